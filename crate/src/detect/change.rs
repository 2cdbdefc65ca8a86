//! Mistakes of a capture that can be undone.

use super::sample::{copied, mapped};
use crate::{
    bits::BitString,
    dump::{self, Dump},
    format::Medium,
    language::t,
    text,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// What must be done to a dump before its frames can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// The bits of every byte stand in reverse order.
    Reversed,
    /// Every bit is inverted.
    Inverted,
    /// Every line begins one clock too early: its first bit is not of the word.
    ClockEarly,
    /// Every line begins one clock too late: the first bit of the word, a 0, is not in it.
    ClockLate,
    /// The first byte of every line is missing, and was this.
    MissingByte(u8),
    /// The bytes are the letters of hexadecimal digits.
    HexText,
}

impl Change {
    /// What is wrong with the dump, and what likely made it so.
    #[must_use]
    pub fn sentence(self) -> String {
        match self {
            Self::Reversed => {
                t("the bits of every byte are reversed: the capture was taken last bit first")
                    .to_string()
            }
            Self::Inverted => {
                t("all bits are inverted: A and B, or + and −, of the data line are swapped")
                    .to_string()
            }
            Self::ClockEarly => {
                t("every line begins one clock too early: its first bit is not of the word")
                    .to_string()
            }
            Self::ClockLate => {
                t("every line begins one clock too late: the first bit of the word is missing")
                    .to_string()
            }
            Self::MissingByte(byte) => {
                text!(
                    "the first byte of every line is missing: it was 0x{}",
                    format_args!("{byte:02X}")
                )
            }
            Self::HexText => {
                t("the bytes are letters: hexadecimal digits that were sent as text").to_string()
            }
        }
    }

    /// The name in records.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reversed => "reversed",
            Self::Inverted => "inverted",
            Self::ClockEarly => "clock-early",
            Self::ClockLate => "clock-late",
            Self::MissingByte(_) => "missing-byte",
            Self::HexText => "hex-text",
        }
    }

    /// The change as a link has it: its name, and the byte where one is missing.
    ///
    /// ```
    /// use encoderscope::detect::Change;
    /// for change in [Change::Inverted, Change::MissingByte(0x1a)] {
    ///     assert_eq!(Change::parse(&change.code()), Some(change));
    /// }
    /// assert_eq!(Change::parse("upside-down"), None);
    /// ```
    #[must_use]
    pub fn code(self) -> String {
        match self {
            Self::MissingByte(byte) => format!("{}:{byte:02x}", self.name()),
            other => other.name().to_string(),
        }
    }

    /// The change of a link.
    #[must_use]
    pub fn parse(code: &str) -> Option<Self> {
        let (name, byte) = code.split_once(':').unwrap_or((code, "0"));
        let byte = u8::from_str_radix(byte, 16).ok()?;
        let mut all = [
            Self::Reversed,
            Self::Inverted,
            Self::ClockEarly,
            Self::ClockLate,
            Self::MissingByte(byte),
            Self::HexText,
        ]
        .into_iter();
        all.find(|change| change.name() == name)
    }

    /// The dump as it should have been captured.
    ///
    /// ```
    /// use encoderscope::{detect::Change, dump::parse, format::Medium};
    /// let dump = parse("80 01", Medium::Bytes);
    /// assert_eq!(Change::Reversed.apply(&dump).bytes(), [0x01, 0x80]);
    /// assert_eq!(Change::Inverted.apply(&dump).bytes(), [0x7f, 0xfe]);
    /// assert_eq!(Change::MissingByte(0x1a).apply(&dump).bytes(), [0x1a, 0x80, 0x01]);
    /// ```
    #[must_use]
    pub fn apply(self, dump: &Dump) -> Dump {
        match self {
            Self::HexText => {
                let letters = dump.bytes().iter().map(|byte| char::from(*byte)).collect();
                let text: String = letters;
                dump::parse(&text, Medium::Bytes)
            }
            Self::Reversed => mapped(dump, &mut |bits| {
                // A string of 0 and 1 has no bytes: it is turned round as a whole.
                if bits.len().is_multiple_of(8) {
                    let bytes = bits.bytes().iter().map(|byte| byte.reverse_bits());
                    return BitString::of_bytes(bytes.collect());
                }
                let mut out = BitString::default();
                (0..bits.len()).rev().for_each(|at| out.push(bits.bit(at)));
                out
            }),
            Self::Inverted => mapped(dump, &mut |bits| {
                let mut out = BitString::default();
                (0..bits.len()).for_each(|at| out.push(!bits.bit(at)));
                out
            }),
            // What is beyond the end reads as 0.
            Self::ClockEarly => mapped(dump, &mut |bits| {
                let mut out = BitString::default();
                (1..=bits.len()).for_each(|at| out.push(bits.bit(at)));
                out
            }),
            Self::ClockLate => mapped(dump, &mut |bits| {
                let mut out = BitString::default();
                out.push(false);
                (1..bits.len()).for_each(|at| out.push(bits.bit(at - 1)));
                out
            }),
            Self::MissingByte(byte) => mapped(dump, &mut |bits| {
                if !bits.len().is_multiple_of(8) {
                    return copied(bits);
                }
                let mut bytes = Vec::from([byte]);
                bytes.extend_from_slice(bits.bytes());
                BitString::of_bytes(bytes)
            }),
        }
    }
}
