//! The page, its serial worker and the JavaScript module, as far as they share code.
//!
//! Three WASM files are made from this package: `page` is the Leptos front end; `module` has no
//! Leptos in it and serves the worker and the JavaScript module; `element`, the small one of the
//! custom element, uses the core alone.
#![cfg(feature = "app")]

pub mod browser;
pub mod desk;
pub mod engine;
pub mod link;
pub mod message;
pub mod plot;
pub mod serial;
pub mod tally;
