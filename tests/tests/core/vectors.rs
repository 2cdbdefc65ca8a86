#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::decode::Decoder;
use encoderscope::record::Value as RecordValue;
use encoderscope_tests::{decoder, paste};
use serde_json::Value;

/// Runs every vector of a protocol and says how many there were.
fn each(protocol: &str, run: impl Fn(&str, &Value)) -> usize {
    let all: Vec<Value> = serde_json::from_str(include_str!("../../vectors.json")).unwrap();
    let mine = all.iter().filter(|vector| vector["protocol"] == protocol);
    mine.map(|vector| {
        let name = format!("{} ({})", vector["id"].as_str().unwrap(), vector["source"]);
        run(&name, vector);
    })
    .count()
}

/// Decodes the text as one frame and compares the record with what is expected.
fn compare(name: &str, decoder: &Decoder, text: &str, expected: &[(&str, Value)]) {
    let mut frames = 0;
    let summary = decoder.dump(&paste(decoder, text), &mut |decoded| {
        let encoderscope::decode::Decoded::Frame(frame) = decoded else {
            panic!("{name}: {decoded:?}");
        };
        frames += 1;
        let record: Value = serde_json::from_str(&frame.record().to_string()).unwrap();
        for (path, value) in expected {
            assert_eq!(
                record.pointer(path).unwrap_or(&Value::Null),
                value,
                "{name} {path}"
            );
        }
        assert_eq!(frame.reading().is_some(), frame.ok(), "{name}");
        let ok = frame.record().find("ok") == Some(&RecordValue::Bool(true));
        assert_eq!(ok, frame.ok(), "{name}");
        if frame.ok() {
            let again = frame.layout.encode(&frame.values());
            assert_eq!(again.as_bits().len(), frame.bits.len(), "{name}");
        }
    });
    assert_eq!((frames, summary.skipped), (1, 0), "{name}");
}

fn hex_or_bits(vector: &Value) -> &str {
    let text = |key: &str| vector[key].as_str().filter(|text| !text.is_empty());
    text("hex").or(text("bits")).unwrap()
}

#[test]
fn t485_vectors() {
    let count = each("T485", |name, vector| {
        let expected = &vector["expected"];
        if !expected["meaning"].is_null() {
            request(name, vector);
            return;
        }
        let bits = &vector["params"]["st_bits"];
        let decoder = decoder(&format!("format=t485 angle-bits={bits}"));
        let mut wanted = vec![
            ("/angle", expected["abs"].clone()),
            ("/status", expected["sf"].clone()),
            ("/crc/ok", expected["crc_ok"].clone()),
            ("/ok", expected["crc_ok"].clone()),
        ];
        for (path, key) in [
            ("/error", "encoder_error"),
            ("/enid", "enid"),
            ("/turns", "multiturn"),
            ("/alarm", "almc"),
        ] {
            if !expected[key].is_null() {
                wanted.push((path, expected[key].clone()));
            }
        }
        compare(name, &decoder, hex_or_bits(vector), &wanted);
    });
    assert_eq!(count, 15);
}

fn request(name: &str, vector: &Value) {
    use encoderscope::format::t485::Request;
    let byte = u8::from_str_radix(hex_or_bits(vector), 16).unwrap();
    let request = Request::of_byte(byte).unwrap_or_else(|| panic!("{name}"));
    let decoder = decoder("format=t485");
    let layout = decoder.layout(&[byte]).unwrap();
    assert_eq!(
        layout.len / 8,
        vector["expected"]["reply_len"].as_u64().unwrap() as usize,
        "{name}"
    );
    assert_eq!(
        byte.count_ones() % 2,
        1,
        "{name}: the whole byte has odd parity"
    );
    let values = layout.values(encoderscope::bits::Bits::of_bytes(&[byte]));
    assert_eq!(
        u64::from(values.operation.unwrap()),
        vector["params"]["data_id"].as_u64().unwrap(),
        "{name}"
    );
    assert!(values.parity.unwrap().ok(), "{name}");
    assert_eq!(
        values.parity.unwrap().received,
        vector["expected"]["id_parity_even"].as_u64().unwrap(),
        "{name}"
    );
    let writes = vector["expected"]["meaning"].as_str().unwrap();
    assert_eq!(
        request.changes_encoder(),
        writes.contains("reset") || writes.contains("write"),
        "{name}"
    );
}

