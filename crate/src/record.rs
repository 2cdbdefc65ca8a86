//! Records: frames, notes and profiles as named values, for JSON and for JavaScript.
//!
//! The names stand here once, so that the command line and the JavaScript module agree.

use crate::{
    decode::{Frame, Summary},
    explain::{Note, degrees_text},
    language::in_english,
    layout::Class,
    profile::{Profile, camel},
    reading::Checked,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};
use core::fmt;

/// The name of the place in the input.
pub const START: &str = "start";
/// The name of the bytes of a frame.
pub const HEX: &str = "hex";
/// The name of what is wrong with a frame.
pub const FAULTS: &str = "faults";

/// A value of a record.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Absent.
    Null,
    /// Truth.
    Bool(bool),
    /// A whole number.
    Int(i128),
    /// A number with digits behind the point, as JSON writes it.
    Decimal(String),
    /// Text.
    Text(String),
    /// Values in order.
    List(Vec<Self>),
    /// Named values.
    Record(Record),
}

/// Named values in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record(pub Vec<(String, Value)>);

impl Value {
    /// The value as it is written in a link or on the command line: text without quotes.
    #[must_use]
    pub fn plain(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            other => other.to_string(),
        }
    }
}

impl Record {
    /// An empty record.
    #[must_use]
    pub const fn new() -> Self {
        Self(Vec::new())
    }

    /// Adds a named value.
    #[must_use]
    pub fn with(mut self, name: &str, value: impl Into<Value>) -> Self {
        self.0.push((name.to_string(), value.into()));
        self
    }

    /// Adds a value where there is one.
    #[must_use]
    fn with_some(self, name: &str, value: Option<impl Into<Value>>) -> Self {
        match value {
            Some(value) => self.with(name, value),
            None => self,
        }
    }

    /// Adds a value that the format may have: null where this frame has none.
    #[must_use]
    fn with_known(self, name: &str, known: &[&str], value: Option<impl Into<Value>>) -> Self {
        match known.contains(&name) {
            true => self.with(name, value),
            false => self.with_some(name, value),
        }
    }

    /// The value of a name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<&Value> {
        self.0
            .iter()
            .find(|(known, _)| known == name)
            .map(|(_, value)| value)
    }
}

macro_rules! value_from {
    ($($type:ty => |$value:ident| $made:expr;)*) => {
        $(impl From<$type> for Value {
            fn from($value: $type) -> Self { $made }
        })*
    };
}
value_from! {
    bool => |value| Self::Bool(value);
    u8 => |value| Self::Int(value.into());
    u32 => |value| Self::Int(value.into());
    i64 => |value| Self::Int(value.into());
    u64 => |value| Self::Int(value.into());
    usize => |value| Self::Int(value as i128);
    // JSON has no other numbers.
    f64 => |value| match value.is_finite() {
        true => Self::Decimal(value.to_string()),
        false => Self::Null,
    };
    String => |value| Self::Text(value);
    &str => |value| Self::Text(value.to_string());
    Record => |value| Self::Record(value);
    Class => |value| Self::Text(value.name().to_string());
    Checked => |value| Record::new()
        .with("expected", value.expected)
        .with("received", value.received)
        .with("ok", value.ok())
        .into();
}

impl<T: Into<Self>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Null, Into::into)
    }
}

impl<T: Into<Self>> From<Vec<T>> for Value {
    fn from(values: Vec<T>) -> Self {
        Self::List(values.into_iter().map(Into::into).collect())
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Null => f.write_str("null"),
            Self::Bool(value) => write!(f, "{value}"),
            Self::Int(value) => write!(f, "{value}"),
            Self::Decimal(digits) => f.write_str(digits),
            Self::Text(text) => quote(text, f),
            Self::List(values) => {
                f.write_str("[")?;
                for (index, value) in values.iter().enumerate() {
                    write!(f, "{}{value}", if index > 0 { "," } else { "" })?;
                }
                f.write_str("]")
            }
            Self::Record(record) => write!(f, "{record}"),
        }
    }
}

impl fmt::Display for Record {
    /// JSON on one line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("{")?;
        for (index, (name, value)) in self.0.iter().enumerate() {
            f.write_str(if index > 0 { "," } else { "" })?;
            quote(name, f)?;
            write!(f, ":{value}")?;
        }
        f.write_str("}")
    }
}

