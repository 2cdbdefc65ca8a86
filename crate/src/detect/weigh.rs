//! How well one profile explains a dump, in bits.

use super::{
    Candidate, LIKELY, Verdict,
    counted::Counted,
    hypotheses::{unusual, width},
    motion::Motion,
    sample::{kept, lines},
};
use crate::{
    bits::Bits,
    decode::{Decoded, Decoder},
    dump::Dump,
    format::{Format, Medium},
    framing::Why,
    language::t,
    profile::{Code, Profile},
    text,
};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};

/// Less than this is chance.
pub(super) const CHANCE: i32 = 3;
/// Against: a frame that fails, a byte of no frame, a width whose top bit was never seen set.
const FAILS: i32 = 6;
const SKIPPED: i32 = 1;
const UNUSED_BIT: i32 = 1;
const UNUSED_STILL: i32 = 2;
/// For: an identity that names the width, a preamble that is the profile's own.
const NAMED: i32 = 12;
const PREAMBLE: i32 = 4;
const STARTED: i32 = 3;
/// For: the only width that an encoder of the manuals has.
const OWN_WIDTH: i32 = 4;
/// For: the requests that such replies follow, and the pace that the manual gives.
const ASKED: i32 = 8;
/// Against: a bit of the angle that never changes, for each position, and so many at most.
const STUCK_MOST: u32 = 8;
/// Against: a bit beside the position that comes and goes, for each time, and so many at most.
const FLICKERS: i32 = 2;
const FLICKERS_MOST: i32 = 30;
/// Against: an error and a warning at once in every frame; another address.
const BOTH: i32 = 6;
const ADDRESS: i32 = 4;
/// For: lines of text, which no other stream is.
pub(super) const LINES: i32 = 10;
/// For a temperature that a chip may have, in tenths of a degree; against any other.
const LIKELY_HEAT: i32 = 3;
const ROOM: core::ops::RangeInclusive<i32> = 50..=900;
/// What is left of the evidence where bits beside the position come and go without a check.
const UNTIDY: i32 = 8;
/// Against: the bytes of the angle in the wrong order.
const SWAPPED: i32 = 12;
/// Against: a counter that is no shaft.
const COUNTER: i32 = 400;
/// Against: bits beside the word that nobody would have clocked, or that fill up its bytes.
const CLOCKED: i32 = 8;
const FILLED: i32 = 1;
/// What a word of the right length is worth when nothing else is known.
const STEADY: i32 = 6;
/// Words that are hardly ever anything else, and how few of them tell nothing.
const USUAL: i32 = 1;
pub(super) const FEW: i32 = 6;
/// A bit that changes in fewer than one of so many lines changes by damage.
const DAMAGE: usize = 25;
/// Lines that are looked at before all are.
const FIRST: usize = 6;
/// Bytes that are looked at before all are.
const FRONT: usize = 4096;

