//! Python 3.

mod crc;
mod numbers;

pub(super) use crc::crc;

use super::{
    plan::{Check, Choice, Kind, Plan, Problem, Reach, Reply},
    plan::{function, hex},
    text::{bare, folded, indented, joined, lines, pascal, sentence, upper, wrapped},
};
use crate::{bits, layout::Covered};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};
use numbers::{any, number, read, taken, term};

/// The longest line of a sum of bits.
const ROOM: usize = 76;

/// The whole file.
pub(super) fn source(plan: &Plan<'_>) -> String {
    let mut out = head(plan);
    out.extend(declarations(plan));
    out.extend(helpers(plan));
    for reply in &plan.replies {
        out.extend(reply_function(plan, reply));
    }
    if plan.replies.len() > 1 {
        out.extend(choice(plan));
    }
    while out.last().is_some_and(String::is_empty) {
        out.pop();
    }
    joined(&out)
}

fn head(plan: &Plan<'_>) -> Vec<String> {
    let mut out = Vec::from([format!(
        "\"\"\"Decodes {} frames of an absolute encoder.",
        plan.title
    )]);
    for text in [
        format!("Profile: {}", plan.profile),
        format!("Input: {} {}", plan.input(), plan.unit()),
        "Made by Encoderscope. Python 3; no dependencies.".into(),
    ] {
        out.push(String::new());
        out.extend(wrapped("", &text));
    }
    out.extend(lines("\"\"\"\n\nfrom dataclasses import dataclass"));
    if !plan.tables.is_empty() {
        out.push("from enum import IntFlag".into());
    }
    if plan.quantities.iter().any(|quantity| quantity.optional) {
        out.push("from typing import Optional".into());
    }
    out.extend(lines("\n"));
    out
}

fn comment(text: &str) -> Vec<String> {
    wrapped("# ", text)
}

/// A doc comment, on one line where it has room.
fn doc(text: &str) -> Vec<String> {
    let mut all = wrapped("", text);
    if let Some(first) = all.first_mut() {
        first.insert_str(0, "\"\"\"");
    }
    match all.len() {
        1 => all.iter_mut().for_each(|line| line.push_str("\"\"\"")),
        _ => all.push("\"\"\"".into()),
    }
    all
}

fn frame(plan: &Plan<'_>) -> String {
    format!("{}Frame", pascal(&plan.name))
}

fn error(plan: &Plan<'_>) -> String {
    format!("{}Error", pascal(&plan.name))
}

/// The class of the bits of a field, where they have names.
fn table(plan: &Plan<'_>, field: &str) -> Option<String> {
    let mut tables = plan.tables.iter();
    let has = tables.any(|(name, _)| *name == field);
    has.then(|| format!("{}{}", pascal(&plan.name), pascal(field)))
}

fn declarations(plan: &Plan<'_>) -> Vec<String> {
    let mut out = Vec::new();
    for (field, bits) in &plan.tables {
        let name = table(plan, field).unwrap_or_default();
        out.push(format!("class {name}(IntFlag):"));
        out.extend(indented(4, doc(&format!("The bits of {field}."))));
        for bit in bits {
            out.push(String::new());
            out.extend(indented(4, comment(&sentence(bit.doc))));
            let mask = hex(bits::placed(1, bit.place), 8);
            out.push(format!("    {} = {mask}", upper(bit.name)));
        }
        out.extend(lines("\n"));
    }
    out.push(format!("class {}(ValueError):", error(plan)));
    out.extend(indented(4, doc("Why a frame is refused.")));
    out.extend(lines("\n\n@dataclass(frozen=True)"));
    out.push(format!("class {}:", frame(plan)));
    out.extend(indented(
        4,
        doc(match plan.replies.len() {
            1 => "What a frame says.",
            _ => "What a reply says; None where it has no such field.",
        }),
    ));
    for quantity in &plan.quantities {
        out.push(String::new());
        out.extend(indented(4, comment(&quantity.doc)));
        let kind = match (quantity.kind, table(plan, quantity.name)) {
            (_, Some(table)) => table,
            (Kind::Flag, None) => "bool".into(),
            (_, None) => "int".into(),
        };
        let kind = match quantity.optional {
            true => format!("Optional[{kind}]"),
            false => kind,
        };
        out.push(format!("    {}: {kind}", quantity.name));
    }
    let angle = plan
        .quantities
        .iter()
        .find(|quantity| quantity.name == "angle");
    if let Some(angle) = angle {
        let turn = bits::codes(plan.angle_bits);
        let (kind, guard) = match angle.optional {
            true => (
                "Optional[float]",
                "\n        if self.angle is None:\n            return None",
            ),
            false => ("float", ""),
        };
        out.extend(lines(&format!(
            "\n    @property\n    def degrees(self) -> {kind}:\n        \
             \"\"\"The angle in degrees, from 0 up to 360.\"\"\"{guard}\n        \
             return self.angle * 360.0 / {turn}"
        )));
    }
    out.extend(lines("\n"));
    out
}

