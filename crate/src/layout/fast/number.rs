//! Numbers read straight out of the bytes of frames.

use super::WORD;
use crate::{
    bits::{self, Span},
    layout::Part,
};
use alloc::vec::Vec;

/// A part of a number: some bits of the eight bytes from one on.
#[derive(Clone, Copy, Debug, Default)]
struct Take {
    /// The first of the bytes, counted in the frame.
    at: usize,
    order: Order,
    /// How far the bits are turned to the right to be where they are worth what they are.
    turn: u32,
    /// Where they are then.
    mask: u64,
}

/// Which of the bytes is the most significant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Order {
    #[default]
    First,
    Last,
}

/// A number of a frame as its bits stand there; most have one part. One without parts does not
/// exist, and reads as 0.
#[derive(Clone, Debug, Default)]
pub(super) struct Number {
    takes: Vec<Take>,
    /// Where the number stands in the word of a Gray code that the takes read.
    gray: Option<(u32, u64)>,
}

impl Number {
    /// The number in a frame of `len` bytes whose parts are these, the most significant first.
    pub(super) fn of(len: usize, parts: &[Part]) -> Self {
        let mut number = Self::default();
        match Take::of_reversed(len, parts) {
            Some(take) => number.takes.push(take),
            None => parts.iter().for_each(|part| number.add(len, *part)),
        }
        number
    }

    /// The number in `part` of a Gray-coded word, in a frame of `len` bytes.
    pub(super) fn of_gray(len: usize, word: Span, part: Part) -> Self {
        let mut number = Self::default();
        let below = word.end() - part.span.end();
        number.add(
            len,
            Part {
                span: word,
                place: 0,
            },
        );
        number.gray = Some((below as u32, bits::mask(part.span.len)));
        number
    }

    fn add(&mut self, len: usize, part: Part) {
        let (start, end) = (part.span.start, part.span.end());
        // What begins inside a byte may reach into a ninth.
        let cut = (start / 8 + WORD) * 8;
        if end > cut {
            let place = part.place + (end - cut) as u32;
            let spans = [(start..cut, place), (cut..end, part.place)];
            for (bits, place) in spans {
                let span = Span::new(bits.start, bits.len());
                self.takes.push(Take::of(len, span, place));
            }
        } else {
            self.takes.push(Take::of(len, part.span, part.place));
        }
    }

    pub(super) const fn exists(&self) -> bool {
        !self.takes.is_empty()
    }

    /// All there is to the number, where it stands in the first eight bytes as it is.
    fn in_head(&self) -> Option<Take> {
        match &*self.takes {
            [] => Some(Take::default()),
            [take] if self.gray.is_none() && take.at == 0 && take.order == Order::First => {
                Some(*take)
            }
            _ => None,
        }
    }

    /// The number in the frame at the start of `bytes`, where it exists.
    #[inline]
    pub(super) fn some(&self, bytes: &[u8]) -> Option<u64> {
        self.exists().then(|| self.read(bytes))
    }

    #[inline]
    pub(super) fn read(&self, bytes: &[u8]) -> u64 {
        self.decoded(self.sum(bytes))
    }

    #[inline(always)]
    const fn decoded(&self, bits: u64) -> u64 {
        match self.gray {
            None => bits,
            Some((below, mask)) => bits::above(bits::from_gray(bits), below) & mask,
        }
    }

    /// Puts what the numbers of the frames of `len` bytes in `run` come to into `column`, which
    /// holds what comes of 0. Number by number rather than frame by frame, so that what differs
    /// between numbers is decided once.
    #[inline]
    pub(super) fn column<T>(
        &self,
        run: &[u8],
        len: usize,
        column: &mut [T],
        of: impl Fn(u64) -> T,
    ) {
        let of = |bits| of(self.decoded(bits));
        match &*self.takes {
            [] => {}
            [take] => take.column(run, len, column, |slot, bits| *slot = of(bits)),
            _ => {
                let mut rest = run;
                for slot in column {
                    *slot = of(self.sum(rest));
                    rest = rest.get(len..).unwrap_or_default();
                }
            }
        }
    }

    /// The number as its bits stand in the frame at the start of `bytes`.
    #[inline(always)]
    fn sum(&self, bytes: &[u8]) -> u64 {
        let takes = self.takes.iter();
        takes.fold(0, |sum, take| sum | take.read(bytes))
    }
}

