//! What the engine keeps of a link: counts, rates, the last reading and the last frames.

use crate::{
    message::{Counts, Entry, Lamp, Outcome, Progress, Setting, Shown, Snapshot},
    plot::Trail,
};
use encoderscope::{
    bits,
    decode::{Decoder, Frame},
    history::Sample,
    reading::degrees,
    sequence::{Event, Holds},
    session::{Echo, Micros, Output},
};
use std::collections::VecDeque;

/// Entries of the log that a snapshot carries.
const LOG: usize = 12;
/// Replies over which latencies are sorted.
const LATENCIES: usize = 512;
/// The rate is taken over this time.
const RATE_OVER: Micros = 1_000_000;

/// A frame or skip as it came; it is explained only when a snapshot is made.
struct Seen {
    at: Micros,
    bytes: Vec<u8>,
    frame: bool,
    sure: bool,
    text: String,
}

/// What is kept of a link.
pub struct Tally {
    decoder: Option<Decoder>,
    opened: Micros,
    changed: bool,
    counts: Counts,
    echo: Echo,
    last_good: Option<Vec<u8>>,
    /// One counter for each named bit of the reply, in the order of the explanation.
    seen_bits: Vec<f64>,
    latencies: VecDeque<Micros>,
    /// Times of good frames within the last second.
    good_times: VecDeque<Micros>,
    log: VecDeque<Seen>,
    /// Parts of a turn within the last second.
    parts: VecDeque<(Micros, f64)>,
    progress: Option<Progress>,
    /// What the plot shows.
    trail: Trail,
}

impl std::fmt::Debug for Tally {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Tally")
            .field("counts", &self.counts)
            .finish_non_exhaustive()
    }
}

impl Tally {
    /// Nothing yet.
    #[must_use]
    pub fn new(now: Micros) -> Self {
        Self {
            decoder: None,
            opened: now,
            changed: true,
            counts: Counts::default(),
            echo: Echo::Unknown,
            last_good: None,
            seen_bits: Vec::new(),
            latencies: VecDeque::new(),
            good_times: VecDeque::new(),
            log: VecDeque::new(),
            parts: VecDeque::new(),
            progress: None,
            trail: Trail::new(now),
        }
    }

    /// What is kept for the plot.
    #[must_use]
    pub const fn trail(&self) -> &Trail {
        &self.trail
    }

    /// The same, to be brought up to date.
    pub const fn trail_mut(&mut self) -> &mut Trail {
        &mut self.trail
    }

    /// A link is open.
    pub fn start(&mut self, decoder: Decoder) {
        self.trail.start(decoder.profile().angle_bits);
        self.decoder = Some(decoder);
        self.changed = true;
    }

    /// Something else than the tally has changed.
    pub const fn touch(&mut self) {
        self.changed = true;
    }

    /// Whether there is anything new since the last snapshot.
    #[must_use]
    pub const fn changed(&self) -> bool {
        self.changed
    }

    /// Bytes have come in.
    pub fn received(&mut self, count: usize) {
        self.counts.bytes += count as f64;
    }

    /// The port reported a break, framing, parity or overrun error.
    pub fn line_error(&mut self) {
        self.counts.line += 1.0;
        self.changed = true;
    }

    /// What is known of echo.
    pub const fn echo(&mut self, echo: Echo) {
        self.echo = echo;
    }

    /// A sequence begins.
    pub fn begin(&mut self, setting: Setting, total: usize) {
        let before = self
            .decoder
            .as_ref()
            .zip(self.last_good.as_ref())
            .and_then(|(decoder, bytes)| shown(&frame_of(decoder, bytes, true)?));
        self.progress = Some(Progress {
            setting,
            done: 0,
            total: total as u32,
            count: None,
            before,
            outcome: None,
        });
        self.changed = true;
    }

    /// A sequence could not begin.
    pub fn refuse(&mut self, setting: Setting, why: &str) {
        self.begin(setting, 0);
        self.end(Some(false), why.into());
    }

    /// Bytes have come in while a sequence runs.
    pub fn received_in_sequence(&mut self, count: usize) {
        self.counts.set += count as f64;
        self.changed = true;
    }

