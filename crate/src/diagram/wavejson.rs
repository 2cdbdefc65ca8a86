//! Timelines as WaveJSON, the notation of WaveDrom, and the bits of a frame from it
//! (<https://github.com/wavedrom/schema/blob/master/WaveJSON.md>).
//!
//! A letter of a `wave` lasts for one period: `0`, `l`, `L`, `d` are low, `1`, `h`, `H`, `u` high,
//! `p`, `P` a clock that is high first, `n`, `N` one that is low first, `.` goes on, and so does
//! `|`, where time is left out; `=` and `2`…`9` show the next text of `data`; `x` and `z` say nothing.
//!
//! ```
//! use encoderscope::{diagram::wavejson, format::Format};
//! let profile = Format::SsiTree.default_profile();
//! let text = "{signal: [{name: 'clk', wave: '1n...1'}, {name: 'data', wave: '1.01..', phase: -0.5}]}";
//! let bits = wavejson::read(text, &profile)?;
//! // The first falling edge latches; three read.
//! assert_eq!((bits.as_bits().len(), bits.as_bits().bytes()[0]), (3, 0b1010_0000));
//! # Ok::<(), encoderscope::diagram::Unreadable>(())
//! ```

use super::{Fold, Lane, Timeline, Unreadable, What, relaxed};
use crate::{
    bits::BitString,
    capture::{Signal, choose},
    decode::Frame,
    format::{Format, Link},
    language::t,
    profile::Profile,
    record::{Record, Value},
    text,
};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};

/// The longest a wave may be, in letters.
const LONGEST: usize = 64 * 1024;
/// What a whole period is counted in, so that its halves and phases are whole numbers.
const PERIOD: i64 = 1_000;

/// The timeline of a frame as WaveJSON: the lanes, then a row with the fields.
///
/// A letter is half a clock, or a bit of a serial line; a long rest is one `|`.
#[must_use]
pub fn written(frame: &Frame<'_>, timeline: &Timeline) -> Record {
    let fold = Fold::new(timeline, 1.0);
    let lanes = timeline.lanes.iter().map(|lane| lane_of(lane, &fold));
    let mut signal: Vec<Value> = lanes.map(Value::Record).collect();
    signal.push(fields(frame, timeline, &fold).into());
    let title = frame.layout.shape.profile.title();
    Record::new()
        .with("signal", Value::List(signal))
        .with("head", Record::new().with("text", title))
        .with("config", Record::new().with("hscale", 1u32))
}

fn lane_of(lane: &Lane, fold: &Fold) -> Record {
    let mut wave = String::new();
    let mut before = None;
    for cell in fold.cells() {
        let level = lane.level_at(middle(cell.from, cell.to));
        wave.push(match (before == Some(level), level) {
            (true, _) => '.',
            (false, true) => '1',
            (false, false) => '0',
        });
        // Time is left out behind the letter that says how the line rests.
        if cell.is_folded {
            wave.push('|');
        }
        before = Some(level);
    }
    Record::new().with("name", lane.name).with("wave", wave)
}

/// A row of boxes with the names of what the encoder sends.
fn fields(frame: &Frame<'_>, timeline: &Timeline, fold: &Fold) -> Record {
    let mut wave = String::new();
    let mut data: Vec<String> = Vec::new();
    let mut before = String::new();
    for cell in fold.cells() {
        let at = middle(cell.from, cell.to);
        let mut slots = timeline.of_lane(timeline.encoder());
        let slot = slots.find(|slot| (slot.from..slot.to).contains(&at));
        let name = slot.map_or("", |slot| match slot.what {
            What::Bit(bit) => frame
                .layout
                .field_at(bit)
                .map_or("", |field| field.row.name),
            What::Idle => "",
            what => what.name(),
        });
        match (name == before && !wave.is_empty(), name) {
            (true, _) => wave.push('.'),
            (false, "") => wave.push('x'),
            (false, _) => {
                wave.push('=');
                data.push(name.to_string());
            }
        }
        if cell.is_folded {
            wave.push('|');
        }
        before = name.to_string();
    }
    Record::new()
        .with("name", "fields")
        .with("wave", wave)
        .with("data", data)
}

const fn middle(from: i64, to: i64) -> i64 {
    from.saturating_add(to.saturating_sub(from) / 2)
}

/// The bits that a diagram with a clock and a data lane shows, as a dump of `profile` has them:
/// read at the falling edges of the clock, of which the first only latches, except of BiSS-C.
///
/// Which lane is which their names say, or that one of them is a clock.
///
/// # Errors
///
/// The text is no WaveJSON, has no two such lanes, or the data has no level where it is read;
/// says what is wrong, and at which clock.
pub fn read(text: &str, profile: &Profile) -> Result<BitString, Unreadable> {
    if profile.link() != Link::Clocked {
        let title = profile.title();
        return Err(Unreadable::whole(text!("{} has no clock", title)));
    }
    let whole = relaxed::read(text)?;
    let mut lanes = Vec::new();
    if let Value::Record(record) = &whole
        && let Some(signal) = record.find("signal")
    {
        gather(signal, &mut lanes)?;
    }
    let (clock, data) = chosen(&lanes)?;
    let is_biss = match profile.own {
        Some(own) => own.is_biss(),
        None => profile.format == Format::BissC,
    };
    let pairs = clock.levels.iter().zip(clock.levels.iter().skip(1));
    let falls = pairs.filter(|(high, low)| high.1 == Some(true) && low.1 == Some(false));
    let mut bits = BitString::default();
    for (index, (_, (time, _))) in falls.enumerate().skip(usize::from(!is_biss)) {
        let Some(level) = data.level_before(*time) else {
            return Err(Unreadable::whole(text!(
                "{} has no level at clock {}",
                data.name,
                index + 1
            )));
        };
        bits.push(level);
    }
    match bits.as_bits().is_empty() {
        true => Err(Unreadable::whole(text!("{} reads no bit", clock.name))),
        false => Ok(bits),
    }
}

