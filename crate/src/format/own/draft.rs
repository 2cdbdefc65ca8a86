//! How a user's layout is written: fields with kinds and widths, as text and as data.
//!
//! `RLS serial;poll:31;angle:24:le,crc:8:0x97:xor=0xff` reads: a title, how frames come, and the
//! fields in transmission order, each a kind and a width with what else is to be known of it.

mod text;

use crate::{
    language::msg,
    layout::{Active, Role},
    profile::{Choice, choice},
};
use alloc::{string::String, vec::Vec};

/// Most fields of a layout.
pub const MOST_FIELDS: usize = 40;
/// Most bits of a field that holds a number.
const WIDEST: u32 = 64;
/// Most bits of a CRC.
const WIDEST_CRC: u32 = 16;
/// Most bits of a field that only frames.
const WIDEST_FRAMING: u32 = 256;
/// Most letters of a title, a field's name or a status bit's name.
pub(crate) const LONGEST_NAME: usize = 60;

choice! {
    /// What a field of a user's layout is.
    Kind {
        /// Whole turns.
        Turns = "turns",
        /// Counts within one turn.
        Angle = "angle",
        /// The position is not valid.
        Error = "error",
        /// The position is valid, but near a limit.
        Warning = "warning",
        /// The position is valid: the opposite of an error.
        Valid = "valid",
        /// No zero has been set by the user.
        ZeroDefault = "zero-default",
        /// Up to eight named bits.
        Status = "status",
        /// Degrees Celsius × 10, two's complement.
        Temperature = "temperature",
        /// Revolutions per second × 10, two's complement.
        Speed = "speed",
        /// A count of frames or commands.
        Count = "count",
        /// Bits with one value in every good frame.
        Const = "const",
        /// Bits that are 0 in every good frame.
        Zeros = "zeros",
        /// Bits that say nothing.
        Skip = "skip",
        /// A CRC.
        Crc = "crc",
        /// One bit that makes the number of ones even.
        Even = "even",
        /// One bit that makes the number of ones odd.
        Odd = "odd",
    }
}

impl Kind {
    /// The role that fields of this kind have in a layout.
    #[must_use]
    pub const fn role(self) -> Role {
        match self {
            Self::Turns => Role::Turns,
            Self::Angle => Role::Angle,
            Self::Error => Role::Error,
            Self::Warning => Role::Warning,
            Self::Valid => Role::Valid,
            Self::ZeroDefault => Role::ZeroDefault,
            Self::Status => Role::Status,
            Self::Temperature => Role::Temperature,
            Self::Speed => Role::Speed,
            Self::Count => Role::Count,
            Self::Zeros => Role::Padding,
            Self::Const | Self::Skip => Role::Framing,
            Self::Crc => Role::Crc,
            Self::Even | Self::Odd => Role::Parity,
        }
    }

    /// What a field of this kind says, in a sentence.
    #[must_use]
    pub const fn doc(self) -> &'static str {
        match self {
            Self::Turns => msg("Whole turns."),
            Self::Angle => msg("Angle within one turn."),
            Self::Error => msg("Says that the position is not valid."),
            Self::Warning => msg("Says that something is near its limit; the position is valid."),
            Self::Valid => msg("Says that the position is valid."),
            Self::ZeroDefault => msg("Says that no zero has been set."),
            Self::Status => msg("Status bits."),
            Self::Temperature => msg("Temperature in tenths of a degree Celsius."),
            Self::Speed => msg("Speed in tenths of a revolution per second."),
            Self::Count => msg("A count."),
            Self::Const => msg("The same in every frame."),
            Self::Zeros => msg("Always 0."),
            Self::Skip => msg("Carries nothing that is read."),
            Self::Crc => msg("Checksum."),
            Self::Even => msg("Makes the number of ones even."),
            Self::Odd => msg("Makes the number of ones odd."),
        }
    }

    /// The widths it can have, in bits.
    #[must_use]
    pub const fn widths(self) -> (u32, u32) {
        match self {
            Self::Turns => (1, 32),
            Self::Angle | Self::Const => (1, WIDEST),
            Self::Error
            | Self::Warning
            | Self::Valid
            | Self::ZeroDefault
            | Self::Even
            | Self::Odd => (1, 1),
            Self::Status | Self::Count => (1, 8),
            Self::Temperature | Self::Speed => (2, 32),
            Self::Zeros | Self::Skip => (1, WIDEST_FRAMING),
            Self::Crc => (3, WIDEST_CRC),
        }
    }
}

/// How frames of a user's layout come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Framing {
    /// A master clocks out a word; a line of a dump is one.
    Line,
    /// The same behind the idle, acknowledge, start and cds bits of BiSS-C.
    Biss,
    /// The encoder sends them over a serial line unasked.
    Stream,
    /// The encoder answers to this byte.
    Poll(u8),
}

/// The parameters of a CRC, by the usual names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CrcRule {
    /// Polynomial without its highest term.
    pub polynomial: u64,
    /// What the register starts from.
    pub init: u64,
    /// Whether bytes are taken, and the register is sent, last bit first.
    pub reflected: bool,
    /// What the result is combined with by exclusive or.
    pub xorout: u64,
}

/// A field of a user's layout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Draft {
    /// What it is.
    pub kind: Kind,
    /// Number of bits.
    pub width: u32,
    /// Its own name; without one it is called by its kind. Fields of one name are parts of one
    /// number, the most significant first.
    pub name: Option<String>,
    /// Which level asserts a flag or a status bit.
    pub active: Active,
    /// Whether the number is sent with its last byte first, together with its neighbours of the
    /// same kind up to a whole number of bytes.
    pub little_endian: bool,
    /// Whether it is part of a Gray-coded word, together with its neighbours.
    pub gray: bool,
    /// The value of `const`.
    pub value: u64,
    /// How a CRC is computed.
    pub crc: CrcRule,
    /// Name of the first field that a check covers; the first of all without one.
    pub from: Option<String>,
    /// Name of the last field that a check covers; the one before it without one.
    pub to: Option<String>,
    /// Names of status bits, the most significant first; empty where a bit has none.
    pub bits: Vec<String>,
}

impl Draft {
    /// A field with nothing special about it.
    #[must_use]
    pub const fn new(kind: Kind, width: u32) -> Self {
        Self {
            kind,
            width,
            name: None,
            active: Active::High,
            little_endian: false,
            gray: false,
            value: 0,
            crc: CrcRule {
                polynomial: 0,
                init: 0,
                reflected: false,
                xorout: 0,
            },
            from: None,
            to: None,
            bits: Vec::new(),
        }
    }
}

/// A whole layout as it is written.
///
/// ```
/// use encoderscope::format::own::Written;
/// let text = "My encoder;line;angle:18,error:1:low,crc:6:0x03:xor=0x3f";
/// let written: Written = text.parse().unwrap();
/// assert_eq!((written.fields.len(), written.fields[0].width), (3, 18));
/// assert_eq!(written.to_string(), text);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// What the encoder is called.
    pub title: String,
    /// How frames come.
    pub framing: Framing,
    /// The fields in transmission order.
    pub fields: Vec<Draft>,
}
