//! RS485 and RS422: one-byte commands of MPP and PT encoders (MPP "RS485/RS422", PT
//! "RS485/RS422 protocol interface").
//!
//! 8N1, 2 500 000 baud (code B) or 115 200 (code A). A reply is big-endian data and CRC-8, **without
//! any echo of the command**: it does not say what it is, so a decoder must be told the
//! command and the widths.
//!
//! ```
//! use encoderscope::{decode::Decoder, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "rs485"), ("command", "t")])?)?;
//! let reply = [0x00, 0x01, 0x00, 0x00, 0x01, 0xff, 0x9c, 0x6c];
//! let frame = decoder.frame(&reply).unwrap();
//! let values = frame.values();
//! assert_eq!((values.turns, values.angle, values.temperature), (Some(1), Some(1), Some(-100)));
//! assert_eq!(frame.layout.encode(&values).into_bytes(), reply);
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```
//!
//! Where the manuals mislead: PT's example sends 0x32 and reads seven bytes; 0x64 gives seven
//! (single turn: five), 0x31 six. PT's commands 0x21, 0731 and 0704 are 0x31, 0x64 and 0x74.
//! PT's CRC table is damaged; the polynomial is right.

use super::{Format, HEALTH, Limits, Manual, Link, Spec, angle_padding, said, turns_padding, one, spared};
use crate::{
    check::Checksum,
    language::msg,
    layout::{Check, Layout, layout},
    profile::Profile,
};

/// RS485.
pub const SPEC: Spec = Spec {
    name: "rs485",
    title: "RS485",
    link: Link::Polled,
    parameters: &["angle-bits", "turns-bits", "turns-code", "command", "baud"],
    quantities: &["temperature", "speed", "count"],
    limits: Limits {
        angle: 24,
        turns: 16,
        together: 40,
        frame: (0, 0),
    },
    interval: None,
    default: Profile::base(Format::Rs485),
};

/// What its manual says of it.
pub const MANUAL: Manual = Manual {
    about: said(
        "one-byte commands of MPP and PT encoders over RS485 and RS422, whose replies do not say what they answer",
    ),
    source: said("MPP and PT, RS485/RS422"),
    timing: None,
    example: spared("00 05 12 34 56 00 02\n00 05 12 a0 01 00 31\nff fe 13 00 00 60 8d\n"),
    guesses: &[],
    layouts: |profile, shape| one(profile.command.reply(), shape),
};

/// How long an encoder is silent while it stores a zero, in microseconds (MPP "RS485", note 3).
pub const STORING: u64 = 40_000;

/// A command of the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// 0x30 `0`: set zero, ten times in turn with `1`.
    Zero,
    /// 0x31 `1`: position.
    Position,
    /// 0x64 `d`: position and status.
    Status,
    /// 0x73 `s`: position and speed.
    Speed,
    /// 0x74 `t`: position and chip temperature.
    Temperature,
}

impl Command {
    /// All commands.
    pub const ALL: &[Self] = &[
        Self::Zero,
        Self::Position,
        Self::Status,
        Self::Speed,
        Self::Temperature,
    ];

    /// The letter that is sent.
    #[must_use]
    pub const fn letter(self) -> char {
        self.byte() as char
    }

    /// What it asks for, in a few words.
    ///
    /// ```
    /// assert_eq!(encoderscope::format::rs485::Command::Status.title(), "position and status");
    /// ```
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Zero => msg("set zero"),
            Self::Position => msg("position"),
            Self::Status => msg("position and status"),
            Self::Speed => msg("position and speed"),
            Self::Temperature => msg("position and temperature"),
        }
    }

    /// The byte on the wire.
    #[must_use]
    pub const fn byte(self) -> u8 {
        match self {
            Self::Zero => b'0',
            Self::Position => b'1',
            Self::Status => b'd',
            Self::Speed => b's',
            Self::Temperature => b't',
        }
    }

    /// The command of a byte.
    #[must_use]
    pub fn of_byte(byte: u8) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|command| command.byte() == byte)
    }

    /// The command of a letter.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        match text.as_bytes() {
            [byte] => Self::of_byte(*byte),
            _ => None,
        }
    }

    /// Whether the encoder may hold something else afterwards.
    #[must_use]
    pub const fn changes_encoder(self) -> bool {
        matches!(self, Self::Zero)
    }

    /// The layout of the reply.
    #[must_use]
    pub fn reply(self) -> &'static Layout {
        match self {
            Self::Zero => &ZERO,
            Self::Position => &POSITION,
            Self::Status => &STATUS_REPLY,
            Self::Speed => &SPEED,
            Self::Temperature => &TEMPERATURE,
        }
    }
}

layout! {
    /// Turns, where the model counts them, and angle.
    pub static DATA(p) {
        /// The bits above the turn counter are 0.
        turns_padding: Padding[turns_padding(p)];
        /// Whole turns; only models M, BM and FM send them.
        turns: Turns[p.turns_bits];
        /// The bits above the angle are 0: the angle is right-aligned in two or three bytes.
        angle_padding: Padding[angle_padding(p)];
        /// Angle within one turn.
        angle: Angle[p.angle_bits];
    }
}

layout! {
    /// Position reply: to 0x31 `1`.
    pub static POSITION(p) {
        include DATA;
        /// CRC over all bytes before it.
        crc: Crc[8], check = Check::from(Checksum::Crc8x97, "turns_padding");
    }
}

layout! {
    /// Position and status reply: to 0x64 `d`.
    pub static STATUS_REPLY(p) {
        include DATA;
        include HEALTH;
        /// CRC over all bytes before it.
        crc: Crc[8], check = Check::from(Checksum::Crc8x97, "turns_padding");
    }
}

layout! {
    /// Position and speed reply: to 0x73 `s`.
    pub static SPEED(p) {
        include DATA;
        /// Revolutions per second × 10, signed.
        speed: Speed[16];
        /// CRC over all bytes before it.
        crc: Crc[8], check = Check::from(Checksum::Crc8x97, "turns_padding");
    }
}

layout! {
    /// Position and temperature reply: to 0x74 `t`.
    pub static TEMPERATURE(p) {
        include DATA;
        /// Temperature of the chip, degrees Celsius × 10, signed.
        temperature: Temperature[16];
        /// CRC over all bytes before it.
        crc: Crc[8], check = Check::from(Checksum::Crc8x97, "turns_padding");
    }
}

layout! {
    /// Reply to the set-zero command 0x30 `0`.
    pub static ZERO(p) {
        /// How many pairs of commands the encoder has counted; at 10 it stores the zero.
        count: Count[8];
        /// CRC over the count.
        crc: Crc[8], check = Check::from(Checksum::Crc8x97, "count");
    }
}
