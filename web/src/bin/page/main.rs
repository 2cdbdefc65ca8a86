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
mod profile_editor;
mod setting;
mod theme;
mod zero_wire;

use wasm_bindgen::prelude::*;

fn main() {}

/// Mounts the page; `make_worker` makes the dedicated worker that runs the engine.
#[wasm_bindgen]
pub fn start(make_worker: js_sys::Function) {
    leptos::mount::mount_to_body(move || app::app(&make_worker));
}