#[test]
fn biss_c_vectors() {
    let generic = each("BISS-C", |name, vector| {
        let expected = &vector["expected"];
        let params = &vector["params"];
        let (turns, angle) = match (&params["mt_bits"], &expected["mt_bits"]) {
            (_, turns) if !turns.is_null() => (turns.clone(), expected["st_bits"].clone()),
            _ => (0.into(), params["data_bits"].clone()),
        };
        let status = &params["status_bits"];
        let decoder = decoder(&format!(
            "format=biss-c turns-bits={turns} angle-bits={angle} status-bits={status}"
        ));
        let position = if turns == 0 {
            &expected["position"]
        } else {
            &expected["singleturn"]
        }
        .clone();
        let mut wanted = vec![
            ("/angle", position),
            ("/error", expected["error_active"].clone()),
            ("/warning", expected["warning_active"].clone()),
            ("/crc/received", expected["crc_received"].clone()),
            ("/crc/ok", expected["crc_ok"].clone()),
            ("/ok", expected["crc_ok"].clone()),
        ];
        if turns != 0 {
            wanted.push(("/turns", expected["multiturn"].clone()));
        }
        compare(name, &decoder, hex_or_bits(vector), &wanted);
    });
    assert_eq!(generic, 12);
    let native = each("BISS-C MPP/PT", |name, vector| {
        let expected = &vector["expected"];
        let params = &vector["params"];
        let status = if expected["status"].is_null() { 0 } else { 6 };
        let decoder = decoder(&format!(
            "format=biss-c turns-bits={} angle-bits={} status-bits={status}",
            params["mt_bits"], params["X"]
        ));
        let low = |key: &str| Value::Bool(expected[key] == 0);
        compare(
            name,
            &decoder,
            hex_or_bits(vector),
            &[
                ("/turns", expected["multiturn"].clone()),
                ("/angle", expected["singleturn"].clone()),
                ("/error", low("error_bit")),
                ("/warning", low("warning_bit")),
                (
                    "/status",
                    if status == 0 {
                        Value::Null
                    } else {
                        expected["status"].clone()
                    },
                ),
                ("/crc/received", expected["crc"].clone()),
                ("/ok", true.into()),
            ],
        );
    });
    assert_eq!(native, 5);
}

#[test]
fn rs485_vectors() {
    let count = each("RS485", |name, vector| {
        let expected = &vector["expected"];
        let command = match vector["params"]["cmd"].as_str().unwrap() {
            "30" => "0",
            "31" => "1",
            "64" => "d",
            "74" => "t",
            other => panic!("{name}: {other}"),
        };
        let decoder = decoder(&format!("format=rs485 command={command}"));
        let text = hex_or_bits(vector);
        if command == "0" {
            let bytes = paste(&decoder, text).bytes();
            let frame = decoder.frame(&bytes).unwrap();
            assert!(frame.ok(), "{name}");
            assert_eq!(frame.values().count, Some(10), "{name}");
            return;
        }
        let mut wanted = vec![
            ("/turns", expected["multiturn"].clone()),
            ("/angle", expected["singleturn"].clone()),
            ("/ok", expected["crc_ok"].clone()),
        ];
        if let Some(degrees) = expected["angle_deg"].as_f64() {
            wanted.push(("/degrees", (degrees as i64).into()));
        }
        if let Some(temperature) = expected["temp_c"].as_f64() {
            wanted.push(("/temperature", (temperature as i64).into()));
        }
        if let Some(byte) = expected["status"].as_u64() {
            wanted.push(("/status", (byte & 0x3f).into()));
            wanted.push(("/error", expected["error"].clone()));
            wanted.push(("/warning", expected["warning"].clone()));
        }
        compare(name, &decoder, text, &wanted);
    });
    assert_eq!(count, 4);
}
