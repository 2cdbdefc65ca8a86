//! The table: a row a frame, of which only those in sight exist.
//!
//! A browser draws no element of 300 million pixels, so beyond a limit the scroll bar stands for
//! parts of the table instead of pixels, and the wheel moves rows, not the bar.

mod filter;

use crate::app::App;
use encoderscope::{
    explain::grouped_signed,
    language::{number, t},
    sheet::Quantity,
};
use encoderscope_web::message::{RowState, RowView, ToDesk};
use filter::FilterBar;
use leptos::{html, prelude::*};
use web_sys::{KeyboardEvent, WheelEvent};

/// Height of a row in CSS pixels; the style sheet has the same.
const ROW: f64 = 30.0;
/// Rows in sight.
const SIGHT: usize = 12;
/// Rows that are fetched beyond those in sight, on either side.
const BEYOND: usize = 24;
/// The tallest element that every browser draws.
const TALLEST: f64 = 6_000_000.0;

/// Where the table stands.
#[derive(Clone, Copy)]
struct Scroll {
    /// The first row in sight, and how much of it is out of sight.
    first: RwSignal<f64>,
    total: Memo<usize>,
    frame: NodeRef<html::Div>,
}

impl Scroll {
    fn height(self) -> f64 {
        (self.total.get() as f64 * ROW).min(TALLEST)
    }

    fn most(self) -> f64 {
        self.total.get_untracked().saturating_sub(SIGHT) as f64
    }

    /// Pixels that the bar can move.
    fn way(self) -> f64 {
        let frame = self.frame.get_untracked();
        let way = frame.map_or(0, |frame| frame.scroll_height() - frame.client_height());
        f64::from(way).max(1.0)
    }

    fn is_scaled(self) -> bool {
        self.total.get_untracked() as f64 * ROW > TALLEST
    }

    /// The bar was moved.
    fn moved(self) {
        let Some(frame) = self.frame.get_untracked() else {
            return;
        };
        let top = frame.scroll_top();
        let first = match self.is_scaled() {
            true => {
                // What the wheel has set is finer than the bar.
                let own = self.first.get_untracked() / self.most().max(1.0) * self.way();
                if (own - top).abs() < 1.5 {
                    return;
                }
                (top / self.way() * self.most()).round()
            }
            false => top / ROW,
        };
        self.first.set(first.clamp(0.0, self.most()));
    }

    /// Brings a row to the top, or as near as the table goes.
    fn go(self, first: f64) {
        let first = first.clamp(0.0, self.most());
        self.first.set(first);
        if let Some(frame) = self.frame.get_untracked() {
            let top = match self.is_scaled() {
                true => first / self.most().max(1.0) * self.way(),
                false => first * ROW,
            };
            frame.set_scroll_top(top.round());
        }
    }

    fn wheeled(self, event: &WheelEvent) {
        if !self.is_scaled() {
            return;
        }
        event.prevent_default();
        let rows = match event.delta_mode() {
            WheelEvent::DOM_DELTA_LINE => event.delta_y(),
            WheelEvent::DOM_DELTA_PAGE => event.delta_y() * SIGHT as f64,
            _ => event.delta_y() / ROW,
        };
        self.go((self.first.get_untracked() + rows).round());
    }

    /// Brings a row into sight.
    fn show(self, place: usize) {
        let (place, first) = (place as f64, self.first.get_untracked());
        if place < first || place > first + (SIGHT - 2) as f64 {
            self.go(place - (SIGHT / 3) as f64);
        }
    }
}

