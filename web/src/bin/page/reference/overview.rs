//! All of the reference at a glance: formats, the layouts of other makers that come with the
//! program, products and calculators.

use super::{
    Scroll,
    book::{Leaf, errata_link, filled_link, link},
    format::Facts,
    kinds,
    topic::Topic,
};
use crate::app::App;
use encoderscope::{
    calculator::CALCULATORS,
    errata::ERRATA,
    format::{Format, own::SHIPPED},
    language::t,
    profile::Profile,
    text,
};
use leptos::prelude::*;

#[component]
pub(super) fn Overview() -> impl IntoView {
    let app = expect_context::<App>();
    let rows = move || {
        let present = app.profile.get();
        Format::ALL
            .iter()
            .map(|format| {
                let mine = present.format == *format;
                let profile = if mine {
                    present
                } else {
                    format.default_profile()
                };
                row(profile, format.manual().about, mine)
            })
            .collect_view()
    };
    let own: Vec<_> = SHIPPED
        .iter()
        .filter_map(|shipped| {
            let profile = Profile::parse([("format", "own"), ("layout", shipped.name)]).ok()?;
            Some(row(profile, shipped.source, false))
        })
        .collect();
    let entry = |leaf: Leaf, title: &'static str, about: &'static str| {
        view! {
            <div>
                <dt><a href=filled_link(leaf, &[])>{title}</a></dt>
                <dd>{about}</dd>
            </div>
        }
    };
    let topics = Topic::ALL.map(|topic| entry(Leaf::Topic(topic), topic.title(), topic.about()));
    let calculators = CALCULATORS.iter().map(|calculator| {
        let leaf = Leaf::Calculator(calculator.name);
        entry(leaf, t(calculator.title), t(calculator.about))
    });
    let heads = |about: &'static str| {
        let names = [
            t("format"),
            about,
            t("wires"),
            t("frame"),
            t("check"),
            t("rate"),
        ];
        names
            .map(|name| view! { <th scope="col">{name}</th> })
            .into_view()
    };
    view! {
        <article class="sheet" data-testid="reference-overview">
            <header class="head">
                <h1>{t("Reference")}</h1>
                <p class="about">
                    {t("From the label on the encoder to the first angle; every frame, request, check and status bit, out of the tables that this page decodes with.")}
                </p>
            </header>
            <section class="part" aria-labelledby="hand-title">
                <h2 id="hand-title">{t("With the encoder in the hand")}</h2>
                <dl class="topics">{topics.into_view()}</dl>
            </section>
            <section class="part" aria-labelledby="calculators-title">
                <h2 id="calculators-title">{t("Calculators")}</h2>
                <dl class="topics">{calculators.collect_view()}</dl>
            </section>
            <section class="part" aria-labelledby="formats-title">
                <h2 id="formats-title">{t("Formats of the manuals")}</h2>
                <Scroll label=t("Formats of the manuals").to_owned()>
                    <table class="overview">
                        <caption class="unseen">{t("Formats of the manuals, each with the widths that are chosen or usual")}</caption>
                        <thead><tr>{heads(t("what it is"))}</tr></thead>
                        <tbody>{rows}</tbody>
                    </table>
                </Scroll>
            </section>
            <section class="part" aria-labelledby="own-title">
                <h2 id="own-title">{t("Layouts of other makers")}</h2>
                <Scroll label=t("Layouts of other makers").to_owned()>
                    <table class="overview">
                        <caption class="unseen">{t("Layouts of other makers that come with the program, and where they are described")}</caption>
                        <thead><tr>{heads(t("described in"))}</tr></thead>
                        <tbody>{own}</tbody>
                    </table>
                </Scroll>
            </section>
            <section class="part" aria-labelledby="errata-title">
                <h2 id="errata-title">{t("Errors in the manuals")}</h2>
                <p>
                    <a href=errata_link(None)>{text!("{} places", ERRATA.len())}</a>
                    {t(" where the manuals would lead a reader wrong, with the right reading and why.")}
                </p>
            </section>
        </article>
    }
}

fn row(profile: Profile, about: &'static str, is_present: bool) -> impl IntoView {
    let kinds = kinds::all(&profile);
    let facts = Facts::of(&profile, kinds::main(&kinds));
    view! {
        <tr
            data-testid="reference-entry"
            data-format=profile.format.name()
            class:present=is_present
            aria-current=is_present.then_some("true")
        >
            <th scope="row"><a href=link(&profile, None)>{t(profile.title())}</a></th>
            <td class="words">{t(about)}</td>
            <td class="words">{facts.wires}</td>
            <td>{facts.length}</td>
            <td>{facts.check}</td>
            <td>{facts.rate}</td>
        </tr>
    }
}
