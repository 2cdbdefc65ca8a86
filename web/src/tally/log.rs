//! The raw log: what was sent and what came, with a verdict.

use super::frame_of;
use crate::message::{Entry, LogFilter};
use encoderscope::{
    decode::{Decoder, Frame},
    session::Micros,
};
use std::collections::VecDeque;

/// Entries that a snapshot carries.
const SHOWN: usize = 14;
/// Entries that are kept, and of those the ones with a fault, which good ones do not push out.
const KEPT: usize = 256;

/// What an entry is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Bytes that were sent.
    Sent,
    /// A frame that came.
    Frame {
        /// Whether it stood where a frame must stand.
        sure: bool,
        /// Whether every check holds.
        good: bool,
    },
    /// Bytes that came and are no frame.
    Skip,
    /// Bytes that came while something else than reading was going on.
    Aside,
}

impl Kind {
    const fn is_fault(self) -> bool {
        matches!(self, Self::Skip | Self::Frame { good: false, .. })
    }
}

/// A frame or skip as it came; it is explained only when a snapshot is made.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub(super) at: Micros,
    pub(super) bytes: Vec<u8>,
    pub(super) kind: Kind,
    pub(super) text: String,
}

#[derive(Debug, Default)]
pub(super) struct Log {
    pub(super) filter: LogFilter,
    all: VecDeque<Seen>,
    faults: VecDeque<Seen>,
}

impl Log {
    pub(super) fn push(&mut self, seen: Seen) {
        if seen.kind.is_fault() {
            self.faults.push_front(seen.clone());
            self.faults.truncate(KEPT);
        }
        self.all.push_front(seen);
        self.all.truncate(KEPT);
    }

    /// The newest entries that the filter lets through.
    pub(super) fn entries(&self, decoder: &Decoder, opened: Micros) -> Vec<Entry> {
        let passes = |seen: &&Seen| match self.filter {
            LogFilter::All | LogFilter::Faults => true,
            LogFilter::Received => seen.kind != Kind::Sent,
            LogFilter::Sent => seen.kind == Kind::Sent,
        };
        let from = match self.filter {
            LogFilter::Faults => &self.faults,
            _ => &self.all,
        };
        let shown = from.iter().filter(passes).take(SHOWN);
        shown.map(|seen| entry(decoder, seen, opened)).collect()
    }
}

fn entry(decoder: &Decoder, seen: &Seen, opened: Micros) -> Entry {
    let frame = match seen.kind {
        Kind::Frame { sure, .. } => frame_of(decoder, &seen.bytes, sure),
        _ => None,
    };
    let class = |index: usize| {
        let field = frame
            .as_ref()
            .and_then(|frame| frame.layout.field_at(index * 8 + 7));
        field.map_or("none", |field| field.row.role.class().name())
    };
    Entry {
        time: seen.at.saturating_sub(opened) as f64 / 1e6,
        sent: seen.kind == Kind::Sent,
        bytes: seen
            .bytes
            .iter()
            .enumerate()
            .map(|(index, byte)| (*byte, class(index).into()))
            .collect(),
        ok: match seen.kind {
            Kind::Sent | Kind::Aside => None,
            Kind::Frame { .. } => Some(frame.as_ref().is_some_and(Frame::ok)),
            Kind::Skip => Some(false),
        },
        text: seen.text.clone(),
    }
}
