//! The console: what is on it, and its first view.

use crate::{
    app::{App, Source},
    devices::DevicesPanel,
    finder::{FindButton, SearchPanel},
    link_panel::LinkPanel,
    live::{Angle, Status},
    log::Frames,
    plot::PlotPanel,
    profile_editor::{Offer, ProfileEditor},
    setting::SettingPanel,
    standstill::Standstill,
    zero_wire::ZeroWire,
};
use encoderscope_web::{
    message::Link,
    serial::{self, Absent},
};
use leptos::prelude::*;

#[component]
pub(crate) fn Console() -> impl IntoView {
    let app = expect_context::<App>();
    let preview = move || app.source.get() == Source::Preview;
    view! {
        <div class="console">
            {move || match preview() {
                true => view! { <Welcome /> }.into_any(),
                false => view! { <LinkPanel /> }.into_any(),
            }}
            <div class="stage">
                {move || (!preview()).then(|| view! { <SearchPanel /> })}
                <Angle />
                <div class="side">
                    <Status />
                    {move || (!preview()).then(|| view! { <SettingPanel /> <ZeroWire /> })}
                </div>
                {move || (!preview()).then(|| view! { <DevicesPanel /> })}
                {move || (!preview()).then(|| view! { <div class="plots"><PlotPanel /><Standstill /></div> })}
                <Frames />
            </div>
        </div>
    }
}

/// Why no port can be reached, and what to do.
pub(crate) const fn absent_text(absent: Absent) -> &'static str {
    match absent {
        Absent::Insecure => {
            "This page came over plain http, where browsers give no access to serial ports. \
             Open it over https or from localhost. The demo and the decoder work here."
        }
        Absent::NoApi => {
            "This browser has no Web Serial. Chrome, Edge or another Chromium browser on a \
             computer can read the encoder. The demo and the decoder work here."
        }
    }
}

#[component]
pub(crate) fn ConnectButton() -> impl IntoView {
    let app = expect_context::<App>();
    let absent = serial::available().err();
    let label = move || match app.snapshot.get().link {
        Link::Lost | Link::Refused { .. } if app.source.get() == Source::Port => "Reconnect",
        _ => "Connect an encoder",
    };
    view! {
        <button class="primary" data-testid="connect" disabled=absent.is_some() on:click=move |_| app.connect()>
            {label}
        </button>
    }
}

#[component]
pub(crate) fn DemoButton() -> impl IntoView {
    let app = expect_context::<App>();
    view! {
        <button data-testid="demo" on:click=move |_| app.demo(Source::Demo)>
            "Try the demo"
        </button>
    }
}

/// The first view: what this is, and three doors.
#[component]
fn Welcome() -> impl IntoView {
    let app = expect_context::<App>();
    view! {
        <section class="panel welcome">
            <h1>"Reads absolute encoders in the browser"</h1>
            <p class="lead">
                "T485, RS485, RS422, BUS, PERIOD and ASI live over a USB adapter; SSI and BiSS-C "
                "from a pasted dump. No installation, and nothing leaves this device."
            </p>
            <div class="doors">
                <ConnectButton />
                <DemoButton />
                {serial::available().is_ok().then(|| view! { <FindButton /> })}
                <a class="button" href="#/decode">"Paste a dump"</a>
            </div>
            {serial::available().err().map(|absent| view! {
                <p class="notice" data-testid="link-state" data-value="no-serial">{absent_text(absent)}</p>
            })}
            {move || app.notice.get().map(|notice| view! { <p class="fault" role="alert">{notice}</p> })}
            <details>
                <summary>"Encoder settings"</summary>
                <ProfileEditor offer=Offer::Serial />
            </details>
        </section>
    }
}
