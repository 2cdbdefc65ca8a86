//! What a decoder does, before it is written in a language.

use super::text;
use crate::{
    bits,
    check::{Algorithm, Checksum},
    decode::Decoder,
    format::Medium,
    layout::{Active, Coding, Covered, Field, Resolved, Role, StatusBit},
    profile::TurnsCode,
};
use alloc::{format, string::String, vec::Vec};

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
        all.join(" ")
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

/// The pieces of a field in single bytes, most significant first.
pub(super) fn pieces(layout: &Resolved, field: &Field) -> Vec<Piece> {
    let mut out = Vec::new();
    for part in layout.parts(field) {
        let mut at = part.span.start;
        while at < part.span.end() {
            let take = (8 - at % 8).min(part.span.end() - at);
            out.push(Piece {
                byte: at / 8,
                shift: (8 - at % 8 - take) as u32,
                width: take,
                place: part.place + (part.span.end() - at - take) as u32,
            });
            at += take;
        }
    }
    out.sort_by_key(|piece| core::cmp::Reverse(piece.place));
    out
}

fn replies(decoder: &Decoder) -> (Vec<Reply<'_>>, Choice) {
    let all = decoder.replies();
    let mut out: Vec<Reply<'_>> = Vec::new();
    let operation = |layout: &'_ Resolved| {
        let mut fields = layout.fields();
        let field = fields.find(|field| field.row.role == Role::Operation)?;
        pieces(layout, field).first().copied()
    };
    let led = all.first().and_then(|(_, layout)| operation(layout));
    let Some(led) = led else {
        // Of lines of text the longest stands for all.
        let Some((_, layout)) = all.last().copied() else {
            return (out, Choice::One);
        };
        let choice = digits(layout, all.len()).unwrap_or(Choice::One);
        out.push(Reply::new(String::new(), layout));
        return (out, choice);
    };
    let code = |byte: u8| bits::low_byte(bits::slice(byte.into(), led.shift, led.width));
    let codes = bits::mask(led.width) as usize + 1;
    // Where every operation has one byte, the byte is what people know it by.
    let by_byte = all.len() == codes;
    for (byte, layout) in &all {
        let lead = if by_byte { *byte } else { code(*byte) };
        let same = |reply: &&mut Reply<'_>| core::ptr::eq(reply.layout.layout, layout.layout);
        match out.iter_mut().find(same) {
            Some(reply) if reply.leads.contains(&lead) => {}
            Some(reply) => reply.leads.push(lead),
            None => {
                let mut reply = Reply::new(String::new(), layout);
                reply.leads.push(lead);
                out.push(reply);
            }
        }
    }
    for reply in &mut out {
        let first = reply.leads.first().copied().unwrap_or(0);
        reply.key = match by_byte {
            true => format!("_{first:02x}"),
            false => format!("_{first}"),
        };
    }
    let most = out.iter().map(|reply| reply.leads.len()).max();
    let other = out.iter().position(|reply| Some(reply.leads.len()) == most);
    let choice = match by_byte {
        true => Choice::Byte {
            other: other.unwrap_or(0),
        },
        false => Choice::Operation(led),
    };
    (out, choice)
}

/// Lines of text: digits, and fixed bytes behind them.
fn digits(layout: &Resolved, most: usize) -> Option<Choice> {
    let mut fields = layout.fields();
    let number = fields.find(|field| matches!(layout.coding(field), Some((Coding::Decimal, _))))?;
    layout.coding(number)?;
    let behind = fields
        .filter_map(|field| field.row.constant)
        .map(bits::low_byte);
    Some(Choice::Digits {
        most,
        behind: behind.collect(),
    })
}

impl<'a> Reply<'a> {
    /// The Gray-coded word.
    pub(super) fn gray(&self) -> Option<bits::Span> {
        self.values.iter().find_map(|value| match value.from {
            Source::Gray(_, word, _) => Some(word),
            _ => None,
        })
    }

