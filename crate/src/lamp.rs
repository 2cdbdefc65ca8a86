//! The LED of MPP and PT: what it says of the data, which bits it stands for, and the way back.
//!
//! ```
//! use encoderscope::lamp::{Health, Lamp, Light, Rhythm};
//! let health = Health::parse("0x50")?;
//! assert_eq!(health.lamp(), Lamp { light: Light::Yellow, rhythm: Rhythm::Blinking });
//! let low = Lamp::parse("yellow", "yes")?.causes()?;
//! assert_eq!(low[0].text, "the battery is below 2.9 V");
//! # Ok::<(), encoderscope::calculator::Fault>(())
//! ```

mod flags;

pub use flags::{Flag, flags};

use crate::{
    bits,
    calculator::Fault,
    format::{STATUS, blinks},
    language::{msg, t},
    layout::StatusBit,
    product::Series,
    text,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// The colour of the LED.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Light {
    /// All is well.
    Green,
    /// A warning.
    Yellow,
    /// An error.
    Red,
    /// It does not shine.
    Dark,
}

impl Light {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Green, Self::Yellow, Self::Red, Self::Dark];

    /// Its name, also in links.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Green => msg("green"),
            Self::Yellow => msg("yellow"),
            Self::Red => msg("red"),
            Self::Dark => msg("dark"),
        }
    }

    /// What it says of the data (MPP and PT, "Status bits").
    #[must_use]
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Green => t("green"),
            Self::Yellow => t("yellow: the position is valid, something is near its limit"),
            Self::Red => t("red: the position is not valid"),
            Self::Dark => t("dark: most likely the encoder has no supply"),
        }
    }
}

/// Whether the LED blinks, once a second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rhythm {
    /// It does not.
    Steady,
    /// It does.
    Blinking,
}

/// What the LED shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lamp {
    /// Its colour.
    pub light: Light,
    /// Whether it blinks.
    pub rhythm: Rhythm,
}

/// Error, warning and status, as a status byte carries them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Health {
    /// b7: the position is not valid.
    pub error: bool,
    /// b6: the position is valid, but something is near its limit.
    pub warning: bool,
    /// b5…b0.
    pub status: u8,
}

/// A bit that a lamp may stand for.
#[derive(Clone, Copy, Debug)]
pub struct Cause {
    /// The bit.
    pub bit: &'static StatusBit,
    /// What has happened when it comes with this lamp.
    pub text: &'static str,
    /// What to do.
    pub remedy: &'static str,
}

/// A bit of a status byte, read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadBit {
    /// Its place in the byte.
    pub place: u32,
    /// Its name.
    pub name: &'static str,
    /// Whether it is 1.
    pub set: bool,
    /// What it says when it is 1.
    pub text: &'static str,
    /// What to do about it; empty for the flags.
    pub remedy: &'static str,
}

/// A row of the manuals' table of battery bits.
#[derive(Clone, Copy, Debug)]
pub struct BatteryBit {
    /// The bit.
    pub place: u32,
    /// What it says with the warning bit; `None` where it never comes with one.
    pub warning: Option<&'static str>,
    /// What it says with the error bit.
    pub error: &'static str,
    /// What to do.
    pub remedy: &'static str,
}

/// The battery bits (MPP and PT, "Status bits related to the battery").
pub static BATTERY: [BatteryBit; 2] = [
    BatteryBit {
        place: 5,
        warning: None,
        error: msg(
            "while the supply was off the battery was disconnected or too low: the turns were \
                lost and have restarted from 0",
        ),
        remedy: msg(
            "check the mounting and the voltage of the battery, then switch the encoder off \
                 and on, which clears the bit",
        ),
    },
    BatteryBit {
        place: 4,
        warning: Some(msg("the battery is below 2.9 V")),
        error: msg("the battery is below 2.7 V"),
        remedy: msg("replace the battery"),
    },
];

const NEAR: &str = msg("near its limit: the position is still valid");
const BEYOND: &str = msg("beyond its limit: the position is not valid");

impl Health {
    /// The health in a status byte.
    #[must_use]
    pub const fn of_byte(byte: u8) -> Self {
        let byte = byte as u64;
        Self {
            error: bits::bit(byte, 7),
            warning: bits::bit(byte, 6),
            status: bits::low_byte(bits::slice(byte, 0, 6)),
        }
    }

