//! Order codes: from the label on the encoder to a profile.
//!
//! `MPP-20-30-A-24BM-R-N-A-M`: series – rotor – stator – output – resolution – interface –
//! supply – temperature – option (MPP and PT, order code). [`FORMS`] has the tables: reading,
//! writing and all messages come from them.
//!
//! Besides whole codes there are the short forms of the manuals: `17BM-T`, `24M-D`, and `17M`
//! alone for BiSS-C; `IP-75-ASI1`; `AVM58` and `AVM58-H`.

mod conclusions;
mod form;
mod label;
mod offer;
mod tables;

pub use conclusions::Request;
pub use form::{Form, Part, Place, Says, Token, Word};
pub use tables::FORMS;

use crate::{
    language::{msg, t},
    product::{Interface, Series},
    profile::Profile,
    say, text,
};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};
use core::fmt;

/// What an order code says.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// The profile it implies.
    pub profile: Profile,
    /// The series; none for a short form, which MPP and PT share.
    pub series: Option<Series>,
    /// How it is wired and what it speaks.
    pub interface: Interface,
    /// How turns are kept.
    pub turns: Turns,
    /// The form of its code.
    pub form: &'static Form,
    /// The parts of its code, those that were left out too.
    pub tokens: Vec<Token>,
}

/// How turns are kept (MPP and PT, "Models"; P+F article, "the variety of designs").
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turns {
    /// Not at all.
    Single,
    /// They are counted while there is power, and are 0 after it was off.
    Powered,
    /// A battery keeps counting.
    Battery,
    /// In flash; without power the shaft may turn by 90° at most.
    Flash,
    /// By a mechanical gear, which needs no power.
    Gear,
}

/// What is wrong with an order code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModelError {
    /// Which part, counted from 1.
    pub position: usize,
    /// What is wrong and what would fit.
    pub message: String,
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        say!(
            f,
            "part {} of the order code: {}",
            self.position,
            self.message
        )
    }
}

impl core::error::Error for ModelError {}

impl Turns {
    /// Its name in records.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Single => "none",
            Self::Powered => "powered",
            Self::Battery => "battery",
            Self::Flash => "flash",
            Self::Gear => "gear",
        }
    }
}

/// One part of a code that is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// The text, in capital Latin letters; empty where the part is missing.
    pub text: String,
    /// What stands at this position; none behind the last.
    pub part: Option<&'static Part>,
    /// What it means.
    pub doc: String,
    /// What is wrong, and what fits.
    pub fault: Option<String>,
}

/// Parses an order code.
///
/// Lower case, spaces, any dash and Cyrillic letters that look like Latin ones are understood.
///
/// # Errors
///
/// Says which part is wrong and what fits there; of several the first.
///
/// ```
/// let model = encoderscope::model::parse("MPP-40-60-A-23BM-T-N-A-M").unwrap();
/// assert_eq!((model.profile.angle_bits, model.profile.turns_bits), (23, 16));
/// let wrong = encoderscope::model::parse("MPP-40-60-A-23BM-Z-N-A-M").unwrap_err();
/// assert_eq!(
///     wrong.to_string(),
///     "part 6 of the order code: \"Z\" is no interface; S, B, R, A, T, D or P fit"
/// );
/// ```
pub fn parse(code: &str) -> Result<Model, ModelError> {
    let texts = label::parts(code);
    let first = texts.first().map(String::as_str).unwrap_or_default();
    let form = Form::of(first).ok_or_else(|| no_series(first))?;
    form.compose(&texts)
}

/// What every part of a code means, and what is wrong with it, however much is wrong.
///
/// ```
/// let looks = encoderscope::model::look("MPP-40-x-A-24-Z-N-A-M");
/// let wrong: Vec<_> = looks.iter().filter(|look| look.fault.is_some()).collect();
/// assert_eq!(wrong.len(), 2);
/// assert_eq!(wrong[0].fault.as_deref(), Some("\"X\" is no stator diameter; 1 to 999 mm fit"));
/// ```
#[must_use]
pub fn look(code: &str) -> Vec<Look> {
    let texts = label::parts(code);
    let first = texts.first().map(String::as_str).unwrap_or_default();
    let form = Form::of(first);
    let parts = form.map_or(&[][..], |form| form.parts);
    let count = texts.len().max(parts.len());
    let mut looks: Vec<Look> = (0..count)
        .map(|index| {
            let text = texts.get(index).map(String::as_str);
            let part = parts.get(index).copied();
            let read = read(part, text, parts.len());
            Look {
                text: text.unwrap_or_default().to_string(),
                part,
                doc: read.as_ref().map(Token::doc).unwrap_or_default(),
                fault: match form {
                    Some(_) => read.err(),
                    None => (index == 0).then(|| no_series(first).message),
                },
            }
        })
        .collect();
    // What no part says alone: that two do not go together.
    if let Err(error) = parse(code)
        && let Some(look) = looks.get_mut(error.position.saturating_sub(1))
    {
        look.fault.get_or_insert(error.message);
    }
    looks
}

/// What does not go together (MPP and PT: T485 note 2, BUS versions and example, baud codes).
pub const RULES: [&str; 4] = [T485_ONLY, BUS_ONLY, M1_ONLY, BAUD_ONLY];
const T485_ONLY: &str = msg("T485 comes with 17M, 17BM, 17FM, 23M, 23BM or 23FM only");
const BUS_ONLY: &str = msg("BUS comes without a turn counter or with M; BM and FM do not exist");
const M1_ONLY: &str = msg("M1 exists with BUS only; nothing, M, BM or FM fits");
const BAUD_ONLY: &str = msg("only RS485 and RS422, letters R and A, have a baud code; M fits");

