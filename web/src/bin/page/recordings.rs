//! Recordings: making them, what is there, replaying and comparing them; and the support file.

mod compare;
mod deleting;
mod kept;
mod recorder;
mod remains;
mod replay;
mod report;

pub(crate) use kept::RecordingsPanel;
pub(crate) use recorder::RecordButton;
pub(crate) use remains::Remains;
pub(crate) use replay::ReplayBar;

use crate::{
    app::{App, Source},
    handout::save,
};
use deleting::Doomed;
use encoderscope::{
    language::{number, t},
    text,
};
use encoderscope_web::{
    link::{profile, query},
    message::{Answer, BIT_CHANGES, Digest, Kept, RecorderState, Setting, Story, Wish},
};
use js_sys::Array;
use leptos::prelude::*;
use recorder::MARKER;
use report::Report;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::Blob;

/// What the page knows of recordings.
#[derive(Clone, Copy)]
pub(crate) struct Recordings {
    app: App,
    state: RwSignal<RecorderState>,
    list: RwSignal<Vec<Kept>>,
    doomed: RwSignal<Option<Doomed>>,
    /// It was doomed a moment ago: the focus is to go where that is undone.
    pressed: StoredValue<bool>,
    /// What could not be done.
    fault: RwSignal<Option<String>>,
    story: RwSignal<Option<Story>>,
    /// The support file that is open.
    opened: RwSignal<Option<Report>>,
    comparison: RwSignal<Option<Box<[Digest; 2]>>>,
    /// The speed that a replay goes on with when it is held.
    speed: RwSignal<f64>,
    /// The note that is being written, and how many there were.
    note: RwSignal<String>,
    notes: StoredValue<u32>,
    /// A support file is being made, with what the user says of it.
    hands: RwSignal<bool>,
    remark: RwSignal<String>,
}

impl Recordings {
    /// Those of the page, which listens to the engine from the first call on.
    pub(crate) fn of(app: App) -> Self {
        app.keep(|| {
            let made = Self {
                app,
                state: RwSignal::new(RecorderState::default()),
                list: RwSignal::new(Vec::new()),
                doomed: RwSignal::new(None),
                pressed: StoredValue::new(false),
                fault: RwSignal::new(None),
                story: RwSignal::new(None),
                opened: RwSignal::new(None),
                comparison: RwSignal::new(None),
                speed: RwSignal::new(1.0),
                note: RwSignal::new(String::new()),
                notes: StoredValue::new(0),
                hands: RwSignal::new(false),
                remark: RwSignal::new(String::new()),
            };
            app.hear(move |parcel| made.receive(&parcel));
            made.send(&Wish::Recordings);
            made
        })
    }

    fn send(self, wish: &Wish) {
        self.post(wish, &JsValue::UNDEFINED);
    }

    /// Wishes something with a file beside it.
    fn post(self, wish: &Wish, file: &JsValue) {
        self.fault.set(None);
        self.app.wish_with(wish, file);
    }

    fn receive(self, parcel: &Array) {
        let Ok(message) = serde_wasm_bindgen::from_value::<Answer>(parcel.get(0)) else {
            return;
        };
        match message {
            Answer::Plot(plot) => self.app.feed.plot.set(*plot),
            Answer::Rest(rest) => self.app.feed.rest.set(rest.map(|rest| *rest)),
            Answer::Recorder(state) => {
                let replayed = state.replay.as_ref().map(|replay| replay.profile.clone());
                let runs = state.recording.as_ref().is_some_and(|one| one.runs);
                if self.app.recording.get_untracked() != runs {
                    self.app.recording.set(runs);
                    self.app
                        .workers
                        .with_value(|workers| workers.recording(runs));
                }
                self.state.set(state);
                match replayed {
                    Some(text) => self.follow(&text),
                    None if self.opened.with_untracked(Option::is_some) => self.opened.set(None),
                    None => {}
                }
            }
            Answer::Recordings(list) => self.list.set(list),
            Answer::File(name) => {
                if let Ok(file) = parcel.get(1).dyn_into::<Blob>() {
                    save(&file, &name);
                }
            }
            Answer::Fault(text) => self.fault.set(Some(text)),
            Answer::Story(story) => self.story.set(Some(story)),
            Answer::Report(text) => self.opened.set(Some(Report::parse(&text))),
            Answer::Comparison(both) => self.comparison.set(Some(both)),
        }
    }

    /// The encoder in the settings is the one that is replayed.
    fn follow(self, text: &str) {
        if self.app.source.get_untracked() != Source::Replay {
            return;
        }
        if let Ok(profile) = profile(text)
            && self.app.profile.get_untracked() != profile
        {
            self.app.running.set(Some(profile));
            self.app.change_profile(profile);
        }
    }

    /// Replays a recording that is kept.
    fn replay(self, name: String) {
        self.begin(name, &JsValue::UNDEFINED);
    }

    /// Replays a file of the user's.
    pub(crate) fn open(self, name: String, file: &JsValue) {
        self.begin(name, file);
    }

    fn begin(self, name: String, file: &JsValue) {
        let app = self.app;
        self.opened.set(None);
        app.obstacle.set(None);
        app.source.set(Source::Replay);
        let profile = query(&app.readable());
        self.post(&Wish::Replay { name, profile }, file);
    }
}

/// Bytes in few digits.
fn size_text(bytes: f64) -> String {
    match bytes {
        1e9.. => text!("{} GB", number(format_args!("{:.2}", bytes / 1e9))),
        1e6.. => text!("{} MB", number(format_args!("{:.1}", bytes / 1e6))),
        1e3.. => text!("{} kB", format_args!("{:.0}", bytes / 1e3)),
        _ => text!("{} bytes", bytes),
    }
}

/// What was noted or happened, as it is written in English; what a user wrote stays as it is.
fn noted(english: &str) -> String {
    let (head, rest) = english.split_once(": ").unwrap_or((english, ""));
    let number = english.strip_prefix(MARKER).map(str::parse::<u32>);
    let is_ours = BIT_CHANGES.contains(&rest)
        || Setting::KINDS.iter().any(|kind| kind.name() == head)
        || head.starts_with("link ");
    match (number, is_ours) {
        (Some(Ok(number)), _) => format!("{}{number}", t(MARKER)),
        (_, true) => retold(english),
        _ => english.to_owned(),
    }
}

/// What is written in English into a file, for people: as a whole, or part by part.
fn retold(english: &str) -> String {
    let whole = t(english);
    if whole != english {
        return whole.to_owned();
    }
    for mark in [": ", "; "] {
        if let Some((before, behind)) = english.split_once(mark) {
            return [&retold(before), mark, &retold(behind)].concat();
        }
    }
    match (english.strip_prefix("link "), english.strip_suffix('.')) {
        (Some(state), _) => text!("link {}", t(state)),
        (None, Some(sentence)) => format!("{}.", t(sentence)),
        (None, None) => english.to_owned(),
    }
}

/// Seconds as on a clock.
fn clock_text(seconds: f64) -> String {
    let seconds = seconds as u64;
    let (hours, minutes) = (seconds / 3600, seconds / 60 % 60);
    match hours {
        0 => format!("{minutes}:{:02}", seconds % 60),
        _ => format!("{hours}:{minutes:02}:{:02}", seconds % 60),
    }
}
