//! A choice for every part of an order code.

use super::write;
use crate::app::App;
use encoderscope::{
    language::t,
    model::{self, FORMS, Form, Look, Place},
    text,
};
use leptos::prelude::*;

/// A choice for every part, which writes the code.
#[component]
pub(super) fn Composer(looks: Memo<Vec<Look>>) -> impl IntoView {
    let book = expect_context::<App>().book();
    let form = Memo::new(move |_| looks.with(|looks| form_of(looks)));
    let texts = Memo::new(move |_| looks.with(|looks| form.get().complete(looks)));
    let selects = move || {
        let form = form.get();
        let parts = form.parts.iter().enumerate();
        let is_series = |place| place == Place::Series;
        parts
            .filter(|(_, part)| !is_series(part.place))
            .map(|(index, part)| {
                let options = move || options(form, index, &texts.get());
                let choose = move |text: String| {
                    let mut looks = looks.get_untracked();
                    if looks.is_empty() {
                        looks = model::look(&texts.get_untracked().join("-"));
                    }
                    for look in &mut looks {
                        let place = look.part.map(|part| part.place);
                        if place == Some(part.place) {
                            look.text.clone_from(&text);
                        } else if part.place == Place::Rotor && place == Some(Place::Stator) {
                            // The stator goes with the rotor.
                            look.text.clear();
                        }
                    }
                    write(book, &joined(&form.complete(&looks)));
                };
                view! {
                    <label>
                        {part.place.name()}
                        <select
                            data-testid="order-compose"
                            data-position=(index + 1).to_string()
                            on:change:target=move |event| choose(event.target().value())
                        >
                            {options}
                        </select>
                    </label>
                }
            })
            .collect_view()
    };
    let series = move || {
        let present = looks.with(|looks| series_of(looks));
        all_series()
            .map(|(name, title)| {
                view! {
                    <option value=name prop:selected=name == present>{title}</option>
                }
            })
            .collect_view()
    };
    let change_series = move |name: String| {
        let Some((form, first)) = starts(&name) else {
            return;
        };
        let mut texts = form.complete(&looks.get_untracked());
        if let (Some(text), Some(first)) = (texts.first_mut(), first) {
            first.clone_into(text);
        }
        write(book, &joined(&texts));
    };
    view! {
        <section class="part" aria-labelledby="order-composer">
            <h2 id="order-composer">{t("Compose one")}</h2>
            <div class="order-form">
                <label>
                    {t("series")}
                    <select
                        data-testid="order-compose"
                        data-position="series"
                        on:change:target=move |event| change_series(event.target().value())
                    >
                        {series}
                    </select>
                </label>
                {selects}
            </div>
        </section>
    }
}

/// The name of the short form among the series.
const SHORT: &str = "short";

/// All series, by what a code begins with.
fn all_series() -> impl Iterator<Item = (&'static str, &'static str)> {
    FORMS.iter().flat_map(|form| {
        let first = form.parts.first();
        let series = first.filter(|part| part.place == Place::Series);
        let words = series.map_or(&[][..], |part| part.words);
        let short = series
            .is_none()
            .then_some((SHORT, t("short form of MPP and PT")));
        words.iter().map(|word| (word.text, word.text)).chain(short)
    })
}

/// The form of a series, and how its codes begin.
fn starts(name: &str) -> Option<(&'static Form, Option<&str>)> {
    if name == SHORT {
        return FORMS.last().map(|form| (form, None));
    }
    let begins = |form: &&Form| {
        form.parts
            .first()
            .is_some_and(|part| part.read(name).is_some())
    };
    FORMS.iter().find(begins).map(|form| (form, Some(name)))
}

/// What a code begins with.
fn series_of(looks: &[Look]) -> String {
    match looks.first() {
        Some(look) if look.part.is_some_and(|part| part.place == Place::Series) => {
            look.text.clone()
        }
        Some(Look { part: Some(_), .. }) => SHORT.to_owned(),
        _ => FORMS
            .first()
            .map(|form| form.title.to_owned())
            .unwrap_or_default(),
    }
}

/// The form of a code; the first where there is none yet.
pub(super) fn form_of(looks: &[Look]) -> &'static Form {
    let found = starts(&series_of(looks)).map(|(form, _)| form);
    found.unwrap_or(&FORMS[0])
}

fn joined(texts: &[String]) -> String {
    let texts: Vec<_> = texts.iter().map(String::as_str).collect();
    texts.join("-").trim_end_matches('-').to_owned()
}

/// What can be chosen at a position; what does not go with the rest says so.
fn options(form: &'static Form, index: usize, texts: &[String]) -> Vec<AnyView> {
    let present = texts.get(index).cloned().unwrap_or_default();
    let mut choices = form.choices(index, texts);
    let read = form.parts.get(index).and_then(|part| part.read(&present));
    // A size that the table does not have may be typed.
    if let Some(token) = read
        && !choices.contains(&token)
    {
        choices.insert(0, token);
    }
    choices
        .into_iter()
        .map(|token| {
            let text = token.text();
            let mut with = texts.to_vec();
            if let Some(place) = with.get_mut(index) {
                place.clone_from(&text);
            }
            let doc = match form.compose(&with) {
                Ok(_) => token.doc(),
                Err(_) => text!("{}; not with the rest", token.doc()),
            };
            let title = match text.as_str() {
                "" => text!("nothing: {}", doc),
                text => format!("{text}: {doc}"),
            };
            view! { <option value=text.clone() prop:selected=text == present>{title}</option> }
                .into_any()
        })
        .collect()
}
