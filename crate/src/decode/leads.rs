//! What the first byte of a frame of a byte format says.

use super::Decoder;
use crate::{
    bits::{self, Bits},
    format::{Format, asi4, bus, own::Own, t485},
    layout::Resolved,
    profile::Dialect,
};
use alloc::vec::Vec;

/// What the profile's own address speaks for a BUS frame, in bits.
const OWN_DEVICE: i8 = 6;
/// What a parity of the other sense speaks against it.
const OTHER_PARITY: i8 = -6;

/// A byte that begins no frame.
pub(super) const NO_LEAD: Lead = Lead {
    layout: u8::MAX,
    request: false,
    names: 0,
    unsure: false,
};

/// What the first byte of a frame says.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lead {
    /// Which layout the frame has; one that does not exist where there is none.
    layout: u8,
    /// Whether it is a request that may stand before its reply in a dump.
    request: bool,
    /// How much it speaks for a frame beyond what the checks count, in bits.
    names: i8,
    /// Whether an encoder may not know the request, and answer with another layout.
    unsure: bool,
}

/// How frames begin that follow another without being weighed, as their first bytes, the first
/// the least significant: some bits must be so, and others must not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Follows {
    mask: u64,
    value: u64,
    never_mask: u64,
    never: u64,
}

impl Follows {
    /// With the byte that the other begins with; where it is a request too, not twice.
    const fn echo(byte: u8, request: bool) -> Self {
        let value = byte as u64;
        let twice = bits::placed(value, 8) | value;
        Self {
            mask: 0xff,
            value,
            never_mask: if request { 0xffff } else { 0 },
            never: if request { twice } else { 1 },
        }
    }

    /// With any byte but the request.
    const fn other_than(request: Option<u8>) -> Self {
        Self {
            mask: 0,
            value: 0,
            never_mask: if request.is_some() { 0xff } else { 0 },
            never: match request {
                Some(byte) => byte as u64,
                None => 1,
            },
        }
    }

    /// With the same `count` bits, up to 64, as another.
    pub(super) fn same_bits(other: &[u8], count: usize) -> Self {
        let first = other.get(..8).unwrap_or(other);
        let unused = 8usize.saturating_sub(first.len()) * 8;
        let head = bits::placed(bits::word(first), unused as u32);
        let mask = !bits::mask(64usize.saturating_sub(count));
        Self {
            mask: mask.swap_bytes(),
            value: (head & mask).swap_bytes(),
            never_mask: 0,
            never: 1,
        }
    }

    /// Whether a frame begins so.
    #[inline(always)]
    pub(crate) const fn holds(self, head: u64) -> bool {
        head & self.mask == self.value && head & self.never_mask != self.never
    }
}

impl Decoder {
    pub(super) fn lead(&self, byte: u8) -> Lead {
        let asked = t485::Request::of_byte(byte).filter(|_| self.profile.format == Format::T485);
        let index = match self.profile.format {
            Format::T485 => match asked {
                Some(asked) => t485::Request::ALL
                    .iter()
                    .position(|request| *request == asked),
                // Any other control byte is answered with the angle.
                None => t485::is_control(byte).then_some(0),
            },
            Format::Bus => {
                let code = self.layouts[0].values(Bits::of_bytes(&[byte])).operation;
                let mut known = bus::Operation::ALL.iter();
                known.position(|operation| Some(operation.code()) == code)
            }
            _ => Some(0),
        };
        let names = self.weigh_lead(byte);
        let request = match self.profile.format {
            Format::Rs485 => byte == self.profile.command.byte(),
            Format::T485 => asked.is_some(),
            Format::Bus => names > 0,
            _ => self.profile.own.and_then(Own::request) == Some(byte),
        };
        Lead {
            layout: index.map_or(u8::MAX, |index| index as u8),
            request,
            names,
            unsure: asked.is_some_and(|asked| !asked.is_known_to(Dialect::Mpp)),
        }
    }

