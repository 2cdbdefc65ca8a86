//! Bytes, cut anyhow, into frames and skips; every byte ends in exactly one of them.
//!
//! A CRC that passes does not prove where a frame begins. A checksum that starts
//! from 0 ignores leading zeros, and a frame followed by a zero byte passes again, so while
//! the turns stay below 256 the phase one byte late passes in every frame; and on a still
//! shaft any phase that passes once passes for ever. The framer therefore weighs phases as
//! evidence, in bits, over a window of frames:
//!
//! - a frame that passes is worth its redundant bits (CRC, fixed and padding bits), but little
//!   when it repeats one already counted, and less than nothing when its last byte is 0, since
//!   then the phase before it with the zero in front explains the same bytes better;
//! - an angle that continues the one before speaks for a phase; one that jumps, or status
//!   bits that change from frame to frame, speak against it;
//! - the phase held before, the start and the end of the input count for a little.
//!
//! The best phase wins when it leads clearly; otherwise its frame is *not sure*, and no
//! reading comes out of it. A frame in the held phase that passes and does not end in 0 needs
//! no weighing: that is the fast path. A stream without requests is joined only where a second
//! frame follows the first. Text is framed by its line ends. All decisions depend on
//! the bytes alone, never on how they were cut.

mod evidence;
mod text;
mod weigh;

use crate::{
    bits::Bits, decode::Decoder, format::Format, language::t, layout::Resolved, reading::Reading,
    say,
};
use alloc::vec::Vec;
use core::fmt;
use evidence::{Position, WINDOW};
use weigh::{is_sound, passing};

/// Longest skip that is reported as one.
const SKIP: usize = 256;

/// A stretch of the input.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a> {
    /// Offset of its first byte in the input.
    pub start: u64,
    /// Its bytes.
    pub bytes: &'a [u8],
    /// What it is.
    pub kind: PieceKind<'a>,
}

impl<'a> Piece<'a> {
    /// The frames of a run, one by one; of any other piece itself.
    pub fn frames(self) -> impl Iterator<Item = Self> + 'a {
        let len = match self.kind {
            PieceKind::Frame { layout, .. } => layout.bytes(),
            PieceKind::Skip(_) => self.bytes.len(),
        };
        let starts = (self.start..).step_by(len.max(1));
        let frames = self.bytes.chunks_exact(len.max(1)).zip(starts);
        frames.map(move |(bytes, start)| Self {
            start,
            bytes,
            kind: self.kind,
        })
    }

    /// Position and health, of a good frame only.
    #[must_use]
    pub fn reading(&self) -> Option<Reading> {
        match self.kind {
            PieceKind::Frame {
                layout,
                sure: true,
                holds: true,
            } => layout.position(Bits::of_bytes(self.bytes).prefix(layout.len)),
            _ => None,
        }
    }
}

/// What a stretch of the input is.
#[derive(Clone, Copy, Debug)]
pub enum PieceKind<'a> {
    /// A frame, good or bad.
    Frame {
        /// Its layout.
        layout: &'a Resolved,
        /// Whether it is certain that a frame begins here.
        sure: bool,
        /// Whether every check holds.
        holds: bool,
    },
    /// Bytes of no frame.
    Skip(Why),
}

/// Why input belongs to no frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// The host's request, or its echo by a two-wire adapter.
    Request,
    /// No check holds here.
    NoFrame,
    /// It came without a request.
    Unasked,
    /// The input ends inside a frame; bytes, or bits for bit strings.
    Truncated {
        /// What there is.
        have: usize,
        /// What a frame needs.
        need: usize,
    },
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Request => f.write_str(t("request")),
            Self::NoFrame => f.write_str(t("no frame")),
            Self::Unasked => f.write_str(t("came unasked")),
            Self::Truncated { have, need } => say!(f, "{} of {}", have, need),
        }
    }
}

/// Cuts a byte stream into frames and skips.
///
/// ```
/// use encoderscope::{decode::Decoder, framing::{Framer, PieceKind}, profile::Profile};
/// let decoder = Decoder::new(Profile::parse([("format", "t485")])?)?;
/// let mut framer = Framer::at_start();
/// let mut frames = 0;
/// let mut count = |piece: encoderscope::framing::Piece<'_>| {
///     frames += usize::from(matches!(piece.kind, PieceKind::Frame { .. }));
/// };
/// for byte in [0x77, 0x02, 0x20, 0xb4, 0xbd, 0x1c, 0x37] {
///     framer.push(&decoder, &[byte], &mut count);
/// }
/// framer.finish(&decoder, &mut count);
/// assert_eq!(frames, 1);
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Framer {
    /// Bytes not yet decided on, behind those of the open skip.
    buffer: Vec<u8>,
    /// Offset of the first byte of `buffer` in the input.
    base: u64,
    /// The byte before `buffer`.
    before: Option<u8>,
    /// Bytes at the front of `buffer` that are skipped but not yet reported.
    skipped: usize,
    why: Why,
    held: bool,
    /// Nothing has been skipped since the start of the input or the last sure frame.
    contiguous: bool,
    /// Where the shaft was in the last sure frame, and in the one before.
    last: Option<Position>,
    earlier: Option<Position>,
    /// Where a frame begins whose phase has been proven.
    proven: Option<u64>,
    /// The last sure frame, and whether it was the one before it again.
    previous: Vec<u8>,
    repeats: bool,
}

