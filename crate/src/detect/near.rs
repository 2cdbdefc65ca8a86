//! What nearly fits: mistakes of a capture, and profiles beside the one that was chosen.

use super::{
    Candidate, Change, LEAD, hypotheses, rank,
    sample::{Sample, lines},
};
use crate::{dump::Dump, format::Medium, profile::Profile, text};
use alloc::{collections::BTreeMap, format, string::String, vec::Vec};

/// What fits a dump better than the profile that was chosen, or nearly as well.
#[derive(Clone, Debug, PartialEq)]
pub struct Near {
    /// What is different, in a sentence.
    pub text: String,
    /// The profile that fits.
    pub profile: Profile,
    /// What must be done to the dump first.
    pub change: Option<Change>,
}

/// Most that is said.
const MOST: usize = 6;

/// What fits `dump` better than `profile` does, though it differs in one thing: a width, a
/// command, a mistake of the capture. The best comes first; nothing where the profile fits. Only
/// the front of the dump is looked at, so that this takes little time.
///
/// ```
/// use encoderscope::{detect::near, dump::parse, format::Format};
/// let profile = Format::T485.default_profile();
/// let text = "1a 20 29 c0 01 11 00 00 00 c8 0b\n1a 20 83 c1 00 11 00 00 00 c8 a1";
/// let dump = parse(text, profile.medium());
/// assert_eq!(near(&profile, &dump)[0].profile.angle_bits, 17);
/// ```
#[must_use]
pub fn near(profile: &Profile, dump: &Dump) -> Vec<Near> {
    let sample = Sample::new(dump, dump, dump).front();
    let own = rank::tried(*profile, &sample);
    let score = own.map_or(0, |own| own.score);
    let beside = |sample: &Sample| {
        let all = hypotheses::of(sample).into_iter();
        all.filter(|other| other.format == profile.format && other != profile)
            .map(|other| fitted(profile, other))
            .collect::<Vec<_>>()
    };
    let mut found: Vec<Candidate> = Vec::new();
    for other in beside(&sample) {
        found.extend(rank::tried(other, &sample));
    }
    for change in changes(&sample) {
        let sample = sample.changed(change);
        for other in core::iter::once(*profile).chain(beside(&sample)) {
            let candidate = rank::tried(other, &sample).filter(rank::is_strong);
            found.extend(candidate.map(|candidate| candidate.after(change)));
        }
    }
    found.retain(|candidate| candidate.score >= score + LEAD);
    found.sort_by_key(|candidate| -candidate.score);
    found.truncate(MOST);
    found
        .into_iter()
        .map(|candidate| Near {
            text: sentence(profile, &candidate),
            profile: candidate.profile,
            change: candidate.change,
        })
        .collect()
}

/// A profile with what is not on the wire taken from the chosen one.
const fn fitted(chosen: &Profile, other: Profile) -> Profile {
    Profile {
        baud: chosen.baud,
        turns_code: chosen.turns_code,
        status_active: chosen.status_active,
        dialect: chosen.dialect,
        marker: chosen.marker,
        ..other
    }
}

fn sentence(chosen: &Profile, candidate: &Candidate) -> String {
    let mut differs: Vec<String> = Vec::new();
    let before = chosen.parameters();
    for (name, value) in candidate.profile.parameters() {
        let same = before.iter().any(|known| *known == (name, value.clone()));
        if !same {
            differs.push(format!("{name} {}", value.plain()));
        }
    }
    let skip = usize::from(candidate.change.is_some());
    let why = candidate.evidence.get(skip).map_or("", String::as_str);
    match (candidate.change, differs.is_empty()) {
        (Some(change), true) => text!("{}; then {}", change.sentence(), why),
        (Some(change), false) => {
            text!(
                "{}; then with {} {}",
                change.sentence(),
                differs.join(", "),
                why
            )
        }
        (None, _) => text!("with {} {}", differs.join(", "), why),
    }
}

/// The mistakes that a capture may have.
pub(super) fn changes(sample: &Sample) -> Vec<Change> {
    let mut all = Vec::new();
    let bytes = sample.dump(Medium::Bytes).bytes();
    // The same line again and again is not evidence of any mistake.
    let dump = sample.dump(Medium::Bits);
    let same = lines(dump)
        .skip(1)
        .zip(lines(dump))
        .all(|(one, other)| one == other);
    if sample.is_decimal || sample.counts || dump.is_empty() || same && lines(dump).count() > 1 {
        return all;
    }
    if !sample.is_bits() {
        let spaced = |byte: &u8| byte.is_ascii_hexdigit() || byte.is_ascii_whitespace();
        if bytes.iter().all(spaced) {
            all.push(Change::HexText);
        }
        all.extend(missing_byte(sample));
        all.push(Change::Reversed);
    }
    all.extend([Change::Inverted, Change::ClockLate, Change::ClockEarly]);
    all
}

/// The byte that all lines would need in front for the exclusive or of each to be 0, as that of
/// every T485 and BUS frame is; both begin with the byte that was asked.
fn missing_byte(sample: &Sample) -> Option<Change> {
    let dump = sample.dump(Medium::Bytes);
    let mut sums: BTreeMap<u8, usize> = BTreeMap::new();
    let mut total = 0;
    for line in lines(dump).filter(|line| line.len() < 12 * 8) {
        let sum = line.bytes().iter().fold(0, |sum, byte| sum ^ byte);
        *sums.entry(sum).or_default() += 1;
        total += 1;
    }
    let (byte, count) = sums.into_iter().max_by_key(|(_, count)| *count)?;
    let most = total > 2 && count * 4 > total * 3;
    (most && byte != 0).then_some(Change::MissingByte(byte))
}
