//! The console: what is on it, and its first view.

use crate::{
    app::{App, Source, in_pieces},
    devices::DevicesPanel,
    finder::{FindButton, SearchPanel},
    link_panel::LinkPanel,
    live::{Angle, Status},
    log::Frames,
    parts::{self, coming, later},
    plot::PlotPanel,
    ports::Obstacle,
    recordings::{Recordings, RecordingsPanel},
    setting::SettingPanel,
    standstill::Standstill,
    zero_wire::ZeroWire,
};
use encoderscope::language::t;
use encoderscope_web::{message::Link, serial};
use leptos::prelude::*;

#[component]
pub(crate) fn Console() -> impl IntoView {
    let app = expect_context::<App>();
    let preview = Memo::new(move |_| app.source.get() == Source::Preview);
    view! {
        <div class="console">
            {move || app.feed.parcels.get().then(|| later(parts::remains, || ()))}
            {move || match preview.get() {
                true => view! { <Preview /> }.into_any(),
                false => later(parts::live, Preview).into_any(),
            }}
        </div>
    }
}

/// The first view: three doors, and what is behind them in small.
#[component]
fn Preview() -> impl IntoView {
    let [angle, status, frames] = in_pieces();
    view! {
        <Welcome />
        <div class="stage">
            {move || angle.get().then(|| view! { <Angle /> })}
            <div class="side">{move || status.get().then(|| view! { <Status /> })}</div>
            {move || frames.get().then(|| view! { <Frames /> })}
        </div>
    }
}

/// What is shown of an encoder that is read.
#[component]
pub(crate) fn Live() -> impl IntoView {
    let app = expect_context::<App>();
    // From now on answers are heard.
    Recordings::of(app);
    // A recording cannot be changed.
    let lives = Memo::new(move |_| app.source.get() != Source::Replay);
    view! {
        <LinkPanel />
        <div class="stage">
            <SearchPanel />
            <div class="centre">
                <Angle />
                <DevicesPanel />
                <PlotPanel />
            </div>
            <div class="side">
                <Status />
                {move || lives.get().then(|| view! { <SettingPanel /> <ZeroWire /> })}
                <Standstill />
            </div>
            <Frames />
            <RecordingsPanel />
        </div>
    }
}

#[component]
pub(crate) fn ConnectButton() -> impl IntoView {
    let app = expect_context::<App>();
    let absent = serial::available().err();
    let label = move || match app.snapshot.with(|snapshot| snapshot.link.clone()) {
        Link::Lost | Link::Refused { .. } if app.source.get() == Source::Port => t("Reconnect"),
        _ => t("Connect an encoder"),
    };
    view! {
        <button class="primary" data-testid="connect" disabled=move || absent.is_some() || app.reads_link.get() on:click=move |_| app.connect()>
            {label}
        </button>
    }
}

#[component]
pub(crate) fn DemoButton() -> impl IntoView {
    let app = expect_context::<App>();
    view! {
        <button data-testid="demo" disabled=move || app.reads_link.get() on:click=move |_| app.demo(Source::Demo)>
            {t("Try the demo")}
        </button>
    }
}

/// What stands in the way of a port.
#[component]
fn ObstacleNote() -> impl IntoView {
    let app = expect_context::<App>();
    let obstacle = move || Obstacle::of_browser().or_else(|| app.obstacle.get());
    move || {
        obstacle().map(|obstacle| {
            view! {
                <p class="notice" role="alert" data-testid="link-state" data-value=obstacle.name()>
                    {obstacle.text()}
                </p>
            }
        })
    }
}

/// The first view: what this is, and three doors.
#[component]
fn Welcome() -> impl IntoView {
    let opened = RwSignal::new(false);
    view! {
        <section class="panel welcome">
            <h1>{t("Reads absolute encoders in the browser")}</h1>
            <p class="lead">
                {t(
                    "T485, RS485, RS422, BUS, PERIOD and ASI live over a USB adapter; SSI and BiSS-C from a \
                     pasted dump. No installation, and nothing leaves this device.",
                )}
            </p>
            <div class="doors">
                <ConnectButton />
                <DemoButton />
                {serial::available().is_ok().then(|| view! { <FindButton /> })}
                <a class="button" href="#/decode">{t("Paste a dump")}</a>
            </div>
            <ObstacleNote />
            <details on:toggle=move |_| opened.set(true)>
                <summary>{t("Encoder settings")}</summary>
                {move || opened.get().then(|| later(parts::settings, coming))}
            </details>
        </section>
    }
}
