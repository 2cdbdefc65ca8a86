//! What has been read, over hours: angle, speed, temperature and errors for plots, in bounded
//! memory.

mod series;
mod tacho;

pub use series::{Point, Scale, Series};

use crate::session::Micros;
use tacho::Tacho;

/// Errors are counted in slots of this length.
const SLOT: Micros = 100_000;
/// Slots in the second over which errors are added up.
const SLOTS: usize = 10;

/// What a good frame says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Degrees, 0 ≤ d < 360.
    pub degrees: f64,
    /// Whole turns, where the frame says them.
    pub turns: Option<f64>,
    /// Revolutions per second, where the frame says it.
    pub speed: Option<f64>,
    /// Degrees Celsius, where the frame says it.
    pub temperature: Option<f64>,
}

/// Angle, speed, temperature and errors over time.
///
/// ```
/// use encoderscope::history::{History, Sample};
/// let mut history = History::new();
/// for at in 0..2_000 {
///     // One revolution a second, a thousand frames.
///     let degrees = (at % 1_000) as f64 * 0.36;
///     history.take(at * 1_000, &Sample { degrees, ..Sample::default() });
/// }
/// history.fail(2_000_000);
/// let speed = history.speed().points(1_000_000, 2_000_000, 1);
/// assert!(speed.iter().all(|point| (point.value.unwrap() - 1.0).abs() < 1e-9));
/// assert_eq!(history.span(), Some((0, 2_000_000)));
/// ```
#[derive(Clone, Debug)]
pub struct History {
    angle: Series,
    speed: Series,
    temperature: Series,
    errors: Series,
    tacho: Tacho,
    turning: Option<f64>,
    failures: Failures,
}

impl Default for History {
    fn default() -> Self {
        Self::new()
    }
}

impl History {
    /// Nothing yet.
    #[must_use]
    pub fn new() -> Self {
        Self {
            angle: Series::new(Scale::Circle),
            speed: Series::new(Scale::Line),
            temperature: Series::new(Scale::Line),
            errors: Series::new(Scale::Line),
            tacho: Tacho::default(),
            turning: None,
            failures: Failures::default(),
        }
    }

    /// Takes a good frame. Where it says no speed, that follows from the angles of the last
    /// 100 ms, or from the last two where the turns are counted too; without the turns, neighbours
    /// must be less than half a turn and 20 ms apart.
    pub fn take(&mut self, at: Micros, sample: &Sample) {
        self.angle.push(at, sample.degrees);
        let derived = || self.tacho.take(at, sample.degrees, sample.turns);
        self.turning = sample.speed.or_else(derived);
        if let Some(speed) = self.turning {
            self.speed.push(at, speed);
        }
        if let Some(temperature) = sample.temperature {
            self.temperature.push(at, temperature);
        }
        self.failures.advance(at, &mut self.errors);
    }

    /// Counts a bad frame or a request without a reply.
    pub fn fail(&mut self, at: Micros) {
        self.failures.advance(at, &mut self.errors);
        self.failures.count();
    }

    /// The angle was set: what was before it says nothing about the speed.
    pub fn jump(&mut self) {
        self.tacho = Tacho::default();
        self.turning = None;
    }

    /// How fast the shaft turned at the last frame, in revolutions per second, where that is known.
    #[must_use]
    pub const fn turning(&self) -> Option<f64> {
        self.turning
    }

    /// When the first frame came, and the last, good or bad.
    #[must_use]
    pub fn span(&self) -> Option<(Micros, Micros)> {
        match (self.angle.span(), self.errors.span()) {
            (Some(one), Some(other)) => Some((one.0.min(other.0), one.1.max(other.1))),
            (one, other) => one.or(other),
        }
    }

    /// Degrees.
    #[must_use]
    pub const fn angle(&self) -> &Series {
        &self.angle
    }

    /// Revolutions per second: the encoder's own, or derived from the angle.
    #[must_use]
    pub const fn speed(&self) -> &Series {
        &self.speed
    }

    /// Degrees Celsius.
    #[must_use]
    pub const fn temperature(&self) -> &Series {
        &self.temperature
    }

    /// Bad frames and requests without a reply within the last second.
    #[must_use]
    pub const fn errors(&self) -> &Series {
        &self.errors
    }
}

/// Adds errors up over a second.
#[derive(Clone, Debug, Default)]
struct Failures {
    /// Number of the slot that is being filled.
    slot: Option<Micros>,
    counts: [u32; SLOTS],
}

impl Failures {
    /// Goes on to the slot of `at`; each one that ends gives a sample.
    fn advance(&mut self, at: Micros, errors: &mut Series) {
        let now = at / SLOT;
        let slot = *self.slot.get_or_insert(now);
        let behind = now.saturating_sub(slot);
        // After a long pause nothing is left to be added up.
        for step in 1..=behind.min(SLOTS as Micros) {
            let sum: u64 = self.counts.iter().copied().map(u64::from).sum();
            errors.push((slot + step).saturating_mul(SLOT), sum as f64);
            self.counts.rotate_right(1);
            if let Some(first) = self.counts.first_mut() {
                *first = 0;
            }
        }
        self.slot = Some(slot.max(now));
    }

    fn count(&mut self) {
        if let Some(first) = self.counts.first_mut() {
            *first = first.saturating_add(1);
        }
    }
}
