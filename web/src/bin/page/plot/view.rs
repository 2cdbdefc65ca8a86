//! What the plot shows and how: the time, the quantities, the cursor and the mark.

use super::{
    Feed,
    chart::{Height, value_at, value_text},
};
use crate::app::App;
use encoderscope::{
    language::{number, t},
    text,
};
use encoderscope_web::plot::{PlotRequest, Quantity, Stretch};
use leptos::prelude::*;

/// How much of the past is shown while it goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Span {
    Seconds20,
    Minutes2,
    Minutes10,
    Hour,
    All,
}

impl Span {
    pub(super) const ALL: [Self; 5] = [
        Self::Seconds20,
        Self::Minutes2,
        Self::Minutes10,
        Self::Hour,
        Self::All,
    ];

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Seconds20 => t("20 s"),
            Self::Minutes2 => t("2 min"),
            Self::Minutes10 => t("10 min"),
            Self::Hour => t("1 h"),
            Self::All => t("All"),
        }
    }

    const fn stretch(self) -> Stretch {
        match self {
            Self::Seconds20 => Stretch::Last(20.0),
            Self::Minutes2 => Stretch::Last(120.0),
            Self::Minutes10 => Stretch::Last(600.0),
            Self::Hour => Stretch::Last(3600.0),
            Self::All => Stretch::All,
        }
    }
}

/// What the plot shows and how.
#[derive(Clone, Copy)]
pub(super) struct View {
    pub(super) feed: Feed,
    pub(super) app: App,
    pub(super) span: RwSignal<Span>,
    /// The time that is looked at while the plot is paused.
    pub(super) held: RwSignal<Option<(f64, f64)>>,
    pub(super) shown: RwSignal<Vec<Quantity>>,
    pub(super) height: RwSignal<Height>,
    /// Where the pointer is.
    pub(super) cursor: RwSignal<Option<f64>>,
    pub(super) mark: RwSignal<Option<f64>>,
    columns: RwSignal<u32>,
}

impl View {
    pub(super) fn new(app: App) -> Self {
        Self {
            feed: app.feed,
            app,
            span: RwSignal::new(Span::Seconds20),
            held: RwSignal::new(None),
            shown: RwSignal::new(remembered()),
            height: RwSignal::new(Height::Whole),
            cursor: RwSignal::new(None),
            mark: RwSignal::new(None),
            columns: RwSignal::new(600),
        }
    }

    pub(super) fn request(&self) -> PlotRequest {
        PlotRequest {
            stretch: match self.held.get() {
                Some((from, to)) => Stretch::Between(from, to),
                None => self.span.get().stretch(),
            },
            columns: self.columns.get(),
            quantities: self.shown.get(),
        }
    }

    /// A gesture on a chart.
    pub(super) fn told(&self, what: &str, a: f64, b: f64) {
        let time = Some(a).filter(|at| !at.is_nan());
        match what {
            "zoom" => self.held.set(Some((a, b))),
            "cursor" if self.cursor.get_untracked() != time => self.cursor.set(time),
            "mark" => self.mark.set(time),
            "live" => self.go_on(),
            "width" if a >= 1.0 => self.columns.set(a as u32),
            _ => {}
        }
    }

    pub(super) fn pause(&self) {
        let ends = self.feed.plot.with_untracked(|plot| (plot.from, plot.to));
        self.held.set(Some(ends));
    }

    pub(super) fn go_on(&self) {
        self.held.set(None);
        self.mark.set(None);
    }

    /// Looks at another time: `scale` times as long, moved by `shift` of its length.
    pub(super) fn look(&self, scale: f64, shift: f64) {
        let ends = self.feed.plot.with_untracked(|plot| (plot.from, plot.to));
        let (from, to) = self.held.get_untracked().unwrap_or(ends);
        let half = (to - from) / 2.0 * scale;
        let middle = (from + to) / 2.0 + (to - from) * shift;
        self.held.set(Some((middle - half, middle + half)));
    }

