//! The wires while the frame is sent, in step with the bits.

use super::paper::{Lit, Paper};
use crate::app::App;
use encoderscope::{
    diagram::{Fold, Lane, Limit, Master, Slot, Timeline, What},
    format::Link,
    language::{number, t},
    layout::Class,
    text,
};
use leptos::{html, prelude::*};

/// Width of a bit, and heights of what is drawn, in pixels.
const BIT: f64 = 20.0;
const LANE: f64 = 58.0;
const SWING: f64 = 26.0;
const TOP: f64 = 36.0;
const LETTER: f64 = 7.2;
/// Room in front of the first level.
const LEFT: f64 = 4.0;

#[component]
pub(super) fn Wave() -> impl IntoView {
    let app = expect_context::<App>();
    let paper = app.paper();
    let hertz = RwSignal::new(Master::default().hertz);
    let clocked = Memo::new(move |_| app.profile.get().link() == Link::Clocked);
    let timeline = Memo::new(move |_| {
        let master = Master {
            hertz: hertz.get(),
            ..Master::default()
        };
        paper.with(|sketch| sketch.timeline(&master))
    });
    let frame = NodeRef::<html::Div>::new();
    // What is pointed at elsewhere is brought into sight here.
    Effect::new(move || {
        let lit = paper.lit.get();
        let bit = match lit {
            Some(Lit::Bit(bit)) => Some(bit),
            Some(Lit::Field(field)) => paper
                .plan
                .with_untracked(|plan| plan.cells.iter().position(|cell| *cell == Some(field))),
            None => None,
        };
        let x = timeline.with_untracked(|timeline| {
            let timeline = timeline.as_ref()?;
            let fold = Fold::new(timeline, BIT);
            Some(LEFT + fold.x(timeline.slot_of(bit?)?.from))
        });
        if let (Some(x), Some(frame)) = (x, frame.get_untracked()) {
            let (left, width) = (frame.scroll_left(), f64::from(frame.client_width()));
            if x < left + LEFT || x > left + width - 2.0 * BIT {
                frame.set_scroll_left(x - width / 3.0);
            }
        }
    });
    let enter = move |text: String| {
        if let Ok(kilohertz) = text.trim().replace(',', ".").parse::<f64>() {
            hertz.set((kilohertz * 1e3).clamp(1.0, 1e8) as u32);
        }
        hertz.notify();
    };
    let picture =
        move || timeline.with(|timeline| timeline.as_ref().map(|timeline| draw(paper, timeline)));
    let limits = move || {
        let limits =
            timeline.with(|timeline| timeline.as_ref().map(|timeline| timeline.limits.clone()));
        limits
            .unwrap_or_default()
            .into_iter()
            .map(limit)
            .collect_view()
    };
    view! {
        <section class="panel">
            <div class="heading">
                <h2>{t("On the wire")}</h2>
                {move || match clocked.get() {
                    true => view! {
                        <label>
                            <span class="hint">{t("Clock, kHz")}</span>
                            <input
                                class="entry"
                                inputmode="decimal"
                                data-testid="explain-clock"
                                prop:value=move || number(f64::from(hertz.get()) / 1e3).to_string()
                                on:change:target=move |event| enter(event.target().value())
                            />
                        </label>
                    }.into_any(),
                    false => view! {
                        <span class="hint">{move || text!("{} baud, 8N1", app.profile.get().baud)}</span>
                    }.into_any(),
                }}
            </div>
            <div class="wave-box">
                {move || timeline.with(|timeline| timeline.as_ref().map(wire_names))}
                <div class="wave" node_ref=frame tabindex="0" role="region" aria-label=t("Timing diagram")>{picture}</div>
            </div>
            <ul class="limits">{limits}</ul>
        </section>
    }
}

fn limit(limit: Limit) -> impl IntoView {
    let (class, sign) = match limit.holds {
        true => ("good", "✓"),
        false => ("bad", "✗"),
    };
    view! {
        <li data-testid="explain-limit" data-value=limit.holds.to_string()>
            <b class=class>{sign} " " {t(limit.name)} ": " {limit.value}</b>
            <span class="doc">{format!("{} ({})", limit.text, t(limit.source))}</span>
        </li>
    }
}

fn draw(paper: Paper, timeline: &Timeline) -> impl IntoView + use<> {
    let fold = Fold::new(timeline, BIT);
    let height = TOP + LANE * timeline.lanes.len() as f64 + 4.0;
    let width = LEFT + fold.width() + 8.0;
    let lanes = timeline.lanes.iter().enumerate();
    let lanes: Vec<_> = lanes
        .map(|(index, lane)| wire(lane, TOP + LANE * index as f64, timeline.end, &fold))
        .collect();
    let slots: Vec<_> = timeline
        .slots
        .iter()
        .map(|slot| stretch(paper, slot, &fold))
        .collect();
    let folds: Vec<_> = fold
        .cells()
        .iter()
        .filter(|cell| cell.is_folded)
        .map(|cell| {
            let x = LEFT + cell.x + cell.width / 2.0;
            view! { <text class="fold" x=x y=TOP + LANE - 22.0>"≈"</text> }
        })
        .collect();
    let names = names(paper, timeline, &fold);
    view! {
        <svg
            width=width
            height=height
            viewBox=format!("0 0 {width} {height}")
            role="img"
            aria-label=t("Levels of the wires over time")
            on:mouseleave=move |_| paper.lit.set(None)
        >
            {slots}
            {names}
            {lanes}
            {folds}
        </svg>
    }
}

