//! The engine: drives a session over a port or against the built-in encoder, and keeps what
//! the page shows. It runs in a dedicated worker, or on the page where it must.

mod ending;
mod line;
mod plot;
mod recorder;
mod replay;
mod run;
mod talk;
mod wishes;

use crate::{
    browser::{Timer, now, origin, system},
    link,
    message::{Answer, FromEngine, Link, PortId, Snapshot, ToEngine},
    tally::Tally,
    transcript::Transcript,
};
use encoderscope::{
    decode::Decoder,
    emulator::{Emulator, Shaft},
    finder::Finder,
    language::msg,
    profile::{Profile, ProfileError},
    session::{Micros, Session},
};
use ending::shut;
use recorder::Recorder;
use replay::Replayed;
use run::{Run, Todo, Wire};
use std::{cell::RefCell, rc::Rc};
use talk::Talk;
use wasm_bindgen::JsValue;

/// The built-in encoder is asked a thousand times a second.
const DEMO_INTERVAL: Micros = 1_000;
/// The adapter of the built-in encoder.
const BUILT_IN: &str = msg("built-in encoder");
/// Figures and the log are renewed so often: nobody reads them faster.
const SNAPSHOTS: Micros = 200_000;

/// The engine; clones share one state.
#[derive(Clone)]
pub struct Engine {
    state: Rc<RefCell<State>>,
}

struct State {
    post: Box<dyn Fn(FromEngine)>,
    /// Answers a wish, with a file beside it.
    hand: Box<dyn Fn(Answer, Option<JsValue>)>,
    timer: Option<Timer>,
    link: Link,
    /// Requests are so far apart.
    interval: Micros,
    run: Option<Run>,
    /// The recording that is replayed instead.
    player: Option<Replayed>,
    /// What a support file shows until it is replayed.
    saved: Option<Snapshot>,
    recorder: Recorder,
    tally: Tally,
    /// The page has drawn and waits for what is new.
    wanted: bool,
    /// Before this time no snapshot is made of frames alone.
    rested: Micros,
    /// What the page has asked for and nobody has begun.
    asked: Option<Order>,
    /// What has been asked is being done.
    busy: bool,
    /// The port that is being opened, and with which opening.
    opening: Option<(PortId, u32)>,
    /// Counts openings, so that what belongs to an earlier one can be told.
    generation: u32,
}

/// What is to be done with the link.
enum Order {
    /// What the page has asked for.
    Link(ToEngine),
    /// A recording is to be replayed in its place.
    Replay(Box<Replayed>),
}

impl std::fmt::Debug for Engine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Engine").finish_non_exhaustive()
    }
}

impl Engine {
    /// An engine that speaks through `post`, and answers wishes through `hand`.
    pub fn new(
        post: impl Fn(FromEngine) + 'static,
        hand: impl Fn(Answer, Option<JsValue>) + 'static,
    ) -> Self {
        let engine = Self {
            state: Rc::new(RefCell::new(State {
                post: Box::new(post),
                hand: Box::new(hand),
                timer: None,
                link: Link::Closed,
                interval: 0,
                run: None,
                player: None,
                saved: None,
                recorder: Recorder::default(),
                tally: Tally::new(now(), Transcript::new(origin(), &system())),
                wanted: true,
                rested: 0,
                asked: None,
                busy: false,
                opening: None,
                generation: 0,
            })),
        };
        let weak = Rc::downgrade(&engine.state);
        let timer = Timer::new(move || {
            if let Some(state) = weak.upgrade() {
                if let Some(timer) = &mut state.borrow_mut().timer {
                    timer.fired();
                }
                Self { state }.pump();
            }
        });
        engine.state.borrow_mut().timer = Some(timer);
        engine.look_for_remains();
        engine
    }

    /// Does what the page asks.
    pub fn handle(&self, message: ToEngine) {
        let mut state = self.state.borrow_mut();
        match message {
            ToEngine::Next => state.wanted = true,
            ToEngine::Ping => (state.post)(FromEngine::Pong),
            ToEngine::Log(filter) => state.tally.filter(filter),
            ToEngine::Open { .. }
            | ToEngine::Demo { .. }
            | ToEngine::Find { .. }
            | ToEngine::Close => {
                state.asked = Some(Order::Link(message));
                drop(state);
                return self.kick();
            }
        }
        drop(state);
        self.pump();
    }

