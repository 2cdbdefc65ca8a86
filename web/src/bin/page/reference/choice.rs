//! What is chosen on a page; it lives in the link.

use super::book::Book;
use crate::app::App;
use encoderscope::{
    calculator::Fault,
    language::t,
    product::{Interface, Series},
    wiring::encoder,
};
use leptos::prelude::*;

/// The series and the interface that are chosen.
pub(super) fn chosen(book: Book) -> Result<(Series, Interface), Fault> {
    let filled = book.filled();
    encoder(|name| found(&filled, name))
}

/// What is filled in under a name.
pub(super) fn found<'a>(filled: &'a [(String, String)], name: &str) -> Option<&'a str> {
    let found = filled.iter().find(|(known, _)| known == name);
    found.map(|(_, value)| value.as_str())
}

/// The series and the interface. Another encoder has other interfaces and other adapters.
#[component]
pub(super) fn EncoderChoice() -> impl IntoView {
    let book = expect_context::<App>().book();
    let asked = Memo::new(move |_| chosen(book));
    let series = Signal::derive(move || match asked.get() {
        Ok((series, _)) => series.key().to_owned(),
        Err(_) => book.entry("series").unwrap_or_default(),
    });
    let interface = Signal::derive(move || match asked.get() {
        Ok((_, interface)) => interface.key().to_owned(),
        Err(_) => book.entry("interface").unwrap_or_default(),
    });
    let offered = Signal::derive(move || {
        let (series, interface) = asked.get().unwrap_or((Series::Mpp, Interface::Rs485));
        let mut all = series.interfaces().to_vec();
        // What a link asks for is shown even where it does not exist.
        if !all.contains(&interface) {
            all.push(interface);
        }
        let words = all.into_iter();
        words
            .map(|interface| (interface.key(), t(interface.title())))
            .collect::<Vec<_>>()
    });
    let all = Series::ALL.map(|series| (series.key(), t(series.name())));
    view! {
        <Choice
            name="series"
            title=t("Series")
            hint=t("the first part of the order code")
            words=all.to_vec()
            chosen=series
            clears=&["interface", "battery", "adapter"]
        />
        <Choice
            name="interface"
            title=t("Interface")
            hint=t("MPP and PT: the letter behind the bits")
            words=offered
            chosen=interface
            clears=&["adapter"]
        />
    }
}

/// One of some words, of which each has a name in links and one for people.
#[component]
pub(super) fn Choice(
    name: &'static str,
    title: &'static str,
    hint: &'static str,
    #[prop(into)] words: Signal<Vec<(&'static str, &'static str)>>,
    /// The name of what is chosen.
    #[prop(into)]
    chosen: Signal<String>,
    /// Entries that no longer fit when this one changes.
    #[prop(optional)]
    clears: &'static [&'static str],
) -> impl IntoView {
    let book = expect_context::<App>().book();
    let id = format!("choice-{name}");
    let hint_id = format!("{id}-hint");
    let enter = move |value: String| {
        for other in clears {
            book.clear(other);
        }
        book.enter(name, &value);
    };
    let options = move || {
        let words = words.get().into_iter();
        words
            .map(|(key, title)| {
                view! { <option value=key prop:selected=move || chosen.get() == key>{title}</option> }
            })
            .collect_view()
    };
    view! {
        <div class="asked">
            <label for=id.clone()>{title}</label>
            <span class="entered">
                <select
                    id=id
                    data-testid="choice"
                    data-name=name
                    aria-describedby=hint_id.clone()
                    on:change:target=move |event| enter(event.target().value())
                >
                    {options}
                </select>
            </span>
            <p class="hint" id=hint_id>{hint}</p>
        </div>
    }
}
