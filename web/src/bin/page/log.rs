//! The raw log: every frame with its time, direction, bytes and verdict.

mod by_hand;
mod inspect;

pub(crate) use by_hand::ByHand;
pub(crate) use inspect::Inspect;

use crate::{
    app::{App, Source},
    parts::{self, later},
};
use encoderscope_web::message::{Entry, LogFilter, ToEngine};
use leptos::prelude::*;

#[component]
pub(crate) fn Frames() -> impl IntoView {
    let app = expect_context::<App>();
    let filter = RwSignal::new(LogFilter::All);
    let held = RwSignal::new(None::<Vec<Entry>>);
    let chosen = RwSignal::new(None::<Entry>);
    app.send(ToEngine::Log(LogFilter::All));
    // What was chosen is explained by the profile that it came with.
    Effect::new(move || {
        app.profile.track();
        chosen.set(None);
        held.set(None);
    });
    let log = Memo::new(move |_| held.get().unwrap_or_else(|| app.snapshot.get().log));
    let choose = move |entry: Entry| {
        // A row that runs away cannot be looked at.
        held.set(Some(log.get_untracked()));
        chosen.set(Some(entry));
    };
    let show = move |wanted: LogFilter| {
        filter.set(wanted);
        held.set(None);
        app.send(ToEngine::Log(wanted));
    };
    let close = Callback::new(move |()| {
        chosen.set(None);
        held.set(None);
    });
    let sent = Callback::new(move |()| show(LogFilter::Beside));
    let pause = move |_| {
        held.update(|held| {
            *held = match held {
                Some(_) => None,
                None => Some(app.snapshot.get_untracked().log),
            };
        });
    };
    let filters = [
        (LogFilter::All, "all"),
        (LogFilter::Received, "received"),
        (LogFilter::Sent, "sent"),
        (LogFilter::Faults, "faults"),
        (LogFilter::Beside, "other"),
    ];
    view! {
        <section class="panel frames">
            <h2>"Frames"</h2>
            <div class="doors bar-of" role="group" aria-label="Which frames">
                {filters.map(|(wanted, text)| view! {
                    <button
                        class="quiet"
                        class:chosen=move || filter.get() == wanted
                        aria-pressed=move || (filter.get() == wanted).to_string()
                        data-testid="log-filter"
                        data-value=text
                        on:click=move |_| show(wanted)
                    >
                        {text}
                    </button>
                }).collect_view()}
                <button class="quiet" data-testid="log-pause" aria-pressed=move || held.get().is_some().to_string() on:click=pause>
                    {move || if held.get().is_some() { "go on" } else { "pause" }}
                </button>
            </div>
            <div class="rows-of">
                <table>
                    <thead>
                        <tr>
                            <th>"time"</th>
                            <th><span class="unseen">"direction"</span></th>
                            <th>"bytes"</th>
                            <th>"check"</th>
                        </tr>
                    </thead>
                    <tbody>
                        {move || log.get().into_iter().map(|entry| view! { <EntryRow entry=entry chosen=chosen choose=choose /> }).collect_view()}
                    </tbody>
                </table>
            </div>
            {move || chosen.get().map(|entry| later(move || parts::inspect(entry.clone(), close), || ()))}
            {move || (app.source.get() != Source::Preview).then(|| later(move || parts::by_hand(sent), || ()))}
        </section>
    }
}

#[component]
fn EntryRow(
    entry: Entry,
    chosen: RwSignal<Option<Entry>>,
    choose: impl Fn(Entry) + Copy + 'static,
) -> impl IntoView {
    let bytes = entry.bytes.iter().map(|(byte, class)| {
        view! { <span class=format!("byte {class}")>{format!("{byte:02X}")}</span> }
    });
    let bytes = bytes.collect_view();
    let verdict = match entry.ok {
        Some(true) => ("verdict good", "✓".to_owned()),
        Some(false) => ("verdict bad", entry.text.clone()),
        None => ("verdict", entry.text.clone()),
    };
    let (direction, arrow) = if entry.sent {
        ("sent", "→")
    } else {
        ("received", "←")
    };
    let mine = entry.clone();
    let is_chosen = move || chosen.get().as_ref() == Some(&mine);
    let (ok, time) = (entry.ok, entry.time);
    view! {
        <tr
            class:chosen=is_chosen
            data-testid="frame-row"
            data-direction=direction
            data-ok=ok.map(|ok| ok.to_string())
            on:click=move |_| choose(entry.clone())
        >
            <td class="time"><button class="quiet" title="Explain these bytes">{format!("{time:.4}")}</button></td>
            <td title=direction>{arrow}</td>
            <td class="bytes">{bytes}</td>
            <td class=verdict.0>{verdict.1}</td>
        </tr>
    }
}
