//! Laws of timelines: what the wires are drawn to do is the frame, bit by bit.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::{
    captures::{PROFILES, US, values},
    layouts::layouts,
};
use encoderscope::{
    bits::{BitString, Bits, Span},
    capture::{Capture, Edge, Wire},
    decode::Decoder,
    diagram::{Fold, Master, Side, Timeline, What},
    format::{Format, Link, bus, own::Own, rs485::Command, t485::Request},
    layout::Resolved,
};
use encoderscope_tests::{Noise, decoder};

/// Profiles of serial formats, two own layouts among them.
const SERIAL: &[&str] = &[
    "format=rs485",
    "format=rs485 command=1 angle-bits=16 turns-bits=0 baud=115200",
    "format=t485",
    "format=bus",
    "format=bus angle-bits=16 turns-bits=0",
    "format=period",
    "format=asi1",
    "format=asi1 angle-bits=22 marker=first",
    "format=asi4",
    "format=own layout=rls-aksim2-serial-18",
    "format=own layout=Mine;stream;const:8:0xa5,angle:24:le,crc:8:0x07",
];

/// Profiles that a master clocks, whose clock and data are not told from recordings.
pub(crate) const UNRECORDED: &[&str] = &[
    "format=as5048",
    "format=own layout=rls-biss-26",
    "format=own layout=incoder-ssi6",
    "format=own layout=Mine;line;turns:3:gray,angle:10:gray,odd:1",
];

/// Profiles of every format and of own layouts.
pub(crate) fn profiles() -> impl Iterator<Item = &'static str> {
    SERIAL.iter().chain(PROFILES).chain(UNRECORDED).copied()
}

fn noisy(noise: &mut Noise, layout: &Resolved) -> BitString {
    let mut bits = BitString::zeros(layout.len);
    for start in (0..layout.len).step_by(32) {
        let len = (layout.len - start).min(32);
        bits.write(Span::new(start, len), noise.draw());
    }
    bits
}

pub(crate) fn drawn(layout: &Resolved, bits: Bits<'_>) -> Timeline {
    Timeline::new(layout, bits, &Master::default())
}

/// Bits of a dump that were never on the wire: what stands in front of a word.
fn unsent(layout: &Resolved) -> usize {
    let is_clocked = layout.shape.link() == Link::Clocked;
    match is_clocked && !layout.shape.preamble {
        true => (layout.shape.idle + layout.shape.unused) as usize,
        false => 0,
    }
}

/// The laws of one timeline.
fn obeys(case: &str, layout: &Resolved, bits: Bits<'_>) {
    let timeline = drawn(layout, bits);
    let encoder = timeline.encoder();
    assert_eq!(timeline.lanes[encoder].side, Side::Encoder, "{case}");
    for (index, lane) in timeline.lanes.iter().enumerate() {
        assert_eq!(
            lane.steps.first().map(|step| (step.time, step.level)),
            Some((0, true))
        );
        assert!(
            lane.steps
                .windows(2)
                .all(|two| two[0].time < two[1].time && two[0].level != two[1].level),
            "{case}"
        );
        let slots: Vec<_> = timeline.of_lane(index).collect();
        let apart = slots.windows(2).all(|two| two[0].to <= two[1].from);
        assert!(apart, "{case}: slots of {} overlap", lane.name);
    }
    // The encoder's lane is told of from the beginning to the end.
    let mut now = 0;
    for slot in timeline.of_lane(encoder) {
        assert_eq!(slot.from, now, "{case}: {:?}", slot.what);
        assert!(slot.to > slot.from, "{case}");
        now = slot.to;
    }
    assert_eq!(now, timeline.end, "{case}");
    assert_eq!(timeline.ticks.first(), Some(&0));
    assert_eq!(timeline.ticks.last(), Some(&timeline.end));

    let order: Vec<usize> = timeline
        .of_lane(encoder)
        .filter_map(|slot| match slot.what {
            What::Bit(bit) => Some(bit),
            _ => None,
        })
        .collect();
    let bytes = layout.shape.link() != Link::Clocked;
    let expected: Vec<usize> = match bytes {
        true => (0..layout.len).map(|at| at / 8 * 8 + 7 - at % 8).collect(),
        false => (unsent(layout)..layout.len).collect(),
    };
    assert_eq!(order, expected, "{case}");
    for bit in expected {
        let slot = timeline.slot_of(bit).expect("a slot");
        assert_eq!(slot.lane, encoder, "{case}");
        let at = slot.sampled.expect("a time at which it is read");
        assert!((slot.from..slot.to).contains(&at), "{case}: bit {bit}");
        assert_eq!(timeline.bit_at(at), Some(bit), "{case}");
        let level = timeline.lanes[encoder].level_at(at);
        assert_eq!(level, bits.bit(bit), "{case}: bit {bit}");
    }
}

