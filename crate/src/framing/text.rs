//! Text streams: a line is a frame. There is no checksum, so the line before and the one behind
//! it must bear a number out.

use super::{Framer, Step, Trust, Why, evidence::Position, passing};
use crate::{bits::Bits, decode::Decoder, layout::Resolved};

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
            return Step::Skip(have, why);
        };
        let (line, behind) = rest.split_at(end + 1);
        let whole = self.contiguous || before == Some(b'\n');
        let Some(layout) = decoder
            .layout(line)
            .filter(|layout| whole && layout.len / 8 == line.len())
        else {
            return Step::Skip(line.len(), Why::NoFrame);
        };
        if !layout.holds(Bits::of_bytes(line)) {
            return Step::Frame(layout, Trust::Kept);
        }
        let next = &behind[..behind.len().min(LINE)];
        if open && next.len() < LINE && !next.contains(&b'\n') {
            return Step::Wait;
        }
        if self.leaps(decoder, layout, line, next) {
            Step::Frame(layout, Trust::Unsure)
        } else {
            Step::Frame(layout, Trust::Sure)
        }
    }

    /// Whether a position lies off the way from the one before to the one behind it, as it does
    /// when a digit was lost or changed.
    fn leaps(&self, decoder: &Decoder, layout: &Resolved, line: &[u8], behind: &[u8]) -> bool {
        let next = passing(decoder, behind)
            .and_then(|layout| Position::of(layout, &behind[..layout.len / 8]));
        let (Some(last), Some(here), Some(next)) = (self.last, Position::of(layout, line), next)
        else {
            return false;
        };
        let most = 2.0 * last.distance(next) + SMALL;
        here.distance(last) > most && here.distance(next) > most
    }
}
