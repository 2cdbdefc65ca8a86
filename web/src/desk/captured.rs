//! Recordings of a logic analyser: their frames, and what is wrong with their timing.

use crate::message::Count;
use encoderscope::{
    capture::{Clocked, Clocking, Kind, Options, Recording, Unreadable, Violation},
    decode::Decoder,
    detect::Detection,
    dump::Dump,
    format::{Format, Link},
    profile::Profile,
};

/// What was found out about a recording.
#[derive(Debug, Default)]
pub(super) struct Captured {
    /// Which wires there are, and what else is to be said.
    pub(super) notes: Vec<String>,
    /// What is wrong with the timing of each frame.
    violations: Vec<Vec<Violation>>,
}

/// Reads the recording with the profile, or where no master clocks that, as BiSS-C where there are
/// acknowledges, else as the SSI whose words have so many bits.
fn recording(text: &[u8], kind: Kind, profile: Option<Profile>) -> Result<Recording, Unreadable> {
    let clocked = profile.filter(|profile| profile.link() == Link::Clocked);
    let profiles = match clocked {
        Some(profile) => vec![profile],
        None => [Format::BissC, Format::Ssi]
            .map(Format::default_profile)
            .into(),
    };
    let mut best = Err(Unreadable::Signals(0));
    for profile in profiles {
        let Ok(decoder) = Decoder::new(profile) else {
            continue;
        };
        best = Recording::read(text, kind, &decoder, Options::default());
        let Ok(read) = &best else {
            break;
        };
        if clocked.is_none() && is_biss(read) {
            return best;
        }
    }
    match (clocked, best.as_ref().ok().and_then(word)) {
        (None, Some(profile)) => match Decoder::new(profile) {
            Ok(decoder) => Recording::read(text, kind, &decoder, Options::default()),
            Err(_) => best,
        },
        _ => best,
    }
}

/// Whether every frame begins with the idle line, an acknowledge of one length, start and cds.
fn is_biss(read: &Recording) -> bool {
    const LONG_ACK: usize = 3;
    let acknowledge = |frame: &Clocked| {
        let bits = frame.bits.as_bits();
        let run = |from: usize, level: bool| {
            let rest = from..bits.len();
            rest.take_while(|at| bits.bit(*at) == level).count()
        };
        let idle = run(0, true);
        let ack = run(idle, false);
        let start = idle + ack;
        let is_start = bits.bit(start) && start + 1 < bits.len() && !bits.bit(start + 1);
        (idle > 0 && ack >= LONG_ACK && is_start).then_some(ack)
    };
    let first = read.frames.first().and_then(acknowledge);
    let mut frames = read.frames.iter();
    first.is_some() && frames.all(|frame| acknowledge(frame) == first) && holds_check(read)
}

/// Whether BiSS-C explains the first frames best: a word of SSI with few turns begins with zeros
/// and a one as well.
fn holds_check(read: &Recording) -> bool {
    const ENOUGH: usize = 64;
    let frames = read.frames.iter().take(ENOUGH);
    let dump = Dump::of_lines(frames.map(|frame| (frame.bits.clone(), None)));
    let mut detection = Detection::new(&dump, &dump, &dump);
    while detection.step() {}
    let found = detection.candidates();
    found
        .first()
        .is_some_and(|best| best.profile.format == Format::BissC)
}

/// The SSI profile whose words have as many bits as most words of a recording.
fn word(read: &Recording) -> Option<Profile> {
    let bits = read.frames.iter().map(|frame| frame.bits.as_bits().len());
    let mut bits: Vec<usize> = bits.collect();
    bits.sort_unstable();
    let bits = *bits.get(bits.len() / 2)?;
    let text = |bits: usize| bits.to_string();
    let pairs = match bits {
        13 => vec![("format", "ssi-tree".to_owned()), ("turns-bits", text(0))],
        25 => vec![("format", "ssi-tree".to_owned())],
        30 => vec![("format", "ssi7".to_owned())],
        // Error, warning and six status bits, and turns in front of long words.
        24..=32 => vec![
            ("format", "ssi".to_owned()),
            ("turns-bits", text(0)),
            ("angle-bits", text(bits - 8)),
        ],
        40..=48 => vec![
            ("format", "ssi".to_owned()),
            ("angle-bits", text(bits - 24)),
        ],
        _ => vec![
            ("format", "ssi-tree".to_owned()),
            ("align", "right".to_owned()),
            ("frame-bits", text(bits)),
        ],
    };
    Profile::parse(pairs.iter().map(|(name, value)| (*name, value.as_str()))).ok()
}

impl Captured {
    /// Reads a recording; what it holds as a dump, and the profile that reads it.
    ///
    /// # Errors
    ///
    /// There are no clock and data in it; says why.
    pub(super) fn read(
        text: &[u8],
        kind: Kind,
        profile: Option<Profile>,
    ) -> Result<(Self, Dump, Profile), String> {
        let read = recording(text, kind, profile)
            .map_err(|why| format!("The recording cannot be read: {why}."))?;
        let mut notes: Vec<String> = read.wires.reasons.iter().map(ToString::to_string).collect();
        if profile.is_none_or(|profile| profile.link() != Link::Clocked) {
            notes.push("The word length is taken from the recording: choose the format to have the number of clocks judged.".into());
        }
        if read.clocking == Clocking::Counted {
            notes.push("There are no times in it, so that timing is not judged.".into());
        }
        notes.extend(read.stray.iter().map(ToString::to_string));
        let lines = read
            .frames
            .iter()
            .map(|frame| (frame.bits.clone(), Some(frame.seconds())));
        let dump = Dump::of_lines(lines);
        let violations = read.frames.into_iter().map(|frame| frame.violations);
        Ok((
            Self {
                notes,
                violations: violations.collect(),
            },
            dump,
            read.profile,
        ))
    }

    /// Whether the input is a recording.
    pub(super) const fn is_some(&self) -> bool {
        !self.violations.is_empty()
    }

    /// What is wrong with the timing, by kind.
    pub(super) fn timing(&self) -> Vec<Count> {
        let mut all: Vec<Count> = Vec::new();
        for (index, violations) in self.violations.iter().enumerate() {
            for violation in violations {
                let name = violation.kind.name();
                match all.iter_mut().find(|known| known.name == name) {
                    Some(known) => known.count += 1.0,
                    None => all.push(Count {
                        name: name.into(),
                        count: 1.0,
                        first: index,
                    }),
                }
            }
        }
        all
    }

    /// What is wrong with the timing of a frame.
    pub(super) fn said_of(&self, index: usize) -> Vec<String> {
        let violations = self.violations.get(index).into_iter().flatten();
        violations.map(ToString::to_string).collect()
    }
}
