//! What a recording comes to: every change of its signals, kept in a few bytes each.

use super::{Change, Clocking, Named, Signal, Unreadable, recording::MOST_SIGNALS};
use crate::bits::{above, low_byte, placed, slice};
use alloc::vec::Vec;

/// Bytes that are set aside at a time.
const BLOCK: usize = 256 * 1024;
/// Bytes that a change takes at most: two numbers, of 64 bits and of a signal with its level.
const LONGEST: usize = 12;

/// All changes of the signals of a recording, in order.
///
/// A change is kept as the signal with its level, and the time since the change before, each as a
/// number of seven bits a byte. So it takes at most 12 bytes; one within 2 µs of the one before
/// takes 4, within 268 µs 5. How much all take is bounded by [`super::Reader::with_room`].
///
/// ```
/// use encoderscope::capture::{Kind, Reader};
/// let mut reader = Reader::new(Kind::Samples, None).unwrap();
/// reader.push(b"Time [us],clk,data\n0,1,1\n5,0,1\n6,1,1\n").unwrap();
/// let changes = reader.finish().unwrap();
/// let clock = changes.iter().filter(|change| change.signal == 0);
/// assert_eq!(clock.map(|change| change.time).collect::<Vec<_>>(), [0, 5_000_000, 6_000_000]);
/// assert_eq!((changes.len(), changes.signals()[0].edges), (4, 2));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Changes {
    pub(super) signals: Vec<Signal>,
    pub(super) clocking: Clocking,
    /// When the recording ended.
    pub(super) end: i64,
    kept: Kept,
}

impl Changes {
    /// All signals.
    #[must_use]
    pub fn signals(&self) -> &[Signal] {
        &self.signals
    }

    /// What the times are worth.
    #[must_use]
    pub const fn clocking(&self) -> Clocking {
        self.clocking
    }

    /// When the recording ended, in picoseconds or samples.
    #[must_use]
    pub const fn end(&self) -> i64 {
        self.end
    }

    /// How many changes there are.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.kept.count
    }

    /// Whether nothing ever has a level.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Bytes that they take.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.kept.blocks.iter().map(Vec::len).sum()
    }

    /// The changes: the first level of each signal, then where it takes another one.
    pub fn iter(&self) -> impl Iterator<Item = Change> + '_ {
        let mut place = Place::default();
        core::iter::from_fn(move || self.next(&mut place))
    }

    /// The change at a place, which moves on.
    #[inline]
    pub(super) fn next(&self, place: &mut Place) -> Option<Change> {
        let mut block = self.kept.blocks.get(place.block)?;
        if place.at >= block.len() {
            place.block += 1;
            place.at = 0;
            block = self.kept.blocks.get(place.block)?;
        }
        let signal = number(block, &mut place.at)?;
        let since = number(block, &mut place.at)?;
        place.time = place.time.wrapping_add_unsigned(since);
        Some(Change {
            time: place.time,
            signal: above(signal, 1) as usize,
            level: slice(signal, 0, 1) == 1,
        })
    }
}

/// How far the changes have been looked at.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Place {
    block: usize,
    at: usize,
    /// Of the change before.
    pub(super) time: i64,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Kept {
    /// No change is in two of them.
    blocks: Vec<Vec<u8>>,
    count: usize,
    /// When the last one was.
    time: i64,
}

impl Kept {
    fn push(&mut self, change: Change) {
        let full = |block: &Vec<u8>| block.len() + LONGEST > BLOCK;
        if self.blocks.last().is_none_or(full) {
            self.blocks.push(Vec::with_capacity(BLOCK));
        }
        if let Some(block) = self.blocks.last_mut() {
            let signal = placed(change.signal as u64, 1);
            write(block, signal + u64::from(change.level));
            write(block, change.time.wrapping_sub(self.time) as u64);
        }
        self.count += 1;
        self.time = change.time;
    }
}

/// Writes seven bits a byte, the lowest first; all but the last byte have the highest bit set.
#[inline]
fn write(block: &mut Vec<u8>, mut number: u64) {
    while number > 127 {
        block.push(low_byte(number) | 128);
        number = above(number, 7);
    }
    block.push(low_byte(number));
}

/// Reads what [`write`] has written.
#[inline]
fn number(block: &[u8], at: &mut usize) -> Option<u64> {
    let mut number = 0;
    let mut place = 0;
    loop {
        let byte = *block.get(*at)?;
        *at += 1;
        number |= placed(u64::from(byte & 127), place);
        if byte < 128 {
            return Some(number);
        }
        place += 7;
    }
}

/// Takes changes as they are read.
#[derive(Clone, Debug)]
pub(super) struct Keeper {
    signals: Vec<Signal>,
    /// The shortest time between two changes.
    finest: i64,
    last: Option<i64>,
    kept: Kept,
    /// Bytes that may be kept.
    pub(super) room: usize,
    /// Whether they were not enough.
    full: bool,
}

impl Keeper {
    pub(super) const fn new(room: usize) -> Self {
        Self {
            signals: Vec::new(),
            finest: i64::MAX,
            last: None,
            kept: Kept {
                blocks: Vec::new(),
                count: 0,
                time: 0,
            },
            room,
            full: false,
        }
    }

    pub(super) fn take(&mut self, change: Change) {
        if self.signals.len() <= change.signal {
            let count = change.signal.min(MOST_SIGNALS) + 1;
            self.signals.resize_with(count, || Signal::new(""));
        }
        if let Some(last) = self.last.replace(change.time)
            && last < change.time
        {
            self.finest = self.finest.min(change.time.saturating_sub(last));
        }
        let signal = self.signals.get_mut(change.signal);
        if signal.is_some_and(|signal| signal.change(change.time, change.level)) {
            self.full |= self.used() + LONGEST > self.room;
            if !self.full {
                self.kept.push(change);
            }
        }
    }

    fn used(&self) -> usize {
        let before = self.kept.blocks.len().saturating_sub(1) * BLOCK;
        before + self.kept.blocks.last().map_or(0, Vec::len)
    }

    /// Whether everything could be kept so far.
    pub(super) const fn fits(&self) -> Result<(), Unreadable> {
        match self.full {
            true => Err(Unreadable::TooManyChanges(self.room)),
            false => Ok(()),
        }
    }

    pub(super) fn finish(mut self, named: &Named) -> Result<Changes, Unreadable> {
        self.fits()?;
        self.signals
            .resize_with(named.names.len(), || Signal::new(""));
        for (signal, name) in self.signals.iter_mut().zip(&named.names) {
            signal.name.clone_from(name);
            signal.finish(named.end);
        }
        for other in &named.others {
            if let Some(signal) = self.signals.get_mut(*other) {
                *signal = Signal::new(&signal.name);
            }
        }
        Ok(Changes {
            signals: self.signals,
            // What lies between two changes is a bound of what the recorder tells apart.
            clocking: match named.clocking {
                Clocking::Timed(0) if self.finest < i64::MAX => Clocking::Timed(self.finest),
                other => other,
            },
            end: named.end,
            kept: self.kept,
        })
    }
}
