//! The support file: what the page shows and what was said on the line of late, in one file that
//! shows the same page elsewhere. It carries no names and no addresses.

use super::{Recordings, clock_text, noted, size_text};
use crate::{
    app::{App, Source},
    doctor,
};
use encoderscope::{
    language::{in_english, msg, t},
    text,
};
use encoderscope_web::{
    browser::{property, system, time_text},
    link::query,
    message::{Snapshot, Story, Wish},
    serial,
};
use js_sys::{Array, JSON};
use leptos::prelude::*;
use serde::{Deserialize, Serialize};
use wasm_bindgen::JsValue;

/// Letters of a time, with the space behind it.
const TIME: usize = "2026-01-01 00:00:00 ".len();

/// What stands in front of a support file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct Report {
    /// The version of this page.
    encoderscope: String,
    /// When it was made, UTC.
    made: String,
    browser: String,
    system: String,
    /// The adapter: its chip and USB identity.
    adapter: String,
    /// The profile, as the parameters of a link.
    profile: String,
    /// What the user says of it.
    remark: String,
    /// The ladder of the link, and what the page says of it.
    link: Vec<String>,
    /// The same in the language that is spoken; nothing in a report that was opened.
    #[serde(skip)]
    link_said: Vec<String>,
    /// What happened of late, with its time.
    history: Vec<String>,
    /// What was said on the line of late: how long, in seconds, and how many bytes.
    seconds: f64,
    bytes: f64,
    /// Everything the console shows.
    snapshot: Snapshot,
}

impl Report {
    /// That of a file; what it does not say is left out.
    pub(super) fn parse(text: &str) -> Self {
        let parsed = JSON::parse(text).unwrap_or_default();
        serde_wasm_bindgen::from_value(parsed).unwrap_or_default()
    }

    fn of(app: App, story: &Story, remark: String) -> Self {
        let profile = match app.source.get_untracked() {
            Source::Port => app.profile.get_untracked(),
            _ => app.readable(),
        };
        let adapter = match (app.source.get_untracked(), app.port.get_untracked()) {
            (Source::Port, Some(port)) => serial::kind(port),
            (Source::Port, None) => String::new(),
            (Source::Replay, _) => msg("a recording").into(),
            (Source::Demo | Source::Preview, _) => msg("built-in encoder").into(),
        };
        Self {
            encoderscope: env!("CARGO_PKG_VERSION").into(),
            made: js_sys::Date::new_0().to_iso_string().into(),
            browser: browser(),
            system: system(),
            adapter,
            profile: query(&profile),
            remark,
            link: in_english(|| untrack(|| doctor::findings(app))),
            link_said: untrack(|| doctor::findings(app)),
            history: story
                .happenings
                .iter()
                .map(|(at, text)| format!("{} {text}", time_text(*at)))
                .collect(),
            seconds: story.seconds,
            bytes: story.size,
            snapshot: (*story.snapshot).clone(),
        }
    }

    fn text(&self) -> String {
        let plain = serde_wasm_bindgen::Serializer::json_compatible();
        let value = self.serialize(&plain).unwrap_or_default();
        let space = JsValue::from_f64(1.0);
        JSON::stringify_with_replacer_and_space(&value, &JsValue::NULL, &space)
            .map(String::from)
            .unwrap_or_default()
    }
}

/// The browser and its main version.
fn browser() -> String {
    let navigator = JsValue::from(window().navigator());
    let brands = property(&property(&navigator, "userAgentData"), "brands");
    let brands = Array::from(&brands);
    let named = brands.iter().filter_map(|brand| {
        let name = property(&brand, "brand").as_string()?;
        let version = property(&brand, "version").as_string()?;
        // One of them is there to be ignored.
        (!name.contains("Not")).then(|| format!("{name} {version}"))
    });
    let named: Vec<String> = named.collect();
    if !named.is_empty() {
        return named.join(", ");
    }
    let agent = property(&navigator, "userAgent").as_string();
    let agent = agent.unwrap_or_default();
    // The last word names the browser, in those that say no more.
    agent.rsplit(' ').next().unwrap_or_default().to_owned()
}