#[component]
pub(super) fn Rows(shown: Memo<Option<usize>>) -> impl IntoView {
    let desk = expect_context::<App>().desk();
    let scroll = Scroll {
        first: RwSignal::new(0.0),
        total: Memo::new(move |_| desk.overview.get().shown),
        frame: NodeRef::new(),
    };
    let top = Memo::new(move |_| scroll.first.get().floor() as usize);
    // What was fetched is old when other rows are shown or more have come.
    let state = Memo::new(move |_| {
        let overview = desk.overview.get();
        (
            overview.profile,
            overview.shown,
            overview.rows,
            overview.arranged,
        )
    });
    Effect::new(move || {
        let _ = state.get();
        let first = top.get().saturating_sub(BEYOND);
        desk.send(ToDesk::Rows {
            first,
            count: SIGHT + 2 * BEYOND,
        });
    });
    Effect::new(move || desk.send(ToDesk::Show(desk.selection.get())));
    Effect::new(move || {
        let _ = scroll.total.get();
        if let Some(place) = desk.goal.get()
            && (place < scroll.total.get_untracked() || place == 0)
        {
            scroll.show(place);
            desk.goal.set(None);
        }
    });
    let key = move |event: KeyboardEvent| {
        let rows = desk.rows.get_untracked();
        let place = shown
            .get_untracked()
            .and_then(|index| rows.1.iter().position(|row| row.index == index))
            .map(|at| rows.0 + at);
        let known = desk.place.get_value().or(place);
        let here = known.unwrap_or(top.get_untracked()) as f64;
        let to = match event.key().as_str() {
            "ArrowDown" => here + 1.0,
            "ArrowUp" => here - 1.0,
            "PageDown" => here + SIGHT as f64,
            "PageUp" => here - SIGHT as f64,
            "Home" => 0.0,
            "End" => f64::MAX,
            _ => return,
        };
        event.prevent_default();
        let last = scroll.total.get_untracked().saturating_sub(1) as f64;
        let to = to.clamp(0.0, last) as usize;
        desk.place.set_value(Some(to));
        scroll.show(to);
        let at = to.checked_sub(rows.0).and_then(|at| rows.1.get(at));
        match at {
            Some(row) => desk.chosen.set(Some(row.index)),
            None => desk.send(ToDesk::Pick(to)),
        }
    };
    let visible = move || {
        let (first, rows) = desk.rows.get();
        let mut top = top.get();
        // While the bar runs, the rows that came last are shown: they are a moment old.
        if !rows.is_empty() && (top >= first + rows.len() || top + SIGHT < first) {
            top = first + rows.len().saturating_sub(SIGHT) / 2;
        }
        let places = top..(top + SIGHT + 1).min(scroll.total.get());
        let row = |place: usize| {
            let at = place.checked_sub(first)?;
            rows.get(at).cloned()
        };
        places
            .map(|place| match row(place) {
                Some(row) => view! { <Line row=row place=place shown=shown /> }.into_any(),
                None => view! { <tr class="pending"><td colspan="6">"…"</td></tr> }.into_any(),
            })
            .collect_view()
    };
    let timed = Memo::new(move |_| desk.overview.get().timed);
    view! {
        <section class="panel rows">
            <FilterBar />
            <div
                class="scroll"
                style:height=move || format!("{}px", (scroll.total.get().clamp(1, SIGHT) + 1) as f64 * ROW + 4.0)
                tabindex="0"
                role="region"
                aria-label=t("Frames")
                node_ref=scroll.frame
                data-testid="rows"
                data-value=move || scroll.total.get().to_string()
                on:scroll=move |_| scroll.moved()
                on:wheel=move |event: WheelEvent| scroll.wheeled(&event)
                on:keydown=key
            >
                <div class="tall" style:height=move || format!("{}px", scroll.height() + ROW)>
                    <table aria-rowcount=move || scroll.total.get().to_string()>
                        <thead>
                            <tr>
                                <Heading by=Quantity::Start title=t("at") />
                                {move || timed.get().then(|| view! { <Heading by=Quantity::Time title=t("time") /> })}
                                <Heading by=Quantity::Turns title=t("turns") />
                                <Heading by=Quantity::Angle title=t("angle") />
                                <Heading by=Quantity::Status title=t("status") />
                                <th class="check">{t("check")}</th>
                                <th class="hex">{t("Bytes").to_lowercase()}</th>
                            </tr>
                        </thead>
                        <tbody>{visible}</tbody>
                    </table>
                </div>
            </div>
        </section>
    }
}

