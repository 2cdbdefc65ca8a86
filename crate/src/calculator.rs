//! Calculators: what is otherwise worked out on paper with a manual beside it.
//!
//! A [`Calculator`] names what it needs and works out [`Answer`]s; its names are those of links,
//! so that a filled one can be sent. What is impossible gives a sentence and no number.
//!
//! ```
//! use encoderscope::calculator::Calculator;
//! let resolution = Calculator::named("resolution").unwrap();
//! let outcome = resolution.work(|name| match name {
//!     "given" => Some("bits"),
//!     "value" => Some("14"),
//!     _ => None,
//! })?;
//! // IP-75, table 1: 14 bits are 79.1 seconds of arc.
//! assert_eq!(outcome.answer("arc-seconds").unwrap().text, "79.1016″");
//! # Ok::<(), encoderscope::calculator::Fault>(())
//! ```

mod adapters;
mod apci1710;
mod bus_timing;
pub mod quantity;
mod resolution;
mod ssi_line;

use crate::{language::t, text};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};
use core::fmt;
use quantity::Measure;

/// Something that is worked out.
#[derive(Clone, Copy, Debug)]
pub struct Calculator {
    /// Its name in links, in kebab-case.
    pub name: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// What it answers, in a sentence.
    pub about: &'static str,
    /// Where the formulas are from.
    pub source: &'static str,
    /// What it needs.
    pub inputs: &'static [Input],
    work: fn(&Given) -> Result<Outcome, Fault>,
}

/// What a calculator needs.
#[derive(Clone, Copy, Debug)]
pub struct Input {
    /// Its name in links, in kebab-case.
    pub name: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// What to enter, and where to find it.
    pub doc: &'static str,
    /// What it can be.
    pub kind: Kind,
    /// What it is when nothing is said, as a user would write it.
    pub default: &'static str,
}

/// What an input can be.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A number.
    Number {
        /// What it counts.
        measure: Measure,
        /// The unit of a bare number.
        unit: &'static str,
        /// The least that makes sense.
        least: f64,
        /// The most that makes sense.
        most: f64,
        /// Whether it is a whole number.
        whole: bool,
    },
    /// One of some words.
    Word(&'static [Word]),
}

/// A word that can be chosen.
#[derive(Clone, Copy, Debug)]
pub struct Word {
    /// Its name in links.
    pub name: &'static str,
    /// Its name for people.
    pub title: &'static str,
}

/// What has been entered, checked.
#[derive(Clone, Debug)]
pub struct Given {
    values: Vec<(&'static str, Entered)>,
}

#[derive(Clone, Copy, Debug)]
enum Entered {
    Number(f64),
    Word(&'static str),
}

/// What came out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// The answers, in the order in which they are read.
    pub answers: Vec<Answer>,
    /// A program with the answers filled in.
    pub code: Option<Code>,
}

/// A program with the answers filled in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Code {
    /// What it does.
    pub title: &'static str,
    /// The name of its file.
    pub file: &'static str,
    /// The program.
    pub text: String,
}

/// One answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// Its name, which no translation changes.
    pub name: &'static str,
    /// What it is.
    pub title: String,
    /// The number, in the unit of the text's name or of the title; none where there is none.
    pub number: Option<f64>,
    /// The answer in words, with its unit.
    pub text: String,
    /// What to know about it, or where it comes from.
    pub note: String,
    /// Whether it is good news.
    pub tone: Tone,
}

/// Whether an answer is good news.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// A matter of fact.
    Plain,
    /// It works.
    Good,
    /// It works with reservations.
    Warn,
    /// It does not work.
    Bad,
}

/// Why there is no outcome.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The input that is wrong.
    pub input: &'static str,
    /// What is wrong with it, as a sentence without its first capital.
    pub message: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl core::error::Error for Fault {}

/// All calculators, in the order in which they are offered.
pub static CALCULATORS: &[Calculator] = &[
    resolution::RESOLUTION,
    ssi_line::SSI_LINE,
    bus_timing::BUS_TIMING,
    apci1710::APCI_1710,
    adapters::ADAPTERS,
];

impl Calculator {
    /// The calculator of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        CALCULATORS
            .iter()
            .find(|calculator| calculator.name == name)
    }

    /// Works out what follows from what is entered; what is not entered is the default.
    ///
    /// # Errors
    ///
    /// Names the input that is wrong, or that makes the rest impossible.
    pub fn work<'a>(&self, entered: impl Fn(&str) -> Option<&'a str>) -> Result<Outcome, Fault> {
        let values = self.inputs.iter().map(|input| {
            let text = entered(input.name).unwrap_or(input.default);
            Ok((input.name, input.read(text)?))
        });
        let values = values.collect::<Result<_, _>>()?;
        (self.work)(&Given { values })
    }
}

