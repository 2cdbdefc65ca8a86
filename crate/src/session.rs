//! The host's side of a serial line: requests, replies, time-outs and echo, or listening to a
//! stream, without any I/O.
//!
//! Feed what arrives to [`Session::handle_input`], call [`Session::handle_timeout`] when
//! [`Session::deadline`] has come, then drain [`Session::poll_output`]. Time is in microseconds
//! of any clock that does not run backwards. A session only ever sends requests that read
//! ([`Ask`]); what changes an encoder is a [`crate::sequence`].
//!
//! Two-wire adapters may return the request before the reply, and a reply of T485 or BUS starts
//! with the same byte as the request. The first replies are therefore awaited until the line is
//! quiet: one byte more than a reply, the request in front and a check that holds behind it are
//! an echo. After three replies that agree the session knows, and no longer waits.
//!
//! A reply is only sure when it comes alone: the line must be quiet before the first request,
//! and what comes unasked, or in excess of a reply, makes the session wait for silence. A
//! reply that is missing may still be on its way, so the next one is not sure, and the
//! patience grows until replies and requests pair up again; replies that come soon bring it back.
//! Every few seconds the session listens a little longer before it asks, so that a reply too many
//! is found out.

mod ask;
mod hand;
mod judge;
mod output;
mod patience;

pub use ask::{Ask, Refusal};
pub use hand::Hand;
pub use output::{Echo, Output};

use crate::{
    decode::Decoder,
    format::{Format, Link, bus},
    framing::{Framer, Why},
};
use alloc::{collections::VecDeque, vec::Vec};
use output::reported;
use patience::Patience;
pub(crate) use patience::TIMEOUT;

/// Microseconds.
pub type Micros = u64;

/// Longest a USB adapter holds bytes back, with room: FTDI's latency timer is 16 ms.
pub(crate) const QUIET: Micros = 20_000;
/// A stream that says nothing for so long is silent.
const SILENCE: Micros = 500_000;
/// Now and then a session listens before it asks, so that a reply too many does not stay in front
/// of all others: this often, and for so many times the last latency.
const LISTEN_EVERY: Micros = 5_000_000;
const LISTEN_TIMES: Micros = 4;
/// What is asked once is asked so often at most, until its reply is certain.
const TRIES: u8 = 3;
/// Replies that must agree before echo is taken as known.
const AGREE: u8 = 3;
/// More than any reply: the line is talking without being asked.
const FLOOD: usize = 64;

#[derive(Clone, Copy, Debug)]
enum State {
    /// Nothing has been asked yet.
    Fresh,
    /// The next request goes out at this time.
    Idle(Micros),
    /// A request is out since `sent`; judged at `until` whatever has come.
    Waiting { sent: Micros, until: Micros },
    /// Before the first request and when something went wrong: wait until nothing has come for
    /// a while.
    Draining(Micros),
    /// A stream is listened to; silent when nothing has come by this time.
    Listening(Micros),
}

/// A conversation with one encoder.
///
/// ```
/// use encoderscope::{decode::Decoder, profile::Profile, session::{Output, Session}};
/// let decoder = Decoder::new(Profile::parse([("format", "t485")])?)?;
/// let mut session = Session::new(decoder, 0).unwrap();
/// session.handle_timeout(0);
/// session.handle_timeout(session.deadline());
/// assert_eq!(session.poll_output(), Some(Output::Transmit(vec![0x1a])));
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Debug)]
pub struct Session {
    decoder: Decoder,
    /// What is asked in turn; nothing for a stream.
    polls: Vec<Ask>,
    /// Which of them is next.
    turn: usize,
    /// What is asked once, before the next poll; the first stays until its reply is certain.
    once: VecDeque<Ask>,
    /// How often the first of them has been asked.
    tries: u8,
    /// What is being asked.
    asked: Ask,
    interval: Micros,
    state: State,
    echo: Echo,
    votes: u8,
    patience: Patience,
    /// A reply was missing and may still come: the request that it answers.
    late: Option<Vec<u8>>,
    /// When the session last listened before it asked.
    listened: Micros,
    received: Vec<u8>,
    framer: Framer,
    output: VecDeque<Output>,
}

impl Session {
    /// A session that asks every `interval` microseconds, or with 0 as soon as it has the reply;
    /// a stream is listened to.
    ///
    /// # Errors
    ///
    /// The format has no serial line, or its command would change the encoder.
    pub fn new(decoder: Decoder, interval: Micros) -> Result<Self, Refusal> {
        let profile = decoder.profile();
        let polls = match profile.link() {
            Link::Clocked => return Err(Refusal::NotSerial(profile.format)),
            Link::Stream => Vec::new(),
            Link::Polled => Vec::from([Ask::position(&decoder)?]),
        };
        Ok(Self::with(decoder, polls, interval))
    }

