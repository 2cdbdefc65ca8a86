//! Sequences that change an encoder, as data, and the one interpreter that runs them.
//!
//! A [`Script`] is a table of steps: what is sent, and what must come back. The interpreter
//! ([`Runner`]) is driven like a [`crate::session::Session`]. It goes slowly on purpose: after
//! each reply the line must be quiet before the next command, so that a late, a doubled or a
//! foreign reply is seen. Anything unexpected stops it at once, with what is known of the
//! encoder: it acts on the last command alone, so until that was sent nothing has changed, and
//! when its reply is missing nobody knows. Where the encoder does not say what it has counted,
//! what is read before and afterwards must show the change.
//!
//! | script | commands | acts on | source |
//! |---|---|---|---|
//! | RS485 zero | ten pairs 0x31, 0x30; C counts 1…10 | the tenth 0x30, then 40 ms of silence | MPP "RS485", note 3 |
//! | T485 resets | ten times 0xC2, 0x62 or 0xBA | the tenth | MPP "T485", notes 3 and 4 |
//! | T485 EEPROM | 0x32 once | at once | Tamagawa |
//! | BUS zero | ten pairs *get*, *set zero*; C counts 1…10 | the tenth *set zero*, then ≤ 50 ms | MPP "BUS", set zero |
//! | BUS address | X 2 4 6 8 10 12 14 16 Y; three silent, then C = 4…10 | the tenth, then ≤ 50 ms | MPP "BUS", set address |

mod danger;
mod runner;

pub use danger::{Danger, danger};
pub use runner::{Event, Runner};

use crate::{
    format::{
        Format, TIMES,
        bus::{self, Operation},
        rs485::{self, Command},
        t485::Request,
    },
    language::{msg, t},
    profile::Profile,
    say,
    session::Micros,
};
use alloc::vec::Vec;
use core::fmt;

/// What is to be changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// The present position becomes 0 (RS485, BUS).
    Zero,
    /// The present angle becomes 0 (T485).
    ResetAngle,
    /// The turns become 0 (T485).
    ResetTurns,
    /// The errors are cleared (T485, Tamagawa only).
    ResetErrors,
    /// A byte of the EEPROM (T485, Tamagawa only).
    Memory {
        /// Its address, 0…127.
        address: u8,
        /// What it becomes.
        data: u8,
    },
    /// The address on the bus; **every** device on the wire hears it (BUS).
    Address(u8),
}

/// What a step sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Send {
    /// An RS485 command.
    Rs485(Command),
    /// A T485 request.
    T485(Request),
    /// A BUS operation for the profile's device.
    Bus(Operation),
    /// *Set address* with a fixed address.
    Address(u8),
    /// *Set address* with the new address.
    NewAddress,
    /// *Get* from the device with the new address.
    GetNew,
}

impl Send {
    /// What is sent, in a few words.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Rs485(command) => command.title(),
            Self::T485(request) => request.title(),
            Self::Bus(operation) => operation.title(),
            Self::Address(_) => Operation::SetAddress.title(),
            Self::NewAddress => msg("set address, the new one"),
            Self::GetNew => msg("position and status, from the new address"),
        }
    }
}

/// What must come back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expect {
    /// A good reply.
    Reply,
    /// A good reply that counts this round.
    CountsRound,
    /// A good reply that counts this much.
    Counts(u8),
    /// Nothing.
    Silence,
}

impl fmt::Display for Expect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reply => f.write_str(t("a good reply")),
            Self::CountsRound => f.write_str(t("a good reply that counts the round")),
            Self::Counts(count) => say!(f, "a good reply that counts {}", count),
            Self::Silence => f.write_str(t("nothing")),
        }
    }
}

/// One command of a script.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// What is sent.
    pub send: Send,
    /// What must come back.
    pub expect: Expect,
}

