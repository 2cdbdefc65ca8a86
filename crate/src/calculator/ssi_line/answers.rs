//! What is answered about a line: how late its data come, which clocks fit, and how often the
//! encoder is read.

use super::Line;
use crate::{
    calculator::{Answer, Tone, quantity::shown},
    explain::grouped,
    format::{
        Format, biss_c,
        timing::{Beyond, MICROSECOND, Positions},
    },
    language::t,
    text,
};
use alloc::{format, string::String};

/// Lengths in metres, and the highest clock in kilohertz up to each (P+F article, table 2).
const TABLE: [(f64, f64); 4] = [
    (50.0, 400.0),
    (100.0, 300.0),
    (200.0, 200.0),
    (400.0, 100.0),
];

/// Up to here the data come a quarter of a period late: what table 2 promises.
const SAFE: f64 = 90.0;
/// From here on the receiver takes the wrong bits (P+F article, long lines).
const WRONG: f64 = 180.0;

/// What the delay makes of the clock.
pub(super) fn shift(line: &Line) -> [Answer; 4] {
    let phase = line.phase(line.clock);
    let (tone, said, why) = match phase {
        phase if phase < SAFE => (Tone::Good, t("safe"), t("less than a quarter of a period")),
        phase if phase < WRONG => (
            Tone::Warn,
            t("works, with no margin"),
            t("more than a quarter of a period, less than half of one"),
        ),
        _ => (
            Tone::Bad,
            t("wrong bits"),
            t(
                "each bit comes when the next one is read, by a controller that reads half a period behind the edge, as in the article",
            ),
        ),
    };
    let highest = |name, title: &str, degrees: f64| match line.delay {
        delay if delay > 0.0 => Answer::of(name, title, degrees / 360.0 * 1e6 / delay, 4, "kHz"),
        _ => Answer::worded(name, title, t("any: there is no delay")),
    };
    [
        Answer::of("phase", t("Phase shift of the clock wished"), phase, 4, "°")
            .note(t("the delay in periods of the clock, times 360°"))
            .tone(tone),
        Answer::worded("verdict", t("So the clock wished is"), said)
            .note(why)
            .tone(tone),
        highest("clock-safe", t("Highest clock for 90°"), SAFE)
            .note(t("one period is four delays")),
        highest("clock-edge", t("Highest clock for 180°"), WRONG)
            .note(t("one period is two delays: nothing may become slower")),
    ]
}

/// What the P+F article says of the same length, and where it is at odds with itself.
pub(super) fn table(line: &Line) -> [Answer; 4] {
    let row = TABLE.iter().find(|(length, _)| line.length <= *length);
    let half = 1e6 / line.clock / 2.0;
    let sum = line.delay + half;
    let second = Answer::of("second-sum", t("Delay and half a period"), sum, 4, "ns").note(text!("the article's second sum, {} + {}: the data leave the encoder half a period behind the edge that latched", shown(line.delay, 6), shown(half, 4)));
    let rate = Answer::of("second-sum-clock", t("The clock of that sum"), 1e6 / sum, 4, "kHz").note(
        t("the article clocks 200 m with 300 kHz, though this sum gives about 220 kHz there and its table 200 kHz: erratum 24"),
    );
    let (clock, phase) = match row {
        None => (
            Answer::worded("table-clock", t("Highest clock of table 2"), t("none")).note(t(
                "table 2 of the P+F article ends at 400 m; the formula above goes on",
            )),
            Answer::worded("table-phase", t("Phase shift of that clock"), t("none")),
        ),
        Some(&(length, clock)) => {
            let shift = line.phase(clock);
            let edge = match line.length == length {
                true => {
                    t("; the row says “less than”, and the article itself takes it for its 200 m")
                }
                false => "",
            };
            let (tone, note) = match shift {
                shift if shift < SAFE => (Tone::Good, t("less than 90°, as the table promises")),
                shift if shift < WRONG => (
                    Tone::Warn,
                    t(
                        "the table promises less than 90°; its own formula, with all delays, says this",
                    ),
                ),
                _ => (
                    Tone::Bad,
                    t(
                        "the table promises less than 90°; by its own formula, with all delays, the bits would be wrong",
                    ),
                ),
            };
            (
                Answer::of(
                    "table-clock",
                    t("Highest clock of table 2"),
                    clock,
                    4,
                    "kHz",
                )
                .note(text!("P+F article, the row to {} m{}", length, edge)),
                Answer::of("table-phase", t("Phase shift of that clock"), shift, 4, "°")
                    .note(note)
                    .tone(tone),
            )
        }
    };
    [clock, phase, second, rate]
}

