//! The bits of a frame in rows, with the names of the fields above.

use super::{
    MARGIN, Scene,
    labels::{LINE, Label, place},
    pen::Pen,
};
use crate::{bits::Span, explain::Note, language::t, layout::Class};
use alloc::{format, string::ToString, vec::Vec};

/// Width of a bit.
const CELL: f64 = 20.0;
/// Height of a bit.
const HEIGHT: f64 = 24.0;
/// Height of the line under a field.
const UNDERLINE: f64 = 4.0;

pub(super) fn draw(pen: &mut Pen, scene: &Scene<'_>) {
    for row in rows(scene, (pen.inner() / CELL) as usize) {
        draw_row(pen, scene, row);
    }
}

/// A run of bits that belong to one field.
struct Run<'a> {
    span: Span,
    note: Option<&'a Note>,
}

/// The runs of a row.
fn runs<'a>(scene: &'a Scene<'_>, row: Span) -> Vec<Run<'a>> {
    let mut runs: Vec<Run<'a>> = Vec::new();
    let mut owner = None;
    for at in row.start..row.end() {
        let mine = scene.owners.get(at).copied();
        match runs.last_mut().filter(|_| owner == mine) {
            Some(run) => run.span.len += 1,
            None => runs.push(Run {
                span: Span::new(at, 1),
                note: scene.note(at),
            }),
        }
        owner = mine;
    }
    runs
}

/// Cuts the frame into rows of at most `most` bits: bytes stay whole, and words are cut where a
/// field begins if that leaves a row at least half full.
fn rows(scene: &Scene<'_>, most: usize) -> Vec<Span> {
    let len = scene.owners.len();
    let most = match (scene.is_bytes(), most / 8) {
        (true, 1..) => most / 8 * 8,
        _ => most.max(1),
    };
    let mut rows = Vec::new();
    let mut start = 0;
    while start < len {
        let full = (start + most).min(len);
        let begins = |at: &usize| scene.owners.get(*at) != scene.owners.get(at - 1);
        let end = match full < len && !scene.is_bytes() {
            true => (start + most / 2 + 1..=full).rev().find(begins),
            false => None,
        };
        let end = end.unwrap_or(full);
        rows.push(Span::new(start, end - start));
        start = end;
    }
    rows
}

fn draw_row(pen: &mut Pen, scene: &Scene<'_>, row: Span) {
    let x = |at: usize| MARGIN + (at - row.start) as f64 * CELL;
    let runs = runs(scene, row);
    let mut labels = Vec::new();
    for run in &runs {
        let class = run.note.map_or(Class::Framing, |note| note.class);
        let name = run.note.map_or("", |note| t(note.name));
        let broken = run.note.is_some_and(|note| note.fault.is_some());
        let (text, class) = match broken {
            true => (format!("✗ {name}"), "es-name es-bad"),
            false => (name.to_string(), names(class)),
        };
        labels.push(Label::new(x(run.span.start), &text, class));
    }
    let lines = place(&mut labels, MARGIN + pen.inner());
    let top = pen.y + lines as f64 * LINE;
    for label in &labels {
        let y = top - 3.0 - label.line as f64 * LINE;
        if label.line > 0 {
            let foot = (label.anchor + 1.0, top);
            pen.path(&[(label.anchor + 1.0, y + 2.0), foot], "es-rule");
        }
        pen.text_at(label.x, y, label.class, &label.text);
    }
    for run in &runs {
        let from = x(run.span.start);
        let width = run.span.len as f64 * CELL;
        let class = run.note.map_or(Class::Framing, |note| note.class);
        let said = |note: &Note| format!("{}: {} {}", t(note.name), note.doc, note.text);
        pen.open(&run.note.map_or_else(Default::default, said));
        for at in run.span.start..run.span.end() {
            let digit = if scene.frame.bits.bit(at) { "1" } else { "0" };
            let middle = x(at) + CELL / 2.0;
            pen.text_at(middle, top + HEIGHT - 7.0, "es-bit es-mid es-ink", digit);
        }
        // A gap keeps neighbours of one class apart.
        let line = (width - 2.0, UNDERLINE);
        pen.rect((from + 1.0, top + HEIGHT), line, fill(class));
        if run.note.is_some_and(|note| note.fault.is_some()) {
            pen.rect((from + 1.0, top), (width - 2.0, HEIGHT - 2.0), "es-fault");
        }
        let under = top + HEIGHT + UNDERLINE + 10.0;
        pen.text_at(
            from + 1.0,
            under,
            "es-small es-dim",
            &run.span.start.to_string(),
        );
        pen.close();
    }
    pen.y = top + HEIGHT + UNDERLINE + 24.0;
}

/// How something of a class is filled.
pub(super) const fn fill(class: Class) -> &'static str {
    match class {
        Class::Turns => "es-turns",
        Class::Angle => "es-angle",
        Class::Flags => "es-flags",
        Class::Status => "es-status",
        Class::Check => "es-check",
        Class::Framing => "es-framing",
    }
}

/// How the name of something of a class is painted.
pub(super) const fn names(class: Class) -> &'static str {
    match class {
        Class::Turns => "es-name es-turns",
        Class::Angle => "es-name es-angle",
        Class::Flags => "es-name es-flags",
        Class::Status => "es-name es-status",
        Class::Check => "es-name es-check",
        Class::Framing => "es-name es-framing",
    }
}
