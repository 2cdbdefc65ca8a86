//! What the page wishes of a link that is open.

use super::{
    DEMO_INTERVAL, Engine, SNAPSHOTS, State,
    run::{Run, Todo, UNBEGUN, Wire},
    talk::{After, Talk},
    unfit,
};
use crate::{
    browser::now,
    language,
    message::{Answer, FromEngine, Knobs, Link, STILL, Setting, Snapshot, Supply, Wish},
    tally::News,
};
use encoderscope::{
    emulator::{Emulator, Faults, ZeroInput},
    finder::Finder,
    format::t485::Request,
    language::{in_english, t},
    sequence::danger,
    session::{Ask, Hand, Micros},
};
use wasm_bindgen::{JsCast, JsValue};

impl Engine {
    /// Does what a part of the page wishes; a file may come with it.
    pub fn grant(&self, wish: Wish, file: Option<JsValue>) {
        let state = || self.state.borrow_mut();
        let replays = state().is_replaying();
        match wish {
            // A recording hears nothing.
            Wish::Scan | Wish::Watch(_) | Wish::Send { .. } | Wish::ReadMemory(_) if replays => {}
            Wish::Speak => {
                language::speak(&file.unwrap_or_default());
                state().tally.touch();
            }
            Wish::Set(setting) => state().begin(setting),
            Wish::StopSetting => state().stop(),
            Wish::ForgetSetting => state().tally.forget_progress(),
            Wish::Scan => state().scan(),
            Wish::Watch(address) => state().watch(address),
            Wish::Send { bytes, confirmed } => state().send(&bytes, confirmed),
            Wish::Pace(rate) => state().pace(rate),
            Wish::ReadMemory(address) => state().read_memory(address),
            Wish::Supply(supply) => state().supply(supply),
            Wish::Turn(speed) => state().turn(speed),
            Wish::Knobs(knobs) => state().adjust(knobs),
            Wish::Plot(request) => state().plot(&request),
            Wish::Rest => state().rest(),
            Wish::Mark(note) => state().tally.note(now(), &note),
            Wish::Play(speed) => state().play_at(speed),
            Wish::Story => {
                let story = state().story();
                self.hand(Answer::Story(story), None);
            }
            Wish::Record => self.begin_recording(),
            Wish::StopRecording => state().end_recording(None),
            Wish::Copy => {
                if let Some(Ok(handle)) = file.map(JsCast::dyn_into) {
                    self.copy(handle);
                }
            }
            Wish::Recordings => self.list(),
            Wish::Settle(name) => self.settle(name),
            Wish::Delete(name) => self.delete(name),
            Wish::Fetch(name) => self.fetch(name),
            Wish::Report(text) => self.report(&text),
            Wish::Replay { name, profile } => self.replay(name, profile, file),
            Wish::Seek(part) => self.seek(part),
            Wish::Compare(names) => self.compare(names),
        }
        self.pump();
    }

    /// Answers a wish, with a file beside it.
    pub(super) fn hand(&self, answer: Answer, file: Option<JsValue>) {
        (self.state.borrow().hand)(answer, file);
    }
}

impl State {
    /// Lets go of what is open, and says why; it is still to be closed.
    pub(super) fn let_go(&mut self, why: &str) -> Option<Wire> {
        self.generation += 1;
        self.tally.interrupted();
        let run = self.run.take();
        if self.player.take().is_some() {
            self.saved = None;
            self.tally.transcript().replays = false;
            return None;
        }
        let mut run = run?;
        run.abandon(&mut self.tally);
        self.tally.transcript().close(now(), why);
        Some(run.wire)
    }

    /// The link is another one, or in another state.
    pub(super) fn tell_link(&mut self, now: Micros) {
        let link = in_english(|| self.link_said());
        let name = link.name();
        let text = match &link {
            Link::Refused { reason, hint } if !hint.is_empty() => {
                format!("link {name}: {reason} {hint}")
            }
            Link::Refused { reason, .. } | Link::Unfit { reason, .. } => {
                format!("link {name}: {reason}")
            }
            _ => format!("link {name}"),
        };
        self.tally.happened(now, text);
        self.tally.touch();
    }

