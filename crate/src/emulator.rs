//! The encoder's side: answers requests as the manuals say, with a moving shaft and faults.
//!
//! Feed requests to [`Emulator::handle_input`] and take the answers from
//! [`Emulator::poll_output`] when their last bit has left the wire. Time is in microseconds.

use crate::{
    bits::{self, BitString},
    decode::Decoder,
    format::{Format, STATUS, rs485, t485},
    layout::{Layout, Resolved, Role, Shape, StatusBit},
    profile::Profile,
    reading::Values,
    session::Micros,
};
use alloc::{collections::VecDeque, vec::Vec};

/// The reply starts 3 µs after the request (MPP "T485").
const TURNAROUND: Micros = 3;
/// Resets must be asked for ten times in a row (MPP "T485", "RS485").
const TEN: u8 = 10;
/// How long an RS485 encoder is silent while it stores a zero.
const STORING: Micros = 40_000;

/// How the shaft moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaft {
    /// Turns at time 0.
    pub start: f64,
    /// Revolutions per second.
    pub speed: f64,
    /// Turns by which it swings to both sides of that motion.
    pub sway: f64,
    /// Seconds of one swing to and fro.
    pub period: f64,
}

impl Shaft {
    /// A shaft that stands still.
    #[must_use]
    pub const fn still(turns: f64) -> Self {
        Self {
            start: turns,
            speed: 0.0,
            sway: 0.0,
            period: 1.0,
        }
    }

    /// A shaft that turns evenly.
    #[must_use]
    pub const fn turning(turns: f64, speed: f64) -> Self {
        Self {
            start: turns,
            speed,
            sway: 0.0,
            period: 1.0,
        }
    }

    /// Where it is, in turns.
    ///
    /// ```
    /// use encoderscope::emulator::Shaft;
    /// assert_eq!(Shaft::turning(0.5, 2.0).at(1_000_000), 2.5);
    /// ```
    #[must_use]
    pub fn at(&self, now: Micros) -> f64 {
        let seconds = now as f64 / 1e6;
        self.start + self.speed * seconds + self.sway * swing(seconds / self.period)
    }

    /// How fast it turns, in revolutions per second.
    #[must_use]
    pub fn speed_at(&self, now: Micros) -> f64 {
        (self.at(now + 500) - self.at(now.saturating_sub(500))) * 1000.0
    }
}

/// The bits of `from` that are set in `value`, at the places that `to` gives their names.
fn carried(value: u64, from: &[StatusBit], to: &[StatusBit]) -> u8 {
    let set = from.iter().filter(|bit| bits::bit(value, bit.place));
    set.fold(0, |sum, bit| sum | bit_named(to, bit.name))
}

/// The bit of a name; nothing where the table has no such bit.
fn bit_named(table: &[StatusBit], name: &str) -> u8 {
    let found = table.iter().find(|bit| bit.name == name);
    found.map_or(0, |bit| bits::low_byte(bits::placed(1, bit.place)))
}

/// A smooth wave of period 1 between −1 and 1, two parabolas.
fn swing(phase: f64) -> f64 {
    let (_, x) = split(phase);
    if x < 0.5 {
        16.0 * x * (0.5 - x)
    } else {
        -16.0 * (x - 0.5) * (1.0 - x)
    }
}

/// Whole turns and the part of a turn, which is never negative.
fn split(turns: f64) -> (i64, f64) {
    let whole = turns as i64;
    let part = turns - whole as f64;
    if part < 0.0 {
        (whole - 1, part + 1.0)
    } else {
        (whole, part)
    }
}

/// What goes wrong on the way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Faults {
    /// The adapter returns every request.
    pub echo: bool,
    /// No answers at all.
    pub silent: bool,
    /// Of 1000 reply bytes, how many have a bit turned over.
    pub flip: u32,
    /// Of 1000 reply bytes, how many get lost.
    pub drop: u32,
    /// Of 1000 reply bytes, how many are followed by a stray byte.
    pub insert: u32,
}

/// An encoder.
///
/// ```
/// use encoderscope::{emulator::{Emulator, Shaft}, profile::Profile};
/// let profile = Profile::parse([("format", "rs485"), ("turns-bits", "0"), ("command", "1")])?;
/// let mut encoder = Emulator::new(profile, Shaft::still(0.5))?;
/// encoder.handle_input(0, &[0x31]);
/// assert_eq!(encoder.poll_output(1_000).unwrap()[..3], [0x80, 0x00, 0x00]);
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Debug)]
pub struct Emulator {
    profile: Profile,
    /// How the shaft moves.
    pub shaft: Shaft,
    /// What goes wrong on the way.
    pub faults: Faults,
    /// The six status bits.
    pub status: u8,
    /// The position is not valid.
    pub error: bool,
    /// Something is near its limit.
    pub warning: bool,
    /// Degrees Celsius × 10.
    pub temperature: i32,
    /// Turns that are taken off the shaft's.
    zero: f64,
    last: u8,
    counted: u8,
    silent_until: Micros,
    random: u64,
    output: VecDeque<(Micros, Vec<u8>)>,
}

impl Emulator {
    /// An encoder that is well.
    ///
    /// # Errors
    ///
    /// A parameter of the profile is out of range.
    pub fn new(profile: Profile, shaft: Shaft) -> Result<Self, crate::profile::ProfileError> {
        Decoder::new(profile)?;
        Ok(Self {
            profile,
            shaft,
            faults: Faults::default(),
            status: 0,
            error: false,
            warning: false,
            temperature: 312,
            zero: 0.0,
            last: 0,
            counted: 0,
            silent_until: 0,
            random: 0x9e37_79b9_7f4a_7c15,
            output: VecDeque::new(),
        })
    }

