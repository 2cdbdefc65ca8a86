//! Logic-analyser captures: edges of clock and data to frames, with the timing checked.
//!
//! The clock rests high. Its first falling edge latches the position; data changes on rising
//! edges and is read on falling ones (MPP and PT, "SSI" and "BISS-C"; IP-75, 5.4.1; P+F article,
//! figure 2). So n bits of an SSI word need n+1 falling edges and the first reads nothing. Of
//! BiSS-C every falling edge is read: line idle, acknowledge, start and cds come before the data,
//! and [`crate::decode::Decoder::line`] knows them. A frame is what the master clocks between two
//! pauses.
//!
//! ```
//! use encoderscope::{
//!     capture::{Capture, wave::Wave}, decode::Decoder, profile::Profile, reading::Values,
//! };
//! let profile = Profile::parse([("format", "ssi"), ("angle-bits", "16")])?;
//! let decoder = Decoder::new(profile)?;
//! let values = Values { turns: Some(5), angle: Some(0x4000), ..Values::default() };
//! let mut wave = Wave::new(&profile).expect("a master clocks SSI");
//! wave.frame(&decoder.encode(&values));
//!
//! let mut capture = Capture::new(&decoder).expect("a master clocks SSI");
//! for edge in wave.edges() {
//!     capture.push(edge);
//! }
//! capture.finish(wave.now());
//! let frame = capture.poll().expect("a frame");
//! assert_eq!((frame.clocks, &frame.violations[..]), (41, &[][..]));
//! assert_eq!(decoder.line(frame.bits.as_bits()).unwrap().values().turns, Some(5));
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```

mod burst;
mod changes;
mod extraction;
mod reader;
mod recording;
pub mod samples;
#[cfg(feature = "vcd")]
pub mod vcd;
mod violation;
pub mod wave;
mod wires;

pub use changes::Changes;
pub use extraction::Extraction;
pub use reader::Reader;
pub use recording::{Kind, Named, Options, Recording, Unreadable, sniff};
pub use violation::{Duration, Frequency, Violation, ViolationKind};
pub(crate) use wires::choose;
pub use wires::{Change, Reason, Signal, Use, Wires};

use crate::{
    bits::BitString,
    decode::Decoder,
    format::{
        Format, biss_c,
        timing::{Timing, Words},
    },
    profile::{Justify, Profile},
};
use alloc::{collections::VecDeque, vec::Vec};
use burst::{Burst, Judged};

/// Clock edges of a burst that are kept: a clock that does not pause is cut here.
const MOST_EDGES: usize = 8192;
/// Violations that are kept where there is no frame to tell them of.
const MOST_STRAY: usize = 1024;
/// A silence of more than so many half periods is no part of a burst.
const PAUSE_FACTOR: i64 = 2;

/// One of the two wires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wire {
    /// CLOCK or MA, from the master.
    Clock,
    /// DATA or SLO, from the encoder.
    Data,
}

/// A wire takes a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// When, in picoseconds; may be negative where the recording's trigger is at 0.
    pub time: i64,
    /// Which wire.
    pub wire: Wire,
    /// Its level from then on.
    pub level: bool,
}

/// What the times of a capture are worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clocking {
    /// Picoseconds, told apart from this many on.
    Timed(i64),
    /// Samples of an unknown period: durations are compared with one another only.
    Counted,
}

/// A frame: what was clocked between two pauses.
#[derive(Clone, Debug, PartialEq)]
pub struct Clocked {
    /// When the first falling edge latched the position, in picoseconds.
    pub time: i64,
    /// The bits as they were read. Of SSI exactly the word, then what further clocks brought; of
    /// BiSS-C from the idle line on.
    pub bits: BitString,
    /// Falling edges of the clock.
    pub clocks: u32,
    /// Frequency of the clock in hertz; of a single clock there is none.
    pub hertz: Option<f64>,
    /// SSI7: level of the data line in the gap behind the word, the error flag E (IP-75, 5.4.1,
    /// note 3; the manual does not name its polarity).
    pub gap: Option<bool>,
    /// What is wrong, by the clock at which it is.
    pub violations: Vec<Violation>,
}

impl Clocked {
    /// When the position was latched, in seconds.
    #[must_use]
    pub const fn seconds(&self) -> f64 {
        self.time as f64 / 1e12
    }
}

/// Reads edges, in the order of their times, into frames. Its memory is bounded.
#[derive(Clone, Debug)]
pub struct Capture {
    rules: Rules,
    clock: Option<bool>,
    data: Option<bool>,
    /// When anything was first known.
    begin: Option<i64>,
    burst: Burst,
    /// A frame that may turn out to be aborted by what comes next.
    held: Option<Judged>,
    /// Clocks of the frame before that.
    clocks: u32,
    /// What was found where there is no frame to tell it of.
    stray: Vec<Violation>,
    /// Half a period of the frame before.
    half: i64,
    /// Acknowledge of the frame before.
    acknowledge: Option<u32>,
    /// With the level of the data line before each.
    out: VecDeque<(Clocked, bool)>,
}

/// What frames are measured by.
#[derive(Clone, Copy, Debug)]
struct Rules {
    profile: Profile,
    /// Bits of a frame as the profile describes it; of BiSS-C with one idle bit.
    frame: u32,
    timing: &'static Timing,
    clocking: Clocking,
}

impl Rules {
    fn is_biss(&self) -> bool {
        self.profile.format == Format::BissC
    }

    /// Bits of the word; of BiSS-C from the acknowledge on.
    fn word(&self) -> u32 {
        self.frame - u32::from(self.is_biss())
    }

    /// Falling edges that latch or read the idle line.
    fn before_word(&self) -> u32 {
        if self.is_biss() {
            biss_c::IDLE_CLOCKS
        } else {
            1
        }
    }

    /// Falling edges of a frame, as far as it is known before one is read.
    fn needed(&self) -> u32 {
        self.before_word() + self.word()
    }

    const fn resolution(&self) -> i64 {
        match self.clocking {
            Clocking::Timed(resolution) => resolution,
            Clocking::Counted => 1,
        }
    }

    const fn is_timed(&self) -> bool {
        matches!(self.clocking, Clocking::Timed(_))
    }

    /// Whether the clock, silent for `gap` where half a period lasts `half`, may have been
    /// silent long enough for the encoder to give the reading up.
    fn is_silent(&self, gap: i64, half: i64) -> bool {
        let longer = gap > half.saturating_mul(PAUSE_FACTOR);
        match self.clocking {
            Clocking::Timed(_) => longer && gap > self.timing.silence(),
            Clocking::Counted => longer,
        }
    }

    /// Whether an edge to `level` after `gap` begins another burst.
    fn splits(&self, burst: &Burst, gap: i64, level: bool) -> bool {
        // Most edges come soon.
        let whole = !level && self.timing.words == Words::Once && burst.falls() >= self.needed();
        if self.is_timed() && gap <= self.timing.silence() && !whole {
            return false;
        }
        let Some(half) = burst.recent_half() else {
            // One edge is not yet a clock: after a rising one the line rests.
            return !level && self.is_timed() && gap > self.timing.silence();
        };
        whole && gap > half.saturating_mul(PAUSE_FACTOR) || self.is_silent(gap, half)
    }
}

impl Capture {
    /// A capture of a format that a master clocks; `None` for the others.
    #[must_use]
    pub fn new(decoder: &Decoder) -> Option<Self> {
        let profile = *decoder.profile();
        Some(Self {
            rules: Rules {
                profile,
                frame: decoder.main_layout().len as u32,
                timing: profile.format.timing()?,
                clocking: Clocking::Timed(0),
            },
            clock: None,
            data: None,
            begin: None,
            burst: Burst::default(),
            held: None,
            clocks: 0,
            stray: Vec::new(),
            half: 0,
            acknowledge: None,
            out: VecDeque::new(),
        })
    }

    /// This capture with times that are worth `clocking`.
    #[must_use]
    pub const fn with_clocking(mut self, clocking: Clocking) -> Self {
        self.rules.clocking = clocking;
        self
    }

    /// The profile that reads the bits: they begin with the frame, whatever follows it.
    #[must_use]
    pub const fn profile(&self) -> Profile {
        Profile {
            justify: Justify::Left,
            ..self.rules.profile
        }
    }

    /// Takes an edge. The first one of each wire says which level it has; edges that change
    /// nothing are ignored.
    pub fn push(&mut self, edge: Edge) {
        self.begin.get_or_insert(edge.time);
        match edge.wire {
            Wire::Data => {
                if self.data.replace(edge.level) != Some(edge.level) {
                    self.burst.data_edge(edge.time, edge.level);
                }
            }
            Wire::Clock => match self.clock.replace(edge.level) {
                Some(before) if before != edge.level => self.clock_edge(edge),
                _ => {}
            },
        }
    }

    /// Says that nothing more comes, and when the recording ended.
    pub fn finish(&mut self, end: i64) {
        self.close(end, Ending::Recording);
        if let Some(mut last) = self.held.take() {
            // A frame as long as the one before is not cut, wherever the recording ends.
            let same = last.frame.clocks == self.clocks;
            let silence = end.saturating_sub(last.end);
            if !same && !self.rules.is_silent(silence, last.half) {
                last.cut();
            }
            self.release(last, None);
        }
    }

    /// The next frame.
    pub fn poll(&mut self) -> Option<Clocked> {
        self.next().map(|(frame, _)| frame)
    }

    /// The next frame, and the level at which the data line was before it.
    fn next(&mut self) -> Option<(Clocked, bool)> {
        self.out.pop_front()
    }

    /// Takes what was found behind the last frame or without any.
    #[must_use]
    pub fn stray(&mut self) -> Vec<Violation> {
        core::mem::take(&mut self.stray)
    }

    fn clock_edge(&mut self, edge: Edge) {
        if let Some(last) = self.burst.last_edge() {
            let gap = edge.time.saturating_sub(last);
            if self.burst.edges() >= MOST_EDGES {
                self.stray.truncate(MOST_STRAY);
                self.stray.push(Violation {
                    time: edge.time,
                    clock: None,
                    kind: ViolationKind::Endless {
                        clocks: self.burst.falls(),
                    },
                    timing: self.rules.timing,
                });
                self.close(edge.time, Ending::Clock);
            } else if self.rules.splits(&self.burst, gap, edge.level) {
                self.close(edge.time, Ending::Clock);
            }
        }
        self.burst.clock_edge(edge.time, edge.level);
    }

    /// Ends the burst and the silence after it.
    fn close(&mut self, end: i64, ending: Ending) {
        let burst = self.burst.take(self.data);
        let Some(half) = burst.half(self.half) else {
            return;
        };
        let mut judged = burst.judge(&self.rules, half, self.acknowledge, (end, ending));
        let Some(first) = judged.first else {
            // Nothing but glitches: told of with the next frame.
            self.stray.append(&mut judged.frame.violations);
            self.stray.truncate(MOST_STRAY);
            return;
        };
        self.half = half;
        let strays = core::mem::take(&mut self.stray);
        judged.frame.violations.splice(0..0, strays);
        match self.held.take() {
            Some(before) => {
                self.clocks = before.frame.clocks;
                let gap = judged.start.saturating_sub(before.end);
                let aborted = before.is_aborted_by(&judged);
                if aborted {
                    judged.remain();
                } else {
                    judged.paused(&self.rules, first.saturating_sub(before.end));
                }
                self.release(before, aborted.then_some(gap));
            }
            None => judged.opened(&self.rules, self.begin.unwrap_or(judged.start)),
        }
        self.acknowledge = judged.acknowledge.or(self.acknowledge);
        self.held = Some(judged);
    }

    fn release(&mut self, judged: Judged, aborted: Option<i64>) {
        let idle = judged.idle;
        self.out
            .push_back((judged.concluded(&self.rules, aborted), idle));
    }
}

/// What ended a burst.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ending {
    /// Another one.
    Clock,
    /// The end of the recording.
    Recording,
}
