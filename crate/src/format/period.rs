//! PERIOD: MPP and PT encoders that send their position every millisecond unasked (MPP
//! "PERIOD", PT "PERIOD").
//!
//! The frames are the replies to `d` of [`super::rs485`], one every millisecond on TX, without
//! header or pause that a USB adapter would keep. Where frames begin is found out from their
//! length and CRC over a run of them: [`crate::framing`] says how.
//!
//! ```
//! use encoderscope::{decode::Decoder, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "period")])?)?;
//! let bytes = [0xff, 0xfe, 0x12, 0x34, 0x56, 0x60, 0xbb];
//! let frame = decoder.frame(&bytes).unwrap();
//! let values = frame.values();
//! assert_eq!((values.turns, values.angle), (Some(65_534), Some(0x12_3456)));
//! assert_eq!((values.warning, values.status), (Some(true), Some(0b10_0000)));
//! assert_eq!(decoder.encode(&values).into_bytes(), bytes);
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```
//!
//! Where the manual misleads: it names wires A and B; the frames are on TX+ and TX−, pins 5
//! and 6.

use super::{Format, Link, Manual, Spec, rs485, said, one};
use crate::{layout::Layout, profile::Profile};

/// PERIOD.
pub const SPEC: Spec = Spec {
    name: "period",
    title: "PERIOD",
    link: Link::Stream,
    parameters: &["angle-bits", "turns-bits", "turns-code", "baud"],
    quantities: &[],
    limits: rs485::SPEC.limits,
    interval: Some(INTERVAL),
    default: Profile::base(Format::Period),
};

/// What its manual says of it.
pub const MANUAL: Manual = Manual {
    about: said("what MPP and PT encoders send every millisecond unasked"),
    source: said("MPP and PT, PERIOD"),
    timing: None,
    example: rs485::MANUAL.example,
    guesses: &[],
    layouts: |_, shape| one(FRAME, shape),
};

/// Microseconds from one frame to the next.
pub const INTERVAL: u64 = 1_000;

/// The layout of every frame.
pub static FRAME: &Layout = &rs485::STATUS_REPLY;