    /// When the next answer is due.
    #[must_use]
    pub fn deadline(&self) -> Option<Micros> {
        self.output.front().map(|(at, _)| *at)
    }

    /// The next answer that has left the wire by `now`.
    pub fn poll_output(&mut self, now: Micros) -> Option<Vec<u8>> {
        if self.deadline()? > now {
            return None;
        }
        self.output.pop_front().map(|(_, bytes)| bytes)
    }

    /// The host has sent `bytes`.
    pub fn handle_input(&mut self, now: Micros, bytes: &[u8]) {
        for byte in bytes {
            let mut line = Vec::new();
            if self.faults.echo {
                line.push(*byte);
            }
            if now >= self.silent_until && !self.faults.silent {
                if let Some(reply) = self.answer(now, *byte) {
                    self.disturb(&reply.into_bytes(), &mut line);
                }
                self.last = *byte;
            }
            if !line.is_empty() {
                let on_wire = line.len() as u64 * 10_000_000 / u64::from(self.profile.baud);
                self.output.push_back((now + TURNAROUND + on_wire, line));
            }
        }
    }

    /// The numbers of this moment.
    #[must_use]
    pub fn values(&self, now: Micros) -> Values {
        let (turns, part) = split(self.shaft.at(now) - self.zero);
        let codes = bits::codes(self.profile.angle_bits) as f64;
        let (status, alarm) = match self.profile.format {
            Format::T485 => (0, carried(u64::from(self.status), STATUS, t485::ALARM)),
            Format::BissC | Format::Rs485 => (self.status, 0),
        };
        Values {
            turns: Some(bits::slice(
                turns as u64,
                0,
                self.profile.turns_bits as usize,
            )),
            angle: Some((part * codes) as u64),
            error: Some(self.error),
            warning: Some(self.warning),
            status: Some(status),
            alarm: Some(alarm),
            enid: Some(if self.profile.angle_bits == 17 {
                0x11
            } else {
                0x17
            }),
            speed: Some((self.shaft.speed_at(now) * 10.0) as i32),
            temperature: Some(self.temperature),
            count: Some(self.counted),
            ..Values::default()
        }
    }

    fn answer(&mut self, now: Micros, byte: u8) -> Option<BitString> {
        match self.profile.format {
            Format::T485 => Some(self.answer_t485(now, byte)),
            Format::Rs485 => self.answer_rs485(now, byte),
            Format::BissC => None,
        }
    }

    fn resolved(&self, layout: &'static Layout) -> Resolved {
        Resolved::new(layout, Shape::of(self.profile))
    }

    fn answer_t485(&mut self, now: Micros, byte: u8) -> BitString {
        use t485::Request;
        let request = Request::of_byte(byte).filter(|request| {
            // MPP and PT know these five; the others are Tamagawa's own.
            matches!(
                request,
                Request::Angle
                    | Request::Turns
                    | Request::All
                    | Request::ResetAngle
                    | Request::ResetTurns
            )
        });
        self.count_resets(now, byte, request);
        let layout = self.resolved(request.unwrap_or(Request::Angle).reply());
        let mut values = self.values(now);
        if request.is_none() {
            values.status = Some(bit_named(t485::STATUS_FIELD, "communication error"));
        }
        let mut out = layout.encode(&values);
        out.write(bits::Span::new(0, 8), u64::from(byte));
        layout.seal(&mut out, Role::Crc);
        out
    }

    fn count_resets(&mut self, now: Micros, byte: u8, request: Option<t485::Request>) {
        self.counted = if self.last == byte {
            self.counted.saturating_add(1)
        } else {
            1
        };
        if self.counted == TEN {
            let (turns, part) = split(self.shaft.at(now) - self.zero);
            match request {
                Some(t485::Request::ResetAngle) => self.zero += part,
                Some(t485::Request::ResetTurns) => self.zero += turns as f64,
                _ => {}
            }
        }
    }

    fn answer_rs485(&mut self, now: Micros, byte: u8) -> Option<BitString> {
        let command = rs485::Command::of_byte(byte)?;
        match command {
            rs485::Command::Zero if self.last == rs485::Command::Position.byte() => {
                self.counted += 1;
            }
            rs485::Command::Zero => self.counted = 1,
            rs485::Command::Position if self.last == rs485::Command::Zero.byte() => {}
            _ => self.counted = 0,
        }
        let reply = self.resolved(command.reply()).encode(&self.values(now));
        if self.counted == TEN {
            self.zero = self.shaft.at(now);
            self.counted = 0;
            self.silent_until = now + STORING;
        }
        Some(reply)
    }

    fn disturb(&mut self, reply: &[u8], line: &mut Vec<u8>) {
        for byte in reply {
            let mut byte = *byte;
            if self.chance(self.faults.flip) {
                let place = (self.next() % 8) as u32;
                byte ^= bits::low_byte(bits::placed(1, place));
            }
            if !self.chance(self.faults.drop) {
                line.push(byte);
            }
            if self.chance(self.faults.insert) {
                let stray = bits::low_byte(self.next());
                line.push(stray);
            }
        }
    }

    fn chance(&mut self, per_mille: u32) -> bool {
        per_mille > 0 && self.next() % 1000 < u64::from(per_mille)
    }

    /// A linear congruential generator (Knuth's MMIX); its high half is random enough here.
    fn next(&mut self) -> u64 {
        self.random = self
            .random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        bits::slice(self.random, 33, 31)
    }
}