/// Which clocks the format allows, and whether the one wished is among them.
pub(super) fn window(line: &Line) -> [Answer; 3] {
    let Line { timing, clock, .. } = line;
    let (timeout, shortest) = (micros(timing.timeout), micros(timing.silence()));
    let beyond = match timing.beyond {
        Beyond::Never => String::new(),
        Beyond::FirstLow { fastest, low } => text!(
            "to {} when the first low lasts {} ns or more",
            hertz(f64::from(fastest)),
            shown(micros(low) * 1e3, 6)
        ),
        Beyond::Compensated { fastest } => text!(
            "to {} when the master compensates the delay of the line",
            hertz(f64::from(fastest))
        ),
    };
    let period = line.period();
    let asked = clock * 1e3;
    let too_long = text!("the period of {} µs is not below", shown(period, 4));
    let (tone, fits, why) = match asked {
        asked if asked > f64::from(timing.limit()) => (
            Tone::Bad,
            t("no"),
            text!("at most {}", hertz(f64::from(timing.limit()))),
        ),
        asked if asked > f64::from(timing.fastest) => {
            (Tone::Warn, t("conditionally"), beyond.clone())
        }
        _ if period >= timeout => (
            Tone::Bad,
            t("no"),
            text!(
                "{} the time-out of {} µs, and the encoder gives up",
                too_long,
                shown(timeout, 4)
            ),
        ),
        asked if asked < f64::from(timing.slowest) => (
            Tone::Warn,
            t("below the manual's range"),
            text!(
                "it begins at {}; by the time-out alone the clock would do",
                hertz(f64::from(timing.slowest))
            ),
        ),
        _ if period >= shortest => (
            Tone::Warn,
            t("for most encoders"),
            text!(
                "{} the shortest time-out, {} µs",
                too_long,
                shown(shortest, 4)
            ),
        ),
        _ => (Tone::Good, t("yes"), String::new()),
    };
    let lowest = Answer::of(
        "timeout-clock",
        t("Lowest clock by the time-out"),
        1e3 / timeout,
        4,
        "kHz",
    );
    let lowest = lowest.note(match shortest < timeout {
        true => text!(
            "{}: the period must be shorter; for the shortest, above {} kHz",
            t(timing.timeout_text),
            shown(1e3 / shortest, 4)
        ),
        false => text!("{}: the period must be shorter", t(timing.timeout_text)),
    });
    [
        Answer::worded(
            "window",
            t("Clocks that the format allows"),
            format!(
                "{}…{}",
                hertz(f64::from(timing.slowest)),
                hertz(f64::from(timing.fastest))
            ),
        )
        .note(match beyond.is_empty() {
            true => t(timing.source).into(),
            false => format!("{}; {beyond}", t(timing.source)),
        }),
        lowest,
        Answer::worded("clock-fits", t("Is the clock wished allowed"), fits)
            .note(why)
            .tone(tone),
    ]
}

/// How long a reading takes, and how often there can be one.
pub(super) fn cycle(line: &Line, bits: f64) -> [Answer; 5] {
    let timing = line.timing;
    // The encoder answers from the first rising edge on, of BiSS-C from the second.
    let (idle, why) = match line.format {
        Format::BissC => (biss_c::IDLE_CLOCKS, t("two more than bits")),
        _ => (1, t("one more than bits: the first latches the position")),
    };
    let clocks = bits + f64::from(idle);
    let reading = (clocks - 0.5) * line.period();
    let pause = micros(timing.pause);
    let rate = 1e6 / (reading + pause);
    let update = Answer::of("rate", t("Readings a second"), rate, 4, "")
        .note(t("1 / (reading + pause), as fast as it goes"));
    let positions = t("New positions a second");
    let fresh = match timing.positions {
        Positions::Unsaid => Answer::worded("positions", positions, t("every reading"))
            .note(t("the article names no limit of the encoder")),
        Positions::MoreThan(own) if rate > f64::from(own) => Answer::worded(
            "positions",
            positions,
            text!("more than {}", grouped(own.into())),
        )
        .note(t("the manual promises that and names no limit")),
        Positions::Of(own) if rate > f64::from(own) => {
            Answer::of("positions", positions, own.into(), 4, "")
                .note(text!(
                    "the encoder is the limit: it takes {} a second, and some are read twice",
                    grouped(own.into())
                ))
                .tone(Tone::Warn)
        }
        Positions::Of(own) | Positions::MoreThan(own) => {
            Answer::of("positions", positions, rate, 4, "").note(text!(
                "the line is the limit: the encoder takes {} a second",
                grouped(own.into())
            ))
        }
    };
    [
        Answer::of("clocks", t("Falling edges"), clocks, 4, "").note(why),
        Answer::of("read-time", t("A reading"), reading, 4, "µs").note(match line.format {
            Format::BissC => t("from the first falling edge on, half a period behind the last one"),
            _ => t("T_rc = n · T + 0.5 · T (IP-75, 5.4.1)"),
        }),
        Answer::of("pause", t("Pause behind it, at least"), pause, 4, "µs")
            .note(t(timing.pause_text)),
        update,
        fresh,
    ]
}

/// Picoseconds in microseconds.
fn micros(picoseconds: i64) -> f64 {
    picoseconds as f64 / MICROSECOND as f64
}

/// A frequency with the unit that suits it.
fn hertz(frequency: f64) -> String {
    match frequency {
        frequency if frequency >= 1e6 => text!("{} MHz", shown(frequency / 1e6, 4)),
        frequency => text!("{} kHz", shown(frequency / 1e3, 4)),
    }
}
