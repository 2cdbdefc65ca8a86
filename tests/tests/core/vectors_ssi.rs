//! What runs the vectors of words that a master clocks out.

use super::vectors::{agree, decoded, hex_or_bits, raw};
use encoderscope::{
    bits::{Bits, Span, from_gray, placed, to_gray},
    check::Checksum,
    decode::Decoder,
    layout::{Resolved, Role},
    reading::Values,
};
use encoderscope_tests::{decoder, paste};
use serde_json::{Value, json};

pub(crate) fn ssi7(name: &str, vector: &Value) {
    let frame = &vector["params"]["frame_bits"];
    for angle in [14, 22] {
        let decoder = decoder(&format!(
            "format=ssi7 frame-bits={frame} angle-bits={angle}"
        ));
        ssi7_word(name, vector, &decoder, hex_or_bits(vector));
    }
}

fn ssi7_word(name: &str, vector: &Value, decoder: &Decoder, text: &str) {
    let (record, notes) = decoded(name, decoder, text);
    let found = json!({
        "pd": record["angle"],
        "parity_bit": raw(&notes, "parity"),
        "parity_ok": record["parity"]["ok"],
        "alarm": raw(&notes, "alarm"),
    });
    agree(name, vector, &found);
    assert_eq!(record["ok"], true, "{name}");
    assert_eq!(record["error"], raw(&notes, "alarm") == 1, "{name}");
}

pub(crate) fn ssi2(name: &str, vector: &Value) {
    let text = hex_or_bits(vector);
    let frame = &vector["params"]["frame_bits"];
    let short = decoder(&format!("format=ssi7 frame-bits={frame} angle-bits=22"));
    ssi7_word(name, vector, &short, text);
    let whole = decoder("format=ssi7 angle-bits=22");
    ssi7_word(name, vector, &whole, &format!("00 {text}"));
}

/// The word of a vector as bytes.
fn word(vector: &Value) -> Vec<u8> {
    paste(&decoder("format=asi1"), hex_or_bits(vector))
        .bytes()
        .to_vec()
}

/// PV, ZPD and PD of an ASI1 packet in the order in which it sends them, without what stands
/// between them.
fn in_order_of_asi1(values: &Values) -> u64 {
    let decoder = decoder("format=asi1 angle-bits=22");
    let packet = decoder.encode(values);
    let layout = decoder.main_layout();
    let payload = [Role::Valid, Role::ZeroDefault, Role::Angle];
    let mut parts: Vec<Span> = layout
        .fields()
        .filter(|field| payload.contains(&field.row.role))
        .flat_map(|field| layout.parts(field))
        .map(|part| part.span)
        .collect();
    parts.sort_by_key(|span| span.start);
    parts.iter().fold(0, |sum, span| {
        placed(sum, span.len as u32) | packet.as_bits().read(*span)
    })
}

/// Reads PV, ZPD and a PD of `width` bits from bit `start` on, and compares their order with
/// that of ASI1; returns what was found.
fn incoder(name: &str, bits: Bits<'_>, start: usize, width: usize) -> Value {
    let pd = bits.read(Span::new(start + 2, width));
    let (pv, zpd) = (bits.bit(start), bits.bit(start + 1));
    let values = Values {
        valid: Some(pv),
        zero_default: Some(zpd),
        angle: Some(pd),
        ..Values::default()
    };
    let sent = placed(bits.read(Span::new(start, 2)), 22) | pd;
    assert_eq!(in_order_of_asi1(&values), sent, "{name}");
    json!({ "pv": u64::from(pv), "zpd": u64::from(zpd), "pd": pd })
}

pub(crate) fn ssi1(name: &str, vector: &Value) {
    let bytes = word(vector);
    assert_eq!(bytes.len(), 3, "{name}");
    agree(name, vector, &incoder(name, Bits::of_bytes(&bytes), 0, 22));
}

pub(crate) fn ssi4(name: &str, vector: &Value) {
    let bytes = word(vector);
    assert_eq!(bytes.len(), 4, "{name}");
    let bits = Bits::of_bytes(&bytes);
    let mut found = incoder(name, bits, 0, 19);
    found["ts"] = bits.read(Span::new(21, 11)).into();
    agree(name, vector, &found);
}

