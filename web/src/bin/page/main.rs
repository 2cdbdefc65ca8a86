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
mod language;
mod link_panel;
mod live;
mod log;
mod parts;
mod plot;
mod ports;
mod profile_editor;
mod recordings;
mod reference;
mod setting;
mod standstill;
mod zero_wire;

use encoderscope_web::browser::Peer;
use wasm_bindgen::prelude::*;

fn main() {}

#[wasm_bindgen]
extern "C" {
    #[derive(Clone, Debug)]
    /// Fetches and makes what is not Rust; `web/js/main.js`.
    pub type Workers;
    /// The language that the page begins with, by its code.
    #[wasm_bindgen(method, getter)]
    fn language(this: &Workers) -> String;
    /// Its texts; undefined for English.
    #[wasm_bindgen(method, getter)]
    fn texts(this: &Workers) -> JsValue;
    /// One that runs the engine.
    #[wasm_bindgen(method, catch)]
    fn engine(this: &Workers) -> Result<Peer, JsValue>;
    /// The page's end of a channel to an engine that runs on the page.
    #[wasm_bindgen(method, catch, js_name = engineHere)]
    async fn engine_here(this: &Workers) -> Result<JsValue, JsValue>;
    /// One that decodes dumps.
    #[wasm_bindgen(method, catch)]
    fn desk(this: &Workers) -> Result<Peer, JsValue>;
    /// What plots are drawn with.
    #[wasm_bindgen(method, catch)]
    async fn charts(this: &Workers) -> Result<JsValue, JsValue>;
    /// Whether a recording runs: until it ends, no new version of the page is taken into use.
    #[wasm_bindgen(method)]
    fn recording(this: &Workers, runs: bool);
}

/// Mounts the page.
#[wasm_bindgen]
pub fn start(workers: Workers) {
    // The page itself has no views: they are made anew with the language.
    leptos::mount::mount_to_body(move || app::start(workers));
}
