//! Where the manuals would lead a reader wrong.

use super::{
    Part,
    book::{Mark, Section, errata_link, link},
};
use crate::app::App;
use encoderscope::{
    errata::{ERRATA, Erratum},
    language::t,
    profile::Profile,
    text,
};
use leptos::prelude::*;

/// Those of a format.
#[component]
pub(super) fn Of(profile: Profile) -> impl IntoView {
    let all: Vec<_> = profile
        .format
        .errata()
        .map(|erratum| {
            let href = link(&profile, Some(&Mark::Erratum(erratum.number)));
            item(erratum, href)
        })
        .collect();
    view! {
        <Part profile=profile section=Section::Errata>
            <ol class="errors">{all}</ol>
        </Part>
    }
}

/// All of them, those of no format too.
#[component]
pub(super) fn All() -> impl IntoView {
    let all: Vec<_> = ERRATA
        .iter()
        .map(|erratum| item(erratum, errata_link(Some(erratum.number))))
        .collect();
    let count = ERRATA.len();
    view! {
        <article class="sheet" data-testid="reference-errata">
            <header class="head">
                <h1>{t("Errors in the manuals")}</h1>
                <p class="about">
                    {text!("{} places where the manuals contradict themselves, or the wire, and the reading that was chosen.", count)}
                </p>
            </header>
            <ol class="errors">{all}</ol>
        </article>
    }
}

fn item(erratum: &'static Erratum, href: String) -> impl IntoView {
    let book = expect_context::<App>().book();
    let mark = Mark::Erratum(erratum.number);
    let id = mark.id();
    let formats: Vec<_> = erratum
        .formats
        .iter()
        .map(|format| {
            let href = link(&format.default_profile(), None);
            view! { " " <a href=href>{t(format.title())}</a> }
        })
        .collect();
    let marked = move || book.is_marked(&mark);
    let current = marked.clone();
    view! {
        <li
            id=id
            tabindex="-1"
            class:marked=marked
            aria-current=move || current().then_some("true")
            data-testid="erratum"
            data-value=erratum.number
        >
            <a class="number" href=href aria-label=text!("Erratum {}", erratum.number)>{erratum.number}</a>
            <p class="place"><b>{t(erratum.place)}</b> {formats}</p>
            <p class="wrong"><span class="tag">{t("it says")}</span> <q>{t(erratum.says)}</q></p>
            <p class="right"><span class="tag">{t("right is")}</span> {t(erratum.right)}</p>
            <p class="why"><span class="tag">{t("because")}</span> {t(erratum.because)}</p>
        </li>
    }
}
