//! Decodes dumps in a worker of its own: reads the input piece by piece, keeps the sheet of rows,
//! and answers what the page asks of it.
//!
//! Nothing here takes longer than a few hundredths of a second at a time, so that the page can ask
//! for rows, or for something else altogether, while a large file is still being read.

mod captured;
mod capturing;
mod export;
mod judge;
mod look;
mod overview;
mod reading;
mod rows;
mod share;
mod source;

use crate::{
    language, link,
    message::{FromDesk, Marked, ToDesk},
};
use captured::Captured;
use capturing::{Framing, Tape};
use encoderscope::{
    decode::Decoder,
    detect::Change,
    dump::{Dump, Reader},
    export::{Language, source},
    language::t,
    profile::Profile,
    sheet::{Filter, Order, Sheet},
};
use judge::Judge;
use overview::marked;
use share::Load;
use source::Source;
use std::{cell::RefCell, rc::Rc};
use wasm_bindgen::{JsCast, JsValue};
use web_sys::Blob;

/// Text that the page shows in a box to type in, in bytes.
const TYPED: usize = 400_000;
/// Marks that the page gets.
const MOST_MARKS: usize = 400;

/// What has been read of the input.
#[derive(Debug, Default)]
enum Paper {
    #[default]
    None,
    /// Text that is still coming.
    Coming(Reader),
    /// Bytes that are still coming.
    Growing(Dump),
    /// All of it.
    Whole(Dump),
}

impl Paper {
    fn dump(&self) -> Option<&Dump> {
        match self {
            Self::None => None,
            Self::Coming(reader) => Some(reader.dump()),
            Self::Growing(dump) | Self::Whole(dump) => Some(dump),
        }
    }

    /// Nothing more will come.
    fn end(&mut self) {
        *self = match std::mem::take(self) {
            Self::Coming(reader) => Self::Whole(reader.finish()),
            Self::Growing(dump) => Self::Whole(dump),
            paper => paper,
        };
    }
}

/// What the desk knows of its input.
struct State {
    post: Rc<dyn Fn(FromDesk, Option<JsValue>)>,
    /// Counts inputs and profiles: work for an earlier one ends.
    job: u32,
    source: Option<Source>,
    profile: Option<Profile>,
    /// Where the data begins in the source.
    origin: usize,
    /// Whether the source is no text.
    binary: bool,
    /// Bytes of the source that have been read.
    read: f64,
    done: bool,
    paper: Paper,
    sheet: Option<Sheet>,
    /// The recording of clock and data, and whether it is being framed.
    tape: Tape,
    framing: Framing,
    captured: Captured,
    judge: Judge,
    shown: (Filter, Option<Order>),
    /// The row that was explained last, and one that is to be as soon as it is there.
    explained: Option<usize>,
    awaited: Option<usize>,
    /// How often rows have been chosen and sorted.
    arranged: u32,
    /// When the page was last told how far it is, in milliseconds.
    told: f64,
}

/// The desk; clones share one.
#[derive(Clone)]
pub struct Desk {
    state: Rc<RefCell<State>>,
}

impl std::fmt::Debug for Desk {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Desk")
    }
}

impl Desk {
    /// A desk that says what it has to say through `post`, with a file beside it where there is
    /// one.
    #[must_use]
    pub fn new(post: impl Fn(FromDesk, Option<JsValue>) + 'static) -> Self {
        Self {
            state: Rc::new(RefCell::new(State {
                post: Rc::new(post),
                job: 0,
                source: None,
                profile: None,
                origin: 0,
                binary: false,
                read: 0.0,
                done: true,
                paper: Paper::None,
                sheet: None,
                tape: Tape::None,
                framing: Framing::Idle,
                captured: Captured::default(),
                judge: Judge::default(),
                shown: (Filter::default(), None),
                explained: None,
                awaited: None,
                arranged: 0,
                told: 0.0,
            })),
        }
    }

    /// Does what the page asks for.
    pub fn handle(&self, message: ToDesk, file: Option<JsValue>) {
        match message {
            ToDesk::Speak => {
                language::speak(&file.unwrap_or_default());
                self.say_again();
            }
            ToDesk::Text { text, profile } => {
                let bytes: Rc<[u8]> = text.into_bytes().into();
                self.open(Source::Text(bytes), &profile);
            }
            ToDesk::File { profile } => {
                let blob = file.and_then(|file| file.dyn_into::<Blob>().ok());
                match blob {
                    Some(blob) => self.open(Source::File(blob), &profile),
                    None => self.post(FromDesk::Refused(t("There is no file to read.").into())),
                }
            }
            ToDesk::Link {
                payload,
                change,
                profile,
            } => self.open_link(payload, change, profile),
            ToDesk::Profile(profile) => self.change_profile(&profile),
            ToDesk::Change { change, profile } => self.change_input(&change, &profile),
            ToDesk::Cancel => self.cancel(),
            ToDesk::Show(shown) => self.show(&shown),
            ToDesk::Rows { first, count } => self.send_rows(first, count),
            ToDesk::Explain(index) => self.explain(index),
            ToDesk::Place(index) => self.find(|_, _| Some(index)),
            ToDesk::Pick(place) => self.find(|sheet, _| sheet.shown_at(place)),
            ToDesk::Seek(seconds) => self.find(|sheet, dump| sheet.row_at(dump, seconds)),
            ToDesk::NextFault(from) => self.find(|sheet, _| sheet.next_fault(from)),
            ToDesk::Trace { from, to, columns } => self.trace(from, to, columns),
            ToDesk::Export(kind) => self.export(kind),
            ToDesk::Share(number) => self.share(number),
            ToDesk::Report => self.report(),
            ToDesk::Source(language) => self.source(&language),
        }
    }

