//! What a session says.

use super::Micros;
use crate::framing::{Piece, PieceKind, Why};
use alloc::vec::Vec;

/// What a session has to say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    /// Bytes to send.
    Transmit(Vec<u8>),
    /// A reply of the right length, or a frame of a stream.
    Frame {
        /// Its bytes.
        bytes: Vec<u8>,
        /// Whether it stood where the frame must stand.
        sure: bool,
        /// Time from the request, where there was one.
        latency: Option<Micros>,
    },
    /// Bytes that belong to no reply.
    Skip {
        /// The bytes.
        bytes: Vec<u8>,
        /// Why.
        why: Why,
    },
    /// Nothing came back, or nothing but the echo of the request.
    Silent {
        /// Whether the request came back.
        echo: bool,
    },
}

/// Whether the adapter returns what it sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Echo {
    /// Not known yet.
    Unknown,
    /// Only replies come back.
    Absent,
    /// The request comes back before the reply.
    Present,
}

/// What a session says of a piece.
pub(super) fn reported(piece: &Piece<'_>) -> Output {
    let bytes = piece.bytes.into();
    match piece.kind {
        PieceKind::Frame { sure, .. } => Output::Frame {
            bytes,
            sure,
            latency: None,
        },
        PieceKind::Skip(why) => Output::Skip { bytes, why },
    }
}
