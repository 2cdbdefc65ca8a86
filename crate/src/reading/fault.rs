//! What is wrong with a frame, and where.

use super::Checked;
use crate::{
    bits::{self, Bits, Span},
    language::t,
    layout::{Coding, Field, Resolved, Role},
    say,
};
use alloc::vec::Vec;
use core::fmt;

/// What is wrong with a frame, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The bits of the frame that show it.
    pub at: Span,
    /// What is wrong.
    pub kind: FaultKind,
}

/// Kinds of faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// A CRC or parity does not hold.
    Check {
        /// Name of the field.
        name: &'static str,
        /// The numbers.
        checked: Checked,
    },
    /// A fixed field has another value.
    Constant {
        /// Name of the field.
        name: &'static str,
        /// What it must be.
        expected: u64,
        /// What it is.
        received: u64,
    },
    /// The bits above a right-aligned number are not zero: the number is wider than asked for.
    Wider {
        /// Name of the padding.
        name: &'static str,
    },
    /// Bits that are always 0 are not.
    Zeros {
        /// Name of the field.
        name: &'static str,
    },
    /// A number in text has other characters than digits.
    Digits {
        /// Name of the field.
        name: &'static str,
    },
    /// A number in text is larger than the widest one.
    Range {
        /// Name of the field.
        name: &'static str,
        /// The number.
        value: u64,
        /// The largest it can be.
        most: u64,
    },
    /// A repeated word is not the first one again.
    Repeat {
        /// Which word, counted from 1.
        word: u32,
    },
    /// The frame's place is not certain: another phase of the stream passes its checks as well.
    Ambiguous,
}

impl fmt::Display for FaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Check { name, checked } => say!(
                f,
                "{} is 0x{}, the data gives 0x{}",
                t(name),
                format_args!("{:02X}", checked.received),
                format_args!("{:02X}", checked.expected)
            ),
            Self::Constant {
                name,
                expected,
                received,
            } => {
                say!(
                    f,
                    "{} is {}, must be {}",
                    t(name),
                    format_args!("{received:b}"),
                    format_args!("{expected:b}")
                )
            }
            Self::Wider { name } => say!(
                f,
                "{} is not 0: the number is wider than the profile says",
                t(name)
            ),
            Self::Zeros { name } => say!(f, "bits of {} that are always 0 are set", t(name)),
            Self::Digits { name } => say!(f, "{} has characters that are no digits", t(name)),
            Self::Range { name, value, most } => {
                say!(f, "{} is {}, the largest is {}", t(name), value, most)
            }
            Self::Repeat { word } => say!(
                f,
                "word {} is not the first one again: the line disturbs the transmission",
                word
            ),
            Self::Ambiguous => f.write_str(t(
                "the check passes, but may do so by chance: where frames begin is not certain",
            )),
        }
    }
}

impl Resolved {
    /// Everything that is wrong with a frame; nothing for a good one.
    #[must_use]
    pub fn faults(&self, bits: Bits<'_>) -> Vec<Fault> {
        if self.passes_sieve(bits) == Some(true) {
            return Vec::new();
        }
        self.fields()
            .filter_map(|field| self.fault(field, bits))
            .collect()
    }

    /// Whether every check of the frame holds.
    #[must_use]
    #[inline]
    pub fn holds(&self, bits: Bits<'_>) -> bool {
        match self.passes_sieve(bits) {
            Some(holds) => holds,
            None => self.fields().all(|field| self.fault(field, bits).is_none()),
        }
    }

    /// What is wrong with one field.
    #[must_use]
    pub fn fault(&self, field: &Field, bits: Bits<'_>) -> Option<Fault> {
        let parts = self.parts(field);
        let at = parts.first().map_or_else(Span::default, |part| part.span);
        let kind = if field.row.role == Role::Repeat {
            let word = self.broken_repeat(at, bits)?;
            FaultKind::Repeat { word }
        } else {
            self.fault_kind(field, bits)?
        };
        Some(Fault { at, kind })
    }

    fn fault_kind(&self, field: &Field, bits: Bits<'_>) -> Option<FaultKind> {
        let name = field.row.name;
        let raw = self.read(field, bits);
        if let Some((Coding::Decimal, text)) = self.coding(field) {
            let most = bits::mask(self.shape.profile.angle_bits as usize);
            return match bits.decimal(text) {
                None => Some(FaultKind::Digits { name }),
                Some(value) if value > most => Some(FaultKind::Range { name, value, most }),
                Some(_) => None,
            };
        }
        if let Some(expected) = field.row.constant.filter(|expected| *expected != raw) {
            let received = raw;
            return Some(match field.row.role {
                Role::Padding => FaultKind::Wider { name },
                _ => FaultKind::Constant {
                    name,
                    expected,
                    received,
                },
            });
        }
        if raw & field.row.zeros != 0 {
            return Some(FaultKind::Zeros { name });
        }
        let checked = self
            .checked(field, bits)
            .filter(|checked| field.is_binding() && !checked.ok())?;
        Some(FaultKind::Check { name, checked })
    }

    /// Which of the words in `repeats` is not, behind a 0, the word in front of them.
    fn broken_repeat(&self, repeats: Span, bits: Bits<'_>) -> Option<u32> {
        let word = self.shape.profile.frame_bits as usize;
        let first = repeats.start.checked_sub(word)?;
        (0..self.shape.repeats).find_map(|index| {
            let zero = repeats.start + index as usize * (word + 1);
            let same = (0..word).all(|at| bits.bit(first + at) == bits.bit(zero + 1 + at));
            (bits.bit(zero) || !same).then_some(index + 2)
        })
    }
}
