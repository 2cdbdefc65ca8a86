//! Recordings: writing what is said on the line as it comes, and handing it out.

mod copy;

use super::{Engine, State};
use crate::{
    browser::{now, time_text},
    message::{Answer, Kept, Place, RecorderState, Recording, Story},
    store::{self, Out},
};
use copy::Copy;
use encoderscope::{
    language::{in_english, msg, t},
    session::Micros,
};
use js_sys::{Array, Date, Uint8Array};
use std::rc::Rc;
use wasm_bindgen::JsValue;
use web_sys::{Blob, FileSystemFileHandle};

/// What has come is written so often, which is all that a crash can take.
const WRITE: Micros = 500_000;
/// More than this is written at once.
const MUCH: usize = 262_144;
/// Memory takes no more, in bytes.
const ROOM: f64 = 536_870_912.0;
/// The page is told so often how it goes.
const TELL: Micros = 200_000;
/// A start is busy enough without looking for recordings that were cut off, in milliseconds.
const LATER: f64 = 1_000.0;

/// Recordings, and what the page knows of them.
#[derive(Default)]
pub(super) struct Recorder {
    running: Option<Running>,
    /// How the last one stands or has ended.
    last: Option<Recording>,
    /// One has ended since the page was told which there are.
    ended: bool,
    /// Recordings that are nowhere but in memory.
    in_memory: Vec<(String, Blob)>,
    told: RecorderState,
    next_tell: Micros,
}

struct Running {
    name: String,
    began: Micros,
    written: Micros,
    sink: Sink,
    copy: Option<Rc<Copy>>,
}

enum Sink {
    /// The file is being made.
    Coming,
    File(Out),
    Memory {
        parts: Array,
        size: f64,
    },
}

impl Sink {
    fn memory() -> Self {
        Self::Memory {
            parts: Array::new(),
            size: 0.0,
        }
    }

    const fn size(&self) -> f64 {
        match self {
            Self::Coming => 0.0,
            Self::File(out) => out.size(),
            Self::Memory { size, .. } => *size,
        }
    }

    fn append(&mut self, bytes: &[u8]) -> Result<(), String> {
        match self {
            Self::Coming => Ok(()),
            Self::File(out) => out.append(bytes),
            Self::Memory { size, .. } if *size + bytes.len() as f64 > ROOM => {
                Err(msg("There is no room left for it in memory.").into())
            }
            Self::Memory { parts, size } => {
                parts.push(&Uint8Array::from(bytes));
                *size += bytes.len() as f64;
                Ok(())
            }
        }
    }
}

impl Running {
    fn shown(&self, now: Micros) -> Recording {
        Recording {
            name: self.name.clone(),
            seconds: now.saturating_sub(self.began) as f64 / 1e6,
            size: self.sink.size(),
            place: match self.sink {
                Sink::Memory { .. } => Place::Memory,
                Sink::Coming | Sink::File(_) => Place::Storage,
            },
            copy: self.copy.as_ref().map(|copy| copy.name()),
            runs: true,
            fault: self.copy.as_ref().and_then(|copy| copy.fault()),
        }
    }
}

/// A name that tells when the recording began, on the user's clock.
fn name() -> String {
    let time = time_text(Date::now()).replace([' ', ':'], "-");
    format!("encoderscope-{time}.pcapng")
}

impl Engine {
    pub(super) fn fault(&self, text: &str) {
        self.hand(Answer::Fault(text.into()), None);
    }

