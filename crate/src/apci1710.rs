//! The SSI module of the boards APCI-1710 and CPCI-1710, register by register (P+F article,
//! "registers of the SSI module" and table 5).
//!
//! A board has four modules, each of which clocks up to three encoders with one clock. The article
//! gives no offset of OUTPUT, and none of SHIFT; those here are of the driver of the boards' maker
//! in Linux (comedi, `APCI1710_Ssi.c`).
//!
//! ```
//! use encoderscope::apci1710::{Register, divider};
//! assert_eq!(divider(50), 100);
//! let status = Register::Status.notes(0b0111_0001);
//! let busy = status.iter().find(|note| note.name == "busy").unwrap();
//! assert_eq!(busy.text, "the word is on its way");
//! ```

pub mod tables;
mod word;

pub use word::{Form, Word, WordError};

use crate::{
    bits::{self, BitString, Span},
    explain::{Note, grouped},
    format::Format,
    language::{msg, t},
    layout::{Layout, Resolved, Shape},
    text,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// Where the registers are described.
pub const SOURCE: &str = msg("P+F article, registers of the SSI module and table 5");
/// Modules of a board.
pub const MODULES: u32 = 4;
/// Bytes from one module to the next.
pub const MODULE_BYTES: u32 = 64;
/// The highest clock that a module makes, in hertz (P+F article, register FRQ).
pub const FASTEST: u32 = 1_000_000;
/// Bits of a register SHIFT, and so of the longest word.
pub const WORD_BITS: u32 = 32;

/// What can be done with a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// It is read.
    Read,
    /// It is written.
    Write,
}

impl Access {
    /// How it is said.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Read => msg("read"),
            Self::Write => msg("write"),
        }
    }
}

/// One of the three encoders of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// On the wires Bx.
    One,
    /// On the wires Cx.
    Two,
    /// On the wires Dx.
    Three,
}

impl Channel {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::One, Self::Two, Self::Three];

    /// Its number, from 1 on.
    #[must_use]
    pub const fn number(self) -> u32 {
        match self {
            Self::One => 1,
            Self::Two => 2,
            Self::Three => 3,
        }
    }

    /// Its bit in CONTROL.
    #[must_use]
    pub const fn control(self) -> u32 {
        bits::placed(1, self.number() - 1) as u32
    }
}

/// A register of a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Register {
    /// The divider of the clock.
    Frq,
    /// Busy, and the levels of the inputs.
    Status,
    /// How many bits a word has.
    Counts,
    /// The word of an encoder.
    Shift(Channel),
    /// Starts a reading.
    Start,
    /// Which words are converted from Gray code.
    Control,
    /// The digital output.
    Output,
    /// What the module is.
    Identity,
}

impl Register {
    /// All of them, in the order of their offsets.
    pub const ALL: [Self; 10] = [
        Self::Frq,
        Self::Status,
        Self::Counts,
        Self::Shift(Channel::One),
        Self::Start,
        Self::Shift(Channel::Two),
        Self::Control,
        Self::Shift(Channel::Three),
        Self::Output,
        Self::Identity,
    ];

