//! Reading the input in pieces, and decoding as far as it has come.

use super::{
    Desk, Paper,
    captured::Captured,
    capturing::{Framing, Tape},
    source::{self, HEAD, Recoder, Source, is_binary},
};
use crate::{
    browser::{now, pause},
    link,
    message::FromDesk,
};
use encoderscope::{
    capture::{Changes, sniff},
    detect::Change,
    dump::{Dump, Reader},
    format::Medium,
    sheet::Sheet,
};
use std::rc::Rc;

/// Bytes of data that are decoded in one go, and those of words of bits, which are short.
const BUDGET: usize = 128 << 10;
const BUDGET_OF_BITS: usize = 8 << 10;
/// Rows that are looked at in one go.
const ROWS: usize = 50_000;
/// How much more than its front says a text may hold.
const SPARE: f64 = 1.02;
/// Microseconds of work before others get their turn.
const SLICE: u64 = 20_000;

/// Gives others their turn when work has taken long enough.
pub(super) struct Turn {
    since: u64,
}

impl Turn {
    pub(super) fn new() -> Self {
        Self { since: now() }
    }

    pub(super) async fn over(&mut self) {
        if now().saturating_sub(self.since) > SLICE {
            pause(0.0).await;
            self.since = now();
        }
    }
}

impl super::State {
    /// Begins with an empty sheet.
    pub(super) fn blank(&mut self) {
        self.sheet = self.decoder().map(Sheet::new);
        let (filter, order) = self.shown;
        if let Some(sheet) = &mut self.sheet {
            sheet.show(filter, order);
        }
    }
}

impl Desk {
    /// Begins to read and decode the source with the profile.
    pub(super) fn begin(&self) {
        let job = {
            let mut state = self.state.borrow_mut();
            state.job += 1;
            state.done = false;
            state.framing = Framing::Idle;
            state.blank();
            state.job
        };
        self.run(job);
    }

