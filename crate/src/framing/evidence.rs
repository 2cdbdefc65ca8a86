//! The evidence for a phase, in bits: what its frames say for and against it.

use crate::{
    bits,
    layout::{Glimpse, Resolved},
};

/// How many frames a phase is judged by.
pub(super) const WINDOW: usize = 8;
/// A true checksum is 0 once in 256 frames, that of the phase one byte late always.
const LATE: i32 = -8;
/// The angle continues within 1/64 turn.
const CONTINUES: i32 = 6;
/// An identical frame once more: frames of this length are there, whatever their phase.
const REPEATS: i32 = 2;
/// A number that jumps.
const JUMPS: i32 = -3;

/// The least that a frame can add to a score, whether it passes or fails.
pub(super) const WORST: i32 = LATE + 2 * JUMPS;

/// Where the shaft is, in turns, and the range after which it wraps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Position {
    turns: f64,
    range: f64,
}

impl Position {
    pub(super) fn of(layout: &Resolved, frame: &[u8]) -> Option<Self> {
        Self::of_glimpse(layout, &layout.glimpse(frame))
    }

    /// An angle of an encoder that counts no turns.
    #[inline]
    pub(super) fn of_angle(angle: u64, bits: u32) -> Self {
        Self {
            turns: angle as f64 / bits::power(bits),
            range: 1.0,
        }
    }

    fn of_glimpse(layout: &Resolved, values: &Glimpse) -> Option<Self> {
        let profile = &layout.shape.profile;
        let angle = values.angle? as f64 / bits::power(profile.angle_bits);
        Some(match values.turns {
            Some(turns) => Self {
                turns: turns as f64 + angle,
                range: bits::power(profile.turns_bits),
            },
            None => Self {
                turns: angle,
                range: 1.0,
            },
        })
    }

    /// How far apart two positions are, in turns, the shorter way round.
    pub(super) fn distance(self, other: Self) -> f64 {
        let apart = (self.turns - other.turns).abs();
        apart.min((self.range - apart).abs())
    }
}

/// The evidence for a phase.
pub(super) struct Chain<'b> {
    pub(super) score: i32,
    /// What the score would be at the least had it been followed further.
    pub(super) least: i32,
    pub(super) passes: usize,
    /// What the places of the frames are counted in.
    input: &'b [u8],
    /// Where the frames begin, and how long they are.
    frames: [(u32, u32); WINDOW],
    last: Option<Position>,
    status: Option<u8>,
    repeats: i32,
    distinct: i32,
    /// The first two positions, and the redundancy of the first frame.
    opening: [Option<Position>; 2],
    redundancy: u32,
}

impl<'b> Chain<'b> {
    /// No frame yet; the score begins with `bonus`.
    pub(super) const fn new(input: &'b [u8], last: Option<Position>, bonus: i32) -> Self {
        Self {
            score: bonus,
            least: bonus,
            passes: 0,
            input,
            frames: [(0, 0); WINDOW],
            last,
            status: None,
            repeats: 0,
            distinct: 0,
            opening: [None; 2],
            redundancy: 0,
        }
    }

    /// Where the frames that passed begin, and their bytes.
    fn frames(&self) -> impl Iterator<Item = (usize, &'b [u8])> {
        let frames = self.frames.iter().take(self.passes);
        frames.map(|(at, len)| {
            let at = *at as usize;
            let frame = self.input.get(at..at + *len as usize);
            (at, frame.unwrap_or_default())
        })
    }

    /// Whether there are several frames, all the same.
    pub(super) const fn only_repeats(&self) -> bool {
        self.distinct == 1 && self.passes > 1
    }

    /// Whether the first frame leaps away from `last` and back to the frame behind it: a broken
    /// frame whose short check passes by chance looks like that.
    pub(super) fn leaps(&self, last: Option<Position>) -> bool {
        let far = |from: Option<Position>, to: Option<Position>| {
            from.zip(to)
                .is_some_and(|(from, to)| from.distance(to) > 0.25)
        };
        let [first, second] = self.opening;
        self.redundancy < 16 && far(last, first) && far(first, second)
    }

    /// Whether more than one frame begins with this byte.
    pub(super) fn begins_again(&self, first: u8) -> bool {
        let frames = self.frames();
        frames
            .filter(|(_, frame)| frame.first() == Some(&first))
            .count()
            > 1
    }

    pub(super) fn visits(&self, at: usize) -> bool {
        self.frames().any(|(visited, _)| visited == at)
    }

    /// Counts a frame that passes; `names` is what its first byte says for it.
    pub(super) fn add(&mut self, layout: &Resolved, at: usize, names: i32) {
        let bytes = self.input.get(at..).unwrap_or_default();
        let frame = bytes.get(..layout.bytes()).unwrap_or_default();
        let known = self
            .frames()
            .any(|(_, other)| other.last() == frame.last() && other == frame);
        if known {
            if self.repeats < 3 {
                self.repeats += 1;
                self.score += REPEATS;
            }
        } else {
            let late = layout.is_zero_led && frame.last() == Some(&0);
            self.score += match late {
                // Once may be chance.
                true if self.distinct == 0 => 0,
                true => LATE,
                false => layout.redundancy as i32 + names,
            };
            self.distinct += 1;
        }
        if let Some(slot) = self.frames.get_mut(self.passes) {
            *slot = (at as u32, frame.len() as u32);
            self.passes += 1;
        }
        let values = layout.glimpse(bytes);
        if self.status.is_some() && values.status != self.status {
            self.score += JUMPS;
        }
        self.status = values.status;
        let Some(position) = Position::of_glimpse(layout, &values) else {
            return;
        };
        if self.passes <= 2 {
            self.opening[self.passes - 1] = Some(position);
        }
        if self.passes == 1 {
            self.redundancy = layout.redundancy;
        }
        if let Some(last) = self.last {
            let distance = position.distance(last);
            if distance > 0.25 {
                self.score += JUMPS;
            } else if distance < 1.0 / 64.0 && !known {
                self.score += CONTINUES;
            }
        }
        self.last = Some(position);
    }
}
