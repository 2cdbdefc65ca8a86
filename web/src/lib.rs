//! The page, its serial worker and the JavaScript module, as far as they share code.
//!
//! Three programs are made from this package: `page` is the Leptos front end, whose WASM the build
//! splits into the first view and the parts that come when they are wanted (`bin/page/parts.rs`);
//! `module` has no Leptos in it and serves the workers and the JavaScript module; `element`, the
//! small one of the custom element, uses the core alone.
#![cfg(feature = "app")]

pub mod browser;
pub mod desk;
pub mod engine;
pub mod language;
pub mod message;
pub mod plot;
pub mod serial;
pub mod store;
pub mod tally;
pub mod transcript;

pub use encoderscope::link;

// Faster than the one that comes with Rust, and half its size.
#[cfg(target_family = "wasm")]
#[global_allocator]
static ALLOCATOR: talc::wasm::WasmDynamicTalc = talc::wasm::new_wasm_dynamic_allocator();
