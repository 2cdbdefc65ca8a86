//! Checksums of the frames of the MPP and PT manuals, computed with the `crc` crate.
//!
//! All of them start from 0, so leading zero bits do not change them: a bit string of any
//! length is right-aligned into bytes first.

use crate::bits::{Bits, Span};
use crc::{Algorithm, Crc};

/// The longest checked run: 64 data bits, two flags and 16 status bits of BiSS-C, rounded up.
const LONGEST: usize = 16;

static CRC8_97: Crc<u8> = Crc::<u8>::new(&Algorithm {
    width: 8,
    poly: 0x97,
    init: 0,
    refin: false,
    refout: false,
    xorout: 0,
    check: 0x94,
    residue: 0,
});

static CRC8_XOR: Crc<u8> = Crc::<u8>::new(&Algorithm {
    width: 8,
    poly: 0x01,
    init: 0,
    refin: false,
    refout: false,
    xorout: 0,
    check: 0x31,
    residue: 0,
});

static CRC6_BISS: Crc<u8> = Crc::<u8>::new(&Algorithm {
    width: 6,
    poly: 0x03,
    init: 0,
    refin: false,
    refout: false,
    xorout: 0x3f,
    check: 0x2e,
    residue: 0,
});

/// How a check field is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Checksum {
    /// x⁸+x⁷+x⁴+x²+x+1: RS485, RS422, PERIOD (MPP and PT, appendix CRC-8).
    Crc8x97,
    /// x⁸+1, which is the exclusive or of all bytes: T485, BUS (MPP, appendix).
    Crc8Xor,
    /// x⁶+x+1, inverted on the wire: BiSS-C (MPP, appendix CRC-6).
    Crc6Biss,
    /// One bit that makes the number of ones even: the control field of T485.
    EvenParity,
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
        if self == Self::EvenParity {
            return u64::from(bits.read(over).count_ones() % 2);
        }
        let crc = match self {
            Self::Crc8x97 => &CRC8_97,
            Self::Crc8Xor => &CRC8_XOR,
            Self::Crc6Biss | Self::EvenParity => &CRC6_BISS,
        };
        if over.start.is_multiple_of(8) && over.len.is_multiple_of(8) && over.end() <= bits.len() {
            return u64::from(crc.checksum(&bits.bytes()[over.start / 8..over.end() / 8]));
        }
        let (bytes, used) = bits.right_aligned::<LONGEST>(over);
        u64::from(crc.checksum(&bytes[LONGEST - used..]))
    }

    /// Number of bits of the check field.
    #[must_use]
    pub const fn width(self) -> u32 {
        match self {
            Self::Crc8x97 | Self::Crc8Xor => 8,
            Self::Crc6Biss => 6,
            Self::EvenParity => 1,
        }
    }

    /// The name with the polynomial, as a person would look it up.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Crc8x97 => "CRC-8, x⁸+x⁷+x⁴+x²+x+1",
            Self::Crc8Xor => "CRC-8, x⁸+1 (exclusive or of all bytes)",
            Self::Crc6Biss => "CRC-6, x⁶+x+1, sent inverted",
            Self::EvenParity => "even parity",
        }
    }
}
