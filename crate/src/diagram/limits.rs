//! What the manuals ask of the one who reads, measured on a timeline.

use crate::{
    capture::{Duration, Frequency},
    format::timing::{Beyond, MICROSECOND, Timing},
    language::{msg, t},
    text,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// A limit of a manual, and how the timeline stands to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limit {
    /// What is limited.
    pub name: &'static str,
    /// What the manual asks.
    pub text: String,
    /// Where it says so.
    pub source: &'static str,
    /// What it is here.
    pub value: String,
    /// Whether that is allowed.
    pub holds: bool,
    /// Where on the timeline it is measured, from and to, in picoseconds.
    pub at: (i64, i64),
}

/// A clock as it is. Times are in picoseconds.
pub(super) struct Clock {
    pub(super) half: i64,
    pub(super) first_low: i64,
    pub(super) pause: i64,
    /// The first falling and rising edge.
    pub(super) fall: i64,
    pub(super) rise: i64,
    /// The last ones.
    pub(super) last_fall: i64,
    pub(super) last_rise: i64,
}

impl Clock {
    pub(super) fn limits(&self, timing: &Timing, hertz: u32) -> Vec<Limit> {
        let source = timing.source;
        let speed = |hertz: u32| Frequency(hertz.into()).to_string();
        let (slowest, fastest) = (speed(timing.slowest), speed(timing.fastest));
        let beyond = match timing.beyond {
            Beyond::Never => String::new(),
            Beyond::FirstLow { fastest, low } => text!(
                ", up to {} with a first low of {}",
                speed(fastest),
                Duration(low)
            ),
            Beyond::Compensated { fastest } => text!(
                ", up to {} where the master compensates the delay of the line",
                speed(fastest)
            ),
        };
        let mut limits = Vec::from([Limit {
            name: msg("clock"),
            text: format!("{slowest}…{fastest}{beyond}"),
            source,
            value: speed(hertz),
            holds: (timing.slowest..=timing.limit()).contains(&hertz),
            at: (self.rise, self.rise.saturating_add(self.half * 2)),
        }]);
        if let Beyond::FirstLow { low, .. } = timing.beyond
            && hertz > timing.fastest
        {
            limits.push(Limit {
                name: msg("first low"),
                text: text!("{} above {}", Duration(low), fastest),
                source,
                value: Duration(self.first_low).to_string(),
                holds: self.first_low >= low,
                at: (self.fall, self.rise),
            });
        }
        let rest = self.half.max(self.first_low);
        limits.push(Limit {
            name: msg("time-out"),
            text: text!(
                "{}: the encoder gives the reading up when the clock rests so long",
                t(timing.timeout_text)
            ),
            source,
            value: text!("the clock rests for {}", Duration(rest)),
            holds: rest < timing.silence(),
            at: (
                self.last_fall,
                self.last_fall.saturating_add(timing.timeout),
            ),
        });
        limits.push(Limit {
            name: msg("pause"),
            text: t(timing.pause_text).into(),
            source,
            value: Duration(self.pause).to_string(),
            holds: self.pause >= timing.pause,
            at: (self.last_rise, self.last_rise.saturating_add(self.pause)),
        });
        limits
    }
}

/// A stream that sends a frame every `interval` microseconds, measured on one frame.
pub(super) fn interval(source: &'static str, interval: u64, at: (i64, i64)) -> Limit {
    let every = micros(interval);
    let lasts = at.1.saturating_sub(at.0);
    Limit {
        name: msg("interval"),
        text: text!("a frame every {}", Duration(every)),
        source,
        value: text!("a frame lasts {}", Duration(lasts)),
        holds: lasts <= every,
        at: (at.0, at.0.saturating_add(every)),
    }
}

/// The other devices of a BUS are deaf for `suspend` microseconds, so that they do not take the
/// reply, which ends at `at.1`, for requests.
pub(super) fn suspend(suspend: u64, at: (i64, i64)) -> Limit {
    let deaf = micros(suspend);
    let lasts = at.1.saturating_sub(at.0);
    Limit {
        name: msg("suspend"),
        text: text!("other devices are deaf for {}", Duration(deaf)),
        source: msg("MPP, BUS, T_SUSPEND"),
        value: text!("the reply is over after {}", Duration(lasts)),
        holds: lasts <= deaf,
        at: (at.0, at.0.saturating_add(deaf)),
    }
}

fn micros(micros: u64) -> i64 {
    i64::try_from(micros)
        .unwrap_or(i64::MAX)
        .saturating_mul(MICROSECOND)
}
