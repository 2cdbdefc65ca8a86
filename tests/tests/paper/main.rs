//! What calculators, wiring, order codes and the other tables of the reference say in Russian.

#[cfg(not(target_arch = "wasm32"))]
mod russian;