    /// Begins a sequence with the encoder that is being read.
    pub(super) fn begin(&mut self, setting: Setting) {
        if self.is_replaying() {
            let why = || t("This is a recording. Nothing was sent.").into();
            return self.tally.refuse(self.time(), setting, why);
        }
        let still = self.tally.moved(now()).is_some_and(|moved| moved < STILL);
        let Some(run) = &mut self.run else {
            let why = || t("Nothing is connected.").into();
            return self.tally.refuse(now(), setting, why);
        };
        let Some(session) = run.session.as_mut().filter(|_| run.talk.is_none()) else {
            return;
        };
        if setting.needs_rest() && !still {
            let why = || t("The shaft must stand still for a second. Nothing was sent.").into();
            return self.tally.refuse(now(), setting, why);
        }
        let scan = Finder::scan(session.decoder().profile(), now());
        match (setting, scan) {
            // Every device on the wire would take the new address.
            (Setting::Address(_), Some(finder)) => {
                session.rest();
                self.tally.begin(now(), setting, 0);
                run.talk = Some(Talk::Scan(finder, After::Set(setting)));
            }
            _ => run.set(setting, now(), &mut self.tally),
        }
    }

    /// Ends a sequence before its next command, a scan at once.
    pub(super) fn stop(&mut self) {
        let Some(run) = &mut self.run else {
            return;
        };
        match &mut run.talk {
            Some(Talk::Set(_, runner)) => runner.stop(),
            Some(Talk::Scan(_, After::Set(setting))) => {
                self.tally.refuse(now(), *setting, || t(UNBEGUN).into());
                run.talk = None;
            }
            Some(Talk::Scan(_, After::Read)) => run.talk = None,
            _ => {}
        }
    }

    /// Looks for all devices of the BUS that is being read.
    pub(super) fn scan(&mut self) {
        let Some(run) = &mut self.run else {
            return;
        };
        let Some(session) = run.session.as_mut().filter(|_| run.talk.is_none()) else {
            return;
        };
        if let Some(finder) = Finder::scan(session.decoder().profile(), now()) {
            session.rest();
            run.talk = Some(Talk::Scan(finder, After::Read));
        }
    }

    /// Puts another device of the BUS on the dial.
    pub(super) fn watch(&mut self, address: u8) {
        let addresses = self.tally.addresses();
        if let Some(run) = self.run.as_mut().filter(|run| run.talk.is_none()) {
            run.read_devices(now(), Some(address), &addresses, &mut self.tally);
        }
    }

    /// Sends bytes by hand, but none that change an encoder unless the user was asked.
    pub(super) fn send(&mut self, bytes: &[u8], confirmed: bool) {
        let Some(run) = self.run.as_mut().filter(|run| run.talk.is_none()) else {
            return;
        };
        let Some(session) = &mut run.session else {
            return;
        };
        if !confirmed && danger(session.decoder().profile(), bytes).is_some() {
            return;
        }
        session.rest();
        run.talk = Some(Talk::Hand(Hand::new(bytes, now())));
    }

    /// Asks so many times a second.
    pub(super) fn pace(&mut self, rate: f64) {
        self.interval = if rate > 0.0 {
            (1e6 / rate) as Micros
        } else {
            0
        };
        if let Some(run) = &mut self.run {
            run.interval = match run.wire {
                Wire::Port { .. } | Wire::Replay => self.interval,
                Wire::Demo(_) => self.interval.max(DEMO_INTERVAL),
            };
            if let Some(session) = &mut run.session {
                session.set_interval(run.interval);
            }
        }
    }

