//! Exports of logic analysers: tables of bytes, and sigrok's annotations.

use super::{Direction, stamp};
use crate::language::msg;
use alloc::vec::Vec;
use core::ops::Range;

/// A table with a heading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Table {
    separator: char,
    data: usize,
    time: Option<usize>,
    kind: Option<usize>,
    direction: Option<usize>,
    errors: Vec<usize>,
    saleae: bool,
    /// Whether numbers that are not marked are hexadecimal.
    pub(super) hexadecimal: bool,
}

/// A row of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Row {
    pub(super) bytes: Vec<u8>,
    pub(super) time: Option<f64>,
    pub(super) direction: Option<Direction>,
    /// Where the data stand, and where it notes an error.
    pub(super) data: Range<usize>,
    pub(super) error: Option<Range<usize>>,
    /// It is something else than data.
    pub(super) other: bool,
}

const DATA: [&str; 13] = [
    "data",
    "value",
    "decoded protocol result",
    "rx data",
    "miso",
    "byte",
    "bytes",
    "hex",
    "payload",
    "data (hex)",
    "data [hex]",
    "rx",
    "result",
];
const TIME: [&str; 8] = [
    "time [s]",
    "start_time",
    "time",
    "timestamp",
    "start",
    "time(s)",
    "time (s)",
    "start time",
];
const DIRECTION: [&str; 4] = ["direction", "dir", "analyzer name", "name"];
const OTHERS: [&str; 8] = [
    "type",
    "duration",
    "parity error",
    "framing error",
    "error",
    "packet id",
    "id",
    "mosi",
];

impl Table {
    /// The table that a line heads.
    pub(super) fn headed_by(line: &str) -> Option<Self> {
        [',', ';', '\t'].into_iter().find_map(|separator| {
            let names: Vec<_> = fields(line, separator)
                .map(|at| bare(&line[at]).to_ascii_lowercase())
                .collect();
            let place = |known: &[&str]| {
                known
                    .iter()
                    .find_map(|known| names.iter().position(|name| name == known))
            };
            let data = place(&DATA)?;
            let time = place(&TIME);
            let others = [time, place(&DIRECTION), place(&OTHERS)];
            if names.len() < 2 || others.iter().flatten().all(|other| *other == data) {
                return None;
            }
            let errors = (0..names.len()).filter(|index| names[*index].ends_with("error"));
            Some(Self {
                separator,
                data,
                time,
                kind: place(&["type"]),
                direction: place(&DIRECTION),
                errors: errors.collect(),
                saleae: place(&["time [s]", "start_time"]).is_some(),
                hexadecimal: false,
            })
        })
    }

    /// Decides what numbers that are not marked are.
    pub(super) fn settle<'a>(&mut self, lines: impl Iterator<Item = &'a str>) {
        for line in lines {
            let Some(at) = fields(line, self.separator).nth(self.data) else {
                continue;
            };
            let text = bare(&line[at]);
            let pair = text.len() == 2 && text.bytes().all(|digit| digit.is_ascii_hexdigit());
            let lettered = text.bytes().any(|digit| digit.is_ascii_alphabetic());
            self.hexadecimal |= pair && (lettered || text.starts_with('0'));
        }
    }

    pub(super) const fn name(&self) -> &'static str {
        if self.saleae {
            msg("Saleae CSV")
        } else {
            msg("CSV table")
        }
    }

    /// Reads a row; `None` where its data cannot be read.
    pub(super) fn row(&self, line: &str) -> Option<Row> {
        let all: Vec<Range<usize>> = fields(line, self.separator).collect();
        let field = |index: Option<usize>| {
            let at = all.get(index?)?;
            line.get(at.clone()).map(bare)
        };
        let data = all.get(self.data).cloned()?;
        let is_error = |index: &&usize| {
            let text = field(Some(**index)).unwrap_or_default();
            !["", "0", "false", "no", "none"]
                .iter()
                .any(|none| text.eq_ignore_ascii_case(none))
        };
        let error = self
            .errors
            .iter()
            .find(is_error)
            .and_then(|index| all.get(*index).cloned());
        let kind = field(self.kind).unwrap_or("data");
        let other = !["data", "result", "byte", ""]
            .iter()
            .any(|known| kind.eq_ignore_ascii_case(known));
        let text = field(Some(self.data)).unwrap_or_default();
        let mut bytes = Vec::new();
        if !other && !text.is_empty() {
            // Where a number is written in two ways, one of them is marked.
            let words = || {
                line[data.clone()]
                    .trim()
                    .trim_matches('"')
                    .split([' ', '\t'])
            };
            let marked = |word: &str| word.contains("0x");
            let any = words().any(marked);
            for word in words().filter(|word| !word.is_empty() && (!any || marked(word))) {
                bytes.push(self.value(word)?);
            }
        }
        let time = field(self.time).and_then(|text| {
            text.parse()
                .ok()
                .or_else(|| stamp::read(text.as_bytes()).map(|stamp| stamp.seconds))
        });
        Some(Row {
            other: other || bytes.is_empty(),
            bytes,
            time: time.filter(|time: &f64| time.is_finite()),
            direction: field(self.direction).and_then(named),
            data,
            error,
        })
    }

    fn value(&self, word: &str) -> Option<u8> {
        let quoted = word.starts_with('\'') && word.ends_with('\'');
        let word = word.trim_matches(['\'', '(', ')']);
        let marked = word.strip_prefix("0x").or_else(|| word.strip_prefix("0X"));
        if let Some(digits) = word.strip_prefix("0b") {
            return u8::from_str_radix(digits, 2).ok();
        }
        match marked {
            Some(digits) => u8::from_str_radix(digits, 16).ok(),
            None if word.starts_with('+') => None,
            None if self.hexadecimal || quoted => u8::from_str_radix(word, 16).ok(),
            None => word.parse().ok(),
        }
    }
}

