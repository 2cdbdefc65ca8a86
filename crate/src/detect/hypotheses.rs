//! Every profile that is tried, from what the dump is, and how unusual each is.

use super::sample::{Sample, lines};
use crate::{
    format::{Format, Link, Medium, own, rs485::Command},
    profile::{Align, Code, Justify, Parity, Profile},
};
use alloc::vec::Vec;

/// What an encoder that no manual describes must make up for, in bits.
const UNUSUAL: i32 = 10;
/// Bits beside the data of a word that a capture may hold.
const SPARE: u32 = 7;
/// A bit that more lines than one in so many have is meant to be there.
const RARE: usize = 6;

/// How unusual a profile is, in bits: an encoder of the manuals is expected sooner.
pub(super) const fn unusual(profile: &Profile) -> i32 {
    let native = profile.angle_bits >= 16 && profile.angle_bits <= 24;
    let counted = matches!(profile.turns_bits, 0 | 16);
    match profile.format {
        Format::Ssi | Format::Rs485 | Format::Bus | Format::Period => {
            if native && counted {
                0
            } else {
                UNUSUAL
            }
        }
        Format::BissC => match (native && counted, profile.status_bits) {
            (true, 6) => 0,
            (true, 0) if profile.turns_bits == 0 => 3,
            (_, 0) if profile.turns_bits == 0 && profile.angle_bits <= 36 => 4,
            (true, 0) => 5,
            _ => UNUSUAL,
        },
        Format::T485 => {
            if matches!(profile.angle_bits, 17 | 23) {
                0
            } else {
                UNUSUAL
            }
        }
        Format::Ssi7 => 1,
        Format::SsiTree => {
            let parity = if matches!(profile.parity, Parity::None) {
                0
            } else {
                1
            };
            // A number at the end of a longer word.
            let sum = profile.turns_bits + profile.angle_bits + parity as u32;
            let right = match profile.align {
                Align::Right if sum < profile.frame_bits => UNUSUAL / 2,
                Align::Right => 1,
                Align::Tree => 0,
            };
            let turns = match profile.turns_bits {
                0 | 12 => 0,
                _ => UNUSUAL,
            };
            let angle = match profile.angle_bits {
                13 => 0,
                12 => 1,
                _ => UNUSUAL,
            };
            let long = match (profile.turns_bits, profile.frame_bits - parity as u32) {
                (0, 12 | 13) | (1.., 24 | 25) => 0,
                _ => UNUSUAL,
            };
            1 + parity + right + long + if turns > angle { turns } else { angle }
        }
        Format::Own => 5,
        _ => 0,
    }
}

/// All that a dump may be, those of the manuals first.
pub(super) fn of(sample: &Sample) -> Vec<Profile> {
    let mut all = Vec::new();
    if !sample.is_bits() || sample.is_octets() {
        bytes(sample, &mut all);
    }
    if let Some((len, _)) = sample.line_bits() {
        let len = u32::try_from(len).unwrap_or(u32::MAX);
        // A line of a hundred bytes is a stream.
        if len <= LONGEST {
            words(sample, len, &mut all);
        }
    }
    shipped(sample, &mut all);
    all.extend(
        Format::ALL
            .iter()
            .flat_map(|format| format.manual().guesses),
    );
    all.retain(|profile| profile.check().is_ok());
    all
}

/// The longest line that may be one clocked word, or the same word a few times.
const LONGEST: u32 = 192;

fn native() -> impl Iterator<Item = (u32, u32)> {
    (16..=24).flat_map(|angle| [0, 16].map(|turns| (angle, turns)))
}

