//! Functions for CRCs, in Rust.

use super::doc;
use crate::{
    bits,
    check::Algorithm,
    export::{
        plan::{Kind, Reach, function, hex},
        text::{lines, sentence},
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
    let word = format!("u{size}");
    let width = crc.width;
    let of = |value| hex(value, width);
    let top = of(bits::placed(1, width.saturating_sub(1)));
    let all = of(bits::mask(width as usize));
    let polynomial = of(crc.polynomial);
    let name = function(crc);
    let xorout = match crc.xorout {
        0 => String::new(),
        xorout => format!(" ^ {}", of(xorout)),
    };
    let mut text = doc(&sentence(&crc.to_string()));
    let reflected = crc.refin && crc.refout;
    let bytewise = reach == Reach::Bytes && (reflected || width >= 8 && !crc.refin && !crc.refout);
    if bytewise && crc.polynomial == 1 && width == 8 {
        let init = of(crc.init);
        text.extend(lines(&format!(
            "fn {name}(bytes: &[u8]) -> {word} {{\n    \
             bytes.iter().fold({init}, |sum, byte| sum ^ byte){xorout}\n}}"
        )));
        return text;
    }
    if bytewise {
        let init = match reflected {
            true => bits::reversed(crc.init, width),
            false => crc.init,
        };
        let (enter, step) = if reflected {
            let polynomial = of(bits::reversed(crc.polynomial, width));
            (
                match size {
                    8 => "*byte".to_string(),
                    _ => format!("{word}::from(*byte)"),
                },
                ("1".to_string(), ">>", polynomial),
            )
        } else {
            let enter = match width - 8 {
                0 => "*byte".to_string(),
                up => format!("{word}::from(*byte) << {up}"),
            };
            (enter, (top, "<<", polynomial))
        };
        let (edge, shift, polynomial) = step;
        // Only the low bits of a register that is wider than the CRC are part of it.
        let cut = match width == size || reflected {
            true => String::new(),
            false => format!("            crc &= {all};\n"),
        };
        text.extend(lines(&format!(
            "fn {name}(bytes: &[u8]) -> {word} {{\n    let mut crc: {word} = {};\n    \
             for byte in bytes {{\n        crc ^= {enter};\n        for _ in 0..8 {{\n            \
             let carry = crc & {edge} != 0;\n            crc {shift}= 1;\n            \
             if carry {{\n                crc ^= {polynomial};\n            }}\n{cut}        \
             }}\n    }}\n    crc{xorout}\n}}",
            of(init)
        )));
        return text;
    }
    // Bit by bit, as they come, serves every width, place and order.
    let (given, bits) = match reach {
        Reach::Bytes => ("", "0..bytes.len() * 8"),
        Reach::Bits => (", first: usize, count: usize", "first..first + count"),
    };
    let order = if crc.refin {
        "bit % 8"
    } else {
        "(7 - bit % 8)"
    };
    let enter = match size {
        8 => format!("(bytes[bit / 8] >> {order})"),
        _ => format!("{word}::from(bytes[bit / 8] >> {order})"),
    };
    text.extend(lines(&format!(
        "fn {name}(bytes: &[u8]{given}) -> {word} {{\n    let mut crc: {word} = {init};\n    \
         for bit in {bits} {{\n        let carry = ({enter} ^ (crc >> {shift})) & 1 != 0;\n        \
         crc = (crc << 1) & {all};\n        if carry {{\n            crc ^= {polynomial};\n        \
         }}\n    }}",
        init = of(crc.init),
        shift = width - 1,
    )));
    if crc.refout {
        let spare = size - width;
        text.push(match spare {
            0 => "    crc = crc.reverse_bits();".into(),
            spare => format!("    crc = crc.reverse_bits() >> {spare};"),
        });
    }
    text.extend(lines(&format!("    crc{xorout}\n}}")));
    text
}
