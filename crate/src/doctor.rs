//! How a link is: one named state, from what a session says.
//!
//! | state | evidence |
//! |---|---|
//! | silent | requests, or half a second of a stream, without a byte |
//! | echo only | nothing but the requests comes back |
//! | garbage | bytes that are no frames: a wrong baud rate, A and B swapped, no termination |
//! | checks fail | frames of the right length whose checks fail: noise, a marginal rate |
//! | other profile | the same bytes are good frames with other widths or of another stream |
//! | unasked | bytes come that nobody asked for |
//! | good | frames whose checks hold, if only some of them |

use crate::{
    finder::{explain_replies, streams},
    format::Link,
    framing::Why,
    profile::Profile,
    session::{Ask, Micros, Output},
};
use alloc::{collections::VecDeque, vec::Vec};

/// Requests without a reply after which a link is called silent.
const SILENT_AFTER: u32 = 3;
/// Replies without a good frame after which a link is called failing.
const FAILING_AFTER: u32 = 10;
/// Bytes without a good frame after which a stream is called failing, and without a request
/// after which it is called unasked.
const BYTES_AFTER: usize = 200;
/// So many good ones among the last frames of a stream, or the last replies, are read, however many
/// others fail: by chance one in 256 passes the shortest check.
const READ_FROM: usize = 2;
const LAST_FRAMES: u64 = 64;
const LAST_REPLIES: u64 = 32;
/// So many bytes of a stream that are no frame count as one that has failed.
const ABOUT_A_FRAME: usize = 8;
/// Where one byte in so many is part of a frame that fails, frames come: by chance one in 256 bytes
/// begins what passes for one.
const FRAMES_FROM: usize = 16;
/// Replies and bytes of a stream that are kept to be looked at.
const REPLIES: usize = 12;
const BYTES: usize = 2_048;
/// More of one reply is not kept.
const REPLY: usize = 64;

/// How a link is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finding {
    /// Nothing can be said yet.
    Waiting,
    /// Nothing comes back.
    Silent,
    /// Only the requests come back.
    EchoOnly,
    /// What comes back is no frame.
    Garbage,
    /// Frames of the right length, but their checks fail.
    ChecksFail,
    /// The frames are good with this profile.
    OtherProfile(Profile),
    /// The encoder talks without being asked; as this profile says, where it is known.
    Unasked(Option<Profile>),
    /// Good frames come in.
    Good,
}

/// What came back to a request.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Exchange {
    request: Vec<u8>,
    reply: Vec<u8>,
}

/// Watches a session.
///
/// ```
/// use encoderscope::{decode::Decoder, doctor::{Doctor, Finding}, profile::Profile, session::Output};
/// let mut doctor = Doctor::new(Profile::parse([("format", "t485")])?, 0);
/// for _ in 0..3 {
///     doctor.watch(0, &Output::Silent { echo: true }, false);
/// }
/// assert_eq!(doctor.finding(), Finding::EchoOnly);
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Debug)]
pub struct Doctor {
    profile: Profile,
    finding: Finding,
    silent: u32,
    failing: u32,
    /// Frames and replies up to now, and at which of them the last good ones came.
    frames: u64,
    good: VecDeque<u64>,
    /// Bytes since the last good frame: those that are none, with those of frames that failed; those
    /// of such frames alone; and those unasked.
    strange: usize,
    framed: usize,
    unasked: usize,
    current: Exchange,
    exchanges: VecDeque<Exchange>,
    stream: VecDeque<u8>,
    /// Bytes of the stream since this time.
    streamed: usize,
    since: Micros,
}

impl Doctor {
    /// Nothing has been seen yet.
    #[must_use]
    pub fn new(profile: Profile, now: Micros) -> Self {
        Self {
            profile,
            finding: Finding::Waiting,
            silent: 0,
            failing: 0,
            frames: 0,
            good: VecDeque::new(),
            strange: 0,
            framed: 0,
            unasked: 0,
            current: Exchange::default(),
            exchanges: VecDeque::new(),
            stream: VecDeque::new(),
            streamed: 0,
            since: now,
        }
    }

    /// How the link is.
    #[must_use]
    pub const fn finding(&self) -> Finding {
        self.finding
    }