/// Makes a support file, which is shown before it is saved.
#[component]
pub(super) fn Handing(recordings: Recordings) -> impl IntoView {
    let app = recordings.app;
    let (wanted, remark) = (recordings.hands, recordings.remark);
    let report = Memo::new(move |_| {
        let story = recordings.story.get()?;
        wanted.get().then(|| Report::of(app, &story, remark.get()))
    });
    let open = move |_| {
        recordings.story.set(None);
        recordings.send(&Wish::Story);
        wanted.set(true);
    };
    view! {
        <button data-testid="report" on:click=open>{t("Support file…")}</button>
        {move || (wanted.get() && recordings.story.with(Option::is_some)).then(|| view! {
            <div class="support" data-testid="report-preview">
                <h3>{t("What goes into the support file")}</h3>
                {move || report.get().map(|report| view! { <Contents report=report /> })}
                <label class="remark">
                    {t("What you saw, in your own words")}
                    <textarea
                        name="remark"
                        prop:value=move || remark.get()
                        on:input:target=move |event| remark.set(event.target().value())
                    />
                </label>
                <p class="hint">
                    {t(
                        "Names of adapters, files and people are not in it, nor any address. Nothing is sent: you save \
                         the file, and hand it to whom you like.",
                    )}
                </p>
                <div class="doors">
                    <button
                        class="primary"
                        data-testid="report-save"
                        on:click=move |_| {
                            if let Some(report) = report.get_untracked() {
                                recordings.send(&Wish::Report(report.text()));
                            }
                        }
                    >
                        {t("Save")}
                    </button>
                    <button class="quiet" on:click=move |_| wanted.set(false)>{t("Close")}</button>
                </div>
            </div>
        })}
    }
}

/// The support file that is open.
#[component]
pub(super) fn Opened(recordings: Recordings) -> impl IntoView {
    move || {
        recordings.opened.get().map(|report| {
            view! {
                <section class="panel support" data-testid="report-opened">
                    <h2>{t("Support file")}</h2>
                    <p>
                        {t(
                            "The console shows what it showed when the file was made. Play replays what was said on \
                             the line before.",
                        )}
                    </p>
                    <Contents report=report />
                </section>
            }
        })
    }
}

#[component]
fn Contents(report: Report) -> impl IntoView {
    let whole = report.text();
    let link = match report.link_said.is_empty() {
        true => report.link,
        false => report.link_said,
    };
    // Behind the time that each line begins with.
    let happened = |line: String| match line.split_at_checked(TIME) {
        Some((time, text)) => [time, &noted(text)].concat(),
        None => line,
    };
    let history = report.history.into_iter().map(happened).collect();
    let lists = [(t("The link"), link), (t("What happened"), history)];
    let rows = [
        (t("Made"), report.made),
        ("Encoderscope", report.encoderscope),
        (t("Browser"), report.browser),
        (t("System"), report.system),
        (t("Adapter"), t(&report.adapter).to_owned()),
        (t("Encoder"), report.profile),
        (t("Remark"), report.remark),
        (
            t("On the line"),
            text!(
                "the last {}, {}",
                clock_text(report.seconds),
                size_text(report.bytes)
            ),
        ),
    ];
    let rows = rows.into_iter().filter(|(_, value)| !value.is_empty());
    view! {
        <dl>
            {rows.map(|(name, value)| view! { <dt>{name}</dt> <dd>{value}</dd> }).collect_view()}
        </dl>
        {lists.map(|(name, lines)| (!lines.is_empty()).then(|| view! {
            <details>
                <summary>{name}</summary>
                <ul class="lines">{lines.into_iter().map(|line| view! { <li>{line}</li> }).collect_view()}</ul>
            </details>
        })).collect_view()}
        <details>
            <summary>{t("Every word of it")}</summary>
            <pre data-testid="report-text">{whole}</pre>
        </details>
    }
}
