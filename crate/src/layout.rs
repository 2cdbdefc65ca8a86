//! `layout!`: one table a frame, the single source of where every field stands.
//!
//! A row holds a field's doc, name, role, width and, where it has them, its polarity, its named
//! bits, its fixed value or its checksum. Rows stand in transmission order and offsets are
//! their sums, so a gap or an overlap cannot be written. Widths are computed from the profile.
//! Rows of one name are parts of one field, most significant first; rows inside `le { … }`
//! form one number that is sent as little-endian bytes; `include TABLE;` stands for the rows
//! of another table.
//!
//! Decoder, encoder, explainer and checks all read a [`Resolved`] layout: a table whose widths
//! have been worked out once, so that the frame loop only shifts.

use crate::{
    bits::{self, BitString, Bits, Span},
    check::Checksum,
    profile::Profile,
};
use alloc::vec::Vec;
use core::ops::Range;

/// What a field means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Bits that frame the data and carry no value: idle, acknowledge, tail.
    Framing,
    /// Bits that must be 0 because the number beside them is narrower than its bytes.
    Padding,
    /// The operation a request asks for, echoed in the reply.
    Operation,
    /// Whole turns.
    Turns,
    /// Angle within one turn.
    Angle,
    /// Position data is invalid.
    Error,
    /// Position data is valid, but something is near its limit.
    Warning,
    /// Status bits.
    Status,
    /// The alarm byte of T485.
    Alarm,
    /// Encoder identity of T485.
    Enid,
    /// Revolutions per second × 10, 16-bit two's complement.
    Speed,
    /// Degrees Celsius × 10, 16-bit two's complement.
    Temperature,
    /// How many commands of a sequence the encoder has counted.
    Count,
    /// EEPROM address.
    MemoryAddress,
    /// EEPROM data.
    MemoryData,
    /// CRC.
    Crc,
    /// Parity.
    Parity,
}

/// The colour of a field: the same class has the same hue everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Turns.
    Turns,
    /// Angle.
    Angle,
    /// Error and warning flags, counts.
    Flags,
    /// Status, alarm, temperature and speed.
    Status,
    /// CRC and parity.
    Check,
    /// Everything that frames.
    Framing,
}

impl Class {
    /// The name used in style sheets and records.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Turns => "turns",
            Self::Angle => "angle",
            Self::Flags => "flags",
            Self::Status => "status",
            Self::Check => "check",
            Self::Framing => "framing",
        }
    }
}

impl Role {
    /// The class of a field with this role.
    #[must_use]
    pub const fn class(self) -> Class {
        match self {
            Self::Framing | Self::Padding | Self::Operation | Self::Enid => Class::Framing,
            Self::Turns => Class::Turns,
            Self::Angle => Class::Angle,
            Self::Error | Self::Warning | Self::Count => Class::Flags,
            Self::Status
            | Self::Alarm
            | Self::Speed
            | Self::Temperature
            | Self::MemoryAddress
            | Self::MemoryData => Class::Status,
            Self::Crc | Self::Parity => Class::Check,
        }
    }
}

/// Which level asserts a flag; framing bits rest at the other one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Active {
    /// 1 asserts.
    High,
    /// 0 asserts.
    Low,
}

/// One named bit of a status field.
#[derive(Clone, Copy, Debug)]
pub struct StatusBit {
    /// Place in the field, 0 being the least significant bit.
    pub place: u32,
    /// Short name.
    pub name: &'static str,
    /// What it means and what to do, shown when the bit is set.
    pub doc: &'static str,
    /// Whether this bit is the format's error or warning flag.
    pub role: Option<Role>,
}

/// Which bits a checksum covers.
#[derive(Clone, Copy, Debug)]
pub struct Check {
    /// How it is computed.
    pub sum: Checksum,
    /// Name of the first covered row.
    pub first: &'static str,
    /// Name of the last covered row; without one, all bits up to the check field.
    pub last: Option<&'static str>,
}

impl Check {
    /// Everything from the row `first` up to the check field.
    #[must_use]
    pub const fn from(sum: Checksum, first: &'static str) -> Option<Self> {
        Some(Self {
            sum,
            first,
            last: None,
        })
    }

    /// One row.
    #[must_use]
    pub const fn of(sum: Checksum, row: &'static str) -> Option<Self> {
        Some(Self {
            sum,
            first: row,
            last: Some(row),
        })
    }
}

