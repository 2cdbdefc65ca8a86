//! Pasted text to bytes and bits.
//!
//! Reads hexadecimal bytes with any separators and prefixes (`1a 20`, `0x1A,`, `1A20`, `\x1a`)
//! and strings of 0 and 1; of text streams, lines of decimal numbers too. What cannot be read is kept, with its place.

use crate::{bits::BitString, format::Medium};
use alloc::{format, vec::Vec};
use core::ops::Range;

/// Digits of the longest number that is taken for one in a text stream; longer runs are bytes.
const LONGEST_NUMBER: usize = 6;

/// A parsed dump.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Dump {
    /// Lines with something readable in them.
    pub lines: Vec<Line>,
    /// Where in the text unreadable tokens stand, in bytes.
    pub unread: Vec<Range<usize>>,
}

/// A line of a dump.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// What it holds.
    pub bits: BitString,
    /// Whether it was written as a string of 0 and 1.
    pub binary: bool,
}

impl Dump {
    /// Whether the dump was written as strings of 0 and 1.
    #[must_use]
    pub fn is_bits(&self) -> bool {
        !self.lines.is_empty() && self.lines.iter().all(|line| line.binary)
    }

    /// A dump of bytes that nobody has written down.
    #[must_use]
    pub fn of_bytes(bytes: &[u8]) -> Self {
        let bits = BitString::of_bytes(bytes.into());
        let binary = false;
        Self {
            lines: Vec::from([Line { bits, binary }]),
            unread: Vec::new(),
        }
    }

    /// All bytes as one stream.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        self.lines
            .iter()
            .flat_map(|line| line.bits.as_bits().bytes())
            .copied()
            .collect()
    }
}

/// Parses text; what 0 and 1 mean depends on what the format consists of.
///
/// ```
/// use encoderscope::{dump::parse, format::Medium};
/// assert_eq!(parse("{0x1A, 0x20}, \\x37", Medium::Bytes).bytes(), [0x1a, 0x20, 0x37]);
/// assert_eq!(parse("1101 0000 1", Medium::Bits).lines[0].bits.as_bits().len(), 9);
/// ```
#[must_use]
pub fn parse(text: &str, medium: Medium) -> Dump {
    // Files may begin with a mark of their encoding; blanks keep the places of what follows.
    let blank;
    let text = match text.strip_prefix('\u{feff}') {
        Some(rest) => {
            blank = format!("   {rest}");
            &blank
        }
        None => text,
    };
    let mut dump = Dump::default();
    if medium == Medium::Text && is_decimal(text) {
        for line in text.lines().map(bare).filter(|line| !line.is_empty()) {
            let at = line.as_ptr() as usize - text.as_ptr() as usize;
            match is_number(line) {
                true => dump.lines.push(decimal_line(line)),
                false => dump.unread.push(at..at + line.len()),
            }
        }
        return dump;
    }
    let all: Vec<Token<'_>> = text.lines().flat_map(tokens_of).collect();
    let binary = match medium {
        Medium::Bytes | Medium::Text => {
            let octet = |token: &Token<'_>| token.binary().is_some_and(|digits| digits.len() == 8);
            all.iter().all(octet)
        }
        Medium::Bits => is_binary(&all),
    };
    let mut at = 0;
    for line in text.split('\n') {
        let tokens: Vec<Token<'_>> = tokens_of(line).collect();
        let mut bits = BitString::default();
        for token in &tokens {
            if !token.read(binary, &mut bits) {
                let start = at + token.at;
                dump.unread.push(start..start + token.text.len());
            }
        }
        if !bits.as_bits().is_empty() {
            dump.lines.push(Line {
                bits,
                binary: binary && medium == Medium::Bits,
            });
        }
        at += line.len() + 1;
    }
    dump
}

/// Whether the text is what a terminal shows of a stream of decimal numbers, one a line: then
/// there is no line feed among its bytes, as there is in every dump of such a stream.
fn is_decimal(text: &str) -> bool {
    let feeds = |token: Token<'_>| {
        let token = token.text.to_ascii_lowercase();
        token.trim_start_matches("0x") == "0a" || token.ends_with("0d0a")
    };
    !text.lines().flat_map(tokens_of).any(feeds) && text.lines().any(|line| is_number(bare(line)))
}

/// A line without what separates it from the next.
fn bare(line: &str) -> &str {
    line.trim_matches(|letter: char| letter.is_whitespace() || ",;".contains(letter))
}

fn is_number(line: &str) -> bool {
    (1..=LONGEST_NUMBER).contains(&line.len()) && line.bytes().all(|digit| digit.is_ascii_digit())
}

/// A number as it was on the wire.
fn decimal_line(number: &str) -> Line {
    let mut bytes = Vec::from(number);
    bytes.extend(*b"\r\n");
    Line {
        bits: BitString::of_bytes(bytes),
        binary: false,
    }
}

/// A run of characters without separators.
struct Token<'a> {
    text: &'a str,
    at: usize,
}

fn tokens_of(line: &str) -> impl Iterator<Item = Token<'_>> {
    let separates = |letter: char| letter.is_whitespace() || ",;|{}[]()\"'_-:".contains(letter);
    line.split(separates)
        .filter(|text| !text.is_empty())
        .map(move |text| Token {
            text,
            at: text.as_ptr() as usize - line.as_ptr() as usize,
        })
}

/// A dump is binary when it has nothing but 0 and 1 and does not look like hexadecimal pairs.
fn is_binary(tokens: &[Token<'_>]) -> bool {
    let digits: Option<usize> = tokens
        .iter()
        .map(|token| token.binary().map(str::len))
        .sum();
    let pairs = tokens.iter().all(|token| token.text.len() == 2);
    let prefixed = tokens.iter().any(|token| token.text.starts_with("0b"));
    digits.is_some_and(|digits| digits >= 8 && !pairs || prefixed)
}

impl<'a> Token<'a> {
    /// The digits of a string of 0 and 1.
    fn binary(&self) -> Option<&'a str> {
        let digits = self.text.strip_prefix("0b").unwrap_or(self.text);
        (!digits.is_empty() && digits.bytes().all(|digit| matches!(digit, b'0' | b'1')))
            .then_some(digits)
    }

    /// Appends what the token holds; `false` when it cannot be read.
    fn read(&self, binary: bool, out: &mut BitString) -> bool {
        if binary {
            let Some(digits) = self.binary() else {
                return false;
            };
            digits.bytes().for_each(|digit| out.push(digit == b'1'));
            return true;
        }
        let mut bytes = Vec::new();
        // Assemblers write 1Ah, and some terminals single digits.
        let text = match self.text.strip_suffix(['h', 'H']) {
            Some(digits) if !digits.contains("\\x") => digits,
            _ => self.text,
        };
        for part in text.split("\\x").filter(|part| !part.is_empty()) {
            let digits = part.strip_prefix("0x").or_else(|| part.strip_prefix("0X"));
            let digits = digits.unwrap_or(part);
            let whole = digits.len().is_multiple_of(2) || digits.len() == 1;
            if digits.is_empty() || !whole || !digits.bytes().all(|digit| digit.is_ascii_hexdigit())
            {
                return false;
            }
            for pair in digits.as_bytes().chunks(2) {
                let pair = core::str::from_utf8(pair).unwrap_or_default();
                bytes.push(u8::from_str_radix(pair, 16).unwrap_or_default());
            }
        }
        for byte in &bytes {
            for place in (0..8).rev() {
                out.push(crate::bits::bit(u64::from(*byte), place));
            }
        }
        !bytes.is_empty()
    }
}
