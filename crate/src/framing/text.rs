//! Text streams: a line is a frame. There is no checksum, so the line before and the one behind
//! it must bear a number out.

use super::{Framer, Piece, PieceKind, Sink, Step, Trust, Why, evidence::Position, passing};
use crate::{
    bits::{self, Bits},
    decode::Decoder,
    format::asi4,
    layout::Resolved,
};

/// Longer than any line: text without line ends is not waited for beyond this.
const LINE: usize = 64;
/// A position that deviates by less, in turns, is never called a leap.
const SMALL: f64 = 1.0 / 512.0;

impl Framer {
    pub(super) fn text_step<'d>(
        &self,
        decoder: &'d Decoder,
        rest: &[u8],
        before: Option<u8>,
        open: bool,
    ) -> Step<'d> {
        let judged = &rest[..rest.len().min(LINE)];
        let Some(end) = judged.iter().position(|byte| *byte == b'\n') else {
            if open && rest.len() < LINE {
                return Step::Wait;
            }
            let have = judged.len();
            let number = have <= decoder.longest() && rest[0].is_ascii_digit();
            let why = match number && self.contiguous {
                true => Why::Truncated {
                    have,
                    need: decoder.longest(),
                },
                false => Why::NoFrame,
            };
            return Step::Skip(have, why, None);
        };
        let (line, behind) = rest.split_at(end + 1);
        let whole = self.contiguous || before == Some(b'\n');
        let Some(layout) = decoder
            .layout(line)
            .filter(|layout| whole && layout.len / 8 == line.len())
        else {
            return Step::Skip(line.len(), Why::NoFrame, None);
        };
        if !layout.holds(Bits::of_bytes(line)) {
            return Step::Frame(layout, Trust::Kept);
        }
        let next = &behind[..behind.len().min(LINE)];
        // At the start of a stream two lines must bear the first one out.
        let needed = if self.last.is_some() { 1 } else { 2 };
        let lines = next.iter().filter(|byte| **byte == b'\n').count();
        if open && next.len() < LINE && lines < needed {
            return Step::Wait;
        }
        if self.leaps(decoder, layout, line, next) {
            Step::Frame(layout, Trust::Unsure)
        } else {
            Step::Frame(layout, Trust::Sure)
        }
    }

    /// Reports lines from `from` on for as long as each is a number between its neighbours;
    /// returns where it stops. Those of as many digits as the one before come together.
    pub(super) fn hold_text(
        &mut self,
        decoder: &Decoder,
        from: usize,
        sink: &mut Sink<'_>,
    ) -> usize {
        let width = decoder.profile().angle_bits;
        let most = bits::mask(width as usize);
        let read = |bytes: &[u8]| asi4::number(bytes).filter(|(number, _)| *number <= most);
        let (mut at, mut begin, mut same) = (from, from, 0);
        let mut here = read(&self.buffer[at..]);
        while let (Some((number, len)), Some(last)) = (here, self.last) {
            let next = read(&self.buffer[at + len..]);
            let position = Position::of_angle(number, width);
            let between = next
                .is_some_and(|(next, _)| !position.is_off(last, Position::of_angle(next, width)));
            if !between {
                break;
            }
            if len != same {
                self.lines(decoder, begin..at, sink);
                (begin, same) = (at, len);
            }
            (self.earlier, self.last) = (self.last, Some(position));
            at += len;
            here = next;
        }
        self.lines(decoder, begin..at, sink);
        at
    }

    /// Reports lines of one length.
    fn lines(&self, decoder: &Decoder, at: core::ops::Range<usize>, sink: &mut Sink<'_>) {
        let bytes = &self.buffer[at.clone()];
        if let Some(layout) = decoder.layout(bytes) {
            sink(Piece {
                start: self.base + at.start as u64,
                bytes,
                kind: PieceKind::Frame {
                    layout,
                    sure: true,
                    holds: true,
                },
            });
        }
    }

    /// Whether a position lies off the way between its two nearest neighbours, as it does when a
    /// digit was lost or changed: the line before and the one behind, or at an end of the stream
    /// the two that there are.
    fn leaps(&self, decoder: &Decoder, layout: &Resolved, line: &[u8], behind: &[u8]) -> bool {
        let read = |bytes: &[u8]| {
            let layout = passing(decoder, bytes)?;
            let len = layout.len / 8;
            Some((Position::of(layout, &bytes[..len])?, len))
        };
        let next = read(behind);
        let second = next.and_then(|(_, len)| read(&behind[len..]));
        let neighbours = match (self.last, next) {
            (Some(last), Some((next, _))) => Some((last, next)),
            (Some(last), None) => self.earlier.zip(Some(last)),
            (None, Some((next, _))) => second.map(|(second, _)| (next, second)),
            (None, None) => None,
        };
        let (Some((one, other)), Some(here)) = (neighbours, Position::of(layout, line)) else {
            return false;
        };
        here.is_off(one, other)
    }
}

impl Position {
    /// Whether it is further from both its neighbours than they are apart.
    #[inline]
    fn is_off(self, one: Self, other: Self) -> bool {
        let most = 2.0 * one.distance(other) + SMALL;
        self.distance(one) > most && self.distance(other) > most
    }
}
