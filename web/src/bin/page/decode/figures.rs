//! What the rows come to.

use super::plural;
use crate::app::App;
use encoderscope::explain::{grouped, grouped_signed};
use encoderscope_web::message::{Count, Overview};
use leptos::prelude::*;

fn number(value: f64, places: usize) -> String {
    format!("{value:.places$}").replace('-', "−")
}

fn range(low: &str, high: &str) -> String {
    match low == high {
        true => low.into(),
        false => format!("{low} … {high}"),
    }
}

/// Named figures of an overview.
pub(super) fn figures(overview: &Overview) -> Vec<(&'static str, String)> {
    let mut all = Vec::new();
    if let Some((low, high)) = overview.angle {
        all.push(("angle", range(&number(low, 3), &number(high, 3)) + "°"));
    }
    if let Some((low, high)) = overview.turns {
        let text = |value: f64| grouped_signed(value as i64);
        all.push(("turns", range(&text(low), &text(high))));
    }
    if let Some((low, high)) = overview.speed {
        all.push(("speed", range(&number(low, 3), &number(high, 3)) + " rev/s"));
    }
    if let Some((low, high)) = overview.temperature {
        all.push((
            "temperature",
            range(&number(low, 1), &number(high, 1)) + " °C",
        ));
    }
    if let Some(duration) = overview.duration.filter(|duration| *duration > 0.0) {
        all.push(("time", number(duration, 3) + " s"));
    }
    all
}

#[component]
pub(super) fn Figures() -> impl IntoView {
    let desk = expect_context::<App>().desk();
    let heading = move || {
        let Overview {
            frames,
            bad,
            skipped,
            ..
        } = desk.overview.get();
        let mut text = format!("{} good", grouped((frames - bad) as u64));
        if bad > 0.0 {
            text += &format!(" · {} bad", grouped(bad as u64));
        }
        if skipped > 0.0 {
            text += &format!(" · {} skipped", plural(skipped, "byte"));
        }
        text
    };
    let counts = move |title: &'static str,
                       class: &'static str,
                       of: fn(&Overview) -> &Vec<Count>| {
        let list = desk.overview.with(|overview| of(overview).clone());
        (!list.is_empty()).then(|| {
            let items = list.into_iter().map(|count| {
                let go = move |_| {
                    desk.chosen.set(Some(count.first));
                    desk.send(encoderscope_web::message::ToDesk::Place(count.first));
                };
                view! {
                    <li>
                        <button class="quiet" title="Go to the first" data-testid="count" on:click=go>
                            <span class="number">{grouped(count.count as u64)}</span> " × " {count.name}
                        </button>
                    </li>
                }
            });
            view! {
                <div class=format!("tally {class}")>
                    <h3>{title}</h3>
                    <ul>{items.collect_view()}</ul>
                </div>
            }
        })
    };
    view! {
        <section class="panel sums" data-testid="figures">
            <h2>{move || plural(desk.overview.get().frames, "frame")} <span>{heading}</span></h2>
            <dl>
                {move || figures(&desk.overview.get()).into_iter().map(|(name, value)| view! {
                    <div><dt>{name}</dt><dd class="number" data-figure=name>{value}</dd></div>
                }).collect_view()}
            </dl>
            <div class="tallies">
                {move || counts("Faults", "bad", |overview| &overview.faults)}
                {move || counts("Timing", "bad", |overview| &overview.timing)}
                {move || counts("Not in a frame", "dim", |overview| &overview.skips)}
                {move || counts("The encoder says", "warn", |overview| &overview.conditions)}
            </div>
            {move || {
                let lost = desk.overview.get().lost;
                (lost > 0.0).then(|| view! {
                    <p class="hint">{format!("{} more are not kept: the table is full.", plural(lost, "row"))}</p>
                })
            }}
        </section>
    }
}
