//! The angle over the rows.

use crate::{
    app::App,
    plot::{Canvas, Chart},
};
use encoderscope::language::t;
use encoderscope_web::message::ToDesk;
use leptos::{html, prelude::*};
use std::rc::Rc;
use wasm_bindgen::prelude::*;

/// Columns before the chart has said how wide it is.
const COLUMNS: usize = 600;

#[component]
pub(super) fn AngleChart() -> impl IntoView {
    let app = expect_context::<App>();
    let desk = app.desk();
    let place = NodeRef::<html::Div>::new();
    let chart = RwSignal::new_local(None::<Rc<Chart>>);
    let begun = StoredValue::new(false);
    let columns = RwSignal::new(COLUMNS);
    // All rows, or those that were zoomed to.
    let zoom = RwSignal::new(None::<(usize, usize)>);
    let total = Memo::new(move |_| desk.overview.get().rows);
    let tell =
        Closure::<dyn FnMut(String, f64, f64)>::new(move |what: String, a: f64, b: f64| match what
            .as_str()
        {
            "zoom" => zoom.set(Some((a.max(0.0) as usize, b.max(a + 1.0).ceil() as usize))),
            "live" => zoom.set(None),
            "width" => columns.set((a as usize).max(100)),
            "mark" if a >= 0.0 => desk.send(ToDesk::Place(a.round() as usize)),
            _ => {}
        });
    // Kept until the chart is gone, or it would call what is no more.
    let tell = StoredValue::new_local(Some(tell));
    // Not before there is something to draw: opening a file is work enough for one task.
    let traced = Memo::new(move |_| desk.trace.with(|trace| !trace.rows.is_empty()));
    Effect::new(move || {
        let (Some(element), true) = (place.get(), traced.get()) else {
            return;
        };
        if std::mem::replace(&mut *begun.write_value(), true) {
            return;
        }
        let canvas = Canvas {
            element: element.into(),
            quantity: "angle",
            color: "--angle",
            over: "rows",
            tell,
            chart,
        };
        canvas.fill(app);
    });
    let profile = Memo::new(move |_| desk.overview.get().profile);
    Effect::new(move || {
        let _ = profile.get();
        zoom.set(None);
    });
    Effect::new(move || {
        let _ = profile.get();
        let total = total.get();
        let (from, to) = zoom.get().unwrap_or((0, total));
        let columns = columns.get();
        desk.send(ToDesk::Trace { from, to, columns });
    });
    Effect::new(move || {
        let (Some(chart), trace) = (chart.get(), desk.trace.get()) else {
            return;
        };
        let to = trace.to.max(trace.from + 1) as f64;
        chart.draw(
            &trace.rows,
            &trace.degrees,
            trace.from as f64,
            to,
            0.0,
            360.0,
        );
    });
    Effect::new(move || {
        if let Some(chart) = chart.get() {
            chart.mark(desk.chosen.get().map_or(f64::NAN, |row| row as f64));
        }
    });
    on_cleanup(move || {
        if let Some(chart) = chart.try_get_untracked().flatten() {
            chart.remove();
        }
        tell.try_update_value(Option::take);
    });
    view! {
        <section class="panel angle-chart" hidden=move || total.get() < 3>
            <h2>{t("Angle")} <span>{t("over the rows: drag to zoom, click to go there")}</span></h2>
            <div class="chart" data-testid="angle-chart" tabindex="0" role="group" aria-label=t("Angle over the rows") node_ref=place></div>
            {move || zoom.get().map(|_| view! {
                <button class="quiet" on:click=move |_| zoom.set(None)>{t("show all")}</button>
            })}
        </section>
    }
}
