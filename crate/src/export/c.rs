//! C99.

mod crc;
mod numbers;

pub(super) use crc::crc;

use super::{
    plan::{Check, Choice, Kind, Plan, Problem, Reach, Reply},
    plan::{function, hex},
    text::{bare, folded, indented, joined, lines, sentence, upper, wrapped},
};
use crate::{
    bits,
    layout::{Covered, Field},
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};
use numbers::{any, number, offset, read, shaped, taken, term};

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
    out.extend(degrees(plan));
    joined(&out)
}

fn head(plan: &Plan<'_>) -> Vec<String> {
    let mut out = lines("/*");
    let paragraphs = [
        format!("Decodes {} frames of an absolute encoder.", plan.title),
        format!("Profile: {}", plan.profile),
        format!("Input: {} {}", plan.input(), plan.unit()),
        "Made by Encoderscope. C99; no allocation, no dependencies.".into(),
    ];
    for (index, text) in paragraphs.iter().enumerate() {
        if index > 0 {
            out.push(" *".into());
        }
        out.extend(wrapped(" * ", text));
    }
    out.extend(lines(
        " */\n#include <stdbool.h>\n#include <stddef.h>\n#include <stdint.h>\n",
    ));
    out
}

/// A comment, on one line where it has room.
fn comment(text: &str) -> Vec<String> {
    let mut all = wrapped("/* ", text);
    for line in all.iter_mut().skip(1) {
        line.replace_range(..2, "  ");
    }
    if let Some(last) = all.last_mut() {
        last.push_str(" */");
    }
    all
}

fn declarations(plan: &Plan<'_>) -> Vec<String> {
    let (name, big) = (&plan.name, upper(&plan.name));
    let mut out = comment("What became of a frame.");
    out.push(format!("enum {name}_result {{"));
    out.push(format!("    {big}_OK = 0,"));
    for problem in plan.problems() {
        out.extend(indented(4, comment(&sentence(problem.doc()))));
        out.push(format!("    {},", self::problem(plan, problem)));
    }
    out.extend(lines("};\n"));
    for (field, table) in &plan.tables {
        out.extend(comment(&format!("The bits of {field}.")));
        out.push("enum {".into());
        for bit in table {
            out.extend(indented(4, comment(&sentence(bit.doc))));
            let mask = hex(bits::placed(1, bit.place), 8);
            out.push(format!(
                "    {big}_{}_{} = {mask},",
                upper(field),
                upper(bit.name)
            ));
        }
        out.extend(lines("};\n"));
    }
    out.extend(comment(match plan.replies.len() {
        1 => "What a frame says.",
        _ => "What a reply says; where it has no such field, has_... is false.",
    }));
    out.push(format!("struct {name}_frame {{"));
    for quantity in &plan.quantities {
        out.extend(indented(4, comment(&quantity.doc)));
        if quantity.optional {
            out.push(format!("    bool has_{};", quantity.name));
        }
        out.push(format!("    {} {};", integer(quantity.kind), quantity.name));
    }
    out.extend(lines("};\n"));
    out
}

fn problem(plan: &Plan<'_>, problem: Problem) -> String {
    format!("{}_BAD_{}", upper(&plan.name), upper(problem.name()))
}

