//! Bit strings: the only module that shifts.
//!
//! A bit string is read as a wire or a byte dump shows it: bit 0 comes first and is the most
//! significant bit of the first byte. Numbers inside it are most significant bit first.

mod polynomial;

pub use polynomial::Polynomial;

use alloc::vec::Vec;

/// A run of bits inside a bit string.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Span {
    /// Index of the first bit.
    pub start: usize,
    /// Number of bits.
    pub len: usize,
}

impl Span {
    /// A run of `len` bits from `start`.
    #[must_use]
    pub const fn new(start: usize, len: usize) -> Self {
        Self { start, len }
    }

    /// Index one past the last bit.
    #[must_use]
    pub const fn end(self) -> usize {
        self.start + self.len
    }

    /// Whether the bit `index` lies in this run.
    #[must_use]
    pub const fn contains(self, index: usize) -> bool {
        index >= self.start && index < self.end()
    }
}

/// A borrowed bit string.
///
/// ```
/// use encoderscope::bits::{Bits, Span};
/// let bits = Bits::of_bytes(&[0b1000_0010, 0xff]);
/// assert_eq!(bits.read(Span::new(6, 4)), 0b1011);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bits<'a> {
    bytes: &'a [u8],
    len: usize,
}

impl<'a> Bits<'a> {
    /// All bits of `bytes`.
    #[must_use]
    pub const fn of_bytes(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            len: bytes.len() * 8,
        }
    }

    /// The first `len` bits, or all where there are fewer.
    ///
    /// ```
    /// use encoderscope::bits::Bits;
    /// assert_eq!(Bits::of_bytes(&[0x12, 0x34]).prefix(7).bytes(), [0x12]);
    /// ```
    #[must_use]
    pub fn prefix(self, len: usize) -> Self {
        let len = len.min(self.len);
        let bytes = self.bytes.get(..len.div_ceil(8)).unwrap_or_default();
        Self { bytes, len }
    }

    /// Number of bits.
    #[must_use]
    pub const fn len(self) -> usize {
        self.len
    }

    /// Whether there are no bits.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.len == 0
    }

    /// The bytes that hold the bits; unused low bits of the last one are zero or idle.
    #[must_use]
    pub const fn bytes(self) -> &'a [u8] {
        self.bytes
    }

    /// The bit at `index`; bits beyond the end read as 0.
    #[must_use]
    pub fn bit(self, index: usize) -> bool {
        index < self.len && (self.bytes[index / 8] >> (7 - index % 8)) & 1 == 1
    }

    /// The number in `span`, most significant bit first; of spans over 64 bits the last 64.
    #[must_use]
    pub fn read(self, span: Span) -> u64 {
        let (first, last) = (span.start / 8, span.end().div_ceil(8));
        if last <= first + 8
            && span.end() <= self.len
            && let Some(bytes) = self.bytes.get(first..last)
        {
            return (word(bytes) >> (last * 8 - span.end())) & mask(span.len);
        }
        let mut value = 0u64;
        let mut at = span.start;
        while at < span.end() {
            let take = (8 - at % 8).min(span.end() - at);
            let byte = if at < self.len { self.bytes[at / 8] } else { 0 };
            let part = (u64::from(byte) >> (8 - at % 8 - take)) & mask(take);
            value = (value << take) | part;
            at += take;
        }
        value
    }

    /// The number in `span` as bytes, big-endian, with zero bits in front.
    ///
    /// A checksum that starts from 0 is not changed by those zeros, so a byte-wise CRC serves
    /// bit strings of any length. Returns the bytes and how many of them are used, at the end.
    #[must_use]
    pub fn right_aligned<const N: usize>(self, span: Span) -> ([u8; N], usize) {
        let mut out = [0; N];
        let count = span.len.div_ceil(8).min(N);
        let mut end = span.end();
        for slot in out.iter_mut().rev().take(count) {
            let start = end.saturating_sub(8).max(span.start);
            *slot = low_byte(self.read(Span::new(start, end - start)));
            end = start;
        }
        (out, count)
    }
}

impl Bits<'_> {
    /// The number that the bytes in `span` write in ASCII digits; `None` where one is no digit.
    #[must_use]
    pub fn decimal(self, span: Span) -> Option<u64> {
        let digits = self.bytes.get(span.start / 8..span.end() / 8)?;
        digits.iter().try_fold(0u64, |number, digit| {
            let digit = char::from(*digit).to_digit(10)?;
            number.checked_mul(10)?.checked_add(digit.into())
        })
    }
}

/// An owned bit string.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BitString {
    bytes: Vec<u8>,
    len: usize,
}

impl BitString {
    /// `len` zero bits.
    #[must_use]
    pub fn zeros(len: usize) -> Self {
        Self {
            bytes: alloc::vec![0; len.div_ceil(8)],
            len,
        }
    }

    /// All bits of `bytes`.
    #[must_use]
    pub fn of_bytes(bytes: Vec<u8>) -> Self {
        let len = bytes.len() * 8;
        Self { bytes, len }
    }

    /// Appends one bit.
    pub fn push(&mut self, bit: bool) {
        if self.len.is_multiple_of(8) {
            self.bytes.push(0);
        }
        self.len += 1;
        self.write(Span::new(self.len - 1, 1), u64::from(bit));
    }

    /// Puts the low bits of `value` into `span`, its top bit into what is wider than 64; bits
    /// beyond the end are dropped.
    pub fn write(&mut self, span: Span, value: u64) {
        for (offset, index) in (span.start..span.end()).rev().enumerate() {
            if index < self.len {
                let at = 0x80 >> (index % 8);
                if (value >> offset.min(63)) & 1 == 1 {
                    self.bytes[index / 8] |= at;
                } else {
                    self.bytes[index / 8] &= !at;
                }
            }
        }
    }

