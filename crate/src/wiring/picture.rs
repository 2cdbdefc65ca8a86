//! The picture of a wiring: narrow enough for a phone, and one wire a line, so that none cross.
//!
//! Presentation attributes alone, so that a page without inline styles can show it; what is ink,
//! dim or paper has a class of that name (`w-ink` …) by which a page can recolour it. Wires
//! keep their colours, with an outline by which white is seen on paper and black on dark.

use super::{End, OHMS, Paint, Place, Presence, Shield, Terminal, Wire, Wiring};
use crate::{
    diagram::svg::{Palette, escaped, number},
    language::t,
    text,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

const WIDTH: f64 = 360.0;
/// From one wire to the next.
const ROW: f64 = 48.0;
/// Where the first wire lies.
const TOP: f64 = 72.0;
/// Edges of the encoder's box.
const ENCODER: (f64, f64) = (6.0, 128.0);
/// Edges of the boxes at the other end.
const OTHER: (f64, f64) = (250.0, 354.0);
/// Edges of the shield.
const SHIELD: (f64, f64) = (149.0, 221.0);

const BOLD: &str = " font-weight=\"600\"";

/// Draws a wiring as SVG: well-formed, self-contained, without styles or scripts.
#[must_use]
pub fn svg(wiring: &Wiring) -> String {
    let setup = wiring.setup;
    let title = text!(
        "{} with {}, to {}",
        t(setup.series.name()),
        t(setup.interface.title()),
        setup.adapter.title()
    );
    let rows = rows(wiring);
    let mut ink = Ink::default();
    encoder(&mut ink, wiring, &rows);
    shield(&mut ink, wiring, &rows);
    for row in &rows {
        if let Some(wire) = row.wire {
            draw(&mut ink, wire, row.y);
        }
    }
    ground(&mut ink, wiring, &rows);
    others(&mut ink, wiring, &rows);
    resistors(&mut ink, wiring, &rows);
    let last = rows.last().map_or(TOP, |row| row.y);
    let height = last
        + match wiring.shield {
            Shield::AtController | Shield::Depends => 66.0,
            Shield::Unsaid => 34.0,
        };
    let (width, height) = (number(WIDTH), number(height));
    let described: String = wiring.wires.iter().map(in_words).collect();
    let paper = Palette::LIGHT.panel;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{width}\" \
         height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"system-ui, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif\">\n\
         <title>{}</title>\n<desc>{}</desc>\n\
         <rect class=\"w-paper\" fill=\"{paper}\" width=\"{width}\" height=\"{height}\"/>\n\
         {}</svg>\n",
        escaped(&title),
        escaped(described.trim_end()),
        ink.body
    )
}

/// A wire in words.
fn in_words(wire: &Wire) -> String {
    let pin = wire.pin.map(|pin| text!("pin {}, ", pin));
    let paint = wire.paint.map(|paint| format!("{}, ", paint.title()));
    let goes = match wire.goes {
        None => t("is not used").to_string(),
        Some(terminal) => text!("goes to {} {}", place(terminal.place), t(terminal.name)),
    };
    let (pin, paint) = (pin.unwrap_or_default(), paint.unwrap_or_default());
    format!("{pin}{paint}{} {goes}. ", t(wire.signal))
}

fn place(place: Place) -> &'static str {
    match place {
        Place::Supply => t("supply"),
        Place::Adapter => t("adapter"),
        Place::Battery => t("battery"),
        Place::Switch => t("switch"),
    }
}

/// A line of the picture: a wire, the terminal it goes to, or the adapter's ground alone.
struct Row<'a> {
    wire: Option<&'a Wire>,
    terminal: Option<Terminal>,
    y: f64,
}

fn rows(wiring: &Wiring) -> Vec<Row<'_>> {
    let mut rows = Vec::new();
    let mut y = TOP;
    let mut is_grounded = false;
    for wire in &wiring.wires {
        let on_supply = wire
            .goes
            .is_some_and(|terminal| terminal.place == Place::Supply);
        if !on_supply && !is_grounded {
            is_grounded = true;
            if let Some(ground) = wiring.ground {
                rows.push(Row {
                    wire: None,
                    terminal: Some(ground),
                    y,
                });
                y += ROW;
            }
        }
        rows.push(Row {
            wire: Some(wire),
            terminal: wire.goes,
            y,
        });
        y += ROW;
    }
    rows
}

