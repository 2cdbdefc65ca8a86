//! Tests of the core; the same ones run natively and in a browser.
#![allow(missing_docs)]

#[cfg(target_arch = "wasm32")]
wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_browser);

mod adapters;
mod captures;
mod captures_files;
mod captures_pieces;
mod captures_timing;
mod columns;
mod corpus;
mod crc_search;
mod detection;
mod detection_kinds;
mod diagrams;
mod diagrams_golden;
mod diagrams_limits;
mod diagrams_svg;
mod diagrams_wavedrom;
mod doctor;
mod dumps;
mod encoders;
mod finder;
mod framing;
mod fuzz;
mod history;
mod laws;
mod laws_asi;
mod laws_bits;
mod laws_formats;
mod laws_profiles;
mod laws_ssi;
mod layouts;
mod own;
mod pastes;
mod reference;
mod resolution;
mod rivals;
mod sequences;
mod sessions;
mod sheets;
mod sketches;
mod sketches_digits;
mod standstill;
mod streams;
mod tables;
mod vectors;
mod vectors_ssi;
