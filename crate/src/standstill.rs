//! How much the angle of a shaft at rest varies: what is left is the encoder's noise.

use crate::{bits, session::Micros};
use alloc::{collections::VecDeque, vec, vec::Vec};

/// Figures are taken over this time.
const OVER: Micros = 1_000_000;
/// No more samples than this are kept.
const SAMPLES: usize = 4_096;
/// Bins on either side of the middle one.
const SIDE: u64 = 20;

/// The angles of the last second.
///
/// ```
/// use encoderscope::standstill::Standstill;
/// let mut standstill = Standstill::new(17);
/// for (at, angle) in [131_071, 0, 1, 0].into_iter().enumerate() {
///     standstill.push(at as u64 * 1_000, angle);
/// }
/// let figures = standstill.figures().unwrap();
/// assert_eq!((figures.mean, figures.peak_to_peak), (0.0, 2));
/// assert_eq!(figures.bins, [1, 2, 1]);
/// assert!((figures.sigma - 0.5f64.sqrt()).abs() < 1e-3);
/// assert!((figures.arcseconds(1.0) - 9.9).abs() < 0.1);
/// ```
#[derive(Clone, Debug)]
pub struct Standstill {
    angle_bits: u32,
    angles: VecDeque<(Micros, u64)>,
}

/// How much an angle varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Bits per turn.
    pub angle_bits: u32,
    /// How many samples there are.
    pub samples: usize,
    /// Mean angle in counts, 0 ≤ m < 2^`angle_bits`.
    pub mean: f64,
    /// Standard deviation in counts.
    pub sigma: f64,
    /// From the lowest to the highest, in counts.
    pub peak_to_peak: u64,
    /// Counts in a bin, at least 1.
    pub width: u64,
    /// How many samples fall into each bin, at most 41; the mean is in the middle one.
    pub bins: Vec<u32>,
}

impl Figures {
    /// Counts in arc-seconds.
    #[must_use]
    pub fn arcseconds(&self, counts: f64) -> f64 {
        counts * 1_296_000.0 / bits::codes(self.angle_bits) as f64
    }
}

impl Standstill {
    /// Nothing yet of an encoder with so many bits per turn.
    #[must_use]
    pub const fn new(angle_bits: u32) -> Self {
        Self {
            angle_bits,
            angles: VecDeque::new(),
        }
    }

    /// Takes an angle in counts; what is older than a second is forgotten.
    pub fn push(&mut self, at: Micros, angle: u64) {
        if self.angles.len() == SAMPLES {
            self.angles.pop_front();
        }
        self.angles.push_back((at, angle));
        self.forget(at);
    }

    /// Forgets what is older than a second.
    pub fn forget(&mut self, now: Micros) {
        let old = |(at, _): &(Micros, u64)| at.saturating_add(OVER) < now;
        while self.angles.front().is_some_and(old) {
            self.angles.pop_front();
        }
    }

    /// Forgets all: the angle was set.
    pub fn clear(&mut self) {
        self.angles.clear();
    }

    /// How much the angle varies, taken the shorter way around; `None` while there is nothing.
    #[must_use]
    pub fn figures(&self) -> Option<Figures> {
        let (_, reference) = *self.angles.front()?;
        let codes = bits::codes(self.angle_bits.min(64)) as i128;
        let away = || {
            self.angles.iter().map(|(_, angle)| {
                let apart = (i128::from(*angle) - i128::from(reference)).rem_euclid(codes);
                match apart > codes / 2 {
                    true => apart - codes,
                    false => apart,
                }
            })
        };
        let count = self.angles.len() as i128;
        let (low, high) = (away().min()?, away().max()?);
        let sum: i128 = away().sum();
        let center = (2 * sum + count).div_euclid(2 * count);
        let mean = (i128::from(reference) + center).rem_euclid(codes) as f64
            + (sum - center * count) as f64 / count as f64;
        let reach = (center - low).max(high - center).unsigned_abs() as u64;
        let width = reach.div_ceil(SIDE).max(1);
        let side = ((reach + width / 2) / width) as usize;
        let mut bins = vec![0u32; 2 * side + 1];
        for apart in away() {
            let bin = (apart - center + i128::from(width / 2)).div_euclid(width.into());
            if let Some(bin) = bins.get_mut((bin + side as i128) as usize) {
                *bin += 1;
            }
        }
        Some(Figures {
            angle_bits: self.angle_bits,
            samples: self.angles.len(),
            mean: if mean < 0.0 {
                mean + codes as f64
            } else {
                mean
            },
            sigma: deviation(away(), count),
            peak_to_peak: (high - low) as u64,
            width,
            bins,
        })
    }
}

/// The standard deviation of `count` numbers. Whole numbers keep it exactly 0 at rest, and the
/// core has no square root of others.
fn deviation(numbers: impl Iterator<Item = i128>, count: i128) -> f64 {
    let (sum, squares) = numbers.fold((0i128, 0i128), |(sum, squares), number| {
        let square = number.saturating_mul(number);
        (sum + number, squares.saturating_add(square))
    });
    let scatter = squares.saturating_mul(count) - sum.saturating_mul(sum);
    let scatter = scatter.unsigned_abs();
    let root = match scatter.checked_mul(1_000_000) {
        Some(scaled) => scaled.isqrt() as f64 / 1_000.0,
        None => scatter.isqrt() as f64,
    };
    root / count as f64
}
