//! Replaying a recording: what was said on the line is said again to a session that reads along,
//! at the recording's own time, so that everything the page shows is made as it was then.

mod compare;
mod player;

use super::{Engine, Order, State};
use crate::{
    browser::now,
    message::{Answer, Link, Replay, Snapshot},
    store,
};
use encoderscope::{language::t, session::Micros};
use js_sys::JSON;
use player::{Player, Stage};
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{Blob, File};

/// So much of a file is read at once, in bytes.
const PIECE: f64 = 1_048_576.0;
/// So long a replay works before others get their turn.
const TURN: Micros = 8_000;

pub(super) use player::Player as Replayed;

impl Engine {
    /// Begins to replay a recording, or the file that came with the wish.
    pub(super) fn replay(&self, name: String, profile: String, file: Option<JsValue>) {
        let engine = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            let file: Option<File> = file.and_then(|file| file.dyn_into().ok());
            let blob = match file {
                Some(file) => Some(Blob::from(file)),
                None => engine.recording(&name).await,
            };
            match blob {
                Some(blob) => {
                    let player = Player::new(name, blob, profile);
                    engine.state.borrow_mut().asked = Some(Order::Replay(Box::new(player)));
                    engine.kick();
                    engine.list();
                }
                None => engine.fault(t("This recording is not there any more.")),
            }
        });
    }

    /// Replays, from the beginning.
    pub(super) fn begin_replay(&self, player: Player) {
        {
            let mut state = self.state.borrow_mut();
            state.tally.renew(0, "");
            state.tally.forget_progress();
            state.tally.transcript().replays = true;
            state.player = Some(player);
        }
        self.set_link(Link::Waiting);
    }

    /// Goes on at a part of the file, 0…1.
    pub(super) fn seek(&self, part: f64) {
        let mut state = self.state.borrow_mut();
        let State { player, tally, .. } = &mut *state;
        let Some(player) = player else {
            return;
        };
        player.seek(part, now());
        tally.renew(0, "");
        state.saved = None;
        state.run = None;
        state.generation += 1;
        drop(state);
        self.set_link(Link::Waiting);
    }

    /// Reads the next piece of the file that is replayed.
    pub(super) fn feed(&self) {
        let (part, generation) = {
            let mut state = self.state.borrow_mut();
            let generation = state.generation;
            let part = state.player.as_mut().and_then(Player::next_piece);
            (part, generation)
        };
        let Some(part) = part else {
            return;
        };
        let engine = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            let bytes = store::bytes(&part).await;
            let fault = bytes.is_err();
            let report = {
                let mut state = engine.state.borrow_mut();
                if state.generation != generation {
                    return;
                }
                let Some(player) = &mut state.player else {
                    return;
                };
                player.push(&bytes.unwrap_or_default());
                player.report()
            };
            if fault {
                engine.fault(t("The file cannot be read any more."));
            }
            if let Some(text) = report {
                engine.open_report(text);
            }
            engine.pump();
        });
    }

    /// A support file: shows what the page showed when it was made.
    fn open_report(&self, text: String) {
        let parsed = JSON::parse(&text).unwrap_or_default();
        let snapshot = crate::browser::property(&parsed, "snapshot");
        let snapshot = serde_wasm_bindgen::from_value::<Snapshot>(snapshot).ok();
        {
            let mut state = self.state.borrow_mut();
            state.saved = snapshot;
            state.tally.touch();
            if let Some(player) = &mut state.player {
                player.set_speed(0.0, now());
            }
        }
        self.hand(Answer::Report(text), None);
    }
}

impl State {
    pub(super) const fn is_replaying(&self) -> bool {
        self.player.is_some()
    }

    /// The time on the line: that of the recording where one is replayed.
    pub(super) fn time(&self) -> Micros {
        self.player.as_ref().map_or_else(now, Player::time)
    }

    /// Replays at another speed; 0 holds.
    pub(super) fn play_at(&mut self, speed: f64) {
        if let Some(player) = &mut self.player {
            player.set_speed(speed, now());
            if speed > 0.0 {
                self.saved = None;
            }
        }
    }

    /// Lets a replay go on; returns whether it wants more of its file.
    pub(super) fn play(&mut self, now: Micros) -> bool {
        let Self {
            player: Some(player),
            run,
            tally,
            link,
            ..
        } = self
        else {
            return false;
        };
        let mut stage = Stage { run, tally, link };
        let due = player.play(&mut stage, now, TURN);
        let fault = player.fault();
        if let (Some(due), Some(timer)) = (due, &mut self.timer) {
            timer.wake_by(due);
        }
        let hungry = player.is_hungry();
        if let Some(fault) = fault {
            (self.hand)(Answer::Fault(format!("{fault}.")), None);
        }
        hungry
    }

    /// How the replay goes.
    pub(super) fn replay_shown(&self) -> Option<Replay> {
        self.player.as_ref().map(Player::shown)
    }
}
