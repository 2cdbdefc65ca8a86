//! Text in pieces to a dump.

mod rows;
mod slow;

use super::{
    Direction, Dropped, Dump,
    clean::{Clean, is_plain},
    line::Front,
    survey,
    writing::{Digits, Form, Quotes, Times},
};
use crate::format::Medium;
use alloc::vec::Vec;
use core::ops::Range;

/// How much of a text decides what kind of writing it is, in bytes.
const HEAD: usize = 64 * 1024;
/// Bytes of text of the longest line; what is longer is several lines.
const LONGEST: usize = 64 * 1024;
/// Digits of the longest number that is taken for one in a text stream; longer runs are bytes.
const LONGEST_NUMBER: usize = 6;
/// Seconds of a day.
const DAY: f64 = 86_400.0;

/// Reads a text that comes in pieces.
///
/// The kind of writing is decided once, from the head of the text; then it does not matter how
/// the text is cut.
///
/// ```
/// use encoderscope::{dump::{Reader, parse}, format::Medium};
/// let text = "1A 20 29 C0\n3B 17";
/// let mut reader = Reader::new(Medium::Bytes, text);
/// for piece in text.as_bytes().chunks(4) {
///     reader.push(piece);
/// }
/// assert_eq!(reader.finish(), parse(text, Medium::Bytes));
/// ```
#[derive(Clone, Debug)]
pub struct Reader {
    dump: Dump,
    medium: Medium,
    /// The begun line.
    pending: Vec<u8>,
    /// Where the begun line begins in the text.
    at: u64,
    clean: Clean,
    /// Whether the line goes on behind a soft line end.
    soft: bool,
    in_comment: bool,
    /// Of the lines that follow and have none of their own.
    direction: Option<Direction>,
    /// Whether any line was marked as received, and as sent.
    signs: [bool; 2],
    /// Time and direction of the lines below a heading.
    heading: Option<(Option<f64>, Option<Direction>)>,
    first_day: Option<i64>,
    /// Offset and bytes of the last line of a hexdump.
    last_row: Option<(u64, Vec<u8>)>,
    starred: Option<Range<u64>>,
    repeated: u64,
}

/// A line in plain letters.
#[derive(Clone, Copy)]
struct Text<'a> {
    line: &'a str,
    at: u64,
    places: Option<&'a [u64]>,
}

impl Text<'_> {
    /// Where a part of the line stands in the whole text.
    fn place(&self, range: Range<usize>) -> Range<u64> {
        match self.places {
            None => self.at + range.start as u64..self.at + range.end as u64,
            Some(places) => {
                let place = |index: usize| {
                    places
                        .get(index)
                        .or(places.last())
                        .copied()
                        .unwrap_or(self.at)
                };
                place(range.start)..place(range.end).max(place(range.start))
            }
        }
    }
}

impl Reader {
    /// A reader that takes the text for the kind of writing that its head shows.
    #[must_use]
    pub fn new(medium: Medium, head: &str) -> Self {
        let mut shown = head;
        if head.len() > HEAD {
            let cut = (0..=HEAD)
                .rev()
                .find(|at| head.is_char_boundary(*at))
                .unwrap_or(0);
            let whole = head[..cut].rfind(['\n', '\r']).unwrap_or(cut);
            shown = &head[..whole];
        }
        let writing = survey::survey(medium, shown);
        Self {
            dump: Dump {
                binary: writing.digits == Digits::Binary && medium == Medium::Bits,
                writing,
                ..Dump::default()
            },
            medium,
            pending: Vec::new(),
            at: 0,
            clean: Clean::default(),
            soft: false,
            in_comment: false,
            direction: None,
            signs: [false; 2],
            heading: None,
            first_day: None,
            last_row: None,
            starred: None,
            repeated: 0,
        }
    }

    /// Takes more of the text, cut anywhere.
    pub fn push(&mut self, mut piece: &[u8]) {
        while !piece.is_empty() {
            if let Some(len) = self.simple_line(piece) {
                self.at += len as u64;
                piece = &piece[len..];
                continue;
            }
            let room = LONGEST - self.pending.len();
            let near = &piece[..room.min(piece.len())];
            let ends = near.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
            match ends {
                Some(end) if self.pending.is_empty() => {
                    self.raw_line(&near[..end]);
                    self.at += end as u64 + 1;
                    piece = &piece[end + 1..];
                }
                Some(end) => {
                    self.pending.extend_from_slice(&near[..end]);
                    self.take_pending(usize::MAX);
                    self.at += 1;
                    piece = &piece[end + 1..];
                }
                None => {
                    self.pending.extend_from_slice(near);
                    piece = &piece[near.len()..];
                    if self.pending.len() == LONGEST {
                        let cut = cut(&self.pending);
                        self.take_pending(cut);
                    }
                }
            }
        }
    }

    /// So many times the text so far is still to come: makes room for what it will hold, if it
    /// goes on alike. Room that is made as it is needed takes twice as much.
    pub fn expect(&mut self, times: f64) {
        self.dump.expect(times);
    }