    /// Tells the page of recordings that were cut off, if there are any.
    pub(super) fn look_for_remains(&self) {
        let engine = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            crate::browser::pause(LATER).await;
            let all = store::list().await.unwrap_or_default();
            if all.iter().any(|kept| !kept.whole && !kept.runs) {
                engine.hand(Answer::Recordings(all), None);
            }
        });
    }

    /// Tells the page which recordings there are, when one has ended.
    pub(super) fn list_ended(&self) {
        if std::mem::take(&mut self.state.borrow_mut().recorder.ended) {
            self.list();
        }
    }

    /// Lets a recording go.
    pub(super) fn delete(&self, name: String) {
        let memory = &mut self.state.borrow_mut().recorder.in_memory;
        memory.retain(|(known, _)| *known != name);
        self.change(async move { store::delete(&name).await });
    }

    /// Gives a recording that was cut off its end.
    pub(super) fn settle(&self, name: String) {
        self.change(async move { store::settle(&name).await });
    }

    /// Hands out a recording.
    pub(super) fn fetch(&self, name: String) {
        let engine = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            match engine.recording(&name).await {
                Some(file) => engine.hand(Answer::File(name), Some(file.into())),
                None => engine.fault(t("This recording is not there any more.")),
            }
            engine.list();
        });
    }

    /// Begins a recording.
    pub(super) fn begin_recording(&self) {
        let wanted = name();
        {
            let mut state = self.state.borrow_mut();
            if state.recorder.running.is_some() {
                return;
            }
            let now = now();
            state.tally.transcript().begin(now);
            state.recorder.running = Some(Running {
                name: wanted.clone(),
                began: now,
                written: now,
                sink: Sink::Coming,
                copy: None,
            });
        }
        let engine = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            let made = Out::create(&wanted).await;
            let unwanted = {
                let running = &mut engine.state.borrow_mut().recorder.running;
                match running.as_mut().filter(|running| running.name == wanted) {
                    Some(running) => {
                        running.sink = made.map_or_else(|_| Sink::memory(), Sink::File);
                        None
                    }
                    // It was ended meanwhile.
                    None => made.ok(),
                }
            };
            if unwanted.is_some() {
                drop(unwanted);
                engine.change(async move { store::delete(&wanted).await });
            }
            engine.pump();
        });
    }

    pub(super) fn copy(&self, handle: FileSystemFileHandle) {
        let (copy, name, size) = {
            let mut state = self.state.borrow_mut();
            let Some(running) = &mut state.recorder.running else {
                return;
            };
            let copy = Rc::new(Copy::new(handle));
            running.copy = Some(Rc::clone(&copy));
            (copy, running.name.clone(), running.sink.size())
        };
        let engine = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            let whole = engine.recording(&name).await;
            let front = whole.and_then(|whole| whole.slice_with_f64_and_f64(0.0, size).ok());
            copy.run(front).await;
            engine.pump();
        });
    }

    /// A recording, as far as it has come.
    pub(super) async fn recording(&self, name: &str) -> Option<Blob> {
        let in_memory = {
            let state = self.state.borrow();
            let recorder = &state.recorder;
            let ended = recorder.in_memory.iter().find(|(known, _)| known == name);
            let running = recorder.running.as_ref().filter(|one| one.name == name);
            match (ended, running.map(|running| &running.sink)) {
                (Some((_, blob)), _) => Some(blob.clone()),
                (None, Some(Sink::Memory { parts, .. })) => blob_of(parts),
                _ => None,
            }
        };
        match in_memory {
            Some(blob) => Some(blob),
            None => {
                // One that was cut off gets its end first: a file that changes while it is read
                // cannot be read on. One that runs keeps its own.
                let _ = store::settle(name).await;
                store::open(name).await.ok().map(Into::into)
            }
        }
    }

    /// Changes what is kept, and says what is there then.
    pub(super) fn change(&self, change: impl Future<Output = Result<(), JsValue>> + 'static) {
        let engine = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            // What is not there any more needs no change.
            let _ = change.await;
            engine.list();
        });
    }

    pub(super) fn list(&self) {
        let engine = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            // Where nothing is kept, there is what is in memory.
            let mut all = store::list().await.unwrap_or_default();
            {
                let state = engine.state.borrow();
                let in_memory = state.recorder.in_memory.iter().rev();
                let in_memory = in_memory.map(|(name, blob)| Kept {
                    name: name.clone(),
                    size: blob.size(),
                    written: Date::now(),
                    runs: false,
                    whole: true,
                });
                all.splice(0..0, in_memory);
            }
            engine.hand(Answer::Recordings(all), None);
        });
    }

    /// A support file: what was said of late, with a text in front.
    pub(super) fn report(&self, text: &str) {
        let file = self.state.borrow_mut().tally.transcript().late(text);
        let blob = blob_of(&Array::of1(&Uint8Array::from(&file[..])));
        let name = name().replace(".pcapng", "-report.pcapng");
        self.hand(Answer::File(name), blob.map(Into::into));
    }
}

