//! Deleting a recording, which can be undone for a while.

use super::Recordings;
use encoderscope::{language::t, text};
use encoderscope_web::message::{Kept, Wish};
use leptos::{html, leptos_dom::helpers::TimeoutHandle, prelude::*};
use std::time::Duration;

/// How long a deletion can be undone; a page that is closed before deletes nothing.
const UNDONE: Duration = Duration::from_secs(20);

/// The recording that will be deleted, and when that is done.
#[derive(Clone)]
pub(super) struct Doomed {
    name: String,
    timeout: TimeoutHandle,
}

impl Recordings {
    /// Those that are there, without the one that will be deleted.
    pub(super) fn shown(self) -> Vec<Kept> {
        let doomed = self.doomed.get().map(|doomed| doomed.name);
        let list = self.list.get().into_iter();
        list.filter(|kept| Some(&kept.name) != doomed.as_ref())
            .collect()
    }

    /// Takes a recording away; one that was taken away before is gone now.
    pub(super) fn delete(self, name: String) {
        self.finish_deletion();
        if let Ok(timeout) = set_timeout_with_handle(move || self.finish_deletion(), UNDONE) {
            self.pressed.set_value(true);
            self.doomed.set(Some(Doomed { name, timeout }));
        }
    }

    fn undelete(self) {
        if let Some(doomed) = self.doomed.get_untracked() {
            doomed.timeout.clear();
            self.doomed.set(None);
        }
    }

    fn finish_deletion(self) {
        if let Some(Doomed { name, timeout }) = self.doomed.get_untracked() {
            timeout.clear();
            self.send(&Wish::Delete(name.clone()));
            // The engine says the same a moment later, or what went wrong.
            self.list
                .update(|list| list.retain(|kept| kept.name != name));
            self.doomed.set(None);
        }
    }
}

/// Says what was deleted, and undoes it.
#[component]
pub(super) fn Deleted(recordings: Recordings) -> impl IntoView {
    let button = NodeRef::<html::Button>::new();
    // The button that was pressed is gone with its row.
    Effect::new(move |_| {
        if let (Some(button), true) = (button.get(), recordings.pressed.get_value()) {
            recordings.pressed.set_value(false);
            let _ = button.focus();
        }
    });
    let said = move |doomed: Doomed| {
        view! {
            <p class="hint" data-testid="deleted">
                {text!("{} is deleted.", doomed.name)} " "
                <button node_ref=button data-testid="undelete" on:click=move |_| recordings.undelete()>{t("Undo")}</button>
            </p>
        }
    };
    view! { <div role="status">{move || recordings.doomed.get().map(said)}</div> }
}
