//! What a session rests for: sequences, searches, and bytes sent by hand.

use crate::message::{PortId, Setting};
use encoderscope::{
    finder::Finder,
    sequence::Runner,
    session::{Hand, Micros},
};

/// A conversation that is not reading.
#[derive(Debug)]
pub(super) enum Talk {
    /// A sequence that changes the encoder.
    Set(Setting, Box<Runner>),
    /// Bytes that the user sends.
    Hand(Hand),
    /// A scan of a BUS, and what it is for.
    Scan(Finder, After),
    /// A search for the encoder on a port, or for the built-in one.
    Find(Finder, Option<PortId>),
}

/// What a scan is for.
#[derive(Clone, Copy, Debug)]
pub(super) enum After {
    /// To read every device.
    Read,
    /// To be sure that one device alone takes the new address.
    Set(Setting),
}

impl Talk {
    /// When something is to be done next.
    pub(super) const fn deadline(&self) -> Micros {
        match self {
            Self::Set(_, runner) => runner.deadline(),
            Self::Hand(hand) => hand.deadline(),
            Self::Scan(finder, _) | Self::Find(finder, _) => finder.deadline(),
        }
    }

    /// Bytes have come.
    pub(super) fn handle_input(&mut self, now: Micros, bytes: &[u8]) {
        match self {
            Self::Set(_, runner) => runner.handle_input(now, bytes),
            Self::Hand(hand) => hand.handle_input(now, bytes),
            Self::Scan(finder, _) | Self::Find(finder, _) => finder.handle_input(now, bytes),
        }
    }

    /// The time of [`Self::deadline`] has come.
    pub(super) fn handle_timeout(&mut self, now: Micros) {
        match self {
            Self::Set(_, runner) => runner.handle_timeout(now),
            Self::Hand(hand) => hand.handle_timeout(now),
            Self::Scan(finder, _) | Self::Find(finder, _) => finder.handle_timeout(now),
        }
    }
}
