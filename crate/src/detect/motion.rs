//! Where the shaft was in frame after frame: a shaft goes on, noise jumps.
//!
//! A position costs as many bits as its distance from where the shaft was bound for; as many as
//! it would cost without knowing so are the baseline, of which bits that never change are no part. What is saved is
//! evidence for the split of a frame into turns, angle and the rest.

use crate::{bits, profile::Profile, reading::Values};
use alloc::{collections::BTreeMap, vec::Vec};

/// Bits that say how long the number of a step is.
const LENGTH: u32 = 3;
/// So many steps that are all the same are those of a counter.
const COUNTED: u32 = 8;

/// The positions of a dump, each series in order.
#[derive(Debug, Default)]
pub(super) struct Track {
    /// Of each device of a bus, and of frames with and without turns, a series of its own.
    series: BTreeMap<(Option<u8>, bool), Vec<u128>>,
    angles: Vec<u64>,
}

/// What the positions come to.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    /// Bits saved.
    pub(super) gain: i32,
    /// Steps between different positions.
    pub(super) steps: u32,
    /// Steps that go on from those before.
    pub(super) smooth: u32,
    /// Steps that nothing foretold.
    pub(super) jumps: u32,
    /// Times the turns went up or down by one as the angle passed zero.
    pub(super) turned: u32,
    /// Times the angle passed zero.
    pub(super) wraps: u32,
    /// Highest bits of the angle that were never set.
    pub(super) unset: u32,
    /// Lowest bits of the angle that never changed.
    pub(super) stuck: u32,
    /// Whether all steps are the same, as those of a counter are.
    pub(super) counts: bool,
}

impl Track {
    pub(super) fn add(&mut self, profile: &Profile, values: &Values) {
        let Some(angle) = values.angle else {
            return;
        };
        let turns = values.turns.filter(|_| profile.turns_bits > 0);
        let all = i128::try_from(bits::codes(profile.turns_bits)).unwrap_or(i128::MAX);
        let counted = i128::from(turns.unwrap_or(0)).rem_euclid(all);
        let turn = bits::codes(profile.angle_bits);
        let place = counted.unsigned_abs() * turn + u128::from(angle) % turn;
        let series = self.series.entry((values.address, turns.is_some()));
        series.or_default().push(place);
        self.angles.push(angle);
    }

    /// What the positions come to, of lines with `active` bits that change.
    pub(super) fn motion(&self, profile: &Profile, active: u32) -> Motion {
        let mut motion = Motion::default();
        let width = profile.angle_bits;
        let set = self.angles.iter().fold(0, |set, angle| set | angle);
        let first = self.angles.first().copied().unwrap_or(0);
        let moved = self
            .angles
            .iter()
            .fold(0, |moved, angle| moved | (angle ^ first));
        motion.unset = width.saturating_sub(u64::BITS - set.leading_zeros());
        if moved > 0 {
            motion.stuck = moved.trailing_zeros();
        }
        let mut sizes: Option<(u128, bool)> = None;
        for ((_, has_turns), places) in &self.series {
            let turns_bits = if *has_turns { profile.turns_bits } else { 0 };
            let series = Series {
                all: bits::codes(turns_bits + width),
                turn: bits::codes(width),
                has_turns: *has_turns,
                active,
            };
            series.follow(places, &mut motion, &mut sizes);
        }
        motion.counts = motion.steps >= COUNTED && sizes.is_some_and(|(_, same)| same);
        motion
    }
}

/// The numbers of a series.
struct Series {
    /// How many positions there are.
    all: u128,
    /// How many to a turn.
    turn: u128,
    has_turns: bool,
    /// Bits of the lines that change: a word that is decoded wrongly seems to have more.
    active: u32,
}

impl Series {
    fn follow(&self, places: &[u128], motion: &mut Motion, sizes: &mut Option<(u128, bool)>) {
        let first = places.first().copied().unwrap_or(0);
        let moved = places
            .iter()
            .fold(0, |moved, place| moved | (place ^ first));
        let active = moved.count_ones().min(self.active);
        let mut before: Option<u128> = None;
        for pair in places.windows(2) {
            let &[from, to] = pair else { continue };
            let step = self.minus(to, from);
            if step == 0 {
                continue;
            }
            motion.steps += 1;
            let off = before.map_or(step, |before| self.minus(step, before));
            let off = self.size(off).min(self.size(step));
            let cost = LENGTH + (2 * off.min(u128::MAX / 4) + 1).ilog2();
            if cost < active {
                motion.smooth += 1;
                motion.gain += (active - cost) as i32;
            } else if cost > active + 1 {
                motion.jumps += 1;
            }
            // Half a turn and more in one step may have gone either way.
            if self.size(step) < self.turn / 2 {
                let (from, to) = (from % self.turn, to % self.turn);
                let apart = from.abs_diff(to);
                let wraps = apart > self.turn - apart;
                motion.wraps += u32::from(wraps);
                motion.turned += u32::from(wraps && self.has_turns);
            }
            *sizes = Some(match *sizes {
                None => (step, true),
                Some((size, same)) => (size, same && size == step),
            });
            before = Some(step);
        }
    }

    /// How far it is from `from` up to `to`.
    const fn minus(&self, to: u128, from: u128) -> u128 {
        (to + self.all - from) % self.all
    }

    /// How far a step goes, up or down.
    fn size(&self, step: u128) -> u128 {
        step.min(self.all - step)
    }
}
