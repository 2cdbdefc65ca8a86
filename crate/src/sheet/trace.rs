//! The angle of the rows of a sheet, so that any stretch of them can be drawn at once.

use super::Sheet;
use crate::{decode::Decoded, dump::Dump, reading::Reading};
use alloc::vec::Vec;

/// Rows in a block.
const BLOCK: usize = 64;
/// Rows of a column that are read one by one; more are taken from blocks.
const FEW: usize = 2 * BLOCK;

/// What the rows of a column come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// The first row.
    pub row: usize,
    /// Lowest and highest angle of good frames in degrees; `None` where there is none.
    pub range: Option<(f64, f64)>,
    /// Rows that are no good frame, requests among them.
    pub gaps: u32,
}

impl Column {
    const fn new(row: usize) -> Self {
        Self {
            row,
            range: None,
            gaps: 0,
        }
    }

    fn add(&mut self, angle: Option<f64>) {
        match (angle, &mut self.range) {
            (None, _) => self.gaps += 1,
            (Some(angle), None) => self.range = Some((angle, angle)),
            (Some(angle), Some((low, high))) => {
                *low = low.min(angle);
                *high = high.max(angle);
            }
        }
    }

    fn join(&mut self, other: &Self) {
        self.gaps += other.gaps;
        self.range = match (self.range, other.range) {
            (Some((low, high)), Some((lower, higher))) => Some((low.min(lower), high.max(higher))),
            (one, other) => one.or(other),
        };
    }
}

/// Blocks of rows.
#[derive(Clone, Debug, Default)]
pub(super) struct Trace {
    blocks: Vec<Column>,
    rows: usize,
}

fn angle_of(decoded: &Decoded<'_>) -> Option<f64> {
    match decoded {
        Decoded::Frame(frame) => frame.reading().as_ref().map(Reading::degrees),
        Decoded::Skip { .. } => None,
    }
}

impl Trace {
    /// Takes the next row.
    pub(super) fn add(&mut self, decoded: &Decoded<'_>) {
        if self.rows.is_multiple_of(BLOCK) {
            self.blocks.push(Column::new(self.rows));
        }
        self.rows += 1;
        if let Some(block) = self.blocks.last_mut() {
            block.add(angle_of(decoded));
        }
    }
}

impl Sheet {
    /// The angle of the rows `from` up to `to`, in at most `columns` columns of as many rows each.
    #[must_use]
    pub fn columns(&self, dump: &Dump, from: usize, to: usize, columns: usize) -> Vec<Column> {
        let to = to.min(self.len());
        let from = from.min(to);
        let each = (to - from).div_ceil(columns.max(1)).max(1);
        (from..to)
            .step_by(each)
            .map(|start| self.column(dump, start, (start + each).min(to)))
            .collect()
    }

    fn column(&self, dump: &Dump, from: usize, to: usize) -> Column {
        let mut column = Column::new(from);
        if to - from <= FEW {
            for index in from..to {
                let good = self.is_good(index).then(|| self.row(dump, index)).flatten();
                column.add(good.and_then(|row| angle_of(&row.decoded)));
            }
            return column;
        }
        let blocks = from / BLOCK..to.div_ceil(BLOCK);
        for block in self.trace.blocks.get(blocks).unwrap_or_default() {
            column.join(block);
        }
        column
    }
}
