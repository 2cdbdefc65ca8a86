//! Bit formats: a line of a dump is a frame.

use super::{Decoder, Frame, Shapes};
use crate::{
    bits::Bits,
    format::{Format, biss_c, ssi, ssi_tree},
    framing::Why,
    layout::{Layout, Resolved, Shape},
};
use alloc::{borrow::Cow, vec::Vec};

/// The layouts of the shapes that the lines of a dump were found to have, prepared to judge and
/// read many lines quickly.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    layouts: Vec<Resolved>,
    room: usize,
}

/// For a line alone, preparing its layout is not worth while.
static NOTHING: Kept = Kept::with_room(0);

impl Kept {
    /// Room for the shapes that lines are likely to have.
    pub(super) const fn new() -> Self {
        Self::with_room(16)
    }

    const fn with_room(room: usize) -> Self {
        Self {
            layouts: Vec::new(),
            room,
        }
    }

    fn add(&mut self, table: &'static Layout, shapes: &Shapes) {
        for shape in shapes.iter().flatten() {
            if self.layouts.len() < self.room && self.find(*shape).is_none() {
                let layout = Resolved::new(table, *shape);
                self.layouts.push(layout.sieved());
            }
        }
    }

    fn find(&self, shape: Shape) -> Option<&Resolved> {
        self.layouts.iter().find(|layout| layout.shape == shape)
    }
}

impl Decoder {
    /// Reads one line of a bit format.
    ///
    /// # Errors
    ///
    /// The line is too short for a frame.
    pub fn line<'a>(&'a self, bits: Bits<'a>) -> Result<Frame<'a>, Why> {
        let shapes = self.shapes(bits)?;
        let chosen = self.likeliest(&mut Kept::with_room(0), core::iter::once(bits));
        self.line_as(&NOTHING, &shapes, bits, chosen)
    }

    fn shapes(&self, bits: Bits<'_>) -> Result<Shapes, Why> {
        let profile = &self.profile;
        let plain = self.layouts[0].shape;
        let found = match profile.format {
            _ if plain.preamble => biss_c::shapes(profile, self.data_bits, bits),
            Format::SsiTree => ssi_tree::shapes(profile, bits),
            _ => {
                let spare = (bits.len() as u32).checked_sub(self.data_bits);
                let shapes = spare.map(|spare| ssi::with_spare(profile, plain, bits, spare));
                shapes.ok_or(self.data_bits)
            }
        };
        found.map_err(|need| Why::Truncated {
            have: bits.len(),
            need: need as usize,
        })
    }

    /// Bits of a frame of a bit format without what may stand around it.
    pub(super) fn count_data_bits(&self) -> u32 {
        let Some(layout) = self.layouts.first() else {
            return 0;
        };
        let before = match layout.shape.preamble {
            true => Resolved::new(&biss_c::PREAMBLE, layout.shape).len,
            false => 0,
        };
        layout.len.saturating_sub(before) as u32
    }

    /// Which of the shapes holds its CRC in most lines; of equals the first.
    pub(super) fn likeliest<'a>(
        &self,
        kept: &mut Kept,
        lines: impl Iterator<Item = Bits<'a>>,
    ) -> usize {
        let mut passes = [0usize; 3];
        for bits in lines {
            let Ok(shapes) = self.shapes(bits) else {
                continue;
            };
            kept.add(self.table(), &shapes);
            for (count, shape) in passes.iter_mut().zip(shapes) {
                let holds = |shape| self.shaped(kept, shape).holds(bits);
                *count += usize::from(shape.is_some_and(holds));
            }
        }
        let best = passes.iter().max().copied().unwrap_or(0);
        passes.iter().position(|count| *count == best).unwrap_or(0)
    }

    /// Reads one line in the shape that the lines of its dump have.
    pub(super) fn line_of<'a>(&'a self, bits: Bits<'a>, chosen: usize) -> Result<Frame<'a>, Why> {
        self.line_as(&NOTHING, &self.shapes(bits)?, bits, chosen)
    }

    /// The same, and keeps what the lines behind it need too.
    pub(super) fn line_kept<'a>(
        &'a self,
        kept: &'a mut Kept,
        bits: Bits<'a>,
        chosen: usize,
    ) -> Result<Frame<'a>, Why> {
        let shapes = self.shapes(bits)?;
        kept.add(self.table(), &shapes);
        self.line_as(kept, &shapes, bits, chosen)
    }

    fn line_as<'a>(
        &'a self,
        kept: &'a Kept,
        shapes: &Shapes,
        bits: Bits<'a>,
        chosen: usize,
    ) -> Result<Frame<'a>, Why> {
        let shape = shapes[chosen].or_else(|| shapes.iter().copied().flatten().next());
        let shape = shape.ok_or(Why::NoFrame)?;
        let layout = self.shaped(kept, shape);
        // Without a checksum, a clock too many may be on either side of a word.
        let others = shapes.iter().flatten().filter(|other| **other != shape);
        let mut rivals = others
            .map(|other| self.shaped(kept, *other))
            .filter(|other| other.holds(bits) && other.reading(bits) != layout.reading(bits));
        let sure = match self.layouts[0].shape.preamble {
            true => is_quiet(bits, layout.shape.tail),
            false => rivals.next().is_none(),
        };
        Ok(Frame {
            start: 0,
            layout,
            bits,
            sure,
            request: None,
        })
    }

    /// How many bits at the start of a line make every line of its length, of which they are the
    /// first bits too, one of the same shape and as sure; `None` where the rest counts as well.
    pub(super) fn deciding_bits(&self, shape: &Shape, bits: usize) -> Option<usize> {
        let around = shape.idle + shape.unused;
        if self.layouts.first()?.shape.preamble {
            // All that is looked at is where the start bit stands.
            return (shape.preamble && shape.tail < 8).then_some((around + shape.ack + 1) as usize);
        }
        let word = self.data_bits as usize;
        let spare = bits.checked_sub(word)?;
        // One bit too many may be on either side, and more bits may be the word once more.
        let either = spare == 1 && !bits.is_multiple_of(8);
        (!either && spare < word).then_some(around as usize)
    }

    fn table(&self) -> &'static Layout {
        self.layouts[0].layout
    }

    /// The layout of a shape; most lines have the shape of the profile.
    fn shaped<'a>(&'a self, kept: &'a Kept, shape: Shape) -> Cow<'a, Resolved> {
        let own = || self.layouts.first().filter(|layout| layout.shape == shape);
        match kept.find(shape).or_else(own) {
            Some(layout) => Cow::Borrowed(layout),
            None => Cow::Owned(Resolved::new(self.table(), shape)),
        }
    }
}

/// Whether a line is idle behind a BiSS-C frame: low for the time-out, then high. A few bits that
/// fill a byte say nothing; more that come and go are another frame, or this is none.
fn is_quiet(bits: Bits<'_>, tail: u32) -> bool {
    let rest = bits.len().saturating_sub(tail as usize)..bits.len();
    let falls = |at: usize| bits.bit(at - 1) && !bits.bit(at);
    tail < 8 || !rest.skip(1).any(falls)
}
