//! Which signal of a recording is the clock and which the data.

use crate::say;
use alloc::{
    string::{String, ToString},
    vec::Vec,
};
use core::fmt;

/// Runs between two edges are counted by the power of two of their length.
const CLASSES: usize = 64;
/// How many times as many edges as the data a clock has at least, in fifths. Data that changes
/// with every bit has half as many.
const FIFTHS: u64 = 8;

/// A signal takes a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Change {
    /// When, in picoseconds or samples.
    pub time: i64,
    /// Index of the signal.
    pub signal: usize,
    /// Its level from then on.
    pub level: bool,
}

/// What is known of a signal before it is read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signal {
    /// Its name in the recording.
    pub name: String,
    /// How often it changes.
    pub edges: u64,
    level: Option<bool>,
    since: i64,
    /// The longest run of each level.
    longest: [i64; 2],
    runs: [u64; CLASSES],
}

/// A wire as a signal of the recording.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Use {
    /// Index of the signal.
    pub signal: usize,
    /// Its name.
    pub name: String,
    /// Whether it is read upside down.
    pub inverted: bool,
}

/// Which signals the wires are, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wires {
    /// CLOCK or MA.
    pub clock: Use,
    /// DATA or SLO.
    pub data: Use,
    /// Why.
    pub reasons: Vec<Reason>,
}

/// Why a signal is taken for a wire.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// It was asked for.
    Asked(String),
    /// Its name says so.
    Named(String),
    /// It changes in regular bursts, more often than the others.
    Regular {
        /// Its name.
        name: String,
        /// How often it changes.
        edges: u64,
    },
    /// It changes with the clock, less often than it.
    Follows {
        /// Its name.
        name: String,
        /// How often it changes.
        edges: u64,
    },
    /// Two signals are called the other way round, or asked for so.
    Swapped {
        /// What is called the clock.
        clock: String,
        /// What is called the data.
        data: String,
    },
    /// The clock rests low.
    ClockRestsLow(String),
    /// The data line rests low.
    DataRestsLow(String),
    /// The signal never changes.
    Still {
        /// Its name.
        name: String,
        /// Its level, where it is known.
        level: Option<bool>,
    },
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Asked(name) => say!(f, "{}: as asked for", name),
            Self::Named(name) => say!(f, "{}: by its name", name),
            Self::Regular { name, edges } => say!(
                f,
                "{} is the clock: it changes most often and in regular bursts ({} edges)",
                name,
                edges
            ),
            Self::Follows { name, edges } => say!(
                f,
                "{} is the data: it changes less often than the clock ({} edges)",
                name,
                edges
            ),
            Self::Swapped { clock, data } => say!(
                f,
                "clock and data are swapped: {} has the regular bursts of a clock, {} has \
                 not",
                data,
                clock
            ),
            Self::ClockRestsLow(name) => say!(
                f,
                "{} rests low: read upside down, as the inverted wire of its pair; if it is \
                 not, the master's clock must rest high (CPOL 1)",
                name
            ),
            Self::DataRestsLow(name) => say!(
                f,
                "{} rests low: read upside down, as the inverted wire of its pair",
                name
            ),
            Self::Still { name, level } => match level {
                Some(level) => say!(f, "{} never changes, it stays {}", name, u8::from(*level)),
                None => say!(f, "{} never has a level", name),
            },
        }
    }
}

/// Words that name the clock, and the data.
const CLOCK_NAMES: &[&str] = &["clk", "clock", "ma", "scl", "sck", "sclk", "mclk", "takt"];
const DATA_NAMES: &[&str] = &["data", "slo", "dat", "miso", "sd", "dout", "sda", "sdo"];

impl Signal {
    /// A signal of which nothing is known but its name.
    #[must_use]
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_string(),
            edges: 0,
            level: None,
            since: 0,
            longest: [0; 2],
            runs: [0; CLASSES],
        }
    }

    /// Takes a level of this signal; whether it is the first one, or another one than before.
    pub fn change(&mut self, time: i64, level: bool) -> bool {
        match self.level.replace(level) {
            Some(before) if before == level => return false,
            Some(before) => {
                self.edges += 1;
                self.run(time, before);
            }
            None => {}
        }
        self.since = time;
        true
    }

    /// Says when the recording ended.
    pub fn finish(&mut self, time: i64) {
        if let Some(level) = self.level {
            self.run(time, level);
        }
    }

    fn run(&mut self, time: i64, level: bool) {
        let run = time.saturating_sub(self.since).max(0);
        if let Some(longest) = self.longest.get_mut(usize::from(level)) {
            *longest = run.max(*longest);
        }
        let class = run.checked_ilog2().unwrap_or(0) as usize;
        if let Some(count) = self.runs.get_mut(class) {
            *count += 1;
        }
    }

    /// Whether it ever has a level.
    #[must_use]
    pub const fn lives(&self) -> bool {
        self.level.is_some()
    }

    /// The level of the longest run.
    #[must_use]
    pub fn rests(&self) -> Option<bool> {
        match (self.edges, self.longest) {
            (0, _) => self.level,
            (_, [low, high]) => Some(high >= low),
        }
    }

    /// How many runs are about as long as most are, in thousandths.
    fn regularity(&self) -> u64 {
        let all: u64 = self.runs.iter().sum();
        let pairs = self.runs.iter().zip(self.runs.iter().skip(1));
        let most = pairs.map(|(a, b)| a + b).max().unwrap_or(0);
        most * 1000 / all.max(1)
    }

    fn is_called(&self, names: &[&str]) -> bool {
        let lower = self.name.to_ascii_lowercase();
        let last = lower.rsplit(['.', '/', ':', ' ']).next().unwrap_or(&lower);
        let word = last.trim_matches(|letter: char| !letter.is_ascii_alphabetic());
        names.iter().any(|name| {
            word == *name
                || word
                    .split(|letter: char| !letter.is_ascii_alphanumeric())
                    .any(|part| {
                        part.trim_end_matches(|digit: char| digit.is_ascii_digit()) == *name
                    })
        })
    }

    /// Whether it may be the other wire of the same pair.
    fn mirrors(&self, other: &Self) -> bool {
        self.edges > 0 && self.edges == other.edges && self.runs == other.runs
    }
}