#[test]
fn every_bit_of_every_layout_is_read_where_its_slot_says() {
    let mut noise = Noise::new(3);
    for case in layouts() {
        let bits = noisy(&mut noise, &case.layout);
        obeys(&case.name, &case.layout, bits.as_bits());
    }
    for parameters in profiles() {
        let decoder = decoder(parameters);
        for values in values(&decoder) {
            let bits = decoder.encode(&values);
            let layout = match decoder.profile().link() {
                Link::Clocked => decoder.main_layout(),
                _ => decoder.layout(bits.as_bits().bytes()).expect("a layout"),
            };
            obeys(parameters, layout, bits.as_bits());
        }
    }
    let known: Vec<Format> = SERIAL
        .iter()
        .chain(PROFILES)
        .chain(UNRECORDED)
        .map(|text| decoder(text).profile().format)
        .collect();
    assert!(Format::ALL.iter().all(|format| known.contains(format)));
}

/// What a receiver of 8N1 makes of a lane.
fn received(timeline: &Timeline, lane: usize, baud: u32) -> Vec<u8> {
    let lane = &timeline.lanes[lane];
    let bit = 1e12 / f64::from(baud);
    let mut out = Vec::new();
    let mut now = 0;
    while let Some(start) = lane
        .steps
        .iter()
        .find(|step| step.time >= now && !step.level)
    {
        let level = |bits: f64| lane.level_at(start.time + (bit * bits) as i64);
        assert!(!level(0.5), "a start bit");
        assert!(level(9.5), "a stop bit");
        out.push(
            (0..8u8)
                .map(|place| u8::from(level(1.5 + f64::from(place))) << place)
                .sum(),
        );
        now = start.time + (bit * 9.6) as i64;
    }
    out
}

#[test]
fn a_receiver_reads_the_bytes_of_request_and_reply() {
    for parameters in SERIAL {
        let decoder = decoder(parameters);
        let profile = decoder.profile();
        let asked = match profile.format {
            Format::Rs485 => Some(profile.command.byte()),
            Format::T485 => Some(Request::All.byte()),
            Format::Bus => Some(bus::request(profile, bus::Operation::Get, 0x1f)),
            _ => profile.own.and_then(Own::request),
        };
        for values in values(&decoder) {
            let frame = decoder.encode(&values).into_bytes();
            let layout = decoder.layout(&frame).unwrap();
            let timeline = drawn(layout, Bits::of_bytes(&frame));
            let encoder = timeline.encoder();
            assert_eq!(received(&timeline, encoder, profile.baud), frame);
            assert_eq!(
                timeline.lanes.len(),
                1 + usize::from(asked.is_some()),
                "{parameters}"
            );
            if let Some(asked) = asked {
                assert_eq!(received(&timeline, 0, profile.baud), [asked]);
                let turn = timeline
                    .slots
                    .iter()
                    .find(|slot| slot.what == What::Turnaround)
                    .unwrap();
                assert_eq!(turn.to - turn.from, 3 * US);
            }
        }
    }
}

#[test]
fn requests_of_several_bytes_and_those_that_change_are_drawn() {
    let tamagawa = decoder("format=t485 dialect=tamagawa");
    let reply = [0xea, 0x10, 0x55, 0xea ^ 0x10 ^ 0x55];
    let timeline = drawn(tamagawa.layout(&reply).unwrap(), Bits::of_bytes(&reply));
    assert_eq!(received(&timeline, 0, 2_500_000), [0xea, 0x10, 0xea ^ 0x10]);
    let requests = timeline.of_lane(0);
    let bits = requests.filter(|slot| matches!(slot.what, What::Request(_)));
    assert_eq!(bits.count(), 24);

    let zero = decoder("format=rs485 command=0");
    let reply = [0x0a, 0x00];
    let timeline = drawn(zero.layout(&reply).unwrap(), Bits::of_bytes(&reply));
    assert_eq!(received(&timeline, 0, 2_500_000), [Command::Zero.byte()]);
}

