//! Decoding piece by piece.

use super::{Decoded, Decoder, Frame, Summary, lines::Kept};
use crate::{
    bits::Bits,
    dump::{Direction, Dump},
    format::{Format, Medium, rs485::Command},
    framing::{Framer, Piece, PieceKind, Why},
    profile::Profile,
};
use alloc::{borrow::Cow, vec::Vec};

/// Lines over which the shape of the frames of a bit format is chosen.
pub(super) const ENOUGH_LINES: usize = 4_096;
/// Bytes that are framed at once.
pub(super) const CHUNK: usize = 65_536;

/// A dump that is decoded piece by piece, and may grow between the pieces.
///
/// The frames are the same whatever the pieces are. In bit formats nothing comes out before
/// there are enough lines to choose the shape of the frames, or [`Pass::finish`] is called.
///
/// What is marked as sent in a dump is no part of what the encoder said: it is skipped as a
/// request, what came before it is framed to its end, and the next frame answers it. The
/// replies to another RS485 command than the profile's are read as what they are.
///
/// ```
/// use encoderscope::{decode::{Decoded, Decoder, Pass}, dump::parse, profile::Profile};
/// let decoder = Decoder::new(Profile::parse([("format", "t485")])?)?;
/// let dump = parse("TX: 02\nRX: 02 20 b4 bd 1c 37", decoder.profile().medium());
/// let mut pass = Pass::new();
/// let mut asked = Vec::new();
/// let mut sink = |decoded: Decoded<'_>| {
///     if let Decoded::Frame(frame) = decoded {
///         asked.push((frame.start, frame.request));
///     }
/// };
/// while pass.step(&decoder, &dump, 4, &mut sink) {}
/// pass.finish(&decoder, &dump, &mut sink);
/// assert_eq!(asked, [(1, Some(0))]);
/// assert_eq!(pass.summary().frames, 1);
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Pass {
    framer: Framer,
    /// Bytes of the stream that are taken.
    at: u64,
    /// Lines of a bit format that are taken.
    line: usize,
    /// The last request, until its reply comes.
    request: Option<u64>,
    /// The command that the last request was, where it is not the profile's.
    asked: Option<Command>,
    /// Decoders of the replies to other commands, as they are met.
    others: Vec<Decoder>,
    /// Which of the shapes of a bit format the lines have.
    shape: Option<usize>,
    kept: Kept,
    summary: Summary,
}

type Sink<'s> = dyn FnMut(Decoded<'_>) + 's;

impl Default for Pass {
    fn default() -> Self {
        Self::new()
    }
}

