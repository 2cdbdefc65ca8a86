//! The language of the page, and the switch that changes it.

use crate::{Workers, app::App};
use encoderscope::language::t;
use encoderscope_web::language;
use leptos::prelude::*;
use wasm_bindgen::JsValue;

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
    /// What views are made for; all are made anew when it changes.
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

impl App {
    /// Speaks another language, once its texts are there.
    fn choose(self, language: Language) {
        leptos::task::spawn_local(async move {
            let workers = self.workers.get_value();
            let Ok(texts) = workers.speak(language.code()).await else {
                let why = t("This language cannot be loaded without the network.");
                return self.link_fault.set(Some(why.into()));
            };
            language::speak(&texts);
            name_on_page(language);
            self.tell(&texts);
            self.spoken.texts.set_value(texts);
            self.spoken.language.set(language);
        });
    }
}

#[component]
pub(crate) fn LanguageSwitch() -> impl IntoView {
    let app = expect_context::<App>();
    let present = app.spoken.language;
    let choices = Language::ALL.map(|language| {
        let (name, letters) = language.name();
        view! {
            <button
                lang=language.code()
                title=name
                aria-label=name
                aria-pressed=move || (present.get() == language).to_string()
                data-testid=format!("language-{}", language.code())
                on:click=move |_| app.choose(language)
            >
                {letters}
            </button>
        }
    });
    view! {
        <span class="languages" role="group" aria-label=t("Language")>
            {choices.into_view()}
        </span>
    }
}
