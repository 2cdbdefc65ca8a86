//! An open link: a session, or what it rests for, over a port or with the built-in encoder.

mod beside;

use super::talk::{After, Talk};
use crate::{
    link::query,
    message::Link,
    serial::{Port, Reader},
    tally::Tally,
};
use encoderscope::{
    bits::Bits,
    doctor::{Doctor, Finding},
    emulator::Emulator,
    language::{msg, t},
    profile::Profile,
    session::{Micros, Output, Session},
};

/// So late a step is only made after the tab was frozen or the machine asleep.
const ASLEEP: Micros = 1_000_000;

/// How a setting ends that is broken off before its first command.
pub(super) const UNBEGUN: &str =
    msg("Stopped: it was broken off. Nothing was sent that changes an encoder.");

/// An open link.
pub(super) struct Run {
    /// What reads; nothing while an encoder is searched for.
    pub(super) session: Option<Session>,
    pub(super) interval: Micros,
    /// What the session rests for.
    pub(super) talk: Option<Talk>,
    /// How far the built-in encoder has lived; its time never runs backwards.
    lived: Micros,
    /// When the link was last looked at.
    looked: Micros,
    pub(super) wire: Wire,
    doctor: Doctor,
    /// What the doctor has said last.
    said: Finding,
    /// What only the engine can do.
    pub(super) todo: Option<Todo>,
}

pub(super) enum Wire {
    Port {
        port: Port,
        reader: Option<Reader>,
    },
    Demo(Box<Emulator>),
    /// A recording: nothing is sent.
    Replay,
}

/// What a search wants of the engine.
#[derive(Clone, Copy, Debug)]
pub(super) enum Todo {
    /// The port at another baud rate.
    Reopen(u32),
    /// More of the file that is replayed.
    Feed,
    /// Nothing more.
    Close,
}

impl Wire {
    fn send(&mut self, at: Micros, bytes: &[u8]) {
        match self {
            Self::Port { port, .. } => port.write(bytes),
            Self::Demo(emulator) => emulator.handle_input(at, bytes),
            Self::Replay => {}
        }
    }
}

impl Run {
    /// A link that reads.
    pub(super) fn reading(wire: Wire, session: Session, interval: Micros, now: Micros) -> Self {
        let doctor = Doctor::new(*session.decoder().profile(), now);
        Self {
            session: Some(session),
            ..Self::new(wire, doctor, interval, now)
        }
    }

    /// A link on which an encoder is searched for.
    pub(super) fn searching(wire: Wire, talk: Talk, now: Micros) -> Self {
        let doctor = Doctor::new(Profile::base(encoderscope::format::Format::T485), now);
        Self {
            talk: Some(talk),
            ..Self::new(wire, doctor, 0, now)
        }
    }

    const fn new(wire: Wire, doctor: Doctor, interval: Micros, now: Micros) -> Self {
        Self {
            session: None,
            interval,
            talk: None,
            lived: now,
            looked: now,
            wire,
            doctor,
            said: Finding::Waiting,
            todo: None,
        }
    }

    /// Runs up to `now`; returns how the link is when that has changed.
    pub(super) fn advance(&mut self, now: Micros, tally: &mut Tally) -> Option<Link> {
        // The built-in encoder lives in virtual time, which catches up here; after a pause of
        // the tab it does not replay more than a second.
        let oldest = now.saturating_sub(1_000_000);
        loop {
            let mut idle = true;
            let host = self.host_deadline();
            let at = match &mut self.wire {
                Wire::Port { .. } | Wire::Replay => now,
                Wire::Demo(emulator) => {
                    let next = emulator.deadline().unwrap_or(Micros::MAX).min(host);
                    let at = next.max(oldest).max(self.lived).min(now);
                    self.lived = at;
                    if let Some(bytes) = emulator.poll_output(at) {
                        self.take(at, &bytes, tally);
                        idle = false;
                    }
                    at
                }
            };
            if self.host_deadline() <= at {
                match (&mut self.talk, &mut self.session) {
                    (Some(talk), _) => talk.handle_timeout(at),
                    (None, Some(session)) => session.handle_timeout(at),
                    (None, None) => {}
                }
                idle = false;
            }
            idle &= !self.follow(at, tally);
            idle &= !self.follow_session(at, tally);
            if idle || self.todo.is_some() {
                return self.news();
            }
        }
    }

    /// How the link is, when that has changed.
    fn news(&mut self) -> Option<Link> {
        let finding = self.doctor.finding();
        if self.session.is_none() || self.said == finding {
            return None;
        }
        self.said = finding;
        Some(match finding {
            Finding::Waiting => return None,
            Finding::Silent => Link::Silent { echo: false },
            Finding::EchoOnly => Link::Silent { echo: true },
            Finding::Garbage => Link::Garbage,
            Finding::ChecksFail => Link::Failing,
            Finding::OtherProfile(profile) => Link::OtherProfile {
                profile: query(&profile),
            },
            Finding::Unasked(profile) => Link::Unasked {
                profile: profile.as_ref().map(query),
            },
            Finding::Good => Link::Reading,
        })
    }

