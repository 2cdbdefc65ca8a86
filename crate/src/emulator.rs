//! The encoder's side: speaks every format as the manuals say, with a moving shaft and faults.
//!
//! Feed requests to [`Emulator::handle_input`] and take what it sends from
//! [`Emulator::poll_output`] when its last bit has left the wire; read clocked formats with
//! [`Emulator::clock`]. Time is in microseconds.

mod answers;
mod bus;
mod counter;
mod shaft;
mod uart;
mod wire;

pub use bus::Bus;
pub use counter::{Battery, Counter, Direction, ZeroInput};
pub use shaft::Shaft;
pub use uart::heard;
pub use wire::{Faults, Sent};

use crate::{
    bits::{self, BitString},
    decode::Decoder,
    format::{Format, Link, STATUS, t485},
    layout::StatusBit,
    profile::{Dialect, Profile, ProfileError},
    reading::Values,
    session::Micros,
};
use alloc::{vec, vec::Vec};
pub(crate) use answers::TURNAROUND;
use answers::Talk;
use counter::Scales;
use shaft::split;
use wire::Wire;

/// An encoder answers this long after power-on (MPP and PT, "start-up"; IP-75: 0.15 s at most).
const START_UP: Micros = 15_000;
/// The zero inputs of the IP-75 act this long after power-on (IP-75, 5.1.1).
const ZERO_INPUT: Micros = 3_000_000;
/// Frames of a stream are kept this long for a reader that is slow.
const CATCH_UP: Micros = 1_000_000;
/// A clocked word stays latched this long after its last bit (P+F article, t_m; IP-75, T_mu).
const LATCHED: Micros = 20;

/// An encoder.
///
/// ```
/// use encoderscope::{emulator::{Emulator, Shaft}, profile::Profile};
/// let profile = Profile::parse([("format", "rs485"), ("turns-bits", "0"), ("command", "1")])?;
/// let mut encoder = Emulator::new(profile, Shaft::still(0.5))?;
/// encoder.handle_input(0, &[0x31]);
/// assert_eq!(encoder.poll_output(1_000).unwrap()[..3], [0x80, 0x00, 0x00]);
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Debug)]
pub struct Emulator {
    decoder: Decoder,
    /// How the shaft moves.
    pub shaft: Shaft,
    /// Counts by which the angle may be off to either side, at random.
    pub noise: u32,
    /// What goes wrong on the way.
    pub faults: Faults,
    /// Microseconds between the frames of a stream; those of the manual where it is nothing.
    pub interval: Option<Micros>,
    /// The status bits; those of the battery are added.
    pub status: u8,
    /// The position is not valid.
    pub error: bool,
    /// Something is near its limit.
    pub warning: bool,
    /// Degrees Celsius × 10.
    pub temperature: i32,
    /// How the turns are kept without power.
    pub counter: Counter,
    /// The battery of a BM model.
    pub battery: Battery,
    /// In which direction the code rises.
    pub direction: Direction,
    scales: Scales,
    /// No zero has been set through the inputs of the IP-75.
    zero_default: bool,
    /// When a zero input acts, and which.
    zero_input: Option<(Micros, ZeroInput)>,
    /// The turns were lost while there was no power.
    turns_lost: bool,
    /// Where the shaft was when the power went; `None` while it is on.
    off_at: Option<f64>,
    ready_at: Micros,
    talk: Talk,
    /// When the next frame of a stream begins; at once while nobody has listened.
    next_frame: Option<Micros>,
    latched: Option<(Micros, BitString)>,
    wire: Wire,
    sent: Sent,
}

impl Emulator {
    /// An encoder that is well and has been on for a while.
    ///
    /// # Errors
    ///
    /// A parameter of the profile is out of range.
    pub fn new(profile: Profile, shaft: Shaft) -> Result<Self, ProfileError> {
        Ok(Self {
            decoder: Decoder::new(profile)?,
            shaft,
            noise: 0,
            faults: Faults::default(),
            interval: None,
            status: 0,
            error: false,
            warning: false,
            temperature: 312,
            counter: Counter::Volatile,
            battery: Battery::Good,
            direction: Direction::Up,
            scales: Scales::default(),
            zero_default: true,
            zero_input: None,
            turns_lost: false,
            off_at: None,
            ready_at: 0,
            talk: Talk::new(&profile),
            next_frame: None,
            latched: None,
            wire: Wire::new(),
            sent: Sent::default(),
        })
    }

    /// The profile.
    #[must_use]
    pub const fn profile(&self) -> &Profile {
        self.decoder.profile()
    }

    /// The address that a BUS encoder answers to.
    #[must_use]
    pub const fn address(&self) -> u8 {
        self.talk.address
    }

    /// The byte that a cell of the EEPROM holds; `None` beyond its 128 cells.
    #[must_use]
    pub fn memory(&self, address: u8) -> Option<u8> {
        self.talk.memory.get(usize::from(address)).copied()
    }

