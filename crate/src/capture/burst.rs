//! One burst of clock edges: its bits, and what is wrong with it.

mod judged;

pub(super) use judged::Judged;

use super::{Clocked, Ending, Rules, Violation, ViolationKind};
use crate::{
    bits::{BitString, Bits},
    format::{
        Format, biss_c,
        timing::{Beyond, SECOND},
    },
};
use alloc::vec::Vec;
use judged::State;

/// Data edges of a burst that are kept; what follows is noise.
const MOST_DATA: usize = 2 * super::MOST_EDGES;
/// Of the half periods before an edge, how many say how long one lasts.
const RECENT: usize = 16;
/// A pulse shorter than this part of half a period is no clock.
const GLITCH: i64 = 4;
/// Half periods that say what half a period is.
const ENOUGH: usize = 4;
/// What a measured time may be beside a limit, in per cent: a recorder's clock is no standard.
const TOLERANCE: i64 = 1;

/// A level and since when.
#[derive(Clone, Copy, Debug)]
struct Step {
    time: i64,
    level: bool,
}

/// Clock edges without a pause between, and the data from the first of them on.
#[derive(Clone, Debug, Default)]
pub(super) struct Burst {
    clock: Vec<Step>,
    data: Vec<Step>,
    /// Level of the data before its first edge.
    initial: Option<bool>,
    falls: u32,
}

impl Burst {
    pub(super) fn clock_edge(&mut self, time: i64, level: bool) {
        self.clock.push(Step { time, level });
        self.falls += u32::from(!level);
    }

    pub(super) fn data_edge(&mut self, time: i64, level: bool) {
        self.initial.get_or_insert(!level);
        if self.data.len() < MOST_DATA {
            self.data.push(Step { time, level });
        }
    }

    pub(super) fn edges(&self) -> usize {
        self.clock.len()
    }

    pub(super) const fn falls(&self) -> u32 {
        self.falls
    }

    pub(super) fn last_edge(&self) -> Option<i64> {
        self.clock.last().map(|edge| edge.time)
    }

    /// The burst so far; the next one begins with the data at `level`.
    pub(super) fn take(&mut self, level: Option<bool>) -> Self {
        let next = Self {
            initial: level,
            ..Self::default()
        };
        core::mem::replace(self, next)
    }

    /// How long half a period has lasted lately.
    pub(super) fn recent_half(&self) -> Option<i64> {
        let from = self.clock.len().saturating_sub(RECENT + 1);
        let recent = self.clock.get(from..).unwrap_or_default();
        ranked(recent, 2)
    }

    /// How long half a period lasts, uneven ones as the shorter; `before` where there are too
    /// few to say. Nothing where there is no clock.
    pub(super) fn half(&self, before: i64) -> Option<i64> {
        if self.clock.len() > ENOUGH || before == 0 {
            ranked(&self.clock, 4).or((!self.clock.is_empty()).then_some(0))
        } else {
            Some(before)
        }
    }

    /// The level of the data just before `time`.
    fn data_at(&self, time: i64) -> bool {
        let after = self.data.partition_point(|step| step.time < time);
        match after.checked_sub(1).and_then(|index| self.data.get(index)) {
            Some(step) => step.level,
            None => self.initial.unwrap_or(true),
        }
    }

    /// The clock without pulses that are far too short.
    fn steady(&mut self, half: i64, mut glitch: impl FnMut(i64, u32, i64)) {
        let mut kept: Vec<Step> = Vec::with_capacity(self.clock.len());
        let mut falls = 0;
        for edge in core::mem::take(&mut self.clock) {
            let width = kept.last().map(|last| edge.time.saturating_sub(last.time));
            match width {
                Some(width) if width.saturating_mul(GLITCH) < half => {
                    let start = edge.time.saturating_sub(width);
                    falls -= kept.pop().map_or(0, |last| u32::from(!last.level));
                    glitch(start, falls.max(1), width);
                }
                _ => {
                    falls += u32::from(!edge.level);
                    kept.push(edge);
                }
            }
        }
        self.clock = kept;
        self.falls = falls;
    }

