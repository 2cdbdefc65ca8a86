//! What the benches decode: the same bytes for the core and for whatever is measured beside it.

use crate::{Noise, decoder};
use encoderscope::{
    columns::Columns,
    decode::{Decoder, Words},
    dump::Reader,
    framing::Framer,
    reading::Values,
};

/// What a serial port delivers at once, in bytes.
pub const CHUNK: usize = 65_536;
/// One byte in so many is changed, lost or doubled in a noisy stream.
const NOISE: u64 = 100;
/// Frames of the way of the shaft, a hundred turns.
const FRAMES: u32 = 270_000;

/// Frames of one profile, in one writing.
#[derive(Clone, Copy, Debug)]
pub struct Workload {
    /// Its name, in kebab-case.
    pub name: &'static str,
    /// What it is, in a few words.
    pub title: &'static str,
    /// The profile, as [`decoder`] takes it.
    pub parameters: &'static str,
    /// How the frames come.
    pub writing: Writing,
}

/// How frames come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Writing {
    /// One behind the other.
    Stream,
    /// The same, with one byte in a hundred changed, lost or doubled.
    Noise,
    /// Words of as many whole bytes as a frame needs, as an SPI controller stores them.
    Words,
    /// A line of hexadecimal digits each.
    Text,
}

/// What was decoded, in two numbers that depend on every frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sums {
    /// Frames with an angle.
    pub frames: u64,
    /// The angles, added up.
    pub angles: u64,
}

impl Sums {
    /// Adds what is in columns.
    pub fn add(&mut self, columns: &Columns) {
        self.frames += columns.len() as u64;
        self.angles += columns.angle.iter().sum::<u64>();
    }
}

/// What `make bench` has a row for.
pub const WORKLOADS: [Workload; 6] = [
    Workload {
        name: "period",
        title: "`period`",
        parameters: "format=period",
        writing: Writing::Stream,
    },
    Workload {
        name: "t485",
        title: "`t485`, all data",
        parameters: "format=t485",
        writing: Writing::Stream,
    },
    Workload {
        name: "asi1",
        title: "`asi1`",
        parameters: "format=asi1",
        writing: Writing::Stream,
    },
    Workload {
        name: "asi1-noise",
        title: "`asi1`, 1 % of bytes bad",
        parameters: "format=asi1",
        writing: Writing::Noise,
    },
    Workload {
        name: "biss-c",
        title: "`biss-c` 24BM, words",
        parameters: "format=biss-c angle-bits=24 turns-bits=16",
        writing: Writing::Words,
    },
    Workload {
        name: "biss-c-text",
        title: "`biss-c` 24BM, hex text",
        parameters: "format=biss-c angle-bits=24 turns-bits=16",
        writing: Writing::Text,
    },
];

/// Input of growing length: a name, and how many times as long as usual it is.
pub const GROWTH: [(&str, f64); 5] = [
    ("1-64", 1.0 / 64.0),
    ("1-16", 1.0 / 16.0),
    ("1-4", 0.25),
    ("1", 1.0),
    ("4", 4.0),
];

impl Workload {
    /// A decoder of its frames.
    #[must_use]
    pub fn decoder(&self) -> Decoder {
        decoder(self.parameters)
    }

    /// At most `bytes` of a shaft that goes the same way again and again, in whole frames, and
    /// what was encoded; more of it begins with the same bytes.
    #[must_use]
    pub fn input(&self, bytes: usize) -> (Vec<u8>, Sums) {
        let frames = self.frames();
        let mut out = Vec::with_capacity(bytes);
        let mut sums = Sums::default();
        let mut noise = Noise::new(1);
        for (frame, angle) in frames.iter().cycle() {
            let before = out.len();
            self.write(frame, &mut noise, &mut out);
            if out.len() > bytes {
                out.truncate(before);
                break;
            }
            sums.frames += 1;
            sums.angles += angle;
        }
        (out, sums)
    }

