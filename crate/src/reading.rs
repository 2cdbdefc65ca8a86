//! What a frame says: [`Values`] are all its numbers as they were sent, good or bad;
//! a [`Reading`] exists only where every check of the frame holds.

mod fault;

pub use fault::{Fault, FaultKind};

use crate::{
    bits::{self, BitString, Bits, Span},
    layout::{Active, Field, Resolved, Role, StatusBit},
    profile::TurnsCode,
};
use alloc::vec::Vec;

/// A check field: what was received, and what the covered bits give.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Checked {
    /// Computed from the covered bits.
    pub expected: u64,
    /// Received.
    pub received: u64,
}

impl Checked {
    /// Whether the check holds.
    #[must_use]
    pub const fn ok(self) -> bool {
        self.expected == self.received
    }
}

/// All numbers of a frame as they were sent; what the format does not have is `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Values {
    /// Whole turns; negative only where the profile reads the counter as signed.
    pub turns: Option<i64>,
    /// Counts within one turn.
    pub angle: Option<u64>,
    /// The position is not valid, whatever the polarity of the bit.
    pub error: Option<bool>,
    /// The position is valid, in formats that say so; `error` is the opposite.
    pub valid: Option<bool>,
    /// No zero has been set by the user.
    pub zero_default: Option<bool>,
    /// The position is valid, but near a limit; false in formats that have only an error flag.
    pub warning: Option<bool>,
    /// The six status bits, 1 where the condition is there; T485: the status field.
    pub status: Option<u8>,
    /// The alarm byte.
    pub alarm: Option<u8>,
    /// Encoder identity.
    pub enid: Option<u8>,
    /// Revolutions per second × 10.
    pub speed: Option<i32>,
    /// Degrees Celsius × 10.
    pub temperature: Option<i32>,
    /// How many commands of a sequence the encoder has counted.
    pub count: Option<u8>,
    /// The operation that the frame answers; T485: the data ID, four bits; BUS: two bits.
    pub operation: Option<u8>,
    /// Address of the device on a bus.
    pub address: Option<u8>,
    /// EEPROM address and data.
    pub memory: (Option<u8>, Option<u8>),
    /// The CRC.
    pub crc: Option<Checked>,
    /// The parity.
    pub parity: Option<Checked>,
}

/// Position and health, from a frame whose checks all hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Counts within one turn, in 0…2^`angle_bits`−1.
    pub angle: u64,
    /// Bits per turn.
    pub angle_bits: u32,
    /// Whole turns, where the encoder counts them.
    pub turns: Option<i64>,
    /// The encoder itself says that the position is not valid.
    pub error: bool,
    /// The encoder warns; the position is valid.
    pub warning: bool,
    /// The six status bits; T485: the status field.
    pub status: Option<u8>,
}

impl Reading {
    /// The angle in degrees, 0 ≤ d < 360.
    ///
    /// ```
    /// use encoderscope::reading::degrees;
    /// assert_eq!(degrees(65_536, 17), 180.0);
    /// ```
    #[must_use]
    pub fn degrees(&self) -> f64 {
        degrees(self.angle, self.angle_bits)
    }
}

/// `angle` counts of `angle_bits` bits per turn, in degrees.
#[must_use]
pub fn degrees(angle: u64, angle_bits: u32) -> f64 {
    let degrees = angle as f64 * 360.0 / bits::codes(angle_bits) as f64;
    // Beyond 53 bits the last counts would round up to a full turn.
    degrees.min(360.0f64.next_down())
}

