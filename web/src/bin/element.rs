//! The smallest module: what `<encoder-frame>` needs of the core, and nothing of a browser.
//!
//! Only text goes in and out, views as JSON: that takes less room than objects made one by one.

// Without this the standard library's start of a program comes in.
#![no_main]

use encoderscope::{
    decode::Decoder,
    dump::Direction,
    format::{Format, Medium},
    language::{self, Catalogue, t},
    profile::Profile,
    record::{Record, Value},
    sketch::{Checks, Sketch},
    text,
};
use std::cell::Cell;
use wasm_bindgen::prelude::*;

// Half the size of the one that comes with Rust.
#[global_allocator]
static ALLOCATOR: talc::wasm::WasmDynamicTalc = talc::wasm::new_wasm_dynamic_allocator();

/// What stands between names and values of attributes.
const BREAK: char = '\0';

thread_local! {
    static LEARNT: Cell<Option<&'static Catalogue>> = const { Cell::new(None) };
}

/// Learns what is said in another language ([`Catalogue::read`]).
#[wasm_bindgen]
pub fn learn(texts: String) {
    LEARNT.set(Some(Catalogue::read(texts)));
}

/// Speaks the language that has been learnt from now on, or English again.
#[wasm_bindgen]
pub fn speak(other: bool) {
    language::speak(LEARNT.get().filter(|_| other));
}

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
    /// What attributes say: the parameters of a profile, a `frame` in digits or without one the
    /// example, and its `direction`. Names and values take turns, with a NUL between.
    #[wasm_bindgen(constructor)]
    pub fn new(attributes: &str) -> Self {
        Self(sketch(attributes))
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

fn sketch(attributes: &str) -> Result<Sketch, String> {
    let mut words = attributes.split(BREAK);
    let pairs: Vec<_> = core::iter::from_fn(|| Some((words.next()?, words.next()?))).collect();
    let find = |wanted: &str| {
        pairs
            .iter()
            .find(|pair| pair.0 == wanted)
            .map(|pair| pair.1)
    };
    let parameters = pairs.iter().copied();
    let parameters = parameters.filter(|(name, _)| !matches!(*name, "frame" | "direction"));
    let profile = Profile::parse(parameters).map_err(|why| why.to_string())?;
    let decoder = Decoder::new(profile).map_err(|why| why.to_string())?;
    let direction = match find("direction") {
        None => None,
        Some("sent") => Some(Direction::Sent),
        Some("received") => Some(Direction::Received),
        Some(other) => {
            return Err(text!(
                "direction: \"{}\" is not known; known: sent received",
                other
            ));
        }
    };
    match find("frame") {
        Some(text) => {
            Sketch::of_digits(decoder, text, direction).map_err(|why| format!("frame: {why}"))
        }
        None => Sketch::example(decoder, direction.unwrap_or(Direction::Received))
            .ok_or_else(|| t("direction: nothing is sent to such an encoder").to_string()),
    }
}

fn view(sketch: &Sketch) -> Record {
    let bits = sketch.bits();
    let digits: String = (0..bits.len())
        .map(|index| if bits.bit(index) { '1' } else { '0' })
        .collect();
    let notes = sketch.notes();
    let notes = notes.iter().map(|note| note.record().into()).collect();
    // What is wrong, for people; the record is the same in every language.
    let frame = sketch.frame();
    let faults = frame.faults().into_iter();
    let faults = faults.map(|fault| Value::Text(fault.kind.to_string()));
    // The kind was named in the language of its time.
    let kind = sketch.kind();
    let mut kinds = sketch.decoder().frame_kinds().into_iter();
    let title = kinds.find(|known| known.name == kind.name);
    let title = title.map_or_else(|| kind.title.clone(), |known| known.title);
    let is_clocked = sketch.decoder().profile().medium() == Medium::Bits;
    Record::new()
        .with("title", title.as_str())
        .with("frame", sketch.text())
        .with("bits", digits)
        .with("clocked", is_clocked)
        .with("notes", Value::List(notes))
        .with("faults", Value::List(faults.collect()))
        .with("record", frame.record())
}
