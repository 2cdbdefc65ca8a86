//! The lanes of a timeline in rows, with the bits and fields below.

use super::{
    MARGIN, Scene, Timeline,
    labels::{LINE, Label, place},
    pen::Pen,
    strip::{fill, names},
};
use crate::{
    diagram::{Fold, Lane, Side, Slot, What},
    language::t,
};
use alloc::{string::String, vec::Vec};

/// Room for the names of the lanes.
const NAMES: f64 = 60.0;
/// The narrowest and the widest bit.
const BIT: (f64, f64) = (12.0, 24.0);
/// Height of a wave, and of a lane with the room below.
const WAVE: f64 = 22.0;
const LANE: f64 = 34.0;

pub(super) fn draw(pen: &mut Pen, scene: &Scene<'_>, timeline: &Timeline) {
    let room = pen.inner() - NAMES;
    let narrow = Fold::new(timeline, BIT.0);
    let wider = BIT.0 * room / narrow.width().max(1.0);
    let fold = Fold::new(timeline, wider.clamp(BIT.0, BIT.1));
    pen.down(14.0);
    pen.text(MARGIN, "es-head es-ink", t("On the wire"));
    if scene.is_bytes() {
        pen.down(18.0);
        let order = t("each byte: start bit, least significant bit first, stop bit");
        pen.text(MARGIN, "es-dim", order);
    }
    pen.down(14.0);
    for (from, to) in rows(scene, timeline, &fold, room) {
        let row = Row {
            scene,
            timeline,
            fold: &fold,
            from,
            to,
        };
        row.draw(pen);
    }
}

/// From when to when the rows are, cut where a byte begins, or between the bits of a word.
fn rows(scene: &Scene<'_>, timeline: &Timeline, fold: &Fold, room: f64) -> Vec<(i64, i64)> {
    let is_cut = |slot: &&Slot| match slot.what {
        What::Bit(_) | What::Request(_) => !scene.is_bytes(),
        What::Stop => false,
        _ => true,
    };
    let mut cuts: Vec<i64> = timeline
        .slots
        .iter()
        .filter(is_cut)
        .map(|slot| slot.from)
        .collect();
    cuts.push(timeline.end);
    cuts.sort_unstable();
    let mut rows = Vec::new();
    let mut from = 0;
    while from < timeline.end {
        let fits = |cut: &&i64| **cut > from && fold.x(**cut) - fold.x(from) <= room;
        let next = cuts.iter().find(|cut| **cut > from);
        let Some(to) = cuts.iter().rev().find(fits).or(next) else {
            break;
        };
        rows.push((from, *to));
        from = *to;
    }
    rows
}

struct Row<'a> {
    scene: &'a Scene<'a>,
    timeline: &'a Timeline,
    fold: &'a Fold,
    from: i64,
    to: i64,
}

