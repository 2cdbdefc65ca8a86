//! What is wrong with the timing of a capture, and where.

use crate::{
    format::timing::{MICROSECOND, NANOSECOND, SECOND, Timing, Words},
    language::{msg, number, t},
    say,
};
use core::fmt;

/// Something that the manual does not allow, or that no encoder can answer to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation {
    /// When, in picoseconds of the recording.
    pub time: i64,
    /// At which clock of its frame, the first falling edge being 1.
    pub clock: Option<u32>,
    /// What.
    pub kind: ViolationKind,
    /// The limits it is measured by.
    pub timing: &'static Timing,
}

/// What is wrong. Durations are in picoseconds, frequencies in hertz.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ViolationKind {
    /// The clock is slower than the slowest.
    Slow {
        /// Of the clock.
        hertz: f64,
    },
    /// The clock is faster than the fastest.
    Fast {
        /// Of the clock.
        hertz: f64,
    },
    /// The clock is fast, and its first low is too short for that.
    FirstLow {
        /// Of the clock.
        hertz: f64,
        /// Of the first low.
        low: i64,
        /// What it should be.
        needed: i64,
    },
    /// The pause before this frame is too short.
    Pause {
        /// From the last edge of the frame before.
        measured: i64,
    },
    /// The data line becomes high too early or too late after the frame.
    Timeout {
        /// From the last falling edge.
        measured: i64,
    },
    /// The data line does not become high after the frame.
    NotReady {
        /// From the last falling edge to the next frame, or to the end of the recording.
        measured: i64,
    },
    /// The clock rests within a frame for so long that the encoder gives the reading up.
    Aborted {
        /// The rest.
        half: i64,
    },
    /// The clocks are what remains of an aborted reading.
    Remainder,
    /// The frame has too few clocks, or clocks that carry nothing.
    Clocks {
        /// Falling edges.
        falling: u32,
        /// Bits of the word, or of the frame from the acknowledge on.
        word: u32,
        /// Falling edges that it needs.
        needed: u32,
    },
    /// The recording begins or ends within the frame.
    Cut,
    /// The acknowledge is not as long as the profile says.
    Acknowledge {
        /// Zeros.
        bits: u32,
        /// Zeros of the profile.
        expected: u32,
        /// Zeros of the frame before, where they were others.
        before: Option<u32>,
    },
    /// A pulse of the clock far shorter than the others; it is left out of the bits.
    Glitch {
        /// Its width.
        width: i64,
        /// Half a period of the clock.
        half: i64,
    },
    /// Data changes when it is being read.
    LateData {
        /// From the rising edge to the change.
        delay: i64,
        /// From the rising edge to the falling edge that reads the data.
        high: i64,
        /// How often in this frame.
        times: u32,
    },
    /// The data line does not change during a whole frame and after it.
    DataStuck {
        /// Its level.
        level: bool,
    },
    /// The clock rests low instead of high.
    IdleLow,
    /// The clock does not pause.
    Endless {
        /// Clocks without a pause.
        clocks: u32,
    },
}

impl ViolationKind {
    /// The kind in words.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Slow { .. } => msg("clock too slow"),
            Self::Fast { .. } => msg("clock too fast"),
            Self::FirstLow { .. } => msg("first low too short"),
            Self::Pause { .. } => msg("pause too short"),
            Self::Timeout { .. } => msg("time-out out of range"),
            Self::NotReady { .. } => msg("encoder not ready"),
            Self::Aborted { .. } => msg("read aborted"),
            Self::Remainder => msg("rest of an aborted read"),
            Self::Clocks { .. } => msg("wrong number of clocks"),
            Self::Cut => msg("cut by the recording"),
            Self::Acknowledge { .. } => msg("acknowledge of another length"),
            Self::Glitch { .. } => msg("glitch on the clock"),
            Self::LateData { .. } => msg("data changes late"),
            Self::DataStuck { .. } => msg("data line stuck"),
            Self::IdleLow => msg("clock rests low"),
            Self::Endless { .. } => msg("clock without a pause"),
        }
    }
}

/// A duration in picoseconds, written without its sign in the unit that suits it.
///
/// ```
/// assert_eq!(encoderscope::capture::Duration(12_500_000).to_string(), "12.5 µs");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Duration(pub i64);

/// Writes `value / unit` with up to two decimals.
fn decimal(f: &mut fmt::Formatter<'_>, value: i128, unit: i128, name: &'static str) -> fmt::Result {
    let hundredths = (value * 100 + unit / 2) / unit;
    let (whole, rest) = (hundredths / 100, hundredths % 100);
    match (rest % 10, rest) {
        (_, 0) => write!(f, "{whole}")?,
        (0, _) => write!(f, "{}", number(format_args!("{whole}.{}", rest / 10)))?,
        _ => write!(f, "{}", number(format_args!("{whole}.{rest:02}")))?,
    }
    write!(f, " {}", t(name))
}

impl fmt::Display for Duration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let picos = i128::from(self.0.unsigned_abs());
        let units = [
            (i128::from(SECOND), msg("s")),
            (i128::from(SECOND / 1000), msg("ms")),
            (i128::from(MICROSECOND), msg("µs")),
            (i128::from(NANOSECOND), msg("ns")),
        ];
        let (unit, name) = units
            .into_iter()
            .find(|(unit, _)| picos >= *unit)
            .unwrap_or((1, msg("ps")));
        decimal(f, picos, unit, name)
    }
}

