//! Layouts prepared to judge and read many frames quickly, out of the same tables.
//!
//! Every check starts from a constant and adds up, bit by bit, so that what is wrong with a
//! frame is the sum of what is wrong with its bytes: a table of 256 entries for each of them
//! replaces the checks. The tables are computed from the checks themselves. Frames of up to
//! eight bytes are judged and read as one word, up to sixteen as two.

use super::{Active, Field, Resolved, Role};
use crate::{
    bits::{self, BitString, Bits, Span},
    columns::{Columns, Health},
    decode::Follows,
    reading::Reading,
};
use alloc::{boxed::Box, vec::Vec};

/// Bytes of a word.
const WORD: usize = 8;
/// Frames that are read into columns at once.
const BATCH: usize = 64;

/// What a word of a frame must be, and what its bytes add to the checks of the frame.
#[derive(Clone, Debug)]
struct Sieve {
    /// Fixed bits.
    mask: u64,
    value: u64,
    /// For each byte of the word, the last one first.
    syndromes: Box<[[u16; 256]; WORD]>,
}

/// The tables of a layout.
#[derive(Clone, Debug)]
pub(super) struct Fast {
    /// What the checks of an all-zero frame come to.
    none: u16,
    /// The last eight bytes, and what is before them.
    last: Sieve,
    before: Option<Sieve>,
    angle: Number,
    turns: Number,
    status: Number,
    error: Flag,
    warning: Flag,
}

/// Where a part of a number stands in the frame as one word, and what it is worth.
#[derive(Clone, Copy, Debug, Default)]
struct Take {
    below: u32,
    mask: u64,
    place: u32,
}

/// A number; most have one part.
#[derive(Clone, Debug, Default)]
struct Number {
    exists: bool,
    first: Take,
    more: Vec<Take>,
}

/// One bit, and the level that asserts it.
#[derive(Clone, Copy, Debug)]
struct Flag {
    at: Take,
    asserted: u64,
}

/// A flag that does not exist: no level asserts it.
const NO_FLAG: Flag = Flag {
    at: Take {
        below: 0,
        mask: 0,
        place: 0,
    },
    asserted: u64::MAX,
};

impl Resolved {
    /// The same layout, prepared to judge and read many frames quickly; text and frames that are
    /// not a few whole bytes stay as they are.
    #[must_use]
    pub fn sieved(mut self) -> Self {
        let plain = self.fields().all(|field| self.coding(field).is_none());
        let checks: u32 = self
            .fields()
            .filter(|field| Field::is_binding(field))
            .map(|field| field.width)
            .sum();
        if !plain || !self.len.is_multiple_of(8) || self.len > 16 * WORD || checks > u16::BITS {
            return self;
        }
        let none = self.syndrome(&BitString::zeros(self.len));
        let bytes = self.len / 8;
        let cut = bytes.saturating_sub(WORD);
        self.fast = Some(Box::new(Fast {
            none,
            last: self.sieve(cut..bytes, none),
            before: (cut > 0).then(|| self.sieve(0..cut, none)),
            angle: self.number(Role::Angle),
            turns: self.number(Role::Turns),
            status: self.number(Role::Status),
            error: self
                .flag(Role::Error, Active::High)
                .or_else(|| self.flag(Role::Valid, Active::Low))
                .or_else(|| self.named_error())
                .unwrap_or(NO_FLAG),
            warning: self.flag(Role::Warning, Active::High).unwrap_or(NO_FLAG),
        }));
        self
    }

    fn take(&self, span: Span, place: u32) -> Take {
        Take {
            below: (self.len - span.end()) as u32,
            mask: bits::mask(span.len),
            place,
        }
    }

    fn number(&self, role: Role) -> Number {
        let field = self.fields().find(|field| field.row.role == role);
        let parts = field.map_or(&[][..], |field| self.parts(field));
        let mut takes = parts.iter().map(|part| self.take(part.span, part.place));
        Number {
            exists: field.is_some(),
            first: takes.next().unwrap_or_default(),
            more: takes.collect(),
        }
    }

    /// The bit of a flag, which says the same as asked for, or the opposite.
    fn flag(&self, role: Role, says: Active) -> Option<Flag> {
        let field = self.fields().find(|field| field.row.role == role)?;
        let part = self.parts(field).first()?;
        Some(Flag {
            at: self.take(part.span, 0),
            asserted: u64::from(field.row.active == says),
        })
    }

    /// The error flag where it is a named bit of the status.
    fn named_error(&self) -> Option<Flag> {
        let field = self.fields().find(|field| field.row.role == Role::Status)?;
        let mut named = field.row.bits.iter();
        let bit = named.find(|bit| bit.role == Some(Role::Error))?;
        let at = self.bit_of(field, bit.place)?;
        Some(Flag {
            at: self.take(Span::new(at, 1), 0),
            asserted: 1,
        })
    }

