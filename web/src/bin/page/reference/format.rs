//! The page of a format.

use super::{
    Part, Scroll,
    book::Section,
    checks::Checks,
    commands::{self, Commands, Sequences},
    errata,
    frames::{Frames, strip},
    kinds::{self, Kind},
    status::{self, Status},
    timing::{self, Timing},
};
use crate::app::App;
use encoderscope::{
    capture::Frequency, explain::grouped, format::Link, language::t, profile::Profile,
    sequence::Change, text,
};
use encoderscope_web::link::query;
use leptos::prelude::*;

/// What a format comes down to.
pub(super) struct Facts {
    pub(super) wires: &'static str,
    pub(super) length: String,
    pub(super) rate: String,
    pub(super) check: String,
}

impl Facts {
    pub(super) fn of(profile: &Profile, main: Option<&Kind>) -> Self {
        let link = profile.link();
        let hertz = |hertz: u32| Frequency(hertz.into()).to_string();
        let rate = match (link, profile.format.timing()) {
            (Link::Clocked, Some(timing)) => {
                format!("{}…{}", hertz(timing.slowest), hertz(timing.fastest))
            }
            (Link::Clocked, None) => t("the encoder's data sheet says").to_owned(),
            _ => text!("{} baud", grouped(profile.baud.into())),
        };
        let sums = main.map(|kind| {
            let fields = kind.frame.layout.fields();
            let mut sums: Vec<_> = fields
                .filter_map(|field| Some((field.width, field.cover?.0)))
                .collect();
            sums.sort_by_key(|(width, _)| core::cmp::Reverse(*width));
            sums
        });
        let widest = sums.unwrap_or_default().first().map(|(_, sum)| *sum);
        Self {
            wires: match link {
                Link::Clocked => t("clock and data"),
                Link::Polled => t("serial, asked"),
                Link::Stream => t("serial, unasked"),
            },
            length: main.map(Kind::length).unwrap_or_default(),
            rate,
            check: match widest.map(|sum| (sum.name(), sum.algorithm())) {
                None => t("none").to_owned(),
                Some((name, None)) => t(name).to_owned(),
                Some((_, Some(crc))) => crc
                    .name()
                    .map_or(crc.to_string(), |name| t(name).to_owned()),
            },
        }
    }
}

/// The parts that the page of a profile's format has.
pub(super) fn sections(profile: &Profile) -> Vec<Section> {
    let kinds = kinds::all(profile);
    let has = |section: &Section| match section {
        Section::Parameters | Section::Frames => true,
        Section::Commands => !commands::asked(profile).is_empty(),
        Section::Sequences => !Change::all(profile).is_empty(),
        Section::Status => !status::tables(&kinds).is_empty(),
        Section::Timing => !timing::times(profile, &kinds).is_empty(),
        Section::Checks => kinds.iter().any(|kind| {
            kind.frame
                .layout
                .fields()
                .any(|field| field.cover.is_some())
        }),
        Section::Errata => profile.format.errata().next().is_some(),
    };
    let all = Section::ALL.into_iter();
    all.filter(has).collect()
}

#[component]
pub(super) fn Page() -> impl IntoView {
    let app = expect_context::<App>();
    move || {
        let profile = app.profile.get();
        let kinds = StoredValue::new(kinds::all(&profile));
        let name = profile.format.name();
        let sections = sections(&profile).into_iter();
        let parts: Vec<_> = sections
            .map(|section| match section {
                Section::Parameters => view! { <Parameters profile=profile /> }.into_any(),
                Section::Frames => view! { <Frames profile=profile kinds=kinds /> }.into_any(),
                Section::Commands => view! { <Commands profile=profile /> }.into_any(),
                Section::Sequences => view! { <Sequences profile=profile /> }.into_any(),
                Section::Status => view! { <Status profile=profile kinds=kinds /> }.into_any(),
                Section::Timing => view! { <Timing profile=profile kinds=kinds /> }.into_any(),
                Section::Checks => view! { <Checks profile=profile kinds=kinds /> }.into_any(),
                Section::Errata => view! { <errata::Of profile=profile /> }.into_any(),
            })
            .collect();
        view! {
            <article class="sheet" data-testid="reference-format" data-format=name>
                <Head profile=profile kinds=kinds />
                {parts}
            </article>
        }
    }
}

