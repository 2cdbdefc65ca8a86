#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    capture::{
        Capture, Clocked, Kind, Options, Reason, Recording, Unreadable, Violation, ViolationKind,
        sniff,
        wave::{Glitch, Long, Wave},
    },
    decode::Decoder,
    reading::Values,
};
use encoderscope_tests::{
    Noise,
    captures::{Writing, written},
    decoder,
};

const NS: i64 = 1_000;
const US: i64 = 1_000_000;

/// Profiles of every clocked format at several widths.
const PROFILES: &[&str] = &[
    "format=ssi angle-bits=16 turns-bits=0",
    "format=ssi angle-bits=17",
    "format=ssi angle-bits=24",
    "format=ssi7 angle-bits=14",
    "format=ssi7 angle-bits=22",
    "format=ssi7 angle-bits=22 frame-bits=24",
    "format=ssi-tree",
    "format=ssi-tree turns-bits=0",
    "format=ssi-tree code=binary parity=even turns-bits=12 angle-bits=12",
    "format=ssi-tree align=right turns-bits=0 angle-bits=10 frame-bits=16",
    "format=biss-c angle-bits=17",
    "format=biss-c angle-bits=24 turns-bits=0 ack-bits=1",
    "format=biss-c angle-bits=32 turns-bits=0 status-bits=0 ack-bits=20",
];

/// A few values, the extremes first.
fn values(decoder: &Decoder) -> Vec<Values> {
    let profile = decoder.profile();
    let mask = |bits: u32| (1u64 << bits) - 1;
    let mut noise = Noise::new(7);
    let mut all = vec![(0, 0), (u64::MAX, u64::MAX)];
    all.extend((0..4).map(|_| (noise.draw(), noise.draw())));
    let all = all.into_iter().map(|(turns, angle)| Values {
        turns: (profile.turns_bits > 0).then_some((turns & mask(profile.turns_bits)) as i64),
        angle: Some(angle & mask(profile.angle_bits)),
        ..Values::default()
    });
    all.collect()
}

fn clean(decoder: &Decoder) -> Wave {
    Wave::new(decoder.profile()).expect("a master clocks it")
}

fn read(decoder: &Decoder, wave: &Wave) -> Vec<Clocked> {
    let mut capture = Capture::new(decoder).expect("a master clocks it");
    for edge in wave.edges() {
        capture.push(edge);
    }
    capture.finish(wave.now());
    let frames = std::iter::from_fn(|| capture.poll()).collect();
    assert_eq!(capture.stray(), []);
    frames
}

/// That the frames hold the values.
fn decodes(decoder: &Decoder, frames: &[Clocked], expected: &[Values], case: &str) {
    assert_eq!(frames.len(), expected.len(), "{case}");
    let decoder = Decoder::new(Capture::new(decoder).unwrap().profile()).unwrap();
    for (frame, expected) in frames.iter().zip(expected) {
        let line = decoder.line(frame.bits.as_bits()).expect("a frame");
        let found = line.values();
        assert_eq!(
            (found.turns, found.angle),
            (expected.turns, expected.angle),
            "{case}"
        );
        assert!(line.ok(), "{case} {:?}", line.faults());
    }
}

fn kinds(frames: &[Clocked]) -> Vec<(usize, Option<u32>, ViolationKind)> {
    let all = frames.iter().enumerate().flat_map(|(index, frame)| {
        let found = frame.violations.iter();
        found.map(move |found| (index, found.clock, found.kind))
    });
    all.collect()
}

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
fn clean_waves_of_any_frequency_give_their_values_and_no_violation() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let timing = decoder.profile().format.timing().unwrap();
        let usual = timing.slowest.max(125_000);
        let mut speeds = vec![timing.slowest, usual, 500_000, 1_000_000, timing.fastest];
        speeds.push(timing.limit());
        for hertz in speeds {
            for pause in [timing.pause, timing.pause * 5, 1_000 * timing.pause] {
                let mut wave = clean(&decoder);
                wave.hertz = hertz;
                wave.pause = pause;
                wave.delay = 20 * NS;
                wave.first_low = (hertz > timing.fastest).then_some(500 * NS);
                let values = values(&decoder);
                for values in &values {
                    wave.frame(&decoder.encode(values));
                }
                let case = format!("{parameters} {hertz} Hz, pause {pause}");
                let frames = read(&decoder, &wave);
                assert_eq!(kinds(&frames), [], "{case}");
                decodes(&decoder, &frames, &values, &case);
                for frame in &frames {
                    let measured = frame.hertz.unwrap();
                    let off = measured / f64::from(hertz) - 1.0;
                    assert!(off.abs() < 0.001, "{case}: {measured}");
                }
            }
        }
    }
}

