//! An emulated encoder behind a pty, for page tests with real Web Serial.
//!
//! `pty-encoder --format t485 --angle-bits 23 turning=0.5`: profile parameters, then settings.
//! Prints the path of the pty's other end, then takes a setting a line from standard input:
//! `turning=R` (revolutions per second), `still=TURNS`, `noise=COUNTS`, `status=BITS`,
//! `error=0|1`, `warning=0|1`, `temperature=TENTHS`, the supply `power=off|on|set|reset`
//! (with a zero input of the IP-75 at 0 V), `counter=volatile|flash` (what becomes of the turns
//! without it), and the faults `echo=0|1`, `silent=0|1`, `flip=N`,
//! `drop=N`, `double=N`, `insert=N` (N of 1000 reply bytes), `lose=N`, `late=N`, `twice=N` (N of
//! 1000 replies), `delay=MICROSECONDS`, `jitter=MICROSECONDS` (of every reply), `zeros=BYTES` (at
//! power-on). `exclusive=0` lets another program open the pty, as the last close of a real port does;
//! this one is held open here. `interval=MICROSECONDS` lets a stream send so often, and `patient=1`
//! lets its bytes wait for a reader. `device=ADDRESS` puts another encoder on the BUS; settings behind it
//! are for that one. The adapter runs at the baud rate that the browser has asked for: at another
//! rate than the encoder's both sides hear what a UART makes of it. What a stream sends while nobody
//! reads is lost.
//!
//! The end of standard input pulls the plug. `unplug-heard=N` pulls it when the Nth command after
//! a pause, or after reading, has been heard, before an answer gets out, and `unplug-answered=N` when the answer to it
//! has been read.
//!
//! `tell` prints what it knows as a line of JSON, and so does the plug when it is pulled: bytes
//! `heard`, their `kinds` (each byte once), those `changing` that are part of a command that changes
//! an encoder, bytes `sent`, bytes `unread` that were lost because nobody read, replies sent `whole`
//! and `damaged` and those `passing` for good, and what the encoder holds: `turns`, `angle`,
//! `address`, `error`, `memory`.

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    native::run()
}

