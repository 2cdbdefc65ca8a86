//! A check bit by bit: what the register holds after each of them.

use super::{Algorithm, Checksum};
use crate::bits::{Bits, Span};
use alloc::vec::Vec;

/// A parity is the shortest CRC: one bit, polynomial x+1.
const PARITY: Algorithm = Algorithm {
    width: 1,
    polynomial: 1,
    init: 0,
    refin: false,
    refout: false,
    xorout: 0,
};

/// One bit goes into the register.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// Where in the frame it stands.
    pub at: usize,
    /// Its level.
    pub bit: bool,
    /// Whether it differs from the bit that is shifted out, so that the polynomial is subtracted.
    pub subtracts: bool,
    /// The register afterwards.
    pub register: u64,
}

/// A check from its first bit to its result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Walk {
    /// The parameters; of a parity those of the CRC that it is.
    pub algorithm: Algorithm,
    /// The register before the first bit.
    pub start: u64,
    /// One step a bit, in the order in which they go in.
    pub steps: Vec<Step>,
    /// The register at the end, read out and inverted where the algorithm says so.
    pub result: u64,
}

impl Checksum {
    /// The check over a run of bits, step by step.
    ///
    /// ```
    /// use encoderscope::{bits::{Bits, Span}, check::Checksum};
    /// let (bits, all) = (Bits::of_bytes(&[0b1010_0000]), Span::new(0, 3));
    /// let walk = Checksum::Crc6Biss.walk(bits, all);
    /// let registers: Vec<u64> = walk.steps.iter().map(|step| step.register).collect();
    /// assert_eq!(registers, [0b000011, 0b000110, 0b001111]);
    /// assert_eq!(walk.result, 0b110000);
    /// assert_eq!(walk.result, Checksum::Crc6Biss.compute(bits, all));
    /// ```
    #[must_use]
    pub fn walk(self, bits: Bits<'_>, over: Span) -> Walk {
        let odd = Algorithm {
            xorout: 1,
            ..PARITY
        };
        let parity = match self {
            Self::OddParity => odd,
            _ => PARITY,
        };
        let algorithm = self.algorithm().unwrap_or(parity);
        let start = algorithm.start();
        let mut register = start;
        let mut steps = Vec::with_capacity(over.len);
        algorithm.order(over, |at| {
            let bit = bits.bit(at);
            let subtracts = algorithm.subtracts(register, bit);
            register = algorithm.shifted(register, bit);
            steps.push(Step {
                at,
                bit,
                subtracts,
                register,
            });
        });
        Walk {
            algorithm,
            start,
            steps,
            result: algorithm.result(register),
        }
    }
}