    /// The value of a quantity.
    pub(super) fn value(&self, quantity: &Quantity) -> Option<&Reading<'a>> {
        self.values.iter().find(|value| value.name == quantity.name)
    }

    /// For each byte of the frame, the bits that are not of a field.
    pub(super) fn masks(&self, field: &Field) -> Vec<String> {
        let mut masks = alloc::vec![0xff; self.layout.len.div_ceil(8)];
        for piece in pieces(self.layout, field) {
            if let Some(mask) = masks.get_mut(piece.byte) {
                *mask &= !bits::placed(bits::mask(piece.width), piece.shift);
            }
        }
        masks.into_iter().map(|mask| hex(mask, 8)).collect()
    }

    /// The bytes in which a field has bits that are in `mask`, and those bits.
    pub(super) fn masked(&self, field: &Field, mask: u64) -> Vec<(usize, u64)> {
        let pieces = pieces(self.layout, field);
        let masked = |piece: &Piece| {
            let wanted = bits::slice(mask, piece.place, piece.width);
            (piece.byte, bits::placed(wanted, piece.shift))
        };
        pieces
            .iter()
            .map(masked)
            .filter(|(_, mask)| *mask != 0)
            .collect()
    }

    fn new(key: String, layout: &'a Resolved) -> Self {
        let doc: Vec<&str> = layout.layout.doc.iter().map(|line| line.trim()).collect();
        let mut checks = Vec::new();
        let mut fixed = Vec::new();
        for field in layout.fields() {
            if let (true, Some((sum, covered))) = (field.is_binding(), field.cover) {
                checks.push(check(field, sum, covered));
            }
            let (mask, value) = match field.row.constant {
                Some(constant) => (bits::mask(field.width as usize), constant),
                None => (field.row.zeros, 0),
            };
            if mask != 0 {
                let problem = match field.row.role {
                    Role::Padding => Problem::Padding,
                    _ => Problem::Fixed,
                };
                fixed.push(Check::Fixed {
                    field,
                    mask,
                    value,
                    problem,
                });
            }
        }
        // A CRC says more than bits that are 0 by chance.
        checks.sort_by_key(Check::problem);
        checks.extend(fixed);
        Self {
            key,
            leads: Vec::new(),
            layout,
            doc: doc.join(" "),
            checks,
            values: layout
                .fields()
                .flat_map(|field| values(layout, field))
                .collect(),
        }
    }
}

fn check(field: &Field, sum: Checksum, covered: Covered) -> Check<'_> {
    let span = match covered {
        Covered::Run(span) => span,
        Covered::Frame => bits::Span::default(),
    };
    match (sum.algorithm(), sum) {
        (Some(crc), _) => Check::Crc(field, crc, covered),
        (None, Checksum::OddParity) => Check::Parity(field, span, 1),
        (None, _) => Check::Parity(field, span, 0),
    }
}

/// What a field says.
fn values<'a>(layout: &'a Resolved, field: &'a Field) -> Vec<Reading<'a>> {
    let row = field.row;
    let Some(name) = row.role.quantity() else {
        return Vec::new();
    };
    let profile = &layout.shape.profile;
    let signed = match row.role {
        Role::Speed | Role::Temperature => true,
        Role::Turns => profile.turns_code == TurnsCode::Signed,
        _ => false,
    };
    let decimal = matches!(layout.coding(field), Some((Coding::Decimal, _)));
    let flag = matches!(
        row.role,
        Role::Error | Role::Warning | Role::Valid | Role::ZeroDefault
    );
    let kind = match (flag, signed) {
        (true, _) => Kind::Flag,
        (_, true) => Kind::Signed(field.width),
        _ if decimal => Kind::Unsigned(profile.angle_bits),
        (_, false) => Kind::Unsigned(field.width),
    };
    let part = layout.parts(field).first();
    let from = match (layout.coding(field), part, row.active) {
        (Some((Coding::Gray, word)), Some(part), _) => {
            Source::Gray(field, word, (word.end() - part.span.end()) as u32)
        }
        (_, _, Active::Low) => Source::Inverted(field),
        _ => Source::Field(field),
    };
    let mut out = Vec::from([Reading { name, kind, from }]);
    for bit in row.bits {
        if let Some(name) = bit.role.and_then(Role::quantity) {
            out.push(Reading {
                name,
                kind: Kind::Flag,
                from: Source::Bit(field, bit.place),
            });
        }
    }
    out
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
