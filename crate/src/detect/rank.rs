//! Candidates against each other.

use super::{
    CERTAIN, Candidate, LEAD, Verdict,
    sample::Sample,
    weigh::{CHANCE, FEW, LINES, is_one_number, weigh},
};
use crate::{
    bits,
    format::Format,
    language::{msg, t},
    profile::Profile,
    text,
};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};

/// Bits of evidence of several frames, and of one alone, that are not to be had by chance from
/// one of some hundred profiles.
const PROBABLE: i32 = 14;
const ALONE: i32 = 20;
/// A lead that leaves no doubt.
const SAFE_LEAD: i32 = 8;
/// Evidence without a check that leaves no doubt, and from how many frames.
const MOVED: i32 = 80;
const MOVED_FRAMES: i32 = 8;
/// More candidates than this help nobody.
const MOST: usize = 24;

/// What one frame, or a shaft that stands still, calls for.
const MORE: &str = msg("more frames, of a turning shaft, would decide");

/// What no frame tells of a number without anything between turns and angle.
const SIDE_BY_SIDE: &str =
    msg("turns and angle stand side by side: how many bits are turns only the data sheet says");

/// Tries one profile on a sample.
pub(super) fn tried(profile: Profile, sample: &Sample) -> Option<Candidate> {
    let mut candidate = weigh(profile, sample.dump(profile.medium()))?;
    if sample.counts && !candidate.checked {
        return None;
    }
    if profile.format == Format::Asi4 && sample.is_decimal {
        // The line ends of a list of numbers were not on the wire.
        candidate.score -= 4 * candidate.distinct + LINES;
        candidate.checked = false;
        if candidate.motion.counts {
            candidate.score = 0;
        }
    }
    Some(candidate)
}

/// Whether a candidate is good enough to be listed after a change of the dump, and to leave no
/// need for a search of unknown checksums.
pub(super) fn is_strong(candidate: &Candidate) -> bool {
    candidate.score >= PROBABLE + LEAD && proves(candidate) && !candidate.untidy
}

/// Whether a candidate leaves no need to look for mistakes of the capture.
pub(super) fn is_settled(candidate: &Candidate) -> bool {
    candidate.change.is_none()
        && candidate.score >= CERTAIN
        && is_strong(candidate)
        && candidate.motion.stuck == 0
}

/// Whether there is evidence for more than the length of the frames.
const fn proves(candidate: &Candidate) -> bool {
    candidate.checked && candidate.distinct > 1
        || candidate.distinct >= MOVED_FRAMES / 2
            && candidate.motion.smooth > candidate.motion.jumps
}

/// The candidates in order, with their verdicts.
pub(super) fn ranked(mut found: Vec<Candidate>) -> Vec<Candidate> {
    found.retain(|candidate| candidate.score > CHANCE);
    found.sort_by_key(|candidate| -candidate.score);
    let Some(leader) = found.first().cloned() else {
        return found;
    };
    let rivals = || {
        let others = found.iter().skip(1);
        others.filter(|other| !reads_alike(&leader, other))
    };
    let lead = rivals()
        .map(|rival| leader.score - rival.score)
        .max_by_key(|lead| -lead);
    let lead = lead.unwrap_or(i32::MAX);
    let close = rivals()
        .filter(|rival| leader.score - rival.score < LEAD)
        .count();
    let undecided = decides(
        &leader,
        rivals().filter(|rival| leader.score - rival.score < SAFE_LEAD),
    );
    let verdict = match alone(&leader, lead) {
        Verdict::Likely if undecided.contains(&Decider::DataSheet) => Verdict::Ambiguous,
        verdict => verdict,
    };
    found.truncate(MOST);
    for candidate in &mut found {
        // So little evidence tells nothing from anything.
        let margin = if leader.distinct < 3 { SAFE_LEAD } else { LEAD };
        let near = leader.score - candidate.score < margin;
        let alike = reads_alike(&leader, candidate);
        candidate.verdict = match verdict {
            Verdict::Ambiguous if near => Verdict::Ambiguous,
            _ if alike && candidate.change == leader.change => verdict,
            _ => Verdict::Unlikely,
        };
        if candidate.verdict == Verdict::Ambiguous && close > 0 {
            candidate.evidence.push(match close {
                1 => t("another reading fits as well").to_string(),
                more => text!("{} other readings fit as well", more),
            });
        }
        if candidate.verdict != Verdict::Unlikely {
            let said = undecided.iter().map(Decider::sentence);
            candidate.evidence.extend(said);
        }
    }
    name_alike(&mut found);
    name_mixed(&mut found);
    found
}

/// The verdict on the best candidate.
fn alone(leader: &Candidate, lead: i32) -> Verdict {
    let clean = leader.change.is_none()
        && !leader.untidy
        && leader.profile.own.is_none_or(|_| leader.checked);
    let enough = match leader.checked {
        true => leader.score >= CERTAIN && leader.distinct > 1,
        false => leader.score >= MOVED && leader.distinct >= MOVED_FRAMES,
    };
    // Without a check nearly all steps must go on from those before.
    let motion = &leader.motion;
    let few = leader.distinct < FEW;
    let moves = motion.steps > 0 && motion.smooth * 5 < motion.steps * 4;
    if !leader.checked && !few && lead >= LEAD && moves {
        return Verdict::Unlikely;
    }
    let probable = match leader.distinct {
        1 => leader.score >= ALONE,
        _ => leader.score >= PROBABLE,
    };
    match lead {
        ..LEAD => Verdict::Ambiguous,
        SAFE_LEAD.. if clean && enough && leader.motion.stuck == 0 => Verdict::Certain,
        _ if leader.untidy && !leader.checked && !few => Verdict::Unlikely,
        _ if probable && clean | (leader.score >= ALONE) => Verdict::Likely,
        // So little can be many things.
        _ if few || leader.motion.steps == 0 => Verdict::Ambiguous,
        _ => Verdict::Unlikely,
    }
}

