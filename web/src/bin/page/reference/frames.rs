//! The kinds of frame: an example drawn, and the layout as a table.

use super::{
    Part, Scroll,
    book::{Mark, Section, link},
    commands,
    kinds::{self, Kind, Run},
};
use crate::app::App;
use encoderscope::{
    bits,
    dump::Direction,
    explain::Note,
    language::t,
    layout::{Active, Coding, Field, Resolved, Role},
    profile::{Profile, TurnsCode},
    text,
};
use leptos::prelude::*;

#[component]
pub(super) fn Frames(profile: Profile, kinds: StoredValue<Vec<Kind>>) -> impl IntoView {
    let order = match profile.is_serial() {
        true => t(
            "Bits are counted from 0 in the order in which frames are written: byte by byte, the \
             most significant bit first. A UART sends the least significant bit of each byte first.",
        ),
        false => t("Bits are counted from 0 in the order in which they are sent."),
    };
    let kinds = kinds.get_value();
    // The head of the page has drawn the only one.
    let is_drawn = kinds.len() > 1;
    let frames = kinds.into_iter();
    let frames: Vec<_> = frames
        .map(|kind| {
            let drawn = is_drawn.then(|| strip(&kind).into_any());
            view! { <Frame kind=kind drawn=drawn /> }
        })
        .collect();
    view! {
        <Part profile=profile section=Section::Frames>
            <p class="hint">{order}</p>
            {frames}
        </Part>
    }
}

/// One kind of frame.
#[component]
fn Frame(kind: Kind, drawn: Option<AnyView>) -> impl IntoView {
    let goes = match kind.frame.direction {
        Direction::Sent => t("the master sends"),
        Direction::Received => t("the encoder sends"),
    };
    let title = kind.frame.title.clone();
    let asks = commands::asks_for(&kind).map(|asks| format!("{asks}; "));
    let caption = text!("Fields of {}, in the order in which they are sent", title);
    let notes = kind.notes();
    let fields: Vec<Field> = kind.frame.layout.fields().cloned().collect();
    let rows: Vec<_> = fields
        .into_iter()
        .zip(notes)
        .map(|(field, note)| view! { <Row kind=kind.clone() field=field note=note /> })
        .collect();
    let explainer = kind.explainer();
    view! {
        <section class="kind">
            <h3>
                {title}
                <small>{asks} {goes} " " {kind.length()}</small>
            </h3>
            {drawn}
            <Scroll label=caption.clone()>
                <table class="layout">
                    <caption class="unseen">{caption}</caption>
                    <thead>
                        <tr>
                            <th scope="col">{t("bits")}</th>
                            <th scope="col">{t("field")}</th>
                            <th scope="col">{t("width")}</th>
                            <th scope="col">{t("coding")}</th>
                            <th scope="col">{t("what it is")}</th>
                            <th scope="col">{t("in the example")}</th>
                        </tr>
                    </thead>
                    <tbody>{rows}</tbody>
                </table>
            </Scroll>
            <p class="ways"><a href=explainer>{t("Take it apart")}</a></p>
        </section>
    }
}

/// A frame, run by run.
pub(super) fn strip(kind: &Kind) -> impl IntoView + use<> {
    let serial = kind.profile.is_serial();
    let text = kind.text();
    let runs = kinds::runs(&kind.frame.layout, serial.then_some(8));
    let shown = runs.into_iter();
    let strip = match serial {
        false => shown
            .map(|run| run_view(kind, &run))
            .collect_view()
            .into_any(),
        true => {
            let runs: Vec<Run> = shown.collect();
            let octets = runs.chunk_by(|one, other| one.span.start / 8 == other.span.start / 8);
            octets
                .map(|octet| {
                    let at = octet.first().map_or(0, |run| run.span.start / 8);
                    let byte = kind.bits().bytes().get(at).copied().unwrap_or(0);
                    let runs: Vec<_> = octet.iter().map(|run| run_view(kind, run)).collect();
                    view! {
                        <div class="octet-of">
                            <b class="hex">{format!("{byte:02X}")}</b>
                            <div class="runs">{runs}</div>
                        </div>
                    }
                })
                .collect_view()
                .into_any()
        }
    };
    view! {
        <div class="strip" class:bytes=serial role="img" aria-label=text!("example: {}", text)>
            {strip}
        </div>
    }
}

fn run_view(kind: &Kind, run: &Run) -> impl IntoView + use<> {
    let bits: String = (run.span.start..run.span.end())
        .map(|at| if kind.bits().bit(at) { '1' } else { '0' })
        .collect();
    let whole = run.span.len == run.field.width as usize;
    let decimal = kind.frame.layout.coding(&run.field);
    let digits = matches!(decimal, Some((Coding::Decimal, _)));
    // Which bits of its number they are, where there are others elsewhere.
    let part = (!whole && !digits).then(|| {
        let high = run.place as usize + run.span.len - 1;
        let text = match run.span.len {
            1 => high.to_string(),
            _ => format!("{high}…{}", run.place),
        };
        view! { " " <small>{text}</small> }
    });
    view! {
        <div class=format!("run {}", run.field.row.role.class().name())>
            <span class="levels">{bits}</span>
            <span class="label">{kinds::title(&run.field)} {part}</span>
        </div>
    }
}

