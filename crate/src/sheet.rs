//! A decoded dump as a table: a row a frame, filtered, sorted, summed up and traced.
//!
//! Rows are read again when they are looked at, and those that follow one another alike are kept
//! together, so that ten million of them stay a small part of the data they come from. Everything
//! is done in steps, so that a worker can show the first rows at once and stop at any time.
//!
//! ```
//! use encoderscope::{decode::Decoder, dump, profile::Profile, sheet::Sheet};
//! let decoder = Decoder::new(Profile::parse([("format", "t485")])?)?;
//! let dump = dump::parse("02 20 b4 bd 1c 37 02 20 50 a9 78 a4", decoder.profile().medium());
//! let mut sheet = Sheet::new(decoder);
//! while sheet.step(&dump, 4096) {}
//! sheet.finish(&dump);
//! assert_eq!((sheet.len(), sheet.figures().summary.bad), (2, 1));
//! assert!(sheet.row(&dump, 0).is_some_and(|row| row.is_good()));
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```

mod figures;
mod rows;
mod trace;
mod view;

pub use figures::{Figures, Tally};
pub use trace::Column;
pub use view::{Filter, Order, Quantity, Show};

use crate::{
    bits::Bits,
    decode::{Decoded, Decoder, Frame, Pass},
    dump::{Direction, Dump, Line},
    format::Medium,
    framing::Why,
};
use rows::{Entry, Kind, Rows, Skip, Unit};
use trace::Trace;
use view::View;

/// Rows that are kept; more would not fit beside the data they come from.
pub const MOST_ROWS: usize = 64_000_000;

/// Lines that a reply may be spread over.
const REPLY_LINES: usize = 8;

/// A row that is looked at.
#[derive(Clone, Debug)]
pub struct Row<'a> {
    /// Its place among all rows.
    pub index: usize,
    /// When its first byte came, in seconds, where the dump says so.
    pub time: Option<f64>,
    /// Which way it went, where the dump says so.
    pub direction: Option<Direction>,
    /// What it is.
    pub decoded: Decoded<'a>,
}

impl Row<'_> {
    /// Whether it is a frame whose every check holds.
    #[must_use]
    pub fn is_good(&self) -> bool {
        matches!(&self.decoded, Decoded::Frame(frame) if frame.ok())
    }
}

/// A dump that is being decoded, and what was found in it.
#[derive(Debug)]
pub struct Sheet {
    decoder: Decoder,
    pass: Pass,
    rows: Rows,
    /// Rows that found no place.
    lost: u64,
    figures: Figures,
    trace: Trace,
    view: View,
}

impl Sheet {
    /// A sheet without rows.
    #[must_use]
    pub fn new(decoder: Decoder) -> Self {
        let unit = match decoder.profile().medium() {
            Medium::Bits => Unit::Line,
            Medium::Bytes | Medium::Text => Unit::Byte,
        };
        Self {
            decoder,
            pass: Pass::new(),
            rows: Rows::new(unit),
            lost: 0,
            figures: Figures::default(),
            trace: Trace::default(),
            view: View::default(),
        }
    }

    /// The decoder.
    #[must_use]
    pub const fn decoder(&self) -> &Decoder {
        &self.decoder
    }

    /// Decodes about `budget` bytes more; whether there is more to decode now.
    pub fn step(&mut self, dump: &Dump, budget: usize) -> bool {
        self.run(dump, |pass, decoder, sink| {
            pass.step(decoder, dump, budget, sink)
        })
    }

    /// Nothing more will come: what was held back is decided.
    pub fn finish(&mut self, dump: &Dump) {
        self.run(dump, |pass, decoder, sink| pass.finish(decoder, dump, sink));
    }

    /// Takes the rows that come out of the pass.
    fn run<T>(
        &mut self,
        dump: &Dump,
        with: impl FnOnce(&mut Pass, &Decoder, &mut dyn FnMut(Decoded<'_>)) -> T,
    ) -> T {
        let mut taker = Taker {
            dump,
            line: 0,
            rows: &mut self.rows,
            lost: &mut self.lost,
            figures: &mut self.figures,
            trace: &mut self.trace,
        };
        let out = with(&mut self.pass, &self.decoder, &mut |decoded| {
            taker.add(&decoded);
        });
        self.figures.summary = self.pass.summary();
        out
    }

    /// Number of rows.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no rows.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Rows beyond [`MOST_ROWS`], which are counted and not kept.
    #[must_use]
    pub const fn lost(&self) -> u64 {
        self.lost
    }

    /// What the rows come to.
    #[must_use]
    pub const fn figures(&self) -> &Figures {
        &self.figures
    }

    /// A row, decoded again.
    #[must_use]
    pub fn row<'a>(&'a self, dump: &'a Dump, index: usize) -> Option<Row<'a>> {
        let entry = self.rows.get(index)?;
        let (line, decoded) = match self.decoder.profile().medium() {
            Medium::Bits => {
                let line = dump.line(entry.at as usize)?;
                (line, self.decode_line(line.bits, line.start))
            }
            Medium::Bytes | Medium::Text => {
                let at = entry.at as usize;
                let bytes = dump.bytes().get(at..at + usize::from(entry.len))?;
                let line = dump.line(dump.line_at(at as u64))?;
                (line, self.decode_bytes(dump, &entry, bytes))
            }
        };
        Some(Row {
            index,
            time: line.time,
            direction: line.direction,
            decoded,
        })
    }

    /// Whether the row is a good frame; cheaper than reading it.
    #[must_use]
    pub fn is_good(&self, index: usize) -> bool {
        self.rows
            .get(index)
            .is_some_and(|entry| entry.kind == Kind::Good)
    }

    /// The first row that is not a good frame, a request or its echo, from `from` on.
    #[must_use]
    pub fn next_fault(&self, from: usize) -> Option<usize> {
        self.rows.next_fault(from)
    }

    /// The row at or behind a time in seconds, where times are known and ascend.
    #[must_use]
    pub fn row_at(&self, dump: &Dump, seconds: f64) -> Option<usize> {
        let time = |index: usize| self.row(dump, index).and_then(|row| row.time);
        time(0)?;
        let (mut low, mut high) = (0, self.rows.len());
        while low < high {
            let middle = low + (high - low) / 2;
            match time(middle) {
                Some(time) if time < seconds => low = middle + 1,
                _ => high = middle,
            }
        }
        Some(low.min(self.rows.len().saturating_sub(1)))
    }

    fn decode_line<'a>(&'a self, bits: Bits<'a>, start: u64) -> Decoded<'a> {
        match self.pass.line(&self.decoder, bits) {
            Ok(frame) => Decoded::Frame(Frame { start, ..frame }),
            Err(why) => Decoded::Skip { start, bits, why },
        }
    }

    fn decode_bytes<'a>(&'a self, dump: &'a Dump, entry: &Entry, bytes: &'a [u8]) -> Decoded<'a> {
        let start = u64::from(entry.at);
        let bits = Bits::of_bytes(bytes);
        let request = self.request(dump, start);
        let asked = request.map_or(&[][..], |line| line.bits.bytes());
        let decoder = self.pass.answering(&self.decoder, asked);
        let why = match (entry.kind, decoder.frame(bytes)) {
            (Kind::Skip(Skip::Request), _) => Why::Request,
            (Kind::Skip(Skip::Unasked), _) => Why::Unasked,
            (Kind::Skip(Skip::Truncated), _) => Why::Truncated {
                have: bytes.len(),
                need: match decoder.layout(bytes) {
                    Some(layout) => layout.len / 8,
                    None => decoder.longest(),
                },
            },
            (Kind::Skip(Skip::NoFrame), _) | (_, None) => Why::NoFrame,
            (kind, Some(frame)) => {
                // What holds its checks and is bad all the same is not sure of its place.
                let sure = kind == Kind::Good || !frame.layout.holds(bits);
                let request = request.map(|line| line.start);
                return Decoded::Frame(Frame {
                    start,
                    sure,
                    request,
                    ..frame
                });
            }
        };
        Decoded::Skip { start, bits, why }
    }

    /// The request that what begins at `start` may answer: the one right in front of it.
    fn request<'a>(&self, dump: &'a Dump, start: u64) -> Option<Line<'a>> {
        if !dump.has_directions() {
            return None;
        }
        let own = dump.line_at(start);
        let before = (own.saturating_sub(REPLY_LINES)..own).rev();
        let mut lines = before.filter_map(|index| dump.line(index));
        lines.find(|line| line.direction == Some(Direction::Sent))
    }
}

/// Takes the rows of a pass.
struct Taker<'s> {
    dump: &'s Dump,
    /// The line that the last row began in.
    line: usize,
    rows: &'s mut Rows,
    lost: &'s mut u64,
    figures: &'s mut Figures,
    trace: &'s mut Trace,
}

impl Taker<'_> {
    fn add(&mut self, decoded: &Decoded<'_>) {
        if self.rows.len() >= MOST_ROWS {
            *self.lost += 1;
            return;
        }
        let (start, bits, kind) = match decoded {
            Decoded::Frame(frame) => {
                let kind = if frame.ok() { Kind::Good } else { Kind::Bad };
                (frame.start, frame.bits, kind)
            }
            Decoded::Skip { start, bits, why } => {
                let skip = match why {
                    Why::Request => Skip::Request,
                    Why::NoFrame => Skip::NoFrame,
                    Why::Unasked => Skip::Unasked,
                    Why::Truncated { .. } => Skip::Truncated,
                };
                (*start, *bits, Kind::Skip(skip))
            }
        };
        let timed = self.dump.has_times();
        let unit = self.rows.unit();
        if unit == Unit::Line || timed {
            self.line = self.dump.line_at(start);
        }
        let time = timed.then(|| self.dump.time_of(self.line)).flatten();
        self.figures.add(self.rows.len(), decoded, time);
        self.trace.add(decoded);
        let at = match unit {
            Unit::Line => self.line as u64,
            Unit::Byte => start,
        };
        self.rows.push(Entry {
            at: u32::try_from(at).unwrap_or(u32::MAX),
            len: u16::try_from(bits.bytes().len()).unwrap_or(u16::MAX),
            kind,
        });
    }
}
