//! Checksums of the frames of the manuals, and of a user's own, computed with the `crc` crate.
//!
//! Those of the manuals start from 0, so leading zero bits do not change them: a bit string of any
//! length is right-aligned into bytes first. One that does not, or is reflected, covers whole
//! bytes: [`crate::format::own`] refuses any other.

mod algorithm;
mod walk;

pub use algorithm::Algorithm;
pub use walk::{Step, Walk};

use crate::{
    bits::{self, Bits, Span},
    language::{in_english, msg, t},
};
use alloc::{
    boxed::Box,
    string::{String, ToString},
};
use core::fmt;
use crc::{Crc, NoTable};

/// How checksums are looked up.
#[cfg(not(feature = "small"))]
type Lookup = crc::Table<1>;
#[cfg(feature = "small")]
type Lookup = NoTable;

/// The longest checked run in bytes that does not consist of whole bytes: that of the longest
/// layout a user may write.
const LONGEST: usize = 32;

static CRC8_97: Crc<u8, Lookup> = Crc::<u8, Lookup>::new(&X97);

/// x⁸+x⁷+x⁴+x²+x+1.
const X97: crc::Algorithm<u8> = crc::Algorithm {
    width: 8,
    poly: 0x97,
    init: 0,
    refin: false,
    refout: false,
    xorout: 0,
    check: 0x94,
    residue: 0,
};

static CRC8_XOR: Crc<u8, Lookup> = Crc::<u8, Lookup>::new(&XOR);

/// x⁸+1.
const XOR: crc::Algorithm<u8> = crc::Algorithm {
    width: 8,
    poly: 0x01,
    init: 0,
    refin: false,
    refout: false,
    xorout: 0,
    check: 0x31,
    residue: 0,
};

static CRC6_BISS: Crc<u8, Lookup> = Crc::<u8, Lookup>::new(&BISS);

/// x⁶+x+1, inverted.
const BISS: crc::Algorithm<u8> = crc::Algorithm {
    width: 6,
    poly: 0x03,
    init: 0,
    refin: false,
    refout: false,
    xorout: 0x3f,
    check: 0x2e,
    residue: 0,
};

static CRC16_8005: Crc<u16, Lookup> = Crc::<u16, Lookup>::new(&crc::CRC_16_UMTS);

/// How a check field is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Checksum {
    /// x⁸+x⁷+x⁴+x²+x+1: RS485, RS422, PERIOD (MPP and PT, appendix CRC-8).
    Crc8x97,
    /// x⁸+1, which is the exclusive or of all bytes: T485, BUS (MPP, appendix).
    Crc8Xor,
    /// x⁶+x+1, inverted on the wire: BiSS-C (MPP, appendix CRC-6).
    Crc6Biss,
    /// x¹⁶+x¹⁵+x²+1: ASI1 (IP-75, 5.3.1).
    Crc16x8005,
    /// One bit that makes the number of ones even: the control field of T485, SSI7.
    EvenParity,
    /// One bit that makes the number of ones odd: the request of BUS.
    OddParity,
    /// A CRC of the user's own.
    Own(&'static OwnCrc),
}

impl Checksum {
    /// The value the check field must hold for the covered bits.
    ///
    /// ```
    /// use encoderscope::{bits::{Bits, Span}, check::Checksum};
    /// let text = b"123456789";
    /// let all = Span::new(0, 72);
    /// assert_eq!(Checksum::Crc8x97.compute(Bits::of_bytes(text), all), 0x94);
    /// assert_eq!(Checksum::Crc6Biss.compute(Bits::of_bytes(text), all), 0x2e);
    /// ```
    #[must_use]
    pub fn compute(self, bits: Bits<'_>, over: Span) -> u64 {
        let ones = || {
            let words = (over.start..over.end()).step_by(64);
            let word = |at: usize| bits.read(Span::new(at, 64.min(over.end() - at)));
            u64::from(words.map(|at| word(at).count_ones()).sum::<u32>() % 2)
        };
        let whole = over.start.is_multiple_of(8) && over.len.is_multiple_of(8);
        let run = bits.bytes().get(over.start / 8..over.end() / 8);
        let padded;
        let bytes = match run {
            Some(run) if whole => run,
            _ => {
                let (bytes, used) = bits.right_aligned::<LONGEST>(over);
                padded = bytes;
                &padded[LONGEST - used..]
            }
        };
        match self {
            Self::Crc8x97 => CRC8_97.checksum(bytes).into(),
            Self::Crc8Xor => CRC8_XOR.checksum(bytes).into(),
            Self::Crc6Biss => CRC6_BISS.checksum(bytes).into(),
            Self::Crc16x8005 => CRC16_8005.checksum(bytes).into(),
            Self::EvenParity => ones(),
            Self::OddParity => 1 - ones(),
            Self::Own(own) => own.crc.checksum(bytes).into(),
        }
    }

