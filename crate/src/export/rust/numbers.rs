//! Numbers and flags out of the bytes, in Rust.

use super::integer;
use crate::{
    bits::{self, Span},
    export::{
        plan::{Kind, Piece, Plan, Reading, Reply, Source, hex, pieces},
        text::closes_last,
    },
    layout::Field,
};
use alloc::{format, string::String, vec::Vec};

/// Whether any of the bits of a field that are in `mask` is set, or none is.
pub(super) fn any(reply: &Reply<'_>, field: &Field, mask: u64, than: &str) -> String {
    let masked = reply.masked(field, mask);
    let one = masked.len() == 1;
    let terms: Vec<String> = masked
        .iter()
        .map(|(byte, mask)| match mask {
            0xff => format!("bytes[{byte}]"),
            mask if one => format!("bytes[{byte}] & {}", hex(*mask, 8)),
            mask => format!("(bytes[{byte}] & {})", hex(*mask, 8)),
        })
        .collect();
    format!("{} {than} 0", terms.join(" | "))
}

/// Whether the only bit of a field is set.
pub(super) fn flag(plan: &Plan<'_>, reply: &Reply<'_>, field: &Field, than: &str) -> String {
    match plan.is_bits() {
        true => format!("{} {than} 0", number(plan, reply, field)),
        false => any(reply, field, bits::mask(field.width as usize), than),
    }
}

/// The number that a field holds, as an unsigned integer.
pub(super) fn number(plan: &Plan<'_>, reply: &Reply<'_>, field: &Field) -> String {
    let parts = reply.layout.parts(field);
    if plan.is_bits()
        && let [part] = parts
    {
        return read(part.span);
    }
    let wide = Kind::Unsigned(field.width).size();
    let pieces = pieces(reply.layout, field);
    let terms: Vec<String> = pieces.iter().map(|piece| term(piece, wide)).collect();
    terms.join(" | ")
}

pub(super) fn read(span: Span) -> String {
    format!("read_bits(bytes, {}, {})", span.start, span.len)
}

pub(super) fn term(piece: &Piece, wide: u32) -> String {
    let mut text = format!("bytes[{}]", piece.byte);
    if piece.shift > 0 {
        text = format!("{text} >> {}", piece.shift);
    }
    if piece.width + (piece.shift as usize) < 8 {
        let mask = hex(bits::mask(piece.width), 8);
        text = match piece.shift {
            0 => format!("{text} & {mask}"),
            _ => format!("({text}) & {mask}"),
        };
    }
    match (piece.place, wide) {
        (_, 8) => text,
        (0, wide) => format!("u{wide}::from({text})"),
        (place, wide) => format!("(u{wide}::from({text}) << {place})"),
    }
}

/// The value of a quantity.
pub(super) fn taken(plan: &Plan<'_>, reply: &Reply<'_>, value: &Reading<'_>) -> String {
    let all = |field: &Field| hex(bits::mask(field.width as usize), field.width);
    match (&value.from, value.kind) {
        (Source::Field(field), Kind::Flag) => flag(plan, reply, field, "!="),
        (Source::Inverted(field), Kind::Flag) => flag(plan, reply, field, "=="),
        (Source::Bit(field, place), _) => any(reply, field, bits::placed(1, *place), "!="),
        (Source::Inverted(field), kind) => {
            let text = format!("({} ^ {})", number(plan, reply, field), all(field));
            format!("{text} as {}", integer(kind))
        }
        (Source::Gray(field, word, below), kind) => {
            let mut text = String::from("word");
            if *below > 0 {
                text = format!("(word >> {below})");
            }
            if *below as usize + (field.width as usize) < word.len {
                text = format!("{text} & {}", all(field));
            }
            shaped(plan, kind, &text)
        }
        (Source::Field(field), kind) => shaped(plan, kind, &number(plan, reply, field)),
    }
}

/// A number as the integer that holds it.
pub(super) fn shaped(plan: &Plan<'_>, kind: Kind, text: &str) -> String {
    let own = match plan.is_bits() {
        true => plan.word_size(),
        false => kind.size(),
    };
    let one = !text.contains(' ') || closes_last(text);
    let whole = if one {
        text.into()
    } else {
        format!("({text})")
    };
    match kind {
        // A number as wide as the integer has its sign where it belongs.
        Kind::Signed(width) if width == kind.size() => format!("{whole} as {}", integer(kind)),
        Kind::Signed(width) => {
            let sign = hex(bits::placed(1, width.saturating_sub(1)), width);
            let wide = if width < 32 { 32 } else { 64 };
            let number = format!("({whole} ^ {sign}) as i{wide} - {sign}");
            match wide == kind.size() {
                true => number,
                false => format!("({number}) as {}", integer(kind)),
            }
        }
        _ if own == kind.size() => text.into(),
        _ => format!("{whole} as {}", integer(kind)),
    }
}
