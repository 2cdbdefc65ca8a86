//! What the engine keeps of a link: counts, rates, the last reading and the last frames.

mod asides;
mod log;
mod memory;
mod pace;
mod settings;
mod shaft;
mod story;
mod take;

use crate::{
    link::query,
    message::{Cell, Counts, Lamp, LogFilter, Progress, Search, Shown, Snapshot},
    plot::Trail,
    transcript::Transcript,
};
pub(crate) use asides::RESTLESS;
use asides::{Kept, Scan};
use encoderscope::{
    decode::{Decoder, Frame},
    reading::degrees,
    recording::{Line, LineError},
    session::{Echo, Micros},
};
use log::{Kind, Log, Seen};
use pace::Pace;
use settings::Words;
use shaft::{FEWEST, Place};
use std::collections::VecDeque;
use story::Story;

/// The rate is taken over this time.
const RATE_OVER: Micros = 1_000_000;

/// What the page does not know yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum News {
    /// It knows everything.
    Nothing,
    /// Frames have gone by, or have not come.
    Frames,
    /// Something else, too.
    More,
}

/// What is kept of a link.
pub struct Tally {
    decoder: Option<Decoder>,
    opened: Micros,
    news: News,
    /// There is a good frame that the page has not been told of.
    fresh: bool,
    counts: Counts,
    echo: Echo,
    last_good: Option<Vec<u8>>,
    /// One counter for each named bit of the reply, in the order of the explanation.
    seen_bits: Vec<f64>,
    latencies: VecDeque<Micros>,
    /// Times of good frames within the last second.
    good_times: VecDeque<Micros>,
    log: Log,
    /// Where the shaft was within the last second.
    places: VecDeque<Place>,
    pace: Pace,
    progress: Option<Progress>,
    /// How it ended.
    ending: Option<Words>,
    devices: Vec<Kept>,
    scan: Option<Scan>,
    search: Option<Search>,
    memory: Option<Cell>,
    /// What the plot shows.
    trail: Trail,
    transcript: Transcript,
    story: Story,
    /// What the line is read through.
    adapter: String,
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
    pub fn new(now: Micros, transcript: Transcript) -> Self {
        Self {
            decoder: None,
            opened: now,
            news: News::More,
            fresh: false,
            counts: Counts::default(),
            echo: Echo::Unknown,
            last_good: None,
            seen_bits: Vec::new(),
            latencies: VecDeque::new(),
            good_times: VecDeque::new(),
            log: Log::default(),
            places: VecDeque::new(),
            pace: Pace::default(),
            progress: None,
            ending: None,
            devices: Vec::new(),
            scan: None,
            search: None,
            memory: None,
            trail: Trail::new(now),
            transcript,
            story: Story::default(),
            adapter: String::new(),
        }
    }

    /// Forgets one link for another, which is read through an adapter; how the last setting
    /// ended stays until it has been read, the log is shown as before, and what happened is not forgotten.
    pub fn renew(&mut self, now: Micros, adapter: &str) {
        let next = Self::new(now, Transcript::default());
        let before = std::mem::replace(self, next);
        self.progress = before.progress;
        self.ending = before.ending;
        self.log.filter = before.log.filter;
        self.transcript = before.transcript;
        self.story = before.story;
        self.adapter = adapter.into();
    }

    /// Counts since the link was opened.
    #[must_use]
    pub const fn counts(&self) -> Counts {
        self.counts
    }

    /// What was said on the line.
    pub const fn transcript(&mut self) -> &mut Transcript {
        &mut self.transcript
    }

    /// A line is open at a baud rate, and an encoder is searched for.
    pub fn listen(&mut self, now: Micros, baud: u32) {
        self.open(now, String::new(), baud);
    }

    fn open(&mut self, now: Micros, profile: String, baud: u32) {
        let line = Line {
            profile,
            adapter: self.adapter.clone(),
            baud,
        };
        self.transcript.open(now, line);
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

    /// A link is open, or goes on with another device.
    pub fn start(&mut self, now: Micros, decoder: Decoder) {
        let profile = decoder.profile();
        self.trail.start(profile.angle_bits);
        self.open(now, query(profile), profile.baud);
        self.decoder = Some(decoder);
        self.last_good = None;
        self.seen_bits.clear();
        self.places.clear();
        self.touch();
    }

    /// Shows other entries of the log.
    pub const fn filter(&mut self, filter: LogFilter) {
        self.log.filter = filter;
        self.touch();
    }

    /// Something else than the tally has changed.
    pub const fn touch(&mut self) {
        self.news = News::More;
    }

    /// What is new since the last snapshot.
    #[must_use]
    pub const fn news(&self) -> News {
        self.news
    }

    /// The last good reading, if nobody has asked for it yet.
    pub fn reading(&mut self) -> Option<Shown> {
        if !std::mem::take(&mut self.fresh) {
            return None;
        }
        let frame = frame_of(self.decoder.as_ref()?, self.last_good.as_ref()?, true)?;
        shown(&frame)
    }

    /// Bytes have come in, for reading or for something beside it.
    pub fn received(&mut self, now: Micros, bytes: &[u8], beside: bool) {
        self.transcript.received(now, bytes, beside);
        self.counts.bytes += bytes.len() as f64;
        self.pace.bytes(now, bytes.len());
        if beside {
            self.counts.set += bytes.len() as f64;
            self.pass();
        }
    }

    /// The port reported a break, framing, parity or overrun error.
    pub fn line_error(&mut self, now: Micros, error: LineError) {
        self.transcript.failed(now, error);
        self.counts.line += 1.0;
        self.pass();
    }

    /// What is known of echo.
    pub const fn echo(&mut self, echo: Echo) {
        self.echo = echo;
    }

    /// Frames have gone by.
    fn pass(&mut self) {
        self.news = self.news.max(News::Frames);
    }

    fn remember(&mut self, at: Micros, bytes: &[u8], kind: Kind) {
        self.pass();
        self.log.push(Seen {
            at,
            bytes: bytes.into(),
            kind,
        });
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
        // A pause does not take away all that is known: what is left reaches back a second.
        let old = |place: &Place| place.at + RATE_OVER < now;
        while self.places.len() > FEWEST && self.places.get(1).is_some_and(old) {
            self.places.pop_front();
        }
    }

    /// What the page shows; the link's state is the caller's.
    pub fn snapshot(&mut self, now: Micros) -> Snapshot {
        self.news = News::Nothing;
        self.fresh = false;
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
            progress: self.progress(),
            turning: self.trail.turning(),
            error_rate: self.pace.error_rate(now),
            byte_rate: self.pace.byte_rate(now),
            gap: self.pace.gap(now).map(|gap| gap as f64 / 1000.0),
            devices: self
                .devices
                .iter()
                .map(|device| device.shown(now))
                .collect(),
            watched: self.watched(),
            scan: self.scan.as_ref().map(Scan::says),
            search: self.search.clone(),
            memory: self.memory,
            ..Snapshot::default()
        };
        if let Some(decoder) = &self.decoder {
            snapshot.log = self.log.entries(decoder, self.opened);
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
        zero_default: values.zero_default,
    })
}