/// Tries one profile; `None` where no frame passes.
pub(crate) fn weigh(profile: Profile, dump: &Dump) -> Option<Candidate> {
    let decoder = Decoder::new(profile).ok()?;
    if !is_promising(&decoder, dump) {
        return None;
    }
    let mut counted = Counted::default();
    let mut unsure = Counted::default();
    let mut others = 0;
    let summary = decoder.dump(dump, &mut |decoded| match decoded {
        // The dump says that another command was asked.
        Decoded::Frame(frame) if frame.layout.shape.profile.command != profile.command => {
            others += 1;
        }
        Decoded::Frame(frame) if frame.ok() => counted.add(&profile, &frame),
        Decoded::Frame(frame) if frame.layout.holds(frame.bits) => unsure.add(&profile, &frame),
        Decoded::Skip {
            why: Why::Request,
            bits,
            ..
        } => {
            counted.requests += bits.bytes().len() as u64;
        }
        _ => {}
    });
    // A still shaft does not tell where its frames begin, but they are of its format.
    let placed = counted.good >= unsure.good;
    let mut unsettled = unsure.good;
    if !placed {
        unsure.requests = counted.requests;
        unsettled = counted.good;
        counted = unsure;
    }
    let count = i32::try_from(counted.distinct.len()).unwrap_or(i32::MAX / 64);
    if count == 0 {
        return None;
    }
    // Polled replies are not a free-running stream, but nothing tells those without requests.
    if profile.format == Format::Period && counted.requests > 0 {
        return None;
    }
    let mut profile = profile;
    if let (Some(address), 1) = (counted.addresses.first(), counted.addresses.len()) {
        profile.address = u32::from(*address);
    }
    let active = match profile.format {
        Format::SsiTree if profile.code == Code::Gray => active(dump),
        _ => u32::MAX,
    };
    let mut motion = counted.track.motion(&profile, active);
    let first = counted.wires.first().copied().unwrap_or(0);
    let moved = counted
        .wires
        .iter()
        .fold(0, |moved, wire| moved | (wire ^ first));
    if moved > 0 {
        motion.stuck = motion.stuck.max(moved.trailing_zeros());
    }
    let mut evidence = Vec::new();
    let proved = count.saturating_mul(counted.check_bits);
    let bad = summary.frames - counted.good - unsettled - others;
    if counted.check_bits > 0 {
        evidence.push(text!(
            "the check holds in {} of {} frames",
            counted.good,
            summary.frames
        ));
        if counted.distinct.len() as u64 != counted.good {
            evidence.push(text!("{} of them are distinct", count));
        }
        evidence.push(text!("by chance 1 in 2^{}", proved));
    } else {
        evidence.push(text!(
            "{} of {} lines have its form; it has no check",
            counted.good,
            summary.frames
        ));
    }
    let unusual = unusual(&profile) + beside(&profile, dump);
    let mut score = proved - unusual;
    score += moves(&motion, &counted, &profile, &mut evidence);
    let strange = summary.skipped - counted.requests;
    // A damaged dump is still a dump of its format: what is good in it keeps a quarter.
    let against = bad * FAILS as u64 + strange * SKIPPED as u64;
    let against = i32::try_from(against).unwrap_or(i32::MAX / 2);
    score -= against.min(score.max(0) / 4 * 3 + bad as i32 / 2);
    if !placed {
        score = score.min(LIKELY);
        evidence.push(t("where its frames begin is not certain").to_string());
    }
    let mut turned_round = false;
    if profile.angle_bits > 8 && profile.medium() == Medium::Bytes {
        let other = counted.swapped.motion(&profile, u32::MAX);
        if other.gain > motion.gain / 2 * 3 {
            score -= SWAPPED;
            turned_round = true;
            let why = t("the angle is continuous only with its bytes in the other order");
            evidence.insert(0, why.to_string());
        }
    }
    if counted.requests > 0 {
        score += ASKED;
        evidence.push(text!("{} requests stand between them", counted.requests));
    }
    if strange > 0 {
        evidence.push(text!("{} bytes belong to no frame", strange));
    }
    score += fits(&counted, &profile, &mut evidence);
    // Without a check, words of the right length that stand still may be anything.
    let steady = motion.jumps == 0 && counted.changes == 0 && motion.stuck == 0;
    let odd = counted.both > 0 || bad + strange > 0 || motion.counts;
    if counted.check_bits <= 1 && steady && !odd {
        score = score.max(STEADY + counted.check_bits - unusual - motion.unset.min(4) as i32);
    }
    // Few words of a usual length are worth naming, though little speaks for them.
    let usual = unusual <= USUAL && counted.check_bits <= 1 && count < FEW && bad + strange == 0;
    // Without a check, what is not steady beside the position, or jumps, is another layout.
    let often = |count: i64| count * 4 > counted.good as i64;
    let untidy =
        counted.check_bits <= 1 && (often(counted.changes.into()) || often(motion.jumps.into()));
    if untidy {
        score /= UNTIDY;
    }
    if usual && !motion.counts {
        score = score.max(CHANCE + 1);
    }
    Some(Candidate {
        profile,
        verdict: Verdict::of(score, count),
        evidence,
        change: None,
        score,
        distinct: count,
        checked: counted.check_bits > 1,
        motion,
        reads: counted.reads,
        covered: counted.covered,
        strange,
        untidy: untidy || turned_round,
    })
}

/// How many bits of the lines change more often than damage makes them.
fn active(dump: &Dump) -> u32 {
    let mut ones: Vec<usize> = Vec::new();
    let mut total = 0;
    for line in lines(dump) {
        total += 1;
        ones.resize(ones.len().max(line.len()), 0);
        for (at, count) in ones.iter_mut().enumerate() {
            *count += usize::from(line.bit(at));
        }
    }
    let active = ones
        .iter()
        .filter(|count| (**count).min(total - **count) * DAMAGE > total);
    active.count() as u32
}

/// How odd the bits beside the word are.
fn beside(profile: &Profile, dump: &Dump) -> i32 {
    let len = lines(dump).next().map_or(0, Bits::len) as u32;
    let spare = width(profile).and_then(|width| len.checked_sub(width));
    match spare.unwrap_or(0) {
        0 => 0,
        // The same word may come several times.
        _ if profile.format == Format::SsiTree && len > 2 * profile.frame_bits => FILLED,
        _ if dump.is_bits() => CLOCKED,
        // What fills the last byte is usual, whole bytes behind the word are less so.
        spare => FILLED + (spare / 8) as i32,
    }
}

