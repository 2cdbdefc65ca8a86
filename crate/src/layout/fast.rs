//! Layouts prepared to judge and read many frames quickly, out of the same tables.
//!
//! A frame of up to sixteen bytes is two words. A [`Sieve`] judges them and a [`Number`] reads
//! them; both are computed once, from the rows of the layout and its checks.

mod number;
mod sieve;

use super::{Active, Coding, Field, Part, Resolved, Role};
use crate::{
    bits::{self, Bits, Span},
    columns::{Columns, Health},
    decode::Follows,
    profile::TurnsCode,
    reading::Reading,
};
use alloc::{boxed::Box, vec::Vec};
use number::{Number, Together};
use sieve::Sieve;

/// Bytes of a word.
const WORD: usize = 8;

/// A frame of up to sixteen bytes as its first eight bytes and its last eight, which overlap; a
/// shorter frame is the first of the bytes of both. The first byte is the least significant.
#[derive(Clone, Copy, Debug)]
struct Words {
    head: u64,
    tail: u64,
}

/// What judges and reads the frames of a layout.
#[derive(Clone, Debug)]
pub(super) struct Fast {
    sieve: Sieve,
    angle: Number,
    turns: Number,
    /// The top bit of turns in two's complement, which counts negative.
    sign: u64,
    status: Number,
    /// Bits of the status that are sent the other way round.
    status_flip: u64,
    /// What [`Health`] holds.
    health: Number,
    /// Its bits that are sent the other way round.
    health_flip: u64,
    /// All four where they are read from one word.
    together: Option<Together>,
}

/// What tells whether one frame goes on from another, good or bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Glimpse {
    pub(crate) angle: Option<u64>,
    pub(crate) turns: Option<i64>,
    pub(crate) status: Option<u8>,
}

impl Resolved {
    /// The same layout, prepared to judge and read many frames quickly; text, repeated words,
    /// coded bits with one value, frames that are longer than sixteen bytes and those with several
    /// or coded flags of an error stay as they are.
    #[must_use]
    pub fn sieved(mut self) -> Self {
        // Where size counts, few frames are read.
        if cfg!(feature = "small") {
            return self;
        }
        let plain = self.fields().all(|field| {
            let once = field.row.role != Role::Repeat;
            let coding = self.coding(field).map(|(coding, _)| coding);
            let fixed = field.row.constant.is_some() || field.row.zeros != 0;
            let read = match coding {
                Some(Coding::Gray) => !fixed,
                other => other.is_none(),
            };
            once && field.width <= u64::BITS && read
        });
        let checks: u32 = self
            .fields()
            .filter(|field| Field::is_binding(field))
            .map(|field| field.width)
            .sum();
        let single = |of: fn(Role) -> bool| {
            let mut flags = self.fields().filter(|field| of(field.row.role));
            let plain = |flag: &Field| self.coding(flag).is_none();
            flags.next().is_none_or(plain) && flags.next().is_none()
        };
        let flags = single(|role| matches!(role, Role::Error | Role::Valid))
            && single(|role| role == Role::Warning);
        if !plain || !flags || self.len > 16 * WORD || checks > u16::BITS {
            return self;
        }
        let signed = self.shape.profile.turns_code == TurnsCode::Signed;
        let last = |role| self.fields().rfind(|field| field.row.role == role);
        let number = |field: Option<&Field>| {
            let Some((field, [first, ..])) = field.map(|field| (field, self.parts(field))) else {
                return Number::default();
            };
            match self.coding(field) {
                Some((_, word)) => Number::of_gray(self.bytes(), word, *first),
                None => Number::of(self.bytes(), self.parts(field)),
            }
        };
        let (turns, status) = (last(Role::Turns), last(Role::Status));
        let (health, health_flip) = self.health();
        let (angle, turns_number) = (number(last(Role::Angle)), number(turns));
        let status_number = number(status);
        self.fast = Some(Box::new(Fast {
            sieve: Sieve::of(&self),
            together: Together::of([&angle, &turns_number, &status_number, &health]),
            angle,
            sign: turns
                .filter(|_| signed)
                .map_or(0, |field| bits::placed(1, field.width.saturating_sub(1))),
            turns: turns_number,
            status_flip: status.map_or(0, |field| field.active_high(0)),
            status: status_number,
            health,
            health_flip,
        }));
        self
    }

