//! The page's end of the worker that decodes dumps: what was asked of it, and what it said.

use crate::Workers;
use encoderscope::{profile::Profile, sheet::Quantity};
use encoderscope_web::{
    link::{self, Fragment, encode, query},
    message::{
        CandidateView, Explained, FileKind, FromDesk, Marked, Overview, RowView, Selection, ToDesk,
        TraceView,
    },
};
use js_sys::Array;
use leptos::prelude::*;
use std::time::Duration;
use wasm_bindgen::{JsCast, JsValue, prelude::Closure};
use web_sys::{Blob, HtmlAnchorElement, MessageEvent, Url, Worker};

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
    worker: StoredValue<Option<Worker>, LocalStorage>,
    /// What was said before the worker was ready.
    waiting: StoredValue<Option<Vec<Parcel>>, LocalStorage>,
    /// Text of the box.
    pub(crate) text: RwSignal<String>,
    /// The text that the worker has.
    sent: StoredValue<String>,
    /// What the input is called where it is not the text of the box.
    pub(crate) file: RwSignal<Option<String>>,
    pub(crate) overview: RwSignal<Overview>,
    /// Rows, and the place of the first one.
    pub(crate) rows: RwSignal<(usize, Vec<RowView>)>,
    pub(crate) candidates: RwSignal<Vec<CandidateView>>,
    /// Whether it is still being found out what the input may be.
    pub(crate) judging: RwSignal<bool>,
    /// The candidate whose mistake of the capture is undone.
    pub(crate) changed: RwSignal<Option<usize>>,
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
    /// Where the table is to go: a place among the rows that are shown.
    pub(crate) goal: RwSignal<Option<usize>>,
    /// The profile that the candidates lead to, where nobody has chosen one.
    pub(crate) found: RwSignal<Option<Profile>>,
    pub(crate) choice: RwSignal<Choice>,
    typing: StoredValue<Option<TimeoutHandle>>,
    settling: StoredValue<Option<TimeoutHandle>>,
    profile: StoredValue<Option<Profile>>,
}

impl Desk {
    pub(crate) fn new(workers: Workers) -> Self {
        Self {
            workers: StoredValue::new_local(workers),
            worker: StoredValue::new_local(None),
            waiting: StoredValue::new_local(Some(Vec::new())),
            text: RwSignal::new(String::new()),
            sent: StoredValue::new(String::new()),
            file: RwSignal::new(None),
            overview: RwSignal::new(Overview::default()),
            rows: RwSignal::new((0, Vec::new())),
            candidates: RwSignal::new(Vec::new()),
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
            goal: RwSignal::new(None),
            found: RwSignal::new(None),
            choice: RwSignal::new(Choice::Nobody),
            typing: StoredValue::new(None),
            settling: StoredValue::new(None),
            profile: StoredValue::new(None),
        }
    }

    /// Whether there is nothing to decode.
    pub(crate) fn is_empty(self) -> bool {
        self.file.with(Option::is_none) && self.text.with(|text| text.trim().is_empty())
    }

    /// Speaks to the worker, which is made when it is first needed.
    pub(crate) fn send(self, message: ToDesk) {
        self.send_with(message, None);
    }