/// What the positions say.
fn moves(motion: &Motion, counted: &Counted, profile: &Profile, evidence: &mut Vec<String>) -> i32 {
    let mut score = motion.gain;
    if motion.counts && counted.check_bits == 0 {
        evidence.push(t("every step is the same, as those of a counter are").to_string());
        return -COUNTER;
    }
    let goes_on = motion.smooth > 0 && motion.smooth * 2 >= motion.steps;
    if goes_on {
        evidence.push(text!(
            "the position is continuous: {} of {} steps go on from those before, by chance 1 in \
             2^{}",
            motion.smooth,
            motion.steps,
            motion.gain
        ));
    } else if motion.steps > 0 {
        evidence.push(match motion.jumps {
            0 => t("the shaft hardly moves").to_string(),
            jumps => text!("the position jumps in {} of {} steps", jumps, motion.steps),
        });
    } else {
        evidence.push(t("the shaft stands still").to_string());
    }
    if motion.turned > 0 && !is_one_number(profile) {
        let times = motion.turned;
        evidence.push(text!(
            "the turns step with the wrap of the angle, {} times",
            times
        ));
    } else if motion.wraps > 0 {
        evidence.push(text!("the angle passes zero {} times", motion.wraps));
    }
    if motion.unset > 0 {
        let jumps = motion.jumps.min(6) as i32;
        let against = motion.unset as i32 * (UNUSED_BIT + jumps) + 1;
        // One position is set in its top bits or not: that says little of the width.
        score -= match motion.steps {
            0 => against.min(UNUSED_STILL),
            _ => against,
        };
        evidence.push(match motion.unset {
            1 => t("the top bit of the angle was never seen set: it may be narrower").to_string(),
            many => {
                text!(
                    "the top {} bits of the angle were never seen set: it may be narrower",
                    many
                )
            }
        });
    }
    if motion.stuck > 0 && counted.distinct.len() > 3 {
        let most = match profile.code {
            Code::Gray => u32::MAX,
            Code::Binary => STUCK_MOST,
        };
        let each = (counted.distinct.len() as u32 - 1).min(most);
        score -= (motion.stuck * each) as i32;
        evidence.push(match motion.stuck {
            1 => t("the lowest bit of the angle never changes").to_string(),
            many => text!("the lowest {} bits of the angle never change", many),
        });
    }
    score
}

/// Whether turns and angle stand side by side, so that where one ends cannot be seen.
pub(super) fn is_one_number(profile: &Profile) -> bool {
    profile.medium() == Medium::Bits
}

/// What else speaks for a profile or against it.
fn fits(counted: &Counted, profile: &Profile, evidence: &mut Vec<String>) -> i32 {
    let mut score = 0;
    if counted.preamble {
        score += PREAMBLE;
        evidence.push(t("the lines begin with the preamble of these encoders").to_string());
    } else if counted.started {
        score += STARTED;
        evidence.push(t("the lines begin with an acknowledge and a start bit").to_string());
    }
    if counted.named {
        score += NAMED;
        evidence.push(text!(
            "the encoder identity says {} bits",
            profile.angle_bits
        ));
    }
    if let Some((least, most)) = counted.temperatures {
        let usual = ROOM.contains(&least) && ROOM.contains(&most);
        score += if usual { LIKELY_HEAT } else { -LIKELY_HEAT };
    }
    if profile.format == Format::Asi4 && counted.good >= 4 {
        score += LINES;
        evidence.push(t("every line is digits with CR and LF").to_string());
    }
    let single = matches!(profile.format, Format::Asi1 | Format::Ssi7);
    if single && profile.angle_bits == profile.format.default_profile().angle_bits {
        score += OWN_WIDTH;
        evidence.push(t("the width of the IP-75").to_string());
    }
    if counted.changes > 0 {
        let against = counted.changes.saturating_mul(FLICKERS);
        // Without a check, bits that come and go speak for another layout.
        score -= match counted.check_bits {
            0 | 1 => against,
            _ => against.min(FLICKERS_MOST),
        };
        evidence.push(text!(
            "bits beside the position change {} times",
            counted.changes
        ));
    }
    if counted.both * 2 > counted.good && counted.good > 0 {
        score -= BOTH;
        evidence.push(t("error and warning are set together").to_string());
    }
    if let Some(more) = counted
        .addresses
        .len()
        .checked_sub(1)
        .filter(|more| *more > 0)
    {
        score -= more as i32 * ADDRESS;
        evidence.push(text!("{} addresses answer", more + 1));
    }
    score
}

/// Whether the first frames pass often enough to look at the others.
fn is_promising(decoder: &Decoder, dump: &Dump) -> bool {
    let profile = decoder.profile();
    match profile.medium() {
        Medium::Text => true,
        Medium::Bits => {
            let count = dump.len();
            if count <= FIRST {
                return true;
            }
            let stride = count / FIRST;
            // Not every so many-eth line, where the same fault may come back.
            let few = kept(dump, &|index| {
                let turn = index / stride;
                turn < FIRST && index % stride == turn % stride
            });
            let summary = decoder.dump(&few, &mut |_| {});
            (summary.frames - summary.bad) * 3 >= FIRST as u64
        }
        Medium::Bytes => {
            let bytes = dump.bytes();
            let front = bytes.get(..FRONT).unwrap_or(bytes);
            let mut passes = 0;
            let mut longest = 1;
            for start in 0..front.len() {
                let rest = front.get(start..).unwrap_or_default();
                let layout = decoder.layout(rest);
                let Some(layout) = layout else { continue };
                longest = longest.max(layout.len / 8);
                let frame = rest.get(..layout.len / 8);
                passes +=
                    usize::from(frame.is_some_and(|frame| layout.holds(Bits::of_bytes(frame))));
            }
            passes * longest * 8 >= front.len()
        }
    }
}
