//! The classic SSI word of Pepperl+Fuchs AVS/AVM58 and many others (P+F article, tables 1 and 4).
//!
//! In a *fir-tree* an axis stands between turns and angle: twelve columns to its left, turns
//! right-aligned against it, and the angle to its right, followed by zeros. Right-aligned words
//! have the zeros in front. Turns and angle are one Gray word, which is converted as a whole
//! before it is cut. Single-turn words have no left half.
//!
//! ```
//! use encoderscope::{bits::Bits, decode::Decoder, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "ssi-tree")])?)?;
//! let frame = decoder.line(Bits::of_bytes(&[0x01, 0x4a, 0x52, 0x23])).unwrap();
//! let values = frame.values();
//! assert_eq!((values.turns, values.angle), (Some(3171), Some(962)));
//! assert_eq!(frame.layout.encode(&values).as_bits().bytes(), [0x01, 0x4a, 0x52, 0x23]);
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```
//!
//! A master that keeps clocking gets the same word again, with one 0 between
//! (multi-transmission, 14 clocks a word of 13 bits, 26 of 25). Words that differ show an error
//! of the line.
//!
//! Where the article misleads: 16 bits are 65 536 values, not 32 688; the rows of table 1 have
//! 25 and 26 columns, so the word length and the place of the parity are parameters.

use super::{spared, one, Format, Limits, Manual, Link, Spec, said,
    ssi::{AFTER, BEFORE, with_spare},
    timing::{Beyond, MICROSECOND, Positions, Timing, Words},
};
use crate::{
    bits::Bits,
    check::Checksum,
    decode::Shapes,
    language::msg,
    layout::{Check, Shape, layout},
    profile::{Align, Code, Justify, Parity, Profile},
};

/// SSI fir-tree.
pub const SPEC: Spec = Spec {
    name: "ssi-tree",
    title: msg("SSI fir-tree"),
    link: Link::Clocked,
    parameters: &[
        "angle-bits",
        "turns-bits",
        "turns-code",
        "code",
        "align",
        "frame-bits",
        "parity",
        "justify",
    ],
    quantities: &["parity"],
    limits: Limits {
        angle: 18,
        turns: 16,
        together: 34,
        frame: (2, 64),
    },
    interval: None,
    default: Profile {
        angle_bits: 13,
        turns_bits: 12,
        code: Code::Gray,
        align: Align::Tree,
        frame_bits: 25,
        ..Profile::base(Format::SsiTree)
    },
};

/// What its manual says of it.
pub const MANUAL: Manual = Manual {
    about: said("the classic SSI word of Pepperl+Fuchs AVS and AVM58, and of many others"),
    source: said("P+F article, tables 1 and 4"),
    timing: Some(&TIMING),
    example: spared("1010010100101001000100011\n0110001111111011110001000\n"),
    guesses: &[],
    layouts: |_, shape| one(&WORD, shape),
};

/// Clock and pause (P+F article, figure 2; table 6, "0.1…1.5 Mbit/s").
pub const TIMING: Timing = Timing {
    source: msg("P+F article, figure 2 and table 6"),
    slowest: 100_000,
    fastest: 1_500_000,
    beyond: Beyond::Never,
    timeout: 20 * MICROSECOND,
    returns: (10 * MICROSECOND, 30 * MICROSECOND),
    timeout_text: msg("t_m = 20 ± 10 µs"),
    pause: 30 * MICROSECOND,
    pause_text: msg("t_m = 20 ± 10 µs, which the pause must exceed"),
    words: Words::Ring,
    // The article names none.
    positions: Positions::Unsaid,
};

/// Columns to the left of the axis.
const LEFT: u32 = 12;

layout! {
    /// SSI word with what stands around it in a dump.
    pub static WORD(p) {
        include BEFORE;
        /// The columns to the left of the number are 0.
        leading: Padding[leading(p)];
        gray(p.code == Code::Gray) {
            /// Whole turns, against the axis.
            turns: Turns[p.turns_bits];
            /// Angle within one turn, most significant bit first from the axis.
            angle: Angle[p.angle_bits];
        }
        /// The columns to the right of the number are 0.
        trailing: Padding[if p.code == Code::Binary { trailing(p) } else { 0 }];
        /// The columns to the right of a Gray word carry nothing.
        trailing: Framing[if p.code == Code::Gray { trailing(p) } else { 0 }];
        /// Makes the number of ones in the word even.
        parity: Parity[u32::from(p.parity == Parity::Even)],
            check = Check::from(Checksum::EvenParity, "leading");
        /// Makes the number of ones in the word odd.
        parity: Parity[u32::from(p.parity == Parity::Odd)],
            check = Check::from(Checksum::OddParity, "leading");
        /// The same word again, a 0 in front of each: all must agree.
        again: Repeat[p.repeats * (p.frame_bits + 1)];
        include AFTER;
    }
}

/// Bits of the data and the parity.
const fn number(p: &Profile) -> u32 {
    let parity = !matches!(p.parity, Parity::None);
    p.turns_bits
        .saturating_add(p.angle_bits)
        .saturating_add(parity as u32)
}

/// Columns that the left half of a fir-tree has beyond the turns.
const fn left(p: &Profile, room: u32) -> u32 {
    let left = LEFT.saturating_sub(p.turns_bits);
    // A single-turn word has no left half unless it is as long as one that has.
    if p.turns_bits > 0 || room >= left && p.frame_bits >= 2 * LEFT {
        left
    } else {
        0
    }
}

/// Columns in front of the number.
const fn leading(p: &Profile) -> u32 {
    let room = p.frame_bits.saturating_sub(number(p));
    match p.align {
        Align::Tree => left(p, room),
        Align::Right => room,
    }
}

/// Columns between the number and the parity.
const fn trailing(p: &Profile) -> u32 {
    p.frame_bits.saturating_sub(number(p) + leading(p))
}

/// The shortest word that holds these widths.
#[must_use]
pub const fn needed_bits(p: &Profile) -> u32 {
    match p.align {
        Align::Tree => number(p).saturating_add(left(p, 0)),
        Align::Right => number(p),
    }
}

/// The shape of a line: one word, or the same word several times with a 0 between.
///
/// # Errors
///
/// The line is too short; says how many bits it would need.
pub fn shapes(profile: &Profile, bits: Bits<'_>) -> Result<Shapes, u32> {
    let spare = (bits.len() as u32).checked_sub(profile.frame_bits);
    let spare = spare.ok_or(profile.frame_bits)?;
    let one = with_spare(profile, Shape::of(*profile), bits, spare);
    let word = profile.frame_bits as usize;
    let around = match profile.justify {
        Justify::Left => word..bits.len(),
        Justify::Right => 0..bits.len().saturating_sub(word),
    };
    // A word in wide bytes has one level around it; a word of zeros says nothing either way.
    let level = bits.bit(around.start);
    let narrow = { around }.all(|at| bits.bit(at) == level);
    let times = (bits.len() + 1) / (word + 1);
    let rest = bits.len() + 1 - times * (word + 1);
    if times < 2 || rest >= 8 || (narrow && rest > 0) {
        return Ok(one);
    }
    let plain = Shape {
        repeats: times as u32 - 1,
        ..Shape::of(*profile)
    };
    let shapes = with_spare(profile, plain, bits, rest as u32);
    if rest != 1 {
        return Ok(shapes);
    }
    // A clock more for each word, 14 for 13 bits, leaves a 0 behind the last one too.
    let behind = Shape { tail: 1, ..plain };
    let idle = bits.bit(0).then_some(Shape { idle: 1, ..plain });
    Ok([Some(behind), idle, None])
}
