//! A session and an emulated encoder that talk to each other.

use encoderscope::{
    bits::Bits,
    emulator::{Emulator, Shaft},
    reading::Reading,
    session::{Micros, Output, Session},
};
use encoderscope_tests::decoder;

/// What a conversation came to.
#[derive(Debug, Default)]
pub(super) struct Log {
    pub(super) readings: Vec<(Micros, Reading)>,
    pub(super) bad: usize,
    pub(super) skipped: usize,
    pub(super) silent: usize,
    pub(super) received: usize,
    pub(super) framed: usize,
}

/// A session and an emulator on one wire, with a virtual clock.
pub(super) struct Pair {
    pub(super) session: Session,
    pub(super) emulator: Emulator,
    pub(super) now: Micros,
    /// Answers are delivered in pieces of so many bytes.
    pub(super) piece: usize,
    /// What has been asked.
    pub(super) asked: Vec<Vec<u8>>,
}

impl Log {
    /// Counts the bytes of what a session still has to say.
    pub(super) fn count(&mut self, session: &mut Session) {
        while let Some(output) = session.poll_output() {
            match output {
                Output::Frame { bytes, .. } => self.framed += bytes.len(),
                Output::Skip { bytes, .. } => self.skipped += bytes.len(),
                Output::Transmit(_) | Output::Silent { .. } => {}
            }
        }
    }
}

impl Pair {
    pub(super) fn new(parameters: &str, shaft: Shaft) -> Self {
        let decoder = decoder(parameters);
        let emulator = Emulator::new(*decoder.profile(), shaft).unwrap();
        Self {
            session: Session::new(decoder, 0).unwrap(),
            emulator,
            now: 0,
            piece: usize::MAX,
            asked: Vec::new(),
        }
    }

    pub(super) fn run(&mut self, until: Micros) -> Log {
        let mut log = Log::default();
        while self.now < until {
            self.session.handle_timeout(self.now);
            while let Some(bytes) = self.emulator.poll_output(self.now) {
                log.received += bytes.len();
                for piece in bytes.chunks(self.piece) {
                    self.session.handle_input(self.now, piece);
                    self.now += 1;
                }
            }
            while let Some(output) = self.session.poll_output() {
                match output {
                    Output::Transmit(bytes) => {
                        self.emulator.handle_input(self.now, &bytes);
                        self.asked.push(bytes);
                    }
                    Output::Frame { bytes, sure, .. } => {
                        log.framed += bytes.len();
                        let layout = self.session.decoder().layout(&bytes);
                        let reading = layout.and_then(|layout| {
                            layout.reading(Bits::of_bytes(&bytes)).ok().flatten()
                        });
                        match reading.filter(|_| sure) {
                            Some(reading) => log.readings.push((self.now, reading)),
                            None => log.bad += 1,
                        }
                    }
                    Output::Skip { bytes, .. } => log.skipped += bytes.len(),
                    Output::Silent { .. } => log.silent += 1,
                }
            }
            let next = self
                .emulator
                .deadline()
                .unwrap_or(Micros::MAX)
                .min(self.session.deadline());
            self.now = next.max(self.now + 1);
        }
        log
    }
}
