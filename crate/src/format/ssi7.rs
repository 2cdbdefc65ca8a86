//! SSI7 of the IP-75 inductosyn (IP-75, 5.4.1).
//!
//! 30 bits, most significant first: six zeros, 22 bits of position, parity, alarm. Its low 24
//! bits are SSI2 of the IncOder family: `frame-bits=24` reads those.
//!
//! ```
//! use encoderscope::{bits::Bits, decode::Decoder, profile::Profile};
//! let profile = Profile::parse([("format", "ssi7"), ("angle-bits", "22")])?;
//! let decoder = Decoder::new(profile)?;
//! let word = [0x00, 0x04, 0x8d, 0x16];
//! let frame = decoder.line(Bits::of_bytes(&word)).unwrap();
//! let values = frame.values();
//! assert!(frame.ok());
//! assert_eq!((values.angle, values.error), (Some(0x12345), Some(false)));
//! assert_eq!(decoder.encode(&values).as_bits().len(), 30);
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```
//!
//! Where the manual misleads: note 2 has every edge send a bit, but each rising edge does;
//! T_mu and T_mi are one time, 20 ± 1 µs after the last falling edge. In the gap between words
//! the data line carries the error flag.

use super::{spared, one, Format, Limits, Manual, Link, Spec, said,
    ssi::{AFTER, BEFORE},
    timing::{Beyond, MICROSECOND, Positions, Timing, Words},
};
use crate::{
    check::Checksum,
    language::msg,
    layout::{Check, layout},
    profile::Profile,
};

/// SSI7.
pub const SPEC: Spec = Spec {
    name: "ssi7",
    title: "SSI7",
    link: Link::Clocked,
    parameters: &["angle-bits", "frame-bits", "justify"],
    quantities: &["parity"],
    limits: Limits {
        angle: POSITION,
        turns: 0,
        together: POSITION,
        frame: (POSITION + 2, 30),
    },
    interval: None,
    default: Profile {
        angle_bits: 14,
        turns_bits: 0,
        frame_bits: 30,
        ..Profile::base(Format::Ssi7)
    },
};

/// What its manual says of it.
pub const MANUAL: Manual = Manual {
    about: said("the clocked word of the IP-75 inductosyn"),
    source: said("IP-75, 5.4.1"),
    timing: Some(&TIMING),
    example: spared("000000000000000000000000000110\n000000000000001000000000000011\n"),
    guesses: &[],
    layouts: |_, shape| one(&WORD, shape),
};

/// Clock and pause (IP-75, 5.4.1, figure 8 and its notes).
pub const TIMING: Timing = Timing {
    source: msg("IP-75, 5.4.1"),
    slowest: 100_000,
    fastest: 2_000_000,
    beyond: Beyond::Never,
    timeout: 20 * MICROSECOND,
    returns: (19 * MICROSECOND, 21 * MICROSECOND),
    timeout_text: msg("T_mu = 20 ± 1 µs"),
    pause: 21 * MICROSECOND,
    pause_text: msg("T_mu = 20 ± 1 µs, which the gap must exceed"),
    words: Words::Once,
    // IP-75, table 1.
    positions: Positions::MoreThan(10_000),
};

/// Width of the position field, PD.
const POSITION: u32 = 22;

layout! {
    /// SSI7 word with what stands around it in a dump.
    pub static WORD(p) {
        include BEFORE;
        /// Always 0.
        zeros: Framing[p.frame_bits.saturating_sub(POSITION + 2)], constant = Some(0);
        /// The bits above a position of fewer than 22 bits are 0.
        padding: Padding[POSITION.saturating_sub(p.angle_bits)];
        /// Angle within one turn (PD).
        angle: Angle[p.angle_bits];
        /// Makes the number of ones in the position even (P).
        parity: Parity[1], check = Check::rows(Checksum::EvenParity, "padding", "angle");
        /// The device is faulty and the position not valid (A).
        alarm: Error[1];
        include AFTER;
    }
}