    /// The CRC of BUS holds for a frame that is read a byte late, as the next one begins with
    /// the same byte: what remains is its address and a parity that is likely.
    fn weigh_lead(&self, byte: u8) -> i8 {
        if self.profile.format != Format::Bus {
            return 0;
        }
        let values = self.layouts[0].values(Bits::of_bytes(&[byte]));
        let own = values.address.map(u32::from) == Some(self.profile.address);
        let parity = match values.parity {
            Some(parity) if parity.ok() => 1,
            Some(_) => OTHER_PARITY,
            None => 0,
        };
        parity + if own { OWN_DEVICE } else { 0 }
    }

    /// The layout of a frame of a byte format that begins `bytes`; `None` where no frame can.
    ///
    /// The first byte tells it, except in ASI4, whose lines end where they end.
    #[must_use]
    #[inline]
    pub fn layout(&self, bytes: &[u8]) -> Option<&Resolved> {
        if self.profile.format == Format::Asi4 {
            return self.layouts.get(asi4::digits(bytes)? - 1);
        }
        let lead = self.leads[usize::from(*bytes.first()?)];
        let layout = self.layouts.get(usize::from(lead.layout))?;
        if lead.unsure {
            return Some(self.refused(bytes).unwrap_or(layout));
        }
        Some(layout)
    }

    /// What an encoder of the profile's kind can send, each with a byte that begins it: of T485 and
    /// BUS one for every byte that can, of other formats all for one byte.
    ///
    /// An encoder that does not know a T485 request answers with its angle.
    #[must_use]
    pub fn replies(&self) -> Vec<(u8, &Resolved)> {
        if !self.echoes() {
            return self.layouts.iter().map(|layout| (0, layout)).collect();
        }
        let known = |byte| match self.profile.format {
            Format::T485 => t485::Request::of_byte(byte)
                .is_some_and(|request| request.is_known_to(self.profile.dialect)),
            _ => true,
        };
        let all = (0..=u8::MAX).zip(&self.leads);
        all.filter_map(|(byte, lead)| {
            let own = self.layouts.get(usize::from(lead.layout))?;
            let sent = if known(byte) {
                own
            } else {
                self.layouts.first()?
            };
            Some((byte, sent))
        })
        .collect()
    }

    /// The layout of the reply to a T485 request that the encoder did not understand: it sends
    /// the angle instead.
    fn refused(&self, bytes: &[u8]) -> Option<&Resolved> {
        let holds = |layout: &&Resolved| {
            let frame = bytes.get(..layout.len / 8);
            frame.is_some_and(|frame| layout.holds(Bits::of_bytes(frame)))
        };
        let own = self.leads[usize::from(*bytes.first()?)].layout;
        let own = self.layouts.get(usize::from(own))?;
        let angle = self.layouts.first()?;
        (!holds(&own) && holds(&angle)).then_some(angle)
    }

    /// How the frames begin that may follow one beginning with `byte` without being weighed;
    /// `None` where each is to be weighed.
    #[inline]
    pub(crate) fn follower(&self, byte: u8) -> Option<Follows> {
        let lead = self.leads.get(usize::from(byte))?;
        match self.echoes() {
            true if lead.unsure || lead.names < 0 => None,
            true => Some(Follows::echo(byte, lead.request)),
            false if lead.request => None,
            false => Some(Follows::other_than(self.request)),
        }
    }

    /// Whether `byte` is a request that may stand before its reply in a dump.
    #[must_use]
    #[inline]
    pub fn is_request(&self, byte: u8) -> bool {
        self.leads[usize::from(byte)].request
    }

    /// Whether a reply begins with the byte that was asked.
    #[must_use]
    pub fn echoes(&self) -> bool {
        match self.profile.own {
            Some(own) => own.echoes(),
            None => matches!(self.profile.format, Format::T485 | Format::Bus),
        }
    }

    /// Whether a frame that begins with `byte` needs no more proof of its place than its checks.
    /// The CRC of BUS holds in other phases too, so the device must be the profile's, or the one
    /// of the frame before.
    #[inline]
    pub(crate) fn is_known_lead(&self, byte: u8, before: Option<u8>) -> bool {
        if self.profile.format != Format::Bus {
            return true;
        }
        let names = self.names(byte);
        names >= OWN_DEVICE.into() || names > 0 && before == Some(byte)
    }

    /// How much the first byte of a frame speaks for it beyond what its checks count, in bits.
    pub(crate) fn names(&self, first: u8) -> i32 {
        self.leads[usize::from(first)].names.into()
    }
}
