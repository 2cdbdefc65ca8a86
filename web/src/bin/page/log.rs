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
    let log = Memo::new(move |_| {
        let held = view.held.get();
        held.unwrap_or_else(|| app.snapshot.with(|snapshot| snapshot.log.clone()))
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

/// A row, made anew only when its shape changes; what is in it follows the log.
#[component]
fn Row(
    index: usize,
    log: Memo<Vec<Entry>>,
    chosen: RwSignal<Option<Entry>>,
    choose: impl Fn(usize) + Copy + Send + Sync + 'static,
) -> impl IntoView {
    let shape = Memo::new(move |_| log.with(|log| log.get(index).map(Shape::of)));
    let time = move || {
        log.with(|log| {
            log.get(index)
                .map(|entry| number(format_args!("{:.4}", entry.time)).to_string())
        })
    };
    let byte = move |place: usize| {
        log.with(|log| {
            let (byte, _) = log.get(index)?.bytes.get(place)?;
            Some(format!("{byte:02X}"))
        })
    };
    let is_chosen = move || {
        let is = |log: &Vec<Entry>| {
            chosen.with(|chosen| chosen.is_some() && chosen.as_ref() == log.get(index))
        };
        log.with(is)
    };
    move || {
        let shape = shape.get()?;
        let classes = shape.classes.into_iter().enumerate();
        let bytes = classes.map(|(place, class)| {
            view! { <span class=format!("byte {class}")>{move || byte(place)}</span> }
        });
        let verdict = match shape.ok {
            Some(true) => ("verdict good", "✓".to_owned()),
            Some(false) => ("verdict bad", t(&shape.text).to_owned()),
            None => ("verdict", t(&shape.text).to_owned()),
        };
        let (direction, arrow) = if shape.sent {
            (msg("sent"), "→")
        } else {
            (msg("received"), "←")
        };
        Some(view! {
            <tr
                class:chosen=is_chosen
                data-testid="frame-row"
                data-direction=direction
                data-ok=shape.ok.map(|ok| ok.to_string())
                on:click=move |_| choose(index)
            >
                <td class="time"><button class="quiet" title=t("Explain these bytes")>{time}</button></td>
                <td title=t(direction)>{arrow}</td>
                <td class="bytes">{bytes.collect_view()}</td>
                <td class=verdict.0>{verdict.1}</td>
            </tr>
        })
    }
}

/// An entry without its time and its values.
#[derive(Clone, Debug, PartialEq)]
struct Shape {
    sent: bool,
    ok: Option<bool>,
    text: String,
    classes: Vec<String>,
}

impl Shape {
    fn of(entry: &Entry) -> Self {
        Self {
            sent: entry.sent,
            ok: entry.ok,
            text: entry.text.clone(),
            classes: entry.bytes.iter().map(|(_, class)| class.clone()).collect(),
        }
    }
}
