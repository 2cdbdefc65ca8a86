//! Files that hold what is expected: `UPDATE=1` writes them anew.

/// Whether they are to be written.
#[cfg(not(target_arch = "wasm32"))]
#[must_use]
pub fn is_updating() -> bool {
    std::env::var_os("UPDATE").is_some_and(|value| value == "1")
}

/// Writes one, by its path in this package.
///
/// # Panics
///
/// It cannot be written.
#[cfg(not(target_arch = "wasm32"))]
pub fn write(path: &str, text: &str) {
    let path = format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::write(path, text).expect("a golden that can be written");
}

/// In a browser there are no files to write.
#[cfg(target_arch = "wasm32")]
#[must_use]
pub fn is_updating() -> bool {
    false
}

/// In a browser there are no files to write.
#[cfg(target_arch = "wasm32")]
pub fn write(_: &str, _: &str) {}
