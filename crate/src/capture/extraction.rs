//! The frames of a recording, from its changes.

use super::{
    Capture, Changes, Clocked, Edge, Options, Reason, Recording, Signal, Unreadable, Wire, Wires,
    changes::Place, wires::choose,
};
use crate::decode::Decoder;
use alloc::{string::ToString, vec::Vec};

/// Frames of a recording that are kept.
pub(super) const MOST_FRAMES: usize = 200_000;

/// Chooses the wires of a recording and takes the frames from them, some changes at a time.
///
/// The changes stay as they are, so that a recording that has been read once is framed by one
/// profile after the other.
///
/// ```
/// use encoderscope::{
///     capture::{Extraction, Kind, Options, Reader}, decode::Decoder, profile::Profile,
/// };
/// let mut reader = Reader::new(Kind::Samples, None).unwrap();
/// reader.push(b"Time [us],clk,data\n0,1,1\n50,0,1\n51,1,1\n52,0,1\n53,1,0\n54,0,0\n").unwrap();
/// reader.push(b"55,1,0\n56,0,0\n57,1,0\n74,1,1\n100,1,1\n").unwrap();
/// let changes = reader.finish().unwrap();
/// let clocks = |frame_bits| {
///     let pairs = [("turns-bits", "0"), ("angle-bits", "2"), ("frame-bits", frame_bits)];
///     let pairs = pairs.into_iter().chain([("format", "ssi-tree")]);
///     let decoder = Decoder::new(Profile::parse(pairs).unwrap()).unwrap();
///     let mut extraction = Extraction::new(&changes, &decoder, Options::default()).unwrap();
///     while extraction.step(&changes, 4).unwrap() {}
///     let frame = extraction.finish(&changes).frames.remove(0);
///     (frame.clocks, frame.violations.len())
/// };
/// assert_eq!((clocks("3"), clocks("2")), ((4, 0), (4, 1)));
/// ```
#[derive(Clone, Debug)]
pub struct Extraction {
    wires: Wires,
    /// As it is before the first change.
    fresh: Capture,
    capture: Capture,
    place: Place,
    seen: usize,
    /// Changes that are looked at.
    most: usize,
    frames: Vec<Clocked>,
    /// Frames that the data line is low before.
    low: usize,
    is_over: bool,
}

impl Extraction {
    /// One of a format that a master clocks.
    ///
    /// # Errors
    ///
    /// The format has no clock, or there are not two signals or not those asked for.
    pub fn new(
        changes: &Changes,
        decoder: &Decoder,
        options: Options<'_>,
    ) -> Result<Self, Unreadable> {
        let title = decoder.profile().format.title();
        let capture = Capture::new(decoder).ok_or(Unreadable::NotClocked(title))?;
        let capture = capture.with_clocking(changes.clocking);
        let signals = &changes.signals;
        let find = |asked: Option<&str>| {
            let Some(name) = asked else { return Ok(None) };
            let found = signals.iter().position(|signal| signal.name == name);
            let missing = || {
                let names = signals.iter().map(|signal| signal.name.clone());
                Unreadable::NoSuchSignal(name.to_string(), names.collect())
            };
            found.map(Some).ok_or_else(missing)
        };
        let asked = (find(options.clock)?, find(options.data)?);
        let lives = signals.iter().filter(|signal| signal.lives()).count();
        let wires = choose(signals, asked).ok_or(Unreadable::Signals(lives.min(1)))?;
        Ok(Self {
            wires,
            fresh: capture.clone(),
            capture,
            place: Place::default(),
            seen: 0,
            most: changes.len(),
            frames: Vec::new(),
            low: 0,
            is_over: false,
        })
    }

    /// Looks at the next changes, at most `budget` of them; whether there is more to do.
    ///
    /// A recording whose data line turns out to rest low is gone through twice.
    ///
    /// # Errors
    ///
    /// There are more frames than are kept.
    pub fn step(&mut self, changes: &Changes, budget: usize) -> Result<bool, Unreadable> {
        if self.is_over {
            return Ok(false);
        }
        let until = self.most.min(self.seen.saturating_add(budget));
        while self.seen < until
            && let Some(change) = changes.next(&mut self.place)
        {
            self.seen += 1;
            for (wire, used) in [
                (Wire::Clock, &self.wires.clock),
                (Wire::Data, &self.wires.data),
            ] {
                if used.signal == change.signal {
                    self.capture.push(Edge {
                        time: change.time,
                        wire,
                        level: change.level != used.inverted,
                    });
                }
            }
        }
        if self.seen >= self.most {
            let whole = self.most >= changes.len();
            self.capture.finish(match whole {
                true => changes.end,
                false => self.place.time,
            });
        }
        self.drain()?;
        if self.seen >= self.most {
            self.is_over = !self.turns_over(changes.signals.get(self.wires.data.signal));
        }
        Ok(!self.is_over)
    }

    /// How many changes have been looked at.
    #[must_use]
    pub const fn seen(&self) -> usize {
        self.seen
    }

    /// Leaves the changes aside that have not been looked at: the recording ends here.
    pub const fn stop(&mut self) {
        self.most = self.seen;
    }

    /// What was found.
    #[must_use]
    pub fn finish(mut self, changes: &Changes) -> Recording {
        Recording {
            signals: changes.signals.clone(),
            wires: self.wires,
            clocking: changes.clocking,
            profile: self.capture.profile(),
            frames: self.frames,
            stray: self.capture.stray(),
        }
    }

    fn drain(&mut self) -> Result<(), Unreadable> {
        while let Some((frame, high)) = self.capture.next() {
            self.low += usize::from(!high);
            if self.frames.len() == MOST_FRAMES {
                return Err(Unreadable::TooManyFrames);
            }
            self.frames.push(frame);
        }
        Ok(())
    }

    /// Begins again with the data inverted, where it rests low.
    fn turns_over(&mut self, data: Option<&Signal>) -> bool {
        let lives = data.is_some_and(|signal| signal.edges > 0);
        if self.wires.data.inverted || !lives || self.low * 2 <= self.frames.len() {
            return false;
        }
        self.wires.data.inverted = true;
        let name = self.wires.data.name.clone();
        self.wires.reasons.push(Reason::DataRestsLow(name));
        self.capture = self.fresh.clone();
        self.place = Place::default();
        self.seen = 0;
        self.frames.clear();
        self.low = 0;
        true
    }
}