/// A lane as it is written: levels, each from a time on.
struct Row {
    name: String,
    is_clock: bool,
    levels: Vec<(i64, Option<bool>)>,
}

impl Row {
    fn level_before(&self, time: i64) -> Option<bool> {
        let after = self.levels.partition_point(|(from, _)| *from < time);
        self.levels.get(after.saturating_sub(1))?.1
    }

    /// The lane as what a logic analyser would have recorded of it.
    fn signal(&self) -> Signal {
        let mut signal = Signal::new(&self.name);
        for (time, level) in &self.levels {
            if let Some(level) = level {
                signal.change(*time, *level);
            }
        }
        signal.finish(self.levels.last().map_or(0, |(time, _)| *time));
        signal
    }
}

/// The clock and the data.
fn chosen(rows: &[Row]) -> Result<(&Row, &Row), Unreadable> {
    let signals: Vec<Signal> = rows.iter().map(Row::signal).collect();
    let clock = rows.iter().position(|row| row.is_clock);
    let wires = choose(&signals, (clock, None));
    let found = wires.and_then(|wires| {
        let row = |index: usize| rows.get(index);
        row(wires.clock.signal).zip(row(wires.data.signal))
    });
    found.ok_or_else(|| Unreadable::whole(t("there are no two lanes with levels: clock and data")))
}

/// The lanes of a `signal`, also those in groups.
fn gather(value: &Value, lanes: &mut Vec<Row>) -> Result<(), Unreadable> {
    match value {
        Value::List(values) => values.iter().try_for_each(|value| gather(value, lanes)),
        Value::Record(record) => {
            if let Some(Value::Text(wave)) = record.find("wave") {
                lanes.push(row(record, wave)?);
            }
            Ok(())
        }
        _ => Ok(()),
    }
}

fn row(record: &Record, wave: &str) -> Result<Row, Unreadable> {
    let name = record.find("name").map(Value::plain).unwrap_or_default();
    if wave.len() > LONGEST {
        return Err(Unreadable::whole(text!(
            "{} has more than {} letters",
            name,
            LONGEST
        )));
    }
    let scaled = |name: &str, usual: f64| {
        let number = match record.find(name) {
            Some(Value::Int(number)) => *number as f64,
            Some(Value::Decimal(digits)) => digits.parse().unwrap_or(usual),
            _ => usual,
        };
        (number * PERIOD as f64) as i64
    };
    let period = scaled("period", 1.0).clamp(2, PERIOD * PERIOD);
    let mut time = scaled("phase", 0.0)
        .clamp(-PERIOD * PERIOD, PERIOD * PERIOD)
        .saturating_neg();
    let texts: Vec<String> = match record.find("data") {
        Some(Value::Text(text)) => text.split_whitespace().map(ToString::to_string).collect(),
        Some(Value::List(values)) => values.iter().map(Value::plain).collect(),
        _ => Vec::new(),
    };
    let mut texts = texts.into_iter();
    let mut levels: Vec<(i64, Option<bool>)> = Vec::new();
    // What a point repeats: the levels of both halves of a period.
    let mut halves = [None; 2];
    let mut is_clock = false;
    for letter in wave.chars() {
        let both = |level| [level; 2];
        halves = match letter {
            '.' | '|' => halves,
            '0' | 'l' | 'L' | 'd' => both(Some(false)),
            '1' | 'h' | 'H' | 'u' => both(Some(true)),
            'p' | 'P' => [Some(true), Some(false)],
            'n' | 'N' => [Some(false), Some(true)],
            '=' | '2'..='9' => both(match texts.next().as_deref() {
                Some("0") => Some(false),
                Some("1") => Some(true),
                _ => None,
            }),
            'x' | 'X' | 'z' | 'Z' => both(None),
            other => {
                return Err(Unreadable::whole(text!(
                    "{}: {} is no letter of a wave",
                    name,
                    format_args!("{other:?}")
                )));
            }
        };
        is_clock |= matches!(letter, 'p' | 'P' | 'n' | 'N');
        if levels.is_empty() && matches!(letter, 'n' | 'N') {
            // A clock that is low first begins with a falling edge.
            levels.push((time.saturating_sub(1), Some(true)));
        }
        for (half, at) in halves
            .into_iter()
            .zip([time, time.saturating_add(period / 2)])
        {
            if levels.last().is_none_or(|(_, level)| *level != half) {
                levels.push((at, half));
            }
        }
        time = time.saturating_add(period);
    }
    Ok(Row {
        name,
        is_clock,
        levels,
    })
}