type Sink<'s> = dyn FnMut(Piece<'_>) + 's;

/// What to do with the bytes at hand.
enum Step<'d> {
    Wait,
    Frame(&'d Resolved, Trust),
    Skip(usize, Why, Option<Proven>),
}

/// The frame behind a skip needs no more evidence for its phase than was found before the skip.
struct Proven;

/// How far a frame can be trusted to begin where it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Trust {
    /// It passes, and its phase leads clearly.
    Sure,
    /// It passes, but another phase may be the right one.
    Unsure,
    /// It fails, and frames behind it pass in its phase.
    Kept,
    /// It fails, and nothing behind it tells where the next frame begins.
    Last,
}

impl Framer {
    /// A framer at the start of a dump, which probably begins with a whole frame.
    #[must_use]
    pub const fn at_start() -> Self {
        Self {
            buffer: Vec::new(),
            base: 0,
            before: None,
            skipped: 0,
            why: Why::NoFrame,
            held: false,
            contiguous: true,
            last: None,
            earlier: None,
            proven: None,
            previous: Vec::new(),
            repeats: false,
        }
    }

    /// A framer at the start of a stretch that begins at an offset in the input, and probably
    /// with a whole frame.
    #[must_use]
    pub const fn at_offset(start: u64) -> Self {
        let mut framer = Self::at_start();
        framer.base = start;
        framer
    }

    /// A framer that joins a running stream somewhere.
    #[must_use]
    pub const fn joining() -> Self {
        let mut framer = Self::at_start();
        framer.contiguous = false;
        framer
    }

    /// Takes more input.
    pub fn push(&mut self, decoder: &Decoder, bytes: &[u8], sink: &mut Sink<'_>) {
        self.push_runs(decoder, bytes, &mut |run| run.frames().for_each(&mut *sink));
    }

    /// The input has ended; reports what is left.
    pub fn finish(&mut self, decoder: &Decoder, sink: &mut Sink<'_>) {
        self.finish_runs(decoder, &mut |run| run.frames().for_each(&mut *sink));
    }

    /// Takes more input; good frames of one layout that follow one another come as one piece,
    /// which is quicker to read into columns.
    ///
    /// ```
    /// use encoderscope::{columns::Columns, decode::Decoder, framing::Framer, profile::Profile};
    /// let decoder = Decoder::new(Profile::parse([("format", "t485")])?)?;
    /// let stream = [0x02, 0x20, 0xb4, 0xbd, 0x1c, 0x37].repeat(1000);
    /// let (mut framer, mut columns) = (Framer::at_start(), Columns::default());
    /// framer.push_runs(&decoder, &stream, &mut |run| columns.take(&run));
    /// framer.finish_runs(&decoder, &mut |run| columns.take(&run));
    /// assert_eq!(columns.angle, [0x1c_bdb4; 1000]);
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    pub fn push_runs(&mut self, decoder: &Decoder, bytes: &[u8], sink: &mut Sink<'_>) {
        self.buffer.extend_from_slice(bytes);
        self.run(decoder, Ending::Open, sink);
    }

    /// The input has ended; reports what is left, in runs.
    pub fn finish_runs(&mut self, decoder: &Decoder, sink: &mut Sink<'_>) {
        self.run(decoder, Ending::Closed, sink);
        self.flush(0, self.skipped, sink);
        self.base += self.skipped as u64;
        self.buffer.clear();
        self.skipped = 0;
        self.held = false;
    }

