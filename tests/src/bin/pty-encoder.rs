//! An emulated encoder behind a pty, for page tests with real Web Serial.
//!
//! `pty-encoder --format t485 --angle-bits 23 turning=0.5`: profile parameters, then settings.
//! Prints the path of the pty's other end, then takes a setting a line from standard input:
//! `turning=R` (revolutions per second), `still=TURNS`, `noise=COUNTS`, `status=BITS`,
//! `error=0|1`, `warning=0|1`, `temperature=TENTHS`, the supply `power=off|on|set|reset`
//! (with a zero input of the IP-75 at 0 V), and the faults `echo=0|1`, `silent=0|1`, `flip=N`,
//! `drop=N`, `insert=N` (N of 1000 reply bytes), `lose=N`, `late=N`, `twice=N` (N of 1000
//! replies). `exclusive=0` lets another program open the pty, as the last close of a real port does;
//! this one is held open here. `interval=MICROSECONDS` lets a stream send so often, and `patient=1`
//! lets its bytes wait for a reader. `tell=1` prints what comes in, a line of hexadecimal digits at a time.
//! `device=ADDRESS` puts another encoder on the BUS; settings behind it
//! are for that one. The adapter runs at the baud rate that the browser has asked for: at another
//! rate than the encoder's both sides hear what a UART makes of it. The end of standard input pulls the plug. What a stream sends while nobody reads is
//! lost.

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    native::run()
}

#[cfg(not(target_arch = "wasm32"))]
mod native {
    use encoderscope::{
        emulator::{Bus, Emulator, Shaft, ZeroInput},
        profile::Profile,
        session::Micros,
    };
    use rustix::{
        event::{PollFd, PollFlags, Timespec, poll},
        fs::{Mode, OFlags, open},
        io::{Errno, ioctl_fionbio, read, write},
        pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt},
        termios::{OptionalActions, ioctl_tiocnxcl, tcgetattr, tcsetattr},
    };
    use std::{error::Error, io::Write, os::fd::OwnedFd, time::Instant};

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
        serve(
            &mut line,
            &master,
            &slave,
            patience(&settings),
            hearing(&settings),
        )
    }

    /// What becomes of bytes that nobody reads.
    #[derive(Clone, Copy, PartialEq, Eq)]
    enum Unread {
        Lost,
        Waits,
    }

    /// Whether what comes in is printed.
    #[derive(Clone, Copy, PartialEq, Eq)]
    enum Heard {
        Told,
        Kept,
    }

    fn hearing(settings: &[String]) -> Heard {
        match settings.iter().any(|setting| setting == "tell=1") {
            true => Heard::Told,
            false => Heard::Kept,
        }
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
            "patient" | "tell" => {}
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
            "temperature" => emulator.temperature = value.parse()?,
            "lose" => emulator.faults.lose = value.parse()?,
            "late" => emulator.faults.late = value.parse()?,
            "twice" => emulator.faults.twice = value.parse()?,
            "flip" => emulator.faults.flip = value.parse()?,
            "drop" => emulator.faults.drop = value.parse()?,
            "insert" => emulator.faults.insert = value.parse()?,
            _ => return Err(format!("{name} is no setting").into()),
        }
        Ok(())
    }

    fn serve(
        line: &mut Bus,
        master: &OwnedFd,
        slave: &OwnedFd,
        unread: Unread,
        heard: Heard,
    ) -> Result<(), Box<dyn Error>> {
        let start = Instant::now();
        let stdin = std::io::stdin();
        let mut buffer = [0; 4096];
        let mut text = String::new();
        loop {
            let now = start.elapsed().as_micros() as u64;
            let rate = tcgetattr(slave)?.output_speed();
            for device in &mut line.devices {
                device.faults.rate = Some(rate).filter(|rate| *rate != device.profile().baud);
            }
            let mut output = Vec::new();
            while let Some(bytes) = line.poll_output(now) {
                output.extend(bytes);
            }
            write_all(master, &output, unread)?;
            let wait = line
                .deadline()
                .map_or(100_000, |due| due.saturating_sub(now));
            let mut ready = [
                PollFd::new(master, PollFlags::IN),
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
                let count = read(master, &mut buffer)?;
                if heard == Heard::Told {
                    println!("{}", encoderscope::record::hex(&buffer[..count]));
                }
                let now = start.elapsed().as_micros() as u64;
                line.handle_input(now, &buffer[..count]);
            }
            if command.intersects(PollFlags::IN | PollFlags::HUP) {
                let count = read(&stdin, &mut buffer)?;
                if count == 0 {
                    return Ok(());
                }
                text.push_str(&String::from_utf8_lossy(&buffer[..count]));
                while let Some(end) = text.find('\n') {
                    let setting: String = text.drain(..=end).collect();
                    let now = start.elapsed().as_micros() as u64;
                    match setting.trim() {
                        "exclusive=0" => ioctl_tiocnxcl(slave)?,
                        setting => set(line, setting, now)?,
                    }
                }
            }
        }
    }

    fn write_all(master: &OwnedFd, mut bytes: &[u8], unread: Unread) -> Result<(), Errno> {
        while !bytes.is_empty() {
            match write(master, bytes) {
                Ok(count) => bytes = &bytes[count..],
                Err(Errno::AGAIN) if unread == Unread::Lost => return Ok(()),
                Err(Errno::AGAIN) => {
                    let stdin = std::io::stdin();
                    let mut ready = [
                        PollFd::new(master, PollFlags::OUT),
                        PollFd::new(&stdin, PollFlags::IN),
                    ];
                    poll(&mut ready, None)?;
                    // Being unplugged or told something comes first.
                    if !ready[1].revents().is_empty() {
                        return Ok(());
                    }
                }
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }
}
