//! The language of the page and its workers.

use encoderscope::language::{self, Catalogue};
use std::cell::OnceCell;
use wasm_bindgen::JsValue;

thread_local! {
    static LEARNT: OnceCell<&'static Catalogue> = const { OnceCell::new() };
}

/// Speaks another language, of which a string has all texts ([`Catalogue::read`]); English where there
/// is none.
pub fn speak(texts: &JsValue) {
    let learn = |texts| LEARNT.with(|learnt| *learnt.get_or_init(|| Catalogue::read(texts)));
    language::speak(texts.as_string().map(learn));
}
