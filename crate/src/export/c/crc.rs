//! Functions for CRCs, in C.

use super::comment;
use crate::{
    bits,
    check::Algorithm,
    export::{
        plan::{Kind, Reach, function, hex},
        text::{indented, lines, sentence},
    },
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// A function that computes a CRC.
pub(in crate::export) fn crc(crc: &Algorithm, reach: Reach) -> Vec<String> {
    let size = Kind::Unsigned(crc.width).size();
    let word = format!("uint{size}_t");
    let width = crc.width;
    let of = |value| hex(value, width);
    let top = of(bits::placed(1, width.saturating_sub(1)));
    let all = of(bits::mask(width as usize));
    let polynomial = of(crc.polynomial);
    let name = function(crc);
    let out = match crc.xorout {
        0 => "crc".to_string(),
        xorout => format!("({word})(crc ^ {})", of(xorout)),
    };
    let reflected = crc.refin && crc.refout;
    let bytewise = reach == Reach::Bytes && (reflected || width >= 8 && !crc.refin && !crc.refout);
    let mut text = comment(&sentence(&crc.to_string()));
    if bytewise {
        text.push(format!(
            "static {word} {name}(const uint8_t *bytes, size_t len)"
        ));
        let init = match reflected {
            true => bits::reversed(crc.init, width),
            false => crc.init,
        };
        text.extend(lines(&format!("{{\n    {word} crc = {};", of(init))));
        if crc.polynomial == 1 && width == 8 {
            text.extend(lines(
                "    for (size_t i = 0; i < len; i++)\n        crc ^= bytes[i];",
            ));
            text.extend(lines(&format!("    return {out};\n}}")));
            return text;
        }
        text.push("    for (size_t i = 0; i < len; i++) {".into());
        let body = if reflected {
            let polynomial = of(bits::reversed(crc.polynomial, width));
            format!(
                "crc ^= bytes[i];\nfor (int bit = 0; bit < 8; bit++)\n    \
                 crc = (crc & 1u) ? ({word})((crc >> 1) ^ {polynomial}) : ({word})(crc >> 1);"
            )
        } else {
            let shift = match width - 8 {
                0 => "bytes[i]".to_string(),
                up => format!("({word})(bytes[i] << {up})"),
            };
            let cut = if width == size {
                String::new()
            } else {
                format!("\ncrc &= {all};")
            };
            format!(
                "crc ^= {shift};\nfor (int bit = 0; bit < 8; bit++)\n    crc = (crc & {top}) ? \
                 ({word})((crc << 1) ^ {polynomial}) : ({word})(crc << 1);{cut}"
            )
        };
        text.extend(indented(8, lines(&body)));
        text.extend(lines(&format!("    }}\n    return {out};\n}}")));
        return text;
    }
    // Bit by bit, as they come, serves every width, place and order.
    let (given, bits) = match reach {
        Reach::Bytes => ("size_t len", "size_t bit = 0; bit < len * 8; bit++"),
        Reach::Bits => (
            "unsigned first, unsigned count",
            "unsigned bit = first; bit < first + count; bit++",
        ),
    };
    let order = match (crc.refin, reach) {
        (false, _) => "7 - bit % 8",
        (true, _) => "bit % 8",
    };
    text.push(format!(
        "static {word} {name}(const uint8_t *bytes, {given})"
    ));
    text.extend(lines(&format!(
        "{{\n    {word} crc = {init};\n    for ({bits}) {{\n        \
         bool carry = (((bytes[bit / 8] >> ({order})) ^ (crc >> {shift})) & 1) != 0;\n        \
         crc = ({word})((crc << 1) & {all});\n        if (carry)\n            \
         crc ^= {polynomial};\n    }}",
        init = of(crc.init),
        shift = width - 1,
    )));
    if crc.refout {
        text.extend(lines(&format!(
            "    {word} reversed = 0;\n    for (unsigned bit = 0; bit < {width}; bit++)\n        \
             reversed = ({word})((reversed << 1) | ((crc >> bit) & 1));\n    crc = reversed;"
        )));
    }
    text.extend(lines(&format!("    return {out};\n}}")));
    text
}
