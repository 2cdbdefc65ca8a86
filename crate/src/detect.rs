//! What a dump may be: every format at every width, ranked by evidence.
//!
//! Evidence is counted in bits: a frame whose check holds is worth its checksum, once for each
//! distinct frame, since a still shaft repeats itself; what does not fit counts against. One
//! frame alone is never certain: a CRC-6 holds by chance once in 64 frames, a CRC-8 once in 256.

use crate::{
    bits,
    decode::{Decoded, Decoder, Frame},
    dump::{self, Dump},
    format::{Format, Medium, rs485::Command},
    framing::Why,
    layout::{Role, Shape},
    profile::Profile,
    record::Record,
};
use alloc::{
    collections::BTreeSet,
    format,
    string::{String, ToString},
    vec::Vec,
};

/// Text beyond this is not looked at: what has not shown by then will not.
const ENOUGH_TEXT: usize = 8_000;
/// Bits of evidence for each verdict, and the lead that sets a candidate apart.
const CERTAIN: i32 = 40;
pub(crate) const LIKELY: i32 = 8;
pub(crate) const LEAD: i32 = 4;
/// Against: a frame that fails, a byte of no frame, a width whose top bit was never seen set.
const FAILS: i32 = 6;
const SKIPPED: i32 = 1;
const UNUSED_BIT: i32 = 3;
/// For: an identity that names the width, a preamble that is the profile's own.
const NAMED: i32 = 6;
const PREAMBLE: i32 = 4;
/// For: the only width that an encoder of the manuals has.
const OWN_WIDTH: i32 = 4;
/// Less than this is chance.
const CHANCE: i32 = 3;

/// How sure a detection is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Several frames say so, and nothing else fits.
    Certain,
    /// It fits better than anything else.
    Likely,
    /// Something else fits as well.
    Ambiguous,
    /// Hardly more than chance.
    Unlikely,
}

impl Verdict {
    /// The verdict on so many bits of evidence from so many distinct frames.
    pub(crate) const fn of(score: i32, distinct: i32) -> Self {
        match score {
            _ if distinct > 1 && score >= CERTAIN => Self::Certain,
            LIKELY.. => Self::Likely,
            _ => Self::Unlikely,
        }
    }

    /// The word for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Certain => "certain",
            Self::Likely => "likely",
            Self::Ambiguous => "ambiguous",
            Self::Unlikely => "unlikely",
        }
    }
}

/// Something that a dump may be.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// How to read it.
    pub profile: Profile,
    /// How sure that is.
    pub verdict: Verdict,
    /// Why, in sentences.
    pub evidence: Vec<String>,
    pub(crate) score: i32,
}

impl Candidate {
    /// The record of a candidate: its profile, verdict and evidence.
    #[must_use]
    pub fn record(&self) -> Record {
        self.profile
            .record()
            .with("verdict", self.verdict.name())
            .with("evidence", self.evidence.clone())
    }
}

/// Ranks what a pasted dump may be, best first; nothing where more speaks against than for.
///
/// ```
/// use encoderscope::{detect::{Verdict, detect}, format::Format};
/// let found = detect("1a 20 29 c0 3b 17 00 00 00 c8 37\n1a 20 83 c1 52 17 00 00 00 c8 f5");
/// assert_eq!((found[0].profile.format, found[0].profile.angle_bits), (Format::T485, 23));
/// ```
#[must_use]
pub fn detect(text: &str) -> Vec<Candidate> {
    let end = (0..=ENOUGH_TEXT.min(text.len()))
        .rev()
        .find(|at| text.is_char_boundary(*at));
    let text = &text[..end.unwrap_or(0)];
    let dumps = [
        dump::parse(text, Medium::Bytes),
        dump::parse(text, Medium::Bits),
        dump::parse(text, Medium::Text),
    ];
    // Strings of 0 and 1 are clocked words.
    let bits_only = dumps[1].is_bits();
    let mut found: Vec<Candidate> = hypotheses()
        .filter(|profile| !bits_only || profile.medium() == Medium::Bits)
        .filter_map(|profile| {
            let dump = match profile.medium() {
                Medium::Bytes => &dumps[0],
                Medium::Bits => &dumps[1],
                Medium::Text => &dumps[2],
            };
            weigh(profile, dump)
        })
        .collect();
    found.retain(|candidate| candidate.score > CHANCE);
    found.sort_by_key(|candidate| -candidate.score);
    let best = found.first().map_or(0, |candidate| candidate.score);
    let leader = found.first().map(|candidate| candidate.profile);
    let rivals = found
        .iter()
        .filter(|candidate| best - candidate.score < LEAD)
        .filter(|candidate| leader.is_none_or(|leader| !reads_alike(&leader, &candidate.profile)))
        .count();
    for candidate in &mut found {
        if best - candidate.score < LEAD && rivals > 0 {
            candidate.verdict = Verdict::Ambiguous;
            candidate.evidence.push(match rivals {
                1 => "another reading fits as well".to_string(),
                more => format!("{more} other readings fit as well"),
            });
        } else if leader.is_some_and(|leader| !reads_alike(&leader, &candidate.profile)) {
            candidate.verdict = Verdict::Unlikely;
        }
    }
    found
}

/// Whether two profiles give the same readings: PERIOD sends the replies of RS485 to `d`.
fn reads_alike(one: &Profile, other: &Profile) -> bool {
    let neutral = |profile: &Profile| match profile.format {
        Format::Period => Profile {
            format: Format::Rs485,
            command: Command::Status,
            ..*profile
        },
        _ => *profile,
    };
    neutral(one) == neutral(other)
}