/// What the format is, at a glance.
#[component]
fn Head(profile: Profile, kinds: StoredValue<Vec<Kind>>) -> impl IntoView {
    let main = kinds.with_value(|kinds| kinds::main(kinds).cloned());
    let facts = Facts::of(&profile, main.as_ref());
    let about = profile.format.manual().about;
    let same = query(&profile);
    let explain = main
        .as_ref()
        .map_or(format!("#/explain?{same}"), Kind::explainer);
    let facts = [
        (t("link"), facts.wires.to_owned()),
        (t("frame"), facts.length),
        (t("rate"), facts.rate),
        (t("check"), facts.check),
        (t("manual"), t(profile.source()).to_owned()),
    ];
    let facts = facts.map(|(name, value)| view! { <div><dt>{name}</dt><dd>{value}</dd></div> });
    view! {
        <header class="head">
            <h1>{t(profile.title())}</h1>
            <p class="about">{t(about)} "."</p>
            <dl class="facts">{facts.into_view()}</dl>
            {main.as_ref().map(strip)}
            <p class="ways">
                {profile.is_serial().then(|| view! { <a href=format!("#/console?{same}")>{t("Read one")}</a> })}
                <a href=format!("#/decode?{same}")>{t("Decode a dump")}</a>
                <a href=explain>{t("Take this frame apart")}</a>
            </p>
        </header>
    }
}

/// The parameters, what they can be, and what they are.
#[component]
fn Parameters(profile: Profile) -> impl IntoView {
    let default = profile.format.default_profile().parameters();
    let value = |from: &[(&'static str, encoderscope::record::Value)], name: &str| {
        let mine = from.iter().find(|(known, _)| *known == name);
        mine.map(|(_, value)| value.plain()).unwrap_or_default()
    };
    let present = profile.parameters();
    let rows: Vec<_> = profile
        .format
        .parameters()
        .iter()
        .map(|name| {
            let words = Profile::words(name).iter().zip(Profile::word_docs(name));
            let words: Vec<_> = words
                .map(|(word, doc)| {
                    let doc = t(doc.trim()).trim_end_matches('.');
                    view! { <div><b>{*word}</b> " " <span class="doc">{doc}</span></div> }
                })
                .collect();
            let range = profile.range(name).map(|(least, most)| {
                let most = grouped(most.into());
                view! { <div><b>{format!("{}…{most}", grouped(least.into()))}</b></div> }
            });
            let (was, is) = (value(&default, name), value(&present, name));
            let changed = was != is;
            view! {
                <tr data-testid="reference-parameter" data-name=*name>
                    <th scope="row">{*name}</th>
                    <td class="words">{t(Profile::doc(name))}</td>
                    <td class="choices">{words} {range}</td>
                    <td>{was}</td>
                    <td class="here" class:changed=changed>{is}</td>
                </tr>
            }
        })
        .collect();
    let limits = profile.format.limits();
    let both = limits.angle + limits.turns > limits.together && limits.turns > 0;
    view! {
        <Part profile=profile section=Section::Parameters>
            <p class="hint">
                {t("Their names in links; the same on the command line, and in JavaScript in camelCase.")}
                {both.then(|| text!(" Angle and turns have at most {} bits together.", limits.together))}
            </p>
            <Scroll label=t("Parameters").to_owned()>
                <table class="parameters">
                    <caption class="unseen">{t("Parameters")}</caption>
                    <thead>
                        <tr>
                            <th scope="col">{t("name")}</th>
                            <th scope="col">{t("what it is")}</th>
                            <th scope="col">{t("can be")}</th>
                            <th scope="col">{t("default")}</th>
                            <th scope="col">{t("on this page")}</th>
                        </tr>
                    </thead>
                    <tbody>{rows}</tbody>
                </table>
            </Scroll>
            <p class="example-link">
                {t("The profile of this page, as a link has it: ")}
                <code>{query(&profile)}</code>
            </p>
        </Part>
    }
}
