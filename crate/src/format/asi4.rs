//! ASI4: the text stream of the IP-75 inductosyn (IP-75, 5.3.2).
//!
//! 230 400 baud, 8N1; every two milliseconds a decimal number in ASCII, then CR LF. Pasted lines
//! of numbers are read as they are.
//!
//! ```
//! use encoderscope::{decode::Decoder, profile::Profile};
//! let decoder = Decoder::new(Profile::parse([("format", "asi4")])?)?;
//! let frame = decoder.frame(b"8192\r\n").unwrap();
//! let values = frame.values();
//! assert_eq!(values.angle, Some(8192));
//! assert_eq!(decoder.encode(&values).into_bytes(), b"8192\r\n");
//! assert!(!decoder.frame(b"16384\r\n").unwrap().ok());
//! # Ok::<(), encoderscope::profile::ProfileError>(())
//! ```
//!
//! Where the manual misleads: it gives the range as 0…16384; 14 bits end at 16383.

use super::{Format, Limits, Manual, Link, Spec, said, spared};
use crate::{
    layout::{Resolved, Shape, layout},
    profile::Profile,
};

/// ASI4.
pub const SPEC: Spec = Spec {
    name: "asi4",
    title: "ASI4",
    link: Link::Stream,
    parameters: &["angle-bits", "baud"],
    quantities: &[],
    limits: Limits {
        angle: 16,
        turns: 0,
        together: 16,
        frame: (0, 0),
    },
    interval: Some(INTERVAL),
    default: Profile {
        angle_bits: 14,
        turns_bits: 0,
        baud: 230_400,
        ..Profile::base(Format::Asi4)
    },
};

/// What its manual says of it.
pub const MANUAL: Manual = Manual {
    about: said("the text stream of the IP-75 inductosyn"),
    source: said("IP-75, 5.3.2"),
    timing: None,
    example: spared("8190\n8191\n8192\n"),
    guesses: &[],
    layouts: |_, shape| (1..=DIGITS as u32).map(|digits| Resolved::new(&LINE, Shape { digits, ..shape })).collect(),
};

/// Microseconds from one line to the next.
pub const INTERVAL: u64 = 2_000;
/// The most digits that a line can have.
pub const DIGITS: usize = 5;

layout! {
    /// ASI4 line.
    pub static LINE(p) {
        decimal {
            /// Angle within one turn, in decimal digits.
            angle: Angle[8 * p.digits];
        }
        /// Carriage return.
        cr: Framing[8], constant = Some(0x0d);
        /// Line feed.
        lf: Framing[8], constant = Some(0x0a);
    }
}

/// How many digits the line at the start of `bytes` has; nothing where no line is.
#[must_use]
pub fn digits(bytes: &[u8]) -> Option<usize> {
    let end = bytes
        .iter()
        .take(DIGITS + 1)
        .position(|byte| *byte == b'\r')?;
    (end > 0 && bytes[..end].iter().all(u8::is_ascii_digit)).then_some(end)
}

/// The number in the whole line at the start of `bytes`, and the bytes of the line; nothing where
/// no line is.
///
/// ```
/// use encoderscope::format::asi4::number;
/// assert_eq!(number(b"512\r\n513"), Some((512, 5)));
/// assert_eq!((number(b"512\r"), number(b"\r\n"), number(b"123456\r\n")), (None, None, None));
/// ```
#[must_use]
#[inline]
pub fn number(bytes: &[u8]) -> Option<(u64, usize)> {
    let mut number = 0;
    for (at, byte) in bytes.iter().take(DIGITS + 1).enumerate() {
        match byte.wrapping_sub(b'0') {
            digit @ 0..10 if at < DIGITS => number = number * 10 + u64::from(digit),
            _ if at > 0 && *byte == b'\r' => {
                return (bytes.get(at + 1) == Some(&b'\n')).then_some((number, at + 2));
            }
            _ => return None,
        }
    }
    None
}
