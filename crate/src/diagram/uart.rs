//! Frames of a serial line, 8N1: start bit, eight bits with the least significant first, stop bit
//! (MPP and PT, "RS485", "T485", "BUS", "PERIOD"; IP-75, 5.3).

use super::{Lane, Limit, Side, Slot, Timeline, What, limits};
use crate::{
    bits::{self, Bits, Span},
    emulator::TURNAROUND,
    format::{
        Format, Link, bus,
        own::Own,
        t485::Request,
        timing::{MICROSECOND, SECOND},
    },
    language::msg,
    layout::Resolved,
};
use alloc::vec::Vec;

/// Bits of a byte.
const BYTE: u32 = 8;
/// Bit times that the line is shown at rest in front of the first byte and behind the last one.
const REST: u64 = 2;

pub(super) fn timeline(layout: &Resolved, bits: Bits<'_>) -> Timeline {
    let profile = &layout.shape.profile;
    let asked = request(layout, bits);
    let mut encoder = Line::new(msg("encoder"), Side::Encoder, profile.baud);
    let mut host = Line::new(msg("host"), Side::Master, profile.baud);
    let rest = host.after(0, REST);

    let sent = host.send(rest, asked.iter().copied(), What::Request);
    let replies = match asked.is_empty() {
        true => rest,
        false => sent.saturating_add(TURNAROUND as i64 * MICROSECOND),
    };
    encoder.slot(What::Idle, 0, rest);
    if !asked.is_empty() {
        encoder.slot(What::Idle, rest, sent);
        encoder.slot(What::Turnaround, sent, replies);
    }
    let over = encoder.send(replies, bytes(layout, bits), What::Bit);

    let mut limits = Vec::new();
    let mut next = over;
    let at = (replies, over);
    // How often a user's own stream comes is no matter of a manual.
    if let (None, Some(interval)) = (profile.own, profile.format.interval()) {
        let limit = limits::interval(profile.source(), interval, at);
        next = limit.at.1.max(over);
        limits.push(limit);
        encoder.slot(What::Pause, over, next);
    }
    if profile.format == Format::Bus {
        limits.push(limits::suspend(bus::suspend(profile), (sent, over)));
    }
    let end = encoder.after(next, REST);
    encoder.slot(What::Idle, next, end);

    let lines = match asked.is_empty() {
        true => Vec::from([encoder]),
        false => Vec::from([host, encoder]),
    };
    assembled(lines, limits, end)
}

/// A request without its reply.
pub(super) fn request_alone(layout: &Resolved, bits: Bits<'_>) -> Timeline {
    let mut host = Line::new(msg("host"), Side::Master, layout.shape.profile.baud);
    let rest = host.after(0, REST);
    host.slot(What::Idle, 0, rest);
    let over = host.send(rest, bytes(layout, bits), What::Bit);
    let end = host.after(over, REST);
    host.slot(What::Idle, over, end);
    assembled(Vec::from([host]), Vec::new(), end)
}

fn bytes(layout: &Resolved, bits: Bits<'_>) -> impl Iterator<Item = u8> {
    (0..layout.len)
        .step_by(BYTE as usize)
        .map(move |start| bits::low_byte(bits.read(Span::new(start, BYTE as usize))))
}

fn assembled(lines: Vec<Line>, limits: Vec<Limit>, end: i64) -> Timeline {
    let mut lanes = Vec::new();
    let mut slots = Vec::new();
    for (index, line) in lines.into_iter().enumerate() {
        let mine = line.slots.into_iter();
        slots.extend(mine.map(|slot| Slot {
            lane: index,
            ..slot
        }));
        lanes.push(line.lane);
    }
    Timeline {
        ticks: slots.iter().map(|slot: &Slot| slot.from).collect(),
        lanes,
        slots,
        limits,
        end,
    }
    .sorted()
}

/// The bytes that the host has sent to get this frame; none of a stream.
fn request(layout: &Resolved, bits: Bits<'_>) -> Vec<u8> {
    let profile = &layout.shape.profile;
    if profile.link() != Link::Polled {
        return Vec::new();
    }
    let echoed = bits::low_byte(bits.read(Span::new(0, BYTE as usize)));
    match profile.format {
        Format::Rs485 => [profile.command.byte()].into(),
        Format::T485 => match Request::of_byte(echoed) {
            Some(request) => {
                let (address, data) = layout.values(bits).memory;
                request.bytes(profile, address.unwrap_or(0), data.unwrap_or(0))
            }
            None => [echoed].into(),
        },
        Format::Bus => [echoed].into(),
        _ => profile.own.and_then(Own::request).into_iter().collect(),
    }
}

/// One direction of a serial line.
struct Line {
    lane: Lane,
    slots: Vec<Slot>,
    baud: u32,
}

impl Line {
    fn new(name: &'static str, side: Side, baud: u32) -> Self {
        let mut lane = Lane::new(name, side);
        lane.step(0, true);
        Self {
            lane,
            slots: Vec::new(),
            baud: baud.max(1),
        }
    }

    /// When so many bit times after `start` are over; counted from there, so that nothing drifts.
    fn after(&self, start: i64, count: u64) -> i64 {
        let lasts = i128::from(count) * i128::from(SECOND) / i128::from(self.baud);
        start.saturating_add(i64::try_from(lasts).unwrap_or(i64::MAX))
    }

    fn slot(&mut self, what: What, from: i64, to: i64) {
        self.slots.push(Slot {
            what,
            lane: 0,
            from,
            to,
            sampled: None,
        });
    }

    /// Sends bytes without a pause between; `what` names a bit by its index, the most significant
    /// of each byte first. Returns when the last stop bit is over.
    fn send(
        &mut self,
        start: i64,
        bytes: impl Iterator<Item = u8>,
        what: impl Fn(usize) -> What,
    ) -> i64 {
        let mut count = 0;
        let mut now = start;
        for (index, byte) in bytes.enumerate() {
            let first = index * BYTE as usize;
            let places = (0..BYTE).map(|place| {
                let at = first + (BYTE - 1 - place) as usize;
                (what(at), bits::bit(byte.into(), place))
            });
            let framed = core::iter::once((What::Start, false))
                .chain(places)
                .chain([(What::Stop, true)]);
            for (what, level) in framed {
                count += 1;
                let next = self.after(start, count);
                self.lane.step(now, level);
                let middle = now.saturating_add(next.saturating_sub(now) / 2);
                let read = matches!(what, What::Bit(_) | What::Request(_));
                self.slots.push(Slot {
                    what,
                    lane: 0,
                    from: now,
                    to: next,
                    sampled: read.then_some(middle),
                });
                now = next;
            }
        }
        now
    }
}
