//! Which encoder is on the line: listens and asks at the baud rates of the manuals, and ranks what
//! fits by evidence. Like [`crate::session::Session`] it does no I/O.
//!
//! At each rate it listens first, since free-running encoders tell by themselves; where the line
//! is quiet it asks what only reads ([`crate::session::Ask`]), one request at a time, and waits until the line is
//! quiet again. Requests go out only at rates so far apart that a device at another one of the
//! manuals hears zeros at most, and of RS485 only `d`, `s` and `t`: the byte of `1` is *set zero*
//! to a device of a BUS. An adapter that runs at a rate in between could turn a request
//! into a command; it takes ten of those in a row to change anything, so no request is
//! repeated before others have gone out, nor where nothing intelligible came back.
//!
//! | baud | listens | asks |
//! |---|---|---|
//! | 2 500 000 | PERIOD | T485 *all*, *angle*; RS485 `d`, `s`, `t`; BUS *get* to all 32 addresses |
//! | 115 200 | PERIOD | RS485 `d`, `s`, `t` |
//! | 230 400 | ASI1, ASI4 | nothing |
//!
//! The format and the widths in bytes follow from length and checks. Bits per turn do not
//! while the shaft stands still, unless the encoder names them: what is left open is said.

mod requests;
mod weigh;

pub use requests::requests;

use crate::{
    detect::{LEAD, LIKELY, Verdict},
    format::Format,
    profile::Profile,
    session::{Micros, QUIET, TIMEOUT},
};
use alloc::{collections::VecDeque, string::String, vec::Vec};
use weigh::{Asked, Weighed};
pub(crate) use weigh::{explain_replies, streams};

/// How long a line is listened to before anything is asked, in microseconds.
const LISTEN: Micros = 300_000;
/// Fewer bytes than these while nothing was asked are no stream.
const STREAM: usize = 24;
/// More than these are not looked at.
const ENOUGH: usize = 4_096;
/// How long a device of a BUS may take when all addresses are asked in turn.
const SCAN_TIMEOUT: Micros = 50_000;
/// How long a line that talks is borne with before it is asked anything, in microseconds.
const PATIENCE: Micros = 1_000_000;
/// How often what has been answered is asked again.
const ROUNDS: usize = 12;

/// What is tried at a baud rate.
#[derive(Clone, Copy, Debug)]
struct Plan {
    baud: u32,
    asks: &'static [Format],
}

static PLANS: &[Plan] = &[
    Plan {
        baud: 2_500_000,
        asks: &[Format::T485, Format::Rs485, Format::Bus],
    },
    Plan {
        baud: 115_200,
        asks: &[Format::Rs485],
    },
    Plan {
        baud: 230_400,
        asks: &[],
    },
];

/// What a finder has to say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// Open the port at this baud rate, then call [`Finder::handle_opened`].
    Open(u32),
    /// Bytes to send.
    Transmit(Vec<u8>),
    /// The search is over.
    Ended,
}

/// An encoder that may be on the line.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// How to read it; its angle is as wide as it can be.
    pub profile: Profile,
    /// How sure the format is.
    pub verdict: Verdict,
    /// Why, in sentences.
    pub evidence: Vec<String>,
    /// The fewest bits per turn that the angles fit in; equal to those of the profile where the
    /// width is known.
    pub narrowest: u32,
    /// The addresses that answered, of a BUS.
    pub addresses: Vec<u8>,
    pub(crate) score: i32,
}

/// What was tried, and what came of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trial {
    /// At which baud rate.
    pub baud: u32,
    /// What was asked; nothing while it only listened.
    pub format: Option<Format>,
    /// Requests sent.
    pub requests: u32,
    /// Bytes that came.
    pub bytes: usize,
    /// Whether it was tried at all: the adapter may not make the rate.
    pub tried: bool,
}

