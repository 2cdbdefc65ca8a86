//! Absolute rotary encoders on the wire: decode, explain, encode and converse.
//!
//! ```
//! use encoderscope::{decode::Decoder, link};
//! let decoder = Decoder::new(link::profile("format=t485&angle-bits=23")?)?;
//! let frame = decoder.frame(&[0x1a, 0x20, 0x29, 0xc0, 0x3b, 0x17, 0, 0, 0, 0xc8, 0x37]);
//! let reading = frame.and_then(|frame| frame.reading()).unwrap();
//! assert_eq!((reading.turns, reading.angle), (Some(0), 3_915_817));
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```
//!
//! # Architecture
//!
//! One table feeds everything: a frame is a `layout!` table ([`layout`]), and [`format`] has a
//! file of them for every format. A [`profile::Profile`] says which encoder it is; with it a
//! table becomes a [`layout::Resolved`], which knows where each bit is. What comes after never
//! asks which format it has.
//!
//! The stages, in the order the data takes them:
//!
//! - [`dump`]: pasted text to bytes and bits;
//! - [`capture`]: edges that a logic analyser has recorded to frames, with the timing checked;
//! - [`framing`]: bytes, cut anyhow, into frames and skips;
//! - [`decode`]: a [`decode::Frame`] is bits and the layout that reads them;
//! - [`reading`]: what the shaft does, from good frames only; [`columns`]: many at once;
//! - [`explain`]: what the bits say, from any frame; [`sketch`]: a frame that is changed bit by
//!   bit; [`diagram`]: pictures of frames, and what the wires do;
//! - [`detect`]: what a dump may be, ranked by evidence; [`sheet`]: a decoded dump as a table;
//! - [`session`]: the host's side of a serial line; [`sequence`]: what changes an encoder;
//!   [`finder`]: which encoder is on the line; [`doctor`]: how the link is; [`emulator`]: the
//!   encoder's side of it all; [`conversation`]: what both say while something is changed;
//! - [`recording`]: what was said on a line, as a file (feature `pcapng`);
//! - [`history`]: what has been read, over hours; [`standstill`]: how much it varies at rest;
//! - [`crc_search`]: the checksum of frames of an unknown format;
//! - [`export`]: decoders as source, frames as tables; [`link`]: a profile in a link;
//! - [`product`]: what is sold; [`model`]: order codes; [`wiring`]: which wire goes where;
//!   [`procedure`]: how the zero of each product is set; [`lamp`]: what an encoder's LED says;
//! - [`language`]: what is said to people, in English or another language;
//! - [`calculator`]: what is worked out on paper; [`adapter`]: what USB adapters can do;
//!   [`apci1710`]: the registers of a board that clocks SSI encoders.
//!
//! The crate does no I/O. Whoever has a port gives what was read and when to
//! [`session::Session`], takes what it wants sent, and calls it again when it asks to be; the
//! page does so in a worker, the tests on a virtual clock.
//!
//! # What always holds
//!
//! Each promise has a name, by which the rest of the project speaks of it.
//!
//! - **One row.** A layout fact, that is a place, a width, an order, a name or a check, stands
//!   in one row of one table. Decoder, encoder, checks, detection, explainer, pictures and
//!   exported sources read it there.
//! - **No panic.** No input makes the crate panic; what is wrong comes back as an error with a
//!   place. It forbids `unsafe`, and the fuzz targets look for the rest.
//! - **Nothing lost.** Every byte that goes into a [`framing::Framer`] comes out once, in order,
//!   in a frame or as skipped with a reason; every character of a dump is read or left out with
//!   a reason.
//! - **Cut anyhow.** How a stream was cut into pieces changes no frame of it.
//! - **No false angle.** A [`reading::Reading`] is made of frames alone whose every check holds;
//!   what failed is shown as failed.
//! - **There and back.** What the encoder of a layout wrote, its decoder reads: the tests try
//!   every width, and turn every bit over to see that the check notices.
//! - **Nothing by accident.** What changes an encoder is a [`sequence::Script`] that somebody
//!   begins with [`session::Session::ask`]; [`finder`], [`detect`] and [`link`] have no way to.
//! - **No clock.** Times come in with the bytes, as microseconds; nothing waits.
//! - **One name.** What programs read, the keys of JSON, is named in [`record`]; what people
//!   read is said in English in the source, and translated by [`language`].
//!
//! The manuals contradict themselves in places; [`errata::ERRATA`] lists each with the reading
//! that was chosen.
#![no_std]
#![forbid(unsafe_code)]

extern crate alloc;
#[cfg(feature = "vcd")]
extern crate std;

pub mod adapter;
pub mod apci1710;
pub mod bits;
pub mod calculator;
pub mod capture;
pub mod check;
pub mod columns;
pub mod conversation;
pub mod crc_search;
pub mod decode;
pub mod detect;
pub mod diagram;
pub mod doctor;
pub mod dump;
pub mod emulator;
pub mod errata;
pub mod explain;
pub mod export;
pub mod finder;
pub mod format;
pub mod framing;
pub mod history;
pub mod lamp;
pub mod language;
pub mod layout;
pub mod link;
pub mod model;
pub mod procedure;
pub mod product;
pub mod profile;
pub mod reading;
pub mod record;
#[cfg(feature = "pcapng")]
pub mod recording;
pub mod sequence;
pub mod session;
pub mod sheet;
pub mod sketch;
pub mod standstill;
pub mod wiring;
