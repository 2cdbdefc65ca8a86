//! The language of the page, and the switch that changes it.

use crate::{Workers, app::App};
use encoderscope::language::t;
use encoderscope_web::language;
use leptos::prelude::*;
use std::cell::Cell;
use wasm_bindgen::prelude::*;

/// A language of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Language {
    English,
    Russian,
}

impl Language {
    const ALL: [Self; 2] = [Self::English, Self::Russian];

    /// Its name in links (ISO 639-1).
    pub(crate) const fn code(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::Russian => "ru",
        }
    }

    /// What its own speakers call it, and the two letters of the switch.
    const fn name(self) -> (&'static str, &'static str) {
        match self {
            Self::English => ("English", "EN"),
            Self::Russian => ("Русский", "РУ"),
        }
    }

    fn of_code(code: &str) -> Self {
        let found = Self::ALL.into_iter().find(|one| one.code() == code);
        found.unwrap_or(Self::English)
    }
}

/// The language that is spoken, with its texts.
#[derive(Clone, Copy)]
pub(crate) struct Spoken {
    /// What views are made for.
    pub(crate) language: RwSignal<Language>,
    /// What workers are told.
    pub(crate) texts: StoredValue<JsValue, LocalStorage>,
}

impl Spoken {
    /// The language that the page begins with, whose texts are there.
    pub(crate) fn new(workers: &Workers) -> Self {
        let language = Language::of_code(&workers.language());
        let texts = workers.texts();
        language::speak(&texts);
        name_on_page(language);
        Self {
            language: RwSignal::new(language),
            texts: StoredValue::new_local(texts),
        }
    }
}

/// What the browser is told of the language of the page.
fn name_on_page(language: Language) {
    if let Some(root) = document().document_element() {
        // Setting an attribute by a constant name cannot fail.
        let _ = root.set_attribute("lang", language.code());
    }
}

thread_local! {
    static PAGE: Cell<Option<App>> = const { Cell::new(None) };
}

/// Speaks another language, which has been chosen; what is not English needs its texts.
#[wasm_bindgen]
pub fn speak(code: &str, texts: &JsValue) {
    let language = Language::of_code(code);
    let Some(app) = PAGE.get() else {
        return;
    };
    if language != Language::English && texts.is_undefined() {
        let why = t("This language cannot be loaded without the network.");
        return app.link_fault.set(Some(why.into()));
    }
    language::speak(texts);
    name_on_page(language);
    app.link_fault.set(None);
    app.tell(texts);
    app.spoken.texts.set_value(texts.clone());
    app.spoken.language.set(language);
    app.show();
}

/// Its buttons choose by their `lang` (`web/js/main.js`).
#[component]
pub(crate) fn LanguageSwitch() -> impl IntoView {
    let app = expect_context::<App>();
    PAGE.set(Some(app));
    let present = app.spoken.language.get_untracked();
    // Elements made one by one would take the first view twice the room.
    let choices = Language::ALL.map(|language| {
        let (code, (name, letters)) = (language.code(), language.name());
        let pressed = language == present;
        format!(
            r#"<button lang="{code}" title="{name}" aria-label="{letters}, {name}" aria-pressed="{pressed}" data-testid="language-{code}">{letters}</button>"#
        )
    });
    view! {
        <span class="languages" role="group" aria-label=t("Language") inner_html=choices.concat()></span>
    }
}
