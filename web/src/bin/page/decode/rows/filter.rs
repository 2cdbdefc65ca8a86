//! The bar above the table: which rows are shown, and where to go.

use crate::{app::App, desk::end_text};
use encoderscope::{
    explain::grouped,
    format::STATUS,
    language::t,
    sheet::{Quantity, Show},
    text,
};
use encoderscope_web::message::{Selection, ToDesk};
use leptos::{html, prelude::*};

/// Which rows are shown, and where to go.
#[component]
pub(super) fn FilterBar() -> impl IntoView {
    let desk = expect_context::<App>().desk();
    let update = move |change: &dyn Fn(&mut Selection)| {
        desk.place.set_value(None);
        desk.selection.update(|selection| change(selection));
        desk.goal.set(Some(0));
    };
    let shows = Show::ALL.map(|show| {
        let is_chosen = move || {
            let name = desk.selection.get().show;
            name == show.name() || name.is_empty() && show == Show::All
        };
        view! {
            <button
                class="quiet"
                aria-pressed=move || is_chosen().to_string()
                data-testid="show"
                data-value=show.name()
                on:click=move |_| update(&|selection| selection.show = show.name().into())
            >
                {title(show)}
            </button>
        }
    });
    let (of, from, to) = desk
        .selection
        .with_untracked(|selection| selection.range.clone())
        .unwrap_or((Quantity::Degrees.name().into(), f64::MIN, f64::MAX));
    let quantity = RwSignal::new(Quantity::parse(&of).unwrap_or(Quantity::Degrees));
    let chosen = quantity.get_untracked();
    let is_filtered = desk
        .selection
        .with_untracked(|selection| selection.range.is_some() || selection.status != 0);
    let low = NodeRef::<html::Input>::new();
    let high = NodeRef::<html::Input>::new();
    let apply = move || {
        let number = |input: NodeRef<html::Input>| {
            let text = input.get_untracked().map(|input| input.value())?;
            text.trim().replace(',', ".").parse::<f64>().ok()
        };
        let range = match (number(low), number(high)) {
            (None, None) => None,
            (low, high) => Some((
                quantity.get_untracked().name().to_owned(),
                low.unwrap_or(f64::MIN),
                high.unwrap_or(f64::MAX),
            )),
        };
        update(&|selection| selection.range = range.clone());
    };
    let go = move |text: String| {
        desk.lost.set(false);
        let Some(seconds) = seconds_of(&text) else {
            return desk.lost.set(true);
        };
        match desk.overview.with_untracked(|overview| overview.timed) {
            true => desk.send(ToDesk::Seek(seconds)),
            false => desk.send(ToDesk::Place((seconds as usize).saturating_sub(1))),
        }
    };
    let next = move |_| {
        let from = desk.chosen.get_untracked().map_or(0, |row| row + 1);
        desk.send(ToDesk::NextFault(from));
    };
    let bits = STATUS.iter().map(|bit| {
        let mask = 1u8.checked_shl(bit.place).unwrap_or(0);
        let is_set = move || desk.selection.get().status & mask != 0;
        view! {
            <label class="check-box">
                <input
                    type="checkbox"
                    prop:checked=is_set
                    on:change=move |_| update(&|selection| selection.status ^= mask)
                />
                {t(bit.name)}
            </label>
        }
    });
    let bits = bits.collect_view();
    let shown = move || {
        let overview = desk.overview.get();
        (overview.shown != overview.rows).then(|| {
            text!(
                "{} of {} rows",
                grouped(overview.shown as u64),
                grouped(overview.rows as u64)
            )
        })
    };
    view! {
        <div class="filters">
            <div class="bar-of" role="group" aria-label=t("Which rows")>{shows.into_iter().collect_view()}</div>
            <button class="quiet" data-testid="next-fault" on:click=next>{t("next fault ↓")}</button>
            <label class="go">
                {move || if desk.overview.get().timed { t("Go to time") } else { t("Go to row") }}
                <input inputmode="decimal" data-testid="go" on:change:target=move |event| go(event.target().value()) />
            </label>
            <span class="hint" data-testid="shown">{shown}</span>
            {move || desk.lost.get().then(|| view! { <span class="hint" role="status" data-testid="no-row">{t("There is no such row.")}</span> })}
        </div>
        <details class="filters-more" open=is_filtered>
            <summary>{t("Filter by value or status")}</summary>
            <div class="filters">
                <label>
                    {t("Quantity")}
                    <select
                        data-testid="range-of"
                        on:change:target=move |event| {
                            quantity.set(Quantity::parse(&event.target().value()).unwrap_or(Quantity::Degrees));
                            apply();
                        }
                    >
                        {Quantity::ALL.into_iter().map(|known| view! {
                            <option value=known.name() selected=known == chosen>{match known {
                                Quantity::Start => t("Start").to_lowercase(),
                                known => t(known.name()).to_owned(),
                            }}</option>
                        }).collect_view()}
                    </select>
                </label>
                <label>{t("from")} <input inputmode="decimal" data-testid="range-low" value=end_text(from) node_ref=low on:change=move |_| apply() /></label>
                <label>{t("to")} <input inputmode="decimal" data-testid="range-high" value=end_text(to) node_ref=high on:change=move |_| apply() /></label>
                <div class="status-bits">{bits}</div>
            </div>
        </details>
    }
}

/// What a show is called on the page.
fn title(show: Show) -> &'static str {
    match show {
        Show::All => t("all"),
        Show::Frames => t("frames"),
        Show::Faults => t("faults"),
        Show::Conditions => t("error or warning"),
    }
}

/// Seconds, or a time of day.
fn seconds_of(text: &str) -> Option<f64> {
    let text = text.trim().replace(',', ".");
    let parts: Vec<f64> = text
        .split(':')
        .map(|part| part.parse().ok())
        .collect::<Option<_>>()?;
    (parts.len() <= 3).then(|| parts.iter().fold(0.0, |sum, part| sum * 60.0 + part))
}