    pub(super) fn toggle(&self, quantity: Quantity) {
        self.shown.update(|shown| {
            let wanted = |other: &Quantity| shown.contains(other) != (*other == quantity);
            *shown = Quantity::ALL.into_iter().filter(wanted).collect();
        });
        remember(&self.shown.get_untracked());
    }

    pub(super) fn is_shown(&self, quantity: Quantity) -> bool {
        self.shown.with(|shown| shown.contains(&quantity))
    }

    /// Degrees in a count of the encoder.
    pub(super) fn count(&self) -> f64 {
        let bits = self.app.snapshot.with_untracked(|snapshot| {
            let reading = snapshot.reading.as_ref();
            reading.map_or(24, |reading| reading.angle_bits)
        });
        360.0 / 2f64.powi(bits as i32)
    }

    /// The time and the values at the cursor; with a mark, how far they are from it.
    pub(super) fn readout(&self) -> Vec<(&'static str, String)> {
        let (cursor, mark) = (self.cursor.get(), self.mark.get());
        let Some(at) = cursor.or(mark) else {
            return Vec::new();
        };
        self.feed.plot.with(|plot| {
            let traces = plot.traces.iter();
            match (cursor, mark) {
                (Some(cursor), Some(mark)) => {
                    let time = seconds_text(cursor - mark);
                    let apart = traces.filter_map(|trace| {
                        let apart = difference(
                            trace.quantity,
                            value_at(trace, cursor)?,
                            value_at(trace, mark)?,
                        );
                        Some((
                            t(trace.quantity.name()),
                            format!("Δ {}", value_text(trace.quantity, apart)),
                        ))
                    });
                    [(t("from the mark"), format!("Δ {time}"))]
                        .into_iter()
                        .chain(apart)
                        .collect()
                }
                _ => {
                    let label = if cursor.is_some() {
                        t("cursor")
                    } else {
                        t("mark")
                    };
                    let values = traces.filter_map(|trace| {
                        Some((
                            t(trace.quantity.name()),
                            value_text(trace.quantity, value_at(trace, at)?),
                        ))
                    });
                    [(label, seconds_text(at))]
                        .into_iter()
                        .chain(values)
                        .collect()
                }
            }
        })
    }

    /// From the mark to the cursor: seconds, and how far the first quantity is apart.
    pub(super) fn delta(&self) -> Option<(f64, Option<f64>)> {
        let (cursor, mark) = (self.cursor.get()?, self.mark.get()?);
        let apart = self.feed.plot.with(|plot| {
            let trace = plot.traces.first()?;
            Some(difference(
                trace.quantity,
                value_at(trace, cursor)?,
                value_at(trace, mark)?,
            ))
        });
        Some((cursor - mark, apart))
    }
}

/// How far a value is from another; an angle goes the shorter way.
fn difference(quantity: Quantity, value: f64, other: f64) -> f64 {
    let apart = value - other;
    match quantity {
        Quantity::Angle => apart - (apart / 360.0).round() * 360.0,
        _ => apart,
    }
}

fn seconds_text(seconds: f64) -> String {
    text!("{} s", number(format_args!("{seconds:.4}"))).replace('-', "−")
}

/// The quantities that were shown last.
fn remembered() -> Vec<Quantity> {
    let storage = window().local_storage().ok().flatten();
    let names = storage.and_then(|storage| storage.get_item("plot").ok().flatten());
    match names {
        Some(names) => {
            let listed = |quantity: &Quantity| names.split(' ').any(|name| name == quantity.name());
            Quantity::ALL.into_iter().filter(listed).collect()
        }
        None => vec![Quantity::Angle],
    }
}

fn remember(shown: &[Quantity]) {
    let names: Vec<_> = shown.iter().map(|quantity| quantity.name()).collect();
    if let Ok(Some(storage)) = window().local_storage() {
        // A browser that keeps nothing shows the angle next time.
        let _ = storage.set_item("plot", &names.join(" "));
    }
}
