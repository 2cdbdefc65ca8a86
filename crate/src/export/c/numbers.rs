//! Numbers and flags out of the bytes, in C.

use super::integer;
use crate::{
    bits::{self, Span},
    export::{
        plan::{Kind, Piece, Plan, Reading, Reply, Source, hex, pieces},
        text::{bare, closes_last},
    },
    layout::Field,
};
use alloc::{format, string::String, vec::Vec};

pub(super) fn offset(bytes: &str, at: usize) -> String {
    match at {
        0 => bytes.into(),
        _ => format!("{bytes} + {at}"),
    }
}

/// Whether any of the bits of a field that are in `mask` is set, or none is.
pub(super) fn any(reply: &Reply<'_>, field: &Field, mask: u64, than: &str) -> String {
    let masked = reply.masked(field, mask);
    let terms: Vec<String> = masked
        .iter()
        .map(|(byte, mask)| match mask {
            0xff => format!("bytes[{byte}]"),
            mask => format!("(bytes[{byte}] & {})", hex(*mask, 8)),
        })
        .collect();
    match terms.as_slice() {
        [one] => format!("{one} {than} 0"),
        more => format!("({}) {than} 0", more.join(" | ")),
    }
}

/// An unsigned number in C.
pub(super) struct Number {
    pub(super) text: String,
    /// Bits of its type; none for what the rules of C make an `int`.
    size: Option<u32>,
}

/// The number that a field holds.
pub(super) fn number(plan: &Plan<'_>, reply: &Reply<'_>, field: &Field) -> Number {
    let parts = reply.layout.parts(field);
    if plan.is_bits()
        && let [part] = parts
    {
        return Number {
            text: read(part.span),
            size: Some(plan.word_size()),
        };
    }
    let pieces = pieces(reply.layout, field);
    let wide = Kind::Unsigned(field.width).size();
    let terms: Vec<String> = pieces.iter().map(|piece| term(piece, wide)).collect();
    match (pieces.as_slice(), terms.as_slice()) {
        ([piece], [one]) => Number {
            text: one.clone(),
            size: (piece.width == 8).then_some(8),
        },
        (_, more) => Number {
            text: format!("({})", more.join(" | ")),
            size: (wide >= 32).then_some(wide),
        },
    }
}

pub(super) fn read(span: Span) -> String {
    format!("read_bits(bytes, {}, {})", span.start, span.len)
}

pub(super) fn term(piece: &Piece, wide: u32) -> String {
    let mut text = format!("bytes[{}]", piece.byte);
    if piece.shift > 0 {
        text = format!("({text} >> {})", piece.shift);
    }
    if piece.width + (piece.shift as usize) < 8 {
        text = format!("({text} & {})", hex(bits::mask(piece.width), 8));
    }
    match (piece.place, wide) {
        (0, _) => text,
        (place, 64) => format!("((uint64_t){text} << {place})"),
        (place, 32) => format!("((uint32_t){text} << {place})"),
        (place, _) => format!("({text} << {place})"),
    }
}

/// The value of a quantity.
pub(super) fn taken(plan: &Plan<'_>, reply: &Reply<'_>, value: &Reading<'_>) -> String {
    let all = |field: &Field| bits::mask(field.width as usize);
    let flag = |field: &Field, than: &str| match plan.is_bits() {
        true => format!("{} {than} 0", number(plan, reply, field).text),
        false => any(reply, field, all(field), than),
    };
    match (&value.from, value.kind) {
        (Source::Field(field), Kind::Flag) => flag(field, "!="),
        (Source::Inverted(field), Kind::Flag) => flag(field, "=="),
        (Source::Bit(field, place), _) => any(reply, field, bits::placed(1, *place), "!="),
        (Source::Inverted(field), kind) => {
            let text = format!(
                "{} ^ {}",
                number(plan, reply, field).text,
                hex(all(field), field.width)
            );
            cast(kind, &text)
        }
        (Source::Gray(field, word, below), kind) => {
            let mut text = String::from("word");
            if *below > 0 {
                text = format!("(word >> {below})");
            }
            if *below as usize + (field.width as usize) < word.len {
                text = format!("({text} & {})", hex(all(field), field.width));
            }
            let size = Some(plan.word_size());
            shaped(kind, &Number { text, size })
        }
        (Source::Field(field), kind) => shaped(kind, &number(plan, reply, field)),
    }
}

/// A number as the integer that holds it.
pub(super) fn shaped(kind: Kind, number: &Number) -> String {
    let text = number.text.as_str();
    match kind {
        Kind::Signed(width) => {
            let sign = hex(bits::placed(1, width.saturating_sub(1)), width);
            let wide = if width < 32 { 32 } else { 64 };
            let number = format!("(int{wide}_t)({text} ^ {sign}) - {sign}");
            match wide == kind.size() {
                true => number,
                false => cast(kind, &number),
            }
        }
        // What is of the integer's type is not converted.
        _ if number.size == Some(kind.size()) => bare(text).into(),
        _ => cast(kind, text),
    }
}

fn cast(kind: Kind, text: &str) -> String {
    let call = text.starts_with("read_bits(") || text.starts_with('(');
    match call && closes_last(text) {
        // One pair of parentheses is enough.
        true => format!("({}){text}", integer(kind)),
        false => format!("({})({text})", integer(kind)),
    }
}
