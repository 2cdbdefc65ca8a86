//! The explainer: a frame as bits and fields that can be changed, and everything that follows.

mod bits;
mod exchange;
mod fields;
mod paper;
mod talk;
mod verdict;
mod walk;
mod wave;

use crate::{
    app::{App, Place},
    profile_editor::{Offer, ProfileEditor},
};
use bits::BitRow;
use encoderscope::{
    language::t,
    sketch::{self, Sketch},
    text,
};
use encoderscope_web::link::{Fragment, query};
use exchange::Exchange;
use fields::Fields;
use leptos::prelude::*;
use talk::Talk;
use verdict::Verdict;
use walk::Checks;
use wave::Wave;

#[component]
pub(crate) fn Explain() -> impl IntoView {
    let app = expect_context::<App>();
    let paper = app.paper();
    app.settle(Place {
        follow: Callback::new(move |link: Fragment| {
            app.follow_profile_of(&link);
            paper.follow_link(&link, app.profile.get_untracked());
        }),
        fragment: Signal::derive(move || {
            let profile = query(&app.profile.get());
            format!("#/explain?{profile}{}", paper.fragment())
        }),
    });
    Effect::new(move || paper.follow_profile(app.profile.get()));
    view! {
        <div class="explain">
            <section class="panel frame">
                <Heading />
                <BitRow />
                <Tools />
            </section>
            <Wave />
            <div class="sides">
                <div class="side">
                    <Fields />
                    <Talk />
                    <Errata />
                </div>
                <div class="side">
                    <section class="panel">
                        <h2>{t("Which frame")}</h2>
                        <ProfileEditor offer=Offer::All />
                    </section>
                    <Verdict />
                    <Checks />
                    <Exchange />
                </div>
            </div>
        </div>
    }
}

/// What the frame is, and which others there are.
#[component]
fn Heading() -> impl IntoView {
    let app = expect_context::<App>();
    let paper = app.paper();
    let kinds = Memo::new(move |_| {
        let _ = paper.plan.get();
        let kinds = paper.with(|sketch| sketch.decoder().frame_kinds());
        let names = kinds.unwrap_or_default().into_iter();
        names
            .map(|kind| (kind.name, kind.title))
            .collect::<Vec<_>>()
    });
    let title = move || {
        let (name, count, bytes) = paper
            .plan
            .with(|plan| (plan.kind().to_owned(), plan.cells.len(), plan.bytes));
        let mut kinds = kinds.get().into_iter();
        let title = kinds.find(|known| known.0 == name).map(|known| known.1);
        let order = match bytes {
            true => text!("{} {0|byte|bytes}", count / 8),
            false => text!("{} bits, first on the wire on the left", count),
        };
        view! { {title} <span>{order}</span> }
    };
    let chosen = move || paper.plan.with(|plan| plan.kind().to_owned());
    let choose = move |name: String| paper.choose(app.profile.get_untracked(), &name);
    view! {
        <div class="heading">
            <h2>{title}</h2>
            {move || {
                let kinds = kinds.get();
                (kinds.len() > 1).then(|| view! {
                    <label>
                        <span class="hint">{t("Frame")}</span>
                        <select
                            data-testid="explain-kind"
                            prop:value=chosen
                            on:change:target=move |event| choose(event.target().value())
                        >
                            {kinds.into_iter().map(|(name, title)| {
                                let mine = name.clone();
                                view! {
                                    <option value=name.clone() selected=move || chosen() == mine>
                                        {format!("{} · {title}", kind_title(&name))}
                                    </option>
                                }
                            }).collect_view()}
                        </select>
                    </label>
                })
            }}
        </div>
    }
}

/// The name of a kind of frame for people.
fn kind_title(name: &str) -> String {
    let title = |name: &str| match name {
        "get" => t("get").to_owned(),
        "identity" => t("identity").to_owned(),
        "memory-read" => t("memory read").to_owned(),
        "memory-write" => t("memory write").to_owned(),
        "twice" => t("twice").to_owned(),
        other => t(&other.replace('-', " ")).to_owned(),
    };
    match name.strip_prefix("request-") {
        Some(name) => text!("request {}", title(name)),
        None => title(name),
    }
}

/// What can be done with the frame as a whole.
#[component]
fn Tools() -> impl IntoView {
    let app = expect_context::<App>();
    let paper = app.paper();
    let text = move || {
        let bytes = paper.plan.with(|plan| plan.bytes);
        let text = paper.with(Sketch::text).unwrap_or_default();
        match bytes {
            true => text.to_uppercase(),
            false => text,
        }
    };
    let enter = move |typed: String| paper.take(&typed, app.profile.get_untracked(), None);
    let follow = move || paper.checks.get() == sketch::Checks::Follow;
    let checked = move || {
        paper
            .plan
            .with(|plan| plan.fields.iter().any(|field| field.is_check))
    };
    let again = move |_| {
        let kind = paper.plan.with_untracked(|plan| plan.kind().to_owned());
        paper.choose(app.profile.get_untracked(), &kind);
    };
    view! {
        <div class="tools">
            <label class="whole">
                {t("The whole frame")}
                <input
                    spellcheck="false"
                    autocomplete="off"
                    data-testid="explain-frame"
                    prop:value=text
                    on:change:target=move |event| enter(event.target().value())
                />
            </label>
            {move || checked().then(|| view! {
                <label class="check-box">
                    <input
                        type="checkbox"
                        data-testid="explain-follow"
                        prop:checked=follow
                        on:change=move |_| {
                            paper.checks.update(|checks| *checks = match checks {
                                sketch::Checks::Follow => sketch::Checks::Stay,
                                sketch::Checks::Stay => sketch::Checks::Follow,
                            });
                        }
                    />
                    {t("checks follow what is changed")}
                </label>
                <button data-testid="explain-mend" on:click=move |_| { paper.change(|sketch, _| sketch.mend()); }>
                    {t("Compute the checks")}
                </button>
            })}
            <button data-testid="explain-example" on:click=again>{t("Example again")}</button>
        </div>
        {move || paper.fault.get().map(|fault| view! { <p class="fault" role="alert">{fault}</p> })}
    }
}

/// Where the manuals would lead a reader of this format wrong.
#[component]
fn Errata() -> impl IntoView {
    let app = expect_context::<App>();
    let format = Memo::new(move |_| app.profile.get().format);
    move || {
        let errata: Vec<_> = format.get().errata().collect();
        (!errata.is_empty()).then(|| {
            view! {
                <section class="panel errata">
                    <h2>{t("The manuals are wrong here")}</h2>
                    <ul>
                        {errata.into_iter().map(|erratum| view! {
                            <li data-testid="erratum">
                                <b>{t(erratum.place)}</b>
                                {text!(": “{}”. Right is: {} – {}.", t(erratum.says), t(erratum.right), t(erratum.because))}
                            </li>
                        }).collect_view()}
                    </ul>
                </section>
            }
        })
    }
}
