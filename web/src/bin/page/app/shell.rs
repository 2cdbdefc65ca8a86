//! What is around the areas: the bar above them, and the view of the one that is open.

use super::{App, Area, Source};
use crate::{
    console::Console,
    language::LanguageSwitch,
    parts::{self, coming, later},
};
use encoderscope::{
    language::{number, t},
    profile::Profile,
    text,
};
use encoderscope_web::link::query;
use leptos::prelude::*;

impl App {
    /// Makes all views, in place of those in another language; what runs goes on.
    pub(crate) fn show(self) {
        self.views.set_value(None);
        let Some(body) = document().body() else {
            return;
        };
        let owner = self.owner.get_value();
        let views = owner.with(|| mount_to(body, move || shell(self)));
        self.views.set_value(Some(Box::new(views)));
    }
}

/// What is around the areas.
fn shell(app: App) -> impl IntoView + use<> {
    view! {
        <header class="bar">
            <a class="brand" href="#/console">
                <svg viewBox="0 0 24 24" aria-hidden="true">
                    <circle cx="12" cy="12" r="10" />
                    <line x1="12" y1="12" x2="17" y2="7" />
                    <circle class="dot" cx="12" cy="12" r="2" />
                </svg>
                "Encoderscope"
            </a>
            <nav aria-label=t("Areas")>
                {Area::ALL
                    .map(|area| {
                        view! {
                            <a
                                href=format!("#/{}", area.name())
                                aria-current=move || (app.area.get() == area).then_some("page")
                            >
                                {area.title()}
                            </a>
                        }
                    })
                    .into_view()}
            </nav>
            <span class="pill" data-testid="profile" data-value=move || query(&app.profile.get())>
                {move || summary(&app.profile.get())}
            </span>
            <LanguageSwitch />
            // `web/js/main.js` turns the theme, which it sets before the page is drawn.
            <button class="theme" aria-label=t("Light or dark") title=t("Light or dark")>"◐"</button>
        </header>
        <main>
            {move || {
                app.link_fault.get().map(|fault| view! { <p class="fault" role="alert">{fault}</p> })
            }}
            // Views without a heading of their own that says what they are.
            {move || {
                let named = match app.area.get() {
                    Area::Console => app.source.get() != Source::Preview,
                    Area::Decode | Area::Explain => true,
                    Area::Reference => false,
                };
                named.then(|| view! { <h1 class="unseen">{app.area.get().title()}</h1> })
            }}
            {move || match app.area.get() {
                Area::Console => view! { <Console /> }.into_any(),
                Area::Decode => later(parts::decode, coming).into_any(),
                Area::Explain => later(parts::explain, coming).into_any(),
                Area::Reference => later(parts::reference, coming).into_any(),
            }}
        </main>
    }
}

/// A profile in a line.
pub(crate) fn summary(profile: &Profile) -> impl IntoView + use<> {
    view! { <b>{t(profile.title())}</b> " " {sizes(profile)} }
}

/// What a profile says behind the name of its format.
pub(crate) fn sizes(profile: &Profile) -> String {
    let mut text = text!("{} bit", profile.angle_bits);
    if profile.turns_bits > 0 {
        text += &text!(" + {} turns", profile.turns_bits);
    }
    if profile.is_serial() {
        text += &text!(" · {} Mbaud", number(f64::from(profile.baud) / 1e6));
    }
    text
}
