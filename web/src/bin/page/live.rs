//! The live view: dial, figures, status.

use crate::{
    app::{App, Source},
    dial::{AngleDigits, Dial},
};
use encoderscope::{
    explain::{grouped, grouped_signed},
    format::blinks,
    lamp::{Health, Light},
    language::{number, t},
    text,
};
use encoderscope_web::message::{Lamp, Link, Shown, Snapshot};
use leptos::prelude::*;

/// Whether what is on the dial comes from an encoder that answers now.
fn is_fresh(snapshot: &Snapshot) -> bool {
    let mut devices = snapshot.devices.iter();
    let own = devices.find(|device| Some(u32::from(device.address)) == snapshot.watched);
    snapshot.link == Link::Reading && own.is_none_or(|device| device.fresh)
}

#[component]
pub(crate) fn Angle() -> impl IntoView {
    let app = expect_context::<App>();
    // All of it from one frame.
    let shown = app.feed.reading;
    let stale = move || shown.get().is_some() && !app.snapshot.with(is_fresh);
    let heading = move || match app.source.get() {
        Source::Port => t("Angle"),
        Source::Replay => t("Recording · angle"),
        Source::Demo | Source::Preview => t("Demo · angle"),
    };
    let counts = move || {
        shown.get().map(|shown| {
            let all = 2f64.powi(shown.angle_bits as i32);
            text!(
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
        let exists = Memo::new(move |_| value.get().is_some());
        move || {
            exists.get().then(|| {
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
                <p class="of">{move || counts().unwrap_or_else(|| t("no reading yet").into())}</p>
                <dl>
                    {row(t("turns"), "turns", |shown| shown.turns, |turns| grouped_signed(turns as i64))}
                    {row(
                        t("unwrapped"),
                        "unwrapped",
                        |shown| shown.turns.map(|turns| turns.mul_add(360.0, shown.degrees)),
                        |degrees| fine(degrees, 1000, "°"),
                    )}
                    {row(
                        t("arc-seconds"),
                        "arc-seconds",
                        |shown| Some(shown.degrees * 3600.0),
                        |seconds| fine(seconds, 10, "″"),
                    )}
                    {row(t("speed"), "speed", |shown| shown.speed, |speed| text!("{} rev/s", number(format_args!("{speed:.1}"))))}
                    <Turning />
                    {row(
                        t("temperature"),
                        "temperature",
                        |shown| shown.temperature,
                        |degrees| number(format_args!("{degrees:.1} °C")).to_string(),
                    )}
                </dl>
                {move || stale().then(|| view! { <p class="hint">{t("last reading before the link stopped")}</p> })}
            </div>
        </section>
    }
}

/// A number with a space between thousands, cut to so many parts of one.
fn fine(value: f64, parts: u64, unit: &str) -> String {
    let sign = if value < 0.0 { "-" } else { "" };
    let all = (value.abs() * parts as f64) as u64;
    let part = (parts + all % parts).to_string();
    number(format_args!(
        "{sign}{}.{}{unit}",
        grouped(all / parts),
        &part[1..]
    ))
    .to_string()
}

/// The speed from the angles, where the frames carry none.
#[component]
fn Turning() -> impl IntoView {
    let app = expect_context::<App>();
    let carried = Memo::new(move |_| {
        let reading = app.snapshot.with(|snapshot| snapshot.reading);
        reading.is_none_or(|shown| shown.speed.is_some())
    });
    let turning = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.turning));
    move || {
        (!carried.get()).then(|| {
            view! {
                <dt>{t("speed, from the angle")}</dt>
                <dd data-testid="turning" data-value=move || turning.get().map(|speed| speed.to_string())>
                    {move || turning.get().map_or_else(|| "–".to_owned(), |speed| text!("{} rev/s", number(format_args!("{speed:.2}"))))}
                </dd>
            }
        })
    }
}

/// Colour of the encoder's own LED.
fn led(shown: &Shown) -> (&'static str, &'static str) {
    let health = Health {
        error: shown.error,
        warning: shown.warning,
        status: 0,
    };
    let light = health.light();
    (tone(light), t(light.meaning()))
}

/// The class of a lamp in a colour.
pub(crate) const fn tone(light: Light) -> &'static str {
    match light {
        Light::Red => "bad",
        Light::Yellow => "warn",
        Light::Green => "good",
        Light::Dark => "off",
    }
}

#[component]
pub(crate) fn Status() -> impl IntoView {
    let app = expect_context::<App>();
    let value = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.reading?.status));
    let led = Memo::new(move |_| {
        app.snapshot.with(|snapshot| {
            let mut lamps = snapshot.lamps.iter();
            let blinking = lamps.any(|lamp| lamp.now && blinks(&lamp.name));
            snapshot.reading.map(|shown| (led(&shown), blinking))
        })
    });
    let lamps = Memo::new(move |_| {
        let rows = |snapshot: &Snapshot| snapshot.lamps.iter().map(lamp_text).collect::<Vec<_>>();
        app.snapshot.with(rows)
    });
    view! {
        <section class="panel status" data-testid="status" data-value=move || value.get().map(|status| status.to_string())>
            <h2>{t("Status")}</h2>
            <ul>
                {move || led.get().map(|((tone, text), blinking)| {
                    let text = if blinking { text!("{}, blinking", text) } else { text.into() };
                    view! {
                        <li class=format!("lamp {tone}") class:blink=blinking data-testid="led">
                            <span>{t("Encoder LED")}</span>
                            <span class="when">{text}</span>
                        </li>
                    }
                })}
                {move || lamps.get().into_iter().map(lamp_row).collect_view()}
            </ul>
            {move || match (led.get(), lamps.with(Vec::is_empty)) {
                (None, _) => Some(t("Shown with the first good frame.")),
                (Some(_), true) => Some(t("These frames carry no status bits.")),
                (Some(_), false) => None,
            }.map(|hint| view! { <p class="hint">{hint}</p> })}
        </section>
    }
}

/// What a status bit shows: changes only when that does.
#[derive(Clone, Debug, PartialEq)]
struct LampText {
    name: String,
    /// What it means, once it has been set.
    doc: Option<String>,
    now: bool,
    when: String,
}

fn lamp_text(lamp: &Lamp) -> LampText {
    LampText {
        name: t(&lamp.name).to_owned(),
        doc: (lamp.seen > 0.0).then(|| t(&lamp.doc).to_owned()),
        now: lamp.now,
        when: match (lamp.now, lamp.seen > 0.0) {
            (true, _) => t("now").into(),
            (false, true) => text!("in {} {0|frame|frames}", grouped(lamp.seen as u64)),
            (false, false) => t("never").into(),
        },
    }
}

fn lamp_row(lamp: LampText) -> impl IntoView {
    view! {
        <li class=if lamp.now { "lamp warn" } else { "lamp off" } data-now=lamp.now.to_string()>
            <span>
                {lamp.name}
                {lamp.doc.map(|doc| view! { <small>{doc}</small> })}
            </span>
            <span class="when">{lamp.when}</span>
        </li>
    }
}
