//! What a frame says: [`Values`] are all its numbers as they were sent, good or bad;
//! a [`Reading`] exists only where every check of the frame holds.

use crate::{
    bits::{self, BitString, Bits, Span},
    layout::{Active, Field, Resolved, Role, StatusBit},
};
use alloc::vec::Vec;
use core::fmt;

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
    /// Whole turns, unsigned.
    pub turns: Option<u64>,
    /// Counts within one turn.
    pub angle: Option<u64>,
    /// The position is not valid, whatever the polarity of the bit.
    pub error: Option<bool>,
    /// The position is valid, but near a limit; false in formats that have only an error flag.
    pub warning: Option<bool>,
    /// The six status bits; T485: the status field.
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
    /// The operation that the frame answers; T485: the data ID, four bits.
    pub operation: Option<u8>,
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
    /// Whole turns, unsigned, where the encoder counts them.
    pub turns: Option<u64>,
    /// The encoder itself says that the position is not valid.
    pub error: bool,
    /// The encoder warns; the position is valid.
    pub warning: bool,
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

/// What is wrong with a frame, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The bits of the frame that show it.
    pub at: Span,
    /// What is wrong.
    pub kind: FaultKind,
}

/// Kinds of faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// A CRC or parity does not hold.
    Check {
        /// Name of the field.
        name: &'static str,
        /// The numbers.
        checked: Checked,
    },
    /// A fixed field has another value.
    Constant {
        /// Name of the field.
        name: &'static str,
        /// What it must be.
        expected: u64,
        /// What it is.
        received: u64,
    },
    /// The bits above a right-aligned number are not zero: the number is wider than asked for.
    Wider {
        /// Name of the padding.
        name: &'static str,
    },
    /// Bits that are always 0 are not.
    Zeros {
        /// Name of the field.
        name: &'static str,
    },
    /// The frame's place is not certain: another phase of the stream passes its checks as well.
    Ambiguous,
}

