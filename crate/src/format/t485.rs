//! T485: the Tamagawa-compatible protocol of MPP and PT encoders (MPP "T485", PT "T485
//! protocol interface").
//!
//! 2 500 000 baud, 8N1. The host sends one control byte; the reply echoes it, adds a status
//! field and little-endian data, and ends with the exclusive or of all bytes before. Reading
//! requests never change the encoder; [`Request::changes_encoder`] names those that do.
//!
//! ```
//! use encoderscope::{decode::Decoder, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "t485")])?)?;
//! let reply = [0x1a, 0x20, 0x29, 0xc0, 0x3b, 0x17, 0x00, 0x00, 0x00, 0xc8, 0x37];
//! let frame = decoder.frame(&reply).unwrap();
//! let values = frame.values();
//! assert_eq!((values.angle, values.turns, values.error), (Some(3_915_817), Some(0), Some(true)));
//! let again = frame.layout.encode(&values);
//! assert_eq!(again.into_bytes(), reply);
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```
//!
//! Where the manuals mislead: the data is right-aligned, not left-aligned (note 1); the CRC is
//! x⁸+1, not x+1 (note 2); the "17" of byte 5 is the ENID, 0x17 or 0x11, and is never required.

use super::{Format, Limits, Manual, Link, Spec, said, spared};
use crate::{
    bits::{self, Bits},
    check::Checksum,
    language::msg,
    layout::{Check, Layout, Resolved, Role, Shape, StatusBit, layout},
    profile::{Dialect, Profile},
};

/// T485.
pub const SPEC: Spec = Spec {
    name: "t485",
    title: "T485",
    link: Link::Polled,
    parameters: &["angle-bits", "turns-bits", "turns-code", "dialect", "baud"],
    quantities: &["parity", "operation", "enid", "alarm"],
    limits: Limits {
        angle: 24,
        turns: 24,
        together: 48,
        frame: (0, 0),
    },
    interval: None,
    default: Profile {
        angle_bits: 23,
        ..Profile::base(Format::T485)
    },
};

/// What its manual says of it.
pub const MANUAL: Manual = Manual {
    about: said("the Tamagawa-compatible protocol of MPP and PT encoders"),
    source: said("MPP and PT, T485"),
    timing: None,
    example: spared("1a 20 29 c0 3b 17 00 00 00 c8 37\n1a 20 83 c1 52 17 00 00 00 c8 f5\n1a 20 bf e1 7d 17 00 00 00 c8 c6\n"),
    guesses: &[],
    layouts: |_, shape| Request::ALL.iter().map(|request| Resolved::new(request.reply(), shape)).collect(),
};

/// Bytes of Tamagawa's EEPROM.
pub const MEMORY_SIZE: u8 = 128;

/// A request of the host, named by its effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// 0x02: angle.
    Angle,
    /// 0x8A: turns.
    Turns,
    /// 0x92: encoder identity (Tamagawa only).
    Identity,
    /// 0x1A: angle, identity, turns and alarm.
    All,
    /// 0x32: EEPROM write (Tamagawa only).
    MemoryWrite,
    /// 0xBA, ten times: reset errors (Tamagawa only).
    ResetErrors,
    /// 0xC2, ten times: the present angle becomes 0.
    ResetAngle,
    /// 0x62, ten times: turns become 0.
    ResetTurns,
    /// 0xEA: EEPROM read (Tamagawa only).
    MemoryRead,
}

impl Request {
    /// All requests.
    pub const ALL: &[Self] = &[
        Self::Angle,
        Self::Turns,
        Self::Identity,
        Self::All,
        Self::MemoryWrite,
        Self::ResetErrors,
        Self::ResetAngle,
        Self::ResetTurns,
        Self::MemoryRead,
    ];

    /// Its name, in kebab-case.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Angle => "angle",
            Self::Turns => "turns",
            Self::Identity => "identity",
            Self::All => "all",
            Self::MemoryWrite => "memory-write",
            Self::ResetErrors => "reset-errors",
            Self::ResetAngle => "reset-angle",
            Self::ResetTurns => "reset-turns",
            Self::MemoryRead => "memory-read",
        }
    }

    /// What it asks for, in a few words.
    ///
    /// ```
    /// assert_eq!(encoderscope::format::t485::Request::ResetTurns.title(), "reset turns");
    /// ```
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Angle => msg("angle"),
            Self::Turns => msg("turns"),
            Self::Identity => msg("encoder identity"),
            Self::All => msg("angle, identity, turns and alarms"),
            Self::MemoryWrite => msg("write a byte of the EEPROM"),
            Self::ResetErrors => msg("reset errors"),
            Self::ResetAngle => msg("reset angle"),
            Self::ResetTurns => msg("reset turns"),
            Self::MemoryRead => msg("read a byte of the EEPROM"),
        }
    }

    /// The control byte on the wire.
    #[must_use]
    pub const fn byte(self) -> u8 {
        match self {
            Self::Angle => 0x02,
            Self::Turns => 0x8a,
            Self::Identity => 0x92,
            Self::All => 0x1a,
            Self::MemoryWrite => 0x32,
            Self::ResetErrors => 0xba,
            Self::ResetAngle => 0xc2,
            Self::ResetTurns => 0x62,
            Self::MemoryRead => 0xea,
        }
    }

    /// The request of a control byte.
    #[must_use]
    pub fn of_byte(byte: u8) -> Option<Self> {
        Self::ALL
            .iter()
            .copied()
            .find(|request| request.byte() == byte)
    }

    /// The request of an operation, the four bits of the control byte that name it.
    #[must_use]
    pub fn of_operation(operation: u8) -> Option<Self> {
        let named = |request: &Self| bits::slice(request.byte().into(), 3, 4);
        let mut all = Self::ALL.iter().copied();
        all.find(|request| named(request) == u64::from(operation))
    }

    /// Whether the encoder may hold something else afterwards.
    #[must_use]
    pub const fn changes_encoder(self) -> bool {
        match self {
            Self::Angle | Self::Turns | Self::Identity | Self::All | Self::MemoryRead => false,
            Self::MemoryWrite | Self::ResetErrors | Self::ResetAngle | Self::ResetTurns => true,
        }
    }

    /// Whether encoders of a dialect know it; others answer with a communication error.
    #[must_use]
    pub const fn is_known_to(self, dialect: Dialect) -> bool {
        match self {
            Self::Angle | Self::Turns | Self::All | Self::ResetAngle | Self::ResetTurns => true,
            Self::Identity | Self::MemoryWrite | Self::ResetErrors | Self::MemoryRead => {
                matches!(dialect, Dialect::Tamagawa)
            }
        }
    }

    /// The layout of the request itself.
    #[must_use]
    pub fn request(self) -> &'static Layout {
        match self {
            Self::MemoryRead => &MEMORY_READ,
            Self::MemoryWrite => &MEMORY,
            _ => &HEAD,
        }
    }

    /// The layout of the reply.
    #[must_use]
    pub fn reply(self) -> &'static Layout {
        match self {
            Self::Angle | Self::ResetErrors | Self::ResetAngle | Self::ResetTurns => &ANGLE,
            Self::Turns => &TURNS,
            Self::Identity => &IDENTITY,
            Self::All => &ALL,
            Self::MemoryWrite | Self::MemoryRead => &MEMORY,
        }
    }
}

