//! The checksum of frames of an unknown format.
//!
//! The difference of two frames of equal length has neither start value nor inversion in it, so
//! the generator of a CRC divides every difference, and with them their greatest common divisor
//! over GF(2). For noise that is 1 after two or three frames; where it is not, its factors are
//! weighed: against how many generators, places and bit orders have been tried. Sums of bytes,
//! exclusive or and parity are found as well.
//!
//! ```
//! use encoderscope::{bits::Bits, crc_search::search, format::Medium};
//! let frames = [[0x12, 0x34, 0x92], [0x56, 0x78, 0x65], [0x9a, 0xbc, 0x51], [0x00, 0x01, 0x97]];
//! let frames: Vec<_> = frames.iter().map(|frame| Bits::of_bytes(frame)).collect();
//! let found = search(Medium::Bytes, &frames);
//! assert_eq!(found[0].sum.name(), "CRC-8/0x97");
//! assert_eq!((found[0].covers.len, found[0].at.start), (16, 16));
//! ```

mod parity;
mod sums;
mod trial;

use crate::{
    bits::{Bits, Polynomial, Span},
    check::Algorithm,
    format::Medium,
    language::t,
    say, text,
};
use alloc::{string::String, vec::Vec};
use core::fmt;

/// The longest frame that is searched, in bits.
pub const LONGEST: usize = Polynomial::BITS;

/// The fewest distinct frames that can say anything.
pub const FEWEST: usize = 3;

/// Bits of evidence that a find needs: of so many sets of noise one gives a find, as a power of
/// two.
const ENOUGH: i32 = 12;

/// Bits of evidence within which a rival of a better find is still shown.
const RIVAL: i32 = 6;

/// Of how many frames one may be damaged.
const DAMAGED: usize = 5;

/// The order of the two bytes of a 16-bit CRC.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ByteOrder {
    /// The most significant byte first, or there is one byte only.
    Big,
    /// The least significant byte first.
    Little,
}

/// What a checksum is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sum {
    /// A CRC; frames of one length do not tell the start value from the final inversion, so the
    /// usual ones are taken where they fit, else start 0 and what then remains.
    Crc(Algorithm),
    /// The sum of the bytes modulo 256 and a constant.
    Added {
        /// What is added to the sum.
        plus: u8,
    },
    /// The opposite of the sum of the bytes modulo 256, and a constant: 0 where the sum of all
    /// bytes is 0, 255 where the sum is inverted.
    Subtracted {
        /// What is added to the opposite of the sum.
        plus: u8,
    },
    /// A bit that makes the number of ones even.
    Even,
    /// A bit that makes the number of ones odd.
    Odd,
}

impl Sum {
    /// A short name: the usual one where there is one.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Crc(crc) => match crc.name() {
                Some(name) => t(name).into(),
                None => text!("CRC-{}", crc.width),
            },
            Self::Added { .. } | Self::Subtracted { .. } => t("sum of bytes").into(),
            Self::Even => t("even parity").into(),
            Self::Odd => t("odd parity").into(),
        }
    }
}

impl fmt::Display for Sum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Crc(crc) => write!(f, "{crc}"),
            Self::Added { plus: 0 } => f.write_str(t("sum of bytes modulo 256")),
            Self::Added { plus } => say!(
                f,
                "sum of bytes modulo 256, plus 0x{}",
                format_args!("{plus:02X}")
            ),
            Self::Subtracted { plus: 0 } => f.write_str(t("sum of all bytes modulo 256 is 0")),
            Self::Subtracted { plus: 0xff } => f.write_str(t("inverted sum of bytes modulo 256")),
            Self::Subtracted { plus } => {
                say!(
                    f,
                    "0x{} less the sum of bytes modulo 256",
                    format_args!("{plus:02X}")
                )
            }
            Self::Even | Self::Odd => f.write_str(&self.name()),
        }
    }
}

/// A checksum that frames have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Found {
    /// What it is.
    pub sum: Sum,
    /// Where it stands.
    pub at: Span,
    /// The bits that it covers; where the first of them never change, it may begin later.
    pub covers: Span,
    /// The order of its bytes.
    pub order: ByteOrder,
    /// In how many frames it holds.
    pub holds: usize,
    /// How many distinct frames there are.
    pub frames: usize,
    /// How strong it is: by chance one of 2^`evidence` such searches finds something like it.
    pub evidence: u32,
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        say!(
            f,
            "{} in {} over {}",
            self.sum,
            place(self.at),
            place(self.covers)
        )?;
        if self.order == ByteOrder::Little {
            f.write_str(t(", low byte first"))?;
        }
        say!(f, "; holds in {} of {} frames", self.holds, self.frames)
    }
}

/// A run of bits for people, in bytes where it is made of them.
fn place(span: Span) -> String {
    let whole = span.start.is_multiple_of(8) && span.len.is_multiple_of(8);
    let (first, len) = match whole {
        true => (span.start / 8, span.len / 8),
        false => (span.start, span.len),
    };
    let last = (first + len).saturating_sub(1);
    match (whole, len) {
        (true, 1) => text!("byte {}", first),
        (true, _) => text!("bytes {}…{}", first, last),
        (false, 1) => text!("bit {}", first),
        (false, _) => text!("bits {}…{}", first, last),
    }
}

