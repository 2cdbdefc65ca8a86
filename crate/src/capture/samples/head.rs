//! What the columns of a table are, and how a row of it is read.

use super::super::{Change, Clocking, Unreadable, recording::MOST_SIGNALS};
use crate::format::timing::SECOND;
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// Headings of columns that count or mark rows and are no signals.
const COUNTERS: &[&str] = &[
    "sample in buffer",
    "sample in window",
    "trigger",
    "gap",
    "sample",
    "samples",
    "index",
    "nr",
    "no",
    "#",
];
/// Words for powers of ten of a picosecond.
const UNITS: &[(&str, i32)] = &[
    ("s", 12),
    ("sec", 12),
    ("seconds", 12),
    ("ms", 9),
    ("milliseconds", 9),
    ("us", 6),
    ("µs", 6),
    ("μs", 6),
    ("microseconds", 6),
    ("ns", 3),
    ("nanoseconds", 3),
    ("ps", 0),
    ("picoseconds", 0),
];

/// What is wrong with a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    Time,
    Backwards,
}

/// What a column holds.
#[derive(Clone, Debug)]
pub(super) enum Column {
    /// Levels of a signal.
    Level {
        name: String,
        signal: usize,
        level: Option<bool>,
        /// Whether it has held anything but 0 and 1.
        dead: bool,
    },
    Other,
}

impl Column {
    /// Whether it holds levels.
    pub(super) const fn is_live(&self) -> bool {
        matches!(
            self,
            Self::Level {
                level: Some(_),
                dead: false,
                ..
            }
        )
    }
}

/// How times are had.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pace {
    /// From a column, in so many powers of ten above a picosecond.
    Column(usize, i32),
    /// Samples a second.
    Rate(u64),
    /// Picoseconds a row.
    Sample(i64),
    /// They are rows.
    Unknown,
}

/// What stands before the rows.
#[derive(Clone, Debug)]
pub(super) struct Head {
    sample: Option<i64>,
    rate: Option<u64>,
    heading: Option<Vec<u8>>,
}

/// A table whose columns are known.
#[derive(Clone, Debug)]
pub(super) struct Table {
    pub(super) columns: Vec<Column>,
    /// Whether its columns have names, or a time.
    pub(super) headed: bool,
    separator: u8,
    pace: Pace,
}

/// Whether a line is a remark.
pub(super) fn is_remark(line: &[u8]) -> bool {
    line.starts_with(b";") || line.starts_with(b"#") || line.starts_with(b"//")
}

impl Head {
    pub(super) const fn new(sample: Option<i64>) -> Self {
        Self {
            sample,
            rate: None,
            heading: None,
        }
    }

    /// Takes a line; the first row of levels makes the table.
    pub(super) fn line(&mut self, line: &[u8]) -> Result<Option<Table>, Unreadable> {
        let line = line.strip_prefix(b"\xef\xbb\xbf").unwrap_or(line);
        if line.is_empty() {
            return Ok(None);
        }
        if is_remark(line) {
            self.rate = rate(line).or(self.rate);
            return Ok(None);
        }
        let separator = separator(self.heading.as_deref().unwrap_or(line));
        if !is_row(line, separator) {
            // Of several headings the first names the columns; radixes come second.
            let radix = line.to_ascii_lowercase().starts_with(b"radix");
            if self.heading.is_none() || !radix {
                self.heading = Some(line.to_vec());
            }
            return Ok(None);
        }
        self.table(line, separator).map(Some)
    }