/// Chooses the wires; `asked` are the signals that the user named, clock and data.
///
/// `None` where there is no second signal.
#[must_use]
pub(crate) fn choose(signals: &[Signal], asked: (Option<usize>, Option<usize>)) -> Option<Wires> {
    let mut reasons = Vec::new();
    let mut clock = asked.0;
    let mut data = asked.1.filter(|_| asked.0 != asked.1);
    for index in [clock, data].into_iter().flatten() {
        reasons.extend(
            signals
                .get(index)
                .map(|signal| Reason::Asked(signal.name.clone())),
        );
    }
    // A pair of two wires has both names; the one that rests high is taken.
    let named = |names: &[&str], taken: Option<usize>| {
        let called = signals.iter().enumerate().filter(|(index, signal)| {
            Some(*index) != taken && signal.lives() && signal.is_called(names)
        });
        called
            .max_by_key(|(index, signal)| {
                (
                    signal.edges > 0,
                    signal.rests() == Some(true),
                    core::cmp::Reverse(*index),
                )
            })
            .map(|(index, _)| index)
    };
    for (wire, names) in [(0, CLOCK_NAMES), (1, DATA_NAMES)] {
        let (own, other) = if wire == 0 {
            (&mut clock, data)
        } else {
            (&mut data, clock)
        };
        if own.is_none()
            && let Some(index) = named(names, other)
        {
            *own = Some(index);
            reasons.extend(
                signals
                    .get(index)
                    .map(|signal| Reason::Named(signal.name.clone())),
            );
        }
    }
    let swapped = match (clock, data) {
        (Some(c), Some(d)) => signals.get(c).zip(signals.get(d)).filter(|(c, d)| {
            d.edges * 5 >= c.edges * FIFTHS && d.edges > 4 && d.regularity() > c.regularity()
        }),
        _ => None,
    };
    if let Some((called_clock, called_data)) = swapped {
        reasons.push(Reason::Swapped {
            clock: called_clock.name.clone(),
            data: called_data.name.clone(),
        });
        core::mem::swap(&mut clock, &mut data);
    }
    let clock = match clock {
        Some(index) => index,
        None => {
            let others = signals
                .iter()
                .enumerate()
                .filter(|(index, signal)| Some(*index) != data && signal.lives());
            let (index, signal) = others.max_by_key(|(index, signal)| {
                (
                    signal.edges.saturating_mul(signal.regularity()),
                    signal.rests() == Some(true),
                    core::cmp::Reverse(*index),
                )
            })?;
            reasons.push(Reason::Regular {
                name: signal.name.clone(),
                edges: signal.edges,
            });
            index
        }
    };
    let chosen = signals.get(clock)?;
    let data = match data {
        Some(index) => index,
        None => {
            let others = signals.iter().enumerate().filter(|(index, signal)| {
                *index != clock && signal.lives() && !signal.mirrors(chosen)
            });
            let (index, signal) = others.max_by_key(|(index, signal)| {
                let follows = signal.edges * FIFTHS <= chosen.edges * 5 + FIFTHS * 2;
                (
                    follows,
                    signal.edges,
                    signal.rests() == Some(true),
                    core::cmp::Reverse(*index),
                )
            })?;
            reasons.push(Reason::Follows {
                name: signal.name.clone(),
                edges: signal.edges,
            });
            index
        }
    };
    for index in [clock, data] {
        if let Some(still) = signals.get(index).filter(|signal| signal.edges == 0) {
            reasons.push(Reason::Still {
                name: still.name.clone(),
                level: still.level,
            });
        }
    }
    let inverted = chosen.edges > 0 && chosen.rests() == Some(false);
    if inverted {
        reasons.push(Reason::ClockRestsLow(chosen.name.clone()));
    }
    let wire = |signal: usize, inverted: bool| {
        let name = signals.get(signal)?.name.clone();
        Some(Use {
            signal,
            name,
            inverted,
        })
    };
    Some(Wires {
        clock: wire(clock, inverted)?,
        data: wire(data, false)?,
        reasons,
    })
}
