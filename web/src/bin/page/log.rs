//! The raw log: every frame with its time, direction, bytes and verdict.

mod by_hand;
mod controls;
mod inspect;

pub(crate) use by_hand::ByHand;
pub(crate) use controls::Controls;
pub(crate) use inspect::Inspect;

use crate::{
    app::{App, Source},
    parts::{self, later},
};
use encoderscope::language::{msg, number, t};
use encoderscope_web::message::{ENTRIES, Entry, LogFilter, ToEngine};
use leptos::prelude::*;

/// What is looked at of the log.
#[derive(Clone, Copy)]
pub(crate) struct LogView {
    filter: RwSignal<LogFilter>,
    /// The entries that are looked at while the log goes on.
    held: RwSignal<Option<Vec<Entry>>>,
    chosen: RwSignal<Option<Entry>>,
}

impl LogView {
    fn new() -> Self {
        Self {
            filter: RwSignal::new(LogFilter::All),
            held: RwSignal::new(None),
            chosen: RwSignal::new(None),
        }
    }

    fn go_on(self) {
        self.chosen.set(None);
        self.held.set(None);
    }

    fn show(self, app: App, wanted: LogFilter) {
        self.filter.set(wanted);
        self.held.set(None);
        app.send(&ToEngine::Log(wanted));
    }
}

#[component]
pub(crate) fn Frames() -> impl IntoView {
    let app = expect_context::<App>();
    let view = LogView::new();
    app.send(&ToEngine::Log(LogFilter::All));
    // What was chosen is explained by the profile that it came with.
    Effect::new(move || {
        app.profile.track();
        view.go_on();
    });
    let (log, set_log) = signal(Vec::new());
    Effect::new(move || {
        let held = view.held.get();
        let new = held.unwrap_or_else(|| app.snapshot.with(|snapshot| snapshot.log.clone()));
        if log.with_untracked(|log| *log != new) {
            set_log.set(new);
        }
    });
    let choose = move |index: usize| {
        // A row that runs away cannot be looked at.
        let log = log.get_untracked();
        view.chosen.set(log.get(index).cloned());
        view.held.set(Some(log));
    };
    let close = Callback::new(move |()| view.go_on());
    let sent = Callback::new(move |()| view.show(app, LogFilter::Beside));
    let reads = move || app.source.get() != Source::Preview;
    let sends = move || reads() && app.source.get() != Source::Replay;
    view! {
        <section class="panel frames">
            <h2>{t("Frames")}</h2>
            {move || reads().then(|| later(move || parts::log_controls(view), || ()))}
            <div class="rows-of">
                <table>
                    <thead>
                        <tr>
                            <th>{t("time")}</th>
                            <th><span class="unseen">{t("direction")}</span></th>
                            <th>{t("bytes")}</th>
                            <th>{t("check")}</th>
                        </tr>
                    </thead>
                    <tbody>
                        {(0..ENTRIES).map(|index| view! { <Row index=index log=log chosen=view.chosen choose=choose /> }).collect_view()}
                    </tbody>
                </table>
            </div>
            {move || view.chosen.get().map(|entry| later(move || parts::inspect(entry.clone(), close), || ()))}
            {move || sends().then(|| later(move || parts::by_hand(sent), || ()))}
        </section>
    }
}

/// A row, whose cells follow the log.
///
/// They are not made anew with what they show: what an effect has read keeps a place for it for
/// ever, even when its view is gone, and noise changes rows many times a second.
#[component]
fn Row(
    index: usize,
    log: ReadSignal<Vec<Entry>>,
    chosen: RwSignal<Option<Entry>>,
    choose: impl Fn(usize) + Copy + Send + Sync + 'static,
) -> impl IntoView {
    let exists = Memo::new(move |_| log.with(|log| log.len() > index));
    let cell = move |show: fn(&Entry) -> String| {
        move || log.with(|log| log.get(index).map(show).unwrap_or_default())
    };
    let bytes = move || {
        log.with(|log| {
            let bytes = log.get(index).map_or(&[][..], |entry| &entry.bytes);
            let bytes = bytes.iter().map(|(byte, class)| {
                view! { <span class=format!("byte {class}")>{format!("{byte:02X}")}</span> }
            });
            bytes.collect_view()
        })
    };
    let is_chosen = move || {
        let is = |log: &Vec<Entry>| {
            chosen.with(|chosen| chosen.is_some() && chosen.as_ref() == log.get(index))
        };
        log.with(is)
    };
    let ok = move || log.with(|log| Some(log.get(index)?.ok?.to_string()));
    let row = move || {
        view! {
            <tr
                class:chosen=is_chosen
                data-testid="frame-row"
                data-direction=cell(|entry| direction(entry).to_owned())
                data-ok=ok
                on:click=move |_| choose(index)
            >
                <td class="time">
                    <button class="quiet" title=t("Explain these bytes")>
                        {cell(|entry| number(format_args!("{:.4}", entry.time)).to_string())}
                    </button>
                </td>
                <td title=cell(|entry| t(direction(entry)).to_owned())>{cell(|entry| if entry.sent { "→" } else { "←" }.into())}</td>
                <td class="bytes">{bytes}</td>
                <td class=cell(verdict)>{cell(|entry| if entry.ok == Some(true) { "✓" } else { t(&entry.text) }.to_owned())}</td>
            </tr>
        }
    };
    move || exists.get().then(row)
}

const fn direction(entry: &Entry) -> &'static str {
    if entry.sent {
        msg("sent")
    } else {
        msg("received")
    }
}

fn verdict(entry: &Entry) -> String {
    match entry.ok {
        Some(true) => "verdict good",
        Some(false) => "verdict bad",
        None => "verdict",
    }
    .into()
}
