//! Light and dark.

use encoderscope::language::t;
use leptos::prelude::*;

#[component]
pub(crate) fn ThemeSwitch() -> impl IntoView {
    // The theme is set before the page is drawn, by the script that loads it.
    let root = document().document_element();
    let dark = root
        .as_ref()
        .and_then(|root| root.get_attribute("data-theme"));
    let dark = RwSignal::new(dark.as_deref() == Some("dark"));
    Effect::new(move || {
        if let Some(root) = &root {
            // Setting an attribute by a constant name cannot fail.
            let _ = root.set_attribute("data-theme", if dark.get() { "dark" } else { "light" });
        }
    });
    let switch = move |_| {
        dark.update(|dark| *dark = !*dark);
        if let Ok(Some(storage)) = window().local_storage() {
            // A browser that keeps nothing starts with the system's theme next time.
            let _ = storage.set_item(
                "theme",
                if dark.get_untracked() {
                    "dark"
                } else {
                    "light"
                },
            );
        }
    };
    view! {
        <button class="theme" on:click=switch aria-label=t("Light or dark") title=t("Light or dark")>
            "◐"
        </button>
    }
}
