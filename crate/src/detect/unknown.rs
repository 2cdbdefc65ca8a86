//! Layouts for frames of a format that nobody has described: where the checksum stands is
//! searched, and where the angle stands is where the frames go on from one another.

use super::{
    Candidate, Verdict,
    motion::Track,
    sample::{Sample, lines},
    weigh::weigh,
};
use crate::{
    bits::{Bits, Span},
    check::{Algorithm, Checksum},
    crc_search::{ByteOrder, FEWEST, Found, LONGEST, Sum, search},
    dump::Dump,
    format::{Format, Medium},
    language::t,
    profile::Profile,
    reading::Values,
    text,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// Most frames that are searched.
const MOST_FRAMES: usize = 200;
/// Most layouts that are proposed.
const MOST: usize = 3;
/// Bits saved by an angle below which there may be none.
const MOVES: i32 = 12;
/// The narrowest angle, in bits.
const NARROWEST: usize = 6;
/// So many frames show where they go on from one another.
const MOVING: usize = 40;

/// The layouts that the checksums of the lines suggest; none for lines without.
pub(super) fn layouts(sample: &Sample) -> Vec<Candidate> {
    let dump = sample.dump(Medium::Bits);
    if sample.counts {
        return Vec::new();
    }
    let Some((len, _)) = sample
        .line_bits()
        .filter(|(len, count)| *count >= FEWEST && *len <= LONGEST)
    else {
        return Vec::new();
    };
    let medium = match sample.is_bits() {
        true => Medium::Bits,
        false => Medium::Bytes,
    };
    let frames: Vec<Bits<'_>> = lines(dump)
        .filter(|line| line.len() == len)
        .take(MOST_FRAMES)
        .collect();
    let found = search(medium, &frames);
    let mut angle_of = None;
    let proposals = found.iter().take(MOST).filter_map(|found| {
        let angle = angle_of.get_or_insert_with(|| angle(&frames, len, medium, found.at));
        let text = written(found, len, *angle)?;
        let profile = Profile::parse([("format", "own"), ("layout", &text)]).ok()?;
        proposed(profile, dump, found, *angle)
    });
    proposals.collect()
}

/// A layout with its evidence, where it reads the frames as the search said.
fn proposed(
    profile: Profile,
    dump: &Dump,
    found: &Found,
    angle: Option<Angle>,
) -> Option<Candidate> {
    let mut candidate = weigh(profile, dump)?;
    let distinct = usize::try_from(candidate.distinct).unwrap_or(0);
    if distinct * 10 < found.frames * 8 {
        return None;
    }
    candidate.verdict = Verdict::Unlikely;
    candidate.untidy = true;
    let mut evidence = Vec::from([
        t("no known format fits; a checksum was found in the frames").to_string(),
        found.to_string(),
    ]);
    evidence.extend(inverted(found));
    evidence.push(text!("by chance 1 in 2^{}", found.evidence));
    evidence.push(match angle {
        Some(_) => t("the angle stands where the frames go on from one another").to_string(),
        None => t("where the angle stands cannot be seen: turn the shaft").to_string(),
    });
    candidate.evidence = evidence;
    Some(candidate)
}

/// Says when the CRC is one of the manuals', sent the other way up.
fn inverted(found: &Found) -> Option<String> {
    let Sum::Crc(crc) = found.sum else {
        return None;
    };
    let known = [
        (Checksum::Crc8x97, "RS485"),
        (Checksum::Crc6Biss, "BiSS-C"),
        (Checksum::Crc16x8005, "ASI1"),
    ];
    let (sum, name) = known.into_iter().find(|(sum, _)| {
        let own = sum.algorithm();
        own.is_some_and(|own| (own.width, own.polynomial) == (crc.width, crc.polynomial))
    })?;
    let own: Algorithm = sum.algorithm()?;
    let plain = own.xorout == 0;
    (own.xorout != crc.xorout).then(|| match plain {
        true => text!("the CRC of {}, but inverted", name),
        false => text!("the CRC of {}, but not inverted", name),
    })
}

/// Where the angle stands, and whether its last byte comes first.
#[derive(Clone, Copy, Debug)]
struct Angle {
    at: Span,
    little_endian: bool,
}

/// The run of bits beside the checksum that saves most when it is taken for a position.
fn angle(frames: &[Bits<'_>], len: usize, medium: Medium, check: Span) -> Option<Angle> {
    let mut best: Option<(i32, Angle)> = None;
    let free = |at: Span| at.end() <= check.start || at.start >= check.end();
    for start in 0..len {
        for width in NARROWEST..=(len - start).min(48) {
            let at = Span::new(start, width);
            if !free(at) {
                continue;
            }
            let whole = medium == Medium::Bytes && start % 8 == 0 && width % 8 == 0 && width > 8;
            for little_endian in [false, true].into_iter().take(if whole { 2 } else { 1 }) {
                let angle = Angle { at, little_endian };
                let gain = saved(frames, angle);
                // Of equals the shortest: what stands above never changes. Ones below do.
                if best
                    .is_none_or(|(most, known)| gain > most || gain == most && width < known.at.len)
                {
                    best = Some((gain, angle));
                }
            }
        }
    }
    best.filter(|(gain, _)| *gain >= MOVES)
        .map(|(_, angle)| angle)
}

fn saved(frames: &[Bits<'_>], angle: Angle) -> i32 {
    let profile = Profile {
        angle_bits: angle.at.len as u32,
        turns_bits: 0,
        ..Format::Own.default_profile()
    };
    let mut track = Track::default();
    for frame in frames.iter().take(MOVING) {
        let read = frame.read(angle.at);
        let bytes = angle.at.len as u32 / 8;
        let value = match angle.little_endian {
            true => crate::bits::above(read.swap_bytes(), u64::BITS - 8 * bytes),
            false => read,
        };
        track.add(
            &profile,
            &Values {
                angle: Some(value),
                ..Values::default()
            },
        );
    }
    track.motion(&profile, u32::MAX).gain
}

/// The layout as a user would write it; `None` for checks that cannot be written so.
fn written(found: &Found, len: usize, angle: Option<Angle>) -> Option<String> {
    if found.order == ByteOrder::Little {
        return None;
    }
    let check = check(found)?;
    let data = angle.unwrap_or(Angle {
        at: Span::new(found.covers.start, found.covers.len.min(64)),
        little_endian: false,
    });
    let little = if data.little_endian { ":le" } else { "" };
    let mut cuts = Vec::from([0, len]);
    for span in [found.at, found.covers, data.at] {
        cuts.extend([span.start, span.end()]);
    }
    cuts.retain(|cut| *cut <= len);
    cuts.sort_unstable();
    cuts.dedup();
    let mut fields: Vec<String> = Vec::new();
    let (mut from, mut to) = (None, None);
    for (index, pair) in cuts.windows(2).enumerate() {
        let &[start, end] = pair else { continue };
        let width = end - start;
        let (name, field) = if found.at.contains(start) {
            (String::new(), check.clone())
        } else if data.at.contains(start) {
            ("angle".to_string(), format!("angle:{width}{little}"))
        } else {
            let name = format!("data {}", index + 1);
            (name.clone(), format!("skip:{width}:name={name}"))
        };
        if found.covers.contains(start) && !found.at.contains(start) {
            from.get_or_insert(name.clone());
            to = Some(name);
        }
        fields.push(field);
    }
    let range = format!(":from={}:to={}", from?, to?);
    let fields: Vec<String> = fields
        .into_iter()
        .map(|field| match field == check {
            true => format!("{field}{range}"),
            false => field,
        })
        .collect();
    Some(format!("Found in this dump;line;{}", fields.join(",")))
}

fn check(found: &Found) -> Option<String> {
    let crc = match found.sum {
        Sum::Crc(crc) => crc,
        Sum::Even => return Some("even:1".to_string()),
        Sum::Odd => return Some("odd:1".to_string()),
        Sum::Added { .. } | Sum::Subtracted { .. } => return None,
    };
    if crc.refin != crc.refout {
        return None;
    }
    let mut text = format!("crc:{}:0x{:x}", crc.width, crc.polynomial);
    if crc.init != 0 {
        text.push_str(&format!(":init=0x{:x}", crc.init));
    }
    if crc.xorout != 0 {
        text.push_str(&format!(":xor=0x{:x}", crc.xorout));
    }
    if crc.refin {
        text.push_str(":reflected");
    }
    Some(text)
}
