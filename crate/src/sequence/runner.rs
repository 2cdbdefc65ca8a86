//! The interpreter of scripts.

use super::{Change, Expect, Holds, Proof, Script, Send, Step, Stop};
use crate::{
    bits::{self, Bits},
    decode::Decoder,
    format::{Format, TIMES, bus::Operation, t485},
    layout::{Resolved, Shape},
    reading::Values,
    session::{Micros, QUIET, TIMEOUT},
};
use alloc::{collections::VecDeque, vec::Vec};

/// How long a line that talks without being asked is borne with, in microseconds.
const PATIENCE: Micros = 1_000_000;
/// More bytes than any reply, its echo and its double.
const FLOOD: usize = 64;

/// What a running sequence has to say.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// Bytes to send.
    Transmit(Vec<u8>),
    /// A command was answered as it should be.
    Progress {
        /// Commands done.
        done: usize,
        /// Commands in all.
        total: usize,
        /// What the encoder has counted, where it says.
        count: Option<u8>,
    },
    /// The sequence is over; nothing more will be sent.
    Ended {
        /// Why it stopped early; nothing when it went through.
        stop: Option<Stop>,
        /// What is known of the encoder.
        holds: Holds,
        /// What it said last.
        last: Option<Values>,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// The next command goes out at this time, when the line has been quiet.
    Ready(Micros),
    /// A command is out since `sent`; judged at `until`.
    Waiting {
        sent: Micros,
        until: Micros,
    },
    Ended,
}

/// A sequence that is being run.
///
/// ```
/// use encoderscope::{decode::Decoder, profile::Profile, sequence::{Change, Event, Runner}};
/// let decoder = Decoder::new(Profile::parse([("format", "rs485")])?)?;
/// let mut runner = Runner::new(&decoder, Change::Zero, 0).unwrap();
/// runner.handle_timeout(runner.deadline());
/// assert_eq!(runner.poll_output(), Some(Event::Transmit(b"d".to_vec())));
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Debug)]
pub struct Runner {
    decoder: Decoder,
    change: Change,
    script: &'static Script,
    /// Which command is next; 0 is the one before, the last is the one after.
    at: usize,
    begun: Micros,
    state: State,
    sent: Vec<u8>,
    received: Vec<u8>,
    /// Whether the adapter returns what is sent, once the first reply has shown it.
    echo: Option<bool>,
    /// What was read before the first command, and last.
    first: Option<Values>,
    last: Option<Values>,
    output: VecDeque<Event>,
}

impl Runner {
    /// A sequence that begins when the line has been quiet for a while; `None` where the format
    /// has no such sequence or the value does not fit.
    #[must_use]
    pub fn new(decoder: &Decoder, change: Change, now: Micros) -> Option<Self> {
        let fits = match change {
            Change::Address(address) => address < 32,
            Change::Memory { address, .. } => address < t485::MEMORY_SIZE,
            _ => true,
        };
        let script = change.script(decoder.profile()).filter(|_| fits)?;
        Some(Self {
            decoder: decoder.clone(),
            change,
            script,
            at: 0,
            begun: now,
            // What was asked before may still be answered.
            state: State::Ready(now + TIMEOUT),
            sent: Vec::new(),
            received: Vec::new(),
            echo: None,
            first: None,
            last: None,
            output: VecDeque::new(),
        })
    }

