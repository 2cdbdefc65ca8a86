//! Layouts of encoders that are on no list, written by a user and kept in a link.
//!
//! What is [`Written`] becomes the same table that the manuals' formats are made of, so that it is
//! decoded, explained, encoded and read live like them. Some such layouts are [`SHIPPED`].
//!
//! ```
//! use encoderscope::{decode::Decoder, profile::Profile};
//! let layout = "Counter;stream;const:8:0xa5,angle:16,crc:8:0x07";
//! let decoder = Decoder::new(Profile::parse([("format", "own"), ("layout", layout)])?)?;
//! let frame = decoder.frame(&[0xa5, 0x40, 0x00, 0xd3]).unwrap();
//! assert!(frame.ok(), "{:?}", frame.faults());
//! assert_eq!(frame.reading().unwrap().degrees(), 90.0);
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```

mod draft;
mod judge;
mod shipped;

pub(crate) use draft::LONGEST_NAME;
pub use draft::{CrcRule, Draft, Framing, Kind, MOST_FIELDS, Written};
pub use shipped::{SHIPPED, Shipped};

use super::{spared, Format, Limits, Manual, Link, Spec, biss_c, said, ssi};
use crate::{
    check::{Algorithm, Checksum, OwnCrc},
    language::msg,
    layout::{Check, Cover, Layout, Piece, Resolved, Row, Shape, StatusBit, Width},
    profile::{Justify, Profile},
    text,
};
use alloc::{
    boxed::Box,
    format,
    string::{String, ToString},
    vec::Vec,
};
use core::fmt;
use once_cell::race::OnceBox;

/// Most different layouts that are kept.
const MOST_LAYOUTS: usize = 10_000;

/// Microseconds from one frame of a stream to the next, where nobody says otherwise.
pub(super) const INTERVAL: u64 = 1_000;

/// A user's layout.
pub const SPEC: Spec = Spec {
    name: "own",
    title: msg("own layout"),
    link: Link::Clocked,
    parameters: &["layout", "turns-code", "justify", "baud"],
    quantities: &[],
    limits: Limits {
        angle: 64,
        turns: 32,
        together: 96,
        frame: (0, 0),
    },
    interval: Some(INTERVAL),
    default: Profile {
        angle_bits: 1,
        turns_bits: 0,
        status_bits: 0,
        baud: 115_200,
        ..Profile::base(Format::Own)
    },
};

/// What its manual says of it.
pub const MANUAL: Manual = Manual {
    about: said("a layout that comes with the program, or that a user wrote"),
    source: said("the user"),
    timing: None,
    example: spared("00 03 08 f6 43 eb\n"),
    guesses: &[],
    layouts: |profile, shape| profile.own.into_iter().map(|own| Resolved::new(own.layout(), shape)).collect(),
};

/// A layout of the user's own. There is one of each text, for as long as the program runs.
pub struct Own {
    text: String,
    short: String,
    written: Written,
    layout: Layout,
    angle_bits: u32,
    turns_bits: u32,
}

impl PartialEq for Own {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl Eq for Own {}

impl fmt::Debug for Own {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Own {
    /// What the encoder is called.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.written.title
    }

    /// The layout as text, or the name of a shipped one.
    #[must_use]
    pub fn short(&self) -> &str {
        &self.short
    }

    /// Where it is described, of one that comes with the program.
    #[must_use]
    pub fn source(&self) -> Option<&'static str> {
        let shipped = SHIPPED.iter().find(|shipped| shipped.name == self.short);
        shipped.map(|shipped| shipped.source)
    }

    /// What it was made from.
    #[must_use]
    pub const fn written(&self) -> &Written {
        &self.written
    }

    /// The table.
    #[must_use]
    pub const fn layout(&self) -> &Layout {
        &self.layout
    }

    /// How frames come.
    #[must_use]
    pub const fn link(&self) -> Link {
        match self.written.framing {
            Framing::Line | Framing::Biss => Link::Clocked,
            Framing::Stream => Link::Stream,
            Framing::Poll(_) => Link::Polled,
        }
    }

    /// The byte that the encoder answers to.
    #[must_use]
    pub const fn request(&self) -> Option<u8> {
        match self.written.framing {
            Framing::Poll(byte) => Some(byte),
            _ => None,
        }
    }

    /// Whether the reply begins with the request.
    #[must_use]
    pub fn echoes(&self) -> bool {
        let first = self.written.fields.first();
        first.is_some_and(|field| {
            field.kind == Kind::Const
                && field.width == 8
                && self.request().map(u64::from) == Some(field.value)
        })
    }

    pub(crate) const fn is_biss(&self) -> bool {
        matches!(self.written.framing, Framing::Biss)
    }

    /// The width that `profile` has not from this layout, and how wide it is here.
    pub(crate) fn differs(&self, profile: &Profile) -> Option<(&'static str, u32)> {
        let widths = [
            ("angle-bits", profile.angle_bits, self.angle_bits),
            ("turns-bits", profile.turns_bits, self.turns_bits),
        ];
        let mut wrong = widths.into_iter().filter(|(_, said, own)| said != own);
        wrong.next().map(|(name, _, own)| (name, own))
    }

    /// Makes `profile` one of this layout.
    pub(crate) fn fit(&'static self, profile: &mut Profile) {
        profile.own = Some(self);
        profile.angle_bits = self.angle_bits;
        profile.turns_bits = self.turns_bits;
        profile.justify = match self.is_biss() {
            true => Justify::Left,
            false => Justify::Right,
        };
    }
}

/// The names of the shipped layouts, with spaces between.
pub(crate) fn names() -> String {
    let names: Vec<_> = SHIPPED.iter().map(|shipped| shipped.name).collect();
    names.join(" ")
}

/// One of the layouts that are kept, and the next.
struct Kept {
    own: Own,
    next: OnceBox<Self>,
}

static KEPT: OnceBox<Kept> = OnceBox::new();

/// The layout of a text, or of the name of a shipped one.
///
/// # Errors
///
/// The text is no layout; says which field is wrong, and what would fit.
///
/// ```
/// use encoderscope::format::own;
/// assert_eq!(own::of("rls-biss-26").unwrap().short(), "rls-biss-26");
/// assert!(own::of("Mine;line;angel:12").unwrap_err().contains("field 1"));
/// ```
pub fn of(text: &str) -> Result<&'static Own, String> {
    let text = text.trim();
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == text);
    let written: Written = shipped.map_or(text, |shipped| shipped.text).parse()?;
    let text = written.to_string();
    let mut place = &KEPT;
    for _ in 0..MOST_LAYOUTS {
        let kept = match place.get() {
            Some(kept) => kept,
            None => {
                let own = build(&written, &text)?;
                let next = OnceBox::new();
                place.get_or_init(|| Box::new(Kept { own, next }))
            }
        };
        if kept.own.text == text {
            return Ok(&kept.own);
        }
        place = &kept.next;
    }
    Err(text!("more than {} different layouts", MOST_LAYOUTS))
}

