//! The checks: parameters, a worked example over the frame that is drawn above, and the table.

use super::{
    Part, Scroll,
    book::Section,
    kinds::{self, Kind},
};
use encoderscope::{
    bits::{Bits, Span},
    check::{Algorithm, Checksum, Step, Walk},
    language::t,
    layout::{Covered, Field},
    profile::Profile,
    text,
};
use leptos::prelude::*;

/// What catalogues give the result of, so that programs can be compared.
const SAMPLE: &[u8] = b"123456789";
/// Bits of a row of the worked example.
const ROW: usize = 8;

/// A check of a kind of frame.
struct Check {
    kind: Kind,
    field: Field,
    sum: Checksum,
    covered: Covered,
    walk: Walk,
    received: u64,
}

/// The checks of some kinds of frame, each once, of the frame most read.
fn checks(kinds: &[Kind]) -> Vec<Check> {
    let mut checks: Vec<Check> = Vec::new();
    let (replies, requests): (Vec<_>, Vec<_>) = kinds.iter().partition(|kind| kind.is_reply());
    for kind in replies.into_iter().chain(requests) {
        let layout = &kind.frame.layout;
        for field in layout.fields() {
            let found = field.cover.and_then(|(sum, covered)| {
                Some(Check {
                    kind: kind.clone(),
                    field: field.clone(),
                    sum,
                    covered,
                    walk: layout.walk(field, kind.bits())?,
                    received: layout.wire(field, kind.bits()),
                })
            });
            let known = |check: &Check| {
                checks.iter().any(|other| {
                    other.sum == check.sum && other.field.row.name == check.field.row.name
                })
            };
            checks.extend(found.filter(|check| !known(check)));
        }
    }
    checks
}

#[component]
pub(super) fn Checks(profile: Profile, kinds: StoredValue<Vec<Kind>>) -> impl IntoView {
    let all: Vec<_> = kinds
        .with_value(|kinds| checks(kinds))
        .iter()
        .map(view_of)
        .collect();
    view! { <Part profile=profile section=Section::Checks>{all}</Part> }
}

fn binary(value: u64, width: u32) -> String {
    format!("{value:0width$b}", width = width as usize)
}

fn hex(value: u64, width: u32) -> String {
    format!("{value:0digits$X}", digits = width.div_ceil(4) as usize)
}

/// A register: of whole digits in hexadecimal, else in binary.
fn register(value: u64, width: u32) -> String {
    match width.is_multiple_of(4) {
        true => hex(value, width),
        false => binary(value, width),
    }
}

fn view_of(check: &Check) -> impl IntoView + use<> {
    let title = kinds::title(&check.field);
    let Check {
        kind,
        field,
        sum,
        walk,
        ..
    } = check;
    let over = check.covers();
    let from = kind.frame.layout.layout.title();
    view! {
        <section
            class="kind"
            data-testid="reference-check"
            data-field=field.row.name
            data-kind=kind.key.clone()
            data-value=walk.result.to_string()
            data-received=check.received.to_string()
        >
            <h3><span class="name check">{title.clone()}</span> " " <small>{t(sum.name())}</small></h3>
            <div class="halves">
                <div>
                    {sum.algorithm().map(facts)}
                    <p class="covers">
                        {t("It covers ")} {over} {text!(" = {} bits of “{}”", walk.steps.len(), from)}
                        {(check.covered == Covered::Frame).then_some(t(", its own taken as 0"))} "."
                    </p>
                    {sum.algorithm().map(|crc| table(&title, crc))}
                </div>
                <div>{worked(check)}</div>
            </div>
        </section>
    }
}