    /// The script that runs.
    #[must_use]
    pub const fn script(&self) -> &'static Script {
        self.script
    }

    /// Commands in all, with the ones before and after.
    #[must_use]
    pub fn total(&self) -> usize {
        self.script.round.len() * usize::from(self.script.rounds) + 2
    }

    /// When [`Self::handle_timeout`] must be called next; never when the sequence has ended.
    #[must_use]
    pub const fn deadline(&self) -> Micros {
        match self.state {
            State::Ready(at) | State::Waiting { until: at, .. } => at,
            State::Ended => Micros::MAX,
        }
    }

    /// The next thing the sequence has to say.
    pub fn poll_output(&mut self) -> Option<Event> {
        self.output.pop_front()
    }

    /// Ends the sequence before its next command.
    pub fn stop(&mut self) {
        if self.state != State::Ended {
            self.end(Some(Stop::Asked));
        }
    }

    /// Bytes have come.
    pub fn handle_input(&mut self, now: Micros, bytes: &[u8]) {
        if bytes.is_empty() {
            return;
        }
        match self.state {
            // Before the first command a session may still have left something on the way.
            State::Ready(at) if self.at == 0 && now < self.begun + PATIENCE => {
                self.state = State::Ready(at.max(now + QUIET));
            }
            State::Ready(_) => self.end(Some(Stop::Unasked)),
            State::Waiting { sent, until } => {
                self.received.extend_from_slice(bytes);
                let until = match self.step().0.expect {
                    Expect::Silence => until,
                    _ if self.received.len() > FLOOD => now,
                    _ => (now + QUIET).min(sent + PATIENCE),
                };
                self.state = State::Waiting { sent, until };
            }
            State::Ended => {}
        }
    }

    /// The time of [`Self::deadline`] has come; earlier calls do nothing.
    pub fn handle_timeout(&mut self, now: Micros) {
        if now < self.deadline() {
            return;
        }
        match self.state {
            State::Ready(_) => {
                self.sent = self
                    .change
                    .bytes(self.decoder.profile(), self.step().0.send);
                self.received.clear();
                self.output.push_back(Event::Transmit(self.sent.clone()));
                self.state = State::Waiting {
                    sent: now,
                    until: now + TIMEOUT,
                };
            }
            State::Waiting { .. } => self.judge(now),
            State::Ended => {}
        }
    }

    /// The present step, and the round it belongs to, counted from 1.
    fn step(&self) -> (&'static Step, u8) {
        let script = self.script;
        let Some(index) = self.at.checked_sub(1) else {
            return (&script.before, 0);
        };
        let rounds = script.round.iter().cycle().enumerate();
        let steps = script.round.len() * usize::from(script.rounds);
        let mut steps = rounds.take(steps).skip(index);
        steps.next().map_or((&script.after, 0), |(index, step)| {
            (step, (index / script.round.len() + 1) as u8)
        })
    }

    fn judge(&mut self, now: Micros) {
        match self.answer() {
            Ok(values) => {
                self.last = values.or(self.last);
                self.first = self.first.or(values);
                self.at += 1;
                let total = self.total();
                self.output.push_back(Event::Progress {
                    done: self.at,
                    total,
                    count: values.and_then(|values| values.count),
                });
                if self.at == total {
                    return self.end(None);
                }
                let acted = self.at + 1 == total;
                let settles = if acted { self.script.settles } else { 0 };
                self.state = State::Ready(now + settles);
            }
            Err(stop) => self.end(Some(stop)),
        }
    }

    /// What the line has answered to the present step.
    fn answer(&mut self) -> Result<Option<Values>, Stop> {
        let (step, round) = self.step();
        // A two-wire adapter returns the command in front of the reply.
        let behind = self.received.strip_prefix(self.sent.as_slice());
        let only_echo = behind == Some(&[]) && self.echo != Some(false);
        let nothing = self.received.is_empty() || only_echo;
        let expected = match step.expect {
            Expect::Silence if nothing => return Ok(None),
            Expect::Silence => return Err(Stop::Unasked),
            Expect::Reply => None,
            Expect::CountsRound => Some(round),
            Expect::Counts(count) => Some(count),
        };
        let layout = self.reply(step.send);
        let echoes = self.decoder.echoes();
        let good = |bytes: &[u8]| {
            let bits = Bits::of_bytes(bytes);
            let named = !echoes || bytes.first() == self.sent.first();
            named && bits.len() == layout.len && layout.holds(bits)
        };
        let plain = self.echo != Some(true) && good(&self.received);
        let echoed = behind.filter(|bytes| self.echo != Some(false) && good(bytes));
        let reply = match echoed {
            Some(reply) => reply,
            None if plain => &self.received,
            None if nothing => return Err(Stop::NoReply),
            None => return Err(Stop::BadReply),
        };
        let values = layout.values(Bits::of_bytes(reply));
        self.echo = Some(echoed.is_some());
        let status = u64::from(values.status.unwrap_or(0));
        if self.decoder.profile().format == Format::T485 && status & t485::not_understood() != 0 {
            return Err(Stop::NotUnderstood);
        }
        match (expected, values.count) {
            (Some(expected), Some(received)) if expected != received => {
                Err(Stop::WrongCount { expected, received })
            }
            (Some(_), None) => Err(Stop::BadReply),
            _ if self.contradicts(&values) => Err(Stop::BadReply),
            _ => Ok(Some(values)),
        }
    }

    /// Whether a reply about the EEPROM names another cell, or another byte once it is written.
    fn contradicts(&self, values: &Values) -> bool {
        let Change::Memory { address, data } = self.change else {
            return false;
        };
        let other = |said: Option<u8>, meant: u8| said.is_some_and(|said| said != meant);
        other(values.memory.0, address) || self.at > 0 && other(values.memory.1, data)
    }

    /// The layout of the reply to what a step sends.
    fn reply(&self, send: Send) -> Resolved {
        let profile = *self.decoder.profile();
        let table = match send {
            Send::Rs485(command) => command.reply(),
            Send::T485(request) => request.reply(),
            Send::Bus(operation) => operation.reply(),
            Send::Address(_) | Send::NewAddress => Operation::SetAddress.reply(),
            Send::GetNew => Operation::Get.reply(),
        };
        Resolved::new(table, Shape::of(profile))
    }

    fn end(&mut self, stop: Option<Stop>) {
        // The encoder acts on the command `acts`.
        let acts = self.total() - 2;
        let out = matches!(self.state, State::Waiting { .. });
        let counted = self.script.proof == Proof::Count;
        let holds = match stop {
            None => self.proven(),
            // Commands of somebody else may have made it count to the end before.
            Some(Stop::WrongCount { received, .. }) if received >= TIMES => Holds::Unknown,
            Some(_) if self.at > acts && counted => Holds::New,
            Some(_) if self.at > acts => Holds::Unknown,
            Some(Stop::WrongCount { .. } | Stop::NotUnderstood) => Holds::Old,
            Some(_) if self.at == acts && out => Holds::Unknown,
            Some(_) => Holds::Old,
        };
        self.state = State::Ended;
        self.output.push_back(Event::Ended {
            stop,
            holds,
            last: self.last,
        });
    }

    /// What the readings before and after show.
    fn proven(&self) -> Holds {
        let (Some(first), Some(last)) = (self.first, self.last) else {
            return Holds::Unknown;
        };
        let codes = bits::codes(self.decoder.profile().angle_bits) as f64;
        // A shaft may turn a little meanwhile; what is near is within 1/64 turn.
        let near = |one: u64, other: u64| {
            let apart = (one as f64 - other as f64).abs() / codes;
            apart.min((1.0 - apart).abs()) < 1.0 / 64.0
        };
        let shown = match self.script.proof {
            Proof::Count | Proof::Memory => Some(true),
            Proof::Errors => match (last.error, last.alarm) {
                (Some(false), Some(0)) => Some(true),
                _ => None,
            },
            Proof::Angle => match (first.angle, last.angle) {
                (Some(first), Some(last)) if !near(first, 0) && near(last, 0) => Some(true),
                (Some(first), Some(last)) if !near(first, 0) && near(last, first) => Some(false),
                _ => None,
            },
            Proof::Turns => match (first.turns, last.turns) {
                (Some(first), Some(0)) if first != 0 => Some(true),
                (Some(first), Some(last)) if first != 0 && last == first => Some(false),
                _ => None,
            },
        };
        match shown {
            Some(true) => Holds::New,
            Some(false) => Holds::Old,
            None => Holds::Unknown,
        }
    }
}
