//! What the rows come to.

use super::count;
use crate::app::App;
use encoderscope::{
    explain::grouped_signed,
    language::{self, msg, t},
    text,
};
use encoderscope_web::message::{Count, Overview};
use leptos::prelude::*;

fn number(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}").replace('-', "−");
    language::number(text).to_string()
}

fn range(low: &str, high: &str) -> String {
    match low == high {
        true => low.into(),
        false => format!("{low} … {high}"),
    }
}

/// Named figures of an overview, with their names in English.
pub(super) fn figures(overview: &Overview) -> Vec<(&'static str, String)> {
    let mut all = Vec::new();
    if let Some((low, high)) = overview.angle {
        all.push((msg("angle"), range(&number(low, 3), &number(high, 3)) + "°"));
    }
    if let Some((low, high)) = overview.turns {
        let text = |value: f64| grouped_signed(value as i64);
        all.push((msg("turns"), range(&text(low), &text(high))));
    }
    if let Some((low, high)) = overview.speed {
        let range = range(&number(low, 3), &number(high, 3));
        all.push((msg("speed"), text!("{} rev/s", range)));
    }
    if let Some((low, high)) = overview.temperature {
        all.push((
            msg("temperature"),
            range(&number(low, 1), &number(high, 1)) + " °C",
        ));
    }
    if let Some(duration) = overview.duration.filter(|duration| *duration > 0.0) {
        all.push((msg("time"), text!("{} s", number(duration, 3))));
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
        let mut text = text!("{} good", count(frames - bad));
        if bad > 0.0 {
            text += &text!(" · {} bad", count(bad));
        }
        if skipped > 0.0 {
            text += &text!(" · {} {0|byte|bytes} skipped", count(skipped));
        }
        text
    };
    let counts = move |title: &'static str,
                       class: &'static str,
                       of: fn(&Overview) -> &Vec<Count>| {
        let list = desk.overview.with(|overview| of(overview).clone());
        (!list.is_empty()).then(|| {
            let items = list.into_iter().map(|item| {
                let go = move |_| {
                    desk.chosen.set(Some(item.first));
                    desk.send(encoderscope_web::message::ToDesk::Place(item.first));
                };
                view! {
                    <li>
                        <button class="quiet" title=t("Go to the first") data-testid="count" on:click=go>
                            <span class="number">{count(item.count)}</span> " × " {item.name}
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
            <h2>{move || text!("{} {0|frame|frames}", count(desk.overview.get().frames))} <span>{heading}</span></h2>
            <dl>
                {move || figures(&desk.overview.get()).into_iter().map(|(name, value)| view! {
                    <div><dt>{t(name)}</dt><dd class="number" data-figure=name>{value}</dd></div>
                }).collect_view()}
            </dl>
            <div class="tallies">
                {move || counts(t("Faults"), "bad", |overview| &overview.faults)}
                {move || counts(t("Timing"), "bad", |overview| &overview.timing)}
                {move || counts(t("Not in a frame"), "dim", |overview| &overview.skips)}
                {move || counts(t("The encoder says"), "warn", |overview| &overview.conditions)}
            </div>
            {move || {
                let lost = desk.overview.get().lost;
                (lost > 0.0).then(|| view! {
                    <p class="hint">{text!("{} {0|row|rows} more are not kept: the table is full.", count(lost))}</p>
                })
            }}
        </section>
    }
}
