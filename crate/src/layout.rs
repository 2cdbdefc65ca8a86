//! `layout!`: one table a frame, the single source of where every field stands.
//!
//! A row holds a field's doc, name, role, width and, where it has them, its polarity, its named
//! bits, its fixed value or its checksum. Rows stand in transmission order and offsets are
//! their sums, so a gap or an overlap cannot be written. Widths are computed from the profile.
//! Rows of one name are parts of one field, most significant first; rows inside `le { … }`
//! form one number that is sent as little-endian bytes; rows inside `gray(when) { … }` form one
//! word that is Gray-coded where the profile says so; rows inside `decimal { … }` are digits of
//! ASCII text; `include TABLE;` stands for the rows of another table.
//!
//! Decoder, encoder, explainer and checks all read a [`Resolved`] layout: a table whose widths
//! have been worked out once, so that the frame loop only shifts.

mod fast;
mod resolved;

pub(crate) use fast::Glimpse;
pub use resolved::{Coding, Covered, Field, Part, Resolved, Shape};

use crate::{bits, check::Checksum, language::meaning};
use alloc::{string::String, vec::Vec};

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
    /// What the encoder is (T485), or a module of a board.
    Enid,
    /// Revolutions per second × 10, 16-bit two's complement.
    Speed,
    /// Degrees Celsius × 10, 16-bit two's complement.
    Temperature,
    /// How many commands of a sequence the encoder has counted.
    Count,
    /// Address of a device on a bus.
    Address,
    /// Position data is valid: the opposite of an error flag.
    Valid,
    /// No zero has been set by the user.
    ZeroDefault,
    /// The same word once more (multi-transmission).
    Repeat,
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
            Self::Framing | Self::Padding | Self::Operation | Self::Address | Self::Enid => {
                Class::Framing
            }
            Self::Turns => Class::Turns,
            Self::Angle => Class::Angle,
            Self::Error | Self::Warning | Self::Valid | Self::ZeroDefault | Self::Count => {
                Class::Flags
            }
            Self::Status
            | Self::Alarm
            | Self::Speed
            | Self::Temperature
            | Self::MemoryAddress
            | Self::MemoryData => Class::Status,
            Self::Crc | Self::Parity | Self::Repeat => Class::Check,
        }
    }
}

impl Role {
    /// The name of what a field with this role says, in snake case; those that only frame or check
    /// the others say nothing.
    ///
    /// ```
    /// use encoderscope::layout::Role;
    /// assert_eq!(Role::ZeroDefault.quantity(), Some("zero_default"));
    /// assert_eq!(Role::Crc.quantity(), None);
    /// ```
    #[must_use]
    pub const fn quantity(self) -> Option<&'static str> {
        Some(match self {
            Self::Operation => "operation",
            Self::Turns => "turns",
            Self::Angle => "angle",
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Status => "status",
            Self::Alarm => "alarm",
            Self::Enid => "enid",
            Self::Speed => "speed",
            Self::Temperature => "temperature",
            Self::Count => "count",
            Self::Address => "address",
            Self::Valid => "valid",
            Self::ZeroDefault => "zero_default",
            Self::MemoryAddress => "memory_address",
            Self::MemoryData => "memory_data",
            Self::Framing | Self::Padding | Self::Repeat | Self::Crc | Self::Parity => return None,
        })
    }
}

/// Which level asserts a flag.
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

impl StatusBit {
    /// The bit of a name in its place; 0 where the table has no such bit.
    #[must_use]
    pub fn named(table: &[Self], name: &str) -> u64 {
        let found = table.iter().find(|bit| bit.name == name);
        found.map_or(0, |bit| bits::placed(1, bit.place))
    }
}

/// Which bits a checksum covers.
#[derive(Clone, Copy, Debug)]
pub enum Cover {
    /// Everything from the row of this name up to the check field.
    From(&'static str),
    /// From the first bit of one row to the last bit of another.
    Rows(&'static str, &'static str),
    /// The whole frame, its own bits taken as 0.
    Frame,
}

/// A checksum and the bits it covers.
#[derive(Clone, Copy, Debug)]
pub struct Check {
    /// How it is computed.
    pub sum: Checksum,
    /// What it covers.
    pub cover: Cover,
}

impl Check {
    /// Everything from the row `first` up to the check field.
    #[must_use]
    pub const fn from(sum: Checksum, first: &'static str) -> Option<Self> {
        let cover = Cover::From(first);
        Some(Self { sum, cover })
    }