/// A sequence.
#[derive(Clone, Copy, Debug)]
pub struct Script {
    /// What it does, for people.
    pub title: &'static str,
    /// A command that reads, sent first: it shows that the encoder answers, and breaks off what
    /// an earlier sequence has left.
    pub before: Step,
    /// The commands of a round.
    pub round: &'static [Step],
    /// How many rounds there are; the encoder acts on the last command of the last one.
    pub rounds: u8,
    /// How long the encoder is silent afterwards, in microseconds.
    pub settles: Micros,
    /// A command that reads, sent last: it shows what the encoder holds now.
    pub after: Step,
    /// What shows that the encoder has acted.
    pub proof: Proof,
}

/// What shows that an encoder has acted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proof {
    /// It has counted to the end.
    Count,
    /// The angle read last is 0, and was not before.
    Angle,
    /// The turns read last are 0, and were not before.
    Turns,
    /// No error is read any more.
    Errors,
    /// The byte read last is the one that was written.
    Memory,
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(t(match self {
            Self::Count => msg("the encoder has counted to the end"),
            Self::Angle => msg("the angle read last is 0, and was not before"),
            Self::Turns => msg("the turns read last are 0, and were not before"),
            Self::Errors => msg("no error is read any more"),
            Self::Memory => msg("the byte read last is the one that was written"),
        }))
    }
}

const fn step(send: Send, expect: Expect) -> Step {
    Step { send, expect }
}

static RS485_ZERO: Script = Script {
    title: msg("set zero"),
    before: step(Send::Rs485(Command::Status), Expect::Reply),
    round: &[
        step(Send::Rs485(Command::Position), Expect::Reply),
        step(Send::Rs485(Command::Zero), Expect::CountsRound),
    ],
    rounds: TIMES,
    settles: rs485::STORING,
    after: step(Send::Rs485(Command::Position), Expect::Reply),
    proof: Proof::Count,
};

static T485_RESET_ANGLE: Script = Script {
    title: msg("reset angle"),
    before: step(Send::T485(Request::Angle), Expect::Reply),
    round: &[step(Send::T485(Request::ResetAngle), Expect::Reply)],
    rounds: TIMES,
    settles: 0,
    after: step(Send::T485(Request::Angle), Expect::Reply),
    proof: Proof::Angle,
};

static T485_RESET_TURNS: Script = Script {
    title: msg("reset turns"),
    before: step(Send::T485(Request::Turns), Expect::Reply),
    round: &[step(Send::T485(Request::ResetTurns), Expect::Reply)],
    after: step(Send::T485(Request::Turns), Expect::Reply),
    proof: Proof::Turns,
    ..T485_RESET_ANGLE
};

static T485_RESET_ERRORS: Script = Script {
    title: msg("reset errors"),
    round: &[step(Send::T485(Request::ResetErrors), Expect::Reply)],
    after: step(Send::T485(Request::All), Expect::Reply),
    proof: Proof::Errors,
    ..T485_RESET_ANGLE
};

/// Tamagawa encoders are busy with the EEPROM for up to 18 ms.
static T485_MEMORY: Script = Script {
    title: msg("write EEPROM"),
    before: step(Send::T485(Request::MemoryRead), Expect::Reply),
    round: &[step(Send::T485(Request::MemoryWrite), Expect::Reply)],
    rounds: 1,
    settles: 18_000,
    after: step(Send::T485(Request::MemoryRead), Expect::Reply),
    proof: Proof::Memory,
};

static BUS_ZERO: Script = Script {
    title: msg("set zero"),
    before: step(Send::Bus(Operation::Get), Expect::Reply),
    round: &[
        step(Send::Bus(Operation::Get), Expect::Reply),
        step(Send::Bus(Operation::SetZero), Expect::CountsRound),
    ],
    rounds: TIMES,
    settles: bus::STORING,
    after: step(Send::Bus(Operation::Get), Expect::Reply),
    proof: Proof::Count,
};

