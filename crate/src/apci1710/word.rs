//! The word of an encoder in a register SHIFT.

use super::WORD_BITS;
use crate::{
    bits::{self, BitString, Span},
    decode::Decoder,
    explain::Note,
    format::Link,
    language::t,
    layout::{Class, Resolved, Shape},
    reading::Values,
    say,
};
use alloc::{string::String, vec::Vec};
use core::fmt;

/// What the module has made of the word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Nothing: it is as it came over the line.
    Plain,
    /// It was taken for Gray code and is binary now.
    Converted,
}

/// The word of an encoder.
#[derive(Clone, Debug)]
pub struct Word {
    /// The bits as they came over the line.
    pub line: BitString,
    /// What every bit of the register says, the highest first.
    pub notes: Vec<Note>,
    /// All numbers, good or bad.
    pub values: Values,
    /// Whether every check holds and nothing stands above the word.
    pub ok: bool,
}

/// Why a register holds no word of a profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WordError {
    /// Encoders of the profile are not clocked.
    NotClocked,
    /// The word has more bits than the register.
    TooLong {
        /// Bits of the word.
        bits: usize,
    },
}

impl fmt::Display for WordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotClocked => f.write_str(t(
                "an encoder of this format is not clocked, and no SSI module reads it",
            )),
            Self::TooLong { bits } => say!(
                f,
                "the word has {} bits, and SHIFT holds {}: the first are lost",
                bits,
                WORD_BITS
            ),
        }
    }
}

impl core::error::Error for WordError {}

impl Word {
    /// Reads a register: the word of the decoder's profile stands at its right end.
    ///
    /// # Errors
    ///
    /// The profile is of no clocked format, or its word is too long.
    ///
    /// ```
    /// use encoderscope::{apci1710::{Form, Word}, decode::Decoder, profile::Profile};
    /// let decoder = Decoder::new(Profile::parse([("format", "ssi-tree")])?)?;
    /// let word = Word::read(&decoder, 0x014a_5223, Form::Plain)?;
    /// assert_eq!((word.values.turns, word.values.angle), (Some(3171), Some(962)));
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    pub fn read(decoder: &Decoder, value: u32, form: Form) -> Result<Self, WordError> {
        let layout = Self::layout(decoder)?;
        let len = layout.len;
        let register = WORD_BITS as usize;
        let above = register - len;
        let word = u64::from(value) & bits::mask(len);
        let beside = bits::above(value.into(), len as u32);
        let mut line = BitString::zeros(len);
        line.write(
            Span::new(0, len),
            match form {
                Form::Plain => word,
                Form::Converted => bits::to_gray(word),
            },
        );
        let mut notes = Vec::new();
        if above > 0 {
            notes.push(Note {
                name: "above",
                class: Class::Framing,
                spans: [Span::new(0, above)].into(),
                doc: String::from(t("What stands above the word.")),
                raw: beside,
                text: match beside {
                    0 => String::from(t("zero")),
                    _ => String::from(t(
                        "not zero: left over, or the word is longer than the profile says",
                    )),
                },
                bits: Vec::new(),
                fault: None,
            });
        }
        notes.extend(layout.explain(line.as_bits()).into_iter().map(|mut note| {
            for span in &mut note.spans {
                span.start += above;
            }
            for bit in &mut note.bits {
                bit.at += above;
            }
            note
        }));
        Ok(Self {
            values: layout.values(line.as_bits()),
            ok: beside == 0 && layout.holds(line.as_bits()),
            line,
            notes,
        })
    }

    /// The register that holds a word, which is the way back of [`Self::read`].
    ///
    /// # Errors
    ///
    /// The profile is of no clocked format, or its word is too long.
    pub fn write(decoder: &Decoder, values: &Values, form: Form) -> Result<u32, WordError> {
        let layout = Self::layout(decoder)?;
        let line = layout.encode(values);
        let word = line.as_bits().read(Span::new(0, layout.len));
        let word = match form {
            Form::Plain => word,
            Form::Converted => bits::from_gray(word),
        };
        Ok(u32::try_from(word).unwrap_or(u32::MAX))
    }

    /// The word without what stands around it in a dump.
    fn layout(decoder: &Decoder) -> Result<Resolved, WordError> {
        let profile = *decoder.profile();
        if profile.link() != Link::Clocked {
            return Err(WordError::NotClocked);
        }
        let bare = Shape {
            idle: 0,
            preamble: false,
            ..Shape::of(profile)
        };
        let layout = Resolved::new(decoder.main_layout().layout, bare);
        match layout.len {
            bits if bits > WORD_BITS as usize => Err(WordError::TooLong { bits }),
            _ => Ok(layout),
        }
    }
}
