//! Bit formats: a line of a dump is a frame.

use super::{Decoded, Decoder, Frame, Shapes, Summary};
use crate::{
    bits::Bits,
    dump::Dump,
    format::{Format, biss_c, ssi, ssi_tree},
    framing::Why,
    layout::{Layout, Resolved, Shape},
};
use alloc::{borrow::Cow, vec::Vec};

impl Decoder {
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
        let sure = self.layouts[0].shape.preamble || rivals.count() == 0;
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

    pub(super) fn lines(
        &self,
        dump: &Dump,
        summary: &mut Summary,
        sink: &mut dyn FnMut(Decoded<'_>),
    ) {
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