impl Resolved {
    /// All numbers of a frame.
    #[must_use]
    pub fn values(&self, bits: Bits<'_>) -> Values {
        let mut values = Values::default();
        for field in self.fields() {
            let raw = self.read(field, bits);
            let byte = Some(bits::low_byte(raw));
            let asserted = Some((raw != 0) == (field.row.active == Active::High));
            // Of several flags one is enough.
            let either = |known: Option<bool>, says: Option<bool>| says.max(known);
            let tenths = || Some(bits::signed(raw, field.width as usize) as i32);
            match field.row.role {
                Role::Turns => values.turns = Some(self.turns(raw)),
                Role::Angle => values.angle = Some(raw),
                Role::Error => values.error = either(values.error, asserted),
                Role::Warning => values.warning = either(values.warning, asserted),
                Role::Valid => {
                    values.valid = asserted;
                    values.error = either(values.error, asserted.map(|valid| !valid));
                }
                Role::ZeroDefault => values.zero_default = asserted,
                Role::Status => {
                    values.status = Some(bits::low_byte(field.active_high(raw)));
                    for named in field.row.bits {
                        if named.role == Some(Role::Error) {
                            values.error = Some(bits::bit(raw, named.place));
                        }
                    }
                }
                Role::Alarm => values.alarm = byte,
                Role::Enid => values.enid = byte,
                Role::Speed => values.speed = tenths(),
                Role::Temperature => values.temperature = tenths(),
                Role::Count => values.count = byte,
                Role::Operation => values.operation = byte,
                Role::Address => values.address = byte,
                Role::MemoryAddress => values.memory.0 = byte,
                Role::MemoryData => values.memory.1 = byte,
                Role::Crc => values.crc = self.checked(field, bits),
                Role::Parity => values.parity = self.checked(field, bits),
                Role::Framing | Role::Padding | Role::Repeat => {}
            }
        }
        if values.error.is_some() && values.warning.is_none() {
            values.warning = Some(false);
        }
        values
    }

    /// The turn counter as the profile reads it.
    #[inline]
    pub(crate) fn turns(&self, raw: u64) -> i64 {
        match self.shape.profile.turns_code {
            TurnsCode::Unsigned => i64::try_from(raw).unwrap_or(i64::MAX),
            TurnsCode::Signed => bits::signed(raw, self.shape.profile.turns_bits as usize),
        }
    }

    /// What a check field holds and what it must hold.
    #[must_use]
    pub fn checked(&self, field: &Field, bits: Bits<'_>) -> Option<Checked> {
        let received = self.read(field, bits);
        self.expected(field, bits)
            .map(|expected| Checked { expected, received })
    }

    /// Position and health.
    ///
    /// # Errors
    ///
    /// Refuses a frame with any fault, and says which; a frame without an angle gives no
    /// reading.
    pub fn reading(&self, bits: Bits<'_>) -> Result<Option<Reading>, Vec<Fault>> {
        if self.holds(bits) {
            Ok(self.position(bits))
        } else {
            Err(self.faults(bits))
        }
    }

    /// Position and health of a frame whose checks hold.
    #[inline]
    pub(crate) fn position(&self, bits: Bits<'_>) -> Option<Reading> {
        match self.quick_position(bits) {
            Some(reading) => Some(reading),
            None => self.slow_position(bits),
        }
    }

    fn slow_position(&self, bits: Bits<'_>) -> Option<Reading> {
        let mut angle = None;
        let mut reading = Reading {
            angle: 0,
            angle_bits: self.shape.profile.angle_bits,
            turns: None,
            error: false,
            warning: false,
            status: None,
        };
        for field in self.fields() {
            let row = field.row;
            let raw = || self.read(field, bits);
            let asserted = || (raw() != 0) == (row.active == Active::High);
            match row.role {
                Role::Angle => angle = Some(raw()),
                Role::Turns => reading.turns = Some(self.turns(raw())),
                Role::Error => reading.error |= asserted(),
                Role::Valid => reading.error |= !asserted(),
                Role::Warning => reading.warning |= asserted(),
                Role::Status => {
                    let raw = raw();
                    reading.status = Some(bits::low_byte(field.active_high(raw)));
                    let errors = row.bits.iter().filter(|bit| bit.role == Some(Role::Error));
                    for bit in errors {
                        reading.error = bits::bit(raw, bit.place);
                    }
                }
                _ => {}
            }
        }
        angle.map(|angle| Reading { angle, ..reading })
    }

