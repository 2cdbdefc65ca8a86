//! What the bits say: one note a field, for every format, out of its layout table.

use crate::{
    bits::{self, Bits, Span},
    format::{Format, bus::Operation, own::Own, rs485::Command, t485::Request},
    language::{meaning, number, t},
    layout::{Active, Class, Coding, Covered, Field, Resolved, Role, Weight},
    reading::Fault,
    text,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// The explanation of one field of a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// Name of the field.
    pub name: &'static str,
    /// Its class, which decides its colour.
    pub class: Class,
    /// Where it stands, most significant part first.
    pub spans: Vec<Span>,
    /// What the field is.
    pub doc: String,
    /// Its number.
    pub raw: u64,
    /// What its number says in this frame.
    pub text: String,
    /// Its single bits, where they have names, most significant first.
    pub bits: Vec<BitNote>,
    /// What is wrong with it.
    pub fault: Option<Fault>,
}

/// The explanation of one named bit.
#[derive(Clone, Debug, PartialEq)]
pub struct BitNote {
    /// Index in the frame.
    pub at: usize,
    /// Name.
    pub name: &'static str,
    /// Whether it is set.
    pub set: bool,
    /// What it means when it is set, and what to do.
    pub doc: &'static str,
    /// Whether it is the format's error or warning flag.
    pub role: Option<Role>,
}

impl Resolved {
    /// Explains every field of a frame in transmission order; together the notes cover every
    /// bit once.
    #[must_use]
    pub fn explain(&self, bits: Bits<'_>) -> Vec<Note> {
        self.fields().map(|field| self.note(field, bits)).collect()
    }

    fn note(&self, field: &Field, bits: Bits<'_>) -> Note {
        let raw = self.read(field, bits);
        let spans: Vec<Span> = self.parts(field).iter().map(|part| part.span).collect();
        Note {
            name: field.row.name,
            class: field.row.role.class(),
            doc: meaning(field.row.english()),
            raw,
            text: self.text(field, raw, bits),
            bits: self.named_bits(field, raw),
            fault: self.fault(field, bits),
            spans,
        }
    }

    fn named_bits(&self, field: &Field, raw: u64) -> Vec<BitNote> {
        let named = field
            .row
            .bits
            .iter()
            .filter(|named| named.place < field.width);
        named
            .filter_map(|named| {
                Some(BitNote {
                    at: self.bit_of(field, named.place)?,
                    name: named.name,
                    set: bits::bit(field.active_high(raw), named.place),
                    doc: t(named.doc),
                    role: named.role,
                })
            })
            .collect()
    }

    /// What the number of a field says.
    fn text(&self, field: &Field, raw: u64, bits: Bits<'_>) -> String {
        let asserted = (raw != 0) == (field.row.active == Active::High);
        let angle_bits = self.shape.profile.angle_bits;
        let tenths = || tenths(bits::signed(raw, field.width as usize) as i32);
        let text = match field.row.role {
            Role::Turns => {
                text!("{} {0|turn|turns}", grouped_signed(self.turns(raw)))
            }
            Role::Angle => text!(
                "{} of {} → {}°",
                grouped(raw),
                grouped(u64::try_from(bits::codes(angle_bits)).unwrap_or(u64::MAX)),
                number(degrees_text(raw, angle_bits, 4))
            ),
            Role::Error if asserted => t("error: the position is not valid").into(),
            Role::Error => t("no error: the position is valid").into(),
            Role::Warning if asserted => t("warning: something is near its limit").into(),
            Role::Warning => t("no warning").into(),
            Role::Valid if asserted => t("the position is valid").into(),
            Role::Valid => t("the position is not valid").into(),
            Role::ZeroDefault if asserted => t("no zero has been set").into(),
            Role::ZeroDefault => t("a zero has been set").into(),
            Role::Status | Role::Alarm => {
                let set: Vec<_> = self
                    .named_bits(field, raw)
                    .iter()
                    .filter(|named| named.set)
                    .map(|named| t(named.name))
                    .collect();
                match set.is_empty() {
                    false => set.join(", "),
                    true if field.active_high(raw) == 0 => t("all well").into(),
                    true => t("bits without a name are set").into(),
                }
            }
            Role::Enid | Role::MemoryData => format!("0x{raw:02X}"),
            Role::Speed => text!("{} rev/s", number(tenths())),
            Role::Temperature => text!("{} °C", number(tenths())),
            Role::Count => text!("{} counted", raw),
            Role::Operation => self.operation(raw),
            Role::Address => text!("device 0x{}", format_args!("{raw:02X}")),
            Role::MemoryAddress => text!("address 0x{}", format_args!("{raw:02X}")),
            Role::Crc | Role::Parity => self.check_text(field, bits),
            Role::Padding if raw == 0 => t("zero").into(),
            Role::Padding => t("not zero: the number is wider than the profile says").into(),
            Role::Repeat => match self.fault(field, bits) {
                None => t("the same word again").into(),
                Some(_) => t("not the same word again").into(),
            },
            Role::Framing => String::new(),
        };
        match self.coding(field) {
            Some((Coding::Gray, _)) => {
                let width = field.width as usize;
                text!(
                    "{} (Gray {})",
                    text,
                    format_args!("{:0width$b}", self.wire(field, bits))
                )
            }
            _ => text,
        }
    }