/// Whether two candidates give the same readings: PERIOD sends the replies of RS485 to `d`, and
/// a number between zeros may be called by several names.
fn reads_alike(one: &Candidate, other: &Candidate) -> bool {
    let widths = |candidate: &Candidate| {
        (
            candidate.profile.angle_bits,
            candidate.profile.turns_bits,
            candidate.reads,
        )
    };
    one.change == other.change && widths(one) == widths(other)
}

/// Says of the first of several that read alike what the others are.
fn name_alike(found: &mut [Candidate]) {
    let Some((leader, others)) = found.split_first_mut() else {
        return;
    };
    let mut names: Vec<&str> = Vec::new();
    let clocked = is_one_number(&leader.profile);
    let alike = others.iter().filter(|other| reads_alike(leader, other));
    for other in alike.filter(|other| is_one_number(&other.profile) == clocked) {
        let name = t(other.profile.title());
        if name != t(leader.profile.title()) && !names.contains(&name) {
            names.push(name);
        }
    }
    if !names.is_empty() {
        leader
            .evidence
            .push(text!("{} would read the same", names.join(t(" and "))));
    }
}

/// Says when what belongs to no frame of the first is made of frames of another format.
fn name_mixed(found: &mut [Candidate]) {
    let Some((leader, others)) = found.split_first_mut() else {
        return;
    };
    let many = leader.strange * 4 > leader.covered;
    let mut rest = others.iter_mut().filter(|other| {
        let format = other.profile.format != leader.profile.format;
        format && is_strong(other) && other.covered * 4 > leader.strange * 3
    });
    if let Some(other) = rest.next().filter(|_| many) {
        let of = |title: &str| text!("two formats are mixed: the rest are frames of {}", title);
        leader.evidence.insert(0, of(t(other.profile.title())));
        other.evidence.insert(0, of(t(leader.profile.title())));
        if leader.verdict == Verdict::Certain {
            leader.verdict = Verdict::Likely;
        }
    }
}

/// What would decide between readings.
#[derive(Debug, PartialEq, Eq)]
enum Decider {
    /// More frames, of a turning shaft.
    More,
    /// No frame, but the data sheet: turns and angle stand side by side.
    DataSheet,
    /// A sample of which this is said.
    Sample(String),
}

impl Decider {
    fn sentence(&self) -> String {
        match self {
            Self::More => t(MORE).to_string(),
            Self::DataSheet => t(SIDE_BY_SIDE).to_string(),
            Self::Sample(sentence) => sentence.clone(),
        }
    }
}

/// What would decide between the best candidate and its rivals.
fn decides<'a>(leader: &Candidate, rivals: impl Iterator<Item = &'a Candidate>) -> Vec<Decider> {
    let mut all: Vec<Decider> = Vec::new();
    if leader.distinct < 3 || !leader.checked && leader.distinct < FEW {
        all.push(Decider::More);
    }
    for rival in rivals {
        let decider = between(leader, rival);
        if !all.contains(&decider) {
            all.push(decider);
        }
    }
    all
}

fn between(leader: &Candidate, rival: &Candidate) -> Decider {
    let (one, other) = (&leader.profile, &rival.profile);
    let same = one.format == other.format;
    if leader.distinct < 3 {
        return Decider::More;
    }
    let spread = |profile: &Profile| profile.angle_bits + profile.turns_bits;
    let narrow = spread(one).min(spread(other));
    let wide = one.angle_bits.max(other.angle_bits);
    if same && spread(one) != spread(other) && one.format == Format::Ssi && narrow > wide {
        return Decider::Sample(text!(
            "frames with turns of at least {} would decide",
            bits::codes(narrow - wide)
        ));
    }
    if same && one.command != other.command {
        return Decider::Sample(
            t("whether it is a temperature or a speed shows when the shaft stands and turns")
                .to_string(),
        );
    }
    if same && one.angle_bits != other.angle_bits && one.code == other.code && is_one_number(one) {
        return Decider::DataSheet;
    }
    if same && one.turns_bits != other.turns_bits && one.angle_bits == other.angle_bits {
        let least = one.turns_bits.min(other.turns_bits);
        return Decider::Sample(text!(
            "frames with turns of at least {} would decide",
            bits::codes(least)
        ));
    }
    if same && one.status_bits != other.status_bits && one.format == Format::BissC {
        return Decider::Sample(
            t("a capture with a status bit set, or of a turning shaft, would decide").to_string(),
        );
    }
    if same && one.angle_bits != other.angle_bits && leader.motion.wraps == 0 {
        return Decider::Sample(
            t("turn the shaft through zero: then the width of the angle shows").to_string(),
        );
    }
    if leader.motion.smooth == 0 {
        return Decider::Sample(
            t("the shaft stands still: frames of a turning shaft would decide").to_string(),
        );
    }
    let rival = match one.format == other.format {
        true => t("another reading of the same format").to_string(),
        false => t(other.title()).to_string(),
    };
    Decider::Sample(text!(
        "{} fits nearly as well; more frames of a turning shaft would decide",
        rival
    ))
}
