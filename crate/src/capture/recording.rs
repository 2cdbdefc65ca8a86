//! A recording of a logic analyser, from its text to frames.

use super::{
    Capture, Change, Clocked, Clocking, Edge, Reason, Signal, Violation, Wire, Wires,
    samples::Samples, wires::choose,
};
use crate::{decode::Decoder, profile::Profile};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};
use core::fmt;

/// Signals of a recording that are read.
pub(super) const MOST_SIGNALS: usize = 1024;
/// Frames of a recording that are kept.
const MOST_FRAMES: usize = 200_000;

/// What a recording is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Value change dump, IEEE 1364 (sigrok, PulseView, simulators).
    Vcd,
    /// Rows of levels (Saleae, sigrok-cli, Xilinx ILA, anything else in columns).
    Samples,
}

/// What a user may say of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options<'a> {
    /// Name of the clock.
    pub clock: Option<&'a str>,
    /// Name of the data.
    pub data: Option<&'a str>,
    /// Picoseconds from one row to the next, where rows have no time.
    pub sample: Option<i64>,
}

/// Why a recording cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unreadable {
    /// No master clocks this format.
    NotClocked(&'static str),
    /// There are not two signals; says how many.
    Signals(usize),
    /// More signals than are read.
    TooManySignals,
    /// More frames than are kept.
    TooManyFrames,
    /// A signal that was asked for, and those there are.
    NoSuchSignal(String, Vec<String>),
    /// The time of a line cannot be read, or is out of all bounds.
    Time(u64),
    /// The time of a line is before that of the line above.
    Backwards(u64),
    /// A line is too long.
    LongLine(u64),
    /// Scopes are too deep at a line.
    Deep(u64),
    /// What the VCD reader says.
    Vcd(String),
    /// This build reads no VCD.
    NoVcd,
}

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotClocked(title) => write!(
                f,
                "{title} has no clock: a capture of clock and data is one of SSI or BiSS-C"
            ),
            Self::Signals(0) => f.write_str("no signal of 0 and 1 in it"),
            Self::Signals(count) => {
                write!(f, "{count} signal of 0 and 1 in it: clock and data are two")
            }
            Self::TooManySignals => write!(
                f,
                "more than {MOST_SIGNALS} signals: export the clock and the data only"
            ),
            Self::TooManyFrames => write!(
                f,
                "more than {MOST_FRAMES} frames: export a shorter part of the recording"
            ),
            Self::NoSuchSignal(name, known) => {
                write!(f, "no signal {name:?}; there are: {}", known.join(", "))
            }
            Self::Time(line) => write!(f, "line {line}: the time cannot be read or is too far off"),
            Self::Backwards(line) => write!(f, "line {line}: the time runs backwards"),
            Self::LongLine(line) => write!(f, "line {line} is too long for a recording"),
            Self::Deep(line) => write!(f, "line {line}: scopes within scopes without end"),
            Self::Vcd(message) => write!(f, "VCD: {message}"),
            Self::NoVcd => f.write_str("VCD is not read here"),
        }
    }
}

/// What a reader knows at the end of a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    /// Names of the signals, in the order of their indexes.
    pub names: Vec<String>,
    /// Signals that turned out to hold more than 0 and 1.
    pub others: Vec<usize>,
    /// What the times are worth.
    pub clocking: Clocking,
    /// When the recording ended.
    pub end: i64,
}

/// A recording, read.
///
/// ```
/// use encoderscope::{capture::{Options, Recording, sniff}, decode::Decoder, profile::Profile};
/// let profile = Profile::parse([
///     ("format", "ssi-tree"), ("turns-bits", "0"), ("angle-bits", "2"), ("frame-bits", "2"),
/// ])?;
/// let text = b"Time [s],Channel 0,Channel 1\n0,1,1\n0.000050,0,1\n0.000051,1,1\n\
///     0.000052,0,1\n0.000053,1,0\n0.000054,0,0\n0.000055,1,0\n0.000074,1,1\n0.0001,1,1\n";
/// let kind = sniff(text).expect("a capture");
/// let decoder = Decoder::new(profile)?;
/// let recording = Recording::read(text, kind, &decoder, Options::default()).unwrap();
/// assert_eq!(recording.wires.clock.name, "Channel 0");
/// assert_eq!(recording.frames[0].bits.as_bits().bytes(), [0b1000_0000]);
/// assert_eq!((recording.frames[0].seconds(), &recording.frames[0].violations[..]), (5e-5, &[][..]));
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// All signals.
    pub signals: Vec<Signal>,
    /// Which of them are clock and data, and why.
    pub wires: Wires,
    /// What the times are worth: with [`Clocking::Counted`] they count rows, and timing is not
    /// judged.
    pub clocking: Clocking,
    /// The profile that reads the bits of the frames.
    pub profile: Profile,
    /// The frames.
    pub frames: Vec<Clocked>,
    /// What is wrong outside of any frame.
    pub stray: Vec<Violation>,
}

