//! The parts of a line: what stands in front of the data, and what between them.

use super::{
    direction::{self, Sign},
    prose,
    stamp::{self, Stamp},
    token::tokens_of,
    writing::{Quotes, Times, Writing},
};
use alloc::{string::String, vec::Vec};
use core::ops::Range;

/// Labels between a time and the data of a line.
const LABELS: usize = 4;

/// What stands in front of the data of a line.
#[derive(Clone, Debug, Default)]
pub(super) struct Front {
    pub(super) quote: Range<usize>,
    pub(super) stamp: Option<(Range<usize>, Stamp)>,
    pub(super) sign: Option<(Range<usize>, Sign)>,
    pub(super) labels: Range<usize>,
    /// Where what is not of these begins.
    pub(super) body: usize,
}

impl Front {
    pub(super) fn read(line: &str, writing: &Writing) -> Self {
        let bytes = line.as_bytes();
        let mut front = Self::default();
        front.blanks(bytes);
        front.unquote(bytes, writing.quotes);
        front.stamp(bytes, writing.times);
        front.sign(bytes);
        if front.sign.is_some() && front.stamp.is_none() && writing.times != Times::None {
            front.stamp(bytes, Times::Strong);
        }
        if front.stamp.is_some() || front.sign.is_some() {
            front.skip_labels(line);
        }
        front
    }

    fn blanks(&mut self, line: &[u8]) {
        let rest = line.get(self.body..).unwrap_or_default();
        self.body += rest.iter().take_while(|byte| b" \t".contains(byte)).count();
    }

    fn unquote(&mut self, line: &[u8], quotes: Quotes) {
        let most = match quotes {
            Quotes::None => return,
            Quotes::Levels(levels) => levels,
            Quotes::Any => usize::MAX,
        };
        let start = self.body;
        let mut levels = 0;
        while levels < most && line.get(self.body).is_some_and(|mark| b">|".contains(mark)) {
            self.body += 1;
            levels += 1;
            self.quote = start..self.body;
            self.blanks(line);
        }
    }

    fn stamp(&mut self, line: &[u8], times: Times) {
        let rest = line.get(self.body..).unwrap_or_default();
        let stamp = match times {
            Times::None => None,
            Times::Strong => stamp::read(rest).filter(|stamp| stamp.strong),
            Times::Any => stamp::read(rest),
        };
        if let Some(stamp) = stamp {
            let start = self.body;
            self.body += stamp.end;
            self.stamp = Some((start..self.body, stamp));
        }
    }

    fn sign(&mut self, line: &[u8]) {
        let rest = line.get(self.body..).unwrap_or_default();
        // No word for a direction begins with such a digit.
        if self.sign.is_some() || rest.first().is_none_or(u8::is_ascii_hexdigit) {
            return;
        }
        if let Some(sign) = direction::read(rest) {
            let start = self.body;
            self.body += sign.end;
            self.sign = Some((start..self.body, sign));
        }
    }

    /// Names of ports, levels of messages, lengths and identities in front of the data.
    fn skip_labels(&mut self, line: &str) {
        let start = self.body;
        let mut end = start;
        for _ in 0..LABELS {
            self.sign(line.as_bytes());
            let rest = line.get(self.body..).unwrap_or_default();
            let chunk = rest.split([' ', '\t']).next().unwrap_or_default();
            let skipped = chunk.len() + can_identity(chunk, &rest[chunk.len()..]);
            let names = chunk
                .starts_with(|letter: char| letter.is_alphabetic() || "[(/-#*".contains(letter));
            let plain = !chunk.contains(['\\', '{', '\'', '=']);
            let mut tokens = tokens_of(chunk);
            let label = tokens.all(|token| token.hexadecimal().is_none());
            if !(names && plain && label) && skipped == chunk.len() || chunk.is_empty() {
                break;
            }
            self.body += skipped;
            end = self.body;
            self.blanks(line.as_bytes());
        }
        self.sign(line.as_bytes());
        self.labels = start..end.max(start);
        let rest = line.get(self.body..).unwrap_or_default();
        if let Some(len) = length(rest) {
            self.labels.end = self.body + len;
            self.body += len;
            self.blanks(line.as_bytes());
        }
    }