/// The direction that a name says.
fn named(name: &str) -> Option<Direction> {
    let mut words = name.split(|letter: char| !letter.is_ascii_alphabetic());
    words.find_map(|word| match word.to_ascii_lowercase().as_str() {
        "tx" | "txd" | "sent" | "out" | "mosi" | "write" | "request" => Some(Direction::Sent),
        "rx" | "rxd" | "received" | "in" | "miso" | "read" | "reply" => Some(Direction::Received),
        _ => None,
    })
}

fn bare(text: &str) -> &str {
    text.trim().trim_matches(['"', '\'']).trim()
}

/// Where the fields of a row stand; a quoted field may hold the separator.
fn fields(line: &str, separator: char) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut start = Some(0);
    core::iter::from_fn(move || {
        let from = start?;
        let mut quoted = false;
        let rest = line.get(from..)?;
        let end = rest.char_indices().find(|(_, letter)| {
            quoted ^= *letter == '"';
            *letter == separator && !quoted
        });
        let end = end.map(|(at, _)| from + at);
        start = end.map(|end| end + separator.len_utf8());
        Some(from..end.unwrap_or(line.len()))
    })
}

/// A line of sigrok-cli, or of an export of PulseView: samples, decoder, class, value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Annotation {
    pub(super) bytes: Vec<u8>,
    pub(super) direction: Option<Direction>,
    /// Where the value begins.
    pub(super) value: usize,
    pub(super) error: bool,
}

impl Annotation {
    pub(super) fn read(line: &str) -> Option<Self> {
        let start = line.len() - line.trim_start().len();
        let mut at = start;
        let samples = line.get(at..)?.split(' ').next()?;
        let sampled = samples.split_once('-').is_some_and(|(from, to)| {
            let number =
                |text: &str| !text.is_empty() && text.bytes().all(|digit| digit.is_ascii_digit());
            number(from) && number(to)
        });
        if sampled {
            at += samples.len() + 1;
        }
        let rest = line.get(at..)?;
        let (name, _) = rest.split_once(':')?;
        let lower = name.trim().to_ascii_lowercase();
        let known = ["uart", "spi", "ssi", "rs485", "biss"]
            .iter()
            .any(|known| lower.starts_with(known));
        let numbered = lower
            .rsplit_once('-')
            .is_some_and(|(_, number)| number.parse::<u16>().is_ok());
        if !(sampled && !lower.is_empty() || known && numbered) {
            return None;
        }
        let value = rest
            .rfind(": ")
            .map_or(at + name.len() + 1, |colon| at + colon + 2);
        let classes = line.get(at..value)?.to_ascii_lowercase();
        let text = line.get(value..)?.trim();
        // Of a byte's own bits only the byte is data.
        let part = ["bit", "start", "stop", "parity"]
            .iter()
            .any(|part| classes.contains(part));
        let digits = text.strip_prefix("0x").unwrap_or(text);
        let pair = digits.len() == 2 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
        let byte = u8::from_str_radix(digits, 16)
            .ok()
            .filter(|_| pair && !part);
        let lower = text.to_ascii_lowercase();
        Some(Self {
            bytes: byte.into_iter().collect(),
            direction: named(&classes),
            value,
            error: lower.contains("error") || lower.contains("break"),
        })
    }
}