#[component]
fn Heading(by: Quantity, title: &'static str) -> impl IntoView {
    let desk = expect_context::<App>().desk();
    let order = Memo::new(move |_| {
        let order = desk.selection.get().order;
        order
            .filter(|(name, _)| name == by.name())
            .map(|order| order.1)
    });
    let click = move |_| {
        let next = match order.get_untracked() {
            None => Some((by.name().to_owned(), false)),
            Some(false) => Some((by.name().to_owned(), true)),
            Some(true) => None,
        };
        desk.place.set_value(None);
        desk.selection.update(|selection| selection.order = next);
        desk.goal.set(Some(0));
    };
    let sorted = move || match order.get() {
        None => "none",
        Some(false) => "ascending",
        Some(true) => "descending",
    };
    let arrow = move || match order.get() {
        None => "",
        Some(false) => " ↑",
        Some(true) => " ↓",
    };
    view! {
        <th class=by.name() aria-sort=sorted>
            <button class="quiet" data-testid="sort" data-value=by.name() on:click=click>{title} {arrow}</button>
        </th>
    }
}

#[component]
fn Line(row: RowView, place: usize, shown: Memo<Option<usize>>) -> impl IntoView {
    let desk = expect_context::<App>().desk();
    let timed = desk.overview.with_untracked(|overview| overview.timed);
    let index = row.index;
    let chosen = move || shown.get() == Some(index);
    let choose = move |_| {
        desk.place.set_value(Some(place));
        desk.chosen.set(Some(index));
    };
    let time = timed.then(|| {
        let text = row.time.map(time_text);
        view! { <td class="time">{text}</td> }
    });
    let start = row.start as u64;
    if !row.is_frame() {
        return view! {
            <tr
                class="skip"
                class:chosen=chosen
                data-testid="dump-skip"
                data-row=index
                aria-rowindex=(place + 1).to_string()
                on:click=choose
            >
                <td>{start}</td>
                {time}
                <td colspan="3" class="bytes">{row.hex}</td>
                <td class="check">{row.check}</td>
                <td class="hex"></td>
            </tr>
        }
        .into_any();
    }
    let good = row.state == RowState::Good;
    // The numbers of a frame that fails are in its fields; here they would pass for good ones.
    let shown_if_good = |text: Option<String>| text.filter(|_| good).unwrap_or_else(|| "–".into());
    let turns = shown_if_good(row.turns.map(|turns| grouped_signed(turns as i64)));
    let angle = shown_if_good(row.degrees.map(|degrees| number(degrees + "°").to_string()));
    view! {
        <tr
            data-testid="dump-row"
            data-row=index
            data-ok=good.to_string()
            data-angle=row.angle
            data-turns=row.turns.map(|turns| turns.to_string())
            class:bad=!good
            class:chosen=chosen
            aria-selected=move || chosen().to_string()
            aria-rowindex=(place + 1).to_string()
            on:click=choose
        >
            <td>{start}</td>
            {time}
            <td>{turns}</td>
            <td class="angle">{angle}</td>
            <td class="status">{row.status}</td>
            <td class="check">{row.check}</td>
            <td class="hex">{row.hex}</td>
        </tr>
    }
    .into_any()
}

/// A time as the log wrote it: of the day where it is hours.
fn time_text(seconds: f64) -> String {
    const HOUR: f64 = 3600.0;
    if seconds < HOUR {
        return number(format_args!("{seconds:.6}")).to_string();
    }
    let whole = seconds.floor() as u64;
    let (hours, minutes) = (whole / 3600, whole / 60 % 60);
    let seconds = seconds % 60.0;
    number(format_args!("{hours:02}:{minutes:02}:{seconds:06.3}")).to_string()
}
