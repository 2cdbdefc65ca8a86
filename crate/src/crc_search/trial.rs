//! CRCs: every place, bit order and width, left as soon as the frames have no common divisor.

use super::{
    ByteOrder, ENOUGH, Found, Sum, Weighed, damage_cost, log2, most_common, place_cost, rank,
};
use crate::{
    bits::{self, Bits, Polynomial, Span},
    check::Algorithm,
    format::Medium,
};
use alloc::vec::Vec;
use core::ops::RangeInclusive;

/// Widths of CRCs.
const WIDTHS: RangeInclusive<u32> = 3..=16;
/// How many bits of the common divisor may be there by chance.
const CHANCE: u32 = 8;
/// Bits of a byte, and the shortest data of a CRC.
const BYTE: usize = 8;

/// In which order the bits of data and CRC go through the division.
#[derive(Clone, Copy)]
struct Coding {
    refin: bool,
    refout: bool,
    order: ByteOrder,
}

/// As the bits stand in the frame.
const PLAIN: Coding = Coding {
    refin: false,
    refout: false,
    order: ByteOrder::Big,
};

/// One way to read frames as codewords.
#[derive(Clone)]
struct Trial {
    /// The data; without a field of its own, the CRC is the end of it.
    data: Span,
    field: Option<Span>,
    coding: Coding,
}

impl Trial {
    /// The bits of a frame as a polynomial that the generator divides, but for a constant.
    fn word(&self, frame: Bits<'_>) -> Polynomial {
        let word = match self.coding.refin {
            false => Polynomial::default().followed_by(frame, self.data),
            true => (self.data.start..self.data.end()).step_by(BYTE).fold(
                Polynomial::default(),
                |word, at| {
                    let byte = frame.read(Span::new(at, BYTE));
                    word.followed(bits::reversed(byte, 8), 8)
                },
            ),
        };
        match self.field {
            Some(field) => word.followed(self.field_value(field, frame), field.len as u32),
            None => word,
        }
    }

    fn field_value(&self, field: Span, frame: Bits<'_>) -> u64 {
        let value = frame.read(field);
        let value = match self.coding.order {
            ByteOrder::Big => value,
            ByteOrder::Little => u64::from((value as u16).swap_bytes()),
        };
        match self.coding.refout {
            true => bits::reversed(value, field.len as u32),
            false => value,
        }
    }

    /// Where a CRC of `width` bits stands, and what it covers.
    fn spans(&self, width: usize) -> (Span, Span) {
        match self.field {
            Some(field) => (field, self.data),
            None => {
                let covers = Span::new(self.data.start, self.data.len.saturating_sub(width));
                (Span::new(covers.end(), width), covers)
            }
        }
    }

    fn widths(&self) -> RangeInclusive<u32> {
        match self.field {
            Some(field) => field.len as u32..=field.len as u32,
            None => WIDTHS,
        }
    }
}

/// Finds in `some` frames what `all` of them are then weighed by.
pub(super) fn search(medium: Medium, some: &[Bits<'_>], all: &[Bits<'_>]) -> Vec<(i32, Found)> {
    let Some((first, others)) = some.split_first() else {
        return Vec::new();
    };
    let trials = trials(medium, first.len());
    let places = trials.iter().filter(|trial| trial.field.is_none()).count();
    let mut out = Vec::new();
    for trial in &trials {
        let own = trial.word(*first);
        let differences = others.iter().map(|other| trial.word(*other).plus(own));
        let Some(divisor) = common_divisor(differences, *trial.widths().start()) else {
            continue;
        };
        let mut tried = Vec::new();
        generators(divisor, trial.widths(), &mut tried);
        let weighed = |generator: &Polynomial| weigh(medium, trial, *generator, all, places);
        out.extend(
            tried
                .iter()
                .filter_map(weighed)
                .filter(|(evidence, _)| *evidence >= ENOUGH),
        );
    }
    out
}