/// Whether a byte can be a control field: its fixed bits and its parity hold.
#[must_use]
pub fn is_control(byte: u8) -> bool {
    let head = Resolved::new(&HEAD, Shape::of(SPEC.default));
    head.holds(Bits::of_bytes(&[byte]))
}

/// The status field (Tamagawa SF).
pub static STATUS_FIELD: &[StatusBit] = &[
    StatusBit {
        place: 7,
        name: msg("delimiter error"),
        doc: msg("the request had no valid stop bit (Tamagawa); check baud, termination and A/B"),
        role: None,
    },
    StatusBit {
        place: 6,
        name: msg("communication error"),
        doc: msg("the encoder did not understand the request: parity or operation unknown"),
        role: None,
    },
    StatusBit {
        place: 5,
        name: msg("encoder error"),
        doc: msg("the position is not valid; the alarm byte of the 'all' reply says why"),
        role: Some(Role::Error),
    },
    StatusBit {
        place: 4,
        name: msg("counting error"),
        doc: msg("the position was miscounted (Tamagawa); power-cycle at standstill"),
        role: None,
    },
];

/// The bit of the status field that says that a request was not understood.
#[must_use]
pub fn not_understood() -> u64 {
    StatusBit::named(STATUS_FIELD, "communication error")
}

/// The alarm byte of MPP and PT (manual: E).
pub static ALARM: &[StatusBit] = &[
    StatusBit {
        place: 7,
        name: msg("battery disconnected"),
        doc: msg(
            "the turn counter was lost and restarted from 0; check the battery, then power-cycle",
        ),
        role: None,
    },
    StatusBit {
        place: 6,
        name: msg("battery low"),
        doc: msg("below 2.9 V the turns are still good, below 2.7 V not; replace the battery"),
        role: None,
    },
];