impl Pass {
    /// A pass at the start of a dump.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            framer: Framer::at_start(),
            at: 0,
            line: 0,
            request: None,
            asked: None,
            others: Vec::new(),
            shape: None,
            kept: Kept::new(),
            summary: Summary {
                bytes: 0,
                frames: 0,
                bad: 0,
                skipped: 0,
            },
        }
    }

    /// Decodes about `budget` bytes more; whether there is more now.
    pub fn step(
        &mut self,
        decoder: &Decoder,
        dump: &Dump,
        budget: usize,
        sink: &mut Sink<'_>,
    ) -> bool {
        match decoder.profile().medium() {
            Medium::Bytes | Medium::Text => self.stream(decoder, dump, budget, sink),
            Medium::Bits if self.shape.is_none() && dump.len() < ENOUGH_LINES => false,
            Medium::Bits => self.lines(decoder, dump, budget, sink),
        }
    }

    /// The dump has ended; decodes what is left.
    pub fn finish(&mut self, decoder: &Decoder, dump: &Dump, sink: &mut Sink<'_>) {
        match decoder.profile().medium() {
            Medium::Bytes | Medium::Text => {
                while self.stream(decoder, dump, CHUNK, sink) {}
                self.end(decoder, sink);
            }
            Medium::Bits => while self.lines(decoder, dump, CHUNK, sink) {},
        }
    }

    /// What has been decoded so far.
    #[must_use]
    pub const fn summary(&self) -> Summary {
        self.summary
    }

    /// Reads one line of a bit format, in the shape that was chosen over all of them.
    pub(crate) fn line<'a>(&self, decoder: &'a Decoder, bits: Bits<'a>) -> Result<Frame<'a>, Why> {
        decoder.line_of(bits, self.shape.unwrap_or(0))
    }

    /// The decoder of the replies to a request.
    pub(crate) fn answering<'d>(&'d self, decoder: &'d Decoder, request: &[u8]) -> &'d Decoder {
        let asked = request.last().and_then(|byte| Command::of_byte(*byte));
        let mut others = self.others.iter();
        let answers = others.find(|other| Some(other.profile().command) == asked);
        answers.unwrap_or(decoder)
    }

    fn stream(
        &mut self,
        decoder: &Decoder,
        dump: &Dump,
        budget: usize,
        sink: &mut Sink<'_>,
    ) -> bool {
        let total = dump.bytes().len() as u64;
        let stop = total.min(self.at.saturating_add(budget.max(1) as u64));
        if !dump.has_directions() {
            self.push(decoder, dump, stop, sink);
            return self.at < total;
        }
        let first = dump.line_at_byte(self.at);
        let mut end = dump.byte_of(first);
        for line in dump.lines_from(first) {
            end += line.bits.bytes().len() as u64;
            if self.at >= stop {
                break;
            }
            match line.direction {
                _ if self.at >= end => {}
                Some(Direction::Sent) => self.sent(decoder, line.bits, end, sink),
                Some(Direction::Received) | None => self.push(decoder, dump, end.min(stop), sink),
            }
        }
        self.at < total
    }

    /// Frames the stream as far as `stop`.
    fn push(&mut self, decoder: &Decoder, dump: &Dump, stop: u64, sink: &mut Sink<'_>) {
        let piece = dump.bytes().get(self.at as usize..stop as usize);
        for chunk in piece.unwrap_or_default().chunks(CHUNK) {
            self.framed(decoder, sink, |framer, decoder, out| {
                framer.push(decoder, chunk, out);
            });
        }
        self.at = self.at.max(stop);
    }

    /// Ends the stretch before a request.
    fn end(&mut self, decoder: &Decoder, sink: &mut Sink<'_>) {
        self.framed(decoder, sink, |framer, decoder, out| {
            framer.finish(decoder, out);
        });
        self.framer = Framer::at_offset(self.at);
        self.request = None;
    }

    /// Runs the framer with the decoder of the replies to what was asked last.
    fn framed(
        &mut self,
        decoder: &Decoder,
        sink: &mut Sink<'_>,
        run: impl FnOnce(&mut Framer, &Decoder, &mut dyn FnMut(Piece<'_>)),
    ) {
        let others = self.others.iter();
        let asked = self.asked;
        let mut answers = others.filter(|other| Some(other.profile().command) == asked);
        let decoder = answers.next().unwrap_or(decoder);
        let (request, summary) = (&mut self.request, &mut self.summary);
        run(&mut self.framer, decoder, &mut |piece| {
            piece_out(piece, request, summary, sink);
        });
    }

    fn sent(&mut self, decoder: &Decoder, bits: Bits<'_>, end: u64, sink: &mut Sink<'_>) {
        self.end(decoder, sink);
        let start = end - bits.bytes().len() as u64;
        self.skip(start, bits, Why::Request, sink);
        self.at = end;
        self.framer = Framer::at_offset(end);
        self.request = Some(start);
        if decoder.profile().format == Format::Rs485 {
            self.ask(decoder.profile(), bits.bytes().last().copied());
        }
    }

    /// Expects the reply to a command.
    fn ask(&mut self, profile: &Profile, byte: Option<u8>) {
        let mut known = Command::ALL.iter().copied();
        self.asked =
            known.find(|command| Some(command.byte()) == byte && *command != profile.command);
        let Some(command) = self.asked else {
            return;
        };
        if self
            .others
            .iter()
            .all(|other| other.profile().command != command)
        {
            self.others.extend(Decoder::new(Profile {
                command,
                ..*profile
            }));
        }
    }

    fn skip(&mut self, start: u64, bits: Bits<'_>, why: Why, sink: &mut Sink<'_>) {
        let len = bits.bytes().len() as u64;
        self.summary.bytes += len;
        self.summary.skipped += len;
        sink(Decoded::Skip { start, bits, why });
    }

    fn lines(
        &mut self,
        decoder: &Decoder,
        dump: &Dump,
        budget: usize,
        sink: &mut Sink<'_>,
    ) -> bool {
        let heard = dump.lines().take(ENOUGH_LINES);
        let heard = heard.filter(|line| line.direction != Some(Direction::Sent));
        let shape = match self.shape {
            Some(shape) => shape,
            None => decoder.likeliest(&mut self.kept, heard.map(|line| line.bits)),
        };
        self.shape = Some(shape);
        let mut done = 0;
        for line in dump.lines_from(self.line) {
            if done >= budget.max(1) {
                break;
            }
            done += line.bits.bytes().len();
            self.line += 1;
            let frame = match line.direction {
                Some(Direction::Sent) => Err(Why::Request),
                Some(Direction::Received) | None => {
                    decoder.line_kept(&mut self.kept, line.bits, shape)
                }
            };
            match frame {
                Ok(mut frame) => {
                    frame.start = line.start;
                    frame.request = self.request.take();
                    self.summary.bytes += line.bits.bytes().len() as u64;
                    self.summary.frames += 1;
                    self.summary.bad += u64::from(!frame.ok());
                    sink(Decoded::Frame(frame));
                }
                Err(why) => {
                    self.request = (why == Why::Request).then_some(line.start);
                    self.skip(line.start, line.bits, why, sink);
                }
            }
        }
        self.line < dump.len()
    }
}

fn piece_out(
    piece: Piece<'_>,
    request: &mut Option<u64>,
    summary: &mut Summary,
    sink: &mut Sink<'_>,
) {
    let bits = Bits::of_bytes(piece.bytes);
    let start = piece.start;
    summary.bytes += piece.bytes.len() as u64;
    match piece.kind {
        PieceKind::Frame { layout, sure, .. } => {
            let frame = Frame {
                start,
                layout: Cow::Borrowed(layout),
                bits,
                sure,
                request: request.take(),
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
