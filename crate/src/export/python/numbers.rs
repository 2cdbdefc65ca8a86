//! Numbers and flags out of the bytes, in Python.

use crate::{
    bits::{self, Span},
    export::plan::{Kind, Piece, Plan, Reading, Reply, Source, hex, pieces},
    layout::Field,
};
use alloc::{format, string::String, vec::Vec};

/// Whether any of the bits of a field that are in `mask` is set, or none is.
pub(super) fn any(reply: &Reply<'_>, field: &Field, mask: u64, than: &str) -> String {
    let masked = reply.masked(field, mask);
    let terms: Vec<String> = masked
        .iter()
        .map(|(byte, mask)| match mask {
            0xff => format!("data[{byte}]"),
            mask => format!("(data[{byte}] & {})", hex(*mask, 8)),
        })
        .collect();
    match terms.as_slice() {
        [one] => format!("{one} {than} 0"),
        more => format!("({}) {than} 0", more.join(" | ")),
    }
}

/// The number that a field holds.
pub(super) fn number(plan: &Plan<'_>, reply: &Reply<'_>, field: &Field) -> String {
    let parts = reply.layout.parts(field);
    if plan.is_bits()
        && let [part] = parts
    {
        return read(part.span);
    }
    let pieces = pieces(reply.layout, field);
    let terms: Vec<String> = pieces.iter().map(term).collect();
    match terms.as_slice() {
        [one] => one.clone(),
        more => format!("({})", more.join(" | ")),
    }
}

pub(super) fn read(span: Span) -> String {
    format!("read_bits(data, {}, {})", span.start, span.len)
}

pub(super) fn term(piece: &Piece) -> String {
    let mut text = format!("data[{}]", piece.byte);
    if piece.shift > 0 {
        text = format!("({text} >> {})", piece.shift);
    }
    if piece.width + (piece.shift as usize) < 8 {
        text = format!("({text} & {})", hex(bits::mask(piece.width), 8));
    }
    match piece.place {
        0 => text,
        place => format!("({text} << {place})"),
    }
}

/// The value of a quantity.
pub(super) fn taken(plan: &Plan<'_>, reply: &Reply<'_>, value: &Reading<'_>) -> String {
    let all = |field: &Field| hex(bits::mask(field.width as usize), field.width);
    let flag = |field: &Field, than: &str| match plan.is_bits() {
        true => format!("{} {than} 0", number(plan, reply, field)),
        false => any(reply, field, bits::mask(field.width as usize), than),
    };
    match (&value.from, value.kind) {
        (Source::Field(field), Kind::Flag) => flag(field, "!="),
        (Source::Inverted(field), Kind::Flag) => flag(field, "=="),
        (Source::Bit(field, place), _) => any(reply, field, bits::placed(1, *place), "!="),
        (Source::Inverted(field), _) => {
            format!("{} ^ {}", number(plan, reply, field), all(field))
        }
        (Source::Gray(field, word, below), kind) => {
            let mut text = String::from("word");
            if *below > 0 {
                text = format!("(word >> {below})");
            }
            if *below as usize + (field.width as usize) < word.len {
                text = format!("({text} & {})", all(field));
            }
            signed(kind, &text)
        }
        (Source::Field(field), kind) => signed(kind, &number(plan, reply, field)),
    }
}

fn signed(kind: Kind, text: &str) -> String {
    match kind {
        Kind::Signed(width) => {
            let sign = hex(bits::placed(1, width.saturating_sub(1)), width);
            format!("({text} ^ {sign}) - {sign}")
        }
        _ => text.into(),
    }
}
