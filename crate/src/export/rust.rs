//! Rust without the standard library.

mod crc;
mod numbers;

pub(super) use crc::crc;

use super::{
    plan::{Check, Choice, Kind, Plan, Problem, Reach, Reply},
    plan::{function, hex},
    text::{folded, indented, joined, lines, pascal, sentence, upper, wrapped},
};
use crate::{bits, layout::Covered};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};
use numbers::{any, flag, number, read, shaped, taken, term};

/// The longest line, that of rustfmt, less the indentation of a statement.
const ROOM: usize = 96;

/// The whole file.
pub(super) fn source(plan: &Plan<'_>) -> String {
    let mut out = head(plan);
    out.extend(declarations(plan));
    if plan.replies.len() > 1 {
        out.extend(choice(plan));
    }
    for reply in &plan.replies {
        out.extend(reply_function(plan, reply));
    }
    out.extend(helpers(plan));
    while out.last().is_some_and(String::is_empty) {
        out.pop();
    }
    joined(&out)
}

fn head(plan: &Plan<'_>) -> Vec<String> {
    let mut out = Vec::new();
    let paragraphs = [
        format!("Decodes {} frames of an absolute encoder.", plan.title),
        format!("Profile: `{}`", plan.profile),
        format!("Input: {} {}", plan.input(), plan.unit()),
        "Made by Encoderscope. Needs `core` alone: no allocation, no dependencies.".into(),
    ];
    for (index, text) in paragraphs.iter().enumerate() {
        if index > 0 {
            out.push("//!".into());
        }
        out.extend(wrapped("//! ", text));
    }
    out.push(String::new());
    out
}

fn doc(text: &str) -> Vec<String> {
    wrapped("/// ", text)
}

fn frame(plan: &Plan<'_>) -> String {
    format!("{}Frame", pascal(&plan.name))
}

fn error(plan: &Plan<'_>) -> String {
    format!("{}Error", pascal(&plan.name))
}

fn declarations(plan: &Plan<'_>) -> Vec<String> {
    let (frame, error) = (frame(plan), error(plan));
    let mut out = doc("Why a frame is refused.");
    out.push("#[derive(Clone, Copy, Debug, PartialEq, Eq)]".into());
    out.push(format!("pub enum {error} {{"));
    for problem in plan.problems() {
        out.extend(indented(4, doc(&sentence(problem.doc()))));
        out.push(format!("    {},", pascal(problem.name())));
    }
    out.extend(lines("}\n"));
    out.extend(lines(&format!(
        "impl core::fmt::Display for {error} {{\n    \
         fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {{\n        \
         f.write_str(match self {{"
    )));
    for problem in plan.problems() {
        let (name, text) = (pascal(problem.name()), problem.doc());
        out.push(format!("            Self::{name} => \"{text}\","));
    }
    out.extend(lines("        })\n    }\n}\n"));
    out.extend(doc(match plan.replies.len() {
        1 => "What a frame says.",
        _ => "What a reply says; `None` where it has no such field.",
    }));
    out.push("#[derive(Clone, Copy, Debug, PartialEq, Eq)]".into());
    out.push(format!("pub struct {frame} {{"));
    for quantity in &plan.quantities {
        out.extend(indented(4, doc(&quantity.doc)));
        let kind = match quantity.optional {
            true => format!("Option<{}>", integer(quantity.kind)),
            false => integer(quantity.kind),
        };
        out.push(format!("    pub {}: {kind},", quantity.name));
    }
    out.extend(lines("}\n"));
    let mut own = Vec::new();
    for (field, table) in &plan.tables {
        for bit in table {
            own.extend(doc(&format!("In `{field}`: {}.", bit.doc)));
            let name = format!("{}_{}", upper(field), upper(bit.name));
            let mask = hex(bits::placed(1, bit.place), 8);
            own.push(format!("pub const {name}: u8 = {mask};"));
        }
        own.push(String::new());
    }
    let angle = plan
        .quantities
        .iter()
        .find(|quantity| quantity.name == "angle");
    if let Some(angle) = angle {
        let turn = bits::codes(plan.angle_bits);
        own.extend(doc("The angle in degrees, from 0 up to 360."));
        own.extend(match angle.optional {
            true => lines(&format!(
                "pub fn degrees(&self) -> Option<f64> {{\n    \
                 self.angle.map(|angle| angle as f64 * 360.0 / {turn}.0)\n}}"
            )),
            false => lines(&format!(
                "pub fn degrees(&self) -> f64 {{\n    self.angle as f64 * 360.0 / {turn}.0\n}}"
            )),
        });
    }
    while own.last().is_some_and(String::is_empty) {
        own.pop();
    }
    if !own.is_empty() {
        out.push(format!("impl {frame} {{"));
        out.extend(indented(4, own));
        out.extend(lines("}\n"));
    }
    out
}

