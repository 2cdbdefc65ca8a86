//! What a logic analyser would record of a master and an encoder: frames to edges.

use super::{Edge, Wire};
use crate::{
    bits::{BitString, Bits},
    format::{
        Format,
        timing::{MICROSECOND, NANOSECOND, SECOND, Timing, Words},
    },
    profile::Profile,
};
use alloc::vec::Vec;

/// A master that clocks frames out of an encoder, and both wires as they are seen on the way.
///
/// The public fields say how the next frames are clocked; a master that does as the manual says
/// is what [`Wave::new`] makes. Times are in picoseconds.
#[derive(Clone, Debug)]
pub struct Wave {
    /// Frequency of the clock in hertz.
    pub hertz: u32,
    /// How long the clock rests before a frame.
    pub pause: i64,
    /// How long the first low lasts, where it is not half a period.
    pub first_low: Option<i64>,
    /// From a rising edge to the data that it brings.
    pub delay: i64,
    /// From the last falling edge to the data line becoming high.
    pub timeout: i64,
    /// Clocks more, or less, than a frame needs.
    pub extra: i32,
    /// A clock whose high, or low, lasts this long instead.
    pub long: Option<Long>,
    /// A short pulse in the high of a clock.
    pub glitch: Option<Glitch>,
    /// What the data line shows behind the word: 0, or the error flag of SSI7.
    pub behind: bool,
    /// The encoder does not answer; the line stays at this level.
    pub stuck: Option<bool>,
    format: Format,
    timing: &'static Timing,
    now: i64,
    edges: Vec<Edge>,
    encoder: Encoder,
}

/// Half a clock that lasts long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Long {
    /// Which clock, from 1 on.
    pub clock: u32,
    /// Which half of it.
    pub level: bool,
    /// How long.
    pub lasts: i64,
}

/// A pulse that is no clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Glitch {
    /// In the high half of which clock, from 1 on.
    pub clock: u32,
    /// How long it lasts.
    pub width: i64,
}

/// The encoder: a shift register, and a time that runs from every falling edge.
#[derive(Clone, Debug)]
struct Encoder {
    /// Rising edges since the position was latched.
    rises: u32,
    fell: Option<i64>,
    level: bool,
}

impl Wave {
    /// A master and an encoder that do as the manual says; `None` for formats without a clock.
    #[must_use]
    pub fn new(profile: &Profile) -> Option<Self> {
        let timing = profile.format.timing()?;
        Some(Self::with(profile.format, timing))
    }

    /// An encoder that sends every bit it is given from the first rising edge on, idle ones too.
    pub(crate) fn verbatim(timing: &'static Timing) -> Self {
        Self::with(Format::Ssi, timing)
    }

    fn with(format: Format, timing: &'static Timing) -> Self {
        let mut wave = Self {
            hertz: 1_000_000,
            pause: timing.pause * 2,
            first_low: None,
            delay: 50 * NANOSECOND,
            timeout: timing.timeout,
            extra: 0,
            long: None,
            glitch: None,
            behind: false,
            stuck: None,
            format,
            timing,
            now: 0,
            edges: Vec::new(),
            encoder: Encoder {
                rises: 0,
                fell: None,
                level: true,
            },
        };
        wave.edge(0, Wire::Clock, true);
        wave.edge(0, Wire::Data, true);
        wave
    }

    /// When the last frame and the time-out behind it are over.
    #[must_use]
    pub const fn now(&self) -> i64 {
        self.now
            .saturating_add(MICROSECOND)
            .saturating_add(self.timeout)
    }

    /// All edges in the order of their times, the levels at the start first.
    #[must_use]
    pub fn edges(&self) -> Vec<Edge> {
        let mut edges = self.edges.clone();
        if let Some(fell) = self.encoder.fell {
            let time = fell.saturating_add(self.timeout);
            edges.push(Edge {
                time,
                wire: Wire::Data,
                level: self.stuck.unwrap_or(true),
            });
        }
        edges.sort_by_key(|edge| edge.time);
        edges
    }

    /// Clocks a frame out: the pause, then all clocks that `bits` need.
    ///
    /// Of SSI `bits` are the word, of BiSS-C everything from the acknowledge on; idle bits before
    /// are passed over.
    pub fn frame(&mut self, bits: &BitString) {
        let bits = bits.as_bits();
        let idle = match self.format {
            Format::BissC => (0..bits.len()).take_while(|at| bits.bit(*at)).count(),
            _ => 0,
        };
        let clocks = (bits.len() - idle) as i64 + self.before() + i64::from(self.extra);
        let half = SECOND / 2 / i64::from(self.hertz.max(1));
        let lasts = |clock: i64, level: bool, usual: i64| match self.long {
            Some(long) if i64::from(long.clock) == clock && long.level == level => long.lasts,
            _ => usual,
        };
        let mut time = self.now.saturating_add(self.pause);
        let mut steps = Vec::new();
        for clock in 1..=clocks {
            let first = if clock == 1 { self.first_low } else { None };
            let rise = time.saturating_add(lasts(clock, false, first.unwrap_or(half)));
            steps.push((time, rise));
            time = rise.saturating_add(lasts(clock, true, half));
        }
        for ((fall, rise), clock) in steps.into_iter().zip(1u32..) {
            self.fall(fall);
            self.rise(rise, bits, idle);
            if let Some(glitch) = self.glitch.filter(|glitch| glitch.clock == clock) {
                let start = rise.saturating_add(half / 2);
                self.edge(start, Wire::Clock, false);
                let end = start.saturating_add(glitch.width);
                self.edge(end, Wire::Clock, true);
            }
            self.now = rise;
        }
    }

    /// Falling edges before the first bit is read.
    const fn before(&self) -> i64 {
        match self.format {
            Format::BissC => crate::format::biss_c::IDLE_CLOCKS as i64,
            _ => 1,
        }
    }

    fn edge(&mut self, time: i64, wire: Wire, level: bool) {
        self.edges.push(Edge { time, wire, level });
    }

    fn data(&mut self, time: i64, level: bool) {
        let level = self.stuck.unwrap_or(level);
        if self.encoder.level != level {
            self.encoder.level = level;
            self.edge(time, Wire::Data, level);
        }
    }

    fn fall(&mut self, time: i64) {
        self.edge(time, Wire::Clock, false);
        if let Some(fell) = self.encoder.fell
            && time.saturating_sub(fell) >= self.timeout
        {
            self.data(fell.saturating_add(self.timeout), true);
            self.encoder.rises = 0;
        }
        self.encoder.fell = Some(time);
    }

    fn rise(&mut self, time: i64, bits: Bits<'_>, idle: usize) {
        self.edge(time, Wire::Clock, true);
        self.encoder.rises += 1;
        // The line is pulled at the edge that brings the first bit.
        let Some(index) = (i64::from(self.encoder.rises) - self.before())
            .try_into()
            .ok()
        else {
            return;
        };
        let index: usize = index;
        let len = bits.len() - idle;
        let again = match self.timing.words {
            Words::Ring => index % (len + 1),
            Words::Once => index,
        };
        let level = match again < len {
            true => bits.bit(idle + again),
            false => self.behind,
        };
        self.data(time.saturating_add(self.delay), level);
    }
}