fn build(written: &Written, text: &str) -> Result<Own, String> {
    let names = names_of(written);
    judge::judge(written, &names)?;
    let names = kept(&names);
    let rows: Vec<Row> = written
        .fields
        .iter()
        .zip(&names)
        .map(|(field, name)| row(field, name, &names))
        .collect();
    let framed = matches!(written.framing, Framing::Biss);
    let mut pieces = Vec::new();
    match written.framing {
        Framing::Biss => pieces.push(Piece::Include(&biss_c::PREAMBLE)),
        Framing::Line => pieces.push(Piece::Include(&ssi::BEFORE)),
        Framing::Stream | Framing::Poll(_) => {}
    }
    group(written, rows, &mut pieces);
    match written.framing {
        _ if framed => pieces.push(Piece::Include(&biss_c::BEHIND)),
        Framing::Line => pieces.push(Piece::Include(&ssi::AFTER)),
        _ => {}
    }
    let bits = |kind: Kind| {
        let mine = written.fields.iter().filter(|field| field.kind == kind);
        mine.map(|field| field.width).sum()
    };
    let shipped = SHIPPED
        .iter()
        .find(|shipped| shipped.text.parse().as_ref() == Ok(written));
    Ok(Own {
        text: text.to_string(),
        short: shipped.map_or(text, |shipped| shipped.name).to_string(),
        written: written.clone(),
        layout: Layout {
            doc: Box::leak(Box::new([&*Box::leak(
                written.title.clone().into_boxed_str(),
            )])),
            pieces: Box::leak(pieces.into_boxed_slice()),
        },
        angle_bits: bits(Kind::Angle),
        turns_bits: bits(Kind::Turns),
    })
}

