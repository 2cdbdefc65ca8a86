//! Decoders as source to paste into a program, and frames as tables.
//!
//! The source is made out of the same layout tables as the decoder, for one profile: it checks
//! what [`crate::layout::Resolved`] checks and reads what it reads.

mod c;
mod plan;
mod python;
mod rust;
pub mod table;
mod text;

use crate::{check::Algorithm, decode::Decoder, language::in_english};
use alloc::string::String;
use plan::Plan;

/// A programming language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// C99 with `stdint.h`, `stdbool.h` and `stddef.h`.
    C,
    /// Rust without the standard library.
    Rust,
    /// Python 3.
    Python,
}

impl Language {
    /// All languages.
    pub const ALL: &[Self] = &[Self::C, Self::Rust, Self::Python];

    /// The name for people.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::C => "C",
            Self::Rust => "Rust",
            Self::Python => "Python",
        }
    }

    /// The ending of a file's name.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::C => "c",
            Self::Rust => "rs",
            Self::Python => "py",
        }
    }
}

/// A decoder for the frames of a profile, as one file without dependencies.
///
/// ```
/// use encoderscope::{decode::Decoder, export::{Language, source}, profile::Profile};
/// let decoder = Decoder::new(Profile::parse([("format", "rs485")])?)?;
/// let text = source(&decoder, Language::C);
/// assert!(text.contains("enum rs485_result decode_rs485(const uint8_t *bytes, size_t len,"));
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[must_use]
pub fn source(decoder: &Decoder, language: Language) -> String {
    in_english(|| {
        let plan = Plan::new(decoder);
        match language {
            Language::C => c::source(&plan),
            Language::Rust => rust::source(&plan),
            Language::Python => python::source(&plan),
        }
    })
}

/// A function that computes a CRC over bytes.
///
/// ```
/// use encoderscope::{check::Checksum, export::{Language, crc_source}};
/// let crc = Checksum::Crc8x97.algorithm().unwrap();
/// assert!(crc_source(&crc, Language::Python).starts_with("def crc_8_0x97(data: bytes) -> int:"));
/// ```
#[must_use]
pub fn crc_source(algorithm: &Algorithm, language: Language) -> String {
    let lines = in_english(|| match language {
        Language::C => c::crc(algorithm, plan::Reach::Bytes),
        Language::Rust => rust::crc(algorithm, plan::Reach::Bytes),
        Language::Python => python::crc(algorithm, plan::Reach::Bytes),
    });
    text::joined(&lines)
}
