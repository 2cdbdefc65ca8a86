//! How an emulated shaft moves.

use crate::session::Micros;

/// How the shaft moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaft {
    /// Turns at time 0.
    pub start: f64,
    /// Revolutions per second.
    pub speed: f64,
    /// Turns by which it swings to both sides of that motion.
    pub sway: f64,
    /// Seconds of one swing to and fro.
    pub period: f64,
}

impl Shaft {
    /// A shaft that stands still.
    #[must_use]
    pub const fn still(turns: f64) -> Self {
        Self {
            start: turns,
            speed: 0.0,
            sway: 0.0,
            period: 1.0,
        }
    }

    /// A shaft that turns evenly.
    #[must_use]
    pub const fn turning(turns: f64, speed: f64) -> Self {
        Self {
            start: turns,
            speed,
            sway: 0.0,
            period: 1.0,
        }
    }

    /// A shaft that goes on evenly from where this one is at `now`, in revolutions per second.
    ///
    /// ```
    /// use encoderscope::emulator::Shaft;
    /// let shaft = Shaft::turning(0.5, 2.0).going_on(1_000_000, 0.0);
    /// assert_eq!(shaft.at(9_000_000), 2.5);
    /// ```
    #[must_use]
    pub fn going_on(&self, now: Micros, speed: f64) -> Self {
        Self::turning(self.at(now) - speed * now as f64 / 1e6, speed)
    }

    /// Where it is, in turns.
    ///
    /// ```
    /// use encoderscope::emulator::Shaft;
    /// assert_eq!(Shaft::turning(0.5, 2.0).at(1_000_000), 2.5);
    /// ```
    #[must_use]
    pub fn at(&self, now: Micros) -> f64 {
        let seconds = now as f64 / 1e6;
        self.start + self.speed * seconds + self.sway * swing(seconds / self.period)
    }

    /// How fast it turns, in revolutions per second.
    #[must_use]
    pub fn speed_at(&self, now: Micros) -> f64 {
        (self.at(now + 500) - self.at(now.saturating_sub(500))) * 1000.0
    }
}

/// A smooth wave of period 1 between −1 and 1, two parabolas.
fn swing(phase: f64) -> f64 {
    let (_, x) = split(phase);
    if x < 0.5 {
        16.0 * x * (0.5 - x)
    } else {
        -16.0 * (x - 0.5) * (1.0 - x)
    }
}

/// Whole turns and the part of a turn, which is never negative and less than 1.
pub(super) fn split(turns: f64) -> (i64, f64) {
    let whole = turns as i64;
    let part = turns - whole as f64;
    // A hair below a whole turn the sum is rounded to 1.
    if part < 0.0 && part + 1.0 < 1.0 {
        (whole - 1, part + 1.0)
    } else if part < 0.0 {
        (whole, 0.0)
    } else {
        (whole, part)
    }
}

/// Turns, and counts of so many `codes` a turn, off by up to `noise` counts. The noise follows
/// from the time alone, so that the same moment is always read the same.
pub(super) fn noisy(now: Micros, noise: u32, codes: u128, turns: i64, part: f64) -> (i64, u64) {
    let angle = (part * codes as f64) as u64;
    if noise == 0 {
        return (turns, angle);
    }
    // The multiplier of Knuth's MMIX; the high half of what it gives is random enough here.
    let draw = |seed: u64| seed.wrapping_mul(6_364_136_223_846_793_005) / 0x1_0000_0000;
    let random = draw(draw(now.wrapping_add(1)));
    let off = i128::from(random % (2 * u64::from(noise) + 1)) - i128::from(noise);
    let codes = i128::try_from(codes).unwrap_or(i128::MAX);
    let angle = i128::from(angle) + off;
    let over = angle.div_euclid(codes) as i64;
    (turns.saturating_add(over), angle.rem_euclid(codes) as u64)
}
