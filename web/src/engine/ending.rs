//! How a port that is opened comes to an end: refused, or let go.

use super::run::Wire;
use crate::{browser::error_text, message::Link};
use encoderscope::language::msg;
use wasm_bindgen::JsValue;

/// Why a port could not be opened, and what to do about it.
pub(super) fn refused(error: &JsValue) -> Link {
    let (name, message) = error_text(error);
    let (reason, hint) = match name.as_str() {
        "InvalidStateError" => (
            msg("This page still holds it: pull the adapter out and plug it in again.").into(),
            "",
        ),
        "SecurityError" => (
            msg(
                "The browser blocks serial ports here: see the site's settings, or ask who manages \
                 this computer.",
            )
            .into(),
            "",
        ),
        "NetworkError" => (
            message,
            msg(
                "Close other tabs and other programs that use it; on Linux your user must be in the \
                 group dialout.",
            ),
        ),
        _ => (message, ""),
    };
    Link::Refused {
        reason,
        hint: hint.into(),
    }
}

/// Closes a port that was let go.
pub(super) async fn shut(wire: Option<Wire>) {
    if let Some(Wire::Port { port, reader }) = wire {
        if let Some(reader) = reader {
            reader.cancel().await;
            reader.release();
        }
        port.close().await;
    }
}