impl Row<'_> {
    fn x(&self, time: i64) -> f64 {
        let time = time.clamp(self.from, self.to);
        MARGIN + NAMES + self.fold.x(time) - self.fold.x(self.from)
    }

    fn is_in(&self, slot: &Slot) -> bool {
        slot.to > self.from && slot.from < self.to
    }

    fn draw(&self, pen: &mut Pen) {
        let top = pen.y;
        for lane in &self.timeline.lanes {
            self.wave(pen, lane);
            pen.down(LANE);
        }
        self.breaks(pen, top);
        let encoder = self.timeline.encoder();
        for slot in self
            .timeline
            .of_lane(encoder)
            .filter(|slot| self.is_in(slot))
        {
            self.mark(pen, slot);
        }
        self.names(pen);
        pen.down(14.0);
    }

    fn wave(&self, pen: &mut Pen, lane: &Lane) {
        let y = |level: bool| if level { pen.y } else { pen.y + WAVE };
        let mut level = lane.level_at(self.from);
        let mut points = Vec::from([(self.x(self.from), y(level))]);
        let within = |time: i64| time > self.from && time < self.to;
        for step in lane.steps.iter().filter(|step| within(step.time)) {
            let x = self.x(step.time);
            points.extend([(x, y(level)), (x, y(step.level))]);
            level = step.level;
        }
        points.push((self.x(self.to), y(level)));
        pen.text_at(MARGIN, pen.y + WAVE - 6.0, "es-name es-dim", t(lane.name));
        pen.path(&points, "es-wire");
    }

    /// Two strokes where time is folded.
    fn breaks(&self, pen: &mut Pen, top: f64) {
        for cell in self.fold.cells().iter().filter(|cell| cell.is_folded) {
            if cell.to <= self.from || cell.from >= self.to {
                continue;
            }
            let middle = (self.x(cell.from) + self.x(cell.to)) / 2.0;
            let height = self.timeline.lanes.len() as f64 * LANE - 4.0;
            pen.rect((middle - 3.0, top - 4.0), (6.0, height), "es-panel");
            for x in [middle - 3.0, middle + 3.0] {
                let stroke = [(x - 2.0, top - 4.0 + height), (x + 2.0, top - 4.0)];
                pen.path(&stroke, "es-rule");
            }
        }
    }

    /// The value of a bit and the place at which it is read.
    fn mark(&self, pen: &mut Pen, slot: &Slot) {
        let lane = self.timeline.lanes.get(slot.lane);
        let (Some(lane), What::Bit(_) | What::Start | What::Stop) = (lane, slot.what) else {
            return;
        };
        let (from, to) = (self.x(slot.from), self.x(slot.to));
        let middle = slot
            .from
            .saturating_add(slot.to.saturating_sub(slot.from) / 2);
        let level = lane.level_at(slot.sampled.unwrap_or(middle));
        let digit = if level { "1" } else { "0" };
        let above = pen.y - LANE;
        let class = match slot.what {
            What::Bit(bit) => {
                let class = self.scene.class(bit);
                let line = (to - from - 1.0, 3.0);
                pen.rect((from + 0.5, pen.y + 8.0), line, fill(class));
                if let Some(at) = slot.sampled.filter(|at| (self.from..self.to).contains(at)) {
                    let y = if level { above } else { above + WAVE };
                    pen.dot((self.x(at), y), fill(class));
                }
                "es-name es-mid es-ink"
            }
            _ => "es-name es-mid es-framing",
        };
        pen.text_at((from + to) / 2.0, pen.y + 3.0, class, digit);
    }

    /// The names of fields and of stretches that are no bits, below.
    fn names(&self, pen: &mut Pen) {
        let mut before = String::new();
        let mut found: Vec<(&Slot, String)> = Vec::new();
        for (index, lane) in self.timeline.lanes.iter().enumerate() {
            for slot in self.timeline.of_lane(index).filter(|slot| self.is_in(slot)) {
                let name = self.name(slot, lane);
                if name != before && !name.is_empty() {
                    found.push((slot, name.clone()));
                }
                if !matches!(slot.what, What::Start | What::Stop) || lane.side == Side::Master {
                    before = name;
                }
            }
            before.clear();
        }
        found.sort_by_key(|(slot, _)| slot.from);
        let mut labels = Vec::new();
        for (slot, name) in &found {
            let class = match slot.what {
                What::Bit(bit) => names(self.scene.class(bit)),
                _ => "es-name es-dim",
            };
            labels.push(Label::new(self.x(slot.from) + 1.0, name, class));
        }
        let top = pen.y + 11.0;
        let lines = place(&mut labels, MARGIN + pen.inner());
        for label in &labels {
            let y = top + 11.0 + label.line as f64 * LINE;
            if label.line > 0 {
                pen.path(&[(label.anchor, top), (label.anchor, y - 9.0)], "es-rule");
            }
            pen.text_at(label.x, y, label.class, &label.text);
        }
        pen.y = top + lines as f64 * LINE;
    }

    fn name(&self, slot: &Slot, lane: &Lane) -> String {
        let is_byte = self.scene.is_bytes();
        match slot.what {
            What::Bit(bit) => self.scene.note(bit).map_or("", |note| t(note.name)).into(),
            What::Start | What::Stop if is_byte && lane.side == Side::Encoder => String::new(),
            What::Start | What::Stop | What::Request(_) if is_byte => t("request").into(),
            what => t(what.name()).into(),
        }
    }
}
