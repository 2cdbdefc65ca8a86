//! What the page shows of a link: its last reading, counts, and what was said on it.

use super::{Cell, Link, Progress, Search};
use serde::{Deserialize, Serialize};

/// The shaft stands still when it moves by less than this within a second, in turns: 0.1°.
pub const STILL: f64 = 1.0 / 3600.0;

/// What the page shows of the link.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    /// How the link is.
    pub link: Link,
    /// The last good reading.
    pub reading: Option<Shown>,
    /// Status bits of the last good frame.
    pub lamps: Vec<Lamp>,
    /// Counts since the link was opened.
    pub counts: Counts,
    /// Good frames a second.
    pub rate: f64,
    /// Median time from request to reply, milliseconds.
    pub latency: Option<f64>,
    /// The time that 99 of 100 replies keep, milliseconds.
    pub latency_p99: Option<f64>,
    /// Whether the adapter returns what is sent, once known.
    pub echo: Option<bool>,
    /// The last frames, newest first.
    pub log: Vec<Entry>,
    /// How far the shaft has moved within the last second, in turns, once that is known.
    pub moved: Option<f64>,
    /// The sequence that runs or has run last.
    pub progress: Option<Progress>,
    /// The cell of the EEPROM that was asked for last.
    pub memory: Option<Cell>,
    /// Revolutions per second, from the angles of the last moments.
    pub turning: Option<f64>,
    /// The share of the last replies that were bad or missing.
    pub error_rate: Option<f64>,
    /// Bytes a second, once that is known.
    pub byte_rate: Option<f64>,
    /// Longest pause within a reply in the last seconds, milliseconds.
    pub gap: Option<f64>,
    /// The devices of a BUS, after a scan.
    pub devices: Vec<Device>,
    /// The address of the BUS device on the dial, to which settings go.
    pub watched: Option<u32>,
    /// What the last scan said, in words.
    pub scan: Option<String>,
    /// Something else than reading goes on: a setting, a scan, a search, or bytes by hand.
    pub busy: bool,
    /// The search for an encoder that runs or has run last.
    pub search: Option<Search>,
}

/// A device of a BUS.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Device {
    /// Its address.
    pub address: u8,
    /// Its last good reading.
    pub reading: Option<Shown>,
    /// Good and bad frames.
    pub good: f64,
    /// Bad frames.
    pub bad: f64,
    /// Whether it answered within the last second.
    pub fresh: bool,
}

/// A good reading.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Shown {
    /// Counts within one turn.
    pub angle: f64,
    /// Bits per turn.
    pub angle_bits: u32,
    /// Degrees.
    pub degrees: f64,
    /// Whole turns.
    pub turns: Option<f64>,
    /// The encoder says that the position is not valid.
    pub error: bool,
    /// The encoder warns.
    pub warning: bool,
    /// The six status bits; T485: the status field.
    pub status: Option<u8>,
    /// Revolutions per second.
    pub speed: Option<f64>,
    /// Degrees Celsius.
    pub temperature: Option<f64>,
    /// No zero has been set by the user (IP-75, ZPD).
    pub zero_default: Option<bool>,
}

/// A status bit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Lamp {
    /// Name.
    pub name: String,
    /// What it means and what to do.
    pub doc: String,
    /// Set in the last good frame.
    pub now: bool,
    /// In how many good frames it was set.
    pub seen: f64,
}

/// Counts since the link was opened; bytes in = bytes in frames + skipped + in sequences +
/// not yet judged, which is nothing once the link has ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counts {
    /// Good frames.
    pub good: f64,
    /// Frames with a fault.
    pub bad: f64,
    /// Bytes received.
    pub bytes: f64,
    /// Bytes in frames, good and bad.
    pub framed: f64,
    /// Bytes in no frame, echoes included.
    pub skipped: f64,
    /// Bytes that came while a sequence or a scan ran, or after bytes sent by hand.
    pub set: f64,
    /// Requests without a reply.
    pub silent: f64,
    /// Break, framing, parity and overrun errors of the port.
    pub line: f64,
}

impl std::ops::Add for Counts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            good: self.good + other.good,
            bad: self.bad + other.bad,
            bytes: self.bytes + other.bytes,
            framed: self.framed + other.framed,
            skipped: self.skipped + other.skipped,
            set: self.set + other.set,
            silent: self.silent + other.silent,
            line: self.line + other.line,
        }
    }
}

/// Entries of the log that a snapshot carries.
pub const ENTRIES: usize = 14;

/// A frame or a skip in the log.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Seconds since the link was opened.
    pub time: f64,
    /// Whether it was sent from here.
    pub sent: bool,
    /// The bytes, each with the class of its field.
    pub bytes: Vec<(u8, String)>,
    /// Whether it is a frame whose checks hold; `None` where nothing is to be judged.
    pub ok: Option<bool>,
    /// What is wrong, why it is no frame, or who sent it.
    pub text: String,
}
