//! What the tests of the core share.

pub mod captures;
pub mod fuzz;
pub mod golden;
pub mod workload;

use encoderscope::{
    decode::{Decoded, Decoder},
    dump::{self, Dump},
    framing::{Framer, PieceKind},
    profile::Profile,
};

/// A decoder from parameters written `name=value` with spaces between.
///
/// # Panics
///
/// The parameters are wrong.
#[must_use]
pub fn decoder(parameters: &str) -> Decoder {
    let pairs = parameters
        .split_whitespace()
        .map(|pair| pair.split_once('=').expect("name=value"));
    Decoder::new(Profile::parse(pairs).expect("a profile")).expect("a decoder")
}

/// A dump as a user would paste it for this decoder.
#[must_use]
pub fn paste(decoder: &Decoder, text: &str) -> Dump {
    dump::parse(text, decoder.profile().medium())
}

/// A stretch of decoded input, in short.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stretch {
    /// Offset, bytes, and whether every check holds.
    Frame(u64, Vec<u8>, bool),
    /// Offset, bytes, and why.
    Skip(u64, Vec<u8>, String),
}

impl Stretch {
    /// Its bytes.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        match self {
            Self::Frame(_, bytes, _) | Self::Skip(_, bytes, _) => bytes,
        }
    }

    /// Where it starts in the input.
    #[must_use]
    pub fn start(&self) -> u64 {
        match self {
            Self::Frame(start, ..) | Self::Skip(start, ..) => *start,
        }
    }

    /// Whether it is a frame whose every check holds.
    #[must_use]
    pub fn is_good(&self) -> bool {
        matches!(self, Self::Frame(.., true))
    }
}

/// All stretches of a dump.
#[must_use]
pub fn stretches(decoder: &Decoder, dump: &Dump) -> Vec<Stretch> {
    let mut out = Vec::new();
    decoder.dump(dump, &mut |decoded| {
        out.push(match decoded {
            Decoded::Frame(frame) => {
                Stretch::Frame(frame.start, frame.bits.bytes().into(), frame.ok())
            }
            Decoded::Skip { start, bits, why } => {
                Stretch::Skip(start, bits.bytes().into(), why.to_string())
            }
        });
    });
    out
}

/// All stretches of a byte stream that arrives in `cuts` of bytes.
#[must_use]
pub fn framed(decoder: &Decoder, cuts: &[&[u8]]) -> Vec<Stretch> {
    let mut out = Vec::new();
    let mut framer = Framer::at_start();
    let mut sink = |piece: encoderscope::framing::Piece<'_>| {
        out.push(match piece.kind {
            PieceKind::Frame { sure, holds, .. } => {
                Stretch::Frame(piece.start, piece.bytes.into(), sure && holds)
            }
            PieceKind::Skip(why) => Stretch::Skip(piece.start, piece.bytes.into(), why.to_string()),
        });
    };
    for cut in cuts {
        framer.push(decoder, cut, &mut sink);
    }
    framer.finish(decoder, &mut sink);
    out
}

/// A small generator of repeatable noise (Marsaglia's xorshift).
#[derive(Clone, Debug)]
pub struct Noise(u64);

impl Noise {
    /// A generator from a seed.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// The next number.
    pub fn draw(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 16
    }

    /// A number below `limit`.
    pub fn below(&mut self, limit: u64) -> u64 {
        self.draw() % limit
    }
}

/// The same bytes, of which some are changed, lost, or have another one put in front.
#[must_use]
pub fn disturbed(bytes: &[u8], per_thousand: u64, random: &mut Noise) -> Vec<u8> {
    let mut disturbed = Vec::with_capacity(bytes.len() + bytes.len() / 32);
    for byte in bytes {
        match (random.below(1_000) < per_thousand, random.below(3)) {
            (false, _) => disturbed.push(*byte),
            (true, 0) => disturbed.push(byte ^ (1 + random.below(255)) as u8),
            (true, 1) => disturbed.extend([random.draw() as u8, *byte]),
            (true, _) => {}
        }
    }
    disturbed
}
