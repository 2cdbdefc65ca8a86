//! The console: link, dial, status, frames.

use crate::{
    adapters,
    app::{App, Source},
    dial::{AngleDigits, Dial},
    profile_editor::{Offer, ProfileEditor},
    setting::SettingPanel,
};
use encoderscope::explain::{grouped, grouped_signed};
use encoderscope_web::{
    message::{Counts, Entry, Lamp, Link, Shown, Snapshot, ToEngine},
    serial::{self, Absent},
};
use leptos::prelude::*;

#[component]
pub(crate) fn Console() -> impl IntoView {
    let app = expect_context::<App>();
    let preview = move || app.source.get() == Source::Preview;
    view! {
        <div class="console">
            {move || preview().then(|| view! { <Welcome /> })}
            {move || (!preview()).then(|| view! { <LinkPanel /> })}
            <Angle />
            <Status />
            {move || (!preview()).then(|| view! { <SettingPanel /> })}
            <Frames />
        </div>
    }
}

/// Why no port can be reached, and what to do.
const fn absent_text(absent: Absent) -> &'static str {
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
fn ConnectButton() -> impl IntoView {
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
fn DemoButton() -> impl IntoView {
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

#[component]
fn LinkPanel() -> impl IntoView {
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

/// Turns the shaft of the built-in encoder by hand.
#[component]
fn DemoShaft() -> impl IntoView {
    let app = expect_context::<App>();
    let speed = RwSignal::new(None::<f64>);
    let turn = move |value: f64| {
        speed.set(Some(value));
        app.send(ToEngine::Turn(value));
    };
    let text = move || match speed.get() {
        None => "swinging".to_owned(),
        Some(0.0) => "standing still".to_owned(),
        Some(speed) => format!("{speed:+.1} rev/s"),
    };
    view! {
        <label class="shaft">
            <span>"Demo shaft " <small>{text}</small></span>
            <input
                type="range"
                min="-2"
                max="2"
                step="0.1"
                data-testid="demo-speed"
                prop:value=move || speed.get().unwrap_or(0.0).to_string()
                on:input:target=move |event| turn(event.target().value().parse().unwrap_or(0.0))
            />
        </label>
        <button class="quiet" data-testid="demo-hold" on:click=move |_| turn(0.0)>"Hold the shaft"</button>
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
        {move || (known() > 0).then(|| view! {
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
            format!("{reason} Close other programs that use it; on Linux your user must be in the group dialout."),
        ),
        Link::Lost => ("The port is gone", "The adapter was unplugged. Plug it in and reconnect.".into()),
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
            <Counted label="in sequences" read=|counts| counts.set />
            <Counted label="line errors" read=|counts| counts.line />
        </dl>
    }
}

/// A number that is only shown when there is something to count.
#[component]
fn Counted(label: &'static str, read: fn(&Counts) -> f64) -> impl IntoView {
    let app = expect_context::<App>();
    let value = Memo::new(move |_| read(&app.snapshot.get().counts));
    move || {
        (value.get() > 0.0).then(|| {
            view! {
                <dt>{label}</dt>
                <dd>{move || grouped(value.get() as u64)}</dd>
            }
        })
    }
}

#[component]
fn Angle() -> impl IntoView {
    let app = expect_context::<App>();
    let shown = Memo::new(move |_| app.snapshot.get().reading);
    let stale = move || shown.get().is_some() && app.snapshot.get().link != Link::Reading;
    let heading = move || match app.source.get() {
        Source::Port => "Angle",
        Source::Demo | Source::Preview => "Demo · angle",
    };
    let counts = move || {
        shown.get().map(|shown| {
            let all = 2f64.powi(shown.angle_bits as i32);
            format!(
                "{} / {} counts",
                grouped(shown.angle as u64),
                grouped(all as u64)
            )
        })
    };
    let row = move |label: &'static str,
                    testid: &'static str,
                    read: fn(&Shown) -> Option<f64>,
                    write: fn(f64) -> String| {
        let value = Memo::new(move |_| shown.get().and_then(|shown| read(&shown)));
        move || {
            value.get().map(|_| {
                let raw = move || value.get().unwrap_or_default();
                view! {
                    <dt>{label}</dt>
                    <dd class=testid data-testid=testid data-value=move || raw().to_string()>
                        {move || write(raw())}
                    </dd>
                }
            })
        }
    };
    view! {
        <section class="panel angle" class:stale=stale>
            <Dial degrees=Signal::derive(move || shown.get().map(|shown| shown.degrees)) />
            <div class="figures">
                <h2>{heading}</h2>
                <AngleDigits shown=shown />
                <p class="of">{move || counts().unwrap_or_else(|| "no reading yet".into())}</p>
                <dl>
                    {row("turns", "turns", |shown| shown.turns, |turns| grouped_signed(turns as i64))}
                    {row(
                        "unwrapped",
                        "unwrapped",
                        |shown| shown.turns.map(|turns| turns.mul_add(360.0, shown.degrees)),
                        |degrees| format!("{degrees:.3}°"),
                    )}
                    {row("speed", "speed", |shown| shown.speed, |speed| format!("{speed:.1} rev/s"))}
                    {row("temperature", "temperature", |shown| shown.temperature, |temperature| format!("{temperature:.1} °C"))}
                </dl>
                {move || stale().then(|| view! { <p class="hint">"last reading before the link stopped"</p> })}
            </div>
        </section>
    }
}

/// Colour of the encoder's own LED (MPP and PT, "LED").
fn led(shown: &Shown) -> (&'static str, &'static str) {
    match (shown.error, shown.warning) {
        (true, _) => ("bad", "red: the position is not valid"),
        (false, true) => (
            "warn",
            "yellow: the position is valid, something is near its limit",
        ),
        (false, false) => ("good", "green"),
    }
}

#[component]
fn Status() -> impl IntoView {
    let app = expect_context::<App>();
    let shown = Memo::new(move |_| app.snapshot.get().reading);
    let lamps = Memo::new(move |_| app.snapshot.get().lamps);
    let value = move || shown.get().and_then(|shown| shown.status);
    view! {
        <section class="panel status" data-testid="status" data-value=move || value().map(|status| status.to_string())>
            <h2>"Status"</h2>
            <ul>
                {move || shown.get().map(|shown| {
                    let (tone, text) = led(&shown);
                    view! {
                        <li class=format!("lamp {tone}")>
                            <span>"Encoder LED"</span>
                            <span class="when">{text}</span>
                        </li>
                    }
                })}
                {move || lamps.get().into_iter().map(|lamp| view! { <LampRow lamp=lamp /> }).collect_view()}
            </ul>
            {move || (shown.get().is_some() && lamps.get().is_empty()).then(|| view! {
                <p class="hint">"These frames carry no status bits."</p>
            })}
            {move || shown.get().is_none().then(|| view! { <p class="hint">"Shown with the first good frame."</p> })}
        </section>
    }
}

#[component]
fn LampRow(lamp: Lamp) -> impl IntoView {
    let when = match (lamp.now, lamp.seen > 0.0) {
        (true, _) => "now".into(),
        (false, true) => format!("in {} frames", grouped(lamp.seen as u64)),
        (false, false) => "never".into(),
    };
    view! {
        <li class=if lamp.now { "lamp warn" } else { "lamp off" } data-now=lamp.now.to_string()>
            <span>
                {lamp.name}
                {lamp.now.then(|| view! { <small>{lamp.doc}</small> })}
            </span>
            <span class="when">{when}</span>
        </li>
    }
}

#[component]
fn Frames() -> impl IntoView {
    let app = expect_context::<App>();
    let log = Memo::new(move |_| app.snapshot.get().log);
    view! {
        <section class="panel frames">
            <h2>"Frames"</h2>
            <table>
                <thead>
                    <tr>
                        <th>"time"</th>
                        <th>"bytes"</th>
                        <th>"check"</th>
                    </tr>
                </thead>
                <tbody>
                    {move || log.get().into_iter().map(|entry| view! { <EntryRow entry=entry /> }).collect_view()}
                </tbody>
            </table>
        </section>
    }
}

#[component]
fn EntryRow(entry: Entry) -> impl IntoView {
    let bytes = entry.bytes.into_iter().map(|(byte, class)| {
        view! { <span class=format!("byte {class}")>{format!("{byte:02X}")}</span> }
    });
    view! {
        <tr data-testid="frame-row" data-ok=entry.ok.to_string()>
            <td class="time">{format!("{:.4}", entry.time)}</td>
            <td class="bytes">{bytes.collect_view()}</td>
            <td class=if entry.ok { "verdict good" } else { "verdict bad" }>
                {if entry.ok { "✓".into() } else { entry.text }}
            </td>
        </tr>
    }
}
