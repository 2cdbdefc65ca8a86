//! Which phase of a stream is the right one.

use super::{
    Framer, Proven, Step, Trust, Why,
    evidence::{Chain, Position, WINDOW, WORST},
};
use crate::{decode::Decoder, format::Link, layout::Resolved};

/// Evidence that a phase needs, and by which it must lead, in bits.
const ENOUGH: i32 = 14;
const LEAD: i32 = 6;
/// A bit error is more common than a lost byte: the held phase starts ahead.
const HELD: i32 = 6;
/// Dumps tend to begin and end with whole frames.
const EDGE: i32 = 4;
/// The longest frame has as many bytes, so that there are fewer other phases.
const MOST_RIVALS: usize = 32;
/// A frame that fails.
const FAILS: i32 = -4;

/// How far a phase is followed.
#[derive(Clone, Copy)]
enum Until {
    /// For a window of frames, or until so many pass.
    Passes(usize),
    /// For a window of frames, or until the score will be this, whatever comes.
    Score(i32),
}

/// The frame that would stand at the bytes at hand, and whether its checks hold.
#[derive(Clone, Copy)]
struct First<'d> {
    layout: &'d Resolved,
    passes: bool,
}

impl Framer {
    /// Decides by the evidence for every phase.
    pub(super) fn weigh<'d>(&self, decoder: &'d Decoder, rest: &[u8]) -> Step<'d> {
        let layout = decoder.layout(rest);
        let passes = layout.is_some_and(|layout| layout.holds_at(rest));
        if !passes && is_before_reply(decoder, rest, self.last) {
            return Step::Skip(1, Why::Request, None);
        }
        let whole = layout.filter(|layout| layout.len / 8 <= rest.len());
        let first = whole
            .filter(|_| passes || self.is_anchored())
            .map(|layout| First { layout, passes });
        let mut rivals = [0; MOST_RIVALS];
        let mut count = 0;
        for shift in 1..decoder.longest().min(rest.len()) {
            let passes = passing(decoder, &rest[shift..]).is_some();
            if let Some(rival) = rivals.get_mut(count)
                && passes
                && !is_late(decoder, rest, shift)
            {
                *rival = shift;
                count += 1;
            }
        }
        let rivals = &rivals[..count];
        if rivals.is_empty() {
            return match first {
                Some(first) => self.alone(decoder, rest, first),
                None => self.nothing(decoder, rest),
            };
        }
        let all = Until::Passes(WINDOW);
        let own = first.map(|first| (first, self.own_chain(decoder, rest, all)));
        let visited = |shift| own.as_ref().is_some_and(|(_, own)| own.visits(shift));
        let until = match (&own, rivals) {
            // That the only phase that passes is better than this one is all that matters, and
            // whether it will be good enough.
            (Some((_, own)), [_]) if own.passes == 0 => Until::Score(ENOUGH.max(own.score + 1)),
            _ => all,
        };
        let mut other: Option<(usize, Chain<'_>)> = None;
        for shift in rivals.iter().copied().filter(|shift| !visited(*shift)) {
            let chain = chain(decoder, rest, shift, self.last, until);
            if other
                .as_ref()
                .is_none_or(|(_, best)| chain.score > best.score)
            {
                other = Some((shift, chain));
            }
        }
        match (own, other) {
            (Some((first, own)), other)
                if other
                    .as_ref()
                    .is_none_or(|(_, best)| own.score >= best.score) =>
            {
                let other = other.map(|(_, best)| best.score);
                self.best(decoder, rest, first, &own, other)
            }
            // The frames only repeat one another, so that the zeros in front of another phase
            // prove nothing against the phase that the input began with.
            (Some((first, own)), Some(_))
                if passes && self.is_anchored() && own.only_repeats() && self.last.is_none() =>
            {
                Step::Frame(first.layout, Trust::Unsure)
            }
            (_, Some((shift, best))) => {
                let proven = best.passes > 1 && best.least >= ENOUGH && !best.leaps(self.last);
                skip(decoder, rest, shift, proven.then_some(Proven))
            }
            (_, None) => self.nothing(decoder, rest),
        }
    }

    /// Decides on the only phase whose first frame passes, if it does: no more of the frames
    /// behind it are looked at than can matter.
    fn alone<'d>(&self, decoder: &'d Decoder, rest: &[u8], first: First<'d>) -> Step<'d> {
        let frame = &rest[..first.layout.len / 8];
        let known = decoder.is_known_lead(rest[0], self.previous.first().copied());
        let until = match first.passes {
            false => Until::Passes(1),
            true if !known => Until::Passes(WINDOW),
            true if self.proven == Some(self.offset_of(rest)) => {
                return Step::Frame(first.layout, Trust::Sure);
            }
            true if !self.is_unrivalled(first.layout, frame) => Until::Score(ENOUGH),
            true if self.held => Until::Passes(0),
            true => Until::Passes(2),
        };
        let own = self.own_chain(decoder, rest, until);
        self.best(decoder, rest, first, &own, None)
    }

    /// Decides on a phase that no other beats; the best of the others has the score `other`.
    fn best<'d>(
        &self,
        decoder: &Decoder,
        rest: &[u8],
        first: First<'d>,
        own: &Chain<'_>,
        other: Option<i32>,
    ) -> Step<'d> {
        let layout = first.layout;
        let lead = other.is_none_or(|score| own.score - score >= LEAD);
        if first.passes {
            let confirmed =
                self.is_anchored() || own.passes > 1 || decoder.profile().link() != Link::Stream;
            let frame = &rest[..layout.len / 8];
            let unrivalled = other.is_none() && self.is_unrivalled(layout, frame);
            let sure = lead
                && confirmed
                && (unrivalled || own.score >= ENOUGH)
                && self.is_addressed(decoder, own, frame, rest.len())
                && (self.held || !own.leaps(self.last));
            Step::Frame(layout, if sure { Trust::Sure } else { Trust::Unsure })
        } else if own.visits(1) {
            Step::Skip(1, Why::Request, None)
        } else if own.passes > 0 {
            Step::Frame(layout, Trust::Kept)
        } else if self.held || ends_whole(decoder, layout, rest, self.is_anchored()) {
            Step::Frame(layout, Trust::Last)
        } else {
            Step::Skip(1, Why::NoFrame, None)
        }
    }

    /// Where the rest of the buffer begins in the input.
    const fn offset_of(&self, rest: &[u8]) -> u64 {
        self.base + (self.buffer.len() - rest.len()) as u64
    }

    /// Whether this is the phase held before, or that of the start.
    const fn is_anchored(&self) -> bool {
        self.held || self.contiguous
    }

    /// Whether a frame that passes needs no more evidence where no other phase passes.
    fn is_unrivalled(&self, layout: &Resolved, frame: &[u8]) -> bool {
        self.is_anchored() && layout.is_sound(frame)
    }

    /// The evidence for the phase that begins here.
    fn own_chain<'b>(&self, decoder: &Decoder, rest: &'b [u8], until: Until) -> Chain<'b> {
        let bonus = match self.is_anchored() {
            true if self.held => HELD,
            true => EDGE,
            false => 0,
        };
        let mut own = Chain::new(rest, self.last, bonus);
        follow(&mut own, decoder, rest, 0, until);
        own
    }

    /// Whether a BUS frame can be trusted to come from the device that it names: the profile's,
    /// one that is heard again, or the only one of a dump.
    fn is_addressed(&self, decoder: &Decoder, own: &Chain<'_>, frame: &[u8], rest: usize) -> bool {
        let known = decoder.is_known_lead(frame[0], self.previous.first().copied());
        let alone = self.is_anchored() && frame.len() == rest;
        decoder.names(frame[0]) >= 0 && (known || alone || own.begins_again(frame[0]))
    }

    /// No phase of the next frame passes.
    fn nothing<'d>(&self, decoder: &'d Decoder, rest: &[u8]) -> Step<'d> {
        let follows = self.is_anchored() || self.skipped == 0;
        if let Some(layout) = decoder.layout(rest)
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
                None,
            );
        }
        let judged = 1..decoder.longest().min(rest.len());
        Step::Skip(judged.end.max(1), Why::NoFrame, None)
    }
}

