//! Every violation is found where it was made, and no other.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::captures::{NS, PROFILES, US, clean, decodes, kinds, read, values};
use encoderscope::{
    capture::{
        Capture, Clocked, Edge, Violation, ViolationKind, Wire,
        wave::{Glitch, Long, Wave},
    },
    decode::Decoder,
    reading::Values,
};
use encoderscope_tests::decoder;

/// Three frames, the second clocked as `disturb` says.
fn disturbed(decoder: &Decoder, disturb: impl Fn(&mut Wave)) -> Vec<Clocked> {
    let mut wave = clean(decoder);
    let usual = wave.clone();
    for (index, values) in values(decoder).iter().skip(2).take(3).enumerate() {
        if index == 1 {
            disturb(&mut wave);
        }
        wave.frame(&decoder.encode(values));
        if index == 1 {
            wave.extra = usual.extra;
            wave.long = usual.long;
            wave.glitch = usual.glitch;
            wave.pause = usual.pause;
            wave.hertz = usual.hertz;
            wave.first_low = usual.first_low;
            wave.delay = usual.delay;
            wave.stuck = usual.stuck;
        }
    }
    read(decoder, &wave)
}

#[test]
fn a_clock_out_of_its_range_is_told_of_with_the_frame() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let timing = decoder.profile().format.timing().unwrap();
        for hertz in [timing.slowest * 9 / 10, timing.slowest / 2] {
            let found = disturbed(&decoder, |wave| {
                wave.hertz = hertz;
                wave.pause = timing.pause * 8;
                // The longest time-out there is, which a slow clock does not run into.
                wave.timeout = timing.returns.1;
            });
            let [(1, None, ViolationKind::Slow { hertz: measured })] = kinds(&found)[..] else {
                panic!("{parameters} {hertz}: {:?}", kinds(&found));
            };
            assert!((measured / f64::from(hertz) - 1.0).abs() < 0.001);
        }
        let hertz = timing.limit() * 11 / 10;
        let found = disturbed(&decoder, |wave| {
            wave.hertz = hertz;
            wave.first_low = Some(500 * NS);
            wave.delay = 5 * NS;
        });
        let [(1, None, ViolationKind::Fast { .. })] = kinds(&found)[..] else {
            panic!("{parameters} {hertz}: {:?}", kinds(&found));
        };
    }
}

#[test]
fn a_fast_ssi_clock_needs_a_long_first_low() {
    let decoder = decoder("format=ssi angle-bits=16");
    let low = |low: i64| {
        disturbed(&decoder, |wave| {
            wave.hertz = 4_000_000;
            wave.first_low = Some(low);
        })
    };
    assert_eq!(kinds(&low(500 * NS)), []);
    let found = low(125 * NS);
    assert_eq!(found[1].violations.len(), 1);
    assert_eq!(
        found[1].violations[0].to_string(),
        "clock of 4 MHz with a first low of 125 ns: faster than 1.5 MHz needs a first low of \
         500 ns (MPP and PT, SSI timing)"
    );
}

#[test]
fn a_short_pause_is_told_of_with_the_frame_behind_it() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let timing = decoder.profile().format.timing().unwrap();
        let over = timing.timeout.max(timing.returns.0) + US / 2;
        for pause in [over, timing.pause * 97 / 100] {
            let found = disturbed(&decoder, |wave| wave.pause = pause);
            assert_eq!(
                kinds(&found),
                [(1, Some(1), ViolationKind::Pause { measured: pause })],
                "{parameters}"
            );
        }
    }
    let decoder = decoder("format=ssi angle-bits=16");
    let found = disturbed(&decoder, |wave| wave.pause = 12_400 * NS);
    assert_eq!(
        found[1].violations[0].to_string(),
        "pause of 12.4 µs before this frame: shorter than t_P = 20 µs (MPP and PT, SSI timing)"
    );
    // So short that the encoder has not given the reading up: two frames all the same.
    let found = disturbed(&decoder, |wave| wave.pause = 4 * US);
    assert_eq!(found.len(), 3);
    assert!(kinds(&found).contains(&(1, Some(1), ViolationKind::Pause { measured: 4 * US })));
}