fn helpers(plan: &Plan<'_>) -> Vec<String> {
    let mut out = Vec::new();
    for (crc, reach) in plan.crcs() {
        out.extend(self::crc(&crc, reach));
        out.extend(lines("\n"));
    }
    let bitwise = plan.crcs().iter().any(|(_, reach)| *reach == Reach::Bits);
    if plan.is_bits() || plan.has_parity() || bitwise {
        out.extend(lines(READ_BITS));
    }
    if plan.has_gray() {
        out.extend(lines(GRAY));
    }
    out
}

const READ_BITS: &str = "\
def read_bits(data: bytes, first: int, count: int) -> int:
    \"\"\"The number in `count` bits from bit `first` on, the most significant one first.\"\"\"
    below = len(data) * 8 - first - count
    return (int.from_bytes(data, \"big\") >> below) & ((1 << count) - 1)

";

const GRAY: &str = "\
def from_gray(code: int) -> int:
    \"\"\"The number that a Gray code stands for.\"\"\"
    value = 0
    while code:
        value ^= code
        code >>= 1
    return value

";

fn reply_function(plan: &Plan<'_>, reply: &Reply<'_>) -> Vec<String> {
    let (name, text) = match plan.replies.len() {
        1 => (
            format!("decode_{}", plan.name),
            "Decodes one frame.".to_string(),
        ),
        _ => (
            format!("_reply{}", reply.key),
            format!("{} It is {}.", reply.doc, plan.frame(reply)),
        ),
    };
    let mut out = Vec::from([format!("def {name}(data: bytes) -> {}:", frame(plan))]);
    let mut body = doc(&text);
    body.extend(match &plan.choice {
        Choice::Digits { most, behind } => digits(plan, *most, behind),
        _ => fields(plan, reply),
    });
    out.extend(indented(4, body));
    out.extend(lines("\n"));
    out
}

fn refuse(plan: &Plan<'_>, condition: &str, why: Problem) -> Vec<String> {
    lines(&format!(
        "if {condition}:\n    raise {}(\"{}\")",
        error(plan),
        why.doc()
    ))
}

fn fields(plan: &Plan<'_>, reply: &Reply<'_>) -> Vec<String> {
    let len = reply.layout.len.div_ceil(8);
    let than = if plan.is_bits() { "<" } else { "!=" };
    let mut out = refuse(plan, &format!("len(data) {than} {len}"), Problem::Length);
    for check in &reply.checks {
        out.extend(broken(plan, reply, check));
    }
    if let Some(word) = reply.gray() {
        out.push(format!("word = from_gray({})", read(word)));
    }
    out.push(format!("return {}(", frame(plan)));
    for quantity in &plan.quantities {
        let text = match reply.value(quantity) {
            None => "None".into(),
            Some(value) => match table(plan, quantity.name) {
                Some(table) => format!("{table}({})", bare(&taken(plan, reply, value))),
                None => bare(&taken(plan, reply, value)).into(),
            },
        };
        let name = quantity.name;
        match folded(ROOM, text).as_slice() {
            [one] => out.push(format!("    {name}={one},")),
            more => {
                out.push(format!("    {name}=("));
                let terms = more.iter().map(|line| line.trim_start().to_string());
                out.extend(indented(8, terms));
                out.push("    ),".into());
            }
        }
    }
    out.push(")".into());
    out
}

/// Refuses a frame in which a check does not hold.
fn broken(plan: &Plan<'_>, reply: &Reply<'_>, check: &Check<'_>) -> Vec<String> {
    let mut out = Vec::new();
    let condition = match check {
        Check::Crc(field, crc, over) => {
            let call = match (over, plan.reach(crc)) {
                (Covered::Frame, Reach::Bytes) => "covered".into(),
                (Covered::Frame, Reach::Bits) => format!("covered, 0, {}", reply.layout.len),
                (Covered::Run(span), Reach::Bytes) => {
                    format!("data[{}:{}]", span.start / 8, span.end() / 8)
                }
                (Covered::Run(span), Reach::Bits) => {
                    format!("data, {}, {}", span.start, span.len)
                }
            };
            if *over == Covered::Frame {
                out.extend(lines(&format!(
                    "# The CRC covers the frame with its own bits as 0.\nmasks = ({})\n\
                     covered = bytes(byte & mask for byte, mask in zip(data, masks))",
                    reply.masks(field).join(", ")
                )));
            }
            let received = number(plan, reply, field);
            out.push(format!("received = {}", bare(&received)));
            format!("received != {}({call})", function(crc))
        }
        Check::Parity(field, span, zero) => {
            let wanted = if *zero == 0 { "!=" } else { "==" };
            let ones = format!("bin({}).count(\"1\") % 2", read(*span));
            format!("{} {wanted} {ones}", number(plan, reply, field))
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
    let end = behind.len();
    let condition = format!("not {} <= len(data) <= {}", end + 1, end + most);
    let mut out = refuse(plan, &condition, Problem::Length);
    out.push(format!("digits = data[:-{end}]"));
    out.extend(refuse(
        plan,
        "any(not 0x30 <= digit <= 0x39 for digit in digits)",
        Problem::Digits,
    ));
    let bytes: Vec<String> = behind.iter().map(|byte| hex((*byte).into(), 8)).collect();
    let condition = format!("data[-{end}:] != bytes(({}))", bytes.join(", "));
    out.extend(refuse(plan, &condition, Problem::Fixed));
    out.push("value = int(digits)".into());
    let largest = bits::mask(plan.angle_bits as usize);
    out.extend(refuse(plan, &format!("value > {largest}"), Problem::Range));
    let all: Vec<String> = plan
        .quantities
        .iter()
        .map(|quantity| format!("{}=value", quantity.name))
        .collect();
    out.push(format!("return {}({})", frame(plan), all.join(", ")));
    out
}

/// The function that knows a reply by its first byte.
fn choice(plan: &Plan<'_>) -> Vec<String> {
    let (selector, other) = match &plan.choice {
        Choice::Operation(piece) => (bare(&term(piece)).to_string(), None),
        Choice::Byte { other } => ("data[0]".into(), Some(*other)),
        Choice::One | Choice::Digits { .. } => return Vec::new(),
    };
    let mut out = Vec::from([format!(
        "def decode_{}(data: bytes) -> {}:",
        plan.name,
        frame(plan)
    )]);
    let mut body = doc("Decodes one reply.");
    body.extend(refuse(plan, "not data", Problem::Length));
    body.push(format!("lead = {selector}"));
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
        let condition = match leads.as_slice() {
            [one] => format!("lead == {one}"),
            more => format!("lead in ({})", more.join(", ")),
        };
        body.push(format!("if {condition}:"));
        body.push(format!("    return _reply{}(data)", reply.key));
    }
    match other.and_then(|other| plan.replies.get(other)) {
        Some(reply) => body.push(format!("return _reply{}(data)", reply.key)),
        None => body.push(format!(
            "raise {}(\"{}\")",
            error(plan),
            Problem::Request.doc()
        )),
    }
    out.extend(indented(4, body));
    out
}
