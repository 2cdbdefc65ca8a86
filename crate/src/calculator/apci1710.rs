//! What is written to an APCI-1710, and the program that does it.

mod program;

use super::{
    Answer, Calculator, Fault, Given, Input, Outcome, Tone, Word,
    quantity::{Measure, shown},
};
use crate::{
    apci1710::{self, Channel, FASTEST, MODULE_BYTES, Register, WORD_BITS},
    explain::grouped,
    format::{
        ssi, ssi_tree,
        timing::{MICROSECOND, SECOND},
    },
    language::{msg, t},
    text,
};
use alloc::{format, string::String, vec::Vec};
use program::Program;

/// Which channels are converted, and their names.
const CHANNELS: &[Word] = &[
    word("1", msg("encoder 1")),
    word("2", msg("encoder 2")),
    word("3", msg("encoder 3")),
    word("1-2", msg("encoders 1 and 2")),
    word("1-3", msg("encoders 1 and 3")),
    word("2-3", msg("encoders 2 and 3")),
    word("1-2-3", msg("all three")),
    word("none", msg("none")),
];

const fn word(name: &'static str, title: &'static str) -> Word {
    Word { name, title }
}

/// The highest address at which a whole board fits into 32 bits.
const HIGHEST: f64 = (u32::MAX - apci1710::MODULES * MODULE_BYTES + 1) as f64;
/// The least number that the board's address is a multiple of: its registers have 32 bits.
const STEP: u64 = 4;

pub(super) const APCI_1710: Calculator = Calculator {
    name: "apci-1710",
    title: "APCI-1710",
    about: msg(
        "What is written to the SSI module of an APCI-1710 or CPCI-1710, where, and how long a reading takes.",
    ),
    source: msg(
        "P+F article, registers of the SSI module; offsets of SHIFT and OUTPUT: Linux, comedi, APCI1710_Ssi.c",
    ),
    inputs: &[
        Input::number(
            "pci-clock",
            msg("PCI clock"),
            msg("from the manual of the computer; 33 MHz nearly everywhere"),
            (Measure::Frequency, "MHz"),
            (0.001, 133.0),
            "33",
        ),
        Input::number(
            "clock",
            msg("Clock wished"),
            msg("of the encoders; the line and the encoder set its limits"),
            (Measure::Frequency, "kHz"),
            (0.001, 100_000.0),
            "125",
        ),
        Input::number(
            "bits",
            msg("Bits of the word"),
            msg("25 of a multi-turn encoder, 13 of a single-turn one"),
            (Measure::Bits, "bits"),
            (1.0, WORD_BITS as f64),
            "25",
        ),
        Input::word(
            "gray",
            msg("Gray to binary"),
            msg("for which encoders the module converts the word"),
            CHANNELS,
            "1",
        ),
        Input::number(
            "module",
            msg("Module"),
            msg("0…3 on the board"),
            (Measure::Count, ""),
            (0.0, (apci1710::MODULES - 1) as f64),
            "0",
        ),
        Input::number(
            "base",
            msg("Address of the board"),
            msg("as in 0xD000; 0 gives the offsets on the board alone"),
            (Measure::Address, ""),
            (0.0, HIGHEST),
            "0",
        ),
    ],
    work,
};