#[cfg(not(target_arch = "wasm32"))]
mod native {
    use encoderscope::{
        emulator::{Bus, Counter, Emulator, Sent, Shaft, ZeroInput},
        profile::Profile,
        sequence::danger,
        session::Micros,
    };
    use rustix::{
        event::{PollFd, PollFlags, Timespec, poll},
        fs::{Mode, OFlags, open},
        io::{Errno, ioctl_fionbio, ioctl_fionread, read, write},
        pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt},
        termios::{OptionalActions, ioctl_tiocnxcl, tcgetattr, tcsetattr},
    };
    use std::{collections::BTreeSet, error::Error, io::Write, os::fd::OwnedFd, time::Instant};

    pub(crate) fn run() -> Result<(), Box<dyn Error>> {
        let (parameters, settings) = arguments()?;
        let pairs = parameters
            .iter()
            .map(|(name, value)| (name.as_str(), value.as_str()));
        let first = Emulator::new(Profile::parse(pairs)?, Shaft::still(0.0))?;
        let mut line = Bus {
            devices: vec![first],
        };
        for setting in &settings {
            set(&mut line, setting, 0)?;
        }

        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        ioctl_fionbio(&master, true)?;
        grantpt(&master)?;
        unlockpt(&master)?;
        let path = ptsname(&master, Vec::new())?;
        // Held open so that the pty stays raw, and readable while no browser has it.
        let slave = open(
            path.as_c_str(),
            OFlags::RDWR | OFlags::NOCTTY,
            Mode::empty(),
        )?;
        let mut raw = tcgetattr(&slave)?;
        raw.make_raw();
        tcsetattr(&slave, OptionalActions::Now, &raw)?;
        println!("{}", path.to_str()?);
        std::io::stdout().flush()?;
        let mut port = Port {
            master,
            slave,
            unread: patience(&settings),
            counts: Counts::default(),
        };
        let end = serve(&mut line, &mut port)?;
        port.counts.tell(&line, end)
    }

    /// The adapter's end of the pty, and the other one, held open.
    struct Port {
        master: OwnedFd,
        slave: OwnedFd,
        unread: Unread,
        counts: Counts,
    }

    /// Bytes that went by.
    #[derive(Default)]
    struct Counts {
        heard: u64,
        kinds: BTreeSet<u8>,
        changing: u64,
        sent: u64,
        unread: u64,
    }

    impl Counts {
        fn hear(&mut self, profile: &Profile, bytes: &[u8]) {
            self.heard += bytes.len() as u64;
            self.kinds.extend(bytes);
            let changing = |byte: &&u8| danger(profile, &[**byte]).is_some();
            self.changing += bytes.iter().filter(changing).count() as u64;
        }

        fn tell(&self, line: &Bus, now: Micros) -> Result<(), Box<dyn Error>> {
            let Self {
                heard,
                kinds,
                changing,
                sent,
                unread,
            } = self;
            let kinds: Vec<u8> = kinds.iter().copied().collect();
            let all = |count: fn(&Sent) -> u64| -> u64 {
                line.devices.iter().map(|one| count(one.sent())).sum()
            };
            let (whole, damaged) = (all(|sent| sent.whole), all(|sent| sent.damaged));
            let passing = all(|sent| sent.passing);
            let encoder = line.devices.last().ok_or("no encoder")?;
            let values = encoder.values(now);
            let (turns, angle) = (values.turns.unwrap_or(0), values.angle.unwrap_or(0));
            let (address, error) = (encoder.address(), encoder.error);
            let memory: Vec<u8> = (0..=u8::MAX)
                .map_while(|cell| encoder.memory(cell))
                .collect();
            println!(
                "{{\"heard\":{heard},\"kinds\":{kinds:?},\"changing\":{changing},\"sent\":{sent},\"unread\":{unread},\
                 \"whole\":{whole},\"damaged\":{damaged},\"passing\":{passing},\
                 \"turns\":{turns},\"angle\":{angle},\"address\":{address},\"error\":{error},\
                 \"memory\":{memory:?}}}"
            );
            Ok(std::io::stdout().flush()?)
        }
    }

    /// A line that says nothing for so long is between two conversations: a sequence waits longer
    /// before its first command. A scan does not, but asks for something else than what is read.
    const PAUSE: Micros = 80_000;
    /// What comes sooner after what came before is read on: the pause was one of a busy machine. The
    /// commands of a sequence and of a scan are further apart.
    const APART: Micros = 10_000;
    /// Bytes are known to have been read when none wait so long after they were sent.
    const READ_BY: Micros = 5_000;

    /// When the plug is pulled.
    struct Plug {
        moment: Moment,
        /// Commands to be heard, and those that are left.
        count: u32,
        left: u32,
        /// Reading has ended.
        begun: bool,
        heard: Vec<u8>,
        heard_at: Micros,
        sent_at: Micros,
    }

    #[derive(Clone, Copy, PartialEq, Eq)]
    enum Moment {
        Heard,
        Answered,
    }

    impl Plug {
        fn new(moment: Moment, count: u32, now: Micros) -> Self {
            Self {
                moment,
                count,
                left: count,
                begun: false,
                heard: Vec::new(),
                heard_at: now,
                sent_at: 0,
            }
        }

        /// A command has been heard: what is sent at once comes at once.
        fn hear(&mut self, now: Micros, bytes: &[u8]) {
            let other = !self.heard.is_empty() && self.heard != bytes;
            let quiet = now - self.heard_at;
            if quiet < APART {
                self.begun = false;
                self.left = self.count;
            }
            self.begun |= other || quiet >= PAUSE;
            self.heard = bytes.into();
            self.heard_at = now;
            if self.begun {
                self.left = self.left.saturating_sub(1);
            }
        }
    }

    /// What becomes of bytes that nobody reads.
    #[derive(Clone, Copy, PartialEq, Eq)]
    enum Unread {
        Lost,
        Waits,
    }

    fn patience(settings: &[String]) -> Unread {
        match settings.iter().any(|setting| setting == "patient=1") {
            true => Unread::Waits,
            false => Unread::Lost,
        }
    }

    type Arguments = (Vec<(String, String)>, Vec<String>);

    fn arguments() -> Result<Arguments, Box<dyn Error>> {
        let mut parameters = Vec::new();
        let mut settings = Vec::new();
        let mut words = std::env::args().skip(1);
        while let Some(word) = words.next() {
            match word.strip_prefix("--") {
                Some(name) => {
                    let value = words
                        .next()
                        .ok_or_else(|| format!("--{name} needs a value"))?;
                    parameters.push((name.to_owned(), value));
                }
                None => settings.push(word),
            }
        }
        Ok((parameters, settings))
    }

    fn set(line: &mut Bus, setting: &str, now: Micros) -> Result<(), Box<dyn Error>> {
        let (name, value) = setting
            .trim()
            .split_once('=')
            .ok_or("a setting is name=value")?;
        let emulator = line.devices.last_mut().ok_or("no encoder")?;
        if name == "device" {
            let profile = emulator.profile().with("address", value)?;
            line.devices
                .push(Emulator::new(profile, Shaft::still(0.0))?);
            return Ok(());
        }
        match name {
            "turning" => emulator.shaft = Shaft::turning(emulator.shaft.start, value.parse()?),
            "still" => emulator.shaft = Shaft::still(value.parse()?),
            "interval" => emulator.interval = Some(value.parse()?),
            "patient" => {}
            "noise" => emulator.noise = value.parse()?,
            "status" => emulator.status = value.parse()?,
            "error" => emulator.error = value == "1",
            "warning" => emulator.warning = value == "1",
            "echo" => emulator.faults.echo = value == "1",
            "silent" => emulator.faults.silent = value == "1",
            "power" => match value {
                "off" => emulator.power_off(now),
                "on" => emulator.power_on(now, None),
                "set" => emulator.power_on(now, Some(ZeroInput::Set)),
                "reset" => emulator.power_on(now, Some(ZeroInput::Reset)),
                _ => return Err(format!("{value} is no supply").into()),
            },
            "counter" => {
                emulator.counter = match value {
                    "volatile" => Counter::Volatile,
                    "flash" => Counter::Flash,
                    _ => return Err(format!("{value} is no counter").into()),
                }
            }
            "temperature" => emulator.temperature = value.parse()?,
            "lose" => emulator.faults.lose = value.parse()?,
            "late" => emulator.faults.late = value.parse()?,
            "twice" => emulator.faults.twice = value.parse()?,
            "delay" => emulator.faults.delay = value.parse()?,
            "jitter" => emulator.faults.jitter = value.parse()?,
            "zeros" => emulator.faults.zeros = value.parse()?,
            "flip" => emulator.faults.flip = value.parse()?,
            "drop" => emulator.faults.drop = value.parse()?,
            "double" => emulator.faults.double = value.parse()?,
            "insert" => emulator.faults.insert = value.parse()?,
            _ => return Err(format!("{name} is no setting").into()),
        }
        Ok(())
    }

    /// Until the plug is pulled; returns when that was.
    fn serve(line: &mut Bus, port: &mut Port) -> Result<Micros, Box<dyn Error>> {
        let start = Instant::now();
        let stdin = std::io::stdin();
        let mut buffer = [0; 4096];
        let mut text = String::new();
        let mut plug: Option<Plug> = None;
        loop {
            let now = start.elapsed().as_micros() as u64;
            follow_rate(line, port)?;
            let mut output = Vec::new();
            while let Some(bytes) = line.poll_output(now) {
                output.extend(bytes);
            }
            let mut wait = line
                .deadline()
                .map_or(100_000, |due| due.saturating_sub(now));
            if let Some(plug) = plug.as_mut().filter(|plug| plug.left == 0) {
                if plug.moment == Moment::Heard {
                    return Ok(now);
                }
                if !output.is_empty() {
                    plug.sent_at = now;
                }
                let read = now > plug.sent_at + READ_BY && ioctl_fionread(&port.slave)? == 0;
                if read && line.deadline().is_none() {
                    return Ok(now);
                }
                wait = wait.min(1_000);
            }
            write_all(port, &output)?;
            let mut ready = [
                PollFd::new(&port.master, PollFlags::IN),
                PollFd::new(&stdin, PollFlags::IN),
            ];
            let timeout = Timespec {
                tv_sec: 0,
                tv_nsec: wait as i64 * 1000,
            };
            if let Err(error) = poll(&mut ready, Some(&timeout))
                && error != Errno::INTR
            {
                return Err(error.into());
            }
            let (input, command) = (ready[0].revents(), ready[1].revents());
            if input.contains(PollFlags::IN) {
                let count = read(&port.master, &mut buffer)?;
                let now = start.elapsed().as_micros() as u64;
                let bytes = &buffer[..count];
                if let Some(first) = line.devices.first() {
                    port.counts.hear(first.profile(), bytes);
                }
                // It may have been opened while this waited.
                follow_rate(line, port)?;
                line.handle_input(now, bytes);
                if let Some(plug) = &mut plug {
                    plug.hear(now, bytes);
                }
            }
            if command.intersects(PollFlags::IN | PollFlags::HUP) {
                let count = read(&stdin, &mut buffer)?;
                if count == 0 {
                    return Ok(now);
                }
                text.push_str(&String::from_utf8_lossy(&buffer[..count]));
                while let Some(end) = text.find('\n') {
                    let setting: String = text.drain(..=end).collect();
                    let now = start.elapsed().as_micros() as u64;
                    let setting = setting.trim();
                    let pulled = |name| setting.strip_prefix(name).map(str::parse);
                    if let Some(count) = pulled("unplug-heard=") {
                        plug = Some(Plug::new(Moment::Heard, count?, now));
                    } else if let Some(count) = pulled("unplug-answered=") {
                        plug = Some(Plug::new(Moment::Answered, count?, now));
                    } else if setting == "tell" {
                        port.counts.tell(line, now)?;
                    } else if setting == "exclusive=0" {
                        ioctl_tiocnxcl(&port.slave)?;
                    } else {
                        set(line, setting, now)?;
                    }
                }
            }
        }
    }

    /// The adapter runs at the rate that it was opened with.
    fn follow_rate(line: &mut Bus, port: &Port) -> Result<(), Errno> {
        let rate = tcgetattr(&port.slave)?.output_speed();
        for device in &mut line.devices {
            device.faults.rate = Some(rate).filter(|rate| *rate != device.profile().baud);
        }
        Ok(())
    }

    fn write_all(port: &mut Port, mut bytes: &[u8]) -> Result<(), Errno> {
        while !bytes.is_empty() {
            match write(&port.master, bytes) {
                Ok(count) => {
                    port.counts.sent += count as u64;
                    bytes = &bytes[count..];
                }
                Err(Errno::AGAIN) if port.unread == Unread::Lost => {
                    port.counts.unread += bytes.len() as u64;
                    return Ok(());
                }
                Err(Errno::AGAIN) => {
                    let stdin = std::io::stdin();
                    let mut ready = [
                        PollFd::new(&port.master, PollFlags::OUT),
                        PollFd::new(&stdin, PollFlags::IN),
                    ];
                    poll(&mut ready, None)?;
                    // Being unplugged or told something comes first.
                    if !ready[1].revents().is_empty() {
                        port.counts.unread += bytes.len() as u64;
                        return Ok(());
                    }
                }
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }
}
