//! Bit formats: a line of a dump is a frame.

use super::{Decoder, Frame, Shapes};
use crate::{
    bits::Bits,
    format::{Format, biss_c, ssi, ssi_tree},
    framing::Why,
    layout::{Layout, Resolved, Shape},
};
use alloc::borrow::Cow;

impl Decoder {
    /// Reads one line of a bit format.
    ///
    /// # Errors
    ///
    /// The line is too short for a frame.
    pub fn line<'a>(&'a self, bits: Bits<'a>) -> Result<Frame<'a>, Why> {
        let shapes = self.shapes(bits);
        let chosen = self.likeliest(core::iter::once(bits));
        self.line_as(&shapes, bits, chosen)
    }

    fn shapes(&self, bits: Bits<'_>) -> Result<Shapes, Why> {
        let found = match self.profile.format {
            _ if self.layouts[0].shape.preamble => {
                let before = Resolved::new(&biss_c::PREAMBLE, self.layouts[0].shape).len;
                let data = self.layouts[0].len.saturating_sub(before) as u32;
                biss_c::shapes(&self.profile, data, bits)
            }
            Format::SsiTree => ssi_tree::shapes(&self.profile, bits),
            _ => ssi::shapes(self.table(), &self.profile, bits),
        };
        found.map_err(|need| Why::Truncated {
            have: bits.len(),
            need: need as usize,
        })
    }

    /// Which of the shapes holds its CRC in most lines; of equals the first.
    pub(super) fn likeliest<'a>(&self, lines: impl Iterator<Item = Bits<'a>>) -> usize {
        let mut passes = [0usize; 3];
        for bits in lines {
            let shapes = self.shapes(bits);
            for (count, shape) in passes.iter_mut().zip(shapes.iter().flatten()) {
                *count += usize::from(shape.is_some_and(|shape| self.shaped(shape).holds(bits)));
            }
        }
        let best = passes.iter().max().copied().unwrap_or(0);
        passes.iter().position(|count| *count == best).unwrap_or(0)
    }

    /// Reads one line in the shape that the lines of its dump have.
    pub(super) fn line_of<'a>(&'a self, bits: Bits<'a>, chosen: usize) -> Result<Frame<'a>, Why> {
        self.line_as(&self.shapes(bits), bits, chosen)
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
        let sure = match self.layouts[0].shape.preamble {
            true => is_quiet(bits, layout.shape.tail),
            false => rivals.count() == 0,
        };
        Ok(Frame {
            start: 0,
            layout,
            bits,
            sure,
            request: None,
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
}

/// Whether a line is idle behind a BiSS-C frame: low for the time-out, then high. A few bits that
/// fill a byte say nothing; more that come and go are another frame, or this is none.
fn is_quiet(bits: Bits<'_>, tail: u32) -> bool {
    let rest = bits.len().saturating_sub(tail as usize)..bits.len();
    let falls = |at: usize| bits.bit(at - 1) && !bits.bit(at);
    tail < 8 || !rest.skip(1).any(falls)
}
