//! Pieces of a stream as a session says them.

use super::Output;
use crate::framing::{Piece, PieceKind};

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
