//! The wire formats, one manual page a file.

pub mod biss_c;
pub mod rs485;
pub mod t485;

use crate::{
    layout::StatusBit,
    profile::{Justify, Profile},
};
use alloc::{string::String, vec::Vec};

/// A wire format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// BiSS-C: [`biss_c`].
    BissC,
    /// MPP and PT commands over RS485 and RS422: [`rs485`].
    Rs485,
    /// Tamagawa-compatible T485: [`t485`].
    T485,
}

/// What a dump of a format consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Medium {
    /// A line is a frame, made of bits.
    Bits,
    /// The whole input is one stream of bytes.
    Bytes,
}

/// How wide the numbers of a format can be, in bits.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Angle.
    pub angle: u32,
    /// Turn counter.
    pub turns: u32,
    /// Both together.
    pub together: u32,
}

impl Format {
    /// All formats, in the order of their names.
    pub const ALL: &[Self] = &[Self::BissC, Self::Rs485, Self::T485];

    /// The name in parameters and links.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::BissC => "biss-c",
            Self::Rs485 => "rs485",
            Self::T485 => "t485",
        }
    }

    /// The name for people.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::BissC => "BiSS-C",
            Self::Rs485 => "RS485",
            Self::T485 => "T485",
        }
    }

    /// The format of a name.
    #[must_use]
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|format| format.name().eq_ignore_ascii_case(name))
    }

    /// All names, with spaces between.
    #[must_use]
    pub fn names() -> String {
        Self::ALL
            .iter()
            .map(|format| format.name())
            .collect::<Vec<_>>()
            .join(" ")
    }

    /// What a dump consists of.
    #[must_use]
    pub const fn medium(self) -> Medium {
        match self {
            Self::BissC => Medium::Bits,
            Self::Rs485 | Self::T485 => Medium::Bytes,
        }
    }

    /// Whether a host asks and the encoder answers, over a serial port.
    #[must_use]
    pub const fn is_polled(self) -> bool {
        match self {
            Self::BissC => false,
            Self::Rs485 | Self::T485 => true,
        }
    }

    /// The names of the parameters that matter to this format.
    #[must_use]
    pub const fn parameters(self) -> &'static [&'static str] {
        match self {
            Self::BissC => &[
                "angle-bits",
                "turns-bits",
                "status-bits",
                "ack-bits",
                "justify",
            ],
            Self::Rs485 => &["angle-bits", "turns-bits", "command", "baud"],
            Self::T485 => &["angle-bits", "turns-bits", "baud"],
        }
    }

    /// How wide the numbers can be.
    #[must_use]
    pub const fn limits(self) -> Limits {
        match self {
            Self::BissC => Limits {
                angle: 64,
                turns: 32,
                together: 64,
            },
            Self::Rs485 => Limits {
                angle: 24,
                turns: 16,
                together: 40,
            },
            Self::T485 => Limits {
                angle: 24,
                turns: 24,
                together: 48,
            },
        }
    }

    /// The profile that omitted parameters are taken from: the widest encoder of the MPP and
    /// PT families that speaks the format.
    #[must_use]
    pub const fn default_profile(self) -> Profile {
        Profile {
            format: self,
            angle_bits: match self {
                Self::BissC | Self::Rs485 => 24,
                Self::T485 => 23,
            },
            turns_bits: 16,
            status_bits: 6,
            ack_bits: 5,
            command: rs485::Command::Status,
            baud: 2_500_000,
            justify: Justify::Left,
        }
    }
}

/// The six status bits that SSI, BiSS-C, RS485, RS422, BUS and PERIOD share
/// (MPP and PT, "Status bits").
pub static STATUS: &[StatusBit] = &[
    StatusBit {
        place: 5,
        name: "battery disconnected",
        doc: "the turn counter was lost and restarted from 0; check the battery, then power-cycle",
        role: None,
    },
    StatusBit {
        place: 4,
        name: "battery low",
        doc: "below 2.9 V the turns are still good, below 2.7 V not; replace the battery",
        role: None,
    },
    StatusBit {
        place: 3,
        name: "field too strong",
        doc: "the rotor is too close to the stator or a magnet is near; check the mounting gap",
        role: None,
    },
    StatusBit {
        place: 2,
        name: "field too weak",
        doc: "the rotor is too far from the stator; check the mounting gap",
        role: None,
    },
    StatusBit {
        place: 1,
        name: "temperature out of range",
        doc: "the encoder is hotter or colder than its order code allows",
        role: None,
    },
    StatusBit {
        place: 0,
        name: "overspeed",
        doc: "the shaft turns faster than the encoder can follow; slow down",
        role: None,
    },
];
