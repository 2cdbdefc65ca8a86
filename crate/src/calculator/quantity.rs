//! Numbers as people write them: `200`, `2,5 MHz`, `6.5 ns/m`, `1 000 000`.

use crate::{
    language::{self, msg, t},
    text,
};
use alloc::{
    format,
    string::{String, ToString},
};

/// What a number counts: units of one kind, of which each is a multiple of the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// A plain number, of which there are only whole ones.
    Count,
    /// A plain number.
    Fraction,
    /// Bits.
    Bits,
    /// Frequencies.
    Frequency,
    /// Baud rates.
    Rate,
    /// Times.
    Time,
    /// Times per length.
    Delay,
    /// Lengths.
    Length,
    /// Angles.
    Angle,
    /// Addresses: whole numbers, in hexadecimal digits behind `0x`.
    Address,
}

/// What Russians write for units.
const CYRILLIC: &[(&str, &str)] = &[
    ("бит", "bits"),
    ("бита", "bits"),
    ("биты", "bits"),
    ("Гц", "Hz"),
    ("кГц", "kHz"),
    ("МГц", "MHz"),
    ("бод", "baud"),
    ("кбод", "kbaud"),
    ("Мбод", "Mbaud"),
    ("с", "s"),
    ("мс", "ms"),
    ("мкс", "µs"),
    ("нс", "ns"),
    ("нс/м", "ns/m"),
    ("м", "m"),
    ("см", "cm"),
    ("мм", "mm"),
    ("мкм", "µm"),
];

impl Measure {
    /// Its units, with how many of the first each is.
    const fn units(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::Count | Self::Fraction | Self::Address => &[],
            Self::Bits => const { &[(msg("bits"), 1.0), ("bit", 1.0)] },
            Self::Frequency => const { &[(msg("Hz"), 1.0), (msg("kHz"), 1e3), (msg("MHz"), 1e6)] },
            Self::Rate => {
                const {
                    &[
                        (msg("baud"), 1.0),
                        ("Bd", 1.0),
                        (msg("kbaud"), 1e3),
                        ("kBd", 1e3),
                        (msg("Mbaud"), 1e6),
                        ("MBd", 1e6),
                    ]
                }
            }
            Self::Time => {
                const {
                    &[
                        (msg("s"), 1.0),
                        (msg("ms"), 1e-3),
                        (msg("µs"), 1e-6),
                        ("μs", 1e-6),
                        ("us", 1e-6),
                        (msg("ns"), 1e-9),
                    ]
                }
            }
            Self::Delay => const { &[(msg("ns/m"), 1.0)] },
            Self::Length => {
                const {
                    &[
                        (msg("m"), 1.0),
                        (msg("cm"), 1e-2),
                        (msg("mm"), 1e-3),
                        (msg("µm"), 1e-6),
                        ("μm", 1e-6),
                        ("um", 1e-6),
                    ]
                }
            }
            Self::Angle => &[
                ("°", 1.0),
                ("deg", 1.0),
                ("′", 1.0 / 60.0),
                ("'", 1.0 / 60.0),
                ("arcmin", 1.0 / 60.0),
                ("″", 1.0 / 3600.0),
                ("\"", 1.0 / 3600.0),
                ("arcsec", 1.0 / 3600.0),
            ],
        }
    }

    fn scale(self, unit: &str) -> Option<f64> {
        let units = self.units();
        let cyrillic = CYRILLIC.iter().find(|(name, _)| *name == unit);
        let unit = cyrillic.map_or(unit, |(_, latin)| latin);
        // mHz is no MHz: prefixes keep their case, other letters need not.
        let is_prefixed = unit.starts_with(['m', 'M']);
        let exact = units.iter().find(|(name, _)| *name == unit);
        let alike = || {
            let mut alike = units.iter();
            alike.find(|(name, _)| !is_prefixed && name.eq_ignore_ascii_case(unit))
        };
        let found = exact.or_else(alike);
        found.map(|(_, scale)| *scale)
    }
}

