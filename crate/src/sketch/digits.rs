//! Frames as documents write them: digits, read strictly, nothing guessed.

use super::Sketch;
use crate::{
    bits::{BitString, Span},
    decode::Decoder,
    dump::Direction,
    format::Medium,
    framing::Why,
    language::t,
    say,
};
use alloc::vec::Vec;
use core::fmt;

/// Most digits that are read: no format's frame comes near it.
const LONGEST: usize = 4096;

/// Why digits are not read as a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DigitsError {
    /// There are none.
    Empty,
    /// This is none.
    NoDigit(char),
    /// They are no frame of the profile that goes this way.
    NoFrame(Why),
}

impl fmt::Display for DigitsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str(t("there are no digits")),
            Self::NoDigit(letter) => {
                say!(
                    f,
                    "\"{}\" is no digit, neither of hexadecimal numbers nor of bits",
                    letter
                )
            }
            Self::NoFrame(Why::Truncated { have, need }) => {
                say!(
                    f,
                    "{} bits are no frame of this profile: it has {}",
                    have,
                    need
                )
            }
            Self::NoFrame(_) => f.write_str(t("this is no frame of this profile")),
        }
    }
}

impl core::error::Error for DigitsError {}

impl Sketch {
    /// The example of the frame that stands for a profile: of the reply to `all` of T485 and to
    /// `get` of BUS, or of the request for it; `None` where nothing is asked.
    ///
    /// ```
    /// use encoderscope::{decode::Decoder, dump::Direction, format::Format, sketch::Sketch};
    /// let decoder = Decoder::new(Format::T485.default_profile())?;
    /// let request = Sketch::example(decoder, Direction::Sent).unwrap();
    /// assert_eq!(request.text(), "1a");
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    #[must_use]
    pub fn example(decoder: Decoder, direction: Direction) -> Option<Self> {
        let kinds = decoder.frame_kinds();
        let main = decoder.main_layout().layout;
        let reply = kinds.iter().position(|kind| {
            kind.direction == Direction::Received && core::ptr::eq(kind.layout.layout, main)
        })?;
        let at = match direction {
            Direction::Received => reply,
            Direction::Sent => reply.checked_sub(1)?,
        };
        let kind = kinds.into_iter().nth(at)?;
        Some(Self::new(decoder, kind))
    }

    /// A frame in digits: hexadecimal ones, or 0 and 1 alone where the format is clocked or has a
    /// frame of just so many bits. `0x` and `0b` in front decide; spaces and `: - , _` between
    /// digits are skipped.
    ///
    /// ```
    /// use encoderscope::{decode::Decoder, format::Format, sketch::Sketch};
    /// let decoder = Decoder::new(Format::T485.default_profile())?;
    /// let sketch = Sketch::of_digits(decoder, "02 20 b4 bd 1c 37", None)?;
    /// assert_eq!(sketch.kind().name, "angle");
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There are characters that are no digits, or they are no frame of the profile.
    pub fn of_digits(
        decoder: Decoder,
        text: &str,
        direction: Option<Direction>,
    ) -> Result<Self, DigitsError> {
        let text = text.trim();
        let (width, digits) = match (text.strip_prefix("0x"), text.strip_prefix("0b")) {
            (Some(rest), _) => (4, digits(rest, 16)?),
            (_, Some(rest)) => (1, digits(rest, 2)?),
            _ => {
                let digits = digits(text, 16)?;
                (digit_width(&decoder, &digits), digits)
            }
        };
        let mut bits = BitString::zeros(digits.len() * width);
        for (index, digit) in digits.iter().enumerate() {
            bits.write(Span::new(index * width, width), u64::from(*digit));
        }
        let sketch = Self::read(decoder, bits, direction).map_err(DigitsError::NoFrame)?;
        match direction {
            Some(wanted) if wanted != sketch.kind.direction => {
                Err(DigitsError::NoFrame(Why::NoFrame))
            }
            _ => Ok(sketch),
        }
    }
}

fn digits(text: &str, radix: u32) -> Result<Vec<u32>, DigitsError> {
    let letters = text
        .chars()
        .filter(|letter| !letter.is_whitespace() && !matches!(letter, ':' | '-' | ',' | '_'));
    let digits = letters
        .take(LONGEST + 1)
        .map(|letter| letter.to_digit(radix).ok_or(DigitsError::NoDigit(letter)))
        .collect::<Result<Vec<_>, _>>()?;
    match digits.len() {
        0 => Err(DigitsError::Empty),
        1..=LONGEST => Ok(digits),
        _ => Err(DigitsError::NoFrame(Why::NoFrame)),
    }
}

/// How many bits a digit stands for when nobody has said so.
fn digit_width(decoder: &Decoder, digits: &[u32]) -> usize {
    let has = |len: usize| {
        let mut kinds = decoder.frame_kinds().into_iter();
        kinds.any(|kind| kind.layout.len == len)
    };
    let binary = digits.iter().all(|digit| *digit < 2);
    let clocked = decoder.profile().medium() == Medium::Bits;
    match binary && (clocked || has(digits.len()) && !has(digits.len() * 4)) {
        true => 1,
        false => 4,
    }
}
