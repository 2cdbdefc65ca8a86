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
//! no weighing: that is the fast path. All decisions depend on the bytes alone, never on how
//! they were cut.

mod evidence;

use crate::{bits::Bits, decode::Decoder, layout::Resolved};
use alloc::vec::Vec;
use core::fmt;
use evidence::{Chain, Position, WINDOW};

/// Evidence that a phase needs, and by which it must lead, in bits.
const ENOUGH: i32 = 14;
const LEAD: i32 = 6;
/// A bit error is more common than a lost byte: the held phase starts ahead.
const HELD: i32 = 6;
/// Dumps tend to begin and end with whole frames.
const EDGE: i32 = 4;
/// A frame that fails.
const FAILS: i32 = -4;
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

/// What a stretch of the input is.
#[derive(Clone, Copy, Debug)]
pub enum PieceKind<'a> {
    /// A frame, good or bad.
    Frame {
        /// Its layout.
        layout: &'a Resolved,
        /// Whether it is certain that a frame begins here.
        sure: bool,
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
            Self::Request => f.write_str("request"),
            Self::NoFrame => f.write_str("no frame"),
            Self::Unasked => f.write_str("came unasked"),
            Self::Truncated { have, need } => write!(f, "{have} of {need}"),
        }
    }
}

/// Cuts a byte stream into frames and skips.
///
/// ```
/// use encoderscope::{decode::Decoder, framing::{Framer, PieceKind}, profile::Profile};
/// let decoder = Decoder::new(Profile::parse([("format", "t485")])?)?;
/// let mut framer = Framer::new(&decoder);
/// let mut frames = 0;
/// for byte in [0x77, 0x02, 0x20, 0xb4, 0xbd, 0x1c, 0x37] {
///     framer.push(&[byte], &mut |piece| frames += usize::from(matches!(piece.kind, PieceKind::Frame { .. })));
/// }
/// framer.finish(&mut |piece| frames += usize::from(matches!(piece.kind, PieceKind::Frame { .. })));
/// assert_eq!(frames, 1);
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Debug)]
pub struct Framer<'d> {
    decoder: &'d Decoder,
    /// Bytes not yet decided on, behind those of the open skip.
    buffer: Vec<u8>,
    /// Offset of the first byte of `buffer` in the input.
    base: u64,
    /// Bytes at the front of `buffer` that are skipped but not yet reported.
    skipped: usize,
    why: Why,
    held: bool,
    /// Nothing has been skipped since the start of the input or the last sure frame.
    contiguous: bool,
    last: Option<Position>,
}

type Sink<'s> = dyn FnMut(Piece<'_>) + 's;

/// What to do with the bytes at hand.
enum Step<'d> {
    Wait,
    Frame(&'d Resolved, Trust),
    Skip(usize, Why),
}

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

impl<'d> Framer<'d> {
    /// A framer at the start of an input.
    #[must_use]
    pub const fn new(decoder: &'d Decoder) -> Self {
        Self {
            decoder,
            buffer: Vec::new(),
            base: 0,
            skipped: 0,
            why: Why::NoFrame,
            held: false,
            contiguous: true,
            last: None,
        }
    }

    /// Takes more input.
    pub fn push(&mut self, bytes: &[u8], sink: &mut Sink<'_>) {
        self.buffer.extend_from_slice(bytes);
        self.run(Ending::Open, sink);
    }

    /// The input has ended; reports what is left.
    pub fn finish(&mut self, sink: &mut Sink<'_>) {
        self.run(Ending::Closed, sink);
        self.flush(0, self.skipped, sink);
        self.base += self.skipped as u64;
        self.buffer.clear();
        self.skipped = 0;
        self.held = false;
    }

    fn run(&mut self, ending: Ending, sink: &mut Sink<'_>) {
        // `from` is where unreported bytes begin; `from + skipped` is where deciding goes on.
        let mut from = 0;
        loop {
            let at = from + self.skipped;
            match self.step(at, ending) {
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
                        kind: PieceKind::Frame { layout, sure },
                    });
                    self.held = matches!(trust, Trust::Sure | Trust::Kept);
                    if trust == Trust::Sure {
                        self.contiguous = true;
                        let values = layout.values(Bits::of_bytes(bytes));
                        self.last = Position::of(layout, &values).or(self.last);
                    }
                    from = end;
                    self.skipped = 0;
                }
                Step::Skip(count, why) => {
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
        self.buffer.drain(..from);
        self.base += from as u64;
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

    fn step(&self, at: usize, ending: Ending) -> Step<'d> {
        let rest = &self.buffer[at..];
        if rest.is_empty() {
            return Step::Wait;
        }
        let held = self.passing(rest);
        // A request before its reply may pass as the first byte of a frame.
        let asks = self.decoder.is_request(rest[0]);
        if let Some(layout) = held
            && self.held
            && rest[layout.len / 8 - 1] != 0
            && !(asks && (rest.len() == layout.len / 8 || self.passing(&rest[1..]).is_some()))
        {
            return Step::Frame(layout, Trust::Sure);
        }
        let longest = self.decoder.longest();
        let open = matches!(ending, Ending::Open);
        if open && rest.len() < (WINDOW + 2) * (longest + 1) {
            return Step::Wait;
        }
        self.weigh(rest, held.is_some())
    }

