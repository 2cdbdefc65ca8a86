//! What the input may be.

use super::{Desk, source::Recoder};
use crate::{
    link,
    message::{CandidateView, FromDesk},
};
use encoderscope::detect::{Candidate, detect};

/// Bytes of the input that are judged.
const JUDGED: usize = 256 << 10;
/// Candidates that the page gets.
const BEST: usize = 6;

/// What the input may be, as far as that is known.
#[derive(Debug, Default)]
pub(super) struct Judge {
    found: Option<Vec<Candidate>>,
}

impl Desk {
    /// Ranks what the input may be; once, since that does not depend on the profile.
    pub(super) async fn judge(&self, job: u32) {
        let (source, origin) = {
            let state = self.state.borrow();
            if state.judge.found.is_some() {
                return;
            }
            (state.source.clone(), state.origin)
        };
        let Some(source) = source else {
            return;
        };
        let Ok(bytes) = source.read(origin as f64, JUDGED).await else {
            return;
        };
        if !self.wants(job) {
            return;
        }
        let bytes = Recoder::new(&bytes).recode(bytes);
        let found = detect(&String::from_utf8_lossy(&bytes));
        let best = found.iter().take(BEST).map(view).collect();
        self.state.borrow_mut().judge.found = Some(found);
        let done = true;
        self.post(FromDesk::Candidates { found: best, done });
    }

    /// Changes the input as a candidate says.
    pub(super) fn change_input(&self, index: usize) {
        let _ = index;
    }
}

fn view(candidate: &Candidate) -> CandidateView {
    CandidateView {
        profile: link::query(&candidate.profile),
        verdict: candidate.verdict.name().into(),
        evidence: candidate.evidence.clone(),
        change: None,
    }
}
