//! Order codes: from the label on the encoder to a profile (MPP and PT, "Order code").
//!
//! `MPP-20-30-A-24BM-R-N-A-M`: series – rotor – stator – output – resolution – interface –
//! supply – temperature – option.

use crate::{format::Format, profile::Profile};
use alloc::{format, string::String, vec::Vec};
use core::fmt;

/// What an order code says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Model {
    /// The profile it implies.
    pub profile: Profile,
    /// `MPP` or `PT`.
    pub series: String,
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
        write!(
            f,
            "part {} of the order code: {}",
            self.position, self.message
        )
    }
}

impl core::error::Error for ModelError {}

/// What each part of a code must be.
const PARTS: [&str; 9] = [
    "series, MPP or PT",
    "rotor diameter in mm, such as 20 or 15B",
    "stator diameter in mm, such as 30 or 25H",
    "output, A",
    "resolution, such as 24, 24M, 24BM or 24FM",
    "interface, one of S B R A T D P",
    "supply, N",
    "temperature, A, B or C",
    "option, M or a baud code A or B",
];

/// Parses an order code.
///
/// # Errors
///
/// Says which part is wrong and what fits there.
///
/// ```
/// let model = encoderscope::model::parse("MPP-40-60-A-23BM-T-N-A-M").unwrap();
/// assert_eq!((model.profile.angle_bits, model.profile.turns_bits), (23, 16));
/// let wrong = encoderscope::model::parse("MPP-40-60-A-23BM-Z-N-A-M").unwrap_err();
/// assert_eq!(wrong.position, 6);
/// ```
pub fn parse(code: &str) -> Result<Model, ModelError> {
    let upper = code.trim().to_ascii_uppercase();
    let parts: Vec<&str> = upper.split('-').collect();
    let wrong = |position: usize| ModelError {
        position,
        message: format!(
            "\"{}\" is not a {}",
            parts.get(position - 1).copied().unwrap_or(""),
            PARTS
                .get(position - 1)
                .copied()
                .unwrap_or("part: the code has nine")
        ),
    };
    let part = |position: usize| {
        parts
            .get(position - 1)
            .copied()
            .ok_or_else(|| wrong(position))
    };
    let one_of = |position: usize, known: &[&str]| {
        part(position).and_then(|text| {
            if known.contains(&text) {
                Ok(())
            } else {
                Err(wrong(position))
            }
        })
    };
    let series = part(1)?;
    one_of(1, &["MPP", "PT"])?;
    diameter(part(2)?, 'B').ok_or_else(|| wrong(2))?;
    diameter(part(3)?, 'H').ok_or_else(|| wrong(3))?;
    one_of(4, &["A"])?;
    let (angle_bits, turns_bits) = resolution(part(5)?).ok_or_else(|| wrong(5))?;
    let interface = part(6)?;
    let format = match interface {
        "S" => Format::Ssi,
        "B" => Format::BissC,
        "R" | "A" => Format::Rs485,
        "T" => Format::T485,
        "D" => Format::Bus,
        "P" => Format::Period,
        _ => return Err(wrong(6)),
    };
    if format == Format::T485 && !matches!(angle_bits, 17 | 23) {
        return Err(ModelError {
            position: 5,
            message: format!("{angle_bits} bits do not exist with T485, which has 17 or 23"),
        });
    }
    one_of(7, &["N"])?;
    one_of(8, &["A", "B", "C"])?;
    one_of(9, &["M", "A", "B"])?;
    if parts.len() > PARTS.len() {
        return Err(wrong(PARTS.len() + 1));
    }
    let slow = format == Format::Rs485 && parts[8] == "A";
    let profile = Profile {
        angle_bits,
        turns_bits,
        baud: if slow { 115_200 } else { 2_500_000 },
        ..format.default_profile()
    };
    Ok(Model {
        profile,
        series: series.into(),
    })
}

fn diameter(text: &str, suffix: char) -> Option<u32> {
    text.strip_suffix(suffix).unwrap_or(text).parse().ok()
}

/// `24BM` → 24 bits per turn and 16 bits of turns.
fn resolution(text: &str) -> Option<(u32, u32)> {
    let letters = text.trim_start_matches(|letter: char| letter.is_ascii_digit());
    let digits = text.strip_suffix(letters)?;
    let turns = match letters {
        "" | "S" => 0,
        "M" | "BM" | "FM" => 16,
        _ => return None,
    };
    let angle = digits
        .parse()
        .ok()
        .filter(|bits| (16..=24).contains(bits))?;
    Some((angle, turns))
}
