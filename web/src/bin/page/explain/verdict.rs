//! What the other side makes of the frame.

use crate::app::App;
use encoderscope::{
    explain::{degrees_text, grouped_signed},
    language::{number, t},
    record::hex,
    sketch::{Heard, Sketch},
    text,
};
use leptos::prelude::*;

#[component]
pub(super) fn Verdict() -> impl IntoView {
    let app = expect_context::<App>();
    let paper = app.paper();
    let heard = Memo::new(move |_| paper.with(Sketch::heard));
    let refused = |faults: Vec<String>| {
        view! {
            <p class="bad"><b>{t("A receiver refuses it.")}</b></p>
            <ul>{faults.into_iter().map(|fault| view! { <li>{fault}</li> }).collect_view()}</ul>
        }
        .into_any()
    };
    let said = move || {
        match heard.get() {
        None => ().into_any(),
        Some(Heard::Reading(reading)) => {
            let turns = reading
                .turns
                .map(|turns| text!("{} {0|turn|turns} and ", grouped_signed(turns)));
            let angle = number(degrees_text(reading.angle, reading.angle_bits, 4)).to_string();
            let error = reading
                .error
                .then(|| t("; but the encoder itself says that this position is not valid"));
            let warning = reading.warning.then(|| t("; the encoder warns"));
            view! {
                <p>
                    <b class="good">{t("A receiver takes it: ")}</b>
                    {turns} {angle} "°" {error} {warning} "."
                </p>
            }
            .into_any()
        }
        Some(Heard::Good) => {
            view! { <p><b class="good">{t("A receiver takes it: ")}</b> {t("every check holds.")}</p> }
                .into_any()
        }
        Some(Heard::Faults(faults)) => {
            refused(faults.iter().map(|fault| fault.kind.to_string()).collect())
        }
        Some(Heard::NoFrame(why)) => refused(vec![text!("It is taken for no frame: {}.", why)]),
        Some(Heard::Silence) => {
            view! { <p class="bad"><b>{t("No encoder of this profile answers.")}</b></p> }.into_any()
        }
        Some(Heard::Answer(answer)) => {
            let text = hex(&answer);
            let shown = answer
                .iter()
                .map(|byte| format!("{byte:02X}"))
                .collect::<Vec<_>>();
            let open = move |_| paper.take(&text, app.profile.get_untracked(), None);
            view! {
                <p>
                    <b class="good">{t("An encoder answers: ")}</b>
                    <code>{shown.join(" ")}</code>
                    " "
                    <button class="quiet" data-testid="explain-answer" on:click=open>{t("look at it")}</button>
                </p>
            }
            .into_any()
        }
    }
    };
    let name = move || match heard.get() {
        Some(Heard::Reading(_) | Heard::Good) => "taken",
        Some(Heard::Faults(_)) => "refused",
        Some(Heard::NoFrame(_)) => "no-frame",
        Some(Heard::Answer(_)) => "answered",
        Some(Heard::Silence) => "silence",
        None => "",
    };
    view! {
        <section class="panel verdict" role="status" data-testid="explain-verdict" data-value=name>
            <h2>{t("What the other side makes of it")}</h2>
            {said}
        </section>
    }
}