impl Trial {
    const fn left_out(plan: &Plan) -> Self {
        Self {
            baud: plan.baud,
            format: None,
            requests: 0,
            bytes: 0,
            tried: false,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// The port is being opened.
    Opening,
    /// Nothing is asked until then.
    Listening {
        since: Micros,
        until: Micros,
    },
    /// The next request goes out at this time, when the line has been quiet, which is waited for
    /// until the second one.
    Ready(Micros, Micros),
    /// A request is out; what has come is judged at this time, and at the second one at the latest.
    Waiting(Micros, Micros),
    Ended,
}

/// A search for the encoder on a line.
///
/// ```
/// use encoderscope::finder::{Finder, Output};
/// let mut finder = Finder::new();
/// assert_eq!(finder.poll_output(), Some(Output::Open(2_500_000)));
/// finder.handle_opened(0);
/// assert!(finder.deadline() > 0 && finder.found().is_empty());
/// ```
#[derive(Debug)]
pub struct Finder {
    /// What is still to be tried, the present plan first.
    plans: VecDeque<Plan>,
    /// The formats still to be asked at this baud rate, the present one first.
    formats: VecDeque<Format>,
    /// What is asked of a BUS that is known.
    known: Option<Profile>,
    /// Requests still to be sent, by their place in the list of the format.
    queue: VecDeque<usize>,
    round: usize,
    asked: Asked,
    state: State,
    received: Vec<u8>,
    /// Bytes since the present listening or asking began.
    heard: usize,
    /// The line was never quiet.
    restless: bool,
    trials: Vec<Trial>,
    found: Vec<Found>,
    /// Addresses of a BUS at which something came that no check holds for.
    disturbed: Vec<u8>,
    output: VecDeque<Output>,
}

impl Default for Finder {
    fn default() -> Self {
        Self::new()
    }
}

impl Finder {
    /// A search over all formats that come over a serial line.
    #[must_use]
    pub fn new() -> Self {
        Self::through(|_| true)
    }

    /// The same through an adapter that makes some baud rates; others are left out, since what is
    /// sent at a wrong rate may be heard as anything.
    pub fn through(makes: impl Fn(u32) -> bool) -> Self {
        let (plans, left_out) = PLANS.iter().partition::<Vec<_>, _>(|plan| makes(plan.baud));
        let mut finder = Self {
            plans: plans.into_iter().copied().collect(),
            formats: VecDeque::new(),
            known: None,
            queue: VecDeque::new(),
            round: 0,
            asked: Asked::default(),
            state: State::Opening,
            received: Vec::new(),
            heard: 0,
            restless: false,
            trials: left_out.into_iter().map(Trial::left_out).collect(),
            found: Vec::new(),
            disturbed: Vec::new(),
            output: VecDeque::new(),
        };
        finder.open();
        finder
    }

    /// A search for the devices of a BUS on a line that is open; `None` where the profile is
    /// not one of a BUS.
    #[must_use]
    pub fn scan(profile: &Profile, now: Micros) -> Option<Self> {
        if profile.format != Format::Bus {
            return None;
        }
        let mut finder = Self::new();
        finder.output.clear();
        finder.plans = VecDeque::from([Plan {
            baud: profile.baud,
            asks: &[Format::Bus],
        }]);
        finder.known = Some(*profile);
        finder.formats = VecDeque::from([Format::Bus]);
        // What was asked before may still be answered.
        finder.begin(now + TIMEOUT);
        Some(finder)
    }

    /// What was found so far, best first.
    #[must_use]
    pub fn found(&self) -> &[Found] {
        &self.found
    }

    /// What was tried so far.
    #[must_use]
    pub fn trials(&self) -> &[Trial] {
        &self.trials
    }

    /// The addresses of a BUS at which something came that no check holds for: a device that is
    /// disturbed, or two with one address.
    #[must_use]
    pub fn disturbed(&self) -> &[u8] {
        &self.disturbed
    }

    /// Whether something talked all the time that could not be read.
    #[must_use]
    pub const fn is_restless(&self) -> bool {
        self.restless
    }

    /// When [`Self::handle_timeout`] must be called next; never while the port is being opened
    /// and when the search is over.
    #[must_use]
    pub const fn deadline(&self) -> Micros {
        match self.state {
            State::Opening | State::Ended => Micros::MAX,
            State::Listening { until, .. } | State::Ready(until, _) | State::Waiting(until, _) => {
                until
            }
        }
    }

    /// The next thing the search has to say.
    pub fn poll_output(&mut self) -> Option<Output> {
        self.output.pop_front()
    }

    /// The port is open at the baud rate that was asked for.
    pub fn handle_opened(&mut self, now: Micros) {
        if self.state == State::Opening {
            self.received.clear();
            self.heard = 0;
            self.try_next(None);
            self.state = State::Listening {
                since: now,
                until: now + LISTEN,
            };
        }
    }

    /// Bytes have come.
    pub fn handle_input(&mut self, now: Micros, bytes: &[u8]) {
        if let Some(trial) = self.trials.last_mut() {
            trial.bytes += bytes.len();
        }
        self.heard += bytes.len();
        if self.received.len() < ENOUGH {
            self.received.extend_from_slice(bytes);
        }
        match self.state {
            State::Ready(at, end) => {
                self.state = State::Ready(at.max(now + QUIET).min(end.max(at)), end);
            }
            State::Waiting(_, end) => self.state = State::Waiting(end.min(now + QUIET), end),
            State::Opening | State::Listening { .. } | State::Ended => {}
        }
    }

    /// The time of [`Self::deadline`] has come; earlier calls do nothing.
    pub fn handle_timeout(&mut self, now: Micros) {
        if now < self.deadline() {
            return;
        }
        match self.state {
            State::Opening | State::Ended => {}
            State::Listening { since, .. } => self.judge_stream(now, now - since),
            State::Ready(_, end) if now >= end && !self.received.is_empty() => {
                self.judge_stream(now, PATIENCE);
            }
            State::Ready(..) => self.ask(now),
            State::Waiting(..) => {
                if let Some(index) = self.queue.pop_front() {
                    let reply = core::mem::take(&mut self.received);
                    self.asked.answered(index, reply);
                }
                self.ready(now);
            }
        }
    }

    fn ready(&mut self, at: Micros) {
        self.received.clear();
        self.heard = 0;
        self.state = State::Ready(at, at + PATIENCE);
    }

    fn plan(&self) -> Option<Plan> {
        self.plans.front().copied()
    }

    /// Asks for the port at the baud rate of the present plan.
    fn open(&mut self) {
        match self.plan() {
            Some(plan) => {
                self.formats = plan.asks.iter().copied().collect();
                self.state = State::Opening;
                self.output.push_back(Output::Open(plan.baud));
            }
            None => self.end(),
        }
    }

    fn next_plan(&mut self) {
        self.plans.pop_front();
        self.open();
    }

    fn end(&mut self) {
        self.state = State::Ended;
        self.output.push_back(Output::Ended);
    }

    fn try_next(&mut self, format: Option<Format>) {
        let baud = self.plan().map_or(0, |plan| plan.baud);
        self.trials.push(Trial {
            baud,
            format,
            requests: 0,
            bytes: 0,
            tried: true,
        });
    }

    /// What came while nothing was asked is a stream, or noise, or nothing.
    fn judge_stream(&mut self, now: Micros, took: Micros) {
        let bytes = core::mem::take(&mut self.received);
        let baud = self.plan().map_or(0, |plan| plan.baud);
        let total = core::mem::take(&mut self.heard);
        let asking = matches!(self.state, State::Ready(..));
        if self.keep(streams(baud, &bytes, total, took)) {
            self.end();
        } else if asking || bytes.len() >= STREAM {
            // Something talks that cannot be read: it would talk into every reply.
            self.restless = true;
            self.next_plan();
        } else {
            self.begin(now);
        }
    }

    /// Begins to ask the next format, or goes on with the next plan.
    fn begin(&mut self, now: Micros) {
        let Some(format) = self.formats.front().copied() else {
            return self.next_plan();
        };
        let baud = self.plan().map_or(0, |plan| plan.baud);
        self.asked = Asked::new(format, baud, self.known);
        self.try_next(Some(format));
        self.round = 0;
        self.queue = (0..self.asked.len()).collect();
        self.ready(now);
    }

    /// Sends the next request of the round, or judges what has come.
    fn ask(&mut self, now: Micros) {
        self.received.clear();
        if let Some(index) = self.queue.front() {
            let scans = self.asked.format() == Some(Format::Bus) && *index > 0;
            let timeout = if scans { SCAN_TIMEOUT } else { TIMEOUT };
            if let Some(trial) = self.trials.last_mut() {
                trial.requests += 1;
            }
            self.output
                .push_back(Output::Transmit(self.asked.request(*index).into()));
            self.state = State::Waiting(now + timeout, now + timeout + PATIENCE);
            return;
        }
        self.round += 1;
        if self.round < ROUNDS {
            self.queue = self.asked.worth_asking(self.round);
        }
        if !self.queue.is_empty() {
            return;
        }
        self.formats.pop_front();
        let Weighed { found, disturbed } = self.asked.weigh();
        self.disturbed.extend(disturbed);
        if self.keep(found) {
            self.end();
        } else {
            self.begin(now);
        }
    }

    /// Keeps what was found; returns whether nothing else can be on the line.
    fn keep(&mut self, mut found: Vec<Found>) -> bool {
        self.found.append(&mut found);
        self.found.sort_by_key(|found| -found.score);
        let best = self.found.first().map_or(0, |found| found.score);
        let rivals = self
            .found
            .iter()
            .filter(|found| best - found.score < LEAD)
            .count();
        if rivals > 1 {
            for found in self.found.iter_mut().take(rivals) {
                found.verdict = Verdict::Ambiguous;
            }
        }
        for found in self.found.iter_mut().skip(rivals) {
            found.verdict = Verdict::Unlikely;
        }
        best >= LIKELY
    }
}
