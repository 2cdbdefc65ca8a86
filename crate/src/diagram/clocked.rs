//! Frames that a master clocks out.

use super::{Lane, Master, Side, Slot, Timeline, What, limits};
use crate::{
    bits::{BitString, Bits},
    capture::{Wire, wave::Wave},
    format::{
        Format, biss_c, ssi,
        timing::{NANOSECOND, SECOND},
    },
    layout::Resolved,
};
use alloc::vec::Vec;

/// From a rising edge to the data that it brings, as far as the clock leaves room for it: about
/// what a driver takes.
const DELAY: i64 = 50 * NANOSECOND;
/// The longest first low and pause that are drawn.
const LONGEST: i64 = 10 * SECOND;
/// Index of the encoder's lane.
const DATA: usize = 1;

pub(super) fn timeline(layout: &Resolved, bits: Bits<'_>, master: &Master) -> Timeline {
    let profile = &layout.shape.profile;
    let is_biss = match profile.own {
        Some(own) => own.is_biss(),
        None => profile.format == Format::BissC,
    };
    let manual = profile.format.timing();
    let timing = manual.unwrap_or(match is_biss {
        true => &biss_c::TIMING,
        false => &ssi::TIMING,
    });
    let sent = sent(layout, bits, is_biss);
    let mut word = BitString::default();
    for (_, level) in &sent {
        word.push(*level);
    }

    let half = SECOND / 2 / i64::from(master.hertz.max(1));
    let first_low = master.first_low.map(|low| low.clamp(1, LONGEST));
    let mut wave = Wave::verbatim(timing);
    wave.hertz = master.hertz;
    wave.first_low = first_low;
    wave.delay = DELAY.min(half / 4);
    wave.pause = half * 2;
    wave.frame(&word);

    let (clock, data) = match is_biss {
        true => ("MA", "SLO"),
        false => ("CLOCK", "DATA"),
    };
    let mut lanes = [
        Lane::new(clock, Side::Master),
        Lane::new(data, Side::Encoder),
    ];
    let [clock, line] = &mut lanes;
    for edge in wave.edges() {
        match edge.wire {
            Wire::Clock => clock.step(edge.time, edge.level),
            Wire::Data => line.step(edge.time, edge.level),
        }
    }
    let of_level = |level: bool| {
        // The first step only says that the clock rests high.
        let edges = clock.steps.iter().skip(1);
        edges.filter(move |step| step.level == level)
    };
    let falls: Vec<i64> = of_level(false).map(|step| step.time).collect();
    let rises: Vec<i64> = of_level(true).map(|step| step.time).collect();
    let first = |times: &[i64]| times.first().copied().unwrap_or(0);
    let last = |times: &[i64]| times.last().copied().unwrap_or(0);

    let ready = last(&falls).saturating_add(wave.timeout);
    let pause = master.pause.unwrap_or(timing.pause).clamp(0, LONGEST);
    let paused = last(&rises).saturating_add(pause);
    let behind = last(&rises).saturating_add(wave.delay);
    let end = ready.max(paused).max(behind).saturating_add(half * 2);
    let mut slots = Vec::new();
    let mut slot = |what, from: i64, to: i64, sampled| {
        let lane = DATA;
        slots.push(Slot {
            what,
            lane,
            from,
            to,
            sampled,
        });
    };
    slot(What::Idle, 0, first(&falls), None);
    let begins = first(&rises).saturating_add(wave.delay);
    slot(What::Latch, first(&falls), begins, None);
    let next = rises.iter().skip(1);
    let reads = falls.iter().skip(1);
    for (((what, _), rise), (next, read)) in sent.iter().zip(&rises).zip(next.zip(reads)) {
        let (from, to) = (*rise + wave.delay, *next + wave.delay);
        slot(*what, from, to, Some(*read));
    }
    let waiting = match profile.format {
        Format::Ssi7 => What::ErrorFlag,
        _ => What::TimeOut,
    };
    slot(waiting, behind, ready, None);
    slot(What::Idle, behind.max(ready), end, None);
    slots.push(Slot {
        what: What::Pause,
        lane: 0,
        from: last(&rises),
        to: paused,
        sampled: None,
    });
    let mut ticks: Vec<i64> = clock.steps.iter().map(|step| step.time).collect();
    ticks.extend([ready, paused]);
    let places = limits::Clock {
        half,
        first_low: first_low.unwrap_or(half),
        pause,
        fall: first(&falls),
        rise: first(&rises),
        last_fall: last(&falls),
        last_rise: last(&rises),
    };
    let limits = manual.map_or_else(Vec::new, |timing| places.limits(timing, master.hertz));
    Timeline {
        lanes: lanes.into(),
        slots,
        limits,
        ticks,
        end,
    }
    .sorted()
}

/// What the encoder sends from the first rising edge on, a bit a clock.
fn sent(layout: &Resolved, bits: Bits<'_>, is_biss: bool) -> Vec<(What, bool)> {
    let shape = &layout.shape;
    let before = match shape.preamble {
        true => 0,
        false => (shape.idle + shape.unused) as usize,
    };
    let mut sent = Vec::new();
    // At the first two falling edges the line of BiSS-C is idle, and the first of them latches.
    if is_biss && (shape.idle == 0 || !shape.preamble) {
        sent.push((What::Idle, true));
    }
    if is_biss && !shape.preamble {
        let zeros = 0..shape.profile.ack_bits;
        sent.extend(zeros.map(|_| (What::Acknowledge, false)));
        sent.push((What::Start, true));
        sent.push((What::Cds, false));
    }
    sent.extend((before..layout.len).map(|at| (What::Bit(at), bits.bit(at))));
    sent
}
