//! The rows of a sheet as they are kept. Rows that follow one another without a gap, alike in
//! length and kind, are kept as one stretch: a file of good frames takes next to nothing.

use alloc::vec::Vec;

/// What a row is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Good,
    Bad,
    Skip(Skip),
}

/// Why input is in no frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Skip {
    Request,
    NoFrame,
    Unasked,
    Truncated,
}

impl Kind {
    /// Whether nothing is wrong with it.
    const fn is_fine(self) -> bool {
        matches!(self, Self::Good | Self::Skip(Skip::Request))
    }
}

/// A row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Entry {
    /// Where its data begins: bytes of the data, or the line of a bit format.
    pub(super) at: u32,
    /// Bytes of its data; of a bit format the line knows.
    pub(super) len: u16,
    pub(super) kind: Kind,
}

/// What data is counted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Byte,
    Line,
}

impl Unit {
    /// How far the next row is, where no gap is between.
    fn step(self, entry: Entry) -> u32 {
        match self {
            Self::Byte => entry.len.into(),
            Self::Line => 1,
        }
    }
}

/// Rows that follow one another.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    /// The place of the first among all rows.
    index: u32,
    first: Entry,
}

/// All rows.
#[derive(Debug)]
pub(super) struct Rows {
    unit: Unit,
    stretches: Vec<Stretch>,
    len: u32,
}

impl Rows {
    pub(super) const fn new(unit: Unit) -> Self {
        Self {
            unit,
            stretches: Vec::new(),
            len: 0,
        }
    }

    pub(super) const fn unit(&self) -> Unit {
        self.unit
    }

    pub(super) const fn len(&self) -> usize {
        self.len as usize
    }

    pub(super) const fn is_empty(&self) -> bool {
        self.len == 0
    }

    pub(super) fn push(&mut self, entry: Entry) {
        let last = self.stretches.last();
        if last.is_none_or(|last| self.of_stretch(last, self.len) != entry) {
            self.stretches.push(Stretch {
                index: self.len,
                first: entry,
            });
        }
        self.len = self.len.saturating_add(1);
    }

    pub(super) fn get(&self, index: usize) -> Option<Entry> {
        let index = u32::try_from(index)
            .ok()
            .filter(|index| *index < self.len)?;
        let stretch = self.stretches.get(self.stretch_at(index)?)?;
        Some(self.of_stretch(stretch, index))
    }

    /// The first row from `from` on with which something is wrong.
    pub(super) fn next_fault(&self, from: usize) -> Option<usize> {
        let from = u32::try_from(from).ok().filter(|from| *from < self.len)?;
        let rest = self.stretches.get(self.stretch_at(from)?..)?;
        let found = rest.iter().find(|stretch| !stretch.first.kind.is_fine())?;
        Some(found.index.max(from) as usize)
    }

    /// What the row of an index is, if it belongs to the stretch.
    fn of_stretch(&self, stretch: &Stretch, index: u32) -> Entry {
        let behind = index.saturating_sub(stretch.index);
        let way = behind.saturating_mul(self.unit.step(stretch.first));
        Entry {
            at: stretch.first.at.saturating_add(way),
            ..stretch.first
        }
    }

    /// The place of the stretch that a row belongs to.
    fn stretch_at(&self, index: u32) -> Option<usize> {
        let behind = self
            .stretches
            .partition_point(|stretch| stretch.index <= index);
        behind.checked_sub(1)
    }
}
