mod laws;

use super::{Input, streams};
use encoderscope::{
    decode::Decoder,
    emulator::{Bus, Counter, Emulator, Faults, Shaft},
    format::{Format, Link, t485},
    profile::{Dialect, Parity, Profile},
    sequence::{Change, Runner},
    session::{Ask, Micros, Session},
};
use laws::Held;
use std::collections::VecDeque;

/// Events in all, and in one step: a script may ask for hours.
const BUDGET: usize = 1_500;
const STEP: usize = 200;
/// How often a host may want to act at one moment.
const SPINS: usize = 4;
/// The longest jump of the clock, and where an encoder sends all the time.
const JUMP: Micros = 1 << 40;
const STREAM_JUMP: Micros = 200_000;
/// Bytes that a session holds at most before it says what they are.
const HELD: usize = 64;
const HELD_OF_STREAM: usize = 512;

/// A script of what happens on a line, between a host and emulated encoders.
///
/// # Panics
///
/// A law is broken: a session sends what changes an encoder, or a byte that came is not reported
/// exactly once and in order; a sequence goes on after its end, or says of the encoder what is
/// not so.
pub fn session(data: &[u8]) {
    let mut input = Input(data);
    let Some(decoder) = input.decoder(&streams()) else {
        return;
    };
    let Some(mut line) = Line::new(&decoder, &mut input) else {
        return;
    };
    while !input.is_empty() && line.budget > 0 {
        line.step(&mut input);
    }
    line.finish();
}

/// A sequence that runs, and what is known of it from outside.
#[derive(Debug)]
struct Run {
    runner: Runner,
    change: Change,
    before: Held,
    sent: usize,
    done: usize,
    ended: bool,
    /// Bytes that are not the encoder's own have come since the last command.
    tainted: bool,
    /// They were taken for a reply, or the encoder was changed by hand: nothing follows.
    void: bool,
    /// Somebody else has sent commands.
    joined: bool,
}

struct Line {
    session: Session,
    run: Option<Run>,
    bus: Bus,
    now: Micros,
    /// Answers are delivered in pieces of so many bytes.
    piece: usize,
    /// What the session has got and not yet reported.
    owed: VecDeque<u8>,
    budget: usize,
    /// What the first encoder held when last anything but a session could change it.
    held: Held,
}

impl Line {
    fn new(decoder: &Decoder, input: &mut Input<'_>) -> Option<Self> {
        let profile = *decoder.profile();
        let options = input.byte();
        // The encoder may be another one than the host thinks.
        let theirs = Profile {
            dialect: Dialect::ALL[usize::from(options & 1)],
            parity: match options >> 1 & 3 {
                0 => profile.parity,
                other => Parity::ALL[usize::from(other - 1)],
            },
            ..profile
        };
        // Devices sleep through the replies of others only at the speed of the manual.
        let several = profile.format == Format::Bus && profile.baud == 2_500_000;
        let count = if several { options >> 3 & 3 } else { 0 };
        let devices = (0..=u32::from(count)).map(|index| {
            let address = (theirs.address + index) % 32;
            let shaft = Shaft::still(f64::from(input.word()) / 1024.0 - 32.0);
            let profile = Profile { address, ..theirs };
            let mut device = Emulator::new(profile, shaft).expect("a profile that fits");
            device.counter = Counter::Flash;
            device
        });
        let bus = Bus {
            devices: devices.collect(),
        };
        let session = Self::session(decoder, input)?;
        let mut line = Self {
            session,
            run: None,
            bus,
            now: Micros::from(input.word()),
            piece: usize::MAX,
            owed: VecDeque::new(),
            budget: BUDGET,
            held: Held {
                turns: None,
                angle: None,
                address: 0,
                errors: (0, false),
                cell: None,
            },
        };
        line.held = line.holds();
        Some(line)
    }

    fn session(decoder: &Decoder, input: &mut Input<'_>) -> Option<Session> {
        let interval = Micros::from(input.word()) * 16;
        let some = usize::from(input.byte() & 3);
        let addresses = input.take(some);
        if decoder.profile().format == Format::Bus && !addresses.is_empty() {
            return Session::of_devices(decoder.clone(), addresses, interval).ok();
        }
        Session::new(decoder.clone(), interval).ok()
    }

