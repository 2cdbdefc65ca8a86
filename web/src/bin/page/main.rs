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
mod desk;
mod devices;
mod dial;
mod doctor;
mod eeprom;
mod explain;
mod finder;
mod frame_view;
mod handout;
mod link_panel;
mod live;
mod log;
mod plot;
mod ports;
mod profile_editor;
mod reference;
mod setting;
mod standstill;
mod theme;
mod zero_wire;

use leptos::prelude::{LocalStorage, StoredValue, provide_context};
use wasm_bindgen::prelude::*;

fn main() {}

#[wasm_bindgen]
extern "C" {
    /// Makes the dedicated workers; `web/js/main.js`.
    pub type Workers;
    /// One that runs the engine.
    #[wasm_bindgen(method, catch)]
    fn engine(this: &Workers) -> Result<web_sys::Worker, JsValue>;
    /// One that decodes dumps.
    #[wasm_bindgen(method, catch)]
    fn desk(this: &Workers) -> Result<web_sys::Worker, JsValue>;
}

/// Mounts the page; `charts` is what plots are drawn with.
#[wasm_bindgen]
pub fn start(workers: Workers, charts: plot::Charts) {
    leptos::mount::mount_to_body(move || {
        provide_context::<StoredValue<_, LocalStorage>>(StoredValue::new_local(charts));
        app::app(workers)
    });
}
