//! Find it for me: what was tried, what was found, and how sure that is.

use crate::app::{App, summary};
use encoderscope::{explain::grouped, format::Format, language::t, profile::Profile, text};
use encoderscope_web::{
    link,
    message::{Found, Link, Search, SearchStage, Trial},
};
use leptos::prelude::*;

#[component]
pub(crate) fn FindButton() -> impl IntoView {
    let app = expect_context::<App>();
    let searching = move || {
        app.snapshot
            .with(|snapshot| snapshot.link == Link::Searching)
    };
    view! {
        <button data-testid="find" disabled=searching on:click=move |_| app.find()>{t("Find it for me")}</button>
    }
}

/// What a trial was, and what came of it.
fn trial_text(trial: &Trial) -> String {
    if !trial.tried {
        let baud = grouped(trial.baud.into());
        return text!("{} baud · left out: this adapter does not make it", baud);
    }
    let title = |name: &String| Format::parse(name).map_or("", Format::title);
    let what = match &trial.format {
        None => t("listened").into(),
        Some(name) => text!("{}, asked {} ×", title(name), trial.requests),
    };
    let came = match trial.bytes {
        0.0 => t("silent").into(),
        bytes => text!("{} {0|byte|bytes}", grouped(bytes as u64)),
    };
    text!("{} baud · {} · {}", grouped(trial.baud.into()), what, came)
}

/// The search, while it runs and afterwards.
#[component]
pub(crate) fn SearchPanel() -> impl IntoView {
    let app = expect_context::<App>();
    let search = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.search.clone()));
    move || {
        search.get().map(|search| {
            let Search { trials, found, stage } = search;
            let done = stage != SearchStage::Running;
            let verdict = match (stage, found.is_empty()) {
                (SearchStage::Running, _) => {
                    t("Listening and asking, with requests that only read.")
                }
                (_, false) => t("Found:"),
                (SearchStage::BrokenOff, true) => t("The search was broken off."),
                (SearchStage::Ended, true) => {
                    t(
                        "Nothing was found. Check the supply and the wiring, swap A and B, and that the \
                         adapter makes 2 500 000 baud.",
                    )
                }
            };
            view! {
                <section class="panel search" data-testid="search" data-done=done.to_string()>
                    <h2>{t("Find it for me")}</h2>
                    <p class="hint">{verdict}</p>
                    {found.into_iter().map(|found| view! { <FoundCard found=found /> }).collect_view()}
                    <details open=!done>
                        <summary>{t("What was tried")}</summary>
                        <ul class="trials">
                            {trials.iter().map(|trial| view! { <li>{trial_text(trial)}</li> }).collect_view()}
                        </ul>
                    </details>
                </section>
            }
        })
    }
}

#[component]
fn FoundCard(found: Found) -> impl IntoView {
    let app = expect_context::<App>();
    let Ok(profile) = link::profile(&found.profile) else {
        return ().into_any();
    };
    let widest = profile.angle_bits;
    let bits = RwSignal::new(widest);
    let chosen = move || Profile {
        angle_bits: bits.get(),
        ..profile
    };
    let open = found.narrowest < widest;
    view! {
        <article class="found" data-testid="found" data-value=found.profile.clone() data-verdict=found.verdict.clone()>
            <p class="name"><span>{move || summary(&chosen())}</span> <span class=format!("verdict {}", found.verdict)>{t(&found.verdict).to_owned()}</span></p>
            <ul>{found.evidence.into_iter().map(|line| view! { <li>{line}</li> }).collect_view()}</ul>
            <div class="doors">
                <button class="primary" data-testid="read-found" on:click=move |_| app.read_as(chosen())>{t("Read it")}</button>
                {open.then(|| view! {
                    <label>
                        {t("Bits per turn")}
                        <select name="found-bits" on:change:target=move |event| bits.set(event.target().value().parse().unwrap_or(widest))>
                            {(found.narrowest..=widest).rev().map(|width| view! { <option value=width>{width}</option> }).collect_view()}
                        </select>
                    </label>
                })}
            </div>
        </article>
    }
    .into_any()
}
