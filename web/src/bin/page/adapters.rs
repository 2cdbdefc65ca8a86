//! What this browser remembers of adapters: the user's name for each, and the encoder behind it.

use encoderscope::profile::Profile;
use encoderscope_web::{
    link::{profile, query},
    message::PortId,
    serial,
};
use leptos::prelude::window;

/// Adapters of one kind cannot be told apart; other ports are known by their place.
fn key(port: PortId, what: &str) -> String {
    match (port.vendor, port.product) {
        (Some(vendor), Some(product)) => format!("adapter-{vendor:04x}-{product:04x}-{what}"),
        _ => format!("adapter-{}-{what}", port.index),
    }
}

fn read(port: PortId, what: &str) -> Option<String> {
    let storage = window().local_storage().ok()??;
    storage.get_item(&key(port, what)).ok()?
}

fn write(port: PortId, what: &str, value: &str) {
    if let Ok(Some(storage)) = window().local_storage() {
        // A browser that keeps nothing asks again next time.
        let _ = storage.set_item(&key(port, what), value);
    }
}

/// The name for a port: the user's, or that of its chip.
pub(crate) fn name(port: PortId) -> String {
    read(port, "name").unwrap_or_else(|| serial::name(port))
}

/// Gives a port a name; an empty one takes the user's away.
pub(crate) fn rename(port: PortId, name: &str) {
    match name.trim() {
        "" => {
            if let Ok(Some(storage)) = window().local_storage() {
                // What cannot be forgotten was not kept.
                let _ = storage.remove_item(&key(port, "name"));
            }
        }
        name => write(port, "name", name),
    }
}

/// Remembers the encoder behind a port.
pub(crate) fn remember(port: PortId, encoder: &Profile) {
    write(port, "profile", &query(encoder));
}

/// Whether an encoder was behind a port.
pub(crate) fn is_known(port: PortId) -> bool {
    read(port, "profile").is_some()
}

/// The encoder that was behind a port last.
pub(crate) fn recall(port: PortId) -> Option<Profile> {
    profile(&read(port, "profile")?).ok()
}