#[test]
fn every_writing_of_a_wave_is_read_back() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let mut wave = clean(&decoder);
        let values = values(&decoder);
        for values in &values {
            wave.frame(&decoder.encode(values));
        }
        let direct = read(&decoder, &wave);
        let writings = [Writing::Sigrok(24), Writing::Sigrok(100)];
        for writing in Writing::EXACT.iter().chain(&writings) {
            let case = format!("{parameters} {writing:?}");
            let text = written(&wave.edges(), wave.now(), *writing);
            let kind = sniff(&text.as_bytes()[..text.len().min(400)]).expect("a recording");
            assert_eq!(kind == Kind::Vcd, *writing == Writing::Vcd, "{case}");
            let found = Recording::read(text.as_bytes(), kind, &decoder, Options::default());
            let found = found.unwrap_or_else(|error| panic!("{case}: {error}"));
            assert_eq!(kinds(&found.frames), [], "{case}");
            assert_eq!(found.stray, [], "{case}");
            decodes(&decoder, &found.frames, &values, &case);
            if Writing::EXACT.contains(writing) {
                assert_eq!(found.frames, direct, "{case}");
            }
            assert!(
                !found.wires.clock.inverted && !found.wires.data.inverted,
                "{case}"
            );
        }
    }
}

#[test]
fn samples_may_be_cut_anywhere() {
    let decoder = decoder("format=ssi-tree turns-bits=0");
    let mut wave = clean(&decoder);
    wave.frame(&decoder.encode(&values(&decoder)[3]));
    for writing in [Writing::Saleae, Writing::Commas, Writing::Sigrok(4)] {
        let text = written(&wave.edges(), wave.now(), writing);
        let whole = changes(&[text.as_bytes()]);
        for cut in 0..=text.len() {
            let (a, b) = text.as_bytes().split_at(cut);
            assert_eq!(changes(&[a, b]), whole, "{writing:?} {cut}");
        }
        let bytes: Vec<&[u8]> = text.as_bytes().chunks(1).collect();
        assert_eq!(changes(&bytes), whole, "{writing:?}");
    }
}

fn changes(cuts: &[&[u8]]) -> (Vec<encoderscope::capture::Change>, Vec<String>) {
    let mut changes = Vec::new();
    let mut samples = encoderscope::capture::samples::Samples::new(None);
    for cut in cuts {
        samples
            .push(cut, &mut |change| changes.push(change))
            .unwrap();
    }
    let named = samples.finish(&mut |change| changes.push(change)).unwrap();
    (changes, named.names)
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
        "25 falling edges for a 25-bit word give 24 bits: send 26 (P+F article, figure 2)"
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
fn wires_are_found_by_name_and_by_their_edges_inverted_or_not() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let mut wave = clean(&decoder);
        let values = values(&decoder);
        for values in &values {
            wave.frame(&decoder.encode(values));
        }
        let text = written(&wave.edges(), wave.now(), Writing::Saleae);
        let not = |level: &str| if level == "0" { "1" } else { "0" };
        for (names, order) in [
            ("CLK+,DATA+", [0, 1]),
            ("CLK-,DATA-", [2, 3]),
            ("a,b", [0, 1]),
            ("a,b", [1, 0]),
            ("a,b", [2, 1]),
            ("a,b", [0, 3]),
            ("a,b", [3, 2]),
            ("data,clk", [0, 1]),
            ("miso,sck", [1, 0]),
            (
                "a,b,c,d",
                [3, 2, 1, 0].as_slice().try_into().unwrap_or([3, 2]),
            ),
        ] {
            let mut lines = text.lines();
            lines.next();
            let rows = lines.map(|line| {
                let fields: Vec<&str> = line.split(',').collect();
                let (clock, data) = (fields[1], fields[2]);
                let all = [clock, data, not(clock), not(data)];
                let levels: Vec<&str> = match names {
                    "a,b,c,d" => vec![all[3], all[2], all[1], all[0]],
                    _ => order.iter().map(|column| all[*column]).collect(),
                };
                format!("{},{}\n", fields[0], levels.join(","))
            });
            let text: String = core::iter::once(format!("Time [s],{names}\n"))
                .chain(rows)
                .collect();
            let case = format!("{parameters} {names} {order:?}");
            let found =
                Recording::read(text.as_bytes(), Kind::Samples, &decoder, Options::default())
                    .unwrap();
            assert_eq!(kinds(&found.frames), [], "{case} {:?}", found.wires);
            decodes(&decoder, &found.frames, &values, &case);
            assert!(found.wires.reasons.len() >= 2, "{case}");
            let swapped = found
                .wires
                .reasons
                .iter()
                .any(|reason| matches!(reason, Reason::Swapped { .. }));
            assert_eq!(swapped, names == "data,clk", "{case}");
        }
    }
}

