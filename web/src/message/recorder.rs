//! Recordings, as the page shows them.

use super::{Counts, Snapshot};
use crate::plot::Trace;
use encoderscope::language::msg;
use serde::{Deserialize, Serialize};

/// What runs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RecorderState {
    /// The recording that runs, or has run last.
    pub recording: Option<Recording>,
    /// The recording that is replayed.
    pub replay: Option<Replay>,
}

/// A recording that runs, or has run last.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Recording {
    /// Its name.
    pub name: String,
    /// How long it has run, in seconds.
    pub seconds: f64,
    /// How long it is, in bytes.
    pub size: f64,
    /// Where it is written.
    pub place: Place,
    /// The name of the user's file that it goes to as well.
    pub copy: Option<String>,
    /// It runs.
    pub runs: bool,
    /// Why it was ended, where the user did not; in English.
    pub fault: Option<String>,
}

/// Where a recording is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Place {
    /// Into the browser's storage, which a crash leaves as it is.
    #[default]
    Storage,
    /// Into memory.
    Memory,
}

/// A recording that is replayed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Replay {
    /// Its name.
    pub name: String,
    /// The profile of what is being read, as the parameters of a link.
    pub profile: String,
    /// The adapter that it was recorded with.
    pub adapter: String,
    /// Where it is, in milliseconds since 1970.
    pub time: f64,
    /// How much of the file has been read, 0…1.
    pub part: f64,
    /// How fast it goes; 0 holds.
    pub speed: f64,
    /// It has come to its end.
    pub ended: bool,
    /// Bytes that could not be read: damage, or an end that is missing.
    pub lost: f64,
    /// The notes in it so far, each with its time in milliseconds since 1970.
    pub notes: Vec<(f64, String)>,
}

/// A recording that is there.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    /// Its name.
    pub name: String,
    /// How long it is, in bytes.
    pub size: f64,
    /// When it was last written to, in milliseconds since 1970.
    pub written: f64,
    /// It is being written, perhaps in another tab.
    pub runs: bool,
    /// It was ended, and not cut off.
    pub whole: bool,
}

impl Kept {
    /// What a row of a list shows of it.
    #[must_use]
    pub fn key(&self) -> (String, u64, bool, bool) {
        (self.name.clone(), self.size as u64, self.runs, self.whole)
    }
}

/// What happens to a status bit: it is set, it is not any more, and it was for less than a look.
pub const BIT_CHANGES: [&str; 3] = [msg("on"), msg("off"), msg("on for a moment")];

/// What happened of late.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Story {
    /// Each with its time in milliseconds since 1970, in English.
    pub happenings: Vec<(f64, String)>,
    /// What is kept of the line: how many bytes.
    pub size: f64,
    /// For how many seconds they go back.
    pub seconds: f64,
    /// What the page shows now, in English.
    pub snapshot: Box<Snapshot>,
}

/// What a recording comes to.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Digest {
    /// Its name.
    pub name: String,
    /// From its first to its last moment, in seconds.
    pub seconds: f64,
    /// The profile that it was last read with, as the parameters of a link.
    pub profile: String,
    /// The adapter.
    pub adapter: String,
    /// Counts over all of it.
    pub counts: Counts,
    /// What was last shown.
    pub last: Box<Snapshot>,
    /// The angle over time.
    pub angle: Option<Trace>,
}
