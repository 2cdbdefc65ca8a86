//! Layouts whose widths have been worked out for one shape of frame.

use super::{Check, Cover, Layout, Piece, Role, Row, Weight, fast::Fast};
use crate::{
    bits::{self, BitString, Bits, Span},
    check::{Checksum, Walk},
    format::Format,
    profile::Profile,
};
use alloc::{boxed::Box, vec::Vec};
use core::ops::Range;

/// What the widths of one frame depend on: the profile, and what was found around the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// The profile.
    pub profile: Profile,
    /// Zeros in front of a number that is narrower than its bytes (SSI dumps).
    pub unused: u32,
    /// Ones before the frame: line idle.
    pub idle: u32,
    /// Whether acknowledge, start and cds bits precede the data (BiSS-C).
    pub preamble: bool,
    /// Zeros before the start bit (BiSS-C).
    pub ack: u32,
    /// Decimal digits of the position (ASI4).
    pub digits: u32,
    /// How often the word is repeated behind the first time (multi-transmission of SSI).
    pub repeats: u32,
    /// Bits after the frame.
    pub tail: u32,
}

impl Shape {
    /// The shape in which the profile itself describes a whole frame.
    #[must_use]
    pub const fn of(profile: Profile) -> Self {
        let framed = match profile.own {
            Some(own) => own.is_biss(),
            None => matches!(profile.format, Format::BissC),
        };
        Self {
            unused: 0,
            idle: framed as u32,
            preamble: framed,
            ack: profile.ack_bits,
            digits: bits::decimal_digits(bits::mask(profile.angle_bits as usize)),
            repeats: 0,
            tail: 0,
            profile,
        }
    }
}

impl core::ops::Deref for Shape {
    type Target = Profile;
    fn deref(&self) -> &Profile {
        &self.profile
    }
}

/// A part of a field: a run of bits of the frame and its place in the field's number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Where in the frame.
    pub span: Span,
    /// Place of its least significant bit in the number.
    pub place: u32,
}

/// The bits that a check covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Covered {
    /// A run of bits.
    Run(Span),
    /// The whole frame, the bits of the check itself taken as 0.
    Frame,
}

/// A field of a resolved layout.
#[derive(Clone, Debug)]
pub struct Field {
    /// The row it comes from; of several parts, the first.
    pub row: &'static Row,
    /// Total number of bits.
    pub width: u32,
    parts: Range<usize>,
    /// For a check field, how it is computed and over which bits.
    pub cover: Option<(Checksum, Covered)>,
}

/// How the bits of a run stand for numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coding {
    /// One Gray-coded word.
    Gray,
    /// ASCII digits.
    Decimal,
}

/// A layout whose widths have been worked out for a shape.
#[derive(Clone, Debug)]
pub struct Resolved {
    /// The table.
    pub layout: &'static Layout,
    /// The shape it was resolved for.
    pub shape: Shape,
    /// Length of the frame in bits.
    pub len: usize,
    /// Bits whose value the others decide: checks, constants and padding.
    pub redundancy: u32,
    /// Whether it holds an angle.
    pub has_angle: bool,
    /// Whether a check binds its data.
    pub is_checked: bool,
    /// Whether a zero byte in front of a frame leaves its check as it is, so that a frame read a
    /// byte late passes whenever it begins with 0.
    pub is_zero_led: bool,
    pub(super) fields: Vec<Field>,
    parts: Vec<Part>,
    pub(super) coded: Option<(Coding, Span)>,
    /// What judges and reads many frames quickly.
    pub(super) fast: Option<Box<Fast>>,
}

