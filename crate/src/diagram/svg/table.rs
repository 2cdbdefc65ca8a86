//! Tables: the fields of a frame, the limits of a timeline.

use super::{
    MARGIN, Scene, Timeline,
    labels::shortened,
    pen::{Pen, wrapped},
    strip::fill,
};
use crate::{
    explain::{Note, grouped},
    language::t,
    layout::Resolved,
    text,
};
use alloc::{format, string::String, vec::Vec};

/// Width of a letter of a monospaced word, of plain text.
const MONO: f64 = 7.4;
const TEXT: f64 = 6.8;
/// Height of a line.
const LINE: f64 = 18.0;
/// Narrower than this, text stands below and not beside.
const BESIDE: f64 = 220.0;
/// Widest field whose bits are written one by one.
const BITS: u32 = 24;

pub(super) fn fields(pen: &mut Pen, scene: &Scene<'_>) {
    let rows: Vec<[String; 3]> = scene
        .notes
        .iter()
        .map(|note| {
            let bits = bits(&scene.frame.layout, note, scene);
            [shortened(t(note.name)), grouped(note.raw), bits]
        })
        .collect();
    let widest = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0) as f64
    };
    let name = MARGIN + 16.0;
    let raw = name + widest(0) * MONO + 16.0;
    let bits = raw + widest(1) * MONO + 16.0;
    let text = bits + widest(2) * MONO + 16.0;
    let room = MARGIN + pen.inner() - text;
    let (text, room, beside) = match room >= BESIDE {
        true => (text, room, true),
        false => (name, pen.inner() - 16.0, false),
    };
    for (note, [first, second, third]) in scene.notes.iter().zip(&rows) {
        pen.rule();
        let top = pen.y;
        pen.down(LINE);
        pen.text(name, "es-mono es-ink", first);
        pen.text(raw, "es-mono es-ink", second);
        pen.text(bits, "es-mono es-dim", third);
        let said = match note.text.is_empty() {
            true => &note.doc,
            false => &note.text,
        };
        let fault = note.fault.map(|fault| format!("✗ {}", fault.kind));
        let mut lines: Vec<(&str, String)> = Vec::new();
        for (class, words) in [("es-ink", Some(said.clone())), ("es-bad", fault)] {
            let words = words.unwrap_or_default();
            if !words.is_empty() {
                let cut = wrapped(&words, room, TEXT).into_iter();
                lines.extend(cut.map(|line| (class, line)));
            }
        }
        for (index, (class, line)) in lines.iter().enumerate() {
            if index > 0 || !beside {
                pen.down(LINE);
            }
            pen.text(text, class, line);
        }
        pen.down(7.0);
        let height = pen.y - top - 10.0;
        pen.rect((MARGIN, top + 5.0), (5.0, height), fill(note.class));
    }
    pen.rule();
    pen.down(20.0);
}

/// The bits of a field as they were sent, and how many.
fn bits(layout: &Resolved, note: &Note, scene: &Scene<'_>) -> String {
    let field = layout.fields().find(|field| field.row.name == note.name);
    let Some(field) = field else {
        return String::new();
    };
    let count = field.width;
    let width = count as usize;
    let bit = t("bit");
    let wire = layout.wire(field, scene.frame.bits);
    if count <= BITS {
        format!("{wire:0width$b} · {count} {bit}")
    } else if count <= u64::BITS {
        let digits = width.div_ceil(4);
        format!("0x{wire:0digits$x} · {count} {bit}")
    } else {
        format!("{count} {bit}")
    }
}

pub(super) fn limits(pen: &mut Pen, timeline: &Timeline) {
    for limit in &timeline.limits {
        pen.rule();
        let (name, value) = (t(limit.name), &limit.value);
        let (head, class) = match limit.holds {
            true => (text!("✓ {}: holds, {}", name, value), "es-good"),
            false => (text!("✗ {}: fails, {}", name, value), "es-bad"),
        };
        pen.down(LINE);
        pen.text(MARGIN, class, &head);
        let asked = format!("{} ({})", limit.text, t(limit.source));
        for line in wrapped(&asked, pen.inner() - 16.0, TEXT) {
            pen.down(LINE);
            pen.text(MARGIN + 16.0, "es-dim", &line);
        }
        pen.down(7.0);
    }
}
