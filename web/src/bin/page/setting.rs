//! Guided setting: zero, resets and address, with a gate in front and a proof behind.

use crate::{
    app::{App, summary},
    eeprom::{Eeprom, byte_text},
};
use encoderscope::{
    format::Format,
    language::{number, t},
    profile::Profile,
    sequence::Change,
    text,
};
use encoderscope_web::message::{Link, Progress, STILL, Setting, Shown, Snapshot, Wish};
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

fn title(setting: Setting) -> &'static str {
    match setting {
        Setting::Zero => t("Set zero"),
        Setting::ResetAngle => t("Reset angle"),
        Setting::ResetTurns => t("Reset turns"),
        Setting::ResetErrors => t("Reset errors"),
        Setting::Address(_) => t("Set address"),
        Setting::Memory { .. } => t("Write EEPROM"),
    }
}

fn meaning(setting: Setting) -> &'static str {
    match setting {
        Setting::Zero => t("The present position becomes 0, turns and angle, and is stored."),
        Setting::ResetAngle => t("The present angle becomes 0 and is stored; the turns stay."),
        Setting::ResetTurns => t("The turns become 0; the angle stays."),
        Setting::ResetErrors => t("The errors that the encoder keeps are cleared."),
        Setting::Address(_) => {
            t("Every device on the wire hears this and takes the new address: connect only one.")
        }
        Setting::Memory { .. } => t("The byte is stored in the encoder and stays without power."),
    }
}

/// What the panel is about; what changes within one of these does not build it anew, so that a
/// button can be pressed for as long as it takes.
#[derive(Clone, PartialEq)]
enum Phase {
    Doors,
    Gate(Setting),
    Running(Setting),
    Ended(Progress),
}

#[component]
pub(crate) fn SettingPanel() -> impl IntoView {
    let app = expect_context::<App>();
    let chosen = RwSignal::new(None::<Setting>);
    let progress = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.progress.clone()));
    let reading = move || app.snapshot.with(|snapshot| snapshot.link == Link::Reading);
    let settings = Memo::new(move |_| offered(&app.profile.get()));
    // What was chosen for one encoder is not done to another.
    let target = Memo::new(move |_| (reading(), app.port.get(), app.profile.get()));
    Effect::new(move || {
        let _ = target.get();
        chosen.set(None);
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
                        disabled=move || !reading() || app.snapshot.with(|snapshot| snapshot.busy)
                        on:click=move |_| chosen.set(Some(setting))
                    >
                        {title(setting)} "…"
                    </button>
                }
            })
            .collect_view()
    };
    let phase = Memo::new(move |_| match (progress.get(), chosen.get()) {
        (Some(progress), _) if progress.outcome.is_some() => Phase::Ended(progress),
        (Some(progress), _) => Phase::Running(progress.setting),
        (None, Some(setting)) => Phase::Gate(setting),
        (None, None) => Phase::Doors,
    });
    move || {
        let phase = phase.get();
        if settings.get().is_empty() && phase == Phase::Doors {
            return None;
        }
        Some(view! {
            <section class="panel setting">
                <h2>{t("Set the encoder")}</h2>
                {match phase {
                    Phase::Ended(progress) => view! { <Ended progress=progress chosen=chosen /> }.into_any(),
                    Phase::Running(setting) => view! { <Running setting=setting progress=progress /> }.into_any(),
                    Phase::Gate(setting) => view! { <Gate setting=setting chosen=chosen /> }.into_any(),
                    Phase::Doors => view! {
                        <div class="doors">{doors()}</div>
                        {has_memory(&app.profile.get()).then(|| view! { <Eeprom chosen=chosen /> })}
                    }
                    .into_any(),
                }}
            </section>
        })
    }
}