/// Whether the first byte is a request whose reply, broken as it is, stands behind it.
fn is_before_reply(decoder: &Decoder, rest: &[u8], last: Option<Position>) -> bool {
    if !decoder.is_request(rest[0]) {
        return false;
    }
    let echoed = decoder.echoes() && rest.get(1) == Some(&rest[0]);
    let behind = decoder.layout(&rest[1..]);
    let alone = behind.is_some_and(|layout| layout.len / 8 + 1 == rest.len());
    let passes = |start| chain(decoder, rest, start, last, Until::Passes(WINDOW)).passes;
    echoed || alone || passes(1) > passes(0)
}

/// Whether what is left of a dump is whole frames from here on.
fn ends_whole(decoder: &Decoder, layout: &Resolved, rest: &[u8], anchored: bool) -> bool {
    let len = layout.len / 8;
    let few = rest.len() < (WINDOW + 2) * (decoder.longest() + 1);
    len == rest.len() || anchored && few && rest.len().is_multiple_of(len)
}

/// Skips to another phase.
fn skip<'d>(decoder: &Decoder, rest: &[u8], count: usize, proven: Option<Proven>) -> Step<'d> {
    if count == 1 && decoder.is_request(rest[0]) {
        Step::Skip(1, Why::Request, proven)
    } else {
        Step::Skip(count, Why::NoFrame, proven)
    }
}

