//! Numbers as people write them, into fields.

use crate::{
    bits,
    explain::tenths,
    language::{number, t},
    layout::{Field, Resolved, Role},
    profile::TurnsCode,
    say,
};
use alloc::string::{String, ToString};
use core::fmt;

/// Why a value is not put into a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The frame has no such field.
    NoField,
    /// It is no number.
    NoNumber,
    /// It does not fit.
    Range {
        /// The smallest that fits.
        least: i128,
        /// The largest that fits.
        most: i128,
        /// Whether both count tenths.
        tenths: bool,
    },
    /// Angles are less than a turn.
    Turn,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NoField => f.write_str(t("the frame has no such field")),
            Self::NoNumber => f.write_str(t("this is no number")),
            Self::Range {
                least,
                most,
                tenths,
            } => {
                let unit = if tenths { 10.0 } else { 1.0 };
                match tenths {
                    true => say!(
                        f,
                        "{} to {} fit",
                        number(least as f64 / unit),
                        number(most as f64 / unit)
                    ),
                    false => say!(f, "{} to {} fit", least, most),
                }
            }
            Self::Turn => f.write_str(t("an angle is at least 0° and less than 360°")),
        }
    }
}

impl core::error::Error for Refusal {}

impl Resolved {
    /// The value of a field, as [`super::Sketch::enter`] takes it.
    pub(super) fn entry(&self, field: &Field, raw: u64) -> String {
        match field.row.role {
            Role::Turns => self.turns(raw).to_string(),
            Role::Speed | Role::Temperature => {
                tenths(bits::signed(raw, field.width as usize) as i32)
            }
            _ => raw.to_string(),
        }
    }

    /// The number of a field that a text says.
    pub(super) fn entered(&self, field: &Field, text: &str) -> Result<u64, Refusal> {
        let text = text.trim();
        let role = field.row.role;
        let degrees = text.strip_suffix('°');
        if role == Role::Angle && (degrees.is_some() || text.contains(['.', ','])) {
            let angle_bits = self.shape.profile.angle_bits;
            return counts(decimal(degrees.unwrap_or(text))?, angle_bits);
        }
        let width = field.width as usize;
        let unsigned = (0, i128::from(bits::mask(width)));
        let signed = (
            -i128::from(bits::mask(width.saturating_sub(1))) - 1,
            i128::from(bits::mask(width.saturating_sub(1))),
        );
        let in_tenths = matches!(role, Role::Speed | Role::Temperature);
        let (least, most) = match role {
            Role::Speed | Role::Temperature => signed,
            Role::Turns if self.shape.profile.turns_code == TurnsCode::Signed => signed,
            Role::Angle => (
                0,
                i128::from(bits::mask(self.shape.profile.angle_bits as usize)),
            ),
            _ => unsigned,
        };
        let number = match in_tenths {
            true => rounded(decimal(text)? * 10.0),
            false => whole(text)?,
        };
        match (least..=most).contains(&number) {
            true => Ok(number as u64 & bits::mask(width)),
            false => Err(Refusal::Range {
                least,
                most,
                tenths: in_tenths,
            }),
        }
    }
}

/// Degrees as counts, the nearest; just below a full turn that is 0 again.
fn counts(degrees: f64, angle_bits: u32) -> Result<u64, Refusal> {
    if !(0.0..360.0).contains(&degrees) {
        return Err(Refusal::Turn);
    }
    let nearest = (degrees / 360.0 * bits::power(angle_bits) + 0.5) as u128;
    Ok(nearest as u64 & bits::mask(angle_bits as usize))
}

fn rounded(number: f64) -> i128 {
    let half = if number < 0.0 { -0.5 } else { 0.5 };
    (number + half) as i128
}

/// A number with a point or a comma; a true minus sign is one too.
fn decimal(text: &str) -> Result<f64, Refusal> {
    let plain = plain(text).replace(',', ".");
    let number: f64 = plain.parse().map_err(|_| Refusal::NoNumber)?;
    number
        .is_finite()
        .then_some(number)
        .ok_or(Refusal::NoNumber)
}

/// A whole number: decimal, hexadecimal with 0x or binary with 0b.
fn whole(text: &str) -> Result<i128, Refusal> {
    let plain = plain(text);
    let radix = |prefix: &str, radix: u32| {
        let digits = plain.strip_prefix(prefix)?;
        Some(u64::from_str_radix(digits, radix).map(i128::from))
    };
    let number = radix("0x", 16)
        .or_else(|| radix("0X", 16))
        .or_else(|| radix("0b", 2))
        .unwrap_or_else(|| plain.parse());
    number.map_err(|_| Refusal::NoNumber)
}

/// Without the spaces that group digits.
fn plain(text: &str) -> String {
    let letters = text.chars().filter(|letter| !letter.is_whitespace());
    letters
        .map(|letter| if letter == '−' { '-' } else { letter })
        .collect()
}
