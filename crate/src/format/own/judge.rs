//! What a user's layout cannot be.

use super::{Draft, Framing, Kind, SPEC, Written};
use crate::{language::t, layout::Class, sequence, text};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};
use core::ops::Range;

/// Most bits of a frame.
const LONGEST: u32 = 256;

/// What no layout can be.
pub(super) fn judge(written: &Written, names: &[String]) -> Result<(), String> {
    let fields = &written.fields;
    let total: u32 = fields.iter().map(|field| field.width).sum();
    let sum = |kind: Kind| -> u32 {
        let mine = fields.iter().filter(|field| field.kind == kind);
        mine.map(|field| field.width).sum()
    };
    if total > LONGEST {
        return Err(text!("{} bits are more than {}", total, LONGEST));
    }
    for kind in [Kind::Angle, Kind::Turns] {
        let mut called = fields
            .iter()
            .zip(names)
            .filter(|(field, _)| field.kind == kind);
        let first = called.next().map(|(_, name)| name);
        if let Some((_, other)) = called.find(|(_, name)| Some(*name) != first) {
            let first = first.map_or("", String::as_str);
            return Err(text!(
                "the parts of the {} are called {} and {}: parts of one number have one name",
                kind.name(),
                first,
                other
            ));
        }
    }
    if sum(Kind::Angle) == 0 {
        return Err(t("there is no angle").to_string());
    }
    if let Framing::Poll(byte) = written.framing
        && let Some(danger) = sequence::danger(&SPEC.default, &[byte])
    {
        return Err(text!("{}: it is not sent by polling", danger));
    }
    let serial = matches!(written.framing, Framing::Stream | Framing::Poll(_));
    if serial && !total.is_multiple_of(8) {
        return Err(text!(
            "{} bits are no whole bytes, which a serial line sends",
            total
        ));
    }
    let same = |one: &Draft, other: &Draft| {
        one.kind == other.kind
            && !matches!(one.kind, Kind::Crc | Kind::Even | Kind::Odd | Kind::Const)
    };
    for (index, (field, name)) in fields.iter().zip(names).enumerate() {
        let earlier = fields.iter().zip(names).take(index);
        let mut mine = earlier.filter(|(_, known)| *known == name);
        if mine.any(|(other, _)| !same(field, other)) {
            return Err(text!("two fields are called {}", name));
        }
        let parts = fields.iter().zip(names).filter(|(_, known)| *known == name);
        let bits: u32 = parts.map(|(part, _)| part.width).sum();
        let (_, most) = field.kind.widths();
        if bits > most {
            return Err(text!(
                "{} bits of {} exceed {}",
                bits,
                field.kind.name(),
                most
            ));
        }
        judge_check(written, names, index)?;
    }
    if is_circle(written, names)? {
        return Err(t("checks cover one another").to_string());
    }
    judge_little_endian(fields)?;
    judge_gray(fields, names)
}

/// What little-endian numbers cannot be.
fn judge_little_endian(fields: &[Draft]) -> Result<(), String> {
    for run in fields.chunk_by(|one, other| one.little_endian == other.little_endian) {
        let mut bits = 0;
        for field in run.iter().filter(|field| field.little_endian) {
            let alone = bits % 8 == 0 && field.width.is_multiple_of(8);
            if field.kind.role().class() == Class::Check && !alone {
                return Err(t("a check that is le has whole bytes of its own").to_string());
            }
            bits += field.width;
        }
        if !bits.is_multiple_of(8) {
            return Err(text!("{} bits of le side by side are no whole bytes", bits));
        }
    }
    Ok(())
}

/// What a Gray-coded word cannot be.
fn judge_gray(fields: &[Draft], names: &[String]) -> Result<(), String> {
    let runs = fields
        .chunk_by(|one, other| one.gray == other.gray)
        .filter(|run| run.first().is_some_and(|field| field.gray));
    if runs.count() > 1 {
        return Err(t("gray fields must stand side by side: they are one word").to_string());
    }
    if fields.iter().any(|field| field.gray && field.little_endian) {
        return Err(t("a field is either gray or le").to_string());
    }
    let gray = fields.iter().filter(|field| field.gray);
    if gray.map(|field| field.width).sum::<u32>() > 64 {
        return Err(t("a gray word has at most 64 bits").to_string());
    }
    let parts = |name: &String| names.iter().filter(|known| *known == name).count();
    let mut words = fields.iter().zip(names).filter(|(field, _)| field.gray);
    if let Some((_, name)) = words.find(|(_, name)| parts(name) > 1) {
        return Err(text!("{} is gray and comes in several parts", name));
    }
    Ok(())
}

/// The fields that a check covers; of those in parts from the first part to the last.
fn covered(field: &Draft, names: &[String], index: usize) -> Result<Range<usize>, String> {
    let known = |name: &String| text!("no field is called \"{}\"", name);
    let first = match &field.from {
        Some(from) => names
            .iter()
            .position(|name| name == from)
            .ok_or_else(|| known(from))?,
        None => 0,
    };
    let last = match &field.to {
        Some(to) => names
            .iter()
            .rposition(|name| name == to)
            .ok_or_else(|| known(to))?,
        None => index.saturating_sub(1),
    };
    Ok(first..last + 1)
}

/// Whether checks cover one another in a circle, so that none can be computed first.
fn is_circle(written: &Written, names: &[String]) -> Result<bool, String> {
    let mut open = Vec::new();
    for (index, field) in written.fields.iter().enumerate() {
        if field.kind.role().class() == Class::Check {
            open.push((index, covered(field, names, index)?));
        }
    }
    loop {
        let left: Vec<_> = open
            .iter()
            .filter(|(_, span)| open.iter().any(|(other, _)| span.contains(other)))
            .cloned()
            .collect();
        match left.len() {
            0 => return Ok(false),
            same if same == open.len() => return Ok(true),
            _ => open = left,
        }
    }
}

/// What a check cannot cover.
fn judge_check(written: &Written, names: &[String], index: usize) -> Result<(), String> {
    let checks = |field: &&Draft| field.kind.role().class() == Class::Check;
    let Some(field) = written.fields.get(index).filter(checks) else {
        return Ok(());
    };
    if field.gray {
        return Err(text!("the check {} cannot be gray", field.kind.name()));
    }
    let span = covered(field, names, index)?;
    let fields = match index {
        0 if field.to.is_none() => &[],
        _ if span.contains(&index) => {
            return Err(text!("the check {} covers itself", field.kind.name()));
        }
        _ => written.fields.get(span).unwrap_or_default(),
    };
    let covered: u32 = fields.iter().map(|field| field.width).sum();
    let rule = field.crc;
    let whole = covered.is_multiple_of(8);
    if field.kind == Kind::Crc && !whole && (rule.reflected || rule.init != 0) {
        return Err(text!(
            "a crc that is reflected or does not start from 0 covers whole bytes, not {} bits",
            covered
        ));
    }
    match covered {
        0 => Err(t("a check covers nothing").to_string()),
        _ => Ok(()),
    }
}