#[test]
fn clocks_too_few_or_too_many_are_counted() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let biss = parameters.contains("biss");
        let whole = disturbed(&decoder, |_| {})[1].clocks;
        for extra in [-9, -2, -1, 1, 2, 3] {
            let found = disturbed(&decoder, |wave| wave.extra = extra);
            let falling = whole.checked_add_signed(extra).unwrap();
            let kinds = kinds(&found);
            assert_eq!(found[1].clocks, falling, "{parameters}");
            if biss && extra > 0 {
                assert_eq!(kinds, [], "{parameters} {extra}");
                continue;
            }
            let [(1, Some(clock), ViolationKind::Clocks { needed, .. })] = kinds[..] else {
                panic!("{parameters} {extra}: {kinds:?}");
            };
            assert_eq!((clock, needed), (falling, whole), "{parameters}");
        }
    }
    let decoder = decoder("format=ssi-tree");
    let found = disturbed(&decoder, |wave| wave.extra = -1);
    assert_eq!(
        found[1].violations[0].to_string(),
        "25 falling edges for a 25-bit word give 24 bits: send 26 (P+F article, figure 2 and table 6)"
    );
    // Twice the word is as it should be.
    let found = disturbed(&decoder, |wave| wave.extra = 26);
    assert_eq!(kinds(&found), []);
}

#[test]
fn a_reading_given_up_is_told_from_its_rest() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let timing = decoder.profile().format.timing().unwrap();
        for level in [false, true] {
            for clock in [4, 10] {
                for lasts in [timing.timeout.max(timing.returns.1) + US, timing.pause * 3] {
                    let found = disturbed(&decoder, |wave| {
                        wave.long = Some(Long {
                            clock,
                            level,
                            lasts,
                        });
                    });
                    let case = format!("{parameters} {clock} {level} {lasts}");
                    let aborted = (1, Some(clock), ViolationKind::Aborted { half: lasts });
                    let kinds = kinds(&found);
                    assert_eq!(found.len(), 4, "{case}");
                    assert_eq!(kinds[0], aborted, "{case} {kinds:?}");
                    assert_eq!(kinds[1], (2, Some(1), ViolationKind::Remainder), "{case}");
                    assert_eq!(kinds.len(), 2, "{case} {kinds:?}");
                }
            }
        }
    }
}

#[test]
fn glitches_are_left_out_and_told_of() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        for clock in [1, 2, 7, 12] {
            for width in [5 * NS, 60 * NS] {
                let found = disturbed(&decoder, |wave| {
                    wave.glitch = Some(Glitch { clock, width });
                });
                let half = 500 * NS;
                let glitch = ViolationKind::Glitch { width, half };
                assert_eq!(kinds(&found), [(1, Some(clock), glitch)], "{parameters}");
                let values: Vec<_> = values(&decoder).into_iter().skip(2).take(3).collect();
                decodes(&decoder, &found, &values, parameters);
            }
        }
    }
}

#[test]
fn data_that_comes_when_it_is_read_is_late() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        for delay in [460 * NS, 500 * NS, 600 * NS, 900 * NS] {
            let found = disturbed(&decoder, |wave| wave.delay = delay);
            let late: Vec<_> = kinds(&found)
                .into_iter()
                .filter(|found| found.0 == 1)
                .collect();
            let [
                (
                    1,
                    Some(_),
                    ViolationKind::LateData {
                        delay: seen,
                        high,
                        times,
                    },
                ),
            ] = late[..]
            else {
                panic!("{parameters} {delay}: {late:?}");
            };
            assert_eq!((seen, high), (delay, 500 * NS), "{parameters}");
            assert!(times > 1);
            // A BiSS-C master compensates the delay.
            if parameters.contains("biss") {
                let values: Vec<_> = values(&decoder).into_iter().skip(2).take(3).collect();
                decodes(&decoder, &found, &values, parameters);
            }
        }
    }
}

