//! The reference: formats, products and calculators, all of it out of the core's tables.

mod book;
mod calculator;
mod checks;
mod choice;
mod commands;
mod errata;
mod format;
mod frames;
mod kinds;
mod overview;
mod status;
mod timing;
mod topic;

pub(crate) use book::Book;

use crate::{
    app::{App, Place},
    profile_editor::{Offer, ProfileEditor},
};
use book::{Leaf, Mark, Section, filled_link};
use encoderscope::{
    calculator::{CALCULATORS, Calculator},
    format::Format,
    language::t,
    profile::Profile,
};
use encoderscope_web::link::Fragment;
use leptos::{ev, html, prelude::*};
use topic::Topic;

#[component]
pub(crate) fn Reference() -> impl IntoView {
    let app = expect_context::<App>();
    let book = app.book();
    app.settle(Place {
        follow: Callback::new(move |link: Fragment| {
            // A page may use names of the profile for entries of its own.
            if !Book::is_filled(&link) {
                app.follow_profile_of(&link);
            }
            book.follow_link(&link);
        }),
        fragment: Signal::derive(move || book.fragment(&app.profile.get())),
    });
    let place = Memo::new(move |_| (book.leaf.get(), app.profile.get().title()));
    Effect::new(move |before: Option<(Leaf, &'static str)>| {
        let place = place.get();
        let mark = book.mark.get();
        let is_new = before != Some(place);
        // What is marked may only now come into being.
        request_animation_frame(move || match mark {
            Some(mark) => reveal(&mark),
            None if is_new => window().scroll_to_with_x_and_y(0.0, 0.0),
            None => {}
        });
        place
    });
    view! {
        <div class="reference">
            <div class="contents">
                <Contents />
                {move || book.leaf.get().has_profile().then(|| view! {
                    <section class="panel">
                        <h2>{t("This encoder")}</h2>
                        <ProfileEditor offer=Offer::All />
                    </section>
                })}
            </div>
            {move || match book.leaf.get() {
                Leaf::Overview => view! { <overview::Overview /> }.into_any(),
                Leaf::Errata => view! { <errata::All /> }.into_any(),
                Leaf::Format => view! { <format::Page /> }.into_any(),
                Leaf::Topic(topic) => view! { <topic::Page topic=topic /> }.into_any(),
                Leaf::Calculator(name) => Calculator::named(name)
                    .map(|calculator| view! { <calculator::Page calculator=calculator /> })
                    .into_any(),
            }}
        </div>
    }
}

/// Brings what is marked into sight, and the reader of a screen reader there.
fn reveal(mark: &Mark) {
    use wasm_bindgen::JsCast;
    let element = document().get_element_by_id(&mark.id());
    if let Some(element) = element.and_then(|found| found.dyn_into::<web_sys::HtmlElement>().ok()) {
        element.scroll_into_view();
        // An element that is gone needs no focus.
        let _ = element.focus();
    }
}

/// The pages, and the parts of the one that is open.
#[component]
fn Contents() -> impl IntoView {
    let app = expect_context::<App>();
    let book = app.book();
    let format = Memo::new(move |_| app.profile.get().format);
    let is_open = move |known: Format| book.leaf.get() == Leaf::Format && format.get() == known;
    let page = move |known: Format| {
        let href = move || {
            let profile = app.profile.get();
            let kept = (profile.format == known).then_some(profile);
            book::link(&kept.unwrap_or(known.default_profile()), None)
        };
        view! {
            <li>
                <a href=href aria-current=move || is_open(known).then_some("page")>{t(known.title())}</a>
                {move || is_open(known).then(|| view! { <Parts /> })}
            </li>
        }
    };
    let leaf = move |leaf: Leaf, href: String, title: &'static str| {
        view! {
            <li>
                <a href=href aria-current=move || (book.leaf.get() == leaf).then_some("page")>{title}</a>
            </li>
        }
    };
    let own = move || {
        let profile = app.profile.get();
        (is_open(Format::Own)).then(|| {
            view! {
                <li>
                    <a href=book::link(&profile, None) aria-current="page">{t(profile.title())}</a>
                    <Parts />
                </li>
            }
        })
    };
    let topic = |topic: Topic| {
        let there = Leaf::Topic(topic);
        leaf(there, filled_link(there, &[]), topic.title())
    };
    let calculator = |calculator: &'static Calculator| {
        let there = Leaf::Calculator(calculator.name);
        leaf(there, filled_link(there, &[]), t(calculator.title))
    };
    // On a narrow page the list would push the page itself out of sight: it is folded there.
    let list = NodeRef::<html::Details>::new();
    let fold = move || {
        if let Some(list) = list.get_untracked() {
            list.set_open(is_wide());
        }
    };
    let wide = StoredValue::new(is_wide());
    let resize = window_event_listener(ev::resize, move |_| {
        // A phone resizes its page while it is scrolled.
        if wide.get_value() != is_wide() {
            wide.set_value(is_wide());
            fold();
        }
    });
    on_cleanup(move || resize.remove());
    Effect::new(move || {
        let _ = (list.get(), book.leaf.get(), format.get());
        fold();
    });
    view! {
        <details class="list" node_ref=list>
            <summary>{t("Contents")}</summary>
            <div role="navigation" aria-label=t("Reference")>
                <h2>{t("The encoder in the hand")}</h2>
                <ul>{Topic::ALL.map(topic).into_view()}</ul>
                <h2>{t("Calculators")}</h2>
                <ul>{CALCULATORS.iter().map(calculator).collect_view()}</ul>
                <h2>{t("Frames")}</h2>
                <ul>
                    {leaf(Leaf::Overview, "#/reference".to_owned(), t("All of it"))}
                    {Format::ALL.iter().map(|known| page(*known)).collect_view()}
                    {own}
                    {leaf(Leaf::Errata, book::errata_link(None), t("Errors in the manuals"))}
                </ul>
            </div>
        </details>
    }
}

/// Whether the contents have room beside the page.
fn is_wide() -> bool {
    let width = window().inner_width().ok();
    let width = width.and_then(|width| width.as_f64()).unwrap_or(0.0);
    width > 1000.0
}

/// The parts of the page that is open.
#[component]
fn Parts() -> impl IntoView {
    let app = expect_context::<App>();
    let book = app.book();
    let parts = move || {
        let profile = app.profile.get();
        let there = format::sections(&profile).into_iter();
        there
            .map(|section| {
                let mark = Mark::Section(section);
                let href = book::link(&profile, Some(&mark));
                view! {
                    <li>
                        <a href=href aria-current=move || book.is_marked(&mark).then_some("location")>
                            {section.title()}
                        </a>
                    </li>
                }
            })
            .collect_view()
    };
    view! { <ul>{parts}</ul> }
}

/// A part of a page with its heading, to which links lead.
#[component]
fn Part(profile: Profile, section: Section, children: Children) -> impl IntoView {
    let mark = Mark::Section(section);
    let id = mark.id();
    view! {
        <section class="part" id=id.clone() tabindex="-1" aria-labelledby=format!("{id}-title")>
            <h2 id=format!("{id}-title")>
                <a href=book::link(&profile, Some(&mark))>{section.title()}</a>
            </h2>
            {children()}
        </section>
    }
}

/// A table in a box of its own, which scrolls where it is wider than the page.
#[component]
fn Scroll(label: String, children: Children) -> impl IntoView {
    view! { <div class="wide" tabindex="0" role="group" aria-label=label>{children()}</div> }
}
