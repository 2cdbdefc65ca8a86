//! What USB adapters make of a baud rate, and how often an encoder can be asked through one.

use super::{Answer, Calculator, Fault, Given, Input, Outcome, Tone, Word, quantity::Measure};
use crate::adapter::{CHIPS, Chip, LATENCY, LEAST_LATENCY, Made, System, TOLERANCE};
use alloc::{format, string::String, vec::Vec};

const fn word(system: System) -> Word {
    Word {
        name: system.key(),
        title: system.title(),
    }
}

pub(super) const ADAPTERS: Calculator = Calculator {
    name: "adapters",
    title: "USB adapters",
    about: "The rate that each chip really makes of an asked one, which its driver takes without a word; and what keeps replies back.",
    source: "FTDI AN232B-04, AN232B-05 and TN_105; Linux ftdi_sio; data sheets of WCH and Silicon Labs",
    inputs: &[
        Input::number(
            "rate",
            "Baud rate asked for",
            "MPP and PT 2 500 000, with code A 115 200; IP-75 230 400",
            (Measure::Rate, "baud"),
            (50.0, 50e6),
            "2 500 000",
        ),
        Input::number(
            "reply",
            "Bytes of request and reply",
            "T485, all data: 1 and 11",
            (Measure::Count, "bytes"),
            (1.0, 1000.0),
            "12",
        ),
        Input::word(
            "system",
            "Operating system",
            "where the browser runs",
            &[
                word(System::Windows),
                word(System::Linux),
                word(System::MacOs),
                word(System::ChromeOs),
            ],
            "windows",
        ),
    ],
    work,
};

fn work(given: &Given) -> Result<Outcome, Fault> {
    let asked = given.number("rate");
    let system = System::parse(given.word("system")).unwrap_or(System::Windows);
    // A start bit, eight bits and a stop bit.
    let byte = 10.0 / asked;
    let wire = given.number("reply") * byte;
    let mut answers: Vec<_> = CHIPS.iter().map(|chip| made(chip, asked as u32)).collect();
    answers.push(
        Answer::of("byte", "A byte on the wire", byte * 1e6, 4, "µs")
            .note("a start bit, eight bits, a stop bit"),
    );
    let often = |name, title: &str, held: f64| {
        let most = 1.0 / (wire + held / 1e3);
        Answer::of(name, title, most, 3, "a second")
    };
    answers.extend([
        often("asked-wire", "Asked at most, by the wire alone", 0.0)
            .note("request and reply without a gap; USB itself adds a frame of 0.125 ms or 1 ms"),
        often("asked-held", "Through FTDI as it comes", LATENCY)
            .note(format!("a short reply is held for {LATENCY} ms"))
            .tone(Tone::Warn),
        often(
            "asked-quick",
            "Through FTDI with its latency timer set",
            LEAST_LATENCY,
        )
        .note(format!("held for {LEAST_LATENCY} ms")),
        Answer::said("latency", "How to set it", system.title()).note(system.latency()),
        Answer::said("permission", "What must be allowed", system.title())
            .note(system.permission()),
    ]);
    Ok(Outcome::of(answers))
}

fn made(chip: &Chip, asked: u32) -> Answer {
    let apart = |rate: f64| (rate / f64::from(asked) - 1.0) * 100.0;
    let say = |rate: f64| {
        let apart = apart(rate);
        let sign = if apart > 0.0 { "+" } else { "" };
        match apart.abs() < 0.005 {
            true => String::from("exactly"),
            false => format!("{sign}{} %", super::quantity::rounded(apart, 3)),
        }
    };
    let with = |text: String| match chip.note {
        "" => text,
        note => format!("{text}; {note}"),
    };
    let of = |rate: f64| Answer::of(chip.name, chip.name, rate, 7, "baud");
    match chip.made(asked) {
        Made::Rate(rate) => of(rate).tone(Tone::Good).note(with(say(rate))),
        Made::Not(rate) => of(rate).tone(Tone::Bad).note(with(format!(
            "{}, where a UART bears {} %",
            say(rate),
            TOLERANCE * 100.0
        ))),
        Made::Listed => Answer::said(chip.name, chip.name, "in its list")
            .tone(Tone::Good)
            .note(with("what it makes exactly is not published".into())),
        Made::Unknown => Answer::said(chip.name, chip.name, "not known")
            .tone(Tone::Warn)
            .note(chip.note),
    }
}