    /// The frames of a stretch of the way, and the angle that each says.
    fn frames(&self) -> Vec<(Vec<u8>, u64)> {
        let decoder = self.decoder();
        let counts = 2f64.powi(decoder.profile().angle_bits as i32);
        let frame = |index| {
            // The turns do not fit a byte: no frame begins with a zero.
            let position = 300.3 + f64::from(index) * 0.000_37;
            let angle = (position.fract() * counts) as u64;
            let frame = decoder.encode(&Values {
                turns: Some(position as i64),
                angle: Some(angle),
                error: Some(false),
                valid: Some(true),
                ..Values::default()
            });
            (frame.into_bytes(), angle)
        };
        (0..FRAMES).map(frame).collect()
    }

    fn write(&self, frame: &[u8], noise: &mut Noise, out: &mut Vec<u8>) {
        match self.writing {
            Writing::Stream | Writing::Words => out.extend(frame),
            Writing::Noise => {
                for byte in frame {
                    match (noise.below(NOISE), noise.below(3)) {
                        (0, 0) => out.push(byte ^ (1 + noise.below(255)) as u8),
                        (0, 1) => out.extend([byte, byte]),
                        (0, _) => {}
                        _ => out.push(*byte),
                    }
                }
            }
            Writing::Text => {
                for (index, byte) in frame.iter().enumerate() {
                    let separator = if index > 0 { " " } else { "" };
                    out.extend(format!("{separator}{byte:02X}").into_bytes());
                }
                out.push(b'\n');
            }
        }
    }

    /// Whether `read` is what `made` frames should give: where bytes are bad, most frames; else
    /// each of them.
    #[must_use]
    pub fn admits(&self, made: Sums, read: Sums) -> bool {
        match self.writing {
            Writing::Noise => (made.frames * 3 / 4..=made.frames).contains(&read.frames),
            Writing::Stream | Writing::Words | Writing::Text => read == made,
        }
    }

    /// Decodes all of it, as it comes; `sink` gets the columns of every chunk.
    pub fn read(&self, decoder: &Decoder, input: &[u8], sink: &mut dyn FnMut(&Columns)) {
        match self.writing {
            Writing::Stream | Writing::Noise => stream(decoder, input, sink),
            Writing::Words => words(decoder, input, sink),
            Writing::Text => text(decoder, input, sink),
        }
    }
}

fn stream(decoder: &Decoder, input: &[u8], sink: &mut dyn FnMut(&Columns)) {
    let mut framer = Framer::at_start();
    let mut columns = Columns::default();
    for chunk in input.chunks(CHUNK) {
        framer.push_runs(decoder, chunk, &mut |run| columns.take(&run));
        sink(&columns);
        columns.clear();
    }
    framer.finish_runs(decoder, &mut |run| columns.take(&run));
    sink(&columns);
}

fn words(decoder: &Decoder, input: &[u8], sink: &mut dyn FnMut(&Columns)) {
    let bits = decoder.main_layout().len.next_multiple_of(8);
    let head = input.get(..CHUNK).unwrap_or(input);
    let mut words = Words::new(decoder, bits, head);
    let mut columns = Columns::default();
    for chunk in input.chunks(CHUNK) {
        words.push_runs(decoder, chunk, &mut |run| columns.take(&run));
        sink(&columns);
        columns.clear();
    }
}

fn text(decoder: &Decoder, input: &[u8], sink: &mut dyn FnMut(&Columns)) {
    let head = String::from_utf8_lossy(input.get(..CHUNK).unwrap_or(input));
    let mut reader = Reader::new(decoder.profile().medium(), &head);
    for chunk in input.chunks(CHUNK) {
        reader.push(chunk);
    }
    let mut columns = Columns::default();
    decoder.dump_runs(&reader.finish(), &mut |run| columns.take(&run));
    sink(&columns);
}
