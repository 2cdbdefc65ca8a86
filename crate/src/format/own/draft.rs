//! How a user's layout is written: fields with kinds and widths, as text and as data.
//!
//! `RLS serial;poll:31;angle:24:le,crc:8:0x97:xor=0xff` reads: a title, how frames come, and the
//! fields in transmission order, each a kind and a width with what else is to be known of it.

use crate::{
    bits,
    language::{msg, t},
    layout::{Active, Class, Role},
    profile::{Choice, choice},
    text,
};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};
use core::{fmt, str::FromStr};

/// Most fields of a layout.
pub const MOST_FIELDS: usize = 40;
/// Most bits of a field that holds a number.
const WIDEST: u32 = 64;
/// Most bits of a CRC.
const WIDEST_CRC: u32 = 16;
/// Most bits of a field that only frames.
const WIDEST_FRAMING: u32 = 256;
/// Most letters of a title, a field's name or a status bit's name.
pub(crate) const LONGEST_NAME: usize = 60;

choice! {
    /// What a field of a user's layout is.
    Kind {
        /// Whole turns.
        Turns = "turns",
        /// Counts within one turn.
        Angle = "angle",
        /// The position is not valid.
        Error = "error",
        /// The position is valid, but near a limit.
        Warning = "warning",
        /// The position is valid: the opposite of an error.
        Valid = "valid",
        /// No zero has been set by the user.
        ZeroDefault = "zero-default",
        /// Up to eight named bits.
        Status = "status",
        /// Degrees Celsius × 10, two's complement.
        Temperature = "temperature",
        /// Revolutions per second × 10, two's complement.
        Speed = "speed",
        /// A count of frames or commands.
        Count = "count",
        /// Bits with one value in every good frame.
        Const = "const",
        /// Bits that are 0 in every good frame.
        Zeros = "zeros",
        /// Bits that say nothing.
        Skip = "skip",
        /// A CRC.
        Crc = "crc",
        /// One bit that makes the number of ones even.
        Even = "even",
        /// One bit that makes the number of ones odd.
        Odd = "odd",
    }
}

impl Kind {
    /// The role that fields of this kind have in a layout.
    #[must_use]
    pub const fn role(self) -> Role {
        match self {
            Self::Turns => Role::Turns,
            Self::Angle => Role::Angle,
            Self::Error => Role::Error,
            Self::Warning => Role::Warning,
            Self::Valid => Role::Valid,
            Self::ZeroDefault => Role::ZeroDefault,
            Self::Status => Role::Status,
            Self::Temperature => Role::Temperature,
            Self::Speed => Role::Speed,
            Self::Count => Role::Count,
            Self::Zeros => Role::Padding,
            Self::Const | Self::Skip => Role::Framing,
            Self::Crc => Role::Crc,
            Self::Even | Self::Odd => Role::Parity,
        }
    }

    /// What a field of this kind says, in a sentence.
    #[must_use]
    pub const fn doc(self) -> &'static str {
        match self {
            Self::Turns => msg("Whole turns."),
            Self::Angle => msg("Angle within one turn."),
            Self::Error => msg("Says that the position is not valid."),
            Self::Warning => msg("Says that something is near its limit; the position is valid."),
            Self::Valid => msg("Says that the position is valid."),
            Self::ZeroDefault => msg("Says that no zero has been set."),
            Self::Status => msg("Status bits."),
            Self::Temperature => msg("Temperature in tenths of a degree Celsius."),
            Self::Speed => msg("Speed in tenths of a revolution per second."),
            Self::Count => msg("A count."),
            Self::Const => msg("The same in every frame."),
            Self::Zeros => msg("Always 0."),
            Self::Skip => msg("Carries nothing that is read."),
            Self::Crc => msg("Checksum."),
            Self::Even => msg("Makes the number of ones even."),
            Self::Odd => msg("Makes the number of ones odd."),
        }
    }

    /// The widths it can have, in bits.
    #[must_use]
    pub const fn widths(self) -> (u32, u32) {
        match self {
            Self::Turns => (1, 32),
            Self::Angle | Self::Const => (1, WIDEST),
            Self::Error
            | Self::Warning
            | Self::Valid
            | Self::ZeroDefault
            | Self::Even
            | Self::Odd => (1, 1),
            Self::Status | Self::Count => (1, 8),
            Self::Temperature | Self::Speed => (2, 32),
            Self::Zeros | Self::Skip => (1, WIDEST_FRAMING),
            Self::Crc => (3, WIDEST_CRC),
        }
    }
}

/// How frames of a user's layout come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Framing {
    /// A master clocks out a word; a line of a dump is one.
    Line,
    /// The same behind the idle, acknowledge, start and cds bits of BiSS-C.
    Biss,
    /// The encoder sends them over a serial line unasked.
    Stream,
    /// The encoder answers to this byte.
    Poll(u8),
}

