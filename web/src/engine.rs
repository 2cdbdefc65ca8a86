//! The engine: drives a session over a port or against the built-in encoder, and keeps what
//! the page shows. It runs in a dedicated worker, or on the page where it must.

mod plot;
mod run;

use crate::{
    browser::{Timer, error_text, now},
    link,
    message::{FromEngine, Link, PortId, STILL, Setting, ToEngine},
    serial::{Port, Read, Reader},
    tally::Tally,
};
use encoderscope::{
    decode::Decoder,
    emulator::{Emulator, Shaft},
    sequence::Runner,
    session::{Micros, Session},
};
use run::{Run, Wire};
use std::{cell::RefCell, rc::Rc};
use wasm_bindgen::JsValue;

/// The built-in encoder is asked a thousand times a second.
const DEMO_INTERVAL: Micros = 1_000;

/// The engine; clones share one state.
#[derive(Clone)]
pub struct Engine {
    state: Rc<RefCell<State>>,
}

struct State {
    post: Box<dyn Fn(FromEngine)>,
    timer: Option<Timer>,
    link: Link,
    run: Option<Run>,
    tally: Tally,
    /// The page has drawn and waits for a snapshot.
    wanted: bool,
    /// What the page has asked for and nobody has begun.
    asked: Option<ToEngine>,
    /// What has been asked is being done.
    busy: bool,
    /// A port is being opened.
    opening: bool,
    /// Counts openings, so that what belongs to an earlier one can be told.
    generation: u32,
}

/// How reading goes on.
enum Next {
    /// With the same reader.
    Read,
    /// With a new reader: a non-fatal error replaces the stream.
    Reader,
    /// Not at all.
    Stop,
}

impl std::fmt::Debug for Engine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Engine").finish_non_exhaustive()
    }
}

impl Engine {
    /// An engine that answers through `post`.
    pub fn new(post: impl Fn(FromEngine) + 'static) -> Self {
        let engine = Self {
            state: Rc::new(RefCell::new(State {
                post: Box::new(post),
                timer: None,
                link: Link::Closed,
                run: None,
                tally: Tally::new(now()),
                wanted: true,
                asked: None,
                busy: false,
                opening: false,
                generation: 0,
            })),
        };
        let weak = Rc::downgrade(&engine.state);
        let timer = Timer::new(move || {
            if let Some(state) = weak.upgrade() {
                let mut state = state.borrow_mut();
                if let Some(timer) = &mut state.timer {
                    timer.fired();
                }
                state.pump();
            }
        });
        engine.state.borrow_mut().timer = Some(timer);
        engine
    }

    /// Does what the page asks.
    pub fn handle(&self, message: ToEngine) {
        let mut state = self.state.borrow_mut();
        match message {
            ToEngine::Next => state.wanted = true,
            ToEngine::Set(setting) => state.begin(setting),
            ToEngine::StopSetting => state.stop(),
            ToEngine::ForgetSetting => state.tally.forget_progress(),
            ToEngine::Turn(speed) => state.turn(speed),
            ToEngine::DemoNoise(counts) => state.demo_noise(counts),
            ToEngine::Plot(request) => state.plot(&request),
            ToEngine::Rest => state.rest(),
            ToEngine::Open { .. } | ToEngine::Demo { .. } | ToEngine::Close => {
                state.asked = Some(message);
                drop(state);
                return self.kick();
            }
        }
        state.pump();
    }

    /// Starts doing what has been asked, unless that is being done; of what is asked meanwhile,
    /// only the last counts.
    fn kick(&self) {
        let mut state = self.state.borrow_mut();
        if state.asked.is_some() && !state.busy {
            state.busy = true;
            let engine = self.clone();
            wasm_bindgen_futures::spawn_local(async move { engine.work().await });
        }
    }

    async fn work(&self) {
        loop {
            let Some(message) = self.state.borrow_mut().asked.take() else {
                break;
            };
            self.close().await;
            match message {
                ToEngine::Open { .. } if self.state.borrow().opening => {
                    // A port cannot be opened twice; when it is open or refused, this goes on.
                    self.state.borrow_mut().asked = Some(message);
                    self.set_link(Link::Opening);
                    break;
                }
                ToEngine::Open { port, profile } => self.begin_open(port, &profile),
                ToEngine::Demo { profile } => self.demo(&profile),
                _ => self.set_link(Link::Closed),
            }
        }
        self.state.borrow_mut().busy = false;
    }

    fn set_link(&self, link: Link) {
        let mut state = self.state.borrow_mut();
        state.link = link;
        state.tally.touch();
        state.pump();
    }

    /// Closes what is open.
    async fn close(&self) {
        let run = {
            let mut state = self.state.borrow_mut();
            state.generation += 1;
            let State { run, tally, .. } = &mut *state;
            if let Some(run) = run {
                run.abandon(tally);
            }
            run.take()
        };
        if let Some(Run {
            wire: Wire::Port { port, reader },
            ..
        }) = run
        {
            if let Some(reader) = reader {
                reader.cancel().await;
                reader.release();
            }
            port.close().await;
        }
    }

    fn session(profile: &str, interval: Micros) -> Result<(Session, Decoder), String> {
        let profile = link::profile(profile).map_err(|error| error.to_string())?;
        let decoder = Decoder::new(profile).map_err(|error| error.to_string())?;
        let session = Session::new(decoder.clone(), interval).map_err(|error| error.to_string())?;
        Ok((session, decoder))
    }