/// Every profile that is tried.
fn hypotheses() -> impl Iterator<Item = Profile> {
    let t485 = [17, 23].map(|angle_bits| Profile {
        angle_bits,
        ..Format::T485.default_profile()
    });
    let native = || (16..=24).flat_map(|angle| [0, 16].map(|turns| (angle, turns)));
    let rs485 = native().flat_map(|(angle_bits, turns_bits)| {
        Command::ALL
            .iter()
            .filter(|command| !command.changes_encoder())
            .map(move |command| Profile {
                angle_bits,
                turns_bits,
                command: *command,
                ..Format::Rs485.default_profile()
            })
    });
    let biss = native().flat_map(|(angle_bits, turns_bits)| {
        [0, 6].map(|status_bits| Profile {
            angle_bits,
            turns_bits,
            status_bits,
            ..Format::BissC.default_profile()
        })
    });
    let plain = [Format::Bus, Format::Period]
        .into_iter()
        .flat_map(move |format| {
            native().map(move |(angle_bits, turns_bits)| Profile {
                angle_bits,
                turns_bits,
                ..format.default_profile()
            })
        });
    let ip75 = [(Format::Asi1, 14), (Format::Asi1, 22), (Format::Asi4, 14)];
    let ip75 = ip75
        .into_iter()
        .chain([(Format::Ssi7, 14), (Format::Ssi7, 22)]);
    let ip75 = ip75.map(|(format, angle_bits)| Profile {
        angle_bits,
        ..format.default_profile()
    });
    t485.into_iter()
        .chain(rs485)
        .chain(biss)
        .chain(plain)
        .chain(ip75)
}

/// Tries one profile; `None` where no frame passes.
pub(crate) fn weigh(profile: Profile, dump: &Dump) -> Option<Candidate> {
    let decoder = Decoder::new(profile).ok()?;
    let mut distinct = BTreeSet::new();
    let mut top_bit = false;
    let mut named = false;
    let mut preamble = false;
    let mut check_bits = 0;
    let mut requests = 0;
    let mut addresses = BTreeSet::new();
    let summary = decoder.dump(dump, &mut |decoded| {
        let frame = match decoded {
            Decoded::Frame(frame) => frame,
            Decoded::Skip { why, bits, .. } => {
                if why == Why::Request {
                    requests += bits.bytes().len() as u64;
                }
                return;
            }
        };
        if !frame.ok() {
            return;
        }
        let values = frame.values();
        top_bit |= values
            .angle
            .is_some_and(|angle| bits::bit(angle, profile.angle_bits - 1));
        named |= matches!(
            (values.enid, profile.angle_bits),
            (Some(0x17), 23) | (Some(0x11), 17)
        );
        preamble |= profile.format == Format::BissC
            && frame.layout.shape
                == Shape {
                    tail: frame.layout.shape.tail,
                    ..Shape::of(profile)
                };
        addresses.extend(values.address);
        check_bits = check_width(&frame);
        distinct.insert(frame.bits.bytes().to_vec());
    });
    let good = summary.frames - summary.bad;
    let count = i32::try_from(distinct.len()).unwrap_or(i32::MAX / 64);
    if count == 0 {
        return None;
    }
    // Polled replies are not a free-running stream, but nothing tells those without requests.
    if profile.format == Format::Period && requests > 0 {
        return None;
    }
    let mut profile = profile;
    if let (Some(address), 1) = (addresses.first(), addresses.len()) {
        profile.address = u32::from(*address);
    }
    let mut evidence = Vec::new();
    evidence.push(format!(
        "the check holds in {good} of {} frames",
        summary.frames
    ));
    if distinct.len() as u64 != good {
        evidence.push(format!("{count} of them are distinct"));
    }
    evidence.push(format!(
        "by chance 1 in 2^{}",
        count.saturating_mul(check_bits)
    ));
    let proved = count.saturating_mul(check_bits);
    // A damaged dump is still a dump of its format: what is good in it keeps a quarter.
    let strange = summary.skipped - requests;
    let against = summary.bad * FAILS as u64 + strange * SKIPPED as u64;
    let against = i32::try_from(against).unwrap_or(i32::MAX);
    let mut score = proved - against.min(proved / 4 * 3);
    if requests > 0 {
        evidence.push(format!("{requests} requests stand between them"));
    }
    if strange > 0 {
        evidence.push(format!("{strange} bytes belong to no frame"));
    }
    if !top_bit {
        score -= UNUSED_BIT;
        evidence
            .push("the top bit of the angle was never seen set: it may be narrower".to_string());
    }
    if preamble {
        score += PREAMBLE;
        evidence.push("the lines begin with the preamble of these encoders".to_string());
    }
    if named {
        score += NAMED;
        evidence.push(format!(
            "the encoder identity says {} bits",
            profile.angle_bits
        ));
    }
    let single = matches!(profile.format, Format::Asi1 | Format::Ssi7);
    if single && profile == profile.format.default_profile() {
        score += OWN_WIDTH;
        evidence.push("the width of the IP-75".to_string());
    }
    Some(Candidate {
        profile,
        verdict: Verdict::of(score, count),
        evidence,
        score,
    })
}

/// Bits of a frame that are right by chance rarely: its checks, and a control field's pattern.
pub(crate) fn check_width(frame: &Frame<'_>) -> i32 {
    let fields = frame.layout.fields().filter(|field| match field.row.role {
        Role::Crc => true,
        Role::Parity => field.is_binding(),
        Role::Framing => {
            field.row.constant.is_some() && frame.layout.shape.profile.format != Format::BissC
        }
        _ => false,
    });
    let width = fields.map(|field| field.width as i32).sum();
    match frame.layout.shape.profile.format {
        // Any list of small numbers looks like it.
        Format::Asi4 => width / 4,
        _ => width,
    }
}