fn edges(timeline: &Timeline) -> Vec<Edge> {
    let mut edges: Vec<Edge> = timeline
        .lanes
        .iter()
        .zip([Wire::Clock, Wire::Data])
        .flat_map(|(lane, wire)| {
            lane.steps.iter().map(move |step| Edge {
                time: step.time,
                wire,
                level: step.level,
            })
        })
        .collect();
    edges.sort_by_key(|edge| edge.time);
    edges
}

/// The bits that a capture reads, and whether it finds nothing wrong with two such frames.
fn captured(decoder: &Decoder, timeline: &Timeline) -> (BitString, bool) {
    let mut capture = Capture::new(decoder).unwrap();
    let last = timeline.lanes[0].steps.last().unwrap().time;
    let pause = timeline
        .of_lane(0)
        .find(|slot| slot.what == What::Pause)
        .unwrap();
    assert_eq!(pause.from, last);
    // The second frame begins when the pause is over.
    let first = timeline.lanes[0].steps[1].time;
    let shift = pause.to - first;
    for edge in edges(timeline) {
        capture.push(edge);
    }
    for edge in edges(timeline) {
        if edge.time >= first {
            let time = edge.time + shift;
            capture.push(Edge { time, ..edge });
        }
    }
    capture.finish(timeline.end + shift);
    let frames: Vec<_> = std::iter::from_fn(|| capture.poll()).collect();
    let clean = frames.iter().all(|frame| frame.violations.is_empty());
    assert_eq!(frames.len(), 2);
    (frames[0].bits.clone(), clean)
}

#[test]
fn a_capture_of_the_wires_reads_the_frame_and_agrees_with_the_limits() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let layout = decoder.main_layout();
        let timing = decoder.profile().format.timing().unwrap();
        for values in values(&decoder) {
            let frame = decoder.encode(&values);
            for hertz in [
                timing.slowest,
                500_000,
                1_000_000,
                timing.fastest,
                timing.limit(),
            ] {
                let master = Master {
                    hertz,
                    first_low: (hertz > timing.fastest).then_some(US / 2),
                    ..Master::default()
                };
                let timeline = Timeline::new(layout, frame.as_bits(), &master);
                let case = format!("{parameters} {hertz}");
                assert!(timeline.limits.iter().all(|limit| limit.holds), "{case}");
                let (bits, clean) = captured(&decoder, &timeline);
                assert!(clean, "{case}");
                // The first falling edge of BiSS-C reads the idle line, which no frame holds.
                let extra = bits.as_bits().len() - layout.len;
                assert_eq!(
                    extra,
                    usize::from(decoder.profile().format == Format::BissC),
                    "{case}"
                );
                for at in 0..layout.len {
                    assert_eq!(
                        bits.as_bits().bit(at + extra),
                        frame.as_bits().bit(at),
                        "{case}"
                    );
                }
            }
        }
    }
}

