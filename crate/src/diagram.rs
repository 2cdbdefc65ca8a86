//! Pictures of frames: what the wires do while a frame is sent, and the frame with its fields.
//!
//! A [`Timeline`] is the timing of one frame as data, for any format: the levels of both wires,
//! and which stretch of time every bit of the frame occupies. [`svg`] draws frames and timelines;
//! [`wavejson`] and [`bitfield`] exchange them with WaveDrom. All of it is read from the same
//! [`crate::layout::Resolved`] layout that decodes the frame.
//!
//! ```
//! use encoderscope::{
//!     bits::Bits, decode::Decoder, diagram::{Master, Timeline}, profile::Profile,
//! };
//! let decoder = Decoder::new(Profile::parse([("format", "asi4")])?)?;
//! let frame = decoder.frame(b"8192\r\n").unwrap();
//! let timeline = Timeline::new(&frame.layout, frame.bits, &Master::default());
//! // The last bit of the first character is the first behind its start bit: a UART sends the
//! // least significant bit first.
//! let (first, last) = (timeline.slot_of(0).unwrap(), timeline.slot_of(7).unwrap());
//! assert!(last.from < first.from);
//! assert_eq!(timeline.bit_at(last.from), Some(7));
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```

pub mod bitfield;
mod clocked;
mod fold;
mod limits;
mod relaxed;
pub mod svg;
mod timeline;
mod uart;
pub mod wavejson;

pub use fold::{Cell, Fold};
pub use limits::Limit;
pub use relaxed::Unreadable;
pub use timeline::{Lane, Master, Side, Slot, Step, Timeline, What};
