//! One quantity over time, drawn by uPlot.

use super::View;
use crate::app::App;
use encoderscope::{
    language::{number, t},
    text,
};
use encoderscope_web::plot::{Plot, Quantity, Trace};
use leptos::{html, prelude::*};
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use web_sys::HtmlElement;

#[wasm_bindgen]
extern "C" {
    /// Makes charts; `web/js/plot.js`.
    pub type Charts;
    #[wasm_bindgen(method)]
    pub fn chart(
        this: &Charts,
        element: &HtmlElement,
        quantity: &str,
        color: &str,
        over: &str,
        tell: &JsValue,
    ) -> Chart;

    /// A chart.
    pub type Chart;
    #[wasm_bindgen(method)]
    pub fn draw(
        this: &Chart,
        times: &[f64],
        values: &[f64],
        from: f64,
        to: f64,
        low: f64,
        high: f64,
    );
    #[wasm_bindgen(method)]
    pub fn mark(this: &Chart, at: f64);
    #[wasm_bindgen(method)]
    pub fn remove(this: &Chart);
}

/// Hears of gestures: which, and where.
pub(crate) type Tell = Closure<dyn FnMut(String, f64, f64)>;

/// Where a chart is to be.
pub(crate) struct Canvas {
    pub(crate) element: HtmlElement,
    /// What is drawn, in words for a reader of the page's code.
    pub(crate) quantity: &'static str,
    /// The token of its colour.
    pub(crate) color: &'static str,
    /// What it is drawn over: `time` or `rows`.
    pub(crate) over: &'static str,
    /// Is told of gestures; nothing once the chart is not wanted any more.
    pub(crate) tell: StoredValue<Option<Tell>, LocalStorage>,
    pub(crate) chart: RwSignal<Option<Rc<Chart>>, LocalStorage>,
}

impl Canvas {
    /// Makes the chart when the library for it has come.
    pub(crate) fn fill(self, app: App) {
        let workers = app.workers.get_value();
        leptos::task::spawn_local(async move {
            let Ok(charts) = workers.charts().await else {
                // The figures beside the chart say the same.
                return;
            };
            let charts: Charts = charts.unchecked_into();
            let made = self.tell.try_with_value(|tell| {
                let tell = tell.as_ref()?.as_ref();
                let chart = charts.chart(&self.element, self.quantity, self.color, self.over, tell);
                Some(Rc::new(chart))
            });
            self.chart.try_set(made.flatten());
        });
    }
}

/// How high a chart reaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Height {
    /// An angle is drawn on a whole turn.
    Whole,
    /// What is drawn fills the chart.
    Fit,
}

const fn color(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Angle => "--angle",
        Quantity::Speed => "--status",
        Quantity::Temperature => "--flags",
        Quantity::Errors => "--bad",
    }
}

/// The lowest and the highest value.
fn extremes(trace: &Trace) -> Option<(f64, f64)> {
    let mut values = trace.values.iter().filter(|value| !value.is_nan());
    let first = *values.next()?;
    Some(values.fold((first, first), |(low, high), value| {
        (low.min(*value), high.max(*value))
    }))
}

/// The range of the axis: round numbers around the values, so that it stays while they vary.
fn range(quantity: Quantity, height: Height, count: f64, trace: &Trace) -> (f64, f64) {
    let (low, high) = extremes(trace).unwrap_or_default();
    let (least, ends) = match (quantity, height) {
        (Quantity::Angle, Height::Whole) => return (0.0, 360.0),
        (Quantity::Angle, Height::Fit) => (8.0 * count, (0.0, 360.0)),
        (Quantity::Speed, _) => (0.2, (f64::MIN, f64::MAX)),
        (Quantity::Temperature, _) => (2.0, (f64::MIN, f64::MAX)),
        (Quantity::Errors, _) => (10.0, (0.0, f64::MAX)),
    };
    let spread = (high - low).max(least);
    let step = rounded(spread / 4.0);
    let middle = (low + high) / 2.0;
    let low = (low.min(middle - spread / 2.0) / step).floor() * step;
    let high = (high.max(middle + spread / 2.0) / step).ceil() * step;
    (low.max(ends.0), high.min(ends.1))
}

