//! ASI1: the binary stream of the IP-75 inductosyn (IP-75, 5.3.1).
//!
//! 230 400 baud, 8N1, packets of six bytes without pauses. Each byte carries seven bits below
//! its top bit; the position is right-aligned in 22 bits, and the CRC-16 covers all 48 bits with
//! its own taken as 0.
//!
//! ```
//! use encoderscope::{decode::Decoder, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "asi1")])?)?;
//! let packet = [0x60, 0x03, 0x7f, 0x7c, 0x15, 0x4a];
//! let frame = decoder.frame(&packet).unwrap();
//! let values = frame.values();
//! assert!(frame.ok());
//! assert_eq!((values.angle, values.valid), (Some(16_383), Some(true)));
//! assert_eq!(decoder.encode(&values).into_bytes(), packet);
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```
//!
//! Where the manual misleads: figure 7, the layout, is not in every copy of it; the order of the
//! bits is that of the IncOder family, from which the format comes. "No pauses" and "3.33 kHz"
//! contradict each other, so gaps mean nothing. The top bit of the bytes is not known for
//! certain: it is part of the CRC as received, is shown, and may be anything (`marker` says
//! what [`crate::emulator`] sends).

use super::{Format, Limits, Manual, Link, Spec, said, one, spared};
use crate::{
    check::Checksum,
    layout::{Check, Shape, layout},
    profile::{Marker, Profile},
};

/// ASI1.
pub const SPEC: Spec = Spec {
    name: "asi1",
    title: "ASI1",
    link: Link::Stream,
    parameters: &["angle-bits", "marker", "baud"],
    quantities: &["valid", "zeroDefault"],
    limits: Limits {
        angle: POSITION,
        turns: 0,
        together: POSITION,
        frame: (0, 0),
    },
    interval: Some(INTERVAL),
    default: Profile {
        angle_bits: 14,
        turns_bits: 0,
        baud: 230_400,
        ..Profile::base(Format::Asi1)
    },
};

/// What its manual says of it.
pub const MANUAL: Manual = Manual {
    about: said("the binary stream of the IP-75 inductosyn"),
    source: said("IP-75, 5.3.1"),
    timing: None,
    example: spared("60 00 00 06 00 35\n60 03 7f 7c 15 4a\n60 00 00 00 00 66\n"),
    guesses: &[],
    layouts: |_, shape| one(&PACKET, shape),
};

/// Microseconds from one packet to the next: 3.33 thousand a second (IP-75, 5.3.1).
pub const INTERVAL: u64 = 300;

/// Width of the position field, PD.
const POSITION: u32 = 22;

/// How many of the bits `high`…`low` of PD belong to the angle.
const fn angle(p: &Shape, high: u32, low: u32) -> u32 {
    let above = p.profile.angle_bits.saturating_sub(low);
    let all = high + 1 - low;
    if above < all { above } else { all }
}

/// How many of the bits `high`…`low` of PD stand above the angle.
const fn padding(p: &Shape, high: u32, low: u32) -> u32 {
    high + 1 - low - angle(p, high, low)
}

layout! {
    /// ASI1 packet, six bytes.
    pub static PACKET(p) {
        /// Top bit of the six bytes: 0, or 1 in the first; shown, never required.
        marker: Framing[1], rest = |p| if p.marker == Marker::First { 0b10_0000 } else { 0 };
        /// 1: the position is valid (PV).
        valid: Valid[1];
        /// 1: no zero has been set by the user (ZPD).
        zero_default: ZeroDefault[1];
        /// Always 0.
        zeros: Framing[2], constant = Some(0);
        /// The bits above a position of fewer than 22 bits are 0.
        padding: Padding[padding(p, 21, 19)];
        /// Angle within one turn (PD).
        angle: Angle[angle(p, 21, 19)];
        /// Top bit.
        marker: Framing[1];
        /// The bits above a position of fewer than 22 bits are 0.
        padding: Padding[padding(p, 18, 12)];
        /// Angle within one turn (PD).
        angle: Angle[angle(p, 18, 12)];
        /// Top bit.
        marker: Framing[1];
        /// The bits above a position of fewer than 22 bits are 0.
        padding: Padding[padding(p, 11, 5)];
        /// Angle within one turn (PD).
        angle: Angle[angle(p, 11, 5)];
        /// Top bit.
        marker: Framing[1];
        /// The bits above a position of fewer than 22 bits are 0.
        padding: Padding[padding(p, 4, 0)];
        /// Angle within one turn (PD).
        angle: Angle[angle(p, 4, 0)];
        /// CRC over the six bytes with these bits taken as 0.
        crc: Crc[2], check = Check::frame(Checksum::Crc16x8005);
        /// Top bit.
        marker: Framing[1];
        /// CRC over the six bytes with these bits taken as 0.
        crc: Crc[7];
        /// Top bit.
        marker: Framing[1];
        /// CRC over the six bytes with these bits taken as 0.
        crc: Crc[7];
    }
}
