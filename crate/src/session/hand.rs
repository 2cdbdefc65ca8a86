//! Bytes that a person sends, and what comes back.

use super::{Micros, QUIET, TIMEOUT};
use alloc::vec::Vec;

/// More than this of an answer is not waited for.
const LONGEST: usize = 256;
/// An answer that does not end is cut off after this, in microseconds.
const PATIENCE: Micros = 500_000;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Ready(Micros),
    /// Judged at this time, and at the second one at the latest.
    Waiting(Micros, Micros),
    Ended,
}

/// Bytes sent by hand: they go out when the line has been quiet, and whatever comes until it is
/// quiet again belongs to them. What they may do is asked before ([`crate::sequence::danger`]).
///
/// ```
/// use encoderscope::session::Hand;
/// let mut hand = Hand::new(&[0x64], 0);
/// hand.handle_timeout(hand.deadline());
/// assert_eq!(hand.poll_output(), Some(vec![0x64]));
/// hand.handle_input(110_000, &[1, 2, 3]);
/// hand.handle_timeout(hand.deadline());
/// assert_eq!(hand.reply(), Some(&[1, 2, 3][..]));
/// ```
#[derive(Clone, Debug)]
pub struct Hand {
    bytes: Vec<u8>,
    /// What is to be sent now.
    output: Option<Vec<u8>>,
    received: Vec<u8>,
    state: State,
}

impl Hand {
    /// Bytes to send as soon as the line is quiet.
    #[must_use]
    pub fn new(bytes: &[u8], now: Micros) -> Self {
        Self {
            bytes: bytes.into(),
            output: None,
            received: Vec::new(),
            // What was asked before may still be answered.
            state: State::Ready(now + TIMEOUT),
        }
    }

    /// When [`Self::handle_timeout`] must be called next; never when it is over.
    #[must_use]
    pub const fn deadline(&self) -> Micros {
        match self.state {
            State::Ready(at) | State::Waiting(at, _) => at,
            State::Ended => Micros::MAX,
        }
    }

    /// Bytes have come; those before the sending belong to nobody.
    pub fn handle_input(&mut self, now: Micros, bytes: &[u8]) {
        // A line that never rests is not waited for.
        if let State::Waiting(_, end) = self.state {
            self.received.extend_from_slice(bytes);
            let full = self.received.len() >= LONGEST;
            let until = if full { now } else { end.min(now + QUIET) };
            self.state = State::Waiting(until, end);
        }
    }

    /// The time of [`Self::deadline`] has come; earlier calls do nothing.
    pub fn handle_timeout(&mut self, now: Micros) {
        match self.state {
            State::Ready(at) if now >= at => {
                self.state = State::Waiting(now + TIMEOUT, now + PATIENCE);
                self.output = Some(core::mem::take(&mut self.bytes));
            }
            State::Waiting(at, _) if now >= at => self.state = State::Ended,
            _ => {}
        }
    }

    /// The bytes, when they are to be sent.
    pub const fn poll_output(&mut self) -> Option<Vec<u8>> {
        self.output.take()
    }

    /// What has come back, once it is over.
    #[must_use]
    pub fn reply(&self) -> Option<&[u8]> {
        (self.state == State::Ended).then_some(&self.received)
    }
}