    /// Whether what stands in front is data of a line of text after all.
    pub(super) fn is_prose(&self, line: &str, unit: Option<usize>) -> bool {
        let body = line.get(self.body..).unwrap_or_default();
        let label = line.get(self.labels.clone()).unwrap_or_default();
        let words = tokens_of(label).filter(|token| token.is_word()).count();
        if words > 1 && !body.is_empty() {
            let from = line.get(self.labels.start..).unwrap_or_default();
            return prose::is_prose(from, unit);
        }
        prose::is_prose(body, unit) && prose::label(body, unit).is_none()
    }
}

/// The length of the identity that stands behind the name of a CAN interface.
fn can_identity(chunk: &str, rest: &str) -> usize {
    let number = chunk
        .strip_prefix("vcan")
        .or_else(|| chunk.strip_prefix("can"));
    if !number.is_some_and(|number| number.parse::<u8>().is_ok()) {
        return 0;
    }
    let identity = rest.trim_start();
    let end = identity
        .find([' ', '\t', '#'])
        .map_or(identity.len(), |end| {
            end + usize::from(identity[end..].starts_with('#'))
        });
    rest.len() - identity.len() + end
}

/// The length of a note of how many bytes follow: `(11)`, `[11]`, `11 bytes:`.
fn length(rest: &str) -> Option<usize> {
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    if let Some(inner) = rest.strip_prefix(['(', '[']) {
        let count = digits(inner);
        let closes = inner.get(count..)?.starts_with([')', ']']);
        let behind = inner
            .get(count + 1..)?
            .trim_start_matches([':', ' ', '\t', '-']);
        let more = tokens_of(behind).next().is_some();
        return (count > 0 && closes && more).then(|| rest.len() - behind.len());
    }
    let count = digits(rest);
    let word = rest.get(count..)?.trim_start();
    let behind = ["bytes", "byte", "Bytes", "B "]
        .iter()
        .find_map(|name| word.strip_prefix(name))?;
    let behind = behind.trim_start_matches([':', ' ', '\t', '-', ',']);
    (count > 0).then(|| rest.len() - behind.len())
}

/// A line with its comments blanked out, and where they stood.
pub(super) fn without_comments(
    line: &str,
    inside: &mut bool,
) -> Option<(String, Vec<Range<usize>>)> {
    if !*inside && !line.contains("//") && !line.contains("/*") && !line.contains("# ") {
        return None;
    }
    let mut found = Vec::new();
    let mut at = 0;
    while at < line.len() {
        let rest = &line[at..];
        if *inside {
            let end = rest.find("*/").map_or(line.len(), |end| at + end + 2);
            *inside = end == line.len() && !rest.ends_with("*/");
            found.push(at..end);
            at = end;
            continue;
        }
        let block = rest.find("/*");
        let to_end = [line_comment(rest), hash(line, at)]
            .into_iter()
            .flatten()
            .min();
        match (block, to_end) {
            (Some(block), to_end) if to_end.is_none_or(|to_end| block < to_end) => {
                *inside = true;
                at += block;
            }
            (_, Some(to_end)) => {
                found.push(at + to_end..line.len());
                break;
            }
            (_, None) => break,
        }
    }
    let mut text = String::from(line);
    for range in &found {
        text.replace_range(range.clone(), &" ".repeat(range.len()));
    }
    Some((text, found))
}

/// `//` that is not of an address.
fn line_comment(rest: &str) -> Option<usize> {
    let at = rest.find("//")?;
    (!rest[..at].ends_with(':')).then_some(at)
}

/// `# ` at the start or behind a blank.
fn hash(line: &str, from: usize) -> Option<usize> {
    let at = from + line.get(from..)?.find("# ")?;
    let before = &line[..at];
    (before.trim().is_empty() || before.ends_with([' ', '\t'])).then_some(at - from)
}

