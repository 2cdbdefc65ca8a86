//! The interpreter of scripts.

use super::{Change, Expect, Holds, Script, Step, Stop};
use crate::{
    bits::Bits,
    decode::Decoder,
    format::{Format, rs485::Command, t485::NOT_UNDERSTOOD},
    layout::{Resolved, Shape},
    reading::Values,
    sequence::Send,
    session::{Micros, QUIET, TIMEOUT},
};
use alloc::{collections::VecDeque, vec::Vec};

/// At this count an encoder acts.
const TEN: u8 = 10;

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
    /// A command is out; judged at this time.
    Waiting(Micros),
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
    state: State,
    sent: Vec<u8>,
    received: Vec<u8>,
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
            Change::Memory { address, .. } => address < 128,
            _ => true,
        };
        let script = change.script(decoder.profile().format).filter(|_| fits)?;
        Some(Self {
            decoder: decoder.clone(),
            change,
            script,
            at: 0,
            state: State::Ready(now + QUIET),
            sent: Vec::new(),
            received: Vec::new(),
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
            State::Ready(at) | State::Waiting(at) => at,
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
            State::Ready(at) if self.at == 0 => self.state = State::Ready(at.max(now + QUIET)),
            State::Ready(_) => self.end(Some(Stop::Unasked)),
            State::Waiting(until) => {
                self.received.extend_from_slice(bytes);
                let quiet = match self.step().0.expect {
                    Expect::Silence => until,
                    _ => now + QUIET,
                };
                self.state = State::Waiting(quiet);
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
                self.state = State::Waiting(now + TIMEOUT);
            }
            State::Waiting(_) => self.judge(now),
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
    fn answer(&self) -> Result<Option<Values>, Stop> {
        let (step, round) = self.step();
        // A two-wire adapter returns the command in front of the reply.
        let behind = self
            .received
            .strip_prefix(self.sent.as_slice())
            .unwrap_or(&self.received);
        let expected = match step.expect {
            Expect::Silence if behind.is_empty() => return Ok(None),
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
        let reply = [self.received.as_slice(), behind]
            .into_iter()
            .find(|bytes| good(bytes));
        let Some(reply) = reply else {
            return Err(match behind.is_empty() {
                true => Stop::NoReply,
                false => Stop::BadReply,
            });
        };
        let values = layout.values(Bits::of_bytes(reply));
        match (expected, values.count) {
            (Some(expected), Some(received)) if expected != received => {
                Err(Stop::WrongCount { expected, received })
            }
            (Some(_), None) => Err(Stop::BadReply),
            _ if self.is_refusal(&values) => Err(Stop::Refused),
            _ if self.contradicts(&values) => Err(Stop::BadReply),
            _ => Ok(Some(values)),
        }
    }

    /// Whether a reply says that the command was not understood.
    fn is_refusal(&self, values: &Values) -> bool {
        let t485 = self.decoder.profile().format == Format::T485;
        t485 && values.status.unwrap_or(0) & NOT_UNDERSTOOD != 0
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
            Send::Rs485(command) => Command::reply(command),
            Send::T485(request) => request.reply(),
            Send::Bus(operation) => operation.reply(),
            Send::Address(_) | Send::NewAddress => {
                crate::format::bus::Operation::SetAddress.reply()
            }
            Send::GetNew => crate::format::bus::Operation::Get.reply(),
        };
        Resolved::new(table, Shape::of(profile))
    }

    fn end(&mut self, stop: Option<Stop>) {
        let acts = self.total() - 2;
        let out = self.state != State::Ended && matches!(self.state, State::Waiting(_));
        // The encoder acts on the command `acts`; its right answer says that it did. Commands of
        // somebody else may have made it count to ten before.
        let counted = matches!(stop, Some(Stop::WrongCount { received: TEN.., .. }));
        let holds = match self.at {
            at if at > acts => Holds::New,
            _ if counted => Holds::Unknown,
            at if at == acts && out => match stop {
                Some(Stop::WrongCount { .. }) => Holds::Old,
                _ => Holds::Unknown,
            },
            _ => Holds::Old,
        };
        self.state = State::Ended;
        self.output.push_back(Event::Ended {
            stop,
            holds,
            last: self.last,
        });
    }
}
