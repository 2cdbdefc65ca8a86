//! The page's end of the engine: a dedicated worker where it can reach serial ports, else an
//! engine on the page itself.

use crate::plot::Feed;
use encoderscope_web::{
    engine::Engine,
    message::{FromEngine, Snapshot, ToEngine},
    serial,
};
use leptos::prelude::*;
use std::{cell::RefCell, rc::Rc};
use wasm_bindgen::{JsCast, prelude::Closure};
use web_sys::{MessageEvent, Worker};

/// Sends messages to the engine; clones share one engine.
#[derive(Clone)]
pub(crate) struct Connection {
    inner: Rc<RefCell<Inner>>,
    feed: Feed,
}

struct Inner {
    worker: Option<Worker>,
    /// Made when the worker turns out to be of no use.
    local: Option<Engine>,
    /// Whether the worker has said what it can do.
    known: bool,
    waiting: Vec<ToEngine>,
}

impl Connection {
    /// Listens to the worker, where there is one; snapshots go into `snapshot`, answers to the plot into `feed`.
    /// A worker that breaks down is replaced by an engine on the page, and `broken` is set.
    pub(crate) fn new(
        worker: Option<Worker>,
        snapshot: RwSignal<Snapshot>,
        feed: Feed,
        broken: RwSignal<bool>,
    ) -> Self {
        let connection = Self {
            inner: Rc::new(RefCell::new(Inner {
                worker: worker.clone(),
                local: None,
                known: false,
                waiting: Vec::new(),
            })),
            feed,
        };
        match worker {
            Some(worker) => connection.listen(&worker, snapshot, broken),
            None => connection.run_here(snapshot),
        }
        connection
    }

    fn listen(&self, worker: &Worker, snapshot: RwSignal<Snapshot>, broken: RwSignal<bool>) {
        let connection = self.clone();
        let on_message = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
            if let Ok(message) = serde_wasm_bindgen::from_value::<FromEngine>(event.data()) {
                connection.receive(message, snapshot);
            }
        });
        worker.set_onmessage(Some(on_message.as_ref().unchecked_ref()));
        on_message.forget();
        let connection = self.clone();
        let on_error = Closure::<dyn FnMut()>::new(move || {
            connection.run_here(snapshot);
            broken.set(true);
        });
        worker.set_onerror(Some(on_error.as_ref().unchecked_ref()));
        on_error.forget();
    }

    fn receive(&self, message: FromEngine, snapshot: RwSignal<Snapshot>) {
        match message {
            // Where the page could reach a port and the worker cannot, the engine runs here.
            FromEngine::Hello { serial: false } if serial::available().is_ok() => {
                self.run_here(snapshot);
            }
            FromEngine::Hello { .. } => self.ready(),
            FromEngine::Plot(plot) => self.feed.plot.set(*plot),
            FromEngine::Rest(rest) => self.feed.rest.set(rest.map(|rest| *rest)),
            FromEngine::Snapshot(new) => {
                snapshot.set(*new);
                // The next one is wanted when this one has been drawn.
                let connection = self.clone();
                request_animation_frame(move || connection.send(ToEngine::Next));
            }
        }
    }

    fn run_here(&self, snapshot: RwSignal<Snapshot>) {
        let connection = self.clone();
        let engine = Engine::new(move |message| {
            let connection = connection.clone();
            // The engine must have finished its step before it is spoken to again.
            leptos::task::spawn_local(async move { connection.receive(message, snapshot) });
        });
        {
            let mut inner = self.inner.borrow_mut();
            if let Some(worker) = inner.worker.take() {
                worker.terminate();
            }
            inner.local = Some(engine);
        }
        self.ready();
    }

    fn ready(&self) {
        let waiting = {
            let mut inner = self.inner.borrow_mut();
            inner.known = true;
            std::mem::take(&mut inner.waiting)
        };
        for message in waiting {
            self.send(message);
        }
    }

    /// Sends a message; before the engine runs, it is kept.
    pub(crate) fn send(&self, message: ToEngine) {
        let mut inner = self.inner.borrow_mut();
        if !inner.known {
            inner.waiting.push(message);
        } else if let Some(engine) = &inner.local {
            engine.handle(message);
        } else if let Some(worker) = &inner.worker
            && let Ok(message) = serde_wasm_bindgen::to_value(&message)
        {
            // A worker that is gone has reported its error already.
            let _ = worker.post_message(&message);
        }
    }
}
