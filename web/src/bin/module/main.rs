//! The small module: the JavaScript API and the serial worker.

mod columns;

use columns::ColumnReader;
use encoderscope::{
    bits::Bits,
    decode::{Decoded, Decoder},
    dump,
    format::{Format, Medium},
    model,
    profile::{Profile, camel},
    reading::Values,
    record::{Record, Value},
};
use encoderscope_web::{
    browser::{Peer, property},
    desk::Desk,
    engine::Engine,
    message::{Answer, FromDesk, FromEngine, ToDesk, ToEngine, Wish},
    serial,
};
use js_sys::{Array, Object, Uint8Array};
use serde::{Serialize, Serializer, ser::SerializeMap};
use wasm_bindgen::prelude::*;
use web_sys::MessageEvent;

fn main() {}

/// A value of the core as serde sees it.
struct Plain<'a>(&'a Value);

impl Serialize for Plain<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            Value::Null => serializer.serialize_unit(),
            Value::Bool(value) => serializer.serialize_bool(*value),
            Value::Int(value) => serializer.serialize_f64(*value as f64),
            // Decimals are made of digits.
            Value::Decimal(digits) => serializer.serialize_f64(digits.parse().unwrap_or(f64::NAN)),
            Value::Text(text) => serializer.serialize_str(text),
            Value::List(values) => serializer.collect_seq(values.iter().map(Plain)),
            Value::Record(record) => {
                let mut map = serializer.serialize_map(Some(record.0.len()))?;
                for (name, value) in &record.0 {
                    map.serialize_entry(name, &Plain(value))?;
                }
                map.end()
            }
        }
    }
}

fn to_js(value: impl Into<Value>) -> Result<JsValue, JsError> {
    let plain = serde_wasm_bindgen::Serializer::json_compatible();
    Ok(Plain(&value.into()).serialize(&plain)?)
}

/// A decoder from a plain object; numbers and text are both fine as values.
fn decoder(profile: &JsValue) -> Result<Decoder, JsError> {
    let mut pairs = Vec::new();
    for entry in Object::entries(profile.unchecked_ref()) {
        let entry: Array = entry.unchecked_into();
        let value = entry.get(1);
        if value.is_undefined() || value.is_null() {
            continue;
        }
        let name = entry.get(0).as_string().unwrap_or_default();
        let value = Object::from(value).to_string();
        pairs.push((name, String::from(value)));
    }
    let pairs = pairs
        .iter()
        .map(|(name, value)| (name.as_str(), value.as_str()));
    Ok(Decoder::new(Profile::parse(pairs)?)?)
}

/// The formats, each with its default profile.
#[wasm_bindgen]
pub fn formats() -> Result<JsValue, JsError> {
    let all = Format::ALL.iter().map(|format| {
        let names = format
            .parameters()
            .iter()
            .map(|name| camel(name))
            .collect::<Vec<_>>();
        Record::new()
            .with("format", format.name())
            .with("title", format.title())
            .with("parameters", names)
            .with("profile", format.default_profile().record())
            .into()
    });
    to_js(Value::List(all.collect()))
}

/// Decodes pasted text: frames, skips, what was not readable, and the counts.
#[wasm_bindgen]
pub fn decode(profile: &JsValue, text: &str) -> Result<JsValue, JsError> {
    let decoder = decoder(profile)?;
    let dump = dump::parse(text, decoder.profile().medium());
    let mut frames: Vec<Value> = Vec::new();
    let mut skips: Vec<Value> = Vec::new();
    let summary = decoder.dump(&dump, &mut |decoded| match decoded {
        Decoded::Frame(frame) => frames.push(frame.record().into()),
        Decoded::Skip { start, bits, why } => skips.push(
            Record::new()
                .with("start", start)
                .with("hex", encoderscope::record::hex(bits.bytes()))
                .with("why", why.to_string())
                .into(),
        ),
    });
    let unread = dump
        .unread()
        .places
        .iter()
        .map(|mark| text.get(mark.at.start as usize..mark.at.end as usize))
        .map(|token| token.unwrap_or_default().into());
    let mut record = Record::new()
        .with("frames", Value::List(frames))
        .with("skips", Value::List(skips))
        .with("unread", Value::List(unread.collect()));
    record.0.extend(summary.record().0);
    to_js(record)
}

/// Decodes all of the input into columns: bytes as they came, or text as it was pasted.
#[wasm_bindgen(js_name = decodeColumns)]
pub fn decode_columns(profile: &JsValue, input: &JsValue) -> Result<Object, JsError> {
    let mut reader = ColumnReader::new(profile)?;
    match (input.as_string(), input.dyn_ref::<Uint8Array>()) {
        (Some(text), _) => reader.push_text(&text),
        (None, Some(bytes)) => reader.push(bytes),
        (None, None) => return Err(JsError::new("the input is neither text nor a Uint8Array")),
    }
    reader.finish();
    Ok(reader.take())
}

/// Ranks what pasted text may be, best first.
#[wasm_bindgen]
pub fn detect(text: &str) -> Result<JsValue, JsError> {
    let found = encoderscope::detect::detect(text);
    to_js(Value::List(
        found
            .iter()
            .map(|candidate| candidate.record().into())
            .collect(),
    ))
}

