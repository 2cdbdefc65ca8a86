//! The connection doctor: a ladder of states, each with its evidence, and what to try next.

use crate::{
    app::{App, Source, summary},
    ports::{AllTheSame, Obstacle},
};
use encoderscope::{
    adapter::{LATENCY, LEAST_LATENCY, Made},
    decode::Decoder,
    explain::grouped,
    format::{Format, Link as Way},
    language::{number, t},
    product::{Interface, Series},
    profile::Profile,
    text,
};
use encoderscope_web::{
    link,
    message::{Link, Snapshot},
    serial,
};
use leptos::prelude::*;

/// How a rung of the ladder stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tone {
    Good,
    Warn,
    Bad,
    /// Not reached.
    Idle,
}

impl Tone {
    const fn name(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Warn => "warn",
            Self::Bad => "bad",
            Self::Idle => "idle",
        }
    }

    const fn sign(self) -> &'static str {
        match self {
            Self::Good => "✓",
            Self::Warn => "!",
            Self::Bad => "✗",
            Self::Idle => "·",
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Rung {
    name: &'static str,
    title: &'static str,
    tone: Tone,
    evidence: String,
}

/// How many rungs a state has climbed, and whether it fails on the next one.
const fn height(link: &Link) -> (usize, bool) {
    match link {
        Link::Closed | Link::Opening => (0, false),
        Link::Unfit { .. } | Link::Refused { .. } | Link::Lost => (0, true),
        Link::Waiting | Link::Searching => (1, false),
        Link::Silent { .. } => (1, true),
        Link::Garbage => (2, true),
        Link::Failing => (3, true),
        Link::OtherProfile { .. } | Link::Unasked { .. } => (4, true),
        Link::Reading => (5, false),
    }
}

fn ladder(app: App) -> Vec<Rung> {
    let snapshot = app.snapshot.get();
    let profile = app.profile.get();
    let (height, fails) = match obstacle(app) {
        Some(_) => (0, true),
        None => height(&snapshot.link),
    };
    let total = snapshot.counts.good + snapshot.counts.bad;
    let percent = snapshot.error_rate.map_or(0.0, |rate| rate * 100.0);
    let baud = match app.source.get() {
        Source::Port => baud_text(app, &profile),
        _ => (Tone::Good, t("the built-in encoder").into()),
    };
    let talks = profile.link() == Way::Stream;
    let rungs = [
        ("port", t("Port open"), baud.1),
        (
            "answer",
            if talks {
                t("Encoder talks")
            } else {
                t("Encoder answers")
            },
            answer_text(&snapshot),
        ),
        (
            "frames",
            t("Frames stand out"),
            rate_text(&snapshot, &profile),
        ),
        (
            "checks",
            t("Checks hold"),
            match total > 0.0 {
                true => text!(
                    "{} of {}, {} % errors{}",
                    grouped(snapshot.counts.good as u64),
                    grouped(total as u64),
                    number(format_args!("{percent:.1}")),
                    match profile.format {
                        Format::Asi4 => t("; ASI4 has no checksum: a disturbed digit goes unseen"),
                        _ => "",
                    }
                ),
                false => String::new(),
            },
        ),
        (
            "reading",
            t("Reading"),
            match height {
                5 => text!("{} frames/s", grouped(snapshot.rate as u64)),
                _ => String::new(),
            },
        ),
    ];
    let rungs = rungs.into_iter().enumerate();
    rungs
        .map(|(index, (name, title, evidence))| {
            let tone = match index {
                _ if index == height && fails => Tone::Bad,
                0 if height > 0 => baud.0,
                3 if height > 3 && percent > 1.0 => Tone::Warn,
                _ if index < height => Tone::Good,
                _ => Tone::Idle,
            };
            let evidence = if index <= height {
                evidence
            } else {
                String::new()
            };
            Rung {
                name,
                title,
                tone,
                evidence,
            }
        })
        .collect()
}

/// The ladder, and what the page says of the link, a line each.
pub(crate) fn findings(app: App) -> Vec<String> {
    let link = app.snapshot.with(|snapshot| snapshot.link.clone());
    let said = match obstacle(app) {
        Some(obstacle) => (t("No port"), obstacle.text()),
        None => link_text(&link, app),
    };
    let said = format!("{}. {}", said.0, said.1);
    let rungs = ladder(app).into_iter();
    let rungs = rungs.map(|rung| format!("{} {}: {}", rung.tone.sign(), rung.title, rung.evidence));
    [said].into_iter().chain(rungs).collect()
}

/// What stands in the way of the port that the user wants.
fn obstacle(app: App) -> Option<Obstacle> {
    let wanted = app.source.get() == Source::Port || app.obstacle.get().is_some();
    wanted
        .then(|| Obstacle::of_browser().or_else(|| app.obstacle.get()))
        .flatten()
}

/// A baud rate in few digits.
fn short(rate: f64) -> String {
    match rate {
        1e6.. => text!("{} M", number(format_args!("{:.3}", rate / 1e6))),
        _ => grouped(rate.round() as u64),
    }
}

/// What the adapter makes of the baud rate.
fn baud_text(app: App, profile: &Profile) -> (Tone, String) {
    let asked = grouped(profile.baud.into());
    let made = app.port.get().map(|port| serial::made(port, profile.baud));
    match made {
        Some(Made::Rate(rate)) if (rate - f64::from(profile.baud)).abs() >= 1.0 => {
            (Tone::Good, text!("{} asked, {} made", asked, short(rate)))
        }
        Some(Made::Not(rate)) => (
            Tone::Warn,
            text!(
                "{} asked, which this chip does not make; its driver takes about {}",
                asked,
                short(rate)
            ),
        ),
        Some(Made::Rate(_) | Made::Listed | Made::Unknown) | None => {
            (Tone::Good, text!("{} baud", asked))
        }
    }
}

fn answer_text(snapshot: &Snapshot) -> String {
    let two = |latency: f64| number(format_args!("{latency:.2}")).to_string();
    let latency = snapshot.latency.map(|latency| text!("{} ms", two(latency)));
    let p99 = snapshot.latency_p99;
    let p99 = p99.map(|latency| text!("p99 {} ms", two(latency)));
    let echo = (snapshot.echo == Some(true)).then(|| t("the adapter echoes requests").into());
    // An adapter that holds bytes back cuts replies in two.
    let gap = snapshot
        .gap
        .filter(|gap| *gap >= 1.0 && snapshot.latency.is_some())
        .map(|gap| {
            text!(
                "pauses of {} ms within replies",
                number(format_args!("{gap:.1}"))
            )
        });
    let parts = [latency, p99, echo, gap];
    parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
}

/// Bytes a second, against what the rate can carry and the encoder should send.
fn rate_text(snapshot: &Snapshot, profile: &Profile) -> String {
    let Some(seen) = snapshot.byte_rate else {
        return String::new();
    };
    let most = f64::from(profile.baud) / 10.0;
    let text = text!("{} bytes/s", grouped(seen as u64));
    if seen > most * 1.05 {
        return text!(
            "{}, more than {} baud carry: the adapter runs faster than asked",
            text,
            grouped(profile.baud.into())
        );
    }
    let due = due_bytes(profile).filter(|_| seen > 0.0);
    // ASI1 may come without pauses as well (IP-75, 5.3.1), which is all that the rate carries.
    let why = match (due, &snapshot.link) {
        (Some(due), Link::Reading) if seen < due * 0.9 => t("bytes are lost on the way"),
        (Some(due), Link::Garbage) if seen < due * 0.9 || seen > most.max(due * 1.1) => {
            t("one side runs at another baud rate")
        }
        _ => return text,
    };
    text!(
        "{}, {} are due: {}",
        text,
        grouped(due.unwrap_or(0.0) as u64),
        why
    )
}

/// Bytes a second that a stream has by its manual; lines of digits have no fixed length.
fn due_bytes(profile: &Profile) -> Option<f64> {
    let interval = profile.format.interval()?;
    let decoder = Decoder::new(*profile).ok()?;
    let bytes = decoder.main_layout().len / 8;
    (profile.format != Format::Asi4).then(|| bytes as f64 * 1e6 / interval as f64)
}

/// What the state of the link is called, and what to try next.
fn link_text(link: &Link, app: App) -> (&'static str, String) {
    let (title, hint) = match link {
        Link::Closed => (t("Not connected"), ""),
        Link::Opening => (t("Opening the port"), ""),
        Link::Waiting => (t("Port open"), t("No answer yet.")),
        Link::Searching => (t("Searching"), t("Only requests that read are sent.")),
        Link::Reading => return (t("Reading"), app.snapshot.with(slow_text)),
        Link::Silent { echo: false } => (
            t("No answer"),
            t(
                "Nothing comes back. Check the supply, swap A and B, check the baud rate and the \
               order code, or let the page find the encoder.",
            ),
        ),
        Link::Silent { echo: true } => (
            t("Only the echo of the requests"),
            t("The adapter works, the encoder does not answer. Check its supply, swap A and B."),
        ),
        Link::Garbage => (
            t("Bytes, but no frames"),
            t(
                "Check the baud rate and the order code, swap A and B, add the terminator; or let \
               the page find the encoder.",
            ),
        ),
        Link::Failing => (
            t("Frames, but no check holds"),
            t(
                "The line is disturbed: check terminator, shield and supply, and that the adapter \
               makes this baud rate.",
            ),
        ),
        Link::OtherProfile { .. } => (
            t("Another encoder than in the settings"),
            t("The frames are good with the profile below; the order code says which is right."),
        ),
        Link::Unasked { .. } => (
            t("The encoder talks without being asked"),
            t("It is a free-running model: choose PERIOD, ASI1 or ASI4 in the encoder settings."),
        ),
        Link::Unfit { reason, .. } => {
            return (t("This profile has no serial line"), format!("{reason}."));
        }
        Link::Refused { reason, hint } => {
            let title = t("The port could not be opened");
            let said = [reason, hint].map(|part| t(part)).join(" ");
            return (title, said.trim().to_owned());
        }
        Link::Lost => (
            t("The port is gone"),
            t(
                "The adapter was unplugged, or the permission for it withdrawn. Plug it in and \
               reconnect.",
            ),
        ),
    };
    (title, hint.into())
}

/// Whether replies come as late as FTDI adapters hold short ones unless told otherwise.
fn is_held(snapshot: &Snapshot) -> bool {
    let held = LATENCY - 2.0..LATENCY + 4.0;
    snapshot
        .latency
        .is_some_and(|latency| held.contains(&latency))
}

fn slow_text(snapshot: &Snapshot) -> String {
    match is_held(snapshot) {
        true => text!(
            "Replies are held for {} ms: set the adapter's latency timer to {} ms.",
            LATENCY,
            LEAST_LATENCY
        ),
        false => String::new(),
    }
}

/// The page of the reference that helps with what the link is now.
fn help(app: App, obstacle: Option<&Obstacle>) -> Option<(String, &'static str)> {
    let profile = app.profile.get();
    let adapters = || format!("#/reference?page=adapters&rate={}", profile.baud);
    let wiring = || {
        let speaks = |known: &Interface| known.format() == profile.format;
        let interface = Interface::ALL.into_iter().find(speaks)?;
        let comes_with = |known: &Series| known.interfaces().contains(&interface);
        let series = Series::ALL.into_iter().find(comes_with)?;
        let (series, interface) = (series.key(), interface.key());
        let page = format!("#/reference?page=wiring&series={series}&interface={interface}");
        Some((page, t("Which wire goes where")))
    };
    app.snapshot
        .with(|snapshot| match (obstacle, &snapshot.link) {
            (Some(Obstacle::RateNotMade(_)), _) => {
                Some((adapters(), t("Adapters that make this rate")))
            }
            (None, Link::Silent { .. } | Link::Garbage) => wiring(),
            (None, Link::Refused { .. }) => Some((adapters(), t("What must be allowed"))),
            (None, Link::Reading) if is_held(snapshot) => Some((adapters(), t("How to set it"))),
            _ => None,
        })
}

/// The ladder, and the state in words.
#[component]
pub(crate) fn LinkState() -> impl IntoView {
    let app = expect_context::<App>();
    let link = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.link.clone()));
    let rungs = Memo::new(move |_| ladder(app));
    let obstacle = Memo::new(move |_| obstacle(app));
    let fails = Memo::new(move |_| obstacle.get().is_some() || height(&link.get()).1);
    let help = Memo::new(move |_| help(app, obstacle.get().as_ref()));
    let name = move || {
        let obstacle = obstacle.get();
        obstacle.map_or_else(|| link.get().name(), |obstacle| obstacle.name())
    };
    let text = Memo::new(move |_| match obstacle.get() {
        Some(obstacle) => (t("No port").to_owned(), obstacle.text()),
        None => {
            let (title, hint) = link_text(&link.get(), app);
            (title.to_owned(), hint)
        }
    });
    let other = move || match link.get() {
        Link::OtherProfile { profile } => Some(profile),
        Link::Unasked { profile } => profile,
        _ => None,
    };
    view! {
        <div class="state" data-testid="link-state" data-value=name role="status">
            <p class=move || if fails.get() { "lamp bad" } else { "named" }>{move || text.get().0}</p>
            {move || Some(text.get().1).filter(|hint| !hint.is_empty()).map(|hint| view! {
                <p class="hint" role=obstacle.get().map(|_| "alert")>{hint}</p>
            })}
            {move || help.get().map(|(href, text)| view! {
                <p class="help"><a data-testid="link-help" href=href>{text}</a></p>
            })}
        </div>
        <AllTheSame />
        {move || other().and_then(|text| link::profile(&text).ok()).map(|profile| view! {
            <p class="suggestion" data-testid="suggestion" data-value=link::query(&profile)>
                <span>{summary(&profile)}</span>
                <button on:click=move |_| app.read_as(profile)>{t("Read it so")}</button>
            </p>
        })}
        <ol class="ladder" aria-label=t("Link")>
            {move || rungs.get().into_iter().map(|rung| view! {
                <li class=format!("rung {}", rung.tone.name()) data-testid="rung" data-name=rung.name data-value=rung.tone.name()>
                    <span class="sign" aria-hidden="true">{rung.tone.sign()}</span>
                    <span><b>{rung.title}</b> " " <small>{rung.evidence}</small></span>
                </li>
            }).collect_view()}
        </ol>
    }
}
