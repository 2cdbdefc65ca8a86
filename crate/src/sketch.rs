//! A frame on paper: changed bit by bit, and what the other side makes of it.
//!
//! ```
//! use encoderscope::{decode::Decoder, profile::Profile, sketch::{Checks, Heard, Sketch}};
//! let decoder = Decoder::new(Profile::parse([("format", "t485")])?)?;
//! let reply = decoder.frame_kinds().into_iter().find(|kind| kind.name == "angle").unwrap();
//! let mut sketch = Sketch::new(decoder, reply);
//! sketch.enter("angle", "180°", Checks::Follow)?;
//! assert!(matches!(sketch.heard(), Heard::Reading(reading) if reading.degrees() == 180.0));
//! sketch.flip(20, Checks::Stay);
//! assert!(matches!(sketch.heard(), Heard::Faults(faults) if faults.len() == 1));
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod digits;
mod entry;
mod kind;

pub use digits::DigitsError;
pub use entry::Refusal;
pub use kind::FrameKind;

use crate::{
    bits::{BitString, Bits, Span},
    decode::{Decoded, Decoder, Frame},
    diagram::{Master, Timeline},
    dump::{self, Direction, Dump},
    emulator::{Emulator, Shaft},
    explain::Note,
    format::Medium,
    framing::Why,
    layout::Field,
    reading::{Fault, Reading},
    record,
    session::Micros,
};
use alloc::{borrow::Cow, format, string::String, vec::Vec};

/// How long an encoder is listened to, in microseconds: longer than any reply takes.
const LISTEN: Micros = 100_000;

/// Most bits of a frame: no format's comes near it, and who shows one shows every bit.
const MOST_BITS: usize = 1024;

/// What checks do when something else is changed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Checks {
    /// They are computed again.
    #[default]
    Follow,
    /// They stay as they are, and fail.
    Stay,
}

/// What the other side makes of a frame.
#[derive(Clone, Debug, PartialEq)]
pub enum Heard {
    /// A good frame with a position.
    Reading(Reading),
    /// A good frame without one.
    Good,
    /// A frame that is refused.
    Faults(Vec<Fault>),
    /// Nothing that is taken for a frame.
    NoFrame(Why),
    /// A request that is answered so.
    Answer(Vec<u8>),
    /// A request that no encoder of the profile answers.
    Silence,
}

/// A frame that can be changed.
#[derive(Clone, Debug)]
pub struct Sketch {
    decoder: Decoder,
    kind: FrameKind,
    bits: BitString,
}

impl Sketch {
    /// The example of a kind of frame.
    #[must_use]
    pub fn new(decoder: Decoder, kind: FrameKind) -> Self {
        Self {
            decoder,
            bits: kind.example.clone(),
            kind,
        }
    }

    /// A frame that is given, of the kind that it looks like most, going one way where that is
    /// known: a T485 EEPROM write is answered with the same bytes.
    ///
    /// # Errors
    ///
    /// It has the length of no frame of the profile.
    ///
    /// ```
    /// use encoderscope::{decode::Decoder, format::Format, sketch::Sketch};
    /// let decoder = Decoder::new(Format::Ssi.default_profile())?;
    /// assert!(Sketch::parse(decoder, &"10".repeat(30_000), None).is_err());
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    pub fn read(
        decoder: Decoder,
        bits: BitString,
        direction: Option<Direction>,
    ) -> Result<Self, Why> {
        if bits.as_bits().len() > MOST_BITS {
            return Err(Why::NoFrame);
        }
        let kind = FrameKind::of(&decoder, bits.as_bits(), direction)?;
        Ok(Self {
            decoder,
            kind,
            bits,
        })
    }

    /// A frame as it is pasted or stands in a link: the first line of a clocked format, else all
    /// bytes.
    ///
    /// # Errors
    ///
    /// It has the length of no frame of the profile.
    pub fn parse(decoder: Decoder, text: &str, direction: Option<Direction>) -> Result<Self, Why> {
        let medium = decoder.profile().medium();
        let dump = dump::parse(text, medium);
        let mut bits = BitString::default();
        match dump.line(0) {
            Some(line) if medium == Medium::Bits => {
                (0..line.bits.len()).for_each(|at| bits.push(line.bits.bit(at)));
            }
            _ => bits = BitString::of_bytes(dump.bytes().into()),
        }
        Self::read(decoder, bits, direction)
    }

    /// The frame as a link writes it: of a clocked format 0 and 1, else hexadecimal digits.
    /// [`Self::parse`] reads it again.
    #[must_use]
    pub fn text(&self) -> String {
        let bits = self.bits();
        match self.decoder.profile().medium() {
            Medium::Bits => {
                // So few digits are taken for bytes unless they are marked.
                let mark = if bits.len() < 8 { "0b" } else { "" };
                let digits = (0..bits.len()).map(|at| if bits.bit(at) { '1' } else { '0' });
                mark.chars().chain(digits).collect()
            }
            Medium::Bytes | Medium::Text => {
                let digits = record::hex(bits.bytes());
                // Without letters they may be bits, or decimal; with these in front they are bits.
                let other = digits.bytes().any(|digit| digit.is_ascii_alphabetic());
                match other && !digits.starts_with("0b") {
                    true => digits,
                    false => format!("0x{digits}"),
                }
            }
        }
    }

