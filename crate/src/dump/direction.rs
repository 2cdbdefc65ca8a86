//! Marks of the direction in front of the lines of a log.

use crate::language::msg;

/// Which way a line went.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// From the host to the encoder.
    Sent,
    /// From the encoder to the host.
    Received,
}

impl Direction {
    /// The word for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sent => msg("sent"),
            Self::Received => msg("received"),
        }
    }
}

/// A mark of the direction at the start of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sign {
    /// Where what follows it begins.
    pub(super) end: usize,
    pub(super) direction: Direction,
}

const WORDS: [(&str, Direction); 29] = {
    use Direction::{Received, Sent};
    [
        ("tx", Sent),
        ("rx", Received),
        ("txd", Sent),
        ("rxd", Received),
        ("t", Sent),
        ("r", Received),
        ("w", Sent),
        ("send", Sent),
        ("sent", Sent),
        ("sending", Sent),
        ("recv", Received),
        ("rcv", Received),
        ("rcvd", Received),
        ("recd", Received),
        ("receive", Received),
        ("received", Received),
        ("receiving", Received),
        ("out", Sent),
        ("in", Received),
        ("outgoing", Sent),
        ("incoming", Received),
        ("write", Sent),
        ("read", Received),
        ("written", Sent),
        ("request", Sent),
        ("req", Sent),
        ("reply", Received),
        ("response", Received),
        ("answer", Received),
    ]
};

const ARROWS: [(&str, Direction); 14] = {
    use Direction::{Received, Sent};
    [
        (">>>", Sent),
        ("<<<", Received),
        ("-->", Sent),
        ("<--", Received),
        ("==>", Sent),
        ("<==", Received),
        (">>", Sent),
        ("<<", Received),
        ("->", Sent),
        ("<-", Received),
        ("=>", Sent),
        ("<=", Received),
        (">", Sent),
        ("<", Received),
    ]
};

/// Reads a mark at the start of `line`, which begins with no blank.
pub(super) fn read(line: &[u8]) -> Option<Sign> {
    let open = usize::from(line.first().is_some_and(|first| b"[(<\"".contains(first)));
    let word = word(line.get(open..)?).map(|(len, direction)| (open + len, direction));
    let (len, direction) = word.or_else(|| arrow(line))?;
    let closers = |byte: &&u8| b" \t:=|])>-<,;\"".contains(byte);
    let end = len + line.get(len..)?.iter().take_while(closers).count();
    Some(Sign { end, direction })
}

fn word(line: &[u8]) -> Option<(usize, Direction)> {
    let len = line
        .iter()
        .take(12)
        .take_while(|letter| letter.is_ascii_alphabetic())
        .count();
    let ends = line
        .get(len)
        .is_none_or(|next| !next.is_ascii_alphanumeric() && *next != b'_');
    let known = |(name, _): &&(&str, Direction)| {
        name.len() == len && line[..len].eq_ignore_ascii_case(name.as_bytes())
    };
    let (_, direction) = WORDS.iter().find(known).filter(|_| ends && len > 0)?;
    Some((len, *direction))
}

fn arrow(line: &[u8]) -> Option<(usize, Direction)> {
    let known = |(mark, _): &&(&str, Direction)| line.starts_with(mark.as_bytes());
    let (mark, direction) = ARROWS.iter().find(known)?;
    Some((mark.len(), *direction))
}

/// Which way what follows went, of a line that heads raw data, as PuTTY and port monitors
/// write it.
pub(super) fn heading(line: &str) -> Option<Direction> {
    let mut words = line.split_whitespace();
    let (_, direction) = word(words.next()?.as_bytes())?;
    let next = words.next()?;
    let data = next == "data" || next == "raw" && words.next() == Some("data");
    data.then_some(direction)
}
