//! What was said on a serial line, with times and directions, as a file.
//!
//! The file is pcapng (draft-ietf-opsawg-pcapng), which Wireshark opens. Packets are of the link
//! type `LINKTYPE_RTAC_SERIAL` (250, tcpdump.org/linktypes): twelve bytes that say when, which way
//! and what happened, then the bytes of the line. In detail:
//!
//! - an interface is a line that was open: `if_name` is the adapter, `if_description` the profile
//!   as the parameters of a link, `if_speed` the baud rate;
//! - the event of a packet is `DATA_TX_START` for bytes that were sent, `DATA_RX_START` for bytes
//!   that came, one of the errors of a UART, `STATUS_CHANGE` for a marker, whose text is the
//!   packet's comment, and `CAPTURE_COMPLETE` where the recording was ended;
//! - a comment on other packets says that they do not belong to reading: a setting, a scan, or
//!   bytes sent by hand;
//! - interface statistics end a line, with the reason as their comment.
//!
//! [`Writer`] begins a new section, which stands for itself, every [`SECTION_LENGTH`], so that
//! a [`Reader`] can start in the middle of a long recording, and goes on behind damage. A file
//! that was cut off, as when the machine lost its supply, is read up to the cut.

mod read;
mod write;

pub use read::{Reader, Section, Unreadable, is_whole};
pub use write::Writer;

use crate::{language::msg, session::Micros};
use alloc::{string::String, vec::Vec};

/// A section is this long, in bytes, before the next one begins.
pub const SECTION_LENGTH: usize = 131_072;

/// Serial line, with the header of Schweitzer Engineering Laboratories' RTAC
/// (tcpdump.org/linktypes/LINKTYPE_RTAC_SERIAL.html).
const LINK_TYPE: i32 = 250;
/// Bytes in front of those of the line: seconds and microseconds since the line was opened, the
/// event, the control lines, and two that mean nothing; numbers have their high byte first.
const HEADER: usize = 12;
/// Where the event stands.
const EVENT: usize = 8;

/// Events of the header, by their numbers.
mod event {
    pub(super) const STATUS_CHANGE: u8 = 0;
    pub(super) const DATA_TX_START: u8 = 1;
    pub(super) const DATA_RX_START: u8 = 2;
    pub(super) const DATA_TX_END: u8 = 3;
    pub(super) const DATA_RX_END: u8 = 4;
    pub(super) const CAPTURE_COMPLETE: u8 = 6;
}

/// A line that is recorded.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Line {
    /// The profile, as the parameters of a link; empty while an encoder is searched for.
    pub profile: String,
    /// The adapter: its chip and USB identity.
    pub adapter: String,
    /// Bits a second.
    pub baud: u32,
}

/// For what bytes are sent that reading does not ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// A guided setting.
    Setting,
    /// A scan or a search.
    Scan,
    /// The user has typed them.
    Hand,
}

impl Purpose {
    /// Every purpose.
    pub const ALL: [Self; 3] = [Self::Setting, Self::Scan, Self::Hand];

    /// How it is called.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Setting => msg("setting"),
            Self::Scan => msg("scan"),
            Self::Hand => msg("by hand"),
        }
    }
}

/// The comment on bytes that came and were not for reading.
const BESIDE: &str = "beside reading";

/// What a UART complains of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineError {
    /// A stop bit was missing.
    Framing,
    /// The parity bit was wrong.
    Parity,
    /// The line stayed low.
    Break,
    /// Bytes came faster than they were taken.
    Overrun,
}

impl LineError {
    /// Every error.
    pub const ALL: [Self; 4] = [Self::Framing, Self::Parity, Self::Break, Self::Overrun];

    /// The event that says it.
    const fn event(self) -> u8 {
        match self {
            Self::Framing => 7,
            Self::Parity => 8,
            Self::Break => 9,
            Self::Overrun => 10,
        }
    }
}

/// What happened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// A line was opened, or goes on with another profile.
    Opened(Line),
    /// Bytes came.
    Received {
        /// The bytes.
        bytes: Vec<u8>,
        /// Whether they were for something else than reading.
        beside: bool,
    },
    /// Bytes were sent.
    Sent {
        /// The bytes.
        bytes: Vec<u8>,
        /// For what, where reading did not ask for them.
        purpose: Option<Purpose>,
    },
    /// The UART complained.
    Failed(LineError),
    /// The user, or the program, has left a note.
    Marked(String),
    /// The line was closed or lost: why.
    Closed(String),
    /// The recording was ended: why.
    Ended(String),
}

/// What happened, and when.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Moment {
    /// Microseconds since the beginning of 1970, UTC.
    pub at: Micros,
    /// What happened.
    pub event: Event,
}
