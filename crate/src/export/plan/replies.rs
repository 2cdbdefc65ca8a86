//! What an encoder can send, out of the layouts.

use super::{Check, Choice, Kind, Piece, Problem, Quantity, Reading, Reply, Source, hex};
use crate::{
    bits,
    check::Checksum,
    decode::Decoder,
    layout::{Active, Coding, Covered, Field, Resolved, Role},
    profile::TurnsCode,
};
use alloc::{format, string::String, vec::Vec};

pub(super) fn replies(decoder: &Decoder) -> (Vec<Reply<'_>>, Choice) {
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
    pub(in crate::export) fn gray(&self) -> Option<bits::Span> {
        self.values.iter().find_map(|value| match value.from {
            Source::Gray(_, word, _) => Some(word),
            _ => None,
        })
    }

    /// The value of a quantity.
    pub(in crate::export) fn value(&self, quantity: &Quantity) -> Option<&Reading<'a>> {
        self.values.iter().find(|value| value.name == quantity.name)
    }

    /// For each byte of the frame, the bits that are not of a field.
    pub(in crate::export) fn masks(&self, field: &Field) -> Vec<String> {
        let mut masks = alloc::vec![0xff; self.layout.len.div_ceil(8)];
        for piece in pieces(self.layout, field) {
            if let Some(mask) = masks.get_mut(piece.byte) {
                *mask &= !bits::placed(bits::mask(piece.width), piece.shift);
            }
        }
        masks.into_iter().map(|mask| hex(mask, 8)).collect()
    }

    /// The bytes in which a field has bits that are in `mask`, and those bits.
    pub(in crate::export) fn masked(&self, field: &Field, mask: u64) -> Vec<(usize, u64)> {
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

/// The pieces of a field in single bytes, most significant first.
pub(in crate::export) fn pieces(layout: &Resolved, field: &Field) -> Vec<Piece> {
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
