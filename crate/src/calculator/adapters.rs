//! What USB adapters make of a baud rate, and how often an encoder can be asked through one.

use super::{Answer, Calculator, Fault, Given, Input, Outcome, Tone, Word, quantity::Measure};
use crate::{
    adapter::{CHIPS, Chip, LATENCY, LEAST_LATENCY, Made, System, TOLERANCE},
    language::{msg, t},
    text,
};
use alloc::{format, string::String, vec::Vec};

const fn word(system: System) -> Word {
    Word {
        name: system.key(),
        title: system.title(),
    }
}

pub(super) const ADAPTERS: Calculator = Calculator {
    name: "adapters",
    title: msg("USB adapters"),
    about: msg(
        "The rate that each chip really makes of an asked one, which its driver takes without a word; and what keeps replies back.",
    ),
    source: msg(
        "FTDI AN232B-04, AN232B-05 and TN_105; Linux ftdi_sio; data sheets of WCH and Silicon Labs",
    ),
    inputs: &[
        Input::number(
            "rate",
            msg("Baud rate asked for"),
            msg("MPP and PT 2 500 000, with code A 115 200; IP-75 230 400"),
            (Measure::Rate, "baud"),
            (50.0, 50e6),
            "2 500 000",
        ),
        Input::number(
            "reply",
            msg("Bytes of request and reply"),
            msg("T485, all data: 1 and 11"),
            (Measure::Count, "bytes"),
            (1.0, 1000.0),
            "12",
        ),
        Input::word(
            "system",
            msg("Operating system"),
            msg("where the browser runs"),
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
        Answer::of("byte", t("A byte on the wire"), byte * 1e6, 4, "µs")
            .note(t("a start bit, eight bits, a stop bit")),
    );
    let often = |name, title: &str, held: f64| {
        let most = 1.0 / (wire + held / 1e3);
        Answer::of(name, title, most, 3, msg("a second"))
    };
    answers.extend([
        often("asked-wire", t("Asked at most, by the wire alone"), 0.0).note(t(
            "request and reply without a gap; USB itself adds a frame of 0.125 ms or 1 ms",
        )),
        often("asked-held", t("Through FTDI as it comes"), LATENCY)
            .note(text!("a short reply is held for {} ms", LATENCY))
            .tone(Tone::Warn),
        often(
            "asked-quick",
            t("Through FTDI with its latency timer set"),
            LEAST_LATENCY,
        )
        .note(text!("held for {} ms", LEAST_LATENCY)),
        Answer::worded("latency", t("How to set it"), system.title()).note(system.latency()),
        Answer::worded("permission", t("What must be allowed"), system.title())
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
            true => String::from(t("exactly")),
            false => text!("{}{} %", sign, super::quantity::shown(apart, 3)),
        }
    };
    let with = |text: String| match chip.note() {
        "" => text,
        note => format!("{text}; {}", t(note)),
    };
    let of = |rate: f64| Answer::of(chip.name, chip.name, rate, 7, "baud");
    match chip.made(asked) {
        Made::Rate(rate) => of(rate).tone(Tone::Good).note(with(say(rate))),
        Made::Not(rate) => of(rate).tone(Tone::Bad).note(with(text!(
            "{}, where a UART bears {} %",
            say(rate),
            TOLERANCE * 100.0
        ))),
        Made::Listed => Answer::worded(chip.name, chip.name, t("in its list"))
            .tone(Tone::Good)
            .note(with(t("what it makes exactly is not published").into())),
        Made::Unknown => Answer::worded(chip.name, chip.name, t("not known"))
            .tone(Tone::Warn)
            .note(t(chip.note())),
    }
}
