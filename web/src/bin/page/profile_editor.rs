//! Choosing a profile: format, widths, and what else its format can be.

use crate::app::App;
use encoderscope::{
    format::{Format, rs485::Command},
    language::{msg, t},
    profile::Profile,
    text,
};
use leptos::prelude::*;

/// Whether formats that have no serial line may be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Offer {
    /// Only what comes over a serial line.
    Serial,
    /// Everything.
    All,
}

/// What a parameter is called on the page.
fn label(name: &str) -> &'static str {
    match name {
        "angle-bits" => t("Angle bits"),
        "turns-bits" => t("Turns bits"),
        "status-bits" => t("Status bits"),
        "ack-bits" => t("Ack bits"),
        "command" => t("Reply to"),
        "address" => t("Address"),
        "code" => t("Code"),
        "align" => t("Align"),
        "frame-bits" => t("Frame bits"),
        "parity" => t("Parity"),
        "turns-code" => t("Turns are"),
        "status-active" => t("Status active"),
        "dialect" => t("Dialect"),
        "marker" => t("Top bits"),
        "baud" => t("Baud"),
        "justify" => t("Justify"),
        _ => "",
    }
}

/// Parameters that few users need to touch.
fn is_rare(format: Format, name: &str) -> bool {
    let rare = [
        "ack-bits",
        "turns-code",
        "status-active",
        "marker",
        "justify",
    ];
    rare.contains(&name) || format == Format::Bus && name == "parity"
}

/// Whether a parameter is of use here.
fn is_offered(offer: Offer, name: &str) -> bool {
    match offer {
        Offer::Serial => !matches!(name, "justify" | "layout"),
        Offer::All => !matches!(name, "baud" | "layout"),
    }
}

/// Edits the shared profile.
#[component]
pub(crate) fn ProfileEditor(offer: Offer) -> impl IntoView {
    let app = expect_context::<App>();
    let fault = RwSignal::new(None::<String>);
    let change = move |name: &'static str, text: String| match app
        .profile
        .get_untracked()
        .with(name, text.trim())
    {
        Ok(new) => {
            fault.set(None);
            app.choose_profile(new);
        }
        Err(error) => fault.set(Some(error.to_string())),
    };
    let choose = move |name: String| {
        if let Some(format) = Format::parse(&name) {
            fault.set(None);
            let new = match format {
                Format::Own => crate::decode::first_own(offer),
                known => Some(known.default_profile()),
            };
            if let Some(new) = new {
                app.choose_profile(new);
            }
        }
    };
    let read_model = move |text: String| {
        if text.trim().is_empty() {
            return fault.set(None);
        }
        match Profile::parse([("model", text.trim())]) {
            Ok(new) if offer == Offer::Serial && !new.is_serial() => {
                fault.set(Some(text!(
                    "{} is clocked, which a USB adapter cannot: decode a pasted dump instead",
                    new.title()
                )));
            }
            Ok(new) => {
                fault.set(None);
                app.choose_profile(new);
            }
            Err(error) => fault.set(Some(error.to_string())),
        }
    };
    let formats = Format::ALL
        .iter()
        .chain(&[Format::Own])
        .filter(move |format| {
            let serial = format.default_profile().is_serial() || **format == Format::Own;
            offer == Offer::All || serial
        });
    let format = Memo::new(move |_| app.profile.get().format);
    let shown = move |rare: bool| {
        let format = format.get();
        let names = format.parameters().iter().copied();
        names
            .filter(move |name| is_offered(offer, name) && is_rare(format, name) == rare)
            .map(move |name| view! { <Parameter name=name offer=offer change=change /> })
            .collect_view()
    };
    let has_rare = move || {
        let format = format.get();
        let mut names = format.parameters().iter();
        names.any(|name| is_offered(offer, name) && is_rare(format, name))
    };
    view! {
        <div class="profile">
            <label>
                {t("Format")}
                <select
                    name="format"
                    prop:value=move || format.get().name()
                    on:change:target=move |event| choose(event.target().value())
                >
                    {formats
                        .map(|known| {
                            view! {
                                <option value=known.name() selected=move || format.get() == *known>
                                    {t(known.title())}
                                </option>
                            }
                        })
                        .collect_view()}
                </select>
            </label>
            {move || shown(false)}
            <label class="model">
                {t("Or the order code")}
                <input
                    name="model"
                    placeholder="MPP-20-30-A-24BM-R-N-A-M"
                    autocapitalize="characters"
                    spellcheck="false"
                    on:change:target=move |event| read_model(event.target().value())
                />
            </label>
            {move || has_rare().then(|| view! {
                <details>
                    <summary>{t("More")}</summary>
                    <div class="profile">{shown(true)}</div>
                </details>
            })}
            {move || fault.get().map(|fault| view! { <p class="fault" role="alert">{fault}</p> })}
        </div>
    }
}

/// One parameter: a number, or a word out of a few.
#[component]
fn Parameter(
    name: &'static str,
    offer: Offer,
    change: impl Fn(&'static str, String) + Copy + Send + 'static,
) -> impl IntoView {
    let app = expect_context::<App>();
    let value = Memo::new(move |_| {
        let parameters = app.profile.get().parameters();
        let mine = parameters.into_iter().find(|(known, _)| *known == name);
        mine.map(|(_, value)| value.plain()).unwrap_or_default()
    });
    let words = Profile::words(name);
    let input = if words.is_empty() {
        view! {
            <input
                inputmode="numeric"
                name=name
                prop:value=move || value.get()
                on:change:target=move |event| change(name, event.target().value())
            />
        }
        .into_any()
    } else {
        let options = words
            .iter()
            .filter(move |word| offer == Offer::All || !writes(name, word));
        view! {
            <select name=name on:change:target=move |event| change(name, event.target().value())>
                {options
                    .map(|word| {
                        view! {
                            <option value=*word selected=move || value.get() == *word>
                                {title(name, word)}
                            </option>
                        }
                    })
                    .collect_view()}
            </select>
        }
        .into_any()
    };
    view! { <label>{label(name)} {input}</label> }
}

/// Whether a word stands for a command that changes the encoder.
fn writes(name: &str, word: &str) -> bool {
    name == "command" && Command::parse(word).is_some_and(Command::changes_encoder)
}

/// Words of parameters that another language has its own words for, each with its parameter: gray
/// is a code here.
const WORDS: [&str; 15] = [
    msg("align.right"),
    msg("align.tree"),
    msg("code.binary"),
    msg("code.gray"),
    msg("justify.left"),
    msg("justify.right"),
    msg("marker.first"),
    msg("marker.none"),
    msg("parity.even"),
    msg("parity.none"),
    msg("parity.odd"),
    msg("status-active.high"),
    msg("status-active.low"),
    msg("turns-code.signed"),
    msg("turns-code.unsigned"),
];

/// A word of a parameter in the language of the page.
pub(crate) fn spoken_word(name: &str, word: &'static str) -> &'static str {
    let known = WORDS.iter().find(|known| {
        let (parameter, value) = known.split_once('.').unwrap_or_default();
        parameter == name && value == word
    });
    // Where nothing else is said the name of the text comes back.
    let said = known
        .map(|known| t(known))
        .filter(|said| !said.ends_with(word));
    said.unwrap_or(word)
}

/// What a word is called on the page.
fn title(name: &str, word: &'static str) -> String {
    match (name, Command::parse(word)) {
        ("command", Some(command)) => format!("{word} · {}", t(command.title())),
        _ => spoken_word(name, word).to_owned(),
    }
}