/// The encoder that a setting goes to.
fn target(profile: &Profile) -> impl IntoView + use<> {
    let address = match profile.format {
        Format::Bus => text!(", address {}", profile.address),
        _ => String::new(),
    };
    view! { {summary(profile)} {address} }
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
    let moved = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.moved));
    let held = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.memory?.data));
    let still = move || moved.get().is_some_and(|moved| moved < STILL);
    let ready = move || {
        let rest = !setting.needs_rest() || still();
        let fits = !matches!(setting, Setting::Address(_)) || wanted.get().is_some();
        let free = |snapshot: &Snapshot| snapshot.link == Link::Reading && !snapshot.busy;
        rest && fits && app.snapshot.with(free)
    };
    let gate = move || match moved.get() {
        None => (
            "lamp idle",
            t("waiting for a second of readings").to_owned(),
        ),
        Some(moved) if moved < STILL => ("lamp good", t("the shaft stands still").to_owned()),
        Some(moved) => (
            "lamp bad",
            text!(
                "the shaft moves: {}° within a second",
                number(format_args!("{:.2}", moved * 360.0))
            ),
        ),
    };
    let confirm = move |_| {
        let setting = match (setting, wanted.get_untracked()) {
            (Setting::Address(_), Some(address)) => Setting::Address(address),
            (setting, _) => setting,
        };
        chosen.set(None);
        app.wish(&Wish::Set(setting));
    };
    view! {
        <p><b>{title(setting)}</b> ". " {meaning(setting)}</p>
        <p class="hint">{t("Goes to")} " " {move || target(&app.profile.get())} "."</p>
        {setting.needs_rest().then(|| view! {
            <p class="hint">{t("Switch the drive off first. On a vertical axis secure the load: a drive that trusts the old zero may move.")}</p>
            <p class=move || gate().0 data-testid="gate" data-value=move || still().to_string()>{move || gate().1}</p>
        })}
        {matches!(setting, Setting::Address(_)).then(|| view! {
            <label>
                {t("New address, 0…31")}
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
                {text!("{} now", title(setting))}
            </button>
            <button on:click=move |_| chosen.set(None)>{t("Cancel")}</button>
        </div>
    }
}

/// What is to be written where, in words.
fn memory_change(address: u8, held: Option<u8>, data: u8) -> String {
    let held = held.map_or_else(|| t("what it holds").into(), byte_text);
    text!(
        "Cell {}: {} becomes {}",
        format_args!("0x{address:02X}"),
        held,
        byte_text(data)
    )
}

/// The position in words.
fn position(shown: &Shown) -> String {
    let degrees = number(format!("{:.4}°", shown.degrees));
    match shown.turns {
        Some(turns) => text!("{} {0|turn|turns} {}", turns, degrees),
        None => degrees.to_string(),
    }
}

/// A sequence that runs.
#[component]
fn Running(setting: Setting, progress: Memo<Option<Progress>>) -> impl IntoView {
    let app = expect_context::<App>();
    let read = move |read: fn(&Progress) -> u32| {
        Memo::new(move |_| progress.get().as_ref().map_or(0, read))
    };
    let (done, total) = (
        read(|progress| progress.done),
        read(|progress| progress.total),
    );
    let count = Memo::new(move |_| progress.get().and_then(|progress| progress.count));
    let hint = move || match total.get() {
        0 => t(" — looking for other devices on the wire first."),
        _ => t(" — nothing else is sent meanwhile."),
    };
    view! {
        <p><b>{title(setting)}</b> {hint}</p>
        <progress max=total value=done aria-label=t("commands done")></progress>
        {move || count.get().map(counted)}
        <div class="doors">
            <button on:click=move |_| app.wish(&Wish::StopSetting)>{t("Stop")}</button>
        </div>
    }
}

/// What the encoder has counted.
fn counted(count: u8) -> impl IntoView {
    view! {
        <p class="count" data-testid="zero-count" data-value=count.to_string()>
            {count} <small>{t(" of 10 counted by the encoder")}</small>
        </p>
    }
}

/// How a sequence ended.
#[component]
fn Ended(progress: Progress, chosen: RwSignal<Option<Setting>>) -> impl IntoView {
    let app = expect_context::<App>();
    let Progress {
        setting,
        count,
        before,
        held,
        outcome,
        ..
    } = progress;
    let again = move |_| {
        app.wish(&Wish::ForgetSetting);
        chosen.set(None);
    };
    outcome.map(|outcome| {
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
            app.snapshot.with(|snapshot| match in_memory {
                true => snapshot.memory?.data.map(byte_text),
                false => snapshot.reading.map(|shown| position(&shown)),
            })
        };
        view! {
            <p class=tone data-testid="zero-outcome" data-value=changed>{outcome.text}</p>
            {count.map(counted)}
            <dl class="counts">
                {before.map(|before| view! { <dt>{t("before")}</dt> <dd data-testid="setting-before">{before}</dd> })}
                <dt>{t("now")}</dt>
                <dd data-testid="setting-now">{now}</dd>
            </dl>
            <div class="doors">
                <button class="primary" on:click=again>{t("Done")}</button>
            </div>
        }
    })
}
