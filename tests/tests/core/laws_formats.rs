//! Laws of T485 and BUS, and of what several formats share.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::layouts::widths;
use encoderscope::{
    bits::{self, Bits, Span},
    decode::Decoder,
    explain::Note,
    format::{Format, bus},
    layout::{Field, Resolved, Role, Shape},
    profile::Profile,
    reading::{FaultKind, Values},
};
use encoderscope_tests::decoder;

/// Names of the bits that are set in a note.
fn names(note: &Note) -> Vec<&'static str> {
    let set = note.bits.iter().filter(|bit| bit.set);
    set.map(|bit| bit.name).collect()
}

fn field(layout: &Resolved, role: Role) -> &Field {
    let mut fields = layout.fields();
    fields.find(|field| field.row.role == role).unwrap()
}

#[test]
fn named_bits_stand_where_the_manual_says() {
    let decoder = decoder("format=rs485 command=d");
    let frame = [0, 0, 0, 0, 0, 0b0110_0000, 0];
    let notes = decoder.main_layout().explain(Bits::of_bytes(&frame));
    let status = notes.iter().find(|note| note.name == "status").unwrap();
    let set: Vec<_> = status
        .bits
        .iter()
        .filter(|bit| bit.set)
        .map(|bit| (bit.name, bit.at))
        .collect();
    assert_eq!(set, [("battery disconnected", 5 * 8 + 2)]);
    let warning = notes.iter().find(|note| note.name == "warning").unwrap();
    assert_eq!(
        (warning.raw, warning.spans[0]),
        (1, Span::new(5 * 8 + 1, 1))
    );
}

/// MPP and PT, "Status bits": b5 … b0.
#[test]
fn the_status_bits_have_one_meaning_in_all_formats_of_mpp_and_pt() {
    let table = [
        "overspeed",
        "temperature out of range",
        "field too weak",
        "field too strong",
        "battery low",
        "battery disconnected",
    ];
    for parameters in [
        "format=ssi",
        "format=biss-c",
        "format=biss-c status-active=low",
        "format=rs485 command=d",
        "format=period",
        "format=bus",
    ] {
        let decoder = decoder(parameters);
        for (place, name) in table.iter().enumerate() {
            let values = Values {
                status: Some(1 << place),
                ..Values::default()
            };
            let frame = decoder.encode(&values);
            let layout = decoder.main_layout();
            let found = layout.values(frame.as_bits());
            assert_eq!(found.status, values.status, "{parameters} {name}");
            let notes = layout.explain(frame.as_bits());
            let note = notes.iter().find(|note| note.name == "status").unwrap();
            assert_eq!(names(note), [*name], "{parameters}");
            let low = parameters.ends_with("low");
            let raw = if low { 0x3f ^ (1 << place) } else { 1 << place };
            assert_eq!(note.raw, raw, "{parameters} {name}");
        }
    }
}

#[test]
fn an_error_is_encoded_where_the_format_has_its_bit() {
    for parameters in [
        "format=ssi",
        "format=biss-c",
        "format=rs485 command=d",
        "format=t485",
        "format=bus",
        "format=period",
        "format=asi1",
        "format=ssi7",
    ] {
        let decoder = decoder(parameters);
        for error in [false, true] {
            let values = Values {
                error: Some(error),
                ..Values::default()
            };
            let frame = decoder.encode(&values);
            let layout = decoder.main_layout();
            let found = layout.values(frame.as_bits());
            assert_eq!(found.error, Some(error), "{parameters}");
            assert_eq!(found.valid.unwrap_or(!error), !error, "{parameters}");
            let reading = layout.reading(frame.as_bits()).unwrap().unwrap();
            assert_eq!(reading.error, error, "{parameters}");
        }
    }
}

#[test]
fn turns_below_zero_are_read_where_the_profile_says_so() {
    for format in Format::ALL {
        if !format.parameters().contains(&"turns-code") {
            continue;
        }
        for name in widths(*format) {
            let pairs = |code| {
                let pairs = name.split(' ').map(|pair| pair.split_once('=').unwrap());
                Profile::parse(pairs.chain([("turns-code", code)])).unwrap()
            };
            let (signed, unsigned) = (pairs("signed"), pairs("unsigned"));
            let width = signed.turns_bits as usize;
            if width == 0 {
                continue;
            }
            let table = decoder_table(signed);
            let layout = Resolved::new(table, Shape::of(signed));
            let plain = Resolved::new(table, Shape::of(unsigned));
            let half = 1i64 << (width - 1);
            for turns in [-half, -1, 0, half - 1] {
                let values = Values {
                    turns: Some(turns),
                    operation: Some(3).filter(|_| *format == Format::T485),
                    ..Values::default()
                };
                let frame = layout.encode(&values);
                let found = layout.values(frame.as_bits());
                assert_eq!(found.turns, Some(turns), "{name}");
                let reading = layout.reading(frame.as_bits()).unwrap().unwrap();
                assert_eq!(reading.turns, Some(turns), "{name}");
                let code = turns as u64 & bits::mask(width);
                let found = plain.values(frame.as_bits());
                assert_eq!(found.turns, Some(code as i64), "{name}");
            }
        }
    }
}

fn decoder_table(profile: Profile) -> &'static encoderscope::layout::Layout {
    Decoder::new(profile).unwrap().main_layout().layout
}

