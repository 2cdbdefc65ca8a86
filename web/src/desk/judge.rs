//! What the input may be.

use super::{Desk, Paper, reading::Turn, source::Recoder};
use crate::{
    link,
    message::{CandidateView, FromDesk, NearView},
};
use encoderscope::{
    detect::{Candidate, Change, Detection, Near, near},
    dump::{self, Dump},
    profile::Profile,
    sheet::Sheet,
};

/// Bytes of text that are judged.
const JUDGED: usize = 128 << 10;
/// Bytes of text in which something is looked for that fits better than the profile.
const NEARBY: usize = 16 << 10;
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
    /// Says what the input may be, and what nearly fits.
    pub(super) async fn judge(&self, job: u32) {
        self.rank(job).await;
        if self.wants(job) {
            self.look_beside(job).await;
        }
    }

    /// Ranks what the input may be; once, since that does not depend on the profile.
    async fn rank(&self, job: u32) {
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

    /// Says what fits better than the profile, where frames of it fail and little is different.
    async fn look_beside(&self, job: u32) {
        let fails = |sheet: &Sheet| {
            let summary = sheet.figures().summary;
            summary.bad > 0 || summary.skipped > 0
        };
        let profile = {
            let state = self.state.borrow();
            let failed = state.sheet.as_ref().is_some_and(fails);
            state
                .profile
                .filter(|_| failed && state.judge.change.is_none())
        };
        let mut found = Vec::new();
        if let Some(profile) = profile
            && let Some(dump) = self.front(&profile).await
        {
            found = near(&profile, &dump).iter().map(near_view).collect();
        }
        if self.wants(job) {
            self.post(FromDesk::Near(found));
        }
    }

    /// The front of what is decoded.
    async fn front(&self, profile: &Profile) -> Option<Dump> {
        let (source, origin) = {
            let state = self.state.borrow();
            if let (Paper::Whole(dump), true) = (&state.paper, state.captured.is_some()) {
                return Some(dump.clone());
            }
            if let (Paper::Whole(dump), true) = (&state.paper, state.binary) {
                let front = dump.bytes().get(..NEARBY).unwrap_or(dump.bytes());
                return Some(Dump::of_bytes(front));
            }
            (state.source.clone()?, state.origin)
        };
        let bytes = source.read(origin as f64, NEARBY).await.ok()?;
        let bytes = Recoder::new(&bytes).recode(bytes);
        Some(dump::parse(
            &String::from_utf8_lossy(&bytes),
            profile.medium(),
        ))
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
            state.blank();
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

fn near_view(near: &Near) -> NearView {
    NearView {
        text: near.text.clone(),
        profile: link::query(&near.profile),
        change: near.change.map(Change::code),
    }
}