    /// How many bytes hold a frame.
    #[must_use]
    #[inline]
    pub const fn bytes(&self) -> usize {
        self.len.div_ceil(8)
    }

    /// What [`Health`] holds, as a number, and which of its bits are sent the other way round.
    fn health(&self) -> (Number, u64) {
        let mut flip = 0;
        let error = self
            .flag(Role::Error, Active::High)
            .or_else(|| self.flag(Role::Valid, Active::Low))
            .or_else(|| self.named_error());
        let warning = self.flag(Role::Warning, Active::High);
        let mut parts: Vec<Part> = Vec::new();
        for (flag, place) in [(error, Health::ERROR), (warning, Health::WARNING)] {
            let Some((span, asserts)) = flag else {
                continue;
            };
            flip |= bits::placed(u64::from(!asserts), place);
            match parts.last_mut() {
                // Side by side they are read at once.
                Some(last) if last.span.end() == span.start && last.place == place + 1 => {
                    *last = Part {
                        span: Span::new(last.span.start, last.span.len + span.len),
                        place,
                    };
                }
                _ => parts.push(Part { span, place }),
            }
        }
        (Number::of(self.bytes(), &parts), flip)
    }

    /// Where a flag stands, and whether a 1 there says so.
    fn flag(&self, role: Role, says: Active) -> Option<(Span, bool)> {
        let field = self.fields().rfind(|field| field.row.role == role)?;
        let part = self.parts(field).first()?;
        Some((part.span, field.row.active == says))
    }

    /// The error flag where it is a named bit of the status.
    fn named_error(&self) -> Option<(Span, bool)> {
        let field = self.fields().find(|field| field.row.role == Role::Status)?;
        let mut named = field.row.bits.iter();
        let bit = named.find(|bit| bit.role == Some(Role::Error))?;
        let at = self.bit_of(field, bit.place)?;
        Some((Span::new(at, 1), true))
    }

    /// Whether every check holds, for a frame of exactly this length; `None` where the layout
    /// has not been sieved.
    #[inline(always)]
    pub(crate) fn passes_sieve(&self, bits: Bits<'_>) -> Option<bool> {
        let fast = self.fast.as_deref()?;
        (bits.len() == self.len).then(|| fast.sieve.holds(Words::of(bits.bytes())))
    }

    /// Whether `bytes` begin with a whole frame whose every check holds.
    #[inline]
    pub(crate) fn holds_at(&self, bytes: &[u8]) -> bool {
        let len = self.bytes();
        match (self.fast.as_deref(), bytes.first_chunk()) {
            (Some(fast), Some(chunk)) => fast.sieve.holds(Words::in_chunk(chunk, len)),
            _ => bytes
                .get(..len)
                .is_some_and(|frame| self.holds(Bits::of_bytes(frame).prefix(self.len))),
        }
    }

    /// Whether a frame that holds does not end as one that is read a byte late: with a zero.
    #[inline]
    pub(crate) fn is_sound(&self, frame: &[u8]) -> bool {
        !(self.is_zero_led && frame.last() == Some(&0))
    }

    /// How many frames at the start of `bytes`, of which the first has been judged, hold, are
    /// sound, and begin as `follows` wants; and whether the last is the one before it again, as
    /// `repeats` says of the first. A frame that ends repetition is left to be judged otherwise.
    #[inline]
    pub(crate) fn run(&self, bytes: &[u8], repeats: bool, follows: Follows) -> (usize, bool) {
        match self.fast.as_deref() {
            Some(fast) => fast.sieve.run(bytes, self.is_zero_led, repeats, follows),
            None => (1, repeats),
        }
    }

    /// Adds a run of frames whose checks hold to columns.
    pub(crate) fn columns(&self, run: &[u8], columns: &mut Columns) {
        let len = self.bytes();
        if let Some((Coding::Decimal, text)) = self.coded {
            let angles = columns.grow(run.len() / len).angle;
            for (angle, line) in angles.iter_mut().zip(run.chunks_exact(len)) {
                *angle = Bits::of_bytes(line).decimal(text).unwrap_or(0);
            }
            return;
        }
        let alone = run.len() == len;
        let fast = self.fast.as_deref();
        let Some(fast) = fast.filter(|fast| fast.angle.exists() && !alone) else {
            for frame in run.chunks_exact(len) {
                columns.push(self.position(Bits::of_bytes(frame).prefix(self.len)));
            }
            return;
        };
        let room = columns.grow(run.len() / len);
        if let Some(together) = fast.together {
            let mut rest = run;
            let slots = room.angle.iter_mut().zip(room.turns);
            let slots = slots.zip(room.status).zip(room.health);
            for (((to_angle, to_turns), to_status), to_health) in slots {
                let [angle, turns, status, health] = together.read(rest);
                *to_angle = angle;
                *to_turns = fast.turns_of(turns);
                *to_status = fast.status_of(status);
                *to_health = fast.health_of(health);
                rest = rest.get(len..).unwrap_or_default();
            }
            return;
        }
        fast.angle.column(run, len, room.angle, |angle| angle);
        fast.turns
            .column(run, len, room.turns, |turns| fast.turns_of(turns));
        fast.status
            .column(run, len, room.status, |status| fast.status_of(status));
        fast.health
            .column(run, len, room.health, |health| fast.health_of(health));
    }