    fn table(&self, row: &[u8], separator: u8) -> Result<Table, Unreadable> {
        let headings = self.heading.as_deref().unwrap_or_default();
        let mut names = headings.split(|byte| *byte == separator);
        let mut columns = Vec::new();
        let mut signals = 0;
        let mut time = None;
        for (index, value) in row.split(|byte| *byte == separator).enumerate() {
            let name = names.next().map(plain).unwrap_or_default();
            let name = String::from_utf8_lossy(name);
            let name = name.trim();
            let lower = name.to_lowercase();
            let unit = match self.heading {
                Some(_) => time_unit(&lower),
                None if index == 0 && !is_level(plain(value)) => Some(None),
                None => None,
            };
            columns.push(if let (Some(unit), None) = (unit, time) {
                let scale = unit.or_else(|| self.guess(value));
                time = scale.map(|scale| (index, scale));
                Column::Other
            } else if COUNTERS.contains(&lower.as_str()) {
                Column::Other
            } else {
                signals += 1;
                if signals > MOST_SIGNALS {
                    return Err(Unreadable::TooManySignals);
                }
                Column::Level {
                    name: match name {
                        "" => format!("column {}", index + 1),
                        _ => name.to_string(),
                    },
                    signal: signals - 1,
                    level: None,
                    dead: false,
                }
            });
        }
        let pace = match (time, self.sample, self.rate) {
            (Some((index, scale)), ..) => Pace::Column(index, scale),
            (_, Some(sample), _) => Pace::Sample(sample),
            (_, _, Some(rate)) => Pace::Rate(rate),
            _ => Pace::Unknown,
        };
        Ok(Table {
            columns,
            headed: self.heading.is_some() || time.is_some(),
            separator,
            pace,
        })
    }

    /// The unit of a time whose heading names none: seconds where there is a fraction; whole
    /// numbers are in the unit in which sigrok writes them for its rate.
    fn guess(&self, value: &[u8]) -> Option<i32> {
        if plain(value).iter().any(|byte| b".,eE".contains(byte)) {
            return Some(12);
        }
        self.rate.map(|rate| match rate {
            0..=1_000 => 9,
            1_001..=1_000_000 => 6,
            1_000_001..=1_000_000_000 => 3,
            _ => 0,
        })
    }
}

impl Table {
    /// What the times are worth.
    pub(super) fn clocking(&self) -> Clocking {
        match self.pace {
            Pace::Column(..) => Clocking::Timed(0),
            Pace::Rate(rate) => Clocking::Timed(SECOND / i64::try_from(rate).unwrap_or(SECOND)),
            Pace::Sample(sample) => Clocking::Timed(sample),
            Pace::Unknown => Clocking::Counted,
        }
    }

    /// Reads a row; returns its time. `before` is the time of the row before, which it cannot
    /// precede.
    pub(super) fn row(
        &mut self,
        line: &[u8],
        number: u64,
        before: Option<i64>,
        sink: &mut dyn FnMut(Change),
    ) -> Result<i64, Fault> {
        let number = i128::from(number);
        let counted = match self.pace {
            Pace::Column(index, scale) => {
                let decimal = if self.separator == b',' { b'.' } else { b',' };
                let field = line.split(|byte| *byte == self.separator).nth(index);
                field
                    .and_then(|field| picos(plain(field), scale, decimal))
                    .map(i128::from)
            }
            Pace::Rate(rate) => Some(number * i128::from(SECOND) / i128::from(rate.max(1))),
            Pace::Sample(sample) => Some(number * i128::from(sample)),
            Pace::Unknown => Some(number),
        };
        let now = counted.and_then(|time| i64::try_from(time).ok());
        let time = now.ok_or(Fault::Time)?;
        if before.is_some_and(|before| time < before) {
            return Err(Fault::Backwards);
        }
        for (column, value) in self
            .columns
            .iter_mut()
            .zip(line.split(|byte| *byte == self.separator))
        {
            match column {
                Column::Other | Column::Level { dead: true, .. } => {}
                Column::Level {
                    signal,
                    level,
                    dead,
                    ..
                } => {
                    let next = match plain(value) {
                        b"0" => false,
                        b"1" => true,
                        b"" => continue,
                        _ => {
                            *dead = true;
                            continue;
                        }
                    };
                    if *level != Some(next) {
                        *level = Some(next);
                        sink(Change {
                            time,
                            signal: *signal,
                            level: next,
                        });
                    }
                }
            }
        }
        Ok(time)
    }
}

/// A field without blanks and quotes.
fn plain(field: &[u8]) -> &[u8] {
    match field {
        [b'0' | b'1'] => field,
        _ => {
            let field = field.trim_ascii();
            let inner = field
                .strip_prefix(b"\"")
                .and_then(|field| field.strip_suffix(b"\""));
            inner.map_or(field, <[u8]>::trim_ascii)
        }
    }
}

fn is_level(field: &[u8]) -> bool {
    matches!(field, b"0" | b"1")
}

