//! Input: a box to paste into, files, and how the text was read.

use super::count;
use crate::{app::App, desk::Named, parts};
use encoderscope::{language::t, text};
use encoderscope_web::message::Marked;
use js_sys::Array;
use leptos::{ev, html, prelude::*};
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{Blob, ClipboardEvent, DragEvent};

/// Letters that the box takes; a text box with more is slow to draw.
const BOXED: usize = 200_000;
/// Letters of the text whose reading is shown.
const SHOWN: usize = 8_000;

#[component]
pub(super) fn Paste() -> impl IntoView {
    let app = expect_context::<App>();
    let desk = app.desk();
    let over = RwSignal::new(false);
    let chooser = NodeRef::<html::Input>::new();
    let profile = move || app.profile.get_untracked();
    let typed = move |text: String| match text.len() > BOXED {
        // A box with so much in it would hold the page up at every letter.
        true => paste_as_file(app, &text),
        false => desk.typed(text, &profile()),
    };
    let pasted = move |event: ev::Event| {
        let Some(event) = event.dyn_ref::<ClipboardEvent>() else {
            return;
        };
        let text = event
            .clipboard_data()
            .and_then(|data| data.get_data("text").ok())
            .unwrap_or_default();
        if text.len() > BOXED {
            event.prevent_default();
            paste_as_file(app, &text);
        }
    };
    let open = move |files: Option<web_sys::FileList>| {
        let file = files.and_then(|files| files.get(0));
        match file {
            Some(file) if file.name().ends_with(".pcapng") => {
                leptos::task::spawn_local(async move {
                    // Without the network there is nothing to replay it with.
                    let _ = parts::replay(app, file.name(), file.into()).await;
                });
            }
            Some(file) => desk.open(Named::File(file.name()), file.into(), &profile()),
            None => {}
        }
    };
    let dropped = move |event: DragEvent| {
        event.prevent_default();
        over.set(false);
        let Some(data) = event.data_transfer() else {
            return;
        };
        let files = data.files();
        match files.as_ref().is_some_and(|files| files.length() > 0) {
            true => open(files),
            false => typed(data.get_data("text").unwrap_or_default()),
        }
    };
    view! {
        <div
            class="drop"
            class:over=move || over.get()
            on:dragover=move |event: DragEvent| {
                event.prevent_default();
                over.set(true);
            }
            on:dragleave=move |_| over.set(false)
            on:drop=dropped
        >
            {move || match desk.file.get() {
                Some(name) => view! {
                    <div class="file" data-testid="file">
                        <b>{name.title()}</b>
                        <button on:click=move |_| desk.typed(String::new(), &profile())>{t("Close")}</button>
                    </div>
                }.into_any(),
                None => view! {
                    <textarea
                        data-testid="dump-input"
                        aria-label=t("Dump")
                        spellcheck="false"
                        autocomplete="off"
                        placeholder=format!("{}\n\n1a 20 29 c0 3b 17 00 00 00 c8 37", t("Paste frames in any writing, or drop a file."))
                        prop:value=move || desk.text.get()
                        on:paste=move |event| pasted(event.into())
                        on:input:target=move |event| typed(event.target().value())
                    />
                }.into_any(),
            }}
        </div>
        <Progress />
        <ReadNote />
        <HowRead />
        {move || desk.refusal.get().map(|why| view! { <p class="fault" role="alert" data-testid="refusal">{why}</p> })}
        <div class="doors">
            <button data-testid="example" on:click=move |_| {
                let text = app.profile.get_untracked().format.manual().example;
                desk.typed(text.into(), &profile());
            }>
                {t("Show an example")}
            </button>
            <label class="button">
                {t("Open a file")}
                <input
                    type="file"
                    class="unseen"
                    data-testid="file-input"
                    node_ref=chooser
                    on:change=move |_| {
                        if let Some(input) = chooser.get() {
                            open(input.files());
                            // The same file may be chosen again.
                            input.set_value("");
                        }
                    }
                />
            </label>
            {move || (!desk.text.get().is_empty()).then(|| view! {
                <button on:click=move |_| desk.typed(String::new(), &profile())>{t("Clear")}</button>
            })}
        </div>
    }
}

