//! The form of an order code: its positions, and how each is read and written.

use super::{Turns, tables::FORMS};
use crate::{
    language::t,
    product::{Interface, Series},
    text,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// The form of an order code: what stands at each position.
#[derive(Debug, PartialEq)]
pub struct Form {
    /// The series, as a label names it, or what such a code is for.
    pub title: &'static str,
    /// Where the form is from.
    pub source: &'static str,
    /// The parts of a usual code.
    pub example: &'static [&'static str],
    /// The positions, of which the first tells the forms apart.
    pub parts: &'static [&'static Part],
}

/// A position of an order code: a number, where it has one, and one of some words behind it.
#[derive(Debug, PartialEq)]
pub struct Part {
    /// Which position it is.
    pub place: Place,
    /// What stands there, in a few words.
    pub doc: &'static str,
    /// The least and the greatest number that can stand there, and its unit.
    pub number: Option<(u32, u32, &'static str)>,
    /// The words, without a number before them or behind it.
    pub words: &'static [Word],
    /// What is meant where the code ends before.
    pub missing: Option<&'static str>,
}

/// A word of an order code.
#[derive(Debug, PartialEq)]
pub struct Word {
    /// The word; empty where a number can stand alone, or nothing.
    pub text: &'static str,
    /// What it means to people.
    pub doc: &'static str,
    /// What follows from it.
    pub says: Says,
}

/// What stands at a position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The series.
    Series,
    /// The diameter of the rotor.
    Rotor,
    /// The diameter of the stator.
    Stator,
    /// What is put out.
    Output,
    /// Bits per turn, and how turns are kept.
    Resolution,
    /// The interface.
    Interface,
    /// The supply.
    Supply,
    /// The temperature range.
    Temperature,
    /// Options.
    Option,
    /// A microcontroller or hard-wired logic.
    Logic,
}

/// What follows from a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Says {
    /// Nothing that a program needs.
    Nothing,
    /// The series.
    Series(Series),
    /// The interface.
    Interface(Interface),
    /// How turns are kept, and in how many bits.
    Turns(Turns, u32),
    /// The least and the greatest temperature, in °C.
    Temperature(i32, i32),
    /// The baud rate.
    Baud(u32),
    /// Hard-wired logic, without preset.
    HardWired,
}

/// A part that has been read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Token {
    /// Its position.
    pub part: &'static Part,
    /// Its number, 0 where it has none.
    pub number: u32,
    /// Its word.
    pub word: &'static Word,
}

impl Place {
    /// Its name for people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Series => t("series"),
            Self::Rotor => t("rotor diameter"),
            Self::Stator => t("stator diameter"),
            Self::Output => t("output"),
            Self::Resolution => t("resolution"),
            Self::Interface => t("interface"),
            Self::Supply => t("supply"),
            Self::Temperature => t("temperature range"),
            Self::Option => t("option"),
            Self::Logic => t("kind of logic"),
        }
    }
}

impl Part {
    /// What a text says at this position.
    #[must_use]
    pub fn read(&'static self, text: &str) -> Option<Token> {
        let (number, rest) = match self.number {
            Some((least, most, _)) => {
                let digits = text.bytes().take_while(u8::is_ascii_digit).count();
                let (digits, rest) = text.split_at_checked(digits)?;
                let number = digits.parse().ok();
                let fitting = number.filter(|number| (least..=most).contains(number));
                (fitting?, rest)
            }
            None => (0, text),
        };
        let word = self.words.iter().find(|word| word.text == rest)?;
        Some(Token {
            part: self,
            number,
            word,
        })
    }

    /// What fits here, as the end of a sentence.
    ///
    /// ```
    /// use encoderscope::model::Form;
    /// let mpp = Form::named("MPP").unwrap();
    /// assert_eq!(mpp.parts[5].fits(), "S, B, R, A, T, D or P fit");
    /// assert_eq!(mpp.parts[4].fits(), "16 to 24 bits fit, alone or with M, BM, FM or M1 behind");
    /// ```
    #[must_use]
    pub fn fits(&self) -> String {
        let words: Vec<&str> = self.words.iter().map(|word| word.text).collect();
        let named: Vec<&str> = words
            .iter()
            .copied()
            .filter(|text| !text.is_empty())
            .collect();
        let list = match named.as_slice() {
            [] => String::new(),
            [only] => (*only).to_string(),
            [firsts @ .., last] => text!("{} or {}", firsts.join(", "), last),
        };
        match (self.number, named.len()) {
            (Some((least, most, unit)), 0) => text!("{} to {} fit", least, counted(most, unit)),
            (Some((least, most, unit)), _) => {
                text!(
                    "{} to {} fit, alone or with {} behind",
                    least,
                    counted(most, unit),
                    list
                )
            }
            (None, 1) if words.len() > 1 => text!("{} or nothing fits", list),
            (None, 1) => text!("{} fits", list),
            (None, _) => text!("{} fit", list),
        }
    }
}

impl Token {
    /// The part as a code writes it.
    #[must_use]
    pub fn text(&self) -> String {
        match self.part.number {
            Some(_) => format!("{}{}", self.number, self.word.text),
            None => self.word.text.to_string(),
        }
    }

    /// What it means.
    #[must_use]
    pub fn doc(&self) -> String {
        match (self.part.number, self.word.doc) {
            (None, doc) => t(doc).to_string(),
            (Some((_, _, unit)), "") => counted(self.number, unit),
            (Some((_, _, unit)), doc) => format!("{}, {}", counted(self.number, unit), t(doc)),
        }
    }
}

impl Form {
    /// The form of a title.
    #[must_use]
    pub fn named(title: &str) -> Option<&'static Self> {
        FORMS.iter().find(|form| form.title == title)
    }

    /// The form whose first part this is.
    pub(super) fn of(first: &str) -> Option<&'static Self> {
        let by_word = FORMS.iter().find(|form| {
            let part = form.parts.first();
            part.is_some_and(|part| part.read(first).is_some())
        });
        // A number that fits nowhere is still a resolution.
        let is_number = first.starts_with(|letter: char| letter.is_ascii_digit());
        by_word.or(if is_number { FORMS.last() } else { None })
    }

    /// All series that codes begin with.
    pub(super) fn series() -> impl Iterator<Item = &'static str> {
        let firsts = FORMS.iter().filter_map(|form| form.parts.first());
        let firsts = firsts.filter(|part| part.place == Place::Series);
        firsts.flat_map(|part| part.words.iter().map(|word| word.text))
    }
}

/// A number with its unit.
fn counted(number: u32, unit: &'static str) -> String {
    match unit {
        "bits" => text!("{} bits", number),
        unit => format!("{number} {}", t(unit)),
    }
}