impl Check {
    /// The names of the fields that go in, in order.
    fn covers(&self) -> impl IntoView + use<> {
        let layout = &self.kind.frame.layout;
        let mut names: Vec<(String, &'static str)> = Vec::new();
        for step in &self.walk.steps {
            if let Some(field) = layout.field_at(step.at) {
                let name = (kinds::title(field), field.row.role.class().name());
                if !names.contains(&name) {
                    names.push(name);
                }
            }
        }
        names
            .into_iter()
            .map(|(name, class)| view! { <span class=format!("name {}", class)>{name}</span> " " })
            .collect_view()
    }
}

/// The parameters of a CRC.
fn facts(crc: Algorithm) -> impl IntoView {
    let word = |yes: bool| if yes { t("yes") } else { t("no") };
    let sample = Bits::of_bytes(SAMPLE);
    let facts = [
        (
            t("catalogue"),
            crc.name().map_or(t("no name"), t).to_owned(),
        ),
        (t("width"), text!("{} bits", crc.width)),
        (
            t("polynomial"),
            format!("0x{}", hex(crc.polynomial, crc.width)),
        ),
        (t("init"), format!("0x{}", hex(crc.init, crc.width))),
        (t("bytes reflected"), word(crc.refin).to_owned()),
        (t("result reflected"), word(crc.refout).to_owned()),
        (t("xorout"), format!("0x{}", hex(crc.xorout, crc.width))),
        (
            t("check of “123456789”"),
            format!(
                "0x{}",
                hex(crc.compute(sample, Span::new(0, sample.len())), crc.width)
            ),
        ),
    ];
    let facts = facts.map(|(name, value)| view! { <div><dt>{name}</dt><dd>{value}</dd></div> });
    view! { <dl class="crc">{facts.into_view()}</dl> }
}

/// The register after each row of bits, and what comes of it.
fn worked(check: &Check) -> impl IntoView + use<> {
    let walk = &check.walk;
    let width = walk.algorithm.width;
    let layout = &check.kind.frame.layout;
    let level = |step: &Step| if step.bit { '1' } else { '0' };
    let row = |steps: &[Step]| {
        let bits: String = steps.iter().map(level).collect();
        let byte = u64::from_str_radix(&bits, 2)
            .ok()
            .filter(|_| steps.len() == ROW);
        // Each bit in the colour of its field.
        let class = |step: &Step| {
            let field = layout.field_at(step.at);
            field.map_or("none", |field| field.row.role.class().name())
        };
        let coloured: Vec<_> = steps
            .chunk_by(|one, next| class(one) == class(next))
            .map(|run| {
                let class = run.first().map_or("none", class);
                let bits: String = run.iter().map(level).collect();
                view! { <span class=format!("name {}", class)>{bits}</span> }
            })
            .collect();
        let after = steps.last().map_or(walk.start, |step| step.register);
        view! {
            <tr>
                <td>{steps.first().map(|step| step.at)}</td>
                <td>{coloured}</td>
                <td>{byte.map(|byte| hex(byte, 8))}</td>
                <td><b>{register(after, width)}</b></td>
            </tr>
        }
    };
    let rows: Vec<_> = walk.steps.chunks(ROW).map(row).collect();
    let last = walk.steps.last().map_or(walk.start, |step| step.register);
    let mut steps = String::new();
    if walk.algorithm.refout {
        steps += t("→ read backwards ");
    }
    if walk.algorithm.xorout != 0 {
        steps += t("→ inverted ");
    }
    let ending = (!steps.is_empty()).then(|| format!("{} {steps}", register(last, width)));
    let (begins, result) = (register(walk.start, width), register(walk.result, width));
    let good = walk.result == check.received;
    let verdict = match good {
        true => view! { <span class="good">{t("= received ✓")}</span> }.into_any(),
        false => {
            view! { <span class="bad">{t("≠ received ")} {register(check.received, width)}</span> }
                .into_any()
        }
    };
    view! {
        <Scroll label=t("Worked example").to_owned()>
            <table class="worked">
                <caption>{t("The example, worked: the register begins at ")} {begins}</caption>
                <thead>
                    <tr>
                        <th scope="col">{t("from bit")}</th>
                        <th scope="col">{t("goes in")}</th>
                        <th scope="col">{t("hex")}</th>
                        <th scope="col">{t("register")}</th>
                    </tr>
                </thead>
                <tbody>{rows}</tbody>
            </table>
        </Scroll>
        <p class="outcome">{ending} " " <b>{result}</b> " " {verdict}</p>
    }
}

/// The table of a program that goes byte by byte.
fn table(title: &str, crc: Algorithm) -> impl IntoView + use<> {
    let entries = crc.table();
    let count = entries.len();
    let columns = if crc.width > 8 { 8 } else { 16 };
    let rows: Vec<_> = entries
        .chunks(columns)
        .enumerate()
        .map(|(index, row)| {
            let cells: Vec<_> = row
                .iter()
                .map(|value| view! { <td>{hex(*value, crc.width)}</td> })
                .collect();
            view! { <tr><th scope="row">{format!("{:02X}", index * columns)}</th>{cells}</tr> }
        })
        .collect();
    let heads: Vec<_> = (0..columns.min(count))
        .map(|column| view! { <th scope="col">{format!("+{column:X}")}</th> })
        .collect();
    let label = text!("Table of {}", title);
    view! {
        <details class="crc-table" data-testid="reference-table">
            <summary>{text!("The table of {} entries, computed", count)}</summary>
            <Scroll label=label.clone()>
                <table>
                    <caption class="unseen">{label}</caption>
                    <thead><tr><td></td>{heads}</tr></thead>
                    <tbody>{rows}</tbody>
                </table>
            </Scroll>
        </details>
    }
}
