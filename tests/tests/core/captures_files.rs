//! Recordings as files: what they hold was written down when they were made, with a model of
//! master and encoder that shares nothing with the one of the crate.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    capture::{Clocking, Options, Recording, sniff},
    decode::Decoder,
    reading::Values,
};
use encoderscope_tests::decoder;

/// A recording, read in its own kind by parameters.
fn read(text: &[u8], parameters: &str) -> Recording {
    let kind = sniff(&text[..text.len().min(512)]).expect("a recording");
    Recording::read(text, kind, &decoder(parameters), Options::default()).expect("readable")
}

/// Of each frame when it was latched in µs, its clocks and its position; violations as text.
fn told(recording: &Recording) -> Vec<String> {
    let decoder = Decoder::new(recording.profile).unwrap();
    let mut lines = Vec::new();
    for frame in &recording.frames {
        let values: Option<Values> = decoder
            .line(frame.bits.as_bits())
            .ok()
            .filter(encoderscope::decode::Frame::ok)
            .map(|frame| frame.values());
        let position = match values {
            Some(values) => format!("{:?} {:?}", values.turns, values.angle),
            None => "no frame".into(),
        };
        let position = position.replace("Some(", "").replace(')', "");
        let at = match recording.clocking {
            Clocking::Timed(_) => format!("{:.2} µs", frame.seconds() * 1e6),
            Clocking::Counted => format!("row {}", frame.time),
        };
        lines.push(format!("{at}: {} clocks, {position}", frame.clocks));
        lines.extend(frame.violations.iter().map(|found| match found.clock {
            Some(clock) => format!("! clock {clock}: {found}"),
            None => format!("! {found}"),
        }));
    }
    assert_eq!(recording.stray, []);
    lines
}

fn wires(recording: &Recording) -> (&str, &str) {
    (&recording.wires.clock.name, &recording.wires.data.name)
}

#[test]
fn ssi_of_sigrok() {
    let text = include_bytes!("../../captures/ssi-17m.sigrok.vcd");
    let found = read(text, "format=ssi angle-bits=17");
    assert_eq!(wires(&found), ("D0", "D1"));
    assert_eq!(
        told(&found),
        [
            "30.00 µs: 42 clocks, 5 65536",
            "173.00 µs: 42 clocks, 5 65537",
        ]
    );
    let hertz = found.frames[0].hertz.unwrap();
    assert!((hertz - 500e3).abs() < 500.0, "{hertz}");
    // Warning and battery low of the second word.
    let decoder = Decoder::new(found.profile).unwrap();
    let values = decoder
        .line(found.frames[1].bits.as_bits())
        .unwrap()
        .values();
    assert_eq!(
        (values.warning, values.status),
        (Some(true), Some(0b01_0000))
    );
}

#[test]
fn biss_of_pulseview_with_a_third_signal() {
    let text = include_bytes!("../../captures/biss-17m.pulseview.vcd");
    let found = read(text, "format=biss-c angle-bits=17");
    assert_eq!(wires(&found), ("MA", "SLO"));
    assert_eq!(found.signals.len(), 3);
    assert_eq!(
        told(&found),
        [
            "25.00 µs: 56 clocks, 5 65536",
            "125.50 µs: 56 clocks, 5 65536",
        ]
    );
}

#[test]
fn a_fir_tree_of_saleae_without_names_whose_trigger_is_at_0() {
    let text = include_bytes!("../../captures/firtree.saleae.csv");
    let found = read(text, "format=ssi-tree");
    assert_eq!(wires(&found), ("Channel 0", "Channel 1"));
    assert_eq!(
        told(&found),
        [
            "-60.00 µs: 26 clocks, 3171 962",
            "122.00 µs: 26 clocks, 3171 962",
            "304.00 µs: 26 clocks, 3171 962",
        ]
    );
}

#[test]
fn ssi7_of_sigrok_cli_with_an_alarm() {
    let text = include_bytes!("../../captures/ssi7.sigrok.csv");
    let found = read(text, "format=ssi7 angle-bits=22");
    assert_eq!(
        told(&found),
        [
            "20.00 µs: 31 clocks, None 8192",
            "100.50 µs: 31 clocks, None 8192"
        ]
    );
    let decoder = Decoder::new(found.profile).unwrap();
    let values = decoder
        .line(found.frames[0].bits.as_bits())
        .unwrap()
        .values();
    assert_eq!(values.error, Some(true));
    assert_eq!(found.frames[0].gap, Some(false));
}

