//! Reading recordings of clock and data in pieces, and framing what has changed in them.

use super::{
    Desk, Paper,
    captured::{Captured, acknowledge, word},
    reading::Turn,
    source::Source,
};
use crate::{link, message::FromDesk};
use encoderscope::{
    capture::{Changes, Extraction, Kind, Options, Reader, Recording, Unreadable},
    decode::Decoder,
    detect::Detection,
    dump::Dump,
    format::{Format, Link},
    language::number,
    profile::Profile,
    sheet::Sheet,
    text,
};
use std::rc::Rc;

/// Bytes of text that are read in one go.
const PART: usize = 128 << 10;
/// Changes that are framed in one go.
const CHANGES: usize = 20_000;
/// Frames that are looked at in one go.
const FRAMES: usize = 5_000;
/// Frames that say whether checks hold.
const ENOUGH: usize = 64;

/// What is kept of a recording of clock and data.
#[derive(Debug, Default)]
pub(super) enum Tape {
    #[default]
    None,
    /// It is still being read.
    Coming(Box<Reader>),
    /// All that changes in it, or up to where reading was stopped.
    Whole(Rc<Changes>),
}

/// Whether frames are being taken from a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Framing {
    #[default]
    Idle,
    Running,
    /// Those that there are will do.
    Stopping,
}

impl Desk {
    /// Reads a recording up to its end, from where it was left; what changes in it stays.
    pub(super) async fn read_tape(
        &self,
        job: u32,
        source: &Source,
        kind: Kind,
    ) -> Result<(), String> {
        {
            let mut state = self.state.borrow_mut();
            if let Tape::None = state.tape {
                let reader = Reader::new(kind, None).map_err(|why| refusal(&why))?;
                state.tape = Tape::Coming(Box::new(reader));
                state.read = state.origin as f64;
                state.paper = Paper::None;
            }
        }
        let mut turn = Turn::new();
        loop {
            let at = self.state.borrow().read;
            let piece = source.piece(at).await?;
            if !self.wants(job) {
                return Ok(());
            }
            for part in piece.chunks(PART) {
                let read = self.state.borrow_mut().read_part(part);
                read.map_err(|why| refusal(&why))?;
                self.tell(false);
                turn.over().await;
                if !self.wants(job) {
                    return Ok(());
                }
            }
            if piece.is_empty() {
                return self.end_tape(Reader::finish);
            }
        }
    }

    /// Lets what has come of a recording be all of it; whether one is being read.
    pub(super) fn cut_tape(&self) -> Result<bool, String> {
        let coming = matches!(self.state.borrow().tape, Tape::Coming(_));
        self.end_tape(Reader::cut).map(|()| coming)
    }

    fn end_tape(
        &self,
        end: impl FnOnce(Reader) -> Result<Changes, Unreadable>,
    ) -> Result<(), String> {
        let mut state = self.state.borrow_mut();
        state.tape = match std::mem::take(&mut state.tape) {
            Tape::Coming(reader) => {
                let changes = end(*reader).map_err(|why| refusal(&why))?;
                Tape::Whole(Rc::new(changes))
            }
            other => other,
        };
        Ok(())
    }

    /// Takes the frames from what has changed, and decodes them.
    pub(super) async fn frame(&self, job: u32, changes: Rc<Changes>) -> Result<(), String> {
        let profile = {
            let mut state = self.state.borrow_mut();
            state.framing = Framing::Running;
            state.profile
        };
        let chosen = profile.filter(|profile| profile.format.timing().is_some());
        // A layout of one's own knows no timing: it reads the frames that are found without it.
        let own = profile.filter(|profile| profile.link() == Link::Clocked && chosen.is_none());
        let mut work = Work {
            desk: self,
            job,
            changes: &changes,
            most: usize::MAX,
            turn: Turn::new(),
        };
        let framed = work.framed(chosen).await;
        if !self.wants(job) {
            return Ok(());
        }
        self.state.borrow_mut().framing = Framing::Idle;
        let Some((captured, dump, framed)) = framed.map_err(|why| self.unframed(&why))? else {
            return Ok(());
        };
        let profile = own.unwrap_or(framed);
        {
            let mut state = self.state.borrow_mut();
            // Lines of another length are something else.
            let same =
                |old: &Dump| old.len() == dump.len() && old.bytes().len() == dump.bytes().len();
            if !state.paper.dump().is_some_and(same) {
                state.judge.forget();
            }
            state.captured = captured;
            state.paper = Paper::Whole(dump);
            state.sheet = Decoder::new(profile).ok().map(Sheet::new);
            let (filter, order) = state.shown;
            if let Some(sheet) = &mut state.sheet {
                sheet.show(filter, order);
            }
            if state.profile != Some(profile) {
                state.profile = Some(profile);
                let post = state.post.clone();
                drop(state);
                post(FromDesk::Taken(link::query(&profile)), None);
            }
        }
        self.decode(job, &mut work.turn).await;
        Ok(())
    }