/// The common divisor of the differences, without powers of x; nothing where it is too small.
fn common_divisor(differences: impl Iterator<Item = Polynomial>, least: u32) -> Option<Polynomial> {
    let mut divisor = Polynomial::default();
    for difference in differences {
        divisor = divisor.gcd(difference.without_x());
        if divisor.degree().is_some_and(|degree| degree < least) {
            return None;
        }
    }
    (!divisor.is_zero()).then_some(divisor)
}

/// The factors of a divisor that a generator can be.
///
/// Few frames leave a few bits too many by chance, or many where the data hardly changes: then
/// generators with a name are tried alone.
fn generators(divisor: Polynomial, widths: RangeInclusive<u32>, out: &mut Vec<Polynomial>) {
    let degree = divisor.degree().unwrap_or(0);
    for width in widths {
        let Some(beyond) = degree.checked_sub(width) else {
            continue;
        };
        let from = out.len();
        if beyond <= CHANCE {
            for cofactor in (1..=bits::mask(beyond as usize + 1)).step_by(2) {
                let cofactor = Polynomial::from(cofactor);
                let exact = divisor.divided(cofactor).filter(|(_, rest)| rest.is_zero());
                if cofactor.degree() == Some(beyond)
                    && let Some((factor, _)) = exact
                {
                    out.push(factor);
                }
            }
            continue;
        }
        let named = Algorithm::KNOWN
            .iter()
            .filter(|(_, crc)| crc.width == width);
        for (_, crc) in named {
            let generator = crc.generator();
            let known = out.iter().skip(from).any(|other| *other == generator);
            if !known && divisor.modulo(generator).is_zero() {
                out.push(generator);
            }
        }
    }
}

