//! The profile: the parameters that tell one encoder's frames from another's.
//!
//! Every parameter has one name, in kebab-case on the command line and in links and in
//! camelCase in JavaScript. An omitted parameter takes its format's default.

mod choice;
mod parameter;

pub(crate) use choice::choice;
pub use choice::{Align, Choice, Code, Dialect, Justify, Marker, Parity, StatusActive, TurnsCode};

use parameter::{PARAMETERS, setter};

use crate::{
    format::{
        Format, Link, Medium,
        own::{self, Own},
        rs485::Command,
        ssi_tree,
    },
    language::t,
    model,
    record::Value,
    text,
};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};
use core::fmt;

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
    /// Address of the device on a BUS, 0…31.
    pub address: u32,
    /// Code of an SSI word.
    pub code: Code,
    /// Where the number stands in an SSI word.
    pub align: Align,
    /// Bits of an SSI word.
    pub frame_bits: u32,
    /// Parity of an SSI word or of a BUS request.
    pub parity: Parity,
    /// How the turn counter is read.
    pub turns_code: TurnsCode,
    /// Polarity of the status bits of BiSS-C.
    pub status_active: StatusActive,
    /// Meaning of the T485 alarm byte.
    pub dialect: Dialect,
    /// Top bits of an ASI1 packet.
    pub marker: Marker,
    /// Baud rate of a UART format.
    pub baud: u32,
    /// On which side the bits of a dump stand in its bytes.
    pub justify: Justify,
    /// A layout of the user's own.
    pub own: Option<&'static Own>,
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

impl Profile {
    /// What most formats have in common; a format's own default overrides it.
    #[must_use]
    pub const fn base(format: Format) -> Self {
        Self {
            format,
            angle_bits: 24,
            turns_bits: 16,
            status_bits: 6,
            ack_bits: 5,
            command: Command::Status,
            address: 0x1f,
            code: Code::Binary,
            align: Align::Right,
            frame_bits: 0,
            parity: Parity::None,
            turns_code: TurnsCode::Unsigned,
            status_active: StatusActive::High,
            dialect: Dialect::Mpp,
            marker: Marker::None,
            baud: 2_500_000,
            justify: Justify::Right,
            own: None,
        }
    }