/// The bits of vector biss-panda-ila-0, as an ILA of a Xilinx FPGA records them.
#[test]
fn a_biss_encoder_of_19_bits_in_an_ila_without_times() {
    let text = include_bytes!("../../captures/biss-19.ila.csv");
    let parameters = "format=biss-c angle-bits=19 turns-bits=0 status-bits=0 ack-bits=10";
    let found = read(text, parameters);
    assert_eq!(wires(&found), ("ma", "slo"));
    assert_eq!(found.clocking, Clocking::Counted);
    let bits: String = (0..41)
        .map(|at| {
            if found.frames[0].bits.as_bits().bit(at) {
                '1'
            } else {
                '0'
            }
        })
        .collect();
    assert_eq!(bits, "11000000000010111111111000010001001010000");
    assert_eq!(told(&found), ["row 75: 41 clocks, None 523298"]);
    let other = read(text, &parameters.replace("ack-bits=10", "ack-bits=5"));
    assert_eq!(
        told(&other),
        [
            "row 75: 41 clocks, None 523298",
            "! clock 3: acknowledge of 10 clocks: 5 in the profile",
        ]
    );
}

#[test]
fn a_master_that_sends_as_many_clocks_as_bits() {
    let text = include_bytes!("../../captures/clocks-25-of-26.saleae.csv");
    let found = read(text, "format=ssi-tree");
    assert_eq!(wires(&found), ("SSI CLK", "SSI DATA"));
    let violation = "! clock 25: 25 falling edges for a 25-bit word give 24 bits: send 26 (P+F \
                     article, figure 2 and table 6)";
    assert_eq!(
        told(&found),
        [
            "40.00 µs: 25 clocks, no frame",
            violation,
            "189.00 µs: 25 clocks, no frame",
            violation,
        ]
    );
}

#[test]
fn a_master_that_does_not_pause_long_enough() {
    let text = include_bytes!("../../captures/pause-13us.vcd");
    let found = read(text, "format=ssi angle-bits=16 turns-bits=0");
    assert_eq!(
        told(&found),
        [
            "30.00 µs: 25 clocks, None 1000",
            "68.00 µs: 25 clocks, None 1001",
            "! clock 1: pause of 13.5 µs before this frame: shorter than t_P = 20 µs (MPP and PT, \
             SSI timing)",
        ]
    );
}

#[test]
fn a_master_that_rests_within_a_frame() {
    let text = include_bytes!("../../captures/aborted.saleae.csv");
    let found = read(text, "format=ssi angle-bits=16 turns-bits=0");
    assert_eq!(
        told(&found),
        [
            "30.00 µs: 25 clocks, None 1000",
            "114.50 µs: 9 clocks, no frame",
            "! clock 9: the clock rests for 26 µs within the frame: longer than t_M = 10 µs, the \
             encoder gives the reading up (MPP and PT, SSI timing)",
            "149.00 µs: 16 clocks, no frame",
            "! clock 1: the rest of the clocks of the reading given up before: they start a \
             reading of their own, cut short",
            "224.50 µs: 25 clocks, None 1001",
        ]
    );
}

#[test]
fn both_inverted_wires_with_decimal_commas() {
    let text = include_bytes!("../../captures/inverted.csv");
    let found = read(text, "format=ssi angle-bits=16 turns-bits=0");
    assert!(found.wires.clock.inverted && found.wires.data.inverted);
    let reasons: Vec<String> = found
        .wires
        .reasons
        .iter()
        .map(ToString::to_string)
        .collect();
    assert_eq!(
        reasons,
        [
            "CLK-: by its name",
            "DATA-: by its name",
            "CLK- rests low: read upside down, as the inverted wire of its pair; if it is not, \
             the master's clock must rest high (CPOL 1)",
            "DATA- rests low: read upside down, as the inverted wire of its pair",
        ]
    );
    assert_eq!(
        told(&found),
        [
            "30.00 µs: 25 clocks, None 1000",
            "171.67 µs: 25 clocks, None 1000"
        ]
    );
}

#[test]
fn a_clock_that_is_too_slow() {
    let text = include_bytes!("../../captures/slow.saleae.csv");
    let found = read(text, "format=ssi angle-bits=16 turns-bits=0");
    let violation = "! clock of 80 kHz: slower than 110 kHz (MPP and PT, SSI timing)";
    assert_eq!(
        told(&found),
        [
            "30.00 µs: 25 clocks, None 1000",
            violation,
            "396.25 µs: 25 clocks, None 1000",
            violation,
        ]
    );
}