    /// What a request asks for.
    fn operation(&self, raw: u64) -> String {
        let code = bits::low_byte(raw);
        let profile = &self.shape.profile;
        let known = match profile.format {
            Format::Rs485 => Command::of_byte(code)
                .map(|command| text!("‘{}’: {}", command.letter(), t(command.title()))),
            Format::T485 => Request::of_operation(code)
                .map(|request| format!("0x{:02X}: {}", request.byte(), t(request.title()))),
            Format::Bus => Operation::of_code(code)
                .map(|operation| format!("{code:02b}: {}", t(operation.title()))),
            _ => profile
                .own
                .and_then(Own::request)
                .filter(|byte| *byte == code)
                .map(|byte| format!("0x{byte:02X}: {}", t("what the encoder answers to"))),
        };
        known.unwrap_or_else(|| text!("operation {}, which is not known", raw))
    }

    fn check_text(&self, field: &Field, bits: Bits<'_>) -> String {
        let (Some((sum, covered)), Some(checked)) = (field.cover, self.checked(field, bits)) else {
            return String::new();
        };
        let name = sum.title();
        let over = match covered {
            Covered::Run(span) => text!("over {} bits", span.len),
            Covered::Frame => text!("over {} bits with its own as 0", self.len),
        };
        let open = match field.row.weight {
            Weight::Advisory if !checked.ok() => t("; the manual leaves this rule open"),
            _ => "",
        };
        let verdict = if checked.ok() { t("holds") } else { t("fails") };
        if sum.width() == 1 {
            format!("{verdict}: {name} {over}{open}")
        } else {
            text!(
                "{}: computed 0x{}, {}, {}{}",
                verdict,
                format_args!("{:02X}", checked.expected),
                name,
                over,
                open
            )
        }
    }
}

/// An angle in degrees with `places` digits behind the point (at most 12), cut off, not rounded:
/// the last count of a turn is never 360°.
///
/// ```
/// use encoderscope::explain::degrees_text;
/// assert_eq!(degrees_text(0xff_ffff, 24, 4), "359.9999");
/// ```
#[must_use]
pub fn degrees_text(angle: u64, angle_bits: u32, places: u32) -> String {
    let unit = 10u64.pow(places.min(12));
    // Less than 360 × 10¹², which leaves room.
    let scaled = u128::from(angle) * 360 * u128::from(unit);
    let scaled = (scaled >> angle_bits.min(64)) as u64;
    let (whole, part) = (scaled / unit, scaled % unit);
    match places.min(12) as usize {
        0 => whole.to_string(),
        width => format!("{whole}.{part:0width$}"),
    }
}

/// A number of tenths with its decimal point.
#[must_use]
pub fn tenths(value: i32) -> String {
    let sign = if value < 0 { "−" } else { "" };
    let value = value.unsigned_abs();
    format!("{sign}{}.{}", value / 10, value % 10)
}

/// Digits in groups of three with thin spaces between.
///
/// ```
/// assert_eq!(encoderscope::explain::grouped(8_388_608), "8\u{202f}388\u{202f}608");
/// ```
#[must_use]
pub fn grouped(value: u64) -> String {
    let digits = value.to_string();
    let mut out = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            out.push('\u{202f}');
        }
        out.push(digit);
    }
    out
}

/// The same of a number that may be negative.
///
/// ```
/// assert_eq!(encoderscope::explain::grouped_signed(-1_000), "−1\u{202f}000");
/// ```
#[must_use]
pub fn grouped_signed(value: i64) -> String {
    let sign = if value < 0 { "−" } else { "" };
    format!("{sign}{}", grouped(value.unsigned_abs()))
}