    /// Reads a status byte: eight bits, b7 first, or one or two hex digits.
    ///
    /// # Errors
    ///
    /// Says what is wrong with the text.
    ///
    /// ```
    /// use encoderscope::lamp::Health;
    /// assert_eq!(Health::parse("1001 0000"), Health::parse("90"));
    /// assert!(Health::parse("256").is_err());
    /// ```
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let plain: String = text
            .chars()
            .filter(|letter| !letter.is_whitespace() && *letter != '_')
            .collect::<String>()
            .to_ascii_lowercase();
        let (digits, radix) = match (plain.strip_prefix("0x"), plain.len()) {
            (Some(digits), _) => (digits, 16),
            (None, 8..) => (plain.strip_prefix("0b").unwrap_or(&plain), 2),
            (None, _) => (plain.as_str(), 16),
        };
        let fits = match radix {
            2 => digits.len() == 8,
            _ => matches!(digits.len(), 1 | 2),
        };
        let is_digits = digits.chars().all(|digit| digit.is_digit(radix));
        let byte = match fits && is_digits {
            true => u8::from_str_radix(digits, radix).ok(),
            false => None,
        };
        byte.map(Self::of_byte).ok_or_else(|| Fault {
            input: "status",
            message: match plain.is_empty() {
                true => t("no status byte is given").to_string(),
                false => text!(
                    "\"{}\" is no status byte: eight bits, b7 first, or two hex digits",
                    text.trim()
                ),
            },
        })
    }

    /// The colour: an error counts more than a warning.
    #[must_use]
    pub const fn light(self) -> Light {
        match (self.error, self.warning) {
            (true, _) => Light::Red,
            (false, true) => Light::Yellow,
            (false, false) => Light::Green,
        }
    }

    /// What the LED shows.
    #[must_use]
    pub fn lamp(self) -> Lamp {
        let light = self.light();
        let battery = self.asserted().any(|bit| blinks(bit.name));
        Lamp {
            light,
            rhythm: match battery && light != Light::Green {
                true => Rhythm::Blinking,
                false => Rhythm::Steady,
            },
        }
    }

    fn asserted(self) -> impl Iterator<Item = &'static StatusBit> {
        let set = move |bit: &&StatusBit| bits::bit(self.status.into(), bit.place);
        STATUS.iter().filter(set)
    }

    /// All eight bits, b7 first.
    #[must_use]
    pub fn bits(self) -> Vec<ReadBit> {
        let flag = |place, name, set, text| ReadBit {
            place,
            name,
            set,
            text,
            remedy: "",
        };
        let flags = [
            flag(7, "error", self.error, t("the position is not valid")),
            flag(
                6,
                "warning",
                self.warning,
                t("the position is valid, but something is near its limit"),
            ),
        ];
        let light = match self.error {
            true => Light::Red,
            false => Light::Yellow,
        };
        let status = STATUS.iter().map(|bit| {
            let cause = cause(bit, light);
            ReadBit {
                place: bit.place,
                name: bit.name,
                set: bits::bit(self.status.into(), bit.place),
                text: cause.map_or(t("never comes with a warning alone"), |cause| cause.text),
                remedy: cause.map_or(bit.doc, |cause| cause.remedy),
            }
        });
        flags.into_iter().chain(status).collect()
    }

    /// What the manuals leave no room for.
    #[must_use]
    pub fn oddities(self) -> Vec<&'static str> {
        let mut odd = Vec::new();
        let flagged = self.error || self.warning;
        if self.status != 0 && !flagged {
            odd.push(t(
                "a status bit is set without error or warning: the manuals name no such case",
            ));
        }
        if self.status == 0 && flagged {
            odd.push(t(
                "error or warning without a status bit: nothing names the reason",
            ));
        }
        let lost = bits::bit(self.status.into(), 5);
        if lost && self.warning && !self.error {
            odd.push(t(
                "battery disconnected comes with the error bit, never with a warning alone",
            ));
        }
        if self.error && self.warning {
            odd.push(t("error and warning together: the manuals do not name the colour; an error counts more"));
        }
        odd
    }
}

/// What a bit says with a light; `None` where they do not come together.
fn cause(bit: &'static StatusBit, light: Light) -> Option<Cause> {
    let battery = BATTERY.iter().find(|row| row.place == bit.place);
    let (text, remedy) = match (battery, light) {
        (_, Light::Green | Light::Dark) => return None,
        (Some(row), Light::Yellow) => (row.warning?, row.remedy),
        (Some(row), Light::Red) => (row.error, row.remedy),
        (None, Light::Yellow) => (NEAR, bit.doc),
        (None, Light::Red) => (BEYOND, bit.doc),
    };
    Some(Cause { bit, text, remedy })
}

