//! What of a text is not data, and where it stands.

use crate::language::{msg, t};
use alloc::vec::Vec;
use core::{fmt, ops::Range};

/// Places that are kept; of more only the number is known.
const MOST_PLACES: usize = 1_000;

/// Why a piece of text is not data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Dropped {
    /// An offset in front of a line of a hexdump.
    Offset,
    /// The same bytes again, as letters.
    Ascii,
    /// A time.
    Time,
    /// A mark of the direction.
    Direction,
    /// A mark of quoted text.
    Quote,
    /// Words of a declaration in a programming language.
    Declaration,
    /// A comment.
    Comment,
    /// A line of ordinary text.
    Prose,
    /// Letters that look like those that were meant; they are read as what they look like.
    LookAlike,
    /// A label, or a column with something else than data.
    Column,
    /// An error of the line that an analyser noted; its byte is kept.
    Error,
    /// Repeated lines that are too many to write out.
    Repeat,
    /// Something that should be data and cannot be read.
    Unreadable,
}

impl Dropped {
    /// All kinds.
    pub const ALL: [Self; 13] = [
        Self::Offset,
        Self::Ascii,
        Self::Time,
        Self::Direction,
        Self::Quote,
        Self::Declaration,
        Self::Comment,
        Self::Prose,
        Self::LookAlike,
        Self::Column,
        Self::Error,
        Self::Repeat,
        Self::Unreadable,
    ];

    /// The kind in words.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Offset => msg("offsets"),
            Self::Ascii => msg("text beside the bytes"),
            Self::Time => msg("times"),
            Self::Direction => msg("direction marks"),
            Self::Quote => msg("quotation marks of e-mail"),
            Self::Declaration => msg("declarations"),
            Self::Comment => msg("comments"),
            Self::Prose => msg("lines of text"),
            Self::LookAlike => msg("look-alike letters"),
            Self::Column => msg("labels and other columns"),
            Self::Error => msg("errors of the line"),
            Self::Repeat => msg("repeated lines that are too many"),
            Self::Unreadable => msg("unreadable"),
        }
    }

    const fn index(self) -> usize {
        self as usize
    }
}

impl fmt::Display for Dropped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(t(self.name()))
    }
}

/// A place in a text, and why it is not data.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark {
    /// Offsets of the text, in bytes.
    pub at: Range<u64>,
    /// Why it is not data.
    pub kind: Dropped,
}

/// Places in a text, in order, up to a limit, and how many there are in all.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Marks {
    /// The first places.
    pub places: Vec<Mark>,
    /// How many places there are.
    pub total: u64,
    counts: [u64; Dropped::ALL.len()],
}

impl Marks {
    /// How many places there are of a kind.
    #[must_use]
    pub fn count(&self, kind: Dropped) -> u64 {
        self.counts[kind.index()]
    }

    /// Whether there are no places.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.total == 0
    }

    pub(super) fn add(&mut self, at: Range<u64>, kind: Dropped) {
        self.total += 1;
        self.counts[kind.index()] += 1;
        // Of a line the comments are found before what stands in front of them.
        let index = self
            .places
            .partition_point(|known| known.at.start <= at.start);
        if index < MOST_PLACES {
            self.places.truncate(MOST_PLACES - 1);
            self.places.insert(index, Mark { at, kind });
        }
    }
}