/// A frequency in hertz, written in the unit that suits it.
///
/// ```
/// assert_eq!(encoderscope::capture::Frequency(1.5e6).to_string(), "1.5 MHz");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frequency(pub f64);

impl fmt::Display for Frequency {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let hertz = self.0 as i128;
        let units = [(1_000_000, msg("MHz")), (1000, msg("kHz")), (1, msg("Hz"))];
        let (unit, name) = units
            .into_iter()
            .find(|(unit, _)| hertz >= *unit)
            .unwrap_or((1, msg("Hz")));
        decimal(f, hertz, unit, name)
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Timing {
            source,
            timeout_text,
            pause_text,
            ..
        } = *self.timing;
        let (source, timeout_text, pause_text) = (t(source), t(timeout_text), t(pause_text));
        let top = |hertz: u32| Frequency(hertz.into());
        match self.kind {
            ViolationKind::Slow { hertz } => say!(
                f,
                "clock of {}: slower than {} ({})",
                Frequency(hertz),
                top(self.timing.slowest),
                source
            ),
            ViolationKind::Fast { hertz } => say!(
                f,
                "clock of {}: faster than {} ({})",
                Frequency(hertz),
                top(self.timing.limit()),
                source
            ),
            ViolationKind::FirstLow { hertz, low, needed } => say!(
                f,
                "clock of {} with a first low of {}: faster than {} needs a first low of {} \
                 ({})",
                Frequency(hertz),
                Duration(low),
                top(self.timing.fastest),
                Duration(needed),
                source
            ),
            ViolationKind::Pause { measured } => say!(
                f,
                "pause of {} before this frame: shorter than {} ({})",
                Duration(measured),
                pause_text,
                source
            ),
            ViolationKind::Timeout { measured } => {
                let (least, _) = self.timing.returns;
                let word = if measured < least {
                    t("only")
                } else {
                    t("as late as")
                };
                say!(
                    f,
                    "the data line is high again {} {} after the last falling edge: the \
                     encoder's time-out is {} ({})",
                    word,
                    Duration(measured),
                    timeout_text,
                    source
                )
            }
            ViolationKind::NotReady { measured } => say!(
                f,
                "the data line is still low {} after the last falling edge: the encoder's \
                 time-out is {} ({})",
                Duration(measured),
                timeout_text,
                source
            ),
            ViolationKind::Aborted { half } => say!(
                f,
                "the clock rests for {} within the frame: longer than {}, the encoder \
                 gives the reading up ({})",
                Duration(half),
                timeout_text,
                source
            ),
            ViolationKind::Remainder => f.write_str(t(
                "the rest of the clocks of the reading given up before: they start a reading of \
                 their own, cut short",
            )),
            ViolationKind::Clocks {
                falling,
                word,
                needed,
            } if falling < needed => match falling.checked_sub(1) {
                Some(bits) if self.clocks_latch() => say!(
                    f,
                    "{} falling edges for a {}-bit word give {} bits: send {} \
                     ({})",
                    falling,
                    word,
                    bits,
                    needed,
                    source
                ),
                _ => say!(
                    f,
                    "{} falling edges: a frame of {} bits from the acknowledge on needs \
                     {} ({})",
                    falling,
                    word,
                    needed,
                    source
                ),
            },
            ViolationKind::Clocks {
                falling,
                word,
                needed,
            } => {
                let again = match self.timing.words {
                    Words::Once => t("the bits behind the word carry nothing"),
                    Words::Ring => t("they do not make the word whole once more"),
                };
                say!(
                    f,
                    "{} falling edges for a {}-bit word, {} more than the {} it \
                     needs: {} ({})",
                    falling,
                    word,
                    falling - needed,
                    needed,
                    again,
                    source
                )
            }
            ViolationKind::Cut => f.write_str(t("the recording begins or ends within this frame")),
            ViolationKind::Acknowledge {
                bits,
                expected,
                before,
            } => {
                say!(
                    f,
                    "acknowledge of {} clocks: {} in the profile",
                    bits,
                    expected
                )?;
                match before {
                    Some(before) => say!(f, ", {} in the frame before", before),
                    None => Ok(()),
                }
            }
            ViolationKind::Glitch { width, half } => say!(
                f,
                "clock pulse of {} where half a period lasts {}: left out of the bits; whether the \
                 encoder counted it, only a checksum tells",
                Duration(width),
                Duration(half)
            ),
            ViolationKind::LateData { delay, high, times } => say!(
                f,
                "data changes {} after the rising edge, the falling edge that reads it comes after \
                 {}, {} times in this frame: lower the clock or shorten the cable ({})",
                Duration(delay),
                Duration(high),
                times,
                source
            ),
            ViolationKind::DataStuck { level } => say!(
                f,
                "the data line stays {} during the whole frame: no encoder answers",
                u8::from(level)
            ),
            ViolationKind::IdleLow => say!(
                f,
                "the clock rests low before this frame: it must rest high ({}); the wire may \
                 be the inverted one of its pair",
                source
            ),
            ViolationKind::Endless { clocks } => say!(
                f,
                "{} clocks without a pause of {} ({})",
                clocks,
                pause_text,
                source
            ),
        }
    }
}

impl Violation {
    /// Whether the first falling edge only latches, so that n bits need n+1.
    fn clocks_latch(&self) -> bool {
        *self.timing != crate::format::biss_c::TIMING
    }
}
