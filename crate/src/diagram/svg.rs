//! Pictures of frames and timelines as SVG: self-contained, to be shown inline, as a file or in
//! print.
//!
//! Every class name begins with `es-` and every rule with the class of the theme, so that a
//! picture inside a page changes nothing around it. What a picture shows by colour it also says in
//! words, in its `<title>` and `<desc>` for those who do not see it.
//!
//! ```
//! use encoderscope::{decode::Decoder, diagram::svg::{Style, frame}, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "asi4")])?)?;
//! let line = decoder.frame(b"8192\r\n").unwrap();
//! let picture = frame(&line, None, &Style::default());
//! assert!(picture.starts_with("<svg ") && picture.contains("8\u{202f}192"));
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```

mod labels;
mod pen;
mod strip;
mod table;
mod theme;
mod waves;

pub(crate) use pen::{escaped, number};
pub use theme::{Palette, Theme};

use super::Timeline;
use crate::{
    decode::Frame, explain::Note, format::Medium, language::t, layout::Class, record::hex, text,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};
use pen::{Pen, wrapped};

/// Pixels around everything.
const MARGIN: f64 = 16.0;
/// The narrowest picture.
const NARROWEST: u32 = 320;
/// The widest picture.
const WIDEST: u32 = 8_192;

/// How a picture looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// Its colours.
    pub theme: Theme,
    /// How wide it is, in pixels, 320…8192; long frames take more rows.
    pub width: u32,
}

impl Default for Style {
    /// 960 pixels, in the colours that the reader prefers.
    fn default() -> Self {
        Self {
            theme: Theme::Auto,
            width: 960,
        }
    }
}

/// A frame: its bits in the order of the layout with the names of the fields, a table of the
/// fields, and, where there is one, its timeline.
#[must_use]
pub fn frame(frame: &Frame<'_>, timeline: Option<&Timeline>, style: &Style) -> String {
    let scene = Scene::new(frame);
    let mut pen = Pen::new(width(style));
    scene.head(&mut pen);
    strip::draw(&mut pen, &scene);
    table::fields(&mut pen, &scene);
    if let Some(timeline) = timeline {
        waves::draw(&mut pen, &scene, timeline);
        table::limits(&mut pen, timeline);
    }
    pen.finish(style.theme, &scene.title(), &scene.describe())
}

/// The timeline of a frame alone, with its limits.
#[must_use]
pub fn timeline(frame: &Frame<'_>, timeline: &Timeline, style: &Style) -> String {
    let scene = Scene::new(frame);
    let mut pen = Pen::new(width(style));
    waves::draw(&mut pen, &scene, timeline);
    table::limits(&mut pen, timeline);
    let title = text!("{}, on the wire", scene.title());
    let said = timeline.limits.iter().map(|limit| match limit.holds {
        true => text!(" {} holds: {}.", t(limit.name), limit.value),
        false => text!(" {} fails: {}.", t(limit.name), limit.value),
    });
    let desc = scene.describe() + &said.collect::<String>();
    pen.finish(style.theme, &title, &desc)
}

fn width(style: &Style) -> f64 {
    style.width.clamp(NARROWEST, WIDEST).into()
}

/// What is drawn.
struct Scene<'a> {
    frame: &'a Frame<'a>,
    notes: Vec<Note>,
    faults: Vec<String>,
    /// Of every bit, the note that explains it.
    owners: Vec<Option<usize>>,
}

impl<'a> Scene<'a> {
    fn new(frame: &'a Frame<'a>) -> Self {
        let notes = frame.explain();
        let mut owners = alloc::vec![None; frame.layout.len];
        for (index, note) in notes.iter().enumerate() {
            for at in note.spans.iter().flat_map(|span| span.start..span.end()) {
                if let Some(owner) = owners.get_mut(at) {
                    *owner = Some(index);
                }
            }
        }
        let faults = frame.faults();
        Self {
            faults: faults.iter().map(|fault| fault.kind.to_string()).collect(),
            frame,
            notes,
            owners,
        }
    }

    /// The note of a bit.
    fn note(&self, bit: usize) -> Option<&Note> {
        let owner = self.owners.get(bit).copied().flatten()?;
        self.notes.get(owner)
    }

    fn class(&self, bit: usize) -> Class {
        self.note(bit).map_or(Class::Framing, |note| note.class)
    }

    /// Whether the frame comes as bytes.
    fn is_bytes(&self) -> bool {
        self.frame.layout.shape.profile.medium() != Medium::Bits
    }

    fn title(&self) -> String {
        let name = t(self.frame.layout.shape.profile.title());
        text!("{}: a frame of {} bits", name, self.owners.len())
    }

    /// All fields and faults in words.
    fn describe(&self) -> String {
        let fields = self.notes.iter().map(|note| {
            let text = match note.text.is_empty() {
                true => note.doc.trim_end_matches('.'),
                false => &note.text,
            };
            let width: usize = note.spans.iter().map(|span| span.len).sum();
            text!(
                "{}, {} {1|bit|bits}, {}: {}.",
                t(note.name),
                width,
                note.raw,
                text
            )
        });
        let faults = self.faults.iter().map(|fault| text!("Fault: {}.", fault));
        fields.chain(faults).collect::<Vec<_>>().join(" ")
    }

    fn head(&self, pen: &mut Pen) {
        pen.down(14.0);
        pen.text(MARGIN, "es-head es-ink", &self.title());
        let bytes = self.frame.bits.bytes();
        let digits: Vec<String> = bytes.iter().map(|byte| hex(&[*byte])).collect();
        for line in wrapped(&digits.join(" "), pen.inner(), 7.4) {
            pen.down(18.0);
            pen.text(MARGIN, "es-mono es-dim", &line);
        }
        let checked = match self.frame.layout.is_checked {
            true => t("every check holds"),
            false => t("nothing speaks against it; the format has no checksum"),
        };
        if self.faults.is_empty() {
            pen.down(20.0);
            pen.text(MARGIN, "es-good", &format!("✓ {checked}"));
        }
        for fault in &self.faults {
            for line in wrapped(&format!("✗ {fault}"), pen.inner(), 7.0) {
                pen.down(20.0);
                pen.text(MARGIN, "es-bad", &line);
            }
        }
        pen.down(16.0);
    }
}
