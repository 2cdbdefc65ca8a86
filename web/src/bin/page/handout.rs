//! What leaves the page: text on the clipboard, and files.

use encoderscope::language::t;
use js_sys::Array;
use leptos::prelude::*;
use std::time::Duration;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{Blob, HtmlAnchorElement, Url};

/// Puts text on the clipboard, then says whether it is there.
pub(crate) fn copy(text: String, said: RwSignal<Option<String>>, success: &'static str) {
    leptos::task::spawn_local(async move {
        let clipboard = window().navigator().clipboard();
        let written = wasm_bindgen_futures::JsFuture::from(clipboard.write_text(&text)).await;
        said.set(Some(match written {
            Ok(_) => success.into(),
            Err(_) => t("The browser does not let the page use the clipboard.").into(),
        }));
    });
}

/// Lets the user keep a file.
pub(crate) fn save(file: &Blob, name: &str) {
    let Ok(address) = Url::create_object_url_with_blob(file) else {
        return;
    };
    let link = document()
        .create_element("a")
        .ok()
        .and_then(|element| element.dyn_into::<HtmlAnchorElement>().ok());
    if let Some(link) = link {
        link.set_href(&address);
        link.set_download(name);
        link.click();
    }
    // The browser has taken the file by then.
    set_timeout(
        move || {
            let _ = Url::revoke_object_url(&address);
        },
        Duration::from_secs(60),
    );
}

/// Lets the user keep text as a file.
pub(crate) fn save_text(text: &str, name: &str) {
    let parts = Array::of1(&JsValue::from_str(text));
    if let Ok(file) = Blob::new_with_str_sequence(&parts) {
        save(&file, name);
    }
}
