//! How fast an encoder can be clocked over a cable, and how often it is read then.

mod answers;

use super::{
    Answer, Calculator, Fault, Given, Input, Outcome, Word,
    quantity::{Measure, shown},
};
use crate::{
    decode::Decoder,
    format::{Format, timing::Timing},
    language::{msg, t},
    layout::{Resolved, Shape},
    profile::Profile,
    text,
};
use answers::{cycle, shift, table, window};

const SSI_TREE: Word = Word {
    name: "ssi-tree",
    title: msg("SSI of Pepperl+Fuchs"),
};
const SSI: Word = Word {
    name: "ssi",
    title: msg("SSI of MPP and PT"),
};
const SSI7: Word = Word {
    name: "ssi7",
    title: msg("SSI7 of IP-75"),
};
const BISS_C: Word = Word {
    name: "biss-c",
    title: msg("BiSS-C of MPP and PT"),
};

pub(super) const SSI_LINE: Calculator = Calculator {
    name: "ssi-line",
    title: msg("SSI line"),
    about: msg(
        "How late the data come over a cable, which clock that allows, and how often the encoder is read with it.",
    ),
    source: msg(
        "P+F article, table 2, figure 2 and APCI-1710; IP-75, 5.4.1; MPP and PT, SSI and BiSS-C timing",
    ),
    inputs: &[
        Input::number(
            "length",
            msg("Cable"),
            msg("from the controller to the encoder"),
            (Measure::Length, "m"),
            (0.0, 10_000.0),
            "200",
        ),
        Input::number(
            "wire-delay",
            msg("Delay of the cable"),
            msg("of each metre; 6.5 ns/m in the article, and no cable is faster than light"),
            (Measure::Delay, "ns/m"),
            (3.336, 100.0),
            "6.5",
        ),
        Input::number(
            "encoder-delay",
            msg("Delay of the encoder"),
            msg("of its electronics, T_e; at most 150 ns in the article"),
            (Measure::Time, "ns"),
            (0.0, 1e5),
            "150",
        ),
        Input::number(
            "receiver-delay",
            msg("Delay of the receiver"),
            msg("T_r; at most 150 ns in the article"),
            (Measure::Time, "ns"),
            (0.0, 1e5),
            "150",
        ),
        Input::number(
            "clock",
            msg("Clock wished"),
            msg("of the controller"),
            (Measure::Frequency, "kHz"),
            (0.001, 100_000.0),
            "125",
        ),
        Input::word(
            "format",
            msg("Format"),
            msg("decides which clocks and pauses are allowed"),
            &[SSI_TREE, SSI, SSI7, BISS_C],
            "ssi-tree",
        ),
        Input::number(
            "bits",
            msg("Bits of the word"),
            msg(
                "25 or 13 of P+F, X + 24 or X + 8 of MPP and PT SSI, 30 of SSI7; of BiSS-C from the acknowledge to the CRC, X + 37 or X + 21",
            ),
            (Measure::Bits, "bits"),
            (1.0, 256.0),
            "25",
        ),
    ],
    work,
};

/// What has been entered, in nanoseconds and kilohertz.
struct Line {
    format: Format,
    timing: &'static Timing,
    length: f64,
    delay: f64,
    clock: f64,
}

impl Line {
    /// How late the data come at a clock, in degrees of its period.
    fn phase(&self, clock: f64) -> f64 {
        self.delay * clock * 360.0 / 1e6
    }

    /// Period of the clock, in microseconds.
    fn period(&self) -> f64 {
        1e3 / self.clock
    }
}

fn work(given: &Given) -> Result<Outcome, Fault> {
    let chosen = Format::parse(given.word("format"));
    let Some((format, timing)) = chosen.and_then(|format| Some((format, format.timing()?))) else {
        return Err(Fault {
            input: "format",
            message: t("no master clocks this format out").into(),
        });
    };
    let bits = given.number("bits");
    let (least, most) = word_limits(format);
    if bits < least || bits > most {
        return Err(Fault {
            input: "bits",
            message: text!(
                "{} bits: a word of {} has {}…{}",
                bits,
                t(format.title()),
                least,
                most
            ),
        });
    }
    let length = given.number("length");
    let wire = given.number("wire-delay") * length;
    let (encoder, receiver) = (
        given.number("encoder-delay"),
        given.number("receiver-delay"),
    );
    let line = Line {
        format,
        timing,
        length,
        delay: encoder + 2.0 * wire + receiver,
        clock: given.number("clock"),
    };
    let sum = text!(
        "T_e + 2 · T_c + T_r = {} + 2 · {} + {} ns: clock out, data back",
        shown(encoder, 6),
        shown(wire, 6),
        shown(receiver, 6)
    );
    let delay = Answer::of("delay", t("Delay of the line"), line.delay, 6, "ns").note(sum);
    let answers = [delay]
        .into_iter()
        .chain(shift(&line))
        .chain(table(&line))
        .chain(window(&line))
        .chain(cycle(&line, bits));
    Ok(Outcome::of(answers.collect::<alloc::vec::Vec<_>>()))
}

/// The shortest and the longest word of a format, in bits.
fn word_limits(format: Format) -> (f64, f64) {
    let limits = format.limits();
    let base = format.default_profile();
    if limits.frame.1 > 0 {
        return (limits.frame.0.into(), limits.frame.1.into());
    }
    let len = |profile: Profile| {
        let whole = Decoder::new(profile).ok();
        whole.map_or(0, |decoder| {
            let shape = Shape {
                idle: 0,
                ..Shape::of(profile)
            };
            Resolved::new(decoder.main_layout().layout, shape).len
        })
    };
    let ends = |name| base.range(name).unwrap_or((0, 0));
    let (status, ack) = (ends("status-bits"), ends("ack-bits"));
    let least = Profile {
        angle_bits: 1,
        turns_bits: 0,
        status_bits: status.0,
        ack_bits: ack.0,
        ..base
    };
    let most = Profile {
        angle_bits: limits.angle.min(limits.together),
        turns_bits: limits.together.saturating_sub(limits.angle),
        status_bits: status.1,
        ack_bits: ack.1,
        ..base
    };
    (len(least) as f64, len(most) as f64)
}