impl Resolved {
    /// Works out a table for a shape.
    #[must_use]
    pub fn new(layout: &'static Layout, shape: Shape) -> Self {
        let mut plan = Plan::default();
        let len = plan.lay_out(layout, &shape, 0);
        let mut fields: Vec<Field> = Vec::new();
        let mut parts = Vec::new();
        for (row, span) in &plan.runs {
            // Of rows of one name that stand for each other, the one that has bits counts.
            if span.len == 0 || fields.iter().any(|field| field.row.name == row.name) {
                continue;
            }
            let mine = || plan.runs.iter().filter(|(other, _)| other.name == row.name);
            let width: usize = mine().map(|(_, span)| span.len).sum();
            let mut place = width as u32;
            let first = parts.len();
            for (_, span) in mine().filter(|(_, span)| span.len > 0) {
                place -= span.len as u32;
                parts.push(Part { span: *span, place });
            }
            fields.push(Field {
                row,
                width: width as u32,
                parts: first..parts.len(),
                cover: row
                    .check
                    .map(|check| (check.sum, plan.cover(check, row.name))),
            });
        }
        Self {
            layout,
            shape,
            len,
            redundancy: fields.iter().map(redundant).sum(),
            has_angle: fields.iter().any(|field| field.row.role == Role::Angle),
            is_checked: fields.iter().any(Field::is_binding),
            is_zero_led: fields.iter().any(
                |field| matches!(field.cover, Some((sum, Covered::Run(_))) if sum.ignores_zeros()),
            ),
            fields,
            parts,
            coded: plan.coded,
            fast: None,
        }
    }

    /// The fields, in transmission order; each has bits.
    pub fn fields(&self) -> impl DoubleEndedIterator<Item = &Field> {
        self.fields.iter()
    }

    /// The parts of a field, most significant first.
    #[must_use]
    pub fn parts(&self, field: &Field) -> &[Part] {
        &self.parts[field.parts.clone()]
    }

    /// The field that holds bit `index` of the frame.
    #[must_use]
    pub fn field_at(&self, index: usize) -> Option<&Field> {
        self.fields().find(|field| {
            self.parts(field)
                .iter()
                .any(|part| part.span.contains(index))
        })
    }

    /// Where in the frame the bit of a field's number at `place` stands.
    #[must_use]
    pub fn bit_of(&self, field: &Field, place: u32) -> Option<usize> {
        let part = self
            .parts(field)
            .iter()
            .find(|part| (part.place..part.place + part.span.len as u32).contains(&place))?;
        Some(part.span.end() - 1 - (place - part.place) as usize)
    }

    /// How the bits of a field stand for its number, where they are not the number itself, and
    /// the run of bits that is coded together.
    #[must_use]
    pub fn coding(&self, field: &Field) -> Option<(Coding, Span)> {
        let part = self.parts(field).first()?;
        self.coded
            .filter(|(_, span)| span.contains(part.span.start))
    }

    /// The number a field holds.
    #[must_use]
    pub fn read(&self, field: &Field, bits: Bits<'_>) -> u64 {
        if let Some((coding, word)) = self.coding(field)
            && let Some(part) = self.parts(field).first()
        {
            let below = (word.end() - part.span.end()) as u32;
            return match coding {
                Coding::Gray => bits::slice(bits::from_gray(bits.read(word)), below, part.span.len),
                Coding::Decimal => bits.decimal(word).unwrap_or(0),
            };
        }
        self.parts(field).iter().fold(0, |value, part| {
            value | bits::placed(bits.read(part.span), part.place)
        })
    }

    /// The bits of a field as they stand in the frame, whatever they are coded in.
    #[must_use]
    pub fn wire(&self, field: &Field, bits: Bits<'_>) -> u64 {
        self.parts(field).iter().fold(0, |value, part| {
            value | bits::placed(bits.read(part.span), part.place)
        })
    }

    /// Puts a number into a field.
    pub fn write(&self, field: &Field, bits: &mut BitString, value: u64) {
        if let Some((coding, word)) = self.coding(field)
            && let Some(part) = self.parts(field).first()
        {
            match coding {
                Coding::Gray => {
                    let below = (word.end() - part.span.end()) as u32;
                    let keep = bits::from_gray(bits.as_bits().read(word));
                    let all = bits::placed(bits::mask(part.span.len), below);
                    let new = keep & !all | bits::placed(value, below) & all;
                    bits.write(word, bits::to_gray(new));
                }
                Coding::Decimal => bits.write_decimal(word, value),
            }
            return;
        }
        for part in self.parts(field) {
            bits.write(part.span, bits::slice(value, part.place, part.span.len));
        }
    }

    /// The value that a check field must hold; `None` for other fields.
    #[must_use]
    pub fn expected(&self, field: &Field, bits: Bits<'_>) -> Option<u64> {
        self.over(field, bits, Checksum::compute)
    }

    /// How the value that a check field must hold comes about, bit by bit; `None` for other
    /// fields. Where a check covers the whole frame, its own bits go in as 0.
    #[must_use]
    pub fn walk(&self, field: &Field, bits: Bits<'_>) -> Option<Walk> {
        self.over(field, bits, Checksum::walk)
    }

