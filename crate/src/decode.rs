//! From bytes and bit strings to frames.

mod leads;
mod lines;
mod pass;
mod words;

pub use pass::Pass;
pub use words::Words;

use crate::{
    bits::{self, BitString, Bits, Span},
    dump::Dump,
    explain::Note,
    format::{Format, Medium, bus, t485},
    framing::{Framer, Piece, PieceKind, Why},
    layout::{Resolved, Shape},
    profile::{Profile, ProfileError},
    reading::{Fault, FaultKind, Reading, Values},
};
use alloc::{borrow::Cow, vec::Vec};
pub(crate) use leads::Follows;
use leads::{Lead, NO_LEAD};

/// A frame: its bits, and the layout that reads them.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// Offset in the input: bytes, or bits for bit strings.
    pub start: u64,
    /// The layout.
    pub layout: Cow<'a, Resolved>,
    /// The bits.
    pub bits: Bits<'a>,
    /// Whether it is certain that a frame begins here, not one byte off.
    pub sure: bool,
    /// Offset of the request that it answers, in bytes, where the dump has marked one.
    pub request: Option<u64>,
}

impl Frame<'_> {
    /// All numbers, good or bad.
    #[must_use]
    pub fn values(&self) -> Values {
        self.layout.values(self.bits)
    }

    /// Whether every check holds and the frame's place is certain.
    #[must_use]
    pub fn ok(&self) -> bool {
        self.sure && self.layout.holds(self.bits)
    }

    /// What is wrong.
    #[must_use]
    pub fn faults(&self) -> Vec<Fault> {
        let mut faults = self.layout.faults(self.bits);
        if !self.sure && faults.is_empty() {
            let at = Span::new(0, self.bits.len());
            faults.push(Fault {
                at,
                kind: FaultKind::Ambiguous,
            });
        }
        faults
    }

    /// Position and health, of a good frame only.
    #[must_use]
    pub fn reading(&self) -> Option<Reading> {
        self.layout
            .reading(self.bits)
            .ok()
            .flatten()
            .filter(|_| self.sure)
    }

    /// What every field says.
    #[must_use]
    pub fn explain(&self) -> Vec<Note> {
        self.layout.explain(self.bits)
    }
}

/// What a stretch of a dump is.
#[derive(Clone, Debug)]
pub enum Decoded<'a> {
    /// A frame, good or bad.
    Frame(Frame<'a>),
    /// Input that belongs to no frame.
    Skip {
        /// Offset in the input: bytes, or bits for bit strings.
        start: u64,
        /// The input.
        bits: Bits<'a>,
        /// Why it is no frame.
        why: Why,
    },
}

impl Decoded<'_> {
    fn piece(&self) -> Piece<'_> {
        let (start, bits) = match self {
            Self::Frame(frame) => (frame.start, frame.bits),
            Self::Skip { start, bits, .. } => (*start, *bits),
        };
        let kind = match self {
            Self::Frame(frame) => PieceKind::Frame {
                layout: &frame.layout,
                sure: frame.sure,
                holds: frame.layout.holds(frame.bits),
            },
            Self::Skip { why, .. } => PieceKind::Skip(*why),
        };
        Piece {
            start,
            bytes: bits.bytes(),
            kind,
        }
    }
}

/// Counts over a dump. Every byte is in a frame or skipped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Bytes of the input; a line of bits is rounded up.
    pub bytes: u64,
    /// Frames, good and bad.
    pub frames: u64,
    /// Frames with a fault.
    pub bad: u64,
    /// Bytes in no frame.
    pub skipped: u64,
}

/// The shapes that a line of a dump can have, the likeliest first.
///
/// Which one is meant is decided over all lines of a dump, by [`Decoder::dump`].
pub type Shapes = [Option<Shape>; 3];

/// A profile with its layouts resolved.
#[derive(Clone, Debug)]
pub struct Decoder {
    profile: Profile,
    /// T485: one a request; BUS: one an operation; ASI4: one a number of digits; else one.
    layouts: Vec<Resolved>,
    /// What each first byte says, for byte formats.
    leads: [Lead; 256],
    /// The one byte that is a request, in formats whose replies do not begin with it.
    request: Option<u8>,
    /// Bits of a frame of a bit format without what may stand around it.
    data_bits: u32,
}

impl Decoder {
    /// Resolves the layouts of a profile.
    ///
    /// # Errors
    ///
    /// A parameter is out of its format's range.
    pub fn new(profile: Profile) -> Result<Self, ProfileError> {
        profile.check()?;
        let shape = Shape::of(profile);
        let layouts = (profile.format.manual().layouts)(&profile, shape);
        let layouts = match profile.medium() {
            Medium::Bits => layouts,
            Medium::Bytes | Medium::Text => layouts.into_iter().map(Resolved::sieved).collect(),
        };
        let mut decoder = Self {
            profile,
            layouts,
            leads: [NO_LEAD; 256],
            request: None,
            data_bits: 0,
        };
        decoder.data_bits = decoder.count_data_bits();
        if profile.medium() == Medium::Bytes {
            decoder.leads = core::array::from_fn(|byte| decoder.lead(byte as u8));
            let alone = (0..=u8::MAX).find(|byte| decoder.is_request(*byte));
            decoder.request = alone.filter(|_| !decoder.echoes());
        }
        Ok(decoder)
    }

