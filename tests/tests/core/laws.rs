#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::{self, Bits, Span},
    check::Checksum,
    format::{Format, t485},
    layout::{Resolved, Role},
};
use encoderscope_tests::{Noise, decoder};

/// Every layout at every width that its format allows.
fn layouts(mut run: impl FnMut(&str, &Resolved)) {
    for angle in 1..=24 {
        for turns in [0, 5, 8, 16] {
            let widths = format!("angle-bits={angle} turns-bits={turns}");
            for command in ["0", "1", "d", "s", "t"] {
                let name = format!("format=rs485 command={command} {widths}");
                run(&name, decoder(&name).main_layout());
            }
            let name = format!("format=t485 {widths}");
            let decoder_t485 = decoder(&name);
            for request in t485::Request::ALL {
                run(
                    &format!("{name} {request:?}"),
                    decoder_t485.layout(&[request.byte()]).unwrap(),
                );
            }
        }
    }
    for angle in (1..=48).step_by(1) {
        for turns in [0, 1, 16] {
            for status in [0, 6] {
                let name = format!(
                    "format=biss-c angle-bits={angle} turns-bits={turns} status-bits={status}"
                );
                run(&name, decoder(&name).main_layout());
            }
        }
    }
}

#[test]
fn spans_cover_every_bit_once() {
    layouts(|name, layout| {
        let mut seen = vec![0; layout.len];
        for field in layout.fields() {
            let width: usize = layout.parts(field).iter().map(|part| part.span.len).sum();
            assert_eq!(width, field.width as usize, "{name} {}", field.row.name);
            for part in layout.parts(field) {
                seen[part.span.start..part.span.end()]
                    .iter_mut()
                    .for_each(|count| *count += 1);
            }
        }
        assert!(seen.iter().all(|count| *count == 1), "{name}: {seen:?}");
    });
}

#[test]
fn every_field_is_read_as_it_was_written() {
    let mut noise = Noise::new(1);
    layouts(|name, layout| {
        for field in layout.fields() {
            let mut bits = bits::BitString::zeros(layout.len);
            let value = noise.draw().wrapping_mul(0x1_0000_0001) & bits::mask(field.width as usize);
            layout.write(field, &mut bits, value);
            assert_eq!(
                layout.read(field, bits.as_bits()),
                value,
                "{name} {}",
                field.row.name
            );
            for other in layout
                .fields()
                .filter(|other| other.row.name != field.row.name)
            {
                assert_eq!(
                    layout.read(other, bits.as_bits()),
                    0,
                    "{name} {}",
                    other.row.name
                );
            }
        }
    });
}

#[test]
fn encoding_and_decoding_are_inverse_and_every_flip_is_caught() {
    let mut noise = Noise::new(2);
    layouts(|name, layout| {
        let mut bits = layout.encode(&encoderscope::reading::Values::default());
        for field in layout.fields() {
            let free = !matches!(
                field.row.role,
                Role::Padding | Role::Framing | Role::Operation | Role::Crc | Role::Parity
            );
            if free {
                let value = noise.draw() & bits::mask(field.width as usize) & !field.row.zeros;
                layout.write(field, &mut bits, value);
            }
        }
        layout.seal(&mut bits, Role::Crc);
        assert!(layout.holds(bits.as_bits()), "{name}");
        let again = layout.encode(&layout.values(bits.as_bits()));
        assert_eq!(again, bits, "{name}");

        for index in 0..layout.len {
            let mut flipped = bits.clone();
            flipped.flip(index);
            let field = layout.field_at(index).unwrap();
            let before = layout.read(field, bits.as_bits());
            assert_ne!(
                layout.read(field, flipped.as_bits()),
                before,
                "{name} bit {index}"
            );
            // The line idle and the control data bit of BiSS-C stand outside of every check.
            let caught = !layout.holds(flipped.as_bits());
            let outside = ["idle", "cds"].contains(&field.row.name);
            assert_ne!(caught, outside, "{name} bit {index} of {}", field.row.name);
        }
    });
}

#[test]
fn notes_cover_every_bit_once() {
    layouts(|name, layout| {
        let bits = layout.encode(&encoderscope::reading::Values::default());
        let notes = layout.explain(bits.as_bits());
        let total: usize = notes
            .iter()
            .flat_map(|note| &note.spans)
            .map(|span| span.len)
            .sum();
        assert_eq!(total, layout.len, "{name}");
        for note in &notes {
            assert!(note.doc.len() > 10, "{name} {} has no doc", note.name);
            for bit in &note.bits {
                assert!(
                    note.spans.iter().any(|span| span.contains(bit.at)),
                    "{name} {}",
                    bit.name
                );
            }
        }
    });
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

#[test]
fn check_values_of_the_checksums() {
    let text = b"123456789";
    let all = Span::new(0, 72);
    let of = |sum: Checksum| sum.compute(Bits::of_bytes(text), all);
    assert_eq!(of(Checksum::Crc8x97), 0x94);
    assert_eq!(of(Checksum::Crc8Xor), 0x31);
    assert_eq!(of(Checksum::Crc6Biss), 0x2e);
    let moteus = [0b0001_0010, 0b0011_0100];
    assert_eq!(
        Checksum::Crc6Biss.compute(Bits::of_bytes(&moteus), Span::new(0, 16)),
        56 ^ 0x3f
    );
}

/// CRC-6 by long division, for lengths that are no multiple of eight.
#[test]
fn crc6_over_any_length_is_the_remainder_of_long_division() {
    let mut noise = Noise::new(3);
    for len in 1..=82 {
        let bytes: Vec<u8> = (0..12).map(|_| noise.draw() as u8).collect();
        let bits = Bits::of_bytes(&bytes);
        let span = Span::new(noise.below(96 - len) as usize, len as usize);
        let mut register = 0u32;
        for index in span.start..span.end() + 6 {
            let next = index < span.end() && bits.bit(index);
            register = (register << 1) | u32::from(next);
            if register & 0x40 != 0 {
                register ^= 0x43;
            }
        }
        let expected = u64::from(register ^ 0x3f);
        assert_eq!(Checksum::Crc6Biss.compute(bits, span), expected, "{len}");
    }
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

#[test]
fn names_of_formats_are_read_back() {
    for format in Format::ALL {
        assert_eq!(Format::parse(format.name()), Some(*format));
        assert_eq!(format.default_profile().check(), Ok(()));
    }
}

#[test]
fn an_error_is_encoded_where_the_format_has_its_bit() {
    for parameters in ["format=t485", "format=rs485 command=d", "format=biss-c"] {
        let decoder = decoder(parameters);
        let layout = decoder.main_layout();
        for error in [false, true] {
            let values = encoderscope::reading::Values {
                error: Some(error),
                operation: Some(3),
                ..Default::default()
            };
            let frame = layout.encode(&values);
            assert_eq!(
                layout.values(frame.as_bits()).error,
                Some(error),
                "{parameters}"
            );
        }
    }
}
