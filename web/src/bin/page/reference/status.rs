//! Status and alarm bits: what each means, and what to do.

use super::{Part, Scroll, book::Section, kinds::Kind};
use encoderscope::{
    format::blinks,
    language::{msg, t},
    layout::{Active, Field, Role},
    profile::Profile,
};
use leptos::prelude::*;

/// A field of named bits or a flag, and what its bits mean.
pub(super) struct Table {
    title: &'static str,
    bits: Vec<Meaning>,
}

#[derive(PartialEq)]
struct Meaning {
    place: Option<u32>,
    name: &'static str,
    level: u8,
    doc: String,
    blinks: bool,
}

/// The fields of named bits and the flags of some kinds of frame, each once.
pub(super) fn tables(kinds: &[Kind]) -> Vec<Table> {
    let mut tables: Vec<Table> = Vec::new();
    let replies = kinds.iter().filter(|kind| kind.is_reply());
    let fields = replies.flat_map(|kind| kind.frame.layout.fields().zip(kind.notes()));
    let mut flags = Vec::new();
    for (field, note) in fields {
        let flag = matches!(
            field.row.role,
            Role::Error | Role::Warning | Role::Valid | Role::ZeroDefault
        );
        if flag {
            let meaning = flag_of(field, note.doc);
            if !flags.contains(&meaning) {
                flags.push(meaning);
            }
        }
        let table = Table {
            title: field.row.name,
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
                title: msg("flags"),
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

fn flag_of(field: &Field, doc: String) -> Meaning {
    Meaning {
        place: None,
        name: field.row.name,
        level: level(field.row.active),
        doc,
        blinks: false,
    }
}

fn named(field: &Field) -> Vec<Meaning> {
    let bits = field.row.bits.iter();
    bits.filter(|bit| bit.place < field.width)
        .map(|bit| Meaning {
            place: Some(bit.place),
            name: bit.name,
            level: level(field.row.active),
            doc: t(bit.doc).to_owned(),
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
            let title = t(table.title).replace('_', " ");
            let leds = table.bits.iter().any(|bit| bit.blinks);
            let rows: Vec<_> = table
                .bits
                .into_iter()
                .map(|bit| {
                    let place = bit
                        .place
                        .map_or(t("flag").to_owned(), |place| format!("b{place}"));
                    let led = match bit.blinks {
                        true => t("blinks once a second"),
                        false => "",
                    };
                    view! {
                        <tr data-testid="reference-status" data-name=bit.name.replace('_', " ")>
                            <td><b>{place}</b> " = " {bit.level}</td>
                            <th scope="row">{t(bit.name).replace('_', " ")}</th>
                            <td class="words">{bit.doc}</td>
                            {leds.then(|| view! { <td class="words">{led}</td> })}
                        </tr>
                    }
                })
                .collect();
            view! {
                <Scroll label=title.clone()>
                    <table>
                        <caption>{title}</caption>
                        <thead>
                            <tr>
                                <th scope="col">{t("bit")}</th>
                                <th scope="col">{t("name")}</th>
                                <th scope="col">{t("what it means, and what to do")}</th>
                                {leds.then(|| view! { <th scope="col">{t("LED")}</th> })}
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
