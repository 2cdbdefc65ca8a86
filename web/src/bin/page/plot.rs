//! The plot: angle, speed, temperature and errors over time.

mod chart;
mod view;

pub(crate) use chart::{Canvas, Chart};

use crate::app::App;
use chart::{ChartView, Height};
use encoderscope::{
    language::{number, t},
    text,
};
use encoderscope_web::{
    message::{Shown, Wish},
    plot::{Plot, Quantity, Rest},
};
use leptos::prelude::*;
use std::time::Duration;
use view::{Span, View};

/// How often the page asks.
const ASK: Duration = Duration::from_millis(100);
/// The standstill panel is brought up to date every second time.
const ASK_REST: u32 = 2;
/// Times after which an answer is no longer waited for.
const PATIENCE: u32 = 10;

/// What the engine has answered.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Feed {
    /// The last good reading, as fast as the page draws.
    pub(crate) reading: RwSignal<Option<Shown>>,
    pub(crate) plot: RwSignal<Plot>,
    pub(crate) rest: RwSignal<Option<Rest>>,
    /// The engine has said something of recordings.
    pub(crate) parcels: RwSignal<bool>,
}

impl Feed {
    pub(crate) fn new() -> Self {
        Self {
            reading: RwSignal::new(None),
            plot: RwSignal::new(Plot::default()),
            rest: RwSignal::new(None),
            parcels: RwSignal::new(false),
        }
    }
}

/// Keeps asking the engine, and goes back to the present when another link begins.
fn ask(view: View) {
    let app = view.app;
    let request = Memo::new(move |_| view.request());
    let waited = StoredValue::new(0u32);
    let ticks = StoredValue::new(0u32);
    Effect::new(move || app.wish(&Wish::Plot(request.get())));
    Effect::new(move || {
        view.feed.plot.track();
        waited.set_value(0);
    });
    let tick = move || {
        ticks.update_value(|ticks| *ticks = ticks.wrapping_add(1));
        if ticks.get_value().is_multiple_of(ASK_REST) {
            app.wish(&Wish::Rest);
        }
        if view.held.get_untracked().is_some() {
            return;
        }
        match waited.get_value() {
            0 => {
                waited.set_value(PATIENCE);
                app.wish(&Wish::Plot(request.get_untracked()));
            }
            left => waited.set_value(left - 1),
        }
    };
    if let Ok(timer) = set_interval_with_handle(tick, ASK) {
        on_cleanup(move || timer.clear());
    }
    Effect::new(move |before: Option<f64>| {
        let good = app.snapshot.with(|snapshot| snapshot.counts.good);
        if before.is_some_and(|before| before > good) {
            view.go_on();
        }
        good
    });
}

#[component]
pub(crate) fn PlotPanel() -> impl IntoView {
    let app = expect_context::<App>();
    let view = app.keep(|| View::new(app));
    ask(view);
    let plot = view.feed.plot;
    let available = Memo::new(move |_| plot.with(|plot| plot.available.clone()));
    let drawn = Memo::new(move |_| {
        let available = available.get();
        let has =
            |quantity: &Quantity| *quantity == Quantity::Angle || available.contains(quantity);
        view.shown.get().into_iter().filter(has).collect::<Vec<_>>()
    });
    let chart = move |quantity: Quantity| {
        let wanted = Memo::new(move |_| drawn.with(|drawn| drawn.contains(&quantity)));
        move || {
            wanted
                .get()
                .then(|| view! { <ChartView quantity=quantity view=view /> })
        }
    };
    let paused = move || view.held.get().is_some();
    let heading = move || match (view.held.get(), view.span.get()) {
        (Some(_), _) => t("Paused").into(),
        (None, Span::All) => t("Since the link was opened").into(),
        (None, span) => text!("Last {}", span.title()),
    };
    let stretch = move || {
        let (from, to) = view.held.get()?;
        let stretch = format!("{:.2} … {to:.2}", from.max(0.0));
        Some(text!("{} s", number(stretch)))
    };
    let points = move || {
        plot.with(|plot| {
            plot.traces
                .first()
                .map_or(0, |trace| trace.times.len())
                .to_string()
        })
    };
    view! {
        <section
            class="panel plot"
            data-testid="plot"
            data-points=points
            data-from=move || plot.with(|plot| plot.from.to_string())
            data-to=move || plot.with(|plot| plot.to.to_string())
            data-paused=move || paused().to_string()
        >
            <h2>{heading} <span>{stretch}</span></h2>
            <Controls view=view />
            {move || drawn.get().is_empty().then(|| view! { <p class="hint">{t("Choose what is drawn.")}</p> })}
            {Quantity::ALL.map(chart).into_iter().collect_view()}
            <div class="below">
                <Readout view=view />
                <div class="group" role="group" aria-label=t("Time that is shown")>
                    <button on:click=move |_| view.look(1.0, -0.5) aria-label=t("Earlier")>"◂"</button>
                    <button on:click=move |_| view.look(1.0, 0.5) aria-label=t("Later")>"▸"</button>
                    <button data-testid="plot-zoom-in" on:click=move |_| view.look(0.5, 0.0) aria-label=t("Zoom in")>"+"</button>
                    <button on:click=move |_| view.look(2.0, 0.0) aria-label=t("Zoom out")>"−"</button>
                </div>
            </div>
        </section>
    }
    .into_any()
}