/// One wire.
fn wire(lane: &Lane, top: f64, end: i64, fold: &Fold) -> impl IntoView + use<> {
    let y = |level: bool| {
        if level {
            top + 10.0
        } else {
            top + 10.0 + SWING
        }
    };
    let mut level = lane.level_at(0);
    let mut path = format!("M {LEFT} {}", y(level));
    for step in &lane.steps {
        let x = LEFT + fold.x(step.time);
        path += &format!(" L {x:.1} {} L {x:.1} {}", y(level), y(step.level));
        level = step.level;
    }
    path += &format!(" L {:.1} {}", LEFT + fold.x(end), y(level));
    view! {
        <path class="wire" d=path />
    }
}

/// The names of the wires, which stay while the levels are scrolled.
fn wire_names(timeline: &Timeline) -> impl IntoView + use<> {
    let height = TOP + LANE * timeline.lanes.len() as f64;
    let names = timeline.lanes.iter().enumerate().map(|(index, lane)| {
        let y = TOP + LANE * index as f64 + 10.0 + SWING / 2.0 + 4.0;
        view! { <text x="0" y=y>{t(lane.name)}</text> }
    });
    view! { <svg class="wire-names" width="60" height=height aria-hidden="true">{names.collect_view()}</svg> }
}

/// A stretch of time, to point at.
fn stretch(paper: Paper, slot: &Slot, fold: &Fold) -> AnyView {
    let (x, to) = (LEFT + fold.x(slot.from), LEFT + fold.x(slot.to));
    let y = TOP + LANE * slot.lane as f64;
    let width = (to - x).max(0.0);
    let What::Bit(bit) = slot.what else {
        return view! {
            <rect class="slot other" x=x y=y width=width height=LANE - 8.0>
                <title>{t(slot.what.name())}</title>
            </rect>
        }
        .into_any();
    };
    let class = paper.plan.with_untracked(|plan| plan.class_of(bit));
    let value = move || paper.with(|sketch| u8::from(sketch.bits().bit(bit)));
    view! {
        <g
            class=format!("slot {}", class.map_or("none", Class::name))
            class:lit=move || paper.is_lit(bit)
            data-testid="explain-slot"
            data-index=bit
            on:mouseenter=move |_| paper.lit.set(Some(Lit::Bit(bit)))
        >
            <rect x=x y=y width=width height=LANE - 8.0 />
            <text x=x + width / 2.0 y=y + LANE - 11.0>{value}</text>
        </g>
    }
    .into_any()
}

/// A name above the wire, from where to where.
struct Name {
    text: String,
    class: &'static str,
    x: f64,
    /// Where it may begin at the latest: over the last bit of its field.
    latest: f64,
    width: f64,
    is_field: bool,
}

impl Name {
    /// Where it begins on a line with others, as far left as it may.
    fn fits(&self, line: &[(f64, f64)]) -> Option<f64> {
        let mut x = self.x;
        // Each of the others pushes it to the right once at most.
        for _ in line {
            let meets = |(from, end): &&(f64, f64)| x < *end && x + self.width > *from;
            x = line.iter().find(meets).map_or(x, |(_, end)| *end);
        }
        let is_free = line
            .iter()
            .all(|(from, end)| x >= *end || x + self.width <= *from);
        (is_free && x <= self.latest).then_some(x)
    }
}

/// The name of each field above its first bit on the wire, and of what else is seen.
fn names(paper: Paper, timeline: &Timeline, fold: &Fold) -> Vec<AnyView> {
    let plan = paper.plan.get_untracked();
    let mut names: Vec<Name> = Vec::new();
    let mut last = None;
    for slot in timeline.of_lane(timeline.encoder()) {
        let (text, class, is_field) = match slot.what {
            What::Bit(bit) => {
                let field = plan.cells.get(bit).copied().flatten();
                if field == last {
                    if let Some(name) = names.last_mut().filter(|name| name.is_field) {
                        name.latest = LEFT + fold.x(slot.from);
                    }
                    continue;
                }
                last = field;
                let Some(field) = field.and_then(|field| plan.fields.get(field)) else {
                    continue;
                };
                (field.title(), field.class.name(), true)
            }
            What::Start | What::Stop => continue,
            other => (t(other.name()).to_owned(), "none", false),
        };
        let x = LEFT + fold.x(slot.from);
        let width = text.chars().count() as f64 * LETTER + LETTER;
        names.push(Name {
            text,
            class,
            x,
            latest: x,
            width,
            is_field,
        });
    }
    // Fields come before what stands around them; a name that has no room on either line is
    // in the list of fields.
    names.sort_by_key(|name| !name.is_field);
    let mut placed: [Vec<(f64, f64)>; 2] = Default::default();
    let mut drawn = Vec::new();
    for name in names {
        let lines = placed.iter_mut().zip([12.0, 26.0]);
        let places = lines.filter_map(|(line, y)| Some((name.fits(line)?, line, y)));
        let Some((x, line, y)) = places.min_by(|one, other| one.0.total_cmp(&other.0)) else {
            continue;
        };
        line.push((x, x + name.width));
        let class = format!("name {}", name.class);
        drawn.push(view! { <text class=class x=x y=y>{name.text}</text> }.into_any());
    }
    drawn
}