    /// What a sequence says.
    pub fn follow(&mut self, event: &Event) {
        self.changed = true;
        match event {
            Event::Transmit(_) => {}
            Event::Progress { done, count, .. } => {
                if let Some(progress) = &mut self.progress {
                    progress.done = *done as u32;
                    progress.count = count.or(progress.count);
                }
            }
            Event::Ended { stop, holds, .. } => {
                let changed = match holds {
                    Holds::New => Some(true),
                    Holds::Old => Some(false),
                    Holds::Unknown => None,
                };
                let text = match stop {
                    Some(stop) => format!("Stopped: {stop}; {holds}."),
                    None => format!("Done: {holds}."),
                };
                self.end(changed, text);
            }
        }
    }

    fn end(&mut self, changed: Option<bool>, text: String) {
        // What was read before says nothing about the shaft any more.
        self.parts.clear();
        self.trail.jump();
        if let Some(progress) = &mut self.progress {
            progress.outcome = Some(Outcome { changed, text });
        }
        self.changed = true;
    }

    /// The outcome has been read.
    pub fn forget_progress(&mut self) {
        self.progress = None;
        self.changed = true;
    }

    /// How far the shaft has moved within the last second, in turns, once that is known.
    #[must_use]
    pub fn moved(&self, now: Micros) -> Option<f64> {
        let (first, reference) = *self.parts.front()?;
        let (last, _) = *self.parts.back()?;
        let fresh = now.saturating_sub(last) < RATE_OVER / 4;
        if !fresh || last - first < RATE_OVER * 9 / 10 {
            return None;
        }
        let away = self.parts.iter().map(|(_, part)| {
            let apart = part - reference;
            apart - apart.round()
        });
        let (low, high) = away.fold((0.0f64, 0.0f64), |(low, high), apart| {
            (low.min(apart), high.max(apart))
        });
        Some(high - low)
    }

    /// Counts what the session says; returns whether it is a good frame.
    pub fn take(&mut self, now: Micros, output: &Output) -> bool {
        match output {
            Output::Transmit(_) => return false,
            Output::Silent { .. } => {
                self.counts.silent += 1.0;
                self.trail.fail(now);
            }
            Output::Skip { bytes, why } => {
                self.counts.skipped += bytes.len() as f64;
                self.remember(now, bytes, false, true, why.to_string());
            }
            Output::Frame {
                bytes,
                sure,
                latency,
            } => {
                self.counts.framed += bytes.len() as f64;
                self.changed = true;
                return self.take_frame(now, bytes, *sure, *latency);
            }
        }
        self.changed = true;
        false
    }

    fn take_frame(
        &mut self,
        now: Micros,
        bytes: &[u8],
        sure: bool,
        latency: Option<Micros>,
    ) -> bool {
        let frame = self
            .decoder
            .as_ref()
            .and_then(|decoder| frame_of(decoder, bytes, sure));
        let text = match &frame {
            Some(frame) => frame.faults().first().map(|fault| fault.kind.to_string()),
            None => Some("no frame of this format".into()),
        };
        let good = text.is_none();
        if good {
            if let Some(frame) = &frame {
                let named = frame.layout.fields().flat_map(|field| {
                    let raw = frame.layout.read(field, frame.bits);
                    field
                        .row
                        .bits
                        .iter()
                        .map(move |bit| bits::bit(raw, bit.place))
                });
                for (index, set) in named.enumerate() {
                    if index == self.seen_bits.len() {
                        self.seen_bits.push(0.0);
                    }
                    self.seen_bits[index] += f64::from(u8::from(set));
                }
            }
            if let Some(shown) = frame.as_ref().and_then(shown) {
                self.parts.push_back((now, shown.degrees / 360.0));
                let sample = Sample {
                    degrees: shown.degrees,
                    speed: shown.speed,
                    temperature: shown.temperature,
                };
                self.trail.take(now, shown.angle as u64, &sample);
            }
            self.counts.good += 1.0;
            self.last_good = Some(bytes.into());
            self.good_times.push_back(now);
            self.forget(now);
            self.latencies.extend(latency);
            if self.latencies.len() > LATENCIES {
                self.latencies.pop_front();
            }
        } else {
            self.counts.bad += 1.0;
            self.trail.fail(now);
        }
        self.remember(now, bytes, true, sure, text.unwrap_or_default());
        good
    }

