//! Recordings of a logic analyser: their frames, and what is wrong with their timing.

use crate::message::Count;
use encoderscope::{
    capture::{Clocked, Clocking, Recording, Violation},
    dump::Dump,
    language::t,
    profile::Profile,
};

/// Frames of a stretch by which the input is judged.
const STRETCH: usize = 200;

/// What was found out about a recording.
#[derive(Debug, Default)]
pub(super) struct Captured {
    /// Which wires there are, and what else is to be said.
    pub(super) notes: Vec<String>,
    /// The front, the middle and the end of the frames, by which it is judged what they are.
    pub(super) sample: Dump,
    /// What is wrong with the timing of each frame.
    violations: Vec<Vec<Violation>>,
    /// How often what is wrong, by kind.
    pub(super) timing: Vec<Count>,
    /// Of frames that are too short to be shown.
    waiting: Vec<Violation>,
}

/// Bits of the acknowledge of a frame that begins with the idle line, an acknowledge, start and
/// cds.
pub(super) fn acknowledge(frame: &Clocked) -> Option<usize> {
    const LONG_ACK: usize = 3;
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
}

/// The SSI profile whose words have as many bits as most words of a recording.
pub(super) fn word(read: &Recording) -> Option<Profile> {
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

/// Stretches of the frames.
fn sample(frames: &[Clocked]) -> Dump {
    let last = frames.len().saturating_sub(STRETCH);
    let taken = |at: usize| at < STRETCH || at >= last || at.abs_diff(last / 2) < STRETCH / 2;
    let frames = frames.iter().enumerate().filter(|(at, _)| taken(*at));
    Dump::of_lines(frames.map(|(_, frame)| (frame.bits.clone(), Some(frame.seconds()))))
}

impl Captured {
    /// What is to be said of a recording whose format was chosen, or else guessed.
    pub(super) fn new(read: &Recording, chosen: Option<Profile>) -> Self {
        let mut notes: Vec<String> = read.wires.reasons.iter().map(ToString::to_string).collect();
        if chosen.is_none() {
            notes.push(t("The word length is taken from the recording: choose the format to have the number of clocks judged.").into());
        }
        if read.clocking == Clocking::Counted {
            notes.push(t("There are no times in it, so that timing is not judged.").into());
        }
        notes.extend(read.stray.iter().map(ToString::to_string));
        Self {
            notes,
            sample: sample(&read.frames),
            ..Self::default()
        }
    }

    /// Takes what is wrong with the next frame; whether the frame has bits, so that it is shown.
    ///
    /// What is wrong with a frame without bits is told of with the next one.
    pub(super) fn take(&mut self, frame: &mut Clocked) -> bool {
        self.waiting.append(&mut frame.violations);
        if frame.bits.as_bits().is_empty() {
            return false;
        }
        let violations = std::mem::take(&mut self.waiting);
        for violation in &violations {
            let name = t(violation.kind.name());
            match self.timing.iter_mut().find(|known| known.name == name) {
                Some(known) => known.count += 1.0,
                None => self.timing.push(Count {
                    name: name.into(),
                    count: 1.0,
                    first: self.violations.len(),
                }),
            }
        }
        self.violations.push(violations);
        true
    }

    /// Says that there are no more frames.
    pub(super) fn finish(&mut self) {
        let waiting = std::mem::take(&mut self.waiting);
        self.notes.extend(waiting.iter().map(ToString::to_string));
    }

    /// Whether the input is a recording.
    pub(super) const fn is_some(&self) -> bool {
        !self.violations.is_empty()
    }

    /// What is wrong with the timing of a frame.
    pub(super) fn said_of(&self, index: usize) -> Vec<String> {
        let violations = self.violations.get(index).into_iter().flatten();
        violations.map(ToString::to_string).collect()
    }
}