#[test]
fn an_acknowledge_of_another_length_is_named_and_the_frame_is_read() {
    for (ack, other) in [(5, 4), (5, 10), (1, 2), (20, 1)] {
        let profile = |ack: u32| decoder(&format!("format=biss-c angle-bits=17 ack-bits={ack}"));
        let (expected, sent) = (profile(ack), profile(other));
        let mut wave = clean(&expected);
        let values = values(&expected);
        for (index, values) in values.iter().enumerate() {
            let sender = if index == 2 { &sent } else { &expected };
            wave.frame(&sender.encode(values));
        }
        let found = read(&expected, &wave);
        let kind = ViolationKind::Acknowledge {
            bits: other,
            expected: ack,
            before: Some(ack),
        };
        assert_eq!(kinds(&found), [(2, Some(3), kind)]);
        decodes(&expected, &found, &values, "acknowledge");
    }
}

#[test]
fn a_data_line_that_nobody_drives_is_stuck() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        for level in [false, true] {
            let mut wave = clean(&decoder);
            wave.stuck = Some(level);
            for values in values(&decoder) {
                wave.frame(&decoder.encode(&values));
            }
            let found = read(&decoder, &wave);
            let stuck = ViolationKind::DataStuck { level };
            // The first frame sees the line fall to its level at the start of the recording.
            let expected: Vec<_> = (0..found.len()).map(|index| (index, None, stuck)).collect();
            let skip = usize::from(!level);
            assert_eq!(kinds(&found)[skip..], expected[skip..], "{parameters}");
        }
    }
}

#[test]
fn a_data_line_that_returns_too_late_or_too_early_is_told_of() {
    for (parameters, timeouts) in [
        (
            "format=ssi7 angle-bits=22",
            [(18, false), (20, true), (22, false)],
        ),
        ("format=ssi-tree", [(9, false), (12, true), (31, false)]),
        (
            "format=ssi angle-bits=16",
            [(2, true), (10, true), (21, false)],
        ),
        (
            "format=biss-c angle-bits=17",
            [(2, true), (15, true), (25, false)],
        ),
    ] {
        let decoder = decoder(parameters);
        for (timeout, good) in timeouts {
            let mut wave = clean(&decoder);
            wave.timeout = timeout * US;
            for values in values(&decoder) {
                wave.frame(&decoder.encode(&values));
            }
            let found = kinds(&read(&decoder, &wave));
            let measured = timeout * US;
            let all = found
                .iter()
                .all(|found| found.2 == ViolationKind::Timeout { measured });
            assert!(all, "{parameters} {timeout} {found:?}");
            assert_eq!(
                found.len(),
                if good { 0 } else { 6 },
                "{parameters} {timeout}"
            );
        }
    }
}

#[test]
fn the_gap_of_ssi7_shows_the_error_flag() {
    let decoder = decoder("format=ssi7 angle-bits=22");
    for behind in [false, true] {
        let mut wave = clean(&decoder);
        wave.behind = behind;
        for values in values(&decoder) {
            wave.frame(&decoder.encode(&values));
        }
        let found = read(&decoder, &wave);
        assert_eq!(kinds(&found), []);
        assert!(found.iter().all(|frame| frame.gap == Some(behind)));
    }
}

#[test]
fn a_recording_may_begin_and_end_within_a_frame() {
    let decoder = decoder("format=ssi angle-bits=16");
    let mut wave = clean(&decoder);
    for values in values(&decoder).iter().take(2) {
        wave.frame(&decoder.encode(values));
    }
    let edges = wave.edges();
    for from in [20, 21, 40] {
        for left in [10, 11, 33] {
            let mut capture = Capture::new(&decoder).unwrap();
            let part = &edges[from..edges.len() - left];
            for edge in part {
                capture.push(*edge);
            }
            capture.finish(part.last().unwrap().time);
            let found: Vec<Clocked> = std::iter::from_fn(|| capture.poll()).collect();
            let cut = |index| (index, None, ViolationKind::Cut);
            assert_eq!(kinds(&found), [cut(0), cut(1)], "{from} {left}");
        }
    }
}

