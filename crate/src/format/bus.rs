//! BUS: the high-speed multi-drop bus of MPP and PT encoders (MPP "BUS", PT "BUS").
//!
//! 2 500 000 baud, 8N1, up to 32 devices on one pair of wires. The host sends one byte with
//! parity, operation and address; the reply echoes it, adds little-endian data, and ends with
//! the exclusive or of all bytes before.
//!
//! ```
//! use encoderscope::{decode::Decoder, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "bus")])?)?;
//! let reply = [0x1f, 0x00, 0x56, 0x34, 0x12, 0x05, 0x00, 0x6a];
//! let frame = decoder.frame(&reply).unwrap();
//! let values = frame.values();
//! assert!(frame.ok());
//! assert_eq!((values.address, values.turns, values.angle), (Some(31), Some(5), Some(0x12_3456)));
//! assert_eq!(decoder.encode(&values).into_bytes(), reply);
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```
//!
//! Where the manuals mislead: the example of 28 µs for 16M1 is right for a turn counter of eight
//! bits; models XXM count 16 bits and sleep 32 µs up to 16 bits per turn, 36 µs above. The sense
//! of the parity is likely, not certain: it is shown, and a frame is not refused for it.

use super::{Format, HEALTH, Limits, Manual, Link, Spec, angle_padding, said, turns_padding, spared};
use crate::{
    check::Checksum,
    language::msg,
    layout::{Check, Layout, Resolved, Shape, Weight, layout},
    profile::{Parity, Profile},
    reading::Values,
};

/// BUS.
pub const SPEC: Spec = Spec {
    name: "bus",
    title: "BUS",
    link: Link::Polled,
    parameters: &[
        "angle-bits",
        "turns-bits",
        "turns-code",
        "address",
        "parity",
        "baud",
    ],
    quantities: &["parity", "address", "operation", "count"],
    limits: Limits {
        angle: 24,
        turns: 16,
        together: 40,
        frame: (0, 0),
    },
    interval: None,
    default: Profile {
        parity: Parity::Odd,
        ..Profile::base(Format::Bus)
    },
};

/// What its manual says of it.
pub const MANUAL: Manual = Manual {
    about: said("the high-speed bus of MPP and PT encoders, up to 32 devices on one pair of wires"),
    source: said("MPP and PT, BUS"),
    timing: None,
    example: spared("1f 1f 00 56 34 12 05 00 6a\n1f 1f 00 01 a0 12 05 00 a9\n1f 1f 60 00 00 13 fe ff 6d\n"),
    guesses: &[],
    layouts: |_, shape| Operation::ALL.iter().map(|operation| Resolved::new(operation.reply(), shape)).collect(),
};

/// Addresses on a pair of wires (MPP "BUS").
pub const ADDRESSES: u8 = 32;

/// The longest that an encoder is silent while it stores, in microseconds (MPP "BUS", note 2).
pub const STORING: u64 = 50_000;

/// What a request asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// 00: position and status.
    Get,
    /// 01: set zero, ten times in turn with 00.
    SetZero,
    /// 10: set address, a sequence of ten addresses; every device on the bus hears it.
    SetAddress,
}

impl Operation {
    /// All operations, in the order of their codes; code 11 gets no answer.
    pub const ALL: &[Self] = &[Self::Get, Self::SetZero, Self::SetAddress];

    /// Its name, in kebab-case.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Get => "get",
            Self::SetZero => "set-zero",
            Self::SetAddress => "set-address",
        }
    }

    /// What it asks for, in a few words.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Get => msg("position and status"),
            Self::SetZero => msg("set zero"),
            Self::SetAddress => msg("set address"),
        }
    }

    /// The code in the request.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::Get => 0b00,
            Self::SetZero => 0b01,
            Self::SetAddress => 0b10,
        }
    }

    /// The operation of a code.
    #[must_use]
    pub fn of_code(code: u8) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|operation| operation.code() == code)
    }

    /// Whether the encoder may hold something else afterwards.
    #[must_use]
    pub const fn changes_encoder(self) -> bool {
        !matches!(self, Self::Get)
    }

    /// The layout of the reply.
    #[must_use]
    pub const fn reply(self) -> &'static Layout {
        match self {
            Self::Get => &GET,
            Self::SetZero | Self::SetAddress => &COUNT,
        }
    }
}

/// The request byte for an operation and an address.
///
/// ```
/// use encoderscope::{format::{Format, bus::{Operation, request}}};
/// let profile = Format::Bus.default_profile();
/// assert_eq!(request(&profile, Operation::Get, 0x1f), 0x1f);
/// assert_eq!(request(&profile, Operation::SetZero, 0x1f), 0xbf);
/// ```
#[must_use]
pub fn request(profile: &Profile, operation: Operation, address: u8) -> u8 {
    let values = Values {
        operation: Some(operation.code()),
        address: Some(address),
        ..Values::default()
    };
    let head = Resolved::new(&HEAD, Shape::of(*profile)).encode(&values);
    head.into_bytes().first().copied().unwrap_or(0)
}

