//! Guided setting: zero, resets and address, with a gate in front and a proof behind.

use crate::{
    app::App,
    eeprom::{Eeprom, byte_text},
};
use encoderscope::{profile::Profile, sequence::Change};
use encoderscope_web::message::{Link, Outcome, Progress, STILL, Setting, Shown, ToEngine};
use leptos::prelude::*;

/// What can be set with a profile.
fn offered(profile: &Profile) -> Vec<Setting> {
    let all = [
        Setting::Zero,
        Setting::ResetAngle,
        Setting::ResetTurns,
        Setting::ResetErrors,
        Setting::Address(0),
    ];
    all.into_iter()
        .filter(|setting| setting.change().script(profile).is_some())
        .collect()
}

/// Whether the encoder has an EEPROM that can be written.
fn has_memory(profile: &Profile) -> bool {
    let change = Change::Memory {
        address: 0,
        data: 0,
    };
    change.script(profile).is_some()
}

const fn title(setting: Setting) -> &'static str {
    match setting {
        Setting::Zero => "Set zero",
        Setting::ResetAngle => "Reset angle",
        Setting::ResetTurns => "Reset turns",
        Setting::ResetErrors => "Reset errors",
        Setting::Address(_) => "Set address",
        Setting::Memory { .. } => "Write EEPROM",
    }
}

const fn meaning(setting: Setting) -> &'static str {
    match setting {
        Setting::Zero => "The present position becomes 0, turns and angle, and is stored.",
        Setting::ResetAngle => "The present angle becomes 0 and is stored; the turns stay.",
        Setting::ResetTurns => "The turns become 0; the angle stays.",
        Setting::ResetErrors => "The errors that the encoder keeps are cleared.",
        Setting::Address(_) => {
            "Every device on the wire hears this and takes the new address: connect only one."
        }
        Setting::Memory { .. } => "The byte is stored in the encoder and stays without power.",
    }
}

#[component]
pub(crate) fn SettingPanel() -> impl IntoView {
    let app = expect_context::<App>();
    let chosen = RwSignal::new(None::<Setting>);
    let progress = Memo::new(move |_| app.snapshot.get().progress);
    let reading = move || app.snapshot.get().link == Link::Reading;
    let settings = Memo::new(move |_| offered(&app.profile.get()));
    // After an address has been set the encoder is read at the new one.
    Effect::new(move || {
        if let Some(Progress {
            setting: Setting::Address(address),
            outcome:
                Some(Outcome {
                    changed: Some(true),
                    ..
                }),
            ..
        }) = progress.get()
        {
            app.adopt_address(address);
        }
    });
    let doors = move || {
        settings
            .get()
            .into_iter()
            .map(|setting| {
                let start = matches!(setting, Setting::Zero | Setting::ResetAngle);
                view! {
                    <button
                        data-testid=if start { "zero-start" } else { "setting-start" }
                        disabled=move || !reading()
                        on:click=move |_| chosen.set(Some(setting))
                    >
                        {title(setting)} "…"
                    </button>
                }
            })
            .collect_view()
    };
    move || {
        let progress = progress.get();
        if settings.get().is_empty() && progress.is_none() {
            return None;
        }
        Some(view! {
            <section class="panel setting">
                <h2>"Set the encoder"</h2>
                {match (progress, chosen.get()) {
                    (Some(progress), _) => view! { <Running progress=progress chosen=chosen /> }.into_any(),
                    (None, Some(setting)) => view! { <Gate setting=setting chosen=chosen /> }.into_any(),
                    (None, None) => view! {
                        <div class="doors">{doors()}</div>
                        {has_memory(&app.profile.get()).then(|| view! { <Eeprom chosen=chosen /> })}
                    }
                    .into_any(),
                }}
            </section>
        })
    }
}