    fn profile(&self) -> &Profile {
        self.session.decoder().profile()
    }

    fn is_stream(&self) -> bool {
        self.profile().link() == Link::Stream
    }

    fn longest(&self) -> Micros {
        if self.is_stream() { STREAM_JUMP } else { JUMP }
    }

    fn device(&mut self) -> &mut Emulator {
        &mut self.bus.devices[0]
    }

    /// One step of the script.
    fn step(&mut self, input: &mut Input<'_>) {
        let what = input.byte();
        let how = what >> 4;
        match what & 0x0f {
            0 | 1 => self.run_for(1_000 << how),
            2 => {
                let longest = if self.is_stream() {
                    STREAM_JUMP
                } else {
                    1 << 40
                };
                self.now += (Micros::from(input.byte()) << (2 * how)).min(longest);
            }
            3 => {
                let bytes = input.take(usize::from(how));
                self.arrive(bytes, true);
            }
            4 => {
                let mut values = self.bus.devices[0].values(self.now);
                values.count = Some(how);
                values.operation = Some(input.byte() & 0x0f);
                let bytes = self.session.decoder().encode(&values).into_bytes();
                self.arrive(&bytes, true);
            }
            5 => self.disturb(input),
            6 => self.piece = usize::from(how).wrapping_sub(1).max(1),
            7 => self.ask(input),
            8 => {
                let now = self.now;
                self.device().power_off(now);
            }
            9 => {
                let now = self.now;
                self.device().power_on(now, None);
            }
            10 => self.begin(input),
            11 => {
                if let Some(run) = &mut self.run {
                    run.runner.stop();
                }
                self.drain();
            }
            12 => {
                let bytes = input.take(usize::from(how) + 1);
                for _ in 0..=how {
                    self.bus.handle_input(self.now, bytes);
                }
                if let Some(run) = &mut self.run {
                    run.joined = true;
                }
                self.held = self.holds();
            }
            13 => {
                let turns = f64::from(input.word() as i16) / 1024.0;
                let now = self.now;
                // Without power it would lose count.
                self.device().power_on(now, None);
                self.device().shaft.start += turns;
                self.device().status = how;
                self.device().error = how & 1 == 1;
                self.void();
                self.held = self.holds();
            }
            14 => {
                let decoder = self.session.decoder().clone();
                if let Some(session) = Self::session(&decoder, input) {
                    self.session = session;
                    self.owed.clear();
                }
            }
            _ => self.run_for(100_000 << how),
        }
    }

    fn disturb(&mut self, input: &mut Input<'_>) {
        let which = input.byte();
        let rate = u32::from(input.byte()) * 4;
        let some = |place: u32| which >> place & 1 == 1;
        let rated = |place: u32| if some(place) { rate } else { 0 };
        // Encoders on one bus would take an echo, a late or a second reply for requests.
        let alone = self.bus.devices.len() == 1;
        self.device().faults = Faults {
            echo: some(0) && alone,
            silent: some(1),
            unplugged: some(2) && rate > 512,
            flip: rated(2),
            drop: rated(3),
            insert: rated(4),
            lose: rated(5),
            late: if alone { rated(6) } else { 0 },
            twice: if alone { rated(7) } else { 0 },
            ..Faults::default()
        };
    }

    fn ask(&mut self, input: &mut Input<'_>) {
        let decoder = self.session.decoder();
        let which = input.byte();
        let argument = input.byte();
        let asked = match which & 3 {
            0 => Ask::position(decoder),
            1 => Ask::device(decoder, argument),
            _ => {
                let request = t485::Request::ALL[usize::from(which >> 2) % 9];
                Ask::t485(decoder, request, argument)
            }
        };
        // What belongs to another format is refused.
        let _ = asked.map(|asked| self.session.ask(asked));
    }

