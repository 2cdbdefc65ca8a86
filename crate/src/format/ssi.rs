//! SSI of MPP and PT encoders (MPP "SSI", PT "SSI").
//!
//! `turns angle error warning status`, most significant bit first, no check at all. The first
//! falling edge of the clock latches the position; data changes on rising edges and is sampled
//! on falling ones, so n bits need n+1 falling edges.
//!
//! ```
//! use encoderscope::{bits::Bits, decode::Decoder, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "ssi"), ("angle-bits", "16")])?)?;
//! // Turns 5, a quarter turn, a warning, the battery low.
//! let word = [0x00, 0x05, 0x40, 0x00, 0b0101_0000];
//! let frame = decoder.line(Bits::of_bytes(&word)).unwrap();
//! let values = frame.values();
//! assert_eq!((values.turns, values.angle), (Some(5), Some(0x4000)));
//! assert_eq!((values.error, values.warning, values.status), (Some(false), Some(true), Some(16)));
//! assert_eq!(decoder.encode(&values).as_bits().bytes(), word);
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```
//!
//! Where the manuals mislead: MPP's row calls b5…b0 "1 bit", there are six; the row "t_CL 400
//! ns…14 µs" is the clock's period and contradicts the row of frequencies, which is right.

use super::{spared, one, Format, HEALTH, Limits, Manual, Link, Spec, said,
    timing::{Beyond, MICROSECOND, NANOSECOND, Positions, Timing, Words},
};
use crate::{
    bits::Bits,
    decode::Shapes,
    language::msg,
    layout::{Shape, layout},
    profile::{Justify, Profile},
};

/// SSI.
pub const SPEC: Spec = Spec {
    name: "ssi",
    title: "SSI",
    link: Link::Clocked,
    parameters: &["angle-bits", "turns-bits", "turns-code", "justify"],
    quantities: &[],
    limits: Limits {
        angle: 32,
        turns: 16,
        together: 48,
        frame: (0, 0),
    },
    interval: None,
    default: Profile::base(Format::Ssi),
};

/// What its manual says of it.
pub const MANUAL: Manual = Manual {
    about: said("a clocked word of MPP and PT encoders, without any check"),
    source: said("MPP and PT, SSI"),
    timing: Some(&TIMING),
    example: spared("00 05 12 34 56 00\n00 05 12 a0 01 00\nff fe 13 00 00 60\n"),
    guesses: &[],
    layouts: |_, shape| one(&WORD, shape),
};

/// Clock and pause (MPP and PT, "SSI", timing parameters and note 1).
pub const TIMING: Timing = Timing {
    source: msg("MPP and PT, SSI timing"),
    slowest: 110_000,
    fastest: 1_500_000,
    beyond: Beyond::FirstLow {
        fastest: 10_000_000,
        low: 500 * NANOSECOND,
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

layout! {
    /// SSI word of MPP and PT with what stands around it in a dump.
    pub static WORD(p) {
        include BEFORE;
        /// Whole turns; only models M, BM and FM send them.
        turns: Turns[p.turns_bits];
        /// Angle within one turn.
        angle: Angle[p.angle_bits];
        include HEALTH;
        include AFTER;
    }
}

layout! {
    /// What stands before an SSI word in a dump.
    pub static BEFORE(p) {
        /// Bits in front of a number that is narrower than its bytes.
        unused: Padding[p.unused];
        /// Line idle before the word.
        idle: Framing[p.idle], rest = |_| u64::MAX;
    }
}

layout! {
    /// What stands behind an SSI word in a dump.
    pub static AFTER(p) {
        /// Bits clocked after the word.
        tail: Framing[p.tail];
    }
}

/// The shapes of a line with `spare` bits beside what it should hold, the likeliest first.
#[must_use]
pub fn with_spare(profile: &Profile, plain: Shape, bits: Bits<'_>, spare: u32) -> Shapes {
    let idle = (0..spare as usize).all(|at| bits.bit(at));
    let before = match idle {
        true => Shape {
            idle: spare,
            ..plain
        },
        false => Shape {
            unused: spare,
            ..plain
        },
    };
    let behind = Shape {
        tail: spare,
        ..plain
    };
    let (first, second) = match profile.justify {
        Justify::Left => (behind, before),
        Justify::Right => (before, behind),
    };
    // One 0 in front may as well be the clock too many behind the word; a 1 is the line idle.
    let either = spare == 1 && !idle && !bits.len().is_multiple_of(8);
    [Some(first), either.then_some(second), None]
}
