//! The recordings that are there, and the support file.

use super::{
    Recordings,
    compare::Comparison,
    deleting::Deleted,
    report::{Handing, Opened},
    size_text,
};
use crate::app::App;
use encoderscope::language::t;
use encoderscope_web::{
    browser::time_text,
    message::{Kept, Wish},
};
use leptos::{html, prelude::*};

#[component]
pub(crate) fn RecordingsPanel() -> impl IntoView {
    let app = expect_context::<App>();
    let recordings = Recordings::of(app);
    // What is chosen to be compared, by name.
    let chosen = RwSignal::new(Vec::<String>::new());
    let compare = move |_| {
        if let [one, other] = &chosen.get_untracked()[..] {
            recordings.comparison.set(None);
            recordings.send(&Wish::Compare([one.clone(), other.clone()]));
        }
    };
    let is_empty = Memo::new(move |_| recordings.shown().is_empty());
    view! {
        <Opened recordings=recordings />
        <section class="panel recordings">
            <h2>{t("Recordings")}</h2>
            {move || recordings.fault.get().map(|why| view! { <p class="fault" role="alert" data-testid="recordings-fault">{why}</p> })}
            {move || match is_empty.get() {
                true => view! {
                    <p class="hint">
                        {t(
                            "A recording keeps every byte with its time and direction. It is written to this browser's \
                             storage as it comes, so that a crash takes half a second at most; Wireshark opens it, and \
                             so does this page.",
                        )}
                    </p>
                }.into_any(),
                false => view! {
                    <table data-testid="recordings">
                        <thead>
                            <tr>
                                <th><span class="unseen">{t("compare")}</span></th>
                                <th>{t("name")}</th>
                                <th>{t("written")}</th>
                                <th>{t("size")}</th>
                                <th><span class="unseen">{t("what to do")}</span></th>
                            </tr>
                        </thead>
                        <tbody>
                            <For each=move || recordings.shown() key=Kept::key let(kept)>
                                <Row recordings=recordings kept=kept chosen=chosen />
                            </For>
                        </tbody>
                    </table>
                }.into_any(),
            }}
            <Deleted recordings=recordings />
            <div class="doors">
                <OpenFile recordings=recordings />
                {move || (recordings.shown().len() > 1).then(|| view! {
                    <button
                        data-testid="compare"
                        disabled=move || chosen.with(Vec::len) != 2
                        title=t("Choose two recordings")
                        on:click=compare
                    >
                        {t("Compare two")}
                    </button>
                })}
                <Handing recordings=recordings />
            </div>
            <Comparison recordings=recordings />
        </section>
    }
}

#[component]
fn Row(recordings: Recordings, kept: Kept, chosen: RwSignal<Vec<String>>) -> impl IntoView {
    let name = StoredValue::new(kept.name.clone());
    let name = move || name.get_value();
    let choose = move |on: bool| {
        chosen.update(|chosen| {
            chosen.retain(|known| *known != name());
            if on {
                chosen.push(name());
            }
            // The one that was chosen first gives way.
            if chosen.len() > 2 {
                chosen.remove(0);
            }
        });
    };
    let note = match (kept.runs, kept.whole) {
        (true, _) => Some(t("runs")),
        (false, false) => Some(t("cut off")),
        (false, true) => None,
    };
    view! {
        <tr data-testid="recording" data-name=name() data-whole=kept.whole.to_string()>
            <td>
                <input
                    type="checkbox"
                    aria-label=t("Compare")
                    prop:checked=move || chosen.with(|chosen| chosen.contains(&name()))
                    on:change:target=move |event| choose(event.target().checked())
                />
            </td>
            <td class="name">{name()} {note.map(|note| view! { " " <small>{note}</small> })}</td>
            <td class="number">{time_text(kept.written)}</td>
            <td class="number">{size_text(kept.size)}</td>
            <td class="doors">
                <button data-testid="replay" disabled=kept.runs on:click=move |_| recordings.replay(name())>{t("Replay")}</button>
                <button data-testid="save" on:click=move |_| recordings.send(&Wish::Fetch(name()))>{t("Save")}</button>
                <button
                    class="quiet"
                    data-testid="delete"
                    disabled=kept.runs
                    on:click=move |_| {
                        chosen.update(|chosen| chosen.retain(|known| *known != name()));
                        recordings.delete(name());
                    }
                >
                    {t("Delete")}
                </button>
            </td>
        </tr>
    }
}

/// Replays a file of the user's, or opens a support file.
#[component]
fn OpenFile(recordings: Recordings) -> impl IntoView {
    let chooser = NodeRef::<html::Input>::new();
    view! {
        <label class="button">
            {t("Open a recording or support file")}
            <input
                type="file"
                class="unseen"
                accept=".pcapng"
                data-testid="recording-file"
                node_ref=chooser
                on:change=move |_| {
                    if let Some(input) = chooser.get() {
                        if let Some(file) = input.files().and_then(|files| files.get(0)) {
                            recordings.open(file.name(), &file);
                        }
                        // The same file may be chosen again.
                        input.set_value("");
                    }
                }
            />
        </label>
    }
}
