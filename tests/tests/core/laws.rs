//! Laws that hold of every layout.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::layouts::{Case, layouts};
use encoderscope::{
    bits::{self, BitString, Bits},
    format::Format,
    layout::{Coding, Covered, Field, Resolved, Role},
    profile::{Code, Parity},
    reading::{Checked, FaultKind, Values},
};
use encoderscope_tests::Noise;

/// The longest run of bits that is a number; longer ones only frame or repeat.
const NUMBER: u32 = 64;

fn random_bits(noise: &mut Noise, len: usize) -> BitString {
    let mut bits = BitString::zeros(len);
    for start in (0..len).step_by(32) {
        let len = (len - start).min(32);
        bits.write(bits::Span::new(start, len), noise.draw());
    }
    bits
}

/// A number that a field can hold.
fn random_number(noise: &mut Noise, layout: &Resolved, field: &Field) -> u64 {
    let number = noise.draw() << 32 ^ noise.draw();
    let angle = bits::mask(layout.shape.profile.angle_bits as usize);
    match layout.coding(field) {
        Some((Coding::Decimal, _)) => number % 10u64.pow(field.width / 8).min(angle + 1),
        _ => number & bits::mask(field.width as usize),
    }
}

/// Whether the field carries a number that is free.
fn is_free(field: &Field) -> bool {
    let role = field.row.role;
    let decided = matches!(role, Role::Padding | Role::Framing | Role::Repeat);
    !decided && field.cover.is_none()
}

/// A good frame that says random numbers.
fn random_frame(noise: &mut Noise, case: &Case) -> BitString {
    let layout = &case.layout;
    let mut bits = layout.encode(&Values::default());
    for field in layout.fields().filter(|field| is_free(field)) {
        let number = random_number(noise, layout, field) & !field.row.zeros;
        layout.write(field, &mut bits, number);
    }
    layout.encode(&layout.values(bits.as_bits()))
}

/// Whether a check or a fixed value guards a bit of the frame.
fn is_guarded(layout: &Resolved, index: usize) -> bool {
    let holds = |field: &Field| {
        let mut parts = layout.parts(field).iter();
        parts.any(|part| part.span.contains(index))
    };
    let repeated = |field: &Field| {
        let word = layout.shape.frame_bits as usize;
        let again = layout.parts(field)[0].span;
        again.contains(index) || (again.start - word..again.start).contains(&index)
    };
    layout.fields().any(|field| {
        let covered = match field.cover.filter(|_| field.is_binding()) {
            Some((_, Covered::Run(span))) => span.contains(index) || holds(field),
            Some((_, Covered::Frame)) => true,
            None => false,
        };
        let fixed = field.row.constant.is_some() && holds(field);
        covered || fixed || (field.row.role == Role::Repeat && repeated(field))
    })
}

/// The fields whose bits may be turned over in a good frame without any check failing; `None`
/// where the format has no check.
fn unguarded(layout: &Resolved) -> Option<&'static [&'static str]> {
    let profile = &layout.shape.profile;
    match profile.format {
        Format::Rs485 | Format::T485 | Format::Bus | Format::Period | Format::Asi1 => Some(&[]),
        Format::As5048 => Some(&["idle", "tail"]),
        Format::BissC => Some(&["idle", "cds", "tail"]),
        Format::Ssi7 => Some(&["idle", "alarm", "tail"]),
        Format::SsiTree if profile.parity != Parity::None || layout.shape.repeats > 0 => {
            Some(&["idle", "tail"])
        }
        Format::Own if layout.fields().any(|field| field.row.role == Role::Crc) => {
            Some(&["idle", "cds", "tail"])
        }
        Format::Ssi | Format::SsiTree | Format::Asi4 | Format::Own => None,
    }
}

#[test]
fn spans_cover_every_bit_once() {
    for Case { name, layout } in layouts() {
        let mut seen = vec![0; layout.len];
        for field in layout.fields() {
            let width: usize = layout.parts(field).iter().map(|part| part.span.len).sum();
            assert_eq!(width, field.width as usize, "{name} {}", field.row.name);
            let mut place = field.width;
            for part in layout.parts(field) {
                place -= part.span.len as u32;
                assert_eq!(part.place, place, "{name} {}", field.row.name);
                seen[part.span.start..part.span.end()]
                    .iter_mut()
                    .for_each(|count| *count += 1);
            }
        }
        assert!(seen.iter().all(|count| *count == 1), "{name}: {seen:?}");
    }
}