    /// Asks for a cell of the EEPROM, where the encoder has one.
    pub(super) fn read_memory(&mut self, address: u8) {
        let session = self.run.as_mut().and_then(|run| run.session.as_mut());
        let asked = session.is_some_and(|session| {
            let ask = Ask::t485(session.decoder(), Request::MemoryRead, address);
            ask.is_ok_and(|ask| session.ask(ask).is_ok())
        });
        if asked {
            self.tally.ask_memory(address);
        }
    }

    fn built_in(&mut self) -> Option<&mut Emulator> {
        match &mut self.run {
            Some(Run {
                wire: Wire::Demo(emulator),
                ..
            }) => Some(emulator),
            _ => None,
        }
    }

    /// Turns the shaft of the built-in encoder.
    pub(super) fn turn(&mut self, speed: f64) {
        if let Some(emulator) = self.built_in() {
            emulator.shaft = emulator.shaft.going_on(now(), speed);
        }
    }

    /// Switches the supply of the built-in encoder.
    pub(super) fn supply(&mut self, supply: Supply) {
        let now = now();
        if let Some(emulator) = self.built_in() {
            match supply {
                Supply::Off => emulator.power_off(now),
                Supply::On => emulator.power_on(now, None),
                Supply::OnWithSet => emulator.power_on(now, Some(ZeroInput::Set)),
                Supply::OnWithReset => emulator.power_on(now, Some(ZeroInput::Reset)),
            }
        }
    }

    /// Lets the built-in encoder report something, or its line fail.
    pub(super) fn adjust(&mut self, knobs: Knobs) {
        if let Some(emulator) = self.built_in() {
            emulator.noise = knobs.noise;
            emulator.status = knobs.status;
            emulator.error = knobs.error;
            emulator.warning = knobs.warning;
            emulator.faults = Faults {
                echo: knobs.echo,
                silent: knobs.silent,
                flip: knobs.flip,
                lose: knobs.lose,
                ..emulator.faults
            };
        }
    }

    /// Lets the link go on, and posts a snapshot; returns what only the engine can do.
    pub(super) fn pump(&mut self) -> Option<Todo> {
        let now = now();
        let mut todo = None;
        if self.is_replaying() {
            todo = self.play(now).then_some(Todo::Feed);
        } else if let Some(run) = &mut self.run {
            run.wake(now, &mut self.tally);
            let news = run.advance(now, &mut self.tally);
            todo = run.todo.take();
            if let Some(timer) = &mut self.timer {
                timer.wake_by(run.deadline());
            }
            if let Some(link) = news {
                self.link = link;
                self.tell_link(now);
            }
        }
        let time = self.time();
        self.tally.review(time);
        if self.wanted {
            self.tell(now);
        }
        if let (Some(due), Some(timer)) = (self.keep(now), &mut self.timer) {
            timer.wake_by(due);
        }
        todo
    }

    /// Tells the page what is new: of frames the reading at once, the rest now and then.
    fn tell(&mut self, now: Micros) {
        match self.tally.news() {
            News::Nothing => {}
            News::Frames if now < self.rested => {
                if let Some(timer) = &mut self.timer {
                    timer.wake_by(self.rested);
                }
                if let Some(reading) = self.tally.reading() {
                    self.wanted = false;
                    (self.post)(FromEngine::Reading(reading));
                }
            }
            News::Frames | News::More => {
                self.wanted = false;
                self.rested = now + SNAPSHOTS;
                let snapshot = self.snapshot();
                (self.post)(FromEngine::Snapshot(Box::new(snapshot)));
            }
        }
    }

    /// How the link is, in the language that is spoken.
    fn link_said(&self) -> Link {
        match &self.link {
            Link::Unfit { profile, .. } => unfit(profile),
            link => link.clone(),
        }
    }

    pub(super) fn snapshot(&mut self) -> Snapshot {
        let time = self.time();
        let mut snapshot = self.tally.snapshot(time);
        if let Some(saved) = &self.saved {
            return saved.clone();
        }
        snapshot.link = self.link_said();
        match &self.run {
            Some(run) => snapshot.busy = run.talk.is_some(),
            None => snapshot.rate = 0.0,
        }
        snapshot
    }
}
