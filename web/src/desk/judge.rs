//! What the input may be.

use super::{Desk, Paper, reading::Turn, source::Recoder};
use crate::{
    link,
    message::{CandidateView, FromDesk},
};
use encoderscope::{
    decode::Decoder,
    detect::{Candidate, Change, Detection},
    sheet::Sheet,
};

/// Bytes of text that are judged.
const JUDGED: usize = 128 << 10;
/// Candidates that the page gets.
const BEST: usize = 6;

/// What the input may be, as far as that is known.
#[derive(Debug, Default)]
pub(super) struct Judge {
    /// Nothing before everything has been tried.
    found: Option<Vec<Candidate>>,
    /// What is done to the input before it is decoded.
    pub(super) change: Option<Change>,
}

impl Judge {
    /// What was found is not true of what is read now.
    pub(super) fn forget(&mut self) {
        self.found = None;
    }
}

impl Desk {
    /// Ranks what the input may be; once, since that does not depend on the profile.
    pub(super) async fn judge(&self, job: u32) {
        if self.state.borrow().judge.found.is_some() {
            return;
        }
        let Some(mut detection) = self.detection().await else {
            return;
        };
        let mut turn = Turn::new();
        loop {
            if !self.wants(job) {
                return;
            }
            if !detection.step() {
                break;
            }
            turn.over().await;
        }
        let found = detection.candidates();
        let best = found.iter().take(BEST).map(view).collect();
        self.state.borrow_mut().judge.found = Some(found);
        let done = true;
        self.post(FromDesk::Candidates { found: best, done });
    }

    /// A detection on the text, or on what was read where that was no text.
    async fn detection(&self) -> Option<Detection> {
        let (source, origin) = {
            let state = self.state.borrow();
            if state.captured.is_some() {
                let sample = &state.captured.sample;
                return Some(Detection::new(sample, sample, sample));
            }
            if let (Paper::Whole(dump), true) = (&state.paper, state.binary) {
                return Some(Detection::new(dump, dump, dump));
            }
            (state.source.clone()?, state.origin)
        };
        let bytes = source.read(origin as f64, JUDGED).await.ok()?;
        let bytes = Recoder::new(&bytes).recode(bytes);
        Some(Detection::of_text(&String::from_utf8_lossy(&bytes)))
    }

    /// Undoes a mistake of the capture, or none, and decodes with a profile.
    pub(super) fn change_input(&self, change: &str, profile: &str) {
        {
            let mut state = self.state.borrow_mut();
            state.profile = link::profile(profile).ok();
            state.judge.change = Change::parse(change);
        }
        self.begin();
    }

    /// Undoes a mistake of the capture, where a candidate said so, and decodes from the start.
    pub(super) fn undo_mistake(&self) {
        let mut state = self.state.borrow_mut();
        let Some(change) = state.judge.change else {
            return;
        };
        if let Paper::Whole(dump) = &state.paper {
            state.paper = Paper::Whole(change.apply(dump));
            state.captured.sample = change.apply(&state.captured.sample);
            state.captured.notes.push(change.sentence());
            let profile = state.profile;
            state.sheet = profile
                .and_then(|profile| Decoder::new(profile).ok())
                .map(Sheet::new);
            let (filter, order) = state.shown;
            if let Some(sheet) = &mut state.sheet {
                sheet.show(filter, order);
            }
        }
    }
}

fn view(candidate: &Candidate) -> CandidateView {
    CandidateView {
        profile: link::query(&candidate.profile),
        verdict: candidate.verdict.name().into(),
        evidence: candidate.evidence.clone(),
        change: candidate.change.map(Change::code),
    }
}
