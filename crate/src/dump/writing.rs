//! What kind of writing a text is.

use super::{offsets::Offsets, table::Table};
use crate::language::{msg, t};
use alloc::string::{String, ToString};
use core::fmt;

/// What kind of writing a text was taken for.
///
/// ```
/// use encoderscope::{dump::parse, format::Medium};
/// let text = "00000000  1a 20 29 c0 3b 17 00 00  00 c8 37                 |. ).;......|\n";
/// assert_eq!(parse(text, Medium::Bytes).writing().name(), "hexdump -C");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Writing {
    pub(super) form: Form,
    pub(super) digits: Digits,
    /// It could be decimal as well.
    pub(super) undecided: bool,
    /// How many digits most of its tokens have.
    pub(super) unit: Option<usize>,
    pub(super) times: Times,
    pub(super) directed: bool,
    pub(super) quotes: Quotes,
    /// Quoted-printable, as mail programs send text.
    pub(super) printable: bool,
    /// In a programming language.
    pub(super) source: bool,
}

/// How lines are made up.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Form {
    #[default]
    Free,
    Offsets(Offsets),
    Table(Table),
    /// Annotations of sigrok's decoders.
    Annotations,
    /// Nobody has written it.
    Captured,
    /// The bytes themselves.
    Binary,
}

/// What the digits are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Digits {
    #[default]
    Hexadecimal,
    Decimal,
    Binary,
    /// Lines of decimal numbers that stand for themselves.
    Numbers,
}

/// Which times in front of lines are no data.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Times {
    #[default]
    None,
    /// Those that cannot be bytes.
    Strong,
    /// All.
    Any,
}

/// How many marks of quoted text lines may begin with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Quotes {
    #[default]
    None,
    /// So many; what follows marks directions.
    Levels(usize),
    Any,
}

impl Writing {
    pub(super) fn binary() -> Self {
        Self {
            form: Form::Binary,
            ..Self::default()
        }
    }

    pub(super) fn captured() -> Self {
        Self {
            form: Form::Captured,
            digits: Digits::Binary,
            ..Self::default()
        }
    }

    /// The kind in words.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match &self.form {
            Form::Offsets(offsets) => offsets.name(),
            Form::Table(table) => table.name(),
            Form::Annotations => msg("sigrok annotations"),
            Form::Captured => msg("captured bits"),
            Form::Binary => msg("plain bytes"),
            Form::Free if self.times != Times::None => msg("terminal log with times"),
            Form::Free if self.source => msg("source code"),
            Form::Free if self.directed => msg("terminal log"),
            Form::Free => self.digits.name(),
        }
    }
}

impl Digits {
    const fn name(self) -> &'static str {
        match self {
            Self::Hexadecimal => msg("hexadecimal"),
            Self::Decimal => msg("decimal"),
            Self::Binary => msg("strings of 0 and 1"),
            Self::Numbers => msg("lines of numbers"),
        }
    }
}

impl fmt::Display for Writing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text: String = t(self.name()).to_string();
        let digits = t(self.digits.name());
        if matches!(self.form, Form::Free) && text != digits && !self.source {
            text.push_str(", ");
            text.push_str(digits);
        }
        if self.quotes != Quotes::None || self.printable {
            text.push_str(t(", quoted in an e-mail"));
        }
        if self.undecided {
            text.push_str(t(", though decimal would fit too"));
        }
        f.write_str(&text)
    }
}