    /// Begins anew after a sleep. What is read then came at a time that nobody knows, and what was
    /// seen of the shaft before a sequence no longer counts.
    pub(super) fn wake(&mut self, now: Micros, tally: &mut Tally) {
        let overslept = |due: Micros| now > due.saturating_add(ASLEEP);
        if overslept(self.host_deadline()) && overslept(self.looked) {
            match &mut self.talk {
                Some(Talk::Set(_, runner)) => runner.stop(),
                // Another device may have been connected meanwhile.
                Some(Talk::Scan(_, after)) => {
                    if let After::Set(setting) = after {
                        let why = msg(
                            "Broken off, for the page slept. Nothing was sent that changes an encoder.",
                        );
                        tally.refuse(now, *setting, move || t(why).into());
                    }
                    self.talk = None;
                }
                Some(Talk::Hand(_)) => self.talk = None,
                Some(Talk::Find(..)) | None => {}
            }
            if let (None, Some(session)) = (&self.talk, &mut self.session) {
                session.rest();
            }
        }
        self.looked = now;
    }

    fn host_deadline(&self) -> Micros {
        match (&self.talk, &self.session) {
            (Some(talk), _) => talk.deadline(),
            (None, Some(session)) => session.deadline(),
            (None, None) => Micros::MAX,
        }
    }

    /// When something is to be done next.
    pub(super) fn deadline(&self) -> Micros {
        let host = self.host_deadline();
        match &self.wire {
            Wire::Port { .. } | Wire::Replay => host,
            Wire::Demo(emulator) => emulator.deadline().unwrap_or(Micros::MAX).min(host),
        }
    }

    /// Bytes have come.
    pub(super) fn take(&mut self, at: Micros, bytes: &[u8], tally: &mut Tally) {
        tally.received(at, bytes, self.talk.is_some());
        match (&mut self.talk, &mut self.session) {
            (Some(talk), _) => {
                if !matches!(talk, Talk::Hand(_)) {
                    tally.answered(at, bytes);
                }
                talk.handle_input(at, bytes);
            }
            (None, Some(session)) => session.handle_input(at, bytes),
            (None, None) => {}
        }
    }

    /// Bytes have come that were recorded.
    pub(super) fn read(&mut self, at: Micros, bytes: &[u8], tally: &mut Tally) {
        self.take(at, bytes, tally);
        self.follow_session(at, tally);
    }

    /// Another host has sent this.
    pub(super) fn hear(&mut self, at: Micros, bytes: &[u8], tally: &mut Tally) {
        if let Some(session) = &mut self.session {
            session.handle_sent(at, bytes);
            let layout = session.decoder().layout(bytes);
            let values = layout.map(|layout| layout.values(Bits::of_bytes(bytes)));
            if let Some(address) = values.and_then(|values| values.address) {
                tally.meet(address);
            }
            self.follow_session(at, tally);
        }
    }

    /// Lets time pass for a session that reads along; returns how the link is when that has
    /// changed.
    pub(super) fn pass(&mut self, from: Micros, to: Micros, tally: &mut Tally) -> Option<Link> {
        while let Some(session) = &mut self.session {
            let due = session.deadline().max(from);
            if due > to {
                break;
            }
            session.handle_timeout(due);
            self.follow_session(due, tally);
        }
        self.news()
    }

    /// Lets the session rest; everything that has come is reported.
    pub(super) fn rest(&mut self, at: Micros, tally: &mut Tally) {
        if let Some(session) = &mut self.session {
            session.rest();
        }
        self.follow_session(at, tally);
    }

    /// The link is going away: a sequence ends here, and every byte is accounted for.
    pub(super) fn abandon(&mut self, tally: &mut Tally) {
        let now = self.looked;
        self.rest(now, tally);
        match &mut self.talk {
            Some(Talk::Set(_, runner)) => {
                runner.stop();
                while let Some(event) = runner.poll_output() {
                    tally.follow(now, &event);
                }
            }
            Some(Talk::Scan(_, After::Set(setting))) => {
                tally.refuse(now, *setting, || t(UNBEGUN).into());
            }
            _ => {}
        }
    }

    fn follow_session(&mut self, at: Micros, tally: &mut Tally) -> bool {
        let Some(session) = &mut self.session else {
            return false;
        };
        let mut spoke = false;
        while let Some(output) = session.poll_output() {
            spoke = true;
            if let Output::Transmit(bytes) = &output {
                self.wire.send(at, bytes);
            }
            let good = tally.take(at, &output);
            self.doctor.watch(at, &output, good);
        }
        tally.echo(session.echo());
        spoke
    }
}