fn work(given: &Given) -> Result<Outcome, Fault> {
    let fault = |input, message: String| Fault { input, message };
    let pci = given.number("pci-clock") * 1e6;
    let wished = given.number("clock") * 1e3;
    if wished > f64::from(FASTEST) {
        return Err(fault(
            "clock",
            text!(
                "{} kHz: the module clocks with at most 1 MHz",
                shown(wished / 1e3, 6)
            ),
        ));
    }
    let slowest = pci / f64::from(apci1710::divider(u16::MAX));
    let frq = apci1710::frq(pci, wished).ok_or_else(|| {
        fault(
            "clock",
            text!(
                "{} Hz: the largest divider, {}, leaves {} Hz",
                shown(wished, 6),
                grouped(apci1710::divider(u16::MAX).into()),
                shown(slowest, 4)
            ),
        )
    })?;
    let base = given.number("base") as u64;
    if !base.is_multiple_of(STEP) {
        return Err(fault(
            "base",
            text!(
                "0x{}: the address of registers of 32 bits is a multiple of {}",
                format_args!("{base:X}"),
                STEP
            ),
        ));
    }
    let divider = apci1710::divider(frq);
    let real = pci / f64::from(divider);
    let bits = given.number("bits") as u32;
    let named = given.word("gray");
    let control = Channel::ALL
        .iter()
        .filter(|channel| named.contains(digit(**channel)))
        .fold(0, |control, channel| control | channel.control());
    let module = given.number("module") as u32;
    let clocks = f64::from(bits + 1);
    let time = clocks * 1e6 / real;

    let divided = Answer::of("frq", "FRQ", frq.into(), 6, "").note(text!(
        "divides the PCI clock by {}, for the highest clock that is not above the one wished",
        grouped(divider.into())
    ));
    let clock = Answer::of(
        "real-clock",
        t("The clock that results"),
        real / 1e3,
        6,
        "kHz",
    );
    let apart = match (real / wished - 1.0) * 100.0 {
        // What is left of a division that goes out even.
        apart if apart.abs() < 1e-6 => 0.0,
        apart => apart,
    };
    let converts = match control {
        0 => t("no word is converted"),
        _ => t(
            "Linux's driver counts one clock more than the article for words that are converted: where the last bit is missing, write COUNTS + 1",
        ),
    };
    let mut answers: Vec<Answer> = [
        divided,
        clock,
        Answer::of("difference", t("Off the clock wished"), apart, 3, "%"),
        limits(real),
        Answer::of("counts", "COUNTS", bits.into(), 4, "").note(text!(
            "{} bits, {} clocks",
            bits,
            bits + 1
        )),
        Answer {
            number: Some(control.into()),
            ..Answer::worded("control", "CONTROL", format!("0x{control:X}"))
        }
        .note(converts),
        Answer::of("read-time", t("A reading"), time, 4, "µs").note(t(
            "the clocks, until D0 of STATUS is 0; then the pause of the encoder",
        )),
    ]
    .into();
    let at = |register: Register| base + u64::from(register.place(module));
    answers.extend(Register::ALL.map(|register| {
        let (name, title) = address_names(register);
        Answer {
            number: Some(at(register) as f64),
            ..Answer::worded(name, t(title), format!("0x{:04X}", at(register)))
        }
        .note(register.layout().title())
    }));
    let program = Program {
        frq,
        real,
        pci,
        bits,
        control,
        module,
        base,
        polls: time * pci / 1e6,
    };
    Ok(Outcome {
        answers,
        code: Some(program.code()),
    })
}

/// Whether encoders keep up a reading with a clock.
fn limits(clock: f64) -> Answer {
    let lowest = |timeout: i64| SECOND as f64 / timeout as f64;
    let micros = |timeout: i64| timeout / MICROSECOND;
    let answer =
        |said: &str| Answer::worded("time-out", t("Is it fast enough for the time-out"), said);
    let (tree, own) = (&ssi_tree::TIMING, &ssi::TIMING);
    match clock {
        clock if clock <= lowest(tree.timeout) => answer(t("no")).tone(Tone::Warn).note(text!(
            "a period must be shorter than t_m, about {} µs: above {} kHz",
            micros(tree.timeout),
            shown(lowest(tree.timeout) / 1e3, 4)
        )),
        clock if clock <= lowest(tree.silence()).max(lowest(own.silence())) => {
            answer(t("for most encoders")).tone(Tone::Warn).note(text!(
                "t_m is {} ± {} µs, and t_M of MPP and PT {} µs: above {} kHz all keep up",
                micros(tree.timeout),
                micros(tree.timeout - tree.silence()),
                micros(own.silence()),
                shown(lowest(tree.silence()).max(lowest(own.silence())) / 1e3, 4)
            ))
        }
        _ => answer(t("yes")).tone(Tone::Good).note(t(
            "a period is shorter than t_m of P+F and t_M of MPP and PT",
        )),
    }
}

const fn digit(channel: Channel) -> char {
    match channel {
        Channel::One => '1',
        Channel::Two => '2',
        Channel::Three => '3',
    }
}

/// The name and the title of a register's address.
const fn address_names(register: Register) -> (&'static str, &'static str) {
    match register {
        Register::Frq => ("address-frq", msg("FRQ, write")),
        Register::Status => ("address-status", msg("STATUS, read")),
        Register::Counts => ("address-counts", msg("COUNTS, write")),
        Register::Shift(Channel::One) => ("address-shift-1", msg("SHIFT 1, read")),
        Register::Shift(Channel::Two) => ("address-shift-2", msg("SHIFT 2, read")),
        Register::Shift(Channel::Three) => ("address-shift-3", msg("SHIFT 3, read")),
        Register::Start => ("address-start", msg("START, write")),
        Register::Control => ("address-control", msg("CONTROL, write")),
        Register::Output => ("address-output", msg("OUTPUT, write")),
        Register::Identity => ("address-identity", msg("IDENTITY, read")),
    }
}
