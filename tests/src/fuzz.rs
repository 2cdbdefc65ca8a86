//! Laws of the core that must hold for any input, as functions of arbitrary bytes.
//!
//! A fuzzer looks for bytes that break them (`tests/fuzz`); the tests run them over what it has
//! found and over noise. Each panics where a law is broken.

mod capture;
mod decode;
mod detect;
mod dump;
mod framing;
mod link;
mod recording;
mod session;
mod sketch;
mod vcd;

pub use capture::capture;
pub use decode::decode;
pub use detect::detect;
pub use dump::dump;
pub use framing::framing;
pub use link::link;
pub use recording::recording;
pub use session::session;
pub use sketch::sketch;
pub use vcd::vcd;

use encoderscope::{
    decode::Decoder,
    format::{Format, Medium, rs485::Command, ssi_tree},
    profile::{Align, Code, Dialect, Justify, Marker, Parity, StatusActive, TurnsCode},
    reading::Values,
    record::{Value, hex},
};

/// The inputs of a corpus: one a line, in hexadecimal digits; lines from `#` on are remarks.
///
/// # Panics
///
/// A line is not hexadecimal.
pub fn inputs(corpus: &str) -> impl Iterator<Item = Vec<u8>> {
    let lines = corpus.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| {
        let digits: Vec<u8> = line
            .chars()
            .map(|digit| digit.to_digit(16).expect("hexadecimal") as u8)
            .collect();
        digits
            .chunks(2)
            .map(|pair| pair[0] << 4 | pair[1])
            .collect()
    })
}

/// Arbitrary bytes, read from the front; behind their end come zeros.
#[derive(Clone, Copy, Debug)]
struct Input<'a>(&'a [u8]);

impl<'a> Input<'a> {
    const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn byte(&mut self) -> u8 {
        self.take(1).first().copied().unwrap_or(0)
    }

    fn word(&mut self) -> u16 {
        u16::from(self.byte()) << 8 | u16::from(self.byte())
    }

    fn long(&mut self) -> u64 {
        (0..4).fold(0, |sum, _| sum << 16 | u64::from(self.word()))
    }

    /// A number in `low..=high`.
    fn within(&mut self, low: u32, high: u32) -> u32 {
        low + u32::from(self.byte()) % (high - low + 1)
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[usize::from(self.byte()) % all.len()]
    }

    /// The next `count` bytes, or what there is.
    fn take(&mut self, count: usize) -> &'a [u8] {
        let (taken, rest) = self.0.split_at(count.min(self.0.len()));
        self.0 = rest;
        taken
    }

    /// A profile of one of the formats, in a fixed number of bytes so that what follows stays in
    /// its place; mostly one that fits its format.
    fn decoder(&mut self, formats: &[Format]) -> Option<Decoder> {
        let format = self.one_of(formats);
        let limits = format.limits();
        let mut profile = format.default_profile();
        let raw = self.byte() == 0xff;
        if raw {
            profile.angle_bits = self.byte().into();
            profile.turns_bits = self.byte().into();
            profile.status_bits = self.byte().into();
            profile.ack_bits = self.byte().into();
            profile.address = self.byte().into();
        } else {
            profile.angle_bits = self.within(1, limits.angle);
            let room = limits.turns.min(limits.together - profile.angle_bits);
            profile.turns_bits = self.within(0, room);
            profile.status_bits = self.within(0, 8);
            profile.ack_bits = self.within(1, 64);
            profile.address = self.within(0, 31);
        }
        profile.command = self.one_of(Command::ALL);
        profile.parity = self.one_of(Parity::ALL);
        let choices = self.byte();
        let chosen = |place: u32| usize::from(choices >> place & 1);
        profile.code = Code::ALL[chosen(0)];
        profile.align = Align::ALL[chosen(1)];
        profile.turns_code = TurnsCode::ALL[chosen(2)];
        profile.status_active = StatusActive::ALL[chosen(3)];
        profile.dialect = Dialect::ALL[chosen(4)];
        profile.justify = Justify::ALL[chosen(5)];
        profile.marker = Marker::ALL[chosen(6)];
        profile.baud = self.one_of(&[2_500_000, 115_200, 9_600, 50_000_000, 1_200]);
        let low = match format {
            Format::SsiTree => ssi_tree::needed_bits(&profile),
            _ => limits.frame.0,
        };
        profile.frame_bits = match raw {
            true => self.byte().into(),
            false => self.within(low, low.max(limits.frame.1)),
        };
        let decoder = Decoder::new(profile);
        assert!(raw || decoder.is_ok(), "{decoder:?}");
        decoder.ok()
    }

    /// Text: as it stands, or the digits of its bytes, or of its bits.
    fn text(&mut self) -> String {
        let form = self.byte();
        let per_line = self.within(1, 64) as usize;
        let bytes = core::mem::take(&mut self.0);
        let lines = |digits: fn(&[u8]) -> String| {
            let lines = bytes.chunks(per_line).map(digits);
            lines.collect::<Vec<_>>().join("\n")
        };
        match form % 4 {
            0 | 1 => String::from_utf8_lossy(bytes).into_owned(),
            2 => lines(hex),
            _ => lines(|bytes| bytes.iter().map(|byte| format!("{byte:08b}")).collect()),
        }
    }

    /// Text: ASCII as it stands, other bytes a word each.
    fn worded(&mut self, words: &[&str]) -> String {
        let mut text = String::new();
        for byte in core::mem::take(&mut self.0) {
            match byte.checked_sub(128) {
                None => text.push(char::from(*byte)),
                Some(word) => text.push_str(words[usize::from(word) % words.len()]),
            }
        }
        text
    }

    fn values(&mut self) -> Values {
        let present = self.word();
        let some = |place: u32| present >> place & 1 == 1;
        Values {
            turns: some(0).then_some(self.long() as i64),
            angle: some(1).then_some(self.long()),
            error: some(2).then_some(some(3)),
            valid: some(4).then_some(some(5)),
            zero_default: some(6).then_some(some(7)),
            warning: some(8).then_some(some(9)),
            status: some(10).then_some(self.byte()),
            alarm: some(10).then_some(self.byte()),
            enid: some(10).then_some(self.byte()),
            speed: some(11).then_some(self.long() as i32),
            temperature: some(11).then_some(self.long() as i32),
            count: some(12).then_some(self.byte()),
            operation: some(13).then_some(self.byte()),
            address: some(14).then_some(self.byte()),
            memory: (
                some(15).then_some(self.byte()),
                some(15).then_some(self.byte()),
            ),
            crc: None,
            parity: None,
        }
    }
}

/// The formats whose dumps are one stream of bytes.
fn streams() -> Vec<Format> {
    let streamed = |format: &Format| format.default_profile().medium() != Medium::Bits;
    Format::ALL.iter().copied().filter(streamed).collect()
}

/// A record is JSON only where every number is finite.
fn check_record(value: &Value) {
    match value {
        Value::Decimal(digits) => {
            let number = digits.parse::<f64>();
            assert!(number.is_ok_and(f64::is_finite), "{digits}");
        }
        Value::List(values) => values.iter().for_each(check_record),
        Value::Record(record) => record.0.iter().for_each(|(_, value)| check_record(value)),
        _ => {}
    }
}