    fn sieve(&self, bytes: core::ops::Range<usize>, none: u16) -> Sieve {
        let mut mask = BitString::zeros(self.len);
        let mut value = BitString::zeros(self.len);
        for field in self.fields() {
            let all = bits::mask(field.width as usize);
            let (fixed, to) = match field.row.constant {
                Some(constant) => (all, constant),
                None => (field.row.zeros, 0),
            };
            self.write(field, &mut mask, fixed);
            self.write(field, &mut value, to & fixed);
        }
        let word = Span::new(bytes.start * 8, bytes.len() * 8);
        let mut syndromes = Box::new([[0; 256]; WORD]);
        for (byte, table) in bytes.rev().zip(syndromes.iter_mut()) {
            for place in 0..8 {
                let mut one = BitString::zeros(self.len);
                one.flip(byte * 8 + 7 - place as usize);
                let adds = self.syndrome(&one) ^ none;
                for (code, sum) in (0u64..).zip(table.iter_mut()) {
                    if bits::bit(code, place) {
                        *sum ^= adds;
                    }
                }
            }
        }
        Sieve {
            mask: mask.as_bits().read(word),
            value: value.as_bits().read(word),
            syndromes,
        }
    }

    /// What the binding checks of a frame give against what they should, side by side.
    fn syndrome(&self, frame: &BitString) -> u16 {
        let mut place = 0;
        let mut sum = 0;
        for field in self.fields().filter(|field| Field::is_binding(field)) {
            let bits = frame.as_bits();
            if let Some(expected) = self.expected(field, bits) {
                sum |= bits::placed(expected ^ self.read(field, bits), place);
                place += field.width;
            }
        }
        sum as u16
    }

    /// Whether every check holds, for a frame of exactly this length; `None` where the layout
    /// has not been sieved.
    #[inline(always)]
    pub(crate) fn passes_sieve(&self, bits: Bits<'_>) -> Option<bool> {
        let fast = self.fast.as_deref()?;
        if bits.len() != self.len {
            return None;
        }
        let bytes = bits.bytes();
        let (before, last) = bytes.split_at(bytes.len().saturating_sub(WORD));
        let mut wrong = 0;
        let mut sum = fast.none;
        fast.last.judge(bits::word(last), &mut wrong, &mut sum);
        if let Some(sieve) = &fast.before {
            sieve.judge(bits::word(before), &mut wrong, &mut sum);
        }
        Some(wrong == 0 && sum == 0)
    }

    /// Whether a frame that holds does not end as one that is read a byte late: with a zero.
    #[inline]
    pub(crate) fn is_sound(&self, frame: &[u8]) -> bool {
        !(self.is_zero_led && frame.last() == Some(&0))
    }

    /// How many frames at the start of `bytes`, of which the first has been judged, hold, are
    /// sound, and begin as `follows` wants; and whether the last is the one before it again, as
    /// `repeats` says of the first. A frame that ends repetition is left to be judged otherwise.
    #[inline]
    pub(crate) fn run(&self, bytes: &[u8], repeats: bool, follows: Follows<'_>) -> (usize, bool) {
        let Some(fast) = self.fast.as_deref() else {
            return (1, repeats);
        };
        match fast.before {
            None => self.run_of(fast, bytes, repeats, follows, Self::short),
            Some(_) => self.run_of(fast, bytes, repeats, follows, Self::long),
        }
    }

    #[inline(always)]
    fn run_of(
        &self,
        fast: &Fast,
        bytes: &[u8],
        mut repeats: bool,
        follows: Follows<'_>,
        words: impl Fn(&Self, &[u8; 2 * WORD]) -> [u64; 2],
    ) -> (usize, bool) {
        let len = self.len / 8;
        let mut frames = 1;
        let Some(first) = bytes.first_chunk() else {
            return (frames, repeats);
        };
        let mut previous = words(self, first);
        let mut rest = bytes.get(len..).unwrap_or_default();
        while let Some(next) = rest.first_chunk() {
            let now = words(self, next);
            let mut wrong = 0;
            let mut sum = fast.none;
            fast.last.judge(now[0], &mut wrong, &mut sum);
            if let Some(before) = &fast.before {
                before.judge(now[1], &mut wrong, &mut sum);
            }
            let late = self.is_zero_led && bits::low_byte(now[0]) == 0;
            let same = now == previous;
            if wrong != 0 || sum != 0 || late || repeats && !same || !follows.holds(next) {
                break;
            }
            (repeats, previous) = (same, now);
            frames += 1;
            rest = rest.get(len..).unwrap_or_default();
        }
        (frames, repeats)
    }

    /// The frame of up to eight bytes at the start of a chunk as a number.
    #[inline(always)]
    fn short(&self, chunk: &[u8; 2 * WORD]) -> [u64; 2] {
        let word = chunk
            .first_chunk()
            .map_or(0, |word| u64::from_be_bytes(*word));
        [bits::above(word, (WORD * 8 - self.len) as u32), 0]
    }

