//! Status and alarm bits: what each means, and what to do.

use super::{Part, Scroll, book::Section, kinds::Kind};
use encoderscope::{
    format::blinks,
    layout::{Active, Field, Role},
    profile::Profile,
};
use leptos::prelude::*;

/// A field of named bits or a flag, and what its bits mean.
pub(super) struct Table {
    title: String,
    bits: Vec<Meaning>,
}

#[derive(PartialEq)]
struct Meaning {
    place: Option<u32>,
    name: String,
    level: u8,
    doc: String,
    blinks: bool,
}

/// The fields of named bits and the flags of some kinds of frame, each once.
pub(super) fn tables(kinds: &[Kind]) -> Vec<Table> {
    let mut tables: Vec<Table> = Vec::new();
    let replies = kinds.iter().filter(|kind| kind.is_reply());
    let fields = replies.flat_map(|kind| kind.frame.layout.fields());
    let mut flags = Vec::new();
    for field in fields {
        let flag = matches!(
            field.row.role,
            Role::Error | Role::Warning | Role::Valid | Role::ZeroDefault
        );
        if flag {
            let meaning = flag_of(field);
            if !flags.contains(&meaning) {
                flags.push(meaning);
            }
        }
        let table = Table {
            title: field.row.name.replace('_', " "),
            bits: named(field),
        };
        let known = |other: &Table| other.title == table.title && other.bits == table.bits;
        if !table.bits.is_empty() && !tables.iter().any(known) {
            tables.push(table);
        }
    }
    if !flags.is_empty() {
        tables.insert(
            0,
            Table {
                title: "flags".to_owned(),
                bits: flags,
            },
        );
    }
    tables
}

const fn level(active: Active) -> u8 {
    match active {
        Active::High => 1,
        Active::Low => 0,
    }
}

fn flag_of(field: &Field) -> Meaning {
    let lines: Vec<_> = field.row.doc.iter().map(|line| line.trim()).collect();
    Meaning {
        place: None,
        name: field.row.name.replace('_', " "),
        level: level(field.row.active),
        doc: lines.join(" "),
        blinks: false,
    }
}

fn named(field: &Field) -> Vec<Meaning> {
    let bits = field.row.bits.iter();
    bits.filter(|bit| bit.place < field.width)
        .map(|bit| Meaning {
            place: Some(bit.place),
            name: bit.name.to_owned(),
            level: level(field.row.active),
            doc: bit.doc.to_owned(),
            blinks: blinks(bit.name),
        })
        .collect()
}

#[component]
pub(super) fn Status(profile: Profile, kinds: StoredValue<Vec<Kind>>) -> impl IntoView {
    let tables: Vec<_> = kinds
        .with_value(|kinds| tables(kinds))
        .into_iter()
        .map(|table| {
            let leds = table.bits.iter().any(|bit| bit.blinks);
            let rows: Vec<_> = table
                .bits
                .into_iter()
                .map(|bit| {
                    let place = bit
                        .place
                        .map_or("flag".to_owned(), |place| format!("b{place}"));
                    let led = match bit.blinks {
                        true => "blinks once a second",
                        false => "",
                    };
                    view! {
                        <tr data-testid="reference-status" data-name=bit.name.clone()>
                            <td><b>{place}</b> " = " {bit.level}</td>
                            <th scope="row">{bit.name.clone()}</th>
                            <td class="words">{bit.doc}</td>
                            {leds.then(|| view! { <td class="words">{led}</td> })}
                        </tr>
                    }
                })
                .collect();
            view! {
                <Scroll label=table.title.clone()>
                    <table>
                        <caption>{table.title}</caption>
                        <thead>
                            <tr>
                                <th scope="col">"bit"</th>
                                <th scope="col">"name"</th>
                                <th scope="col">"what it means, and what to do"</th>
                                {leds.then(|| view! { <th scope="col">"LED"</th> })}
                            </tr>
                        </thead>
                        <tbody>{rows}</tbody>
                    </table>
                </Scroll>
            }
        })
        .collect();
    view! { <Part profile=profile section=Section::Status>{tables}</Part> }
}