    /// Its name in links, in kebab-case.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Frq => "frq",
            Self::Status => "status",
            Self::Counts => "counts",
            Self::Shift(Channel::One) => "shift-1",
            Self::Shift(Channel::Two) => "shift-2",
            Self::Shift(Channel::Three) => "shift-3",
            Self::Start => "start",
            Self::Control => "control",
            Self::Output => "output",
            Self::Identity => "identity",
        }
    }

    /// Its name as the article writes it.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Frq => "FRQ",
            Self::Status => "STATUS",
            Self::Counts => "COUNTS",
            Self::Shift(Channel::One) => "SHIFT 1",
            Self::Shift(Channel::Two) => "SHIFT 2",
            Self::Shift(Channel::Three) => "SHIFT 3",
            Self::Start => "START",
            Self::Control => "CONTROL",
            Self::Output => "OUTPUT",
            Self::Identity => "IDENTITY",
        }
    }

    /// Where it stands in its module, in bytes.
    #[must_use]
    pub const fn offset(self) -> u32 {
        match self {
            Self::Frq | Self::Status => 0,
            Self::Counts => 4,
            Self::Start => 8,
            Self::Control => 12,
            Self::Shift(channel) => 4 * channel.number(),
            Self::Output => 16,
            Self::Identity => 60,
        }
    }

    /// Whether it is read or written.
    #[must_use]
    pub const fn access(self) -> Access {
        match self {
            Self::Status | Self::Shift(_) | Self::Identity => Access::Read,
            Self::Frq | Self::Counts | Self::Start | Self::Control | Self::Output => Access::Write,
        }
    }

    /// Its table.
    #[must_use]
    pub const fn layout(self) -> &'static Layout {
        match self {
            Self::Frq => &tables::FRQ,
            Self::Status => &tables::STATUS,
            Self::Counts => &tables::COUNTS,
            Self::Shift(_) => &tables::SHIFT,
            Self::Start => &tables::START,
            Self::Control => &tables::CONTROL,
            Self::Output => &tables::OUTPUT,
            Self::Identity => &tables::IDENTITY,
        }
    }

    /// Where it stands on a board, in bytes from the board's own address.
    ///
    /// ```
    /// use encoderscope::apci1710::Register;
    /// assert_eq!(Register::Output.place(3), 0xd0);
    /// ```
    #[must_use]
    pub const fn place(self, module: u32) -> u32 {
        MODULE_BYTES
            .saturating_mul(module)
            .saturating_add(self.offset())
    }

    /// Its width in bits.
    #[must_use]
    pub fn width(self) -> usize {
        self.resolved().len
    }

    fn resolved(self) -> Resolved {
        // The widths of a register follow from nothing.
        Resolved::new(self.layout(), Shape::of(Format::SsiTree.default_profile()))
    }

    /// The value in a text: decimal, or behind `0x` or `0b`; `_` and spaces may group the digits.
    ///
    /// ```
    /// use encoderscope::apci1710::Register;
    /// assert_eq!(Register::Control.entered("0b101"), Ok(5));
    /// assert!(Register::Control.entered("0x100").is_err());
    /// ```
    ///
    /// # Errors
    ///
    /// Says what is not a number, or that the register has fewer bits.
    pub fn entered(self, text: &str) -> Result<u32, String> {
        let mut digits = text.to_ascii_lowercase();
        digits.retain(|letter| !letter.is_whitespace() && letter != '_');
        let parsed = match digits.split_at_checked(2) {
            Some(("0x", digits)) => u64::from_str_radix(digits, 16),
            Some(("0b", digits)) => u64::from_str_radix(digits, 2),
            _ => digits.parse(),
        };
        let number = parsed.map_err(|_| {
            text!(
                "\"{}\" is no value of a register: 100, 0x64 and 0b1100100 are",
                text
            )
        })?;
        let width = self.width();
        match u32::try_from(number) {
            Ok(value) if number <= bits::mask(width) => Ok(value),
            _ => Err(text!(
                "{} does not fit: {} has {} bits",
                text,
                self.title(),
                width
            )),
        }
    }

    /// What the bits of a value say, the highest first; what is wider than the register is cut off.
    #[must_use]
    pub fn notes(self, value: u32) -> Vec<Note> {
        let layout = self.resolved();
        let mut row = BitString::zeros(layout.len);
        row.write(Span::new(0, layout.len), value.into());
        let notes = layout.explain(row.as_bits()).into_iter();
        notes
            .map(|note| Note {
                text: self.says(note.name, note.raw),
                ..note
            })
            .collect()
    }

    /// What the number of a field says.
    fn says(self, field: &str, raw: u64) -> String {
        let level = |high: bool| if high { t("high") } else { t("low") };
        match (self, field) {
            (_, "unused") if raw == 0 => t("zero").into(),
            (_, "unused") => t("the article says nothing of these bits").into(),
            (Self::Frq, _) => text!(
                "the PCI clock through {}",
                grouped(divider(bits::low_word(raw)).into())
            ),
            (Self::Counts, _) => text!("{} bits, {} clocks", raw, raw + 1),
            (Self::Start, _) => t("any value starts a reading").into(),
            (Self::Control, _) if raw == 1 => t("Gray code becomes binary").into(),
            (Self::Control, _) => t("the word stays as it comes").into(),
            (Self::Status, "busy") if raw == 1 => t("the word is on its way").into(),
            (Self::Status, "busy") => t("done: the words are in SHIFT").into(),
            (Self::Status, name) if name.starts_with("data") => {
                text!("the line is {}", level(raw == 1))
            }
            // Table 5: 0 says that the level is high.
            (Self::Status, _) => text!("the input is {}", level(raw == 0)),
            (Self::Output, _) if raw == 1 => t("the output is on").into(),
            (Self::Output, _) => t("the output is off, as after a restart").into(),
            (Self::Shift(_), _) => format!("0x{raw:08X}"),
            (Self::Identity, _) => letters(raw),
        }
    }
}

/// Two characters, where they are letters or digits.
fn letters(raw: u64) -> String {
    let letters: Option<String> = [bits::slice(raw, 8, 8), bits::slice(raw, 0, 8)]
        .into_iter()
        .map(|code| {
            let letter = char::from(bits::low_byte(code));
            letter.is_ascii_graphic().then_some(letter)
        })
        .collect();
    match letters.as_deref() {
        Some("SI") => t("SI: Synchronous Serial Interface").into(),
        Some("10") => t("10: revision 1.0").into(),
        Some(other) => other.to_string(),
        None => text!("0x{}: no letters", format_args!("{raw:04X}")),
    }
}

/// What FRQ divides the PCI clock by (P+F article, register FRQ).
///
/// ```
/// use encoderscope::apci1710::divider;
/// assert_eq!((divider(0), divider(50), divider(u16::MAX)), (2, 100, 131_070));
/// ```
#[must_use]
pub const fn divider(value: u16) -> u32 {
    match value {
        0 => 2,
        value => value as u32 * 2,
    }
}

/// The value of FRQ for the highest clock that is not above `wished`, both clocks in hertz; none
/// where the divider is not large enough.
///
/// ```
/// use encoderscope::apci1710::{divider, frq};
/// assert_eq!(frq(33e6, 330e3), Some(50));
/// assert_eq!(frq(33e6, 1e6).map(divider), Some(34));
/// assert_eq!(frq(33e6, 250.0), None);
/// ```
#[must_use]
pub fn frq(pci: f64, wished: f64) -> Option<u16> {
    let exact = pci / 2.0 / wished;
    if !(exact > 0.0 && exact <= f64::from(u16::MAX)) {
        return None;
    }
    let below = exact as u16;
    // The quotient of two round numbers may end beside the whole number that it is.
    let is_whole = exact - f64::from(below) < 1e-9 * exact;
    let value = match is_whole {
        true => below,
        false => below.checked_add(1)?,
    };
    Some(value.max(1))
}
