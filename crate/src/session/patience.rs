//! How long a reply is waited for.

use super::Micros;

/// How long a reply may take beyond its own bytes: request and reply may each be held back.
pub(crate) const TIMEOUT: Micros = 100_000;
const LONGEST: Micros = 800_000;
/// So many replies in a row that come within a quarter of the time show that half of it is enough.
const PROMPT: u8 = 2;

/// Doubles with every reply that is missing, for it may only be late; replies that come soon enough
/// bring it back.
#[derive(Debug)]
pub(super) struct Patience {
    time: Micros,
    prompt: u8,
}

impl Patience {
    pub(super) const fn new() -> Self {
        Self {
            time: TIMEOUT,
            prompt: 0,
        }
    }

    pub(super) const fn time(&self) -> Micros {
        self.time
    }

    /// A reply is missing.
    pub(super) fn grow(&mut self) {
        self.time = (2 * self.time).min(LONGEST);
        self.prompt = 0;
    }

    /// A reply is certain, and took so long.
    pub(super) fn answered(&mut self, latency: Micros) {
        self.prompt = match latency < self.time / 4 {
            true => self.prompt + 1,
            false => 0,
        };
        if self.prompt == PROMPT {
            self.time = (self.time / 2).max(TIMEOUT);
            self.prompt = 0;
        }
    }
}
