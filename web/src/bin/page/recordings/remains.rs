//! Recordings that were cut off, offered with the next visit.

use super::{Recordings, deleting::Deleted, size_text};
use crate::app::{App, Source};
use encoderscope::{language::t, text};
use encoderscope_web::{
    browser::time_text,
    message::{Kept, Wish},
};
use leptos::prelude::*;

#[component]
pub(crate) fn Remains() -> impl IntoView {
    let app = expect_context::<App>();
    let recordings = Recordings::of(app);
    let remains = Memo::new(move |_| {
        let cut = |kept: &&Kept| !kept.whole && !kept.runs;
        let list = recordings.shown();
        list.iter().filter(cut).cloned().collect::<Vec<_>>()
    });
    // Behind the first view the list of recordings says it.
    let alone = Memo::new(move |_| app.source.get() == Source::Preview);
    view! {
        {move || alone.get().then(|| view! { <Deleted recordings=recordings /> })}
        <For each=move || remains.get() key=Kept::key let(kept)>
            <Offer recordings=recordings kept=kept />
        </For>
    }
}

#[component]
fn Offer(recordings: Recordings, kept: Kept) -> impl IntoView {
    let name = StoredValue::new(kept.name.clone());
    view! {
        <section class="panel remains" role="status" data-testid="remains" data-name=kept.name.clone()>
            <h2>{t("A recording was cut off")}</h2>
            <p>
                {text!(
                    "{}, {}, last written {}. It was not ended: the page was closed, or the browser or the machine stopped. Up to half a second before that, everything is there.",
                    kept.name,
                    size_text(kept.size),
                    time_text(kept.written)
                )}
            </p>
            <div class="doors">
                <button
                    class="primary"
                    data-testid="remains-replay"
                    on:click=move |_| recordings.replay(name.get_value())
                >
                    {t("Replay it")}
                </button>
                <button
                    data-testid="remains-save"
                    on:click=move |_| recordings.send(&Wish::Fetch(name.get_value()))
                >
                    {t("Save it")}
                </button>
                <button data-testid="remains-keep" on:click=move |_| recordings.send(&Wish::Settle(name.get_value()))>{t("Keep it")}</button>
                <button class="quiet" on:click=move |_| recordings.delete(name.get_value())>
                    {t("Delete it")}
                </button>
            </div>
        </section>
    }
}
