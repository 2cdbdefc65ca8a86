//! How the zero of each product is set.

use super::{
    super::{
        book::{Leaf, filled_link},
        calculator::{CopyLink, sentence},
        choice::{EncoderChoice, chosen},
    },
    Topic,
};
use crate::app::App;
use encoderscope::{
    language::t,
    procedure::{Missing, Procedure, Step, Zero, zero},
};
use encoderscope_web::link::query;
use leptos::prelude::*;

#[component]
pub(super) fn Page() -> impl IntoView {
    let book = expect_context::<App>().book();
    let ways = move || chosen(book).and_then(|(series, interface)| zero(series, interface));
    let wiring = move || {
        let encoder = chosen(book).ok().map(|(series, interface)| {
            let entries = [("series", series.key()), ("interface", interface.key())];
            filled_link(Leaf::Topic(Topic::Wiring), &entries)
        });
        encoder.unwrap_or_else(|| filled_link(Leaf::Topic(Topic::Wiring), &[]))
    };
    view! {
        <section class="part" aria-label=t("Which encoder")>
            <div class="form">
                <EncoderChoice />
            </div>
        </section>
        <div aria-live="polite">
            {move || match ways() {
                Ok(zero) => view! { <Ways zero=zero /> }.into_any(),
                Err(fault) => view! {
                    <p class="fault" data-testid="zero-fault" data-input=fault.input>{sentence(&fault)}</p>
                }.into_any(),
            }}
        </div>
        <p class="ways">
            <a href=wiring>{t("The wires of this encoder")}</a>
        </p>
        <CopyLink />
    }
}

#[component]
fn Ways(zero: Zero) -> impl IntoView {
    let missing = zero.missing.into_iter();
    view! {
        {zero.procedures.into_iter().map(procedure).collect_view()}
        <section class="part" aria-labelledby="missing-title">
            <h2 id="missing-title">{t("What there is not")}</h2>
            <ul class="warnings">{missing.map(missing_item).collect_view()}</ul>
        </section>
    }
}

fn procedure(procedure: Procedure) -> impl IntoView {
    let id = format!("way-{}", procedure.name);
    let console = procedure.console.map(|profile| {
        let text = match procedure.change {
            Some(_) => t("The console does this step by step"),
            None => t("The console watches this and ticks what it sees"),
        };
        view! {
            <p class="ways">
                <a href=format!("#/console?{}", query(&profile)) data-testid="zero-console">{text}</a>
            </p>
        }
    });
    let notes: Vec<_> = procedure
        .notes
        .into_iter()
        .map(|note| view! { <li>{note}</li> })
        .collect();
    view! {
        <section class="part" aria-labelledby=id.clone() data-testid="zero-way" data-name=procedure.name>
            <h2 id=id.clone()>{procedure.title}</h2>
            <p>{procedure.about}</p>
            <ol class="checklist">{procedure.steps.into_iter().map(step).collect_view()}</ol>
            {(!notes.is_empty()).then(|| view! { <ul class="warnings">{notes}</ul> })}
            {console}
        </section>
    }
}

fn step(step: Step) -> impl IntoView {
    let sends = step.sends.iter().flatten();
    let hex: Vec<String> = sends.map(|byte| format!("{byte:02x}")).collect();
    view! {
        <li data-testid="zero-step" data-times=step.times.to_string() data-sends=hex.join(" ")>
            {step.text}
            <span class="expect">"→ " {step.expect}</span>
            <small class="doc">{step.source}</small>
        </li>
    }
}

fn missing_item(missing: Missing) -> impl IntoView {
    view! {
        <li data-testid="zero-missing">
            {missing.text}
            <small class="doc">{missing.source}</small>
        </li>
    }
}
