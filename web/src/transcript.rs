//! What was said on the line of late, always kept; and all of it, while a recording runs.

use encoderscope::{
    recording::{Line, LineError, Purpose, SECTION_LENGTH, Writer},
    session::Micros,
};
use std::collections::VecDeque;

/// So many bytes are kept of what was said of late.
const KEPT: usize = 8 * 1024 * 1024;

/// What was said, as sections of a recording.
#[derive(Debug, Default)]
pub struct Transcript {
    writer: Writer,
    /// The time 0 of the engine, in microseconds since 1970.
    origin: Micros,
    /// The section that is being written.
    section: Vec<u8>,
    /// Those before it, and when each began.
    sections: VecDeque<(Micros, Vec<u8>)>,
    kept: usize,
    /// When the present section began.
    began: Micros,
    /// What a recording has not taken yet; nothing while none runs.
    untaken: Option<Vec<u8>>,
    /// What is said is a recording that is replayed.
    pub replays: bool,
}

impl Transcript {
    /// An empty transcript; `origin` is the engine's time 0 in microseconds since 1970, `system` what
    /// the program runs on.
    #[must_use]
    pub fn new(origin: Micros, system: &str) -> Self {
        let application = concat!("Encoderscope ", env!("CARGO_PKG_VERSION"));
        Self {
            writer: Writer::new(application, system),
            origin,
            section: Vec::new(),
            sections: VecDeque::new(),
            kept: 0,
            began: 0,
            untaken: None,
            replays: false,
        }
    }

    /// A time of the line in microseconds since 1970.
    #[must_use]
    pub const fn absolute(&self, now: Micros) -> Micros {
        match self.replays {
            true => now,
            false => self.origin + now,
        }
    }

    /// A line was opened, or goes on with another profile.
    pub fn open(&mut self, now: Micros, line: Line) {
        self.put(now, |writer, at, out| writer.open(at, line, out));
    }

    /// Bytes came.
    pub fn received(&mut self, now: Micros, bytes: &[u8], beside: bool) {
        self.put(now, |writer, at, out| {
            writer.received(at, bytes, beside, out);
        });
    }

    /// Bytes were sent.
    pub fn sent(&mut self, now: Micros, bytes: &[u8], purpose: Option<Purpose>) {
        self.put(now, |writer, at, out| writer.sent(at, bytes, purpose, out));
    }

    /// The UART complained.
    pub fn failed(&mut self, now: Micros, error: LineError) {
        self.put(now, |writer, at, out| writer.failed(at, error, out));
    }

    /// A note.
    pub fn mark(&mut self, now: Micros, note: &str) {
        self.put(now, |writer, at, out| writer.mark(at, note, out));
    }

    /// The line was closed or lost.
    pub fn close(&mut self, now: Micros, why: &str) {
        self.put(now, |writer, at, out| writer.close(at, why, out));
    }

    /// Begins a recording, which can be read without what was said before.
    pub fn begin(&mut self, now: Micros) {
        self.untaken = Some(Vec::new());
        self.turn(now);
    }

    /// What the recording has not taken yet; nothing while none runs.
    pub const fn untaken(&mut self) -> Option<&mut Vec<u8>> {
        self.untaken.as_mut()
    }

    /// Ends the recording; returns what it has not taken yet.
    pub fn end(&mut self, now: Micros, why: &str) -> Vec<u8> {
        let mut rest = self.untaken.take().unwrap_or_default();
        let at = self.origin + now;
        // The line goes on: the end belongs to the recording alone.
        self.writer.clone().end(at, why, &mut rest);
        rest
    }

    /// What was said of late, as a recording with a comment in front.
    #[must_use]
    pub fn late(&self, comment: &str) -> Vec<u8> {
        let mut file = Vec::new();
        let mut head = self.writer.clone().commented(comment);
        head.begin(&mut file);
        for (_, section) in &self.sections {
            file.extend_from_slice(section);
        }
        file.extend_from_slice(&self.section);
        file
    }

    /// How many bytes are kept, and for how long they go back, in microseconds.
    #[must_use]
    pub fn kept(&self, now: Micros) -> (usize, Micros) {
        let size = self.kept + self.section.len();
        let oldest = self.sections.front();
        let since = oldest.map_or(self.began, |(began, _)| *began);
        (size, now.saturating_sub(since))
    }

    fn put(&mut self, now: Micros, write: impl FnOnce(&mut Writer, Micros, &mut Vec<u8>)) {
        if self.replays {
            return;
        }
        if self.section.is_empty() {
            self.began = now;
        } else if self.section.len() > SECTION_LENGTH {
            self.turn(now);
        }
        let from = self.section.len();
        write(&mut self.writer, self.origin + now, &mut self.section);
        self.keep(from);
    }

    /// Begins a section.
    fn turn(&mut self, now: Micros) {
        let section = std::mem::take(&mut self.section);
        if !section.is_empty() {
            self.kept += section.len();
            self.sections.push_back((self.began, section));
        }
        while self.kept > KEPT {
            let (_, oldest) = self.sections.pop_front().unwrap_or_default();
            self.kept -= oldest.len();
        }
        self.began = now;
        self.writer.begin(&mut self.section);
        self.keep(0);
    }

    /// Lets the recording have what has been written.
    fn keep(&mut self, from: usize) {
        if let Some(untaken) = &mut self.untaken {
            untaken.extend_from_slice(&self.section[from..]);
        }
    }
}
