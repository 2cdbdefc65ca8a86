//! Absolute rotary encoders on the wire: decode, explain, encode and converse.
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
//! The manuals contradict themselves in places; [`errata::ERRATA`] lists each with the reading
//! that was chosen.
//!
//! Every layout fact stands in one table of [`format`], made by `layout!` ([`layout`]). The
//! crate does no I/O, reads no clock and does not panic on any input.
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
