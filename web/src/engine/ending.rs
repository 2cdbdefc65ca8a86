//! How a port that is opened comes to an end: refused, or let go.

use super::run::Wire;
use crate::{browser::error_text, message::Link};
use wasm_bindgen::JsValue;

/// Why a port could not be opened, and what to do about it.
pub(super) fn refused(error: &JsValue) -> Link {
    let (name, message) = error_text(error);
    let reason = match name.as_str() {
        "InvalidStateError" => {
            "This page still holds it: pull the adapter out and plug it in again.".into()
        }
        "SecurityError" => {
            "The browser blocks serial ports here: see the site's settings, or ask who manages \
             this computer."
                .into()
        }
        "NetworkError" => format!(
            "{message} Close other tabs and other programs that use it; on Linux your user must \
             be in the group dialout."
        ),
        _ => message,
    };
    Link::Refused { reason }
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
