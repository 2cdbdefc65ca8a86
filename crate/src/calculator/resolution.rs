//! Bits, counts, degrees, seconds of arc, and millimetres at a radius.

use super::{
    Answer, Calculator, Fault, Given, Input, Outcome, Tone, Word,
    quantity::{Measure, shown},
};
use crate::{
    bits::codes,
    language::{msg, number, t},
    text,
};

const BITS: Word = Word {
    name: "bits",
    title: msg("bits per turn"),
};
const COUNTS: Word = Word {
    name: "counts",
    title: msg("counts per turn"),
};
const DEGREES: Word = Word {
    name: "degrees",
    title: msg("degrees per count"),
};
const ARC: Word = Word {
    name: "arc-seconds",
    title: msg("seconds of arc per count"),
};
const LENGTH: Word = Word {
    name: "length",
    title: msg("µm per count at the radius"),
};

const SECONDS: f64 = 360.0 * 3600.0;
/// The finest that a format of the manuals can say, and more than any encoder has.
const MOST: f64 = codes(48) as f64;

pub(super) const RESOLUTION: Calculator = Calculator {
    name: "resolution",
    title: msg("Resolution"),
    about: msg(
        "Bits, counts, degrees, seconds of arc and micrometres at a radius, and what the accuracy leaves of them.",
    ),
    source: msg("IP-75, table 1; MPP and PT, characteristics"),
    inputs: &[
        Input::word(
            "given",
            msg("What is known"),
            msg("any one of them gives the others"),
            &[BITS, COUNTS, DEGREES, ARC, LENGTH],
            "bits",
        ),
        Input::number(
            "value",
            msg("How much"),
            msg("a number alone, of what is chosen above"),
            (Measure::Fraction, ""),
            (0.0, MOST),
            "24",
        ),
        Input::number(
            "radius",
            msg("Radius"),
            msg("from the axis to the point that moves"),
            (Measure::Length, "mm"),
            (0.001, 1e6),
            "50",
        ),
        Input::number(
            "accuracy",
            msg("Accuracy, ±"),
            msg("MPP and PT ±0.01°, IP-75 720″"),
            (Measure::Angle, "°"),
            (0.0, 360.0),
            "0.01",
        ),
    ],
    work,
};

fn work(given: &Given) -> Result<Outcome, Fault> {
    let value = given.number("value");
    let radius = given.number("radius");
    let accuracy = given.number("accuracy");
    let around = 2.0 * core::f64::consts::PI * radius * 1e3;
    let fault = |message: alloc::string::String| Fault {
        input: "value",
        message,
    };
    let counts = match given.word("given") {
        "bits" if value > 48.0 || value != f64::from(value as u32) => {
            return Err(fault(text!(
                "{} bits: a width is a whole number up to 48",
                number(value)
            )));
        }
        "bits" => codes(value as u32) as f64,
        "counts" => value,
        _ if value <= 0.0 => {
            return Err(fault(t("a count of no size does not divide a turn").into()));
        }
        "degrees" => 360.0 / value,
        "arc-seconds" => SECONDS / value,
        _ => around / value,
    };
    if counts < 1.0 {
        return Err(fault(t("a turn has less than one such count").into()));
    }
    if counts > MOST {
        return Err(fault(
            t("a turn has more counts than 48 bits can say").into(),
        ));
    }
    // Manuals print steps in few digits: those of 14 bits as 79.1″.
    let rounding = match given.word("given") {
        "bits" | "counts" => 0.0,
        _ => 1e-3,
    };
    let enough = |bits: &u32| codes(*bits) as f64 * (1.0 + rounding) >= counts;
    let bits = (0..=48).find(enough).unwrap_or(48);
    let all = codes(bits) as f64;
    let apart = (all / counts - 1.0).abs();
    let step = 360.0 / counts;
    let width = Answer::of("bits", t("Bits per turn"), bits.into(), 2, "bits");
    let all = shown(all, 15);
    let width = match apart {
        0.0 => width,
        apart if apart <= rounding => width.note(text!("{} counts, as it was rounded", all)),
        _ => width.note(text!(
            "the next width above: {} bits have {} counts",
            bits,
            all
        )),
    };
    let within = accuracy / step;
    let trust = Answer::of(
        "counts-within-accuracy",
        t("Counts in ± the accuracy"),
        within,
        4,
        "counts",
    );
    let trust = match within > 1.0 {
        true => trust.tone(Tone::Warn).note(t(
            "the last digits repeat well and tell small movements, but not the true angle",
        )),
        false => trust
            .tone(Tone::Good)
            .note(t("the resolution is the limit, not the accuracy")),
    };
    Ok(Outcome::of([
        width,
        Answer::of("counts", t("Counts per turn"), counts, 15, ""),
        Answer::of("degrees", t("Degrees per count"), step, 6, "°"),
        Answer::of(
            "arc-seconds",
            t("Seconds of arc per count"),
            SECONDS / counts,
            6,
            "″",
        ),
        Answer::of(
            "length",
            t("Way per count at the radius"),
            around / counts,
            4,
            "µm",
        ),
        Answer::of(
            "accuracy-length",
            t("Accuracy at the radius, ±"),
            accuracy / 360.0 * around,
            4,
            "µm",
        ),
        trust,
    ]))
}
