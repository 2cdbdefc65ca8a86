//! Polynomials over GF(2): what CRCs are made of.

use super::Span;
use super::{Bits, mask};

/// A polynomial over GF(2) of degree up to 255; bit k of the number is the coefficient of x^k.
///
/// ```
/// use encoderscope::bits::Polynomial;
/// // x³+1 = (x+1)(x²+x+1)
/// let product = Polynomial::from(0b1001);
/// assert_eq!(product.divided(0b11.into()), Some((0b111.into(), 0.into())));
/// assert_eq!(product.gcd(0b111.into()), 0b111.into());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Polynomial {
    high: u128,
    low: u128,
}

impl From<u64> for Polynomial {
    fn from(coefficients: u64) -> Self {
        Self {
            high: 0,
            low: coefficients.into(),
        }
    }
}

impl Polynomial {
    /// How many coefficients there is room for.
    pub const BITS: usize = 256;

    /// Whether it is 0.
    #[must_use]
    pub const fn is_zero(self) -> bool {
        self.high == 0 && self.low == 0
    }

    /// The largest power of x in it; 0 has none.
    #[must_use]
    pub const fn degree(self) -> Option<u32> {
        match (self.high.checked_ilog2(), self.low.checked_ilog2()) {
            (Some(degree), _) => Some(128 + degree),
            (None, degree) => degree,
        }
    }

    /// The coefficients of x⁶³ … 1.
    #[must_use]
    pub const fn low(self) -> u64 {
        self.low as u64
    }

    /// The sum, which over GF(2) is the difference too.
    #[must_use]
    pub const fn plus(self, other: Self) -> Self {
        Self {
            high: self.high ^ other.high,
            low: self.low ^ other.low,
        }
    }

    /// The product with x^`by`; what exceeds the room is lost.
    #[must_use]
    pub const fn raised(self, by: u32) -> Self {
        match by {
            0 => self,
            1..128 => Self {
                high: self.high << by | self.low >> (128 - by),
                low: self.low << by,
            },
            128..256 => Self {
                high: self.low << (by - 128),
                low: 0,
            },
            _ => Self { high: 0, low: 0 },
        }
    }

    /// The quotient by the largest power of x that divides it.
    #[must_use]
    pub const fn without_x(self) -> Self {
        if self.low == 0 {
            let by = if self.high == 0 {
                0
            } else {
                self.high.trailing_zeros()
            };
            return Self {
                high: 0,
                low: self.high >> by,
            };
        }
        match self.low.trailing_zeros() {
            0 => self,
            by => Self {
                high: self.high >> by,
                low: self.low >> by | self.high << (128 - by),
            },
        }
    }

    /// This polynomial with the `width` bits of `value` behind it.
    #[must_use]
    pub const fn followed(self, value: u64, width: u32) -> Self {
        let low = Self {
            high: 0,
            low: (value & mask(width as usize)) as u128,
        };
        self.raised(width).plus(low)
    }

    /// This polynomial with the bits of a run behind it, as they stand.
    #[must_use]
    pub fn followed_by(mut self, bits: Bits<'_>, run: Span) -> Self {
        let mut at = run.start;
        while at < run.end() {
            let take = (run.end() - at).min(64);
            self = self.followed(bits.read(Span::new(at, take)), take as u32);
            at += take;
        }
        self
    }

    /// Quotient and remainder; nothing where the divisor is 0.
    #[must_use]
    pub fn divided(self, by: Self) -> Option<(Self, Self)> {
        let below = by.degree()?;
        let (mut quotient, mut rest) = (Self::default(), self);
        while let Some(over) = rest.degree().and_then(|degree| degree.checked_sub(below)) {
            rest = rest.plus(by.raised(over));
            quotient = quotient.plus(Self::from(1).raised(over));
        }
        Some((quotient, rest))
    }

    /// The remainder of a division; of one by 0 the polynomial itself.
    #[must_use]
    pub fn modulo(self, by: Self) -> Self {
        let Some(below) = by.degree() else {
            return self;
        };
        let mut rest = self;
        while let Some(over) = rest.degree().and_then(|degree| degree.checked_sub(below)) {
            rest = rest.plus(by.raised(over));
        }
        rest
    }

    /// The greatest common divisor.
    #[must_use]
    pub fn gcd(self, other: Self) -> Self {
        let (mut a, mut b) = (self, other);
        while !b.is_zero() {
            (a, b) = (b, a.modulo(b));
        }
        a
    }
}
