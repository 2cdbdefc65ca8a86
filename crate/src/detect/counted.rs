//! What the good frames of a dump are, all together.

use super::motion::Track;
use crate::{
    bits,
    decode::Frame,
    format::{Format, Medium},
    layout::{Role, Shape},
    profile::Profile,
    reading::Values,
};
use alloc::{collections::BTreeSet, vec::Vec};

/// Zeros in front of a one that are hardly data.
const LONG_ACK: u32 = 3;

/// Everything that was counted over the good frames of a dump.
#[derive(Default)]
pub(super) struct Counted {
    pub(super) distinct: BTreeSet<Vec<u8>>,
    pub(super) track: Track,
    /// The same with the bytes of the angle in the other order.
    pub(super) swapped: Track,
    pub(super) good: u64,
    /// Bytes of the good frames.
    pub(super) covered: u64,
    pub(super) temperatures: Option<(i32, i32)>,
    pub(super) check_bits: i32,
    pub(super) named: bool,
    pub(super) preamble: bool,
    /// Lines with an acknowledge of another length and a start bit.
    pub(super) started: bool,
    pub(super) requests: u64,
    pub(super) addresses: BTreeSet<u8>,
    pub(super) both: u64,
    /// Bits beside the position that changed from frame to frame, and what they were last.
    pub(super) changes: i32,
    rest: Vec<u64>,
    /// The angles as they stand on the wire: a Gray word hides bits that never change.
    pub(super) wires: Vec<u64>,
    /// What all readings are, so that two profiles that read alike are known.
    pub(super) reads: u64,
}

impl Counted {
    pub(super) fn add(&mut self, profile: &Profile, frame: &Frame<'_>) {
        let values = frame.values();
        self.good += 1;
        self.named |= matches!(
            (values.enid, profile.angle_bits),
            (Some(0x17), 23) | (Some(0x11), 17)
        );
        self.preamble |= frame.layout.shape.preamble
            && frame.layout.shape
                == Shape {
                    tail: frame.layout.shape.tail,
                    ..Shape::of(*profile)
                };
        let Shape {
            preamble,
            idle,
            ack,
            ..
        } = frame.layout.shape;
        self.started |= preamble && idle > 0 && ack >= LONG_ACK;
        self.addresses.extend(values.address);
        self.track.add(profile, &values);
        if profile.medium() == Medium::Bytes {
            self.swapped.add(profile, &swapped(profile, &values));
        }
        self.covered += frame.bits.bytes().len() as u64;
        if let Some(heat) = values.temperature {
            let (least, most) = self.temperatures.unwrap_or((heat, heat));
            self.temperatures = Some((least.min(heat), most.max(heat)));
        }
        self.both += u64::from(values.error == Some(true) && values.warning == Some(true));
        if profile.medium() == Medium::Bits {
            self.wires.extend(wire(frame));
        }
        let rest = rest(frame);
        let before = self.rest.iter().chain(core::iter::repeat(&0));
        let changes = rest
            .iter()
            .zip(before)
            .map(|(now, before)| (now ^ before).count_ones());
        if self.good > 1 {
            self.changes += changes.sum::<u32>() as i32;
        }
        self.rest = rest;
        let kind = u64::from(values.speed.is_some());
        let turns = values.turns.unwrap_or(0).unsigned_abs();
        for part in [values.angle.unwrap_or(0), turns, kind] {
            // FNV-1a, a word at a time.
            self.reads = (self.reads ^ part).wrapping_mul(0x0000_0100_0000_01b3);
        }
        // A frame of nothing but zeros says nothing: its CRC is 0 too.
        let bytes = frame.bits.bytes();
        if bytes.iter().any(|byte| *byte != 0) {
            self.check_bits = check_width(frame);
            self.distinct.insert(bytes.to_vec());
        }
    }
}

fn wire(frame: &Frame<'_>) -> Option<u64> {
    let mut fields = frame.layout.fields();
    let angle = fields.find(|field| field.row.role == Role::Angle)?;
    Some(frame.layout.wire(angle, frame.bits))
}

/// What a frame says beside position and checks, which seldom changes.
fn rest(frame: &Frame<'_>) -> Vec<u64> {
    let fields = frame.layout.fields().filter(|field| match field.row.role {
        Role::Turns | Role::Angle | Role::Speed | Role::Temperature | Role::Count => false,
        _ => field.cover.is_none(),
    });
    fields
        .map(|field| frame.layout.wire(field, frame.bits))
        .collect()
}

/// The angle with its bytes in the other order.
fn swapped(profile: &Profile, values: &Values) -> Values {
    let spare = u64::BITS - profile.angle_bits.next_multiple_of(8);
    let other = |angle: u64| bits::above(angle.swap_bytes(), spare);
    Values {
        angle: values.angle.map(other),
        address: values.address,
        ..Values::default()
    }
}

/// Bits of a frame that are right by chance rarely: its checks, and a control field's pattern.
pub(crate) fn check_width(frame: &Frame<'_>) -> i32 {
    let profile = &frame.layout.shape.profile;
    let fields = frame.layout.fields().filter(|field| match field.row.role {
        Role::Crc => true,
        Role::Parity => field.is_binding(),
        Role::Framing if profile.medium() == Medium::Bits => {
            !frame.layout.shape.preamble && field.row.constant.is_some_and(|constant| constant > 0)
        }
        Role::Framing => field.row.constant.is_some(),
        _ => false,
    });
    let width = fields.map(|field| field.width as i32).sum();
    match profile.format {
        // Any list of small numbers looks like it.
        Format::Asi4 => width / 4,
        _ => width,
    }
}
