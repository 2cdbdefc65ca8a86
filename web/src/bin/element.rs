//! The smallest module: what `<encoder-frame>` needs of the core, and nothing of a browser.
//!
//! Only text goes in and out, views as JSON: that takes less room than objects made one by one.

// Without this the standard library's start of a program comes in.
#![no_main]

use encoderscope::{
    decode::Decoder,
    dump::Direction,
    format::{Format, Medium},
    profile::Profile,
    record::{Record, Value},
    sketch::{Checks, Sketch},
};
use wasm_bindgen::prelude::*;

/// What stands between names and values that are handed over.
const BREAK: char = '\0';

/// The names of all parameters of a profile, with spaces between.
#[wasm_bindgen]
pub fn parameters() -> String {
    let mut names = vec!["format", "model"];
    for format in Format::ALL.iter().chain([&Format::Own]) {
        for name in format.parameters() {
            if !names.contains(name) {
                names.push(name);
            }
        }
    }
    names.join(" ")
}

/// A frame that is shown and changed, or why it is none.
#[wasm_bindgen]
pub struct Paper(Result<Sketch, String>);

#[wasm_bindgen]
impl Paper {
    /// A frame in digits, or the example of the profile. In `profile` names and values take
    /// turns, with a NUL between; `direction` is empty where it is not known.
    #[expect(
        clippy::needless_pass_by_value,
        reason = "wasm-bindgen lends no optional text"
    )]
    #[wasm_bindgen(constructor)]
    pub fn new(profile: &str, frame: Option<String>, direction: &str) -> Self {
        Self(sketch(profile, frame.as_deref(), direction))
    }

    /// Turns a bit over; `checks` that `stay` are not computed again.
    pub fn flip(&mut self, index: usize, checks: &str) {
        let checks = match checks {
            "stay" => Checks::Stay,
            _ => Checks::Follow,
        };
        if let Ok(sketch) = &mut self.0 {
            sketch.flip(index, checks);
        }
    }

    /// Computes all checks again.
    pub fn mend(&mut self) {
        if let Ok(sketch) = &mut self.0 {
            sketch.mend();
        }
    }

    /// What is to be shown, as JSON: the frame, or an `error`.
    pub fn view(&self) -> String {
        let view = match &self.0 {
            Ok(sketch) => view(sketch),
            Err(why) => Record::new().with("error", why.as_str()),
        };
        view.to_string()
    }
}

fn sketch(profile: &str, frame: Option<&str>, direction: &str) -> Result<Sketch, String> {
    let mut words = profile.split(BREAK);
    let pairs = core::iter::from_fn(|| Some((words.next()?, words.next()?)));
    let profile = Profile::parse(pairs).map_err(|why| why.to_string())?;
    let decoder = Decoder::new(profile).map_err(|why| why.to_string())?;
    let direction = match direction {
        "" => None,
        "sent" => Some(Direction::Sent),
        "received" => Some(Direction::Received),
        _ => {
            return Err(format!(
                "direction: \"{direction}\" is not known; known: sent received"
            ));
        }
    };
    match frame {
        Some(text) => {
            Sketch::of_digits(decoder, text, direction).map_err(|why| format!("frame: {why}"))
        }
        None => Sketch::example(decoder, direction.unwrap_or(Direction::Received))
            .ok_or_else(|| "direction: nothing is sent to such an encoder".to_string()),
    }
}

fn view(sketch: &Sketch) -> Record {
    let bits = sketch.bits();
    let digits: String = (0..bits.len())
        .map(|index| if bits.bit(index) { '1' } else { '0' })
        .collect();
    let notes = sketch.notes();
    let notes = notes.iter().map(|note| note.record().into()).collect();
    let is_clocked = sketch.decoder().profile().medium() == Medium::Bits;
    Record::new()
        .with("title", sketch.kind().title.as_str())
        .with("frame", sketch.text())
        .with("bits", digits)
        .with("clocked", is_clocked)
        .with("notes", Value::List(notes))
        .with("record", sketch.frame().record())
}
