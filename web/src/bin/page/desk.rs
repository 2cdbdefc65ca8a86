//! The page's end of the worker that decodes dumps: what was asked of it, and what it said.

mod link;
mod named;
mod worker;

pub(crate) use link::end_text;
pub(crate) use named::Named;

use crate::{Workers, app::App, language::Spoken};
use encoderscope::profile::Profile;
use encoderscope_web::{
    browser::Peer,
    link::query,
    message::{
        CandidateView, Explained, Marked, NearView, Overview, RowView, Selection, ToDesk, TraceView,
    },
};
use leptos::prelude::*;
use std::time::Duration;
use web_sys::Blob;

/// Typing is over when nothing was typed for so long.
const TYPED: Duration = Duration::from_millis(120);
/// The link follows when nothing was changed for so long.
const SETTLED: Duration = Duration::from_millis(500);

/// Who has chosen the profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Choice {
    /// The user, or the link that led here.
    User,
    /// Nobody: what the input is taken for decides.
    Nobody,
}

/// A message, and the file beside it.
type Parcel = (ToDesk, Option<Blob>);

/// What the page knows of the input.
#[derive(Clone, Copy)]
pub(crate) struct Desk {
    workers: StoredValue<Workers, LocalStorage>,
    spoken: Spoken,
    worker: StoredValue<Option<Peer>, LocalStorage>,
    /// What was said before the worker was ready.
    waiting: StoredValue<Option<Vec<Parcel>>, LocalStorage>,
    /// Text of the box.
    pub(crate) text: RwSignal<String>,
    /// The text that the worker has.
    sent: StoredValue<String>,
    /// What the input is called where it is not the text of the box.
    pub(crate) file: RwSignal<Option<Named>>,
    pub(crate) overview: RwSignal<Overview>,
    /// Rows, and the place of the first one.
    pub(crate) rows: RwSignal<(usize, Vec<RowView>)>,
    pub(crate) candidates: RwSignal<Vec<CandidateView>>,
    /// What fits better than the profile, though little is different.
    pub(crate) near: RwSignal<Vec<NearView>>,
    /// Whether it is still being found out what the input may be.
    pub(crate) judging: RwSignal<bool>,
    /// The mistake of the capture that is undone, as a link has it.
    pub(crate) changed: RwSignal<Option<String>>,
    pub(crate) explained: RwSignal<Option<Explained>>,
    pub(crate) trace: RwSignal<TraceView>,
    pub(crate) marks: RwSignal<Vec<Marked>>,
    pub(crate) refusal: RwSignal<Option<String>>,
    pub(crate) report: RwSignal<Vec<Explained>>,
    /// The decoder as source, when it was asked for.
    pub(crate) source: RwSignal<Option<String>>,
    /// The input as a link carries it, or why none does.
    pub(crate) payload: RwSignal<Option<Result<String, String>>>,
    pub(crate) selection: RwSignal<Selection>,
    /// The row that is explained.
    pub(crate) chosen: RwSignal<Option<usize>>,
    /// The place of the row that is explained among those that are shown, where it is known.
    pub(crate) place: StoredValue<Option<usize>>,
    /// A row was looked for that is not there.
    pub(crate) lost: RwSignal<bool>,
    /// Where the table is to go: a place among the rows that are shown.
    pub(crate) goal: RwSignal<Option<usize>>,
    /// The profile that the candidates lead to, where nobody has chosen one.
    pub(crate) found: RwSignal<Option<Profile>>,
    pub(crate) choice: RwSignal<Choice>,
    typing: StoredValue<Option<TimeoutHandle>>,
    settling: StoredValue<Option<TimeoutHandle>>,
    /// Counts inputs, so that the payload of an earlier one is known.
    shares: StoredValue<u32>,
    /// Counts what the worker tells of how far it is.
    heard: StoredValue<u32>,
    profile: StoredValue<Option<Profile>>,
}

impl App {
    /// The page's end of the worker that decodes dumps.
    pub(crate) fn desk(self) -> Desk {
        self.keep(|| {
            let desk = Desk::new(self.workers, self.spoken);
            desk.follow_language();
            desk
        })
    }
}

impl Desk {
    fn new(workers: StoredValue<Workers, LocalStorage>, spoken: Spoken) -> Self {
        Self {
            workers,
            spoken,
            worker: StoredValue::new_local(None),
            waiting: StoredValue::new_local(Some(Vec::new())),
            text: RwSignal::new(String::new()),
            sent: StoredValue::new(String::new()),
            file: RwSignal::new(None),
            overview: RwSignal::new(Overview::default()),
            rows: RwSignal::new((0, Vec::new())),
            candidates: RwSignal::new(Vec::new()),
            near: RwSignal::new(Vec::new()),
            judging: RwSignal::new(false),
            changed: RwSignal::new(None),
            explained: RwSignal::new(None),
            trace: RwSignal::new(TraceView::default()),
            marks: RwSignal::new(Vec::new()),
            refusal: RwSignal::new(None),
            report: RwSignal::new(Vec::new()),
            source: RwSignal::new(None),
            payload: RwSignal::new(None),
            selection: RwSignal::new(Selection::default()),
            chosen: RwSignal::new(None),
            place: StoredValue::new(None),
            lost: RwSignal::new(false),
            goal: RwSignal::new(None),
            found: RwSignal::new(None),
            choice: RwSignal::new(Choice::Nobody),
            typing: StoredValue::new(None),
            settling: StoredValue::new(None),
            shares: StoredValue::new(0),
            heard: StoredValue::new(0),
            profile: StoredValue::new(None),
        }
    }

