#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    detect::{Detection, Verdict, detect},
    emulator::{Emulator, Shaft},
    format::{Format, Medium},
    reading::Values,
    record::hex,
};
use encoderscope_tests::{Noise, decoder};

/// Frames of a turning shaft, one a line.
fn dump(parameters: &str, count: usize) -> String {
    let decoder = decoder(parameters);
    let encoder = Emulator::new(*decoder.profile(), Shaft::turning(300.55, 0.9)).unwrap();
    let frames = (0..count).map(|index| {
        let values = Values {
            operation: Some(3),
            ..encoder.values(index as u64 * 10_000)
        };
        hex(decoder.main_layout().encode(&values).as_bits().bytes())
    });
    frames.collect::<Vec<_>>().join("\n")
}

#[test]
fn each_format_is_told_from_the_others() {
    for parameters in [
        "format=t485 angle-bits=23",
        "format=t485 angle-bits=17",
        "format=rs485 angle-bits=24 command=d",
        "format=rs485 angle-bits=24 command=1",
        "format=rs485 angle-bits=17 command=1 turns-bits=0",
        "format=rs485 angle-bits=20 command=t",
        "format=biss-c angle-bits=24",
        "format=biss-c angle-bits=17",
        "format=biss-c angle-bits=18 turns-bits=0",
        "format=biss-c angle-bits=20 status-bits=0",
    ] {
        let truth = *decoder(parameters).profile();
        let found = detect(&dump(parameters, 40));
        let best = &found[0];
        assert_eq!(
            best.profile.format, truth.format,
            "{parameters}: {found:#?}"
        );
        if best.verdict == Verdict::Certain {
            assert_eq!(best.profile, truth, "{parameters}: {found:#?}");
        } else {
            let open = matches!(best.verdict, Verdict::Ambiguous | Verdict::Likely);
            assert!(open, "{parameters}: {best:?}");
        }
    }
}

#[test]
fn one_frame_alone_is_never_certain() {
    for text in [
        "02 20 b4 bd 1c 37",
        "1a 20 29 c0 3b 17 00 00 00 c8 37",
        "ff fe 12 34 56 60 bb",
        "82 ff fe 80 00 01 90 88",
        "00 05 80 00 00 fd 00 05 80 00 00 fd 00 05 80 00 00 fd",
    ] {
        let found = detect(text);
        assert!(
            found
                .iter()
                .all(|candidate| candidate.verdict != Verdict::Certain),
            "{text}"
        );
    }
}

#[test]
fn nothing_is_made_of_noise() {
    let mut noise = Noise::new(8);
    for _ in 0..20 {
        let bytes: Vec<u8> = (0..120).map(|_| noise.draw() as u8).collect();
        let found = detect(&hex(&bytes));
        assert!(
            found
                .iter()
                .all(|candidate| candidate.verdict != Verdict::Certain),
            "{found:?}"
        );
    }
    assert_eq!(detect(""), []);
    assert_eq!(detect("not a dump"), []);
    assert!(detect(&"é".repeat(30_000)).is_empty());
}

#[test]
fn evidence_is_said_in_sentences() {
    let found = detect(&dump("format=t485", 10));
    assert_eq!(found[0].profile.format, Format::T485);
    assert_eq!(found[0].verdict, Verdict::Certain);
    let record = found[0].record().to_string();
    assert!(
        record.contains(r#""verdict":"certain","evidence":["the check holds in 10 of 10 frames""#),
        "{record}"
    );
}

#[test]
fn a_detection_in_steps_comes_to_the_same() {
    let text = dump("format=bus angle-bits=20", 60);
    let parse = |medium| encoderscope::dump::parse(&text, medium);
    let mut detection = Detection::new(
        &parse(Medium::Bytes),
        &parse(Medium::Bits),
        &parse(Medium::Text),
    );
    let mut steps = 0;
    while detection.step() {
        steps += 1;
    }
    assert!(steps > 50);
    assert_eq!(detection.candidates(), detect(&text));
}
