#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope_tests::{
    Noise,
    fuzz::{self, inputs},
};

/// Runs a target over its corpus, and over as many inputs of noise.
fn replay(target: fn(&[u8]), corpus: &str, noisy: u64) {
    for input in inputs(corpus) {
        target(&input);
    }
    let mut noise = Noise::new(noisy);
    for _ in 0..noisy {
        let len = noise.below(160);
        let input: Vec<u8> = (0..len).map(|_| noise.draw() as u8).collect();
        target(&input);
    }
}

#[test]
fn captures_hold_their_laws() {
    replay(
        fuzz::capture,
        include_str!("../../fuzz/corpus/capture.txt"),
        2_000,
    );
}

#[test]
fn decoding_holds_its_laws() {
    replay(
        fuzz::decode,
        include_str!("../../fuzz/corpus/decode.txt"),
        500,
    );
}

#[test]
fn detection_holds_its_laws() {
    replay(
        fuzz::detect,
        include_str!("../../fuzz/corpus/detect.txt"),
        20,
    );
}

#[test]
fn pasted_text_holds_its_laws() {
    replay(fuzz::dump, include_str!("../../fuzz/corpus/dump.txt"), 500);
}

#[test]
fn framing_holds_its_laws() {
    replay(
        fuzz::framing,
        include_str!("../../fuzz/corpus/framing.txt"),
        500,
    );
}

#[test]
fn conversations_hold_their_laws() {
    replay(
        fuzz::session,
        include_str!("../../fuzz/corpus/session.txt"),
        500,
    );
}

#[test]
fn links_hold_their_laws() {
    replay(fuzz::link, include_str!("../../fuzz/corpus/link.txt"), 500);
}

#[test]
fn sketches_hold_their_laws() {
    replay(
        fuzz::sketch,
        include_str!("../../fuzz/corpus/sketch.txt"),
        500,
    );
}

#[test]
fn value_changes_hold_their_laws() {
    replay(fuzz::vcd, include_str!("../../fuzz/corpus/vcd.txt"), 500);
}

#[test]
fn recordings_hold_their_laws() {
    replay(
        fuzz::recording,
        include_str!("../../fuzz/corpus/recording.txt"),
        2_000,
    );
}
