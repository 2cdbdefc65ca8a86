//! Where error, warning and status stand in the frames of each interface, out of their layouts.

use crate::{
    format::{Link, asi1, asi4, biss_c, bus, period, rs485, ssi, ssi_tree, ssi7, t485},
    language::t,
    layout::{Active, Field, Layout, Resolved, Role, Shape},
    product::Interface,
};
use alloc::{string::String, vec::Vec};

/// A bit that says how the encoder is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Flag {
    /// What its field says.
    pub role: Role,
    /// The field that holds it.
    pub field: &'static str,
    /// Its name.
    pub name: String,
    /// Its number: counted from the end of a clocked frame, or within its byte.
    pub place: u32,
    /// The level that asserts it.
    pub active: Active,
    /// What it means.
    pub doc: String,
}

/// The flags and status bits of an interface, as they follow each other.
///
/// ```
/// use encoderscope::{lamp::flags, layout::Role, product::Interface};
/// let flags = flags(Interface::BissC);
/// let error = flags.iter().find(|flag| flag.role == Role::Error).unwrap();
/// assert_eq!(error.place, 13);
/// ```
#[must_use]
pub fn flags(interface: Interface) -> Vec<Flag> {
    let format = interface.format();
    let layout = Resolved::new(layout(interface), Shape::of(format.default_profile()));
    let is_clocked = format.spec().link == Link::Clocked;
    let place = |index: usize| match is_clocked {
        true => (layout.len - 1).saturating_sub(index) as u32,
        false => 7 - (index % 8) as u32,
    };
    let health = layout.fields().filter(|field| {
        matches!(
            field.row.role,
            Role::Error
                | Role::Warning
                | Role::Status
                | Role::Alarm
                | Role::Valid
                | Role::ZeroDefault
        )
    });
    let flag = |field: &Field, at: u32, name: &'static str, doc: String| {
        layout.bit_of(field, at).map(|index| Flag {
            role: field.row.role,
            field: field.row.name,
            name: t(name).replace('_', " "),
            place: place(index),
            active: field.row.active,
            doc,
        })
    };
    health
        .flat_map(|field| {
            let doc = || {
                let lines: Vec<_> = field.row.doc.iter().map(|line| line.trim()).collect();
                lines.join(" ")
            };
            let named = field.row.bits.iter();
            let named = named.filter_map(|bit| flag(field, bit.place, bit.name, t(bit.doc).into()));
            let alone = match field.row.bits.is_empty() {
                true => flag(field, 0, field.row.name, doc()),
                false => None,
            };
            alone.into_iter().chain(named).collect::<Vec<_>>()
        })
        .collect()
}

/// The reply that carries the status.
const fn layout(interface: Interface) -> &'static Layout {
    match interface {
        Interface::Ssi => &ssi::WORD,
        Interface::BissC => &biss_c::FRAME,
        Interface::Rs485 | Interface::Rs422 => &rs485::STATUS_REPLY,
        Interface::T485 => &t485::ALL,
        Interface::Bus => &bus::GET,
        Interface::Period => period::FRAME,
        Interface::Asi1 => &asi1::PACKET,
        Interface::Asi4 => &asi4::LINE,
        Interface::Ssi7 => &ssi7::WORD,
        Interface::SsiTree => &ssi_tree::WORD,
    }
}
