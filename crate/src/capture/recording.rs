//! A recording of a logic analyser, from its text to frames.

use super::{
    Clocked, Clocking, Extraction, Reader, Signal, Violation, Wires, extraction::MOST_FRAMES,
    samples::Samples,
};
use crate::{decode::Decoder, language::t, profile::Profile, say};
use alloc::{string::String, vec::Vec};
use core::fmt;

/// Signals of a recording that are read.
pub(super) const MOST_SIGNALS: usize = 1024;

/// Bytes of text that are read at a time.
const PIECE: usize = 1024 * 1024;

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
    /// The changes need more than so many bytes.
    TooManyChanges(usize),
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
            Self::NotClocked(title) => say!(
                f,
                "{} has no clock: a capture of clock and data is one of SSI or BiSS-C",
                title
            ),
            Self::Signals(0) => f.write_str(t("no signal of 0 and 1 in it")),
            Self::Signals(count) => {
                say!(
                    f,
                    "{} signal of 0 and 1 in it: clock and data are two",
                    count
                )
            }
            Self::TooManySignals => say!(
                f,
                "more than {} signals: export the clock and the data only",
                MOST_SIGNALS
            ),
            Self::TooManyFrames => say!(
                f,
                "more than {} frames: export a shorter part of the recording",
                MOST_FRAMES
            ),
            Self::TooManyChanges(room) => say!(
                f,
                "its changes of level need more than {} MB: export a shorter part of the \
                 recording, or the clock and the data only",
                room.div_ceil(1_000_000)
            ),
            Self::NoSuchSignal(name, known) => {
                say!(
                    f,
                    "no signal {}; there are: {}",
                    format_args!("{name:?}"),
                    known.join(", ")
                )
            }
            Self::Time(line) => say!(
                f,
                "line {}: the time cannot be read or is too far off",
                line
            ),
            Self::Backwards(line) => say!(f, "line {}: the time runs backwards", line),
            Self::LongLine(line) => say!(f, "line {} is too long for a recording", line),
            Self::Deep(line) => say!(f, "line {}: scopes within scopes without end", line),
            Self::Vcd(message) => say!(f, "VCD: {}", message),
            Self::NoVcd => f.write_str(t("VCD is not read here")),
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
    /// Reads a whole recording; see [`Reader`] and [`Extraction`] for one that comes in pieces.
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
        if decoder.profile().format.timing().is_none() {
            return Err(Unreadable::NotClocked(title));
        }
        let mut reader = Reader::new(kind, options.sample)?;
        for piece in text.chunks(PIECE) {
            reader.push(piece)?;
        }
        let changes = reader.finish()?;
        let mut extraction = Extraction::new(&changes, decoder, options)?;
        while extraction.step(&changes, usize::MAX)? {}
        Ok(extraction.finish(&changes))
    }
}
