//! Guided settings: their progress and their end.

use super::{Tally, frame_of, shown};
use crate::message::{Outcome, Progress, Setting};
use encoderscope::{
    sequence::{Event, Holds},
    session::Micros,
};

impl Tally {
    /// A sequence begins.
    pub fn begin(&mut self, now: Micros, setting: Setting, total: usize) {
        self.note(now, &format!("{}: begins", setting.name()));
        self.prepare(setting, total);
    }

    fn prepare(&mut self, setting: Setting, total: usize) {
        let before = self
            .decoder
            .as_ref()
            .zip(self.last_good.as_ref())
            .and_then(|(decoder, bytes)| shown(&frame_of(decoder, bytes, true)?));
        self.progress = Some(Progress {
            setting,
            done: 0,
            total: total as u32,
            count: None,
            before,
            held: self.held(setting),
            outcome: None,
        });
        self.touch();
    }

    /// A sequence could not begin.
    pub fn refuse(&mut self, now: Micros, setting: Setting, why: &str) {
        self.prepare(setting, 0);
        self.end(now, Some(false), why.into());
    }

    /// What a sequence says.
    pub fn follow(&mut self, now: Micros, event: &Event) {
        self.touch();
        match event {
            Event::Transmit(_) => {}
            Event::Progress { done, count, .. } => {
                if let Some(progress) = &mut self.progress {
                    progress.done = *done as u32;
                    progress.count = count.or(progress.count);
                }
            }
            Event::Ended { stop, holds, .. } => {
                self.settle_memory(*holds);
                let changed = match holds {
                    Holds::New => Some(true),
                    Holds::Old => Some(false),
                    Holds::Unknown => None,
                };
                let text = match stop {
                    Some(stop) => format!("Stopped: {stop}; {holds}."),
                    None => format!("Done: {holds}."),
                };
                self.end(now, changed, text);
            }
        }
    }

    fn end(&mut self, now: Micros, changed: Option<bool>, text: String) {
        if let Some(progress) = &self.progress {
            self.note(now, &format!("{}: {text}", progress.setting.name()));
        }
        // What was read before says nothing about the shaft any more.
        self.places.clear();
        self.trail.jump();
        if let Some(progress) = &mut self.progress {
            progress.outcome = Some(Outcome { changed, text });
        }
        self.touch();
    }

    /// The outcome has been read.
    pub fn forget_progress(&mut self) {
        self.progress = None;
        self.touch();
    }
}