impl Input {
    const fn number(
        name: &'static str,
        title: &'static str,
        doc: &'static str,
        (measure, unit): (Measure, &'static str),
        (least, most): (f64, f64),
        default: &'static str,
    ) -> Self {
        let whole = matches!(
            measure,
            Measure::Count | Measure::Rate | Measure::Bits | Measure::Address
        );
        let kind = Kind::Number {
            measure,
            unit,
            least,
            most,
            whole,
        };
        Self {
            name,
            title,
            doc,
            kind,
            default,
        }
    }

    const fn word(
        name: &'static str,
        title: &'static str,
        doc: &'static str,
        words: &'static [Word],
        default: &'static str,
    ) -> Self {
        Self {
            name,
            title,
            doc,
            kind: Kind::Word(words),
            default,
        }
    }

    /// The unit of a bare number.
    #[must_use]
    pub const fn unit(&self) -> &'static str {
        match self.kind {
            Kind::Number { unit, .. } => unit,
            Kind::Word(_) => "",
        }
    }

    /// The same for people.
    #[must_use]
    pub fn unit_title(&self) -> String {
        counted("", self.unit()).trim().to_string()
    }

    fn read(&self, text: &str) -> Result<Entered, Fault> {
        let wrong = |message: String| Fault {
            input: self.name,
            message: format!("{}: {message}", lowered(t(self.title))),
        };
        match self.kind {
            Kind::Word(words) => {
                let found = words.iter().find(|word| word.name == text);
                found.map(|word| Entered::Word(word.name)).ok_or_else(|| {
                    let names: Vec<_> = words.iter().map(|word| word.name).collect();
                    wrong(text!("\"{}\" is none of {}", text, names.join(", ")))
                })
            }
            Kind::Number {
                measure,
                unit,
                least,
                most,
                whole,
            } => {
                let number = quantity::parse(text, measure, unit).map_err(wrong)?;
                let say = |bound: f64| match (measure, unit) {
                    (Measure::Address, _) => format!("0x{:X}", bound as u64),
                    (_, unit) => counted(&quantity::shown(bound, 9), unit),
                };
                if number < least {
                    return Err(wrong(text!("{} is less than {}", text, say(least))));
                }
                if number > most {
                    return Err(wrong(text!("{} is more than {}", text, say(most))));
                }
                let nearest = (number + 0.5) as i64 as f64;
                match whole {
                    // What a unit multiplies is not exact.
                    true if (number - nearest).abs() > 1e-6 => {
                        Err(wrong(text!("{} is not a whole number", text)))
                    }
                    true => Ok(Entered::Number(nearest)),
                    false => Ok(Entered::Number(number)),
                }
            }
        }
    }
}

/// A number with its unit.
fn counted(number: &str, unit: &'static str) -> String {
    match unit {
        "" | "°" | "′" | "″" => format!("{number}{unit}"),
        "bits" => text!("{} bits", number),
        "bytes" => text!("{} bytes", number),
        "counts" => text!("{} counts", number),
        unit => format!("{number} {}", t(unit)),
    }
}

/// A title as it stands within a sentence: what begins with more than one capital keeps them.
fn lowered(title: &str) -> String {
    let mut letters = title.chars();
    match (letters.next(), letters.next()) {
        (Some(first), Some(second)) if !second.is_uppercase() => {
            first.to_lowercase().chain(title.chars().skip(1)).collect()
        }
        _ => title.to_string(),
    }
}

impl Given {
    fn entered(&self, name: &str) -> Option<Entered> {
        let found = self.values.iter().find(|(known, _)| *known == name);
        found.map(|(_, value)| *value)
    }

    /// A number, in the unit of its input.
    fn number(&self, name: &str) -> f64 {
        match self.entered(name) {
            Some(Entered::Number(number)) => number,
            _ => 0.0,
        }
    }

    /// The name of the word that is chosen.
    fn word(&self, name: &str) -> &'static str {
        match self.entered(name) {
            Some(Entered::Word(word)) => word,
            _ => "",
        }
    }
}

impl Outcome {
    /// Answers alone.
    fn of(answers: impl Into<Vec<Answer>>) -> Self {
        Self {
            answers: answers.into(),
            code: None,
        }
    }

    /// The answer of a name.
    #[must_use]
    pub fn answer(&self, name: &str) -> Option<&Answer> {
        self.answers.iter().find(|answer| answer.name == name)
    }
}

impl Answer {
    /// A number with its unit, rounded to so many digits.
    fn of(name: &'static str, title: &str, number: f64, digits: i32, unit: &'static str) -> Self {
        let text = counted(&quantity::shown(number, digits), unit);
        Self {
            number: Some(number),
            ..Self::worded(name, title, text)
        }
    }

    /// An answer in words.
    fn worded(name: &'static str, title: &str, text: impl Into<String>) -> Self {
        Self {
            name,
            title: title.to_string(),
            number: None,
            text: text.into(),
            note: String::new(),
            tone: Tone::Plain,
        }
    }

    /// The same with what to know about it.
    fn note(self, note: impl Into<String>) -> Self {
        Self {
            note: note.into(),
            ..self
        }
    }

    /// The same with whether it is good news.
    fn tone(self, tone: Tone) -> Self {
        Self { tone, ..self }
    }
}
