//! Calculators: the worked examples of the manuals.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    calculator::{Calculator, Fault, Kind, Outcome, Tone},
    errata::ERRATA,
    format::Format,
};

/// Works a calculator out from `name=value` with spaces between.
fn worked(name: &str, entered: &str) -> Result<Outcome, Fault> {
    let entered: Vec<_> = entered
        .split_whitespace()
        .map(|pair| pair.split_once('=').expect("name=value"))
        .collect();
    let calculator = Calculator::named(name).expect("a calculator");
    for (name, _) in &entered {
        assert!(calculator.inputs.iter().any(|input| input.name == *name));
    }
    calculator.work(|name| {
        let found = entered.iter().find(|(known, _)| *known == name);
        found.map(|(_, value)| *value)
    })
}

#[track_caller]
fn numbers(name: &str, entered: &str, expected: &[(&str, f64)]) {
    let outcome = worked(name, entered).expect("an outcome");
    for (answer, number) in expected {
        let answer = outcome.answer(answer).expect("an answer of the name");
        let got = answer.number.expect("a number");
        assert!(
            (got - number).abs() <= number.abs() * 1e-3,
            "{}: {got}, not {number}",
            answer.name
        );
    }
}

/// The text and the note of an answer that is as good or bad news as expected.
#[track_caller]
fn tone(name: &str, entered: &str, answer: &str, expected: Tone) -> String {
    let outcome = worked(name, entered).expect("an outcome");
    let answer = outcome.answer(answer).expect("an answer of the name");
    assert_eq!(answer.tone, expected, "{entered}: {}", answer.text);
    format!("{} {}", answer.text, answer.note)
}

#[track_caller]
fn refused(name: &str, entered: &str, input: &str, words: &str) {
    let fault = worked(name, entered).expect_err("no outcome");
    assert_eq!(fault.input, input);
    assert!(fault.message.contains(words), "{}", fault.message);
}

#[test]
fn a_cable_of_200_m_delays_by_2900_ns() {
    // P+F article: 300 + 2 · 6.5 · 200 = 2900 ns; 2900 + 0.5 · 3300 ≈ 4500 ns.
    numbers(
        "ssi-line",
        "clock=300",
        &[
            ("delay", 2900.0),
            ("phase", 313.2),
            ("second-sum", 4566.7),
            ("second-sum-clock", 218.98),
            ("table-clock", 200.0),
            ("clock-safe", 86.207),
            ("clock-edge", 172.41),
        ],
    );
    tone("ssi-line", "clock=300", "verdict", Tone::Bad);
    tone("ssi-line", "clock=172", "verdict", Tone::Warn);
    tone("ssi-line", "clock=86", "verdict", Tone::Good);
    let erratum = ERRATA.iter().find(|erratum| erratum.number == 24).unwrap();
    assert!(erratum.says.contains("300 kHz") && erratum.right.contains("172 kHz"));
}

#[test]
fn the_rates_of_table_2_are_late_by_more_than_it_promises() {
    let rows = [
        ("50", 400.0, 136.8, Tone::Warn),
        ("100", 300.0, 172.8, Tone::Warn),
        ("200", 200.0, 208.8, Tone::Bad),
        ("400", 100.0, 198.0, Tone::Bad),
    ];
    for (length, clock, phase, expected) in rows {
        let entered = format!("length={length}");
        numbers(
            "ssi-line",
            &entered,
            &[("table-clock", clock), ("table-phase", phase)],
        );
        tone("ssi-line", &entered, "table-phase", expected);
    }
    numbers("ssi-line", "length=50.1", &[("table-clock", 300.0)]);
    // Only the shortest cables keep what the table promises.
    for (length, expected) in [("24", Tone::Good), ("26", Tone::Warn)] {
        let entered = format!("length={length}");
        tone("ssi-line", &entered, "table-phase", expected);
    }
    let beyond = worked("ssi-line", "length=401").unwrap();
    for name in ["table-clock", "table-phase"] {
        assert_eq!(beyond.answer(name).unwrap().number, None);
    }
    assert!(beyond.answer("delay").unwrap().number.is_some());
}

#[test]
fn a_line_without_delay_bears_any_clock() {
    let entered = "length=0 encoder-delay=0 receiver-delay=0";
    let outcome = worked("ssi-line", entered).unwrap();
    for name in ["clock-safe", "clock-edge"] {
        assert_eq!(outcome.answer(name).unwrap().number, None);
    }
    numbers("ssi-line", entered, &[("phase", 0.0)]);
}