    /// Says all that was said of the input once more, in another language: what has been read of
    /// it is decoded and judged anew, since what is said is kept as it was said.
    pub(super) fn say_again(&self) {
        let job = {
            let mut state = self.state.borrow_mut();
            state.judge.forget();
            if state.source.is_none() {
                return;
            }
            state.awaited = state.awaited.or(state.explained);
            let whole = matches!(state.paper, Paper::Whole(_)) && !state.captured.is_some();
            if !(state.done && whole) {
                drop(state);
                return self.begin();
            }
            state.job += 1;
            state.done = false;
            state.blank();
            let change = state.judge.change.map(Change::sentence);
            state.captured.notes = change.into_iter().collect();
            state.job
        };
        let desk = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            if desk.decode(job, &mut Turn::new()).await {
                desk.conclude(job).await;
            }
        });
    }

    /// Reads and decodes, in the background.
    pub(super) fn run(&self, job: u32) {
        let desk = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            if let Err(why) = desk.read(job).await
                && desk.wants(job)
            {
                desk.cancel();
                desk.post(FromDesk::Refused(why));
            }
        });
    }

    /// Stops reading; what there is stays. What has come of a recording is framed, and framing it
    /// can be stopped as well.
    pub(super) fn cancel(&self) {
        let job = {
            let mut state = self.state.borrow_mut();
            if state.framing != Framing::Idle {
                state.framing = Framing::Stopping;
                return;
            }
            state.job += 1;
            state.job
        };
        match self.cut_tape() {
            Ok(true) => return self.run(job),
            Ok(false) => {}
            Err(why) => self.post(FromDesk::Refused(why)),
        }
        let mut state = self.state.borrow_mut();
        state.paper.end();
        state.finish();
        drop(state);
        self.tell(true);
    }

    async fn read(&self, job: u32) -> Result<(), String> {
        let source = self.state.borrow().source.clone();
        let Some(source) = source else {
            return Ok(());
        };
        self.state.borrow_mut().captured = Captured::default();
        // What has changed in a recording is framed again without reading it again.
        if self.changes().is_none() {
            self.read_source(job, &source).await?;
        }
        if !self.wants(job) {
            return Ok(());
        }
        if let Some(changes) = self.changes() {
            self.frame(job, changes).await?;
            if !self.wants(job) {
                return Ok(());
            }
        }
        if self.state.borrow().judge.change.is_some() {
            self.undo_mistake();
            if !self.decode(job, &mut Turn::new()).await {
                return Ok(());
            }
        }
        self.conclude(job).await;
        Ok(())
    }

    /// Says what has become of the input, all of which has been decoded.
    async fn conclude(&self, job: u32) {
        self.state.borrow_mut().finish();
        self.tell(true);
        self.tell_marks();
        let awaited = self.state.borrow_mut().awaited.take();
        if let Some(index) = awaited {
            self.explain(index);
        }
        self.arrange(job).await;
        if self.wants(job) {
            self.judge(job).await;
        }
    }

    /// What has changed in a recording that has been read.
    fn changes(&self) -> Option<Rc<Changes>> {
        match &self.state.borrow().tape {
            Tape::Whole(changes) => Some(changes.clone()),
            Tape::None | Tape::Coming(_) => None,
        }
    }

    async fn read_source(&self, job: u32, source: &Source) -> Result<(), String> {
        let head = source.read(0.0, HEAD).await?;
        if !self.wants(job) {
            return Ok(());
        }
        let head = self.title(head);
        let mut recoder = Recoder::new(&head);
        let binary = !recoder.is_needed() && is_binary(&head);
        self.state.borrow_mut().binary = binary;
        match (binary, sniff(&head)) {
            (_, Some(kind)) => self.read_tape(job, source, kind).await,
            (true, None) => self.read_bytes(job, source).await,
            (false, None) => {
                let start = recoder_head(&head);
                self.read_text(job, source, &start, &mut recoder).await
            }
        }
    }

    /// Takes the title of a recording off its head.
    fn title(&self, mut head: Vec<u8>) -> Vec<u8> {
        let mut state = self.state.borrow_mut();
        let Some((profile, origin)) = source::profile_of(&head) else {
            return head;
        };
        let first = state.origin == 0;
        let (profile, change) = match profile.split_once("&change=") {
            Some((profile, change)) => (profile.to_owned(), Some(change.to_owned())),
            None => (profile, None),
        };
        state.origin = origin;
        if first && let Ok(known) = link::profile(&profile) {
            state.profile = Some(known);
            state.judge.change = change.as_deref().and_then(Change::parse);
            state.sheet = state.decoder().map(Sheet::new);
            let post = state.post.clone();
            drop(state);
            post(
                FromDesk::Opened {
                    text: None,
                    profile: Some(profile),
                    change,
                },
                None,
            );
        }
        head.split_off(origin)
    }

    async fn read_text(
        &self,
        job: u32,
        source: &Source,
        head: &str,
        recoder: &mut Recoder,
    ) -> Result<(), String> {
        let mut at = {
            let mut state = self.state.borrow_mut();
            let medium = state.profile.map(|profile| profile.medium());
            state.paper = Paper::Coming(Reader::new(medium.unwrap_or(Medium::Bytes), head));
            state.origin as f64
        };
        let mut turn = Turn::new();
        loop {
            let piece = source.piece(at).await?;
            if !self.wants(job) {
                return Ok(());
            }
            let last = piece.is_empty();
            at += piece.len() as f64;
            {
                let mut state = self.state.borrow_mut();
                state.read = at;
                if let Paper::Coming(reader) = &mut state.paper {
                    let first = reader.dump().is_empty();
                    reader.push(&recoder.recode(piece));
                    if first {
                        reader.expect((source.len() / at - 1.0) * SPARE);
                    }
                }
                if last {
                    state.paper.end();
                }
            }
            if !self.decode(job, &mut turn).await || last {
                return Ok(());
            }
        }
    }

    async fn read_bytes(&self, job: u32, source: &Source) -> Result<(), String> {
        let mut at = {
            let mut state = self.state.borrow_mut();
            let mut dump = Dump::of_bytes([]);
            dump.reserve((source.len() as usize).saturating_sub(state.origin));
            state.paper = Paper::Growing(dump);
            state.origin as f64
        };
        let mut turn = Turn::new();
        loop {
            let piece = source.piece(at).await?;
            if !self.wants(job) {
                return Ok(());
            }
            let last = piece.is_empty();
            at += piece.len() as f64;
            let ready = {
                let mut state = self.state.borrow_mut();
                state.read = at;
                if let Paper::Growing(dump) = &mut state.paper {
                    dump.push_bytes(&piece);
                }
                if last {
                    state.paper.end();
                }
                // The bits of a file are one word, which is not there before its end.
                let medium = state.profile.map(|profile| profile.medium());
                last || medium != Some(Medium::Bits)
            };
            if ready && !self.decode(job, &mut turn).await || last {
                return Ok(());
            }
            if !ready {
                self.tell(false);
                turn.over().await;
            }
        }
    }

    /// Decodes what there is; whether the job is still wanted.
    pub(super) async fn decode(&self, job: u32, turn: &mut Turn) -> bool {
        loop {
            let more = {
                let mut state = self.state.borrow_mut();
                let super::State { sheet, paper, .. } = &mut *state;
                match (sheet, paper.dump()) {
                    (Some(sheet), Some(dump)) => {
                        let more = sheet.step(dump, budget(sheet));
                        sheet.arrange(dump, ROWS);
                        more
                    }
                    _ => false,
                }
            };
            self.tell(false);
            turn.over().await;
            if !self.wants(job) {
                return false;
            }
            if !more {
                return true;
            }
        }
    }

    /// Chooses and sorts the rows that are shown.
    pub(super) async fn arrange(&self, job: u32) {
        let mut turn = Turn::new();
        loop {
            let more = {
                let mut state = self.state.borrow_mut();
                let super::State { sheet, paper, .. } = &mut *state;
                match (sheet, paper.dump()) {
                    (Some(sheet), Some(dump)) => sheet.arrange(dump, ROWS),
                    _ => false,
                }
            };
            if !more {
                self.state.borrow_mut().arranged += 1;
                return self.tell(true);
            }
            self.tell(false);
            turn.over().await;
            if !self.wants(job) {
                return;
            }
        }
    }
}

fn budget(sheet: &Sheet) -> usize {
    match sheet.decoder().profile().medium() {
        Medium::Bits => BUDGET_OF_BITS,
        Medium::Bytes | Medium::Text => BUDGET,
    }
}

/// The head of a text as letters.
fn recoder_head(head: &[u8]) -> String {
    let recoded = Recoder::new(head).recode(head.into());
    String::from_utf8_lossy(&recoded).into_owned()
}
