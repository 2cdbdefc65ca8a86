//! The profile: the parameters that tell one encoder's frames from another's.
//!
//! Every parameter has one name, in kebab-case on the command line and in links and in
//! camelCase in JavaScript. An omitted parameter takes its format's default.

use crate::{
    format::{Format, rs485::Command},
    model,
    record::Value,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};
use core::fmt;

/// On which side the bits of a BiSS-C dump stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Justify {
    /// The first bit on the wire is the most significant bit of the first byte (SPI capture).
    Left,
    /// The last bit on the wire is the least significant bit of the last byte (a number).
    Right,
}

/// The parameters of an encoder.
///
/// ```
/// use encoderscope::profile::Profile;
/// let profile = Profile::parse([("format", "t485"), ("angle-bits", "17")])?;
/// assert_eq!((profile.angle_bits, profile.baud), (17, 2_500_000));
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Profile {
    /// The wire format.
    pub format: Format,
    /// Bits per turn.
    pub angle_bits: u32,
    /// Bits of the turn counter; 0 for a single-turn encoder.
    pub turns_bits: u32,
    /// Status bits of a BiSS-C frame.
    pub status_bits: u32,
    /// Acknowledge zeros of a BiSS-C frame.
    pub ack_bits: u32,
    /// The RS485 command whose replies are read.
    pub command: Command,
    /// Baud rate of a UART format.
    pub baud: u32,
    /// On which side the bits of a BiSS-C dump stand.
    pub justify: Justify,
}

/// What is wrong with a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProfileError {
    /// The parameter's name.
    pub name: String,
    /// What is wrong, and what would fit.
    pub message: String,
}

impl fmt::Display for ProfileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.name, self.message)
    }
}

impl core::error::Error for ProfileError {}

fn error(name: &str, message: impl Into<String>) -> ProfileError {
    ProfileError {
        name: name.to_string(),
        message: message.into(),
    }
}

/// A parameter: its name, and how it is written and read.
struct Parameter {
    name: &'static str,
    show: fn(&Profile) -> Value,
    set: fn(&mut Profile, &str) -> Result<(), String>,
}

const PARAMETERS: &[Parameter] = &[
    Parameter {
        name: "angle-bits",
        show: |p| p.angle_bits.into(),
        set: |p, text| number(text).map(|value| p.angle_bits = value),
    },
    Parameter {
        name: "turns-bits",
        show: |p| p.turns_bits.into(),
        set: |p, text| number(text).map(|value| p.turns_bits = value),
    },
    Parameter {
        name: "status-bits",
        show: |p| p.status_bits.into(),
        set: |p, text| number(text).map(|value| p.status_bits = value),
    },
    Parameter {
        name: "ack-bits",
        show: |p| p.ack_bits.into(),
        set: |p, text| number(text).map(|value| p.ack_bits = value),
    },
    Parameter {
        name: "command",
        show: |p| p.command.letter().to_string().into(),
        set: |p, text| {
            Command::parse(text)
                .map(|value| p.command = value)
                .ok_or_else(|| format!("{text:?} is no command; known: 0 1 d s t"))
        },
    },
    Parameter {
        name: "baud",
        show: |p| p.baud.into(),
        set: |p, text| number(text).map(|value| p.baud = value),
    },
    Parameter {
        name: "justify",
        show: |p| {
            match p.justify {
                Justify::Left => "left",
                Justify::Right => "right",
            }
            .into()
        },
        set: |p, text| match text {
            "left" => {
                p.justify = Justify::Left;
                Ok(())
            }
            "right" => {
                p.justify = Justify::Right;
                Ok(())
            }
            _ => Err(format!("{text:?} is no side; known: left right")),
        },
    },
];

fn number(text: &str) -> Result<u32, String> {
    text.parse()
        .map_err(|_| format!("{text:?} is not a whole number"))
}