    fn run(&mut self, decoder: &Decoder, ending: Ending, sink: &mut Sink<'_>) {
        // `from` is where unreported bytes begin; `from + skipped` is where deciding goes on.
        let mut from = 0;
        loop {
            let mut at = from + self.skipped;
            if self.held && self.skipped == 0 && decoder.profile().format == Format::Asi4 {
                from = self.hold_text(decoder, at, sink);
                at = from;
            } else if self.held {
                let held = self.hold(decoder, at, sink);
                if held > at {
                    (from, at) = (held, held);
                }
            }
            match self.step(decoder, at, ending) {
                Step::Wait => break,
                Step::Frame(layout, trust) => {
                    let sure = trust != Trust::Unsure;
                    self.flush(from, self.skipped, sink);
                    let end = at + layout.len / 8;
                    let bytes = &self.buffer[at..end];
                    let start = self.base + at as u64;
                    sink(Piece {
                        start,
                        bytes,
                        kind: PieceKind::Frame {
                            layout,
                            sure,
                            holds: matches!(trust, Trust::Sure | Trust::Unsure),
                        },
                    });
                    self.held = trust == Trust::Sure || trust == Trust::Kept && self.held;
                    if trust == Trust::Sure {
                        self.contiguous = true;
                        self.earlier = self.last;
                        self.last = Position::of(layout, bytes).or(self.last);
                        self.repeats = self.previous == bytes;
                        self.previous.clear();
                        self.previous.extend_from_slice(bytes);
                    }
                    from = end;
                    self.skipped = 0;
                }
                Step::Skip(count, why, proven) => {
                    self.proven = proven.map(|Proven| self.base + (at + count) as u64);
                    if why != self.why || self.skipped + count > SKIP {
                        self.flush(from, self.skipped, sink);
                        from += self.skipped;
                        self.skipped = 0;
                    }
                    self.why = why;
                    self.skipped += count;
                    self.held &= why == Why::Request;
                    self.contiguous &= why == Why::Request;
                }
            }
        }
        if let Some(last) = from.checked_sub(1) {
            self.before = self.buffer.get(last).copied();
        }
        self.buffer.drain(..from);
        self.base += from as u64;
    }

    /// Reports what was skipped and frames for as long as the held phase passes beyond doubt, if it
    /// does; returns where it stops.
    fn hold(&mut self, decoder: &Decoder, from: usize, sink: &mut Sink<'_>) -> usize {
        let mut at = from;
        let mut moved = None;
        while let Some(layout) = self.beyond_doubt(decoder, &self.buffer[at..]) {
            let len = layout.len / 8;
            let run = &self.buffer[at..];
            let repeats = self.previous == run[..len];
            let (frames, repeats) = match decoder.follower(run[0]) {
                Some(follows) => layout.run(run, repeats, follows),
                None => (1, repeats),
            };
            let run = &run[..frames * len];
            // What was skipped in front of the first comes before it.
            self.flush(at - self.skipped, self.skipped, sink);
            self.skipped = 0;
            sink(Piece {
                start: self.base + at as u64,
                bytes: run,
                kind: PieceKind::Frame {
                    layout,
                    sure: true,
                    holds: true,
                },
            });
            at += run.len();
            if layout.has_angle {
                moved = Some((layout, at - len));
            }
            self.repeats = repeats;
            self.previous.clear();
            self.previous.extend_from_slice(&run[run.len() - len..]);
        }
        if let Some((layout, last)) = moved {
            let bytes = &self.buffer[last..last + layout.len / 8];
            self.last = Position::of(layout, bytes).or(self.last);
        }
        self.contiguous |= at > from;
        at
    }

    /// The layout of a frame of the held phase that needs no weighing.
    #[inline]
    fn beyond_doubt<'d>(&self, decoder: &'d Decoder, rest: &[u8]) -> Option<&'d Resolved> {
        let layout = passing(decoder, rest)?;
        let len = layout.len / 8;
        let (frame, behind) = rest.split_at(len);
        let sound = layout.is_checked && (layout.is_sound(frame) || is_sound(decoder, behind));
        // A still shaft may repeat a frame in two phases that both pass for ever.
        let leaves = self.repeats && self.previous != frame;
        let known = decoder.is_known_lead(frame[0], self.previous.first().copied());
        if !sound || leaves || !known {
            return None;
        }
        // A request before its reply may pass as the first byte of a frame.
        let asks = decoder.is_request(rest[0])
            && (!decoder.echoes() || rest.get(1) == Some(&rest[0]))
            && (rest.len() == len || passing(decoder, &rest[1..]).is_some());
        (!asks).then_some(layout)
    }

    fn flush(&self, from: usize, count: usize, sink: &mut Sink<'_>) {
        if count > 0 {
            sink(Piece {
                start: self.base + from as u64,
                bytes: &self.buffer[from..from + count],
                kind: PieceKind::Skip(self.why),
            });
        }
    }

    fn step<'d>(&self, decoder: &'d Decoder, at: usize, ending: Ending) -> Step<'d> {
        let rest = &self.buffer[at..];
        if rest.is_empty() {
            return Step::Wait;
        }
        let open = matches!(ending, Ending::Open);
        if decoder.profile().format == Format::Asi4 {
            let before = match at.checked_sub(1) {
                Some(last) => Some(self.buffer[last]),
                None => self.before,
            };
            return self.text_step(decoder, rest, before, open);
        }
        if open && rest.len() < (WINDOW + 2) * (decoder.longest() + 1) {
            return Step::Wait;
        }
        self.weigh(decoder, rest)
    }
}

/// Whether more input may come.
#[derive(Clone, Copy, Debug)]
enum Ending {
    Open,
    Closed,
}
