//! What an encoder answers to a byte, and what it counts while it does.

use super::{Emulator, shaft::split};
use crate::{
    bits::{self, Bits, Span},
    format::{
        Format, TIMES, bus,
        bus::Operation,
        rs485,
        t485::{self, Request},
    },
    layout::{Layout, Resolved, Role, Shape},
    profile::{Parity, Profile},
    session::Micros,
};
use alloc::vec::Vec;

/// The reply starts 3 µs after the request (MPP "T485").
pub(crate) const TURNAROUND: Micros = 3;
/// The first counts of an address sequence get no answer (MPP "BUS", set address, note 2).
const SILENT_COUNTS: u8 = 3;
/// A request of several bytes is given up when the next byte does not come.
const BETWEEN_BYTES: Micros = 20_000;

/// What an encoder keeps of a conversation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Talk {
    pub(super) address: u8,
    pub(super) memory: [u8; t485::MEMORY_SIZE as usize],
    /// How many commands of a sequence have been counted.
    pub(super) counted: u8,
    last: u8,
    /// Nothing is heard until then.
    deaf_until: Micros,
    /// The bytes of a request that is longer than one, so far, and when the last one came.
    partial: [u8; 4],
    partial_len: usize,
    partial_at: Micros,
    /// The operation before, on a BUS.
    before: Option<Operation>,
    /// Counts that a zero sequence and an address sequence have come to.
    zero_count: u8,
    address_count: u8,
    /// An address sequence that had been answered was broken: the next command is answered.
    address_broken: bool,
}

impl Talk {
    pub(super) const fn new(profile: &Profile) -> Self {
        Self {
            address: bits::low_byte(profile.address as u64),
            memory: [0; t485::MEMORY_SIZE as usize],
            counted: 0,
            last: 0,
            deaf_until: 0,
            partial: [0; 4],
            partial_len: 0,
            partial_at: 0,
            before: None,
            zero_count: 0,
            address_count: 0,
            address_broken: false,
        }
    }

    /// What is left of it after the power was off.
    pub(super) const fn restarted(&self, profile: &Profile) -> Self {
        let mut talk = Self::new(profile);
        talk.address = self.address;
        talk.memory = self.memory;
        talk
    }
}

impl Emulator {
    /// The reply to a byte; empty where there is none.
    pub(super) fn answer(&mut self, now: Micros, byte: u8) -> Vec<u8> {
        if now < self.talk.deaf_until {
            return Vec::new();
        }
        let reply = match self.profile().format {
            Format::T485 => self.answer_t485(now, byte),
            Format::Rs485 => self.answer_rs485(now, byte),
            Format::Bus => self.answer_bus(now, byte),
            _ => self.answer_own(now, byte),
        };
        self.talk.last = byte;
        reply.unwrap_or_default()
    }

    fn resolved(&self, layout: &'static Layout) -> Resolved {
        Resolved::new(layout, Shape::of(*self.profile()))
    }

    fn answer_own(&self, now: Micros, byte: u8) -> Option<Vec<u8>> {
        let own = self
            .profile()
            .own
            .filter(|own| own.request() == Some(byte))?;
        let layout = self.resolved(own.layout());
        Some(layout.encode(&self.values(now)).into_bytes())
    }

    fn answer_rs485(&mut self, now: Micros, byte: u8) -> Option<Vec<u8>> {
        use rs485::Command;
        let command = Command::of_byte(byte)?;
        let last = Command::of_byte(self.talk.last);
        self.talk.counted = match command {
            Command::Zero if last == Some(Command::Position) => self.talk.counted + 1,
            Command::Zero => 1,
            Command::Position if last == Some(Command::Zero) => self.talk.counted,
            _ => 0,
        };
        let layout = self.resolved(command.reply());
        let reply = layout.encode(&self.values(now)).into_bytes();
        if self.talk.counted == TIMES {
            self.store_zero(now, rs485::STORING);
            self.talk.counted = 0;
        }
        Some(reply)
    }

    /// The present position becomes 0, turns and all.
    fn store_zero(&mut self, now: Micros, takes: Micros) {
        let shown = self.scales.position(self.shaft.at(now), self.direction);
        self.scales.shift(shown, self.direction);
        self.talk.deaf_until = now + takes;
    }

    fn answer_t485(&mut self, now: Micros, byte: u8) -> Option<Vec<u8>> {
        if self.talk.partial_len > 0 && now < self.talk.partial_at + BETWEEN_BYTES {
            return self.answer_memory(now, byte);
        }
        let dialect = self.profile().dialect;
        let known = Request::of_byte(byte).filter(|request| request.is_known_to(dialect));
        if let Some(Request::MemoryRead | Request::MemoryWrite) = known {
            self.talk.partial_len = 0;
            return self.answer_memory(now, byte);
        }
        self.talk.counted = match self.talk.last == byte {
            true => self.talk.counted.saturating_add(1),
            false => 1,
        };
        if self.talk.counted == TIMES {
            self.reset(now, known);
        }
        let layout = self.resolved(known.unwrap_or(Request::Angle).reply());
        let mut values = self.values(now);
        if known.is_none() {
            values.status = Some(bits::low_byte(t485::not_understood()));
        }
        let mut out = layout.encode(&values);
        out.write(Span::new(0, 8), u64::from(byte));
        layout.seal(&mut out, Role::Crc);
        Some(out.into_bytes())
    }

