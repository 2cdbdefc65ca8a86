//! How fast the core decodes, in bytes of input a second: streams, words and text into columns,
//! framing, checks and readings included; pasted writings; recordings of clock and data; and what
//! the machine does with the same bytes when it only adds them up or copies them.
//!
//! `cargo bench -p encoderscope-tests`, with a part of a name behind `--` for some of them, and
//! `BENCH_MEGABYTES` of input where it is set.
#![allow(missing_docs)]

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
mod native;

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    native::run();
}
