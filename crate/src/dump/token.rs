//! Runs of characters without separators, and the numbers in them.

use alloc::vec::Vec;

/// A run of characters without separators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token<'a> {
    pub(super) text: &'a str,
    /// Where it begins in its line.
    pub(super) at: usize,
}

/// How the digits of a token are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Base {
    /// Bytes in hexadecimal.
    Hexadecimal,
    /// A byte in decimal.
    Decimal,
}

/// The tokens of a line.
pub(super) fn tokens_of(line: &str) -> impl Iterator<Item = Token<'_>> {
    line.split(separates)
        .map(move |text| Token {
            text,
            at: text.as_ptr() as usize - line.as_ptr() as usize,
        })
        .map(Token::trimmed)
        .filter(|token| !token.text.is_empty())
}

fn separates(letter: char) -> bool {
    letter.is_whitespace() || letter.is_control() || ",;|{}[]()\"'`_-:=<>".contains(letter)
}

/// The digits of a hexadecimal number without what marks it as one.
fn digits_of(text: &str) -> Option<(&str, bool)> {
    let strip = |prefix: &str| {
        let start = text.get(..prefix.len())?;
        start
            .eq_ignore_ascii_case(prefix)
            .then(|| &text[prefix.len()..])
    };
    if let Some(digits) = strip("0x") {
        let digits = ["u8", "u", "U", "L"]
            .iter()
            .find_map(|suffix| digits.strip_suffix(suffix));
        return Some((digits.or_else(|| strip("0x"))?, true));
    }
    if let Some(digits) = strip("$").or_else(|| strip("&h")).or_else(|| strip("#")) {
        return Some((digits, true));
    }
    match text.strip_suffix(['h', 'H']) {
        Some(digits) if !text.contains("\\x") => Some((digits, true)),
        _ => Some((text, false)),
    }
}

impl<'a> Token<'a> {
    /// Without the full stops and marks of a sentence.
    fn trimmed(self) -> Self {
        let text = self.text.trim_end_matches(['.', '!', '?', '*']);
        let rest = text.trim_start_matches(['.', '*', '~', '/']);
        Token {
            text: rest,
            at: self.at + text.len() - rest.len(),
        }
    }

    /// The digits of a string of 0 and 1, and whether they are marked as one.
    pub(super) fn binary(self) -> Option<(&'a str, bool)> {
        let marked = self
            .text
            .strip_prefix("0b")
            .filter(|digits| !digits.is_empty());
        let digits = marked.unwrap_or(self.text);
        digits
            .bytes()
            .all(|digit| matches!(digit, b'0' | b'1'))
            .then_some((digits, marked.is_some()))
    }

    /// The number of its hexadecimal digits, and whether it is marked as hexadecimal; none
    /// where it cannot be read.
    pub(super) fn hexadecimal(self) -> Option<(usize, bool)> {
        if self.text.contains('\\') {
            let mut digits = 0;
            for part in self.text.split("\\x").filter(|part| !part.is_empty()) {
                digits += whole(part)?;
            }
            return (digits > 0).then_some((digits, true));
        }
        let (digits, marked) = digits_of(self.text)?;
        match whole(digits) {
            Some(count) => Some((count, marked)),
            None => self.parts().map(|parts| (parts.count() * 2, false)),
        }
    }

    /// The number that a decimal byte says.
    pub(super) fn decimal(self) -> Option<u8> {
        let text = self.text.strip_suffix("u8").unwrap_or(self.text);
        let digits = text.len() <= 3 && text.bytes().all(|digit| digit.is_ascii_digit());
        digits.then(|| text.parse().ok()).flatten()
    }

    /// Pairs of digits with one unusual letter between them.
    fn parts(self) -> Option<impl Iterator<Item = &'a str>> {
        let between = self
            .text
            .chars()
            .nth(2)
            .filter(|letter| !letter.is_alphanumeric())?;
        let parts = self.text.split(between);
        let pair = |part: &str| part.len() == 2 && whole(part).is_some();
        let four = parts.clone().count() >= 4;
        (four && parts.clone().all(pair)).then_some(parts)
    }

    /// Appends what the token holds; `false` when it cannot be read.
    pub(super) fn read(self, base: Base, out: &mut Vec<u8>) -> bool {
        let marked = self.hexadecimal().is_some_and(|(_, marked)| marked);
        if base == Base::Decimal && !marked {
            let byte = self.decimal();
            out.extend(byte);
            return byte.is_some();
        }
        if self.hexadecimal().is_none() {
            return false;
        }
        if let Some(parts) = self.parts() {
            parts.for_each(|part| push_digits(part, out));
        } else if self.text.contains('\\') {
            self.text
                .split("\\x")
                .for_each(|part| push_digits(part, out));
        } else if let Some((digits, _)) = digits_of(self.text) {
            push_digits(digits, out);
        }
        true
    }

    /// Whether it is a word that is no number.
    pub(super) fn is_word(self) -> bool {
        let letters = self
            .text
            .chars()
            .filter(|letter| letter.is_alphabetic())
            .count();
        letters > 1
            && !self.text.bytes().any(|byte| byte.is_ascii_digit())
            && self.hexadecimal().is_none()
    }
}

/// The number of hexadecimal digits that are whole bytes, or a byte of one digit.
fn whole(digits: &str) -> Option<usize> {
    let count = digits.len();
    let fits = count == 1 || count > 0 && count.is_multiple_of(2);
    (fits && digits.bytes().all(|digit| digit.is_ascii_hexdigit())).then_some(count)
}

fn push_digits(digits: &str, out: &mut Vec<u8>) {
    for pair in digits.as_bytes().chunks(2) {
        let pair = core::str::from_utf8(pair).unwrap_or_default();
        out.extend(u8::from_str_radix(pair, 16).ok());
    }
}