    /// The rows from `first` to `last`.
    #[must_use]
    pub const fn rows(sum: Checksum, first: &'static str, last: &'static str) -> Option<Self> {
        let cover = Cover::Rows(first, last);
        Some(Self { sum, cover })
    }

    /// The whole frame, with the bits of the check itself taken as 0.
    #[must_use]
    pub const fn frame(sum: Checksum) -> Option<Self> {
        let cover = Cover::Frame;
        Some(Self { sum, cover })
    }
}

/// What follows from a check that does not hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weight {
    /// The frame is bad.
    Binding,
    /// It is shown, and the frame stays good: the manual leaves the rule open.
    Advisory,
}

/// Number of bits of a row.
#[derive(Clone, Copy, Debug)]
pub enum Width {
    /// What the shape of the frame makes it.
    Of(fn(&Shape) -> u32),
    /// Always the same.
    Bits(u32),
}

impl Width {
    /// The number for a shape.
    #[must_use]
    pub fn of(self, shape: &Shape) -> usize {
        match self {
            Self::Of(width) => width(shape) as usize,
            Self::Bits(width) => width as usize,
        }
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
    /// Number of bits.
    pub width: Width,
    /// Which level asserts a flag.
    pub active: Active,
    /// What framing bits without a fixed value are when nobody says otherwise.
    pub rest: fn(&Shape) -> u64,
    /// Names of the single bits.
    pub bits: &'static [StatusBit],
    /// The value it always has.
    pub constant: Option<u64>,
    /// Bits of its number that are always 0.
    pub zeros: u64,
    /// How it is computed, for a check field.
    pub check: Option<Check>,
    /// What follows when it does not hold, for a check field.
    pub weight: Weight,
}

impl Row {
    /// A row with no more than a name, a role, a doc and a width.
    #[must_use]
    pub const fn new(
        name: &'static str,
        role: Role,
        doc: &'static [&'static str],
        width: Width,
    ) -> Self {
        Self {
            name,
            role,
            doc,
            width,
            active: Active::High,
            rest: |_| 0,
            bits: &[],
            constant: match role {
                Role::Padding => Some(0),
                _ => None,
            },
            zeros: 0,
            check: None,
            weight: Weight::Binding,
        }
    }

    /// The doc in one line, in English.
    #[must_use]
    pub fn english(&self) -> String {
        joined(self.doc)
    }
}

/// The lines of a doc as one.
fn joined(doc: &[&str]) -> String {
    let lines: Vec<&str> = doc.iter().map(|line| line.trim()).collect();
    lines.join(" ")
}

/// A piece of a table: one row, or rows that form one little-endian number.
#[derive(Clone, Copy, Debug)]
pub enum Piece {
    /// One row, most significant bit first.
    Row(Row),
    /// Rows that form one number, written most significant first and sent last byte first.
    LittleEndian(&'static [Row]),
    /// Rows that form one word, Gray-coded where the function says so.
    Gray(fn(&Shape) -> bool, &'static [Row]),
    /// Rows that are ASCII digits of a decimal number; their widths count the digits' bits.
    Decimal(&'static [Row]),
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

impl Layout {
    /// What the frame is, in a line.
    #[must_use]
    pub fn title(&self) -> String {
        let line = joined(self.doc);
        meaning(line.trim_end_matches('.').replace(['`', '*'], ""))
    }
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
    (@pieces $p:ident ($($done:tt)*) gray($when:expr) { $($rows:tt)* } $($rest:tt)*) => {
        layout!(@pieces $p ($($done)* $crate::layout::Piece::Gray(
            |$p: &$crate::layout::Shape| $when, layout!(@rows $p () $($rows)*)),) $($rest)*)
    };
    (@pieces $p:ident ($($done:tt)*) decimal { $($rows:tt)* } $($rest:tt)*) => {
        layout!(@pieces $p ($($done)*
            $crate::layout::Piece::Decimal(layout!(@rows $p () $($rows)*)),) $($rest)*)
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
                $crate::layout::Width::Of(|$p: &$crate::layout::Shape| { let _ = $p; $width }),
            )
        }
    };
}
pub(crate) use layout;
