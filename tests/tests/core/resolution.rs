//! Bits, counts, degrees, seconds of arc and lengths: each gives the others.

use encoderscope::calculator::{
    Calculator, Fault, Outcome, Tone,
    quantity::{Measure, parse, rounded},
};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

fn try_of(given: &str, value: &str) -> Result<Outcome, Fault> {
    let resolution = Calculator::named("resolution").unwrap();
    resolution.work(|name| match name {
        "given" => Some(given),
        "value" => Some(value),
        _ => None,
    })
}

fn of(given: &str, value: &str) -> Outcome {
    try_of(given, value).unwrap()
}

fn number(outcome: &Outcome, name: &str) -> f64 {
    outcome.answer(name).unwrap().number.unwrap()
}

#[test]
fn the_figures_of_the_manuals() {
    // IP-75, table 1.
    let ip75 = of("bits", "14");
    assert_eq!(number(&ip75, "counts"), 16_384.0);
    assert_eq!(rounded(number(&ip75, "arc-seconds"), 3), "79.1");
    // MPP and PT: 24 bits, ±0.01°.
    let mpp = of("bits", "24");
    assert_eq!(rounded(number(&mpp, "arc-seconds"), 3), "0.0772");
    assert_eq!(number(&mpp, "counts-within-accuracy").round(), 466.0);
    assert_eq!(
        mpp.answer("counts-within-accuracy").unwrap().tone,
        Tone::Warn
    );
    // The figures as they are printed lead back to the width.
    for (seconds, bits) in [("79.1", 14.0), ("79,1", 14.0), ("0.0772", 24.0)] {
        let back = of("arc-seconds", seconds);
        assert_eq!(number(&back, "bits"), bits, "{seconds}");
        assert!(
            back.answer("bits")
                .unwrap()
                .note
                .ends_with("as it was rounded")
        );
    }
    // P+F: 16 bits are 65 536 values (the article says 32 688).
    assert_eq!(
        of("bits", "16").answer("counts").unwrap().text,
        "65\u{202f}536"
    );
}

#[test]
fn each_gives_the_others() {
    for bits in 1..=47 {
        let from_bits = of("bits", &bits.to_string());
        for given in ["counts", "degrees", "arc-seconds", "length"] {
            let text = format!("{:.20}", number(&from_bits, given));
            let back = of(given, &text);
            for name in ["counts", "degrees", "arc-seconds", "length"] {
                let (one, other) = (number(&from_bits, name), number(&back, name));
                assert!((one - other).abs() <= one * 1e-6, "{bits} {given} {name}");
            }
        }
    }
}

#[test]
fn a_count_that_is_no_power_of_two_names_the_width_above() {
    let outcome = of("counts", "10 000");
    assert_eq!(number(&outcome, "bits"), 14.0);
    assert!(
        outcome
            .answer("bits")
            .unwrap()
            .note
            .contains("16\u{202f}384")
    );
    assert_eq!(outcome.answer("degrees").unwrap().text, "0.036°");
    assert_eq!(of("bits", "14").answer("bits").unwrap().note, "");
}

#[test]
fn lengths_are_those_of_the_radius() {
    let resolution = Calculator::named("resolution").unwrap();
    let at = |radius: &'static str| {
        let entered = move |name: &str| match name {
            "value" => Some("14"),
            "radius" => Some(radius),
            _ => None,
        };
        number(&resolution.work(entered).unwrap(), "length")
    };
    // 2π · 100 mm / 16 384 = 38.35 µm.
    assert!((at("100") - 38.35).abs() < 0.01);
    assert_eq!(at("0.1 m"), at("100 mm"));
    assert_eq!(at("10,0 cm"), at("100"));
}

#[test]
fn what_is_impossible_gives_a_sentence() {
    for (given, value, says) in [
        ("bits", "49", "a whole number up to 48"),
        ("bits", "3.5", "a whole number up to 48"),
        ("bits", "-1", "is less than 0"),
        ("counts", "0", "less than one"),
        ("degrees", "0", "no size"),
        ("degrees", "361", "less than one"),
        ("arc-seconds", "0,0000000001", "more counts than 48 bits"),
        ("length", "∞", "not a number"),
        ("length", "NaN", "not a number"),
        ("counts", "", "is empty"),
    ] {
        let fault = try_of(given, value).unwrap_err();
        assert_eq!(fault.input, "value", "{given} {value}");
        assert!(
            fault.message.contains(says),
            "{given} {value}: {}",
            fault.message
        );
    }
    assert_eq!(try_of("furlongs", "1").unwrap_err().input, "given");
}

#[test]
fn numbers_are_read_as_people_write_them() {
    let hertz = |text| parse(text, Measure::Frequency, "Hz");
    assert_eq!(hertz("1 500 000"), Ok(1.5e6));
    assert_eq!(hertz("1\u{202f}500\u{a0}000"), Ok(1.5e6));
    assert_eq!(hertz("1,5MHz"), Ok(1.5e6));
    assert_eq!(hertz("1500 khz"), Ok(1.5e6));
    assert_eq!(hertz("−3"), Ok(-3.0));
    assert!(hertz("5 mHz").is_err());
    assert!(hertz("1.2.3").is_err());
    assert!(hertz("115,200").unwrap_err().contains("write 115200"));
    assert!(hertz("1,000,000").is_err());
    assert_eq!((hertz("0,025"), hertz("1,25")), (Ok(0.025), Ok(1.25)));
    assert_eq!(hertz("2,5e6"), Ok(2.5e6));
    assert_eq!(hertz("1e-3 MHz"), Ok(1e3));
    assert_eq!(parse("20", Measure::Time, "µs"), Ok(20.0));
    assert!((parse("0.02 ms", Measure::Time, "µs").unwrap() - 20.0).abs() < 1e-9);
    assert!((parse("36\"", Measure::Angle, "°").unwrap() - 0.01).abs() < 1e-12);
    assert_eq!(parse("12 bytes", Measure::Count, "bytes"), Ok(12.0));
}

#[test]
fn numbers_are_written_short() {
    for (number, digits, text) in [
        (79.101_562_5, 3, "79.1"),
        (0.000_021_457_67, 4, "0.00002146"),
        (16_777_216.0, 15, "16\u{202f}777\u{202f}216"),
        (999.96, 4, "1\u{202f}000"),
        (1.0, 6, "1"),
        (0.0, 6, "0"),
        (f64::INFINITY, 6, "∞"),
        (5e-324, 2, "0"),
        (-2.5, 2, "−2.5"),
        (2_900.0, 3, "2\u{202f}900"),
    ] {
        assert_eq!(rounded(number, digits), text);
    }
}
