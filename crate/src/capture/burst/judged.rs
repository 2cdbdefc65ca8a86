//! A burst with its bits, judged by its neighbours.

use super::{TOLERANCE, part};
use crate::{
    capture::{Clocked, Rules, Violation, ViolationKind},
    format::timing::Words,
};

/// How a burst stands to a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    Whole,
    Short,
    Remainder,
    Cut,
}

/// A burst with its bits, and what is needed to judge it by its neighbours.
#[derive(Clone, Debug)]
pub(in super::super) struct Judged {
    pub(in super::super) frame: Clocked,
    /// Its first and last edge.
    pub(in super::super) start: i64,
    pub(in super::super) end: i64,
    /// Its first falling edge.
    pub(in super::super) first: Option<i64>,
    pub(in super::super) half: i64,
    pub(in super::super) acknowledge: Option<u32>,
    /// Level of the data line before its first falling edge.
    pub(in super::super) idle: bool,
    /// Whether the clock was low before.
    pub(super) began_low: bool,
    pub(super) needed: u32,
    pub(super) word: u32,
    pub(super) state: State,
}

impl Judged {
    fn found(&mut self, rules: &Rules, time: i64, clock: Option<u32>, kind: ViolationKind) {
        self.frame.violations.push(Violation {
            time,
            clock,
            kind,
            timing: rules.timing,
        });
    }

    /// Whether `next` is the rest of this reading.
    pub(in super::super) fn is_aborted_by(&self, next: &Self) -> bool {
        let low = next.began_low && !self.began_low;
        let sum = self.frame.clocks + next.frame.clocks;
        self.state == State::Short && (low || sum == self.needed)
    }

    /// Says that this is the rest of an aborted reading.
    pub(in super::super) fn remain(&mut self) {
        self.state = State::Remainder;
        // What is cut short has no acknowledge to speak of.
        let acknowledges = |kind| matches!(kind, ViolationKind::Acknowledge { .. });
        self.frame
            .violations
            .retain(|violation| !acknowledges(violation.kind));
        self.acknowledge = None;
    }

    /// Says that the recording does not hold the whole of it, where it is short.
    pub(in super::super) fn cut(&mut self) {
        if self.state == State::Short {
            self.state = State::Cut;
        }
    }

    /// Judges the pause before it.
    pub(in super::super) fn paused(&mut self, rules: &Rules, pause: i64) {
        let time = self.start;
        if self.began_low {
            self.found(rules, time, None, ViolationKind::IdleLow);
        } else if rules.is_timed()
            && pause.saturating_add(rules.resolution()) < part(rules.timing.pause, 100 - TOLERANCE)
        {
            self.found(
                rules,
                time,
                Some(1),
                ViolationKind::Pause { measured: pause },
            );
        }
    }

    /// Judges what there is of the recording before its first burst.
    pub(in super::super) fn opened(&mut self, rules: &Rules, begin: i64) {
        if !rules.is_silent(self.start.saturating_sub(begin), self.half) {
            self.cut();
        } else if self.began_low {
            let time = self.start;
            self.found(rules, time, None, ViolationKind::IdleLow);
        }
    }

    /// The frame, once all is known; `aborted` is the rest of the clock that ended it early.
    pub(in super::super) fn concluded(mut self, rules: &Rules, aborted: Option<i64>) -> Clocked {
        let falling = self.frame.clocks;
        let (needed, word) = (self.needed, self.word);
        let whole = match rules.timing.words {
            _ if rules.is_biss() => true,
            Words::Once => falling == needed,
            // Each time the word comes, a 0 comes with it; behind the last it may be missing.
            Words::Ring => falling == needed || falling >= 2 * needed && falling % needed < 2,
        };
        let clocks = ViolationKind::Clocks {
            falling,
            word,
            needed,
        };
        let (start, end) = (self.start, self.end);
        match (self.state, aborted) {
            (State::Remainder, _) => self.found(rules, start, Some(1), ViolationKind::Remainder),
            (State::Cut, _) => self.found(rules, start, None, ViolationKind::Cut),
            (_, Some(half)) => {
                self.found(rules, end, Some(falling), ViolationKind::Aborted { half });
            }
            (State::Short, None) => self.found(rules, end, Some(falling), clocks),
            (State::Whole, None) if !whole => self.found(rules, end, Some(falling), clocks),
            (State::Whole, None) => {}
        }
        self.frame
            .violations
            .sort_by_key(|violation| violation.time);
        self.frame
    }
}