fn bytes(sample: &Sample, all: &mut Vec<Profile>) {
    let text = [(Format::Asi4, 14)];
    let binary = [(Format::Asi1, 14), (Format::Asi1, 22)];
    let decimal = sample.is_decimal;
    for (format, angle_bits) in text.into_iter().chain(binary) {
        if decimal == (format == Format::Asi4) || format == Format::Asi4 {
            all.push(Profile {
                angle_bits,
                ..format.default_profile()
            });
        }
    }
    for angle_bits in [17, 23].into_iter().chain(16..=24) {
        let profile = Profile {
            angle_bits,
            ..Format::T485.default_profile()
        };
        if !all.contains(&profile) {
            all.push(profile);
        }
    }
    for (angle_bits, turns_bits) in native() {
        for command in Command::ALL.iter().filter(|one| !one.changes_encoder()) {
            all.push(Profile {
                angle_bits,
                turns_bits,
                command: *command,
                ..Format::Rs485.default_profile()
            });
        }
    }
    for format in [Format::Bus, Format::Period] {
        all.extend(native().map(|(angle_bits, turns_bits)| Profile {
            angle_bits,
            turns_bits,
            ..format.default_profile()
        }));
    }
}

/// Words that are clocked out, in lines of `len` bits.
fn words(sample: &Sample, len: u32, all: &mut Vec<Profile>) {
    let exact = sample.is_bits() && !len.is_multiple_of(8);
    // Strings have the length that was clocked; bytes are filled up.
    let least = if exact {
        len.saturating_sub(2)
    } else {
        len.saturating_sub(SPARE)
    };
    let sides: &[Justify] = if exact {
        &[Justify::Right]
    } else {
        &[Justify::Right, Justify::Left]
    };
    let side = |profile: Profile| {
        let full = width(&profile) == Some(len);
        sides
            .iter()
            .take(if full { 1 } else { 2 })
            .map(move |justify| Profile {
                justify: *justify,
                ..profile
            })
    };
    for (angle_bits, turns_bits) in (8..=32).flat_map(|angle| [0, 16].map(|turns| (angle, turns))) {
        let profile = Profile {
            angle_bits,
            turns_bits,
            ..Format::Ssi.default_profile()
        };
        if width(&profile).is_some_and(|width| (least..=len).contains(&width)) {
            all.extend(side(profile));
        }
    }
    for (angle_bits, frame_bits) in [(14, 30), (22, 30), (14, 24), (22, 24)] {
        if (least..=len).contains(&frame_bits) {
            all.extend(side(Profile {
                angle_bits,
                frame_bits,
                ..Format::Ssi7.default_profile()
            }));
        }
    }
    biss(len, all);
    tree(sample, len, least, &side, all);
}

/// Bits of a word that has no preamble; `None` for other formats.
pub(super) fn width(profile: &Profile) -> Option<u32> {
    match profile.format {
        Format::Ssi => Some(profile.turns_bits + profile.angle_bits + 8),
        Format::Ssi7 | Format::SsiTree => Some(profile.frame_bits),
        _ => None,
    }
}

/// BiSS-C: the data of any width, behind a preamble or without.
fn biss(len: u32, all: &mut Vec<Profile>) {
    let widths = native().chain((8..=64).flat_map(|angle| [0, 12, 16].map(|turns| (angle, turns))));
    let first = all.len();
    for (angle_bits, turns_bits) in widths {
        for status_bits in [6, 0, 8] {
            let total = angle_bits + turns_bits + status_bits + 8;
            let usual = angle_bits <= 36 || turns_bits + status_bits == 0;
            if !usual || total > len || total + 80 < len {
                continue;
            }
            let profile = Profile {
                angle_bits,
                turns_bits,
                status_bits,
                ..Format::BissC.default_profile()
            };
            if !all.iter().skip(first).any(|known| *known == profile) {
                all.push(profile);
            }
        }
    }
}

/// The bits of the lines that are set in more than a few of them, from the front or the end.
fn set_bits(sample: &Sample, len: u32) -> Vec<bool> {
    let mut counts: Vec<usize> = alloc::vec![0; len as usize];
    let mut total = 0;
    for line in lines(sample.dump(Medium::Bits)).filter(|line| line.len() == len as usize) {
        total += 1;
        for (at, count) in counts.iter_mut().enumerate() {
            *count += usize::from(line.bit(at));
        }
    }
    counts.iter().map(|count| count * RARE > total).collect()
}

