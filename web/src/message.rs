//! What the page and the engine say to each other.
//!
//! The engine lives in a dedicated worker, or on the page where the browser has no serial in
//! workers; either way these are the messages. What the first view says and hears is [`ToEngine`] and
//! [`FromEngine`]; [`Wish`] and [`Answer`] are known to parts alone that come when they are wanted, so
//! that the first view need not carry them. They are the first of an array; a file may be the second.

mod desk;
mod recorder;
mod search;
mod snapshot;
mod wish;

pub use desk::{
    CandidateView, Count, Explained, FieldView, FileKind, FromDesk, Marked, NearView, Overview,
    RowState, RowView, Selection, ToDesk, TraceView,
};
pub use recorder::{BIT_CHANGES, Digest, Kept, Place, RecorderState, Recording, Replay, Story};
pub use search::{Found, Search, SearchStage, Trial};
pub use snapshot::{Counts, Device, ENTRIES, Entry, Lamp, STILL, Shown, Snapshot};
pub use wish::{Answer, Wish};

use encoderscope::{language::msg, sequence::Change};
use js_sys::Array;
use serde::{Deserialize, Serialize};
use wasm_bindgen::JsValue;

/// [`Wish::Speak`] and [`ToDesk::Speak`], which the first view says without knowing the others.
#[must_use]
pub fn speak(texts: &JsValue) -> JsValue {
    Array::of2(&"Speak".into(), texts).into()
}

/// From the page to the engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ToEngine {
    /// Open a port that the page has permission for and poll an encoder on it.
    Open {
        /// Which port.
        port: PortId,
        /// The profile, as the parameters of a link.
        profile: String,
    },
    /// Poll the built-in encoder.
    Demo {
        /// The profile, as the parameters of a link.
        profile: String,
    },
    /// Search for the encoder on a port, or for the built-in one.
    Find {
        /// Which port; nothing for the built-in encoder.
        port: Option<PortId>,
        /// The profile, as the parameters of a link; the built-in encoder is made from it.
        profile: String,
    },
    /// Which entries of the log the page shows.
    Log(LogFilter),
    /// Stop and close the port.
    Close,
    /// The page has drawn the last snapshot and wants the next.
    Next,
    /// Is anybody there?
    Ping,
}

/// What is to be changed in an encoder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Setting {
    /// The present position becomes 0.
    Zero,
    /// The present angle becomes 0.
    ResetAngle,
    /// The turns become 0.
    ResetTurns,
    /// The errors are cleared.
    ResetErrors,
    /// The address on the bus.
    Address(u8),
    /// A byte of the EEPROM.
    Memory {
        /// Its cell, 0…127.
        address: u8,
        /// What it becomes.
        data: u8,
    },
}

/// The supply of the built-in encoder, and what is tied to 0 V when it comes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Supply {
    /// Off.
    Off,
    /// On.
    On,
    /// On, with ZERO SET at 0 V.
    OnWithSet,
    /// On, with ZERO RESET at 0 V.
    OnWithReset,
}

/// A cell of the EEPROM.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cell {
    /// Its place, 0…127.
    pub address: u8,
    /// What it holds, once it has been read.
    pub data: Option<u8>,
}

/// What the built-in encoder reports, and what goes wrong on its line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Knobs {
    /// Counts by which the angle may be off to either side, at random.
    pub noise: u32,
    /// The six status bits.
    pub status: u8,
    /// The position is not valid.
    pub error: bool,
    /// Something is near its limit.
    pub warning: bool,
    /// The adapter returns every request.
    pub echo: bool,
    /// No answers.
    pub silent: bool,
    /// Of 1000 reply bytes, how many have a bit turned over.
    pub flip: u32,
    /// Of 1000 replies, how many get lost.
    pub lose: u32,
}

/// Which entries of the log are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum LogFilter {
    /// All.
    #[default]
    All,
    /// What came.
    Received,
    /// What was sent.
    Sent,
    /// What is no good frame.
    Faults,
    /// What does not belong to reading: settings, scans, and bytes sent by hand.
    Beside,
}

impl Setting {
    /// One of each kind.
    pub const KINDS: [Self; 6] = [
        Self::Zero,
        Self::ResetAngle,
        Self::ResetTurns,
        Self::ResetErrors,
        Self::Address(0),
        Self::Memory {
            address: 0,
            data: 0,
        },
    ];

