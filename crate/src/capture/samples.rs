//! Rows of levels: what logic analysers export as CSV.
//!
//! - Saleae: `Time [s],Channel 0,Channel 1`, a row a change;
//! - sigrok-cli: remarks behind `;`, a heading, a row a sample; the rate stands in a remark;
//! - Xilinx ILA: `Sample in Buffer,Sample in Window,TRIGGER,…`, a row of radixes, a row a sample;
//! - anything with a heading: a column of time in s, ms, µs, ns or ps, or none.
//!
//! Columns are separated by `,`, `;` or tabs, and behind the latter two the decimal point may be
//! a comma. Columns of anything but 0 and 1 are passed over.

mod head;

use super::{Change, Clocking, Named, Unreadable};
use alloc::{string::String, vec::Vec};
use head::{Column, Head, Table};

/// Bytes of the longest line.
const LONGEST_LINE: usize = 65_536;
/// Rows that say whether text is a recording.
const ROWS_TO_SNIFF: u64 = 2;

/// Reads rows as they come, cut anywhere.
///
/// ```
/// use encoderscope::capture::samples::Samples;
/// let mut changes = Vec::new();
/// let mut samples = Samples::new(None);
/// for cut in ["; Samplerate: 1 MHz\nclk,da", "ta\n1,1\n0,", "1\n"] {
///     samples.push(cut.as_bytes(), &mut |change| changes.push(change)).unwrap();
/// }
/// let named = samples.finish(&mut |change| changes.push(change)).unwrap();
/// assert_eq!(named.names, ["clk", "data"]);
/// assert_eq!((changes.len(), changes[2].time, changes[2].signal), (3, 1_000_000, 0));
/// ```
#[derive(Clone, Debug)]
pub struct Samples {
    /// Of a line that is not yet whole.
    line: Vec<u8>,
    lines: u64,
    rows: u64,
    head: Head,
    table: Option<Table>,
    time: Option<i64>,
}

impl Samples {
    /// A reader; `sample` is the time from one row to the next in picoseconds, for rows that have
    /// no time and no rate.
    #[must_use]
    pub fn new(sample: Option<i64>) -> Self {
        Self {
            line: Vec::new(),
            lines: 0,
            rows: 0,
            head: Head::new(sample),
            table: None,
            time: None,
        }
    }

    /// Takes the next piece of text; `sink` gets every change in it.
    ///
    /// # Errors
    ///
    /// A time cannot be read or runs backwards, a line is too long, or there are too many
    /// columns.
    pub fn push(
        &mut self,
        mut text: &[u8],
        sink: &mut dyn FnMut(Change),
    ) -> Result<(), Unreadable> {
        while let Some(end) = text.iter().position(|byte| *byte == b'\n') {
            let (line, rest) = text.split_at(end);
            text = rest.get(1..).unwrap_or_default();
            if self.line.is_empty() {
                self.line(line, sink)?;
            } else {
                self.keep(line)?;
                let line = core::mem::take(&mut self.line);
                self.line(&line, sink)?;
            }
        }
        self.keep(text)
    }

    /// Takes the last line; says what the columns are called.
    ///
    /// # Errors
    ///
    /// As those of [`Samples::push`].
    pub fn finish(mut self, sink: &mut dyn FnMut(Change)) -> Result<Named, Unreadable> {
        let line = core::mem::take(&mut self.line);
        self.line(&line, sink)?;
        Ok(self.cut())
    }

    /// As [`Samples::finish`] where more text would come: a line that is not whole is left out.
    #[must_use]
    pub fn cut(self) -> Named {
        Named {
            names: self.names(),
            others: self.others(),
            clocking: self
                .table
                .as_ref()
                .map_or(Clocking::Counted, Table::clocking),
            end: self.time.unwrap_or(0),
        }
    }

    /// Whether text that begins so is a recording.
    pub(super) fn sniff(head: &[u8]) -> bool {
        let mut samples = Self::new(None);
        // The last line may be cut.
        let whole = head.iter().rposition(|byte| *byte == b'\n');
        let whole = head.get(..whole.map_or(0, |end| end + 1));
        let read = samples.push(whole.unwrap_or_default(), &mut |_| {});
        let Some(table) = &samples.table else {
            return false;
        };
        let levels = table.columns.iter().filter(|column| column.is_live());
        read.is_ok() && samples.rows >= ROWS_TO_SNIFF && table.headed && levels.count() >= 2
    }

    /// Names of the columns that hold levels.
    fn names(&self) -> Vec<String> {
        let columns = self.table.iter().flat_map(|table| &table.columns);
        let names = columns.filter_map(|column| match column {
            Column::Level { name, .. } => Some(name.clone()),
            _ => None,
        });
        names.collect()
    }

    /// Indexes of those that have held something else.
    fn others(&self) -> Vec<usize> {
        let columns = self.table.iter().flat_map(|table| &table.columns);
        let others = columns.filter_map(|column| match column {
            Column::Level {
                signal, dead: true, ..
            } => Some(*signal),
            _ => None,
        });
        others.collect()
    }

    fn keep(&mut self, text: &[u8]) -> Result<(), Unreadable> {
        if self.line.len() + text.len() > LONGEST_LINE {
            return Err(Unreadable::LongLine(self.lines + 1));
        }
        self.line.extend_from_slice(text);
        Ok(())
    }

    fn line(&mut self, line: &[u8], sink: &mut dyn FnMut(Change)) -> Result<(), Unreadable> {
        self.lines += 1;
        if line.len() > LONGEST_LINE {
            return Err(Unreadable::LongLine(self.lines));
        }
        let line = line.trim_ascii();
        if self.table.is_none() {
            self.table = self.head.line(line)?;
        } else if line.is_empty() || head::is_remark(line) {
            return Ok(());
        }
        match &mut self.table {
            Some(table) => {
                let row = table.row(line, self.rows, self.time, sink);
                let time = row.map_err(|fault| match fault {
                    head::Fault::Time => Unreadable::Time(self.lines),
                    head::Fault::Backwards => Unreadable::Backwards(self.lines),
                })?;
                self.time = Some(time);
                self.rows += 1;
                Ok(())
            }
            None => Ok(()),
        }
    }
}
