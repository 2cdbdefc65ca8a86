//! What of a dump is looked at.

use super::Change;
use crate::{
    bits::{BitString, Bits, Span},
    dump::{Direction, Dump, Line},
    format::Medium,
};
use alloc::collections::BTreeMap;

/// Bytes of a dump that are looked at; of a longer one, three stretches.
const ENOUGH: usize = 256 * 1024;

/// Bytes, and lines, on which changes are tried.
const FRONT: usize = 3_000;
const FRONT_LINES: usize = 40;

/// So many even steps are those of a counter.
const COUNTED: usize = 8;

/// The same text, read as bytes, as bits and as lines of text.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    bytes: Dump,
    bits: Dump,
    text: Dump,
    /// Whether the text is a list of decimal numbers: their line ends were not on the wire.
    pub(super) is_decimal: bool,
    /// Whether the lines are numbers that rise evenly: those of a counter, and of no shaft.
    pub(super) counts: bool,
}

impl Sample {
    pub(super) fn new(bytes: &Dump, bits: &Dump, text: &Dump) -> Self {
        let (bytes, bits, text) = (stretches(bytes), stretches(bits), stretches(text));
        Self {
            is_decimal: !bits.is_bits() && bytes.bytes() != text.bytes(),
            counts: counts(&bits, |number| number) || counts(&bits, u64::swap_bytes),
            bytes,
            bits,
            text,
        }
    }

    pub(super) const fn dump(&self, medium: Medium) -> &Dump {
        match medium {
            Medium::Bytes => &self.bytes,
            Medium::Bits => &self.bits,
            Medium::Text => &self.text,
        }
    }

    /// Whether it was written as strings of 0 and 1: those are clocked words.
    pub(super) fn is_bits(&self) -> bool {
        self.bits.is_bits()
    }

    /// Whether its strings of 0 and 1 are bytes as well.
    pub(super) fn is_octets(&self) -> bool {
        let whole = lines(&self.bits).all(|bits| bits.len().is_multiple_of(8));
        self.is_bits() && whole && self.bits.bytes() == self.bytes.bytes()
    }

    /// Its front, which is enough to see whether a change of the dump makes it readable.
    pub(super) fn front(&self) -> Self {
        let front = |dump: &Dump| {
            let mut left = FRONT;
            mapped(dump, &mut |bits| {
                let bytes = bits.bytes();
                let part = bytes.get(..left).unwrap_or(bytes);
                left = left.saturating_sub(bytes.len().max(FRONT / FRONT_LINES));
                match part.len() == bytes.len() {
                    true => copied(bits),
                    false => BitString::of_bytes(part.into()),
                }
            })
        };
        Self {
            bytes: front(&self.bytes),
            bits: front(&self.bits),
            text: front(&self.text),
            is_decimal: self.is_decimal,
            counts: self.counts,
        }
    }

    /// The same after a change, which a text of decimal numbers cannot undergo.
    pub(super) fn changed(&self, change: Change) -> Self {
        Self {
            bytes: change.apply(&self.bytes),
            bits: change.apply(&self.bits),
            text: self.text.clone(),
            is_decimal: self.is_decimal,
            counts: self.counts,
        }
    }

    /// The length of most lines in bits, and how many have it.
    pub(super) fn line_bits(&self) -> Option<(usize, usize)> {
        let mut lengths = BTreeMap::new();
        for line in lines(&self.bits) {
            *lengths.entry(line.len()).or_insert(0) += 1;
        }
        lengths.into_iter().max_by_key(|(_, count)| *count)
    }
}

/// Whether the lines, as numbers, differ by the same from one to the next.
fn counts(dump: &Dump, order: fn(u64) -> u64) -> bool {
    let short = lines(dump).filter(|line| line.len() <= 64);
    let mut numbers = short.map(|line| order(line.read(Span::new(0, line.len()))));
    let Some(mut before) = numbers.next() else {
        return false;
    };
    let mut first = None;
    let (mut steps, mut even) = (0, 0);
    for number in numbers {
        let step = number.wrapping_sub(before);
        even += usize::from(step != 0 && *first.get_or_insert(step) == step);
        before = number;
        steps += 1;
    }
    // Bytes that count each for itself start again together.
    steps >= COUNTED && even * 32 >= steps * 31
}

/// The bits of every line that is not marked as sent by the host.
pub(super) fn lines(dump: &Dump) -> impl Iterator<Item = Bits<'_>> {
    let received = |line: &Line<'_>| line.direction != Some(Direction::Sent);
    dump.lines().filter(received).map(|line| line.bits)
}

/// A dump with other bits in its lines; lines that come to nothing are left out.
pub(super) fn mapped(dump: &Dump, change: &mut dyn FnMut(Bits<'_>) -> BitString) -> Dump {
    dump.map_lines(&mut |line| change(line.bits))
}

/// The lines of a dump that `keep` names.
pub(super) fn kept(dump: &Dump, keep: &dyn Fn(usize) -> bool) -> Dump {
    let mut index = 0;
    mapped(dump, &mut |bits| {
        index += 1;
        match keep(index - 1) {
            true => copied(bits),
            false => BitString::default(),
        }
    })
}

/// The front, the middle and the end of a dump that is too long to be looked at whole.
fn stretches(dump: &Dump) -> Dump {
    let total = dump.bytes().len();
    if total <= ENOUGH {
        return dump.clone();
    }
    let third = ENOUGH / 3;
    let starts = [0, (total - third) / 2, total - third];
    let wanted = |at: usize| {
        starts
            .iter()
            .any(|start| (*start..start + third).contains(&at))
    };
    let mut at = 0;
    mapped(dump, &mut |bits| {
        let start = at;
        at += bits.bytes().len();
        // A line is kept whole, unless it is a stream by itself.
        if bits.bytes().len() > third {
            let bytes = (start..).zip(bits.bytes());
            let bytes = bytes.filter(|(at, _)| wanted(*at)).map(|(_, byte)| *byte);
            return BitString::of_bytes(bytes.collect());
        }
        match wanted(start) {
            true => copied(bits),
            false => BitString::default(),
        }
    })
}

/// The bits as a string of their own.
pub(super) fn copied(bits: Bits<'_>) -> BitString {
    let mut out = BitString::default();
    (0..bits.len()).for_each(|at| out.push(bits.bit(at)));
    out
}
