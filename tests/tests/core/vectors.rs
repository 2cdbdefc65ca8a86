#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::vectors_ssi;
use encoderscope::{
    bits::{Bits, Span, bit},
    check::Checksum,
    decode::{Decoded, Decoder},
    explain::Note,
    format::{
        Format, biss_c, bus,
        rs485::Command,
        t485::{self, Request},
    },
    layout::{Resolved, Role, Shape},
    profile::Profile,
};
use encoderscope_tests::{decoder, paste};
use serde_json::{Value, json};

/// A test for each public source: its protocol, what the ids of its vectors begin with, how
/// many there are, and what runs one of them.
macro_rules! sources {
    ($($test:ident: $protocol:literal $ids:literal $count:literal $run:path;)*) => {
        const SOURCES: &[(&str, &str)] = &[$(($protocol, $ids)),*];
        $(#[test]
        fn $test() {
            let mine: Vec<Value> = all()
                .into_iter()
                .filter(|vector| is_of(vector, $protocol, $ids))
                .collect();
            assert_eq!(mine.len(), $count);
            for vector in &mine {
                $run(&name_of(vector), vector);
            }
        })*
    };
}

sources! {
    t485_captures_of_hpmicro_sdk_uart_sample: "T485" "tama-hpm-uart-" 3 t485_reply;
    t485_logs_of_hpmicro_sdk_sei_sample: "T485" "tama-hpm-sei-" 3 t485_reply;
    t485_requests_of_tamagawa_library_and_ti_motor_control_sdk: "T485" "tama-req-" 9 t485_request;
    biss_c_capture_in_the_vesc_firmware: "BISS-C" "biss-vesc-" 1 biss_c;
    biss_c_traces_of_pandablocks_fpga: "BISS-C" "biss-panda-" 2 biss_c;
    biss_c_word_of_osw_bissc_vitis: "BISS-C" "biss-osw-" 1 biss_c;
    biss_c_unit_tests_of_moteus: "BISS-C" "biss-moteus-" 2 biss_c;
    biss_c_logs_of_hpmicro_sdk_sei_sample: "BISS-C" "biss-hpm-" 6 biss_c;
    biss_c_status_table_of_mpp_and_pt: "BISS-C MPP/PT" "mpp-bissB-" 3 biss_c_mpp;
    biss_c_printed_row_of_mpp_and_pt: "BISS-C MPP/PT" "mpp-bissA-" 2 biss_c_mpp;
    rs485_reply_table_of_mpp_and_pt: "RS485" "rs485-" 4 rs485;
    bus_request_table_of_mpp_and_pt: "BUS request" "bus-req-" 5 bus_request;
    bus_reply_table_of_mpp_and_pt: "BUS" "bus-24M" 1 bus_reply;
    asi1_order_of_the_zettlex_driver_with_top_bits_0: "ASI1" "asi1-s0-" 4 asi1;
    asi1_order_of_the_zettlex_driver_with_a_top_bit_in_byte_0: "ASI1" "asi1-s1-" 4 asi1;
    crc6_unit_test_of_moteus: "CRC-6" "crc6-moteus-" 1 checksum;
    crc6_check_value_by_long_division: "CRC-6" "crc6-03-" 1 checksum;
    crc8_check_value_of_the_python_package_crc: "CRC-8" "crc8-97-" 1 checksum;
    crc16_unit_tests_of_chromium: "CRC-16" "crc16-chromium-" 4 checksum;
    crc16_check_value_of_the_crate_crc16: "CRC-16" "crc16-check" 1 checksum;
    ssi7_word_table_of_ip75: "SSI7" "ssi7-" 3 vectors_ssi::ssi7;
    ssi2_log_of_stm32incoder_is_the_low_24_bits_of_ssi7:
        "SSI2 (IncOder) = low 24 bits of SSI7" "incoder-ssi2" 1 vectors_ssi::ssi2;
    ssi1_log_of_stm32incoder_pins_the_field_order_of_asi1:
        "SSI1 (IncOder)" "incoder-ssi1" 1 vectors_ssi::ssi1;
    ssi4_log_of_stm32incoder_pins_the_field_order_of_asi1:
        "SSI4 (IncOder)" "incoder-ssi4" 1 vectors_ssi::ssi4;
    ssi6_log_of_stm32incoder_pins_the_field_order_of_asi1_and_the_crc8:
        "SSI6 (IncOder)" "incoder-ssi6" 1 vectors_ssi::ssi6;
    fir_tree_words_by_the_linux_driver_of_apci1710: "SSI fir-tree" "firtree-1" 3 vectors_ssi::tree;
    fir_tree_structure_in_the_siemens_ip241_manual:
        "SSI fir-tree" "firtree-siemens-" 1 vectors_ssi::tree_structure;
    gray_unit_test_of_pyrtl_extras: "Gray" "gray-" 1 vectors_ssi::gray;
}