#[test]
fn every_format_with_a_clock_has_its_window() {
    let chosen = Calculator::named("ssi-line").unwrap().inputs.iter();
    let words = chosen
        .filter_map(|input| match input.kind {
            Kind::Word(words) if input.name == "format" => Some(words),
            _ => None,
        })
        .next()
        .unwrap();
    let clocked = Format::ALL
        .iter()
        .filter(|format| format.timing().is_some());
    assert_eq!(clocked.clone().count(), words.len());
    for format in clocked {
        let timing = format.timing().unwrap();
        let at = |hertz: f64| format!("format={} clock={}", format.name(), hertz / 1e3);
        let (slowest, fastest) = (f64::from(timing.slowest), f64::from(timing.fastest));
        let fits = |hertz, expected| tone("ssi-line", &at(hertz), "clock-fits", expected);
        fits(fastest, Tone::Good);
        let limit = f64::from(timing.limit());
        fits(limit * 1.01, Tone::Bad);
        if limit > fastest {
            fits(limit, Tone::Warn);
        }
        fits(slowest * 1.05, Tone::Good);
        fits(slowest * 0.99, Tone::Warn);
        // The time-out is the end of it.
        let lowest = 1e12 / timing.timeout as f64;
        fits(lowest, Tone::Bad);
        numbers("ssi-line", &at(fastest), &[("timeout-clock", lowest / 1e3)]);
        numbers(
            "ssi-line",
            &at(fastest),
            &[("pause", timing.pause as f64 / 1e6)],
        );
    }
    // P+F article: about 50 kHz for 20 µs; t_m may be 10 µs only.
    numbers("ssi-line", "", &[("timeout-clock", 50.0)]);
    tone("ssi-line", "clock=100", "clock-fits", Tone::Warn);
    assert!(tone("ssi-line", "clock=5 format=ssi", "clock-fits", Tone::Bad).contains("10 µs"));
}

#[test]
fn a_reading_takes_its_bits_and_half_a_period() {
    // IP-75, 5.4.1: n · T + 0.5 · T, and 31 falling edges for 30 bits.
    let entered = "format=ssi7 bits=30 clock=1000";
    numbers(
        "ssi-line",
        entered,
        &[
            ("clocks", 31.0),
            ("read-time", 30.5),
            ("pause", 21.0),
            ("rate", 1e6 / 51.5),
        ],
    );
    // Its manual promises more than 10 000 positions a second, and no limit.
    let more = worked("ssi-line", entered).unwrap();
    let more = more.answer("positions").unwrap();
    assert_eq!(
        (more.number, more.text.as_str()),
        (None, "more than 10\u{202f}000")
    );
    // MPP and PT take 50 000 positions a second, which only short words at high clocks reach.
    numbers(
        "ssi-line",
        "format=ssi bits=48 clock=1000",
        &[
            ("read-time", 48.5),
            ("rate", 14_598.5),
            ("positions", 14_598.5),
        ],
    );
    // BiSS-C is idle for one clock more.
    numbers(
        "ssi-line",
        "format=biss-c bits=61 clock=10MHz",
        &[("clocks", 63.0), ("read-time", 6.25), ("rate", 38_095.2)],
    );
    let tree = worked("ssi-line", "").unwrap();
    assert_eq!(tree.answer("positions").unwrap().number, None);
}

#[test]
fn a_word_that_no_format_has_is_refused() {
    for (format, least, most) in [
        ("ssi", 9, 56),
        ("biss-c", 12, 146),
        ("ssi7", 24, 30),
        ("ssi-tree", 2, 64),
    ] {
        let at = |bits: u32| format!("format={format} bits={bits}");
        for bits in [least, most] {
            assert!(worked("ssi-line", &at(bits)).is_ok(), "{format} {bits}");
        }
        for bits in [least - 1, most + 1] {
            refused("ssi-line", &at(bits), "bits", &format!("{least}…{most}"));
        }
    }
    refused("ssi-line", "wire-delay=3", "wire-delay", "3.336 ns/m");
    refused("ssi-line", "length=-1", "length", "less than 0 m");
    refused("ssi-line", "clock=0", "clock", "less than");
}

#[test]
fn the_sleep_on_a_bus_is_that_of_the_manual() {
    // MPP and PT: 16M1-D sleeps 28 µs.
    let example = "angle-bits=16 turns-bits=8 devices=1";
    numbers(
        "bus-timing",
        example,
        &[
            ("suspend", 28.0),
            ("reply-bytes", 6.0),
            ("reply-time", 24.0),
            ("distance", 31.0),
        ],
    );
    tone("bus-timing", example, "suspend", Tone::Plain);
    numbers(
        "bus-timing",
        "angle-bits=16",
        &[("suspend", 32.0), ("reply-bytes", 7.0)],
    );
    numbers(
        "bus-timing",
        "angle-bits=24",
        &[("suspend", 36.0), ("reply-bytes", 8.0)],
    );
    numbers(
        "bus-timing",
        "angle-bits=17 turns-bits=0",
        &[("suspend", 28.0), ("reply-bytes", 6.0)],
    );
}

