//! The page, its serial worker and the JavaScript module, as far as they share code.
//!
//! Two WASM files are made from this package: `page` is the Leptos front end; `module` has no
//! Leptos in it and serves the worker and the JavaScript module.

pub mod browser;
pub mod desk;
pub mod engine;
pub mod link;
pub mod message;
pub mod plot;
pub mod serial;
pub mod tally;
