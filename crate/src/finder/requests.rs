//! What a search asks.

use crate::{
    decode::Decoder,
    format::{Format, bus::ADDRESSES, rs485::Command, t485::Request},
    profile::Profile,
    session::Ask,
};
use alloc::vec::Vec;

/// The requests that a search sends for the format of a profile: none of them changes an encoder.
///
/// ```
/// use encoderscope::{finder::requests, format::Format};
/// assert_eq!(requests(&Format::Rs485.default_profile()).len(), 3);
/// assert_eq!(requests(&Format::Bus.default_profile()).len(), 32);
/// ```
#[must_use]
pub fn requests(profile: &Profile) -> Vec<Ask> {
    asks(&decoders(*profile))
}

/// A decoder for each kind of reply.
pub(super) fn decoders(profile: Profile) -> Vec<Decoder> {
    let of = |command| {
        let profile = Profile { command, ..profile };
        Decoder::new(profile).ok()
    };
    match profile.format {
        Format::Rs485 => [Command::Status, Command::Speed, Command::Temperature]
            .into_iter()
            .filter_map(of)
            .collect(),
        _ => of(profile.command).into_iter().collect(),
    }
}

pub(super) fn asks(decoders: &[Decoder]) -> Vec<Ask> {
    let Some(first) = decoders.first() else {
        return Vec::new();
    };
    match first.profile().format {
        Format::T485 => [Request::All, Request::Angle]
            .into_iter()
            .filter_map(|request| Ask::t485(first, request, 0).ok())
            .collect(),
        Format::Bus => addresses()
            .filter_map(|address| Ask::device(first, address).ok())
            .collect(),
        _ => decoders
            .iter()
            .filter_map(|decoder| Ask::position(decoder).ok())
            .collect(),
    }
}

/// The addresses of a BUS, that of the factory first.
pub(super) fn addresses() -> impl Iterator<Item = u8> {
    let factory = ADDRESSES - 1;
    core::iter::once(factory).chain(0..factory)
}
