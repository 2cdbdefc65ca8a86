//! What a decoder does, before it is written in a language.

mod replies;

use super::text;
use crate::{
    bits,
    check::Algorithm,
    decode::Decoder,
    format::Medium,
    layout::{Active, Covered, Field, Resolved, Role, StatusBit},
};
use alloc::{format, string::String, vec::Vec};
pub(super) use replies::pieces;
use replies::replies;

/// A decoder of one profile.
pub(super) struct Plan<'a> {
    /// The name of the format in snake case.
    pub(super) name: String,
    /// The name of the format for people.
    pub(super) title: &'static str,
    /// The parameters, as they are written in a link.
    pub(super) profile: String,
    pub(super) medium: Medium,
    pub(super) angle_bits: u32,
    /// What can be sent; more than one where a byte tells which.
    pub(super) replies: Vec<Reply<'a>>,
    pub(super) choice: Choice,
    pub(super) quantities: Vec<Quantity>,
    /// Status fields whose bits have names.
    pub(super) tables: Vec<(&'static str, Vec<StatusBit>)>,
}

/// A frame that an encoder can send.
pub(super) struct Reply<'a> {
    /// What tells it from others in names.
    pub(super) key: String,
    /// The first bytes, or the operations, that begin it.
    pub(super) leads: Vec<u8>,
    pub(super) layout: &'a Resolved,
    pub(super) doc: String,
    /// In the order in which they are made.
    pub(super) checks: Vec<Check<'a>>,
    pub(super) values: Vec<Reading<'a>>,
}

/// How the reply is known.
pub(super) enum Choice {
    /// There is one.
    One,
    /// Decimal digits in front of fixed bytes: so many digits at most, and those bytes.
    Digits { most: usize, behind: Vec<u8> },
    /// The whole first byte; any other is the reply of this index.
    Byte { other: usize },
    /// These bits of the first byte; others are no reply.
    Operation(Piece),
}

/// A number of the frame as it is given to the program.
#[derive(Clone, PartialEq, Eq)]
pub(super) struct Quantity {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) doc: String,
    /// Not in every reply.
    pub(super) optional: bool,
}

/// What a quantity is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Flag,
    /// So many bits.
    Unsigned(u32),
    /// So many bits, two's complement.
    Signed(u32),
}

impl Kind {
    /// Bits of the integer that holds it.
    pub(super) const fn size(self) -> u32 {
        match self {
            Self::Flag => 8,
            Self::Unsigned(width) | Self::Signed(width) => match width {
                0..=8 => 8,
                9..=16 => 16,
                17..=32 => 32,
                _ => 64,
            },
        }
    }
}

/// Where the value of a quantity comes from.
pub(super) struct Reading<'a> {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) from: Source<'a>,
}

/// How a value is taken out of the frame.
pub(super) enum Source<'a> {
    /// The bits of a field.
    Field(&'a Field),
    /// The bits of a field, inverted.
    Inverted(&'a Field),
    /// A field of a Gray word: the word's first bit and length, and how many bits are below.
    Gray(&'a Field, bits::Span, u32),
    /// One bit of a field's number.
    Bit(&'a Field, u32),
}

/// Something that must hold.
pub(super) enum Check<'a> {
    /// A CRC.
    Crc(&'a Field, Algorithm, Covered),
    /// A parity bit, the bits that it covers, and what it is when they are all 0.
    Parity(&'a Field, bits::Span, u32),
    /// Bits of a field's number that have a fixed value.
    Fixed {
        field: &'a Field,
        mask: u64,
        value: u64,
        problem: Problem,
    },
}

/// Why a frame is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Problem {
    Length,
    Request,
    Crc,
    Parity,
    Fixed,
    Padding,
    Digits,
    Range,
}

impl Problem {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Length => "length",
            Self::Request => "request",
            Self::Crc => "crc",
            Self::Parity => "parity",
            Self::Fixed => "fixed",
            Self::Padding => "padding",
            Self::Digits => "digits",
            Self::Range => "range",
        }
    }

    pub(super) const fn doc(self) -> &'static str {
        match self {
            Self::Length => "the frame is too short or too long",
            Self::Request => "the first byte names no known request",
            Self::Crc => "the CRC does not hold",
            Self::Parity => "the parity does not hold",
            Self::Fixed => "bits that never change have another value",
            Self::Padding => "bits above a number are not 0: it is wider than expected",
            Self::Digits => "a character is no digit",
            Self::Range => "the number is larger than the widest one",
        }
    }
}

