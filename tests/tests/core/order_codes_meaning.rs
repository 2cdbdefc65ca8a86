//! What follows from an order code: lengths, rates, wires, requests, and its record.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    decode::Decoder,
    model::{Model, parse},
    product::{Interface, Series},
    record::Value,
};

fn model(code: &str) -> Model {
    parse(code).unwrap_or_else(|error| panic!("{code}: {error}"))
}

#[test]
fn the_crc_6_program_counts_47_bits_for_17m_and_30_for_16() {
    let with_turns = model("17M");
    assert_eq!(with_turns.interface, Interface::BissC);
    assert_eq!(
        (with_turns.profile.angle_bits, with_turns.profile.turns_bits),
        (17, 16)
    );
    assert_eq!(with_turns.frame_bits(), Some(47));
    assert_eq!(model("16").frame_bits(), Some(30));
    assert_eq!(model("MPP-40-60-A-17M-B-N-A-M").frame_bits(), Some(47));
    // With the preamble of a dump: acknowledge, start and zero.
    let decoder = Decoder::new(model("16").profile).unwrap();
    assert!(decoder.main_layout().len >= 37);
}

#[test]
fn letters_r_and_a_share_a_format_and_not_the_wires() {
    let (two, four) = (
        model("PT-20-30-A-24-R-N-A-M"),
        model("PT-20-30-A-24-A-N-A-M"),
    );
    assert_eq!(two.profile, four.profile);
    assert_eq!(
        (two.interface, four.interface),
        (Interface::Rs485, Interface::Rs422)
    );
}

#[test]
fn a_baud_code_is_the_baud_rate() {
    for (option, baud) in [("M", 2_500_000), ("A", 115_200), ("B", 2_500_000)] {
        let code = format!("MPP-20-30-A-24-R-N-A-{option}");
        assert_eq!(model(&code).profile.baud, baud, "{code}");
    }
    assert_eq!(model("IP-75-ASI1").profile.baud, 230_400);
}

#[test]
fn a_code_says_what_else_follows() {
    let model = model("PT-15B-25H-A-24BM-R-N-B-A");
    assert_eq!(model.series, Some(Series::Pt));
    assert!(model.has_battery() && model.changes_by_command());
    assert_eq!(model.temperature(), Some((-40, 105)));
    assert_eq!(model.frame_bits(), Some(7 * 8));
    let record = model.record().to_string();
    assert_eq!(
        record,
        r#"{"format":"rs485","angleBits":24,"turnsBits":16,"command":"d","turnsCode":"unsigned","baud":115200,"series":"PT","orderCode":"PT-15B-25H-A-24BM-R-N-B-A","interface":"rs485","turnsKept":"battery","battery":true,"changesByCommand":true,"supply":"4.5…5.5 V","current":"≈ 100 mA","leastTemperature":-40,"greatestTemperature":105,"rotor":15,"stator":25,"frameBits":56}"#
    );
}

#[test]
fn no_name_of_a_record_means_two_things() {
    for code in [
        "17M",
        "16M1-D",
        "IP-75-ASI4",
        "IP-75-SSI7",
        "AVS58",
        "AVM58-H",
    ] {
        let model = model(code);
        let record = model.record();
        let mut names: Vec<_> = record.0.iter().map(|(name, _)| name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), record.0.len(), "{code}: {record}");
        let bits = record.find("frameBits").map(Value::plain);
        let expected = model.frame_bits().map(|bits| bits.to_string());
        assert_eq!(bits, expected, "{code}");
    }
}

#[test]
fn what_can_be_asked_is_what_the_interface_knows() {
    for (code, bytes, changes) in [
        ("24BM-R", &b"01dst"[..], true),
        ("23M-T", &[0x02, 0x8a, 0x1a, 0xc2, 0x62], true),
        ("24M-D", &[0x1f, 0xbf, 0xdf], true),
        ("24-P", &[], false),
        ("24-B", &[], false),
        ("IP-75-ASI1", &[], false),
        ("AVM58", &[], false),
    ] {
        let model = model(code);
        let asked: Vec<u8> = model
            .requests()
            .iter()
            .map(|request| request.byte)
            .collect();
        assert_eq!(asked, bytes, "{code}");
        assert_eq!(model.changes_by_command(), changes, "{code}");
    }
}

#[test]
fn frames_have_the_lengths_of_the_manuals() {
    for (code, bits) in [
        ("24-S", Some(32)),
        ("24M-S", Some(48)),
        ("24-R", Some(5 * 8)),
        ("23M-T", Some(11 * 8)),
        ("16-D", Some(5 * 8)),
        ("24M-D", Some(8 * 8)),
        ("24-P", Some(5 * 8)),
        ("IP-75-ASI1", Some(6 * 8)),
        ("IP-75-ASI4", None),
        ("IP-75-SSI7", Some(30)),
        ("AVS58", Some(13)),
        ("AVM58", Some(25)),
    ] {
        assert_eq!(model(code).frame_bits(), bits, "{code}");
    }
}
