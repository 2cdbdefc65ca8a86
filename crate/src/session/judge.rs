//! What a reply is worth: whether it is certain, where it stands beside an echo, and what is done
//! where none comes.

use super::{
    AGREE, Echo, LISTEN_EVERY, LISTEN_TIMES, Micros, Output, QUIET, Session, State, TRIES,
};
use crate::framing::Why;

impl Session {
    /// Whether what looks like the reply may be the one that was missing; not where replies name
    /// the request that they answer, and that was another one.
    pub(super) fn may_be_late(&self) -> bool {
        self.late
            .as_ref()
            .is_some_and(|late| !self.decoder.echoes() || *late == self.asked.bytes)
    }

    pub(super) fn holds_at(&self, offset: usize) -> bool {
        let reply = self.received.get(offset..offset + self.asked.reply);
        reply.is_some_and(|bytes| self.asked.is_answered_by(&self.decoder, bytes))
    }

    /// A good reply stands at `offset`, which is right for what is known of echo.
    pub(super) fn accept(&mut self, now: Micros, sent: Micros, offset: usize) {
        self.emit(now, sent, offset, Some(offset));
        self.patience.answered(now - sent);
        self.end_try(true);
        let mut next = self.next_request(now, sent);
        if now > self.listened + LISTEN_EVERY {
            self.listened = now;
            next = next.max(now + LISTEN_TIMES * (now - sent));
        }
        self.state = State::Idle(next);
    }

    /// The line is quiet or the time is up: makes the best of what has come.
    pub(super) fn judge(&mut self, now: Micros, sent: Micros) {
        let have = self.received.len();
        let front = self.asked.bytes.len();
        let echoed = self.received.starts_with(&self.asked.bytes);
        let plain = self.holds_at(0);
        let behind = echoed && self.holds_at(front);
        // Where both hold, the last byte must be explained as well.
        let found = match (plain, behind) {
            (true, true) if have > self.asked.reply => Some(front),
            (true, _) => Some(0),
            (false, true) => Some(front),
            (false, false) => None,
        };
        if let Some(offset) = found {
            let alone = have == self.asked.reply + offset;
            if alone && !self.may_be_late() {
                self.vote(if offset > 0 {
                    Echo::Present
                } else {
                    Echo::Absent
                });
                return self.accept(now, sent, offset);
            }
            self.end_try(false);
            // It may answer an earlier request, or belong to a talk that nobody asked for.
            let quiet = if self.may_be_late() {
                self.patience.time()
            } else {
                QUIET
            };
            self.late = None;
            self.emit(now, sent, offset, None);
            self.state = State::Draining(now + quiet);
            return;
        }
        let only_echo = echoed && have == front;
        self.end_try(false);
        if have == 0 || only_echo {
            let bytes = core::mem::take(&mut self.received);
            self.skip(&bytes, Why::Request);
            self.output.push_back(Output::Silent { echo: only_echo });
            self.late = Some(self.asked.bytes.clone());
            // Among several, one that is away must not hold up the others.
            if self.polls.len() < 2 {
                self.patience.grow();
            }
        } else if have < self.asked.reply {
            let bytes = core::mem::take(&mut self.received);
            self.skip(
                &bytes,
                Why::Truncated {
                    have,
                    need: self.asked.reply,
                },
            );
        } else {
            let last = have - self.asked.reply;
            let echo = if self.echo == Echo::Present { front } else { 0 };
            let exact = echo.min(last);
            let late = (last > front && self.holds_at(last)).then_some(last);
            self.emit(now, sent, late.unwrap_or(exact), None);
        }
        self.state = State::Draining(now + QUIET);
    }

    /// What is asked once is done with when its reply is certain, or when it was asked often enough.
    fn end_try(&mut self, certain: bool) {
        if self.tries >= TRIES || certain && self.tries > 0 {
            self.once.pop_front();
            self.tries = 0;
        }
    }

    fn vote(&mut self, echo: Echo) {
        if self.echo == echo {
            return;
        }
        let agrees = match self.votes {
            0 => true,
            votes => (votes > AGREE) == (echo == Echo::Present),
        };
        // Votes count from 1 for absent and from AGREE + 1 for present.
        let base = if echo == Echo::Present { AGREE + 1 } else { 1 };
        self.votes = if agrees && self.votes > 0 {
            self.votes + 1
        } else {
            base
        };
        self.echo = Echo::Unknown;
        if self.votes >= base + AGREE - 1 {
            self.echo = echo;
            self.votes = 0;
        }
    }

    /// Reports the reply at `offset` and the bytes around it.
    fn emit(&mut self, now: Micros, sent: Micros, offset: usize, good: Option<usize>) {
        let bytes = core::mem::take(&mut self.received);
        let (before, rest) = bytes.split_at(offset);
        let (reply, after) = rest.split_at(self.asked.reply);
        let why = if before == self.asked.bytes {
            Why::Request
        } else {
            Why::NoFrame
        };
        self.skip(before, why);
        self.output.push_back(Output::Frame {
            bytes: reply.into(),
            sure: good.is_some(),
            latency: Some(now - sent),
        });
        self.skip(after, Why::NoFrame);
    }

    pub(super) fn skip(&mut self, bytes: &[u8], why: Why) {
        if !bytes.is_empty() {
            self.output.push_back(Output::Skip {
                bytes: bytes.into(),
                why,
            });
        }
    }
}
