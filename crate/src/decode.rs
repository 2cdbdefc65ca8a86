//! From bytes and bit strings to frames.

use crate::{
    bits::{self, BitString, Bits, Span},
    dump::Dump,
    explain::Note,
    format::{Format, Medium, asi1, asi4, biss_c, bus, period, ssi, ssi_tree, ssi7, t485},
    framing::{Framer, Piece, PieceKind, Why},
    layout::{Layout, Resolved, Shape},
    profile::{Dialect, Profile, ProfileError},
    reading::{Fault, FaultKind, Reading, Values},
};
use alloc::{borrow::Cow, vec, vec::Vec};

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

/// What the profile's own address speaks for a BUS frame, in bits.
const OWN_DEVICE: i8 = 6;
/// What a parity of the other sense speaks against it.
const OTHER_PARITY: i8 = -6;

/// A byte that begins no frame.
const NO_LEAD: Lead = Lead {
    layout: u8::MAX,
    request: false,
    names: 0,
    unsure: false,
    kind: None,
};

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
}

/// What the first byte of a frame says.
#[derive(Clone, Copy, Debug)]
struct Lead {
    /// Which layout the frame has; one that does not exist where there is none.
    layout: u8,
    /// Whether it is a request that may stand before its reply in a dump.
    request: bool,
    /// How much it speaks for a frame beyond what the checks count, in bits.
    names: i8,
    /// Whether an encoder may not know the request, and answer with another layout.
    unsure: bool,
    /// See [`Decoder::kind`].
    kind: Option<u8>,
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
        let one = |table| vec![Resolved::new(table, shape)];
        let layouts: Vec<Resolved> = match profile.format {
            Format::Ssi => one(&ssi::WORD),
            Format::BissC => one(&biss_c::FRAME),
            Format::Ssi7 => one(&ssi7::WORD),
            Format::SsiTree => one(&ssi_tree::WORD),
            Format::Rs485 => one(profile.command.reply()),
            Format::Period => one(period::FRAME),
            Format::Asi1 => one(&asi1::PACKET),
            Format::Asi4 => (1..=asi4::DIGITS as u32)
                .map(|digits| Resolved::new(&asi4::LINE, Shape { digits, ..shape }))
                .collect(),
            Format::T485 => t485::Request::ALL
                .iter()
                .map(|request| Resolved::new(request.reply(), shape))
                .collect(),
            Format::Bus => bus::Operation::ALL
                .iter()
                .map(|operation| Resolved::new(operation.reply(), shape))
                .collect(),
        };
        let layouts = match profile.format.medium() {
            Medium::Bits => layouts,
            Medium::Bytes | Medium::Text => layouts.into_iter().map(Resolved::sieved).collect(),
        };
        let mut decoder = Self {
            profile,
            layouts,
            leads: [NO_LEAD; 256],
        };
        if profile.format.medium() == Medium::Bytes {
            decoder.leads = core::array::from_fn(|byte| decoder.lead(byte as u8));
        }
        Ok(decoder)
    }

    fn lead(&self, byte: u8) -> Lead {
        let asked = t485::Request::of_byte(byte).filter(|_| self.profile.format == Format::T485);
        let index = match self.profile.format {
            Format::T485 => match asked {
                Some(asked) => t485::Request::ALL
                    .iter()
                    .position(|request| *request == asked),
                // Any other control byte is answered with the angle.
                None => t485::is_control(byte).then_some(0),
            },
            Format::Bus => {
                let code = self.layouts[0].values(Bits::of_bytes(&[byte])).operation;
                let mut known = bus::Operation::ALL.iter();
                known.position(|operation| Some(operation.code()) == code)
            }
            _ => Some(0),
        };
        let names = self.weigh_lead(byte);
        let request = match self.profile.format {
            Format::Rs485 => byte == self.profile.command.byte(),
            Format::T485 => asked.is_some(),
            Format::Bus => names > 0,
            _ => false,
        };
        Lead {
            layout: index.map_or(u8::MAX, |index| index as u8),
            request,
            names,
            kind: match self.echoes() {
                _ if request || names < 0 => None,
                true => Some(byte),
                false => index.map(|index| index as u8),
            },
            unsure: asked.is_some_and(|asked| !asked.is_known_to(Dialect::Mpp)),
        }
    }

    /// The CRC of BUS holds for a frame that is read a byte late, as the next one begins with
    /// the same byte: what remains is its address and a parity that is likely.
    fn weigh_lead(&self, byte: u8) -> i8 {
        if self.profile.format != Format::Bus {
            return 0;
        }
        let values = self.layouts[0].values(Bits::of_bytes(&[byte]));
        let own = values.address.map(u32::from) == Some(self.profile.address);
        let parity = match values.parity {
            Some(parity) if parity.ok() => 1,
            Some(_) => OTHER_PARITY,
            None => 0,
        };
        parity + if own { OWN_DEVICE } else { 0 }
    }

    /// The profile.
    #[must_use]
    pub const fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The layout of a frame of a byte format that begins `bytes`; `None` where no frame can.
    ///
    /// The first byte tells it, except in ASI4, whose lines end where they end.
    #[must_use]
    #[inline]
    pub fn layout(&self, bytes: &[u8]) -> Option<&Resolved> {
        if self.profile.format == Format::Asi4 {
            return self.layouts.get(asi4::digits(bytes)? - 1);
        }
        let lead = self.leads[usize::from(*bytes.first()?)];
        let layout = self.layouts.get(usize::from(lead.layout))?;
        if lead.unsure {
            return Some(self.refused(bytes).unwrap_or(layout));
        }
        Some(layout)
    }

    /// The layout of the reply to a T485 request that the encoder did not understand: it sends
    /// the angle instead.
    fn refused(&self, bytes: &[u8]) -> Option<&Resolved> {
        let holds = |layout: &&Resolved| {
            let frame = bytes.get(..layout.len / 8);
            frame.is_some_and(|frame| layout.holds(Bits::of_bytes(frame)))
        };
        let own = self.leads[usize::from(*bytes.first()?)].layout;
        let own = self.layouts.get(usize::from(own))?;
        let angle = self.layouts.first()?;
        (!holds(&own) && holds(&angle)).then_some(angle)
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

    /// What kind of frame `byte` begins: those of one kind may follow one another without being
    /// weighed. A request begins none.
    #[inline]
    pub(crate) const fn kind(&self, byte: u8) -> Option<u8> {
        self.leads[byte as usize].kind
    }

    /// Whether `byte` is a request that may stand before its reply in a dump.
    #[must_use]
    #[inline]
    pub fn is_request(&self, byte: u8) -> bool {
        self.leads[usize::from(byte)].request
    }

    /// Whether a reply begins with the byte that was asked.
    #[must_use]
    pub const fn echoes(&self) -> bool {
        matches!(self.profile.format, Format::T485 | Format::Bus)
    }

    /// Whether a frame that begins with `byte` needs no more proof of its place than its checks.
    /// The CRC of BUS holds in other phases too, so the device must be the profile's, or the one
    /// of the frame before.
    #[inline]
    pub(crate) fn is_known_lead(&self, byte: u8, before: Option<u8>) -> bool {
        if self.profile.format != Format::Bus {
            return true;
        }
        let names = self.names(byte);
        names >= OWN_DEVICE.into() || names > 0 && before == Some(byte)
    }

    /// How much the first byte of a frame speaks for it beyond what its checks count, in bits.
    pub(crate) fn names(&self, first: u8) -> i32 {
        self.leads[usize::from(first)].names.into()
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
        })
    }

    /// Reads one line of a bit format.
    ///
    /// # Errors
    ///
    /// The line is too short for a frame.
    pub fn line<'a>(&'a self, bits: Bits<'a>) -> Result<Frame<'a>, Why> {
        let shapes = self.shapes(bits);
        let chosen = self.likeliest(core::iter::once((&shapes, bits)));
        self.line_as(&shapes, bits, chosen)
    }

    fn shapes(&self, bits: Bits<'_>) -> Result<Shapes, Why> {
        let found = match self.profile.format {
            Format::BissC => biss_c::shapes(&self.profile, bits),
            Format::SsiTree => ssi_tree::shapes(&self.profile, bits),
            _ => ssi::shapes(self.table(), &self.profile, bits),
        };
        found.map_err(|need| Why::Truncated {
            have: bits.len(),
            need: need as usize,
        })
    }

    /// Which of the shapes holds its CRC in most lines; of equals the first.
    fn likeliest<'a>(
        &self,
        lines: impl Iterator<Item = (&'a Result<Shapes, Why>, Bits<'a>)>,
    ) -> usize {
        let mut passes = [0usize; 3];
        for (shapes, bits) in lines {
            for (count, shape) in passes.iter_mut().zip(shapes.iter().flatten()) {
                *count += usize::from(shape.is_some_and(|shape| self.shaped(shape).holds(bits)));
            }
        }
        let best = passes.iter().max().copied().unwrap_or(0);
        passes.iter().position(|count| *count == best).unwrap_or(0)
    }

    fn line_as<'a>(
        &'a self,
        shapes: &Result<Shapes, Why>,
        bits: Bits<'a>,
        chosen: usize,
    ) -> Result<Frame<'a>, Why> {
        let shapes = shapes.as_ref().map_err(|why| *why)?;
        let shape = shapes[chosen].or_else(|| shapes.iter().copied().flatten().next());
        let shape = shape.ok_or(Why::NoFrame)?;
        let layout = self.shaped(shape);
        // Without a checksum, a clock too many may be on either side of a word.
        let others = shapes.iter().flatten().filter(|other| **other != shape);
        let rivals = others
            .map(|other| self.shaped(*other))
            .filter(|other| other.holds(bits) && other.reading(bits) != layout.reading(bits));
        let sure = self.profile.format == Format::BissC || rivals.count() == 0;
        Ok(Frame {
            start: 0,
            layout,
            bits,
            sure,
        })
    }

    fn table(&self) -> &'static Layout {
        self.layouts[0].layout
    }

    /// The layout of a shape; most lines have the shape of the profile.
    fn shaped(&self, shape: Shape) -> Cow<'_, Resolved> {
        match self.layouts.first() {
            Some(layout) if layout.shape == shape => Cow::Borrowed(layout),
            _ => Cow::Owned(Resolved::new(self.table(), shape)),
        }
    }

    /// Decodes a whole dump; `sink` gets every stretch of it in order.
    pub fn dump(&self, dump: &Dump, sink: &mut dyn FnMut(Decoded<'_>)) -> Summary {
        let mut summary = Summary::default();
        match self.profile.format.medium() {
            Medium::Bytes | Medium::Text => {
                let bytes = dump.bytes();
                summary.bytes = bytes.len() as u64;
                let mut framer = Framer::at_start();
                framer.push(self, &bytes, &mut |piece| {
                    piece_out(piece, &mut summary, sink);
                });
                framer.finish(self, &mut |piece| piece_out(piece, &mut summary, sink));
            }
            Medium::Bits => self.lines(dump, &mut summary, sink),
        }
        summary
    }

    fn lines(&self, dump: &Dump, summary: &mut Summary, sink: &mut dyn FnMut(Decoded<'_>)) {
        let all: Vec<_> = dump
            .lines
            .iter()
            .map(|line| self.shapes(line.bits.as_bits()))
            .collect();
        let lines = || dump.lines.iter().map(|line| line.bits.as_bits());
        let chosen = self.likeliest(all.iter().zip(lines()));
        let mut start = 0;
        let as_bits = dump.is_bits();
        for (shapes, bits) in all.iter().zip(lines()) {
            let bytes = bits.bytes().len() as u64;
            let here = if as_bits { start } else { start / 8 };
            start += if as_bits {
                bits.len()
            } else {
                bits.bytes().len() * 8
            } as u64;
            summary.bytes += bytes;
            match self.line_as(shapes, bits, chosen) {
                Ok(mut frame) => {
                    frame.start = here;
                    summary.frames += 1;
                    summary.bad += u64::from(!frame.ok());
                    sink(Decoded::Frame(frame));
                }
                Err(why) => {
                    summary.skipped += bytes;
                    sink(Decoded::Skip {
                        start: here,
                        bits,
                        why,
                    });
                }
            }
        }
    }
}

fn piece_out(piece: Piece<'_>, summary: &mut Summary, sink: &mut dyn FnMut(Decoded<'_>)) {
    let bits = Bits::of_bytes(piece.bytes);
    let start = piece.start;
    match piece.kind {
        PieceKind::Frame { layout, sure, .. } => {
            let frame = Frame {
                start,
                layout: Cow::Borrowed(layout),
                bits,
                sure,
            };
            summary.frames += 1;
            summary.bad += u64::from(!frame.ok());
            sink(Decoded::Frame(frame));
        }
        PieceKind::Skip(why) => {
            summary.skipped += piece.bytes.len() as u64;
            sink(Decoded::Skip { start, bits, why });
        }
    }
}