    /// The parameters of the CRC; a parity has none.
    ///
    /// ```
    /// use encoderscope::check::Checksum;
    /// let crc = Checksum::Crc6Biss.algorithm().unwrap();
    /// assert_eq!((crc.width, crc.polynomial, crc.xorout), (6, 0x03, 0x3f));
    /// assert!(Checksum::EvenParity.algorithm().is_none());
    /// ```
    #[must_use]
    pub const fn algorithm(self) -> Option<Algorithm> {
        match self {
            Self::Crc8x97 => Some(Algorithm::of_u8(&X97)),
            Self::Crc8Xor => Some(Algorithm::of_u8(&XOR)),
            Self::Crc6Biss => Some(Algorithm::of_u8(&BISS)),
            Self::Crc16x8005 => Some(Algorithm::of_u16(&crc::CRC_16_UMTS)),
            Self::Own(own) => Some(own.algorithm),
            Self::EvenParity | Self::OddParity => None,
        }
    }

    /// Number of bits of the check field.
    #[must_use]
    pub const fn width(self) -> u32 {
        match self {
            Self::Crc8x97 | Self::Crc8Xor => 8,
            Self::Crc6Biss => 6,
            Self::Crc16x8005 => 16,
            Self::EvenParity | Self::OddParity => 1,
            Self::Own(own) => own.algorithm.width,
        }
    }

    /// Whether zeros in front of what it covers leave it as it is, and a good run followed by
    /// zeros is good again.
    pub(crate) const fn ignores_zeros(self) -> bool {
        match self {
            Self::Crc8x97 => true,
            Self::Own(own) => own.algorithm.init == 0 && own.algorithm.xorout == 0,
            _ => false,
        }
    }

    /// The name with the polynomial, as a person would look it up.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Crc8x97 => msg("CRC-8, x⁸+x⁷+x⁴+x²+x+1"),
            Self::Crc8Xor => msg("CRC-8, x⁸+1 (exclusive or of all bytes)"),
            Self::Crc6Biss => msg("CRC-6, x⁶+x+1, sent inverted"),
            Self::Crc16x8005 => msg("CRC-16, x¹⁶+x¹⁵+x²+1"),
            Self::EvenParity => msg("even parity"),
            Self::OddParity => msg("odd parity"),
            Self::Own(own) => &own.name,
        }
    }

    /// The same for people, in their language.
    #[must_use]
    pub fn title(self) -> String {
        match self {
            Self::Own(own) => own.algorithm.to_string(),
            other => t(other.name()).into(),
        }
    }
}

/// A CRC whose parameters a user gave.
pub struct OwnCrc {
    name: String,
    algorithm: Algorithm,
    crc: Crc<u16, NoTable>,
}

impl OwnCrc {
    /// The CRC of an algorithm, for as long as the program runs.
    #[must_use]
    pub fn new(algorithm: Algorithm) -> Self {
        let word = |value: u64| bits::low_word(value);
        let leaked = Box::leak(Box::new(crc::Algorithm {
            width: bits::low_byte(algorithm.width.into()),
            poly: word(algorithm.polynomial),
            init: word(algorithm.init),
            refin: algorithm.refin,
            refout: algorithm.refout,
            xorout: word(algorithm.xorout),
            check: 0,
            residue: 0,
        }));
        Self {
            name: in_english(|| algorithm.to_string()),
            algorithm,
            crc: Crc::<u16, NoTable>::new(leaked),
        }
    }
}

impl PartialEq for OwnCrc {
    fn eq(&self, other: &Self) -> bool {
        self.algorithm == other.algorithm
    }
}

impl Eq for OwnCrc {}

impl fmt::Debug for OwnCrc {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)
    }
}