/// A candidate with its evidence before it is known to be enough.
type Weighed = Option<(i32, Found)>;

/// The checksums that `frames` have, the strongest first; nothing for noise, for fewer than
/// [`FEWEST`] distinct frames of one length and for frames longer than [`LONGEST`].
///
/// Frames of another length than the first are left out. In byte formats a checksum begins at a
/// byte, or ends at one and is not a whole number of bytes; in bit formats it may stand anywhere.
/// A few damaged frames do not hide it.
#[must_use]
pub fn search(medium: Medium, frames: &[Bits<'_>]) -> Vec<Found> {
    let len = frames.first().map_or(0, |first| first.len());
    let mut distinct: Vec<Bits<'_>> = frames
        .iter()
        .copied()
        .filter(|frame| frame.len() == len)
        .collect();
    distinct.sort_by(|a, b| a.bytes().cmp(b.bytes()));
    distinct.dedup_by(|a, b| a.bytes() == b.bytes());
    if distinct.len() < FEWEST || len > LONGEST {
        return Vec::new();
    }
    let mut all = trial::search(medium, &distinct, &distinct);
    if all.is_empty() {
        // One damaged frame hides a CRC from all, but not from those without it.
        let groups = DAMAGED.min(distinct.len() / FEWEST);
        for group in 0..groups {
            let some: Vec<_> = distinct
                .iter()
                .copied()
                .skip(group)
                .step_by(groups)
                .collect();
            all.extend(trial::search(medium, &some, &distinct));
        }
    }
    all.extend(sums::search(medium, &distinct));
    all.extend(parity::search(medium, &distinct));
    ranked(all)
}

/// The best finds, without those that follow from them.
fn ranked(mut all: Vec<(i32, Found)>) -> Vec<Found> {
    all.sort_by_key(|(evidence, _)| core::cmp::Reverse(*evidence));
    let mut kept: Vec<(i32, Found)> = Vec::new();
    for (evidence, found) in all {
        let news = kept.iter().all(|(better, known)| {
            !follows(&found, known) && (!overlap(found.at, known.at) || better - evidence <= RIVAL)
        });
        if news {
            kept.push((evidence, found));
        }
    }
    kept.into_iter().map(|(_, found)| found).collect()
}

/// Whether one find is another way of saying a better one, or a part of what that says.
fn follows(found: &Found, known: &Found) -> bool {
    let all = whole(found) == whole(known);
    let parity = matches!(found.sum, Sum::Even | Sum::Odd);
    let divides = match (found.sum, known.sum) {
        (Sum::Crc(part), Sum::Crc(whole)) => {
            let rest = whole.generator().modulo(part.generator());
            rest.is_zero() && overlap(found.at, known.at)
        }
        // What is left of a sum without its carries.
        _ => false,
    };
    all || divides || parity && overlap(whole(found), whole(known))
}

/// The run of bits from the first to the last that a checksum has to do with.
fn whole(found: &Found) -> Span {
    let start = found.at.start.min(found.covers.start);
    Span::new(start, found.at.end().max(found.covers.end()) - start)
}

fn overlap(a: Span, b: Span) -> bool {
    a.start < b.end() && b.start < a.end()
}

/// The smallest power of two, as its exponent, that is not below `count`.
fn log2(count: usize) -> i32 {
    count.next_power_of_two().ilog2() as i32
}

/// What it costs to say where a checksum stands: little at the end, over all before it; more over
/// a part of that, of which there are `starts`; most at one of `places`.
fn place_cost(at: Span, covers: Span, len: usize, starts: usize, places: usize) -> i32 {
    let ends = at.end() == len && covers.end() <= at.start;
    match covers.start {
        0 if ends => 1,
        _ if ends => 1 + log2(starts),
        _ => 1 + log2(places),
    }
}

/// What it costs to say which of the frames do not hold, unless they are too many.
fn damage_cost(holds: usize, frames: usize) -> Option<i32> {
    let bad = frames - holds;
    (bad * DAMAGED <= frames).then(|| bad as i32 * (1 + log2(frames)))
}

/// The value that most have, and how many.
fn most_common<T: Copy + Ord>(values: &[T]) -> Option<(T, usize)> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable();
    sorted
        .chunk_by(|a, b| a == b)
        .filter_map(|run| Some((*run.first()?, run.len())))
        .max_by_key(|(_, count)| *count)
}

/// How many of the frames are independent of each other beyond the first.
fn rank(words: impl Iterator<Item = Polynomial>) -> i32 {
    let mut basis: Vec<Polynomial> = Vec::new();
    let mut first = None;
    for word in words {
        let first = *first.get_or_insert(word);
        let mut rest = word.plus(first);
        for known in &basis {
            // Adding one of a basis is of use only where it takes the highest power away.
            rest = rest.min(rest.plus(*known));
        }
        if !rest.is_zero() {
            basis.push(rest);
            basis.sort_unstable_by(|a, b| b.cmp(a));
        }
    }
    basis.len() as i32
}
