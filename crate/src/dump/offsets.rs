//! Hexdumps: an offset, bytes, and the same bytes as letters.

use crate::language::msg;
use alloc::vec::Vec;

/// Bytes of the longest line of a hexdump.
const WIDEST: usize = 256;

/// How a hexdump is made up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Offsets {
    /// Number base of the offsets.
    base: u32,
    style: Style,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Style {
    Canonical,
    Xxd,
    Od,
    /// Numbers of two bytes, the low one first.
    Words,
    Plain,
}

/// A line of a hexdump.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Row<'a> {
    pub(super) offset: &'a str,
    pub(super) bytes: Vec<u8>,
    /// Where the offset begins, where it ends, and where the bytes end.
    pub(super) places: [usize; 3],
    colon: bool,
    bar: bool,
    /// Digits of its first number.
    width: usize,
}

impl<'a> Row<'a> {
    pub(super) fn read(line: &'a str) -> Option<Self> {
        let start = line.len() - line.trim_start().len();
        let rest = line.get(start..)?;
        let digits = rest.bytes().take_while(u8::is_ascii_hexdigit).count();
        let offset = rest.get(..digits).filter(|_| (4..=16).contains(&digits))?;
        let behind = &rest[digits..];
        let colon = behind.starts_with(':');
        let behind = behind.strip_prefix([':', 'h']).unwrap_or(behind);
        if !behind.is_empty() && !behind.starts_with([' ', '\t']) {
            return None;
        }
        let ends = line.len() - behind.len();
        let mut row = Row {
            offset,
            bytes: Vec::new(),
            places: [start, ends, ends],
            colon,
            bar: behind.contains('|'),
            width: 0,
        };
        row.read_bytes(line);
        Some(row)
    }

    /// Up to a wide gap, a bar or something else than numbers of the same width.
    fn read_bytes(&mut self, line: &str) {
        let widest = if self.colon { 1 } else { 2 };
        let mut at = self.places[1];
        loop {
            let rest = line.get(at..).unwrap_or_default();
            let gap = rest.len() - rest.trim_start_matches([' ', '\t']).len();
            let token = rest[gap..]
                .split([' ', '\t', '-'])
                .next()
                .unwrap_or_default();
            let first = self.width == 0;
            let fits = first || token.len() <= self.width && gap <= widest;
            let even = token.len().is_multiple_of(2) && (2..=16).contains(&token.len());
            let hex = token.bytes().all(|digit| digit.is_ascii_hexdigit());
            if !(fits && even && hex) || self.bytes.len() >= WIDEST {
                return;
            }
            if first {
                self.width = token.len();
            }
            for pair in token.as_bytes().chunks(2) {
                let pair = core::str::from_utf8(pair).unwrap_or_default();
                self.bytes.extend(u8::from_str_radix(pair, 16).ok());
            }
            at += gap + token.len();
            self.places[2] = at;
            // Some programs put a dash between the halves of a line.
            let dash = line.get(at..).is_some_and(|rest| rest.starts_with('-'));
            at += usize::from(dash);
        }
    }
}

impl Offsets {
    /// Whether lines are those of a hexdump: their offsets grow by what is in them.
    pub(super) fn of(lines: &[impl AsRef<str>]) -> Option<Self> {
        let rows: Vec<Option<Row<'_>>> =
            lines.iter().map(|line| Row::read(line.as_ref())).collect();
        let found: Vec<&Row<'_>> = rows.iter().flatten().filter(|row| row.width > 0).collect();
        let first = *found.first()?;
        let mut best: Option<(usize, u32)> = None;
        for base in [16, 8, 10] {
            let steps = rows.windows(2).filter_map(|pair| match pair {
                [Some(one), Some(next)] if !one.bytes.is_empty() => {
                    let one_at = u64::from_str_radix(one.offset, base).ok();
                    let next_at = u64::from_str_radix(next.offset, base).ok();
                    let restarts = next_at == Some(0);
                    let step = one_at.map(|at| at + one.bytes.len() as u64);
                    // The last of an odd number of bytes is written as a word.
                    let short = step.map(|step| step.saturating_sub(1));
                    (!restarts).then_some(
                        next_at.is_some()
                            && (step == next_at || one.width == 4 && short == next_at),
                    )
                }
                _ => None,
            });
            let (mut good, mut bad) = (0, 0);
            steps.for_each(|step| if step { good += 1 } else { bad += 1 });
            if good > bad * 4 && best.is_none_or(|(most, _)| good > most) {
                best = Some((good, base));
            }
        }
        let base = match best {
            Some((_, base)) => base,
            None if found.iter().all(|row| row.stands_alone()) => 16,
            None => return None,
        };
        let style = match first {
            Row { colon: true, .. } => Style::Xxd,
            Row { bar: true, .. } => Style::Canonical,
            Row {
                width: 4, offset, ..
            } if offset.len() == 7 => Style::Words,
            Row { offset, .. } if (6..=7).contains(&offset.len()) => Style::Od,
            _ => Style::Plain,
        };
        Some(Self { base, style })
    }

    pub(super) const fn name(&self) -> &'static str {
        match self.style {
            Style::Canonical => "hexdump -C",
            Style::Xxd => "xxd",
            Style::Od => "od",
            Style::Words => msg("hexdump of words"),
            Style::Plain => "hexdump",
        }
    }

    /// The offset of a row.
    pub(super) fn at(&self, row: &Row<'_>) -> Option<u64> {
        u64::from_str_radix(row.offset, self.base).ok()
    }

    /// The bytes of a row in the order of their addresses.
    pub(super) fn ordered<'r>(&self, row: &'r mut Row<'_>) -> &'r [u8] {
        if self.style == Style::Words && row.width == 4 {
            row.bytes.chunks_exact_mut(2).for_each(<[u8]>::reverse);
        }
        &row.bytes
    }
}

impl Row<'_> {
    /// Whether a line alone is one of a hexdump.
    fn stands_alone(&self) -> bool {
        let zero = self.offset.bytes().all(|digit| digit == b'0');
        let other = self.width != self.offset.len() && self.width <= 4;
        other && (self.colon || zero && self.offset.len() >= 6)
    }
}