#[test]
fn every_vector_has_one_test() {
    let all = all();
    assert_eq!(all.len(), 70);
    for vector in &all {
        let tests = SOURCES
            .iter()
            .filter(|(protocol, ids)| is_of(vector, protocol, ids));
        assert_eq!(tests.count(), 1, "{}", name_of(vector));
        let same = all.iter().filter(|other| other["id"] == vector["id"]);
        assert_eq!(same.count(), 1, "{}", name_of(vector));
    }
}

fn all() -> Vec<Value> {
    serde_json::from_str(include_str!("../../vectors.json")).unwrap()
}

fn is_of(vector: &Value, protocol: &str, ids: &str) -> bool {
    vector["protocol"] == protocol && vector["id"].as_str().unwrap().starts_with(ids)
}

/// The id and the source, for failures.
fn name_of(vector: &Value) -> String {
    format!("{} ({})", vector["id"].as_str().unwrap(), vector["source"])
}

/// Compares everything that a vector expects with what was found under the same keys.
pub(crate) fn agree(name: &str, vector: &Value, found: &Value) {
    let expected = vector["expected"].as_object().unwrap();
    assert!(!expected.is_empty(), "{name}");
    for (key, value) in expected {
        assert_eq!(found.get(key), Some(value), "{name} {key}");
    }
}

pub(crate) fn hex_or_bits(vector: &Value) -> &str {
    let text = |key: &str| vector[key].as_str().filter(|text| !text.is_empty());
    text("hex").or(text("bits")).unwrap_or_default()
}

/// Decodes the text as one frame; returns its record and its notes.
pub(crate) fn decoded(name: &str, decoder: &Decoder, text: &str) -> (Value, Vec<Note>) {
    let mut found = Vec::new();
    let summary = decoder.dump(&paste(decoder, text), &mut |decoded| {
        let Decoded::Frame(frame) = decoded else {
            panic!("{name}: {decoded:?}");
        };
        let record: Value = serde_json::from_str(&frame.record().to_string()).unwrap();
        assert_eq!(record["ok"], frame.ok(), "{name}");
        assert_eq!(frame.reading().is_some(), frame.ok(), "{name}");
        if frame.ok() {
            let layout = &frame.layout;
            let again = layout.encode(&frame.values());
            assert_eq!(again.as_bits().len(), frame.bits.len(), "{name}");
            for field in layout.fields() {
                let row = field.row;
                if row.role != Role::Framing || row.constant.is_some() {
                    let sent = layout.read(field, frame.bits);
                    assert_eq!(layout.read(field, again.as_bits()), sent, "{name}");
                }
            }
        }
        found.push((record, frame.explain()));
    });
    assert_eq!((found.len(), summary.skipped), (1, 0), "{name}");
    found.remove(0)
}

/// The number of a field as it was sent.
pub(crate) fn raw(notes: &[Note], field: &str) -> u64 {
    let note = notes.iter().find(|note| note.name == field);
    note.unwrap_or_else(|| panic!("{field}")).raw
}

/// Whether a named bit is set.
fn is_set(notes: &[Note], name: &str) -> bool {
    let mut bits = notes.iter().flat_map(|note| &note.bits);
    bits.any(|bit| bit.name == name && bit.set)
}

fn t485_reply(name: &str, vector: &Value) {
    let params = &vector["params"];
    let text = hex_or_bits(vector);
    let decoder = decoder(&format!("format=t485 angle-bits={}", params["st_bits"]));
    let (record, notes) = decoded(name, &decoder, text);
    assert_eq!(record["operation"], params["data_id"], "{name}");
    assert!(
        text.starts_with(params["request"].as_str().unwrap()),
        "{name}"
    );
    let found = json!({
        "abs": record["angle"],
        "sf": record["status"],
        "comm_error": is_set(&notes, "communication error"),
        "encoder_error": record["error"],
        "enid": record["enid"],
        "multiturn": record["turns"],
        "almc": record["alarm"],
        "crc_ok": record["crc"]["ok"],
    });
    agree(name, vector, &found);
    assert_eq!(record["ok"], vector["expected"]["crc_ok"], "{name}");
}

