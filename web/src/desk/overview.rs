//! How far the desk is, and what the rows come to.

use super::{State, source::Source};
use crate::{
    link,
    message::{Count, Marked, Overview},
};
use encoderscope::{dump::Marks, sheet::Tally};

/// Places of the text that are no data.
pub(super) fn marked(marks: &Marks) -> Vec<Marked> {
    let places = marks.places.iter().map(|mark| Marked {
        start: mark.at.start as usize,
        end: mark.at.end as usize,
        kind: mark.kind.to_string(),
    });
    places.collect()
}

fn counts(tallies: &[Tally]) -> Vec<Count> {
    let count = |tally: &Tally| Count {
        name: tally.name.clone(),
        count: tally.count as f64,
        first: tally.first,
    };
    let mut all: Vec<Count> = tallies.iter().map(count).collect();
    all.sort_by(|one, other| other.count.total_cmp(&one.count));
    all
}

impl State {
    /// What the page is told.
    pub(super) fn overview(&self) -> Overview {
        let mut view = Overview {
            profile: self.profile.as_ref().map(link::query).unwrap_or_default(),
            read: (self.read, self.source.as_ref().map_or(0.0, Source::len)),
            done: self.done,
            arranged: self.arranged,
            timing: self.captured.timing.clone(),
            notes: self.captured.notes.clone(),
            captured: self.captured.is_some(),
            ..Overview::default()
        };
        if let Some(dump) = self.paper.dump() {
            view.writing = dump.writing().to_string();
            view.lines = dump.len() as f64;
            view.bytes = dump.bytes().len() as f64;
            view.unread = dump.unread().total as f64;
            view.timed = dump.has_times();
            for mark in &dump.dropped().places {
                let kind = mark.kind.to_string();
                match view.dropped.iter_mut().find(|known| known.name == kind) {
                    Some(known) => known.count += 1.0,
                    None => view.dropped.push(Count {
                        name: kind,
                        count: 1.0,
                        first: 0,
                    }),
                }
            }
        }
        if let Some(sheet) = &self.sheet {
            let figures = sheet.figures();
            let full = |bits: u32, angle| encoderscope::reading::degrees(angle, bits);
            let bits = sheet.decoder().profile().angle_bits;
            let tenths = |value: i32| f64::from(value) / 10.0;
            view.frames = figures.summary.frames as f64;
            view.bad = figures.summary.bad as f64;
            view.skipped = figures.summary.skipped as f64;
            view.rows = sheet.len();
            view.shown = sheet.shown();
            view.lost = sheet.lost() as f64;
            view.faults = counts(&figures.faults);
            view.skips = counts(&figures.skips);
            view.conditions = counts(&figures.conditions);
            view.angle = figures
                .angle
                .map(|(low, high)| (full(bits, low), full(bits, high)));
            view.turns = figures.turns.map(|(low, high)| (low as f64, high as f64));
            view.temperature = figures
                .temperature
                .map(|(low, high)| (tenths(low), tenths(high)));
            view.speed = figures.speed;
            view.duration = figures.times.map(|(first, last)| last - first);
        }
        view
    }
}
