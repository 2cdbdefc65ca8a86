//! Pasted text to bytes and bits.
//!
//! Whatever a terminal, an analyser, a hexdump, a source file or an e-mail shows of bytes is
//! read: digits with any separators and prefixes, beside offsets, times, directions, comments
//! and ordinary text. What kind of writing it is is decided once, over the head of the text;
//! then every line is read by itself, so that text of any length can come in pieces. What is
//! no data is kept with its place, and so is what should be data and cannot be read.

mod clean;
mod direction;
mod line;
mod marks;
mod offsets;
mod prose;
mod reader;
mod stamp;
mod survey;
mod table;
mod token;
mod writing;

pub use direction::Direction;
pub use marks::{Dropped, Mark, Marks};
pub use reader::Reader;
pub use writing::Writing;

use crate::{
    bits::{BitString, Bits},
    format::Medium,
};
use alloc::vec::Vec;

/// Lines between two places that are known without adding up.
const STRIDE: usize = 64;
/// Bits of the longest line; what is longer is several lines.
const LONGEST: usize = 1_000_000_000;
/// What stands for the time of a line that has none.
const NO_TIME: f64 = f64::NEG_INFINITY;

/// A parsed dump: the data of all lines in a row, and where each line begins.
///
/// ```
/// use encoderscope::{dump::{Direction, parse}, format::Medium};
/// let dump = parse("[12:00:00.250] TX: 64\n[12:00:00.251] RX: 12 34 56", Medium::Bytes);
/// let line = dump.line(1).ok_or("no line")?;
/// assert_eq!((line.start, line.direction), (1, Some(Direction::Received)));
/// assert_eq!(line.bits.bytes(), [0x12, 0x34, 0x56]);
/// assert_eq!(dump.writing().name(), "terminal log with times");
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dump {
    data: Vec<u8>,
    /// Bits of each line.
    lens: Vec<u32>,
    /// Where each `STRIDE`th line begins.
    stops: Vec<Stop>,
    /// Where the next line will begin.
    end: Stop,
    /// Seconds, one a line, where any line has a time.
    times: Vec<f64>,
    /// One a line, where any line has a direction.
    directions: Vec<Option<Direction>>,
    binary: bool,
    writing: Writing,
    dropped: Marks,
    unread: Marks,
}

/// Where a line begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Stop {
    /// In the data, in bytes.
    byte: u64,
    /// Bits of the lines before it, without what fills their last bytes.
    bits: u64,
}

impl Stop {
    const fn behind(self, len: u32) -> Self {
        Self {
            byte: self.byte + len.div_ceil(8) as u64,
            bits: self.bits + len as u64,
        }
    }
}

/// A line of a dump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line<'a> {
    /// What it holds.
    pub bits: Bits<'a>,
    /// Whether it was written as a string of 0 and 1.
    pub binary: bool,
    /// Offset of the first bit in the stream: bytes, or bits where the dump is bit strings.
    pub start: u64,
    /// When it came, in seconds on the clock of the dump.
    pub time: Option<f64>,
    /// Which way it went.
    pub direction: Option<Direction>,
}

/// Parses text; what 0 and 1 mean depends on what the format consists of.
///
/// ```
/// use encoderscope::{dump::parse, format::Medium};
/// assert_eq!(parse("{0x1A, 0x20}, \\x37", Medium::Bytes).bytes(), [0x1a, 0x20, 0x37]);
/// let bits = parse("1101 0000 1", Medium::Bits);
/// assert_eq!(bits.line(0).map(|line| line.bits.len()), Some(9));
/// ```
#[must_use]
pub fn parse(text: &str, medium: Medium) -> Dump {
    let mut reader = Reader::new(medium, text);
    reader.push(text.as_bytes());
    reader.finish()
}

impl Dump {
    /// A dump of bytes that nobody has written down.
    #[must_use]
    pub fn of_bytes(bytes: impl Into<Vec<u8>>) -> Self {
        let mut dump = Self {
            data: bytes.into(),
            writing: Writing::binary(),
            ..Self::default()
        };
        dump.close_bytes();
        dump
    }

