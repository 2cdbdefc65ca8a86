//! Laws of the streams of IP-75.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::{Bits, Span},
    check::Checksum,
    layout::Role,
    reading::{FaultKind, Values},
};
use encoderscope_tests::{Noise, decoder};

/// The six bytes of an ASI1 packet with the top bits 0, put together by hand from the columns of
/// IP-75, 5.3.1.
fn asi1_packet(valid: bool, zero_default: bool, position: u32) -> [u8; 6] {
    let mut bytes = [
        u8::from(valid) << 6 | u8::from(zero_default) << 5 | (position >> 19) as u8,
        (position >> 12) as u8 & 0x7f,
        (position >> 5) as u8 & 0x7f,
        (position << 2) as u8 & 0x7c,
        0,
        0,
    ];
    let crc = Checksum::Crc16x8005.compute(Bits::of_bytes(&bytes), Span::new(0, 48));
    bytes[3] |= (crc >> 14) as u8;
    bytes[4] = (crc >> 7) as u8 & 0x7f;
    bytes[5] = crc as u8 & 0x7f;
    bytes
}

#[test]
fn every_position_of_asi1_is_encoded_and_decoded() {
    let decoder = decoder("format=asi1");
    for position in 0..1 << 14 {
        for (valid, zero_default) in [(false, false), (false, true), (true, false), (true, true)] {
            let values = Values {
                angle: Some(position.into()),
                valid: Some(valid),
                zero_default: Some(zero_default),
                ..Values::default()
            };
            let packet = asi1_packet(valid, zero_default, position);
            assert_eq!(
                decoder.encode(&values).as_bits().bytes(),
                packet,
                "{position}"
            );
            let frame = decoder.frame(&packet).unwrap();
            assert!(frame.ok(), "{position}");
            let found = frame.values();
            let error = Some(!valid);
            let expected = Values {
                error,
                warning: Some(false),
                crc: found.crc,
                ..values
            };
            assert_eq!(found, expected, "{position}");
        }
    }
}

#[test]
fn wide_positions_of_asi1_stand_where_the_manual_says() {
    for width in 1..=22 {
        let decoder = decoder(&format!("format=asi1 angle-bits={width}"));
        for place in 0..22 {
            let packet = asi1_packet(true, false, 1 << place);
            let frame = decoder.frame(&packet).unwrap();
            assert_eq!(frame.ok(), place < width, "{width} {place}");
            if frame.ok() {
                assert_eq!(frame.values().angle, Some(1 << place), "{width}");
            }
        }
    }
}

/// IP-75, 5.3.1: what the top bits of the bytes are is open.
#[test]
fn the_top_bits_of_asi1_may_be_anything_as_long_as_the_crc_holds() {
    let mut noise = Noise::new(1);
    for marker in ["none", "first"] {
        let decoder = decoder(&format!("format=asi1 marker={marker}"));
        let layout = decoder.main_layout();
        let own = if marker == "first" { 0b10_0000 } else { 0 };
        for pattern in 0..64 {
            let values = Values {
                angle: Some(noise.below(1 << 14)),
                valid: Some(noise.below(2) == 1),
                zero_default: Some(noise.below(2) == 1),
                ..Values::default()
            };
            let mut frame = decoder.encode(&values);
            let sent = layout.values(frame.as_bits());
            let top = layout
                .fields()
                .find(|field| field.row.name == "marker")
                .unwrap();
            assert_eq!(layout.read(top, frame.as_bits()), own);
            layout.write(top, &mut frame, pattern);
            let expected = pattern == own;
            assert_eq!(layout.holds(frame.as_bits()), expected, "{pattern:06b}");
            layout.seal(&mut frame, Role::Crc);
            assert!(layout.holds(frame.as_bits()), "{pattern:06b}");
            let found = layout.values(frame.as_bits());
            let crc = sent.crc;
            assert_eq!(Values { crc, ..found }, sent, "{pattern:06b}");
            let bytes = frame.into_bytes();
            let tops = bytes.iter().fold(0, |sum, byte| sum << 1 | byte >> 7);
            assert_eq!(u64::from(tops), pattern);
        }
    }
}

/// IP-75, 5.3.2, whose range ends one too high: 14 bits end at 16383.
#[test]
fn every_number_of_asi4_up_to_16383_is_read_and_every_larger_one_is_refused() {
    let decoder = decoder("format=asi4");
    for number in 0..100_000u64 {
        let line = format!("{number}\r\n");
        let frame = decoder.frame(line.as_bytes()).unwrap();
        let good = number <= 16_383;
        assert_eq!(frame.ok(), good, "{number}");
        if good {
            let values = frame.values();
            assert_eq!(values.angle, Some(number));
            assert_eq!(decoder.encode(&values).into_bytes(), line.as_bytes());
        } else {
            assert!(frame.reading().is_none(), "{number}");
            let kind = FaultKind::Range {
                name: "angle",
                value: number,
                most: 16_383,
            };
            assert_eq!(frame.faults()[0].kind, kind);
        }
    }
}

#[test]
fn a_line_of_asi4_of_any_width_ends_with_its_last_count() {
    for width in 1..=16 {
        let decoder = decoder(&format!("format=asi4 angle-bits={width}"));
        let last = (1u32 << width) - 1;
        for (number, good) in [(0, true), (last, true), (last + 1, false)] {
            for line in [format!("{number}\r\n"), format!("{number:05}\r\n")] {
                let frame = decoder.frame(line.as_bytes()).unwrap();
                assert_eq!(frame.ok(), good, "{width} {line:?}");
                assert_eq!(frame.values().angle, Some(number.into()), "{line:?}");
            }
        }
    }
}

#[test]
fn what_is_no_line_of_digits_is_no_frame_of_asi4() {
    let decoder = decoder("format=asi4");
    for line in [
        "\r\n",
        "1 3\r\n",
        "-13\r\n",
        "123456\r\n",
        "12\n",
        "12\r",
        "0x12\r\n",
        "",
    ] {
        assert!(decoder.frame(line.as_bytes()).is_none(), "{line:?}");
    }
    let layout = decoder.layout(b"123\r\n").unwrap();
    for (bytes, fault) in [
        (b"1a3\r\n", "angle has characters that are no digits"),
        (b"123\n\n", "cr is 1010, must be 1101"),
        (b"123\r\r", "lf is 1101, must be 1010"),
    ] {
        let faults = layout.faults(Bits::of_bytes(bytes));
        assert_eq!(faults.len(), 1, "{bytes:?}");
        assert_eq!(faults[0].kind.to_string(), fault);
    }
}
