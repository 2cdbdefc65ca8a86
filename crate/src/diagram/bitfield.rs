//! Layouts as bit fields of WaveDrom, and own layouts from them
//! (<https://github.com/wavedrom/bitfield>).
//!
//! A bit field is a list of `{name, bits, attr, type}`, the least significant field first, so that
//! the frame's last bits come first. `attr` holds the field as it is written in a layout of
//! [`crate::format::own`], so that an own layout comes back as it was; a bit field from elsewhere
//! is read by its names.
//!
//! ```
//! use encoderscope::{diagram::bitfield, format::own::Framing};
//! let text = "{reg: [{name: 'CRC', bits: 8}, {name: 'position', bits: 14}, {bits: 2}]}";
//! let written = bitfield::read(text, "Mine", Framing::Line)?;
//! assert_eq!(written.to_string(), "Mine;line;skip:2,angle:14:name=position,skip:8:name=CRC");
//! # Ok::<(), encoderscope::diagram::Unreadable>(())
//! ```

use super::{Unreadable, relaxed};
use crate::{
    bits::{self, Span},
    check::Checksum,
    format::own::{self, CrcRule, Draft, Framing, Kind, MOST_FIELDS, Written},
    language::t,
    layout::{Class, Coding, Covered, Field, Part, Resolved, Role},
    profile::Choice,
    record::{Record, Value},
    text,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// What stands for the bits that frame the data of BiSS-C, which an own layout does not name.
const PREAMBLE: &str = "BiSS-C";

/// A layout as a bit field: the parts of its fields as they are sent, the last one first.
///
/// A field in several parts has the bits of its number behind its name, `angle[7:0]`.
#[must_use]
pub fn written(layout: &Resolved) -> Value {
    let mut parts: Vec<(&Field, &Part)> = layout
        .fields()
        .flat_map(|field| layout.parts(field).iter().map(move |part| (field, part)))
        .collect();
    parts.sort_by_key(|(_, part)| core::cmp::Reverse(part.span.start));
    let entries = parts.into_iter().map(|(field, part)| {
        let name = field.row.name;
        let (top, low) = (part.place + part.span.len as u32, part.place);
        let name = match part.span.len as u32 == field.width {
            true => name.to_string(),
            false => format!("{name}[{}:{low}]", top.saturating_sub(1)),
        };
        let entry = Record::new().with("name", name).with("bits", part.span.len);
        let attr = match frames(layout, field) {
            true => PREAMBLE.to_string(),
            false => draft(layout, field, part).to_string(),
        };
        entry
            .with("attr", attr)
            .with("type", hue(field.row.role.class()))
    });
    Value::List(entries.map(Value::Record).collect())
}

/// The number of a colour of WaveDrom that is near to that of a class.
const fn hue(class: Class) -> u32 {
    match class {
        Class::Turns => 8,
        Class::Angle => 4,
        Class::Flags => 5,
        Class::Status => 7,
        Class::Check => 2,
        Class::Framing => 1,
    }
}

/// Whether a field stands around the data of BiSS-C.
fn frames(layout: &Resolved, field: &Field) -> bool {
    layout.shape.preamble
        && matches!(field.row.name, "idle" | "ack" | "start" | "cds" | "tail")
        && field.row.role == Role::Framing
        && !is_written(layout, field)
}

/// Whether the user's own layout names the field.
fn is_written(layout: &Resolved, field: &Field) -> bool {
    let own = layout.shape.profile.own;
    own.is_some_and(|own| {
        let mut fields = own.written().fields.iter();
        fields.any(|draft| draft.name.as_deref() == Some(field.row.name))
    })
}

/// A part of a field as an own layout would write it.
fn draft(layout: &Resolved, field: &Field, part: &Part) -> Draft {
    let row = field.row;
    let kind = kind(field);
    let little_endian = is_little_endian(layout, field);
    // The bytes of one number are all written as the whole of it.
    let (place, len) = match little_endian {
        true => (0, field.width),
        false => (part.place, part.span.len as u32),
    };
    let mut draft = Draft::new(kind, len);
    if row.name != kind.name() {
        draft.name = Some(plain(row.name));
    }
    draft.active = row.active;
    draft.gray = matches!(layout.coding(field), Some((Coding::Gray, _)));
    draft.little_endian = little_endian;
    if kind == Kind::Const {
        let value = row.constant.unwrap_or(0);
        draft.value = bits::slice(value, place, len as usize);
    }
    if kind == Kind::Status && !row.bits.is_empty() {
        let name = |place| {
            let named = row.bits.iter().find(|bit| bit.place == place);
            named.map_or(String::new(), |bit| plain(bit.name))
        };
        draft.bits = (0..field.width).rev().map(name).collect();
    }
    if let Some((sum, Covered::Run(span))) = field.cover {
        if let Some(algorithm) = sum.algorithm() {
            draft.crc = CrcRule {
                polynomial: algorithm.polynomial,
                init: algorithm.init,
                reflected: algorithm.refin,
                xorout: algorithm.xorout,
            };
        }
        (draft.from, draft.to) = cover(layout, field, span);
    }
    draft
}

/// The names of the first and last field that the check `own` covers, where they are not those
/// that an own layout takes by itself: the first of all, and the one in front of the check.
fn cover(layout: &Resolved, own: &Field, covered: Span) -> (Option<String>, Option<String>) {
    let name = |at: usize| layout.field_at(at).map(|field| plain(field.row.name));
    let begins = |field: &Field| {
        let parts = layout.parts(field).iter();
        parts.map(|part| part.span.start).min()
    };
    let data = layout.fields().filter(|field| !frames(layout, field));
    let first = data.filter_map(begins).min();
    let last = covered.end().saturating_sub(1);
    let from = (first != Some(covered.start)).then(|| name(covered.start));
    let to = (Some(covered.end()) != begins(own)).then(|| name(last));
    (from.flatten(), to.flatten())
}

/// The kind of an own layout's field that says the same, or nothing.
fn kind(field: &Field) -> Kind {
    let fits = |kind: Kind| {
        let (least, most) = kind.widths();
        (least..=most).contains(&field.width)
    };
    let checked = matches!(field.cover, Some((_, Covered::Run(_))));
    let kind = match field.row.role {
        Role::Turns => Kind::Turns,
        Role::Angle => Kind::Angle,
        Role::Error => Kind::Error,
        Role::Warning => Kind::Warning,
        Role::Valid => Kind::Valid,
        Role::ZeroDefault => Kind::ZeroDefault,
        Role::Status | Role::Alarm => Kind::Status,
        Role::Temperature => Kind::Temperature,
        Role::Speed => Kind::Speed,
        Role::Count => Kind::Count,
        Role::Padding => Kind::Zeros,
        Role::Framing if field.row.constant.is_some() => Kind::Const,
        Role::Crc if checked => Kind::Crc,
        Role::Parity => match field.cover {
            Some((Checksum::EvenParity, _)) => Kind::Even,
            _ => Kind::Odd,
        },
        _ => Kind::Skip,
    };
    if fits(kind) { kind } else { Kind::Skip }
}

/// Whether a field belongs to a number that is sent with its last byte first.
fn is_little_endian(layout: &Resolved, field: &Field) -> bool {
    let name = field.row.name;
    if let Some(own) = layout.shape.profile.own {
        return own.written().fields.iter().any(|draft| {
            let known = match &draft.name {
                Some(own) => own == name,
                None => name.starts_with(draft.kind.name()),
            };
            draft.little_endian && known && draft.kind.role() == field.row.role
        });
    }
    // A field that shares the last byte of such a number belongs to it.
    let byte = layout.parts(field).first().map(|part| part.span.start / 8);
    layout.fields().any(|other| {
        let parts = layout.parts(other);
        let ends = parts.first().zip(parts.last());
        let reversed = ends.is_some_and(|(first, last)| first.span.start > last.span.start);
        reversed && parts.iter().any(|part| Some(part.span.start / 8) == byte)
    })
}

/// A name without the letters that separate the parts of a layout's text.
fn plain(name: &str) -> String {
    let shown = |letter: char| match letter {
        ':' | ';' | ',' | '|' | '=' => ' ',
        letter if letter.is_control() => ' ',
        letter => letter,
    };
    let short: String = name.chars().take(own::LONGEST_NAME).map(shown).collect();
    short.trim().to_string()
}

/// The own layout that a bit field describes, called `title`, whose frames come as `framing` says.
///
/// Fields without an `attr` that this module has written are known by their names: the kinds of
/// an own layout, and position, revolution and multiturn. Others carry nothing that is read; a
/// checksum needs its polynomial, which a bit field does not tell.
///
/// # Errors
///
/// The text is no bit field, or has more fields than a layout can have; says which is wrong.
pub fn read(text: &str, title: &str, framing: Framing) -> Result<Written, Unreadable> {
    let whole = relaxed::read(text)?;
    let list = match &whole {
        Value::Record(record) => record.find("reg"),
        other => Some(other),
    };
    let Some(Value::List(entries)) = list else {
        return Err(Unreadable::whole(t(
            "a bit field is a list of fields, or {reg: […]}",
        )));
    };
    let mut sent = Vec::new();
    for (index, entry) in entries.iter().rev().enumerate() {
        let Value::Record(entry) = entry else {
            continue;
        };
        let field = field(entry).map_err(|why| {
            let number = entries.len() - index;
            Unreadable::whole(text!("field {}: {}", number, why))
        })?;
        sent.extend(field);
    }
    let fields = joined(&sent);
    if fields.is_empty() || fields.len() > MOST_FIELDS {
        let count = fields.len();
        return Err(Unreadable::whole(text!(
            "{} fields; a layout has 1…{}",
            count,
            MOST_FIELDS
        )));
    }
    let title = plain(title);
    Ok(Written {
        title: if title.is_empty() {
            "bit field".into()
        } else {
            title
        },
        framing,
        fields,
    })
}

/// A field as it is sent; none for what BiSS-C frames its data with.
fn field(entry: &Record) -> Result<Option<Sent>, String> {
    let width = match entry.find("bits") {
        Some(Value::Int(bits)) => u32::try_from(*bits).ok().filter(|bits| *bits > 0),
        _ => None,
    };
    let width = width.ok_or(t("bits must be a number of bits"))?;
    let attr = match entry.find("attr") {
        Some(Value::Text(text)) => text.as_str(),
        _ => "",
    };
    if attr == PREAMBLE {
        return Ok(None);
    }
    let name = match entry.find("name") {
        Some(Value::Text(name)) => name.as_str(),
        _ => "",
    };
    let range = range(name);
    if let Ok(draft) = attr.parse::<Draft>()
        && (draft.width == width || draft.little_endian && draft.width > width)
    {
        let draft = Draft { width, ..draft };
        return Ok(Some(Sent { draft, range }));
    }
    let name = plain(name.split('[').next().unwrap_or(name));
    let kind = of_name(&name, width);
    let (_, most) = kind.widths();
    if width > most {
        return Err(text!("{} bits are more than {}", width, most));
    }
    let mut draft = Draft::new(kind, width);
    if !name.is_empty() && name != kind.name() {
        draft.name = Some(name);
    }
    Ok(Some(Sent { draft, range }))
}

fn of_name(name: &str, width: u32) -> Kind {
    let lower = name.to_ascii_lowercase();
    let kind = match lower.as_str() {
        "position" | "pos" => Kind::Angle,
        "revolution" | "revolutions" | "multiturn" => Kind::Turns,
        other => Kind::of_word(other).unwrap_or(Kind::Skip),
    };
    let (least, most) = kind.widths();
    match kind {
        Kind::Crc => Kind::Skip,
        _ if (least..=most).contains(&width) => kind,
        _ => Kind::Skip,
    }
}

/// A field as it is sent, and which bits of its number it is where it is a part.
struct Sent {
    draft: Draft,
    range: Option<(u32, u32)>,
}

/// The bits of the number that WaveDrom puts behind a name: `[15:8]`.
fn range(name: &str) -> Option<(u32, u32)> {
    let (_, rest) = name.rsplit_once('[')?;
    let (high, low) = rest.strip_suffix(']')?.split_once(':')?;
    Some((high.parse().ok()?, low.parse().ok()?))
}

/// Puts the bytes of little-endian numbers, which come as they are sent, back into the order in
/// which they are written, and joins the parts that stand side by side then.
fn joined(sent: &[Sent]) -> Vec<Draft> {
    let mut fields: Vec<Draft> = Vec::new();
    let runs = sent.chunk_by(|one, other| one.draft.little_endian && other.draft.little_endian);
    for run in runs {
        let mut rest = run;
        while !rest.is_empty() {
            let (number, behind) = rest.split_at_checked(number(rest)).unwrap_or((rest, &[]));
            fields.extend(reversed(number));
            rest = behind;
        }
    }
    fields
}

/// How many of the parts at the beginning of a run are one number: it ends with a byte behind
/// which none of its fields goes on.
fn number(run: &[Sent]) -> usize {
    let mut filled = 0;
    for (index, part) in run.iter().enumerate() {
        filled += part.draft.width;
        let (mine, behind) = run.split_at_checked(index + 1).unwrap_or((run, &[]));
        let goes_on = |part: &Sent| {
            let next = part.range.and_then(|(high, _)| high.checked_add(1));
            let follows = |other: &Sent| {
                let low = other.range.map(|(_, low)| low);
                let called = |sent: &Sent| (sent.draft.kind, sent.draft.name.clone());
                low == next && called(other) == called(part)
            };
            next.is_some() && behind.iter().any(follows)
        };
        if filled % 8 == 0 && !mine.iter().any(goes_on) {
            return index + 1;
        }
    }
    run.len()
}

/// The fields of a number, the most significant first, from its bytes, the least significant
/// first.
fn reversed(number: &[Sent]) -> Vec<Draft> {
    let mut bytes: Vec<Vec<&Draft>> = Vec::new();
    let mut filled = 0;
    for part in number {
        match bytes.last_mut().filter(|_| filled % 8 != 0) {
            Some(byte) => byte.push(&part.draft),
            None => bytes.push(alloc::vec![&part.draft]),
        }
        filled += part.draft.width;
    }
    bytes.reverse();
    let mut fields: Vec<Draft> = Vec::new();
    for draft in bytes.into_iter().flatten() {
        let same = |last: &&mut Draft| {
            let again = Draft {
                width: last.width,
                ..draft.clone()
            };
            draft.little_endian && again == **last
        };
        match fields.last_mut().filter(same) {
            Some(last) => last.width += draft.width,
            None => fields.push(draft.clone()),
        }
    }
    fields
}
