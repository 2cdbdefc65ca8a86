//! An open link: a session, or a sequence meanwhile, over a port or with the built-in encoder.

use crate::{
    message::{Link, Setting, Supply},
    serial::{Port, Reader},
    tally::Tally,
};
use encoderscope::{
    decode::Decoder,
    emulator::{Emulator, ZeroInput},
    format::t485::Request,
    framing::Why,
    profile::Profile,
    sequence::{Change, Event, Holds, Runner},
    session::{Ask, Micros, Output, Session},
};

/// Requests without a reply after which the link is called silent.
const SILENT_AFTER: u32 = 3;
/// Frames with a fault in a row after which the link is called failing.
const FAILING_AFTER: u32 = 10;
/// Bytes without a request after which the encoder is called free-running.
const UNASKED_AFTER: usize = 100;
/// So late a step is only made after the tab was frozen or the machine asleep.
const ASLEEP: Micros = 1_000_000;

/// An open link.
pub(super) struct Run {
    pub(super) session: Session,
    pub(super) interval: Micros,
    /// A sequence that runs; the session rests meanwhile.
    pub(super) setting: Option<(Setting, Runner)>,
    /// How far the built-in encoder has lived; its time never runs backwards.
    pub(super) lived: Micros,
    /// When the link was last looked at.
    pub(super) looked: Micros,
    pub(super) wire: Wire,
    pub(super) silent: u32,
    pub(super) failing: u32,
    /// Bytes that came unasked since the last good frame.
    pub(super) unasked: usize,
}

pub(super) enum Wire {
    Port { port: Port, reader: Option<Reader> },
    Demo(Box<Emulator>),
}

impl Wire {
    fn send(&mut self, at: Micros, bytes: &[u8]) {
        match self {
            Self::Port { port, .. } => port.write(bytes),
            Self::Demo(emulator) => emulator.handle_input(at, bytes),
        }
    }
}

impl Run {
    /// Runs up to `now`; returns how the link is when that has become clear.
    pub(super) fn advance(&mut self, now: Micros, tally: &mut Tally) -> Option<Link> {
        let mut link = None;
        // The built-in encoder lives in virtual time, which catches up here; after a pause of
        // the tab it does not replay more than a second.
        let oldest = now.saturating_sub(1_000_000);
        loop {
            let mut idle = true;
            let at = match &mut self.wire {
                Wire::Port { .. } => now,
                Wire::Demo(emulator) => {
                    let host = match &self.setting {
                        Some((_, runner)) => runner.deadline(),
                        None => self.session.deadline(),
                    };
                    let next = emulator.deadline().unwrap_or(Micros::MAX).min(host);
                    let at = next.max(oldest).max(self.lived).min(now);
                    self.lived = at;
                    if let Some(bytes) = emulator.poll_output(at) {
                        tally.received(bytes.len());
                        self.take(at, &bytes, tally);
                        idle = false;
                    }
                    at
                }
            };
            if self.deadline() <= at {
                match &mut self.setting {
                    Some((_, runner)) => runner.handle_timeout(at),
                    None => self.session.handle_timeout(at),
                }
                idle = false;
            }
            idle &= !self.follow(at, tally);
            while let Some(output) = self.session.poll_output() {
                idle = false;
                if let Output::Transmit(bytes) = &output {
                    self.wire.send(at, bytes);
                }
                link = self.judge(&output, tally.take(at, &output)).or(link);
            }
            tally.echo(self.session.echo());
            if idle {
                return link;
            }
        }
    }

    /// Begins anew after a sleep. What is read then came at a time that nobody knows, and what was
    /// seen of the shaft before a sequence no longer counts.
    pub(super) fn wake(&mut self, now: Micros) {
        let overslept = |due: Micros| now > due.saturating_add(ASLEEP);
        if overslept(self.deadline()) && overslept(self.looked) {
            match &mut self.setting {
                Some((_, runner)) => runner.stop(),
                None => self.session.rest(),
            }
        }
        self.looked = now;
    }