    /// A session that reads several BUS devices in turn; with none it only waits to be asked.
    ///
    /// # Errors
    ///
    /// The format is not BUS.
    pub fn of_devices(
        decoder: Decoder,
        addresses: &[u8],
        interval: Micros,
    ) -> Result<Self, Refusal> {
        let polls = addresses
            .iter()
            .map(|address| Ask::device(&decoder, *address))
            .collect::<Result<_, _>>()?;
        Ok(Self::with(decoder, polls, interval))
    }

    /// A session that asks nothing itself: it reads along while another host asks
    /// ([`Self::handle_sent`]), or listens to a stream.
    ///
    /// # Errors
    ///
    /// The format has no serial line.
    pub fn following(decoder: Decoder) -> Result<Self, Refusal> {
        match decoder.profile().link() {
            Link::Clocked => Err(Refusal::NotSerial(decoder.profile().format)),
            Link::Stream | Link::Polled => Ok(Self::with(decoder, Vec::new(), 0)),
        }
    }

    fn with(decoder: Decoder, polls: Vec<Ask>, interval: Micros) -> Self {
        Self {
            decoder,
            asked: polls.first().cloned().unwrap_or_default(),
            polls,
            turn: 0,
            once: VecDeque::new(),
            tries: 0,
            interval,
            state: State::Fresh,
            echo: Echo::Unknown,
            votes: 0,
            patience: Patience::new(),
            late: None,
            listened: 0,
            received: Vec::new(),
            framer: Framer::joining(),
            output: VecDeque::new(),
        }
    }

    /// Asks once, before the next poll; the answer is a [`Output::Frame`] like any other. Where none
    /// comes that is certain, it is asked again, three times in all.
    ///
    /// # Errors
    ///
    /// The request belongs to another format, in which its bytes may mean anything.
    pub fn ask(&mut self, ask: Ask) -> Result<(), Refusal> {
        let format = self.decoder.profile().format;
        if ask.format != Some(format) {
            return Err(Refusal::NotOf(format));
        }
        self.once.push_back(ask);
        if let State::Idle(Micros::MAX) = self.state {
            self.state = State::Idle(0);
        }
        Ok(())
    }

    /// Asks every `interval` microseconds from now on.
    pub const fn set_interval(&mut self, interval: Micros) {
        self.interval = interval;
    }

    /// Lets the line rest, or end: everything that has come is reported, what has come of a reply as
    /// skipped, and the next request waits until the line has been quiet.
    ///
    /// ```
    /// use encoderscope::{decode::Decoder, framing::Why, profile::Profile, session::{Output, Session}};
    /// let decoder = Decoder::new(Profile::parse([("format", "period")])?)?;
    /// let mut session = Session::new(decoder, 0).unwrap();
    /// session.handle_input(0, &[7]);
    /// session.rest();
    /// let Some(Output::Skip { bytes, .. }) = session.poll_output() else { panic!() };
    /// assert_eq!(bytes, [7]);
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    pub fn rest(&mut self) {
        let bytes = core::mem::take(&mut self.received);
        self.skip(&bytes, Why::NoFrame);
        self.join();
        self.state = State::Fresh;
    }

    /// Ends what has come of a stream, and joins it anew: what comes after a rest, or a silence, does
    /// not continue what came before.
    fn join(&mut self) {
        let mut framer = core::mem::replace(&mut self.framer, Framer::joining());
        let output = &mut self.output;
        framer.finish(&self.decoder, &mut |piece| {
            output.push_back(reported(&piece));
        });
    }

    /// The decoder that reads the replies.
    #[must_use]
    pub const fn decoder(&self) -> &Decoder {
        &self.decoder
    }

    /// What is known of echo.
    #[must_use]
    pub const fn echo(&self) -> Echo {
        self.echo
    }

    /// When [`Self::handle_timeout`] must be called next.
    #[must_use]
    pub const fn deadline(&self) -> Micros {
        match self.state {
            State::Fresh => 0,
            State::Idle(at) | State::Draining(at) | State::Listening(at) => at,
            State::Waiting { until, .. } => until,
        }
    }

    /// The next thing the session has to say.
    pub fn poll_output(&mut self) -> Option<Output> {
        self.output.pop_front()
    }

