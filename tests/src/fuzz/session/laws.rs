//! What must hold of a conversation, whatever happens on the line.

use super::{Line, Run};
use encoderscope::{
    format::{Format, bus, rs485, t485},
    profile::Profile,
    reading::Values,
    sequence::{Change, Event, Holds, Stop},
    session::{Micros, Output},
};

/// What an encoder holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Held {
    pub(super) turns: Option<i64>,
    pub(super) angle: Option<u64>,
    pub(super) address: u8,
    pub(super) errors: (u8, bool),
    pub(super) cell: Option<u8>,
}

impl Line {
    pub(super) fn check_output(&mut self, output: Output) {
        match output {
            Output::Transmit(bytes) => {
                assert!(reads(self.profile(), &bytes), "{bytes:02x?} is sent");
                self.bus.handle_input(self.now, &bytes);
            }
            Output::Frame {
                bytes,
                sure,
                latency,
            } => {
                self.report(&bytes);
                assert_eq!(latency.is_some(), !self.is_stream());
                let good = || {
                    let frame = self.session.decoder().frame(&bytes);
                    frame.is_some_and(|frame| frame.ok())
                };
                assert!(!sure || self.is_stream() || good());
            }
            Output::Skip { bytes, .. } => self.report(&bytes),
            Output::Silent { .. } => {}
        }
    }

    /// The session has reported bytes: they are the next ones that came.
    pub(super) fn report(&mut self, bytes: &[u8]) {
        assert!(!bytes.is_empty());
        for byte in bytes {
            assert_eq!(self.owed.pop_front(), Some(*byte));
        }
    }

    pub(super) fn check_event(&mut self, run: &mut Run, event: Event) {
        assert!(!run.ended, "{event:?} after the end");
        match event {
            Event::Transmit(bytes) => {
                assert!(!bytes.is_empty() && run.sent == run.done);
                run.sent += 1;
                run.tainted = false;
                self.bus.handle_input(self.now, &bytes);
            }
            Event::Progress { done, total, .. } => {
                run.done += 1;
                assert_eq!((done, total), (run.done, run.runner.total()));
                assert_eq!(run.sent, run.done);
                run.void |= run.tainted;
            }
            Event::Ended { stop, holds, .. } => {
                run.ended = true;
                assert_eq!(run.runner.deadline(), Micros::MAX);
                assert_eq!(stop.is_none(), run.done == run.runner.total());
                // T485 counts nothing: what is read afterwards must show the change.
                let counts = self.profile().format != Format::T485;
                assert!(stop.is_some() || holds == Holds::New || !counts);
                // A count that somebody made up says nothing.
                run.void |= run.tainted && matches!(stop, Some(Stop::WrongCount { .. }));
                let acted = matches!(stop, Some(Stop::WrongCount { received: 10.., .. }));
                if run.void || run.joined && !acted {
                    return;
                }
                let now = match run.change {
                    Change::Memory { address, .. } => self.read(address),
                    _ => self.holds(),
                };
                let (before, change) = (run.before, run.change);
                match holds {
                    Holds::Old => assert_eq!(now, before, "{stop:?}"),
                    Holds::New => check_new(change, now, before),
                    Holds::Unknown => {}
                }
            }
        }
    }

    /// Nothing makes a sequence go on that has ended.
    pub(super) fn check_end(&mut self, run: &mut Run) {
        run.runner.handle_input(self.now, &[0x30]);
        run.runner.handle_timeout(Micros::MAX);
        run.runner.stop();
        assert_eq!(run.runner.poll_output(), None);
        self.held = self.holds();
    }

    /// What the first encoder holds.
    pub(super) fn holds(&self) -> Held {
        let device = &self.bus.devices[0];
        let values: Values = device.values(self.now);
        Held {
            turns: values.turns,
            angle: values.angle,
            address: device.address(),
            errors: (device.status, device.error),
            cell: None,
        }
    }

    /// What it holds, with a byte of its EEPROM, which is asked for on a line that is in order
    /// and when everything else is over.
    pub(super) fn read(&mut self, address: u8) -> Held {
        let second = 1_000_000;
        let now = self.now;
        let faults = core::mem::take(&mut self.device().faults);
        self.device().power_on(now, None);
        self.now += second;
        while self.bus.poll_output(self.now).is_some() {}
        let byte = t485::Request::MemoryRead.byte();
        let request = [byte, address, byte ^ address];
        self.bus.handle_input(self.now, &request);
        self.now += second;
        let reply = self.bus.poll_output(self.now).unwrap_or_default();
        while self.bus.poll_output(self.now).is_some() {}
        self.device().faults = faults;
        Held {
            cell: match reply[..] {
                [first, _, cell, _] if first == byte => Some(cell),
                _ => None,
            },
            ..self.holds()
        }
    }
}

/// Whether the bytes are one request that reads, whatever was sent before.
fn reads(profile: &Profile, bytes: &[u8]) -> bool {
    match (profile.format, bytes) {
        (Format::Rs485, [byte]) => {
            rs485::Command::of_byte(*byte).is_some_and(|command| !command.changes_encoder())
        }
        (Format::T485, [byte]) => {
            t485::Request::of_byte(*byte).is_some_and(|request| !request.changes_encoder())
        }
        (Format::T485, [first, address, sum]) => {
            *first == t485::Request::MemoryRead.byte() && *sum == first ^ address
        }
        (Format::Bus, [byte]) => {
            bus::Operation::of_code(byte >> 5 & 3).is_some_and(|code| !code.changes_encoder())
        }
        _ => false,
    }
}

/// A change that was made shows.
fn check_new(change: Change, now: Held, before: Held) {
    match change {
        Change::Zero => {
            assert!(now.turns.is_none_or(|turns| turns == 0), "{now:?}");
            assert_eq!(now.angle, Some(0));
        }
        Change::ResetAngle => assert_eq!((now.angle, now.turns), (Some(0), before.turns)),
        Change::ResetTurns => assert_eq!((now.angle, now.turns), (before.angle, Some(0))),
        Change::ResetErrors => assert_eq!(now.errors, (0, false)),
        Change::Memory { data, .. } => assert_eq!(now.cell, Some(data)),
        Change::Address(address) => assert_eq!(now.address, address),
    }
}
