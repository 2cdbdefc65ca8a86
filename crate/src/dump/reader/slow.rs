//! Lines that are more than plain bytes.

use super::{Reader, Text, bare, is_number};
use crate::{
    bits::BitString,
    dump::{
        Dropped,
        direction::heading,
        line::{self, Front},
        prose, stamp,
        token::{Base, Token, tokens_of},
        writing::Digits,
    },
    format::Medium,
};
use alloc::{string::String, vec::Vec};
use core::ops::Range;

impl Reader {
    pub(super) fn slow(&mut self, text: Text<'_>, front: &Front) {
        let unit = self.dump.writing.unit;
        if let Some(direction) = heading(text.line) {
            let time = text.line.match_indices(' ').find_map(|(at, _)| {
                stamp::read(text.line.as_bytes().get(at + 1..)?).filter(|stamp| stamp.strong)
            });
            self.heading = Some((time.map(|stamp| stamp.seconds), Some(direction)));
            self.drop_line(text, Dropped::Direction);
            return;
        }
        let inside = self.in_comment;
        let commented = line::without_comments(text.line, &mut self.in_comment);
        let (owned, comments): (String, Vec<Range<usize>>) = commented.unwrap_or_default();
        let whole = if comments.is_empty() {
            text.line
        } else {
            &owned
        };
        let body = whole.get(front.body..).unwrap_or_default();
        if !inside && !self.dump.writing.source && front.is_prose(whole, unit) {
            self.drop_line(text, Dropped::Prose);
            return;
        }
        if let Some(stamp) = stamp::read(whole.trim().as_bytes())
            && stamp.day.is_some()
            && stamp.end == whole.trim().len()
        {
            self.drop_line(text, Dropped::Time);
            return;
        }
        let (time, direction) = self.front(text, front);
        for range in &comments {
            self.drop(text, range.clone(), Dropped::Comment);
        }
        let from = front.body;
        match self.dump.writing.digits {
            Digits::Numbers => self.number(text, whole, from, &comments),
            Digits::Binary => {
                let bits = self.bits(text, body, from);
                self.dump.data.extend_from_slice(bits.as_bits().bytes());
                self.dump.close(bits.as_bits().len(), time, direction);
                return;
            }
            Digits::Decimal => self.bytes(text, body, from, Base::Decimal),
            Digits::Hexadecimal => self.bytes(text, body, from, Base::Hexadecimal),
        }
        self.close(time, direction);
    }

    /// A number as it was on the wire.
    fn number(&mut self, text: Text<'_>, whole: &str, from: usize, comments: &[Range<usize>]) {
        let body = bare(whole.get(from..).unwrap_or_default());
        if is_number(body) {
            self.dump.data.extend_from_slice(body.as_bytes());
            self.dump.data.extend_from_slice(b"\r\n");
            return;
        }
        // What cannot be read is in parts where comments stand within it.
        let mut start = from;
        let end = whole.len()..whole.len();
        for comment in comments.iter().chain([&end]) {
            if let Some(part) = whole.get(start..comment.start).map(bare) {
                let at = part.as_ptr() as usize - whole.as_ptr() as usize;
                self.unread(text, at..at + part.len());
            }
            start = start.max(comment.end);
        }
    }

    /// The bits of a line of 0 and 1; none where bytes are asked for and they are not whole ones.
    fn bits(&mut self, text: Text<'_>, body: &str, from: usize) -> BitString {
        let label = prose::label(body, None).unwrap_or(0);
        self.drop(text, from..from + label, Dropped::Column);
        let tokens = || tokens_of(body).filter(|token| token.at >= label);
        let mut bits = BitString::default();
        for (digits, marked) in tokens().filter_map(Token::binary) {
            if marked && self.medium != Medium::Bits {
                (digits.len()..8).for_each(|_| bits.push(false));
            }
            digits.bytes().for_each(|digit| bits.push(digit == b'1'));
        }
        let fits = self.medium == Medium::Bits || bits.as_bits().len().is_multiple_of(8);
        for token in tokens().filter(|token| !fits || token.binary().is_none()) {
            let start = from + token.at;
            self.unread(text, start..start + token.text.len());
        }
        if fits { bits } else { BitString::default() }
    }