/// One row of a layout table.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Name in the field's standard terms.
    pub name: &'static str,
    /// What it means.
    pub role: Role,
    /// The manual's explanation, in lines.
    pub doc: &'static [&'static str],
    /// Number of bits for a frame shape.
    pub width: fn(&Shape) -> u32,
    /// Which level asserts a flag; framing bits rest at the other one.
    pub active: Active,
    /// Names of the single bits.
    pub bits: &'static [StatusBit],
    /// The value it always has.
    pub constant: Option<u64>,
    /// Bits of its number that are always 0.
    pub zeros: u64,
    /// How it is computed, for a check field.
    pub check: Option<Check>,
}

impl Row {
    /// A row with no more than a name, a role, a doc and a width.
    #[must_use]
    pub const fn new(
        name: &'static str,
        role: Role,
        doc: &'static [&'static str],
        width: fn(&Shape) -> u32,
    ) -> Self {
        Self {
            name,
            role,
            doc,
            width,
            active: Active::High,
            bits: &[],
            constant: match role {
                Role::Padding => Some(0),
                _ => None,
            },
            zeros: 0,
            check: None,
        }
    }
}

/// A piece of a table: one row, or rows that form one little-endian number.
#[derive(Clone, Copy, Debug)]
pub enum Piece {
    /// One row, most significant bit first.
    Row(Row),
    /// Rows that form one number, written most significant first and sent last byte first.
    LittleEndian(&'static [Row]),
    /// The rows of another table.
    Include(&'static Layout),
}

/// A layout table, made by `layout!`.
#[derive(Debug)]
pub struct Layout {
    /// What the frame is.
    pub doc: &'static [&'static str],
    /// The rows in transmission order.
    pub pieces: &'static [Piece],
}

/// Writes a [`Layout`] table; see the module's documentation and the files of `format`.
macro_rules! layout {
    ($(#[doc = $doc:expr])* $vis:vis static $table:ident($p:ident) { $($body:tt)* }) => {
        $(#[doc = $doc])*
        $vis static $table: $crate::layout::Layout = $crate::layout::Layout {
            doc: &[$($doc),*],
            pieces: layout!(@pieces $p () $($body)*),
        };
    };
    (@pieces $p:ident ($($done:tt)*)) => { &[$($done)*] };
    (@pieces $p:ident ($($done:tt)*) le { $($rows:tt)* } $($rest:tt)*) => {
        layout!(@pieces $p ($($done)*
            $crate::layout::Piece::LittleEndian(layout!(@rows $p () $($rows)*)),) $($rest)*)
    };
    (@pieces $p:ident ($($done:tt)*) include $other:ident; $($rest:tt)*) => {
        layout!(@pieces $p ($($done)* $crate::layout::Piece::Include(&$other),) $($rest)*)
    };
    (@pieces $p:ident ($($done:tt)*)
        $(#[doc = $doc:expr])* $name:ident: $role:ident[$width:expr] $(, $key:ident = $value:expr)*;
        $($rest:tt)*) => {
        layout!(@pieces $p ($($done)* $crate::layout::Piece::Row(
            layout!(@row $p [$($doc),*] $name $role [$width] $($key = $value),*)),) $($rest)*)
    };
    (@rows $p:ident ($($done:tt)*)) => { &[$($done)*] };
    (@rows $p:ident ($($done:tt)*)
        $(#[doc = $doc:expr])* $name:ident: $role:ident[$width:expr] $(, $key:ident = $value:expr)*;
        $($rest:tt)*) => {
        layout!(@rows $p ($($done)*
            layout!(@row $p [$($doc),*] $name $role [$width] $($key = $value),*),) $($rest)*)
    };
    (@row $p:ident [$($doc:expr),*] $name:ident $role:ident [$width:expr]
        $($key:ident = $value:expr),*) => {
        $crate::layout::Row {
            $($key: $value,)*
            ..$crate::layout::Row::new(
                stringify!($name),
                $crate::layout::Role::$role,
                &[$($doc),*],
                |$p: &$crate::layout::Shape| { let _ = $p; $width },
            )
        }
    };
}
pub(crate) use layout;

/// What the widths of one frame depend on: the profile, and what was found around the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// The profile.
    pub profile: Profile,
    /// Ones before the frame (BiSS-C line idle).
    pub idle: u32,
    /// Whether acknowledge, start and cds bits precede the data (BiSS-C).
    pub preamble: bool,
    /// Zeros before the start bit (BiSS-C).
    pub ack: u32,
    /// Bits after the frame.
    pub tail: u32,
}

impl Shape {
    /// The shape in which the profile itself describes a whole frame.
    #[must_use]
    pub const fn of(profile: Profile) -> Self {
        Self {
            idle: 1,
            preamble: true,
            ack: profile.ack_bits,
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

/// A field of a resolved layout.
#[derive(Clone, Debug)]
pub struct Field {
    /// The row it comes from; of several parts, the first.
    pub row: &'static Row,
    /// Total number of bits.
    pub width: u32,
    parts: Range<usize>,
    /// For a check field, the bits it covers.
    pub cover: Option<(Checksum, Span)>,
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
    fields: Vec<Field>,
    parts: Vec<Part>,
}

impl Resolved {
    /// Works out a table for a shape.
    #[must_use]
    pub fn new(layout: &'static Layout, shape: Shape) -> Self {
        let mut runs = Vec::new();
        let len = lay_out(layout, &shape, 0, &mut runs);
        let mut fields: Vec<Field> = Vec::new();
        let mut parts = Vec::new();
        for (row, _) in &runs {
            if fields.iter().any(|field| field.row.name == row.name) {
                continue;
            }
            let mine = || runs.iter().filter(|(other, _)| other.name == row.name);
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
                    .map(|check| (check.sum, cover(&runs, check, row.name))),
            });
        }
        Self {
            layout,
            shape,
            len,
            redundancy: fields
                .iter()
                .map(
                    |field| match field.cover.is_some() || field.row.constant.is_some() {
                        true => field.width,
                        false => field.row.zeros.count_ones(),
                    },
                )
                .sum(),
            fields,
            parts,
        }
    }

    /// The fields that have bits, in transmission order.
    pub fn fields(&self) -> impl Iterator<Item = &Field> {
        self.fields.iter().filter(|field| field.width > 0)
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

    /// The number a field holds.
    #[must_use]
    pub fn read(&self, field: &Field, bits: Bits<'_>) -> u64 {
        self.parts(field).iter().fold(0, |value, part| {
            value | bits::placed(bits.read(part.span), part.place)
        })
    }

    /// Puts a number into a field.
    pub fn write(&self, field: &Field, bits: &mut BitString, value: u64) {
        for part in self.parts(field) {
            bits.write(part.span, bits::slice(value, part.place, part.span.len));
        }
    }
}

/// A run of bits and the row it belongs to.
type Run = (&'static Row, Span);

/// Lays a table out from bit `at`; returns where it ends.
fn lay_out(layout: &'static Layout, shape: &Shape, mut at: usize, runs: &mut Vec<Run>) -> usize {
    for piece in layout.pieces {
        match piece {
            Piece::Row(row) => {
                let width = (row.width)(shape) as usize;
                runs.push((row, Span::new(at, width)));
                at += width;
            }
            Piece::LittleEndian(rows) => at = little_endian(rows, shape, at, runs),
            Piece::Include(other) => at = lay_out(other, shape, at, runs),
        }
    }
    at
}

/// Lays `rows` out as one big-endian number from bit `start`, then reverses its bytes.
fn little_endian(rows: &'static [Row], shape: &Shape, start: usize, runs: &mut Vec<Run>) -> usize {
    let total: usize = rows.iter().map(|row| (row.width)(shape) as usize).sum();
    let bytes = total.div_ceil(8);
    let mut at = bytes * 8 - total;
    for row in rows {
        let end = at + (row.width)(shape) as usize;
        if at == end {
            runs.push((row, Span::new(start, 0)));
        }
        while at < end {
            let take = (8 - at % 8).min(end - at);
            let byte = bytes - 1 - at / 8;
            runs.push((row, Span::new(start + byte * 8 + at % 8, take)));
            at += take;
        }
    }
    start + bytes * 8
}

/// The bits that `check`, standing in the row `own`, covers.
fn cover(runs: &[Run], check: Check, own: &str) -> Span {
    let named = |name| runs.iter().filter(move |(row, _)| row.name == name);
    let start = named(check.first).map(|(_, span)| span.start).min();
    let end = match check.last {
        Some(last) => named(last).map(|(_, span)| span.end()).max(),
        None => named(own).map(|(_, span)| span.start).min(),
    };
    let (start, end) = (start.unwrap_or(0), end.unwrap_or(0));
    Span::new(start, end.saturating_sub(start))
}