#[test]
fn without_times_the_timing_is_not_judged_and_the_bits_are_read() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let mut wave = clean(&decoder);
        let values = values(&decoder);
        for values in &values {
            wave.frame(&decoder.encode(values));
        }
        let text = written(&wave.edges(), wave.now(), Writing::Sigrok(8));
        let text = text.replace("; Samplerate: 8 MHz\n", "");
        let read = |options: Options<'_>| {
            Recording::read(text.as_bytes(), Kind::Samples, &decoder, options).unwrap()
        };
        let found = read(Options::default());
        assert_eq!(found.clocking, encoderscope::capture::Clocking::Counted);
        assert!(found.frames.iter().all(|frame| frame.hertz.is_none()));
        assert_eq!(kinds(&found.frames), [], "{parameters}");
        decodes(&decoder, &found.frames, &values, parameters);
        let timed = read(Options {
            sample: Some(125 * NS),
            ..Options::default()
        });
        assert!(timed.frames.iter().all(|frame| frame.hertz == Some(1e6)));
    }
}

#[test]
fn text_that_is_no_recording_is_not_taken_for_one() {
    for text in [
        "",
        "Time [s],Value,Parity Error,Framing Error\n0.1,0x1A,,\n0.2,0x20,,\n0.3,0x00,,\n",
        "0,1,0,1,1,0\n1,0,0,1,1,1\n0,0,0,0,0,0\n",
        "01011010\n01011011\n",
        "1a 20 29 c0\n",
        "0 1 0 1\n1 1 0 1\n0 0 0 1\n",
        "name,Channel 0,Channel 1\n",
        "Time [s],Channel 0\n0,1\n1,0\n2,1\n",
        "$ 1a 20\n",
    ] {
        assert_eq!(sniff(text.as_bytes()), None, "{text}");
    }
    let wave = "Time [s],Channel 0,Channel 1\n-0.000001,1,1\n0,0,1\n1e-6,1,1\n";
    assert_eq!(sniff(wave.as_bytes()), Some(Kind::Samples));
    assert_eq!(sniff(b"\xef\xbb\xbf \n$date\n"), Some(Kind::Vcd));
}

