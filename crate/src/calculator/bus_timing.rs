//! How long a BUS is busy with one device, and how often all of them are read.

use super::{
    Answer, Calculator, Fault, Given, Input, Outcome, Tone, Word,
    quantity::{Measure, shown},
};
use crate::{
    decode::Decoder,
    explain::grouped,
    format::{
        Format,
        bus::{self, Operation},
    },
    language::{msg, t},
    layout::{Resolved, Shape},
    profile::Profile,
    text,
};
use alloc::vec::Vec;

const NONE: Word = Word {
    name: "0",
    title: msg("none"),
};
const EIGHT: Word = Word {
    name: "8",
    title: msg("8 bits, as in the manuals' example 16M1"),
};
const SIXTEEN: Word = Word {
    name: "16",
    title: msg("16 bits, models XXM"),
};

/// What a byte takes on the wire: a start bit, eight bits and a stop bit.
const BYTE: f64 = 10.0;

pub(super) const BUS_TIMING: Calculator = Calculator {
    name: "bus-timing",
    title: msg("BUS timing"),
    about: msg(
        "How long the other devices sleep while one answers, and how often all of them can be asked.",
    ),
    source: msg("MPP and PT, BUS, devices on the bus: T_SUSPEND"),
    inputs: &[
        Input::number(
            "angle-bits",
            msg("Bits per turn"),
            msg("XX of the order code"),
            (Measure::Bits, "bits"),
            (1.0, 24.0),
            "24",
        ),
        Input::word(
            "turns-bits",
            msg("Turn counter"),
            msg("M of the order code"),
            &[SIXTEEN, EIGHT, NONE],
            "16",
        ),
        Input::number(
            "devices",
            msg("Devices"),
            msg("on one pair of wires; an address has five bits"),
            (Measure::Count, ""),
            (1.0, 32.0),
            "4",
        ),
        Input::number(
            "answer-delay",
            msg("Delay of the answer"),
            msg(
                "from the end of the request to the start of the reply; the manuals name none, 3 µs is usual with T485",
            ),
            (Measure::Time, "µs"),
            (0.0, 1e4),
            "3",
        ),
        Input::number(
            "adapter-delay",
            msg("Delay of the adapter"),
            msg(
                "for each question, 0 on the wire itself; an FTDI chip holds short replies for its latency timer, 16 ms or 1 ms where it is set so",
            ),
            (Measure::Time, "ms"),
            (0.0, 1e4),
            "1",
        ),
    ],
    work,
};

fn work(given: &Given) -> Result<Outcome, Fault> {
    let turns = given.word("turns-bits");
    let profile = Profile {
        angle_bits: given.number("angle-bits") as u32,
        turns_bits: turns.parse().unwrap_or(0),
        ..Format::Bus.default_profile()
    };
    Decoder::new(profile).map_err(|error| Fault {
        input: match error.name.as_str() {
            "turns-bits" => "turns-bits",
            _ => "angle-bits",
        },
        message: error.message,
    })?;
    let byte = BYTE * 1e6 / f64::from(profile.baud);
    let devices = given.number("devices");
    let delay = given.number("answer-delay");
    let adapter = given.number("adapter-delay") * 1e3;

    let suspend = bus::suspend(&profile) as f64;
    let reply = Resolved::new(Operation::Get.reply(), Shape::of(profile)).len / 8;
    let reply_time = reply as f64 * byte;
    let answered = delay + reply_time;
    // Of one device alone nobody sleeps.
    let is_asleep = devices > 1.0 && suspend > answered;
    let distance = byte + if is_asleep { suspend } else { answered };
    let asleep = Answer::of(
        "suspend",
        t("Sleep of the others, T_SUSPEND"),
        suspend,
        4,
        "µs",
    );
    let bytes = suspend / byte;
    let asleep = match answered > suspend {
        true => asleep
            .note(text!("{} bytes of {} µs; the reply ends {} µs after the request, so the others wake while it runs and may take its end for a request", shown(bytes, 4), shown(byte, 4), shown(answered, 6)))
            .tone(Tone::Warn),
        false => asleep.note(text!("ceil(XX / 8) + YY / 8 + 4 = {} bytes of {} µs; the reply ends {} µs after the request", shown(bytes, 4), shown(byte, 4), shown(answered, 6))),
    };
    let sent = text!(
        "{} bytes: the request again, status, angle{}, CRC",
        reply,
        if profile.turns_bits > 0 {
            t(", turns")
        } else {
            ""
        }
    );
    let round = devices * distance;
    let mut answers: Vec<Answer> = [
        asleep,
        Answer::of("reply-bytes", t("Reply"), reply as f64, 4, "bytes"),
        Answer::of("reply-time", t("Reply on the wire"), reply_time, 4, "µs").note(sent),
        Answer::of(
            "distance",
            t("From one request to the next, at least"),
            distance,
            5,
            "µs",
        )
        .note(match is_asleep {
            true => t("request and sleep: before that the next device does not hear"),
            false => t("request, delay and reply"),
        }),
        Answer::of("round", t("A round of all devices"), round / 1e3, 5, "ms"),
        Answer::of("rate", t("Positions a second, of each"), 1e6 / round, 4, ""),
        Answer::of("rate-together", t("Of all together"), 1e6 / distance, 4, ""),
    ]
    .into();
    if adapter > 0.0 {
        let slow = devices * (distance + adapter);
        answers.extend([
            Answer::of(
                "adapter-round",
                t("A round through the adapter"),
                slow / 1e3,
                5,
                "ms",
            )
            .note(text!(
                "{} ms more for each of {} questions",
                shown(adapter / 1e3, 6),
                grouped(devices as u64)
            )),
            Answer::of(
                "adapter-rate",
                t("Positions a second through it, of each"),
                1e6 / slow,
                4,
                "",
            ),
            Answer::of(
                "adapter-rate-together",
                t("Of all together, through it"),
                devices * 1e6 / slow,
                4,
                "",
            ),
        ]);
    }
    Ok(Outcome::of(answers))
}
