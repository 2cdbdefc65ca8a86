//! A layout as text: reads what a user has written, and writes it.

use super::{Draft, Framing, Kind, LONGEST_NAME, MOST_FIELDS, Written};
use crate::{
    bits,
    language::t,
    layout::{Active, Class},
    profile::Choice,
    text,
};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};
use core::{fmt, str::FromStr};

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

/// Reads a number in decimal, or in hexadecimal behind `0x`.
fn number(text: &str) -> Result<u64, String> {
    let parsed = match text.strip_prefix("0x") {
        Some(digits) => u64::from_str_radix(digits, 16),
        None => text.parse(),
    };
    parsed.map_err(|_| text!("\"{}\" is not a number", text))
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
