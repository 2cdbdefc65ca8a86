//! Judging frames by tables.
//!
//! Every check starts from a constant and adds up, bit by bit, so that what is wrong with a
//! frame is the sum of what is wrong with its bytes: a table of 256 entries for each of them
//! replaces the checks. The tables are computed from the checks themselves.

use super::{Resolved, WORD, Words};
use crate::{
    bits::{self, BitString},
    decode::Follows,
    layout::Field,
};
use alloc::{vec, vec::Vec};

/// A frame has tables for its bytes, and as many more as make a multiple of this: loops of few
/// different lengths are unrolled.
const GROUP: usize = 4;

/// What a frame must be, and what its bytes add to its checks.
#[derive(Clone, Debug)]
pub(super) struct Sieve {
    /// Bytes of the frame.
    len: usize,
    /// The bits of the words that are of the frame.
    own: Words,
    /// Fixed bits.
    mask: Words,
    value: Words,
    /// What the checks of an all-zero frame come to.
    none: u16,
    /// For each byte.
    syndromes: Vec<[u16; 256]>,
}

impl Sieve {
    pub(super) fn of(layout: &Resolved) -> Self {
        let len = layout.bytes();
        let mut mask = BitString::zeros(layout.len);
        let mut value = BitString::zeros(layout.len);
        for field in layout.fields() {
            let all = bits::mask(field.width as usize);
            let (fixed, to) = match field.row.constant {
                Some(constant) => (all, constant),
                None => (field.row.zeros, 0),
            };
            layout.write(field, &mut mask, fixed);
            layout.write(field, &mut value, to & fixed);
        }
        let none = syndrome(layout, &BitString::zeros(layout.len));
        let mut syndromes = vec![[0; 256]; len.next_multiple_of(GROUP)];
        for (byte, table) in syndromes.iter_mut().enumerate() {
            let adds: [u16; 8] = core::array::from_fn(|place| {
                let mut one = BitString::zeros(layout.len);
                one.flip(byte * 8 + 7 - place);
                syndrome(layout, &one) ^ none
            });
            for code in 1..table.len() {
                // What a code adds is what it adds without its lowest bit, and that bit.
                let (rest, lowest) = (code & (code - 1), code.trailing_zeros());
                table[code] = table[rest] ^ adds[lowest as usize];
            }
        }
        let words = |bits: &BitString| Words::of(bits.as_bits().bytes());
        Self {
            len,
            own: Words::of(&vec![u8::MAX; len]),
            mask: words(&mask),
            value: words(&value),
            none,
            syndromes,
        }
    }

    /// Whether every check holds.
    #[inline(always)]
    pub(super) fn holds(&self, words: Words) -> bool {
        match self.syndromes.len() {
            4 => self.holds_in::<4>(words),
            8 => self.holds_in::<8>(words),
            12 => self.holds_in::<12>(words),
            _ => self.holds_in::<16>(words),
        }
    }

    #[inline(always)]
    fn holds_in<const N: usize>(&self, words: Words) -> bool {
        words.agrees::<N>(self.value, self.mask) && self.sum::<N>(words) == 0
    }

    /// What is wrong with the checks of a frame of up to `N` bytes.
    #[inline(always)]
    fn sum<const N: usize>(&self, words: Words) -> u16 {
        let tables = self.syndromes.first_chunk::<N>();
        let (near, far) = tables.map_or((&[][..], &[][..]), |all| all.split_at(N.min(WORD)));
        let mut sum = self.none;
        for (byte, table) in words.head.to_le_bytes().iter().zip(near) {
            sum ^= table[usize::from(*byte)];
        }
        if N > WORD {
            // The tail overlaps the head.
            let behind = bits::above(words.tail, ((2 * WORD - self.len) * 8) as u32);
            for (byte, table) in behind.to_le_bytes().iter().zip(far) {
                sum ^= table[usize::from(*byte)];
            }
        }
        sum
    }

    /// See [`Resolved::run`].
    pub(super) fn run(
        &self,
        bytes: &[u8],
        zero_led: bool,
        repeats: bool,
        follows: Follows,
    ) -> (usize, bool) {
        match self.syndromes.len() {
            4 => self.run_of::<4>(bytes, zero_led, repeats, follows),
            8 => self.run_of::<8>(bytes, zero_led, repeats, follows),
            12 => self.run_of::<12>(bytes, zero_led, repeats, follows),
            _ => self.run_of::<16>(bytes, zero_led, repeats, follows),
        }
    }

    #[inline(always)]
    fn run_of<const N: usize>(
        &self,
        bytes: &[u8],
        zero_led: bool,
        mut repeats: bool,
        follows: Follows,
    ) -> (usize, bool) {
        let mut frames = 1;
        let mut chunks = bytes.windows(2 * WORD).step_by(self.len);
        let Some(first) = chunks.next().and_then(<[u8]>::first_chunk) else {
            return (frames, repeats);
        };
        let mut previous = Words::in_chunk(first, self.len);
        for next in chunks {
            let Some(next) = next.first_chunk() else {
                break;
            };
            let now = Words::in_chunk(next, self.len);
            let late = zero_led && next.get(self.len - 1) == Some(&0);
            let same = now.agrees::<N>(previous, self.own);
            let breaks = repeats && !same;
            if late || breaks || !self.holds_in::<N>(now) || !follows.holds(now.head) {
                break;
            }
            (repeats, previous) = (same, now);
            frames += 1;
        }
        (frames, repeats)
    }
}

/// What the binding checks of a frame give against what they should, side by side.
fn syndrome(layout: &Resolved, frame: &BitString) -> u16 {
    let mut place = 0;
    let mut sum = 0;
    for field in layout.fields().filter(|field| Field::is_binding(field)) {
        let bits = frame.as_bits();
        if let Some(expected) = layout.expected(field, bits) {
            sum |= bits::placed(expected ^ layout.read(field, bits), place);
            place += field.width;
        }
    }
    bits::low_word(sum)
}
