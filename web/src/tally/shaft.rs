//! What the shaft has done within the last second.

use super::{RATE_OVER, Tally};
use encoderscope::session::Micros;

/// Where the shaft was.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) at: Micros,
    /// Part of a turn.
    pub(super) part: f64,
}

impl Tally {
    /// How far the shaft has moved within the last second, in turns, once that is known.
    #[must_use]
    pub fn moved(&self, now: Micros) -> Option<f64> {
        let first = *self.places.front()?;
        let last = self.places.back()?.at;
        let fresh = now.saturating_sub(last) < RATE_OVER / 4;
        if !fresh || last - first.at < RATE_OVER * 9 / 10 {
            return None;
        }
        let away = self.places.iter().map(|place| {
            let apart = place.part - first.part;
            apart - apart.round()
        });
        let (low, high) = away.fold((0.0f64, 0.0f64), |(low, high), apart| {
            (low.min(apart), high.max(apart))
        });
        Some(high - low)
    }
}