#[test]
fn a_round_of_a_bus_asks_every_device() {
    numbers(
        "bus-timing",
        "devices=32 adapter-delay=16",
        &[
            ("distance", 40.0),
            ("round", 1.28),
            ("rate", 781.25),
            ("rate-together", 25_000.0),
            ("adapter-round", 513.28),
            ("adapter-rate", 1.9482),
            ("adapter-rate-together", 62.344),
        ],
    );
    let wire = worked("bus-timing", "adapter-delay=0").unwrap();
    assert_eq!(wire.answer("adapter-rate"), None);
    // A late answer ends when the others are awake again.
    tone("bus-timing", "answer-delay=5", "suspend", Tone::Warn);
    numbers("bus-timing", "answer-delay=5", &[("distance", 41.0)]);
    refused("bus-timing", "devices=33", "devices", "more than 32");
    refused("bus-timing", "devices=0", "devices", "less than 1");
    refused("bus-timing", "devices=1.5", "devices", "whole");
    refused(
        "bus-timing",
        "turns-bits=9",
        "turns-bits",
        "none of 16, 8, 0",
    );
}

#[test]
fn the_registers_of_the_board_are_those_of_the_article() {
    // FRQ 50 divides by 100; 25 bits have 26 clocks, 32 have 33.
    let entered = "clock=330";
    numbers(
        "apci-1710",
        entered,
        &[
            ("frq", 50.0),
            ("real-clock", 330.0),
            ("difference", 0.0),
            ("counts", 25.0),
            ("read-time", 26e3 / 330.0),
        ],
    );
    numbers(
        "apci-1710",
        "bits=32 clock=330",
        &[("counts", 32.0), ("read-time", 100.0)],
    );
    // The clock that results is never above the one wished, nor above 1 MHz.
    numbers(
        "apci-1710",
        "clock=1000",
        &[
            ("frq", 17.0),
            ("real-clock", 970.588),
            ("difference", -2.9412),
        ],
    );
    for clock in 1..=1000 {
        let outcome = worked("apci-1710", &format!("clock={clock}")).unwrap();
        let [frq, real] =
            ["frq", "real-clock"].map(|name| outcome.answer(name).unwrap().number.unwrap());
        assert!(real <= f64::from(clock) * (1.0 + 1e-9), "{clock}: {real}");
        assert!(
            frq < 2.0 || 33e3 / (2.0 * (frq - 1.0)) > f64::from(clock),
            "{clock}: {frq}"
        );
    }
    for (gray, control) in [
        ("none", 0.0),
        ("1", 1.0),
        ("2", 2.0),
        ("3", 4.0),
        ("1-3", 5.0),
        ("1-2-3", 7.0),
    ] {
        numbers(
            "apci-1710",
            &format!("gray={gray}"),
            &[("control", control)],
        );
    }
    numbers(
        "apci-1710",
        "base=0xD000 module=3",
        &[
            ("address-frq", f64::from(0xd0c0)),
            ("address-status", f64::from(0xd0c0)),
            ("address-counts", f64::from(0xd0c4)),
            ("address-start", f64::from(0xd0c8)),
            ("address-control", f64::from(0xd0cc)),
            ("address-shift-1", f64::from(0xd0c4)),
            ("address-shift-3", f64::from(0xd0cc)),
            ("address-output", f64::from(0xd0d0)),
            ("address-identity", f64::from(0xd0fc)),
        ],
    );
}

#[test]
fn what_the_board_cannot_clock_is_refused() {
    refused("apci-1710", "clock=1001", "clock", "at most 1 MHz");
    refused("apci-1710", "clock=0.25", "clock", "131\u{202f}070");
    assert!(worked("apci-1710", "clock=0.252").is_ok());
    refused("apci-1710", "bits=33", "bits", "more than 32");
    refused("apci-1710", "module=4", "module", "more than 3");
    refused("apci-1710", "base=0xD001", "base", "multiple of 4");
    refused("apci-1710", "base=0x1FFFFFFFF", "base", "0xFFFFFF00");
    for text in ["0x", "D000", "1e4", "0xD00G"] {
        refused("apci-1710", &format!("base={text}"), "base", "behind 0x");
    }
    // Too slow is a warning: the clock can be made, and the encoder gives up.
    for (clock, expected) in [("50", Tone::Warn), ("100", Tone::Warn), ("101", Tone::Good)] {
        tone("apci-1710", &format!("clock={clock}"), "time-out", expected);
    }
}