    fn demo(&self, profile: &str) {
        let made = Self::session(profile, DEMO_INTERVAL).and_then(|(session, decoder)| {
            let shaft = Shaft {
                start: 4.85,
                speed: 0.08,
                sway: 0.35,
                period: 11.0,
            };
            let emulator =
                Emulator::new(*decoder.profile(), shaft).map_err(|error| error.to_string())?;
            Ok((session, decoder, emulator))
        });
        match made {
            Ok((session, decoder, emulator)) => {
                let wire = Wire::Demo(Box::new(emulator));
                self.start(session, decoder, wire, DEMO_INTERVAL);
            }
            Err(reason) => self.set_link(Link::Unfit { reason }),
        }
    }

    fn start(&self, session: Session, decoder: Decoder, wire: Wire, interval: Micros) {
        let mut state = self.state.borrow_mut();
        state.tally = Tally::new(now());
        state.tally.start(decoder);
        state.run = Some(Run {
            session,
            interval,
            setting: None,
            lived: now(),
            wire,
            silent: 0,
            failing: 0,
            unasked: 0,
        });
        state.link = Link::Waiting;
        state.pump();
    }

    /// Opening may take for ever, so nothing waits for it.
    fn begin_open(&self, port: PortId, profile: &str) {
        let (session, decoder) = match Self::session(profile, 0) {
            Ok(made) => made,
            Err(reason) => return self.set_link(Link::Unfit { reason }),
        };
        self.set_link(Link::Opening);
        let generation = {
            let mut state = self.state.borrow_mut();
            state.opening = true;
            state.generation
        };
        let engine = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            let opened = Port::open(port, decoder.profile().baud).await;
            let current = engine.state.borrow().generation == generation;
            match opened {
                Ok(port) if current => {
                    engine.state.borrow_mut().opening = false;
                    engine.start(session, decoder, Wire::Port { port, reader: None }, 0);
                    engine.read(generation).await;
                }
                Ok(port) => {
                    port.close().await;
                    engine.state.borrow_mut().opening = false;
                }
                Err(error) => {
                    engine.state.borrow_mut().opening = false;
                    if current {
                        engine.set_link(refused(&error));
                    }
                }
            }
            engine.kick();
        });
    }

    /// Reads the port until it is closed or lost.
    async fn read(&self, generation: u32) {
        while let Some(reader) = self.next_reader(generation) {
            loop {
                let read = reader.read().await;
                match self.take(generation, read) {
                    Next::Read => {}
                    Next::Reader => break,
                    Next::Stop => return,
                }
            }
            reader.release();
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
        match read {
            Read::Bytes(bytes) => {
                let now = now();
                let State { run, tally, .. } = &mut *state;
                tally.received(bytes.len());
                if let Some(run) = run {
                    run.take(now, &bytes, tally);
                }
                state.pump();
                Next::Read
            }
            Read::LineError => {
                state.tally.line_error();
                Next::Reader
            }
            // A lost port has no further stream, so asking for a reader tells.
            Read::Lost => Next::Reader,
            Read::Closed => Next::Stop,
        }
    }

    /// The port went away.
    async fn lose(&self, generation: u32) {
        {
            let mut state = self.state.borrow_mut();
            if state.generation != generation || state.busy {
                return;
            }
            state.busy = true;
        }
        self.close().await;
        self.set_link(Link::Lost);
        self.work().await;
    }
}

fn refused(error: &JsValue) -> Link {
    let (name, message) = error_text(error);
    let reason = if name == "InvalidStateError" {
        "The port is already open in another tab of this page.".into()
    } else {
        message
    };
    Link::Refused { reason }
}

impl State {
    /// Begins a sequence with the encoder that is being read.
    fn begin(&mut self, setting: Setting) {
        let Some(run) = &mut self.run else {
            return self.tally.refuse(setting, "Nothing is connected.");
        };
        if run.setting.is_some() {
            return;
        }
        let still = self.tally.moved(now()).is_some_and(|moved| moved < STILL);
        if setting.needs_rest() && !still {
            let why = "The shaft must stand still for a second. Nothing was sent.";
            return self.tally.refuse(setting, why);
        }
        match Runner::new(run.session.decoder(), setting.change(), now()) {
            Some(runner) => {
                run.session.rest();
                self.tally.begin(setting, runner.total());
                run.setting = Some((setting, runner));
            }
            None => self.tally.refuse(
                setting,
                "This encoder has no such sequence. Nothing was sent.",
            ),
        }
    }

    /// Turns the shaft of the built-in encoder.
    fn turn(&mut self, speed: f64) {
        if let Some(Run {
            wire: Wire::Demo(emulator),
            ..
        }) = &mut self.run
        {
            emulator.shaft = emulator.shaft.going_on(now(), speed);
        }
    }

    /// Ends a sequence before its next command.
    fn stop(&mut self) {
        if let Some((_, runner)) = self.run.as_mut().and_then(|run| run.setting.as_mut()) {
            runner.stop();
        }
    }

    /// Lets the session speak, answers for the built-in encoder, and posts a snapshot.
    fn pump(&mut self) {
        let now = now();
        let mut wake = None;
        if let Some(run) = &mut self.run {
            let link = run.advance(now, &mut self.tally);
            wake = Some(match &run.wire {
                Wire::Port { .. } => run.deadline(),
                Wire::Demo(emulator) => emulator
                    .deadline()
                    .unwrap_or(Micros::MAX)
                    .min(run.deadline()),
            });
            if let Some(link) = link {
                self.link = link;
            }
        }
        if let (Some(at), Some(timer)) = (wake, &mut self.timer) {
            timer.wake_by(at);
        }
        if self.wanted && self.tally.changed() {
            self.wanted = false;
            let mut snapshot = self.tally.snapshot(now);
            snapshot.link = self.link.clone();
            if self.run.is_none() {
                snapshot.rate = 0.0;
            }
            (self.post)(FromEngine::Snapshot(Box::new(snapshot)));
        }
    }
}