/// The layout of a whole frame at the start of `bytes` whose checks hold.
#[inline]
pub(super) fn passing<'d>(decoder: &'d Decoder, bytes: &[u8]) -> Option<&'d Resolved> {
    decoder
        .layout(bytes)
        .filter(|layout| layout.holds_at(bytes))
}

/// Whether `bytes` begin with a frame that no phase one byte early explains better. In a phase
/// one byte late no frame does, so one vouches for the frame before it.
#[inline]
pub(super) fn is_sound(decoder: &Decoder, bytes: &[u8]) -> bool {
    passing(decoder, bytes).is_some_and(|layout| layout.is_sound(&bytes[..layout.len / 8]))
}

/// Whether the frame at `shift` is the one a byte before it, read one byte late: of phases
/// that pass together the one with the zero in front is right.
fn is_late(decoder: &Decoder, rest: &[u8], shift: usize) -> bool {
    let ends =
        |layout: &Resolved| layout.is_zero_led && rest.get(shift + layout.len / 8 - 1) == Some(&0);
    rest[shift - 1] == 0
        && decoder.layout(&rest[shift..]).is_some_and(ends)
        && passing(decoder, &rest[shift - 1..]).is_some()
}

/// The evidence for the phase that begins at `start`.
fn chain<'b>(
    decoder: &Decoder,
    rest: &'b [u8],
    start: usize,
    last: Option<Position>,
    until: Until,
) -> Chain<'b> {
    let mut chain = Chain::new(rest, last, 0);
    follow(&mut chain, decoder, rest, start, until);
    chain
}

/// Follows a phase to the first frame that fails after one that passes: what stands behind it
/// may have slipped.
fn follow(chain: &mut Chain<'_>, decoder: &Decoder, rest: &[u8], start: usize, until: Until) {
    let mut at = start;
    let mut fails = 0;
    for left in (1..=WINDOW as i32).rev() {
        let enough = match until {
            Until::Passes(frames) => chain.passes >= frames,
            // Two frames are needed to see a leap.
            Until::Score(score) => chain.passes > 1 && chain.score + left * WORST >= score,
        };
        if enough {
            chain.least = chain.score + left * WORST;
            return;
        }
        let Some(mut here) = rest.get(at..).filter(|here| !here.is_empty()) else {
            break;
        };
        let mut layout = passing(decoder, here);
        if layout.is_none() && decoder.is_request(here[0]) {
            layout = passing(decoder, &here[1..]);
            if layout.is_some() {
                at += 1;
                here = &here[1..];
            }
        }
        if let Some(layout) = layout {
            chain.add(layout, at, decoder.names(here[0]));
            at += layout.len / 8;
            continue;
        }
        let Some(layout) = decoder
            .layout(here)
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
    chain.least = chain.score;
}