    /// What has been read: all lines that have ended.
    #[must_use]
    pub const fn dump(&self) -> &Dump {
        &self.dump
    }

    /// The text has ended.
    #[must_use]
    pub fn finish(mut self) -> Dump {
        self.take_pending(usize::MAX);
        if self.soft {
            self.soft = false;
            let clean = core::mem::take(&mut self.clean);
            self.cleaned(&clean);
        }
        if let Some(at) = self.starred.take() {
            self.dump.dropped.add(at, Dropped::Repeat);
        }
        self.dump
    }

    fn take_pending(&mut self, cut: usize) {
        let mut pending = core::mem::take(&mut self.pending);
        let rest = pending.split_off(cut.min(pending.len()));
        self.raw_line(&pending);
        self.at += pending.len() as u64;
        self.pending = rest;
    }

    fn raw_line(&mut self, raw: &[u8]) {
        let printable = self.dump.writing.printable;
        if !printable && !self.soft && is_plain(raw) {
            let line = core::str::from_utf8(raw).unwrap_or_default();
            self.line(Text {
                line,
                at: self.at,
                places: None,
            });
            return;
        }
        let soft = printable && raw.ends_with(b"=") && self.clean.text.len() < LONGEST;
        let raw = if soft { &raw[..raw.len() - 1] } else { raw };
        let mut clean = core::mem::take(&mut self.clean);
        clean.add(raw, self.at, printable);
        self.soft = soft;
        if !soft {
            self.cleaned(&clean);
            clean.clear();
        }
        self.clean = clean;
    }

    fn cleaned(&mut self, clean: &Clean) {
        let before = self.dump.data.len();
        let text = Text {
            line: &clean.text,
            at: self.at,
            places: Some(&clean.places),
        };
        self.line(text);
        if self.dump.data.len() > before {
            for range in &clean.alike {
                self.drop(text, range.clone(), Dropped::LookAlike);
            }
        }
    }

    fn drop(&mut self, text: Text<'_>, range: Range<usize>, kind: Dropped) {
        if !range.is_empty() {
            self.dump.dropped.add(text.place(range), kind);
        }
    }

    fn drop_line(&mut self, text: Text<'_>, kind: Dropped) {
        let line = text.line;
        let start = line.len() - line.trim_start().len();
        self.drop(text, start..line.trim_end().len().max(start), kind);
    }

    fn unread(&mut self, text: Text<'_>, range: Range<usize>) {
        if !range.is_empty() {
            self.dump.unread.add(text.place(range), Dropped::Unreadable);
        }
    }

    /// Makes a line of the data behind the last one.
    fn close(&mut self, time: Option<f64>, direction: Option<Direction>) {
        let bytes = self.dump.data.len() - self.dump.end.byte as usize;
        self.dump.close(bytes * 8, time, direction);
    }

    fn line(&mut self, text: Text<'_>) {
        if text.line.bytes().all(|byte| byte.is_ascii_whitespace()) {
            return;
        }
        match &self.dump.writing.form {
            Form::Free | Form::Captured | Form::Binary => self.free(text),
            Form::Table(_) => self.row_of_table(text),
            Form::Annotations => self.annotation(text),
            Form::Offsets(_) => self.row_of_hexdump(text),
        }
    }

    fn free(&mut self, text: Text<'_>) {
        let writing = &self.dump.writing;
        let fancy =
            writing.times != Times::None || writing.directed || writing.quotes != Quotes::None;
        let front = if fancy {
            Front::read(text.line, writing)
        } else {
            Front::default()
        };
        let simple = writing.digits == Digits::Hexadecimal && !self.in_comment;
        if simple && front.labels.is_empty() && self.pairs(&text.line.as_bytes()[front.body..]) {
            let (time, direction) = self.front(text, &front);
            self.close(time, direction);
            return;
        }
        self.slow(text, &front);
    }

    /// Reads a whole line of nothing but whole bytes with one separator between, in one go, where
    /// nothing in front of it counts; returns its length with its end. Leaves no trace of any
    /// other line.
    fn simple_line(&mut self, piece: &[u8]) -> Option<usize> {
        let writing = &self.dump.writing;
        let fancy =
            writing.times != Times::None || writing.directed || writing.quotes != Quotes::None;
        let free = matches!(writing.form, Form::Free | Form::Captured | Form::Binary);
        let alone = self.pending.is_empty() && self.heading.is_none() && self.signs == [false; 2];
        let begun = self.in_comment || self.soft || writing.printable || !alone;
        if fancy || !free || begun || writing.digits != Digits::Hexadecimal {
            return None;
        }
        let before = self.dump.data.len();
        let mut numeric = false;
        let near = piece.get(..LONGEST).unwrap_or(piece);
        for (index, letters) in near.as_chunks::<3>().0.iter().enumerate() {
            let [high, low, behind] = letters.map(|letter| NIBBLES[usize::from(letter)]);
            if high >= 16 || low >= 16 {
                break;
            }
            self.dump.data.push(high * 16 + low);
            numeric |= high.min(low) < 10;
            if behind == SEPARATES {
                continue;
            }
            if numeric && matches!(letters[2], b'\n' | b'\r') {
                self.close(None, None);
                return Some((index + 1) * 3);
            }
            break;
        }
        self.dump.data.truncate(before);
        None
    }

