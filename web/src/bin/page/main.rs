//! The page: a Leptos front end over the core and the engine.

#![allow(
    unreachable_pub,
    reason = "the component macro writes public property structs"
)]

mod adapters;
mod app;
mod connection;
mod console;
mod decode;
mod demo;
mod devices;
mod dial;
mod doctor;
mod eeprom;
mod finder;
mod frame_view;
mod link_panel;
mod live;
mod log;
mod plot;
mod ports;
mod profile_editor;
mod setting;
mod standstill;
mod theme;
mod zero_wire;

use leptos::prelude::{LocalStorage, StoredValue, provide_context};
use wasm_bindgen::prelude::*;

fn main() {}

/// Mounts the page; `make_worker` makes the dedicated worker that runs the engine, `charts` what
/// the plot is drawn with.
#[wasm_bindgen]
pub fn start(make_worker: js_sys::Function, charts: plot::Charts) {
    leptos::mount::mount_to_body(move || {
        provide_context::<StoredValue<_, LocalStorage>>(StoredValue::new_local(charts));
        app::app(&make_worker)
    });
}