#[test]
fn every_field_is_read_as_it_was_written_and_no_other_changes() {
    let mut noise = Noise::new(1);
    for Case { name, layout } in layouts() {
        let mut bits = random_bits(&mut noise, layout.len);
        for field in layout.fields() {
            let before: Vec<u64> = layout
                .fields()
                .map(|field| layout.read(field, bits.as_bits()))
                .collect();
            let number = random_number(&mut noise, layout, field);
            layout.write(field, &mut bits, number);
            for (other, before) in layout.fields().zip(before) {
                let own = other.row.name == field.row.name;
                assert_eq!(
                    layout.read(other, bits.as_bits()),
                    if own { number } else { before },
                    "{name} {} of {}",
                    other.row.name,
                    field.row.name
                );
            }
        }
    }
}

#[test]
fn encoding_and_decoding_are_inverse() {
    let mut noise = Noise::new(2);
    for Case { name, layout } in layouts() {
        let mut bits = layout.encode(&Values::default());
        for field in layout.fields().filter(|field| is_free(field)) {
            let number = random_number(&mut noise, layout, field) & !field.row.zeros;
            layout.write(field, &mut bits, number);
        }
        let sent = layout.values(bits.as_bits());
        let frame = layout.encode(&sent);
        for field in layout.fields().filter(|field| is_free(field)) {
            assert_eq!(
                layout.read(field, frame.as_bits()),
                layout.read(field, bits.as_bits()),
                "{name} {}",
                field.row.name
            );
        }
        let values = layout.values(frame.as_bits());
        let checks = Values {
            crc: values.crc,
            parity: values.parity,
            ..sent
        };
        assert_eq!(values, checks, "{name}");
        assert_eq!(layout.encode(&values), frame, "{name}");
        assert!(layout.holds(frame.as_bits()), "{name}");
        assert_eq!(layout.faults(frame.as_bits()), [], "{name}");
        let mut checks = values.crc.into_iter().chain(values.parity);
        assert!(checks.all(Checked::ok), "{name}");
        let reading = layout.reading(frame.as_bits()).unwrap();
        assert_eq!(reading.map(|reading| reading.angle), values.angle, "{name}");
    }
}

#[test]
fn a_flipped_bit_is_caught_where_it_is_guarded_and_changes_no_other_field() {
    let mut noise = Noise::new(3);
    for case in layouts() {
        let Case { name, layout } = case;
        let frame = random_frame(&mut noise, case);
        let numbers = |bits: Bits<'_>| -> Vec<u64> {
            let fields = layout.fields();
            fields.map(|field| layout.read(field, bits)).collect()
        };
        let before = numbers(frame.as_bits());
        for index in 0..layout.len {
            let mut flipped = frame.clone();
            flipped.flip(index);
            let own = layout.field_at(index).unwrap();
            let coding = layout.coding(own).map(|(coding, _)| coding);
            let caught = !layout.holds(flipped.as_bits());
            if coding != Some(Coding::Decimal) {
                let guarded = is_guarded(layout, index);
                assert_eq!(caught, guarded, "{name} bit {index} of {}", own.row.name);
            }
            if let Some(open) = unguarded(layout) {
                let open = open.contains(&own.row.name);
                assert_eq!(caught, !open, "{name} bit {index} of {}", own.row.name);
            }
            let after = numbers(flipped.as_bits());
            for ((field, before), after) in layout.fields().zip(&before).zip(&after) {
                if field.row.name == own.row.name {
                    let told = caught && coding == Some(Coding::Decimal) || own.width > NUMBER;
                    assert!(before != after || told, "{name} bit {index}");
                    continue;
                }
                // A bit of a Gray word turns all below it over; that law follows.
                if coding != Some(Coding::Gray) || layout.coding(field).is_none() {
                    assert_eq!(before, after, "{name} bit {index}: {}", field.row.name);
                }
            }
        }
    }
}

#[test]
fn a_flipped_bit_of_a_gray_word_turns_the_bits_from_it_down_over() {
    let mut noise = Noise::new(4);
    for case in layouts() {
        let Case { name, layout } = case;
        let word = layout.fields().find_map(|field| layout.coding(field));
        let Some((Coding::Gray, word)) = word else {
            continue;
        };
        let frame = random_frame(&mut noise, case);
        let before = bits::from_gray(frame.as_bits().read(word));
        let values = layout.values(frame.as_bits());
        for index in word.start..word.end() {
            let mut flipped = frame.clone();
            flipped.flip(index);
            let after = bits::from_gray(flipped.as_bits().read(word));
            assert_eq!(before ^ after, bits::mask(word.end() - index), "{name}");
            let caught = !layout.holds(flipped.as_bits());
            let mut found = layout.values(flipped.as_bits());
            assert_ne!(
                (found.turns, found.angle),
                (values.turns, values.angle),
                "{name}"
            );
            (found.turns, found.angle) = (values.turns, values.angle);
            if caught {
                found.parity = values.parity;
            }
            assert_eq!(found, values, "{name} bit {index}");
        }
    }
}