    /// Adds bytes to a dump of bytes that nobody has written down.
    ///
    /// ```
    /// use encoderscope::dump::Dump;
    /// let mut dump = Dump::of_bytes([0x1a]);
    /// dump.push_bytes(&[0x20, 0x29]);
    /// assert_eq!(dump, Dump::of_bytes([0x1a, 0x20, 0x29]));
    /// ```
    pub fn push_bytes(&mut self, bytes: &[u8]) {
        self.data.extend_from_slice(bytes);
        self.close_bytes();
    }

    /// Makes room for so many bytes more at once; where there is none, room is sought as it is
    /// needed.
    pub fn reserve(&mut self, bytes: usize) {
        let _ = self.data.try_reserve_exact(bytes);
    }

    /// Makes room for so many times more of everything.
    fn expect(&mut self, times: f64) {
        fn room<T>(column: &mut Vec<T>, times: f64) {
            // A column that cannot have it grows as it must.
            let _ = column.try_reserve_exact((column.len() as f64 * times) as usize);
        }
        room(&mut self.data, times);
        room(&mut self.lens, times);
        room(&mut self.stops, times);
        room(&mut self.times, times);
        room(&mut self.directions, times);
    }

    /// Bytes that nobody has written down are one line, as long as lines can be.
    fn close_bytes(&mut self) {
        let longest = LONGEST / 8 * 8;
        while self.end.byte < self.data.len() as u64 {
            let left = (self.data.len() - self.end.byte as usize).saturating_mul(8);
            match self.lens.last_mut() {
                Some(last) if (*last as usize) < longest => {
                    let more = left.min(longest - *last as usize);
                    *last += more as u32;
                    self.end = self.end.behind(more as u32);
                }
                _ => self.close(left.min(longest), None, None),
            }
        }
    }

    /// A dump of bit strings that nobody has written down, each with its time in seconds.
    ///
    /// ```
    /// use encoderscope::{bits::BitString, dump::Dump};
    /// let lines = [(BitString::zeros(25), Some(0.5)), (BitString::zeros(25), None)];
    /// let dump = Dump::of_lines(lines);
    /// let starts: Vec<_> = dump.lines().map(|line| (line.start, line.time)).collect();
    /// assert_eq!(starts, [(0, Some(0.5)), (25, None)]);
    /// ```
    ///
    /// More of them can be added with [`Extend::extend`].
    #[must_use]
    pub fn of_lines(lines: impl IntoIterator<Item = (BitString, Option<f64>)>) -> Self {
        let mut dump = Self {
            binary: true,
            writing: Writing::captured(),
            ..Self::default()
        };
        dump.extend(lines);
        dump
    }

    /// The same dump with other data in its lines; those that come to nothing are left out.
    pub(crate) fn map_lines(&self, change: &mut dyn FnMut(Line<'_>) -> BitString) -> Self {
        let mut changed = Self {
            binary: self.binary,
            writing: self.writing.clone(),
            ..Self::default()
        };
        for line in self.lines() {
            let bits = change(line);
            let len = bits.as_bits().len().min(LONGEST);
            let data = bits.as_bits().bytes().get(..len.div_ceil(8));
            changed.data.extend_from_slice(data.unwrap_or_default());
            changed.close(len, line.time, line.direction);
        }
        changed
    }

    /// The lines with something readable in them.
    #[must_use]
    pub fn lines(&self) -> impl ExactSizeIterator<Item = Line<'_>> + '_ {
        self.lines_from(0)
    }

    pub(crate) fn lines_from(&self, first: usize) -> impl ExactSizeIterator<Item = Line<'_>> + '_ {
        let first = first.min(self.len());
        let mut at = self.stop(first);
        (first..self.len()).map(move |index| {
            let line = self.line_of(index, at);
            at = at.behind(self.lens[index]);
            line
        })
    }

    /// A line.
    #[must_use]
    pub fn line(&self, index: usize) -> Option<Line<'_>> {
        (index < self.len()).then(|| self.line_of(index, self.stop(index)))
    }