    /// Computes with what a check field covers.
    fn over<T>(
        &self,
        field: &Field,
        bits: Bits<'_>,
        compute: fn(Checksum, Bits<'_>, Span) -> T,
    ) -> Option<T> {
        let (sum, covered) = field.cover?;
        Some(match covered {
            Covered::Run(span) => compute(sum, bits, span),
            Covered::Frame => {
                let mut cleared = BitString::of_bytes(bits.bytes().into());
                for part in self.parts(field) {
                    cleared.write(part.span, 0);
                }
                compute(sum, cleared.as_bits(), Span::new(0, self.len))
            }
        })
    }
}

impl Field {
    /// Whether the frame is bad when this check does not hold.
    #[must_use]
    pub fn is_binding(&self) -> bool {
        self.cover.is_some() && self.row.weight == Weight::Binding
    }
}

/// How many bits of a field the others decide.
fn redundant(field: &Field) -> u32 {
    match field.row.role {
        Role::Repeat => 0,
        _ if field.is_binding() || field.row.constant.is_some() => field.width,
        _ => field.row.zeros.count_ones(),
    }
}

/// A table while its widths are worked out.
#[derive(Default)]
struct Plan {
    /// Runs of bits and the rows they belong to.
    runs: Vec<(&'static Row, Span)>,
    coded: Option<(Coding, Span)>,
}

impl Plan {
    /// Lays a table out from bit `at`; returns where it ends.
    fn lay_out(&mut self, layout: &'static Layout, shape: &Shape, mut at: usize) -> usize {
        for piece in layout.pieces {
            match piece {
                Piece::Row(row) => at = self.row(row, shape, at),
                Piece::LittleEndian(rows) => at = self.little_endian(rows, shape, at),
                Piece::Include(other) => at = self.lay_out(other, shape, at),
                Piece::Gray(when, rows) => {
                    let coding = when(shape).then_some(Coding::Gray);
                    at = self.coded(coding, rows, shape, at);
                }
                Piece::Decimal(rows) => {
                    at = self.coded(Some(Coding::Decimal), rows, shape, at);
                }
            }
        }
        at
    }

    fn row(&mut self, row: &'static Row, shape: &Shape, at: usize) -> usize {
        let span = Span::new(at, row.width.of(shape));
        self.runs.push((row, span));
        span.end()
    }

    fn coded(
        &mut self,
        coding: Option<Coding>,
        rows: &'static [Row],
        shape: &Shape,
        start: usize,
    ) -> usize {
        let end = rows.iter().fold(start, |at, row| self.row(row, shape, at));
        if let Some(coding) = coding {
            self.coded = Some((coding, Span::new(start, end - start)));
        }
        end
    }

    /// Lays `rows` out as one big-endian number from bit `start`, then reverses its bytes.
    fn little_endian(&mut self, rows: &'static [Row], shape: &Shape, start: usize) -> usize {
        let total: usize = rows.iter().map(|row| row.width.of(shape)).sum();
        let bytes = total.div_ceil(8);
        let mut at = bytes * 8 - total;
        for row in rows {
            let end = at + row.width.of(shape);
            if at == end {
                self.runs.push((row, Span::new(start, 0)));
            }
            while at < end {
                let take = (8 - at % 8).min(end - at);
                let byte = bytes - 1 - at / 8;
                let span = Span::new(start + byte * 8 + at % 8, take);
                self.runs.push((row, span));
                at += take;
            }
        }
        start + bytes * 8
    }

    /// The bits that `check`, standing in the row `own`, covers.
    fn cover(&self, check: Check, own: &str) -> Covered {
        let named = |name| self.runs.iter().filter(move |(row, _)| row.name == name);
        let starts = |name| named(name).map(|(_, span)| span.start).min();
        let ends = |name| named(name).map(|(_, span)| span.end()).max();
        let (start, end) = match check.cover {
            Cover::From(first) => (starts(first), starts(own)),
            Cover::Rows(first, last) => (starts(first), ends(last)),
            Cover::Frame => return Covered::Frame,
        };
        let (start, end) = (start.unwrap_or(0), end.unwrap_or(0));
        Covered::Run(Span::new(start, end.saturating_sub(start)))
    }
}
