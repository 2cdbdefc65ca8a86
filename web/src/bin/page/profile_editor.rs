//! Choosing a profile: format, widths, command and baud.

use crate::app::App;
use encoderscope::{
    format::{Format, rs485::Command},
    profile::Profile,
};
use leptos::prelude::*;

/// Whether formats that have no serial line may be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Offer {
    /// Only what can be polled.
    Polled,
    /// Everything.
    All,
}

/// Edits the shared profile.
#[component]
pub(crate) fn ProfileEditor(offer: Offer) -> impl IntoView {
    let app = expect_context::<App>();
    let fault = RwSignal::new(None::<String>);
    let formats = Format::ALL
        .iter()
        .filter(move |format| offer == Offer::All || format.is_polled());
    let change = move |new: Profile| match new.check() {
        Ok(()) => {
            fault.set(None);
            app.change_profile(new);
        }
        Err(error) => fault.set(Some(error.to_string())),
    };
    let number = move |name: &'static str,
                       label: &'static str,
                       read: fn(&Profile) -> u32,
                       write: fn(&mut Profile, u32)| {
        let used = move || app.profile.get().format.parameters().contains(&name);
        let edited = move |text: String| match text.parse() {
            Ok(value) => {
                let mut new = app.profile.get_untracked();
                write(&mut new, value);
                change(new);
            }
            Err(_) => fault.set(Some(format!("{name}: {text:?} is not a whole number"))),
        };
        move || {
            used().then(|| {
                view! {
                    <label>
                        {label}
                        <input
                            inputmode="numeric"
                            name=name
                            prop:value=move || read(&app.profile.get()).to_string()
                            on:change:target=move |event| edited(event.target().value())
                        />
                    </label>
                }
            })
        }
    };
    view! {
        <div class="profile">
            <label>
                "Format"
                <select
                    name="format"
                    prop:value=move || app.profile.get().format.name()
                    on:change:target=move |event| {
                        if let Some(format) = Format::parse(&event.target().value()) {
                            change(format.default_profile());
                        }
                    }
                >
                    {formats
                        .map(|format| {
                            view! {
                                <option value=format.name() selected=move || app.profile.get().format == *format>
                                    {format.title()}
                                </option>
                            }
                        })
                        .collect_view()}
                </select>
            </label>
            {number("angle-bits", "Angle bits", |p| p.angle_bits, |p, value| p.angle_bits = value)}
            {number("turns-bits", "Turns bits", |p| p.turns_bits, |p, value| p.turns_bits = value)}
            {number("status-bits", "Status bits", |p| p.status_bits, |p, value| p.status_bits = value)}
            {move || {
                let used = app.profile.get().format.parameters().contains(&"command");
                used.then(|| {
                    view! {
                        <label>
                            "Reply to"
                            <select
                                name="command"
                                on:change:target=move |event| {
                                    if let Some(command) = Command::parse(&event.target().value()) {
                                        change(Profile { command, ..app.profile.get_untracked() });
                                    }
                                }
                            >
                                {Command::ALL
                                    .iter()
                                    .filter(|command| offer == Offer::All || !command.changes_encoder())
                                    .map(|command| {
                                        view! {
                                            <option
                                                value=command.letter().to_string()
                                                selected=move || app.profile.get().command == *command
                                            >
                                                {command_title(*command)}
                                            </option>
                                        }
                                    })
                                    .collect_view()}
                            </select>
                        </label>
                    }
                })
            }}
            {(offer == Offer::Polled)
                .then(|| number("baud", "Baud", |p| p.baud, |p, value| p.baud = value))}
            {move || fault.get().map(|fault| view! { <p class="fault" role="alert">{fault}</p> })}
        </div>
    }
}

const fn command_title(command: Command) -> &'static str {
    match command {
        Command::Zero => "0 · set zero",
        Command::Position => "1 · position",
        Command::Status => "d · position, status",
        Command::Speed => "s · position, speed",
        Command::Temperature => "t · position, temperature",
    }
}