    /// Reads a line of nothing but whole bytes with plain separators between; leaves no trace
    /// of any other line.
    fn pairs(&mut self, line: &[u8]) -> bool {
        let before = self.dump.data.len();
        let mut numeric = false;
        let mut at = 0;
        while let Some(byte) = line.get(at) {
            let high = NIBBLES[usize::from(*byte)];
            if high == SEPARATES {
                at += 1;
                continue;
            }
            let low = line
                .get(at + 1)
                .map_or(STRANGE, |next| NIBBLES[usize::from(*next)]);
            if high < 16 && low < 16 {
                self.dump.data.push(high * 16 + low);
                numeric |= byte.is_ascii_digit() || line[at + 1].is_ascii_digit();
                at += 2;
                // A third digit goes on with the same number.
                continue;
            }
            let starts = at == 0 || NIBBLES[usize::from(line[at - 1])] == SEPARATES;
            let marks = *byte == b'0' && line.get(at + 1).is_some_and(|next| b"xX".contains(next));
            if marks && starts && line.get(at + 2).is_some_and(u8::is_ascii_hexdigit) {
                at += 2;
                continue;
            }
            self.dump.data.truncate(before);
            return false;
        }
        // Words of nothing but such letters are looked at more closely.
        if !numeric {
            self.dump.data.truncate(before);
        }
        numeric
    }

    /// Notes what stands in front of the data of a line; returns its time and direction.
    fn front(&mut self, text: Text<'_>, front: &Front) -> (Option<f64>, Option<Direction>) {
        self.drop(text, front.quote.clone(), Dropped::Quote);
        let mut time = None;
        if let Some((range, stamp)) = &front.stamp {
            self.drop(text, range.clone(), Dropped::Time);
            let first = match (self.first_day, stamp.day) {
                (Some(first), _) => first,
                (None, Some(day)) => *self.first_day.insert(day),
                (None, None) => 0,
            };
            let days = stamp.day.map_or(0, |day| day - first);
            time = Some(stamp.seconds + days as f64 * DAY);
        }
        if let Some((range, sign)) = &front.sign {
            self.drop(text, range.clone(), Dropped::Direction);
            self.direction = Some(sign.direction);
        }
        self.drop(text, front.labels.clone(), Dropped::Column);
        self.drop(text, front.length.clone(), Dropped::Column);
        let own = match &front.sign {
            Some((_, sign)) => {
                self.signs[usize::from(sign.direction == Direction::Sent)] = true;
                Some(sign.direction)
            }
            // Where only one direction is marked, what has no mark is of the other.
            None if front.stamp.is_none() && self.signs == [true; 2] => self.direction,
            None => None,
        };
        let (head_time, head_direction) = self.heading.unwrap_or_default();
        (time.or(head_time), own.or(head_direction))
    }
}

/// Not the digit of a number.
const STRANGE: u8 = 0xff;
const SEPARATES: u8 = 0xfe;
/// The value of each hexadecimal digit.
const NIBBLES: [u8; 256] = {
    let mut table = [STRANGE; 256];
    let mut digit = 0;
    while digit < 16 {
        table[b"0123456789abcdef"[digit] as usize] = digit as u8;
        table[b"0123456789ABCDEF"[digit] as usize] = digit as u8;
        digit += 1;
    }
    let separators = b" \t,;";
    let mut index = 0;
    while index < separators.len() {
        table[separators[index] as usize] = SEPARATES;
        index += 1;
    }
    table
};

/// Where a line that is too long is cut: behind a separator, or between two pairs of digits.
fn cut(line: &[u8]) -> usize {
    let separates = |byte: &u8| b" \t,;|".contains(byte);
    match line.iter().rposition(separates) {
        Some(last) if last > line.len() / 2 => last + 1,
        other => {
            let run = other.map_or(0, |last| last + 1);
            let even = line.len() - (line.len() - run) % 2;
            // A letter of several bytes stays whole.
            let whole = (even.saturating_sub(3)..=even).rev().find(|at| {
                line.get(*at)
                    .is_none_or(|byte| !(0x80..0xc0).contains(byte))
            });
            whole.filter(|at| *at > 0).unwrap_or(line.len())
        }
    }
}

/// A line without what separates it from the next.
pub(super) fn bare(line: &str) -> &str {
    line.trim_matches(|letter: char| letter.is_whitespace() || ",;".contains(letter))
}

pub(super) fn is_number(line: &str) -> bool {
    (1..=LONGEST_NUMBER).contains(&line.len()) && line.bytes().all(|digit| digit.is_ascii_digit())
}