impl fmt::Display for Framing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line => f.write_str("line"),
            Self::Biss => f.write_str("biss"),
            Self::Stream => f.write_str("stream"),
            Self::Poll(byte) => write!(f, "poll:{byte:02x}"),
        }
    }
}

impl FromStr for Framing {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let poll = |digits: &str| u8::from_str_radix(digits.trim_start_matches("0x"), 16);
        match (text, text.strip_prefix("poll:")) {
            ("line", _) => Ok(Self::Line),
            ("biss", _) => Ok(Self::Biss),
            ("stream", _) => Ok(Self::Stream),
            (_, Some(digits)) => poll(digits)
                .map(Self::Poll)
                .map_err(|_| text!("\"{}\" is not a byte in hexadecimal", digits)),
            _ => Err(text!(
                "\"{}\" is no way frames come; known: line biss stream poll:BYTE",
                text
            )),
        }
    }
}

/// The parameters of a CRC, by the usual names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CrcRule {
    /// Polynomial without its highest term.
    pub polynomial: u64,
    /// What the register starts from.
    pub init: u64,
    /// Whether bytes are taken, and the register is sent, last bit first.
    pub reflected: bool,
    /// What the result is combined with by exclusive or.
    pub xorout: u64,
}

/// A field of a user's layout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Draft {
    /// What it is.
    pub kind: Kind,
    /// Number of bits.
    pub width: u32,
    /// Its own name; without one it is called by its kind. Fields of one name are parts of one
    /// number, the most significant first.
    pub name: Option<String>,
    /// Which level asserts a flag or a status bit.
    pub active: Active,
    /// Whether the number is sent with its last byte first, together with its neighbours of the
    /// same kind up to a whole number of bytes.
    pub little_endian: bool,
    /// Whether it is part of a Gray-coded word, together with its neighbours.
    pub gray: bool,
    /// The value of `const`.
    pub value: u64,
    /// How a CRC is computed.
    pub crc: CrcRule,
    /// Name of the first field that a check covers; the first of all without one.
    pub from: Option<String>,
    /// Name of the last field that a check covers; the one before it without one.
    pub to: Option<String>,
    /// Names of status bits, the most significant first; empty where a bit has none.
    pub bits: Vec<String>,
}

impl Draft {
    /// A field with nothing special about it.
    #[must_use]
    pub const fn new(kind: Kind, width: u32) -> Self {
        Self {
            kind,
            width,
            name: None,
            active: Active::High,
            little_endian: false,
            gray: false,
            value: 0,
            crc: CrcRule {
                polynomial: 0,
                init: 0,
                reflected: false,
                xorout: 0,
            },
            from: None,
            to: None,
            bits: Vec::new(),
        }
    }
}

/// A whole layout as it is written.
///
/// ```
/// use encoderscope::format::own::Written;
/// let text = "My encoder;line;angle:18,error:1:low,crc:6:0x03:xor=0x3f";
/// let written: Written = text.parse().unwrap();
/// assert_eq!((written.fields.len(), written.fields[0].width), (3, 18));
/// assert_eq!(written.to_string(), text);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// What the encoder is called.
    pub title: String,
    /// How frames come.
    pub framing: Framing,
    /// The fields in transmission order.
    pub fields: Vec<Draft>,
}

/// Reads a number in decimal, or in hexadecimal behind `0x`.
fn number(text: &str) -> Result<u64, String> {
    let parsed = match text.strip_prefix("0x") {
        Some(digits) => u64::from_str_radix(digits, 16),
        None => text.parse(),
    };
    parsed.map_err(|_| text!("\"{}\" is not a number", text))
}

fn name(text: &str) -> Result<String, String> {
    let text = text.trim();
    match text.chars().count() {
        0 => Err(t("a name is empty").to_string()),
        1..=LONGEST_NAME => Ok(text.to_string()),
        long => Err(text!(
            "a name of {} letters is longer than {}",
            long,
            LONGEST_NAME
        )),
    }
}

impl FromStr for Written {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut parts = text.splitn(3, ';');
        let (Some(title), Some(framing), Some(fields)) = (parts.next(), parts.next(), parts.next())
        else {
            return Err(
                t("a layout is TITLE;line|biss|stream|poll:BYTE;FIELD,FIELD,…").to_string(),
            );
        };
        let title = name(title)?;
        let framing = framing.trim().parse()?;
        let fields: Vec<Draft> = fields
            .split(',')
            .enumerate()
            .take(MOST_FIELDS + 1)
            .map(|(index, field)| {
                let field = field.trim();
                field
                    .parse()
                    .map_err(|why| text!("field {} ({}): {}", index + 1, field, why))
            })
            .collect::<Result<_, String>>()?;
        if fields.len() > MOST_FIELDS {
            return Err(text!("more than {} fields", MOST_FIELDS));
        }
        Ok(Self {
            title,
            framing,
            fields,
        })
    }
}