    /// Asks for a cell of the EEPROM, where the encoder has one.
    pub(super) fn read_memory(&mut self, address: u8, tally: &mut Tally) {
        let ask = Ask::t485(self.session.decoder(), Request::MemoryRead, address);
        if ask.is_ok_and(|ask| self.session.ask(ask).is_ok()) {
            tally.ask_memory(address);
        }
    }

    /// Switches the supply of the built-in encoder.
    pub(super) fn supply(&mut self, supply: Supply, now: Micros) {
        if let Wire::Demo(emulator) = &mut self.wire {
            match supply {
                Supply::Off => emulator.power_off(now),
                Supply::On => emulator.power_on(now, None),
                Supply::OnWithSet => emulator.power_on(now, Some(ZeroInput::Set)),
                Supply::OnWithReset => emulator.power_on(now, Some(ZeroInput::Reset)),
            }
        }
    }

    /// When something is to be done next.
    pub(super) fn deadline(&self) -> Micros {
        match &self.setting {
            Some((_, runner)) => runner.deadline(),
            None => self.session.deadline(),
        }
    }

    /// Bytes have come.
    pub(super) fn take(&mut self, at: Micros, bytes: &[u8], tally: &mut Tally) {
        match &mut self.setting {
            Some((_, runner)) => {
                tally.received_in_sequence(bytes.len());
                runner.handle_input(at, bytes);
            }
            None => self.session.handle_input(at, bytes),
        }
    }

    /// The link is going away: a sequence ends here, and every byte is accounted for.
    pub(super) fn abandon(&mut self, tally: &mut Tally) {
        self.session.finish();
        while let Some(output) = self.session.poll_output() {
            tally.take(self.looked, &output);
        }
        if let Some((_, runner)) = &mut self.setting {
            runner.stop();
            while let Some(event) = runner.poll_output() {
                tally.follow(&event);
            }
        }
    }

    /// Lets a sequence speak; returns whether it did.
    fn follow(&mut self, at: Micros, tally: &mut Tally) -> bool {
        let mut spoke = false;
        while let Some((setting, runner)) = &mut self.setting {
            let setting = *setting;
            let Some(event) = runner.poll_output() else {
                break;
            };
            spoke = true;
            tally.follow(&event);
            match event {
                Event::Transmit(bytes) => self.wire.send(at, &bytes),
                Event::Progress { .. } => {}
                Event::Ended { holds, .. } => {
                    self.setting = None;
                    self.resume(setting.change(), holds, tally);
                }
            }
        }
        spoke
    }

    /// Reads on after a sequence, at the address that the encoder has now.
    fn resume(&mut self, change: Change, holds: Holds, tally: &mut Tally) {
        let (Change::Address(address), Holds::New) = (change, holds) else {
            return;
        };
        let profile = Profile {
            address: u32::from(address),
            ..*self.session.decoder().profile()
        };
        let session = Decoder::new(profile)
            .ok()
            .and_then(|decoder| Session::new(decoder, self.interval).ok());
        if let Some(session) = session {
            tally.start(session.decoder().clone());
            self.session = session;
        }
    }

    fn judge(&mut self, output: &Output, good: bool) -> Option<Link> {
        match output {
            Output::Frame { .. } if good => {
                self.silent = 0;
                self.failing = 0;
                self.unasked = 0;
                Some(Link::Reading)
            }
            Output::Frame { .. }
            | Output::Skip {
                why: Why::Truncated { .. },
                ..
            } => {
                self.silent = 0;
                self.failing += 1;
                (self.failing >= FAILING_AFTER).then_some(Link::Failing)
            }
            Output::Silent { echo } => {
                self.silent += 1;
                (self.silent >= SILENT_AFTER).then_some(Link::Silent { echo: *echo })
            }
            Output::Skip {
                why: Why::Unasked,
                bytes,
            } => {
                self.unasked += bytes.len();
                (self.unasked >= UNASKED_AFTER).then_some(Link::Unasked)
            }
            Output::Skip { .. } | Output::Transmit(_) => None,
        }
    }
}