fn blob_of(parts: &Array) -> Option<Blob> {
    Blob::new_with_u8_array_sequence(parts).ok()
}

impl State {
    /// Writes what has come, and tells the page how recordings and replays go; returns when to
    /// do so again.
    pub(super) fn keep(&mut self, now: Micros) -> Option<Micros> {
        let due = self.write(now);
        let told = self.tell_recorder(now);
        let replays = self.is_replaying().then_some(now + TELL);
        [due, told, replays].into_iter().flatten().min()
    }

    fn write(&mut self, now: Micros) -> Option<Micros> {
        let running = self.recorder.running.as_mut()?;
        let untaken = self.tally.transcript().untaken()?;
        let due = running.written + WRITE;
        if (now < due && untaken.len() < MUCH) || matches!(running.sink, Sink::Coming) {
            return Some(due.max(now + 1_000));
        }
        running.written = now;
        let bytes = std::mem::take(untaken);
        if !bytes.is_empty() {
            if let Err(why) = running.sink.append(&bytes) {
                self.end_recording(Some(why));
                return None;
            }
            if let Some(copy) = &running.copy {
                copy.push(&bytes);
            }
        }
        Some(now + WRITE)
    }

    /// Ends the recording that runs.
    pub(super) fn end_recording(&mut self, fault: Option<String>) {
        let now = now();
        let Some(mut running) = self.recorder.running.take() else {
            return;
        };
        self.recorder.ended = true;
        let why = fault.as_deref().unwrap_or("stopped");
        let rest = self.tally.transcript().end(now, why);
        if matches!(running.sink, Sink::Coming) {
            running.sink = Sink::memory();
        }
        // A storage that is full takes the end alone at best; the recording is good without it.
        let written = running.sink.append(&rest);
        if let Some(copy) = &running.copy {
            copy.push(&rest);
            copy.end();
        }
        let shown = running.shown(now);
        self.recorder.last = Some(Recording {
            runs: false,
            fault: fault.or(written.err()).or(shown.fault.clone()),
            ..shown
        });
        if let Sink::Memory { parts, .. } = &running.sink
            && let Some(blob) = blob_of(parts)
        {
            self.recorder.in_memory.push((running.name, blob));
        }
    }

    /// Tells the page how recordings and replays go; returns when to look again, where it is too
    /// soon.
    fn tell_recorder(&mut self, now: Micros) -> Option<Micros> {
        if now < self.recorder.next_tell {
            return Some(self.recorder.next_tell);
        }
        let running = self.recorder.running.as_ref();
        let state = RecorderState {
            recording: running
                .map(|running| running.shown(now))
                .or_else(|| self.recorder.last.clone()),
            replay: self.replay_shown(),
        };
        if state != self.recorder.told {
            self.recorder.next_tell = now + TELL;
            self.recorder.told = state.clone();
            (self.hand)(Answer::Recorder(state), None);
        }
        None
    }

    pub(super) fn story(&mut self) -> Story {
        let happenings = self.tally.happenings();
        let happenings = happenings
            .map(|(at, text)| (at as f64 / 1e3, text.to_owned()))
            .collect();
        let (size, since) = self.tally.transcript().kept(now());
        let snapshot = in_english(|| self.snapshot());
        // The page has not seen it.
        self.tally.touch();
        Story {
            happenings,
            size: size as f64,
            seconds: since as f64 / 1e6,
            snapshot: Box::new(snapshot),
        }
    }
}
