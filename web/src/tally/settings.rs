//! Guided settings: their progress and their end.

use super::{Tally, frame_of, shown};
use crate::message::{Outcome, Progress, Setting};
use encoderscope::{
    language::{in_english, msg, t},
    sequence::{Event, Holds},
    session::Micros,
};

/// What is said when it is wanted, in the language that is spoken then.
pub(super) type Words = Box<dyn Fn() -> String>;

impl Tally {
    /// A sequence begins.
    pub fn begin(&mut self, now: Micros, setting: Setting, total: usize) {
        self.note(now, &format!("{}: {}", setting.name(), msg("begins")));
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
    pub fn refuse(&mut self, now: Micros, setting: Setting, why: impl Fn() -> String + 'static) {
        self.prepare(setting, 0);
        self.end(now, Some(false), Box::new(why));
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
                let (stop, holds) = (*stop, *holds);
                let words = move || match stop {
                    Some(stop) => format!("{}: {stop}; {holds}.", t("Stopped")),
                    None => format!("{}: {holds}.", t("Done")),
                };
                self.end(now, changed, Box::new(words));
            }
        }
    }

    fn end(&mut self, now: Micros, changed: Option<bool>, words: Words) {
        if let Some(progress) = &self.progress {
            let text = in_english(&words);
            self.note(now, &format!("{}: {text}", progress.setting.name()));
        }
        self.ending = Some(words);
        // What was read before says nothing about the shaft any more.
        self.places.clear();
        self.trail.jump();
        if let Some(progress) = &mut self.progress {
            let text = String::new();
            progress.outcome = Some(Outcome { changed, text });
        }
        self.touch();
    }

    /// The sequence that runs or has run last, with the words for its end.
    pub(super) fn progress(&self) -> Option<Progress> {
        let mut progress = self.progress.clone();
        let outcome = progress.as_mut().and_then(|one| one.outcome.as_mut());
        if let (Some(outcome), Some(words)) = (outcome, &self.ending) {
            outcome.text = words();
        }
        progress
    }

    /// The outcome has been read.
    pub fn forget_progress(&mut self) {
        self.progress = None;
        self.touch();
    }
}