impl fmt::Display for FaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Check { name, checked } => write!(
                f,
                "{name} is 0x{:02X}, the data gives 0x{:02X}",
                checked.received, checked.expected
            ),
            Self::Constant {
                name,
                expected,
                received,
            } => {
                write!(f, "{name} is {received:b}, must be {expected:b}")
            }
            Self::Wider { name } => write!(
                f,
                "{name} is not 0: the number is wider than the profile says"
            ),
            Self::Zeros { name } => write!(f, "bits of {name} that are always 0 are set"),
            Self::Ambiguous => f.write_str(
                "the check passes, but may do so by chance: where frames begin is not certain",
            ),
        }
    }
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
            match field.row.role {
                Role::Turns => values.turns = Some(raw),
                Role::Angle => values.angle = Some(raw),
                Role::Error => values.error = asserted,
                Role::Warning => values.warning = asserted,
                Role::Status => {
                    values.status = byte;
                    for named in field.row.bits {
                        if named.role == Some(Role::Error) {
                            values.error = Some(bits::bit(raw, named.place));
                        }
                    }
                }
                Role::Alarm => values.alarm = byte,
                Role::Enid => values.enid = byte,
                Role::Speed => values.speed = Some(bits::signed16(raw)),
                Role::Temperature => values.temperature = Some(bits::signed16(raw)),
                Role::Count => values.count = byte,
                Role::Operation => values.operation = byte,
                Role::MemoryAddress => values.memory.0 = byte,
                Role::MemoryData => values.memory.1 = byte,
                Role::Crc => values.crc = checked(field, raw, bits),
                Role::Parity => values.parity = checked(field, raw, bits),
                Role::Framing | Role::Padding => {}
            }
        }
        if values.error.is_some() && values.warning.is_none() {
            values.warning = Some(false);
        }
        values
    }

    /// What is wrong with a frame; nothing for a good one.
    #[must_use]
    pub fn faults(&self, bits: Bits<'_>) -> Vec<Fault> {
        self.fields()
            .filter_map(|field| self.fault(field, bits))
            .collect()
    }

    /// Whether every check of the frame holds.
    #[must_use]
    pub fn holds(&self, bits: Bits<'_>) -> bool {
        self.fields().all(|field| self.fault(field, bits).is_none())
    }

    /// What is wrong with one field.
    #[must_use]
    pub fn fault(&self, field: &Field, bits: Bits<'_>) -> Option<Fault> {
        let name = field.row.name;
        let raw = self.read(field, bits);
        let kind = if let Some(expected) = field.row.constant
            && raw != expected
        {
            match field.row.role {
                Role::Padding => FaultKind::Wider { name },
                _ => FaultKind::Constant {
                    name,
                    expected,
                    received: raw,
                },
            }
        } else if raw & field.row.zeros != 0 {
            FaultKind::Zeros { name }
        } else {
            let checked = checked(field, raw, bits).filter(|checked| !checked.ok())?;
            FaultKind::Check { name, checked }
        };
        let at = self
            .parts(field)
            .first()
            .map_or_else(Span::default, |part| part.span);
        Some(Fault { at, kind })
    }

    /// Position and health.
    ///
    /// # Errors
    ///
    /// Refuses a frame with any fault, and says which; a frame without an angle gives no
    /// reading.
    pub fn reading(&self, bits: Bits<'_>) -> Result<Option<Reading>, Vec<Fault>> {
        let faults = self.faults(bits);
        if !faults.is_empty() {
            return Err(faults);
        }
        let values = self.values(bits);
        Ok(values.angle.map(|angle| Reading {
            angle,
            angle_bits: self.shape.profile.angle_bits,
            turns: values.turns,
            error: values.error == Some(true),
            warning: values.warning == Some(true),
        }))
    }

    /// The frame that says `values`; absent ones are 0 or not asserted, checks are computed.
    #[must_use]
    pub fn encode(&self, values: &Values) -> BitString {
        let mut out = BitString::zeros(self.len);
        for field in self.fields() {
            let byte = |value: Option<u8>| u64::from(value.unwrap_or(0));
            let flag = |value: Option<bool>| {
                u64::from(value.unwrap_or(false) == (field.row.active == Active::High))
            };
            let raw = match field.row.role {
                Role::Turns => values.turns.unwrap_or(0),
                Role::Angle => values.angle.unwrap_or(0),
                Role::Error => flag(values.error),
                Role::Warning => flag(values.warning),
                Role::Status => {
                    let error = |bit: &&StatusBit| {
                        bit.role == Some(Role::Error) && values.error == Some(true)
                    };
                    let errors = field.row.bits.iter().filter(error);
                    errors.fold(byte(values.status), |raw, bit| {
                        raw | bits::placed(1, bit.place)
                    })
                }
                Role::Alarm => byte(values.alarm),
                Role::Enid => byte(values.enid),
                Role::Speed => bits::from_signed16(values.speed.unwrap_or(0)),
                Role::Temperature => bits::from_signed16(values.temperature.unwrap_or(0)),
                Role::Count => byte(values.count),
                Role::Operation => byte(values.operation),
                Role::MemoryAddress => byte(values.memory.0),
                Role::MemoryData => byte(values.memory.1),
                Role::Framing => match field.row.constant {
                    Some(constant) => constant,
                    None if field.row.active == Active::Low => u64::MAX,
                    None => 0,
                },
                Role::Padding | Role::Crc | Role::Parity => 0,
            };
            self.write(field, &mut out, raw);
        }
        self.seal(&mut out, Role::Parity);
        self.seal(&mut out, Role::Crc);
        out
    }

    /// Computes the checks of one kind anew.
    pub fn seal(&self, out: &mut BitString, role: Role) {
        for field in self.fields().filter(|field| field.row.role == role) {
            if let Some((sum, over)) = field.cover {
                let value = sum.compute(out.as_bits(), over);
                self.write(field, out, value);
            }
        }
    }
}

fn checked(field: &Field, received: u64, bits: Bits<'_>) -> Option<Checked> {
    field.cover.map(|(sum, over)| Checked {
        expected: sum.compute(bits, over),
        received,
    })
}
