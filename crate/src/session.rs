//! The host's side of a polled format: requests, replies, time-outs and echo, without any I/O.
//!
//! Feed what arrives to [`Session::handle_input`], call [`Session::handle_timeout`] when
//! [`Session::deadline`] has come, then drain [`Session::poll_output`]. Time is in microseconds
//! of any clock that does not run backwards. A session only ever sends its one reading request;
//! it cannot be made for one that changes the encoder.
//!
//! Two-wire adapters may return the request before the reply, and a T485 reply starts with the
//! same byte as the request. The first replies are therefore awaited until the line is quiet:
//! one byte more than a reply, the request in front and a check that holds behind it are an
//! echo. After three replies that agree the session knows, and no longer waits.
//!
//! A reply is only sure when it comes alone: the line must be quiet before the first request,
//! and what comes unasked, or in excess of a reply, makes the session wait for silence. A
//! reply that is missing may still be on its way, so the next one is not sure, and the
//! patience grows until replies and requests pair up again.

use crate::{
    bits::Bits,
    decode::Decoder,
    format::{Format, t485},
    framing::Why,
};
use alloc::{collections::VecDeque, vec::Vec};
use core::fmt;

/// Microseconds.
pub type Micros = u64;

/// Longest a USB adapter holds bytes back, with room: FTDI's latency timer is 16 ms.
const QUIET: Micros = 20_000;
/// How long a reply may take beyond its own bytes: request and reply may each be held back.
/// It doubles with every reply that is missing, up to the longest.
const TIMEOUT: Micros = 100_000;
const LONGEST_TIMEOUT: Micros = 800_000;
/// Replies that must agree before echo is taken as known.
const AGREE: u8 = 3;
/// More than any reply: the line is talking without being asked.
const FLOOD: usize = 64;

/// What a session has to say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// Bytes to send.
    Transmit(Vec<u8>),
    /// A reply of the right length.
    Frame {
        /// Its bytes.
        bytes: Vec<u8>,
        /// Whether it stood where the reply must stand.
        sure: bool,
        /// Time from the request.
        latency: Micros,
    },
    /// Bytes that belong to no reply.
    Skip {
        /// The bytes.
        bytes: Vec<u8>,
        /// Why.
        why: Why,
    },
    /// Nothing came back, or nothing but the echo of the request.
    Silent {
        /// Whether the request came back.
        echo: bool,
    },
}

/// Whether the adapter returns what it sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Echo {
    /// Not known yet.
    Unknown,
    /// Only replies come back.
    Absent,
    /// The request comes back before the reply.
    Present,
}

/// Why there is no session for a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The format is not polled over a serial line.
    NotPolled(Format),
    /// The request would change the encoder.
    ChangesEncoder(u8),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPolled(format) => {
                write!(
                    f,
                    "{} is not read over a serial port: paste a dump instead",
                    format.title()
                )
            }
            Self::ChangesEncoder(byte) => {
                write!(
                    f,
                    "0x{byte:02X} changes the encoder and is never sent by polling"
                )
            }
        }
    }
}

impl core::error::Error for Refusal {}

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
    request: u8,
    /// Bytes of the reply.
    reply: usize,
    interval: Micros,
    state: State,
    echo: Echo,
    votes: u8,
    timeout: Micros,
    /// A reply was missing and may still come.
    late: bool,
    received: Vec<u8>,
    output: VecDeque<Output>,
}

