//! Clock, timers and errors, the same in a worker and on the page.

use encoderscope::session::Micros;
use js_sys::{Array, Date, Function, Promise, Reflect};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::JsFuture;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = performance, js_name = now)]
    fn performance_now() -> f64;
    #[wasm_bindgen(js_name = setTimeout)]
    fn set_timeout(handler: &Function, milliseconds: f64) -> f64;
    #[wasm_bindgen(js_name = clearTimeout)]
    fn clear_timeout(id: f64);
}

#[wasm_bindgen]
extern "C" {
    /// The other end of a conversation: a worker, the page of a worker, or the end of a channel.
    #[derive(Clone, Debug)]
    pub type Peer;
    /// Says something.
    ///
    /// # Errors
    ///
    /// It cannot be copied.
    #[wasm_bindgen(method, catch, js_name = postMessage)]
    pub fn post(this: &Peer, message: &JsValue) -> Result<(), JsValue>;
    /// Hears what is said, as the `data` of a message event.
    #[wasm_bindgen(method, setter, js_name = onmessage)]
    pub fn set_heard(this: &Peer, listener: Option<&Function>);
    /// Hears of a breakdown.
    #[wasm_bindgen(method, setter, js_name = onerror)]
    pub fn set_broken(this: &Peer, listener: Option<&Function>);
    /// Ends the other end.
    #[wasm_bindgen(method)]
    pub fn terminate(this: &Peer);
}

/// The time 0 of [`now`], in microseconds since 1970.
#[must_use]
pub fn origin() -> Micros {
    let performance = property(&js_sys::global(), "performance");
    let origin = property(&performance, "timeOrigin").as_f64();
    (origin.unwrap_or_default() * 1000.0) as Micros
}

/// The system that the browser runs on, by its name.
#[must_use]
pub fn system() -> String {
    let navigator = property(&js_sys::global(), "navigator");
    let platform = property(&property(&navigator, "userAgentData"), "platform");
    let agent = property(&navigator, "userAgent").as_string();
    let agent = agent.unwrap_or_default();
    let known = ["Android", "Windows", "Mac OS", "CrOS", "Linux"];
    let named = || known.into_iter().find(|name| agent.contains(name));
    let platform = platform.as_string().filter(|name| !name.is_empty());
    platform.unwrap_or_else(|| named().unwrap_or("unknown").to_owned())
}

/// A time with its date, on the user's clock, from milliseconds since 1970.
#[must_use]
pub fn time_text(milliseconds: f64) -> String {
    let date = Date::new(&milliseconds.into());
    format!(
        "{}-{:02}-{:02} {:02}:{:02}:{:02}",
        date.get_full_year(),
        date.get_month() + 1,
        date.get_date(),
        date.get_hours(),
        date.get_minutes(),
        date.get_seconds()
    )
}

/// Microseconds since the worker or page was made.
#[must_use]
pub fn now() -> Micros {
    (performance_now() * 1000.0) as Micros
}

/// A timer that can be set again and again, with one callback.
#[derive(Debug)]
pub struct Timer {
    callback: Closure<dyn FnMut()>,
    set: Option<(f64, Micros)>,
}

impl Timer {
    /// A timer that calls `callback`.
    pub fn new(callback: impl FnMut() + 'static) -> Self {
        Self {
            callback: Closure::new(callback),
            set: None,
        }
    }

    /// Makes sure that the callback is called by `at`; it may be called earlier.
    pub fn wake_by(&mut self, at: Micros) {
        if let Some((id, earlier)) = self.set {
            if earlier <= at {
                return;
            }
            clear_timeout(id);
        }
        let wait = at.saturating_sub(now()) as f64 / 1000.0;
        let id = set_timeout(self.callback.as_ref().unchecked_ref(), wait.ceil());
        self.set = Some((id, at));
    }

    /// The callback has been called.
    pub fn fired(&mut self) {
        self.set = None;
    }
}

impl Drop for Timer {
    fn drop(&mut self) {
        if let Some((id, _)) = self.set {
            clear_timeout(id);
        }
    }
}

fn pause_of(milliseconds: f64) -> Promise {
    Promise::new(&mut |kept, _| {
        set_timeout(&kept, milliseconds);
    })
}

/// Lets others run for some milliseconds.
pub async fn pause(milliseconds: f64) {
    // A promise that a timer keeps cannot fail.
    let _ = JsFuture::from(pause_of(milliseconds)).await;
}

/// Waits until a promise is kept or broken, but for some milliseconds at most.
pub async fn settled(promise: &JsValue, at_most: f64) {
    let both = Array::of2(promise, &pause_of(at_most));
    // Whoever waits so does not care which it was.
    let _ = JsFuture::from(Promise::race(&both)).await;
}

/// A property of an object; undefined where there is none.
#[must_use]
pub fn property(object: &JsValue, name: &str) -> JsValue {
    Reflect::get(object, &name.into()).unwrap_or_default()
}

/// The name and the message of a thrown value.
#[must_use]
pub fn error_text(error: &JsValue) -> (String, String) {
    let text = |name| property(error, name).as_string().unwrap_or_default();
    (text("name"), text("message"))
}
