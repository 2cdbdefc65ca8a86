//! Letters as they were meant: what word processors, mail programs and other alphabets make of
//! digits and separators.

use alloc::{string::String, vec::Vec};
use core::ops::Range;

/// A line in plain letters, and where each of its bytes stands in the line as it came.
#[derive(Clone, Debug, Default)]
pub(super) struct Clean {
    pub(super) text: String,
    /// Offsets in the whole text; one more than there are bytes.
    pub(super) places: Vec<u64>,
    /// Where letters of other alphabets were read as digits, in `text`.
    pub(super) alike: Vec<Range<usize>>,
}

/// Whether a line can be taken as it is.
pub(super) fn is_plain(raw: &[u8]) -> bool {
    raw.is_ascii() && !raw.contains(&0)
}

impl Clean {
    pub(super) fn clear(&mut self) {
        self.text.clear();
        self.places.clear();
        self.alike.clear();
    }

    /// Appends a line that begins at `at` of the text.
    pub(super) fn add(&mut self, raw: &[u8], at: u64, printable: bool) {
        self.places.pop();
        let (bytes, offsets) = if printable {
            unquoted(raw)
        } else {
            (raw.into(), Vec::new())
        };
        let place = |index: usize| {
            let offset = offsets.get(index).copied().unwrap_or(index.min(raw.len()));
            at + offset as u64
        };
        let from = self.text.len();
        let mut index = 0;
        for chunk in bytes.utf8_chunks() {
            for letter in chunk.valid().chars() {
                self.letter(letter, place(index));
                index += letter.len_utf8();
            }
            for byte in chunk.invalid() {
                // A space that does not break, in the encodings of one byte a letter.
                self.letter(if *byte == 0xa0 { ' ' } else { '\u{fffd}' }, place(index));
                index += 1;
            }
        }
        self.places.push(at + raw.len() as u64);
        self.read_alike(from);
    }

    fn letter(&mut self, letter: char, place: u64) {
        let before = self.text.len();
        match letter {
            '\u{a0}' | '\u{2000}'..='\u{200a}' | '\u{202f}' | '\u{205f}' | '\u{3000}' => {
                self.text.push(' ');
            }
            '\0'
            | '\u{ad}'
            | '\u{200b}'..='\u{200f}'
            | '\u{202a}'..='\u{202e}'
            | '\u{2060}'..='\u{2064}'
            | '\u{feff}' => {}
            '\u{2010}'..='\u{2015}' | '\u{2212}' | '\u{fe58}' | '\u{fe63}' => self.text.push('-'),
            '\u{2018}'..='\u{201b}' | '\u{2032}' => self.text.push('\''),
            '\u{201c}'..='\u{201f}' | '\u{2033}' | '«' | '»' => self.text.push('"'),
            '→' | '⇒' | '⟶' | '➔' | '➜' => self.text.push_str("->"),
            '←' | '⇐' | '⟵' => self.text.push_str("<-"),
            '×' => self.text.push('x'),
            // The wide forms stand in the order of ASCII.
            '\u{ff01}'..='\u{ff5e}' => {
                let plain = u32::from(letter) - 0xff01 + u32::from('!');
                self.text.push(char::from_u32(plain).unwrap_or('?'));
            }
            _ => self.text.push(letter),
        }
        self.places
            .resize(self.places.len() + self.text.len() - before, place);
    }

    /// Reads letters that look like digits in tokens that otherwise are hexadecimal.
    fn read_alike(&mut self, from: usize) {
        if self.text[from..].is_ascii() {
            return;
        }
        let mut found: Vec<(Range<usize>, String)> = Vec::new();
        let mut start = from;
        for token in self.text[from..].split(|letter: char| !letter.is_alphanumeric()) {
            let at = start..start + token.len();
            start = at.end + self.text[at.end..].chars().next().map_or(0, char::len_utf8);
            if let Some(meant) = meant(token) {
                found.push((at, meant));
            }
        }
        for (at, meant) in found.into_iter().rev() {
            let place = self.places[at.start];
            let ends = self.places[at.end];
            // Each letter keeps its own place.
            let mut places: Vec<u64> = Vec::with_capacity(meant.len());
            let mut index = at.start;
            for letter in self.text[at.clone()].chars() {
                places.push(self.places.get(index).copied().unwrap_or(place).min(ends));
                index += letter.len_utf8();
            }
            let shrink = at.len() - meant.len();
            self.places.splice(at.clone(), places);
            self.text.replace_range(at.clone(), &meant);
            for later in &mut self.alike {
                if later.start >= at.end {
                    *later = later.start - shrink..later.end - shrink;
                }
            }
            self.alike.insert(0, at.start..at.start + meant.len());
        }
        self.alike.sort_by_key(|at| at.start);
    }
}

/// What a token with look-alike letters was meant to be.
fn meant(token: &str) -> Option<String> {
    if token.is_ascii() {
        return None;
    }
    let meant: String = token.chars().map(look).collect::<Option<_>>()?;
    let lower = meant.to_ascii_lowercase();
    let digits = lower.strip_prefix("0x").unwrap_or(&lower);
    let digits = digits.strip_prefix('x').unwrap_or(digits);
    let digits = digits.strip_suffix('h').unwrap_or(digits);
    let hex = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
    // A word of nothing but such letters is one, unless it has the length of a byte.
    let mixed = token.bytes().any(|byte| byte.is_ascii_alphanumeric());
    (hex && (mixed || digits.len() == 2)).then_some(meant)
}

/// The Latin letter or digit that a letter looks like.
const fn look(letter: char) -> Option<char> {
    Some(match letter {
        'А' | 'Α' => 'A',
        'В' | 'Β' => 'B',
        'С' => 'C',
        'Е' | 'Ε' => 'E',
        'а' => 'a',
        'с' => 'c',
        'е' => 'e',
        'х' | 'Х' | 'χ' => 'x',
        'О' | 'о' | 'Ο' | 'ο' => '0',
        'З' | 'з' => '3',
        _ if letter.is_ascii() => letter,
        _ => return None,
    })
}

/// The bytes that quoted-printable text (RFC 2045, section 6.7) stands for, and where each
/// stood; one more place than there are bytes.
fn unquoted(raw: &[u8]) -> (Vec<u8>, Vec<usize>) {
    let mut bytes = Vec::with_capacity(raw.len());
    let mut places = Vec::with_capacity(raw.len() + 1);
    let mut at = 0;
    while let Some(byte) = raw.get(at) {
        places.push(at);
        let code = raw
            .get(at + 1..at + 3)
            .and_then(|pair| core::str::from_utf8(pair).ok());
        let code = code.filter(|pair| pair.bytes().all(|digit| digit.is_ascii_hexdigit()));
        let code = code.and_then(|pair| u8::from_str_radix(pair, 16).ok());
        match code.filter(|_| *byte == b'=') {
            Some(code) => {
                bytes.push(code);
                at += 3;
            }
            None => {
                bytes.push(*byte);
                at += 1;
            }
        }
    }
    places.push(raw.len());
    (bytes, places)
}