    fn send_with(self, message: ToDesk, file: Option<Blob>) {
        if self.worker.with_value(Option::is_none) {
            let made = self.workers.with_value(|workers| workers.desk().ok());
            match made {
                Some(worker) => self.listen(worker),
                None => {
                    return self.refusal.set(Some(
                        "This browser starts no workers, so that nothing can be decoded here."
                            .into(),
                    ));
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
                    let _ = worker.post_message(&Array::of2(&message, &file));
                }
            });
        }
    }

    fn listen(self, worker: Worker) {
        let on_message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
            let both: Array = event.data().unchecked_into();
            if let Ok(message) = serde_wasm_bindgen::from_value::<FromDesk>(both.get(0)) {
                self.receive(message, &both.get(1));
            }
        });
        worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        on_message.forget();
        let on_error = Closure::<dyn FnMut()>::new(move || self.break_down());
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        on_error.forget();
        self.worker.set_value(Some(worker));
    }

    /// The worker is gone; the next input gets another one.
    fn break_down(self) {
        self.worker.update_value(|worker| {
            if let Some(worker) = worker.take() {
                worker.terminate();
            }
        });
        self.waiting.set_value(Some(Vec::new()));
        self.sent.set_value(String::new());
        self.overview.set(Overview::default());
        self.refusal.set(Some(
            "Decoding broke down: the input may need more memory than this browser gives. Cut it in pieces, or reload the page.".into(),
        ));
    }

    fn receive(self, message: FromDesk, file: &JsValue) {
        match message {
            FromDesk::Ready => {
                let waiting = self.waiting.try_update_value(Option::take).flatten();
                for (message, file) in waiting.unwrap_or_default() {
                    self.send_with(message, file);
                }
            }
            FromDesk::Overview(overview) => {
                if overview.done {
                    self.settle();
                }
                self.overview.set(*overview);
            }
            FromDesk::Opened { text, profile } => {
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
                let reads = self
                    .overview
                    .with_untracked(|overview| overview.frames > overview.bad);
                let better = best.filter(|best| match best.verdict.as_str() {
                    "certain" | "likely" => true,
                    // It reads something where the present profile reads nothing.
                    "ambiguous" => !reads,
                    _ => false,
                });
                let profile = better.and_then(|best| link::profile(&best.profile).ok());
                if self.choice.get_untracked() == Choice::Nobody && profile.is_some() {
                    self.found.set(profile);
                }
                self.judging.set(!done);
                self.candidates.set(found);
            }
            FromDesk::Explained(explained) => self.explained.set(Some(*explained)),
            FromDesk::Found(found) => {
                if let Some((place, index)) = found {
                    self.place.set_value(Some(place));
                    self.goal.set(Some(place));
                    self.chosen.set(Some(index));
                }
            }
            FromDesk::Trace(trace) => self.trace.set(trace),
            FromDesk::Shared(payload) => self.payload.set(Some(payload)),
            FromDesk::Exported(kind) => save(file, kind),
            FromDesk::Report(report) => self.report.set(report),
            FromDesk::Source(source) => self.source.set(Some(source)),
            FromDesk::Refused(why) => {
                self.refusal.set(Some(why));
                self.judging.set(false);
            }
        }
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
        let send = move || {
            let text = self.text.get_untracked();
            if self.sent.with_value(|sent| *sent != text) {
                self.sent.set_value(text.clone());
                self.send(ToDesk::Text {
                    text,
                    profile: profile.clone(),
                });
            }
        };
        self.typing
            .set_value(set_timeout_with_handle(send, TYPED).ok());
    }

    /// A file was chosen, or so much was pasted that it is better not shown.
    pub(crate) fn open(self, name: String, file: Blob, profile: &Profile) {
        self.text.set(String::new());
        self.sent.set_value(String::new());
        self.file.set(Some(name.clone()));
        self.forget();
        let profile = query(profile);
        self.send_with(ToDesk::File { name, profile }, Some(file));
    }

    /// What was said of other input is not true any more.
    fn forget(self) {
        self.refusal.set(None);
        self.marks.set(Vec::new());
        self.candidates.set(Vec::new());
        self.changed.set(None);
        self.judging.set(true);
        self.payload.set(None);
        self.selection.set(Selection::default());
        self.chosen.set(None);
        self.place.set_value(None);
        self.goal.set(Some(0));
        self.explained.set(None);
    }

    /// The profile was changed.
    pub(crate) fn decode_as(self, profile: Profile) {
        if self.profile.get_value() == Some(profile) {
            return;
        }
        self.profile.set_value(Some(profile));
        self.changed.set(None);
        self.explained.set(None);
        if self.worker.with_value(Option::is_some) {
            self.send(ToDesk::Profile(query(&profile)));
        }
    }

    /// Undoes the mistake of the capture that a candidate names, and decodes with its profile.
    pub(crate) fn change(self, index: usize, profile: Profile) {
        self.profile.set_value(Some(profile));
        self.changed.set(Some(index));
        self.explained.set(None);
        self.send(ToDesk::Change(index));
    }

    /// Puts the input into the link when it has stayed as it is for a while.
    fn settle(self) {
        if let Some(before) = self.settling.get_value() {
            before.clear();
        }
        let share = move || {
            if self.payload.with_untracked(Option::is_none) && !self.is_empty() {
                self.send(ToDesk::Share);
            }
        };
        self.settling
            .set_value(set_timeout_with_handle(share, SETTLED).ok());
    }

    /// Takes over what a link says.
    pub(crate) fn follow_link(self, fragment: &Fragment) {
        let profile = match fragment.profile() {
            Some(Ok(profile)) => {
                self.choice.set(Choice::User);
                profile
            }
            _ => self
                .profile
                .get_value()
                .unwrap_or_else(|| encoderscope::format::Format::T485.default_profile()),
        };
        let value = |name: &str| fragment.value(name).map(ToOwned::to_owned);
        if let Some(payload) = value("frames") {
            self.forget();
            self.payload.set(Some(Ok(payload.clone())));
            self.profile.set_value(Some(profile));
            let profile = query(&profile);
            self.file.set(Some("frames from a link".into()));
            self.send(ToDesk::Link { payload, profile });
        } else if let Some(text) = value("dump") {
            self.profile.set_value(Some(profile));
            self.typed(text, &profile);
        } else {
            return;
        }
        let numbers = |text: String| {
            let mut parts = text.split(':');
            let name = parts.next()?.to_owned();
            Some((
                name,
                parts.next()?.parse().ok()?,
                parts.next()?.parse().ok()?,
            ))
        };
        let order = value("sort").map(|name| match name.strip_prefix('-') {
            Some(name) => (name.to_owned(), true),
            None => (name, false),
        });
        self.selection.set(Selection {
            show: value("show").unwrap_or_default(),
            status: value("bits")
                .and_then(|bits| bits.parse().ok())
                .unwrap_or(0),
            range: value("range").and_then(numbers),
            order: order.filter(|(name, _)| Quantity::parse(name).is_some()),
        });
        self.chosen
            .set(value("row").and_then(|row| row.parse().ok()));
        self.goal.set(self.chosen.get_untracked());
    }

    /// What a link says of the input and of what is shown of it.
    pub(crate) fn fragment(self) -> String {
        let mut text = String::new();
        if self.is_empty() {
            return text;
        }
        let mut add = |name: &str, value: String| text += &format!("&{name}={}", encode(&value));
        let Selection {
            show,
            status,
            range,
            order,
        } = self.selection.get();
        if !show.is_empty() && show != "all" {
            add("show", show);
        }
        if status != 0 {
            add("bits", status.to_string());
        }
        if let Some((name, low, high)) = range {
            add("range", format!("{name}:{low}:{high}"));
        }
        if let Some((name, descending)) = order {
            add("sort", if descending { format!("-{name}") } else { name });
        }
        if let Some(row) = self.chosen.get() {
            add("row", row.to_string());
        }
        // The longest part last: where a mail program cuts it the rest is still said.
        if let Some(Ok(payload)) = self.payload.get() {
            add("frames", payload);
        }
        text
    }
}

/// Lets the user keep a file that the worker wrote.
fn save(file: &JsValue, kind: FileKind) {
    let Some(blob) = file.dyn_ref::<Blob>() else {
        return;
    };
    let Ok(address) = Url::create_object_url_with_blob(blob) else {
        return;
    };
    let link = document()
        .create_element("a")
        .ok()
        .and_then(|element| element.dyn_into::<HtmlAnchorElement>().ok());
    if let Some(link) = link {
        link.set_href(&address);
        link.set_download(&format!("frames.{}", kind.extension()));
        link.click();
    }
    // The browser has taken the file by then.
    set_timeout(
        move || {
            let _ = Url::revoke_object_url(&address);
        },
        Duration::from_secs(60),
    );
}
