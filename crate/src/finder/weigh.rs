//! The evidence: replies to requests, and streams.

use super::{
    Found,
    requests::{addresses, asks, decoders},
};
use crate::{
    bits,
    decode::{Decoded, Decoder},
    detect::{self, Verdict, check_width},
    dump::Dump,
    format::Format,
    language::t,
    profile::Profile,
    reading::Values,
    session::{Ask, Micros},
    text,
};
use alloc::{
    collections::{BTreeSet, VecDeque},
    string::{String, ToString},
    vec::Vec,
};

/// Bits of evidence: a reply is as long as it must be; it begins with the request.
const LENGTH: i32 = 3;
const ECHOED: i32 = 8;
/// The same reply again; a still shaft gives no other.
const REPEATED: i32 = 1;
/// Against: the top bit of the angle was not seen in a distinct angle; in so many at most.
const UNUSED_BIT: i32 = 3;
const UNUSED_MOST: usize = 8;
/// The encoder names its width; the only width there is.
const NAMED: i32 = 6;
/// A stream is text, line after line: no other is.
const TEXT: i32 = 6;
/// A stream has the pace that the manual gives.
const PACED: i32 = 6;
/// Against: a reply whose check fails.
const FAILS: i32 = 6;
/// So many replies must agree on another profile.
const PROVING: usize = 4;
/// Less than this is chance.
const CHANCE: i32 = 6;
/// The fewest and the most bits per turn in two and in three bytes (MPP and PT, order code).
const TWO_BYTES: u32 = 16;
const THREE_BYTES: (u32, u32) = (17, 24);

/// A profile that may be right, and what it would ask.
#[derive(Debug)]
struct Hypothesis {
    profile: Profile,
    decoders: Vec<Decoder>,
    asks: Vec<Ask>,
}

/// A good reply.
struct Reply {
    values: Values,
    /// Bits that are right by chance rarely.
    worth: i32,
    echo: bool,
}

impl Hypothesis {
    fn new(profile: Profile) -> Self {
        let decoders = decoders(profile);
        let asks = asks(&decoders);
        Self {
            profile,
            decoders,
            asks,
        }
    }

    /// What a reply says, where it is a good one; an adapter may have put the request before it.
    fn read(&self, index: usize, reply: &[u8]) -> Option<Reply> {
        let ask = self.asks.get(index)?;
        let decoder = &self.decoders[index.min(self.decoders.len() - 1)];
        let behind = reply.strip_prefix(ask.bytes());
        let plain = ask.is_answered_by(decoder, reply).then_some((reply, false));
        let (frame, echo) = plain.or_else(|| {
            let behind = behind.filter(|rest| ask.is_answered_by(decoder, rest))?;
            Some((behind, true))
        })?;
        let echoed = if decoder.echoes() { ECHOED } else { 0 };
        let frame = decoder.frame(frame)?;
        Some(Reply {
            values: frame.values(),
            worth: check_width(&frame) + LENGTH + echoed,
            echo,
        })
    }
}

/// What was asked of a format, and what came back.
#[derive(Debug, Default)]
pub(super) struct Asked {
    hypotheses: Vec<Hypothesis>,
    /// Which request, and what came.
    exchanges: Vec<(usize, Vec<u8>)>,
}

/// What the replies came to.
#[derive(Debug, Default)]
pub(super) struct Weighed {
    pub(super) found: Vec<Found>,
    pub(super) disturbed: Vec<u8>,
}

impl Asked {
    pub(super) fn new(format: Format, baud: u32, known: Option<Profile>) -> Self {
        let profiles = match (known, format) {
            (Some(profile), _) => Vec::from([profile]),
            (None, Format::T485) => t485(),
            (None, _) => native(format),
        };
        Self {
            hypotheses: profiles
                .into_iter()
                .map(|profile| Hypothesis::new(Profile { baud, ..profile }))
                .collect(),
            exchanges: Vec::new(),
        }
    }

