//! Sums of bytes modulo 256.

use super::{ByteOrder, ENOUGH, Found, Sum, Weighed, damage_cost, log2, most_common, place_cost};
use crate::{
    bits::{Bits, Span},
    format::Medium,
};
use alloc::vec::Vec;

/// What it costs to say that it is a sum, and of which sign.
const KIND: i32 = 4;
/// Bits of a sum.
const WIDTH: i32 = 8;
/// The shortest data of a sum: that of one byte is a copy.
const SHORTEST: usize = 2;
/// How many different frames count.
const MOST: usize = 64;

/// The sums that the frames of a byte format have.
pub(super) fn search(medium: Medium, frames: &[Bits<'_>]) -> Vec<(i32, Found)> {
    let len = frames.first().map_or(0, |first| first.len() / 8);
    if medium == Medium::Bits {
        return Vec::new();
    }
    let places = || {
        (0..len).flat_map(move |at| {
            let behind = (0..at).map(move |start| (start, at));
            behind.chain([(at + 1, len)]).map(move |data| (at, data))
        })
    };
    let wide = || places().filter(|(_, (start, end))| end - start >= SHORTEST);
    let count = wide().count();
    let mut out = Vec::new();
    for (at, data) in wide() {
        for sign in [Sign::Plus, Sign::Minus] {
            let weighed = weigh(frames, at, data, sign, count);
            out.extend(weighed.filter(|(evidence, _)| *evidence >= ENOUGH));
        }
    }
    out
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Sign {
    Plus,
    Minus,
}

fn weigh(
    frames: &[Bits<'_>],
    at: usize,
    (start, end): (usize, usize),
    sign: Sign,
    places: usize,
) -> Weighed {
    let read = |frame: &Bits<'_>| {
        let bytes = frame.bytes();
        let data = bytes.get(start..end).unwrap_or(&[]);
        let sum = data.iter().fold(0u8, |sum, byte| sum.wrapping_add(*byte));
        let sum = match sign {
            Sign::Plus => sum,
            Sign::Minus => sum.wrapping_neg(),
        };
        let field = bytes.get(at).copied().unwrap_or(0);
        (field.wrapping_sub(sum), sum)
    };
    let all: Vec<(u8, u8)> = frames.iter().map(read).collect();
    let constants: Vec<u8> = all.iter().map(|(constant, _)| *constant).collect();
    let (plus, holds) = most_common(&constants)?;
    let good = || {
        all.iter()
            .zip(frames)
            .filter(|((constant, _), _)| *constant == plus)
    };
    let sums = || good().map(|((_, sum), _)| *sum);
    let mut data: Vec<_> = good()
        .map(|(_, frame)| frame.bytes().get(start..end))
        .collect();
    data.sort_unstable();
    data.dedup();
    let usual = plus == 0 || plus == 0xff && sign == Sign::Minus;
    let constant = if usual { 1 } else { WIDTH };
    let (at, covers) = (
        Span::new(at * 8, 8),
        Span::new(start * 8, (end - start) * 8),
    );
    let len = frames.first()?.len();
    let place = place_cost(at, covers, len, len / 8, places);
    let cost = KIND + constant + place + damage_cost(holds, frames.len())?;
    // Neighbouring numbers have neighbouring sums: only what the sums differ by counts, and a sum
    // that never changes says nothing.
    let spread = sums().max()?.abs_diff(sums().min()?);
    let changing = match spread {
        0 => 0,
        _ => WIDTH.min(1 + log2(spread.into())),
    };
    let evidence = data.len().min(MOST) as i32 * changing - cost;
    let found = Found {
        sum: match sign {
            Sign::Plus => Sum::Added { plus },
            Sign::Minus => Sum::Subtracted { plus },
        },
        at,
        covers,
        order: ByteOrder::Big,
        holds,
        frames: frames.len(),
        evidence: evidence.try_into().unwrap_or(0),
    };
    Some((evidence, found))
}