    /// The name of the format for people; of the user's own layouts their title.
    #[must_use]
    pub fn title(&self) -> &'static str {
        self.own.map_or(t(self.format.title()), Own::title)
    }

    /// The manual that describes the format, and the place in it.
    #[must_use]
    pub fn source(&self) -> &'static str {
        let source = self.own.and_then(Own::source);
        source.unwrap_or(self.format.manual().source)
    }

    /// How frames come.
    #[must_use]
    pub fn link(&self) -> Link {
        self.own.map_or(self.format.spec().link, Own::link)
    }

    /// What a dump consists of.
    #[must_use]
    pub fn medium(&self) -> Medium {
        match (self.link(), self.format) {
            (Link::Clocked, _) => Medium::Bits,
            (_, Format::Asi4) => Medium::Text,
            (Link::Polled | Link::Stream, _) => Medium::Bytes,
        }
    }

    /// Whether the encoder is read over a serial port.
    #[must_use]
    pub fn is_serial(&self) -> bool {
        self.link() != Link::Clocked
    }

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
                        text!("\"{}\" is not known; known: {}", name, Format::names()),
                    )
                })?
                .default_profile(),
            (None, None) => {
                return Err(error(
                    "format",
                    text!("is missing; known: {}", Format::names()),
                ));
            }
        };
        // What a layout implies gives way to what is said beside it.
        let (layouts, others): (Vec<_>, Vec<_>) =
            pairs.iter().partition(|(name, _)| name == "layout");
        for (name, value) in layouts.into_iter().chain(others) {
            if name != "format" && name != "model" {
                profile.set(name, value)?;
            }
        }
        if find("frame-bits").is_none() && find("model").is_none() {
            profile.frame_bits = profile.natural_frame_bits();
        }
        profile.check()?;
        Ok(profile)
    }

    /// The word length that these widths have in practice: 13 clocks for a single turn of an SSI
    /// encoder and 25 for a multi-turn one, more where they do not fit; 30 for SSI7.
    #[must_use]
    pub const fn natural_frame_bits(&self) -> u32 {
        match self.format {
            Format::SsiTree => {
                let common = if self.turns_bits == 0 { 13 } else { 25 };
                let needed = ssi_tree::needed_bits(self);
                if needed > common { needed } else { common }
            }
            _ => self.format.default_profile().frame_bits,
        }
    }

    /// This profile with one parameter changed; a word length that follows from the widths goes
    /// with them.
    ///
    /// ```
    /// use encoderscope::format::Format;
    /// let profile = Format::SsiTree.default_profile().with("turns-bits", "0")?;
    /// assert_eq!(profile.frame_bits, 13);
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// An unknown name, an unreadable value, or a width the format has no room for.
    pub fn with(&self, name: &str, value: &str) -> Result<Self, ProfileError> {
        let mut changed = *self;
        let name = kebab(name);
        changed.set(&name, value)?;
        if name != "frame-bits" && self.frame_bits == self.natural_frame_bits() {
            changed.frame_bits = changed.natural_frame_bits();
        }
        changed.check()?;
        Ok(changed)
    }

    fn set(&mut self, name: &str, value: &str) -> Result<(), ProfileError> {
        let set = setter(name).ok_or_else(|| error(name, t("is no parameter of a profile")))?;
        set(self, value).map_err(|message| error(name, message))
    }

    /// The words that a parameter can be; none for a number.
    #[must_use]
    pub fn words(name: &str) -> &'static [&'static str] {
        let known = PARAMETERS.iter().find(|known| known.name == name);
        known.map_or(&[], |known| known.words)
    }

    /// What a parameter is, in a few words; empty where there is none of the name.
    ///
    /// ```
    /// assert_eq!(encoderscope::profile::Profile::doc("angle-bits"), "bits per turn");
    /// ```
    #[must_use]
    pub fn doc(name: &str) -> &'static str {
        let known = PARAMETERS.iter().find(|known| known.name == name);
        known.map_or("", |known| known.doc)
    }

    /// What each of a parameter's [words](Self::words) means.
    #[must_use]
    pub fn word_docs(name: &str) -> &'static [&'static str] {
        let known = PARAMETERS.iter().find(|known| known.name == name);
        known.map_or(&[], |known| known.docs)
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

    /// The least and the greatest that a number of this profile's format can be; nothing for
    /// words, and for what the format does not use.
    ///
    /// ```
    /// use encoderscope::format::Format;
    /// assert_eq!(Format::Bus.default_profile().range("address"), Some((0, 31)));
    /// assert_eq!(Format::Ssi.default_profile().range("address"), None);
    /// ```
    #[must_use]
    pub fn range(&self, name: &str) -> Option<(u32, u32)> {
        let limits = self.format.limits();
        let used = |range| self.format.parameters().contains(&name).then_some(range);
        match name {
            "angle-bits" => Some((1, limits.angle)),
            "turns-bits" => Some((0, limits.turns)),
            "status-bits" => used((0, 8)),
            "ack-bits" => used((1, 64)),
            "baud" => used((1, 50_000_000)),
            "address" => used((0, 31)),
            "frame-bits" => used((
                match self.format {
                    Format::SsiTree => ssi_tree::needed_bits(self),
                    _ => limits.frame.0,
                },
                limits.frame.1,
            )),
            _ => None,
        }
    }

    /// Whether the widths fit the format.
    ///
    /// # Errors
    ///
    /// Names the parameter that is out of range, and the range.
    pub fn check(&self) -> Result<(), ProfileError> {
        if (self.format == Format::Own) != self.own.is_some() {
            return Err(match self.own {
                None => error(
                    "layout",
                    text!("is missing; write one, or one of: {}", own::names()),
                ),
                Some(_) => error("layout", text!("is not for {}", t(self.format.title()))),
            });
        }
        if let Some(own) = self.own
            && let Some((name, bits)) = own.differs(self)
        {
            return Err(error(name, text!("are {} in the layout", bits)));
        }
        let limits = self.format.limits();
        let numbers = [
            ("angle-bits", self.angle_bits),
            ("turns-bits", self.turns_bits),
            ("status-bits", self.status_bits),
            ("ack-bits", self.ack_bits),
            ("baud", self.baud),
            ("address", self.address),
            ("frame-bits", self.frame_bits),
        ];
        for (name, value) in numbers {
            if let Some((low, high)) = self.range(name)
                && !(low..=high).contains(&value)
            {
                return Err(error(
                    name,
                    text!(
                        "{} is not in {}…{} of {}",
                        value,
                        low,
                        high,
                        t(self.format.title())
                    ),
                ));
            }
        }
        if self.angle_bits + self.turns_bits > limits.together {
            return Err(error(
                "turns-bits",
                text!(
                    "{} and {} bits of angle exceed the {} of {}",
                    self.turns_bits,
                    self.angle_bits,
                    limits.together,
                    t(self.format.title())
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