    /// The session has said something; `good` says whether it is a good frame.
    pub fn watch(&mut self, now: Micros, output: &Output, good: bool) {
        match output {
            Output::Transmit(request) => {
                let request = request.clone();
                let reply = Vec::new();
                let done = core::mem::replace(&mut self.current, Exchange { request, reply });
                if !done.reply.is_empty() {
                    self.exchanges.push_back(done);
                    while self.exchanges.len() > REPLIES {
                        self.exchanges.pop_front();
                    }
                }
            }
            Output::Silent { echo } => {
                self.silent += 1;
                if self.silent >= SILENT_AFTER || self.is_stream() {
                    self.finding = match echo {
                        true => Finding::EchoOnly,
                        false => Finding::Silent,
                    };
                    self.forget(now);
                }
            }
            Output::Frame { bytes, .. } => {
                self.keep(bytes);
                self.silent = 0;
                self.frames += 1;
                if good {
                    self.finding = Finding::Good;
                    self.good.push_back(self.frames);
                    self.good.drain(..self.good.len().saturating_sub(READ_FROM));
                    self.begin_anew();
                    self.unasked = 0;
                } else {
                    self.strange += bytes.len();
                    self.framed += bytes.len();
                    self.fails(now);
                }
            }
            Output::Skip { bytes, why } => {
                self.keep(bytes);
                match why {
                    Why::Request => {}
                    Why::Unasked => {
                        self.unasked += bytes.len();
                        if self.unasked >= BYTES_AFTER {
                            self.unasked = 0;
                            self.finding = Finding::Unasked(self.as_stream(now));
                        }
                    }
                    Why::Truncated { .. } => {
                        self.silent = 0;
                        self.frames += 1;
                        self.fails(now);
                    }
                    Why::NoFrame => {
                        self.strange += bytes.len();
                        self.frames += bytes.len().div_ceil(ABOUT_A_FRAME) as u64;
                        if self.is_stream() && self.strange >= BYTES_AFTER {
                            self.silent = 0;
                            self.judge(now);
                        }
                    }
                }
            }
        }
    }

    fn is_stream(&self) -> bool {
        self.profile.link() == Link::Stream
    }

    /// Keeps bytes to be looked at.
    fn keep(&mut self, bytes: &[u8]) {
        if self.current.reply.len() < REPLY {
            self.current.reply.extend_from_slice(bytes);
        }
        self.streamed += bytes.len();
        self.stream.extend(bytes);
        while self.stream.len() > BYTES {
            self.stream.pop_front();
        }
    }

    fn forget(&mut self, now: Micros) {
        self.exchanges.clear();
        self.stream.clear();
        self.streamed = 0;
        self.since = now;
    }

    /// A frame has failed, or a reply was too short.
    fn fails(&mut self, now: Micros) {
        self.failing += 1;
        if self.failing >= FAILING_AFTER && (!self.is_stream() || self.strange >= BYTES_AFTER) {
            self.judge(now);
        }
    }

    /// Nothing good has come for a while: what it may be instead.
    fn judge(&mut self, now: Micros) {
        if self.finding != Finding::Good || !self.reads_some() {
            self.finding = match self.is_stream() {
                true => self.judge_stream(now),
                false => self.judge_replies(),
            };
            self.forget(now);
        }
        self.begin_anew();
    }

    /// Counts anew what fails.
    const fn begin_anew(&mut self) {
        self.failing = 0;
        self.strange = 0;
        self.framed = 0;
    }

    /// Whether some of the last frames were good.
    fn reads_some(&self) -> bool {
        let last = match self.is_stream() {
            true => LAST_FRAMES,
            false => LAST_REPLIES,
        };
        let first = self.good.front().filter(|_| self.good.len() == READ_FROM);
        first.is_some_and(|first| self.frames - first < last)
    }

    fn judge_stream(&mut self, now: Micros) -> Finding {
        match self.as_stream(now) {
            Some(other) => Finding::OtherProfile(other),
            None if self.framed * FRAMES_FROM >= self.strange => Finding::ChecksFail,
            None => Finding::Garbage,
        }
    }

    /// The stream that the bytes are, if they are another one than that of the profile.
    fn as_stream(&mut self, now: Micros) -> Option<Profile> {
        let took = now.saturating_sub(self.since);
        let bytes = self.stream.make_contiguous();
        let found = streams(self.profile.baud, bytes, self.streamed, took);
        let best = found.into_iter().max_by_key(|found| found.score)?;
        (best.profile != self.profile).then_some(best.profile)
    }

    fn judge_replies(&self) -> Finding {
        let replies = self.exchanges.iter();
        let replies: Vec<_> = replies
            .map(|one| (one.request.as_slice(), one.reply.as_slice()))
            .collect();
        if let Some(other) = explain_replies(&self.profile, &replies) {
            return Finding::OtherProfile(other);
        }
        let expected = crate::decode::Decoder::new(self.profile)
            .ok()
            .and_then(|decoder| Ask::position(&decoder).ok())
            .map_or(0, |ask| ask.reply_len());
        let fits = |one: &&Exchange| {
            let echo = one.reply.starts_with(&one.request);
            let len = one.reply.len();
            len == expected || echo && len == expected + one.request.len()
        };
        let fitting = self.exchanges.iter().filter(fits).count();
        match fitting * 2 > self.exchanges.len() {
            true => Finding::ChecksFail,
            false => Finding::Garbage,
        }
    }
}