fn t485_request(name: &str, vector: &Value) {
    let byte = u8::from_str_radix(hex_or_bits(vector), 16).unwrap();
    let request = Request::of_byte(byte).unwrap_or_else(|| panic!("{name}"));
    let head = Resolved::new(&t485::HEAD, Shape::of(Format::T485.default_profile()));
    let values = head.values(Bits::of_bytes(&[byte]));
    let parity = values.parity.unwrap();
    assert!(parity.ok(), "{name}");
    let id = values.operation.map(u64::from);
    assert_eq!(id, vector["params"]["data_id"].as_u64(), "{name}");
    let meaning = match request {
        Request::Angle => "abs",
        Request::Turns => "multiturn",
        Request::Identity => "ENID",
        Request::All => "abs+ENID+multiturn+ALMC",
        Request::MemoryWrite => "EEPROM write (request 4 bytes)",
        Request::ResetErrors => "reset all errors",
        Request::ResetAngle => "reset single-turn abs",
        Request::ResetTurns => "reset multiturn + errors",
        Request::MemoryRead => "EEPROM read (request 3 bytes)",
    };
    let writes = meaning.contains("reset") || meaning.contains("write");
    assert_eq!(request.changes_encoder(), writes, "{name}");
    let decoder = decoder("format=t485");
    let found = json!({
        "meaning": meaning,
        "reply_len": decoder.layout(&[byte]).unwrap().len / 8,
        "id_parity_even": parity.received,
        "whole_byte_parity": if byte.count_ones() % 2 == 1 { "odd" } else { "even" },
    });
    agree(name, vector, &found);
}

fn biss_c(name: &str, vector: &Value) {
    let params = &vector["params"];
    let expected = &vector["expected"];
    let (turns, angle) = match expected["mt_bits"].as_u64() {
        Some(turns) => (turns, expected["st_bits"].as_u64()),
        None => (0, params["data_bits"].as_u64()),
    };
    let angle = angle.unwrap();
    let decoder = decoder(&format!(
        "format=biss-c turns-bits={turns} angle-bits={angle} status-bits={}",
        params["status_bits"]
    ));
    let (record, notes) = decoded(name, &decoder, hex_or_bits(vector));
    let singleturn = record["angle"].as_u64().unwrap();
    let multiturn = record["turns"].as_u64();
    let found = json!({
        "position": (multiturn.unwrap_or(0) << angle) + singleturn,
        "multiturn": multiturn,
        "singleturn": singleturn,
        "mt_bits": turns,
        "st_bits": angle,
        "error_bit": raw(&notes, "nError"),
        "warning_bit": raw(&notes, "nWarning"),
        "error_active": record["error"],
        "warning_active": record["warning"],
        "crc_received": record["crc"]["received"],
        "crc_ok": record["crc"]["ok"],
    });
    agree(name, vector, &found);
    assert_eq!(record["ok"], expected["crc_ok"], "{name}");
}

fn biss_c_mpp(name: &str, vector: &Value) {
    let params = &vector["params"];
    let printed = vector["expected"]["status"].is_null();
    let decoder = decoder(&format!(
        "format=biss-c turns-bits={} angle-bits={} status-bits={}",
        params["mt_bits"],
        params["X"],
        if printed { 0 } else { 6 }
    ));
    assert_eq!(
        params["total_bits"],
        biss_c::data_bits(decoder.profile()),
        "{name}"
    );
    let (record, notes) = decoded(name, &decoder, hex_or_bits(vector));
    assert_eq!(record["error"], raw(&notes, "nError") == 0, "{name}");
    assert_eq!(record["warning"], raw(&notes, "nWarning") == 0, "{name}");
    let found = json!({
        "multiturn": record["turns"],
        "singleturn": record["angle"],
        "error_bit": raw(&notes, "nError"),
        "warning_bit": raw(&notes, "nWarning"),
        "status": record["status"],
        "crc": record["crc"]["received"],
        "crc_ok": record["crc"]["ok"],
    });
    agree(name, vector, &found);
    assert_eq!(record["ok"], true, "{name}");
}

fn rs485(name: &str, vector: &Value) {
    let params = &vector["params"];
    let byte = u8::from_str_radix(params["cmd"].as_str().unwrap(), 16).unwrap();
    let command = Command::of_byte(byte).unwrap_or_else(|| panic!("{name}"));
    let code = format!("PT-20-30-A-{}-R-N-A-M", params["model"].as_str().unwrap());
    let letter = command.letter().to_string();
    let of_model = |more: &[(&str, &str)]| {
        let own = [("model", code.as_str()), ("command", letter.as_str())];
        let profile = Profile::parse(own.iter().chain(more).copied()).unwrap();
        Decoder::new(profile).unwrap()
    };
    let decoder = of_model(&[]);
    let text = hex_or_bits(vector);
    if command == Command::Zero {
        let bytes = paste(&decoder, text).bytes().to_vec();
        let frame = decoder.frame(&bytes).unwrap();
        assert!(frame.ok(), "{name}");
        let values = frame.values();
        assert_eq!(decoder.encode(&values).into_bytes(), bytes, "{name}");
        let found = json!({ "count": values.count, "crc_ok": values.crc.unwrap().ok() });
        return agree(name, vector, &found);
    }
    let (record, notes) = decoded(name, &decoder, text);
    let (signed, _) = decoded(name, &of_model(&[("turns-code", "signed")]), text);
    let flag = |key: &str| record[key].as_bool().map_or(0, u64::from);
    let status = record["status"].as_u64().unwrap_or(0);
    let found = json!({
        "multiturn": record["turns"],
        "multiturn_signed": signed["turns"],
        "singleturn": record["angle"],
        "angle_deg": record["degrees"].as_f64(),
        "temp_c": record["temperature"].as_f64(),
        "status": flag("error") << 7 | flag("warning") << 6 | status,
        "error": record["error"],
        "warning": record["warning"],
        "batt_lost": is_set(&notes, "battery disconnected"),
        "batt_low": is_set(&notes, "battery low"),
        "crc_ok": record["crc"]["ok"],
    });
    agree(name, vector, &found);
    assert_eq!(record["ok"], true, "{name}");
}

