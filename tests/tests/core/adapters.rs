//! USB adapters: what their chips make of a rate, in the calculator.

use encoderscope::{
    adapter::{CHIPS, Made, System},
    calculator::{Calculator, Outcome, Tone},
};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

fn at(rate: &str, system: &str) -> Outcome {
    let adapters = Calculator::named("adapters").unwrap();
    let entered = |name: &str| match name {
        "rate" => Some(rate),
        "system" => Some(system),
        _ => None,
    };
    adapters.work(entered).unwrap()
}

#[test]
fn the_fastest_rate_is_made_by_high_speed_ftdi_alone() {
    let outcome = at("2.5 Mbaud", "linux");
    let of = |name| outcome.answer(name).unwrap();
    for name in ["FT232H", "FT2232H", "FT4232H"] {
        assert_eq!(of(name).text, "2\u{202f}526\u{202f}316 baud", "{name}");
        assert!(of(name).note.starts_with("+1.05 %"), "{}", of(name).note);
        assert_eq!(of(name).tone, Tone::Good);
    }
    for name in ["FT232R", "FT230X", "FT2232D"] {
        assert_eq!(of(name).text, "3\u{202f}000\u{202f}000 baud", "{name}");
        assert!(of(name).note.starts_with("+20 %"), "{}", of(name).note);
        assert_eq!(of(name).tone, Tone::Bad);
    }
    for name in ["CH340", "CP2104"] {
        assert_eq!(of(name).number, Some(2e6), "{name}");
        assert!(of(name).note.starts_with("−20 %"), "{}", of(name).note);
    }
    for name in ["CP2102N", "CH343", "PL2303"] {
        assert_eq!(
            (of(name).number, of(name).tone),
            (None, Tone::Warn),
            "{name}"
        );
    }
}

#[test]
fn slow_rates_are_made_by_all() {
    for rate in ["115200", "230 400 baud"] {
        let outcome = at(rate, "windows");
        for chip in CHIPS {
            assert_ne!(
                outcome.answer(chip.name).unwrap().tone,
                Tone::Bad,
                "{}",
                chip.name
            );
        }
    }
    let exact = at("2000000", "windows");
    assert!(exact.answer("FT232R").unwrap().note.starts_with("exactly"));
}

#[test]
fn a_rate_that_is_called_made_is_within_what_a_uart_bears() {
    for chip in CHIPS {
        for asked in (1..2_000).map(|thousands| thousands * 2_503) {
            let apart = |rate: f64| (rate / f64::from(asked) - 1.0).abs();
            match chip.made(asked) {
                Made::Rate(rate) => assert!(apart(rate) <= 0.02, "{} {asked}", chip.name),
                Made::Not(rate) => assert!(apart(rate) > 0.02, "{} {asked}", chip.name),
                Made::Listed | Made::Unknown => {}
            }
        }
    }
}

#[test]
fn what_a_list_promises_is_not_called_exact() {
    for name in ["CH340", "CP2104"] {
        let outcome = at("1900000", "windows");
        let answer = outcome.answer(name).unwrap();
        assert_eq!((answer.number, answer.tone), (None, Tone::Good), "{name}");
        assert!(answer.note.contains("not published"), "{name}");
    }
    // The greatest divider of 3 Mbaud is 16 383.875.
    let slow = at("50", "windows");
    for name in ["FT232R", "FT232H"] {
        let answer = slow.answer(name).unwrap();
        assert_eq!(answer.tone, Tone::Bad, "{name}");
        assert!((answer.number.unwrap() - 183.1).abs() < 0.1, "{name}");
    }
    assert_eq!(at("115.2 kbaud", "linux"), at("115 200", "linux"));
}

#[test]
fn the_latency_timer_is_what_limits_ftdi() {
    let outcome = at("2500000", "linux");
    let rate = |name| outcome.answer(name).unwrap().number.unwrap();
    // 16 ms leave about 62 questions a second, 1 ms about a thousand.
    assert!((rate("asked-held") - 62.3).abs() < 0.1);
    assert!((rate("asked-quick") - 954.2).abs() < 0.1);
    assert!((rate("asked-wire") - 2.5e6 / 120.0).abs() < 0.1);
    assert!((rate("byte") - 4.0).abs() < 1e-9);
}

#[test]
fn every_system_has_its_advice() {
    let mut seen = Vec::new();
    for system in System::ALL {
        let outcome = at("115200", system.key());
        let note = |name| outcome.answer(name).unwrap().note.clone();
        assert_eq!(note("latency"), system.latency());
        assert_eq!(note("permission"), system.permission());
        assert!(!seen.contains(&note("latency")));
        seen.push(note("latency"));
    }
    let linux = System::Linux;
    assert!(linux.permission().contains("dialout") && linux.permission().contains("brltty"));
    assert!(linux.latency().contains("ftdi_sio"));
}

#[test]
fn a_rate_of_no_uart_gives_a_sentence() {
    let adapters = Calculator::named("adapters").unwrap();
    for (rate, says) in [
        ("0", "0 is less than 50 baud"),
        ("-9600", "-9600 is less than 50 baud"),
        ("1e9", "1e9 is more than 50\u{202f}000\u{202f}000 baud"),
        ("1e", "\"e\" is none of baud"),
        ("1e-", "\"1e-\" is not a number"),
        ("100 Mbaud", "is more than"),
        ("fast", "\"fast\" is not a number"),
        ("", "is empty"),
        ("115,200", "write 115200 or use a point"),
        ("115.2", "is not a whole number"),
        ("9600 m", "\"m\" is none of baud"),
    ] {
        let fault = adapters
            .work(|name| (name == "rate").then_some(rate))
            .unwrap_err();
        assert_eq!(fault.input, "rate");
        assert!(fault.message.contains(says), "{rate}: {}", fault.message);
    }
}
