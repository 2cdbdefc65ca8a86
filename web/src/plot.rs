//! What the plot and the standstill panel ask the engine for, and the trail that answers.

use encoderscope::{
    history::{History, Sample, Series},
    language::msg,
    session::Micros,
    standstill::Standstill,
};
use serde::{Deserialize, Serialize};

/// What can be plotted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Quantity {
    /// Degrees.
    Angle,
    /// Revolutions per second.
    Speed,
    /// Degrees Celsius.
    Temperature,
    /// Bad frames and requests without a reply within a second.
    Errors,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Angle, Self::Speed, Self::Temperature, Self::Errors];

    /// One word.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Angle => msg("angle"),
            Self::Speed => msg("speed"),
            Self::Temperature => msg("temperature"),
            Self::Errors => msg("errors"),
        }
    }

    /// The unit, with the space in front of it where there is one.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Angle => "°",
            Self::Speed => msg(" rev/s"),
            Self::Temperature => " °C",
            Self::Errors => msg(" a second"),
        }
    }

    const fn series(self, history: &History) -> &Series {
        match self {
            Self::Angle => history.angle(),
            Self::Speed => history.speed(),
            Self::Temperature => history.temperature(),
            Self::Errors => history.errors(),
        }
    }
}

/// A stretch of time; seconds since the link was opened.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Stretch {
    /// The last so many seconds.
    Last(f64),
    /// Everything.
    All,
    /// From the first to the second.
    Between(f64, f64),
}

/// What the page wants to plot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlotRequest {
    /// Which time.
    pub stretch: Stretch,
    /// How many columns the plot has, pixels as a rule.
    pub columns: u32,
    /// What is to be plotted.
    pub quantities: Vec<Quantity>,
}

/// What is to be plotted.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// Where it begins, in seconds since the link was opened.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Of what there is anything to plot.
    pub available: Vec<Quantity>,
    /// The quantities that were asked for.
    pub traces: Vec<Trace>,
}

/// One quantity over time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trace {
    /// Which.
    pub quantity: Quantity,
    /// Seconds since the link was opened, ascending.
    pub times: Vec<f64>,
    /// The values at these times; what is no number is a gap.
    pub values: Vec<f64>,
}

/// How much the angle of a shaft at rest varies.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rest {
    /// Readings within the last second.
    pub samples: f64,
    /// Standard deviation in counts.
    pub sigma: f64,
    /// From the lowest to the highest, in counts.
    pub peak_to_peak: f64,
    /// Arc-seconds in a count.
    pub arcseconds: f64,
    /// Counts in a bin.
    pub width: f64,
    /// Readings in each bin; the mean is in the middle one.
    pub bins: Vec<u32>,
}

/// What is kept of a link for the plot and the standstill panel.
#[derive(Debug)]
pub struct Trail {
    opened: Micros,
    history: History,
    standstill: Standstill,
}

impl Trail {
    /// Nothing yet of a link that was opened then.
    #[must_use]
    pub fn new(opened: Micros) -> Self {
        Self {
            opened,
            history: History::new(),
            standstill: Standstill::new(0),
        }
    }

    /// An encoder with so many bits per turn is being read.
    pub fn start(&mut self, angle_bits: u32) {
        self.history.jump();
        self.standstill = Standstill::new(angle_bits);
    }

    /// Takes the reading of a good frame; `angle` in counts.
    pub fn take(&mut self, at: Micros, angle: u64, sample: &Sample) {
        self.history.take(at.saturating_sub(self.opened), sample);
        self.standstill.push(at, angle);
    }

    /// Counts a bad frame or a request without a reply.
    pub fn fail(&mut self, at: Micros) {
        self.history.fail(at.saturating_sub(self.opened));
    }

    /// The angle may have been set.
    pub fn jump(&mut self) {
        self.history.jump();
        self.standstill.clear();
    }

    /// How fast the shaft turns, in revolutions per second, where that is known.
    #[must_use]
    pub const fn turning(&self) -> Option<f64> {
        self.history.turning()
    }

    /// What there is to plot; `now` is `None` where the link is closed and time stands still.
    #[must_use]
    pub fn plot(&self, now: Option<Micros>, request: &PlotRequest) -> Plot {
        let (first, last) = self.history.span().unwrap_or_default();
        let now = now.map_or(last, |now| now.saturating_sub(self.opened).max(last));
        let (from, to) = match request.stretch {
            Stretch::Last(seconds) => (seconds_of(now) - seconds, seconds_of(now)),
            Stretch::All => (seconds_of(first), seconds_of(now)),
            Stretch::Between(from, to) => (from, to),
        };
        let has = |quantity: &Quantity| !quantity.series(&self.history).is_empty();
        let trace = |quantity: Quantity| {
            let series = quantity.series(&self.history);
            let points = series.points(micros(from), micros(to), request.columns as usize);
            Trace {
                quantity,
                times: points.iter().map(|point| seconds_of(point.at)).collect(),
                values: points
                    .iter()
                    .map(|point| point.value.unwrap_or(f64::NAN))
                    .collect(),
            }
        };
        Plot {
            from,
            to,
            available: Quantity::ALL.into_iter().filter(has).collect(),
            traces: request.quantities.iter().copied().map(trace).collect(),
        }
    }

    /// How much the angle varied within the last second, where anything was read.
    #[must_use]
    pub fn rest(&mut self, now: Micros) -> Option<Rest> {
        self.standstill.forget(now);
        let figures = self.standstill.figures()?;
        Some(Rest {
            samples: figures.samples as f64,
            sigma: figures.sigma,
            peak_to_peak: figures.peak_to_peak as f64,
            arcseconds: figures.arcseconds(1.0),
            width: figures.width as f64,
            bins: figures.bins,
        })
    }
}

fn seconds_of(time: Micros) -> f64 {
    time as f64 / 1e6
}

/// What is before the opening counts as the opening.
fn micros(seconds: f64) -> Micros {
    (seconds * 1e6) as Micros
}