    /// Number of lines.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.lens.len()
    }

    /// Whether nothing was readable.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.lens.is_empty()
    }

    /// The index of the line that holds the offset `start` of the stream; beyond the end the
    /// last one.
    #[must_use]
    pub fn line_at(&self, start: u64) -> usize {
        self.line_where(|stop| {
            let place = if self.binary { stop.bits } else { stop.byte };
            place <= start
        })
    }

    /// The index of the line that holds a byte of the stream.
    pub(crate) fn line_at_byte(&self, byte: u64) -> usize {
        self.line_where(|stop| stop.byte <= byte)
    }

    /// The last line whose place is one of the first ones, for which `holds`.
    fn line_where(&self, holds: impl Fn(&Stop) -> bool) -> usize {
        let block = self.stops.partition_point(&holds).saturating_sub(1);
        let first = block * STRIDE;
        let mut at = self.stops.get(block).copied().unwrap_or_default();
        let rest = self.lens.get(first..).unwrap_or_default();
        let behind = rest.iter().take_while(|len| {
            at = at.behind(**len);
            holds(&at)
        });
        (first + behind.count()).min(self.len().saturating_sub(1))
    }

    /// Everything as one stream, sent and received, in order.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        self.data.get(..self.end.byte as usize).unwrap_or_default()
    }

    /// Whether the dump was written as strings of 0 and 1, so that offsets count bits.
    #[must_use]
    pub const fn is_bits(&self) -> bool {
        self.binary && !self.is_empty()
    }

    /// What kind of writing the text was taken for.
    #[must_use]
    pub const fn writing(&self) -> &Writing {
        &self.writing
    }

    /// What of the text is not data.
    #[must_use]
    pub const fn dropped(&self) -> &Marks {
        &self.dropped
    }

    /// What of the text should be data and cannot be read.
    #[must_use]
    pub const fn unread(&self) -> &Marks {
        &self.unread
    }

    /// Where a line begins in [`Dump::bytes`].
    pub(crate) fn byte_of(&self, index: usize) -> u64 {
        self.stop(index).byte
    }

    /// Whether any line has a time.
    #[must_use]
    pub const fn has_times(&self) -> bool {
        !self.times.is_empty()
    }

    /// When a line came, in seconds.
    pub(crate) fn time_of(&self, index: usize) -> Option<f64> {
        let time = self.times.get(index).copied();
        time.filter(|time| *time != NO_TIME)
    }

    /// Whether any line is marked as sent or received.
    #[must_use]
    pub const fn has_directions(&self) -> bool {
        !self.directions.is_empty()
    }

    fn stop(&self, index: usize) -> Stop {
        let Some(stop) = self.stops.get(index / STRIDE) else {
            return self.end;
        };
        let before = self.lens.get(index / STRIDE * STRIDE..index);
        let behind = |at: Stop, len: &u32| at.behind(*len);
        before.unwrap_or_default().iter().fold(*stop, behind)
    }

    fn line_of(&self, index: usize, at: Stop) -> Line<'_> {
        let rest = self.data.get(at.byte as usize..).unwrap_or_default();
        Line {
            bits: Bits::of_bytes(rest).prefix(self.lens[index] as usize),
            binary: self.binary,
            start: if self.binary { at.bits } else { at.byte },
            time: self.time_of(index),
            direction: self.directions.get(index).copied().flatten(),
        }
    }

    /// Makes a line of `len` bits of the data behind the last line.
    fn close(&mut self, len: usize, time: Option<f64>, direction: Option<Direction>) {
        if len == 0 {
            return;
        }
        let before = self.len();
        if before.is_multiple_of(STRIDE) {
            self.stops.push(self.end);
        }
        let len = u32::try_from(len).unwrap_or(u32::MAX);
        self.lens.push(len);
        self.end = self.end.behind(len);
        if time.is_some() && self.times.is_empty() {
            self.times.resize(before, NO_TIME);
        }
        if time.is_some() || !self.times.is_empty() {
            self.times.push(time.unwrap_or(NO_TIME));
        }
        if direction.is_some() && self.directions.is_empty() {
            self.directions.resize(before, None);
        }
        if direction.is_some() || !self.directions.is_empty() {
            self.directions.push(direction);
        }
    }
}

/// Adds lines to a dump of bit strings, such as [`Dump::of_lines`] makes.
impl Extend<(BitString, Option<f64>)> for Dump {
    fn extend<T: IntoIterator<Item = (BitString, Option<f64>)>>(&mut self, lines: T) {
        for (bits, time) in lines {
            let len = bits.as_bits().len().min(LONGEST);
            let data = bits.as_bits().bytes().get(..len.div_ceil(8));
            self.data.extend_from_slice(data.unwrap_or_default());
            self.close(len, time, None);
        }
    }
}
