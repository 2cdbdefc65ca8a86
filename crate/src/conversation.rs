//! A sequence as a conversation that can be read line by line, an encoder of one's own answering.
//!
//! ```
//! use encoderscope::{conversation::Conversation, dump::Direction, profile::Profile, sequence::{Change, Holds}};
//! let profile = Profile::parse([("format", "rs485")])?;
//! let zero = Conversation::of(&profile, Change::Zero).unwrap();
//! let commands = zero.lines.iter().filter(|line| line.direction == Direction::Sent);
//! assert_eq!((commands.count(), zero.holds), (22, Holds::New));
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```

use crate::{
    decode::Decoder,
    dump::Direction,
    emulator::{Emulator, Shaft},
    format::{Format, rs485::Command},
    profile::Profile,
    sequence::{Change, Event, Holds, Runner},
    session::Micros,
};
use alloc::vec::Vec;

/// Longer than any sequence.
const LONGEST: Micros = 60_000_000;

/// One frame of a conversation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// When it began, in microseconds from the start.
    pub at: Micros,
    /// Which way it went.
    pub direction: Direction,
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// The profile that reads it: the reply to an RS485 command is read as what it answers.
    pub profile: Profile,
}

/// What a master and an encoder say to each other while something is changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conversation {
    /// What it does.
    pub title: &'static str,
    /// What was said, in order.
    pub lines: Vec<Line>,
    /// What the encoder holds in the end.
    pub holds: Holds,
}

impl Conversation {
    /// The conversation that makes a change; `None` where the encoders of the profile know none.
    #[must_use]
    pub fn of(profile: &Profile, change: Change) -> Option<Self> {
        let decoder = Decoder::new(*profile).ok()?;
        let mut runner = Runner::new(&decoder, change, 0)?;
        let mut encoder = Emulator::new(*profile, Shaft::still(1.25)).ok()?;
        let mut said = Self {
            title: runner.script().title,
            lines: Vec::new(),
            holds: Holds::Unknown,
        };
        let mut reads = *profile;
        let mut now = runner.deadline();
        let begun = now;
        while now < LONGEST {
            runner.handle_timeout(now);
            while let Some(bytes) = encoder.poll_output(now) {
                runner.handle_input(now, &bytes);
                said.hear(now - begun, bytes, reads);
            }
            while let Some(event) = runner.poll_output() {
                match event {
                    Event::Transmit(bytes) => {
                        encoder.handle_input(now, &bytes);
                        reads = answered(profile, &bytes);
                        said.lines.push(Line {
                            at: now - begun,
                            direction: Direction::Sent,
                            bytes,
                            profile: reads,
                        });
                    }
                    Event::Progress { .. } => {}
                    Event::Ended { holds, .. } => return Some(Self { holds, ..said }),
                }
            }
            let next = encoder.deadline().unwrap_or(Micros::MAX);
            now = next.min(runner.deadline()).max(now + 1);
        }
        Some(said)
    }

    /// Bytes of a reply may come one by one.
    fn hear(&mut self, at: Micros, bytes: Vec<u8>, profile: Profile) {
        match self.lines.last_mut() {
            Some(line) if line.direction == Direction::Received => line.bytes.extend(bytes),
            _ => self.lines.push(Line {
                at,
                direction: Direction::Received,
                bytes,
                profile,
            }),
        }
    }
}

/// The profile that reads the reply to a request.
fn answered(profile: &Profile, request: &[u8]) -> Profile {
    let asked = request.first().and_then(|byte| Command::of_byte(*byte));
    match (profile.format, asked) {
        (Format::Rs485, Some(command)) => Profile {
            command,
            ..*profile
        },
        _ => *profile,
    }
}

impl Change {
    /// What can be changed in the encoders of a profile, with an address and a byte as examples.
    ///
    /// ```
    /// use encoderscope::{format::Format, sequence::Change};
    /// let all = Change::all(&Format::Bus.default_profile());
    /// assert_eq!(all, [Change::Zero, Change::Address(2)]);
    /// ```
    #[must_use]
    pub fn all(profile: &Profile) -> Vec<Self> {
        let known = [
            Self::Zero,
            Self::ResetAngle,
            Self::ResetTurns,
            Self::ResetErrors,
            Self::Memory {
                address: 0x10,
                data: 0x2a,
            },
            Self::Address(2),
        ];
        let mut known = Vec::from(known);
        known.retain(|change| change.script(profile).is_some());
        known
    }
}