    /// The frame that says `values`; absent ones are 0 or not asserted, checks are computed.
    #[must_use]
    pub fn encode(&self, values: &Values) -> BitString {
        let mut out = BitString::zeros(self.len);
        for field in self.fields() {
            let byte = |value: Option<u8>| u64::from(value.unwrap_or(0));
            let tenths = |value: Option<i32>| i64::from(value.unwrap_or(0)) as u64;
            let flag = |value: Option<bool>| {
                u64::from(value.unwrap_or(false) == (field.row.active == Active::High))
            };
            let raw = match field.row.role {
                Role::Turns => values.turns.unwrap_or(0) as u64,
                Role::Angle => values.angle.unwrap_or(0),
                Role::Error => flag(values.error),
                Role::Warning => flag(values.warning),
                Role::Valid => flag(Some(
                    values.valid.unwrap_or_else(|| values.error != Some(true)),
                )),
                Role::ZeroDefault => flag(values.zero_default),
                Role::Status => {
                    let error = |bit: &&StatusBit| {
                        bit.role == Some(Role::Error) && values.error == Some(true)
                    };
                    let errors = field.row.bits.iter().filter(error);
                    let raw = errors.fold(byte(values.status), |raw, bit| {
                        raw | bits::placed(1, bit.place)
                    });
                    field.active_high(raw)
                }
                Role::Alarm => byte(values.alarm),
                Role::Enid => byte(values.enid),
                Role::Speed => tenths(values.speed),
                Role::Temperature => tenths(values.temperature),
                Role::Count => byte(values.count),
                Role::Operation => byte(values.operation),
                Role::Address => byte(values.address),
                Role::MemoryAddress => byte(values.memory.0),
                Role::MemoryData => byte(values.memory.1),
                Role::Framing => match field.row.constant {
                    Some(constant) => constant,
                    None => (field.row.rest)(&self.shape),
                },
                Role::Padding | Role::Crc | Role::Parity | Role::Repeat => 0,
            };
            self.write(field, &mut out, raw);
        }
        self.mend(&mut out);
        self.repeat(&mut out);
        out
    }

    /// Computes all checks anew; one may cover another, wherever they stand.
    pub(crate) fn mend(&self, out: &mut BitString) {
        let checks = self.fields().filter(|field| field.cover.is_some());
        for _ in checks {
            let parity = self.seal(out, Role::Parity);
            if !self.seal(out, Role::Crc) && !parity {
                break;
            }
        }
    }

    /// Computes the checks of one kind anew; whether any was another one.
    pub fn seal(&self, out: &mut BitString, role: Role) -> bool {
        let mut changed = false;
        for field in self.fields().filter(|field| field.row.role == role) {
            if let Some(value) = self.expected(field, out.as_bits())
                && self.read(field, out.as_bits()) != value
            {
                self.write(field, out, value);
                changed = true;
            }
        }
        changed
    }

    /// Writes the word once more, as often as the shape says.
    fn repeat(&self, out: &mut BitString) {
        let word = self.shape.profile.frame_bits as usize;
        for field in self.fields().filter(|field| field.row.role == Role::Repeat) {
            for part in self.parts(field) {
                for at in part.span.start..part.span.end() {
                    let behind = (at - part.span.start) % (word + 1);
                    let from = part.span.start.saturating_sub(word) + behind.saturating_sub(1);
                    let bit = behind > 0 && out.as_bits().bit(from);
                    out.write(Span::new(at, 1), u64::from(bit));
                }
            }
        }
    }
}

impl Field {
    /// The bits of a status field, 1 where the condition is there; the same the other way round.
    pub(crate) fn active_high(&self, raw: u64) -> u64 {
        match self.row.active {
            Active::High => raw,
            Active::Low => !raw & bits::mask(self.width as usize),
        }
    }
}
