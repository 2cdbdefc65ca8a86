//! What the shaft has done within the last second.

use super::{RATE_OVER, Tally};
use encoderscope::session::Micros;

/// Fewer readings than these say nothing about rest, however slowly they come.
pub(super) const FEWEST: usize = 3;
/// A counter that jumps by so many turns has begun anew.
const JUMP: f64 = 1_000.0;

/// Where the shaft was.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) at: Micros,
    /// Part of a turn.
    pub(super) part: f64,
    pub(super) turns: Option<f64>,
}

impl Place {
    /// How far it is from another place, in turns; without a counter the shorter way round.
    fn apart(&self, other: &Self) -> f64 {
        let part = self.part - other.part;
        match self.turns.zip(other.turns).map(|(one, two)| one - two) {
            Some(turns) if turns.abs() < JUMP => turns + part,
            _ => part - part.round(),
        }
    }
}

impl Tally {
    /// How far the shaft has moved within the last second, or the last three readings where they
    /// come more slowly, in turns, once that is known.
    #[must_use]
    pub fn moved(&self, now: Micros) -> Option<f64> {
        let (first, last) = (*self.places.front()?, *self.places.back()?);
        let span = last.at - first.at;
        let apart = span / (self.places.len() as u64 - 1).max(1);
        let fresh = now.saturating_sub(last.at) < (RATE_OVER / 4).max(apart * 5 / 2);
        if !fresh || self.places.len() < FEWEST || span < RATE_OVER * 9 / 10 {
            return None;
        }
        let away = self.places.iter().map(|place| place.apart(&first));
        let (low, high) = away.fold((0.0f64, 0.0f64), |(low, high), apart| {
            (low.min(apart), high.max(apart))
        });
        Some(high - low)
    }
}