    pub(super) fn format(&self) -> Option<Format> {
        Some(self.hypotheses.first()?.profile.format)
    }

    /// How many requests there are.
    pub(super) fn len(&self) -> usize {
        self.hypotheses.first().map_or(0, |first| first.asks.len())
    }

    pub(super) fn request(&self, index: usize) -> &[u8] {
        let first = self.hypotheses.first();
        first
            .and_then(|first| first.asks.get(index))
            .map_or(&[], Ask::bytes)
    }

    pub(super) fn answered(&mut self, index: usize, reply: Vec<u8>) {
        self.exchanges.push((index, reply));
    }

    /// What is asked again: what was answered; in the second round all of a few. Between two that
    /// are the same another one goes out, so that no encoder hears anything twice in a row.
    pub(super) fn worth_asking(&self, round: usize) -> VecDeque<usize> {
        let few = self.format() != Some(Format::Bus);
        let answered = |index: &usize| {
            let mut exchanges = self.exchanges.iter().filter(|(asked, _)| asked == index);
            exchanges.any(|(index, reply)| self.is_intelligible(*index, reply))
        };
        let mut again: VecDeque<usize> = (0..self.len())
            .filter(|index| round == 1 && few || answered(index))
            .collect();
        if again.len() == 1 && self.len() > 1 {
            let index = again[0];
            again.push_back((index + 1) % self.len());
        }
        again
    }

    /// Whether a reply is good, or says at least which request it answers.
    fn is_intelligible(&self, index: usize, reply: &[u8]) -> bool {
        let request = self.request(index);
        let good = |hypothesis: &Hypothesis| hypothesis.read(index, reply).is_some();
        let named = |hypothesis: &Hypothesis| {
            let echoes = hypothesis.decoders.iter().any(Decoder::echoes);
            echoes && reply.len() > request.len() && reply.starts_with(request)
        };
        self.hypotheses.iter().any(|one| good(one) || named(one))
    }

    /// Whether anything but the echo of the request came back.
    fn talks_at(&self, index: usize) -> bool {
        let mut exchanges = self.exchanges.iter().filter(|(asked, _)| *asked == index);
        exchanges.any(|(index, reply)| !reply.is_empty() && reply != self.request(*index))
    }

    /// What may be on the line, and the addresses where something else is.
    pub(super) fn weigh(&self) -> Weighed {
        let found: Vec<Found> = self
            .hypotheses
            .iter()
            .filter_map(|hypothesis| self.weigh_one(hypothesis))
            .collect();
        let mut disturbed = Vec::new();
        if self.format() == Some(Format::Bus) {
            let answers = |address| found.iter().any(|found| found.addresses.contains(&address));
            disturbed = addresses()
                .enumerate()
                .filter(|(index, address)| self.talks_at(*index) && !answers(*address))
                .map(|(_, address)| address)
                .collect();
        }
        Weighed { found, disturbed }
    }