/// The next 1, 2 or 5 of a power of ten.
fn rounded(value: f64) -> f64 {
    let unit = 10f64.powf(value.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0];
    let step = steps.into_iter().find(|step| step * unit >= value);
    step.unwrap_or(10.0) * unit
}

/// A value with as many decimals as its quantity deserves, always as wide as its widest.
pub(super) fn value_text(quantity: Quantity, value: f64) -> String {
    let (width, places) = match quantity {
        Quantity::Angle => (9, 4),
        Quantity::Speed => (8, 3),
        Quantity::Temperature => (6, 1),
        Quantity::Errors => (4, 0),
    };
    let value = format!("{value:width$.places$}");
    let text = format!("{}{}", number(value), t(quantity.unit()));
    text.replace('-', "−")
}

/// The value that is drawn nearest to a time.
pub(super) fn value_at(trace: &Trace, at: f64) -> Option<f64> {
    let points = trace.times.iter().zip(&trace.values);
    let near = points
        .filter(|(_, value)| !value.is_nan())
        .map(|(time, value)| ((time - at).abs(), *value))
        .min_by(|one, other| one.0.total_cmp(&other.0))?;
    Some(near.1)
}

/// What a chart shows, in words.
fn summary(trace: Option<&Trace>, quantity: Quantity) -> String {
    let last = trace.and_then(|trace| trace.values.iter().rev().find(|value| !value.is_nan()));
    match (trace.and_then(extremes), last) {
        (Some((low, high)), Some(last)) => text!(
            "lowest{} · highest{} · last{}",
            value_text(quantity, low),
            value_text(quantity, high),
            value_text(quantity, *last)
        ),
        _ => t("nothing in this time").into(),
    }
}

fn trace_of(plot: &Plot, quantity: Quantity) -> Option<&Trace> {
    plot.traces.iter().find(|trace| trace.quantity == quantity)
}

#[component]
pub(super) fn ChartView(quantity: Quantity, view: View) -> impl IntoView {
    let place = NodeRef::<html::Div>::new();
    let chart = RwSignal::new_local(None::<Rc<Chart>>);
    let tell = Tell::new(move |what: String, a, b| {
        view.told(&what, a, b);
    });
    // Kept until the chart is gone, or it would call what is no more.
    let tell = StoredValue::new_local(Some(tell));
    Effect::new(move || {
        let Some(element) = place.get() else {
            return;
        };
        let canvas = Canvas {
            element: element.into(),
            quantity: quantity.name(),
            color: color(quantity),
            over: "time",
            tell,
            chart,
        };
        canvas.fill(view.app);
    });
    Effect::new(move || {
        let Some(chart) = chart.get() else {
            return;
        };
        let height = view.height.get();
        view.feed.plot.with(|plot| {
            let Some(trace) = trace_of(plot, quantity) else {
                return;
            };
            let (low, high) = range(quantity, height, view.count(), trace);
            chart.draw(&trace.times, &trace.values, plot.from, plot.to, low, high);
        });
    });
    Effect::new(move || {
        if let Some(chart) = chart.get() {
            chart.mark(view.mark.get().unwrap_or(f64::NAN));
        }
    });
    on_cleanup(move || {
        if let Some(chart) = chart.try_update_untracked(Option::take).flatten() {
            chart.remove();
        }
    });
    let says = Memo::new(move |_| {
        let says = |plot: &Plot| summary(trace_of(plot, quantity), quantity);
        view.feed.plot.with(says)
    });
    view! {
        <figure class="chart">
            <figcaption>
                <b>{t(quantity.name())}</b>
                <span>{says}</span>
            </figcaption>
            <div
                class="canvas"
                node_ref=place
                tabindex="0"
                role="img"
                aria-label=move || text!("{} over time: {}", t(quantity.name()), says.get())
                data-testid=format!("chart-{}", quantity.name())
            ></div>
        </figure>
    }
    .into_any()
}