    /// Writes `value` in ASCII digits into the bytes of `span`; digits beyond it are dropped.
    pub fn write_decimal(&mut self, span: Span, mut value: u64) {
        for start in (span.start..span.end()).step_by(8).rev() {
            self.write(Span::new(start, 8), u64::from(b'0') + value % 10);
            value /= 10;
        }
    }

    /// Turns the bit at `index` over.
    pub fn flip(&mut self, index: usize) {
        let now = self.as_bits().bit(index);
        self.write(Span::new(index, 1), u64::from(!now));
    }

    /// A view of all bits.
    #[must_use]
    pub fn as_bits(&self) -> Bits<'_> {
        Bits {
            bytes: &self.bytes,
            len: self.len,
        }
    }

    /// The bytes that hold the bits.
    #[must_use]
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}

/// Up to eight bytes as one number, the first byte the most significant.
#[must_use]
#[inline]
pub fn word(bytes: &[u8]) -> u64 {
    match (bytes.first_chunk::<4>(), bytes.last_chunk::<4>()) {
        // The two halves overlap where there are fewer than eight bytes, and agree there.
        (Some(first), Some(last)) => {
            let below = (bytes.len().min(8) - 4) * 8;
            u64::from(u32::from_be_bytes(*first)) << below | u64::from(u32::from_be_bytes(*last))
        }
        _ => bytes
            .iter()
            .fold(0, |word, byte| word << 8 | u64::from(*byte)),
    }
}

/// `width` ones, right-aligned; 64 or more give all ones.
#[must_use]
#[inline]
pub const fn mask(width: usize) -> u64 {
    if width >= 64 {
        u64::MAX
    } else {
        (1 << width) - 1
    }
}

/// How many codes a number of `width` bits has: 2^`width`.
#[must_use]
pub const fn codes(width: u32) -> u128 {
    1 << if width > 127 { 127 } else { width }
}

/// 2^`width` as a floating-point number, for widths up to 1023.
#[must_use]
#[inline]
pub(crate) const fn power(width: u32) -> f64 {
    let exponent = if width > 1023 {
        2046
    } else {
        1023 + width as u64
    };
    f64::from_bits(exponent << 52)
}

/// The bit of `value` at `place`, 0 being the least significant.
#[must_use]
pub const fn bit(value: u64, place: u32) -> bool {
    place < 64 && (value >> place) & 1 == 1
}

/// The `width` bits of `value` whose least significant one stands at `place`.
#[must_use]
#[inline]
pub const fn slice(value: u64, place: u32, width: usize) -> u64 {
    if place > 63 {
        0
    } else {
        (value >> place) & mask(width)
    }
}

/// What of `value` stands above its lowest `place` bits, for places below 64.
#[must_use]
#[inline]
pub const fn above(value: u64, place: u32) -> u64 {
    value.wrapping_shr(place)
}

/// `value` turned to the right by `count` bits, or by what is left of them over whole turns: what
/// leaves it below comes back above.
#[must_use]
#[inline]
pub const fn turned(value: u64, count: u32) -> u64 {
    value.rotate_right(count % 64)
}

/// `value` as a number whose bit `sign`, a power of two above which nothing stands, counts negative;
/// 0 leaves it as it is.
#[must_use]
#[inline]
pub(crate) const fn extended(value: u64, sign: u64) -> u64 {
    (value ^ sign).wrapping_sub(sign)
}

/// `value` moved up so that its least significant bit stands at `place`.
#[must_use]
#[inline]
pub const fn placed(value: u64, place: u32) -> u64 {
    if place > 63 { 0 } else { value << place }
}

/// The number that a Gray code of up to 64 bits stands for.
///
/// ```
/// use encoderscope::bits::{from_gray, to_gray};
/// assert_eq!((to_gray(4), from_gray(0b0110)), (0b0110, 4));
/// ```
#[must_use]
pub const fn from_gray(code: u64) -> u64 {
    let mut value = code;
    let mut step = 1;
    while step < 64 {
        value ^= value >> step;
        step *= 2;
    }
    value
}

/// The Gray code of a number: neighbours differ in one bit.
#[must_use]
pub const fn to_gray(value: u64) -> u64 {
    value ^ (value >> 1)
}

/// The low `width` bits of `value` in the opposite order.
///
/// ```
/// assert_eq!(encoderscope::bits::reversed(0b0011, 4), 0b1100);
/// ```
#[must_use]
pub const fn reversed(value: u64, width: u32) -> u64 {
    match width {
        0 => 0,
        1..64 => (value & mask(width as usize)).reverse_bits() >> (64 - width),
        _ => value.reverse_bits(),
    }
}

/// How many decimal digits a number has.
#[must_use]
pub const fn decimal_digits(value: u64) -> u32 {
    match value.checked_ilog10() {
        Some(log) => log + 1,
        None => 1,
    }
}

/// The low `width` bits of `value` as a two's-complement number.
#[must_use]
pub const fn signed(value: u64, width: usize) -> i64 {
    if width == 0 || width >= 64 {
        return value as i64;
    }
    let sign = 1 << (width - 1);
    ((value & mask(width)) ^ sign) as i64 - sign as i64
}

/// The low sixteen bits.
#[must_use]
#[inline]
pub const fn low_word(value: u64) -> u16 {
    (value & 0xffff) as u16
}

/// The low eight bits.
#[must_use]
#[inline]
pub const fn low_byte(value: u64) -> u8 {
    (value & 0xff) as u8
}