#[test]
fn what_stands_around_a_frame_in_a_dump_is_where_it_belongs() {
    // Data of BiSS-C without its acknowledge: the wire has it nevertheless.
    let biss = decoder("format=biss-c angle-bits=17");
    let whole = biss.encode(&values(&biss)[3]);
    let preamble = 1 + 5 + 2;
    let mut bare = BitString::default();
    for at in preamble..whole.as_bits().len() {
        bare.push(whole.as_bits().bit(at));
    }
    let line = biss.line(bare.as_bits()).unwrap();
    assert!(line.ok() && !line.layout.shape.preamble);
    let (one, other) = (
        drawn(biss.main_layout(), whole.as_bits()),
        drawn(&line.layout, bare.as_bits()),
    );
    assert_eq!(one.lanes, other.lanes);
    let named: Vec<What> = other
        .of_lane(1)
        .map(|slot| slot.what)
        .take(preamble + 2)
        .collect();
    assert_eq!(named[..3], [What::Idle, What::Latch, What::Idle]);
    assert_eq!(named[3..8], [What::Acknowledge; 5]);
    assert_eq!(named[8..], [What::Start, What::Cds]);
    assert_eq!(
        one.slot_of(preamble).unwrap().from,
        other.slot_of(0).unwrap().from
    );

    // A word of 13 bits three times, a 0 between.
    let tree = decoder("format=ssi-tree turns-bits=0");
    let word = tree.encode(&values(&tree)[4]);
    let mut ring = BitString::default();
    for time in 0..3 {
        if time > 0 {
            ring.push(false);
        }
        for at in 0..13 {
            ring.push(word.as_bits().bit(at));
        }
    }
    let line = tree.line(ring.as_bits()).unwrap();
    assert_eq!(line.layout.shape.repeats, 2);
    let timeline = drawn(&line.layout, ring.as_bits());
    assert_eq!(
        timeline.lanes[0]
            .steps
            .iter()
            .filter(|step| !step.level)
            .count(),
        3 * 14
    );
    let (bits, clean) = captured(&tree, &timeline);
    assert!(clean);
    assert_eq!(bits, ring);

    // The gap of SSI7 is named for what it carries.
    let ssi7 = decoder("format=ssi7");
    let timeline = drawn(ssi7.main_layout(), ssi7.encode(&values(&ssi7)[2]).as_bits());
    let gap = timeline
        .of_lane(1)
        .find(|slot| slot.what == What::ErrorFlag)
        .unwrap();
    assert_eq!(
        gap.to,
        timeline.lanes[0]
            .steps
            .iter()
            .rev()
            .find(|step| !step.level)
            .unwrap()
            .time
            + 20 * US
    );
}

#[test]
fn a_fold_keeps_the_order_of_time_and_the_width_of_bits() {
    for parameters in profiles() {
        let decoder = decoder(parameters);
        let frame = decoder.encode(&values(&decoder)[2]);
        let layout = match decoder.profile().link() {
            Link::Clocked => decoder.main_layout(),
            _ => decoder.layout(frame.as_bits().bytes()).unwrap(),
        };
        let timeline = drawn(layout, frame.as_bits());
        let fold = Fold::new(&timeline, 12.0);
        for bit in 0..layout.len {
            let slot = timeline.slot_of(bit).unwrap();
            let width = fold.x(slot.to) - fold.x(slot.from);
            assert!((11.5..12.5).contains(&width), "{parameters} {bit}: {width}");
        }
        let places: Vec<f64> = timeline.ticks.iter().map(|time| fold.x(*time)).collect();
        assert!(places.windows(2).all(|two| two[0] < two[1]), "{parameters}");
        assert_eq!(places.last(), Some(&fold.width()));
        assert_eq!((fold.x(-5), fold.x(i64::MAX)), (0.0, fold.width()));
        // Nothing is wider than four bits, so that frames are what is seen.
        let bits = layout.len as f64
            * if layout.shape.link() == Link::Clocked {
                1.0
            } else {
                1.25
            };
        assert!(fold.width() < (bits + 45.0) * 12.0, "{parameters}");
    }
}

#[test]
fn strange_masters_and_frames_are_drawn_too() {
    for parameters in profiles() {
        let decoder = decoder(parameters);
        let layout = decoder.main_layout();
        for hertz in [0, 1, 9_999, u32::MAX] {
            for time in [None, Some(i64::MIN), Some(0), Some(1), Some(i64::MAX)] {
                let master = Master {
                    hertz,
                    first_low: time,
                    pause: time,
                };
                // Too few bits read as 0.
                for bytes in [&[][..], &[0xff]] {
                    let timeline = Timeline::new(layout, Bits::of_bytes(bytes), &master);
                    assert!(timeline.slots.iter().all(|slot| slot.from < slot.to));
                    assert!(timeline.ticks.windows(2).all(|two| two[0] < two[1]));
                    let fold = Fold::new(&timeline, 10.0);
                    assert!(fold.width().is_finite(), "{parameters}");
                }
            }
        }
    }
    for baud in ["1", "50000000"] {
        let decoder = decoder(&format!("format=t485 baud={baud}"));
        let frame = decoder.encode(&values(&decoder)[1]);
        let layout = decoder.layout(frame.as_bits().bytes()).unwrap();
        obeys(baud, layout, frame.as_bits());
    }
}