    /// Bytes have come.
    pub fn handle_input(&mut self, now: Micros, bytes: &[u8]) {
        if self.is_stream() {
            self.state = State::Listening(now + SILENCE);
            return self.listen(bytes);
        }
        match self.state {
            State::Listening(_) | State::Fresh | State::Idle(_) | State::Draining(_) => {
                self.skip(bytes, Why::Unasked);
                let next = match self.deadline() {
                    Micros::MAX => now,
                    next => next,
                };
                self.state = State::Draining(next.max(now + QUIET));
            }
            State::Waiting { sent, until } => {
                self.received.extend_from_slice(bytes);
                let offset = usize::from(self.echo == Echo::Present);
                let offset = offset * self.asked.bytes.len();
                let whole = self.received.len() >= self.asked.reply + offset;
                let exact = self.received.len() == self.asked.reply + offset;
                let plain = self.received.get(..offset) == self.asked.bytes.get(..offset);
                let known = self.echo != Echo::Unknown && !self.may_be_late();
                if known && exact && plain && self.holds_at(offset) {
                    self.accept(now, sent, offset);
                } else if self.received.len() > FLOOD {
                    self.judge(now, sent);
                } else if whole {
                    self.state = State::Waiting {
                        sent,
                        until: until.min(now + QUIET),
                    };
                }
            }
        }
    }

    /// The time of [`Self::deadline`] has come; earlier calls do nothing.
    pub fn handle_timeout(&mut self, now: Micros) {
        if now < self.deadline() {
            return;
        }
        match self.state {
            State::Fresh if self.is_stream() => self.state = State::Listening(now + SILENCE),
            State::Listening(_) => {
                self.join();
                self.output.push_back(Output::Silent { echo: false });
                self.state = State::Listening(now + SILENCE);
            }
            State::Fresh => self.state = State::Draining(now + QUIET),
            State::Idle(_) | State::Draining(_) => {
                let Some(ask) = self.next_ask() else {
                    self.state = State::Idle(Micros::MAX);
                    return;
                };
                self.put(now, ask);
            }
            State::Waiting { sent, .. } => self.judge(now, sent),
        }
    }

    /// Another host has sent this; what it asks is waited for like a request of one's own.
    ///
    /// ```
    /// use encoderscope::{decode::Decoder, profile::Profile, session::{Output, Session}};
    /// let decoder = Decoder::new(Profile::parse([("format", "t485")])?)?;
    /// let mut session = Session::following(decoder).unwrap();
    /// session.handle_sent(0, &[0x1a]);
    /// assert_eq!(session.poll_output(), Some(Output::Transmit(vec![0x1a])));
    /// session.handle_input(400, &[0x1a, 0x20, 0x29, 0xc0, 0x3b, 0x17, 0, 0, 0, 0xc8, 0x37]);
    /// session.handle_sent(1_000, &[0x1a]);
    /// assert!(matches!(session.poll_output(), Some(Output::Frame { sure: true, .. })));
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    pub fn handle_sent(&mut self, now: Micros, bytes: &[u8]) {
        if let State::Waiting { sent, .. } = self.state {
            self.judge(now, sent);
        }
        match Ask::of_bytes(&self.decoder, bytes) {
            Some(ask) => self.put(now, ask),
            None => {
                self.output.push_back(Output::Transmit(bytes.into()));
                self.state = State::Draining(now + QUIET);
            }
        }
    }

    /// Asks.
    fn put(&mut self, now: Micros, ask: Ask) {
        self.asked = ask;
        let request = self.asked.bytes.clone();
        let bits = 10 * (self.asked.reply + 2 * request.len()) as u64;
        let on_wire = bits * 1_000_000 / u64::from(self.decoder.profile().baud);
        self.output.push_back(Output::Transmit(request));
        self.state = State::Waiting {
            sent: now,
            until: now + on_wire + self.patience.time(),
        };
    }

    fn next_ask(&mut self) -> Option<Ask> {
        if let Some(ask) = self.once.front() {
            self.tries += 1;
            return Some(ask.clone());
        }
        let ask = self.polls.get(self.turn).cloned()?;
        self.turn = (self.turn + 1) % self.polls.len();
        Some(ask)
    }

    fn is_stream(&self) -> bool {
        self.decoder.profile().link() == Link::Stream
    }

    /// Cuts a stream into frames.
    fn listen(&mut self, bytes: &[u8]) {
        let output = &mut self.output;
        self.framer.push(&self.decoder, bytes, &mut |piece| {
            output.push_back(reported(&piece));
        });
    }

    /// When the next request may go out after one at `sent`: devices that heard another's
    /// address are deaf for a while.
    fn next_request(&self, now: Micros, sent: Micros) -> Micros {
        let profile = self.decoder.profile();
        let deaf = match profile.format {
            Format::Bus => 10_000_000 / u64::from(profile.baud) + bus::suspend(profile),
            _ => 0,
        };
        now.max(sent + self.interval).max(sent + deaf)
    }
}