/// What must be so before anything is sent.
#[component]
fn Gate(setting: Setting, chosen: RwSignal<Option<Setting>>) -> impl IntoView {
    let app = expect_context::<App>();
    let address = RwSignal::new(app.profile.get_untracked().address.to_string());
    let wanted = Memo::new(move |_| {
        let parsed = address.get().trim().parse::<u8>().ok();
        parsed.filter(|address| *address < 32)
    });
    let moved = Memo::new(move |_| app.snapshot.get().moved);
    let held = Memo::new(move |_| app.snapshot.get().memory.and_then(|cell| cell.data));
    let still = move || moved.get().is_some_and(|moved| moved < STILL);
    let ready = move || {
        let rest = !setting.needs_rest() || still();
        let fits = !matches!(setting, Setting::Address(_)) || wanted.get().is_some();
        rest && fits && app.snapshot.get().link == Link::Reading
    };
    let gate = move || match moved.get() {
        None => ("lamp idle", "waiting for a second of readings".to_owned()),
        Some(moved) if moved < STILL => ("lamp good", "the shaft stands still".to_owned()),
        Some(moved) => (
            "lamp bad",
            format!("the shaft moves: {:.2}° within a second", moved * 360.0),
        ),
    };
    let confirm = move |_| {
        let setting = match (setting, wanted.get_untracked()) {
            (Setting::Address(_), Some(address)) => Setting::Address(address),
            (setting, _) => setting,
        };
        chosen.set(None);
        app.send(ToEngine::Set(setting));
    };
    view! {
        <p><b>{title(setting)}</b> ". " {meaning(setting)}</p>
        {setting.needs_rest().then(|| view! {
            <p class="hint">"Switch the drive off first. On a vertical axis secure the load: a drive that trusts the old zero may move."</p>
            <p class=move || gate().0 data-testid="gate" data-value=move || still().to_string()>{move || gate().1}</p>
        })}
        {matches!(setting, Setting::Address(_)).then(|| view! {
            <label>
                "New address, 0…31"
                <input inputmode="numeric" name="new-address" prop:value=move || address.get() on:input:target=move |event| address.set(event.target().value()) />
            </label>
        })}
        {move || match setting {
            Setting::Memory { address, data } => Some(view! {
                <p data-testid="memory-change">{memory_change(address, held.get(), data)}</p>
            }),
            _ => None,
        }}
        <div class="doors">
            <button class="primary" data-testid="zero-confirm" disabled=move || !ready() on:click=confirm>
                {title(setting)} " now"
            </button>
            <button on:click=move |_| chosen.set(None)>"Cancel"</button>
        </div>
    }
}

/// What is to be written where, in words.
fn memory_change(address: u8, held: Option<u8>, data: u8) -> String {
    let held = held.map_or("what it holds".into(), byte_text);
    format!("Cell 0x{address:02X}: {held} becomes {}", byte_text(data))
}

/// The position in words.
fn position(shown: &Shown) -> String {
    match shown.turns {
        Some(turns) => format!("{turns} turns {:.4}°", shown.degrees),
        None => format!("{:.4}°", shown.degrees),
    }
}

/// A sequence that runs, or how it ended.
#[component]
fn Running(progress: Progress, chosen: RwSignal<Option<Setting>>) -> impl IntoView {
    let app = expect_context::<App>();
    let Progress {
        setting,
        done,
        total,
        count,
        before,
        held,
        outcome,
    } = progress;
    let again = move |_| {
        app.send(ToEngine::ForgetSetting);
        chosen.set(None);
    };
    let counted = count.map(|count| {
        view! {
            <p class="count" data-testid="zero-count" data-value=count.to_string()>
                {count} <small>" of 10 counted by the encoder"</small>
            </p>
        }
    });
    match outcome {
        None => view! {
            <p>
                <b>{title(setting)}</b>
                {if total == 0 { " — looking for other devices on the wire first." } else { " — nothing else is sent meanwhile." }}
            </p>
            <progress max=total value=done aria-label="commands done"></progress>
            {counted}
            <div class="doors">
                <button on:click=move |_| app.send(ToEngine::StopSetting)>"Stop"</button>
            </div>
        }
        .into_any(),
        Some(outcome) => {
            let tone = match outcome.changed {
                Some(true) => "lamp good",
                Some(false) => "lamp bad",
                None => "lamp warn",
            };
            let changed = match outcome.changed {
                Some(true) => "yes",
                Some(false) => "no",
                None => "unknown",
            };
            let in_memory = matches!(setting, Setting::Memory { .. });
            let before = match in_memory {
                true => held.map(byte_text),
                false => before.map(|before| position(&before)),
            };
            let now = move || {
                let snapshot = app.snapshot.get();
                match in_memory {
                    true => snapshot.memory.and_then(|cell| cell.data).map(byte_text),
                    false => snapshot.reading.map(|shown| position(&shown)),
                }
            };
            view! {
                <p class=tone data-testid="zero-outcome" data-value=changed>{outcome.text}</p>
                {counted}
                <dl class="counts">
                    {before.map(|before| view! { <dt>"before"</dt> <dd data-testid="setting-before">{before}</dd> })}
                    <dt>"now"</dt>
                    <dd data-testid="setting-now">{now}</dd>
                </dl>
                <div class="doors">
                    <button class="primary" on:click=again>"Done"</button>
                </div>
            }
            .into_any()
        }
    }
}
