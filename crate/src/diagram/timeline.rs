//! The timing of one frame as data.

use super::{Limit, clocked, uart};
use crate::{bits::Bits, format::Link, language::msg, layout::Resolved};
use alloc::vec::Vec;

/// How a master clocks a frame out; formats of a serial line have their baud rate instead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Master {
    /// Frequency of the clock in hertz.
    pub hertz: u32,
    /// How long the first low lasts in picoseconds, up to ten seconds, where it is not half a
    /// period.
    pub first_low: Option<i64>,
    /// How long the clock rests behind the frame in picoseconds, up to ten seconds; as long as the manual asks where
    /// nobody says otherwise.
    pub pause: Option<i64>,
}

impl Default for Master {
    /// 1 MHz, which every manual allows.
    fn default() -> Self {
        Self {
            hertz: 1_000_000,
            first_low: None,
            pause: None,
        }
    }
}

/// Who drives a wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The master that clocks, or the host that asks.
    Master,
    /// The encoder.
    Encoder,
}

/// A wire takes a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// When, in picoseconds.
    pub time: i64,
    /// Its level from then on.
    pub level: bool,
}

/// One wire, or one direction of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lane {
    /// What it is called: CLOCK and DATA, MA and SLO, host and encoder.
    pub name: &'static str,
    /// Who drives it.
    pub side: Side,
    /// Its levels, the first from time 0 on; each differs from the one before.
    pub steps: Vec<Step>,
}

impl Lane {
    pub(super) const fn new(name: &'static str, side: Side) -> Self {
        Self {
            name,
            side,
            steps: Vec::new(),
        }
    }

    /// Takes a level, in the order of time.
    pub(super) fn step(&mut self, time: i64, level: bool) {
        if self.steps.last().is_none_or(|last| last.level != level) {
            self.steps.push(Step { time, level });
        }
    }

    /// Its level at a time; before its first step it rests high.
    #[must_use]
    pub fn level_at(&self, time: i64) -> bool {
        let after = self.steps.partition_point(|step| step.time <= time);
        let last = after.checked_sub(1).and_then(|index| self.steps.get(index));
        last.is_none_or(|step| step.level)
    }
}

/// What a stretch of time is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// A bit of the frame, by its index.
    Bit(usize),
    /// A bit of the request, by its index; the most significant bit of each byte counts first.
    Request(usize),
    /// Start bit: of a byte, or behind the acknowledge of BiSS-C.
    Start,
    /// Stop bit of a byte.
    Stop,
    /// The first low of the clock: its falling edge latches the position, and nothing is read.
    Latch,
    /// An acknowledge bit of BiSS-C that is not in the frame as it was given.
    Acknowledge,
    /// The control data bit of BiSS-C, where it is not in the frame as it was given.
    Cds,
    /// The line rests.
    Idle,
    /// From the request to the reply.
    Turnaround,
    /// Behind the last bit, until the encoder is ready for the next reading.
    TimeOut,
    /// The same stretch of SSI7, in which the data line carries the error flag E.
    ErrorFlag,
    /// The clock, or a stream, rests before the next frame.
    Pause,
}

impl What {
    /// What it is called.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bit(_) => msg("bit"),
            Self::Request(_) => msg("request"),
            Self::Start => msg("start"),
            Self::Stop => msg("stop"),
            Self::Latch => msg("latch"),
            Self::Acknowledge => msg("ack"),
            Self::Cds => msg("cds"),
            Self::Idle => msg("idle"),
            Self::Turnaround => msg("turnaround"),
            Self::TimeOut => msg("time-out"),
            Self::ErrorFlag => msg("error flag"),
            Self::Pause => msg("pause"),
        }
    }
}

/// A stretch of time on one lane. Times are in picoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// What it is.
    pub what: What,
    /// Index of its lane.
    pub lane: usize,
    /// When it begins.
    pub from: i64,
    /// When it ends.
    pub to: i64,
    /// When its level is read: at a falling edge of the clock, or in the middle of a UART's bit.
    pub sampled: Option<i64>,
}

/// The timing of one frame, with the request it answers. Times are in picoseconds from 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Timeline {
    /// The wires; the encoder's is the last.
    pub lanes: Vec<Lane>,
    /// What the stretches of time are, those of one lane in the order of time.
    pub slots: Vec<Slot>,
    /// What the manual asks.
    pub limits: Vec<Limit>,
    /// Where a drawing on a grid has its lines: the edges of the clock, or the ends of a UART's
    /// bits. The first is 0, the last the end.
    pub ticks: Vec<i64>,
    /// When it is over.
    pub end: i64,
}

impl Timeline {
    /// The timing of a frame that `layout` describes.
    ///
    /// Words are clocked out as `master` says; a user's own layout has no manual, so its clock has
    /// the times of MPP and PT and no limits. A serial line sends 8N1 at the profile's baud rate,
    /// and a request stands in front of its reply.
    ///
    /// What a dump holds in front of a word, and in front of BiSS-C data without an acknowledge,
    /// is not on the wire and has no slot; an acknowledge that is missing is put in its place.
    #[must_use]
    pub fn new(layout: &Resolved, bits: Bits<'_>, master: &Master) -> Self {
        match layout.shape.profile.link() {
            Link::Clocked => clocked::timeline(layout, bits, master),
            Link::Polled | Link::Stream => uart::timeline(layout, bits),
        }
    }

    /// The timing of a request alone, whose bits `layout` describes.
    #[must_use]
    pub fn request(layout: &Resolved, bits: Bits<'_>) -> Self {
        uart::request_alone(layout, bits)
    }

    /// The lane of the encoder; of a request alone that of the host.
    #[must_use]
    pub fn encoder(&self) -> usize {
        self.lanes.len().saturating_sub(1)
    }

    /// The slot of a bit of the frame.
    #[must_use]
    pub fn slot_of(&self, bit: usize) -> Option<&Slot> {
        let mut slots = self.slots.iter();
        slots.find(|slot| slot.what == What::Bit(bit))
    }

    /// The bit of the frame that is on the wire at a time.
    #[must_use]
    pub fn bit_at(&self, time: i64) -> Option<usize> {
        self.slots.iter().find_map(|slot| match slot.what {
            What::Bit(bit) if (slot.from..slot.to).contains(&time) => Some(bit),
            _ => None,
        })
    }

    /// The slots of a lane, in the order of time.
    pub fn of_lane(&self, lane: usize) -> impl Iterator<Item = &Slot> {
        self.slots.iter().filter(move |slot| slot.lane == lane)
    }

    /// This timeline in order, without stretches that take no time.
    pub(super) fn sorted(mut self) -> Self {
        self.ticks.push(0);
        self.ticks.push(self.end);
        self.ticks.sort_unstable();
        self.ticks.dedup();
        self.slots.retain(|slot| slot.from < slot.to);
        self.slots.sort_by_key(|slot| (slot.lane, slot.from));
        self
    }
}
