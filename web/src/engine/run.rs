//! An open link: a session, or what it rests for, over a port or with the built-in encoder.

use super::talk::{After, Talk};
use crate::{
    link::query,
    message::{Link, Setting},
    serial::{Port, Reader},
    tally::{RESTLESS, Tally},
};
use encoderscope::{
    bits::Bits,
    decode::Decoder,
    doctor::{Doctor, Finding},
    emulator::Emulator,
    finder::{self, Finder},
    language::{msg, t},
    profile::Profile,
    recording::Purpose,
    sequence::{Change, Event, Holds, Runner},
    session::{Micros, Output, Session},
    text,
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

    /// Lets what the session rests for speak; returns whether it did.
    fn follow(&mut self, at: Micros, tally: &mut Tally) -> bool {
        match &mut self.talk {
            None => false,
            Some(Talk::Set(setting, runner)) => {
                let setting = *setting;
                let Some(event) = runner.poll_output() else {
                    return false;
                };
                tally.follow(at, &event);
                match event {
                    Event::Transmit(bytes) => self.send(at, &bytes, Purpose::Setting, tally),
                    Event::Progress { .. } => {}
                    Event::Ended { holds, .. } => {
                        self.talk = None;
                        self.resume(at, setting.change(), holds, tally);
                    }
                }
                true
            }
            Some(Talk::Hand(hand)) => {
                if let Some(bytes) = hand.poll_output() {
                    self.send(at, &bytes, Purpose::Hand, tally);
                } else if let Some(reply) = hand.reply() {
                    tally.answered(at, reply);
                    self.talk = None;
                } else {
                    return false;
                }
                true
            }
            Some(Talk::Scan(finder, _)) => {
                match finder.poll_output() {
                    None => return false,
                    Some(finder::Output::Transmit(bytes)) => {
                        self.send(at, &bytes, Purpose::Scan, tally);
                    }
                    // A scan stays at the baud rate of its profile.
                    Some(finder::Output::Open(_)) => finder.handle_opened(at),
                    Some(finder::Output::Ended) => {
                        if let Some(Talk::Scan(finder, after)) = self.talk.take() {
                            self.scanned(at, &finder, after, tally);
                        }
                    }
                }
                true
            }
            Some(Talk::Find(finder, _)) => {
                let Some(output) = finder.poll_output() else {
                    return false;
                };
                tally.searched(finder);
                match (output, &mut self.wire) {
                    (finder::Output::Transmit(bytes), _) => {
                        self.send(at, &bytes, Purpose::Scan, tally);
                    }
                    (finder::Output::Open(baud), Wire::Demo(emulator)) => {
                        emulator.faults.rate = Some(baud);
                        emulator.drop_unread(at);
                        finder.handle_opened(at);
                    }
                    (finder::Output::Open(_), Wire::Replay) => {}
                    (finder::Output::Open(baud), Wire::Port { .. }) => {
                        self.todo = Some(Todo::Reopen(baud));
                    }
                    (finder::Output::Ended, _) => {
                        tally.end_search();
                        self.todo = Some(Todo::Close);
                    }
                }
                true
            }
        }
    }

    fn send(&mut self, at: Micros, bytes: &[u8], purpose: Purpose, tally: &mut Tally) {
        tally.sent(at, bytes, purpose);
        self.wire.send(at, bytes);
    }

    /// A scan is over.
    fn scanned(&mut self, at: Micros, finder: &Finder, after: After, tally: &mut Tally) {
        let addresses = finder.found().first();
        let addresses = addresses.map_or(&[][..], |found| &found.addresses);
        match after {
            After::Read => {
                tally.scanned(addresses, finder);
                self.read_devices(at, None, addresses, tally);
            }
            After::Set(setting) => {
                let own = self
                    .session
                    .as_ref()
                    .map(|session| session.decoder().profile().address);
                let alone = addresses.iter().map(|address| u32::from(*address)).eq(own);
                if alone && finder.disturbed().is_empty() && !finder.is_restless() {
                    self.set(setting, at, tally);
                } else {
                    let addresses = addresses.to_vec();
                    let disturbed = finder.disturbed().to_vec();
                    let restless = finder.is_restless();
                    let why = move || not_alone(&addresses, &disturbed, restless);
                    tally.refuse(at, setting, why);
                }
            }
        }
    }

    /// Begins a sequence.
    pub(super) fn set(&mut self, setting: Setting, now: Micros, tally: &mut Tally) {
        let Some(session) = &mut self.session else {
            return;
        };
        match Runner::new(session.decoder(), setting.change(), now) {
            Some(runner) => {
                session.rest();
                tally.begin(now, setting, runner.total());
                self.talk = Some(Talk::Set(setting, Box::new(runner)));
            }
            None => tally.refuse(now, setting, || {
                t("This encoder has no such sequence. Nothing was sent.").into()
            }),
        }
    }

    /// Reads several devices of a BUS in turn, with the one at `watched` on the dial.
    pub(super) fn read_devices(
        &mut self,
        now: Micros,
        watched: Option<u8>,
        addresses: &[u8],
        tally: &mut Tally,
    ) {
        if let Some(session) = &mut self.session {
            session.rest();
        }
        self.follow_session(now, tally);
        let (Some(session), Some(first)) = (&mut self.session, addresses.first()) else {
            return;
        };
        let profile = *session.decoder().profile();
        let own = addresses
            .iter()
            .find(|address| u32::from(**address) == profile.address);
        let address = u32::from(watched.unwrap_or(*own.unwrap_or(first)));
        let decoder = Decoder::new(Profile { address, ..profile }).ok();
        let made =
            decoder.and_then(|decoder| Session::of_devices(decoder, addresses, self.interval).ok());
        if let Some(new) = made {
            self.doctor = Doctor::new(*new.decoder().profile(), now);
            tally.start(now, new.decoder().clone());
            *session = new;
        }
    }

    /// Reads on after a sequence, at the address that the encoder has now.
    fn resume(&mut self, at: Micros, change: Change, holds: Holds, tally: &mut Tally) {
        if let (Change::Address(address), Holds::New) = (change, holds) {
            tally.forget_devices();
            self.read_devices(at, Some(address), &[address], tally);
        }
    }
}

/// Why the address cannot be set.
fn not_alone(addresses: &[u8], disturbed: &[u8], restless: bool) -> String {
    let list = |addresses: &[u8]| {
        let list: Vec<String> = addresses.iter().map(ToString::to_string).collect();
        list.join(", ")
    };
    let why = match (addresses, disturbed) {
        _ if restless => t(RESTLESS).to_owned(),
        ([], []) => t("No device answered the scan.").to_owned(),
        (_, []) if addresses.len() > 1 => {
            text!(
                "{} devices answer, at {}.",
                addresses.len(),
                list(addresses)
            )
        }
        (_, []) => text!("The device answers at {} now.", list(addresses)),
        _ => text!(
            "What answers at {} is damaged: two devices may share the address.",
            list(disturbed)
        ),
    };
    text!(
        "{} Connect exactly one device, then try again. Nothing was sent.",
        why
    )
}
