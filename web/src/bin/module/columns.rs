//! Readings by the million: a typed array for each number instead of an object for each frame.

use crate::decoder;
use encoderscope::{
    bits::Bits,
    columns::{Columns, Health},
    decode::{Decoded, Decoder, Summary},
    dump::{Dump, Reader},
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
            text: None,
            chunk: Vec::new(),
            columns: Columns::default(),
            summary: Summary::default(),
        })
    }

    /// Decodes more bytes, cut anywhere; of formats that are clocked whole words.
    pub fn push(&mut self, bytes: &Uint8Array) {
        let most = match self.decoder.profile().medium() {
            Medium::Bytes | Medium::Text => CHUNK,
            Medium::Bits => CHUNK - CHUNK % self.word() as u32,
        };
        for start in (0..bytes.length()).step_by(most as usize) {
            let piece = bytes.subarray(start, bytes.length().min(start + most));
            self.chunk.resize(piece.length() as usize, 0);
            piece.copy_to(&mut self.chunk);
            match self.decoder.profile().medium() {
                Medium::Bytes | Medium::Text => self.frame(),
                Medium::Bits => self.words(),
            }
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
        let Self {
            decoder,
            framer,
            columns,
            summary,
            ..
        } = self;
        framer.finish_runs(decoder, &mut |piece| take(&piece, columns, summary));
        self.framer = Framer::at_start();
        if let Some(reader) = self.text.take() {
            self.dump(&reader.finish());
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
    /// Bytes of a word of a clocked format.
    fn word(&self) -> usize {
        self.decoder.main_layout().len.div_ceil(8).max(1)
    }

    /// Decodes the chunk as a part of a stream.
    fn frame(&mut self) {
        let Self {
            decoder,
            framer,
            chunk,
            columns,
            summary,
            ..
        } = self;
        framer.push_runs(decoder, chunk, &mut |piece| take(&piece, columns, summary));
    }

    /// Decodes the chunk as words.
    fn words(&mut self) {
        let len = self.word();
        for word in self.chunk.chunks(len) {
            let frame = self.decoder.line(Bits::of_bytes(word));
            self.summary.bytes += word.len() as u64;
            match frame {
                Ok(frame) => {
                    self.summary.frames += 1;
                    self.summary.bad += u64::from(!frame.ok());
                    self.columns.push(frame.reading());
                }
                Err(_) => self.summary.skipped += word.len() as u64,
            }
        }
    }

    /// Decodes a pasted text.
    fn dump(&mut self, dump: &Dump) {
        let columns = &mut self.columns;
        let counts = self.decoder.dump(dump, &mut |decoded| {
            if let Decoded::Frame(frame) = decoded {
                columns.push(frame.reading());
            }
        });
        self.summary.bytes += counts.bytes;
        self.summary.frames += counts.frames;
        self.summary.bad += counts.bad;
        self.summary.skipped += counts.skipped;
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
            let frames = bytes * 8 / layout.len as u64;
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
