//! Ordinary text around a dump.

use super::token::{Token, tokens_of};

/// English words of hexadecimal digits that occur in letters.
const WEAK: [&str; 32] = [
    "a", "ab", "abed", "ace", "add", "added", "bad", "bade", "be", "bed", "bee", "beef", "cab",
    "cafe", "dad", "dead", "deaf", "deed", "ed", "fab", "face", "faced", "facade", "fade", "faded",
    "fed", "fee", "feed", "ebb", "egg", "dab", "decade",
];

/// What the tokens of a line look like.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    all: usize,
    words: usize,
    weak: usize,
    /// Readable, of the width that the tokens of the dump have.
    fitting: usize,
    strange: usize,
}

/// Whether a line is ordinary text; `unit` is how many digits the tokens of the dump have.
pub(super) fn is_prose(line: &str, unit: Option<usize>) -> bool {
    let mut tally = Tally::default();
    let mut widths = (usize::MAX, 0);
    for token in tokens_of(line) {
        tally.all += 1;
        if token.is_word() {
            tally.words += 1;
        } else if is_weak(token) {
            tally.weak += 1;
            widths = (
                widths.0.min(token.text.len()),
                widths.1.max(token.text.len()),
            );
        } else if fits(token, unit) {
            tally.fitting += 1;
        } else {
            tally.strange += 1;
        }
    }
    if tally.words > 0 {
        return tally.fitting <= tally.words + tally.weak + tally.strange;
    }
    if line.trim_start().starts_with('+') && tally.strange > 0 {
        return true;
    }
    // Nothing but such words is text where they are not as wide as one another, or the dump.
    let other = unit.is_some_and(|unit| widths.1 > 2 && widths != (unit, unit));
    tally.weak > 0 && tally.weak == tally.all && (widths.0 != widths.1 || other)
}

fn is_weak(token: Token<'_>) -> bool {
    WEAK.iter()
        .any(|word| token.text.eq_ignore_ascii_case(word))
}

fn fits(token: Token<'_>, unit: Option<usize>) -> bool {
    let Some((digits, marked)) = token.hexadecimal() else {
        return token.decimal().is_some() && unit == Some(3);
    };
    match unit {
        _ if marked => true,
        Some(unit) => digits == unit || unit <= 3 && digits < unit,
        None => digits > 1,
    }
}

/// Names of the lines in front of an e-mail, whose numbers are no bytes.
const HEADINGS: [&str; 14] = [
    "date", "from", "to", "cc", "subject", "tel", "phone", "fax", "mobile", "office", "page",
    "ticket", "order", "version",
];

/// The end of a label in front of data: `Frame 1: 1A 20`; `unit` as above.
pub(super) fn label(line: &str, unit: Option<usize>) -> Option<usize> {
    let end = line.find([':', '='])? + 1;
    let (label, data) = line.split_at(end);
    let first = tokens_of(label).next()?;
    if !first
        .text
        .starts_with(|letter: char| letter.is_alphabetic())
        || first.hexadecimal().is_some()
    {
        return None;
    }
    let heads = HEADINGS
        .iter()
        .any(|name| first.text.eq_ignore_ascii_case(name));
    let mut tokens = tokens_of(data).peekable();
    let readable = tokens.peek().is_some() && tokens.all(|token| fits(token, unit));
    (readable && !heads).then_some(end)
}