    /// Begins a sequence; while it runs, the session rests.
    fn begin(&mut self, input: &mut Input<'_>) {
        let (argument, change, data) = (input.byte(), input.byte(), input.byte());
        let change = match change % 6 {
            0 => Change::Zero,
            1 => Change::ResetAngle,
            2 => Change::ResetTurns,
            3 => Change::ResetErrors,
            4 => Change::Memory {
                address: argument,
                data,
            },
            _ => Change::Address(argument),
        };
        if self.run.is_some() {
            return;
        }
        if change == Change::ResetErrors {
            self.device().status = 0x15;
            self.device().error = true;
            self.held = self.holds();
        }
        let before = match change {
            Change::Memory { address, .. } => self.read(address),
            _ => self.holds(),
        };
        let Some(runner) = Runner::new(self.session.decoder(), change, self.now) else {
            return;
        };
        let mut addresses: Vec<u8> = self.bus.devices.iter().map(Emulator::address).collect();
        addresses.sort_unstable();
        addresses.dedup();
        self.run = Some(Run {
            runner,
            change,
            before,
            sent: 0,
            done: 0,
            ended: false,
            tainted: false,
            // Only one device may be on the wire when an address is set.
            void: addresses.len() < self.bus.devices.len()
                || matches!(change, Change::Address(_)) && addresses.len() > 1,
            joined: false,
        });
    }

    fn run_for(&mut self, time: Micros) {
        let until = self.now + time.min(self.longest());
        let mut spins = 0;
        for _ in 0..STEP.min(self.budget) {
            self.budget -= 1;
            self.serve();
            let host = match &self.run {
                Some(run) => run.runner.deadline(),
                None => self.session.deadline(),
            };
            let line = self.bus.deadline().unwrap_or(Micros::MAX);
            let next = host.min(line);
            if next > until {
                break;
            }
            spins = if next > self.now || line <= self.now {
                0
            } else {
                spins + 1
            };
            assert!(spins < SPINS, "time stands still at {}", self.now);
            self.now = self.now.max(next);
        }
        self.now = self.now.max(until);
    }

    fn serve(&mut self) {
        match &mut self.run {
            Some(run) => run.runner.handle_timeout(self.now),
            None => self.session.handle_timeout(self.now),
        }
        self.drain();
        while let Some(bytes) = self.bus.poll_output(self.now) {
            let faults = &self.bus.devices[0].faults;
            let disturbed = faults.flip + faults.drop + faults.insert > 0;
            for piece in bytes.chunks(self.piece) {
                self.arrive(piece, disturbed);
            }
        }
    }

    /// Bytes come to the host.
    fn arrive(&mut self, bytes: &[u8], tainted: bool) {
        match &mut self.run {
            Some(run) => {
                run.tainted |= tainted;
                run.runner.handle_input(self.now, bytes);
            }
            None => {
                self.owed.extend(bytes);
                self.session.handle_input(self.now, bytes);
            }
        }
        self.drain();
        let held = if self.is_stream() {
            HELD_OF_STREAM
        } else {
            HELD
        };
        assert!(self.owed.len() <= held, "{} bytes held", self.owed.len());
    }

    fn drain(&mut self) {
        while let Some(output) = self.session.poll_output() {
            self.check_output(output);
        }
        while let Some(mut run) = self.run.take() {
            let Some(event) = run.runner.poll_output() else {
                if run.ended {
                    self.check_end(&mut run);
                } else {
                    self.run = Some(run);
                }
                break;
            };
            self.check_event(&mut run, event);
            self.run = Some(run);
        }
    }

    fn void(&mut self) {
        if let Some(run) = &mut self.run {
            run.void = true;
        }
    }

    /// What a session still holds comes out when nothing more comes in.
    fn finish(&mut self) {
        if let Some(mut run) = self.run.take() {
            run.runner.stop();
            self.run = Some(run);
            self.drain();
            assert!(self.run.is_none());
        } else if self.bus.devices.len() == 1 {
            assert_eq!(self.holds(), self.held, "a session has changed the encoder");
        }
        if self.is_stream() {
            return;
        }
        self.bus.devices.clear();
        for _ in 0..3 {
            self.now = self.now.max(self.session.deadline());
            self.session.handle_timeout(self.now);
            while let Some(output) = self.session.poll_output() {
                self.check_output(output);
            }
        }
        assert!(self.owed.is_empty(), "{:?} never came out", self.owed);
    }
}