    /// What it has sent, and what became of it on the way.
    ///
    /// ```
    /// use encoderscope::{emulator::{Emulator, Shaft}, profile::Profile};
    /// let mut encoder = Emulator::new(Profile::parse([("format", "t485")])?, Shaft::still(0.5))?;
    /// encoder.faults.flip = 1000;
    /// encoder.handle_input(0, &[0x1a]);
    /// assert_eq!((encoder.sent().whole, encoder.sent().damaged), (0, 1));
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    #[must_use]
    pub const fn sent(&self) -> &Sent {
        &self.sent
    }

    /// When the next bytes are due.
    #[must_use]
    pub fn deadline(&self) -> Option<Micros> {
        let stream = self.is_streaming().then_some(self.next_frame.unwrap_or(0));
        match (self.wire.deadline(), stream) {
            (Some(sent), Some(next)) => Some(sent.min(next)),
            (sent, next) => sent.or(next),
        }
    }

    /// The next bytes that have left the wire by `now`.
    pub fn poll_output(&mut self, now: Micros) -> Option<Vec<u8>> {
        self.stream(now);
        let bytes = self.wire.take(now)?;
        (!self.faults.unplugged).then_some(bytes)
    }

    /// What was sent by `now` gets lost: nobody had the port open.
    pub fn drop_unread(&mut self, now: Micros) {
        self.stream(now);
        self.wire.drop_all();
    }

    /// The host has sent `bytes`.
    pub fn handle_input(&mut self, now: Micros, bytes: &[u8]) {
        if self.faults.unplugged {
            return;
        }
        let polled = self.profile().link() == Link::Polled;
        let baud = self.profile().baud;
        let rate = self.faults.rate.unwrap_or(baud);
        if self.faults.echo && rate != baud {
            self.wire.send(&self.faults, now, rate, bytes, &[]);
        }
        for byte in &heard(bytes, rate, baud) {
            let echoes = self.faults.echo && rate == baud;
            let echo: &[u8] = if echoes { &[*byte] } else { &[] };
            let hears = polled && self.is_on(now) && !self.faults.silent;
            let reply = match hears {
                true => self.answer(now, *byte),
                false => Vec::new(),
            };
            self.send(now + TURNAROUND, echo, &reply);
        }
    }

    /// Clocks out `count` bits of a clocked format; what a master sees from the first bit on.
    ///
    /// Within the time-out after a word the same word comes again, and a master that keeps
    /// clocking an SSI encoder gets it again behind a 0 (multi-transmission).
    ///
    /// ```
    /// use encoderscope::{emulator::{Emulator, Shaft}, profile::Profile};
    /// let profile = Profile::parse([("format", "ssi7")])?;
    /// let mut encoder = Emulator::new(profile, Shaft::still(0.5))?;
    /// assert_eq!(encoder.clock(0, 30).as_bits().bytes(), [0x00, 0x02, 0x00, 0x08]);
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    pub fn clock(&mut self, now: Micros, count: usize) -> BitString {
        let off = self.faults.silent || self.faults.unplugged || !self.is_on(now);
        let word = match self.latched.take() {
            Some((until, word)) if now <= until => word,
            _ => self.decoder.encode(&self.values(now)),
        };
        let rings = self.profile().format == Format::SsiTree;
        // In the gap behind its word the data line of an IP-75 is the error flag.
        let gap = self.profile().format == Format::Ssi7 && self.error;
        let len = word.as_bits().len();
        let mut out = BitString::default();
        for index in 0..count {
            let at = if rings { index % (len + 1) } else { index };
            out.push(off || word.as_bits().bit(at) || gap && at >= len);
        }
        self.latched = Some((now + LATCHED, word));
        let flips = Faults {
            drop: 0,
            double: 0,
            insert: 0,
            ..self.faults
        };
        let bytes = self.wire.disturbed(&flips, out.as_bits().bytes());
        for (index, byte) in bytes.iter().enumerate() {
            out.write(bits::Span::new(index * 8, 8), u64::from(*byte));
        }
        out
    }

    /// The power goes; what the shaft does meanwhile, only a battery counts.
    pub fn power_off(&mut self, now: Micros) {
        self.settle(now);
        self.off_at.get_or_insert(self.shaft.at(now));
        self.wire.drop_all();
        self.latched = None;
        self.zero_input = None;
    }

    /// The power comes back, with a zero input of the IP-75 tied to ground or with none.
    pub fn power_on(&mut self, now: Micros, input: Option<ZeroInput>) {
        let Some(off) = self.off_at.take() else {
            return;
        };
        let shaft = self.shaft.at(now);
        let mechanical = self.profile().format == Format::SsiTree;
        self.turns_lost = false;
        if self.profile().turns_bits > 0 && !mechanical {
            let slip = counter::slipped(self.counter, self.battery, off, shaft);
            let lost = split(self.scales.position(shaft, self.direction)).0 as f64;
            self.scales.shift(slip.unwrap_or(lost), self.direction);
            self.turns_lost = self.counter == Counter::Battery && slip.is_none();
        }
        if self.faults.zeros > 0 {
            self.wire.arrive(now, vec![0; self.faults.zeros]);
        }
        self.ready_at = now + START_UP;
        self.next_frame = Some(self.ready_at);
        self.zero_input = input.map(|input| (now + ZERO_INPUT, input));
        self.talk = self.talk.restarted(self.decoder.profile());
    }

