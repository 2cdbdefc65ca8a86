//! The link: how it is, which port, which encoder, and what has come.

use crate::{
    adapters,
    app::{App, Source},
    console::{ConnectButton, DemoButton, absent_text},
    demo::DemoShaft,
    profile_editor::{Offer, ProfileEditor},
};
use encoderscope::explain::grouped;
use encoderscope_web::{
    message::{Counts, Link, Snapshot},
    serial,
};
use leptos::prelude::*;

#[component]
pub(crate) fn LinkPanel() -> impl IntoView {
    let app = expect_context::<App>();
    let link = Memo::new(move |_| app.snapshot.get().link);
    let open = Memo::new(move |_| link.get().is_open());
    let title = move || match app.source.get() {
        Source::Port => {
            app.ports.track();
            app.port.get().map_or("Serial port".into(), adapters::name)
        }
        Source::Demo | Source::Preview => "Demo encoder".into(),
    };
    view! {
        <section class="panel link">
            <h2>"Link"</h2>
            <p class="name">{title}</p>
            <LinkState link=link />
            {move || app.notice.get().map(|notice| view! { <p class="fault" role="alert">{notice}</p> })}
            {serial::available().err().map(|absent| view! { <p class="notice">{absent_text(absent)}</p> })}
            <div class="doors">
                {move || {
                    if open.get() {
                        view! { <button data-testid="disconnect" on:click=move |_| app.disconnect()>"Disconnect"</button> }
                            .into_any()
                    } else {
                        view! { <ConnectButton /> }.into_any()
                    }
                }}
                {move || (app.source.get() == Source::Port).then(|| view! { <DemoButton /> })}
                {move || (open.get() && app.source.get() == Source::Demo).then(|| view! { <ConnectButton /> })}
            </div>
            <PortChooser />
            {move || (open.get() && app.source.get() == Source::Demo).then(|| view! { <DemoShaft /> })}
            <details>
                <summary>"Encoder settings"</summary>
                <ProfileEditor offer=Offer::Serial />
            </details>
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
                    "Port"
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
                            <option disabled selected>{adapters::name(port)} " · not plugged in"</option>
                        })}
                        {app.ports.get().into_iter().enumerate().map(|(index, port)| view! {
                            <option value=index selected=move || app.port.get() == Some(port)>{adapters::name(port)}</option>
                        }).collect_view()}
                    </select>
                </label>
                <button class="quiet" on:click=move |_| leptos::task::spawn_local(app.add_port())>"Add…"</button>
            </div>
        })}
        {move || app.port.get().map(|port| view! {
            <label class="port-name">
                "Name of this adapter"
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

/// What the state of the link is called, and what to do about it.
fn link_text(link: &Link) -> (&'static str, String) {
    match link {
        Link::Closed => ("Not connected", String::new()),
        Link::Opening => ("Opening the port", String::new()),
        Link::Waiting => ("Port open", "no answer yet".into()),
        Link::Reading => ("Reading", String::new()),
        Link::Silent { echo: false } => (
            "No answer",
            "Nothing comes back. Check the supply, swap A and B, check the baud rate and the order code.".into(),
        ),
        Link::Silent { echo: true } => (
            "Only the echo of the requests",
            "The adapter works, the encoder does not answer. Check its supply, swap A and B.".into(),
        ),
        Link::Failing => (
            "Answers, but no check holds",
            "Check the baud rate and the terminator, and that format and bits are those of the order code.".into(),
        ),
        Link::Unasked => (
            "The encoder talks without being asked",
            "It is a free-running model: choose PERIOD, ASI1 or ASI4 in the encoder settings.".into(),
        ),
        Link::Unfit { reason } => ("This profile has no serial line", format!("{reason}.")),
        Link::Refused { reason } => (
            "The port could not be opened",
            reason.clone(),
        ),
        Link::Lost => (
            "The port is gone",
            "The adapter was unplugged, or the permission for it withdrawn. Plug it in and reconnect.".into(),
        ),
    }
}

#[component]
fn LinkState(link: Memo<Link>) -> impl IntoView {
    let app = expect_context::<App>();
    let tone = move || match link.get() {
        Link::Reading => "good",
        Link::Closed | Link::Opening | Link::Waiting => "idle",
        _ => "bad",
    };
    let evidence = move || {
        let snapshot = app.snapshot.get();
        if link.get() != Link::Reading {
            return String::new();
        }
        let latency = snapshot.latency.map(|latency| format!("{latency:.2} ms"));
        let p99 = snapshot
            .latency_p99
            .map(|latency| format!("p99 {latency:.2} ms"));
        let echo = (snapshot.echo == Some(true)).then(|| "the adapter echoes requests".into());
        [latency, p99, echo]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join(" · ")
    };
    view! {
        <div class="state" data-testid="link-state" data-value=move || link.get().name() role="status">
            <p class=move || format!("lamp {}", tone())>{move || link_text(&link.get()).0}</p>
            <p class="hint">{move || link_text(&link.get()).1}</p>
        </div>
        <p class="hint evidence">{evidence}</p>
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
    let value = Memo::new(move |_| read(&app.snapshot.get()));
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
            <Count label="good frames" testid="frames-ok" read=|snapshot| snapshot.counts.good />
            <Count label="bad frames" testid="frames-bad" read=|snapshot| snapshot.counts.bad />
            <Count label="frames a second" testid="rate" read=|snapshot| snapshot.rate />
            <Count label="no answer" testid="silent" read=|snapshot| snapshot.counts.silent />
            <Count label="bytes in" testid="bytes-in" read=|snapshot| snapshot.counts.bytes />
            <Count label="in frames" testid="bytes-framed" read=|snapshot| snapshot.counts.framed />
            <Count label="skipped" testid="bytes-skipped" read=|snapshot| snapshot.counts.skipped />
            <Counted label="in sequences" testid="bytes-set" read=|counts| counts.set />
            <Counted label="line errors" testid="line-errors" read=|counts| counts.line />
        </dl>
    }
}

/// A number that is only shown when there is something to count.
#[component]
fn Counted(label: &'static str, testid: &'static str, read: fn(&Counts) -> f64) -> impl IntoView {
    let app = expect_context::<App>();
    let value = Memo::new(move |_| read(&app.snapshot.get().counts));
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
