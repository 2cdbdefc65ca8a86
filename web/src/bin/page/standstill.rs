//! The standstill panel: how much the angle of a shaft at rest varies.

use crate::app::App;
use encoderscope::{
    explain::grouped,
    language::{self, t},
    text,
};
use encoderscope_web::{message::STILL, plot::Rest};
use leptos::prelude::*;

/// The histogram has at least so many bins on either side of the middle one.
const SIDE: usize = 4;

/// What the panel can say.
#[derive(Clone, Debug, PartialEq)]
enum Shaft {
    /// Not enough has been read.
    Unknown,
    /// It moves.
    Moves,
    /// It rests.
    Rests(Rest),
}

impl Shaft {
    const fn name(&self) -> &'static str {
        match self {
            Self::Unknown => "unknown",
            Self::Moves => "moves",
            Self::Rests(_) => "rests",
        }
    }

    fn says(&self) -> &'static str {
        match self {
            Self::Unknown => t("needs a second of readings"),
            Self::Moves => t("the shaft moves"),
            Self::Rests(_) => t("last second"),
        }
    }

    fn read(&self, value: fn(&Rest) -> f64) -> Option<f64> {
        match self {
            Self::Rests(rest) => Some(value(rest)),
            Self::Unknown | Self::Moves => None,
        }
    }
}

#[component]
pub(crate) fn Standstill() -> impl IntoView {
    let app = expect_context::<App>();
    let moved = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.moved));
    let shaft = Memo::new(move |_| match (moved.get(), app.feed.rest.get()) {
        (Some(moved), _) if moved >= STILL => Shaft::Moves,
        (Some(_), Some(rest)) => Shaft::Rests(rest),
        _ => Shaft::Unknown,
    });
    let scale = move || {
        shaft
            .with(|shaft| shaft.read(|rest| rest.arcseconds))
            .unwrap_or(0.0)
    };
    let row = move |label: &'static str,
                    testid: &'static str,
                    read: fn(&Rest) -> f64,
                    places: usize| {
        let value = Memo::new(move |_| shaft.with(|shaft| shaft.read(read)));
        view! {
            <dt>{label}</dt>
            <dd data-testid=testid data-value=move || value.get().map(|value| value.to_string())>
                {move || match value.get() {
                    Some(counts) => text!("{} counts", number(counts, places)),
                    None => "–".into(),
                }}
            </dd>
            <dt></dt>
            <dd class="arc">
                {move || match value.get() {
                    Some(counts) => {
                        language::number(format_args!("{:.2}″", counts * scale())).to_string()
                    }
                    None => "–".into(),
                }}
            </dd>
        }
    };
    view! {
        <section
            class="panel standstill"
            data-testid="standstill"
            data-value=move || shaft.with(Shaft::name)
        >
            <h2>{t("Standstill")} <span>{move || shaft.with(Shaft::says)}</span></h2>
            <dl>
                {row("σ", "standstill-sigma", |rest| rest.sigma, 2)}
                {row(t("peak to peak"), "standstill-peak", |rest| rest.peak_to_peak, 0)}
            </dl>
            <div><Histogram shaft=shaft /></div>
        </section>
    }
    .into_any()
}

/// Whole numbers grouped; others only where they are small.
fn number(value: f64, places: usize) -> String {
    match value >= 1_000.0 {
        true => grouped(value.round() as u64),
        false => language::number(format_args!("{value:.places$}")).to_string(),
    }
}

#[component]
fn Histogram(shaft: Memo<Shaft>) -> impl IntoView {
    let bars = move || match shaft.get() {
        Shaft::Rests(rest) => rest.bins,
        Shaft::Unknown | Shaft::Moves => Vec::new(),
    };
    let side = move || (bars().len() / 2).max(SIDE);
    let drawn = move || {
        let bars = bars();
        let side = side();
        let most = bars.iter().copied().max().unwrap_or(0).max(1);
        let all = 2 * side + 1;
        let first = side - bars.len() / 2;
        let width = 100.0 / all as f64;
        bars.into_iter()
            .enumerate()
            .map(|(index, count)| {
                let height = f64::from(count) * 40.0 / f64::from(most);
                view! {
                    <rect x=(first + index) as f64 * width + width * 0.1 y=40.0 - height width=width * 0.8 height=height />
                }
            })
            .collect_view()
    };
    let reach = move || {
        let width = shaft
            .with(|shaft| shaft.read(|rest| rest.width))
            .unwrap_or(1.0);
        grouped((side() as f64 * width) as u64)
    };
    view! {
        <svg class="histogram" viewBox="0 0 100 40" preserveAspectRatio="none" role="img" aria-label=t("Distribution of the readings around their mean")>
            {drawn}
            <line x1="0" x2="100" y1="40" y2="40" />
        </svg>
        <p class="reach" aria-hidden="true">
            <span>"−" {reach}</span>
            <span>{t("mean")}</span>
            <span>"+" {reach}</span>
        </p>
    }
    .into_any()
}