fn bus_request(name: &str, vector: &Value) {
    let byte = u8::from_str_radix(hex_or_bits(vector), 16).unwrap();
    let profile = Format::Bus.default_profile();
    let head = Resolved::new(&bus::HEAD, Shape::of(profile));
    let values = head.values(Bits::of_bytes(&[byte]));
    let found = json!({
        "addr": values.address,
        "op": values.operation,
        "parity_ok": values.parity.unwrap().ok(),
    });
    agree(name, vector, &found);
    let operation = bus::Operation::of_code(values.operation.unwrap()).unwrap();
    let again = bus::request(&profile, operation, values.address.unwrap());
    assert_eq!(again, byte, "{name}");
}

fn bus_reply(name: &str, vector: &Value) {
    let model = vector["params"]["model"].as_str().unwrap();
    let code = format!("PT-20-30-A-{model}-D-N-A-M");
    let decoder = Decoder::new(Profile::parse([("model", code.as_str())]).unwrap()).unwrap();
    let (record, _) = decoded(name, &decoder, hex_or_bits(vector));
    let found = json!({
        "addr": record["address"],
        "op": record["operation"],
        "status": record["status"],
        "singleturn": record["angle"],
        "multiturn": record["turns"],
        "crc_ok": record["crc"]["ok"],
    });
    agree(name, vector, &found);
    assert_eq!(record["parity"]["ok"], true, "{name}");
    assert_eq!(record["ok"], true, "{name}");
}

fn asi1(name: &str, vector: &Value) {
    let marker = match vector["params"]["bit7"].as_str().unwrap() {
        "b7 all 0" => "none",
        "b7=1 in byte 0 only" => "first",
        other => panic!("{name}: {other}"),
    };
    let text = hex_or_bits(vector);
    for angle in [14, 22] {
        let decoder = decoder(&format!("format=asi1 angle-bits={angle} marker={marker}"));
        let (record, notes) = decoded(name, &decoder, text);
        if angle == 14 && vector["expected"]["pd"].as_u64() > Some(0x3fff) {
            assert_eq!(record["ok"], false, "{name}: wider than 14 bits");
            continue;
        }
        let found = json!({
            "pv": raw(&notes, "valid"),
            "zpd": raw(&notes, "zero_default"),
            "pd": record["angle"],
            "crc": record["crc"]["received"],
            "crc_ok": record["crc"]["ok"],
        });
        agree(name, vector, &found);
        assert_eq!(record["ok"], true, "{name}");
        assert_eq!(record["error"], raw(&notes, "valid") == 0, "{name}");
        let bytes = paste(&decoder, text).bytes().to_vec();
        let values = decoder.frame(&bytes).unwrap().values();
        assert_eq!(decoder.encode(&values).into_bytes(), bytes, "{name}");
        assert_eq!(bit(raw(&notes, "marker"), 5), marker == "first", "{name}");
    }
}

fn checksum(name: &str, vector: &Value) {
    let sum = match vector["protocol"].as_str().unwrap() {
        "CRC-6" => Checksum::Crc6Biss,
        "CRC-8" => Checksum::Crc8x97,
        "CRC-16" => Checksum::Crc16x8005,
        other => panic!("{name}: {other}"),
    };
    let line = paste(&decoder("format=ssi"), hex_or_bits(vector));
    let bits = line.line(0).map(|line| line.bits);
    let bits = bits.unwrap_or(Bits::of_bytes(&[]));
    let computed = sum.compute(bits, Span::new(0, bits.len()));
    // BiSS-C sends its CRC inverted; the sources give the remainder itself.
    let found = match sum {
        Checksum::Crc6Biss => json!({ "crc": computed ^ 0x3f, "crc_inverted": computed }),
        _ => json!({ "crc": computed }),
    };
    agree(name, vector, &found);
}