/// Explains the first frame of the text, field by field.
#[wasm_bindgen]
pub fn explain(profile: &JsValue, text: &str) -> Result<JsValue, JsError> {
    let decoder = decoder(profile)?;
    let medium = decoder.profile().medium();
    let dump = dump::parse(text, medium);
    let bytes = dump.bytes();
    let bits = match dump.line(0) {
        Some(line) if medium == Medium::Bits => line.bits,
        _ => Bits::of_bytes(bytes),
    };
    let frame = match medium {
        Medium::Bytes | Medium::Text => decoder.frame(bytes),
        Medium::Bits => decoder.line(bits).ok(),
    };
    let frame =
        frame.ok_or_else(|| JsError::new("the text is not one whole frame of this format"))?;
    let notes = frame
        .explain()
        .iter()
        .map(|note| note.record().into())
        .collect();
    to_js(Value::List(notes))
}

/// The frame that says `values`: hexadecimal digits, or 0 and 1 where it is not whole bytes.
#[wasm_bindgen]
pub fn encode(profile: &JsValue, values: &JsValue) -> Result<String, JsError> {
    let decoder = decoder(profile)?;
    let number = |name: &str| property(values, name).as_f64();
    let byte = |name: &str| number(name).map(|value| value as u8);
    let tenths = |name: &str| number(name).map(|value| (value * 10.0).round() as i32);
    let flag = |name: &str| property(values, name).as_bool();
    let values = Values {
        turns: number("turns").map(|value| value as i64),
        angle: number("angle").map(|value| value as u64),
        error: flag("error"),
        warning: flag("warning"),
        status: byte("status"),
        alarm: byte("alarm"),
        enid: byte("enid"),
        speed: tenths("speed"),
        temperature: tenths("temperature"),
        count: byte("count"),
        operation: byte("operation"),
        address: byte("address"),
        valid: flag("valid"),
        zero_default: flag("zeroDefault"),
        memory: (byte("memoryAddress"), byte("memoryData")),
        ..Values::default()
    };
    let frame = decoder.encode(&values);
    let (bits, len) = (frame.as_bits(), frame.as_bits().len());
    Ok(match len % 8 {
        0 => encoderscope::record::hex(bits.bytes()),
        _ => (0..len)
            .map(|index| if bits.bit(index) { '1' } else { '0' })
            .collect(),
    })
}

/// What an order code says.
#[wasm_bindgen(js_name = parseModel)]
pub fn parse_model(code: &str) -> Result<JsValue, JsError> {
    to_js(model::parse(code)?.record())
}

/// Runs the engine for the page at the other end: from a dedicated worker, whose scope that is, or
/// from the page itself through a channel.
#[wasm_bindgen]
pub fn serve(page: &Peer) {
    let out = page.clone();
    let post = move |message: FromEngine| {
        if let Ok(message) = serde_wasm_bindgen::to_value(&message) {
            // The page is gone when this fails.
            let _ = out.post(&message);
        }
    };
    post(FromEngine::Hello {
        serial: serial::available().is_ok(),
    });
    let out = page.clone();
    // Answers to wishes are arrays, with a file beside them.
    let hand = move |message: Answer, file: Option<JsValue>| {
        if let Ok(message) = serde_wasm_bindgen::to_value(&message) {
            let both = Array::of2(&message, &file.unwrap_or_default());
            // The page is gone when this fails.
            let _ = out.post(&both);
        }
    };
    let engine = Engine::new(post, hand);
    let listen = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
        if let Some(both) = event.data().dyn_ref::<Array>() {
            let file = Some(both.get(1)).filter(|with| !with.is_undefined());
            if let Ok(message) = serde_wasm_bindgen::from_value::<Wish>(both.get(0)) {
                engine.grant(message, file);
            }
        } else if let Ok(message) = serde_wasm_bindgen::from_value::<ToEngine>(event.data()) {
            engine.handle(message);
        }
    });
    page.set_heard(Some(listen.as_ref().unchecked_ref()));
    listen.forget();
}

/// Decodes dumps for the page from a dedicated worker.
#[wasm_bindgen(js_name = serveDesk)]
pub fn serve_desk(page: &Peer) {
    let out = page.clone();
    let post = move |message: FromDesk, file: Option<JsValue>| {
        if let Ok(message) = serde_wasm_bindgen::to_value(&message) {
            let both = Array::of2(&message, &file.unwrap_or_default());
            // The page is gone when this fails.
            let _ = out.post(&both);
        }
    };
    post(FromDesk::Ready, None);
    let desk = Desk::new(post);
    let listen = Closure::<dyn FnMut(MessageEvent)>::new(move |event: MessageEvent| {
        let both: Array = event.data().unchecked_into();
        if let Ok(message) = serde_wasm_bindgen::from_value::<ToDesk>(both.get(0)) {
            let file = Some(both.get(1)).filter(|with| !with.is_undefined());
            desk.handle(message, file);
        }
    });
    page.set_heard(Some(listen.as_ref().unchecked_ref()));
    listen.forget();
}