    fn weigh_one(&self, hypothesis: &Hypothesis) -> Option<Found> {
        let mut distinct = BTreeSet::new();
        let mut places = Vec::new();
        let mut addresses = BTreeSet::new();
        let (mut score, mut good, mut bad, mut echoes) = (0, 0, 0, 0);
        let mut named = false;
        for (index, bytes) in &self.exchanges {
            let Some(reply) = hypothesis.read(*index, bytes) else {
                if !bytes.is_empty() && bytes != self.request(*index) {
                    bad += 1;
                }
                continue;
            };
            good += 1;
            echoes += i32::from(reply.echo);
            score += match distinct.insert(bytes) {
                true => reply.worth,
                false => REPEATED,
            };
            places.extend(place(&reply.values));
            addresses.extend(reply.values.address);
            let width = hypothesis.profile.angle_bits;
            named |= matches!(
                (reply.values.enid, width),
                (Some(0x17), 23) | (Some(0x11), 17)
            );
        }
        score -= (bad * FAILS).min(score / 4 * 3);
        score += if named { NAMED } else { 0 };
        // A shaft that moves would show bits above the narrower encoder's, if there were any.
        let top = hypothesis.profile.angle_bits - 1;
        let seen: BTreeSet<u64> = places.iter().map(|(_, angle)| *angle).collect();
        if hypothesis.profile.format == Format::T485
            && !seen.iter().any(|angle| bits::bit(*angle, top))
        {
            score -= UNUSED_BIT * i32::try_from(seen.len().min(UNUSED_MOST)).unwrap_or(0);
        }
        if good == 0 || score < CHANCE {
            return None;
        }
        let mut evidence = Vec::from([text!(
            "{} of {} replies have the right length and check, {} of them distinct",
            good,
            good + bad,
            distinct.len()
        )]);
        if named {
            evidence.push(text!(
                "the encoder identity says {} bits",
                hypothesis.profile.angle_bits
            ));
        }
        if echoes > 0 {
            evidence.push(t("the adapter echoes what it sends").to_string());
        }
        let addresses: Vec<u8> = addresses.into_iter().collect();
        let mut profile = hypothesis.profile;
        if let (Format::Bus, Some(first)) = (profile.format, addresses.first()) {
            profile.address = u32::from(*first);
            let list: Vec<String> = addresses.iter().map(ToString::to_string).collect();
            evidence.push(text!("answers at address {}", list.join(", ")));
        }
        let narrowest = width(&mut profile, &places, &mut evidence);
        let count = i32::try_from(distinct.len()).unwrap_or(i32::MAX);
        Some(Found {
            verdict: Verdict::of(score, count),
            profile,
            evidence,
            narrowest,
            addresses,
            score,
        })
    }
}

/// The profile with which most replies to the requests of `profile` are good, where it is another
/// one: of the same format, and with the same command.
pub(crate) fn explain_replies(profile: &Profile, replies: &[(&[u8], &[u8])]) -> Option<Profile> {
    let profiles = match profile.format {
        Format::T485 => t485(),
        _ => native(profile.format),
    };
    profiles
        .into_iter()
        .map(|other| Profile {
            angle_bits: other.angle_bits,
            turns_bits: other.turns_bits,
            ..*profile
        })
        .filter(|other| other != profile)
        .find(|other| {
            let good = |decoder: &Decoder, ask: &Ask| {
                let holds = |reply: &[u8]| ask.is_answered_by(decoder, reply);
                let good = replies.iter().filter(|(request, reply)| {
                    holds(reply) || reply.strip_prefix(*request).is_some_and(holds)
                });
                good.count()
            };
            let decoder = Decoder::new(*other).ok();
            let ask = decoder
                .as_ref()
                .and_then(|decoder| Ask::position(decoder).ok());
            let good = decoder
                .zip(ask)
                .map_or(0, |(decoder, ask)| good(&decoder, &ask));
            good >= PROVING && good * 2 > replies.len()
        })
}

/// The widths that T485 comes in.
fn t485() -> Vec<Profile> {
    let widths = [23, 17].map(|angle_bits| Profile {
        angle_bits,
        ..Format::T485.default_profile()
    });
    widths.into()
}

/// Two and three bytes of angle, with turns and without.
fn native(format: Format) -> Vec<Profile> {
    let widths = [THREE_BYTES.1, TWO_BYTES].into_iter();
    widths
        .flat_map(|angle_bits| {
            [16, 0].map(|turns_bits| Profile {
                angle_bits,
                turns_bits,
                ..format.default_profile()
            })
        })
        .collect()
}