fn integer(kind: Kind) -> String {
    match kind {
        Kind::Flag => "bool".into(),
        Kind::Unsigned(_) => format!("uint{}_t", kind.size()),
        Kind::Signed(_) => format!("int{}_t", kind.size()),
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
    let size = plan.word_size();
    if plan.is_bits() {
        out.extend(lines(&READ_BITS.replace("WORD", &format!("uint{size}_t"))));
    }
    if plan.has_gray() {
        let steps = if size == 64 { "32" } else { "16" };
        let gray = GRAY.replace("WORD", &format!("uint{size}_t"));
        out.extend(lines(&gray.replace("HALF", steps)));
    }
    out
}

const PARITY: &str = "\
/* Whether the number of ones in `count` bits from bit `first` on is odd. */
static unsigned odd_ones(const uint8_t *bytes, unsigned first, unsigned count)
{
    unsigned odd = 0;
    for (unsigned bit = first; bit < first + count; bit++)
        odd ^= (bytes[bit / 8] >> (7 - bit % 8)) & 1u;
    return odd;
}
";

const READ_BITS: &str = "\
/* The number in `count` bits from bit `first` on, the most significant one first. */
static WORD read_bits(const uint8_t *bytes, unsigned first, unsigned count)
{
    WORD value = 0;
    for (unsigned bit = first; bit < first + count; bit++)
        value = (value << 1) | ((bytes[bit / 8] >> (7 - bit % 8)) & 1u);
    return value;
}
";

const GRAY: &str = "\
/* The number that a Gray code stands for. */
static WORD from_gray(WORD code)
{
    for (unsigned step = 1; step <= HALF; step *= 2)
        code ^= code >> step;
    return code;
}
";

fn signature(plan: &Plan<'_>, name: &str, is_static: Scope) -> Vec<String> {
    let scope = match is_static {
        Scope::Own => "static ",
        Scope::Public => "",
    };
    let line = format!(
        "{scope}enum {0}_result {name}(const uint8_t *bytes, size_t len, struct {0}_frame *out)",
        plan.name
    );
    if line.len() <= 90 {
        return Vec::from([line]);
    }
    let (first, second) = line.split_once("struct").unwrap_or((&line, ""));
    Vec::from([first.trim_end().into(), format!("    struct{second}")])
}

#[derive(Clone, Copy)]
enum Scope {
    Own,
    Public,
}

fn reply_function(plan: &Plan<'_>, reply: &Reply<'_>) -> Vec<String> {
    let (name, scope, doc) = match plan.replies.len() {
        1 => (
            format!("decode_{}", plan.name),
            Scope::Public,
            "Decodes one frame. Writes to `out` only when all is well.".into(),
        ),
        _ => (
            format!("reply{}", reply.key),
            Scope::Own,
            format!("{} It is {}.", reply.doc, plan.frame(reply)),
        ),
    };
    let mut out = comment(&doc);
    out.extend(signature(plan, &name, scope));
    out.push("{".into());
    let mut body = match &plan.choice {
        Choice::Digits { most, behind } => digits(plan, *most, behind),
        _ => fields(plan, reply),
    };
    body.push(format!("return {}_OK;", upper(&plan.name)));
    out.extend(indented(4, body));
    out.extend(lines("}\n"));
    out
}

fn refuse(plan: &Plan<'_>, condition: &str, why: Problem) -> [String; 2] {
    [
        format!("if ({condition})"),
        format!("    return {};", problem(plan, why)),
    ]
}

fn fields(plan: &Plan<'_>, reply: &Reply<'_>) -> Vec<String> {
    let bytes = reply.layout.len.div_ceil(8);
    let short = if plan.is_bits() { "<" } else { "!=" };
    let mut out = Vec::from(refuse(
        plan,
        &format!("len {short} {bytes}"),
        Problem::Length,
    ));
    for check in &reply.checks {
        out.extend(broken(plan, reply, check));
    }
    if plan.replies.len() > 1 {
        out.push(format!("*out = (struct {}_frame){{0}};", plan.name));
    }
    if let Some(word) = reply.gray() {
        let size = plan.word_size();
        out.push(format!(
            "const uint{size}_t word = from_gray({});",
            read(word)
        ));
    }
    for quantity in &plan.quantities {
        let name = quantity.name;
        let Some(value) = reply.value(quantity) else {
            continue;
        };
        if quantity.optional {
            out.push(format!("out->has_{name} = true;"));
        }
        let value = taken(plan, reply, value);
        out.extend(folded(ROOM, format!("out->{name} = {value};")));
    }
    out
}

/// The frame with the bits of its CRC as 0.
fn covered(reply: &Reply<'_>, field: &Field) -> Vec<String> {
    let masks = reply.masks(field);
    lines(&format!(
        "/* The CRC covers the frame with its own bits as 0. */\n\
         static const uint8_t MASKS[] = {{{}}};\nuint8_t covered[sizeof MASKS];\n\
         for (size_t i = 0; i < sizeof MASKS; i++)\n    covered[i] = bytes[i] & MASKS[i];",
        masks.join(", ")
    ))
}

/// Refuses a frame in which a check does not hold.
fn broken(plan: &Plan<'_>, reply: &Reply<'_>, check: &Check<'_>) -> Vec<String> {
    let mut out = Vec::new();
    let condition = match check {
        Check::Crc(field, crc, over) => {
            let call = match (over, plan.reach(crc)) {
                (Covered::Frame, Reach::Bytes) => "covered, sizeof covered".into(),
                (Covered::Frame, Reach::Bits) => format!("covered, 0, {}", reply.layout.len),
                (Covered::Run(span), Reach::Bytes) => {
                    format!("{}, {}", offset("bytes", span.start / 8), span.len / 8)
                }
                (Covered::Run(span), Reach::Bits) => {
                    format!("bytes, {}, {}", span.start, span.len)
                }
            };
            if *over == Covered::Frame {
                out.extend(covered(reply, field));
            }
            let kind = Kind::Unsigned(crc.width);
            let received = shaped(kind, &number(plan, reply, field));
            out.extend(folded(
                ROOM,
                format!("const {} received = {received};", integer(kind)),
            ));
            format!("received != {}({call})", function(crc))
        }
        Check::Parity(field, span, zero) => {
            let equal = if *zero == 0 { "!=" } else { "==" };
            format!(
                "{} {equal} odd_ones(bytes, {}, {})",
                number(plan, reply, field).text,
                span.start,
                span.len
            )
        }
        Check::Fixed {
            field, mask, value, ..
        } => match value {
            0 if check.is_partial() || !plan.is_bits() => any(reply, field, *mask, "!="),
            _ => {
                format!(
                    "{} != {}",
                    number(plan, reply, field).text,
                    hex(*value, field.width)
                )
            }
        },
    };
    out.extend(refuse(plan, &condition, check.problem()));
    out
}

/// A line of decimal digits.
fn digits(plan: &Plan<'_>, most: usize, behind: &[u8]) -> Vec<String> {
    let end = behind.len();
    let mut out = Vec::from(refuse(
        plan,
        &format!("len < {} || len > {}", end + 1, end + most),
        Problem::Length,
    ));
    out.extend(lines(&format!(
        "const size_t digits = len - {end};\nuint32_t value = 0;\n\
         for (size_t i = 0; i < digits; i++) {{\n    if (bytes[i] < '0' || bytes[i] > '9')\n        \
         return {};\n    value = value * 10 + (uint32_t)(bytes[i] - '0');\n}}",
        problem(plan, Problem::Digits)
    )));
    for (index, byte) in behind.iter().enumerate() {
        let at = if index == 0 {
            "digits".into()
        } else {
            format!("digits + {index}")
        };
        let condition = format!("bytes[{at}] != {}", hex((*byte).into(), 8));
        out.extend(refuse(plan, &condition, Problem::Fixed));
    }
    let largest = bits::mask(plan.angle_bits as usize);
    out.extend(refuse(plan, &format!("value > {largest}"), Problem::Range));
    for quantity in &plan.quantities {
        out.push(format!(
            "out->{} = ({})value;",
            quantity.name,
            integer(quantity.kind)
        ));
    }
    out
}

/// The function that knows a reply by its first byte.
fn choice(plan: &Plan<'_>) -> Vec<String> {
    let mut out = comment("Decodes one reply. Writes to `out` only when all is well.");
    out.extend(signature(
        plan,
        &format!("decode_{}", plan.name),
        Scope::Public,
    ));
    out.push("{".into());
    let mut body = Vec::from(refuse(plan, "len == 0", Problem::Length));
    let (selector, other) = match &plan.choice {
        Choice::Operation(piece) => (term(piece, 8), None),
        Choice::Byte { other } => ("bytes[0]".into(), Some(*other)),
        Choice::One | Choice::Digits { .. } => return Vec::new(),
    };
    body.push(format!("switch ({}) {{", bare(&selector)));
    for (index, reply) in plan.replies.iter().enumerate() {
        if Some(index) == other {
            continue;
        }
        for lead in &reply.leads {
            let lead = match plan.choice {
                Choice::Operation(_) => lead.to_string(),
                _ => hex((*lead).into(), 8),
            };
            body.push(format!("case {lead}:"));
        }
        body.push(format!("    return reply{}(bytes, len, out);", reply.key));
    }
    body.push("default:".into());
    match other.and_then(|other| plan.replies.get(other)) {
        Some(reply) => body.push(format!("    return reply{}(bytes, len, out);", reply.key)),
        None => body.push(format!("    return {};", problem(plan, Problem::Request))),
    }
    body.push("}".into());
    out.extend(indented(4, body));
    out.extend(lines("}\n"));
    out
}

fn degrees(plan: &Plan<'_>) -> Vec<String> {
    let angle = plan
        .quantities
        .iter()
        .find(|quantity| quantity.name == "angle");
    let Some(angle) = angle else {
        return Vec::new();
    };
    let mut out = comment("The angle in degrees, from 0 up to 360.");
    out.extend(lines(&format!(
        "double {}_degrees({} angle)\n{{\n    return (double)angle * 360.0 / {}.0;\n}}",
        plan.name,
        integer(angle.kind),
        bits::codes(plan.angle_bits)
    )));
    out
}
