//! What the page wishes of a link that is open.

use super::{
    DEMO_INTERVAL, SNAPSHOTS, State,
    run::{Run, Todo, UNBEGUN, Wire},
    talk::{After, Talk},
};
use crate::{
    browser::now,
    message::{FromEngine, Knobs, STILL, Setting, Snapshot, Supply},
    tally::News,
};
use encoderscope::{
    emulator::{Emulator, Faults, ZeroInput},
    finder::Finder,
    format::t485::Request,
    sequence::danger,
    session::{Ask, Hand, Micros},
};

impl State {
    /// Lets go of what is open; it is still to be closed.
    pub(super) fn let_go(&mut self) -> Option<Wire> {
        self.generation += 1;
        self.tally.interrupted();
        let mut run = self.run.take()?;
        run.abandon(&mut self.tally);
        Some(run.wire)
    }

    /// Begins a sequence with the encoder that is being read.
    pub(super) fn begin(&mut self, setting: Setting) {
        let still = self.tally.moved(now()).is_some_and(|moved| moved < STILL);
        let Some(run) = &mut self.run else {
            return self.tally.refuse(setting, "Nothing is connected.");
        };
        let Some(session) = run.session.as_mut().filter(|_| run.talk.is_none()) else {
            return;
        };
        if setting.needs_rest() && !still {
            let why = "The shaft must stand still for a second. Nothing was sent.";
            return self.tally.refuse(setting, why);
        }
        let scan = Finder::scan(session.decoder().profile(), now());
        match (setting, scan) {
            // Every device on the wire would take the new address.
            (Setting::Address(_), Some(finder)) => {
                session.rest();
                self.tally.begin(setting, 0);
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
                self.tally.refuse(*setting, UNBEGUN);
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
                Wire::Port { .. } => self.interval,
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
        if let Some(run) = &mut self.run {
            run.wake(now, &mut self.tally);
            if let Some(link) = run.advance(now, &mut self.tally) {
                self.link = link;
                self.tally.touch();
            }
            todo = run.todo.take();
            if let Some(timer) = &mut self.timer {
                timer.wake_by(run.deadline());
            }
        }
        if self.wanted {
            self.tell(now);
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
                let snapshot = self.snapshot(now);
                (self.post)(FromEngine::Snapshot(Box::new(snapshot)));
            }
        }
    }

    fn snapshot(&mut self, now: Micros) -> Snapshot {
        let mut snapshot = self.tally.snapshot(now);
        snapshot.link = self.link.clone();
        match &self.run {
            Some(run) => snapshot.busy = run.talk.is_some(),
            None => snapshot.rate = 0.0,
        }
        snapshot
    }
}
