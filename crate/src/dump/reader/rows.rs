//! Rows of tables, of hexdumps and of annotations.

use super::{Reader, Text};
use crate::dump::{Dropped, offsets::Row, prose, table::Annotation, writing::Form};
use alloc::vec::Vec;

/// Bytes that repeated lines of a hexdump are written out to, at most.
const MOST_REPEATED: u64 = 1 << 20;

impl Reader {
    pub(super) fn row_of_table(&mut self, text: Text<'_>) {
        let Form::Table(table) = &self.dump.writing.form else {
            return;
        };
        let line = text.line;
        if crate::dump::table::Table::headed_by(line).is_some() {
            self.drop_line(text, Dropped::Column);
            return;
        }
        let Some(row) = table.row(line) else {
            match prose::is_prose(line, Some(2)) {
                true => self.drop_line(text, Dropped::Prose),
                false => {
                    let start = line.len() - line.trim_start().len();
                    self.unread(text, start..line.trim_end().len());
                }
            }
            return;
        };
        if row.other {
            self.drop_line(text, Dropped::Column);
            return;
        }
        if let Some(error) = row.error {
            self.drop(text, error, Dropped::Error);
        }
        self.drop(text, 0..row.data.start, Dropped::Column);
        self.drop(text, row.data.end..line.len(), Dropped::Column);
        self.dump.data.extend_from_slice(&row.bytes);
        self.close(row.time, row.direction);
    }

    pub(super) fn annotation(&mut self, text: Text<'_>) {
        let Some(found) = Annotation::read(text.line) else {
            self.drop_line(text, Dropped::Prose);
            return;
        };
        if found.bytes.is_empty() {
            self.drop_line(
                text,
                if found.error {
                    Dropped::Error
                } else {
                    Dropped::Column
                },
            );
            return;
        }
        self.drop(text, 0..found.value, Dropped::Column);
        self.dump.data.extend_from_slice(&found.bytes);
        self.close(None, found.direction);
    }

    pub(super) fn row_of_hexdump(&mut self, text: Text<'_>) {
        let front = crate::dump::line::Front::read(text.line, &self.dump.writing);
        let line = text.line.get(front.quote.end..).unwrap_or_default();
        let skipped = front.quote.end;
        if line.trim() == "*" {
            self.drop(text, front.quote.clone(), Dropped::Quote);
            let start = skipped + line.len() - line.trim_start().len();
            self.starred = Some(text.place(start..start + 1));
            return;
        }
        let Form::Offsets(offsets) = &self.dump.writing.form else {
            return;
        };
        let Some(mut row) = Row::read(line) else {
            self.slow(text, &front);
            return;
        };
        let at = offsets.at(&row);
        let bytes: Vec<u8> = offsets.ordered(&mut row).into();
        self.drop(text, front.quote.clone(), Dropped::Quote);
        let [start, offset, end] = row.places.map(|place| place + skipped);
        if let (Some(star), Some(at)) = (self.starred.take(), at)
            && !self.repeat(at)
        {
            self.dump.dropped.add(star, Dropped::Repeat);
        }
        self.drop(text, start..offset, Dropped::Offset);
        let rest = text.line.trim_end().len().max(end);
        let letters = text.line.get(end..rest).unwrap_or_default();
        let gap = letters.len() - letters.trim_start().len();
        self.drop(text, end + gap..rest, Dropped::Ascii);
        self.dump.data.extend_from_slice(&bytes);
        let (time, direction) = self.heading.unwrap_or_default();
        self.close(time, direction);
        if let Some(at) = at.filter(|_| !bytes.is_empty()) {
            self.last_row = Some((at, bytes));
        }
    }

    /// Writes the last row again up to the offset `to`; `false` where that is no whole number
    /// of times, or too often.
    fn repeat(&mut self, to: u64) -> bool {
        let Some((at, bytes)) = &self.last_row else {
            return false;
        };
        let len = bytes.len() as u64;
        let Some(missing) = to.checked_sub(at + len) else {
            return false;
        };
        if !missing.is_multiple_of(len) || self.repeated + missing > MOST_REPEATED {
            return false;
        }
        let bytes = bytes.clone();
        self.repeated += missing;
        for _ in 0..missing / len {
            self.dump.data.extend_from_slice(&bytes);
            let (time, direction) = self.heading.unwrap_or_default();
            self.close(time, direction);
        }
        true
    }
}