    /// Position and health of a frame whose checks hold; `None` where the layout has not been
    /// sieved or holds no angle.
    #[inline]
    pub(crate) fn quick_position(&self, bits: Bits<'_>) -> Option<Reading> {
        let fast = self.fast.as_deref().filter(|_| bits.len() == self.len)?;
        let frame = bits.bytes();
        let health = fast.health_of(fast.health.read(frame));
        Some(Reading {
            angle: fast.angle.some(frame)?,
            angle_bits: self.shape.profile.angle_bits,
            turns: fast.turns.some(frame).map(|turns| fast.turns_of(turns)),
            error: health.is_error(),
            warning: health.is_warning(),
            status: fast.status.some(frame).map(|status| fast.status_of(status)),
        })
    }

    /// Where the shaft is and what the status says, of the frame at the start of `bytes`, good
    /// or bad.
    #[inline]
    pub(crate) fn glimpse(&self, bytes: &[u8]) -> Glimpse {
        if let Some(fast) = self.fast.as_deref() {
            let [angle, turns, status] = match fast.together {
                Some(together) => {
                    let [angle, turns, status, _] = together.read(bytes);
                    [angle, turns, status]
                }
                None => [&fast.angle, &fast.turns, &fast.status].map(|number| number.read(bytes)),
            };
            return Glimpse {
                angle: fast.angle.exists().then_some(angle),
                turns: fast.turns.exists().then(|| fast.turns_of(turns)),
                status: fast.status.exists().then(|| fast.status_of(status)),
            };
        }
        let values = self.values(Bits::of_bytes(bytes).prefix(self.len));
        Glimpse {
            angle: values.angle,
            turns: values.turns,
            status: values.status,
        }
    }
}

impl Fast {
    #[inline(always)]
    const fn turns_of(&self, turns: u64) -> i64 {
        bits::extended(turns, self.sign) as i64
    }

    #[inline(always)]
    const fn status_of(&self, status: u64) -> u8 {
        bits::low_byte(status ^ self.status_flip)
    }

    #[inline(always)]
    const fn health_of(&self, health: u64) -> Health {
        Health::of_bits(bits::low_byte(health ^ self.health_flip))
    }
}

impl Words {
    /// Those of the frame of `len` bytes at the start of a chunk.
    #[inline(always)]
    fn in_chunk(chunk: &[u8; 2 * WORD], len: usize) -> Self {
        let word = |at: usize| {
            let word = chunk.get(at..).and_then(<[u8]>::first_chunk);
            word.map_or(0, |word| u64::from_le_bytes(*word))
        };
        Self {
            head: word(0),
            tail: word(len.saturating_sub(WORD)),
        }
    }

    /// Those of a frame.
    fn of(frame: &[u8]) -> Self {
        let word = |word: &[u8; WORD]| u64::from_le_bytes(*word);
        match (frame.first_chunk(), frame.last_chunk()) {
            (Some(head), Some(tail)) => Self {
                head: word(head),
                tail: word(tail),
            },
            _ => {
                let unused = WORD.saturating_sub(frame.len()) * 8;
                let head = bits::placed(bits::word(frame), unused as u32).swap_bytes();
                Self { head, tail: head }
            }
        }
    }

    /// Whether the bits of `mask` are the same in two frames of up to `N` bytes.
    #[inline(always)]
    const fn agrees<const N: usize>(self, other: Self, mask: Self) -> bool {
        let head = (self.head ^ other.head) & mask.head;
        let tail = (self.tail ^ other.tail) & mask.tail;
        head == 0 && (N <= WORD || tail == 0)
    }
}
