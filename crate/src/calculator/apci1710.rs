//! What is written to an APCI-1710, and the program that does it.

mod program;

use super::{
    Answer, Calculator, Fault, Given, Input, Outcome, Tone, Word,
    quantity::{Measure, rounded},
};
use crate::{
    apci1710::{self, Channel, FASTEST, MODULE_BYTES, Register, WORD_BITS},
    explain::grouped,
    format::{
        ssi, ssi_tree,
        timing::{MICROSECOND, SECOND},
    },
};
use alloc::{format, string::String, vec::Vec};
use program::Program;

/// Which channels are converted, and their names.
const CHANNELS: &[Word] = &[
    word("1", "encoder 1"),
    word("2", "encoder 2"),
    word("3", "encoder 3"),
    word("1-2", "encoders 1 and 2"),
    word("1-3", "encoders 1 and 3"),
    word("2-3", "encoders 2 and 3"),
    word("1-2-3", "all three"),
    word("none", "none"),
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
    about: "What is written to the SSI module of an APCI-1710 or CPCI-1710, where, and how long a reading takes.",
    source: "P+F article, registers of the SSI module; offsets of SHIFT and OUTPUT: Linux, comedi, APCI1710_Ssi.c",
    inputs: &[
        Input::number(
            "pci-clock",
            "PCI clock",
            "from the manual of the computer; 33 MHz nearly everywhere",
            (Measure::Frequency, "MHz"),
            (0.001, 133.0),
            "33",
        ),
        Input::number(
            "clock",
            "Clock wished",
            "of the encoders; the line and the encoder set its limits",
            (Measure::Frequency, "kHz"),
            (0.001, 100_000.0),
            "125",
        ),
        Input::number(
            "bits",
            "Bits of the word",
            "25 of a multi-turn encoder, 13 of a single-turn one",
            (Measure::Bits, "bits"),
            (1.0, WORD_BITS as f64),
            "25",
        ),
        Input::word(
            "gray",
            "Gray to binary",
            "for which encoders the module converts the word",
            CHANNELS,
            "1",
        ),
        Input::number(
            "module",
            "Module",
            "0…3 on the board",
            (Measure::Count, ""),
            (0.0, (apci1710::MODULES - 1) as f64),
            "0",
        ),
        Input::number(
            "base",
            "Address of the board",
            "as in 0xD000; 0 gives the offsets on the board alone",
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
            format!(
                "{} kHz: the module clocks with at most 1 MHz",
                rounded(wished / 1e3, 6)
            ),
        ));
    }
    let slowest = pci / f64::from(apci1710::divider(u16::MAX));
    let frq = apci1710::frq(pci, wished).ok_or_else(|| {
        fault(
            "clock",
            format!(
                "{} Hz: the largest divider, {}, leaves {} Hz",
                rounded(wished, 6),
                grouped(apci1710::divider(u16::MAX).into()),
                rounded(slowest, 4)
            ),
        )
    })?;
    let base = given.number("base") as u64;
    if !base.is_multiple_of(STEP) {
        return Err(fault(
            "base",
            format!("0x{base:X}: the address of registers of 32 bits is a multiple of {STEP}"),
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

    let divided = Answer::of("frq", "FRQ", frq.into(), 6, "").note(format!(
        "divides the PCI clock by {}, {}",
        grouped(divider.into()),
        "for the highest clock that is not above the one wished"
    ));
    let clock = Answer::of("real-clock", "The clock that results", real / 1e3, 6, "kHz");
    let apart = match (real / wished - 1.0) * 100.0 {
        // What is left of a division that goes out even.
        apart if apart.abs() < 1e-6 => 0.0,
        apart => apart,
    };
    let converts = match control {
        0 => "no word is converted",
        _ => {
            "Linux's driver counts one clock more than the article for words that are converted: where the last bit is missing, write COUNTS + 1"
        }
    };
    let mut answers: Vec<Answer> = [
        divided,
        clock,
        Answer::of("difference", "Off the clock wished", apart, 3, "%"),
        limits(real),
        Answer::of("counts", "COUNTS", bits.into(), 4, "")
            .note(format!("{bits} bits, {} clocks", bits + 1)),
        Answer {
            number: Some(control.into()),
            ..Answer::said("control", "CONTROL", format!("0x{control:X}"))
        }
        .note(converts),
        Answer::of("read-time", "A reading", time, 4, "µs")
            .note("the clocks, until D0 of STATUS is 0; then the pause of the encoder"),
    ]
    .into();
    let at = |register: Register| base + u64::from(register.place(module));
    answers.extend(Register::ALL.map(|register| {
        let (name, title) = address_names(register);
        Answer {
            number: Some(at(register) as f64),
            ..Answer::said(name, title, format!("0x{:04X}", at(register)))
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
    let answer = |said: &str| Answer::said("time-out", "Is it fast enough for the time-out", said);
    let (tree, own) = (&ssi_tree::TIMING, &ssi::TIMING);
    match clock {
        clock if clock <= lowest(tree.timeout) => answer("no").tone(Tone::Warn).note(format!(
            "a period must be shorter than t_m, about {} µs: above {} kHz",
            micros(tree.timeout),
            rounded(lowest(tree.timeout) / 1e3, 4)
        )),
        clock if clock <= lowest(tree.silence()).max(lowest(own.silence())) => {
            answer("for most encoders").tone(Tone::Warn).note(format!(
                "t_m is {} ± {} µs, and t_M of MPP and PT {} µs: above {} kHz all keep up",
                micros(tree.timeout),
                micros(tree.timeout - tree.silence()),
                micros(own.silence()),
                rounded(lowest(tree.silence()).max(lowest(own.silence())) / 1e3, 4)
            ))
        }
        _ => answer("yes")
            .tone(Tone::Good)
            .note("a period is shorter than t_m of P+F and t_M of MPP and PT"),
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
        Register::Frq => ("address-frq", "FRQ, write"),
        Register::Status => ("address-status", "STATUS, read"),
        Register::Counts => ("address-counts", "COUNTS, write"),
        Register::Shift(Channel::One) => ("address-shift-1", "SHIFT 1, read"),
        Register::Shift(Channel::Two) => ("address-shift-2", "SHIFT 2, read"),
        Register::Shift(Channel::Three) => ("address-shift-3", "SHIFT 3, read"),
        Register::Start => ("address-start", "START, write"),
        Register::Control => ("address-control", "CONTROL, write"),
        Register::Output => ("address-output", "OUTPUT, write"),
        Register::Identity => ("address-identity", "IDENTITY, read"),
    }
}
