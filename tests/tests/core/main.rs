//! Tests of the core; the same ones run natively and in a browser.
#![allow(missing_docs)]

#[cfg(target_arch = "wasm32")]
wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_browser);

mod detection;
mod dumps;
mod framing;
mod fuzz;
mod laws;
mod sessions;
mod vectors;