    fn post(&self, message: FromDesk) {
        self.post_with(message, None);
    }

    fn post_with(&self, message: FromDesk, file: Option<JsValue>) {
        let post = self.state.borrow().post.clone();
        post(message, file);
    }

    /// Begins with new input.
    fn open(&self, source: Source, profile: &str) {
        if let Some(refusal) = source.refusal() {
            return self.post(FromDesk::Refused(refusal));
        }
        {
            let mut state = self.state.borrow_mut();
            state.source = Some(source);
            state.origin = 0;
            state.tape = Tape::None;
            state.judge = Judge::default();
            state.profile = link::profile(profile).ok();
            state.explained = None;
            state.awaited = None;
        }
        self.begin();
    }

    fn open_link(&self, payload: String, change: String, profile: String) {
        let desk = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            match share::unpack(&payload).await {
                Ok(Load::Text(text)) => {
                    desk.post(FromDesk::Opened {
                        text: (text.len() <= TYPED).then(|| text.clone()),
                        profile: None,
                        change: None,
                    });
                    let bytes: Rc<[u8]> = text.into_bytes().into();
                    desk.open(Source::Text(bytes), &profile);
                    desk.state.borrow_mut().judge.change = Change::parse(&change);
                }
                Ok(Load::Bytes(bytes)) => {
                    let bytes: Rc<[u8]> = bytes.into();
                    desk.open(Source::Bytes(bytes), &profile);
                    desk.state.borrow_mut().judge.change = Change::parse(&change);
                }
                Err(why) => desk.post(FromDesk::Refused(why)),
            }
        });
    }

    /// Decodes the same input otherwise.
    fn change_profile(&self, profile: &str) {
        let Ok(profile) = link::profile(profile) else {
            return;
        };
        if self.state.borrow().profile == Some(profile) {
            return;
        }
        self.state.borrow_mut().profile = Some(profile);
        self.begin();
    }

    /// Whether the work of a job is still wanted.
    fn wants(&self, job: u32) -> bool {
        self.state.borrow().job == job
    }

    /// Writes the decoder in a programming language.
    fn source(&self, language: &str) {
        let known = Language::ALL.iter().find(|known| known.name() == language);
        let decoder = self.state.borrow().decoder();
        if let (Some(language), Some(decoder)) = (known, decoder) {
            self.post(FromDesk::Source(source(&decoder, *language)));
        }
    }

    fn share(&self, number: u32) {
        let desk = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            let packed = match desk.load().await {
                Ok(load) => share::pack(&load).await,
                Err(why) => Err(why),
            };
            desk.post(FromDesk::Shared(number, packed));
        });
    }

    /// The input as a link carries it.
    async fn load(&self) -> Result<Load, String> {
        let (source, origin) = {
            let state = self.state.borrow();
            (state.source.clone(), state.origin)
        };
        let source = source.ok_or_else(|| t("There is nothing to share yet."))?;
        let bytes = source.read(origin as f64, share::MOST + 1).await?;
        Ok(match String::from_utf8(bytes) {
            Ok(text) => Load::Text(text),
            Err(error) => Load::Bytes(error.into_bytes()),
        })
    }

    /// Tells the page how far it is, now or when it was not told for a while.
    fn tell(&self, now: bool) {
        const EVERY: f64 = 100.0;
        let at = crate::browser::now() as f64 / 1000.0;
        let overview = {
            let mut state = self.state.borrow_mut();
            if !now && at - state.told < EVERY {
                return;
            }
            state.told = at;
            state.overview()
        };
        self.post(FromDesk::Overview(Box::new(overview)));
    }

    /// Says how the text was read, in place.
    fn tell_marks(&self) {
        let marks = {
            let state = self.state.borrow();
            match (state.paper.dump(), &state.source) {
                (Some(dump), Some(Source::Text(_))) => {
                    let mut all = marked(dump.dropped());
                    all.extend(marked(dump.unread()).into_iter().map(|mark| Marked {
                        kind: String::new(),
                        ..mark
                    }));
                    all.sort_by_key(|mark| mark.start);
                    all.truncate(MOST_MARKS);
                    all
                }
                _ => Vec::new(),
            }
        };
        self.post(FromDesk::Marks(marks));
    }
}

impl State {
    /// All of the input has been read.
    fn finish(&mut self) {
        if let (Some(sheet), Some(dump)) = (&mut self.sheet, self.paper.dump())
            && !self.done
        {
            sheet.finish(dump);
        }
        self.done = true;
    }

    fn decoder(&self) -> Option<Decoder> {
        Decoder::new(self.profile?).ok()
    }
}