/// Tabs and semicolons separate columns wherever they stand; commas may be decimal points.
fn separator(line: &[u8]) -> u8 {
    let found = [b'\t', b';'].into_iter().find(|byte| line.contains(byte));
    found.unwrap_or(b',')
}

/// Whether every field is empty or begins as a number, and one is a level.
fn is_row(line: &[u8], separator: u8) -> bool {
    let mut fields = line.split(|byte| *byte == separator).map(plain);
    let mut levels = false;
    fields.all(|field| {
        levels |= is_level(field);
        let digits = field
            .strip_prefix(b"-")
            .or_else(|| field.strip_prefix(b"+"))
            .unwrap_or(field);
        digits.is_empty() || digits.first().is_some_and(u8::is_ascii_hexdigit) && !is_word(field)
    }) && levels
}

/// Whether a field is a name that begins as a hexadecimal number does.
fn is_word(field: &[u8]) -> bool {
    field.first().is_some_and(|letter| !letter.is_ascii_digit())
        && field
            .iter()
            .any(|letter| !letter.is_ascii_hexdigit() && !b"+-.,xX".contains(letter))
        || field.len() == 2
            && field.first().is_some_and(u8::is_ascii_alphabetic)
            && field.last().is_some_and(u8::is_ascii_digit)
}

/// Whether a heading names a time, and in which unit.
fn time_unit(lower: &str) -> Option<Option<i32>> {
    let unit = |word: &str| {
        UNITS
            .iter()
            .find(|(name, _)| *name == word)
            .map(|unit| unit.1)
    };
    let words = || {
        lower
            .split(|letter: char| !letter.is_alphanumeric())
            .filter(|word| !word.is_empty())
    };
    let first = words().next()?;
    if matches!(first, "time" | "t" | "timestamp" | "zeit" | "время") {
        return Some(words().skip(1).find_map(unit));
    }
    (words().count() == 1)
        .then(|| unit(first))
        .flatten()
        .map(Some)
}

/// The rate in a remark: `Samplerate: 24 MHz`.
fn rate(remark: &[u8]) -> Option<u64> {
    let text = core::str::from_utf8(remark).ok()?.to_lowercase();
    let (_, behind) = text
        .split_once("samplerate:")
        .or_else(|| text.split_once("sample rate:"))?;
    let behind = behind.trim();
    let end = behind
        .find(|letter: char| !letter.is_ascii_digit() && letter != '.')
        .unwrap_or(behind.len());
    let (number, unit) = behind.split_at_checked(end)?;
    let scale = match unit.trim() {
        "ghz" => 9,
        "mhz" => 6,
        "khz" => 3,
        "hz" | "" => 0,
        _ => return None,
    };
    let rate = picos(number.as_bytes(), scale, b'.')?;
    u64::try_from(rate).ok().filter(|rate| *rate > 0)
}

/// A decimal number times a power of ten, rounded down; `None` where it is none or too large.
fn picos(text: &[u8], scale: i32, decimal: u8) -> Option<i64> {
    let (negative, digits) = match text {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        _ => (false, text),
    };
    let mut value = 0i64;
    let mut power = scale;
    let mut fraction = false;
    let mut any = false;
    let mut rest = digits;
    while let [byte, tail @ ..] = rest {
        match *byte {
            digit @ b'0'..=b'9' => {
                any = true;
                let next = value
                    .checked_mul(10)
                    .and_then(|value| value.checked_add(i64::from(digit - b'0')));
                match next {
                    // Digits of a fraction beyond what is told apart change nothing.
                    Some(next) if fraction && power > -3 => {
                        value = next;
                        power -= 1;
                    }
                    _ if fraction => {}
                    next => value = next?,
                }
            }
            b'e' | b'E' => {
                let exponent: i32 = core::str::from_utf8(tail).ok()?.parse().ok()?;
                power = power.checked_add(exponent)?;
                rest = &[];
                continue;
            }
            point if (point == decimal || point == b'.') && !fraction => fraction = true,
            _ => return None,
        }
        rest = tail;
    }
    if !any {
        return None;
    }
    let factor = 10i64.checked_pow(power.unsigned_abs());
    let value = match (power >= 0, factor) {
        _ if value == 0 => 0,
        (true, factor) => value.checked_mul(factor?)?,
        (false, Some(factor)) => value / factor,
        (false, None) => 0,
    };
    Some(if negative { -value } else { value })
}