/// Each address is twice the count before it, so that three of them pass unanswered while the
/// bus is in use.
static BUS_ADDRESS: Script = Script {
    title: msg("set address"),
    before: step(Send::Bus(Operation::Get), Expect::Reply),
    round: &[
        step(Send::Address(0), Expect::Silence),
        step(Send::Address(2), Expect::Silence),
        step(Send::Address(4), Expect::Silence),
        step(Send::Address(6), Expect::Counts(4)),
        step(Send::Address(8), Expect::Counts(5)),
        step(Send::Address(10), Expect::Counts(6)),
        step(Send::Address(12), Expect::Counts(7)),
        step(Send::Address(14), Expect::Counts(8)),
        step(Send::Address(16), Expect::Counts(9)),
        step(Send::NewAddress, Expect::Counts(10)),
    ],
    rounds: 1,
    settles: bus::STORING,
    after: step(Send::GetNew, Expect::Reply),
    proof: Proof::Count,
};

impl Change {
    /// The script that makes this change; `None` where the encoders of a profile have none.
    #[must_use]
    pub fn script(self, profile: &Profile) -> Option<&'static Script> {
        let known = |request: Request| request.is_known_to(profile.dialect);
        match (self, profile.format) {
            (Self::Zero, Format::Rs485) => Some(&RS485_ZERO),
            (Self::Zero, Format::Bus) => Some(&BUS_ZERO),
            (Self::ResetAngle, Format::T485) => Some(&T485_RESET_ANGLE),
            (Self::ResetTurns, Format::T485) => Some(&T485_RESET_TURNS),
            (Self::ResetErrors, Format::T485) if known(Request::ResetErrors) => {
                Some(&T485_RESET_ERRORS)
            }
            (Self::Memory { .. }, Format::T485) if known(Request::MemoryWrite) => {
                Some(&T485_MEMORY)
            }
            (Self::Address(_), Format::Bus) => Some(&BUS_ADDRESS),
            _ => None,
        }
    }

    /// The bytes of a step.
    #[must_use]
    pub fn bytes(self, profile: &Profile, send: Send) -> Vec<u8> {
        let own = crate::bits::low_byte(profile.address.into());
        let new = match self {
            Self::Address(address) => address,
            _ => own,
        };
        let bus = |operation, address| Vec::from([bus::request(profile, operation, address)]);
        match send {
            Send::Rs485(command) => [command.byte()].into(),
            Send::T485(request) => {
                let (address, data) = match self {
                    Self::Memory { address, data } => (address, data),
                    _ => (0, 0),
                };
                request.bytes(profile, address, data)
            }
            Send::Bus(operation) => bus(operation, own),
            Send::Address(address) => bus(Operation::SetAddress, address),
            Send::NewAddress => bus(Operation::SetAddress, new),
            Send::GetNew => bus(Operation::Get, new),
        }
    }
}

/// What is known of the encoder when a sequence has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// The change was made.
    New,
    /// Nothing has changed.
    Old,
    /// The encoder may have acted or not: read it to see.
    Unknown,
}

impl fmt::Display for Holds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(t(match self {
            Self::New => msg("the change was made"),
            Self::Old => msg("nothing has changed in the encoder"),
            Self::Unknown => msg("the encoder may have acted or not: read it, then decide"),
        }))
    }
}

/// Why a sequence stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// Nothing came back.
    NoReply,
    /// Something came back where nothing should.
    Unasked,
    /// The reply is not one, or has something around it: a fault of the line, or a second talker.
    BadReply,
    /// The encoder counts differently: another command came in between.
    WrongCount {
        /// What it should have counted.
        expected: u8,
        /// What it counted.
        received: u8,
    },
    /// The encoder does not know the command.
    NotUnderstood,
    /// Somebody asked to stop.
    Asked,
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoReply => f.write_str(t("no reply came")),
            Self::Unasked => f.write_str(t("something came where nothing should")),
            Self::BadReply => f.write_str(t("the reply is damaged, or somebody else is talking")),
            Self::WrongCount { expected, received } => say!(
                f,
                "the encoder counts {} instead of {}: another command came between",
                received,
                expected
            ),
            Self::NotUnderstood => f.write_str(t("the encoder does not know this command")),
            Self::Asked => f.write_str(t("it was broken off")),
        }
    }
}
