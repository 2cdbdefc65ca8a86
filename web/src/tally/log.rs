//! The raw log: what was sent and what came, with a verdict.

use super::frame_of;
use crate::message::{ENTRIES, Entry, LogFilter};
use encoderscope::{
    decode::{Decoder, Frame},
    framing::Why,
    language::t,
    recording::Purpose,
    session::Micros,
};
use std::collections::VecDeque;

/// Entries that are kept: of all, of those with a fault, and of those beside reading, which the
/// many good ones do not push out.
const KEPT: usize = 256;

/// What an entry is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A request of the session.
    Asked,
    /// Bytes that were sent beside reading.
    Sent(Purpose),
    /// A frame that came.
    Frame {
        /// Whether it stood where a frame must stand.
        sure: bool,
        /// Whether every check holds.
        good: bool,
    },
    /// Bytes that came and are no frame.
    Skip(Why),
    /// Bytes that came beside reading; the decoder may know them.
    Beside,
}

impl Kind {
    const fn is_fault(self) -> bool {
        matches!(self, Self::Skip(_) | Self::Frame { good: false, .. })
    }

    const fn is_beside(self) -> bool {
        matches!(self, Self::Sent(_) | Self::Beside)
    }

    const fn is_sent(self) -> bool {
        matches!(self, Self::Sent(_) | Self::Asked)
    }
}

/// A frame or skip as it came; it is explained only when a snapshot is made.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub(super) at: Micros,
    pub(super) bytes: Vec<u8>,
    pub(super) kind: Kind,
}

#[derive(Debug, Default)]
pub(super) struct Log {
    pub(super) filter: LogFilter,
    all: VecDeque<Seen>,
    faults: VecDeque<Seen>,
    beside: VecDeque<Seen>,
}

impl Log {
    pub(super) fn push(&mut self, seen: Seen) {
        if seen.kind.is_fault() {
            self.faults.push_front(seen.clone());
            self.faults.truncate(KEPT);
        }
        if seen.kind.is_beside() {
            self.beside.push_front(seen.clone());
            self.beside.truncate(KEPT);
        }
        self.all.push_front(seen);
        self.all.truncate(KEPT);
    }

    /// The newest entries that the filter lets through.
    pub(super) fn entries(&self, decoder: &Decoder, opened: Micros) -> Vec<Entry> {
        let passes = |seen: &&Seen| match self.filter {
            LogFilter::All | LogFilter::Faults | LogFilter::Beside => true,
            LogFilter::Received => !seen.kind.is_sent(),
            LogFilter::Sent => seen.kind.is_sent(),
        };
        let from = match self.filter {
            LogFilter::Faults => &self.faults,
            LogFilter::Beside => &self.beside,
            _ => &self.all,
        };
        let shown = from.iter().filter(passes).take(ENTRIES);
        shown.map(|seen| entry(decoder, seen, opened)).collect()
    }
}

fn entry(decoder: &Decoder, seen: &Seen, opened: Micros) -> Entry {
    let frame = match seen.kind {
        Kind::Frame { sure, .. } => frame_of(decoder, &seen.bytes, sure),
        Kind::Beside => frame_of(decoder, &seen.bytes, true).filter(Frame::ok),
        Kind::Asked | Kind::Sent(_) | Kind::Skip(_) => None,
    };
    let class = |index: usize| {
        let field = frame
            .as_ref()
            .and_then(|frame| frame.layout.field_at(index * 8 + 7));
        field.map_or("none", |field| field.row.role.class().name())
    };
    Entry {
        time: seen.at.saturating_sub(opened) as f64 / 1e6,
        sent: seen.kind.is_sent(),
        bytes: seen
            .bytes
            .iter()
            .enumerate()
            .map(|(index, byte)| (*byte, class(index).into()))
            .collect(),
        ok: match seen.kind {
            Kind::Asked | Kind::Sent(_) => None,
            Kind::Beside => frame.as_ref().map(Frame::ok),
            Kind::Frame { .. } => Some(frame.as_ref().is_some_and(Frame::ok)),
            Kind::Skip(_) => Some(false),
        },
        text: match (seen.kind, &frame) {
            (Kind::Asked | Kind::Beside, _) => String::new(),
            (Kind::Sent(purpose), _) => t(purpose.text()).into(),
            (Kind::Skip(why), _) => why.to_string(),
            (Kind::Frame { .. }, None) => t("no frame of this format").into(),
            (Kind::Frame { .. }, Some(frame)) => {
                let faults = frame.faults();
                let first = faults.first().map(|fault| fault.kind.to_string());
                first.unwrap_or_default()
            }
        },
    }
}