    /// The profile.
    #[must_use]
    pub const fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The layout that describes a whole frame, for explaining and encoding.
    ///
    /// T485 and BUS have several: the replies to `all` and to `get` stand for them.
    #[must_use]
    pub fn main_layout(&self) -> &Resolved {
        let index = match self.profile.format {
            Format::T485 => t485::Request::ALL
                .iter()
                .position(|request| *request == t485::Request::All),
            Format::Asi4 => Some(self.layouts.len() - 1),
            _ => Some(0),
        };
        &self.layouts[index.unwrap_or(0)]
    }

    /// The frame that says `values`; absent ones are 0 or not asserted, checks are computed.
    ///
    /// An `operation` chooses between the frames of T485 and BUS; without one it is the reply to
    /// `all` and to `get`. Without an `address` it is the profile's.
    ///
    /// ```
    /// use encoderscope::{decode::Decoder, profile::Profile, reading::Values};
    /// let decoder = Decoder::new(Profile::parse([("format", "bus"), ("turns-bits", "0")])?)?;
    /// let count = Values { operation: Some(1), count: Some(10), ..Values::default() };
    /// assert_eq!(decoder.encode(&count).into_bytes(), [0xbf, 0x00, 0x0a, 0xb5]);
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    #[must_use]
    pub fn encode(&self, values: &Values) -> BitString {
        let mut values = *values;
        let mut layout = self.main_layout();
        match self.profile.format {
            Format::T485 => {
                let id = |byte: u8| layout.values(Bits::of_bytes(&[byte])).operation;
                values.operation = values.operation.or(id(t485::Request::All.byte()));
                let asked = t485::Request::ALL
                    .iter()
                    .position(|request| id(request.byte()) == values.operation);
                layout = asked.map_or(layout, |index| &self.layouts[index]);
            }
            Format::Bus => {
                let asked = bus::Operation::ALL
                    .iter()
                    .position(|operation| Some(operation.code()) == values.operation);
                let own = bits::low_byte(self.profile.address.into());
                values.address = values.address.or(Some(own));
                layout = asked.map_or(layout, |index| &self.layouts[index]);
            }
            Format::Asi4 => {
                let digits = bits::decimal_digits(values.angle.unwrap_or(0)) as usize;
                layout = self.layouts.get(digits - 1).unwrap_or(layout);
            }
            _ => {}
        }
        layout.encode(&values)
    }

    /// Bytes of the longest frame.
    #[must_use]
    pub fn longest(&self) -> usize {
        self.layouts
            .iter()
            .map(|layout| layout.len / 8)
            .max()
            .unwrap_or(0)
    }

    /// Reads `bytes` as exactly one frame of a byte format.
    #[must_use]
    pub fn frame<'a>(&'a self, bytes: &'a [u8]) -> Option<Frame<'a>> {
        let layout = self.layout(bytes)?;
        (layout.len == bytes.len() * 8).then(|| Frame {
            start: 0,
            layout: Cow::Borrowed(layout),
            bits: Bits::of_bytes(bytes),
            sure: true,
            request: None,
        })
    }

    /// Decodes a whole dump; `sink` gets every stretch of it in order.
    pub fn dump(&self, dump: &Dump, sink: &mut dyn FnMut(Decoded<'_>)) -> Summary {
        let mut pass = Pass::new();
        pass.finish(self, dump, sink);
        pass.summary()
    }

    /// Decodes a whole dump; good frames of one layout that follow one another come as one piece,
    /// which is quicker to read into columns. Offsets count the bytes of [`Dump::bytes`].
    ///
    /// ```
    /// use encoderscope::{columns::Columns, decode::Decoder, dump::parse, profile::Profile};
    /// let profile = Profile::parse([("format", "ssi"), ("angle-bits", "16"), ("turns-bits", "0")])?;
    /// let decoder = Decoder::new(profile)?;
    /// let dump = parse(&"1234 00\n".repeat(1000), decoder.profile().medium());
    /// let mut columns = Columns::default();
    /// decoder.dump_runs(&dump, &mut |run| columns.take(&run));
    /// assert_eq!(columns.angle, [0x1234; 1000]);
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    pub fn dump_runs(&self, dump: &Dump, sink: &mut dyn FnMut(Piece<'_>)) {
        match self.profile.medium() {
            Medium::Bits => words::lines(self, dump, sink),
            Medium::Bytes | Medium::Text if !dump.has_directions() => {
                let mut framer = Framer::at_start();
                for chunk in dump.bytes().chunks(pass::CHUNK) {
                    framer.push_runs(self, chunk, sink);
                }
                framer.finish_runs(self, sink);
            }
            Medium::Bytes | Medium::Text => {
                let _ = self.dump(dump, &mut |decoded| sink(decoded.piece()));
            }
        }
    }
}