/// The classic SSI word: where its zeros stand tells how wide it can be.
fn tree<I: Iterator<Item = Profile>>(
    sample: &Sample,
    len: u32,
    least: u32,
    side: &dyn Fn(Profile) -> I,
    all: &mut Vec<Profile>,
) {
    let set = set_bits(sample, len);
    let first = set.iter().position(|set| *set).unwrap_or(0) as u32;
    let last = set.iter().rposition(|set| *set).unwrap_or(0) as u32 + 1;
    let lengths = (least.max(8)..=len.min(40)).rev();
    let singles = [13, 25, 24, 12].into_iter().filter(|word| len > *word + 8);
    for frame_bits in lengths.chain(singles) {
        let usual = matches!(frame_bits, 12 | 13 | 24 | 25) || frame_bits == len;
        if !usual && frame_bits + 1 != len {
            continue;
        }
        for parity in [Parity::None, Parity::Even, Parity::Odd] {
            let data = frame_bits - u32::from(parity != Parity::None);
            let number = frame_bits.min(last).saturating_sub(first.min(last));
            let right = splits(data, number.min(data));
            let tree = trees(data, first, last.min(data));
            let right = right.into_iter().map(|split| (Align::Right, split));
            let tree = tree.into_iter().map(|split| (Align::Tree, split));
            for (align, (turns_bits, angle_bits)) in tree.chain(right) {
                for code in [Code::Gray, Code::Binary] {
                    all.extend(side(Profile {
                        angle_bits,
                        turns_bits,
                        code,
                        align,
                        parity,
                        frame_bits,
                        ..Format::SsiTree.default_profile()
                    }));
                }
            }
        }
    }
}

/// Turns and angle of a number at the end of the word, of at least `number` bits.
fn splits(data: u32, number: u32) -> Vec<(u32, u32)> {
    let mut splits = Vec::from([(12, 13), (0, 13), (12, 12), (0, 12), (16, 13)]);
    splits.extend([
        (0, data),
        (data.saturating_sub(13), 13),
        (data.saturating_sub(12), 12),
        (0, number),
    ]);
    distinct(splits, |(turns, angle)| {
        angle >= 6 && (number..=data).contains(&(turns + angle)) && turns <= 16 && angle <= 18
    })
}

/// Turns and angle of a fir-tree whose ones begin at `first` and end before `last`.
fn trees(data: u32, first: u32, last: u32) -> Vec<(u32, u32)> {
    let counted = [12, 12u32.saturating_sub(first)];
    let angle = last.saturating_sub(12);
    let mut trees: Vec<(u32, u32)> = counted
        .into_iter()
        .filter(|turns| *turns > 0)
        .flat_map(|turns| [(turns, 13), (turns, 12), (turns, angle)])
        .collect();
    trees.extend([(0, 13), (0, 12), (0, last)]);
    distinct(trees, |(turns, angle)| {
        let columns = if turns > 0 { 12 + angle } else { angle };
        (6..=18).contains(&angle) && columns <= data && columns >= last
    })
}

fn distinct(all: Vec<(u32, u32)>, fits: impl Fn((u32, u32)) -> bool) -> Vec<(u32, u32)> {
    let mut kept = Vec::new();
    for split in all {
        if fits(split) && !kept.contains(&split) {
            kept.push(split);
        }
    }
    kept
}

/// The layouts of other makers that come with the program.
fn shipped(sample: &Sample, all: &mut Vec<Profile>) {
    for shipped in own::SHIPPED {
        let layout = Profile::parse([("format", "own"), ("layout", shipped.name)]);
        let Ok(profile) = layout else { continue };
        if profile.link() == Link::Clocked || !sample.is_bits() {
            all.push(profile);
        }
    }
}