/// The streams that bytes which came unasked may be: `total` of them within `took` microseconds.
pub(crate) fn streams(baud: u32, bytes: &[u8], total: usize, took: Micros) -> Vec<Found> {
    let dump = Dump::of_bytes(bytes);
    let ip75 = [(Format::Asi1, 14), (Format::Asi1, 22), (Format::Asi4, 14)];
    let ip75 = ip75.map(|(format, angle_bits)| Profile {
        angle_bits,
        ..format.default_profile()
    });
    let period = native(Format::Period)
        .into_iter()
        .map(|profile| Profile { baud, ..profile });
    let profiles = ip75
        .into_iter()
        .filter(|profile| profile.baud == baud)
        .chain(period);
    let mut found: Vec<Found> = profiles
        .filter_map(|profile| stream(profile, &dump, total, took))
        .collect();
    found.retain(|found| found.score >= CHANCE);
    found
}

fn stream(profile: Profile, dump: &Dump, total: usize, took: Micros) -> Option<Found> {
    let candidate = detect::weigh(profile, dump)?;
    let decoder = Decoder::new(profile).ok()?;
    let mut places = Vec::new();
    let (mut lengths, mut frames) = (0, 0);
    decoder.dump(dump, &mut |decoded| {
        if let Decoded::Frame(frame) = decoded
            && frame.ok()
        {
            places.extend(place(&frame.values()));
            lengths += frame.bits.len() as u64 / 8;
            frames += 1;
        }
    });
    let mut evidence = candidate.evidence;
    let mut score = candidate.score;
    if profile.format == Format::Asi4 && frames > 20 {
        score += TEXT;
        evidence.push(text!("{} lines of digits, each with CR and LF", frames));
    }
    let interval = profile.format.interval()?;
    // As many frames as all bytes would make.
    let made = (total as u64 * frames).checked_div(lengths)?;
    let due = took / interval;
    if made.abs_diff(due) <= due / 5 {
        score += PACED;
        evidence.push(text!(
            "{} frames a second, as its manual says",
            made * 1_000_000 / took.max(1)
        ));
    }
    let mut profile = profile;
    let narrowest = width(&mut profile, &places, &mut evidence);
    let distinct = places.iter().collect::<BTreeSet<_>>().len();
    Some(Found {
        verdict: Verdict::of(score, i32::try_from(distinct).unwrap_or(i32::MAX)),
        profile,
        evidence,
        narrowest,
        addresses: Vec::new(),
        score,
    })
}

/// Turns and angle; without a counter the turns are 0.
type Place = (i64, u64);

fn place(values: &Values) -> Option<Place> {
    Some((values.turns.unwrap_or(0), values.angle?))
}

/// The fewest bits per turn that the angles fit in; a profile in three bytes takes them over
/// when the angle was seen to wrap.
fn width(profile: &mut Profile, places: &[Place], evidence: &mut Vec<String>) -> u32 {
    let open = matches!(profile.format, Format::Rs485 | Format::Bus | Format::Period);
    if !open || profile.angle_bits != THREE_BYTES.1 {
        return profile.angle_bits;
    }
    let most = places.iter().map(|(_, angle)| *angle).max().unwrap_or(0);
    let used = (1..=THREE_BYTES.1).find(|width| bits::above(most, *width) == 0);
    let narrowest = used.unwrap_or(THREE_BYTES.1).max(THREE_BYTES.0);
    let turn = bits::codes(narrowest) as u64;
    let counts = profile.turns_bits > 0;
    let jumps = places.windows(2).any(|pair| {
        let [(turns, angle), (next_turns, next)] = [pair[0], pair[1]];
        angle.abs_diff(next) > turn / 4 * 3 && counts == (turns != next_turns)
    });
    // A shaft that turns is seen on the other side of a turn as well.
    let sweeps = places
        .iter()
        .any(|(_, angle)| angle.abs_diff(turn / 2) < turn / 4);
    if jumps && sweeps {
        profile.angle_bits = narrowest;
        evidence.push(text!("the angle wraps after {} bits", narrowest));
    } else if narrowest < profile.angle_bits {
        evidence.push(text!(
            "the angles seen fit in {} bits: turn the shaft by a whole turn, or take the \
             bits per turn from the order code",
            narrowest
        ));
    }
    narrowest
}
