//! The dial and the angle in digits.

use encoderscope::{explain::degrees_text, language::number};
use encoderscope_web::message::Shown;
use js_sys::Math;
use leptos::prelude::*;

/// A point on a circle around (0, 0); 0° is up, angles run clockwise.
fn point(degrees: f64, radius: f64) -> (f64, f64) {
    // The browser's sine is there already.
    let angle = degrees.to_radians();
    (radius * Math::sin(angle), -radius * Math::cos(angle))
}

/// The dial of an encoder.
#[component]
pub(crate) fn Dial(#[prop(into)] degrees: Signal<Option<f64>>) -> impl IntoView {
    let ticks = (0..72).map(|index| {
        let at = f64::from(index) * 5.0;
        let major = index % 6 == 0;
        let (x1, y1) = point(at, 94.0);
        let (x2, y2) = point(at, if major { 86.0 } else { 90.0 });
        view! { <line class:major=major x1=x1 y1=y1 x2=x2 y2=y2 /> }
    });
    let labels = [0, 90, 180, 270].map(|at| {
        let (x, y) = point(f64::from(at), 74.0);
        view! { <text x=x y=y>{at}</text> }
    });
    let arc = move || {
        let degrees = degrees.get().unwrap_or(0.0);
        let (x, y) = point(degrees, 100.0);
        let large = u8::from(degrees > 180.0);
        format!("M 0 -100 A 100 100 0 {large} 1 {x:.3} {y:.3}")
    };
    let hand = move || format!("rotate({:.3})", degrees.get().unwrap_or(0.0));
    view! {
        <svg class="dial" class:empty=move || degrees.get().is_none() viewBox="-106 -106 212 212" aria-hidden="true">
            <circle class="ring" r="100" />
            <g class="ticks">{ticks.collect_view()}</g>
            <g>{labels.into_view()}</g>
            <path class="arc" d=arc />
            <g class="hand" transform=hand>
                <line y2="-76" />
            </g>
            <circle class="hub" r="5" />
        </svg>
    }
}

/// Digits of an angle: those within the encoder's accuracy of 0.01°, and those beyond.
fn digits(shown: &Shown) -> (String, String) {
    let counts = 2f64.powi(shown.angle_bits as i32);
    let finest = |places: &u32| 360.0 * 10f64.powi(*places as i32) >= counts;
    let places = (0..6).find(finest).unwrap_or(6);
    let text = degrees_text(shown.angle as u64, shown.angle_bits, places);
    let text = number(text).to_string();
    let trusted = text
        .find(['.', ','])
        .map_or(text.len(), |point| (point + 4).min(text.len()));
    (text[..trusted].into(), format!("{}°", &text[trusted..]))
}

/// The angle, large.
#[component]
pub(crate) fn AngleDigits(#[prop(into)] shown: Signal<Option<Shown>>) -> impl IntoView {
    let text = Memo::new(move |_| {
        let none = || (number("–––.–––").to_string(), String::new());
        shown.get().as_ref().map_or_else(none, digits)
    });
    view! {
        <p
            class="digits"
            class:none=move || shown.get().is_none()
            class:invalid=move || shown.get().is_some_and(|shown| shown.error)
            data-testid="angle"
            data-value=move || shown.get().map(|shown| shown.angle.to_string())
        >
            {move || text.with(|text| text.0.clone())}
            <small>{move || text.with(|text| text.1.clone())}</small>
        </p>
    }
}
