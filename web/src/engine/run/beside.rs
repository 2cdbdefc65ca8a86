//! What an open link does beside reading: settings, scans, searches, and bytes sent by hand.

use super::{Run, Todo, Wire};
use crate::{
    engine::talk::{After, Talk},
    message::Setting,
    tally::{RESTLESS, Tally},
};
use encoderscope::{
    decode::Decoder,
    doctor::Doctor,
    finder::{self, Finder},
    language::t,
    profile::Profile,
    recording::Purpose,
    sequence::{Change, Event, Holds, Runner},
    session::{Micros, Session},
    text,
};

impl Run {
    /// Lets what the session rests for speak; returns whether it did.
    pub(super) fn follow(&mut self, at: Micros, tally: &mut Tally) -> bool {
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
    pub(in super::super) fn set(&mut self, setting: Setting, now: Micros, tally: &mut Tally) {
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
    pub(in super::super) fn read_devices(
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
