//! The SPI word of AS5047 and AS5048, magnetic encoders on a board (AS5048A data sheet, "SPI
//! interface"; AS5047P data sheet, "SPI timing").
//!
//! 16 bits, most significant first: parity, error flag, 14 bits of angle. A word answers the command
//! of the word before it; what answers another register than the angle looks the same.
//!
//! ```
//! use encoderscope::{bits::Bits, decode::Decoder, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "as5048")])?)?;
//! let frame = decoder.line(Bits::of_bytes(&[0xa0, 0x00])).unwrap();
//! assert!(frame.ok());
//! assert_eq!((frame.values().angle, frame.values().error), (Some(0x2000), Some(false)));
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```

use super::{
    Format, Limits, Link, Manual, Spec, one, said, spared,
    ssi::{AFTER, BEFORE},
};
use crate::{
    check::Checksum,
    layout::{Check, layout},
    profile::Profile,
};

/// AS5048.
pub const SPEC: Spec = Spec {
    name: "as5048",
    title: "AS5048",
    link: Link::Clocked,
    parameters: &["angle-bits"],
    quantities: &["parity"],
    limits: Limits {
        angle: POSITION,
        turns: 0,
        together: POSITION,
        frame: (0, 0),
    },
    interval: None,
    default: Profile {
        angle_bits: POSITION,
        turns_bits: 0,
        status_bits: 0,
        ..Profile::base(Format::As5048)
    },
};

/// What its data sheet says of it.
pub const MANUAL: Manual = Manual {
    about: said("the SPI word of the magnetic encoders AS5047 and AS5048"),
    source: said("AS5048A data sheet, SPI interface"),
    timing: None,
    example: spared("a0 00\n20 01\na0 03\n"),
    guesses: &[SPEC.default],
    layouts: |_, shape| one(&WORD, shape),
};

/// Width of the field of the angle.
const POSITION: u32 = 14;

layout! {
    /// Word of an SPI transfer, an answer to *read angle*, with what stands around it in a dump.
    pub static WORD(p) {
        include BEFORE;
        /// Makes the number of ones in the word even (PAR).
        parity: Parity[1], check = Check::rows(Checksum::EvenParity, "error", "angle");
        /// The command before it was not understood (EF).
        error: Error[1];
        /// The bits above an angle of fewer than 14 bits are 0.
        padding: Padding[POSITION.saturating_sub(p.angle_bits)];
        /// Angle within one turn.
        angle: Angle[p.angle_bits];
        include AFTER;
    }
}