    /// The last eight bytes of the longer frame at the start of a chunk, and those before.
    #[inline(always)]
    fn long(&self, chunk: &[u8; 2 * WORD]) -> [u64; 2] {
        let cut = self.len / 8 - WORD;
        let word = |at: usize| {
            let word = chunk.get(at..).and_then(<[u8]>::first_chunk);
            word.map_or(0, |word| u64::from_be_bytes(*word))
        };
        [word(cut), bits::above(word(0), ((WORD - cut) * 8) as u32)]
    }

    /// Adds a run of frames whose checks hold to columns.
    pub(crate) fn columns(&self, run: &[u8], columns: &mut Columns) {
        let frames = run.chunks_exact(self.len / 8);
        let Some(fast) = self.fast.as_deref().filter(|fast| fast.angle.exists) else {
            for frame in frames {
                columns.push(self.position(Bits::of_bytes(frame)));
            }
            return;
        };
        let mut words = [[0; 2]; BATCH];
        let mut rest = run;
        while !rest.is_empty() {
            let mut filled = 0;
            for slot in &mut words {
                let Some(frame) = rest.get(..self.len / 8).filter(|frame| !frame.is_empty()) else {
                    break;
                };
                let (before, last) = frame.split_at(frame.len().saturating_sub(WORD));
                *slot = match (rest.first_chunk(), before.is_empty()) {
                    (Some(chunk), true) => self.short(chunk),
                    (Some(chunk), false) => self.long(chunk),
                    (None, _) => [bits::word(last), bits::word(before)],
                };
                rest = rest.get(self.len / 8..).unwrap_or_default();
                filled += 1;
            }
            if filled == 0 {
                break;
            }
            fast.add(self, words.get(..filled).unwrap_or_default(), columns);
        }
    }

    /// Position and health of a frame whose checks hold; `None` where the layout has not been
    /// sieved or holds no angle.
    #[inline]
    pub(crate) fn quick_position(&self, bits: Bits<'_>) -> Option<Reading> {
        let fast = self.fast.as_deref().filter(|_| bits.len() == self.len)?;
        let bytes = bits.bytes();
        if bytes.len() <= WORD {
            let word = bits::word(bytes);
            return fast.position(self, |take| bits::above(word, take.below) & take.mask);
        }
        // Parts of longer frames stand in one byte each, so none lies across the words.
        let (before, last) = bytes.split_at(bytes.len() - WORD);
        let (before, last) = (bits::word(before), bits::word(last));
        fast.position(self, |take| {
            let (word, below) = match take.below.checked_sub(u64::BITS) {
                Some(below) => (before, below),
                None => (last, take.below),
            };
            bits::above(word, below) & take.mask
        })
    }
}

impl Sieve {
    #[inline]
    fn judge(&self, word: u64, wrong: &mut u64, sum: &mut u16) {
        *wrong |= word & self.mask ^ self.value;
        for (byte, table) in word.to_le_bytes().iter().zip(self.syndromes.iter()) {
            *sum ^= table[usize::from(*byte)];
        }
    }
}

impl Fast {
    /// Adds frames, as their last eight bytes and those before, to columns.
    #[inline]
    fn add(&self, layout: &Resolved, frames: &[[u64; 2]], columns: &mut Columns) {
        let read = |[last, before]: &[u64; 2], take: &Take| {
            let (word, below) = match take.below.checked_sub(u64::BITS) {
                Some(below) => (before, below),
                None => (last, take.below),
            };
            bits::above(*word, below) & take.mask
        };
        let number = |frame: &[u64; 2], number: &Number| {
            let part = |take: &Take| bits::raised(read(frame, take), take.place);
            let first = part(&number.first);
            number.more.iter().fold(first, |sum, take| sum | part(take))
        };
        let is = |frame: &[u64; 2], flag: &Flag| read(frame, &flag.at) == flag.asserted;
        let angle = frames.iter().map(|frame| number(frame, &self.angle));
        columns.angle.extend(angle);
        let turns = frames
            .iter()
            .map(|frame| layout.turns(number(frame, &self.turns)));
        columns.turns.extend(turns);
        let status = frames
            .iter()
            .map(|frame| bits::low_byte(number(frame, &self.status)));
        columns.status.extend(status);
        let health = frames
            .iter()
            .map(|frame| Health::of(is(frame, &self.error), is(frame, &self.warning)));
        columns.health.extend(health);
    }

    #[inline]
    fn position(&self, layout: &Resolved, read: impl Fn(&Take) -> u64) -> Option<Reading> {
        if !self.angle.exists {
            return None;
        }
        let part = |take: &Take| bits::raised(read(take), take.place);
        let number = |number: &Number| {
            let first = part(&number.first);
            number.more.iter().fold(first, |sum, take| sum | part(take))
        };
        let is = |flag: &Flag| read(&flag.at) == flag.asserted;
        Some(Reading {
            angle: number(&self.angle),
            angle_bits: layout.shape.profile.angle_bits,
            turns: self.turns.exists.then(|| layout.turns(number(&self.turns))),
            error: is(&self.error),
            warning: is(&self.warning),
            status: self
                .status
                .exists
                .then(|| bits::low_byte(number(&self.status))),
        })
    }
}