/// A run of bits inside a byte, and its place in a number.
#[derive(Clone, Copy)]
pub(super) struct Piece {
    pub(super) byte: usize,
    /// How far its least significant bit stands from that of the byte.
    pub(super) shift: u32,
    pub(super) width: usize,
    /// How far its least significant bit stands from that of the number.
    pub(super) place: u32,
}

/// What a function for a CRC is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reach {
    /// Whole bytes.
    Bytes,
    /// A run of bits.
    Bits,
}

impl<'a> Plan<'a> {
    pub(super) fn new(decoder: &'a Decoder) -> Self {
        let profile = decoder.profile();
        let parameters = profile.parameters();
        let parameters: Vec<String> = parameters
            .iter()
            .map(|(name, value)| format!("{name}={}", value.plain()))
            .collect();
        let (replies, choice) = replies(decoder);
        let mut plan = Self {
            name: text::snake(profile.format.name()),
            title: profile.format.title(),
            profile: parameters.join(" "),
            medium: profile.medium(),
            angle_bits: profile.angle_bits,
            quantities: Vec::new(),
            tables: Vec::new(),
            replies,
            choice,
        };
        plan.gather();
        plan
    }

    /// The quantities of all replies, and the names of their bits.
    fn gather(&mut self) {
        for reply in &self.replies {
            for value in &reply.values {
                let has = |reply: &Reply<'_>| {
                    let mut values = reply.values.iter();
                    values.any(|other| other.name == value.name)
                };
                if self.quantities.iter().all(|known| known.name != value.name) {
                    self.quantities.push(Quantity {
                        name: value.name,
                        kind: value.kind,
                        doc: value.doc(self.angle_bits),
                        optional: !self.replies.iter().all(has),
                    });
                }
                let table: Vec<StatusBit> = match value.from {
                    Source::Field(field) | Source::Inverted(field) => {
                        let named = field.row.bits.iter().copied();
                        named.filter(|bit| bit.place < field.width).collect()
                    }
                    _ => Vec::new(),
                };
                let known = self.tables.iter().any(|(name, _)| *name == value.name);
                if !table.is_empty() && !known {
                    self.tables.push((value.name, table));
                }
            }
        }
    }

    /// What a frame can be refused for, in order.
    pub(super) fn problems(&self) -> Vec<Problem> {
        let mut all: Vec<Problem> = self.checks().map(Check::problem).collect();
        all.push(Problem::Length);
        match self.choice {
            Choice::One | Choice::Byte { .. } => {}
            Choice::Operation(_) => all.push(Problem::Request),
            Choice::Digits { .. } => all.extend([Problem::Digits, Problem::Fixed, Problem::Range]),
        }
        all.sort_unstable();
        all.dedup();
        all
    }

    fn checks(&self) -> impl Iterator<Item = &Check<'a>> {
        self.replies.iter().flat_map(|reply| &reply.checks)
    }

    /// The CRCs that are computed, and over what.
    pub(super) fn crcs(&self) -> Vec<(Algorithm, Reach)> {
        let mut all: Vec<(Algorithm, Reach)> = Vec::new();
        for check in self.checks() {
            if let Check::Crc(_, crc, covered) = check {
                let reach = reach(crc, *covered);
                match all.iter_mut().find(|(known, _)| known == crc) {
                    Some(known) if reach == Reach::Bits => known.1 = reach,
                    Some(_) => {}
                    None => all.push((*crc, reach)),
                }
            }
        }
        all
    }

    /// What the function for a CRC is given.
    pub(super) fn reach(&self, crc: &Algorithm) -> Reach {
        let all = self.crcs();
        let own = all.iter().find(|(known, _)| known == crc);
        own.map_or(Reach::Bytes, |(_, reach)| *reach)
    }

    /// Whether a parity is computed.
    pub(super) fn has_parity(&self) -> bool {
        self.checks()
            .any(|check| matches!(check, Check::Parity(..)))
    }

    /// Whether a word is Gray-coded.
    pub(super) fn has_gray(&self) -> bool {
        let mut values = self.replies.iter().flat_map(|reply| &reply.values);
        values.any(|value| matches!(value.from, Source::Gray(..)))
    }

    /// Whether numbers are runs of bits anywhere in the frame, not parts of bytes.
    pub(super) fn is_bits(&self) -> bool {
        self.medium == Medium::Bits
    }

    /// Bits of the integer that every run of bits fits in.
    pub(super) fn word_size(&self) -> u32 {
        let widths = self.replies.iter().flat_map(|reply| {
            let values = reply.values.iter().map(Reading::word);
            values.chain(reply.checks.iter().map(Check::width))
        });
        match widths.max() {
            Some(33..) => 64,
            _ => 32,
        }
    }

    /// What a frame consists of.
    pub(super) fn frame(&self, reply: &Reply<'_>) -> String {
        let fields = reply.layout.fields();
        let all: Vec<String> = fields
            .map(|field| format!("{}[{}]", field.row.name, field.width))
            .collect();
        format!("`{}`", all.join(" "))
    }

    /// What the input is.
    pub(super) fn input(&self) -> String {
        match (&self.choice, self.replies.first()) {
            (Choice::One, Some(reply)) if self.is_bits() => format!(
                "{} bits as they come on the wire, the first one the most significant bit of the \
                 first byte; what is behind them is left out. They are {}.",
                reply.layout.len,
                self.frame(reply)
            ),
            (Choice::One, Some(reply)) => format!(
                "{} bytes as they are received: {}.",
                reply.layout.len / 8,
                self.frame(reply)
            ),
            (Choice::Digits { .. }, _) => "one line of digits with its line end.".into(),
            _ => "one reply as it is received, from the echoed request on.".into(),
        }
    }

    /// What the numbers of the angle are.
    pub(super) fn unit(&self) -> String {
        format!(
            "One count of the angle is 360°/{}.",
            bits::codes(self.angle_bits)
        )
    }
}