/// How long a device that hears another's address is deaf, in microseconds
/// (MPP "BUS", T_SUSPEND), so that it does not take the reply for requests.
///
/// ```
/// use encoderscope::{format::{Format, bus}, profile::Profile};
/// let model = |angle_bits, turns_bits| Profile { angle_bits, turns_bits, ..Format::Bus.default_profile() };
/// assert_eq!(bus::suspend(&model(16, 8)), 28);
/// assert_eq!(bus::suspend(&model(16, 16)), 32);
/// assert_eq!(bus::suspend(&model(24, 16)), 36);
/// ```
#[must_use]
pub const fn suspend(profile: &Profile) -> u64 {
    let bytes = profile.angle_bits.div_ceil(8) + profile.turns_bits / 8 + 4;
    // Ten bits a byte.
    bytes as u64 * 10_000_000 / profile.baud as u64
}

layout! {
    /// The request byte, echoed in the reply.
    pub static HEAD(p) {
        /// Makes the number of ones in the byte odd; shown, never required.
        parity: Parity[u32::from(p.parity == Parity::Odd)],
            check = Check::rows(Checksum::OddParity, "operation", "address"), weight = Weight::Advisory;
        /// Makes the number of ones in the byte even; shown, never required.
        parity: Parity[u32::from(p.parity == Parity::Even)],
            check = Check::rows(Checksum::EvenParity, "operation", "address"), weight = Weight::Advisory;
        /// Parity of a sense that is not known.
        unknown: Framing[u32::from(p.parity == Parity::None)];
        /// What the host asked for: 00 get, 01 set zero, 10 set address.
        operation: Operation[2];
        /// Address of the device, 0x1F from the factory.
        address: Address[5];
    }
}

layout! {
    /// The exclusive or of all bytes before it.
    pub static CRC(p) {
        /// Exclusive or of all bytes before it.
        crc: Crc[8], check = Check::from(Checksum::Crc8Xor, "parity");
    }
}

layout! {
    /// Reply to *get*: status, angle, and turns where the model counts them.
    pub static GET(p) {
        include HEAD;
        include HEALTH;
        le {
            /// The bits above the angle are 0: the angle is right-aligned in two or three bytes.
            angle_padding: Padding[angle_padding(p)];
            /// Angle within one turn.
            angle: Angle[p.angle_bits];
        }
        le {
            /// The bits above the turn counter are 0.
            turns_padding: Padding[turns_padding(p)];
            /// Whole turns; only models XXM send them.
            turns: Turns[p.turns_bits];
        }
        include CRC;
    }
}

layout! {
    /// Reply to *set zero* and *set address*.
    pub static COUNT(p) {
        include HEAD;
        include HEALTH;
        /// How many commands of the sequence the encoder has counted; at 10 it acts.
        count: Count[8];
        include CRC;
    }
}