impl Session {
    /// A session that asks every `interval` microseconds, or with 0 as soon as it has the reply.
    ///
    /// # Errors
    ///
    /// The format is not polled, or its command would change the encoder.
    pub fn new(decoder: Decoder, interval: Micros) -> Result<Self, Refusal> {
        let profile = decoder.profile();
        let (request, changes) = match profile.format {
            Format::T485 => (
                t485::Request::All.byte(),
                t485::Request::All.changes_encoder(),
            ),
            Format::Rs485 => (profile.command.byte(), profile.command.changes_encoder()),
            Format::BissC => return Err(Refusal::NotPolled(profile.format)),
        };
        if changes {
            return Err(Refusal::ChangesEncoder(request));
        }
        let reply = decoder.layout(request).map_or(0, |layout| layout.len / 8);
        Ok(Self {
            decoder,
            request,
            reply,
            interval,
            state: State::Fresh,
            echo: Echo::Unknown,
            votes: 0,
            timeout: TIMEOUT,
            late: false,
            received: Vec::new(),
            output: VecDeque::new(),
        })
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
            State::Idle(at) | State::Draining(at) => at,
            State::Waiting { until, .. } => until,
        }
    }

    /// The next thing the session has to say.
    pub fn poll_output(&mut self) -> Option<Output> {
        self.output.pop_front()
    }

    /// Bytes have come.
    pub fn handle_input(&mut self, now: Micros, bytes: &[u8]) {
        match self.state {
            State::Fresh | State::Idle(_) | State::Draining(_) => {
                self.skip(bytes, Why::Unasked);
                let until = self.deadline().max(now + QUIET);
                self.state = State::Draining(until);
            }
            State::Waiting { sent, until } => {
                self.received.extend_from_slice(bytes);
                let offset = usize::from(self.echo == Echo::Present);
                let whole = self.received.len() >= self.reply + offset;
                let exact = self.received.len() == self.reply + offset;
                let plain = offset == 0 || self.received[0] == self.request;
                let known = self.echo != Echo::Unknown && !self.late;
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
            State::Fresh => self.state = State::Draining(now + QUIET),
            State::Idle(_) | State::Draining(_) => {
                self.output
                    .push_back(Output::Transmit([self.request].into()));
                let bits = 10 * (self.reply as u64 + 2);
                let on_wire = bits * 1_000_000 / u64::from(self.decoder.profile().baud);
                self.state = State::Waiting {
                    sent: now,
                    until: now + on_wire + self.timeout,
                };
            }
            State::Waiting { sent, .. } => self.judge(now, sent),
        }
    }

    fn holds_at(&self, offset: usize) -> bool {
        self.received
            .get(offset..offset + self.reply)
            .is_some_and(|bytes| {
                let layout = self.decoder.layout(self.request);
                let named = self.decoder.layout(bytes[0]).is_some();
                let answers =
                    self.decoder.profile().format != Format::T485 || bytes[0] == self.request;
                named && answers && layout.is_some_and(|layout| layout.holds(Bits::of_bytes(bytes)))
            })
    }

    /// A good reply stands at `offset`, which is right for what is known of echo.
    fn accept(&mut self, now: Micros, sent: Micros, offset: usize) {
        self.emit(now, sent, offset, Some(offset));
        self.state = State::Idle((sent + self.interval).max(now));
    }

    /// The line is quiet or the time is up: makes the best of what has come.
    fn judge(&mut self, now: Micros, sent: Micros) {
        let have = self.received.len();
        let echoed = self.received.first() == Some(&self.request) && have > self.reply;
        let plain = self.holds_at(0);
        let behind = echoed && self.holds_at(1);
        // Where both hold, the last byte must be explained as well.
        let found = match (plain, behind) {
            (true, false) => Some(0),
            (false, true) => Some(1),
            (true, true) => Some(usize::from(have > self.reply)),
            (false, false) => None,
        };
        if let Some(offset) = found {
            let alone = have == self.reply + offset;
            if alone && !self.late {
                self.vote(if offset == 1 {
                    Echo::Present
                } else {
                    Echo::Absent
                });
                return self.accept(now, sent, offset);
            }
            // It may answer an earlier request, or belong to a talk that nobody asked for.
            let quiet = if self.late { self.timeout } else { QUIET };
            self.late = false;
            self.emit(now, sent, offset, None);
            self.state = State::Draining(now + quiet);
            return;
        }
        let only_echo = have == 1 && self.received[0] == self.request;
        if have == 0 || only_echo {
            let bytes = core::mem::take(&mut self.received);
            self.skip(&bytes, Why::Request);
            self.output.push_back(Output::Silent { echo: only_echo });
            self.late = true;
            self.timeout = (2 * self.timeout).min(LONGEST_TIMEOUT);
        } else if have < self.reply {
            let bytes = core::mem::take(&mut self.received);
            self.skip(
                &bytes,
                Why::Truncated {
                    have,
                    need: self.reply,
                },
            );
        } else {
            let last = have - self.reply;
            let exact = usize::from(self.echo == Echo::Present).min(last);
            let late = (last > 1 && self.holds_at(last)).then_some(last);
            self.emit(now, sent, late.unwrap_or(exact), None);
        }
        self.state = State::Draining(now + QUIET);
    }

    fn vote(&mut self, echo: Echo) {
        if self.echo == echo {
            return;
        }
        let agrees = match self.votes {
            0 => true,
            votes => (votes > AGREE) == (echo == Echo::Present),
        };
        // Votes count from 1 for absent and from AGREE + 1 for present.
        let base = if echo == Echo::Present { AGREE + 1 } else { 1 };
        self.votes = if agrees && self.votes > 0 {
            self.votes + 1
        } else {
            base
        };
        self.echo = Echo::Unknown;
        if self.votes >= base + AGREE - 1 {
            self.echo = echo;
            self.votes = 0;
        }
    }

    /// Reports the reply at `offset` and the bytes around it.
    fn emit(&mut self, now: Micros, sent: Micros, offset: usize, good: Option<usize>) {
        let bytes = core::mem::take(&mut self.received);
        let (before, rest) = bytes.split_at(offset);
        let (reply, after) = rest.split_at(self.reply);
        let why = if before == [self.request] {
            Why::Request
        } else {
            Why::NoFrame
        };
        self.skip(before, why);
        self.output.push_back(Output::Frame {
            bytes: reply.into(),
            sure: good.is_some(),
            latency: now - sent,
        });
        self.skip(after, Why::NoFrame);
    }

    fn skip(&mut self, bytes: &[u8], why: Why) {
        if !bytes.is_empty() {
            self.output.push_back(Output::Skip {
                bytes: bytes.into(),
                why,
            });
        }
    }
}