#[test]
fn a_number_wider_than_the_profile_gives_no_reading() {
    let decoder = decoder("format=t485 angle-bits=17");
    let frame = [0x02, 0x20, 0xb4, 0xbd, 0x1c, 0x37];
    let frame = decoder.frame(&frame).unwrap();
    assert!(frame.values().crc.unwrap().ok());
    assert!(!frame.ok());
    assert!(frame.reading().is_none());
    assert!(frame.faults()[0].kind.to_string().contains("wider"));
}

/// MPP and PT "T485", note on E; Tamagawa, ALMC.
#[test]
fn the_alarm_byte_of_t485_is_named_by_its_dialect() {
    let tables: [(&str, [Option<&str>; 8]); 2] = [
        (
            "mpp",
            [
                None,
                None,
                None,
                None,
                None,
                None,
                Some("battery low"),
                Some("battery disconnected"),
            ],
        ),
        (
            "tamagawa",
            [
                Some("overspeed"),
                Some("full absolute status"),
                Some("counting error"),
                Some("counter overflow"),
                Some("overheat"),
                Some("multi-turn error"),
                Some("battery error"),
                Some("battery alarm"),
            ],
        ),
    ];
    for (dialect, table) in tables {
        let decoder = decoder(&format!("format=t485 dialect={dialect}"));
        for (place, name) in table.iter().enumerate() {
            let values = Values {
                alarm: Some(1 << place),
                ..Values::default()
            };
            let bytes = decoder.encode(&values).into_bytes();
            assert_eq!((bytes[0], bytes[9]), (0x1a, 1 << place), "{dialect}");
            let frame = decoder.frame(&bytes).unwrap();
            assert_eq!(frame.values().alarm, values.alarm, "{dialect}");
            let notes = frame.explain();
            let note = notes.iter().find(|note| note.name == "alarm").unwrap();
            assert_eq!(names(note), Vec::from_iter(*name), "{dialect} b{place}");
            assert_ne!(note.text, "all well", "{dialect} b{place}");
        }
    }
}

/// MPP "BUS": the sense of the parity is not proved by any capture, so it is shown only.
#[test]
fn the_parity_of_bus_is_reported_and_never_fails_a_frame() {
    for parity in ["odd", "even", "none"] {
        for operation in bus::Operation::ALL {
            let decoder = decoder(&format!("format=bus parity={parity}"));
            for address in 0..32 {
                let values = Values {
                    operation: Some(operation.code()),
                    address: Some(address),
                    ..Values::default()
                };
                let mut frame = decoder.encode(&values);
                let before = frame.as_bits().bytes()[0];
                let right = decoder.layout(&[before]).unwrap().values(frame.as_bits());
                assert_eq!(right.parity.is_none(), parity == "none");
                frame.flip(0);
                let byte = frame.as_bits().bytes()[0];
                assert_eq!(byte, before ^ 0x80);
                let layout = decoder.layout(&[byte]).unwrap();
                assert!(!layout.holds(frame.as_bits()), "{parity} {byte:02x}: CRC");
                layout.seal(&mut frame, Role::Crc);
                assert!(layout.holds(frame.as_bits()), "{parity} {byte:02x}");
                assert_eq!(layout.faults(frame.as_bits()), [], "{parity} {byte:02x}");
                let wrong = layout.values(frame.as_bits());
                assert_eq!(
                    (wrong.operation, wrong.address, wrong.angle),
                    (right.operation, right.address, right.angle)
                );
                let bytes = frame.into_bytes();
                assert!(decoder.frame(&bytes).unwrap().ok());
                let (Some(right), Some(wrong)) = (right.parity, wrong.parity) else {
                    continue;
                };
                let odd = u64::from(before.count_ones() % 2);
                assert_eq!(odd, u64::from(parity == "odd"), "{before:02x}");
                assert!(right.ok() && !wrong.ok(), "{parity} {byte:02x}");
                assert_eq!(wrong.expected, right.received);
                assert_eq!(wrong.received, 1 - right.received);
                let notes = layout.explain(Bits::of_bytes(&bytes));
                let note = notes.iter().find(|note| note.name == "parity").unwrap();
                assert_eq!(note.fault, None);
                assert!(note.text.contains("fails"), "{}", note.text);
            }
        }
    }
}

#[test]
fn nothing_answers_the_operation_11_of_bus() {
    for parity in ["odd", "even", "none"] {
        let decoder = decoder(&format!("format=bus parity={parity}"));
        for byte in 0..=255u8 {
            let known = (byte >> 5) & 3 != 3;
            assert_eq!(decoder.layout(&[byte]).is_some(), known, "{byte:02x}");
        }
    }
}

/// MPP "T485", status field: b3…b0 are 0.
#[test]
fn bits_of_t485_that_are_always_0_are_not_set_in_a_good_frame() {
    let decoder = decoder("format=t485");
    let layout = decoder.main_layout();
    let status = field(layout, Role::Status);
    for code in 0..=255 {
        let mut frame = decoder.encode(&Values::default());
        layout.write(status, &mut frame, code);
        layout.seal(&mut frame, Role::Crc);
        let good = code & 0x0f == 0;
        assert_eq!(layout.holds(frame.as_bits()), good, "{code:02x}");
        let zeros = FaultKind::Zeros { name: "status" };
        let faults = layout.faults(frame.as_bits());
        let found = faults.iter().any(|fault| fault.kind == zeros);
        assert_eq!(found, !good, "{code:02x}");
        let error = layout.values(frame.as_bits()).error;
        assert_eq!(error, Some(code & 0x20 != 0), "{code:02x}");
    }
}
