//! The way from the encoder to the host, and what goes wrong on it.

use super::uart;
use crate::{bits, session::Micros};
use alloc::{collections::VecDeque, vec::Vec};

/// How much later a late reply comes, in microseconds: beyond the patience of any host.
const LATE_BY: Micros = 250_000;

/// What goes wrong on the way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Faults {
    /// The adapter returns every request.
    pub echo: bool,
    /// No answers at all.
    pub silent: bool,
    /// The plug is out: nothing arrives on either side.
    pub unplugged: bool,
    /// The adapter runs at this baud rate instead of the encoder's.
    pub rate: Option<u32>,
    /// Of 1000 reply bytes, how many have a bit turned over.
    pub flip: u32,
    /// Of 1000 reply bytes, how many get lost.
    pub drop: u32,
    /// Of 1000 reply bytes, how many come twice.
    pub double: u32,
    /// Of 1000 reply bytes, how many are followed by a stray byte.
    pub insert: u32,
    /// Of 1000 replies, how many get lost.
    pub lose: u32,
    /// Of 1000 replies, how many come a quarter of a second late.
    pub late: u32,
    /// Of 1000 replies, how many come twice.
    pub twice: u32,
    /// Every reply comes so much later.
    pub delay: Micros,
    /// Every reply comes later by up to so much more, at random.
    pub jitter: Micros,
    /// Bytes of 0 that the line gives when the power comes back, before the encoder speaks.
    pub zeros: usize,
}

/// What an encoder has sent over a serial line; a frame of a stream is a reply here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sent {
    /// Replies that arrive whole, whatever stands around them.
    pub whole: u64,
    /// Replies that do not.
    pub damaged: u64,
    /// Of those, the ones that are good frames all the same: no receiver can tell.
    pub passing: u64,
}

impl Sent {
    /// Counts a reply by what arrives of it.
    pub(super) fn count(&mut self, reply: &[u8], arrives: &[u8], holds: impl Fn(&[u8]) -> bool) {
        let mut rest = arrives;
        let whole = |rest: &[u8]| rest.windows(reply.len()).position(|bytes| bytes == reply);
        let before = self.whole;
        while let Some(at) = whole(rest) {
            self.whole += 1;
            rest = &rest[at + reply.len()..];
        }
        if self.whole == before {
            self.damaged += 1;
            self.passing += u64::from(holds(arrives));
        }
    }
}

/// Bytes on their way to the host.
#[derive(Debug)]
pub(super) struct Wire {
    random: u64,
    queue: VecDeque<(Micros, Vec<u8>)>,
}

impl Wire {
    pub(super) const fn new() -> Self {
        Self {
            random: 0x9e37_79b9_7f4a_7c15,
            queue: VecDeque::new(),
        }
    }

    /// When the next bytes arrive.
    pub(super) fn deadline(&self) -> Option<Micros> {
        self.queue.front().map(|(at, _)| *at)
    }

    /// The next bytes that have arrived by `now`.
    pub(super) fn take(&mut self, now: Micros) -> Option<Vec<u8>> {
        if self.deadline()? > now {
            return None;
        }
        self.queue.pop_front().map(|(_, bytes)| bytes)
    }

    /// Takes what will have arrived by `end`, however late it is.
    pub(super) fn drop_all(&mut self) {
        self.queue.clear();
    }

    /// Sends `echo` and `reply`, the last of whose bits leaves the wire `took` microseconds a byte
    /// after `start`; returns what arrives of the reply.
    pub(super) fn send(
        &mut self,
        faults: &Faults,
        start: Micros,
        baud: u32,
        echo: &[u8],
        reply: &[u8],
    ) -> Vec<u8> {
        let on_wire = |count: usize| count as u64 * 10_000_000 / u64::from(baud);
        let mut line = Vec::from(echo);
        let mut bytes = Vec::new();
        let mut later = 0;
        if !reply.is_empty() && !self.chance(faults.lose) {
            bytes = self.disturbed(faults, reply);
            if self.chance(faults.twice) {
                bytes.extend_from_within(..);
            }
            if let Some(rate) = faults.rate {
                bytes = uart::heard(&bytes, baud, rate);
            }
            later = match self.chance(faults.late) {
                true => LATE_BY,
                false => faults.delay + self.up_to(faults.jitter),
            };
        }
        if later == 0 {
            line.extend_from_slice(&bytes);
        } else if !bytes.is_empty() {
            self.arrive(start + later + on_wire(bytes.len()), bytes.clone());
        }
        if !line.is_empty() {
            self.arrive(start + on_wire(line.len()), line);
        }
        bytes
    }

    pub(super) fn arrive(&mut self, at: Micros, bytes: Vec<u8>) {
        let behind = self.queue.iter().position(|(other, _)| *other > at);
        let index = behind.unwrap_or(self.queue.len());
        self.queue.insert(index, (at, bytes));
    }

    /// The bytes as they arrive.
    pub(super) fn disturbed(&mut self, faults: &Faults, bytes: &[u8]) -> Vec<u8> {
        let mut line = Vec::with_capacity(bytes.len());
        for byte in bytes {
            let mut byte = *byte;
            if self.chance(faults.flip) {
                let place = (self.draw() % 8) as u32;
                byte ^= bits::low_byte(bits::placed(1, place));
            }
            if !self.chance(faults.drop) {
                line.push(byte);
            }
            if self.chance(faults.double) {
                line.push(byte);
            }
            if self.chance(faults.insert) {
                let stray = bits::low_byte(self.draw());
                line.push(stray);
            }
        }
        line
    }

    fn chance(&mut self, per_mille: u32) -> bool {
        per_mille > 0 && self.draw() % 1000 < u64::from(per_mille)
    }

    fn up_to(&mut self, most: Micros) -> Micros {
        match most {
            0 => 0,
            most => self.draw() % (most + 1),
        }
    }

    /// A linear congruential generator (Knuth's MMIX); its high half is random enough here.
    fn draw(&mut self) -> u64 {
        self.random = self
            .random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        bits::slice(self.random, 33, 31)
    }
}