fn height_of(rows: &[Row<'_>], signal: &str) -> Option<f64> {
    let named = |row: &&Row<'_>| row.wire.is_some_and(|wire| wire.signal == signal);
    rows.iter().find(named).map(|row| row.y)
}

fn encoder(ink: &mut Ink, wiring: &Wiring, rows: &[Row<'_>]) {
    let (left, right) = ENCODER;
    let last = rows.last().map_or(TOP, |row| row.y);
    ink.frame((left, TOP - 34.0), (right, last + 22.0));
    let name = format!(
        "{} {}",
        t(wiring.setup.series.name()),
        t(wiring.setup.interface.title())
    );
    let supply = wiring.supply.first().map_or("", |fact| t(fact.value));
    let y = TOP - 46.0;
    ink.text((left + 2.0, y), "w-ink", 13, BOLD, &name);
    ink.text((OTHER.0 + 2.0, y), "w-dim", 12, "", supply);
    for row in rows {
        let Some(wire) = row.wire else { continue };
        if let Some(pin) = wire.pin {
            let at = (left + 12.0, row.y + 4.0);
            ink.text(at, "w-dim", 12, "", &pin.to_string());
        }
        ink.text((left + 28.0, row.y + 4.0), "w-ink", 12, "", t(wire.signal));
    }
    // The battery's minus is joined to 0 V inside.
    if let (Some(zero), Some(minus)) = (height_of(rows, "0 V"), height_of(rows, "Battery−")) {
        let x = left + 7.0;
        ink.path(&[(x, zero), (x, minus)], "w-ink", 1.2, "");
        ink.dot((x, zero));
        ink.dot((x, minus));
    }
}

fn draw(ink: &mut Ink, wire: &Wire, y: f64) {
    let from = ENCODER.1;
    let to = match wire.goes {
        Some(_) => OTHER.0,
        None => from + 26.0,
    };
    ink.wire((from, to), y, wire.paint);
    match (wire.goes, wire.paint) {
        (Some(_), None) => {}
        (Some(_), Some(paint)) => {
            let at = ((SHIELD.0 + SHIELD.1) / 2.0, y - 7.0);
            ink.over(at, " text-anchor=\"middle\"", &paint.title());
        }
        (None, paint) => {
            let paint = paint.map(|paint| format!("{}: ", paint.title()));
            let text = text!("{}not used", paint.unwrap_or_default());
            ink.path(&[(to, y - 6.0), (to, y + 6.0)], "w-ink", 1.5, "");
            ink.over((to + 8.0, y + 4.0), "", &text);
        }
    }
}

/// The boxes at the other end, each around all terminals of its place.
fn others(ink: &mut Ink, wiring: &Wiring, rows: &[Row<'_>]) {
    let boxes = [
        (Place::Supply, t("supply")),
        (Place::Adapter, wiring.setup.adapter.label()),
        (Place::Battery, t("battery")),
        (Place::Switch, t("input")),
    ];
    for (place, heading) in boxes {
        let here = rows.iter().filter_map(|row| {
            let terminal = row.terminal.filter(|terminal| terminal.place == place);
            terminal.map(|terminal| (row.y, terminal.name))
        });
        let here: Vec<_> = here.collect();
        let (Some((first, _)), Some((last, _))) = (here.first(), here.last()) else {
            continue;
        };
        ink.frame((OTHER.0, first - 26.0), (OTHER.1, last + 14.0));
        ink.text((OTHER.0 + 10.0, first - 12.0), "w-dim", 11, "", heading);
        for (y, name) in here {
            ink.text((OTHER.0 + 18.0, y + 4.0), "w-ink", 12, BOLD, t(name));
            ink.dot((OTHER.0, y));
        }
    }
}

/// The ground of the adapter is joined with the supply's.
fn ground(ink: &mut Ink, wiring: &Wiring, rows: &[Row<'_>]) {
    let of = |place| {
        let minus = |row: &&Row<'_>| {
            let ground = row.terminal;
            ground.is_some_and(|terminal| {
                terminal.place == place
                    && terminal.line == super::Line::Supply(super::Polarity::Minus)
            })
        };
        rows.iter().find(minus).map(|row| row.y)
    };
    if let (Some(supply), Some(adapter), Some(_)) =
        (of(Place::Supply), of(Place::Adapter), wiring.ground)
    {
        let x = OTHER.0 - 14.0;
        let bend = [(x, supply), (x, adapter), (OTHER.0, adapter)];
        ink.path(&bend, "w-ink", 1.5, "");
        ink.dot((x, supply));
    }
}

fn shield(ink: &mut Ink, wiring: &Wiring, rows: &[Row<'_>]) {
    let last = rows.last().map_or(TOP, |row| row.y);
    if wiring.shield == Shield::Unsaid {
        return;
    }
    let (left, right) = SHIELD;
    let (top, bottom) = (TOP - 24.0, last + 16.0);
    let round = [
        (left, top),
        (right, top),
        (right, bottom),
        (left, bottom),
        (left, top),
    ];
    ink.path(&round, "w-dim", 1.2, " stroke-dasharray=\"5 4\"");
    let (x, y) = (OTHER.0 - 10.0, bottom + 20.0);
    if wiring.shield == Shield::Depends {
        ink.text((left, y + 6.0), "w-dim", 11, "", t("shield: see the notes"));
        return;
    }
    let lead = [(right, bottom - 8.0), (x, bottom - 8.0), (x, y)];
    ink.path(&lead, "w-dim", 1.2, " stroke-dasharray=\"5 4\"");
    for (half, down) in [(9.0, 0.0), (6.0, 4.0), (3.0, 8.0)] {
        ink.path(
            &[(x - half, y + down), (x + half, y + down)],
            "w-ink",
            1.5,
            "",
        );
    }
    ink.text((left, y + 6.0), "w-dim", 11, "", t("shield"));
    ink.text((x + 16.0, y + 6.0), "w-dim", 11, "", t("ground here"));
}

fn resistors(ink: &mut Ink, wiring: &Wiring, rows: &[Row<'_>]) {
    for terminator in &wiring.terminators {
        let (plus, minus) = terminator.between;
        let (Some(upper), Some(lower)) = (height_of(rows, plus), height_of(rows, minus)) else {
            continue;
        };
        let (x, text) = match (terminator.end, terminator.presence) {
            (End::Encoder, Presence::Added) => (ENCODER.1 + 10.0, text!("{} Ω add", OHMS)),
            (End::Encoder, Presence::Unclear) => (ENCODER.1 - 14.0, text!("{} Ω inside?", OHMS)),
            (End::Encoder, Presence::Inside | Presence::Switched) => {
                (ENCODER.1 - 14.0, text!("{} Ω inside", OHMS))
            }
            (End::Controller, Presence::Inside | Presence::Unclear) => {
                (OTHER.0 + 12.0, text!("{} Ω inside", OHMS))
            }
            (End::Controller, Presence::Switched) => (OTHER.0 + 12.0, text!("{} Ω on", OHMS)),
            (End::Controller, Presence::Added) => (OTHER.0 - 12.0, text!("{} Ω add", OHMS)),
        };
        let dash = match terminator.presence {
            Presence::Unclear => " stroke-dasharray=\"3 2\"",
            _ => "",
        };
        let middle = f64::midpoint(upper, lower);
        // Inside a box the resistor hangs on leads of its own, not on wires.
        let edge = match terminator.end {
            End::Encoder => ENCODER.1,
            End::Controller => OTHER.0,
        };
        let ends = [(edge, upper), (x, upper), (x, middle - 11.0)];
        ink.path(&ends, "w-ink", 1.2, dash);
        let ends = [(edge, lower), (x, lower), (x, middle + 11.0)];
        ink.path(&ends, "w-ink", 1.2, dash);
        ink.resistor((x, middle), dash);
        let (x, anchor) = match (terminator.end, terminator.presence) {
            (End::Encoder, Presence::Added) => (x + 9.0, ""),
            (End::Encoder, _) | (End::Controller, Presence::Added) => {
                (x - 9.0, " text-anchor=\"end\"")
            }
            (End::Controller, _) => (x + 9.0, ""),
        };
        ink.text((x, middle + 4.0), "w-ink", 11, anchor, &text);
    }
}

/// What has been drawn.
#[derive(Default)]
struct Ink {
    body: String,
}

/// The colour of a class in a file.
fn colour(class: &str) -> &'static str {
    match class {
        "w-dim" | "w-dim w-paper-stroke" => Palette::LIGHT.dim,
        "w-paper" => Palette::LIGHT.panel,
        _ => Palette::LIGHT.ink,
    }
}

impl Ink {
    fn text(&mut self, (x, y): (f64, f64), class: &str, size: u32, more: &str, text: &str) {
        let (x, y, fill, text) = (number(x), number(y), colour(class), escaped(text));
        self.body += &format!(
            "<text class=\"{class}\" fill=\"{fill}\" x=\"{x}\" y=\"{y}\" \
             font-size=\"{size}\"{more}>{text}</text>\n"
        );
    }

    /// Words over lines, which they hide as far as they reach.
    fn over(&mut self, at: (f64, f64), more: &str, text: &str) {
        let paper = colour("w-paper");
        let halo = format!(
            " stroke=\"{paper}\" stroke-width=\"4\" stroke-linejoin=\"round\" \
             paint-order=\"stroke\"{more}"
        );
        self.text(at, "w-dim w-paper-stroke", 11, &halo, text);
    }

    fn path(&mut self, points: &[(f64, f64)], class: &str, width: f64, more: &str) {
        let mut path = String::new();
        for (index, (x, y)) in points.iter().enumerate() {
            let letter = if index == 0 { 'M' } else { 'L' };
            path += &format!("{letter}{} {}", number(*x), number(*y));
        }
        let (stroke, width) = (colour(class), number(width));
        self.body += &format!(
            "<path class=\"{class}-stroke\" fill=\"none\" stroke=\"{stroke}\" \
             stroke-width=\"{width}\"{more} d=\"{path}\"/>\n"
        );
    }

    fn frame(&mut self, (left, top): (f64, f64), (right, bottom): (f64, f64)) {
        let [x, y, width, height] = [left, top, right - left, bottom - top].map(number);
        let stroke = colour("w-dim");
        self.body += &format!(
            "<rect class=\"w-dim-stroke\" fill=\"none\" stroke=\"{stroke}\" x=\"{x}\" y=\"{y}\" \
             width=\"{width}\" height=\"{height}\" rx=\"4\"/>\n"
        );
    }

    fn resistor(&mut self, (x, y): (f64, f64), more: &str) {
        let (left, top) = (number(x - 5.0), number(y - 11.0));
        let (stroke, fill) = (colour("w-ink"), colour("w-paper"));
        self.body += &format!(
            "<rect class=\"w-paper w-ink-stroke\" fill=\"{fill}\" stroke=\"{stroke}\" \
             stroke-width=\"1.2\"{more} x=\"{left}\" y=\"{top}\" width=\"10\" height=\"22\"/>\n"
        );
    }

    fn dot(&mut self, (x, y): (f64, f64)) {
        let (x, y, fill) = (number(x), number(y), colour("w-ink"));
        self.body +=
            &format!("<circle class=\"w-ink\" fill=\"{fill}\" cx=\"{x}\" cy=\"{y}\" r=\"3\"/>\n");
    }

    /// A wire in its colours; a plain line where they are not known.
    fn wire(&mut self, (from, to): (f64, f64), y: f64, paint: Option<Paint>) {
        let line = [(from, y), (to, y)];
        let Some(paint) = paint else {
            return self.path(&line, "w-ink", 2.0, "");
        };
        // The outline, then the colours upon it.
        self.path(&line, "w-dim", 8.0, "");
        let (from, to, y) = (number(from), number(to), number(y));
        let mut stroke = |colour: &str, more: &str| {
            self.body += &format!(
                "<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"5.5\"{more} \
                 d=\"M{from} {y}L{to} {y}\"/>\n"
            );
        };
        stroke(paint.base.hex(), "");
        if let Some(stripe) = paint.stripe {
            stroke(stripe.hex(), " stroke-dasharray=\"5 9\"");
        }
    }
}