    /// Lets the link go on, posts a snapshot, and does what a search wants.
    fn pump(&self) {
        let todo = self.state.borrow_mut().pump();
        self.list_ended();
        match todo {
            None => {}
            Some(Todo::Feed) => self.feed(),
            Some(Todo::Reopen(baud)) => self.search_at(baud),
            Some(Todo::Close) => {
                let close = Order::Link(ToEngine::Close);
                self.state.borrow_mut().asked.get_or_insert(close);
                self.kick();
            }
        }
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
            let Some(order) = self.state.borrow_mut().asked.take() else {
                break;
            };
            let wire = self.state.borrow_mut().let_go("closed");
            shut(wire).await;
            let message = match order {
                Order::Link(message) => message,
                Order::Replay(player) => {
                    self.begin_replay(*player);
                    continue;
                }
            };
            match message {
                ToEngine::Open { port, .. }
                | ToEngine::Find {
                    port: Some(port), ..
                } if self.is_opening(port) => {
                    // A port cannot be opened twice; when it is open or refused, this goes on.
                    self.state.borrow_mut().asked = Some(Order::Link(message));
                    self.set_link(Link::Opening);
                    break;
                }
                ToEngine::Open { port, profile } => self.begin_open(port, &profile),
                ToEngine::Demo { profile } => self.demo(&profile),
                ToEngine::Find {
                    port: Some(port), ..
                } => self.begin_search(port),
                ToEngine::Find {
                    port: None,
                    profile,
                } => self.search_demo(&profile),
                _ => self.set_link(Link::Closed),
            }
        }
        self.state.borrow_mut().busy = false;
    }

    fn set_link(&self, link: Link) {
        {
            let mut state = self.state.borrow_mut();
            let now = state.time();
            state.link = link;
            state.tell_link(now);
        }
        self.pump();
    }

    fn is_opening(&self, port: PortId) -> bool {
        let opening = self.state.borrow().opening;
        opening.is_some_and(|(other, _)| other == port)
    }

    fn session(profile: &str, interval: Micros) -> Result<Session, String> {
        let profile = link::profile(profile).map_err(|error| error.to_string())?;
        let decoder = Decoder::new(profile).map_err(|error| error.to_string())?;
        Session::new(decoder, interval).map_err(|error| error.to_string())
    }

    fn demo(&self, profile: &str) {
        let interval = self.state.borrow().interval.max(DEMO_INTERVAL);
        match Self::session(profile, interval) {
            Ok(session) => match emulator(session.decoder().profile()) {
                Ok(wire) => self.start(session, wire, interval, BUILT_IN),
                Err(_) => self.set_link(unfit(profile)),
            },
            Err(_) => self.set_link(unfit(profile)),
        }
    }

    /// Searches for the built-in encoder, as if nothing were known of it.
    fn search_demo(&self, profile: &str) {
        let made = link::profile(profile).and_then(|profile| emulator(&profile));
        match made {
            Ok(wire) => {
                let mut state = self.state.borrow_mut();
                state.tally.renew(now(), BUILT_IN);
                let talk = Talk::Find(Finder::new(), None);
                state.run = Some(Run::searching(wire, talk, now()));
                drop(state);
                self.set_link(Link::Searching);
            }
            Err(_) => self.set_link(unfit(profile)),
        }
    }

    fn start(&self, session: Session, wire: Wire, interval: Micros, adapter: &str) {
        {
            let mut state = self.state.borrow_mut();
            state.tally.renew(now(), adapter);
            state.tally.start(now(), session.decoder().clone());
            state.run = Some(Run::reading(wire, session, interval, now()));
        }
        self.set_link(Link::Waiting);
    }
}

/// The profile cannot be read over a serial line; why, in the language that is spoken.
fn unfit(profile: &str) -> Link {
    let emulated = || link::profile(profile).and_then(|profile| emulator(&profile));
    let reason = match Engine::session(profile, 0) {
        Ok(_) => emulated().err().map(|error| error.to_string()),
        Err(reason) => Some(reason),
    };
    Link::Unfit {
        profile: profile.into(),
        reason: reason.unwrap_or_default(),
    }
}

/// The built-in encoder: its shaft swings.
fn emulator(profile: &Profile) -> Result<Wire, ProfileError> {
    let shaft = Shaft {
        start: 4.85,
        speed: 0.08,
        sway: 0.35,
        period: 11.0,
    };
    Ok(Wire::Demo(Box::new(Emulator::new(*profile, shaft)?)))
}