fn integer(kind: Kind) -> String {
    match kind {
        Kind::Flag => "bool".into(),
        Kind::Unsigned(_) => format!("u{}", kind.size()),
        Kind::Signed(_) => format!("i{}", kind.size()),
    }
}

fn helpers(plan: &Plan<'_>) -> Vec<String> {
    let mut out = Vec::new();
    for (crc, reach) in plan.crcs() {
        out.extend(self::crc(&crc, reach));
        out.push(String::new());
    }
    if plan.has_parity() {
        out.extend(lines(PARITY));
    }
    let word = format!("u{}", plan.word_size());
    if plan.is_bits() {
        out.extend(lines(&READ_BITS.replace("WORD", &word)));
    }
    if plan.has_gray() {
        out.extend(lines(&GRAY.replace("WORD", &word)));
    }
    out
}

const PARITY: &str = "\
/// Whether the number of ones in `count` bits from bit `first` on is odd.
fn odd_ones(bytes: &[u8], first: usize, count: usize) -> bool {
    let ones = (first..first + count).filter(|bit| (bytes[bit / 8] >> (7 - bit % 8)) & 1 == 1);
    ones.count() % 2 == 1
}
";

const READ_BITS: &str = "\
/// The number in `count` bits from bit `first` on, the most significant one first.
fn read_bits(bytes: &[u8], first: usize, count: usize) -> WORD {
    (first..first + count).fold(0, |value, bit| {
        (value << 1) | WORD::from((bytes[bit / 8] >> (7 - bit % 8)) & 1)
    })
}
";

const GRAY: &str = "\
/// The number that a Gray code stands for.
fn from_gray(mut code: WORD) -> WORD {
    let mut step = 1;
    while step < WORD::BITS {
        code ^= code >> step;
        step *= 2;
    }
    code
}
";

fn reply_function(plan: &Plan<'_>, reply: &Reply<'_>) -> Vec<String> {
    let (name, text) = match plan.replies.len() {
        1 => (
            format!("pub fn decode_{}", plan.name),
            "Decodes one frame.".into(),
        ),
        _ => (
            format!("fn reply{}", reply.key),
            format!("{} It is {}.", reply.doc, plan.frame(reply)),
        ),
    };
    let mut out = doc(&text);
    out.push(format!(
        "{name}(bytes: &[u8]) -> Result<{}, {}> {{",
        frame(plan),
        error(plan)
    ));
    let body = match &plan.choice {
        Choice::Digits { most, behind } => digits(plan, *most, behind),
        _ => fields(plan, reply),
    };
    out.extend(indented(4, body));
    out.extend(lines("}\n"));
    out
}

fn refuse(plan: &Plan<'_>, condition: &str, why: Problem) -> Vec<String> {
    lines(&format!(
        "if {condition} {{\n    return Err({}::{});\n}}",
        error(plan),
        pascal(why.name())
    ))
}

fn fields(plan: &Plan<'_>, reply: &Reply<'_>) -> Vec<String> {
    let len = reply.layout.len.div_ceil(8);
    let short = format!("{}::Length", error(plan));
    let mut out = match plan.is_bits() {
        true => lines(&format!(
            "let Some(bytes) = bytes.first_chunk::<{len}>() else {{\n    return Err({short});\n}};"
        )),
        false => lines(&format!(
            "let Ok(bytes) = <&[u8; {len}]>::try_from(bytes) else {{\n    return Err({short});\n}};"
        )),
    };
    for check in &reply.checks {
        out.extend(broken(plan, reply, check));
    }
    if let Some(word) = reply.gray() {
        out.push(format!("let word = from_gray({});", read(word)));
    }
    out.push(format!("Ok({} {{", frame(plan)));
    for quantity in &plan.quantities {
        let name = quantity.name;
        let text = match (reply.value(quantity), quantity.optional) {
            (None, _) => "None".into(),
            (Some(value), true) => {
                let value = taken(plan, reply, value);
                // "name: Some(value)," inside a struct.
                if name.len() + value.len() + 9 > ROOM - 4 {
                    out.push(format!("    {name}: Some("));
                    out.extend(indented(8, folded(ROOM - 8, format!("{value},"))));
                    out.push("    ),".into());
                    continue;
                }
                format!("Some({value})")
            }
            (Some(value), false) => taken(plan, reply, value),
        };
        out.extend(indented(4, folded(ROOM - 4, format!("{name}: {text},"))));
    }
    out.push("})".into());
    out
}