    /// Why there are no frames.
    fn unframed(&self, why: &Unreadable) -> String {
        let state = self.state.borrow();
        let whole = state.source.as_ref().map_or(0.0, Source::len);
        match state.read < whole {
            true => text!(
                "Stopped after {} MB: {}.",
                number(format_args!("{:.1}", state.read / 1e6)),
                why
            ),
            false => refusal(why),
        }
    }
}

fn refusal(why: &Unreadable) -> String {
    text!("The recording cannot be read: {}.", why)
}

impl super::State {
    /// Reads the next part of a recording; what cannot be read is not kept.
    fn read_part(&mut self, part: &[u8]) -> Result<(), Unreadable> {
        if let Tape::Coming(reader) = &mut self.tape {
            if let Err(why) = reader.push(part) {
                self.tape = Tape::None;
                return Err(why);
            }
            self.read += part.len() as f64;
        }
        Ok(())
    }
}

/// Framing a recording, a little at a time. Nothing comes of it where the job is not wanted any
/// more.
struct Work<'a> {
    desk: &'a Desk,
    job: u32,
    changes: &'a Changes,
    /// Changes that are looked at.
    most: usize,
    turn: Turn,
}

impl Work<'_> {
    /// Whether the job is still wanted, when others have had their turn.
    async fn goes_on(&mut self) -> bool {
        self.desk.tell(false);
        self.turn.over().await;
        self.desk.wants(self.job)
    }

    /// What there is to show, and the profile that reads it.
    async fn framed(
        &mut self,
        chosen: Option<Profile>,
    ) -> Result<Option<(Captured, Dump, Profile)>, Unreadable> {
        let read = match chosen {
            Some(profile) => self.extracted(profile).await?,
            None => self.guessed().await?,
        };
        let Some(read) = read else {
            return Ok(None);
        };
        let profile = read.profile;
        let shown = self.shown(read, chosen).await;
        Ok(shown.map(|(captured, dump)| (captured, dump, profile)))
    }

    /// As BiSS-C where there are acknowledges, else as the SSI whose words have so many bits.
    async fn guessed(&mut self) -> Result<Option<Recording>, Unreadable> {
        let Some(read) = self.extracted(Format::BissC.default_profile()).await? else {
            return Ok(None);
        };
        match self.is_biss(&read).await {
            Some(false) => {}
            Some(true) => return Ok(Some(read)),
            None => return Ok(None),
        }
        let Some(read) = self.extracted(Format::Ssi.default_profile()).await? else {
            return Ok(None);
        };
        match word(&read) {
            Some(profile) => self.extracted(profile).await,
            None => Ok(Some(read)),
        }
    }

    /// The frames as they are with a profile.
    async fn extracted(&mut self, profile: Profile) -> Result<Option<Recording>, Unreadable> {
        let title = profile.format.title();
        let decoder = Decoder::new(profile).map_err(|_| Unreadable::NotClocked(title))?;
        let mut extraction = Extraction::new(self.changes, &decoder, Options::default())?;
        while extraction.step(self.changes, CHANGES)? {
            if !self.goes_on().await {
                return Ok(None);
            }
            let stopping = self.desk.state.borrow().framing == Framing::Stopping;
            if stopping && self.most == usize::MAX {
                self.most = extraction.seen();
            }
            if extraction.seen() >= self.most {
                extraction.stop();
            }
        }
        Ok(Some(extraction.finish(self.changes)))
    }

    /// Whether every frame begins with the idle line, an acknowledge of one length, start and cds,
    /// and BiSS-C explains the first ones best: a word of SSI with few turns begins with zeros and
    /// a one as well.
    async fn is_biss(&mut self, read: &Recording) -> Option<bool> {
        let first = read.frames.first().and_then(acknowledge);
        if first.is_none() {
            return Some(false);
        }
        for frames in read.frames.chunks(FRAMES) {
            if frames.iter().any(|frame| acknowledge(frame) != first) {
                return Some(false);
            }
            if !self.goes_on().await {
                return None;
            }
        }
        let frames = read.frames.iter().take(ENOUGH);
        let dump = Dump::of_lines(frames.map(|frame| (frame.bits.clone(), None)));
        let mut detection = Detection::new(&dump, &dump, &dump);
        while detection.step() {
            if !self.goes_on().await {
                return None;
            }
        }
        let found = detection.candidates();
        let best = found.first();
        Some(best.is_some_and(|best| best.profile.format == Format::BissC))
    }

    /// The frames as a dump, and what is wrong with their timing.
    async fn shown(
        &mut self,
        mut read: Recording,
        chosen: Option<Profile>,
    ) -> Option<(Captured, Dump)> {
        let mut captured = Captured::new(&read, chosen);
        let mut dump = Dump::of_lines([]);
        let mut frames = std::mem::take(&mut read.frames).into_iter().peekable();
        while frames.peek().is_some() {
            dump.extend(frames.by_ref().take(FRAMES).filter_map(|mut frame| {
                let seconds = frame.seconds();
                captured
                    .take(&mut frame)
                    .then_some((frame.bits, Some(seconds)))
            }));
            if !self.goes_on().await {
                return None;
            }
        }
        captured.finish();
        Some((captured, dump))
    }
}
