//! The language of the page and its workers.

use encoderscope::language::{self, Catalogue};
use js_sys::{Array, Object};
use std::cell::OnceCell;
use wasm_bindgen::JsValue;

thread_local! {
    static LEARNT: OnceCell<&'static Catalogue> = const { OnceCell::new() };
}

/// Speaks another language: an object of what is said in English, and what is said instead. English
/// where there is none.
pub fn speak(texts: &JsValue) {
    language::speak(Object::try_from(texts).map(learn));
}

fn learn(texts: &Object) -> &'static Catalogue {
    LEARNT.with(|learnt| {
        *learnt.get_or_init(|| {
            let pairs = Object::entries(texts);
            Catalogue::new(pairs.iter().filter_map(|pair| {
                let pair = Array::from(&pair);
                Some((pair.get(0).as_string()?, pair.get(1).as_string()?))
            }))
        })
    })
}