/// The end of the words of a declaration in front of its data.
pub(super) fn declaration(body: &str) -> Option<usize> {
    let mut tokens = tokens_of(body);
    let first = tokens.next()?;
    let names_bytes = ["db", "dcb", "defb", "byte"];
    if names_bytes
        .iter()
        .any(|name| first.text.eq_ignore_ascii_case(name))
    {
        let marked = tokens
            .next()
            .and_then(|token| token.hexadecimal())
            .is_some_and(|(_, marked)| marked);
        return marked.then_some(first.at + first.text.len());
    }
    let at = body.find('=')?;
    let other = body[at..].starts_with("==") || body[..at].ends_with(['<', '>', '!']);
    let named = tokens_of(&body[..at]).any(|token| {
        token
            .text
            .starts_with(|letter: char| letter.is_alphabetic())
            && token.hexadecimal().is_none()
    });
    if other || !named {
        return None;
    }
    // The number of bytes is no data.
    let value = body[at + 1..].trim().trim_end_matches(';');
    let counts = body[..at].trim_end().to_ascii_lowercase();
    let counts = ["len", "length", "size", "count"]
        .iter()
        .any(|name| counts.ends_with(name));
    let scalar = value.bytes().all(|digit| digit.is_ascii_digit());
    Some(if counts && scalar { body.len() } else { at + 1 })
}

/// Where the same bytes stand as letters behind the bytes of a line.
pub(super) fn letters(body: &str) -> Option<usize> {
    let mut tokens = tokens_of(body).peekable();
    let mut bytes = 0;
    while let Some(token) = tokens.next() {
        if token.text.len() != 2 || token.hexadecimal().is_none() {
            return None;
        }
        bytes += 1;
        let end = token.at + 2;
        let next = tokens.peek();
        if next.is_some_and(|next| next.text.len() == 2 && next.hexadecimal().is_some()) {
            continue;
        }
        let rest = body.get(end..)?;
        let shown = rest.trim_start();
        let gap = rest.len() - shown.len();
        let framed = shown
            .strip_prefix(['|', '"'])
            .and_then(|text| text.strip_suffix(['|', '"']));
        let wide = gap > 1 || rest.starts_with('\t') || framed.is_some();
        let shown = framed.unwrap_or(shown);
        return (wide && shown.chars().count() == bytes).then_some(end);
    }
    None
}

/// A string literal with escapes at the start of `text`: its end, and its bytes.
pub(super) fn literal(text: &str) -> Option<(usize, Vec<u8>)> {
    let bytes = text.as_bytes();
    let marked = usize::from(bytes.first().is_some_and(|first| b"bB".contains(first)));
    let quote = *bytes.get(marked).filter(|quote| b"'\"".contains(quote))?;
    let mut out = Vec::new();
    let mut at = marked + 1;
    let mut escaped = false;
    loop {
        let byte = *bytes.get(at)?;
        at += 1;
        match byte {
            b'\\' => {
                escaped = true;
                let code = *bytes.get(at)?;
                at += 1;
                out.push(match code {
                    b'x' => {
                        let pair = text.get(at..at + 2)?;
                        at += 2;
                        let hex = pair.bytes().all(|digit| digit.is_ascii_hexdigit());
                        u8::from_str_radix(pair, 16).ok().filter(|_| hex)?
                    }
                    b'n' => b'\n',
                    b'r' => b'\r',
                    b't' => b'\t',
                    b'0' => 0,
                    b'a' => 7,
                    b'b' => 8,
                    b'v' => 11,
                    b'f' => 12,
                    b'\\' | b'\'' | b'"' => code,
                    _ => return None,
                });
            }
            _ if byte == quote => break,
            // Without a mark of bytes blanks only separate.
            b' ' | b',' if marked == 0 => {}
            _ => out.push(byte),
        }
    }
    (escaped && text.is_char_boundary(at)).then_some((at, out))
}