/// Only the smallest program has no room for the words.
const IS_TERSE: bool = cfg!(feature = "small");

fn no_series(first: &str) -> ModelError {
    let message = match (IS_TERSE, first) {
        (true, _) => t("does not fit").to_string(),
        (_, "") => t("is missing").to_string(),
        (_, first) => {
            let series: Vec<_> = Form::series().collect();
            text!("\"{}\" is no series; {} fit", first, series.join(", "))
        }
    };
    ModelError {
        position: 1,
        message,
    }
}

/// What a text says at a part, or what is wrong with it.
fn read(part: Option<&'static Part>, text: Option<&str>, count: usize) -> Result<Token, String> {
    let found = part.and_then(|part| part.read(text.or(part.missing)?));
    found.ok_or_else(|| match (IS_TERSE, part, text) {
        (true, ..) => t("does not fit").to_string(),
        (_, None, text) => text!(
            "\"{}\" is one too many: the code has {} parts",
            text.unwrap_or_default(),
            count
        ),
        (_, Some(part), None) => text!("the {} is missing; {}", part.place.name(), part.fits()),
        (_, Some(part), Some(text)) => {
            text!("\"{}\" is no {}; {}", text, part.place.name(), part.fits())
        }
    })
}

impl Form {
    /// The model whose code has these parts.
    ///
    /// # Errors
    ///
    /// Says which part is wrong and what fits there.
    ///
    /// ```
    /// use encoderscope::model::Form;
    /// let pt = Form::named("PT").unwrap();
    /// let model = pt.compose(&["PT", "15B", "25H", "A", "24BM", "R", "N", "A", "M"])?;
    /// assert_eq!(model.code(), "PT-15B-25H-A-24BM-R-N-A-M");
    /// # Ok::<(), encoderscope::model::ModelError>(())
    /// ```
    pub fn compose(&'static self, texts: &[impl AsRef<str>]) -> Result<Model, ModelError> {
        let count = self.parts.len();
        let mut tokens = Vec::new();
        for index in 0..count.max(texts.len()) {
            let text = texts.get(index).map(AsRef::as_ref);
            match read(self.parts.get(index).copied(), text, count) {
                Ok(token) => tokens.push(token),
                Err(message) => {
                    return Err(ModelError {
                        position: index + 1,
                        message,
                    });
                }
            }
        }
        let model = Model::of(self, tokens);
        match model.impossible() {
            None => Ok(model),
            Some((place, why)) => {
                let at = self.parts.iter().position(|part| part.place == place);
                Err(ModelError {
                    position: at.unwrap_or_default() + 1,
                    message: if IS_TERSE { t("does not fit") } else { t(why) }.to_string(),
                })
            }
        }
    }
}

impl Model {
    fn of(form: &'static Form, tokens: Vec<Token>) -> Self {
        let (mut series, mut interface) = (None, Interface::SsiTree);
        let (mut widths, mut turns, mut baud) = (None, Turns::Single, None);
        for token in &tokens {
            match token.word.says {
                Says::Series(named) => {
                    series = Some(named);
                    if matches!(named, Series::Avm58 | Series::Asm58) {
                        turns = Turns::Gear;
                    }
                }
                Says::Interface(named) => interface = named,
                Says::Turns(kept, bits) => {
                    turns = kept;
                    widths = Some((token.number, bits));
                }
                Says::Baud(rate) => baud = Some(rate),
                Says::Nothing | Says::Temperature(..) | Says::HardWired => {}
            }
        }
        let mut profile = interface.format().default_profile();
        profile.baud = baud.unwrap_or(profile.baud);
        if let Some((angle_bits, turns_bits)) = widths {
            (profile.angle_bits, profile.turns_bits) = (angle_bits, turns_bits);
        }
        if let Some(Series::Avs58 | Series::Ass58) = series {
            profile.turns_bits = 0;
            profile.frame_bits = profile.natural_frame_bits();
        }
        Self {
            profile,
            series,
            interface,
            turns,
            form,
            tokens,
        }
    }

    /// The part that does not go with the others, and which of the [`RULES`] says so.
    fn impossible(&self) -> Option<(Place, &'static str)> {
        let says_baud = |token: &Token| matches!(token.word.says, Says::Baud(_));
        let Profile {
            angle_bits,
            turns_bits,
            ..
        } = self.profile;
        match self.interface {
            Interface::T485 if !matches!(angle_bits, 17 | 23) || !matches!(turns_bits, 16) => {
                Some((Place::Resolution, T485_ONLY))
            }
            Interface::Bus if matches!(self.turns, Turns::Battery | Turns::Flash) => {
                Some((Place::Resolution, BUS_ONLY))
            }
            interface if turns_bits == 8 && interface != Interface::Bus => {
                Some((Place::Resolution, M1_ONLY))
            }
            Interface::Rs485 | Interface::Rs422 => None,
            _ if self.tokens.iter().any(says_baud) => Some((Place::Option, BAUD_ONLY)),
            _ => None,
        }
    }

    /// The code as it is ordered, in capital letters.
    ///
    /// ```
    /// let model = encoderscope::model::parse("рт 20 30h a 24 s n a m").unwrap();
    /// assert_eq!(model.code(), "PT-20-30H-A-24-S-N-A-M");
    /// ```
    #[must_use]
    pub fn code(&self) -> String {
        let texts = self.tokens.iter().map(Token::text);
        let texts: Vec<_> = texts.filter(|text| !text.is_empty()).collect();
        texts.join("-")
    }

    /// The part of its code at a place.
    #[must_use]
    pub fn token(&self, place: Place) -> Option<&Token> {
        self.tokens.iter().find(|token| token.part.place == place)
    }
}
