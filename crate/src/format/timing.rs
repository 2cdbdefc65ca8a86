//! What a manual asks of the master that clocks frames out.

/// Picoseconds in a nanosecond.
pub const NANOSECOND: i64 = 1_000;
/// Picoseconds in a microsecond.
pub const MICROSECOND: i64 = 1_000_000;
/// Picoseconds in a second.
pub const SECOND: i64 = 1_000_000_000_000;

/// When a clock may be faster than usual.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// Never.
    Never,
    /// When the first low lasts long enough for the encoder to latch.
    FirstLow {
        /// Hertz.
        fastest: u32,
        /// Picoseconds.
        low: i64,
    },
    /// When the master compensates the delay of drivers and cable.
    Compensated {
        /// Hertz.
        fastest: u32,
    },
}

/// What more clocks than a word has bring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Words {
    /// Nothing.
    Once,
    /// The same word again, a 0 between (multi-transmission).
    Ring,
}

/// How many new positions an encoder takes in a second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Positions {
    /// The manual does not say.
    Unsaid,
    /// So many.
    Of(u32),
    /// More than so many.
    MoreThan(u32),
}

/// Clock and pause of a format. Times are in picoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// Where the manual says so.
    pub source: &'static str,
    /// Lowest clock frequency, hertz.
    pub slowest: u32,
    /// Highest clock frequency, hertz.
    pub fastest: u32,
    /// When the clock may be faster than that.
    pub beyond: Beyond,
    /// How long after the last falling edge the encoder gives a reading up, typically.
    pub timeout: i64,
    /// The shortest and longest time after which the data line must be high again.
    pub returns: (i64, i64),
    /// The time-out as the manual writes it.
    pub timeout_text: &'static str,
    /// The shortest pause of the clock between two readings.
    pub pause: i64,
    /// The pause as the manual writes it.
    pub pause_text: &'static str,
    /// What more clocks than a word has bring.
    pub words: Words,
    /// How many new positions the encoder takes in a second.
    pub positions: Positions,
}

impl Timing {
    /// The highest clock frequency there is, whatever its condition, in hertz.
    #[must_use]
    pub const fn limit(&self) -> u32 {
        match self.beyond {
            Beyond::Never => self.fastest,
            Beyond::FirstLow { fastest, .. } | Beyond::Compensated { fastest } => fastest,
        }
    }

    /// A silence of the clock from which on an encoder may have given the reading up.
    #[must_use]
    pub const fn silence(&self) -> i64 {
        if self.returns.0 > 0 {
            self.returns.0
        } else {
            self.timeout
        }
    }
}
