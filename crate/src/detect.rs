//! What a dump may be: every format at every width, ranked by evidence.
//!
//! Evidence is counted in bits. A frame whose check holds is worth its checksum, once for each
//! distinct frame, since a still shaft repeats itself. A position that goes on from those before
//! it is worth what its bits would cost without knowing so; that alone finds formats without a
//! check, and tells turns from angle. What does not fit counts against, and so does an encoder
//! that no manual describes. One frame alone is never certain: a CRC-6 holds by chance once in
//! 64 frames, a CRC-8 once in 256. What cannot be decided is said to be ambiguous, with what
//! would decide it.
//!
//! Where nothing fits, the usual mistakes of a capture are undone one by one ([`Change`]), and
//! an unknown checksum is looked for.

mod change;
mod counted;
mod hypotheses;
mod motion;
mod near;
mod rank;
mod sample;
mod unknown;
mod weigh;

pub use change::Change;
pub(crate) use counted::check_width;
pub use near::{Near, near};
pub(crate) use weigh::weigh;

use crate::{
    dump::{self, Dump},
    format::Medium,
    language::msg,
    profile::Profile,
    record::Record,
};
use alloc::{collections::VecDeque, string::String, vec::Vec};
use motion::Motion;
use sample::Sample;

/// Bits of evidence for each verdict, and the lead that sets a candidate apart.
const CERTAIN: i32 = 40;
pub(crate) const LIKELY: i32 = 8;
pub(crate) const LEAD: i32 = 4;
/// What a mistake of the capture must make up for.
const CHANGED: i32 = 6;

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
            Self::Certain => msg("certain"),
            Self::Likely => msg("likely"),
            Self::Ambiguous => msg("ambiguous"),
            Self::Unlikely => msg("unlikely"),
        }
    }
}

/// Something that a dump may be.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// How to read it.
    pub profile: Profile,
    /// How sure that is.
    pub verdict: Verdict,
    /// Why, in sentences; what would decide between this and others is said last.
    pub evidence: Vec<String>,
    /// What must be done to the dump first.
    pub change: Option<Change>,
    pub(crate) score: i32,
    /// How many distinct frames are good.
    distinct: i32,
    /// Whether the frames have a check.
    checked: bool,
    motion: Motion,
    /// Equal where all readings are.
    reads: u64,
    /// Bytes of good frames, and of none.
    covered: u64,
    strange: u64,
    /// Whether the frames fit, but what they say is odd.
    untidy: bool,
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        (self.profile, self.verdict, self.change) == (other.profile, other.verdict, other.change)
            && self.evidence == other.evidence
    }
}

impl Candidate {
    /// The candidate on a dump after a change.
    fn after(mut self, change: Change) -> Self {
        self.change = Some(change);
        self.score -= CHANGED;
        self.evidence.insert(0, change.sentence());
        self
    }

    /// The record of a candidate: its profile, verdict, evidence, and what must be changed.
    #[must_use]
    pub fn record(&self) -> Record {
        let record = self
            .profile
            .record()
            .with("verdict", self.verdict.name())
            .with("evidence", self.evidence.clone());
        match self.change {
            Some(change) => record.with("change", change.name()),
            None => record,
        }
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
    let mut detection = Detection::of_text(text);
    while detection.step() {}
    detection.candidates()
}

/// A detection in steps, each short enough for a page or a worker to stay awake.
///
/// ```
/// use encoderscope::detect::Detection;
/// let mut detection = Detection::of_text("02 20 b4 bd 1c 37\n02 20 50 a9 78 a3");
/// while detection.step() {}
/// assert_eq!(detection.candidates()[0].profile.format.name(), "t485");
/// ```
#[derive(Clone, Debug)]
pub struct Detection {
    sample: Sample,
    /// What is still to be tried on the dump, as it is or after a change.
    queue: VecDeque<Profile>,
    changed: Option<(Change, Sample)>,
    changes: VecDeque<Change>,
    /// Whether the checksum is still to be searched.
    unknown: bool,
    found: Vec<Candidate>,
}

impl Detection {
    /// A detection on the same text parsed as bytes, as bits and as text.
    ///
    /// Of more than 256 kB three stretches are looked at: the front, the middle and the end.
    #[must_use]
    pub fn new(bytes: &Dump, bits: &Dump, text: &Dump) -> Self {
        let sample = Sample::new(bytes, bits, text);
        Self {
            queue: hypotheses::of(&sample).into(),
            changes: near::changes(&sample).into(),
            sample,
            changed: None,
            unknown: true,
            found: Vec::new(),
        }
    }

    /// A detection on a pasted text.
    #[must_use]
    pub fn of_text(text: &str) -> Self {
        let parse = |medium| dump::parse(text, medium);
        Self::new(
            &parse(Medium::Bytes),
            &parse(Medium::Bits),
            &parse(Medium::Text),
        )
    }

    /// Tries the next profile; `false` when there is nothing more to try.
    pub fn step(&mut self) -> bool {
        if let Some(profile) = self.queue.pop_front() {
            let found = match &self.changed {
                None => rank::tried(profile, &self.sample),
                Some((change, front)) => rank::tried(profile, front)
                    .filter(rank::is_strong)
                    .and_then(|_| rank::tried(profile, &self.sample.changed(*change)))
                    .map(|candidate| candidate.after(*change)),
            };
            self.found.extend(found);
            return true;
        }
        let best = self.found.iter().max_by_key(|candidate| candidate.score);
        if best.is_some_and(rank::is_settled) {
            return false;
        }
        if let Some(change) = self.changes.pop_front() {
            let sample = self.sample.front().changed(change);
            self.queue = hypotheses::of(&sample).into();
            self.changed = Some((change, sample));
            return true;
        }
        if core::mem::take(&mut self.unknown) && !self.found.iter().any(rank::is_strong) {
            self.found.extend(unknown::layouts(&self.sample));
            return true;
        }
        false
    }

    /// How many profiles are still to be tried before the next kind of mistake is looked at.
    #[must_use]
    pub fn left(&self) -> usize {
        self.queue.len()
    }

    /// What was found so far, best first.
    #[must_use]
    pub fn candidates(&self) -> Vec<Candidate> {
        rank::ranked(self.found.clone())
    }
}