/// Opens text as if it were a file.
fn paste_as_file(app: App, text: &str) {
    let parts = Array::of1(&JsValue::from_str(text));
    if let Ok(blob) = Blob::new_with_str_sequence(&parts) {
        let name = Named::Pasted(text.len());
        app.desk().open(name, blob, &app.profile.get_untracked());
    }
}

/// How far a long input is, and a way to stop.
#[component]
fn Progress() -> impl IntoView {
    let desk = expect_context::<App>().desk();
    let progress = Memo::new(move |_| {
        let overview = desk.overview.get();
        let (read, total) = overview.read;
        let busy = !overview.done && total > 0.0 && !desk.is_empty();
        busy.then(|| (read / total * 100.0).floor().clamp(0.0, 100.0))
    });
    move || {
        progress.get().map(|percent| {
            view! {
                <div class="progress" data-testid="progress" data-value=percent.to_string()>
                    <progress max="100" value=percent.to_string() aria-label=t("Reading")></progress>
                    <span class="number">{format!("{percent} %")}</span>
                    <button data-testid="cancel" on:click=move |_| desk.cancel()>{t("Stop")}</button>
                </div>
            }
        })
    }
}

/// What was read, in a line.
#[component]
fn ReadNote() -> impl IntoView {
    let desk = expect_context::<App>().desk();
    move || {
        let overview = desk.overview.get();
        let empty = desk.is_empty();
        let nothing = overview.done && overview.lines == 0.0;
        let unread = (overview.unread > 0.0).then(|| {
            text!(
                " {} {0|piece|pieces} cannot be read.",
                count(overview.unread)
            )
        });
        let dropped: Vec<_> = overview
            .dropped
            .iter()
            .map(|kind| kind.name.clone())
            .collect();
        let dropped = (!dropped.is_empty()).then(|| text!(" Left out: {}.", dropped.join(", ")));
        let said = match nothing {
            true => t("There are no bytes in it.").to_owned(),
            false => text!(
                "Read as {}: {} {1|line|lines}, {2} {2|byte|bytes}.",
                overview.writing,
                count(overview.lines),
                count(overview.bytes)
            ),
        };
        (!empty && (overview.lines > 0.0 || nothing)).then(|| {
            view! {
                <p class="hint" role="status" data-testid="read-note">
                    {said}
                    {dropped}
                    {unread.map(|unread| view! { <span class="fault">{unread}</span> })}
                </p>
                {overview.notes.into_iter().map(|note| view! { <p class="hint">{note}</p> }).collect_view()}
            }
        })
    }
}

/// The text with what was left out and what cannot be read, in place.
#[component]
fn HowRead() -> impl IntoView {
    let desk = expect_context::<App>().desk();
    move || {
        let marks = desk.marks.get();
        (!marks.is_empty() && !desk.is_empty()).then(|| {
            let text = desk.text.get_untracked();
            let unread = marks.iter().any(Marked::is_unread);
            view! {
                <details class="how-read" open=unread>
                    <summary>{t("How the text was read")}</summary>
                    <pre data-testid="how-read">{pieces(&text, &marks)}</pre>
                </details>
            }
        })
    }
}

/// The text cut at the marks.
fn pieces(text: &str, marks: &[Marked]) -> Vec<AnyView> {
    let end = (0..=SHOWN.min(text.len()))
        .rev()
        .find(|at| text.is_char_boundary(*at))
        .unwrap_or(0);
    let mut out = Vec::new();
    let mut at = 0;
    for mark in marks {
        let (start, stop) = (mark.start.max(at).min(end), mark.end.min(end));
        let (Some(before), Some(piece)) = (text.get(at..start), text.get(start..stop)) else {
            continue;
        };
        out.push(before.to_owned().into_any());
        let piece = piece.to_owned();
        out.push(match mark.is_unread() {
            true => view! { <mark data-testid="unread" title=t("cannot be read")>{piece}</mark> }
                .into_any(),
            false => view! { <s title=mark.kind.clone()>{piece}</s> }.into_any(),
        });
        at = stop;
    }
    out.push(text.get(at..end).unwrap_or_default().to_owned().into_any());
    if end < text.len() {
        out.push(view! { <i>{t(" … the rest is not shown")}</i> }.into_any());
    }
    out
}
