//! Bytes that a person sends, and what comes back.

use super::{Micros, QUIET, TIMEOUT};
use alloc::vec::Vec;

/// More than this of an answer is not waited for.
const LONGEST: usize = 256;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Ready(Micros),
    Waiting(Micros),
    Ended,
}

/// Bytes sent by hand: they go out when the line has been quiet, and whatever comes until it is
/// quiet again belongs to them. What they may do is asked before ([`crate::sequence::danger`]).
///
/// ```
/// use encoderscope::session::Hand;
/// let mut hand = Hand::new(&[0x64], 0);
/// assert_eq!(hand.handle_timeout(hand.deadline()), Some(vec![0x64]));
/// hand.handle_input(30_000, &[1, 2, 3]);
/// assert_eq!(hand.handle_timeout(hand.deadline()), None);
/// assert_eq!(hand.reply(), Some(&[1, 2, 3][..]));
/// ```
#[derive(Clone, Debug)]
pub struct Hand {
    bytes: Vec<u8>,
    received: Vec<u8>,
    state: State,
}

impl Hand {
    /// Bytes to send as soon as the line is quiet.
    #[must_use]
    pub fn new(bytes: &[u8], now: Micros) -> Self {
        Self {
            bytes: bytes.into(),
            received: Vec::new(),
            // What was asked before may still be answered.
            state: State::Ready(now + QUIET),
        }
    }

    /// When [`Self::handle_timeout`] must be called next; never when it is over.
    #[must_use]
    pub const fn deadline(&self) -> Micros {
        match self.state {
            State::Ready(at) | State::Waiting(at) => at,
            State::Ended => Micros::MAX,
        }
    }

    /// Bytes have come; those before the sending belong to nobody and are returned.
    pub fn handle_input<'b>(&mut self, now: Micros, bytes: &'b [u8]) -> &'b [u8] {
        // A line that never rests is not waited for.
        let State::Waiting(until) = self.state else {
            return bytes;
        };
        self.received.extend_from_slice(bytes);
        let full = self.received.len() >= LONGEST;
        let until = if full { now } else { until.min(now + QUIET) };
        self.state = State::Waiting(until);
        &[]
    }

    /// The time of [`Self::deadline`] has come; returns what is to be sent.
    pub fn handle_timeout(&mut self, now: Micros) -> Option<Vec<u8>> {
        match self.state {
            State::Ready(at) if now >= at => {
                self.state = State::Waiting(now + TIMEOUT);
                Some(self.bytes.clone())
            }
            State::Waiting(at) if now >= at => {
                self.state = State::Ended;
                None
            }
            _ => None,
        }
    }

    /// What has come back, once it is over.
    #[must_use]
    pub fn reply(&self) -> Option<&[u8]> {
        (self.state == State::Ended).then_some(&self.received)
    }
}
