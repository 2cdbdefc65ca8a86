//! What happened of late: how the link was, which status bits came and went, what was set.

use super::{Tally, frame_of};
use crate::message::BIT_CHANGES;
use encoderscope::{bits, session::Micros};
use std::collections::VecDeque;

/// Happenings that are kept.
const KEPT: usize = 200;
/// Status bits are looked at so often: more often nobody wants to know.
const REVIEW: Micros = 200_000;

/// What happened of late.
#[derive(Debug, Default)]
pub(super) struct Story {
    happenings: VecDeque<(Micros, String)>,
    /// The status bits when they were looked at last: set, and in how many frames.
    bits: Vec<(bool, f64)>,
    next_review: Micros,
}

impl Story {
    fn push(&mut self, now: Micros, text: String) {
        if self.happenings.len() == KEPT {
            self.happenings.pop_front();
        }
        self.happenings.push_back((now, text));
    }
}

impl Tally {
    /// Something happened; said in English.
    pub fn happened(&mut self, now: Micros, text: String) {
        self.story.push(self.transcript.absolute(now), text);
    }

    /// Something happened that the transcript should tell, too; said in English.
    pub fn note(&mut self, now: Micros, text: &str) {
        self.transcript.mark(now, text);
        self.happened(now, text.into());
    }

    /// What happened of late, oldest first, with the time in microseconds since 1970.
    pub fn happenings(&self) -> impl Iterator<Item = (Micros, &str)> {
        let happenings = self.story.happenings.iter();
        happenings.map(|(at, text)| (*at, text.as_str()))
    }

    /// Looks which status bits came and went.
    pub fn review(&mut self, now: Micros) {
        if now < self.story.next_review {
            return;
        }
        self.story.next_review = now + REVIEW;
        let Some((decoder, last)) = self.decoder.as_ref().zip(self.last_good.as_ref()) else {
            return self.story.bits.clear();
        };
        let Some(frame) = frame_of(decoder, last, true) else {
            return;
        };
        let named = frame.layout.fields().flat_map(|field| {
            let raw = frame.layout.read(field, frame.bits);
            let bits = field.row.bits.iter();
            bits.map(move |bit| (bit.name, bits::bit(raw, bit.place)))
        });
        let [on, off, moment] = BIT_CHANGES;
        let is = named.zip(&self.seen_bits);
        for (index, ((name, set), seen)) in is.enumerate() {
            let before = self.story.bits.get(index).copied();
            let (was, had) = before.unwrap_or((false, 0.0));
            let what = match (was, set) {
                (false, true) => on,
                (true, false) => off,
                (false, false) if *seen > had => moment,
                _ => "",
            };
            if !what.is_empty() {
                let at = self.transcript.absolute(now);
                self.story.push(at, format!("{name}: {what}"));
            }
            match before {
                Some(_) => self.story.bits[index] = (set, *seen),
                None => self.story.bits.push((set, *seen)),
            }
        }
    }
}