pub(crate) fn ssi6(name: &str, vector: &Value) {
    let bytes = word(vector);
    assert_eq!(bytes.len(), 4, "{name}");
    let bits = Bits::of_bytes(&bytes);
    let mut found = incoder(name, bits, 8, 22);
    found["crc8"] = bits.read(Span::new(0, 8)).into();
    agree(name, vector, &found);
    let computed = Checksum::Crc8x97.compute(bits, Span::new(8, 24));
    assert_eq!(vector["expected"]["crc8"], computed, "{name}");
}

/// A decoder of fir-tree words of the widths of a vector.
fn tree_decoder(vector: &Value, frame: &Value, code: &str) -> Decoder {
    let params = &vector["params"];
    decoder(&format!(
        "format=ssi-tree turns-bits={} angle-bits={} frame-bits={frame} code={code}",
        params["turn_bits"], params["pos_bits"]
    ))
}

/// The bits in digits.
pub(crate) fn text(bits: Bits<'_>) -> String {
    (0..bits.len())
        .map(|at| if bits.bit(at) { '1' } else { '0' })
        .collect()
}

/// The word with turns and angle in a Gray code each, which no encoder of the article sends.
fn separate(layout: &Resolved, values: &Values) -> String {
    let mut own = *values;
    own.turns = values.turns.map(|turns| to_gray(turns as u64) as i64);
    own.angle = values.angle.map(to_gray);
    text(layout.encode(&own).as_bits())
}

pub(crate) fn tree(name: &str, vector: &Value) {
    let expected = &vector["expected"];
    let frame = &vector["params"]["frame_bits"];
    let binary = tree_decoder(vector, frame, "binary");
    let gray = tree_decoder(vector, frame, "gray");
    assert_eq!(hex_or_bits(vector), expected["bits_binary"], "{name}");
    for (decoder, key) in [(&binary, "bits_binary"), (&gray, "bits_gray_whole_word")] {
        let line = paste(decoder, expected[key].as_str().unwrap());
        let values = decoder.line(line.line(0).unwrap().bits).unwrap().values();
        let (record, _) = decoded(name, decoder, expected[key].as_str().unwrap());
        assert_eq!(record["ok"], true, "{name} {key}");
        let found = json!({
            "turns": record["turns"],
            "position": record["angle"],
            "bits_binary": text(binary.encode(&values).as_bits()),
            "bits_gray_whole_word": text(gray.encode(&values).as_bits()),
            "bits_gray_separate_fields": separate(binary.main_layout(), &values),
        });
        agree(name, vector, &found);
    }
    let other = &expected["bits_gray_separate_fields"];
    let (record, _) = decoded(name, &gray, other.as_str().unwrap());
    let same = record["turns"] == expected["turns"] && record["angle"] == expected["position"];
    assert_eq!(same, *other == expected["bits_gray_whole_word"], "{name}");
}

pub(crate) fn tree_structure(name: &str, vector: &Value) {
    let word = &vector["params"]["word"];
    for code in ["binary", "gray"] {
        let decoder = tree_decoder(vector, word, code);
        let layout = decoder.main_layout();
        assert_eq!(*word, layout.len, "{name}");
        let end = |role: Role| {
            let field = layout.fields().find(|field| field.row.role == role);
            let parts = layout.parts(field.unwrap());
            parts.iter().map(|part| part.span.end()).max().unwrap()
        };
        let width = |name: &str| {
            let field = layout.fields().find(|field| field.row.name == name);
            field.map(|field| field.width)
        };
        let found = json!({
            "leading_zeros": width("leading"),
            "multiturn_bits": width("turns"),
            "singleturn_bits": width("angle"),
            "clock_pulses_needed": end(Role::Angle),
        });
        agree(name, vector, &found);
        assert_eq!(end(Role::Turns), 12, "{name}: the axis");
    }
}

pub(crate) fn gray(name: &str, vector: &Value) {
    let width = vector["params"]["bits"].as_u64().unwrap() as usize;
    let decoder = decoder(&format!(
        "format=ssi-tree align=right turns-bits=0 angle-bits={width} frame-bits={width}"
    ));
    let codes: Vec<String> = (0..1 << width)
        .map(|number| {
            let code = to_gray(number);
            assert_eq!(from_gray(code), number, "{name}");
            let values = Values {
                angle: Some(number),
                ..Values::default()
            };
            let word = decoder.encode(&values);
            assert_eq!(
                decoder.line(word.as_bits()).unwrap().values(),
                values,
                "{name}"
            );
            let digits = text(word.as_bits());
            assert_eq!(digits, format!("{code:0width$b}"), "{name}");
            digits
        })
        .collect();
    agree(name, vector, &json!({ "codes": codes }));
}
