//! Opening, reading and losing ports.

use super::{
    Engine, State,
    ending::{refused, shut},
    run::{Run, Wire},
    talk::Talk,
    unfit,
};
use crate::{
    browser::{now, pause},
    message::{Link, PortId},
    serial::{self, Port, Read, Reader},
};
use encoderscope::{
    adapter::Made,
    finder::{Finder, Output},
};

/// The longest pause between two readers of a line that does nothing but fail, in milliseconds.
const LONGEST_PAUSE: f64 = 128.0;

/// How reading goes on.
enum Next {
    /// With the same reader.
    Read,
    /// With a new reader: a non-fatal error replaces the stream.
    Reader,
    /// Not at all, because the port is gone.
    Lost,
    /// Not at all, because nobody wants it any more.
    Stop,
}

impl Engine {
    /// Opens a port for reading.
    pub(super) fn begin_open(&self, port: PortId, profile: &str) {
        let interval = self.state.borrow().interval;
        let Ok(session) = Self::session(profile, interval) else {
            return self.set_link(unfit(profile));
        };
        self.set_link(Link::Opening);
        let baud = session.decoder().profile().baud;
        self.open(port, baud, None, move |engine, wire| {
            engine.start(session, wire, interval, &serial::kind(port));
        });
    }

    /// Opens a port for a search, at the first baud rate that it asks for.
    pub(super) fn begin_search(&self, port: PortId) {
        let makes = |baud| !matches!(serial::made(port, baud), Made::Not(_));
        let mut finder = Finder::through(makes);
        {
            let mut state = self.state.borrow_mut();
            state.tally.renew(now(), &serial::kind(port));
            state.tally.searched(&finder);
        }
        self.set_link(Link::Searching);
        if let Some(Output::Open(baud)) = finder.poll_output() {
            self.search(port, finder, baud, None);
        }
    }

    /// Goes on with a search at another baud rate.
    pub(super) fn search_at(&self, baud: u32) {
        let run = {
            let mut state = self.state.borrow_mut();
            state.generation += 1;
            state.run.take()
        };
        if let Some(Run {
            talk: Some(Talk::Find(finder, Some(port))),
            wire,
            ..
        }) = run
        {
            self.search(port, finder, baud, Some(wire));
        }
    }

    fn search(&self, port: PortId, mut finder: Finder, baud: u32, before: Option<Wire>) {
        self.open(port, baud, before, move |engine, wire| {
            finder.handle_opened(now());
            let talk = Talk::Find(finder, Some(port));
            {
                let mut state = engine.state.borrow_mut();
                state.tally.listen(now(), baud);
                state.run = Some(Run::searching(wire, talk, now()));
            }
            engine.pump();
        });
    }

    /// Opens a port, after closing what was open before, and reads it. Opening may take for ever,
    /// so nothing waits for it.
    fn open(
        &self,
        port: PortId,
        baud: u32,
        before: Option<Wire>,
        begin: impl FnOnce(&Self, Wire) + 'static,
    ) {
        let generation = {
            let mut state = self.state.borrow_mut();
            state.opening = Some((port, state.generation));
            state.generation
        };
        let engine = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            shut(before).await;
            let watching = engine.clone();
            let gone = move || {
                let engine = watching.clone();
                wasm_bindgen_futures::spawn_local(async move { engine.lose(generation).await });
            };
            let opened = Port::open(port, baud, gone).await;
            let current = engine.state.borrow().generation == generation;
            match opened {
                Ok(port) if current => {
                    engine.opened(generation);
                    begin(&engine, Wire::Port { port, reader: None });
                    engine.read(generation).await;
                }
                Ok(port) => {
                    port.close().await;
                    engine.opened(generation);
                }
                Err(error) => {
                    engine.opened(generation);
                    if current {
                        engine.state.borrow_mut().tally.interrupted();
                        engine.set_link(refused(&error));
                    }
                }
            }
            engine.kick();
        });
    }

    /// An opening has come to its end.
    fn opened(&self, generation: u32) {
        let opening = &mut self.state.borrow_mut().opening;
        opening.take_if(|(_, opening)| *opening == generation);
    }

    /// Reads the port until it is closed or lost.
    async fn read(&self, generation: u32) {
        let mut wait = 0.0;
        while let Some(reader) = self.next_reader(generation) {
            let next = loop {
                let read = reader.read().await;
                if let Read::Bytes(_) = read {
                    wait = 0.0;
                }
                match self.take(generation, read) {
                    Next::Read => {}
                    next => break next,
                }
            };
            match next {
                Next::Read | Next::Reader => reader.release(),
                Next::Lost => break,
                Next::Stop => return,
            }
            // The stream of a broken line may fail as soon as it is read, for ever.
            pause(wait).await;
            wait = (2.0 * wait).clamp(1.0, LONGEST_PAUSE);
        }
        self.lose(generation).await;
    }

    /// A reader of the port; the one before it has been let go.
    fn next_reader(&self, generation: u32) -> Option<Reader> {
        let mut state = self.state.borrow_mut();
        if state.generation != generation {
            return None;
        }
        match &mut state.run {
            Some(Run {
                wire: Wire::Port { port, reader },
                ..
            }) => {
                *reader = port.reader();
                reader.clone()
            }
            _ => None,
        }
    }

    fn take(&self, generation: u32, read: Read) -> Next {
        let mut state = self.state.borrow_mut();
        if state.generation != generation {
            return Next::Stop;
        }
        let next = match read {
            Read::Bytes(bytes) => {
                let now = now();
                let State { run, tally, .. } = &mut *state;
                if let Some(run) = run {
                    run.wake(now, tally);
                    run.take(now, &bytes, tally);
                }
                Next::Read
            }
            Read::LineError(error) => {
                state.tally.line_error(now(), error);
                Next::Reader
            }
            // Nobody here has closed it: that would be another generation.
            Read::Lost | Read::Closed => return Next::Lost,
        };
        drop(state);
        self.pump();
        next
    }

    /// The port went away, perhaps while it was being opened.
    async fn lose(&self, generation: u32) {
        let wire = {
            let mut state = self.state.borrow_mut();
            if state.generation != generation || state.busy {
                return;
            }
            state.busy = true;
            state.opening = None;
            state.let_go("lost")
        };
        self.set_link(Link::Lost);
        shut(wire).await;
        self.work().await;
    }
}