    fn remember(&mut self, at: Micros, bytes: &[u8], frame: bool, sure: bool, text: String) {
        self.log.push_front(Seen {
            at,
            bytes: bytes.into(),
            frame,
            sure,
            text,
        });
        self.log.truncate(LOG);
    }

    /// Forgets good frames that the rate no longer counts.
    fn forget(&mut self, now: Micros) {
        while self
            .good_times
            .front()
            .is_some_and(|at| at + RATE_OVER < now)
        {
            self.good_times.pop_front();
        }
        while self
            .parts
            .front()
            .is_some_and(|(at, _)| at + RATE_OVER < now)
        {
            self.parts.pop_front();
        }
    }

    /// What the page shows; the link's state is the caller's.
    pub fn snapshot(&mut self, now: Micros) -> Snapshot {
        self.changed = false;
        self.forget(now);
        let over = (now - self.opened).clamp(1, RATE_OVER) as f64 / 1e6;
        let mut sorted: Vec<Micros> = self.latencies.iter().copied().collect();
        sorted.sort_unstable();
        let latency = |share: usize| {
            let at = (sorted.len() * share / 100).min(sorted.len().saturating_sub(1));
            sorted.get(at).map(|latency| *latency as f64 / 1000.0)
        };
        let mut snapshot = Snapshot {
            counts: self.counts,
            rate: self.good_times.len() as f64 / over,
            latency: latency(50),
            latency_p99: latency(99),
            echo: match self.echo {
                Echo::Unknown => None,
                Echo::Absent => Some(false),
                Echo::Present => Some(true),
            },
            moved: self.moved(now),
            progress: self.progress.clone(),
            ..Snapshot::default()
        };
        if let Some(decoder) = &self.decoder {
            snapshot.log = self
                .log
                .iter()
                .map(|seen| entry(decoder, seen, self.opened))
                .collect();
            if let Some(bytes) = &self.last_good
                && let Some(frame) = frame_of(decoder, bytes, true)
            {
                snapshot.reading = shown(&frame);
                snapshot.lamps = self.lamps(&frame);
            }
        }
        snapshot
    }

    fn lamps(&self, frame: &Frame<'_>) -> Vec<Lamp> {
        let bits = frame.explain().into_iter().flat_map(|note| note.bits);
        bits.zip(&self.seen_bits)
            .map(|(bit, seen)| Lamp {
                name: bit.name.into(),
                doc: bit.doc.into(),
                now: bit.set,
                seen: *seen,
            })
            .collect()
    }
}

fn frame_of<'a>(decoder: &'a Decoder, bytes: &'a [u8], sure: bool) -> Option<Frame<'a>> {
    decoder.frame(bytes).map(|frame| Frame { sure, ..frame })
}

fn shown(frame: &Frame<'_>) -> Option<Shown> {
    let reading = frame.reading()?;
    let values = frame.values();
    let scaled = |value: Option<i32>| value.map(|value| f64::from(value) / 10.0);
    Some(Shown {
        angle: reading.angle as f64,
        angle_bits: reading.angle_bits,
        degrees: degrees(reading.angle, reading.angle_bits),
        turns: reading.turns.map(|turns| turns as f64),
        error: reading.error,
        warning: reading.warning,
        status: reading.status,
        speed: scaled(values.speed),
        temperature: scaled(values.temperature),
    })
}

fn entry(decoder: &Decoder, seen: &Seen, opened: Micros) -> Entry {
    let frame = if seen.frame {
        frame_of(decoder, &seen.bytes, seen.sure)
    } else {
        None
    };
    let class = |index: usize| {
        let field = frame
            .as_ref()
            .and_then(|frame| frame.layout.field_at(index * 8 + 7));
        field.map_or("none", |field| field.row.role.class().name())
    };
    Entry {
        time: seen.at.saturating_sub(opened) as f64 / 1e6,
        bytes: seen
            .bytes
            .iter()
            .enumerate()
            .map(|(index, byte)| (*byte, class(index).into()))
            .collect(),
        ok: frame.as_ref().is_some_and(Frame::ok),
        text: seen.text.clone(),
    }
}