#[test]
fn a_clock_that_never_pauses_is_cut() {
    let decoder = decoder("format=ssi angle-bits=16");
    let mut wave = clean(&decoder);
    wave.extra = 20_000;
    wave.frame(&decoder.encode(&Values::default()));
    let found = read(&decoder, &wave);
    let endless = kinds(&found).into_iter();
    let endless = endless.filter(|found| matches!(found.2, ViolationKind::Endless { .. }));
    assert_eq!(endless.count(), 4);
    assert!(found.iter().all(|frame| frame.clocks <= 4097));
}

#[test]
fn violations_read_as_sentences() {
    let decoder = decoder("format=ssi7");
    let found = disturbed(&decoder, |wave| {
        wave.long = Some(Long {
            clock: 12,
            level: true,
            lasts: 30 * US,
        });
    });
    let text: Vec<String> = found
        .iter()
        .flat_map(|frame| frame.violations.iter().map(Violation::to_string))
        .collect();
    assert_eq!(
        text,
        [
            "the clock rests for 30 µs within the frame: longer than T_mu = 20 ± 1 µs, the \
             encoder gives the reading up (IP-75, 5.4.1)",
            "the rest of the clocks of the reading given up before: they start a reading of their \
             own, cut short"
        ]
    );
}

#[test]
fn an_encoder_that_is_not_ready_for_the_next_frame_is_told_of() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let timing = decoder.profile().format.timing().unwrap();
        let mut wave = clean(&decoder);
        wave.timeout = timing.pause * 3;
        wave.frame(&decoder.encode(&values(&decoder)[2]));
        wave.frame(&decoder.encode(&values(&decoder)[2]));
        let found = kinds(&read(&decoder, &wave));
        let measured = timing.pause * 2 + 500 * NS;
        let late = ViolationKind::NotReady { measured };
        assert!(found.contains(&(0, None, late)), "{parameters} {found:?}");
    }
}

#[test]
fn a_clock_that_rests_low_is_told_of_with_each_frame() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let mut wave = clean(&decoder);
        for values in values(&decoder) {
            wave.frame(&decoder.encode(&values));
        }
        let mut capture = Capture::new(&decoder).unwrap();
        for edge in wave.edges() {
            capture.push(Edge {
                level: edge.level != (edge.wire == Wire::Clock),
                ..edge
            });
        }
        capture.finish(wave.now());
        let frames: Vec<Clocked> = std::iter::from_fn(|| capture.poll()).collect();
        assert_eq!(frames.len(), 6, "{parameters}");
        for frame in &frames {
            let low = |found: &&Violation| found.kind == ViolationKind::IdleLow;
            assert_eq!(
                frame.violations.iter().filter(low).count(),
                1,
                "{parameters}"
            );
        }
    }
}

#[test]
fn a_glitch_in_the_pause_is_told_of_with_the_next_frame() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let mut wave = clean(&decoder);
        let values = values(&decoder);
        for values in &values[2..4] {
            wave.frame(&decoder.encode(values));
        }
        let mut edges = wave.edges();
        let falls = edges
            .iter()
            .filter(|edge| edge.wire == Wire::Clock && !edge.level);
        let falls: Vec<i64> = falls.map(|edge| edge.time).collect();
        // Well behind the first frame, and well before the second.
        let time = falls[falls.len() / 2] - wave.pause / 3;
        let pulse = |time, level| Edge {
            time,
            wire: Wire::Clock,
            level,
        };
        edges.extend([pulse(time, false), pulse(time + 30 * NS, true)]);
        edges.sort_by_key(|edge| edge.time);
        let mut capture = Capture::new(&decoder).unwrap();
        edges.into_iter().for_each(|edge| capture.push(edge));
        capture.finish(wave.now());
        let frames: Vec<Clocked> = std::iter::from_fn(|| capture.poll()).collect();
        let glitch = ViolationKind::Glitch {
            width: 30 * NS,
            half: 500 * NS,
        };
        assert_eq!(kinds(&frames), [(1, Some(1), glitch)], "{parameters}");
        assert_eq!(frames[1].violations[0].time, time);
        decodes(&decoder, &frames, &values[2..4], parameters);
    }
}
