//! The link: how it is, which port, which encoder, and what has come.

use crate::{
    adapters,
    app::{App, Source},
    console::{ConnectButton, DemoButton},
    demo::DemoKnobs,
    doctor::LinkState,
    finder::FindButton,
    profile_editor::{Offer, ProfileEditor},
    recordings::{RecordButton, ReplayBar},
};
use encoderscope::{
    explain::grouped,
    format::Link as Way,
    language::{number, t},
    text,
};
use encoderscope_web::{
    message::{Counts, Snapshot},
    serial,
};
use leptos::prelude::*;

#[component]
pub(crate) fn LinkPanel() -> impl IntoView {
    let app = expect_context::<App>();
    let open = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.link.is_open()));
    let lives = move || app.source.get() != Source::Replay;
    let polled = move || lives() && app.profile.get().link() == Way::Polled;
    let title = move || match app.source.get() {
        Source::Port => {
            app.ports.track();
            app.port
                .get()
                .map_or_else(|| t("Serial port").into(), adapters::name)
        }
        Source::Demo | Source::Preview => t("Demo encoder").into(),
        Source::Replay => t("Recording").into(),
    };
    view! {
        <section class="panel link">
            <h2>{t("Link")}</h2>
            <p class="name">{title}</p>
            <LinkState />
            <ReplayBar />
            <RecordButton />
            <div class="doors">
                {move || {
                    if open.get() && app.source.get() != Source::Replay {
                        view! { <button data-testid="disconnect" on:click=move |_| app.disconnect()>{t("Disconnect")}</button> }
                            .into_any()
                    } else {
                        view! { <ConnectButton /> }.into_any()
                    }
                }}
                {move || (app.source.get() != Source::Demo || !open.get()).then(|| view! { <DemoButton /> })}
                {move || lives().then(|| view! { <FindButton /> })}
                {move || (open.get() && app.source.get() == Source::Demo).then(|| view! { <ConnectButton /> })}
            </div>
            <PortChooser />
            {move || (open.get() && app.source.get() == Source::Demo).then(|| view! { <DemoKnobs /> })}
            <details>
                <summary>{t("Encoder settings")}</summary>
                <ProfileEditor offer=Offer::Serial />
            </details>
            {move || polled().then(|| view! { <PaceChooser /> })}
            <Counters />
        </section>
    }
}

#[component]
fn PortChooser() -> impl IntoView {
    let app = expect_context::<App>();
    let known = move || app.ports.get().len();
    // Shown as chosen, so that taking another port is a choice.
    let missing = move || {
        let known = app.ports.get();
        app.port
            .get()
            .filter(|port| serial::find(&known, *port).is_none())
    };
    view! {
        {move || (known() > 0 || missing().is_some()).then(|| view! {
            <div class="ports">
                <label>
                    {t("Port")}
                    <select
                        data-testid="port"
                        on:change:target=move |event| {
                            let index = event.target().value().parse::<usize>().unwrap_or(0);
                            if let Some(port) = app.ports.get_untracked().get(index) {
                                app.choose_port(*port);
                            }
                        }
                    >
                        {move || missing().map(|port| view! {
                            <option disabled selected>{adapters::name(port)} {t(" · not plugged in")}</option>
                        })}
                        {app.ports.get().into_iter().enumerate().map(|(index, port)| view! {
                            <option value=index selected=move || app.port.get() == Some(port)>{adapters::name(port)}</option>
                        }).collect_view()}
                    </select>
                </label>
                <button class="quiet" on:click=move |_| leptos::task::spawn_local(app.add_port())>{t("Add…")}</button>
            </div>
        })}
        {move || app.port.get().map(|port| view! {
            <label class="port-name">
                {t("Name of this adapter")}
                <input
                    name="port-name"
                    prop:value=adapters::name(port)
                    on:change:target=move |event| {
                        adapters::rename(port, &event.target().value());
                        app.ports.update(|_| ());
                    }
                />
            </label>
        })}
    }
}

/// A number that a test can read.
#[component]
fn Count(
    label: &'static str,
    #[prop(optional)] testid: &'static str,
    read: fn(&Snapshot) -> f64,
) -> impl IntoView {
    let app = expect_context::<App>();
    let value = Memo::new(move |_| app.snapshot.with(read));
    view! {
        <dt>{label}</dt>
        <dd data-testid=testid data-value=move || value.get().to_string()>
            {move || grouped(value.get() as u64)}
        </dd>
    }
}

#[component]
fn Counters() -> impl IntoView {
    view! {
        <dl class="counts">
            <Count label=t("good frames") testid="frames-ok" read=|snapshot| snapshot.counts.good />
            <Count label=t("bad frames") testid="frames-bad" read=|snapshot| snapshot.counts.bad />
            <ErrorRate />
            <Count label=t("frames a second") testid="rate" read=|snapshot| snapshot.rate />
            <Count label=t("no answer") testid="silent" read=|snapshot| snapshot.counts.silent />
            <Count label=t("bytes in") testid="bytes-in" read=|snapshot| snapshot.counts.bytes />
            <Count label=t("in frames") testid="bytes-framed" read=|snapshot| snapshot.counts.framed />
            <Count label=t("skipped") testid="bytes-skipped" read=|snapshot| snapshot.counts.skipped />
            <Counted label=t("beside reading") testid="bytes-set" read=|counts| counts.set />
            <Counted label=t("line errors") testid="line-errors" read=|counts| counts.line />
        </dl>
    }
}

/// How often the encoder is asked.
#[component]
fn PaceChooser() -> impl IntoView {
    let app = expect_context::<App>();
    let rates = [
        ("0", t("as often as it answers")),
        ("1000", t("1 000 times a second")),
        ("100", t("100 times a second")),
        ("10", t("10 times a second")),
        ("1", t("once a second")),
    ];
    view! {
        <label>
            {t("Asked")}
            <select
                name="pace"
                on:change:target=move |event| app.set_pace(event.target().value().parse().unwrap_or(0.0))
            >
                {rates.map(|(rate, text)| view! {
                    <option value=rate selected=move || app.pace.get().to_string() == rate>{text}</option>
                }).collect_view()}
            </select>
        </label>
    }
}

/// The share of the last replies that were bad or missing.
#[component]
fn ErrorRate() -> impl IntoView {
    let app = expect_context::<App>();
    let rate = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.error_rate));
    view! {
        <dt>{t("errors, last 5 s")}</dt>
        <dd data-testid="error-rate" data-value=move || rate.get().map(|rate| rate.to_string())>
            {move || rate.get().map_or_else(|| "–".to_owned(), |rate| text!("{} %", number(format_args!("{:.1}", rate * 100.0))))}
        </dd>
    }
}

/// A number that is only shown when there is something to count.
#[component]
fn Counted(label: &'static str, testid: &'static str, read: fn(&Counts) -> f64) -> impl IntoView {
    let app = expect_context::<App>();
    let value = Memo::new(move |_| app.snapshot.with(|snapshot| read(&snapshot.counts)));
    move || {
        (value.get() > 0.0).then(|| {
            view! {
                <dt>{label}</dt>
                <dd data-testid=testid data-value=move || value.get().to_string()>
                    {move || grouped(value.get() as u64)}
                </dd>
            }
        })
    }
}