#[test]
fn what_cannot_be_read_is_refused_with_its_place() {
    let decoder = decoder("format=ssi");
    let refused = |text: &str| {
        let kind = if text.starts_with('$') {
            Kind::Vcd
        } else {
            Kind::Samples
        };
        Recording::read(text.as_bytes(), kind, &decoder, Options::default()).unwrap_err()
    };
    let head = "$timescale 1 ns $end\n$var wire 1 ! clk $end\n$var wire 1 \" data $end\n\
                $enddefinitions $end\n";
    let vcd = |body: &str| refused(&format!("{head}{body}")).to_string();
    assert_eq!(vcd("#10\n1!\n#9\n0!\n"), "line 7: the time runs backwards");
    assert_eq!(
        vcd("#9223372036854775808\n1!\n"),
        "line 5: the time cannot be read or is too far off"
    );
    assert_eq!(
        vcd("#99999999999999999999999\n"),
        "VCD: number too large to fit in target type at line 5"
    );
    assert_eq!(
        vcd("\u{1}\u{2}garbage"),
        "VCD: unexpected character at start of command at line 5"
    );
    assert!(vcd(&format!("b{} !\n", "1".repeat(100_000))).starts_with("VCD: a command or name"));
    assert!(
        vcd(&format!("$comment {}", "x".repeat(100_000))).starts_with("VCD: a command or name")
    );
    assert!(vcd("1").starts_with("VCD: unexpected end of VCD file"));
    let deep = "$scope module a $end\n".repeat(100_000);
    assert_eq!(refused(&deep), Unreadable::Deep(65));
    let many: String = (0..5_000)
        .map(|index| format!("$var wire 1 x{index} s{index} $end\n"))
        .collect();
    assert_eq!(refused(&many), Unreadable::TooManySignals);
    assert_eq!(
        refused("$timescale 40000000 s $end\n$var wire 1 ! a $end\n#9999999999\n1!\n"),
        Unreadable::Time(3)
    );
    assert_eq!(refused("$timescale 0 s $end\n"), Unreadable::Time(1));
    assert_eq!(refused("$version x $end\n"), Unreadable::Signals(0));

    let csv = |text: &str| refused(text).to_string();
    assert_eq!(
        csv("Time [s],a,b\n1,0,0\n0.5,1,1\n"),
        "line 3: the time runs backwards"
    );
    assert_eq!(
        csv("Time [s],a,b\n0,0,0\nx,1,1\n"),
        "line 3: the time cannot be read or is too far off"
    );
    assert_eq!(
        csv("Time [s],a,b\n0,0,0\n1e300,1,1\n"),
        "line 3: the time cannot be read or is too far off"
    );
    assert_eq!(
        csv(&format!("{}\n", "0,".repeat(50_000))),
        "line 1 is too long for a recording"
    );
    assert_eq!(
        csv("Time [s],a\n0,1\n1,0\n"),
        "1 signal of 0 and 1 in it: clock and data are two"
    );
    let other = self::decoder("format=t485");
    let error = Recording::read(b"", Kind::Samples, &other, Options::default()).unwrap_err();
    assert!(error.to_string().starts_with("T485 has no clock"));
    let named = Options {
        clock: Some("x"),
        ..Options::default()
    };
    let error = Recording::read(b"t [us];a;b\n0,5;1;1\n", Kind::Samples, &decoder, named);
    assert_eq!(
        error.unwrap_err().to_string(),
        "no signal \"x\"; there are: a, b"
    );
}

#[test]
fn wide_signals_reals_and_unknown_levels_are_passed_over() {
    let decoder = decoder("format=ssi-tree turns-bits=0 angle-bits=2 frame-bits=2");
    let text = "$timescale 1us $end $scope module a $end $var wire 8 # bus [7:0] $end\n\
        $var wire 1 ! clk $end $var reg 1 % q [0] $end $var real 64 r volts $end $upscope $end\n\
        $enddefinitions $end\n#0 $dumpvars b00000000 # 1! b1 % r1.5 r $end\n\
        #100 0! #102 1! x% #104 0! b1010 # #106 1! b0 % #108 0! #110 1! #120 b1 % #200 z%";
    let found = Recording::read(text.as_bytes(), Kind::Vcd, &decoder, Options::default()).unwrap();
    assert_eq!(
        (
            found.wires.clock.name.as_str(),
            found.wires.data.name.as_str()
        ),
        ("clk", "q[0]")
    );
    assert_eq!(found.frames.len(), 1);
    assert_eq!(found.frames[0].bits.as_bits().bytes(), [0b1000_0000]);
    assert_eq!(found.frames[0].seconds(), 100e-6);
}

/// Every text that a violation can have names the measured value and the limit.
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