/// Refuses a frame in which a check does not hold.
fn broken(plan: &Plan<'_>, reply: &Reply<'_>, check: &Check<'_>) -> Vec<String> {
    let mut out = Vec::new();
    let condition = match check {
        Check::Crc(field, crc, over) => {
            let call = match (over, plan.reach(crc)) {
                (Covered::Frame, Reach::Bytes) => "&covered".into(),
                (Covered::Frame, Reach::Bits) => format!("&covered, 0, {}", reply.layout.len),
                (Covered::Run(span), Reach::Bytes) => {
                    let start = match span.start / 8 {
                        0 => String::new(),
                        start => start.to_string(),
                    };
                    format!("&bytes[{start}..{}]", span.end() / 8)
                }
                (Covered::Run(span), Reach::Bits) => {
                    format!("bytes, {}, {}", span.start, span.len)
                }
            };
            if *over == Covered::Frame {
                out.extend(lines(&format!(
                    "// The CRC covers the frame with its own bits as 0.\n\
                     let masks = [{}];\nlet mut covered = *bytes;\n\
                     for (byte, mask) in covered.iter_mut().zip(masks) {{\n    *byte &= mask;\n}}",
                    reply.masks(field).join(", ")
                )));
            }
            let kind = Kind::Unsigned(crc.width);
            let received = shaped(plan, kind, &number(plan, reply, field));
            out.extend(folded(ROOM, format!("let received = {received};")));
            format!("received != {}({call})", function(crc))
        }
        Check::Parity(field, span, zero) => {
            let than = if *zero == 0 { "!=" } else { "==" };
            let own = flag(plan, reply, field, "!=");
            format!(
                "({own}) {than} odd_ones(bytes, {}, {})",
                span.start, span.len
            )
        }
        Check::Fixed {
            field, mask, value, ..
        } => match value {
            0 if check.is_partial() || !plan.is_bits() => any(reply, field, *mask, "!="),
            _ => format!(
                "{} != {}",
                number(plan, reply, field),
                hex(*value, field.width)
            ),
        },
    };
    out.extend(refuse(plan, &condition, check.problem()));
    out
}

/// A line of decimal digits.
fn digits(plan: &Plan<'_>, most: usize, behind: &[u8]) -> Vec<String> {
    let error = error(plan);
    let end: Vec<String> = behind.iter().map(|byte| hex((*byte).into(), 8)).collect();
    let mut out = lines(&format!(
        "let Some((digits, end)) = bytes.split_last_chunk::<{}>() else {{\n    \
         return Err({error}::Length);\n}};",
        behind.len()
    ));
    let condition = format!("digits.is_empty() || digits.len() > {most}");
    out.extend(refuse(plan, &condition, Problem::Length));
    out.extend(lines(&format!(
        "let mut value = 0u32;\nfor digit in digits {{\n    if !digit.is_ascii_digit() {{\n        \
         return Err({error}::Digits);\n    }}\n    \
         value = value * 10 + u32::from(digit - b'0');\n}}"
    )));
    let condition = format!("*end != [{}]", end.join(", "));
    out.extend(refuse(plan, &condition, Problem::Fixed));
    let largest = bits::mask(plan.angle_bits as usize);
    out.extend(refuse(plan, &format!("value > {largest}"), Problem::Range));
    out.push(format!("Ok({} {{", frame(plan)));
    for quantity in &plan.quantities {
        out.push(format!(
            "    {}: value as {},",
            quantity.name,
            integer(quantity.kind)
        ));
    }
    out.push("})".into());
    out
}

/// The function that knows a reply by its first byte.
fn choice(plan: &Plan<'_>) -> Vec<String> {
    let error = error(plan);
    let (selector, other) = match &plan.choice {
        Choice::Operation(piece) => (term(piece, 8), None),
        Choice::Byte { other } => ("bytes[0]".into(), Some(*other)),
        Choice::One | Choice::Digits { .. } => return Vec::new(),
    };
    let mut out = doc("Decodes one reply.");
    out.push(format!(
        "pub fn decode_{}(bytes: &[u8]) -> Result<{}, {error}> {{",
        plan.name,
        frame(plan)
    ));
    let mut body = refuse(plan, "bytes.is_empty()", Problem::Length);
    body.push(format!("match {selector} {{"));
    for (index, reply) in plan.replies.iter().enumerate() {
        if Some(index) == other {
            continue;
        }
        let leads: Vec<String> = reply
            .leads
            .iter()
            .map(|lead| match plan.choice {
                Choice::Operation(_) => lead.to_string(),
                _ => hex((*lead).into(), 8),
            })
            .collect();
        body.push(format!(
            "    {} => reply{}(bytes),",
            leads.join(" | "),
            reply.key
        ));
    }
    match other.and_then(|other| plan.replies.get(other)) {
        Some(reply) => body.push(format!("    _ => reply{}(bytes),", reply.key)),
        None => body.push(format!("    _ => Err({error}::Request),")),
    }
    body.push("}".into());
    out.extend(indented(4, body));
    out.extend(lines("}\n"));
    out
}
