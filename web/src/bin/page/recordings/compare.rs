//! Two recordings side by side.

use super::{Recordings, clock_text};
use crate::app::sizes;
use encoderscope::{
    explain::grouped,
    language::{msg, number, t},
    text,
};
use encoderscope_web::{
    link::profile,
    message::{Digest, Lamp},
    plot::Trace,
};
use leptos::prelude::*;

/// Size of the picture, in its own units.
const WIDTH: f64 = 800.0;
const HEIGHT: f64 = 160.0;

#[component]
pub(super) fn Comparison(recordings: Recordings) -> impl IntoView {
    move || {
        recordings.comparison.get().map(|both| {
            let [one, other] = *both;
            let rows = rows(&one).into_iter().zip(rows(&other));
            let rows = rows.map(|((name, left), (_, right))| {
                let differs = left != right;
                view! {
                    <tr class:differs=differs data-testid="compared" data-name=name>
                        <th scope="row">{t(name)}</th>
                        <td class="number">{left}</td>
                        <td class="number">{right}</td>
                    </tr>
                }
            });
            let rows = rows.collect_view();
            let long = one.seconds.max(other.seconds);
            let line = |digest: &Digest| digest.angle.as_ref().map(|trace| points(trace, long));
            view! {
                <table class="comparison" data-testid="comparison">
                    <thead>
                        <tr>
                            <td></td>
                            <th scope="col" class="one">{one.name.clone()}</th>
                            <th scope="col" class="other">{other.name.clone()}</th>
                        </tr>
                    </thead>
                    <tbody>{rows}</tbody>
                </table>
                <svg
                    class="overlay"
                    viewBox=format!("0 0 {WIDTH} {HEIGHT}")
                    role="img"
                    aria-label=t("The angle of both over time")
                >
                    <path class="one" d=line(&one) />
                    <path class="other" d=line(&other) />
                </svg>
                <p class="hint">{text!("The angle, 0 to 360°, over the first {}.", clock_text(long))}</p>
            }
        })
    }
}

/// The encoder that a link names, in a line.
fn encoder(link: &str) -> String {
    profile(link).map_or(link.to_owned(), |profile| {
        format!("{} {}", t(profile.title()), sizes(&profile))
    })
}

/// What a recording comes to, a row each.
fn rows(digest: &Digest) -> Vec<(&'static str, String)> {
    let counts = digest.counts;
    let count = |value: f64| grouped(value as u64);
    let all = counts.good + counts.bad + counts.silent;
    let share = |part: f64| match all > 0.0 {
        true => number(format_args!("{:.3} %", part / all * 100.0)).to_string(),
        false => "–".into(),
    };
    let milliseconds = |value: Option<f64>| {
        let two = |value| text!("{} ms", number(format_args!("{value:.2}")));
        value.map_or("–".into(), two)
    };
    let last = &digest.last;
    let reading = last.reading.map_or("–".into(), |shown| {
        let degrees = number(format!("{:.4}°", shown.degrees));
        match shown.turns {
            Some(turns) => text!("{} {0|turn|turns}, {}", turns, degrees),
            None => degrees.to_string(),
        }
    });
    let lit = |lamp: &&Lamp| lamp.seen > 0.0;
    let lamps: Vec<_> = last
        .lamps
        .iter()
        .filter(lit)
        .map(|lamp| t(&lamp.name))
        .collect();
    vec![
        (msg("length"), clock_text(digest.seconds)),
        (msg("encoder"), encoder(&digest.profile)),
        (msg("adapter"), t(&digest.adapter).to_owned()),
        (msg("good frames"), count(counts.good)),
        (msg("bad frames"), count(counts.bad)),
        (msg("no answer"), count(counts.silent)),
        (msg("errors"), share(counts.bad + counts.silent)),
        (msg("bytes in"), count(counts.bytes)),
        (msg("skipped"), count(counts.skipped)),
        (msg("line errors"), count(counts.line)),
        (
            msg("frames a second"),
            match digest.seconds > 0.0 {
                true => count(counts.good / digest.seconds),
                false => "–".into(),
            },
        ),
        (msg("median reply"), milliseconds(last.latency)),
        (msg("99 of 100 replies"), milliseconds(last.latency_p99)),
        (msg("last reading"), reading),
        (
            msg("status bits seen"),
            match lamps.is_empty() {
                true => t("none").into(),
                false => lamps.join(", "),
            },
        ),
    ]
}

/// The path of the angle over so many seconds, broken where the shaft passes 0.
fn points(trace: &Trace, seconds: f64) -> String {
    let first = trace.times.first().copied().unwrap_or_default();
    let mut path = String::new();
    let mut before = f64::NAN;
    for (time, value) in trace.times.iter().zip(&trace.values) {
        if value.is_nan() {
            before = f64::NAN;
            continue;
        }
        let x = (time - first) / seconds.max(1e-6) * WIDTH;
        let y = HEIGHT * (1.0 - value / 360.0);
        let joined = (value - before).abs() < 180.0;
        path += &format!("{}{x:.1} {y:.1}", if joined { "L" } else { "M" });
        before = *value;
    }
    path
}
