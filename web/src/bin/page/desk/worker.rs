//! Speaks with the worker that decodes dumps: makes it when it is first needed, takes in what it
//! says, and lets it go.

use super::{Choice, Desk};
use crate::handout::save;
use encoderscope::language::t;
use encoderscope_web::{
    browser::Peer,
    link,
    message::{self, FromDesk, Overview, ToDesk},
};
use js_sys::Array;
use leptos::prelude::*;
use std::time::Duration;
use wasm_bindgen::{JsCast, JsValue, prelude::Closure};
use web_sys::{Blob, MessageEvent};

/// A worker that is asked to stop does so in this time, or is at something that cannot be stopped.
const PATIENCE: Duration = Duration::from_millis(1_500);

impl Desk {
    /// Tells the worker the texts of the language.
    pub(super) fn tell(self) {
        let texts = self.spoken.texts.get_value();
        self.worker.with_value(|worker| {
            if let Some(worker) = worker {
                // A worker that is gone has reported its error already.
                let _ = worker.post(&message::speak(&texts));
            }
        });
    }

    /// Speaks to the worker, which is made when it is first needed.
    pub(crate) fn send(self, message: ToDesk) {
        self.send_with(message, None);
    }

    pub(super) fn send_with(self, message: ToDesk, file: Option<Blob>) {
        if self.worker.with_value(Option::is_none) {
            let made = self.workers.with_value(|workers| workers.desk().ok());
            match made {
                Some(worker) => self.listen(worker),
                None => {
                    let why =
                        t("This browser starts no workers, so that nothing can be decoded here.");
                    return self.refusal.set(Some(why.into()));
                }
            }
        }
        let mut early = Some((message, file));
        self.waiting.update_value(|waiting| {
            if let Some(waiting) = waiting {
                waiting.extend(early.take());
            }
        });
        if let Some((message, file)) = early
            && let Ok(message) = serde_wasm_bindgen::to_value(&message)
        {
            let file = file.map_or(JsValue::UNDEFINED, Into::into);
            self.worker.with_value(|worker| {
                if let Some(worker) = worker {
                    // A worker that is gone has reported its error already.
                    let _ = worker.post(&Array::of2(&message, &file));
                }
            });
        }
    }

    fn listen(self, worker: Peer) {
        let on_message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
            let both: Array = event.data().unchecked_into();
            if let Ok(message) = serde_wasm_bindgen::from_value::<FromDesk>(both.get(0)) {
                self.receive(message, &both.get(1));
            }
        });
        worker.set_heard(Some(on_message.as_ref().unchecked_ref()));
        on_message.forget();
        let on_error = Closure::<dyn FnMut()>::new(move || self.break_down());
        worker.set_broken(Some(on_error.as_ref().unchecked_ref()));
        on_error.forget();
        self.worker.set_value(Some(worker));
    }

    /// The worker is gone; the next input gets another one.
    fn break_down(self) {
        self.dismiss(t(
            "Decoding broke down: the input may need more memory than this browser gives. Cut it in pieces, or reload the page.",
        ));
    }

    /// Lets the worker go, whatever it is at.
    fn dismiss(self, why: &str) {
        self.worker.update_value(|worker| {
            if let Some(worker) = worker.take() {
                worker.terminate();
            }
        });
        self.waiting.set_value(Some(Vec::new()));
        self.sent.set_value(String::new());
        self.judging.set(false);
        self.overview.set(Overview {
            done: true,
            ..Overview::default()
        });
        self.refusal.set(Some(why.into()));
    }

    /// Stops reading; what has been decoded stays, where the worker hears it in time.
    pub(crate) fn cancel(self) {
        self.send(ToDesk::Cancel);
        let input = self.shares.get_value();
        let heard = self.heard.get_value();
        let dismiss = move || {
            let same = self.shares.try_get_value() == Some(input);
            let silent = self.heard.try_get_value() == Some(heard);
            let busy = self
                .overview
                .try_with_untracked(|overview| !overview.done)
                .unwrap_or(false);
            if busy && same && silent {
                self.dismiss(t(
                    "Stopped. Decoding did not answer: nothing of the input is kept.",
                ));
            }
        };
        set_timeout(dismiss, PATIENCE);
    }

    fn receive(self, message: FromDesk, file: &JsValue) {
        match message {
            FromDesk::Ready => {
                self.tell();
                let waiting = self.waiting.try_update_value(Option::take).flatten();
                for (message, file) in waiting.unwrap_or_default() {
                    self.send_with(message, file);
                }
            }
            FromDesk::Overview(overview) => {
                self.heard.update_value(|heard| *heard += 1);
                if overview.done {
                    self.settle();
                }
                self.overview.set(*overview);
            }
            FromDesk::Opened {
                text,
                profile,
                change,
            } => {
                if change.is_some() {
                    self.changed.set(change);
                }
                if let Some(text) = text {
                    self.sent.set_value(text.clone());
                    self.text.set(text);
                    self.file.set(None);
                }
                if let Some(profile) = profile.and_then(|profile| link::profile(&profile).ok()) {
                    self.choice.set(Choice::User);
                    self.profile.set_value(Some(profile));
                    self.found.set(Some(profile));
                }
            }
            FromDesk::Taken(profile) => {
                let profile = link::profile(&profile).ok();
                self.profile.set_value(profile);
                self.found.set(profile);
            }
            FromDesk::Marks(marks) => self.marks.set(marks),
            FromDesk::Rows { first, rows } => self.rows.set((first, rows)),
            FromDesk::Candidates { found, done } => {
                let best = found.first().filter(|best| best.change.is_none());
                // The frames of a recording are cut by its profile.
                let captured = self.overview.with_untracked(|overview| overview.captured);
                let reads = self
                    .overview
                    .with_untracked(|overview| overview.frames > overview.bad);
                let better = best.filter(|best| match best.verdict.as_str() {
                    "certain" | "likely" => true,
                    // It reads something where the present profile reads nothing.
                    "ambiguous" => !reads && !captured,
                    _ => false,
                });
                let profile = better.and_then(|best| link::profile(&best.profile).ok());
                if self.choice.get_untracked() == Choice::Nobody && profile.is_some() {
                    self.found.set(profile);
                }
                self.judging.set(!done);
                self.candidates.set(found);
            }
            FromDesk::Near(near) => self.near.set(near),
            FromDesk::Explained(explained) => self.explained.set(Some(*explained)),
            FromDesk::Found(found) => {
                self.lost.set(found.is_none());
                if let Some((place, index)) = found {
                    self.place.set_value(Some(place));
                    self.goal.set(Some(place));
                    self.chosen.set(Some(index));
                }
            }
            FromDesk::Trace(trace) => self.trace.set(trace),
            // What was packed before the input changed is not wanted any more.
            FromDesk::Shared(number, payload) if number == self.shares.get_value() => {
                self.payload.set(Some(payload));
            }
            FromDesk::Shared(..) => {}
            FromDesk::Exported(kind) => {
                if let Some(file) = file.dyn_ref::<Blob>() {
                    save(file, &format!("frames.{}", kind.extension()));
                }
            }
            FromDesk::Report(report) => self.report.set(report),
            FromDesk::Source(source) => self.source.set(Some(source)),
            FromDesk::Refused(why) => {
                self.refusal.set(Some(why));
                self.judging.set(false);
            }
        }
    }
}