    /// The input PRESET1 of a P+F encoder: the present position becomes 0.
    pub fn preset(&mut self, now: Micros) {
        self.scales.preset(self.shaft.at(now), self.direction);
    }

    /// The numbers of this moment.
    #[must_use]
    pub fn values(&self, now: Micros) -> Values {
        let profile = self.profile();
        let (turns, part) = split(self.scales.position(self.shaft.at(now), self.direction));
        let codes = bits::codes(profile.angle_bits);
        let (turns, angle) = shaft::noisy(now, self.noise, codes, turns, part);
        let (battery, battery_error, battery_warning) = self.battery_status();
        let shown = self.status | battery;
        let (status, alarm) = match (profile.format, profile.dialect) {
            (Format::T485, Dialect::Mpp) => (0, carried(shown, STATUS, t485::ALARM)),
            (Format::T485, Dialect::Tamagawa) => (0, carried(shown, STATUS, t485::TAMAGAWA_ALARM)),
            _ => (shown, 0),
        };
        let wide = bits::slice(turns as u64, 0, profile.turns_bits as usize);
        Values {
            turns: Some(wide as i64),
            angle: Some(angle),
            error: Some(self.error || battery_error),
            warning: Some(self.warning || battery_warning),
            zero_default: Some(self.zero_default),
            status: Some(status),
            alarm: Some(alarm),
            enid: Some(if profile.angle_bits == 17 { 0x11 } else { 0x17 }),
            speed: Some((self.shaft.speed_at(now) * 10.0) as i32),
            temperature: Some(self.temperature),
            address: Some(self.talk.address),
            count: Some(self.talk.counted),
            ..Values::default()
        }
    }

    /// The battery's status bits, and whether they are an error or a warning.
    fn battery_status(&self) -> (u8, bool, bool) {
        if self.counter != Counter::Battery {
            return (0, false, false);
        }
        let bit = |name| bits::low_byte(StatusBit::named(STATUS, name));
        let low = bit("battery low");
        let lost = bit("battery disconnected");
        let (bits, error, warning) = match self.battery {
            Battery::Good => (0, false, false),
            Battery::Low => (low, false, true),
            Battery::Empty => (low, true, false),
            Battery::Absent => (lost, true, false),
        };
        match self.turns_lost {
            true => (bits | lost, true, warning),
            false => (bits, error, warning),
        }
    }

    fn is_on(&self, now: Micros) -> bool {
        self.off_at.is_none() && now >= self.ready_at
    }

    fn is_streaming(&self) -> bool {
        let stream = self.profile().link() == Link::Stream;
        stream && self.off_at.is_none() && !self.faults.silent && !self.faults.unplugged
    }

    /// Sends the frames of a stream that begin by `now`.
    fn stream(&mut self, now: Micros) {
        self.settle(now);
        let Some(usual) = self.profile().format.interval() else {
            return;
        };
        let interval = self.interval.unwrap_or(usual).max(1);
        // A stream that was held up does not catch up for longer than this.
        let oldest = now.saturating_sub(CATCH_UP);
        let mut next = self.next_frame.unwrap_or(now).max(oldest);
        if !self.is_streaming() {
            self.next_frame = Some(next.max(now));
            return;
        }
        while next <= now {
            let frame = self.decoder.encode(&self.values(next)).into_bytes();
            self.send(next, &[], &frame);
            next += interval;
        }
        self.next_frame = Some(next);
    }

    /// Puts a reply on the wire, behind the echo of its request.
    fn send(&mut self, start: Micros, echo: &[u8], reply: &[u8]) {
        let baud = self.profile().baud;
        let arrives = self.wire.send(&self.faults, start, baud, echo, reply);
        if !reply.is_empty() {
            let decoder = &self.decoder;
            let holds = |bytes: &[u8]| decoder.frame(bytes).is_some_and(|frame| frame.ok());
            self.sent.count(reply, &arrives, holds);
        }
    }

    /// Lets a zero input act when its time has come.
    fn settle(&mut self, now: Micros) {
        let Some((at, input)) = self.zero_input.filter(|(at, _)| *at <= now) else {
            return;
        };
        self.zero_input = None;
        self.zero_default = input == ZeroInput::Reset;
        self.scales = Scales::default();
        if input == ZeroInput::Set {
            self.scales.shift(self.shaft.at(at), Direction::Up);
        }
    }
}

/// The bits of `from` that are set in `value`, at the places that `to` gives their names.
fn carried(value: u8, from: &[StatusBit], to: &[StatusBit]) -> u8 {
    let set = from.iter().filter(|bit| bits::bit(value.into(), bit.place));
    bits::low_byte(set.fold(0, |sum, bit| sum | StatusBit::named(to, bit.name)))
}