impl Lamp {
    /// A lamp by the names of links: its colour, and whether it blinks, `yes` or `no`.
    ///
    /// # Errors
    ///
    /// Says which names there are.
    pub fn parse(light: &str, blinking: &str) -> Result<Self, Fault> {
        let fault = |input, message| Fault { input, message };
        let found = Light::ALL.into_iter().find(|known| known.name() == light);
        let names = || Light::ALL.map(Light::name).join(", ");
        let light =
            found.ok_or_else(|| fault("lamp", text!("\"{}\" is none of {}", light, names())))?;
        let rhythm = match blinking {
            "yes" => Rhythm::Blinking,
            "no" => Rhythm::Steady,
            _ => {
                let message = text!("\"{}\" is neither yes nor no", blinking);
                return Err(fault("blinking", message));
            }
        };
        Ok(Self { light, rhythm })
    }

    /// Its name: `red`, `red-blinking`.
    #[must_use]
    pub fn name(self) -> String {
        match self.rhythm {
            Rhythm::Steady => self.light.name().to_string(),
            Rhythm::Blinking => format!("{}-blinking", self.light.name()),
        }
    }

    /// What it may stand for: of these bits at least one is set.
    ///
    /// A steady lamp excludes the battery bits, as those make it blink; of a blinking one the
    /// others may be set beside them.
    ///
    /// # Errors
    ///
    /// No encoder shows such a lamp.
    pub fn causes(self) -> Result<Vec<Cause>, Fault> {
        let refuse = |message: &str| {
            Err(Fault {
                input: "blinking",
                message: message.to_string(),
            })
        };
        match (self.light, self.rhythm) {
            (Light::Green, Rhythm::Blinking) => {
                return refuse(t(
                    "green does not blink: what blinks is a warning or an error of the battery, \
                     in yellow or red",
                ));
            }
            (Light::Dark, Rhythm::Blinking) => {
                return refuse(t(
                    "a dark lamp does not blink: choose the colour in which it blinks",
                ));
            }
            _ => {}
        }
        let blinking = self.rhythm == Rhythm::Blinking;
        let bits = STATUS.iter().filter(|bit| blinks(bit.name) == blinking);
        Ok(bits.filter_map(|bit| cause(bit, self.light)).collect())
    }

    /// What to do at once.
    #[must_use]
    pub fn remedy(self) -> &'static str {
        match (self.light, self.rhythm) {
            (Light::Green, _) => t("nothing: the data are good"),
            (Light::Yellow, Rhythm::Steady) => {
                t("go on, and read the status bits: one of them is near its limit")
            }
            (Light::Yellow, Rhythm::Blinking) => {
                t("go on, and replace the battery soon: the turns are lost when it fails")
            }
            (Light::Red, Rhythm::Steady) => {
                t("do not use the position; read the status bits, which name the reason")
            }
            (Light::Red, Rhythm::Blinking) => t(
                "do not use the position; see to the battery, switch the encoder off and on, and \
                 reference the turns anew",
            ),
            (Light::Dark, _) => t(
                "check the supply and its polarity at the encoder's own pins; the manuals do not \
                 speak of a dark lamp",
            ),
        }
    }
}

/// What the source of a series says of lamps and health.
#[must_use]
pub fn about(series: Series) -> &'static str {
    match series {
        Series::Mpp | Series::Pt => t(
            "MPP and PT have an LED of three colours: green, yellow with the warning bit, red with \
             the error bit; it blinks once a second for the bits of the battery. In BiSS-C, says \
             PT, the error bit stands only for the battery, and the warning bit for any error or \
             warning.",
        ),
        Series::Ip75 => t(
            "The manual of IP-75 names no lamp. ASI1 says whether the position is valid (PV) and \
             whether a zero was set (ZPD); SSI7 has an alarm bit, and its error flag on DATA \
             between the words; ASI4 has nothing.",
        ),
        Series::Avs58 | Series::Avm58 | Series::Ass58 | Series::Asm58 => t(
            "The article on Pepperl+Fuchs encoders names neither a lamp nor status bits; a parity \
             bit at most guards the word.",
        ),
    }
}