    /// Whether there is nothing to decode.
    pub(crate) fn is_empty(self) -> bool {
        self.file.with(Option::is_none) && self.text.with(|text| text.trim().is_empty())
    }

    /// Has all that was said of the input said again in another language.
    fn follow_language(self) {
        Effect::new(move |before: Option<()>| {
            self.spoken.language.track();
            if before.is_some() {
                // What was found is being said anew.
                let lines = self.overview.with_untracked(|overview| overview.lines);
                self.judging.set(lines > 0.0);
                self.candidates.set(Vec::new());
                self.near.set(Vec::new());
                self.report.set(Vec::new());
                self.payload.update(|payload| {
                    payload.take_if(|payload| payload.is_err());
                });
                self.tell();
            }
        });
    }

    /// The text of the box was changed.
    pub(crate) fn typed(self, text: String, profile: &Profile) {
        self.file.set(None);
        self.text.set(text);
        self.forget();
        let profile = query(profile);
        if let Some(before) = self.typing.get_value() {
            before.clear();
        }
        let send = move || self.hand_over(&profile);
        self.typing
            .set_value(set_timeout_with_handle(send, TYPED).ok());
    }

    /// Whether the box has text that the worker does not have.
    fn is_ahead(self) -> bool {
        let sent = || {
            self.sent
                .with_value(|sent| *sent == self.text.get_untracked())
        };
        self.file.with_untracked(Option::is_none) && !sent()
    }

    /// Sends the text of the box, where the worker does not have it yet.
    fn hand_over(self, profile: &str) {
        if self.is_ahead() {
            let text = self.text.get_untracked();
            self.sent.set_value(text.clone());
            self.send(ToDesk::Text {
                text,
                profile: profile.to_owned(),
            });
        }
    }

    /// Asks for something that is made of what stands in the box now.
    pub(crate) fn ask(self, message: ToDesk) {
        if let Some(profile) = self.profile.get_value() {
            self.hand_over(&query(&profile));
        }
        self.send(message);
    }

    /// A file was chosen, or so much was pasted that it is better not shown.
    pub(crate) fn open(self, name: Named, file: Blob, profile: &Profile) {
        self.text.set(String::new());
        self.sent.set_value(String::new());
        self.file.set(Some(name));
        self.forget();
        let profile = query(profile);
        self.send_with(ToDesk::File { profile }, Some(file));
    }

    /// What was said of other input is not true any more.
    fn forget(self) {
        self.shares.update_value(|number| *number += 1);
        if let Some(before) = self.settling.get_value() {
            before.clear();
        }
        self.refusal.set(None);
        self.marks.set(Vec::new());
        self.candidates.set(Vec::new());
        self.near.set(Vec::new());
        self.changed.set(None);
        self.judging.set(true);
        self.payload.set(None);
        self.selection.set(Selection::default());
        self.chosen.set(None);
        self.place.set_value(None);
        self.lost.set(false);
        self.goal.set(Some(0));
        self.explained.set(None);
    }

    /// The profile was changed.
    pub(crate) fn decode_as(self, profile: Profile) {
        if self.profile.get_value() == Some(profile) {
            return;
        }
        self.profile.set_value(Some(profile));
        self.explained.set(None);
        self.near.set(Vec::new());
        if self.worker.with_value(Option::is_some) {
            self.send(ToDesk::Profile(query(&profile)));
        }
    }

    /// Undoes the mistake of the capture that a candidate names, or none, and decodes with its
    /// profile.
    pub(crate) fn change(self, change: Option<String>, profile: Profile) {
        self.profile.set_value(Some(profile));
        self.changed.set(change.clone());
        self.explained.set(None);
        self.near.set(Vec::new());
        self.send(ToDesk::Change {
            change: change.unwrap_or_default(),
            profile: query(&profile),
        });
    }

    /// Packs the input for a link.
    pub(crate) fn share(self) {
        self.ask(ToDesk::Share(self.shares.get_value()));
    }

    /// Puts the input into the link when it has stayed as it is for a while.
    fn settle(self) {
        if let Some(before) = self.settling.get_value() {
            before.clear();
        }
        let share = move || {
            let bare = self.payload.with_untracked(Option::is_none);
            if bare && !self.is_empty() && !self.is_ahead() {
                self.share();
            }
        };
        self.settling
            .set_value(set_timeout_with_handle(share, SETTLED).ok());
    }
}