    /// Decides by the evidence for every phase.
    fn weigh(&self, rest: &[u8], passes: bool) -> Step<'d> {
        let first = self.decoder.layout(rest[0]);
        let anchored = self.held || self.contiguous;
        let mut own = None;
        if passes || (anchored && first.is_some_and(|layout| layout.len / 8 <= rest.len())) {
            let chain = self.chain(rest, 0, self.last);
            let bonus = if self.held {
                HELD
            } else if anchored {
                EDGE
            } else {
                0
            };
            own = Some(chain.plus(bonus));
        }
        let mut other: Option<(usize, i32)> = None;
        for shift in 1..self.decoder.longest().min(rest.len()) {
            let visited = own.as_ref().is_some_and(|own| own.visits(shift));
            if visited || self.passing(&rest[shift..]).is_none() || self.is_late(rest, shift) {
                continue;
            }
            let score = self.chain(rest, shift, self.last).score;
            if other.is_none_or(|(_, best)| score > best) {
                other = Some((shift, score));
            }
        }
        match (own, other) {
            (Some(own), other) if other.is_none_or(|(_, score)| own.score >= score) => {
                let Some(layout) = first else {
                    return Step::Skip(1, Why::NoFrame);
                };
                let lead = other.is_none_or(|(_, score)| own.score - score >= LEAD);
                if passes {
                    let sure = lead && own.score >= ENOUGH && (self.held || !own.leaps(self.last));
                    Step::Frame(layout, if sure { Trust::Sure } else { Trust::Unsure })
                } else if own.visits(1) {
                    Step::Skip(1, Why::Request)
                } else if own.passes > 0 {
                    Step::Frame(layout, Trust::Kept)
                } else if self.held || layout.len / 8 == rest.len() {
                    Step::Frame(layout, Trust::Last)
                } else {
                    Step::Skip(1, Why::NoFrame)
                }
            }
            // The frames only repeat one another, so that the zeros in front of another phase
            // prove nothing against the phase that the input began with.
            (Some(own), Some((shift, _)))
                if passes && own.only_repeats() && self.last.is_none() =>
            {
                first.map_or(self.skip(rest, shift), |layout| {
                    Step::Frame(layout, Trust::Unsure)
                })
            }
            (_, Some((shift, _))) => self.skip(rest, shift),
            (_, None) => self.nothing(rest, anchored),
        }
    }

    /// No phase of the next frame passes.
    fn nothing(&self, rest: &[u8], anchored: bool) -> Step<'d> {
        let follows = anchored || self.skipped == 0;
        if let Some(layout) = self.decoder.layout(rest[0])
            && follows
            && rest.len() < layout.len / 8
        {
            let need = layout.len / 8;
            return Step::Skip(
                rest.len(),
                Why::Truncated {
                    have: rest.len(),
                    need,
                },
            );
        }
        let judged = 1..self.decoder.longest().min(rest.len());
        Step::Skip(judged.end.max(1), Why::NoFrame)
    }

    fn skip(&self, rest: &[u8], count: usize) -> Step<'d> {
        if count == 1 && self.decoder.is_request(rest[0]) {
            Step::Skip(1, Why::Request)
        } else {
            Step::Skip(count, Why::NoFrame)
        }
    }

    /// The layout of a whole frame at the start of `bytes` whose checks hold.
    fn passing(&self, bytes: &[u8]) -> Option<&'d Resolved> {
        let layout = self.decoder.layout(*bytes.first()?)?;
        let frame = bytes.get(..layout.len / 8)?;
        layout.holds(Bits::of_bytes(frame)).then_some(layout)
    }

    /// Whether the frame at `shift` is the one a byte before it, read one byte late: of phases
    /// that pass together the one with the zero in front is right.
    fn is_late(&self, rest: &[u8], shift: usize) -> bool {
        let ends = |layout: &Resolved| rest.get(shift + layout.len / 8 - 1) == Some(&0);
        rest[shift - 1] == 0
            && self.decoder.layout(rest[shift]).is_some_and(ends)
            && self.passing(&rest[shift - 1..]).is_some()
    }

    /// Follows a phase for a window of frames, to the first that fails after one that passes:
    /// what stands behind it may have slipped.
    fn chain<'b>(&self, rest: &'b [u8], start: usize, last: Option<Position>) -> Chain<'b> {
        let mut chain = Chain::new(last);
        let mut at = start;
        let mut fails = 0;
        for _ in 0..WINDOW {
            let Some(mut here) = rest.get(at..).filter(|here| !here.is_empty()) else {
                break;
            };
            let mut layout = self.passing(here);
            if layout.is_none() && self.decoder.is_request(here[0]) {
                layout = self.passing(&here[1..]);
                if layout.is_some() {
                    at += 1;
                    here = &here[1..];
                }
            }
            if let Some(layout) = layout {
                chain.add(layout, &here[..layout.len / 8], at);
                at += layout.len / 8;
                continue;
            }
            let Some(layout) = self
                .decoder
                .layout(here[0])
                .filter(|layout| layout.len / 8 <= here.len())
            else {
                break;
            };
            chain.score += FAILS;
            fails += 1;
            if fails > 2 || chain.passes > 0 {
                break;
            }
            at += layout.len / 8;
        }
        if at == rest.len() && chain.passes > 0 {
            chain.score += EDGE;
        }
        chain
    }
}

/// Whether more input may come.
#[derive(Clone, Copy, Debug)]
enum Ending {
    Open,
    Closed,
}
