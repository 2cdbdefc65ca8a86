//! Many readings as columns: a number after the other, no object for each frame.
//!
//! ```
//! use encoderscope::{columns::Columns, decode::Decoder, framing::Framer, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "t485")])?)?;
//! let (mut framer, mut columns) = (Framer::at_start(), Columns::default());
//! framer.push_runs(&decoder, &[0x02, 0x20, 0xb4, 0xbd, 0x1c, 0x37], &mut |run| columns.take(&run));
//! framer.finish_runs(&decoder, &mut |run| columns.take(&run));
//! assert_eq!((columns.len(), columns.angle[0], columns.health[0].is_error()), (1, 0x1c_bdb4, true));
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```

use crate::{
    bits,
    framing::{Piece, PieceKind},
    reading::Reading,
};
use alloc::vec::Vec;

/// The readings of good frames, each number in a column of its own.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Columns {
    /// Counts within one turn.
    pub angle: Vec<u64>,
    /// Whole turns; 0 where the encoder counts none.
    pub turns: Vec<i64>,
    /// The status bits; 0 where the frame has none.
    pub status: Vec<u8>,
    /// What the encoder says of the position.
    pub health: Vec<Health>,
    /// Where the runs of frames are in the input.
    pub runs: Vec<Run>,
}

/// Frames that follow one another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// Offset of the first in the input, in bytes.
    pub start: u64,
    /// Bytes of each.
    pub len: u32,
    /// How many there are.
    pub frames: u32,
}

/// What an encoder says of its position, in a byte.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Health(u8);

impl Health {
    /// Places of its bits.
    pub(crate) const ERROR: u32 = 1;
    pub(crate) const WARNING: u32 = 0;

    pub(crate) const fn of_bits(bits: u8) -> Self {
        Self(bits)
    }

    fn of(error: bool, warning: bool) -> Self {
        let bit = |says: bool, place| bits::placed(says.into(), place);
        Self(bits::low_byte(
            bit(error, Self::ERROR) | bit(warning, Self::WARNING),
        ))
    }

    /// The position is not valid.
    #[must_use]
    pub const fn is_error(self) -> bool {
        bits::bit(self.0 as u64, Self::ERROR)
    }

    /// The position is valid, but something is near its limit.
    #[must_use]
    pub const fn is_warning(self) -> bool {
        bits::bit(self.0 as u64, Self::WARNING)
    }
}

/// The places of some readings, all 0 yet.
pub(crate) struct Room<'c> {
    pub(crate) angle: &'c mut [u64],
    pub(crate) turns: &'c mut [i64],
    pub(crate) status: &'c mut [u8],
    pub(crate) health: &'c mut [Health],
}

impl Columns {
    /// How many readings there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.angle.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.angle.is_empty()
    }

    /// Takes what a piece says; frames that are bad, not certain or without an angle say nothing.
    pub fn take(&mut self, piece: &Piece<'_>) {
        let PieceKind::Frame {
            layout,
            sure: true,
            holds: true,
        } = piece.kind
        else {
            return;
        };
        let before = self.len();
        layout.columns(piece.bytes, self);
        let frames = self.len() - before;
        if frames > 0 {
            self.runs.push(Run {
                start: piece.start,
                len: layout.bytes() as u32,
                frames: frames as u32,
            });
        }
    }

    pub(crate) fn push(&mut self, reading: Option<Reading>) {
        let Some(reading) = reading else {
            return;
        };
        self.angle.push(reading.angle);
        self.turns.push(reading.turns.unwrap_or(0));
        self.status.push(reading.status.unwrap_or(0));
        self.health.push(Health::of(reading.error, reading.warning));
    }

    /// Makes room for more readings behind those that there are.
    pub(crate) fn grow(&mut self, count: usize) -> Room<'_> {
        fn grown<T: Clone + Default>(column: &mut Vec<T>, count: usize) -> &mut [T] {
            let old = column.len();
            column.resize(old + count, T::default());
            column.get_mut(old..).unwrap_or_default()
        }
        Room {
            angle: grown(&mut self.angle, count),
            turns: grown(&mut self.turns, count),
            status: grown(&mut self.status, count),
            health: grown(&mut self.health, count),
        }
    }

    /// Forgets the readings, and keeps their room.
    pub fn clear(&mut self) {
        self.angle.clear();
        self.turns.clear();
        self.status.clear();
        self.health.clear();
        self.runs.clear();
    }
}
