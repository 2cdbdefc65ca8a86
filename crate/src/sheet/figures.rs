//! What the rows of a sheet come to: counts by kind, bits ever set, ranges, speed.

use crate::{
    bits,
    decode::{Decoded, Frame, Summary},
    language::t,
    layout::Role,
    reading::{FaultKind, Reading},
    text,
};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};

/// Most different kinds that are told apart.
const MOST_KINDS: usize = 40;

/// How often something was seen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tally {
    /// What.
    pub name: String,
    /// How often.
    pub count: u64,
    /// The first row with it.
    pub first: usize,
}

/// What the rows of a sheet come to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Figures {
    /// Frames and bytes.
    pub summary: Summary,
    /// Faults of frames by kind.
    pub faults: Vec<Tally>,
    /// Why input is in no frame.
    pub skips: Vec<Tally>,
    /// Named bits of status and alarm that were ever set in a good frame, and the flags of error
    /// and warning.
    pub conditions: Vec<Tally>,
    /// Smallest and largest angle of good frames, in counts.
    pub angle: Option<(u64, u64)>,
    /// Fewest and most turns.
    pub turns: Option<(i64, i64)>,
    /// Lowest and highest temperature, degrees Celsius × 10.
    pub temperature: Option<(i32, i32)>,
    /// Lowest and highest speed in revolutions per second, from neighbours whose time is known.
    pub speed: Option<(f64, f64)>,
    /// Time of the first and the last row that has one, in seconds.
    pub times: Option<(f64, f64)>,
    /// The last good position in turns, its time, and after how many turns it comes again.
    last: Option<(f64, f64, f64)>,
}

fn widen<T: PartialOrd + Copy>(range: &mut Option<(T, T)>, value: T) {
    *range = Some(match *range {
        None => (value, value),
        Some((low, high)) if value < low => (value, high),
        Some((low, high)) if value > high => (low, value),
        Some(range) => range,
    });
}

fn count(tallies: &mut Vec<Tally>, name: &str, row: usize) {
    if let Some(tally) = tallies.iter_mut().find(|tally| tally.name == name) {
        tally.count += 1;
    } else if tallies.len() < MOST_KINDS {
        tallies.push(Tally {
            name: name.to_string(),
            count: 1,
            first: row,
        });
    }
}

/// What faults of a kind have in common.
fn kind_of(fault: &FaultKind) -> String {
    match fault {
        FaultKind::Check { name, .. } => text!("{} does not hold", t(name)),
        FaultKind::Constant { name, .. } => text!("{} is not what it must be", t(name)),
        FaultKind::Range { name, .. } => text!("{} is too large", t(name)),
        FaultKind::Repeat { .. } => t("a repeated word differs").to_string(),
        FaultKind::Ambiguous => t("where the frame begins is not certain").to_string(),
        other => other.to_string(),
    }
}

impl Figures {
    /// Counts a row that came at `time`.
    pub(super) fn add(&mut self, row: usize, decoded: &Decoded<'_>, time: Option<f64>) {
        if let Some(time) = time {
            widen(&mut self.times, time);
        }
        match decoded {
            Decoded::Skip { why, .. } => {
                let name = match why {
                    crate::framing::Why::Truncated { .. } => t("cut short").to_string(),
                    other => other.to_string(),
                };
                count(&mut self.skips, &name, row);
            }
            Decoded::Frame(frame) if frame.ok() => self.add_good(row, frame, time),
            Decoded::Frame(frame) => {
                self.last = None;
                for fault in frame.faults() {
                    count(&mut self.faults, &kind_of(&fault.kind), row);
                }
            }
        }
    }

    fn add_good(&mut self, row: usize, frame: &Frame<'_>, time: Option<f64>) {
        for field in frame.layout.fields() {
            let named = !field.row.bits.is_empty();
            if named {
                let raw = field.active_high(frame.layout.read(field, frame.bits));
                let set = field
                    .row
                    .bits
                    .iter()
                    .filter(|bit| bits::bit(raw, bit.place));
                for bit in set.filter(|_| raw != 0) {
                    count(&mut self.conditions, t(bit.name), row);
                }
            }
            if field.row.role == Role::Temperature {
                let raw = frame.layout.read(field, frame.bits);
                let value = bits::signed(raw, field.width as usize);
                widen(&mut self.temperature, value as i32);
            }
        }
        if let Some(reading) = frame.reading() {
            let mut named = frame.layout.fields().flat_map(|field| field.row.bits);
            // An error that is a named bit has been counted by its name.
            if reading.error && !named.any(|bit| bit.role == Some(Role::Error)) {
                count(&mut self.conditions, t("error"), row);
            }
            if reading.warning {
                count(&mut self.conditions, t("warning"), row);
            }
            self.add_reading(&reading, frame.layout.shape.profile.turns_bits, time);
        }
    }

    fn add_reading(&mut self, reading: &Reading, turns_bits: u32, time: Option<f64>) {
        widen(&mut self.angle, reading.angle);
        let within = reading.angle as f64 / bits::codes(reading.angle_bits) as f64;
        let (position, again) = match reading.turns {
            None => (within, 1.0),
            Some(turns) => {
                widen(&mut self.turns, turns);
                (turns as f64 + within, bits::codes(turns_bits) as f64)
            }
        };
        let Some(time) = time else {
            return;
        };
        if let Some((before, then, _)) = self.last
            && time > then
        {
            let apart = position - before;
            let apart = match apart {
                apart if apart > again / 2.0 => apart - again,
                apart if apart < -again / 2.0 => apart + again,
                apart => apart,
            };
            widen(&mut self.speed, apart / (time - then));
        }
        self.last = Some((position, time, again));
    }
}