    /// Reads the bits and says what is wrong, as far as the burst alone tells.
    pub(super) fn judge(
        mut self,
        rules: &Rules,
        half: i64,
        acknowledge: Option<u32>,
        (end, ending): (i64, Ending),
    ) -> Judged {
        let mut violations = Vec::new();
        let mut found = |time, clock: Option<u32>, kind| {
            violations.push(Violation {
                time,
                clock,
                kind,
                timing: rules.timing,
            });
        };
        if rules.is_timed() {
            self.steady(half, |time, clock, width| {
                found(time, Some(clock), ViolationKind::Glitch { width, half });
            });
        }
        let of_level = |level: bool| {
            let edges = self.clock.iter().filter(move |edge| edge.level == level);
            edges.map(|edge| edge.time)
        };
        let falls: Vec<i64> = of_level(false).collect();
        let first = falls.first().copied();
        let start = self.clock.first().map_or(end, |edge| edge.time);
        let began_low = self.clock.first().is_some_and(|edge| edge.level);
        let rises: Vec<i64> = of_level(true)
            .filter(|time| first.is_some_and(|first| *time > first))
            .collect();
        let last_fall = falls.last().copied().unwrap_or(start);

        let late = self.late(rules, &falls, &rises);
        let mut shift = 0;
        if let Some(late) = &late {
            found(
                late.time,
                Some(late.clock),
                ViolationKind::LateData {
                    delay: late.delay,
                    high: late.high,
                    times: late.times,
                },
            );
            // A BiSS-C master compensates the delay of the line, and so is it done here.
            if rules.is_biss() && late.times * 2 > late.changes {
                shift = late.delay;
            }
        }
        let read = if rules.is_biss() { 0 } else { 1 };
        let mut bits = BitString::default();
        for fall in falls.iter().skip(read) {
            bits.push(self.data_at(fall.saturating_add(shift)));
        }

        let mut needed = rules.needed();
        let mut word = rules.word();
        let zeros = acknowledged(rules, bits.as_bits()).map(|(idle, ack)| {
            let expected = rules.profile.ack_bits;
            word = word - expected + ack;
            needed = idle + word;
            if ack != expected {
                found(
                    falls.get(idle as usize).copied().unwrap_or(start),
                    Some(idle + 1),
                    ViolationKind::Acknowledge {
                        bits: ack,
                        expected,
                        before: acknowledge.filter(|before| *before != ack),
                    },
                );
            }
            ack
        });

        let hertz = frequency(&falls);
        if let Some(hertz) = hertz.filter(|_| rules.is_timed()) {
            let low = rises
                .first()
                .zip(first)
                .map_or(0, |(rise, fall)| rise.saturating_sub(fall));
            if let Some(kind) = of_frequency(rules, hertz, low) {
                found(first.unwrap_or(start), None, kind);
            }
        }
        let rest = end.saturating_sub(last_fall);
        let count = falls.len() as u32;
        let changed = self.data.iter().any(|step| Some(step.time) >= first);
        if count >= needed && !changed && (ending == Ending::Clock || rules.is_silent(rest, half)) {
            let level = self.data_at(end);
            found(
                first.unwrap_or(start),
                None,
                ViolationKind::DataStuck { level },
            );
        } else if let Some((time, kind)) = self.returned(rules, &rises, last_fall, end)
            && count >= needed
        {
            found(time, None, kind);
        }
        let gap =
            (rules.profile.format == Format::Ssi7 && rest > rules.timing.returns.0).then(|| {
                let behind = rises.last().copied().unwrap_or(last_fall).max(last_fall);
                let over = last_fall.saturating_add(rules.timing.returns.0);
                self.data_at(behind.saturating_add(over.saturating_sub(behind) / 2))
            });
        let state = match needed > count {
            true => State::Short,
            false => State::Whole,
        };
        Judged {
            start,
            end: self.last_edge().unwrap_or(end),
            first,
            idle: self.data_at(first.unwrap_or(start)),
            began_low,
            half,
            needed,
            word,
            acknowledge: zeros,
            state,
            frame: Clocked {
                time: first.unwrap_or(start),
                bits,
                clocks: count,
                hertz: hertz.filter(|_| rules.is_timed()),
                gap: gap.filter(|_| rules.is_timed()),
                violations,
            },
        }
    }

    /// When the data line becomes high behind the frame, if that is too early or too late.
    fn returned(
        &self,
        rules: &Rules,
        rises: &[i64],
        last_fall: i64,
        end: i64,
    ) -> Option<(i64, ViolationKind)> {
        if !rules.is_timed() {
            return None;
        }
        let (least, most) = rules.timing.returns;
        let margin = rules.resolution();
        let is_late = |measured: i64| measured.saturating_sub(margin) > part(most, 100 + TOLERANCE);
        let last_rise = rises.last().copied().filter(|rise| *rise > last_fall)?;
        let last = self.data.last()?;
        if !last.level {
            let measured = end.saturating_sub(last_fall);
            return is_late(measured).then_some((end, ViolationKind::NotReady { measured }));
        }
        // What changes within half a period of the last rising edge follows the last bit.
        let high = last_rise.saturating_sub(last_fall);
        let measured = last.time.saturating_sub(last_fall);
        let is_early = measured.saturating_add(margin) < part(least, 100 - TOLERANCE);
        let behind = last.time > last_rise.saturating_add(high);
        (behind && (is_early || is_late(measured)))
            .then_some((last.time, ViolationKind::Timeout { measured }))
    }

