#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    capture::{
        Capture, Clocked, Kind, Options, Reason, Recording, Unreadable, ViolationKind, sniff,
        wave::Wave,
    },
    decode::Decoder,
    reading::Values,
};
use encoderscope_tests::{
    Noise,
    captures::{Writing, written},
    decoder,
};

pub(crate) const NS: i64 = 1_000;
pub(crate) const US: i64 = 1_000_000;

/// Profiles of every clocked format at several widths.
pub(crate) const PROFILES: &[&str] = &[
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
pub(crate) fn values(decoder: &Decoder) -> Vec<Values> {
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

pub(crate) fn clean(decoder: &Decoder) -> Wave {
    Wave::new(decoder.profile()).expect("a master clocks it")
}

pub(crate) fn read(decoder: &Decoder, wave: &Wave) -> Vec<Clocked> {
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
pub(crate) fn decodes(decoder: &Decoder, frames: &[Clocked], expected: &[Values], case: &str) {
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

pub(crate) fn kinds(frames: &[Clocked]) -> Vec<(usize, Option<u32>, ViolationKind)> {
    let all = frames.iter().enumerate().flat_map(|(index, frame)| {
        let found = frame.violations.iter();
        found.map(move |found| (index, found.clock, found.kind))
    });
    all.collect()
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

#[test]
fn columns_of_more_than_0_and_1_are_no_wires() {
    let decoder = decoder("format=ssi-tree turns-bits=0 angle-bits=2 frame-bits=2");
    let text = "state[3:0],x,Time (ns),y,volts\n0,1,0,1,0.1\n1,1,50000,0,0.2\n0,1,51000,1,0.3\n\
                1,1,52000,0,1\n0,0,53000,1,0\n1,0,54000,0,1\n0,0,55000,1,0\n7,1,72000,1,0\n\
                0,,99000,,5\n";
    let found =
        Recording::read(text.as_bytes(), Kind::Samples, &decoder, Options::default()).unwrap();
    assert_eq!(
        (
            found.wires.clock.name.as_str(),
            found.wires.data.name.as_str()
        ),
        ("y", "x")
    );
    assert_eq!(found.frames.len(), 1);
    assert_eq!(found.frames[0].bits.as_bits().bytes(), [0b1000_0000]);
    assert_eq!(
        (found.frames[0].seconds(), kinds(&found.frames)),
        (5e-5, vec![])
    );
}

#[test]
fn what_a_user_says_of_the_wires_goes_before_their_names() {
    let decoder = decoder("format=ssi-tree");
    let mut wave = clean(&decoder);
    for values in values(&decoder) {
        wave.frame(&decoder.encode(&values));
    }
    let text = written(&wave.edges(), wave.now(), Writing::Saleae);
    let text = text.replacen("Channel 0,Channel 1", "data,clk", 1);
    let asked = |clock, data| {
        let options = Options {
            clock: Some(clock),
            data,
            sample: None,
        };
        Recording::read(text.as_bytes(), Kind::Samples, &decoder, options).unwrap()
    };
    let swapped = |found: &Recording| {
        let reasons = found.wires.reasons.iter();
        let told: Vec<String> = reasons.map(ToString::to_string).collect();
        told.contains(
            &"clock and data are swapped: data has the regular bursts of a clock, clk has not"
                .into(),
        )
    };
    let right = asked("data", Some("clk"));
    let wrong = asked("clk", Some("data"));
    assert_eq!((swapped(&right), swapped(&wrong)), (false, true));
    // Both wires cannot be one signal.
    let both = asked("data", Some("data"));
    for found in [right, wrong, both] {
        assert_eq!(
            (
                found.wires.clock.name.as_str(),
                found.wires.data.name.as_str()
            ),
            ("data", "clk")
        );
        assert_eq!(kinds(&found.frames), []);
        decodes(&decoder, &found.frames, &values(&decoder), "asked");
    }
}

#[test]
fn a_wire_that_never_changes_is_told_of() {
    let decoder = decoder("format=ssi");
    let text = "Time [s],clk,data\n0,1,0\n0.001,1,0\n0.002,1,0\n";
    let found =
        Recording::read(text.as_bytes(), Kind::Samples, &decoder, Options::default()).unwrap();
    let reasons: Vec<String> = found
        .wires
        .reasons
        .iter()
        .map(ToString::to_string)
        .collect();
    assert_eq!(
        reasons[2..],
        [
            "clk never changes, it stays 1",
            "data never changes, it stays 0"
        ]
    );
    assert_eq!(found.frames, []);
}

#[test]
fn frames_without_end_are_refused() {
    let decoder = decoder("format=ssi");
    let mut text =
        String::from("$timescale 1 us $end $var wire 1 ! clk $end $var wire 1 % d $end\n");
    text.push_str("#0 1! 1%\n");
    for frame in 1..200_003 {
        let at = frame * 100;
        text.push_str(&format!("#{at} 0!\n#{} 1!\n", at + 1));
    }
    let found = Recording::read(text.as_bytes(), Kind::Vcd, &decoder, Options::default());
    assert_eq!(found.unwrap_err(), Unreadable::TooManyFrames);
}
