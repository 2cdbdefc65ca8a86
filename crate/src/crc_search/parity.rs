//! Parity bits.

use super::{ByteOrder, ENOUGH, Found, Sum, Weighed, damage_cost, place_cost, rank};
use crate::{
    bits::{Bits, Polynomial, Span},
    format::Medium,
};
use alloc::vec::Vec;

/// What it costs to say that it is a parity, and of which sense.
const KIND: i32 = 4;
/// The shortest data of a parity: that of fewer bits is a copy.
const SHORTEST: usize = 3;

/// The parity bits that the frames have.
pub(super) fn search(medium: Medium, frames: &[Bits<'_>]) -> Vec<(i32, Found)> {
    let len = frames.first().map_or(0, |first| first.len());
    let step = match medium {
        Medium::Bits => 1,
        Medium::Bytes | Medium::Text => 8,
    };
    let sums: Vec<Vec<bool>> = frames.iter().map(|frame| running(*frame)).collect();
    let places = || {
        (0..len).flat_map(move |at| {
            let behind = (0..at)
                .step_by(step)
                .map(move |start| Span::new(start, at - start));
            let before = Span::new(at + 1, len - at - 1);
            behind.chain([before]).map(move |data| (at, data))
        })
    };
    let wide = || places().filter(|(_, data)| data.len >= SHORTEST);
    let count = wide().count();
    let mut out = Vec::new();
    for (at, data) in wide() {
        let weighed = weigh(frames, &sums, at, data, count);
        out.extend(weighed.filter(|(evidence, _)| *evidence >= ENOUGH));
    }
    out
}

/// Whether the number of ones in front of each bit, and of all bits, is odd.
fn running(frame: Bits<'_>) -> Vec<bool> {
    let mut odd = false;
    let mut out = alloc::vec![odd];
    for at in 0..frame.len() {
        odd ^= frame.bit(at);
        out.push(odd);
    }
    out
}

fn weigh(
    frames: &[Bits<'_>],
    sums: &[Vec<bool>],
    at: usize,
    covers: Span,
    places: usize,
) -> Weighed {
    let odd = |sums: &Vec<bool>| {
        let sum = |from: usize, to: usize| sums.get(from) != sums.get(to);
        sum(covers.start, covers.end()) != sum(at, at + 1)
    };
    let ones = sums.iter().filter(|sums| odd(sums)).count();
    let (sense, holds) = match ones * 2 > frames.len() {
        true => (true, ones),
        false => (false, frames.len() - ones),
    };
    let damage = damage_cost(holds, frames.len())?;
    let good = || {
        let all = frames.iter().zip(sums);
        all.filter(|(_, sums)| odd(sums) == sense)
            .map(|(frame, _)| *frame)
    };
    let first = good().next()?.bit(at);
    if good().all(|frame| frame.bit(at) == first) {
        return None;
    }
    let own = Span::new(at, 1);
    let len = frames.first()?.len();
    let cost = KIND + damage + place_cost(own, covers, len, len, places);
    let independent = rank(good().map(|frame| Polynomial::default().followed_by(frame, covers)));
    let evidence = independent - cost;
    let found = Found {
        sum: if sense { Sum::Odd } else { Sum::Even },
        at: own,
        covers,
        order: ByteOrder::Big,
        holds,
        frames: frames.len(),
        evidence: evidence.try_into().unwrap_or(0),
    };
    Some((evidence, found))
}
