//! Which bytes may change an encoder.

use crate::{
    bits::Bits,
    format::{
        Format,
        bus::{self, Operation},
        rs485::Command,
        t485::Request,
    },
    language::{msg, t},
    layout::{Resolved, Shape},
    profile::Profile,
    say,
};
use core::fmt;

/// A byte that belongs to a command that changes an encoder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Danger {
    /// The byte.
    pub byte: u8,
    /// What it is part of.
    pub what: &'static str,
    /// The format whose encoders understand it so.
    pub format: Format,
}

impl fmt::Display for Danger {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        say!(
            f,
            "0x{} is part of {} on {} encoders",
            format_args!("{:02X}", self.byte),
            t(self.what),
            t(self.format.title())
        )
    }
}

/// So many bytes that look like it are a sequence of a BUS.
const MANY: usize = 3;

/// The first of some bytes that is part of a command that changes an encoder, whatever the profile
/// says, since it may be wrong. Many bytes look like an operation of a BUS: where the profile is
/// not one of a BUS, a few of them are not taken for one.
///
/// ```
/// use encoderscope::{format::Format, sequence::danger};
/// let t485 = Format::T485.default_profile();
/// assert_eq!(danger(&t485, &[0x1a, 0x30]).unwrap().byte, 0x30);
/// assert_eq!(danger(&t485, &[0x1a, 0x64, 0xbf]), None);
/// assert!(danger(&Format::Bus.default_profile(), &[0xbf]).is_some());
/// ```
#[must_use]
pub fn danger(profile: &Profile, bytes: &[u8]) -> Option<Danger> {
    let of_bus = || bytes.iter().filter_map(|byte| of_bus(profile, *byte));
    let enough = profile.format == Format::Bus || of_bus().count() >= MANY;
    let mut named = bytes.iter().filter_map(|byte| of_byte(*byte));
    named.next().or_else(|| of_bus().next().filter(|_| enough))
}

fn of_byte(byte: u8) -> Option<Danger> {
    let danger = |what, format| Some(Danger { byte, what, format });
    if Command::of_byte(byte).is_some_and(Command::changes_encoder) {
        return danger(msg("set zero"), Format::Rs485);
    }
    match Request::of_byte(byte).filter(|request| request.changes_encoder()) {
        Some(Request::MemoryWrite) => danger(msg("EEPROM write"), Format::T485),
        Some(Request::ResetErrors) => danger(msg("reset errors"), Format::T485),
        Some(Request::ResetTurns) => danger(msg("reset turns"), Format::T485),
        Some(_) => danger(msg("reset angle"), Format::T485),
        None => None,
    }
}

fn of_bus(profile: &Profile, byte: u8) -> Option<Danger> {
    let danger = |what| {
        let format = Format::Bus;
        Some(Danger { byte, what, format })
    };
    let bus = match profile.format {
        Format::Bus => *profile,
        _ => Format::Bus.default_profile(),
    };
    let head = Resolved::new(&bus::HEAD, Shape::of(bus));
    // Whatever the parity says: what an encoder requires of it is not known.
    let operation = head.values(Bits::of_bytes(&[byte])).operation?;
    match Operation::of_code(operation).filter(|operation| operation.changes_encoder())? {
        Operation::SetAddress => danger(msg("set address")),
        _ => danger(msg("set zero")),
    }
}