/// What fields are called: their own name, or their kind; framing fields are told apart.
fn names_of(written: &Written) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for field in &written.fields {
        let base = field.name.as_deref().unwrap_or(field.kind.name());
        let single = !matches!(field.kind, Kind::Angle | Kind::Turns);
        let mut name = base.to_string();
        let mut count = 1;
        while single && field.name.is_none() && names.contains(&name) {
            count += 1;
            name = format!("{base}{count}");
        }
        names.push(name);
    }
    names
}

/// The names for as long as the program runs; parts of one number share theirs.
fn kept(names: &[String]) -> Vec<&'static str> {
    let mut kept: Vec<&'static str> = Vec::new();
    for name in names {
        let known = kept.iter().find(|known| *known == name).copied();
        kept.push(known.unwrap_or_else(|| Box::leak(name.clone().into_boxed_str())));
    }
    kept
}

fn row(field: &Draft, name: &'static str, names: &[&'static str]) -> Row {
    let doc: &'static [&'static str] = Box::leak(Box::new([field.kind.doc()]));
    let mut row = Row::new(name, field.kind.role(), doc, Width::Bits(field.width));
    row.active = field.active;
    if field.kind == Kind::Const {
        row.constant = Some(field.value);
    }
    let top = field.bits.len();
    let bits: Vec<StatusBit> = field
        .bits
        .iter()
        .enumerate()
        .filter(|(_, name)| !name.is_empty())
        .map(|(index, name)| StatusBit {
            place: (top - 1 - index) as u32,
            name: Box::leak(name.clone().into_boxed_str()),
            doc: "",
            role: None,
        })
        .collect();
    row.bits = Box::leak(bits.into_boxed_slice());
    let sum = match field.kind {
        Kind::Even => Checksum::EvenParity,
        Kind::Odd => Checksum::OddParity,
        Kind::Crc => Checksum::Own(Box::leak(Box::new(OwnCrc::new(algorithm(field))))),
        _ => return row,
    };
    let named = |wanted: &Option<String>| {
        let known = names.iter().copied();
        wanted
            .as_ref()
            .and_then(|wanted| known.clone().find(|name| name == wanted))
    };
    let first = named(&field.from)
        .or(names.first().copied())
        .unwrap_or(name);
    let cover = match named(&field.to) {
        Some(last) => Cover::Rows(first, last),
        None => Cover::From(first),
    };
    row.check = Some(Check { sum, cover });
    row
}

fn algorithm(field: &Draft) -> Algorithm {
    let rule = field.crc;
    Algorithm {
        width: field.width,
        polynomial: rule.polynomial,
        init: rule.init,
        refin: rule.reflected,
        refout: rule.reflected,
        xorout: rule.xorout,
    }
}

/// Puts rows into pieces: Gray neighbours into one word, little-endian neighbours into numbers of
/// whole bytes.
fn group(written: &Written, rows: Vec<Row>, pieces: &mut Vec<Piece>) {
    let mut number: Vec<Row> = Vec::new();
    let mut word: Vec<Row> = Vec::new();
    for (field, row) in written.fields.iter().zip(rows) {
        if !field.gray && !word.is_empty() {
            let rows = Box::leak(core::mem::take(&mut word).into_boxed_slice());
            pieces.push(Piece::Gray(always, rows));
        }
        match (field.gray, field.little_endian) {
            (true, _) => word.push(row),
            (false, true) => number.push(row),
            (false, false) => pieces.push(Piece::Row(row)),
        }
        let bits: usize = number.iter().map(width).sum();
        if bits > 0 && bits.is_multiple_of(8) {
            let rows = Box::leak(core::mem::take(&mut number).into_boxed_slice());
            pieces.push(Piece::LittleEndian(rows));
        }
    }
    if !word.is_empty() {
        pieces.push(Piece::Gray(always, Box::leak(word.into_boxed_slice())));
    }
}

const fn always(_: &Shape) -> bool {
    true
}

fn width(row: &Row) -> usize {
    match row.width {
        Width::Bits(bits) => bits as usize,
        Width::Of(_) => 0,
    }
}
