//! What the shaft has done within the last second.

use super::{RATE_OVER, Tally};
use encoderscope::session::Micros;

/// The speed is taken over this time.
const SPEED_OVER: Micros = 200_000;

/// Where the shaft was.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) at: Micros,
    /// Part of a turn.
    pub(super) part: f64,
    pub(super) turns: Option<f64>,
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

    /// How fast the shaft turns, in revolutions per second; `None` where it may have turned by
    /// half a turn and more from one frame to the next.
    pub(super) fn turning(&self) -> Option<f64> {
        let last = *self.places.back()?;
        let since = last.at.saturating_sub(SPEED_OVER);
        let recent = self.places.iter().filter(|place| place.at >= since);
        let first = *recent.clone().next()?;
        let apart = |one: &Place, next: &Place| {
            let part = next.part - one.part;
            match (one.turns, next.turns) {
                // A counter that begins again from 0 is not a turn backwards.
                (Some(one), Some(next)) if (next - one).abs() < 1000.0 => Some(next - one + part),
                _ => Some(part - part.round()).filter(|part| part.abs() < 0.4),
            }
        };
        let mut moved = 0.0;
        for (one, next) in recent.clone().zip(recent.skip(1)) {
            moved += apart(one, next)?;
        }
        let took = last.at - first.at;
        (took >= SPEED_OVER / 2).then(|| moved * 1e6 / took as f64)
    }
}