    /// The bytes of a line, between whatever else stands there.
    fn bytes(&mut self, text: Text<'_>, body: &str, from: usize, base: Base) {
        let source = self.dump.writing.source;
        let unit = self.dump.writing.unit;
        let mut start = 0;
        if source && is_directive(body) {
            self.drop(
                text,
                from..from + body.trim_end().len(),
                Dropped::Declaration,
            );
            return;
        }
        if let Some(end) = line::declaration(body) {
            self.drop(text, from..from + end, Dropped::Declaration);
            start = end;
        } else if let Some(end) = prose::label(body, unit) {
            self.drop(text, from..from + end, Dropped::Column);
            start = end;
        }
        let mut end = body.len();
        if let Some(letters) = line::letters(body.get(start..).unwrap_or_default()) {
            end = start + letters;
            self.drop(
                text,
                from + end..from + body.trim_end().len(),
                Dropped::Ascii,
            );
        }
        // String literals stand for themselves; what is between them are tokens.
        let mut at = start;
        for (quote, _) in body.match_indices(['\'', '"']) {
            let marked = quote > 0 && body[..quote].ends_with(['b', 'B']);
            let open = quote - usize::from(marked);
            if open < at || quote >= end {
                continue;
            }
            let Some((len, bytes)) = body.get(open..).and_then(line::literal) else {
                continue;
            };
            self.tokens(text, body, at..open, from, base);
            self.dump.data.extend_from_slice(&bytes);
            at = open + len;
        }
        self.tokens(text, body, at..end.max(at), from, base);
    }

    fn tokens(&mut self, text: Text<'_>, body: &str, part: Range<usize>, from: usize, base: Base) {
        let source = self.dump.writing.source;
        let here = body.get(part.clone()).unwrap_or_default();
        for token in tokens_of(here) {
            let before = &here[..token.at];
            let behind = &here[token.at + token.text.len()..];
            let mark = before.ends_with(['b', 'B', 'x']) && behind.starts_with('"');
            let size = is_size(source, before, behind);
            if !mark && !size && token.read(base, &mut self.dump.data) {
                continue;
            }
            let start = from + part.start + token.at;
            let range = start..start + token.text.len();
            if source && (size || is_name(token, before)) {
                self.drop(text, range, Dropped::Declaration);
            } else {
                self.unread(text, range);
            }
        }
    }
}

/// Whether a line of a program holds no data at all: a directive, or a head of a declaration.
fn is_directive(body: &str) -> bool {
    let body = body.trim();
    let directive = body
        .strip_prefix('#')
        .is_some_and(|rest| rest.starts_with(|letter: char| letter.is_ascii_lowercase()));
    let data = body.contains(['{', '=', '(', '\'', '"', ',']);
    let named = tokens_of(body).next().is_some_and(|token| {
        token.at == 0
            && token
                .text
                .starts_with(|letter: char| letter.is_alphabetic())
            && token.hexadecimal().is_none()
    });
    directive && !body.contains("0x") || named && !data
}

/// Whether a number in brackets is the size of what is declared, or of what is asked for.
fn is_size(source: bool, before: &str, behind: &str) -> bool {
    let named = before.strip_suffix(['[', '(']).is_some_and(|name| {
        name.ends_with(|letter: char| letter.is_alphanumeric() || letter == '_')
    });
    source && named && behind.starts_with([']', ')'])
}

fn is_name(token: Token<'_>, before: &str) -> bool {
    token
        .text
        .starts_with(|letter: char| letter.is_alphabetic())
        || before.ends_with('[')
}