#[component]
fn Controls(view: View) -> impl IntoView {
    let available = Memo::new(move |_| view.feed.plot.with(|plot| plot.available.clone()));
    let paused = move || view.held.get().is_some();
    let span = move |span: Span| {
        view! {
            <button
                data-testid="plot-span"
                aria-pressed=move || (!paused() && view.span.get() == span).to_string()
                on:click=move |_| {
                    view.span.set(span);
                    view.go_on();
                }
            >
                {span.title()}
            </button>
        }
    };
    let quantity = move |quantity: Quantity| {
        let offered =
            move || quantity == Quantity::Angle || available.with(|all| all.contains(&quantity));
        view! {
            <button
                data-testid=format!("plot-{}", quantity.name())
                aria-pressed=move || view.is_shown(quantity).to_string()
                hidden=move || !offered()
                on:click=move |_| view.toggle(quantity)
            >
                {t(quantity.name())}
            </button>
        }
    };
    let fits = move || view.height.get() == Height::Fit;
    view! {
        <div class="controls">
            <div class="group" role="group" aria-label=t("How it goes on")>
                <button
                    class="pause"
                    data-testid="plot-pause"
                    on:click=move |_| if view.held.get_untracked().is_some() { view.go_on() } else { view.pause() }
                >
                    {move || if paused() { t("Live") } else { t("Pause") }}
                </button>
                {Span::ALL.map(span).into_iter().collect_view()}
            </div>
            <div class="group" role="group" aria-label=t("What is drawn")>
                {Quantity::ALL.map(quantity).into_iter().collect_view()}
                <button
                    data-testid="plot-fit"
                    aria-pressed=move || fits().to_string()
                    title=t("Draw the angle as large as it fits, not on a whole turn")
                    on:click=move |_| view.height.set(if fits() { Height::Whole } else { Height::Fit })
                >
                    {t("fit angle")}
                </button>
            </div>
        </div>
    }
    .into_any()
}

#[component]
fn Readout(view: View) -> impl IntoView {
    let delta = move || view.delta();
    view! {
        <div
            class="readout"
            data-testid="plot-cursor"
            data-time=move || view.cursor.get().map(|time| time.to_string())
            data-mark=move || view.mark.get().map(|time| time.to_string())
            data-delta=move || delta().map(|(time, _)| time.to_string())
            data-value=move || delta().and_then(|(_, apart)| apart).map(|apart| apart.to_string())
        >
            {move || {
                let rows = view.readout();
                match rows.is_empty() {
                    true => view! {
                        <p class="hint">{t("Point at a chart to read it, click to set a mark, drag to zoom. Keys: ← → Enter Esc.")}</p>
                    }
                        .into_any(),
                    false => {
                        let rows = rows.into_iter();
                        let rows = rows.map(|(label, value)| view! { <div><dt>{label}</dt> <dd>{value}</dd></div> });
                        view! { <dl>{rows.collect_view()}</dl> }.into_any()
                    }
                }
            }}
        </div>
    }
    .into_any()
}