    fn reset(&mut self, now: Micros, request: Option<Request>) {
        let shown = self.scales.position(self.shaft.at(now), self.direction);
        let (turns, part) = split(shown);
        match request {
            Some(Request::ResetAngle) => self.scales.shift(part, self.direction),
            Some(Request::ResetTurns) => self.scales.shift(turns as f64, self.direction),
            Some(Request::ResetErrors) => {
                self.status = 0;
                self.error = false;
                self.turns_lost = false;
            }
            _ => {}
        }
    }

    /// Collects an EEPROM request; answers when it is whole and its CRC holds.
    fn answer_memory(&mut self, now: Micros, byte: u8) -> Option<Vec<u8>> {
        let at = self.talk.partial_len;
        *self.talk.partial.get_mut(at)? = byte;
        self.talk.partial_len = at + 1;
        self.talk.partial_at = now;
        let request = Request::of_byte(self.talk.partial[0])?;
        let asked = self.resolved(request.request());
        if self.talk.partial_len * 8 < asked.len {
            return None;
        }
        self.talk.partial_len = 0;
        let partial = self.talk.partial;
        let bits = Bits::of_bytes(&partial[..=at]);
        if !asked.holds(bits) {
            return None;
        }
        let mut values = asked.values(bits);
        let cell = self
            .talk
            .memory
            .get_mut(usize::from(values.memory.0.unwrap_or(0)))?;
        match values.memory.1 {
            Some(data) => *cell = data,
            None => values.memory.1 = Some(*cell),
        }
        let reply = self.resolved(request.reply());
        Some(reply.encode(&values).into_bytes())
    }

    fn answer_bus(&mut self, now: Micros, byte: u8) -> Option<Vec<u8>> {
        let head = self.resolved(&bus::HEAD).values(Bits::of_bytes(&[byte]));
        let odd = self.profile().parity != Parity::None;
        if odd && head.parity.is_some_and(|parity| !parity.ok()) {
            return None;
        }
        let operation = Operation::of_code(head.operation?);
        let address = head.address?;
        let before = core::mem::replace(&mut self.talk.before, operation);
        if operation != Some(Operation::SetAddress) {
            self.talk.address_broken |= self.talk.address_count > SILENT_COUNTS;
            self.talk.address_count = 0;
            if address != self.talk.address {
                self.talk.before = None;
                self.talk.zero_count = 0;
                self.talk.deaf_until = now + bus::suspend(self.profile());
                return None;
            }
        }
        let count = match operation? {
            Operation::Get => {
                if before != Some(Operation::SetZero) {
                    self.talk.zero_count = 0;
                }
                0
            }
            Operation::SetZero => self.count_zero(now, before),
            Operation::SetAddress => self.count_address(now, address)?,
        };
        let mut values = self.values(now);
        values.operation = head.operation;
        values.address = Some(address);
        values.count = Some(count);
        Some(self.decoder.encode(&values).into_bytes())
    }

    /// What C is after a *set zero*: 0 where no *get* stood before it, 1 where it starts anew.
    fn count_zero(&mut self, now: Micros, before: Option<Operation>) -> u8 {
        self.talk.zero_count = match before {
            Some(Operation::Get) => self.talk.zero_count + 1,
            _ => 0,
        };
        let count = self.talk.zero_count;
        if count == TIMES {
            self.store_zero(now, bus::STORING);
            self.talk.zero_count = 0;
        }
        count
    }

    /// What C is after a *set address*; the first three of a sequence get no answer.
    fn count_address(&mut self, now: Micros, address: u8) -> Option<u8> {
        self.talk.zero_count = 0;
        let count = self.talk.address_count;
        let right = match count {
            0 | 9 => true,
            _ => address == 2 * count,
        };
        let answered = count > SILENT_COUNTS || self.talk.address_broken;
        self.talk.address_broken = false;
        if !right {
            self.talk.address_count = 1;
            return answered.then_some(1);
        }
        self.talk.address_count = count + 1;
        if self.talk.address_count == TIMES {
            self.talk.address = address;
            self.talk.address_count = 0;
            self.talk.deaf_until = now + bus::STORING;
            return Some(TIMES);
        }
        (answered || self.talk.address_count > SILENT_COUNTS).then_some(count + 1)
    }
}