    /// The sequence that makes it.
    #[must_use]
    pub const fn change(self) -> Change {
        match self {
            Self::Zero => Change::Zero,
            Self::ResetAngle => Change::ResetAngle,
            Self::ResetTurns => Change::ResetTurns,
            Self::ResetErrors => Change::ResetErrors,
            Self::Address(address) => Change::Address(address),
            Self::Memory { address, data } => Change::Memory { address, data },
        }
    }

    /// How it is called.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Zero => msg("set zero"),
            Self::ResetAngle => msg("reset angle"),
            Self::ResetTurns => msg("reset turns"),
            Self::ResetErrors => msg("reset errors"),
            Self::Address(_) => msg("set address"),
            Self::Memory { .. } => msg("EEPROM write"),
        }
    }

    /// Whether the shaft must stand still meanwhile.
    #[must_use]
    pub const fn needs_rest(self) -> bool {
        matches!(self, Self::Zero | Self::ResetAngle)
    }
}

/// A sequence that runs, or has run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// What is being changed.
    pub setting: Setting,
    /// Commands done.
    pub done: u32,
    /// Commands in all.
    pub total: u32,
    /// What the encoder has counted.
    pub count: Option<u8>,
    /// The position before.
    pub before: Option<Shown>,
    /// What the cell of the EEPROM held before.
    pub held: Option<u8>,
    /// How it ended.
    pub outcome: Option<Outcome>,
}

/// How a sequence ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Whether the change was made, where that is known.
    pub changed: Option<bool>,
    /// What happened and what the encoder holds, in words.
    pub text: String,
}

/// From the engine to the page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum FromEngine {
    /// The engine runs.
    Hello {
        /// Whether it can reach serial ports itself.
        serial: bool,
    },
    /// The answer to [`ToEngine::Ping`].
    Pong,
    /// The state of the link and what it has read.
    Snapshot(Box<Snapshot>),
    /// The reading between snapshots.
    Reading(Shown),
}

/// A port among those that the page has permission for.
///
/// Port objects do not cross to a worker; the order of the list and the USB identity do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PortId {
    /// Place in the list of known ports.
    pub index: u32,
    /// USB vendor, where the port is on USB.
    pub vendor: Option<u16>,
    /// USB product.
    pub product: Option<u16>,
}

/// How the link is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Link {
    /// Nothing is open.
    #[default]
    Closed,
    /// The port is being opened.
    Opening,
    /// Requests go out, nothing good has come back yet.
    Waiting,
    /// Good frames come in.
    Reading,
    /// Nothing comes back.
    Silent {
        /// Nothing but the echo of the requests.
        echo: bool,
    },
    /// An encoder is being searched for.
    Searching,
    /// What comes back is no frame.
    Garbage,
    /// Frames come back, but their checks fail.
    Failing,
    /// The frames are good with another profile.
    OtherProfile {
        /// It, as the parameters of a link.
        profile: String,
    },
    /// Bytes come without being asked for.
    Unasked {
        /// The profile they fit, where there is one.
        profile: Option<String>,
    },
    /// The profile cannot be read over a serial port.
    Unfit {
        /// It, as the parameters of a link.
        #[serde(default)]
        profile: String,
        /// Why.
        reason: String,
    },
    /// The port could not be opened.
    Refused {
        /// Why, in English; perhaps in the browser's words.
        reason: String,
        /// What to do about it, in English.
        #[serde(default)]
        hint: String,
    },
    /// The port went away.
    Lost,
}

impl Link {
    /// One word for each state.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Closed => msg("closed"),
            Self::Opening => msg("opening"),
            Self::Waiting => msg("waiting"),
            Self::Reading => msg("reading"),
            Self::Silent { echo: false } => msg("silent"),
            Self::Silent { echo: true } => msg("echo-only"),
            Self::Searching => msg("searching"),
            Self::Garbage => msg("garbage"),
            Self::Failing => msg("failing"),
            Self::OtherProfile { .. } => msg("other-profile"),
            Self::Unasked { .. } => msg("unasked"),
            Self::Unfit { .. } => msg("unfit"),
            Self::Refused { .. } => msg("refused"),
            Self::Lost => msg("lost"),
        }
    }

    /// Whether a port is open or being opened.
    #[must_use]
    pub const fn is_open(&self) -> bool {
        !matches!(
            self,
            Self::Closed | Self::Unfit { .. } | Self::Refused { .. } | Self::Lost
        )
    }
}
