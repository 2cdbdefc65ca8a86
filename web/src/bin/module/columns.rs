//! Readings by the million: a typed array for each number instead of an object for each frame.

use crate::decoder;
use encoderscope::{
    columns::{Columns, Health},
    decode::{Decoder, Summary, Words},
    dump::Reader,
    format::Medium,
    framing::{Framer, Piece, PieceKind},
};
use js_sys::{Float64Array, Object, Reflect, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

/// Bytes that are taken over and decoded at once.
const CHUNK: u32 = 65_536;

/// Decodes input that comes in pieces into columns.
#[wasm_bindgen]
#[derive(Debug)]
pub struct ColumnReader {
    decoder: Decoder,
    framer: Framer,
    words: Option<Words>,
    text: Option<Reader>,
    chunk: Vec<u8>,
    columns: Columns,
    summary: Summary,
}

#[wasm_bindgen]
impl ColumnReader {
    /// A reader at the start of its input.
    #[wasm_bindgen(constructor)]
    pub fn new(profile: &JsValue) -> Result<Self, JsError> {
        Ok(Self {
            decoder: decoder(profile)?,
            framer: Framer::at_start(),
            words: None,
            text: None,
            chunk: Vec::new(),
            columns: Columns::default(),
            summary: Summary::default(),
        })
    }

    /// Decodes more bytes, cut anywhere; of clocked formats words, one behind the other.
    pub fn push(&mut self, bytes: &Uint8Array) {
        for start in (0..bytes.length()).step_by(CHUNK as usize) {
            let piece = bytes.subarray(start, bytes.length().min(start + CHUNK));
            self.chunk.resize(piece.length() as usize, 0);
            piece.copy_to(&mut self.chunk);
            self.decode();
        }
    }

    /// Takes more of a pasted text, cut anywhere; what is in it is decoded at its end.
    #[wasm_bindgen(js_name = pushText)]
    pub fn push_text(&mut self, text: &str) {
        let medium = self.decoder.profile().medium();
        let reader = self.text.get_or_insert_with(|| Reader::new(medium, text));
        reader.push(text.as_bytes());
    }

    /// The input has ended; decodes what is left. What is pushed then is another input.
    pub fn finish(&mut self) {
        let (decoder, columns, summary) = (&self.decoder, &mut self.columns, &mut self.summary);
        let mut sink = |piece: Piece<'_>| take(&piece, columns, summary);
        self.framer.finish_runs(decoder, &mut sink);
        self.framer = Framer::at_start();
        if let Some(mut words) = self.words.take() {
            words.finish_runs(&mut sink);
        }
        if let Some(text) = self.text.take() {
            decoder.dump_runs(&text.finish(), &mut sink);
        }
    }

    /// How many readings there are.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.columns.len()
    }

    /// Hands the readings over, and forgets them.
    pub fn take(&mut self) -> Object {
        let columns = &self.columns;
        let runs = object([
            (
                "start",
                floats(columns.runs.iter().map(|run| run.start as f64)),
            ),
            ("len", counts(columns.runs.iter().map(|run| run.len))),
            ("frames", counts(columns.runs.iter().map(|run| run.frames))),
        ]);
        let summary = object([
            ("bytes", (self.summary.bytes as f64).into()),
            ("frames", (self.summary.frames as f64).into()),
            ("bad", (self.summary.bad as f64).into()),
            ("skipped", (self.summary.skipped as f64).into()),
        ]);
        let taken = object([
            (
                "angle",
                floats(columns.angle.iter().map(|angle| *angle as f64)),
            ),
            (
                "turns",
                floats(columns.turns.iter().map(|turns| *turns as f64)),
            ),
            ("status", bytes(columns.status.iter().copied())),
            (
                "health",
                bytes(columns.health.iter().map(|health| code(*health))),
            ),
            ("runs", runs.into()),
            ("summary", summary.into()),
        ]);
        self.columns.clear();
        taken
    }

    /// Forgets the readings.
    pub fn clear(&mut self) {
        self.columns.clear();
    }
}

impl ColumnReader {
    /// Decodes the chunk.
    fn decode(&mut self) {
        let (decoder, columns, summary) = (&self.decoder, &mut self.columns, &mut self.summary);
        let mut sink = |piece: Piece<'_>| take(&piece, columns, summary);
        match decoder.profile().medium() {
            Medium::Bytes | Medium::Text => {
                self.framer.push_runs(decoder, &self.chunk, &mut sink);
            }
            Medium::Bits => {
                let bits = decoder.main_layout().len.next_multiple_of(8);
                let words = self
                    .words
                    .get_or_insert_with(|| Words::new(decoder, bits, &self.chunk));
                words.push_runs(decoder, &self.chunk, &mut sink);
            }
        }
    }
}

fn take(piece: &Piece<'_>, columns: &mut Columns, summary: &mut Summary) {
    let bytes = piece.bytes.len() as u64;
    summary.bytes += bytes;
    match piece.kind {
        PieceKind::Frame {
            layout,
            sure,
            holds,
        } => {
            let frames = bytes / layout.bytes() as u64;
            summary.frames += frames;
            summary.bad += if sure && holds { 0 } else { frames };
        }
        PieceKind::Skip(_) => summary.skipped += bytes,
    }
    columns.take(piece);
}

/// 0 good, 1 warning, 2 error, 3 both.
fn code(health: Health) -> u8 {
    u8::from(health.is_error()) * 2 + u8::from(health.is_warning())
}

fn floats(numbers: impl Iterator<Item = f64>) -> JsValue {
    let numbers: Vec<f64> = numbers.collect();
    Float64Array::from(numbers.as_slice()).into()
}

fn counts(numbers: impl Iterator<Item = u32>) -> JsValue {
    let numbers: Vec<u32> = numbers.collect();
    Uint32Array::from(numbers.as_slice()).into()
}

fn bytes(numbers: impl Iterator<Item = u8>) -> JsValue {
    let numbers: Vec<u8> = numbers.collect();
    Uint8Array::from(numbers.as_slice()).into()
}

fn object<const N: usize>(properties: [(&str, JsValue); N]) -> Object {
    let object = Object::new();
    for (name, value) in properties {
        // A new object takes any property.
        let _ = Reflect::set(&object, &name.into(), &value);
    }
    object
}