/// Angle, turns, status and health of a frame, where all stand in its first eight bytes: they
/// are read at once, which is quicker where there are more than two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Together([Take; 4]);

impl Together {
    pub(super) fn of(numbers: [&Number; 4]) -> Option<Self> {
        let several = numbers.iter().filter(|number| number.exists()).count() > 2;
        let [angle, turns, status, health] = numbers.map(Number::in_head);
        let takes = [angle?, turns?, status?, health?];
        several.then_some(Self(takes))
    }

    /// The numbers of the frame at the start of `bytes`.
    #[inline(always)]
    pub(super) fn read(self, bytes: &[u8]) -> [u64; 4] {
        let word = u64::from_be_bytes(eight(bytes));
        self.0.map(|take| take.worth(word))
    }
}

impl Take {
    /// Bits that stand in eight bytes.
    fn of(len: usize, span: Span, place: u32) -> Self {
        // Where the frame has eight bytes, those read are its own.
        let at = (span.start / 8).min(len.saturating_sub(WORD));
        let below = ((at + WORD) * 8 - span.end()) as u32;
        Self {
            at,
            order: Order::First,
            turn: below.wrapping_sub(place),
            mask: bits::placed(bits::mask(span.len), place),
        }
    }

    /// All parts together, where they are the bytes of a number that is sent last byte first.
    fn of_reversed(len: usize, parts: &[Part]) -> Option<Self> {
        let [first, .., last] = parts else {
            return None;
        };
        let at = (last.span.start / 8).min(len.saturating_sub(WORD));
        // Where the least significant bit of a part stands in the eight bytes.
        let stands = |part: &Part| {
            let end = part.span.end() - 1;
            let byte = (end / 8).checked_sub(at).filter(|byte| *byte < WORD)?;
            (part.span.start / 8 == end / 8).then_some(byte * 8 + 7 - end % 8)
        };
        let below = stands(last)?;
        let above = |part: &Part| (part.place - last.place) as usize;
        let fits = |part: &Part| stands(part) == Some(below + above(part));
        parts.iter().all(fits).then(|| Self {
            at,
            order: Order::Last,
            turn: (below as u32).wrapping_sub(last.place),
            mask: bits::placed(bits::mask(above(first) + first.span.len), last.place),
        })
    }

    /// What the part is worth in the frame at the start of `bytes`.
    #[inline]
    fn read(&self, bytes: &[u8]) -> u64 {
        let rest = bytes.get(self.at..).unwrap_or_default();
        self.worth(match self.order {
            Order::First => u64::from_be_bytes(eight(rest)),
            Order::Last => u64::from_le_bytes(eight(rest)),
        })
    }

    /// What the part is worth in its eight bytes, of which the first is the most significant.
    #[inline(always)]
    const fn worth(&self, word: u64) -> u64 {
        bits::turned(word, self.turn) & self.mask
    }

    /// Puts what the part is worth in each frame into `column`.
    #[inline(always)]
    fn column<T>(&self, run: &[u8], len: usize, column: &mut [T], put: impl Fn(&mut T, u64)) {
        match self.order {
            Order::First => self.column_of(run, len, column, put, u64::from_be_bytes),
            Order::Last => self.column_of(run, len, column, put, u64::from_le_bytes),
        }
    }

    #[inline(always)]
    fn column_of<T>(
        &self,
        run: &[u8],
        len: usize,
        column: &mut [T],
        put: impl Fn(&mut T, u64),
        word: impl Fn([u8; WORD]) -> u64,
    ) {
        let mut rest = run.get(self.at..).unwrap_or_default();
        for slot in column {
            put(slot, self.worth(word(eight(rest))));
            rest = rest.get(len..).unwrap_or_default();
        }
    }
}

/// The first eight bytes, or all there are and zeros behind them.
#[inline(always)]
fn eight(bytes: &[u8]) -> [u8; WORD] {
    match bytes.first_chunk() {
        Some(word) => *word,
        None => filled_up(bytes),
    }
}

/// Fewer than eight bytes, and zeros behind them: the last frames of a run may stand so.
#[cold]
fn filled_up(rest: &[u8]) -> [u8; WORD] {
    let mut word = [0; WORD];
    word.iter_mut().zip(rest).for_each(|(to, from)| *to = *from);
    word
}
