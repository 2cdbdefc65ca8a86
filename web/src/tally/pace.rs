//! How fast things come, over the last seconds.

use encoderscope::session::Micros;
use std::collections::VecDeque;

/// What is counted together.
const SLOT: Micros = 250_000;
/// How many slots are looked at: five seconds.
const SLOTS: usize = 20;

#[derive(Clone, Copy, Debug, Default)]
struct Slot {
    index: u64,
    good: u32,
    bad: u32,
    bytes: usize,
    gap: Micros,
}

/// Counts of the last seconds.
#[derive(Debug, Default)]
pub(super) struct Pace {
    slots: VecDeque<Slot>,
    /// When the last bytes of the present reply came.
    chunk: Option<Micros>,
}

impl Pace {
    fn slot(&mut self, now: Micros) -> &mut Slot {
        let index = now / SLOT;
        if self.slots.back().is_none_or(|last| last.index < index) {
            self.slots.push_back(Slot {
                index,
                ..Slot::default()
            });
        }
        self.forget(now);
        let last = self.slots.len() - 1;
        &mut self.slots[last]
    }

    fn forget(&mut self, now: Micros) {
        let oldest = (now / SLOT).saturating_sub(SLOTS as u64);
        while self.slots.len() > 1 && self.slots.front().is_some_and(|slot| slot.index < oldest) {
            self.slots.pop_front();
        }
    }

    /// A frame has come, or a reply has not.
    pub(super) fn frame(&mut self, now: Micros, good: bool) {
        let slot = self.slot(now);
        match good {
            true => slot.good += 1,
            false => slot.bad += 1,
        }
    }

    /// A request goes out; what comes next is its reply.
    pub(super) const fn request(&mut self) {
        self.chunk = None;
    }

    /// Bytes have come.
    pub(super) fn bytes(&mut self, now: Micros, count: usize) {
        let gap = self.chunk.map_or(0, |last| now.saturating_sub(last));
        self.chunk = Some(now);
        let slot = self.slot(now);
        slot.bytes += count;
        slot.gap = slot.gap.max(gap);
    }

    fn recent(&self, now: Micros) -> impl Iterator<Item = &Slot> {
        let oldest = (now / SLOT).saturating_sub(SLOTS as u64);
        self.slots.iter().filter(move |slot| slot.index >= oldest)
    }

    /// The share of the last replies that were bad or missing.
    pub(super) fn error_rate(&self, now: Micros) -> Option<f64> {
        let (good, bad) = self.recent(now).fold((0, 0), |(good, bad), slot| {
            (good + slot.good, bad + slot.bad)
        });
        (good + bad > 0).then(|| f64::from(bad) / f64::from(good + bad))
    }

    /// Bytes a second, over all whole slots but the first one; `None` before there are a second of
    /// them. What a busy machine delivers late still counts.
    pub(super) fn byte_rate(&self, now: Micros) -> Option<f64> {
        let (first, last) = (self.slots.front()?.index + 1, now / SLOT);
        let whole = self.slots.iter().skip(1).filter(|slot| slot.index < last);
        let bytes: usize = whole.map(|slot| slot.bytes).sum();
        let took = last.saturating_sub(first) * SLOT;
        (took >= 1_000_000).then(|| bytes as f64 * 1e6 / took as f64)
    }

    /// The longest pause within a reply of the last seconds.
    pub(super) fn gap(&self, now: Micros) -> Option<Micros> {
        self.recent(now).map(|slot| slot.gap).max()
    }
}
