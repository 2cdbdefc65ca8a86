//! The speed of a shaft from its angles.

use crate::session::Micros;
use alloc::collections::VecDeque;

/// A speed is derived from the angles of this time.
const OVER: Micros = 100_000;
/// Angles over less than this are too few for a speed.
const SPREAD: Micros = OVER / 2;
/// Angles further apart than this are not of one motion.
const LONGEST: Micros = 2_000_000;
/// No more angles than this are kept.
const ANGLES: usize = 1_024;
/// Without counted turns, angles further apart than this may have a whole turn between them: at
/// this distance the speed is right up to 20 revolutions a second.
const ALONE: Micros = 20_000;
/// So many turns from one angle to the next may as well be the rest of a turn the other way round.
const NEARLY_HALF: f64 = 0.4;
/// A counter that jumps by so many turns has begun anew.
const JUMP: f64 = 1_000.0;

/// An angle, unrolled.
#[derive(Clone, Copy, Debug)]
struct Place {
    at: Micros,
    /// Turns counted on from the first angle.
    unrolled: f64,
    /// Part of a turn, and whole turns where the encoder counts them.
    part: f64,
    turns: Option<f64>,
}

/// Derives a speed from angles. Where the turns are counted, frames may be seconds apart;
/// otherwise the shaft is taken to go the shorter way round, which only holds over a short time.
#[derive(Clone, Debug, Default)]
pub(super) struct Tacho {
    places: VecDeque<Place>,
}

impl Tacho {
    /// Takes an angle in degrees; gives revolutions per second.
    pub(super) fn take(&mut self, at: Micros, degrees: f64, turns: Option<f64>) -> Option<f64> {
        let part = degrees / 360.0;
        let step = self
            .places
            .back()
            .and_then(|last| step(last, at, part, turns));
        let unrolled = match (step, self.places.back()) {
            (Some(step), Some(last)) => last.unrolled + step,
            _ => {
                self.places.clear();
                part
            }
        };
        if !unrolled.is_finite() {
            self.places.clear();
            return None;
        }
        self.places.push_back(Place {
            at,
            unrolled,
            part,
            turns,
        });
        let old = |place: &Place| at.saturating_sub(place.at) > OVER;
        while self.places.len() > 2 && self.places.front().is_some_and(old)
            || self.places.len() > ANGLES
        {
            self.places.pop_front();
        }
        let first = self.places.front()?;
        let over = at.saturating_sub(first.at);
        (over >= SPREAD).then(|| (unrolled - first.unrolled) * 1e6 / over as f64)
    }
}

/// How far the shaft has turned since a place, as far as that can be known.
fn step(last: &Place, at: Micros, part: f64, turns: Option<f64>) -> Option<f64> {
    let apart = at.saturating_sub(last.at);
    let parts = part - last.part;
    match last.turns.zip(turns).map(|(before, turns)| turns - before) {
        Some(turns) if turns > -JUMP && turns < JUMP => (apart <= LONGEST).then_some(turns + parts),
        _ => Some(shortest_way(parts)).filter(|part| apart <= ALONE && part.abs() < NEARLY_HALF),
    }
}

/// A difference of turns without the whole ones: between −½ and ½.
fn shortest_way(apart: f64) -> f64 {
    let part = apart % 1.0;
    if part > 0.5 {
        part - 1.0
    } else if part < -0.5 {
        part + 1.0
    } else {
        part
    }
}
