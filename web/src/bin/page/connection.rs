//! The page's end of the engine: a dedicated worker where it can reach serial ports, else an
//! engine on the page itself.

use crate::{Workers, app::after_picture, plot::Feed};
use encoderscope_web::{
    browser::Peer,
    message::{self, FromEngine, Shown, Snapshot, ToEngine},
    serial,
};
use js_sys::Array;
use leptos::prelude::*;
use std::{cell::RefCell, rc::Rc, time::Duration};
use wasm_bindgen::{JsCast, JsValue, prelude::Closure};
use web_sys::MessageEvent;

/// A worker is asked every second whether it is there; one that has not answered so often is gone.
/// A browser that ends a worker says nothing.
const UNANSWERED: u32 = 10;

/// Sends messages to the engine; clones share one engine.
#[derive(Clone)]
pub(crate) struct Connection {
    inner: Rc<RefCell<Inner>>,
    workers: StoredValue<Workers, LocalStorage>,
    texts: StoredValue<JsValue, LocalStorage>,
    snapshot: RwSignal<Snapshot>,
    feed: Feed,
    parcels: Rc<RefCell<Parcels>>,
}

/// Answers to wishes, which the first view does not know.
#[derive(Default)]
struct Parcels {
    heard: Option<Box<dyn Fn(Array)>>,
    /// What was said before anybody listened.
    waiting: Vec<Array>,
}

struct Inner {
    /// Nothing while an engine on the page is made.
    engine: Option<Peer>,
    /// Where the engine runs.
    seat: Seat,
    /// What was said before the engine ran; nothing from then on.
    waiting: Option<Vec<JsValue>>,
    /// How often a worker was asked since it spoke last.
    unanswered: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Seat {
    Worker,
    Page,
}

impl Connection {
    /// Starts the engine once the page has been drawn, in a worker where there are workers;
    /// snapshots go into `snapshot`, the rest of what it says into `feed`. A worker that breaks
    /// down is replaced by an engine on the page, and `broken` is set. The engine is told the texts of
    /// the language before anything else.
    pub(crate) fn new(
        workers: StoredValue<Workers, LocalStorage>,
        texts: StoredValue<JsValue, LocalStorage>,
        snapshot: RwSignal<Snapshot>,
        feed: Feed,
        broken: RwSignal<bool>,
    ) -> Self {
        let connection = Self {
            inner: Rc::new(RefCell::new(Inner {
                engine: None,
                seat: Seat::Worker,
                waiting: Some(Vec::new()),
                unanswered: 0,
            })),
            workers,
            texts,
            snapshot,
            feed,
            parcels: Rc::default(),
        };
        let starting = connection.clone();
        after_picture(move || starting.start(broken));
        connection
    }

    fn start(&self, broken: RwSignal<bool>) {
        let Ok(worker) = self.workers.with_value(Workers::engine) else {
            return self.run_here();
        };
        self.listen(&worker);
        let moved = self.clone();
        let on_error = Closure::<dyn FnMut()>::new(move || {
            moved.run_here();
            broken.set(true);
        });
        worker.set_broken(Some(on_error.as_ref().unchecked_ref()));
        on_error.forget();
        self.inner.borrow_mut().engine = Some(worker);
        let watching = self.clone();
        set_interval(move || watching.watch(broken), Duration::from_secs(1));
    }

    /// Sees to it that the worker is there, once it has begun.
    fn watch(&self, broken: RwSignal<bool>) {
        let unanswered = {
            let mut inner = self.inner.borrow_mut();
            if inner.seat == Seat::Page || inner.waiting.is_some() {
                return;
            }
            inner.unanswered += 1;
            inner.unanswered
        };
        if unanswered <= UNANSWERED {
            self.send(&ToEngine::Ping);
        } else {
            self.run_here();
            broken.set(true);
        }
    }

    fn listen(&self, engine: &Peer) {
        let connection = self.clone();
        let on_message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
            let data = event.data();
            if let Ok(message) = serde_wasm_bindgen::from_value::<FromEngine>(data.clone()) {
                connection.receive(message);
            } else if let Ok(parcel) = data.dyn_into() {
                connection.take(parcel);
            }
        });
        engine.set_heard(Some(on_message.as_ref().unchecked_ref()));
        on_message.forget();
    }

    fn receive(&self, message: FromEngine) {
        self.inner.borrow_mut().unanswered = 0;
        match message {
            // Where the page could reach a port and the worker cannot, the engine runs here.
            FromEngine::Hello { serial: false }
                if serial::available().is_ok() && self.inner.borrow().seat == Seat::Worker =>
            {
                self.run_here();
            }
            FromEngine::Hello { .. } => self.ready(),
            FromEngine::Pong => {}
            FromEngine::Reading(reading) => {
                self.show(Some(reading));
                self.want_next();
            }
            FromEngine::Snapshot(new) => {
                self.show(new.reading);
                self.snapshot.set(*new);
                self.want_next();
            }
        }
    }

    /// Shows a reading; a shaft at rest is not drawn again.
    fn show(&self, reading: Option<Shown>) {
        if self.feed.reading.get_untracked() != reading {
            self.feed.reading.set(reading);
        }
    }

    /// More is wanted when this has been drawn.
    fn want_next(&self) {
        let connection = self.clone();
        request_animation_frame(move || connection.send(&ToEngine::Next));
    }

    fn run_here(&self) {
        {
            let mut inner = self.inner.borrow_mut();
            if let Some(worker) = inner.engine.take() {
                worker.terminate();
            }
            inner.seat = Seat::Page;
            inner.waiting.get_or_insert_default();
        }
        let connection = self.clone();
        leptos::task::spawn_local(async move {
            let workers = connection.workers.get_value();
            // Without the code there is no engine; the page has said what it cannot do.
            if let Ok(engine) = workers.engine_here().await {
                let engine: Peer = engine.unchecked_into();
                connection.listen(&engine);
                connection.inner.borrow_mut().engine = Some(engine);
            }
        });
    }

    fn ready(&self) {
        let waiting = self.inner.borrow_mut().waiting.take();
        let language = message::speak(&self.texts.get_value());
        for message in [language].into_iter().chain(waiting.unwrap_or_default()) {
            self.post(message);
        }
    }

    /// Sends a message; before the engine runs, it is kept.
    pub(crate) fn send(&self, message: &ToEngine) {
        if let Ok(message) = serde_wasm_bindgen::to_value(message) {
            self.post(message);
        }
    }

    pub(crate) fn post(&self, message: JsValue) {
        let mut inner = self.inner.borrow_mut();
        if let Some(waiting) = &mut inner.waiting {
            waiting.push(message);
        } else if let Some(engine) = &inner.engine {
            // A worker that is gone has reported its error already.
            let _ = engine.post(&message);
        }
    }

    fn take(&self, parcel: Array) {
        let mut parcels = self.parcels.borrow_mut();
        if parcels.heard.is_none() {
            parcels.waiting.push(parcel);
            return self.feed.parcels.set(true);
        }
        drop(parcels);
        if let Some(heard) = &self.parcels.borrow().heard {
            heard(parcel);
        }
    }

    /// Hears answers to wishes, and those that have come.
    pub(crate) fn hear(&self, heard: impl Fn(Array) + 'static) {
        let waiting = std::mem::take(&mut self.parcels.borrow_mut().waiting);
        for parcel in waiting {
            heard(parcel);
        }
        self.parcels.borrow_mut().heard = Some(Box::new(heard));
    }
}
