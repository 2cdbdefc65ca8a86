//! The built-in encoder's knobs: its shaft, what it reports, and what goes wrong on its line.

use crate::app::App;
use encoderscope::{
    bits,
    format::{Format, STATUS},
    language::{msg, number, t},
    text,
};
use encoderscope_web::message::{Knobs, Wish};
use leptos::prelude::*;

/// How the built-in encoder is set; a new one turns by itself and is well.
#[derive(Clone, Copy)]
struct Demo {
    /// Revolutions per second, once somebody turns it by hand.
    speed: RwSignal<Option<f64>>,
    knobs: RwSignal<Knobs>,
}

impl Demo {
    fn of(app: App) -> Self {
        app.keep(|| {
            let demo = Self {
                speed: RwSignal::new(None),
                knobs: RwSignal::new(Knobs::default()),
            };
            Effect::new(move || {
                app.running.track();
                demo.speed.set(None);
                demo.set(app, &|knobs| *knobs = Knobs::default());
            });
            demo
        })
    }

    fn set(self, app: App, change: &dyn Fn(&mut Knobs)) {
        self.knobs.update(|knobs| change(knobs));
        app.wish(&Wish::Knobs(self.knobs.get_untracked()));
    }
}

#[component]
pub(crate) fn DemoKnobs() -> impl IntoView {
    let app = expect_context::<App>();
    view! {
        <DemoShaft />
        <details class="knobs">
            <summary>{t("Demo status and faults")}</summary>
            <Reports app=app />
        </details>
    }
}

/// Turns the shaft of the built-in encoder by hand.
#[component]
fn DemoShaft() -> impl IntoView {
    let app = expect_context::<App>();
    let speed = Demo::of(app).speed;
    let turn = move |value: f64| {
        speed.set(Some(value));
        app.wish(&Wish::Turn(value));
    };
    let text = move || match speed.get() {
        None => t("swinging").to_owned(),
        Some(0.0) => t("standing still").to_owned(),
        Some(speed) => text!("{} rev/s", number(format_args!("{speed:+.1}"))),
    };
    view! {
        <label class="shaft">
            <span>{t("Demo shaft")} " " <small>{text}</small></span>
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
        <button data-testid="demo-hold" on:click=move |_| turn(0.0)>{t("Hold the shaft")}</button>
    }
}

#[component]
fn Reports(app: App) -> impl IntoView {
    let demo = Demo::of(app);
    let knobs = demo.knobs;
    let set = move |change: &dyn Fn(&mut Knobs)| demo.set(app, change);
    let carries_status = move || !matches!(app.profile.get().format, Format::Asi1 | Format::Asi4);
    let bit = move |place: u32| bits::low_byte(bits::placed(1, place));
    let lamps = move || {
        let lamps = STATUS.iter().map(move |status| {
            let bit = bit(status.place);
            view! {
                <Check
                    name=status.name
                    on=Signal::derive(move || knobs.get().status & bit > 0)
                    change=move |on| set(&|knobs| knobs.status = if on { knobs.status | bit } else { knobs.status & !bit })
                />
            }
        });
        lamps.collect_view()
    };
    view! {
        {move || carries_status().then(lamps)}
        <Check name=msg("error") on=Signal::derive(move || knobs.get().error) change=move |on| set(&|knobs| knobs.error = on) />
        <Check name=msg("warning") on=Signal::derive(move || knobs.get().warning) change=move |on| set(&|knobs| knobs.warning = on) />
        <Check name=msg("silent") on=Signal::derive(move || knobs.get().silent) change=move |on| set(&|knobs| knobs.silent = on) />
        <Check name=msg("echo") on=Signal::derive(move || knobs.get().echo) change=move |on| set(&|knobs| knobs.echo = on) />
        <Slider
            name="noise"
            title=t("Noise of the angle")
            unit=t("counts")
            most=8
            value=Signal::derive(move || knobs.get().noise)
            change=move |counts| set(&|knobs| knobs.noise = counts)
        />
        <Slider
            name="flip"
            title=t("Bytes with a wrong bit")
            unit=t("of 1000")
            most=200
            value=Signal::derive(move || knobs.get().flip)
            change=move |share| set(&|knobs| knobs.flip = share)
        />
        <Slider
            name="lost"
            title=t("Replies lost")
            unit=t("of 1000")
            most=200
            value=Signal::derive(move || knobs.get().lose)
            change=move |share| set(&|knobs| knobs.lose = share)
        />
    }
}

#[component]
fn Check(
    name: &'static str,
    on: Signal<bool>,
    change: impl Fn(bool) + Copy + 'static,
) -> impl IntoView {
    view! {
        <label class="switch">
            <input type="checkbox" name=format!("demo-{name}") prop:checked=on on:change:target=move |event| change(event.target().checked()) />
            {t(name)}
        </label>
    }
}

#[component]
fn Slider(
    name: &'static str,
    title: &'static str,
    unit: &'static str,
    most: u32,
    value: Signal<u32>,
    change: impl Fn(u32) + Copy + 'static,
) -> impl IntoView {
    view! {
        <label class="shaft">
            <span>{title} " " <small>{move || format!("{} {unit}", value.get())}</small></span>
            <input
                type="range"
                min="0"
                max=most.to_string()
                name=format!("demo-{name}")
                prop:value=move || value.get().to_string()
                on:input:target=move |event| change(event.target().value().parse().unwrap_or(0))
            />
        </label>
    }
}
