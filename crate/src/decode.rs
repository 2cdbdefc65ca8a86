//! From bytes and bit strings to frames.

use crate::{
    bits::{Bits, Span},
    dump::Dump,
    explain::Note,
    format::{Format, Medium, biss_c, rs485, t485},
    framing::{Framer, Piece, PieceKind, Why},
    layout::{Resolved, Shape},
    profile::{Profile, ProfileError},
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

/// A profile with its layouts resolved.
#[derive(Clone, Debug)]
pub struct Decoder {
    profile: Profile,
    /// One a request for T485, else one.
    layouts: Vec<Resolved>,
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
        let layouts = match profile.format {
            Format::BissC => vec![Resolved::new(&biss_c::FRAME, shape)],
            Format::Rs485 => vec![Resolved::new(profile.command.reply(), shape)],
            Format::T485 => t485::Request::ALL
                .iter()
                .map(|request| Resolved::new(request.reply(), shape))
                .collect(),
        };
        Ok(Self { profile, layouts })
    }

    /// The profile.
    #[must_use]
    pub const fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The layout of a frame that begins with `first`; `None` where no frame can.
    #[must_use]
    pub fn layout(&self, first: u8) -> Option<&Resolved> {
        match self.profile.format {
            Format::BissC => None,
            Format::Rs485 => self.layouts.first(),
            Format::T485 => {
                let at = t485::Request::ALL
                    .iter()
                    .position(|request| request.byte() == first)?;
                self.layouts.get(at)
            }
        }
    }

    /// The layout that describes a whole frame, for explaining and encoding.
    ///
    /// T485 has one for every request; the reply to `all` stands for them.
    #[must_use]
    pub fn main_layout(&self) -> &Resolved {
        self.layout(t485::Request::All.byte())
            .unwrap_or(&self.layouts[0])
    }

    /// Whether `byte` is a request that may stand before its reply in a dump.
    #[must_use]
    pub fn is_request(&self, byte: u8) -> bool {
        match self.profile.format {
            Format::BissC => false,
            Format::Rs485 => rs485::Command::of_byte(byte) == Some(self.profile.command),
            Format::T485 => t485::Request::of_byte(byte).is_some(),
        }
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
        let layout = self.layout(*bytes.first()?)?;
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

    fn shapes(&self, bits: Bits<'_>) -> Result<biss_c::Shapes, Why> {
        biss_c::shapes(&self.profile, bits).map_err(|need| Why::Truncated {
            have: bits.len(),
            need: need as usize,
        })
    }

    /// Which of the shapes holds its CRC in most lines; of equals the first.
    fn likeliest<'a>(
        &self,
        lines: impl Iterator<Item = (&'a Result<biss_c::Shapes, Why>, Bits<'a>)>,
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
        shapes: &Result<biss_c::Shapes, Why>,
        bits: Bits<'a>,
        chosen: usize,
    ) -> Result<Frame<'a>, Why> {
        let shapes = shapes.as_ref().map_err(|why| *why)?;
        let shape = shapes[chosen].or_else(|| shapes.iter().copied().flatten().next());
        let shape = shape.ok_or(Why::NoFrame)?;
        Ok(Frame {
            start: 0,
            layout: self.shaped(shape),
            bits,
            sure: true,
        })
    }

    /// The layout of a shape; most lines have the shape of the profile.
    fn shaped(&self, shape: Shape) -> Cow<'_, Resolved> {
        match self.layouts.first() {
            Some(layout) if layout.shape == shape => Cow::Borrowed(layout),
            _ => Cow::Owned(Resolved::new(&biss_c::FRAME, shape)),
        }
    }

    /// Decodes a whole dump; `sink` gets every stretch of it in order.
    pub fn dump(&self, dump: &Dump, sink: &mut dyn FnMut(Decoded<'_>)) -> Summary {
        let mut summary = Summary::default();
        match self.profile.format.medium() {
            Medium::Bytes => {
                let bytes = dump.bytes();
                summary.bytes = bytes.len() as u64;
                let mut framer = Framer::new(self);
                framer.push(&bytes, &mut |piece| piece_out(piece, &mut summary, sink));
                framer.finish(&mut |piece| piece_out(piece, &mut summary, sink));
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
        for (shapes, bits) in all.iter().zip(lines()) {
            let bytes = bits.bytes().len() as u64;
            let here = if dump.is_bits() { start } else { start / 8 };
            start += if dump.is_bits() {
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
        PieceKind::Frame { layout, sure } => {
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