    /// Which frame it is.
    #[must_use]
    pub const fn kind(&self) -> &FrameKind {
        &self.kind
    }

    /// The profile's decoder.
    #[must_use]
    pub const fn decoder(&self) -> &Decoder {
        &self.decoder
    }

    /// The bits, in transmission order as they are read.
    #[must_use]
    pub fn bits(&self) -> Bits<'_> {
        self.bits.as_bits()
    }

    /// The frame as a receiver has it that knows where it begins.
    #[must_use]
    pub fn frame(&self) -> Frame<'_> {
        Frame {
            start: 0,
            layout: Cow::Borrowed(&self.kind.layout),
            bits: self.bits(),
            sure: true,
            request: None,
        }
    }

    /// What the wires do while it is sent.
    #[must_use]
    pub fn timeline(&self, master: &Master) -> Timeline {
        match self.kind.direction {
            Direction::Sent => Timeline::request(&self.kind.layout, self.bits()),
            Direction::Received => Timeline::new(&self.kind.layout, self.bits(), master),
        }
    }

    /// What every field says.
    #[must_use]
    pub fn notes(&self) -> Vec<Note> {
        self.kind.layout.explain(self.bits())
    }

    /// The field of a name.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<&Field> {
        let mut fields = self.kind.layout.fields();
        fields.find(|field| field.row.name == name)
    }

    /// Turns a bit over. A bit of a check stays as it is then: that is a check broken on purpose.
    pub fn flip(&mut self, index: usize, checks: Checks) {
        if index >= self.bits().len() {
            return;
        }
        self.bits.flip(index);
        let field = self.kind.layout.field_at(index);
        if field.is_some_and(|field| field.cover.is_none()) {
            self.settle(checks);
        }
    }

    /// Puts a byte in place of the one at `index`, checks as they are.
    pub fn set_byte(&mut self, index: usize, byte: u8) {
        let len = self
            .bits()
            .len()
            .saturating_sub(index.saturating_mul(8))
            .min(8);
        if len == 8 {
            self.bits.write(Span::new(index * 8, 8), byte.into());
        }
    }

    /// Puts a value into a field, as a person writes it: a number in decimal or with 0x or 0b, the
    /// angle also in degrees ("180.5°"), speed in revolutions per second, temperature in degrees
    /// Celsius.
    ///
    /// # Errors
    ///
    /// There is no such field, it is no such number, or it does not fit.
    pub fn enter(&mut self, name: &str, text: &str, checks: Checks) -> Result<(), Refusal> {
        let field = self.field(name).ok_or(Refusal::NoField)?.clone();
        let raw = self.kind.layout.entered(&field, text)?;
        self.kind.layout.write(&field, &mut self.bits, raw);
        if field.cover.is_none() {
            self.settle(checks);
        }
        Ok(())
    }

    /// The value of a field as [`Self::enter`] takes it; of the angle its counts.
    #[must_use]
    pub fn entry(&self, name: &str) -> Option<String> {
        let field = self.field(name)?;
        let raw = self.kind.layout.read(field, self.bits());
        Some(self.kind.layout.entry(field, raw))
    }

    fn settle(&mut self, checks: Checks) {
        if checks == Checks::Follow {
            self.mend();
        }
    }

    /// Computes all checks again.
    pub fn mend(&mut self) {
        self.kind.layout.mend(&mut self.bits);
    }

    /// What the other side makes of it: a master of a reply, an encoder of a request.
    #[must_use]
    pub fn heard(&self) -> Heard {
        match (self.kind.direction, self.decoder.profile().medium()) {
            (Direction::Sent, _) => self.answered(),
            (Direction::Received, Medium::Bits) => match self.decoder.line(self.bits()) {
                Ok(frame) => judged(frame.faults(), frame.reading()),
                Err(why) => Heard::NoFrame(why),
            },
            (Direction::Received, Medium::Bytes | Medium::Text) => self.framed(),
        }
    }

    fn answered(&self) -> Heard {
        let shaft = Shaft::still(kind::EXAMPLE_TURNS as f64 + kind::EXAMPLE_DEGREES / 360.0);
        let Ok(mut encoder) = Emulator::new(*self.decoder.profile(), shaft) else {
            return Heard::Silence;
        };
        encoder.handle_input(0, self.bits().bytes());
        let mut answer = Vec::new();
        while let Some(bytes) = encoder.poll_output(LISTEN) {
            answer.extend(bytes);
        }
        match answer.is_empty() {
            true => Heard::Silence,
            false => Heard::Answer(answer),
        }
    }

    fn framed(&self) -> Heard {
        let bytes = self.bits().bytes();
        // Who has asked knows where the reply begins and how long it is.
        if let Some(frame) = self.decoder.frame(bytes) {
            return judged(frame.faults(), frame.reading());
        }
        let mut why = Why::NoFrame;
        self.decoder.dump(&Dump::of_bytes(bytes), &mut |decoded| {
            if let Decoded::Skip { why: said, .. } = decoded {
                why = said;
            }
        });
        Heard::NoFrame(why)
    }
}

fn judged(faults: Vec<Fault>, reading: Option<Reading>) -> Heard {
    match (faults.is_empty(), reading) {
        (false, _) => Heard::Faults(faults),
        (true, Some(reading)) => Heard::Reading(reading),
        (true, None) => Heard::Good,
    }
}