/// Whether text that begins with `head` is a recording of a logic analyser, and of which kind.
///
/// Rows must have at least two columns of nothing but 0 and 1, under a heading or beside a time;
/// so a table of decoded bytes is none, and neither are strings of 0 and 1.
#[must_use]
pub fn sniff(head: &[u8]) -> Option<Kind> {
    let text = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
    let text = text.trim_ascii_start();
    const WORDS: &[&[u8]] = &[
        b"$date",
        b"$version",
        b"$timescale",
        b"$comment",
        b"$scope",
        b"$var",
    ];
    if WORDS.iter().any(|word| text.starts_with(word)) {
        return Some(Kind::Vcd);
    }
    Samples::sniff(head).then_some(Kind::Samples)
}

impl Recording {
    /// Reads a whole recording.
    ///
    /// # Errors
    ///
    /// The format has no clock, there are not two signals or not those asked for, or the text
    /// breaks the rules of its kind; says where.
    pub fn read(
        text: &[u8],
        kind: Kind,
        decoder: &Decoder,
        options: Options<'_>,
    ) -> Result<Self, Unreadable> {
        let title = decoder.profile().format.title();
        let capture = Capture::new(decoder).ok_or(Unreadable::NotClocked(title))?;
        let mut signals: Vec<Signal> = Vec::new();
        let (mut finest, mut last) = (i64::MAX, None);
        let named = pass(text, kind, options, &mut |change| {
            if signals.len() <= change.signal {
                signals.resize_with(change.signal.min(MOST_SIGNALS) + 1, || Signal::new(""));
            }
            if let Some(signal) = signals.get_mut(change.signal) {
                signal.change(change.time, change.level);
            }
            if let Some(last) = last.replace(change.time).filter(|last| *last < change.time) {
                finest = finest.min(change.time.saturating_sub(last));
            }
        })?;
        signals.resize_with(named.names.len(), || Signal::new(""));
        for (signal, name) in signals.iter_mut().zip(&named.names) {
            signal.name.clone_from(name);
            signal.finish(named.end);
        }
        for other in &named.others {
            if let Some(signal) = signals.get_mut(*other) {
                *signal = Signal::new(&signal.name);
            }
        }
        let find = |asked: Option<&str>| {
            let Some(name) = asked else { return Ok(None) };
            let found = signals.iter().position(|signal| signal.name == name);
            let missing = || Unreadable::NoSuchSignal(name.to_string(), named.names.clone());
            found.map(Some).ok_or_else(missing)
        };
        let asked = (find(options.clock)?, find(options.data)?);
        let lives = signals.iter().filter(|signal| signal.lives()).count();
        let mut wires = choose(&signals, asked).ok_or(Unreadable::Signals(lives.min(1)))?;
        // What lies between two changes is a bound of what the recorder tells apart.
        let clocking = match named.clocking {
            Clocking::Timed(0) if finest < i64::MAX => Clocking::Timed(finest),
            other => other,
        };
        let capture = capture.with_clocking(clocking);
        let profile = capture.profile();
        let mut frames;
        let mut stray;
        loop {
            let mut low = 0usize;
            (frames, stray) = extract(capture.clone(), &wires, named.end, &mut low, |sink| {
                pass(text, kind, options, sink).map(|_| ())
            })?;
            let line = signals.get(wires.data.signal);
            let lives = line.is_some_and(|line| line.edges > 0);
            if wires.data.inverted || !lives || low * 2 <= frames.len() {
                break;
            }
            wires.data.inverted = true;
            let name = wires.data.name.clone();
            wires.reasons.push(Reason::DataRestsLow(name));
        }
        Ok(Self {
            signals,
            wires,
            clocking,
            profile,
            frames,
            stray,
        })
    }
}

type Sink<'a> = &'a mut dyn FnMut(Change);

/// All changes of a recording.
fn pass(
    text: &[u8],
    kind: Kind,
    options: Options<'_>,
    sink: Sink<'_>,
) -> Result<Named, Unreadable> {
    match kind {
        Kind::Samples => {
            let mut samples = Samples::new(options.sample);
            samples.push(text, sink)?;
            samples.finish(sink)
        }
        #[cfg(feature = "vcd")]
        Kind::Vcd => super::vcd::read(text, sink),
        #[cfg(not(feature = "vcd"))]
        Kind::Vcd => Err(Unreadable::NoVcd),
    }
}

/// The frames on two wires; counts those that the data line is low before.
fn extract(
    mut capture: Capture,
    wires: &Wires,
    end: i64,
    low: &mut usize,
    run: impl FnOnce(Sink<'_>) -> Result<(), Unreadable>,
) -> Result<(Vec<Clocked>, Vec<Violation>), Unreadable> {
    let mut frames = Vec::new();
    let mut drain = |capture: &mut Capture, frames: &mut Vec<Clocked>| {
        while let Some((frame, high)) = capture.next() {
            *low += usize::from(!high);
            // One more shows that there are too many.
            if frames.len() <= MOST_FRAMES {
                frames.push(frame);
            }
        }
    };
    run(&mut |change| {
        for (wire, used) in [(Wire::Clock, &wires.clock), (Wire::Data, &wires.data)] {
            if used.signal == change.signal {
                capture.push(Edge {
                    time: change.time,
                    wire,
                    level: change.level != used.inverted,
                });
            }
        }
        drain(&mut capture, &mut frames);
    })?;
    capture.finish(end);
    drain(&mut capture, &mut frames);
    if frames.len() > MOST_FRAMES {
        return Err(Unreadable::TooManyFrames);
    }
    Ok((frames, capture.stray()))
}