    /// The changes of data that come when it is being read, or after.
    fn late(&self, rules: &Rules, falls: &[i64], rises: &[i64]) -> Option<Late> {
        let mut late: Option<Late> = None;
        let mut changes = 0;
        let last = *falls.last()?;
        for step in self.data.iter().filter(|step| step.time <= last) {
            let Some(index) = rises
                .partition_point(|rise| *rise <= step.time)
                .checked_sub(1)
            else {
                continue;
            };
            // The rising edge of clock k is followed by the falling edge of clock k + 1.
            let (Some(rise), Some(fall)) = (rises.get(index), falls.get(index + 1)) else {
                continue;
            };
            changes += 1;
            let delay = step.time.saturating_sub(*rise);
            let high = fall.saturating_sub(*rise);
            let seen = rules.is_timed() && rules.resolution().saturating_mul(4) <= high;
            if seen && delay.saturating_mul(8) > high.saturating_mul(7) {
                let late = late.get_or_insert(Late {
                    time: step.time,
                    clock: index as u32 + 2,
                    delay,
                    high,
                    times: 0,
                    changes: 0,
                });
                late.times += 1;
            }
        }
        late.map(|late| Late { changes, ..late })
    }
}

/// Data that changes when it is being read.
struct Late {
    time: i64,
    clock: u32,
    delay: i64,
    high: i64,
    times: u32,
    /// All changes of the frame.
    changes: u32,
}

const fn part(value: i64, per_cent: i64) -> i64 {
    value / 100 * per_cent
}

/// The half period at one `part`th of the way from the shortest to the longest.
fn ranked(edges: &[Step], part: usize) -> Option<i64> {
    let pairs = edges.iter().zip(edges.iter().skip(1));
    let mut halves: Vec<i64> = pairs.map(|(a, b)| b.time.saturating_sub(a.time)).collect();
    halves.sort_unstable();
    halves.get(halves.len() / part).copied()
}

/// Idle and acknowledge bits in front of the start bit of BiSS-C.
fn acknowledged(rules: &Rules, bits: Bits<'_>) -> Option<(u32, u32)> {
    let (idle, ack) = biss_c::preamble(bits)?;
    rules.is_biss().then_some((idle, ack))
}

/// The frequency of the clock, the first and longer periods left aside.
fn frequency(falls: &[i64]) -> Option<f64> {
    let regular = if falls.len() > 2 {
        falls.get(1..)?
    } else {
        falls
    };
    let pairs = regular.iter().zip(regular.iter().skip(1));
    let mut periods: Vec<i64> = pairs.map(|(a, b)| b.saturating_sub(*a)).collect();
    periods.sort_unstable();
    let median = *periods.get(periods.len() / 2)?;
    let usual = periods
        .iter()
        .take_while(|period| period.saturating_mul(2) <= median.saturating_mul(3));
    let (count, sum) = usual.fold((0u32, 0i64), |(count, sum), period| {
        (count + 1, sum.saturating_add(*period))
    });
    (sum > 0).then(|| SECOND as f64 * f64::from(count) / sum as f64)
}

fn of_frequency(rules: &Rules, hertz: f64, low: i64) -> Option<ViolationKind> {
    let timing = rules.timing;
    let above = |limit: u32| hertz * 100.0 > f64::from(limit) * (100 + TOLERANCE) as f64;
    if hertz * 100.0 < f64::from(timing.slowest) * (100 - TOLERANCE) as f64 {
        return Some(ViolationKind::Slow { hertz });
    }
    if above(timing.limit()) {
        return Some(ViolationKind::Fast { hertz });
    }
    match timing.beyond {
        Beyond::FirstLow { low: needed, .. }
            if above(timing.fastest)
                && low.saturating_add(rules.resolution()) < part(needed, 100 - TOLERANCE) =>
        {
            Some(ViolationKind::FirstLow { hertz, low, needed })
        }
        // A line whose delay needs compensating shows in the data.
        _ => None,
    }
}
