//! Bit formats in bulk: lines that are equally long, one after the other.

use super::{Decoder, Follows, lines::Kept, pass::ENOUGH_LINES};
use crate::{
    bits::Bits,
    dump::{Direction, Dump, Line},
    framing::{Piece, PieceKind, Why},
};
use alloc::vec::Vec;

type Sink<'s> = dyn FnMut(Piece<'_>) + 's;

/// Lines of a bit format that are equally long and stand one after the other, each in whole
/// bytes, as a program stores what SPI reads.
///
/// ```
/// use encoderscope::{columns::Columns, decode::{Decoder, Words}, profile::Profile};
/// let profile = [("format", "biss-c"), ("angle-bits", "17"), ("turns-bits", "0")];
/// let decoder = Decoder::new(Profile::parse(profile)?)?;
/// let stored = [0x82, 0x40, 0x00, 0x60, 0x10].repeat(1000);
/// let (mut words, mut columns) = (Words::new(&decoder, 40, &stored), Columns::default());
/// words.push_runs(&decoder, &stored, &mut |run| columns.take(&run));
/// assert_eq!(columns.angle, [0x8000; 1000]);
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Words {
    lines: Lines,
    /// The begun line.
    begun: Vec<u8>,
    /// Offset of the begun line in the input.
    at: u64,
}

impl Words {
    /// Lines of `bits` bits each. What stands around the data in them is decided once, from the
    /// first ones in `head`; then it does not matter how they are cut.
    #[must_use]
    pub fn new(decoder: &Decoder, bits: usize, head: &[u8]) -> Self {
        let bits = bits.max(1);
        let mut kept = Kept::new();
        let lines = head.chunks_exact(bits.div_ceil(8)).take(ENOUGH_LINES);
        let lines = lines.map(|line| Bits::of_bytes(line).prefix(bits));
        let shape = decoder.likeliest(&mut kept, lines);
        Self {
            lines: Lines { bits, shape, kept },
            begun: Vec::new(),
            at: 0,
        }
    }

    /// Takes more input; good frames that follow one another come as one piece.
    pub fn push_runs(&mut self, decoder: &Decoder, mut bytes: &[u8], sink: &mut Sink<'_>) {
        let len = self.lines.bits.div_ceil(8);
        if !self.begun.is_empty() {
            let (end, rest) = bytes.split_at(bytes.len().min(len - self.begun.len()));
            self.begun.extend_from_slice(end);
            bytes = rest;
            if self.begun.len() < len {
                return;
            }
            self.lines.run(decoder, &self.begun, self.at, sink);
            self.at += len as u64;
            self.begun.clear();
        }
        let (whole, begun) = bytes.split_at(bytes.len() / len * len);
        self.lines.run(decoder, whole, self.at, sink);
        self.at += whole.len() as u64;
        self.begun.extend_from_slice(begun);
    }

    /// The input has ended; reports what is left.
    pub fn finish_runs(&mut self, sink: &mut Sink<'_>) {
        if !self.begun.is_empty() {
            let have = self.begun.len() * 8;
            let need = self.lines.bits;
            skip(self.at, &self.begun, Why::Truncated { have, need }, sink);
            self.at += self.begun.len() as u64;
            self.begun.clear();
        }
    }
}

/// How lines of one length are read.
#[derive(Clone, Debug)]
struct Lines {
    bits: usize,
    /// Which of their shapes they have.
    shape: usize,
    kept: Kept,
}

impl Lines {
    /// Reads whole lines.
    fn run(&mut self, decoder: &Decoder, lines: &[u8], mut start: u64, sink: &mut Sink<'_>) {
        let len = self.bits.div_ceil(8);
        let mut rest = lines;
        while let Some((line, behind)) = rest.split_at_checked(len) {
            let bits = Bits::of_bytes(line).prefix(self.bits);
            let frame = match decoder.line_kept(&mut self.kept, bits, self.shape) {
                Ok(frame) => frame,
                Err(why) => {
                    skip(start, line, why, sink);
                    (start, rest) = (start + len as u64, behind);
                    continue;
                }
            };
            let (layout, sure) = (&*frame.layout, frame.sure);
            let holds = layout.holds(bits);
            let alike = decoder.deciding_bits(&layout.shape, self.bits);
            let frames = match alike.filter(|alike| sure && holds && *alike <= 64) {
                Some(alike) => {
                    let (frames, _) = layout.run(rest, false, Follows::same_bits(line, alike));
                    frames
                }
                None => 1,
            };
            let (bytes, behind) = rest.split_at(frames * len);
            sink(Piece {
                start,
                bytes,
                kind: PieceKind::Frame {
                    layout,
                    sure,
                    holds,
                },
            });
            (start, rest) = (start + bytes.len() as u64, behind);
        }
    }
}

fn skip(start: u64, bytes: &[u8], why: Why, sink: &mut Sink<'_>) {
    sink(Piece {
        start,
        bytes,
        kind: PieceKind::Skip(why),
    });
}

/// Reads the lines of a dump of a bit format, those of one length that follow one another at
/// once.
pub(super) fn lines(decoder: &Decoder, dump: &Dump, sink: &mut Sink<'_>) {
    let mut kept = Kept::new();
    let is_sent = |line: &Line<'_>| line.direction == Some(Direction::Sent);
    let heard = dump
        .lines()
        .take(ENOUGH_LINES)
        .filter(|line| !is_sent(line));
    let shape = decoder.likeliest(&mut kept, heard.map(|line| line.bits));
    let mut lines = Lines {
        bits: 1,
        shape,
        kept,
    };
    let (mut begin, mut end) = (0, 0);
    let whole = |begin: usize, end: usize| dump.bytes().get(begin..end).unwrap_or_default();
    for line in dump.lines() {
        let sent = is_sent(&line);
        if sent || line.bits.len() != lines.bits {
            lines.run(decoder, whole(begin, end), begin as u64, sink);
            (begin, lines.bits) = (end, line.bits.len().max(1));
        }
        end += line.bits.bytes().len();
        if sent {
            skip(begin as u64, line.bits.bytes(), Why::Request, sink);
            begin = end;
        }
    }
    lines.run(decoder, whole(begin, end), begin as u64, sink);
}