/// How much the frames speak for a generator.
fn weigh(
    medium: Medium,
    trial: &Trial,
    generator: Polynomial,
    frames: &[Bits<'_>],
    places: usize,
) -> Weighed {
    let width = generator.degree()?;
    let len = frames.first()?.len();
    let (at, covers) = trial.spans(width as usize);
    if covers.len < BYTE.max(width as usize) {
        return None;
    }
    let words: Vec<Polynomial> = frames.iter().map(|frame| trial.word(*frame)).collect();
    let rests: Vec<u64> = words
        .iter()
        .map(|word| word.modulo(generator).low())
        .collect();
    let (constant, holds) = most_common(&rests)?;
    let good = || {
        let all = frames.iter().zip(&words).zip(&rests);
        all.filter(|(_, rest)| **rest == constant)
            .map(|(pair, _)| pair)
    };
    // Bits that never change are known without a CRC.
    let first = good().next()?.0.read(at);
    let changing = good()
        .fold(0, |seen, (frame, _)| seen | (frame.read(at) ^ first))
        .count_ones() as i32;
    let independent = rank(good().map(|(_, word)| *word));
    let (algorithm, told) = solved(trial, generator, constant, covers);
    let coded = match trial.field {
        Some(_) => 2,
        None => 0,
    };
    let starts = len / step(medium);
    let place = place_cost(at, covers, len, starts, places);
    let cost = told + coded + place + damage_cost(holds, frames.len())?;
    let still = (width as i32 - changing).min(changing);
    let evidence = (independent + 1) * changing + still - cost;
    let found = Found {
        sum: Sum::Crc(algorithm),
        at,
        covers,
        order: trial.coding.order,
        holds,
        frames: frames.len(),
        evidence: evidence.try_into().unwrap_or(0),
    };
    Some((evidence, found))
}

/// The parameters that give frames of this length the constant rest, and what it costs to name
/// them.
fn solved(trial: &Trial, generator: Polynomial, constant: u64, covers: Span) -> (Algorithm, i32) {
    let width = generator.degree().unwrap_or(0);
    let all = bits::mask(width as usize);
    let plain = Algorithm {
        width,
        polynomial: generator.low() & all,
        init: 0,
        refin: trial.coding.refin,
        refout: trial.coding.refout,
        xorout: 0,
    };
    let rest = |crc: &Algorithm| {
        let start = Polynomial::from(crc.init).raised(covers.len as u32);
        let out = match crc.refout {
            true => bits::reversed(crc.xorout, width),
            false => crc.xorout,
        };
        start.modulo(generator).low() ^ out
    };
    let named = || Algorithm::KNOWN.iter().map(|(_, crc)| *crc);
    let same = |crc: &Algorithm| {
        (crc.width, crc.polynomial, crc.refin, crc.refout)
            == (width, plain.polynomial, plain.refin, plain.refout)
    };
    let names = log2(Algorithm::KNOWN.len());
    let fits = |crc: &Algorithm| same(crc) && rest(crc) == constant;
    if let Some(crc) = named().find(fits) {
        return (crc, names);
    }
    let generator = match named().any(|crc| same(&crc)) {
        true => names,
        // The width, the generator but for its ends, and the two reflections.
        false => 4 + width as i32 - 1 + 2,
    };
    let usual = [(0, 0), (all, 0), (0, all), (all, all)];
    let usual = usual.map(|(init, xorout)| Algorithm {
        init,
        xorout,
        ..plain
    });
    match usual.into_iter().find(|crc| rest(crc) == constant) {
        Some(crc) => (crc, generator + log2(usual.len())),
        // An unusual constant is the last of the possibilities.
        None => {
            let xorout = match plain.refout {
                true => bits::reversed(constant, width),
                false => constant,
            };
            (
                Algorithm { xorout, ..plain },
                generator + width as i32 + log2(usual.len()),
            )
        }
    }
}

/// Between the places where data and CRCs begin.
const fn step(medium: Medium) -> usize {
    match medium {
        Medium::Bits => 1,
        Medium::Bytes | Medium::Text => BYTE,
    }
}

/// All ways to read frames of `len` bits.
fn trials(medium: Medium, len: usize) -> Vec<Trial> {
    let mut out = Vec::new();
    let step = step(medium);
    for end in (step..=len).step_by(step) {
        for start in (0..end).step_by(step) {
            out.push(Trial {
                data: Span::new(start, end - start),
                field: None,
                coding: PLAIN,
            });
        }
    }
    match medium {
        Medium::Bits => {
            for width in WIDTHS
                .map(|width| width as usize)
                .filter(|width| *width < len)
            {
                out.push(Trial {
                    data: Span::new(width, len - width),
                    field: Some(Span::new(0, width)),
                    coding: PLAIN,
                });
            }
        }
        Medium::Bytes | Medium::Text => byte_trials(len, &mut out),
    }
    out
}

/// A CRC in bytes of its own, behind the data or in front of it.
fn byte_trials(len: usize, out: &mut Vec<Trial>) {
    for width in WIDTHS.map(|width| width as usize) {
        let room = width.next_multiple_of(BYTE);
        for at in (0..(len + 1).saturating_sub(room)).step_by(BYTE) {
            let field = Span::new(at + room - width, width);
            let behind = (0..at)
                .step_by(BYTE)
                .map(|start| Span::new(start, at - start));
            let before = Span::new(at + room, len - at - room);
            for data in behind.chain([before]).filter(|data| data.len >= BYTE) {
                // Whole bytes as they stand, behind their data, are a trial without a field.
                let joined = room == width && data.end() == at;
                coded(data, field, joined, out);
            }
        }
    }
}

fn coded(data: Span, field: Span, joined: bool, out: &mut Vec<Trial>) {
    let orders: &[ByteOrder] = match field.len {
        16 => &[ByteOrder::Big, ByteOrder::Little],
        _ => &[ByteOrder::Big],
    };
    for order in orders {
        for (refin, refout) in [(false, false), (true, true), (false, true), (true, false)] {
            let plain = !refin && !refout && *order == ByteOrder::Big;
            if !(plain && joined) {
                out.push(Trial {
                    data,
                    field: Some(field),
                    coding: Coding {
                        refin,
                        refout,
                        order: *order,
                    },
                });
            }
        }
    }
}