fn quote(text: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    f.write_str("\"")?;
    for letter in text.chars() {
        match letter {
            '"' | '\\' => write!(f, "\\{letter}")?,
            letter if u32::from(letter) < 0x20 => write!(f, "\\u{:04x}", u32::from(letter))?,
            letter => write!(f, "{letter}")?,
        }
    }
    f.write_str("\"")
}

/// Lower-case hexadecimal digits without separators.
#[must_use]
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Digits behind the point that one count of an encoder of `bits` bits deserves.
fn useful_digits(bits: u32) -> u32 {
    (bits / 3).clamp(4, 12)
}

/// Digits with a point without the zeros at their end.
fn decimal(digits: &str) -> Value {
    Value::Decimal(digits.trim_end_matches('0').trim_end_matches('.').into())
}

fn scaled(value: Option<i32>) -> Option<Value> {
    value.map(|tenths| {
        let sign = if tenths < 0 { "-" } else { "" };
        let size = tenths.unsigned_abs();
        decimal(&format!("{sign}{}.{}", size / 10, size % 10))
    })
}

impl Frame<'_> {
    /// The record of a frame; absent quantities are null.
    #[must_use]
    pub fn record(&self) -> Record {
        let values = self.values();
        let profile = &self.layout.shape.profile;
        let bits = profile.angle_bits;
        let known = profile.format.spec().quantities;
        let faults = self.faults().into_iter();
        let faults: Vec<String> =
            in_english(|| faults.map(|fault| fault.kind.to_string()).collect());
        Record::new()
            .with(START, self.start)
            .with(HEX, hex(self.bits.bytes()))
            .with("ok", faults.is_empty())
            .with("turns", values.turns)
            .with("angle", values.angle)
            .with(
                "degrees",
                values
                    .angle
                    .map(|angle| decimal(&degrees_text(angle, bits, useful_digits(bits)))),
            )
            .with("error", values.error)
            .with("warning", values.warning)
            .with("status", values.status)
            .with("crc", values.crc)
            .with_known("parity", known, values.parity)
            .with_known("temperature", known, scaled(values.temperature))
            .with_known("speed", known, scaled(values.speed))
            .with_known("valid", known, values.valid)
            .with_known("zeroDefault", known, values.zero_default)
            .with_known("address", known, values.address)
            .with_known("operation", known, values.operation)
            .with_known("count", known, values.count)
            .with_known("enid", known, values.enid)
            .with_known("alarm", known, values.alarm)
            .with_known("memoryAddress", known, values.memory.0)
            .with_known("memoryData", known, values.memory.1)
            .with_some(FAULTS, (!faults.is_empty()).then_some(faults))
    }
}

impl Summary {
    /// The record of the counts over a dump.
    #[must_use]
    pub fn record(&self) -> Record {
        let counts = Record::new()
            .with("bytes", self.bytes)
            .with("frames", self.frames)
            .with("bad", self.bad)
            .with("skipped", self.skipped);
        Record::new().with("summary", counts)
    }
}

impl Note {
    /// The record of an explanation.
    #[must_use]
    pub fn record(&self) -> Record {
        let spans: Vec<Value> = self
            .spans
            .iter()
            .map(|span| {
                Record::new()
                    .with("start", span.start)
                    .with("len", span.len)
                    .into()
            })
            .collect();
        let bits: Vec<Value> = self
            .bits
            .iter()
            .map(|bit| {
                Record::new()
                    .with("at", bit.at)
                    .with("name", bit.name)
                    .with("set", bit.set)
                    .with("doc", bit.doc)
                    .into()
            })
            .collect();
        Record::new()
            .with("name", self.name)
            .with("class", self.class)
            .with("spans", Value::List(spans))
            .with("doc", self.doc.as_str())
            .with("raw", self.raw)
            .with("text", self.text.as_str())
            .with("bits", Value::List(bits))
            .with("fault", self.fault.map(|fault| fault.kind.to_string()))
    }
}

impl Profile {
    /// The record of a profile: the parameters that its format uses, in camelCase.
    #[must_use]
    pub fn record(&self) -> Record {
        let named = self.parameters().into_iter();
        Record(named.map(|(name, value)| (camel(name), value)).collect())
    }
}
