//! Plays a recording: which of its moments are due, and what they do.

use super::PIECE;
use crate::{
    browser,
    engine::{
        run::{Run, Wire},
        unfit,
    },
    link,
    message::{Counts, Link, Replay},
    tally::Tally,
};
use encoderscope::{
    decode::Decoder,
    recording::{Event, Line, Moment, Reader, Unreadable},
    session::{Micros, Session},
};
use web_sys::Blob;

/// The notes of a recording that are shown: the newest.
const NOTES: usize = 100;

/// A recording that is played.
pub(in crate::engine) struct Player {
    name: String,
    file: Blob,
    reader: Reader,
    /// How much of the file has been asked for.
    asked: f64,
    /// A piece of the file is on its way.
    waits: bool,
    /// The section that is shown has been looked at.
    reported: bool,
    next: Option<Moment>,
    /// The recording's time, and when it was that, by the engine's clock.
    time: Micros,
    since: Micros,
    speed: f64,
    ended: bool,
    /// The profile where the recording has none.
    fallback: String,
    line: Option<Line>,
    /// The time of the first moment.
    began: Option<Micros>,
    /// What the lines before came to.
    before: Counts,
    notes: Vec<(f64, String)>,
    fault: Option<Unreadable>,
}

/// What a recording is played to.
pub(in crate::engine) struct Stage<'a> {
    pub(in crate::engine) run: &'a mut Option<Run>,
    pub(in crate::engine) tally: &'a mut Tally,
    pub(in crate::engine) link: &'a mut Link,
}

impl Player {
    pub(in crate::engine) fn new(name: String, file: Blob, fallback: String) -> Self {
        Self {
            name,
            file,
            reader: Reader::new(),
            asked: 0.0,
            waits: false,
            reported: false,
            next: None,
            time: 0,
            since: browser::now(),
            speed: 1.0,
            ended: false,
            fallback,
            line: None,
            began: None,
            before: Counts::default(),
            notes: Vec::new(),
            fault: None,
        }
    }

    pub(super) const fn time(&self) -> Micros {
        self.time
    }

    /// For how long it has played, in microseconds.
    pub(super) fn length(&self) -> Micros {
        self.time.saturating_sub(self.began.unwrap_or(self.time))
    }

    pub(super) fn set_speed(&mut self, speed: f64, now: Micros) {
        // At once is no further than what comes next.
        let next = self.next.as_ref().map_or(self.time, |next| next.at);
        self.time = self.target(now).min(next).max(self.time);
        self.since = now;
        self.speed = if speed > 0.0 { speed } else { 0.0 };
    }

    /// Goes on at a part of the file, at the speed that it had.
    pub(super) fn seek(&mut self, part: f64, now: Micros) {
        let size = self.file.size();
        self.asked = (part.clamp(0.0, 1.0) * size).floor();
        self.reader = match self.asked > 0.0 {
            true => Reader::joining(),
            false => Reader::new(),
        };
        self.waits = false;
        self.next = None;
        self.time = 0;
        self.since = now;
        self.ended = false;
        self.line = None;
        self.before = Counts::default();
        self.notes.clear();
    }

    /// Whether more of the file is wanted.
    pub(super) fn is_hungry(&self) -> bool {
        !self.waits
            && self.fault.is_none()
            && self.left() > 0.0
            && self.reader.rest() < PIECE as usize
    }

    fn left(&self) -> f64 {
        self.file.size() - self.asked
    }

    /// The next piece of the file, which is then on its way.
    pub(super) fn next_piece(&mut self) -> Option<Blob> {
        if !self.is_hungry() {
            return None;
        }
        let end = (self.asked + PIECE).min(self.file.size());
        let piece = self.file.slice_with_f64_and_f64(self.asked, end).ok()?;
        self.asked = end;
        self.waits = true;
        Some(piece)
    }

    /// A piece has come; an empty one is the last.
    pub(super) fn push(&mut self, bytes: &[u8]) {
        self.waits = false;
        if bytes.is_empty() {
            self.asked = self.file.size();
        }
        self.reader.push(bytes);
    }

    /// What stands in front of a support file, once.
    pub(super) fn report(&mut self) -> Option<String> {
        if self.reported {
            return None;
        }
        self.reported = true;
        self.look();
        let front = self.reader.front().unwrap_or_default();
        (!front.is_empty()).then(|| front.to_owned())
    }

    /// Why the file cannot be read, once.
    pub(super) fn fault(&mut self) -> Option<Unreadable> {
        self.fault
            .filter(|_| !std::mem::replace(&mut self.ended, true))
    }

    /// What the lines of the recording come to, with the present one.
    pub(super) fn counts(&self, tally: &Tally) -> Counts {
        self.before + tally.counts()
    }

    pub(super) const fn line(&self) -> Option<&Line> {
        self.line.as_ref()
    }

    pub(super) const fn is_over(&self) -> bool {
        self.ended
    }

    pub(super) fn shown(&self) -> Replay {
        let line = self.line.as_ref();
        let read = self.asked - self.reader.rest() as f64;
        Replay {
            name: self.name.clone(),
            profile: self.profile().unwrap_or_default().to_owned(),
            adapter: line.map(|line| line.adapter.clone()).unwrap_or_default(),
            time: self.time as f64 / 1e3,
            part: (read / self.file.size().max(1.0)).clamp(0.0, 1.0),
            speed: self.speed,
            ended: self.ended,
            lost: self.lost(),
            notes: self.notes.clone(),
        }
    }

