//! The tables of the order codes: what stands at each position, and what it means.

use super::Turns;
use crate::{
    format::said,
    product::{Interface, Series},
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
    pub const fn name(self) -> &'static str {
        match self {
            Self::Series => "series",
            Self::Rotor => "rotor diameter",
            Self::Stator => "stator diameter",
            Self::Output => "output",
            Self::Resolution => "resolution",
            Self::Interface => "interface",
            Self::Supply => "supply",
            Self::Temperature => "temperature range",
            Self::Option => "option",
            Self::Logic => "kind of logic",
        }
    }
}

/// What only a composer needs.
const fn shown(texts: &'static [&'static str]) -> &'static [&'static str] {
    if cfg!(feature = "small") { &[] } else { texts }
}

const fn word(text: &'static str, says: Says, doc: &'static str) -> Word {
    Word {
        text,
        says,
        doc: said(doc),
    }
}

impl Part {
    const fn of(place: Place, words: &'static [Word], doc: &'static str) -> Self {
        Self {
            place,
            doc: said(doc),
            number: None,
            words,
            missing: None,
        }
    }

    const fn counted(self, least: u32, most: u32, unit: &'static str) -> Self {
        Self {
            number: Some((least, most, unit)),
            ..self
        }
    }

    const fn or(self, missing: &'static str) -> Self {
        Self {
            missing: Some(missing),
            ..self
        }
    }

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
            [firsts @ .., last] => format!("{} or {last}", firsts.join(", ")),
        };
        match (self.number, named.len()) {
            (Some((least, most, unit)), 0) => format!("{least} to {most} {unit} fit"),
            (Some((least, most, unit)), _) => {
                format!("{least} to {most} {unit} fit, alone or with {list} behind")
            }
            (None, 1) if words.len() > 1 => format!("{list} or nothing fits"),
            (None, 1) => format!("{list} fits"),
            (None, _) => format!("{list} fit"),
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
            (None, doc) => doc.to_string(),
            (Some((_, _, unit)), "") => format!("{} {unit}", self.number),
            (Some((_, _, unit)), doc) => format!("{} {unit}, {doc}", self.number),
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

/// Bits per turn, and how turns are kept (MPP and PT, "Models"; the 8-bit counter: "BUS", example).
static RESOLUTION: Part = Part::of(
    Place::Resolution,
    &[
        word("", Says::Turns(Turns::Single, 0), "single turn"),
        word(
            "M",
            Says::Turns(Turns::Powered, 16),
            "turns are counted while there is power",
        ),
        word(
            "BM",
            Says::Turns(Turns::Battery, 16),
            "turns are counted on a battery while there is no power",
        ),
        word(
            "FM",
            Says::Turns(Turns::Flash, 16),
            "turns are kept in flash; without power the shaft may turn by 90° at most",
        ),
        word(
            "M1",
            Says::Turns(Turns::Powered, 8),
            "an 8-bit turn counter, while there is power",
        ),
    ],
    "bits per turn, and how turns are kept",
)
.counted(16, 24, "bits");

/// The wires and what is spoken over them (MPP and PT, "Models").
const INTERFACE: Part = Part::of(
    Place::Interface,
    &[
        word(
            "S",
            Says::Interface(Interface::Ssi),
            "SSI; it has no CRC, so the manual recommends BiSS-C on the same wires",
        ),
        word("B", Says::Interface(Interface::BissC), "BiSS-C"),
        word("R", Says::Interface(Interface::Rs485), "RS485, two wires"),
        word("A", Says::Interface(Interface::Rs422), "RS422, four wires"),
        word(
            "T",
            Says::Interface(Interface::T485),
            "T485, compatible with Tamagawa of 17 or 23 bits",
        ),
        word(
            "D",
            Says::Interface(Interface::Bus),
            "BUS, the high-speed bus",
        ),
        word(
            "P",
            Says::Interface(Interface::Period),
            "PERIOD, sends by itself every millisecond",
        ),
    ],
    "interface",
);

static OUTPUT: Part = Part::of(
    Place::Output,
    &[word("A", Says::Nothing, "absolute value")],
    "what is put out",
);

static SUPPLY: Part = Part::of(Place::Supply, &[word("N", Says::Nothing, "5 V")], "supply");

static TEMPERATURE: Part = Part::of(
    Place::Temperature,
    &[
        word("A", Says::Temperature(-40, 85), "−40…85 °C"),
        word("B", Says::Temperature(-40, 105), "−40…105 °C"),
        word("C", Says::Temperature(-40, 125), "−40…125 °C"),
    ],
    "working temperature",
);

/// Baud codes A and B (MPP and PT, "RS485/RS422").
static OPTION: Part = Part::of(
    Place::Option,
    &[
        word("M", Says::Nothing, "no option"),
        word("A", Says::Baud(115_200), "115 200 baud"),
        word(
            "B",
            Says::Baud(2_500_000),
            "2 500 000 baud, as without a code",
        ),
    ],
    "none, or the baud rate of RS485 and RS422",
);

const fn diameter(place: Place, words: &'static [Word], doc: &'static str) -> Part {
    Part::of(place, words, doc).counted(1, 999, "mm")
}

/// All forms of order codes.
pub static FORMS: &[Form] = &[
    Form {
        title: "MPP",
        source: said("MPP, order code"),
        example: shown(&["MPP", "40", "60", "A", "24BM", "R", "N", "A", "M"]),
        parts: &[
            &Part::of(
                Place::Series,
                &[word(
                    "MPP",
                    Says::Series(Series::Mpp),
                    "KingKong MPP, magnetic",
                )],
                "series",
            ),
            &diameter(
                Place::Rotor,
                &[word("", Says::Nothing, "")],
                "inner diameter of the rotor",
            ),
            &diameter(
                Place::Stator,
                &[word("", Says::Nothing, "")],
                "outer diameter of the stator",
            ),
            &OUTPUT,
            &RESOLUTION,
            &INTERFACE,
            &SUPPLY,
            &TEMPERATURE,
            &OPTION,
        ],
    },
    Form {
        title: "PT",
        source: said("PT, models and size table; the letters as in MPP, order code"),
        example: shown(&["PT", "20", "30", "A", "24BM", "R", "N", "A", "M"]),
        parts: &[
            &Part::of(
                Place::Series,
                &[word("PT", Says::Series(Series::Pt), "Mosrac PT, magnetic")],
                "series",
            ),
            &diameter(
                Place::Rotor,
                &[
                    word("", Says::Nothing, "rotor with a thread"),
                    word("B", Says::Nothing, "bonded rotor"),
                ],
                "size of the rotor, and how it is fixed",
            ),
            &diameter(
                Place::Stator,
                &[
                    word("", Says::Nothing, "mounted from the front"),
                    word("H", Says::Nothing, "mounted from the front or the back"),
                ],
                "outer diameter of the stator, and how it is mounted",
            ),
            &OUTPUT,
            &RESOLUTION,
            &INTERFACE,
            &SUPPLY,
            &TEMPERATURE,
            &OPTION,
        ],
    },
    Form {
        title: "IP-75",
        source: said("IP-75, 5.3 and 5.4; its manual has no order code"),
        example: shown(&["IP-75", "ASI1"]),
        parts: &[
            &Part::of(
                Place::Series,
                &[word(
                    "IP-75",
                    Says::Series(Series::Ip75),
                    "inductosyn ИП-75",
                )],
                "series",
            ),
            &Part::of(
                Place::Interface,
                &[
                    word(
                        "ASI1",
                        Says::Interface(Interface::Asi1),
                        "binary stream over RS-485",
                    ),
                    word(
                        "ASI4",
                        Says::Interface(Interface::Asi4),
                        "text stream over RS-485",
                    ),
                    word("SSI7", Says::Interface(Interface::Ssi7), "SSI of 30 bits"),
                ],
                "what it sends",
            ),
        ],
    },
    Form {
        title: "Pepperl+Fuchs",
        source: said("P+F article, table 6"),
        example: shown(&["AVM58", ""]),
        parts: &[
            &Part::of(
                Place::Series,
                &[
                    word(
                        "AVS58",
                        Says::Series(Series::Avs58),
                        "single turn, solid shaft",
                    ),
                    word(
                        "AVM58",
                        Says::Series(Series::Avm58),
                        "multi-turn, solid shaft",
                    ),
                    word(
                        "ASS58",
                        Says::Series(Series::Ass58),
                        "single turn, hollow shaft",
                    ),
                    word(
                        "ASM58",
                        Says::Series(Series::Asm58),
                        "multi-turn, hollow shaft",
                    ),
                ],
                "series",
            ),
            &Part::of(
                Place::Logic,
                &[
                    word("", Says::Nothing, "a microcontroller, with a preset"),
                    word("H", Says::HardWired, "hard-wired logic, without preset"),
                ],
                "nothing, or H for hard-wired logic",
            )
            .or(""),
        ],
    },
    Form {
        title: "MPP or PT",
        source: said("MPP and PT, T485 note 2, BUS version table, CRC-6 program"),
        example: shown(&["17M", "T"]),
        parts: &[
            &RESOLUTION,
            // The CRC-6 program calls BiSS-C models 17M and 16.
            &INTERFACE.or("B"),
        ],
    },
];
