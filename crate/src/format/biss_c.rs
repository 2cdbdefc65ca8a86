//! BiSS-C: the synchronous interface of MPP and PT, and of other makers (MPP "BISS-C", PT
//! "BISS-C").
//!
//! `ack[zeros] start=1 cds=0 turns angle nError nWarning status crc`, most significant bit
//! first. Error and warning are active low; the CRC-6 is inverted and covers everything from
//! the turns to the bit before it.
//!
//! ```
//! use encoderscope::{bits::Bits, decode::Decoder, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "biss-c"), ("angle-bits", "17")])?)?;
//! // 0x82 is an idle bit, five acknowledge zeros, start and cds; the data begins with the
//! // second byte.
//! let frame = decoder.line(Bits::of_bytes(&[0x82, 0x00, 0x05, 0x80, 0x00, 0x60, 0x68])).unwrap();
//! let values = frame.values();
//! assert!(frame.ok());
//! assert_eq!((values.turns, values.angle, values.error), (Some(5), Some(65_536), Some(false)));
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```
//!
//! Where the manuals mislead: the printed row puts the error at b7 and leaves no room for the
//! CRC; their own status table and frame lengths fit only error b13, warning b12, status
//! b11…b6, CRC b5…b0. The CRC-6 polynomial is x⁶+x+1, not x⁶+x⁵+1.

use super::{spared, one, Format, Limits, Manual, Link, STATUS, Spec, said,
    timing::{Beyond, MICROSECOND, Positions, Timing, Words},
};
use crate::{
    bits::Bits,
    check::Checksum,
    decode::Shapes,
    language::msg,
    layout::{Active, Check, Shape, layout},
    profile::{Justify, Profile, StatusActive},
};

/// BiSS-C.
pub const SPEC: Spec = Spec {
    name: "biss-c",
    title: "BiSS-C",
    link: Link::Clocked,
    parameters: &[
        "angle-bits",
        "turns-bits",
        "turns-code",
        "status-bits",
        "status-active",
        "ack-bits",
        "justify",
    ],
    quantities: &[],
    limits: Limits {
        angle: 64,
        turns: 63,
        together: 64,
        frame: (0, 0),
    },
    interval: None,
    default: Profile {
        justify: Justify::Left,
        ..Profile::base(Format::BissC)
    },
};

/// What its manual says of it.
pub const MANUAL: Manual = Manual {
    about: said("the synchronous interface of MPP and PT encoders, and of other makers"),
    source: said("MPP and PT, BiSS-C"),
    timing: Some(&TIMING),
    example: spared("82 00 05 55 a3 c1 c0 d4\n82 00 05 56 b0 f7 c0 48\n82 ff fe 80 00 01 90 88\n"),
    guesses: &[],
    layouts: |_, shape| one(&FRAME, shape),
};

/// Clock and pause (MPP and PT, "BISS-C", timing parameters and note 1).
pub const TIMING: Timing = Timing {
    source: msg("MPP and PT, BiSS-C timing"),
    slowest: 120_000,
    fastest: 2_500_000,
    beyond: Beyond::Compensated {
        fastest: 10_000_000,
    },
    timeout: 10 * MICROSECOND,
    // Only a typical value is given, but it must be over when the pause is.
    returns: (0, 20 * MICROSECOND),
    timeout_text: msg("t_M = 10 µs"),
    pause: 20 * MICROSECOND,
    pause_text: msg("t_P = 20 µs"),
    words: Words::Once,
    // MPP and PT, characteristics: update frequency.
    positions: Positions::Of(50_000),
};

/// Clocks at whose falling edges the line is still idle: the encoder pulls it low at the second
/// rising edge (MPP and PT, "BISS-C").
pub const IDLE_CLOCKS: u32 = 2;

layout! {
    /// BiSS-C frame with what stands around it in a dump.
    pub static FRAME(p) {
        include PREAMBLE;
        /// Whole turns.
        turns: Turns[p.turns_bits];
        /// Angle within one turn.
        angle: Angle[p.angle_bits];
        /// Active low: 0 says that the position is not valid.
        nError: Error[1], active = Active::Low;
        /// Active low: 0 says that something is near its limit; the position is valid.
        nWarning: Warning[1], active = Active::Low;
        /// Battery, magnetic field, temperature and speed.
        status: Status[if p.status_active == StatusActive::High { p.status_bits } else { 0 }],
            bits = STATUS;
        /// Battery, magnetic field, temperature and speed; 0 says that the condition is there.
        status: Status[if p.status_active == StatusActive::Low { p.status_bits } else { 0 }],
            bits = STATUS, active = Active::Low;
        /// Inverted remainder over everything from the turns to the bit before it.
        crc: Crc[6], check = Check::from(Checksum::Crc6Biss, "turns");
        include BEHIND;
    }
}

layout! {
    /// What stands before the data of a BiSS-C frame.
    pub static PREAMBLE(p) {
        /// Line idle before the frame.
        idle: Framing[p.idle], rest = |_| u64::MAX;
        /// Acknowledge: the encoder pulls the line low while it gets its data ready.
        ack: Framing[if p.preamble { p.ack } else { 0 }], constant = Some(0);
        /// Start bit, the first bit after the latency.
        start: Framing[u32::from(p.preamble)], constant = Some(1);
        /// Control data bit, unused by these encoders.
        cds: Framing[u32::from(p.preamble)];
    }
}

layout! {
    /// What stands behind the data of a BiSS-C frame.
    pub static BEHIND(p) {
        /// Time-out and line idle after the frame.
        tail: Framing[p.tail];
    }
}

/// Number of bits from the first turns or angle bit to the last CRC bit.
#[must_use]
pub const fn data_bits(profile: &Profile) -> u32 {
    profile.turns_bits + profile.angle_bits + 2 + profile.status_bits + Checksum::Crc6Biss.width()
}

/// Finds the shapes that a line with `data` bits of data can have: behind a preamble, alone from the first bit on, alone
/// up to the last bit.
///
/// Data that starts with zeros and a one looks like a preamble too, so several may fit.
///
/// # Errors
///
/// The line is too short for any; says how many bits it would need.
pub fn shapes(profile: &Profile, data: u32, bits: Bits<'_>) -> Result<Shapes, u32> {
    let before = (bits.len() as u32).checked_sub(data).ok_or(data)?;
    match profile.justify {
        Justify::Left => left(profile, data, bits, before),
        Justify::Right => Ok([
            right(profile, bits, before),
            None,
            Some(bare(profile, before, 0)),
        ]),
    }
}

fn left(profile: &Profile, data: u32, bits: Bits<'_>, spare: u32) -> Result<Shapes, u32> {
    // Without a preamble no more than the padding of the last or first byte can be spare.
    let padded = spare < 8;
    let zeros = (0..spare as usize).all(|at| !bits.bit(at));
    let mut shapes = [
        None,
        padded.then(|| bare(profile, 0, spare)),
        (padded && zeros).then(|| bare(profile, spare, 0)),
    ];
    if let Some((idle, ack)) = preamble(bits) {
        match spare.checked_sub(idle + ack + 2) {
            Some(tail) => {
                shapes[0] = Some(Shape {
                    idle,
                    preamble: true,
                    ack,
                    tail,
                    ..Shape::of(*profile)
                });
            }
            // A capture with the profile's own preamble that ends too early is a short frame:
            // its CRC-6 read at the wrong place would pass once in 64.
            None if idle > 0 && ack == profile.ack_bits => {
                return Err(idle + ack + 2 + data);
            }
            None => {}
        }
    }
    Ok(shapes)
}

fn right(profile: &Profile, bits: Bits<'_>, before: u32) -> Option<Shape> {
    let start = before.checked_sub(2)?;
    let zeros = (0..start)
        .rev()
        .take_while(|at| !bits.bit(*at as usize))
        .count() as u32;
    (bits.bit(start as usize) && zeros > 0).then(|| Shape {
        idle: start - zeros,
        ack: zeros,
        ..Shape::of(*profile)
    })
}

const fn bare(profile: &Profile, idle: u32, tail: u32) -> Shape {
    Shape {
        idle,
        preamble: false,
        ack: 0,
        tail,
        ..Shape::of(*profile)
    }
}

/// Idle ones and acknowledge zeros in front of a start bit; nothing where there is none.
#[must_use]
pub fn preamble(bits: Bits<'_>) -> Option<(u32, u32)> {
    let run = |from: usize, level: bool| {
        (from..bits.len())
            .take_while(|at| bits.bit(*at) == level)
            .count()
    };
    let idle = run(0, true);
    let ack = run(idle, false);
    (ack > 0 && idle + ack < bits.len()).then_some((idle as u32, ack as u32))
}
