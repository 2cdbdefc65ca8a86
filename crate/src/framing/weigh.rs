//! Which phase of a stream is the right one.

use super::{
    Framer, Step, Trust, Why,
    evidence::{Chain, Position, WINDOW},
};
use crate::{bits::Bits, decode::Decoder, format::Link, layout::Resolved};

/// Evidence that a phase needs, and by which it must lead, in bits.
const ENOUGH: i32 = 14;
const LEAD: i32 = 6;
/// A bit error is more common than a lost byte: the held phase starts ahead.
const HELD: i32 = 6;
/// Dumps tend to begin and end with whole frames.
const EDGE: i32 = 4;
/// A frame that fails.
const FAILS: i32 = -4;
impl Framer {
    /// Decides by the evidence for every phase.
    pub(super) fn weigh<'d>(&self, decoder: &'d Decoder, rest: &[u8]) -> Step<'d> {
        let passes = passing(decoder, rest).is_some();
        let first = decoder.layout(rest);
        let anchored = self.held || self.contiguous;
        let mut own = None;
        if !passes && is_before_reply(decoder, rest, self.last) {
            return Step::Skip(1, Why::Request);
        }
        if passes || (anchored && first.is_some_and(|layout| layout.len / 8 <= rest.len())) {
            let chain = chain(decoder, rest, 0, self.last);
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
        for shift in 1..decoder.longest().min(rest.len()) {
            let visited = own.as_ref().is_some_and(|own| own.visits(shift));
            if visited
                || passing(decoder, &rest[shift..]).is_none()
                || is_late(decoder, rest, shift)
            {
                continue;
            }
            let score = chain(decoder, rest, shift, self.last).score;
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
                    let confirmed =
                        anchored || own.passes > 1 || decoder.profile().link() != Link::Stream;
                    let frame = &rest[..layout.len / 8];
                    let unrivalled = anchored && other.is_none() && layout.is_sound(frame);
                    let sure = lead
                        && confirmed
                        && (own.score >= ENOUGH || unrivalled)
                        && self.is_addressed(decoder, &own, frame, rest.len(), anchored)
                        && (self.held || !own.leaps(self.last));
                    Step::Frame(layout, if sure { Trust::Sure } else { Trust::Unsure })
                } else if own.visits(1) {
                    Step::Skip(1, Why::Request)
                } else if own.passes > 0 {
                    Step::Frame(layout, Trust::Kept)
                } else if self.held || ends_whole(decoder, layout, rest, anchored) {
                    Step::Frame(layout, Trust::Last)
                } else {
                    Step::Skip(1, Why::NoFrame)
                }
            }
            // The frames only repeat one another, so that the zeros in front of another phase
            // prove nothing against the phase that the input began with.
            (Some(own), Some((shift, _)))
                if passes && anchored && own.only_repeats() && self.last.is_none() =>
            {
                first.map_or(skip(decoder, rest, shift), |layout| {
                    Step::Frame(layout, Trust::Unsure)
                })
            }
            (_, Some((shift, _))) => skip(decoder, rest, shift),
            (_, None) => self.nothing(decoder, rest, anchored),
        }
    }

    /// Whether a BUS frame can be trusted to come from the device that it names: the profile's,
    /// one that is heard again, or the only one of a dump.
    fn is_addressed(
        &self,
        decoder: &Decoder,
        own: &Chain<'_>,
        frame: &[u8],
        rest: usize,
        anchored: bool,
    ) -> bool {
        let known = decoder.is_known_lead(frame[0], self.previous.first().copied());
        let alone = anchored && frame.len() == rest;
        decoder.names(frame[0]) >= 0 && (known || alone || own.begins_again(frame[0]))
    }

    /// No phase of the next frame passes.
    fn nothing<'d>(&self, decoder: &'d Decoder, rest: &[u8], anchored: bool) -> Step<'d> {
        let follows = anchored || self.skipped == 0;
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
            );
        }
        let judged = 1..decoder.longest().min(rest.len());
        Step::Skip(judged.end.max(1), Why::NoFrame)
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
    echoed || alone || chain(decoder, rest, 1, last).passes > chain(decoder, rest, 0, last).passes
}

/// Whether what is left of a dump is whole frames from here on.
fn ends_whole(decoder: &Decoder, layout: &Resolved, rest: &[u8], anchored: bool) -> bool {
    let len = layout.len / 8;
    let few = rest.len() < (WINDOW + 2) * (decoder.longest() + 1);
    len == rest.len() || anchored && few && rest.len().is_multiple_of(len)
}

fn skip<'d>(decoder: &Decoder, rest: &[u8], count: usize) -> Step<'d> {
    if count == 1 && decoder.is_request(rest[0]) {
        Step::Skip(1, Why::Request)
    } else {
        Step::Skip(count, Why::NoFrame)
    }
}

/// The layout of a whole frame at the start of `bytes` whose checks hold.
#[inline]
pub(super) fn passing<'d>(decoder: &'d Decoder, bytes: &[u8]) -> Option<&'d Resolved> {
    let layout = decoder.layout(bytes)?;
    let frame = bytes.get(..layout.len / 8)?;
    layout.holds(Bits::of_bytes(frame)).then_some(layout)
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

/// Follows a phase for a window of frames, to the first that fails after one that passes:
/// what stands behind it may have slipped.
fn chain<'b>(decoder: &Decoder, rest: &'b [u8], start: usize, last: Option<Position>) -> Chain<'b> {
    let mut chain = Chain::new(last);
    let mut at = start;
    let mut fails = 0;
    for _ in 0..WINDOW {
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
            let frame = &here[..layout.len / 8];
            chain.add(layout, frame, at, decoder.names(frame[0]));
            at += frame.len();
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
    chain
}