#[test]
fn a_sieve_judges_as_the_checks_themselves() {
    let mut noise = Noise::new(5);
    for case in layouts().iter().filter(|case| case.is_bytes()) {
        let Case { name, layout } = case;
        let plain = Resolved::new(layout.layout, layout.shape);
        let same = |bits: &BitString| {
            let holds = plain.holds(bits.as_bits());
            assert_eq!(layout.holds(bits.as_bits()), holds, "{name} {bits:?}");
            assert_eq!(plain.faults(bits.as_bits()).is_empty(), holds, "{name}");
            let faults = layout.faults(bits.as_bits());
            assert_eq!(faults, plain.faults(bits.as_bits()), "{name} {bits:?}");
            holds
        };
        for _ in 0..4 {
            same(&random_bits(&mut noise, layout.len));
        }
        let frame = random_frame(&mut noise, case);
        assert!(same(&frame), "{name}");
        for index in 0..layout.len {
            let mut flipped = frame.clone();
            flipped.flip(index);
            let bits = flipped.as_bits();
            assert_eq!(layout.holds(bits), plain.holds(bits), "{name} bit {index}");
        }
        let mut wrong = frame;
        for field in layout.fields().filter(|field| is_free(field)) {
            let number = random_number(&mut noise, layout, field);
            layout.write(field, &mut wrong, number);
        }
        same(&wrong);
        layout.seal(&mut wrong, Role::Parity);
        layout.seal(&mut wrong, Role::Crc);
        same(&wrong);
    }
}

#[test]
fn notes_cover_every_bit_once_and_say_what_it_is() {
    let mut noise = Noise::new(6);
    for case in layouts() {
        let Case { name, layout } = case;
        let frames = [
            random_frame(&mut noise, case),
            random_bits(&mut noise, layout.len),
        ];
        for frame in frames {
            let notes = layout.explain(frame.as_bits());
            let mut seen = vec![0; layout.len];
            for note in &notes {
                assert!(note.doc.len() > 5, "{name} {} has no doc", note.name);
                for span in &note.spans {
                    seen[span.start..span.end()]
                        .iter_mut()
                        .for_each(|count| *count += 1);
                }
                for bit in &note.bits {
                    assert!(
                        note.spans.iter().any(|span| span.contains(bit.at)),
                        "{name} {}",
                        bit.name
                    );
                    assert!(bit.doc.len() > 10, "{name} {} has no doc", bit.name);
                }
            }
            assert!(seen.iter().all(|count| *count == 1), "{name}: {seen:?}");
            let faults: Vec<_> = notes.iter().filter_map(|note| note.fault).collect();
            assert_eq!(faults, layout.faults(frame.as_bits()), "{name}");
            assert_eq!(faults.is_empty(), layout.holds(frame.as_bits()), "{name}");
        }
    }
}

#[test]
fn a_fixed_field_with_another_value_is_named_by_its_fault() {
    let mut noise = Noise::new(7);
    for case in layouts() {
        let Case { name, layout } = case;
        let frame = random_frame(&mut noise, case);
        for field in layout.fields() {
            let Some(constant) = field.row.constant else {
                continue;
            };
            let row = field.row;
            let mut wrong = frame.clone();
            let received = constant ^ bits::mask(field.width as usize);
            layout.write(field, &mut wrong, received);
            layout.seal(&mut wrong, Role::Parity);
            layout.seal(&mut wrong, Role::Crc);
            assert!(!layout.holds(wrong.as_bits()), "{name} {}", row.name);
            let expected = match row.role {
                Role::Padding => FaultKind::Wider { name: row.name },
                _ => FaultKind::Constant {
                    name: row.name,
                    expected: constant,
                    received,
                },
            };
            let faults = layout.faults(wrong.as_bits());
            let found = faults.iter().any(|fault| fault.kind == expected);
            assert!(found, "{name} {}: {faults:?}", row.name);
            assert!(layout.reading(wrong.as_bits()).is_err(), "{name}");
        }
    }
}

#[test]
fn what_carries_no_number_is_fixed_but_for_what_the_manuals_leave_open() {
    for Case { name, layout } in layouts() {
        for field in layout.fields() {
            let row = field.row;
            let gray = layout.shape.code == Code::Gray;
            let open = match row.name {
                "idle" | "tail" | "cds" | "marker" | "unknown" => true,
                "trailing" => gray,
                // What a user's layout skips.
                _ => layout.shape.own.is_some() && row.constant.is_none(),
            };
            match row.role {
                Role::Framing => assert_eq!(row.constant.is_none(), open, "{name} {}", row.name),
                Role::Padding => assert_eq!(row.constant, Some(0), "{name} {}", row.name),
                _ => assert_eq!(row.constant, None, "{name} {}", row.name),
            }
        }
    }
}