/// One field.
#[component]
fn Row(kind: Kind, field: Field, note: Note) -> impl IntoView {
    let book = expect_context::<App>().book();
    let layout = &kind.frame.layout;
    let mark = Mark::Field {
        kind: kind.key.clone(),
        name: field.row.name.to_owned(),
    };
    let id = mark.id();
    let href = link(&kind.profile, Some(&mark));
    let spans = spans(layout, &field);
    let bits: Vec<_> = spans
        .iter()
        .map(|(from, to)| view! { <div>{range(*from, *to)}</div> })
        .collect();
    let bytes = kind.profile.is_serial().then(|| {
        let first = spans.iter().map(|(from, _)| from / 8).min().unwrap_or(0);
        let last = spans.iter().map(|(_, to)| to / 8).max().unwrap_or(0);
        let word = if first == last { t("byte") } else { t("bytes") };
        view! { <div class="doc">{word} " " {range(first, last)}</div> }
    });
    let says = match note.text.is_empty() {
        // What only frames is a pattern.
        true => format!("{:0width$b}", note.raw, width = field.width as usize),
        false => note.text,
    };
    let class = field.row.role.class().name();
    let marked = move || book.is_marked(&mark);
    let current = marked.clone();
    view! {
        <tr
            id=id
            tabindex="-1"
            class=class
            class:marked=marked
            aria-current=move || current().then_some("true")
            data-testid="reference-row"
            data-field=field.row.name
            data-kind=kind.key.clone()
        >
            <td>{bits} {bytes}</td>
            <th scope="row"><a class=format!("name {}", class) href=href>{kinds::title(&field)}</a></th>
            <td>{field.width}</td>
            <td class="words">{coding(layout, &field)}</td>
            <td class="words">{note.doc}</td>
            <td class="words">
                <a class="quiet" href=kind.explainer() aria-label=text!("{} in the explainer: {}", kinds::title(&field), says)>{says.clone()}</a>
            </td>
        </tr>
    }
}

fn range(from: usize, to: usize) -> String {
    match from == to {
        true => from.to_string(),
        false => format!("{from}…{to}"),
    }
}

/// The runs of bits of a field in transmission order, from and to; neighbours are one.
fn spans(layout: &Resolved, field: &Field) -> Vec<(usize, usize)> {
    let mut all: Vec<_> = layout.parts(field).iter().map(|part| part.span).collect();
    all.sort_by_key(|span| span.start);
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for span in all {
        let last = span.end().saturating_sub(1);
        match runs.last_mut() {
            Some((_, to)) if *to + 1 == span.start => *to = last,
            _ => runs.push((span.start, last)),
        }
    }
    runs
}

/// How the bits of a field stand for what it says.
fn coding(layout: &Resolved, field: &Field) -> String {
    let row = field.row;
    let width = field.width as usize;
    if let Some(value) = row.constant.filter(|_| row.role != Role::Padding) {
        return text!(
            "always {}",
            format_args!("{:0width$b}", value & bits::mask(width))
        );
    }
    if let Some((sum, _)) = field.cover {
        return match sum.algorithm() {
            Some(crc) => crc.to_string(),
            None => t(sum.name()).to_owned(),
        };
    }
    let parts = layout.parts(field);
    let starts = || parts.iter().map(|part| part.span.start);
    let backwards = starts().zip(starts().skip(1)).any(|(one, next)| next < one);
    let signed = layout.shape.profile.turns_code == TurnsCode::Signed;
    let number = match (row.role, row.active) {
        (Role::Padding, _) => t("always 0"),
        (Role::Speed | Role::Temperature, _) => t("two's complement, tenths"),
        (Role::Turns, _) if signed => t("two's complement"),
        (Role::Turns | Role::Angle | Role::Count, _) => t("unsigned"),
        (Role::Error | Role::Warning | Role::Valid | Role::ZeroDefault, Active::High) => {
            t("1 says so")
        }
        (Role::Error | Role::Warning | Role::Valid | Role::ZeroDefault, Active::Low) => {
            t("0 says so")
        }
        (Role::Status | Role::Alarm, Active::High) => t("a bit a condition, 1 says so"),
        (Role::Status | Role::Alarm, Active::Low) => t("a bit a condition, 0 says so"),
        (Role::Repeat, _) => t("as the word before"),
        (Role::Framing, _) => t("any"),
        _ => t("code"),
    };
    let order = match layout.coding(field) {
        Some((Coding::Gray, word)) if word.len > width => t(", Gray, one word with its neighbour"),
        Some((Coding::Gray, _)) => t(", Gray"),
        Some((Coding::Decimal, _)) => t(", in ASCII digits"),
        None if backwards => t(", little-endian"),
        None if parts.len() > 1 => t(", in parts, most significant first"),
        None => "",
    };
    format!("{number}{order}")
}