impl FromStr for Draft {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut parts = text.split(':');
        let word = parts.next().unwrap_or_default();
        let kind = Kind::of_word(word)
            .ok_or_else(|| text!("\"{}\" is no kind; known: {}", word, Kind::WORDS.join(" ")))?;
        let (least, most) = kind.widths();
        let width = match parts.next() {
            Some(width) => width
                .parse()
                .map_err(|_| text!("\"{}\" is not a number of bits", width))?,
            None => least,
        };
        if !(least..=most).contains(&width) {
            return Err(text!(
                "{} bits are not in {}…{} of {}",
                width,
                least,
                most,
                word
            ));
        }
        let mut draft = Self::new(kind, width);
        for option in parts {
            draft.set(option)?;
        }
        let fits = |value: u64| value <= bits::mask(width as usize);
        let rule = draft.crc;
        if [draft.value, rule.polynomial, rule.init, rule.xorout]
            .into_iter()
            .any(|value| !fits(value))
        {
            return Err(text!("a value has more than {} bits", width));
        }
        if draft.bits.len() > width as usize {
            return Err(text!(
                "{} names are not for {} bits",
                draft.bits.len(),
                width
            ));
        }
        if kind == Kind::Crc && draft.crc.polynomial == 0 {
            return Err(t("a crc needs its polynomial, for example crc:8:0x97").to_string());
        }
        Ok(draft)
    }
}

impl Draft {
    fn set(&mut self, option: &str) -> Result<(), String> {
        let known = match option.split_once('=') {
            Some(("name", value)) => {
                self.name = Some(name(value)?);
                true
            }
            Some(("from", value)) if self.kind.role().class() == Class::Check => {
                self.from = Some(name(value)?);
                true
            }
            Some(("to", value)) if self.kind.role().class() == Class::Check => {
                self.to = Some(name(value)?);
                true
            }
            Some(("init", value)) if self.kind == Kind::Crc => {
                self.crc.init = number(value)?;
                true
            }
            Some(("xor", value)) if self.kind == Kind::Crc => {
                self.crc.xorout = number(value)?;
                true
            }
            Some(("bits", value)) if self.kind == Kind::Status => {
                self.bits = value
                    .split('|')
                    .map(|bit| bit.chars().take(LONGEST_NAME).collect::<String>())
                    .map(|bit| bit.trim().to_string())
                    .collect();
                true
            }
            None if self.kind == Kind::Crc && option == "reflected" => {
                self.crc.reflected = true;
                true
            }
            None if option == "low" => {
                self.active = Active::Low;
                true
            }
            None if option == "le" => {
                self.little_endian = true;
                true
            }
            None if option == "gray" => {
                self.gray = true;
                true
            }
            None if self.kind == Kind::Crc => {
                self.crc.polynomial = number(option)?;
                true
            }
            None if self.kind == Kind::Const => {
                self.value = number(option)?;
                true
            }
            _ => false,
        };
        match known {
            true => Ok(()),
            false => Err(text!(
                "\"{}\" says nothing about {}",
                option,
                self.kind.name()
            )),
        }
    }
}

impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{};{};", self.title, self.framing)?;
        for (index, field) in self.fields.iter().enumerate() {
            write!(f, "{}{field}", if index > 0 { "," } else { "" })?;
        }
        Ok(())
    }
}

impl fmt::Display for Draft {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.kind.name(), self.width)?;
        match self.kind {
            Kind::Crc => write!(f, ":0x{:02x}", self.crc.polynomial)?,
            Kind::Const => write!(f, ":0x{:x}", self.value)?,
            _ => {}
        }
        let flags = [
            ("low", self.active == Active::Low),
            ("le", self.little_endian),
            ("gray", self.gray),
            ("reflected", self.crc.reflected),
        ];
        for (word, _) in flags.iter().filter(|(_, is_set)| *is_set) {
            write!(f, ":{word}")?;
        }
        for (word, value) in [("init", self.crc.init), ("xor", self.crc.xorout)] {
            if value != 0 {
                write!(f, ":{word}=0x{value:x}")?;
            }
        }
        if !self.bits.is_empty() {
            write!(f, ":bits={}", self.bits.join("|"))?;
        }
        for (word, value) in [("from", &self.from), ("to", &self.to), ("name", &self.name)] {
            if let Some(value) = value {
                write!(f, ":{word}={value}")?;
            }
        }
        Ok(())
    }
}