/// The number in a text, in `unit`; a unit behind it may be another of the same measure.
///
/// Spaces of any width may group the digits, and the decimal sign is a point or a comma. An address
/// may be hexadecimal.
///
/// # Errors
///
/// Says what is not a number, or which units there are.
///
/// ```
/// use encoderscope::calculator::quantity::{Measure, parse};
/// assert_eq!(parse("2,5 MHz", Measure::Frequency, "kHz"), Ok(2500.0));
/// assert_eq!(parse("2,5 МГц", Measure::Frequency, "kHz"), Ok(2500.0));
/// assert_eq!(parse("1 000 000", Measure::Count, ""), Ok(1e6));
/// assert_eq!(parse("0xD0_80", Measure::Address, ""), Ok(53376.0));
/// assert!(parse("200 apples", Measure::Length, "m").is_err());
/// ```
pub fn parse(text: &str, measure: Measure, unit: &str) -> Result<f64, String> {
    let text = text.trim();
    if measure == Measure::Address && text.contains(|letter: char| letter.is_ascii_alphabetic()) {
        return address(text).ok_or_else(|| {
            text!(
                "\"{}\" is not an address: hexadecimal digits stand behind 0x",
                text
            )
        });
    }
    let is_part = |letter: char| letter.is_ascii_digit() || ".,-−+".contains(letter);
    let after = |from: usize, is_part: &dyn Fn(char) -> bool| {
        let rest = text.get(from..).unwrap_or("");
        from + rest.find(|letter| !is_part(letter)).unwrap_or(rest.len())
    };
    let mut end = after(0, &|letter| is_part(letter) || letter.is_whitespace());
    let exponent = text
        .get(end..)
        .and_then(|rest| rest.strip_prefix(['e', 'E']));
    if exponent.is_some_and(|rest| rest.starts_with(is_part)) {
        end = after(end + 1, &is_part);
    }
    let (digits, name) = text.split_at(end);
    if let Some(whole) = thousands(digits) {
        return Err(text!(
            "\"{}\" may be a thousand or a fraction: write {} or use a point",
            text,
            whole
        ));
    }
    let digits: String = digits
        .chars()
        .filter(|letter| !letter.is_whitespace())
        .map(|letter| match letter {
            ',' => '.',
            '−' => '-',
            other => other,
        })
        .collect();
    let number: f64 = match digits.is_empty() {
        true if text.is_empty() => return Err(t("is empty").into()),
        _ => digits
            .parse()
            .map_err(|_| text!("\"{}\" is not a number", text))?,
    };
    let of = |name: &str| measure.scale(name).unwrap_or(1.0);
    match name.trim() {
        name if name.is_empty() || name == unit => Ok(number),
        name => measure
            .scale(name)
            .map(|scale| number * (scale / of(unit)))
            .ok_or_else(|| {
                let known: alloc::vec::Vec<_> =
                    measure.units().iter().map(|(name, _)| t(name)).collect();
                match known.is_empty() {
                    true => text!("\"{}\" stands behind a plain number", name),
                    false => text!("\"{}\" is none of {}", name, known.join(", ")),
                }
            }),
    }
}

/// The number of hexadecimal digits behind `0x`.
fn address(text: &str) -> Option<f64> {
    let digits = text
        .strip_prefix("0x")
        .or_else(|| text.strip_prefix("0X"))?;
    let digits = digits.chars().filter(|letter| *letter != '_');
    let mut address = None;
    for letter in digits {
        address = Some(address.unwrap_or(0.0) * 16.0 + f64::from(letter.to_digit(16)?));
    }
    address
}

/// The number with its comma taken for one that groups thousands, where it may be one.
fn thousands(digits: &str) -> Option<String> {
    let (whole, group) = digits.trim().split_once(',')?;
    let is_number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let unclear = !matches!(whole, "" | "0") && group.len() == 3;
    (unclear && is_number(whole) && is_number(group)).then(|| format!("{whole}{group}"))
}

/// A number with so many significant digits, its thousands apart and without trailing zeros.
///
/// ```
/// use encoderscope::calculator::quantity::rounded;
/// assert_eq!(rounded(79.1015625, 3), "79.1");
/// assert_eq!(rounded(2_526_315.79, 4), "2\u{202f}526\u{202f}000");
/// assert_eq!(rounded(0.0, 3), "0");
/// assert_eq!(rounded(-0.000_123_4, 2), "−0.00012");
/// ```
#[must_use]
pub fn rounded(number: f64, digits: i32) -> String {
    if !number.is_finite() {
        return "∞".into();
    }
    let sign = if number < 0.0 { "−" } else { "" };
    let size = number.abs();
    let mut places = digits - 1;
    let mut scale = 1.0;
    while size >= 10.0 * scale && scale < 1e300 {
        scale *= 10.0;
        places -= 1;
    }
    while size > 0.0 && size < scale && scale > 1e-300 {
        scale /= 10.0;
        places += 1;
    }
    let size = match places < 0 {
        true => {
            let mut step = 1.0;
            for _ in places..0 {
                step *= 10.0;
            }
            (size / step + 0.5) as u64 as f64 * step
        }
        false => size,
    };
    let text = format!("{size:.*}", usize::try_from(places).unwrap_or(0));
    let (whole, part) = text.split_once('.').unwrap_or((&text, ""));
    let whole = whole
        .parse()
        .map_or_else(|_| whole.into(), crate::explain::grouped);
    match part.trim_end_matches('0') {
        "" => format!("{sign}{whole}"),
        part => format!("{sign}{whole}.{part}"),
    }
}

/// The same as people of the language write it.
pub(super) fn shown(number: f64, digits: i32) -> String {
    language::number(rounded(number, digits)).to_string()
}