    fn lost(&self) -> f64 {
        let cut = if self.left() > 0.0 {
            0
        } else {
            self.reader.rest()
        };
        let lost = self.reader.lost() as f64;
        // While moments wait, what the reader holds is not lost.
        if self.ended { lost + cut as f64 } else { lost }
    }

    /// The profile that the line is read with; none while an encoder was searched for.
    fn profile(&self) -> Option<&str> {
        let line = self.line.as_ref()?;
        let own = self
            .reader
            .section()
            .application
            .starts_with("Encoderscope");
        match line.profile.is_empty() {
            true if own => None,
            true => Some(&self.fallback),
            false => Some(&line.profile),
        }
    }

    /// The recording's time now, if nothing holds it up.
    fn target(&self, now: Micros) -> Micros {
        let passed = now.saturating_sub(self.since) as f64 * self.speed;
        // As fast as possible is further than any recording.
        self.time.saturating_add(passed as Micros)
    }

    /// Makes sure that the next moment is there, if it has come.
    fn look(&mut self) {
        if self.next.is_none() && self.fault.is_none() {
            match self.reader.next() {
                Ok(moment) => self.next = moment,
                Err(fault) => self.fault = Some(fault),
            }
        }
    }

    /// Plays what is due, for so long at most; returns when to go on, where time decides that.
    pub(super) fn play(
        &mut self,
        stage: &mut Stage<'_>,
        now: Micros,
        turn: Micros,
    ) -> Option<Micros> {
        if self.ended || self.speed == 0.0 {
            self.since = now;
            return None;
        }
        let end = now + turn;
        let target = self.target(now);
        loop {
            self.look();
            let Some(moment) = &self.next else {
                break;
            };
            let at = moment.at.max(self.time);
            // Nobody waits while no line is open.
            if at > target && self.line.is_some() {
                break;
            }
            if browser::now() > end {
                self.since = browser::now();
                return Some(self.since);
            }
            stage.pass(self.time, at);
            self.time = at;
            self.began.get_or_insert(at);
            if let Some(moment) = self.next.take() {
                self.perform(at, moment.event, stage);
            }
        }
        self.since = browser::now();
        let Some(next) = &self.next else {
            if self.left() <= 0.0 && !self.waits && self.fault.is_none() {
                self.ended = true;
                stage.rest(self.time);
            }
            return None;
        };
        let next = next.at;
        stage.pass(self.time, target);
        self.time = self.time.max(target);
        let due = stage.deadline().min(next).saturating_sub(self.time);
        Some(now + (due as f64 / self.speed) as Micros)
    }

    fn perform(&mut self, at: Micros, event: Event, stage: &mut Stage<'_>) {
        match event {
            Event::Opened(line) => self.open(at, line, stage),
            Event::Received { bytes, beside } => stage.received(at, &bytes, beside),
            Event::Sent { bytes, purpose } => match (purpose, &mut *stage.run) {
                (Some(purpose), _) => {
                    stage.rest(at);
                    stage.tally.sent(at, &bytes, purpose);
                }
                (None, Some(run)) => run.hear(at, &bytes, stage.tally),
                (None, None) => {}
            },
            Event::Failed(error) => stage.tally.line_error(at, error),
            Event::Marked(note) => {
                stage.tally.happened(at, note.clone());
                if self.notes.len() == NOTES {
                    self.notes.remove(0);
                }
                self.notes.push((at as f64 / 1e3, note));
            }
            Event::Closed(why) => {
                stage.rest(at);
                self.line = None;
                *stage.link = match why.as_str() {
                    "lost" => Link::Lost,
                    _ => Link::Closed,
                };
                stage.tally.touch();
            }
            Event::Ended(_) => {}
        }
    }

    fn open(&mut self, at: Micros, line: Line, stage: &mut Stage<'_>) {
        if self.line.is_none() {
            self.before = self.counts(stage.tally);
            stage.tally.renew(at, &line.adapter);
        }
        self.line = Some(line);
        let made = self.profile().map(|profile| {
            let made = link::profile(profile).and_then(Decoder::new).ok();
            let session = made.and_then(|decoder| Session::following(decoder).ok());
            session.ok_or_else(|| unfit(profile))
        });
        stage.rest(at);
        (*stage.run, *stage.link) = match made {
            None => (None, Link::Searching),
            Some(Err(link)) => (None, link),
            Some(Ok(session)) => {
                stage.tally.start(at, session.decoder().clone());
                let run = Run::reading(Wire::Replay, session, 0, at);
                (Some(run), Link::Waiting)
            }
        };
    }
}

impl Stage<'_> {
    /// Lets time pass on the line.
    fn pass(&mut self, from: Micros, to: Micros) {
        if let Some(run) = self.run
            && let Some(link) = run.pass(from, to, self.tally)
        {
            *self.link = link;
            self.tally.touch();
        }
    }

    fn deadline(&self) -> Micros {
        let session = self.run.as_ref().and_then(|run| run.session.as_ref());
        session.map_or(Micros::MAX, Session::deadline)
    }

    /// Lets the session rest: what comes now is not for it.
    fn rest(&mut self, at: Micros) {
        if let Some(run) = self.run {
            run.rest(at, self.tally);
        }
    }

    fn received(&mut self, at: Micros, bytes: &[u8], beside: bool) {
        match self.run {
            Some(run) if !beside => run.read(at, bytes, self.tally),
            _ => {
                self.tally.received(at, bytes, true);
                self.tally.answered(at, bytes);
            }
        }
    }
}