impl Check<'_> {
    /// Bits of the number that is looked at.
    const fn width(&self) -> u32 {
        match self {
            Self::Crc(field, ..) | Self::Parity(field, ..) | Self::Fixed { field, .. } => {
                field.width
            }
        }
    }

    /// Whether it looks at some bits of the field only.
    pub(super) fn is_partial(&self) -> bool {
        match self {
            Self::Fixed { field, mask, .. } => *mask != bits::mask(field.width as usize),
            Self::Crc(..) | Self::Parity(..) => false,
        }
    }

    pub(super) fn problem(&self) -> Problem {
        match self {
            Self::Crc(..) => Problem::Crc,
            Self::Parity(..) => Problem::Parity,
            Self::Fixed { problem, .. } => *problem,
        }
    }
}

impl Reading<'_> {
    const fn field(&self) -> &Field {
        match self.from {
            Source::Field(field)
            | Source::Inverted(field)
            | Source::Gray(field, ..)
            | Source::Bit(field, _) => field,
        }
    }

    /// Bits of the run that must be read at once.
    const fn word(&self) -> u32 {
        match self.from {
            Source::Gray(_, word, _) => word.len as u32,
            _ => self.field().width,
        }
    }

    fn doc(&self, angle_bits: u32) -> String {
        let row = self.field().row;
        if let Source::Bit(_, place) = self.from {
            let named = row.bits.iter().find(|bit| bit.place == place);
            return named.map_or(String::new(), |bit| text::sentence(bit.doc));
        }
        let lines: Vec<&str> = row.doc.iter().map(|line| line.trim()).collect();
        let doc = lines.join(" ");
        match (row.role, row.active) {
            (Role::Angle, _) => {
                let most = bits::mask(angle_bits as usize);
                format!("{doc} Counts, 0 to {most}.")
            }
            (_, Active::Low) if self.kind == Kind::Flag => {
                format!("{doc} True here when it is asserted.")
            }
            (_, Active::Low) => format!("{doc} Inverted here: 1 says so."),
            _ => doc,
        }
    }
}

/// What a function for a CRC must be given: most work on bytes.
fn reach(crc: &Algorithm, covered: Covered) -> Reach {
    let whole = match covered {
        Covered::Run(span) => span.start.is_multiple_of(8) && span.len.is_multiple_of(8),
        Covered::Frame => true,
    };
    if whole && crc.width >= 8 {
        Reach::Bytes
    } else {
        Reach::Bits
    }
}

/// A number in hexadecimal digits, as many as `width` bits need.
pub(super) fn hex(value: u64, width: u32) -> String {
    let digits = width.div_ceil(4).next_multiple_of(2) as usize;
    format!("0x{value:0digits$x}")
}

/// The name of the function that computes a CRC.
pub(super) fn function(crc: &Algorithm) -> String {
    match crc.name() {
        Some(name) => text::snake(name),
        None => format!("crc_{}_{:x}", crc.width, crc.polynomial),
    }
}