/// The alarm byte of Tamagawa's own encoders (ALMC); its battery bits mean the opposite of those
/// of MPP and PT.
pub static TAMAGAWA_ALARM: &[StatusBit] = &[
    StatusBit {
        place: 7,
        name: msg("battery alarm"),
        doc: msg("the battery is low, the turns are still good; replace it"),
        role: None,
    },
    StatusBit {
        place: 6,
        name: msg("battery error"),
        doc: msg("the battery was lost and the turns with it; replace it, then reset"),
        role: None,
    },
    StatusBit {
        place: 5,
        name: msg("multi-turn error"),
        doc: msg("the turn counter is wrong; reset it at a known position"),
        role: None,
    },
    StatusBit {
        place: 4,
        name: msg("overheat"),
        doc: msg("the encoder is too hot"),
        role: None,
    },
    StatusBit {
        place: 3,
        name: msg("counter overflow"),
        doc: msg("the turn counter has run over"),
        role: None,
    },
    StatusBit {
        place: 2,
        name: msg("counting error"),
        doc: msg("the position was miscounted; power-cycle at standstill"),
        role: None,
    },
    StatusBit {
        place: 1,
        name: msg("full absolute status"),
        doc: msg(
            "the shaft turned too fast at power-on; the resolution is reduced until it slows down",
        ),
        role: None,
    },
    StatusBit {
        place: 0,
        name: msg("overspeed"),
        doc: msg("the shaft turned too fast while on battery; reset the turns"),
        role: None,
    },
];

layout! {
    /// The control byte, echoed from the request, and the status field.
    pub static HEAD(p) {
        /// Makes the number of ones in the operation even.
        control_parity: Parity[1], check = Check::rows(Checksum::EvenParity, "operation", "operation");
        /// What the host asked for (Tamagawa data ID).
        operation: Operation[4];
        /// Fixed pattern 010 of every control byte.
        sink: Framing[3], constant = Some(0b010);
    }
}

layout! {
    /// The status field (Tamagawa SF).
    pub static SF(p) {
        /// Errors of the link and of the encoder; the low four bits are 0.
        status: Status[8], bits = STATUS_FIELD, zeros = 0x0f;
    }
}

layout! {
    /// A0 A1 A2.
    pub static ANGLE_DATA(p) {
        le {
            /// The bits of A2 above the angle are 0: the angle is right-aligned.
            angle_padding: Padding[24u32.saturating_sub(p.angle_bits)];
            /// Angle within one turn.
            angle: Angle[p.angle_bits];
        }
    }
}

layout! {
    /// M0 M1 M2.
    pub static TURNS_DATA(p) {
        le {
            /// The bits above the turn counter are 0.
            turns_padding: Padding[24u32.saturating_sub(p.turns_bits)];
            /// Whole turns since the counter was reset.
            turns: Turns[p.turns_bits];
        }
    }
}

layout! {
    /// The exclusive or of all bytes before it.
    pub static CRC(p) {
        /// Exclusive or of all bytes before it.
        crc: Crc[8], check = Check::from(Checksum::Crc8Xor, "control_parity");
    }
}

layout! {
    /// Angle reply, six bytes: to 0x02, and to the resets 0xC2, 0x62 and 0xBA.
    pub static ANGLE(p) {
        include HEAD;
        include SF;
        include ANGLE_DATA;
        include CRC;
    }
}

layout! {
    /// Turns reply, six bytes: to 0x8A.
    pub static TURNS(p) {
        include HEAD;
        include SF;
        include TURNS_DATA;
        include CRC;
    }
}

layout! {
    /// Identity reply, four bytes: to 0x92 (Tamagawa only).
    pub static IDENTITY(p) {
        include HEAD;
        include SF;
        include ENID;
        include CRC;
    }
}

layout! {
    /// Encoder identity.
    pub static ENID(p) {
        /// Encoder identity: bits per turn, 0x17 for 23 and 0x11 for 17; shown, never required.
        enid: Enid[8];
    }
}

layout! {
    /// Reply with all data, eleven bytes: to 0x1A.
    pub static ALL(p) {
        include HEAD;
        include SF;
        include ANGLE_DATA;
        include ENID;
        include TURNS_DATA;
        /// Battery alarms (manual: E).
        alarm: Alarm[if p.dialect == Dialect::Mpp { 8 } else { 0 }], bits = ALARM;
        /// Alarms (Tamagawa: ALMC).
        alarm: Alarm[if p.dialect == Dialect::Tamagawa { 8 } else { 0 }], bits = TAMAGAWA_ALARM;
        include CRC;
    }
}

layout! {
    /// EEPROM read request, three bytes: 0xEA (Tamagawa only).
    pub static MEMORY_READ(p) {
        include HEAD;
        /// Address in the EEPROM.
        memory_address: MemoryAddress[8];
        include CRC;
    }
}

layout! {
    /// EEPROM frame, four bytes: the request 0x32, and the reply to it and to 0xEA (Tamagawa
    /// only).
    pub static MEMORY(p) {
        include HEAD;
        /// Address in the EEPROM.
        memory_address: MemoryAddress[8];
        /// The byte at that address.
        memory_data: MemoryData[8];
        include CRC;
    }
}
