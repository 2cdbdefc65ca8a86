//! Functions for CRCs, in Python.

use super::doc;
use crate::{
    bits,
    check::Algorithm,
    export::{
        plan::{Reach, function, hex},
        text::{indented, lines, sentence},
    },
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// The loop over a run of bits.
const BITS: &str = "for bit in range(first, first + count):";

/// A function that computes a CRC.
pub(in crate::export) fn crc(crc: &Algorithm, reach: Reach) -> Vec<String> {
    let width = crc.width;
    let of = |value| hex(value, width);
    let all = of(bits::mask(width as usize));
    let polynomial = of(crc.polynomial);
    let name = function(crc);
    let xorout = match crc.xorout {
        0 => String::new(),
        xorout => format!(" ^ {}", of(xorout)),
    };
    let about = indented(4, doc(&sentence(&crc.to_string())));
    let given = match reach {
        Reach::Bytes => "data: bytes",
        Reach::Bits => "data: bytes, first: int, count: int",
    };
    let mut text = Vec::from([format!("def {name}({given}) -> int:")]);
    text.extend(about);
    let reflected = crc.refin && crc.refout;
    let body = if reach == Reach::Bytes && crc.polynomial == 1 && width == 8 {
        format!(
            "crc = {}\nfor byte in data:\n    crc ^= byte\nreturn crc{xorout}",
            of(crc.init)
        )
    } else if reach == Reach::Bytes && reflected {
        format!(
            "crc = {}\nfor byte in data:\n    crc ^= byte\n    for _ in range(8):\n        \
             crc = (crc >> 1) ^ {} if crc & 1 else crc >> 1\nreturn crc{xorout}",
            of(bits::reversed(crc.init, width)),
            of(bits::reversed(crc.polynomial, width)),
        )
    } else {
        let (loops, bit, by) = match (reach, crc.refin) {
            (Reach::Bytes, false) => (
                "for byte in data:\n    for place in range(7, -1, -1):",
                "(byte >> place)",
                8,
            ),
            (Reach::Bytes, true) => (
                "for byte in data:\n    for place in range(8):",
                "(byte >> place)",
                8,
            ),
            (Reach::Bits, false) => (BITS, "read_bits(data, bit, 1)", 4),
            (Reach::Bits, true) => (BITS, "read_bits(data, bit ^ 7, 1)", 4),
        };
        let reversed = match crc.refout {
            true => format!("crc = int(f\"{{crc:0{width}b}}\"[::-1], 2)\n"),
            false => String::new(),
        };
        let step = indented(
            by,
            lines(&format!(
                "carry = ({bit} ^ (crc >> {})) & 1\ncrc = (crc << 1) & {all}\nif carry:\n    \
                 crc ^= {polynomial}",
                width - 1
            )),
        );
        format!(
            "crc = {}\n{loops}\n{}\n{reversed}return crc{xorout}",
            of(crc.init),
            step.join("\n")
        )
    };
    text.extend(indented(4, lines(&body)));
    text
}
