//! The built-in encoder's knobs.

use crate::app::App;
use encoderscope_web::message::ToEngine;
use leptos::prelude::*;

/// Turns the shaft of the built-in encoder by hand.
#[component]
pub(crate) fn DemoShaft() -> impl IntoView {
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
