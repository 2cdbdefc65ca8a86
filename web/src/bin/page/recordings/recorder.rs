//! Making a recording.

use super::{Recordings, clock_text, retold, size_text};
use crate::app::{App, Source};
use encoderscope::{
    language::{msg, t},
    text,
};
use encoderscope_web::{
    browser::property,
    message::{Place, Recording, Wish},
};
use js_sys::{Function, Object, Promise, Reflect};
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use wasm_bindgen_futures::JsFuture;
use web_sys::StorageManager;

/// A note of which nothing else is said, before its number.
pub(super) const MARKER: &str = msg("marker ");

/// Starts and ends a recording, and leaves notes in it.
#[component]
pub(crate) fn RecordButton() -> impl IntoView {
    let app = expect_context::<App>();
    let recordings = Recordings::of(app);
    let recording = Memo::new(move |_| recordings.state.with(|state| state.recording.clone()));
    let runs = app.recording;
    let press = move |_| match runs.get_untracked() {
        true => recordings.send(&Wish::StopRecording),
        false => {
            // A browser that is asked keeps recordings when it runs out of room for other sites.
            if let Ok(storage) = property(&window().navigator(), "storage").dyn_into() {
                let storage: StorageManager = storage;
                let _ = storage.persist();
            }
            recordings.notes.set_value(0);
            recordings.send(&Wish::Record);
        }
    };
    let may = move || runs.get() || app.source.get() != Source::Replay;
    view! {
        {move || may().then(|| view! {
            <div class="recorder">
                <button
                    class="record"
                    data-testid="record"
                    aria-pressed=move || runs.get().to_string()
                    on:click=press
                >
                    {move || if runs.get() { t("Stop recording") } else { t("Record") }}
                </button>
                {move || recording.get().filter(|one| one.runs).map(|one| view! {
                    <span class="number" data-testid="recorded" data-value=one.size.to_string()>
                        {clock_text(one.seconds)} " · " {size_text(one.size)}
                    </span>
                })}
            </div>
        })}
        {move || runs.get().then(|| view! { <Notes recordings=recordings /> })}
        {move || recording.get().map(|one| view! { <Remarks recording=one /> })}
    }
}

/// What is to be known of a recording that runs or has ended.
#[component]
fn Remarks(recording: Recording) -> impl IntoView {
    let in_memory = recording.runs && recording.place == Place::Memory;
    view! {
        {in_memory.then(|| view! {
            <p class="hint" data-testid="record-memory">
                {t(
                    "This browser keeps no files for this page: the recording is in memory alone, and gone with \
                     the page. Save it when it has ended.",
                )}
            </p>
        })}
        {recording.copy.map(|name| view! {
            <p class="hint" data-testid="record-copy">{match recording.runs {
                true => text!("Also written to {}, which is there when the recording has ended.", name),
                false => text!("Also written to {}.", name),
            }}</p>
        })}
        {recording.fault.map(|why| view! {
            <p class="fault" role="alert" data-testid="record-fault">
                {match recording.runs {
                    true => retold(&why),
                    false => text!("The recording has ended: {} What came before is kept.", retold(&why)),
                }}
            </p>
        })}
    }
}

/// Notes, and the copy on disk.
#[component]
fn Notes(recordings: Recordings) -> impl IntoView {
    let note = recordings.note;
    let leave = move || {
        recordings.notes.update_value(|notes| *notes += 1);
        let text = note.get_untracked();
        let text = match text.trim() {
            "" => format!("{MARKER}{}", recordings.notes.get_value()),
            text => text.to_owned(),
        };
        note.set(String::new());
        recordings.send(&Wish::Mark(text));
    };
    let can_copy = property(&window(), "showSaveFilePicker").is_function();
    view! {
        <form
            class="note"
            on:submit=move |event| {
                event.prevent_default();
                leave();
            }
        >
            <input
                name="note"
                aria-label=t("Note")
                placeholder=t("what happens now")
                prop:value=move || note.get()
                on:input:target=move |event| note.set(event.target().value())
            />
            <button data-testid="record-mark">{t("Mark")}</button>
        </form>
        {can_copy.then(|| view! {
            <button
                class="quiet"
                data-testid="record-to-disk"
                on:click=move |_| leptos::task::spawn_local(copy(recordings))
            >
                {t("Write it to disk as well…")}
            </button>
        })}
    }
}

/// Lets the user choose a file that the recording goes to as well.
async fn copy(recordings: Recordings) {
    let Some(name) = recordings
        .state
        .with_untracked(|state| Some(state.recording.as_ref()?.name.clone()))
    else {
        return;
    };
    let options = Object::new();
    // A plain object takes every property.
    let _ = Reflect::set(&options, &"suggestedName".into(), &name.into());
    let ask: Function = property(&window(), "showSaveFilePicker").unchecked_into();
    // Nothing is chosen when this fails.
    if let Ok(asked) = ask.call1(&window(), &options)
        && let Ok(handle) = JsFuture::from(asked.unchecked_into::<Promise>()).await
    {
        recordings.post(&Wish::Copy, &handle);
    }
}