impl Profile {
    /// A profile from names and values, in any order; `model` stands for all it implies.
    ///
    /// # Errors
    ///
    /// An unknown name, an unreadable value, a width the format has no room for, or no
    /// `format` and no `model`.
    pub fn parse<'a>(
        pairs: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Self, ProfileError> {
        let pairs: Vec<(String, &str)> = pairs
            .into_iter()
            .map(|(name, value)| (kebab(name), value))
            .collect();
        let find = |wanted: &str| {
            pairs
                .iter()
                .find(|(name, _)| name == wanted)
                .map(|pair| pair.1)
        };
        let mut profile = match (find("model"), find("format")) {
            (Some(code), _) => {
                model::parse(code)
                    .map_err(|fault| error("model", fault.to_string()))?
                    .profile
            }
            (None, Some(name)) => Format::parse(name)
                .ok_or_else(|| {
                    error(
                        "format",
                        format!("{name:?} is not known; known: {}", Format::names()),
                    )
                })?
                .default_profile(),
            (None, None) => {
                return Err(error(
                    "format",
                    format!("is missing; known: {}", Format::names()),
                ));
            }
        };
        for (name, value) in &pairs {
            if name == "format" || name == "model" {
                continue;
            }
            let parameter = PARAMETERS
                .iter()
                .find(|parameter| parameter.name == name)
                .ok_or_else(|| error(name, "is no parameter of a profile"))?;
            (parameter.set)(&mut profile, value).map_err(|message| error(name, message))?;
        }
        profile.check()?;
        Ok(profile)
    }

    /// Whether `name`, in either spelling, names a parameter.
    #[must_use]
    pub fn knows(name: &str) -> bool {
        let name = kebab(name);
        name == "format" || name == "model" || PARAMETERS.iter().any(|known| known.name == name)
    }

    /// The parameters this profile's format uses, with their values, `format` first.
    #[must_use]
    pub fn parameters(&self) -> Vec<(&'static str, Value)> {
        let used = self.format.parameters();
        core::iter::once(("format", self.format.name().into()))
            .chain(
                PARAMETERS
                    .iter()
                    .filter(|known| used.contains(&known.name))
                    .map(|known| (known.name, (known.show)(self))),
            )
            .collect()
    }

    /// Whether the widths fit the format.
    ///
    /// # Errors
    ///
    /// Names the parameter that is out of range, and the range.
    pub fn check(&self) -> Result<(), ProfileError> {
        let limits = self.format.limits();
        let range = |name, value: u32, low: u32, high: u32| {
            if (low..=high).contains(&value) {
                Ok(())
            } else {
                Err(error(
                    name,
                    format!("{value} is not in {low}…{high} of {}", self.format.title()),
                ))
            }
        };
        range("angle-bits", self.angle_bits, 1, limits.angle)?;
        range("turns-bits", self.turns_bits, 0, limits.turns)?;
        range("status-bits", self.status_bits, 0, 8)?;
        range("ack-bits", self.ack_bits, 1, 255)?;
        range("baud", self.baud, 1, 50_000_000)?;
        if self.angle_bits + self.turns_bits > limits.together {
            return Err(error(
                "turns-bits",
                format!(
                    "{} and {} bits of angle exceed the {} of {}",
                    self.turns_bits,
                    self.angle_bits,
                    limits.together,
                    self.format.title()
                ),
            ));
        }
        Ok(())
    }
}

/// `angleBits` and `angle-bits` are one name.
fn kebab(name: &str) -> String {
    let mut out = String::new();
    for letter in name.chars() {
        if letter.is_ascii_uppercase() {
            out.push('-');
        }
        out.push(letter.to_ascii_lowercase());
    }
    out
}

/// The JavaScript spelling of a parameter's name.
#[must_use]
pub fn camel(name: &str) -> String {
    let mut out = String::new();
    let mut upper = false;
    for letter in name.chars() {
        if letter == '-' {
            upper = true;
        } else {
            out.push(if upper {
                letter.to_ascii_uppercase()
            } else {
                letter
            });
            upper = false;
        }
    }
    out
}
