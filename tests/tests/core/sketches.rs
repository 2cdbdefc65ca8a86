#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::{BitString, Bits},
    check::Checksum,
    conversation::Conversation,
    decode::Decoder,
    dump::Direction,
    format::{Format, own},
    profile::{Dialect, Profile},
    sequence::{Change, Holds},
    sketch::{Checks, FrameKind, Heard, Refusal, Sketch},
};
use encoderscope_tests::decoder;

fn copied(bits: Bits<'_>) -> BitString {
    let mut out = BitString::default();
    (0..bits.len()).for_each(|at| out.push(bits.bit(at)));
    out
}

/// A decoder for every format, the dialects of T485 and every shipped layout.
fn decoders() -> Vec<Decoder> {
    let formats = Format::ALL.iter().map(|format| format.default_profile());
    let tamagawa = Profile {
        dialect: Dialect::Tamagawa,
        ..Format::T485.default_profile()
    };
    let shipped = own::SHIPPED
        .iter()
        .map(|shipped| Profile::parse([("format", "own"), ("layout", shipped.text)]).unwrap());
    let all = formats.chain([tamagawa]).chain(shipped);
    all.map(|profile| Decoder::new(profile).unwrap()).collect()
}

fn kinds() -> Vec<(Decoder, FrameKind)> {
    let with = |decoder: Decoder| {
        let kinds = decoder.frame_kinds().into_iter();
        kinds
            .map(move |kind| (decoder.clone(), kind))
            .collect::<Vec<_>>()
    };
    decoders().into_iter().flat_map(with).collect()
}

#[test]
fn examples_are_good_and_known_again() {
    for (decoder, kind) in kinds() {
        let (name, title) = (kind.name.clone(), kind.title.clone());
        assert!(!title.is_empty(), "{name}");
        let sketch = Sketch::new(decoder.clone(), kind);
        assert_eq!(sketch.bits().len(), sketch.kind().layout.len, "{name}");
        assert!(sketch.kind().layout.holds(sketch.bits()), "{name}: {title}");
        let again = Sketch::read(
            decoder.clone(),
            copied(sketch.bits()),
            Some(sketch.kind().direction),
        )
        .unwrap();
        assert_eq!(again.kind().name, name, "{title}");
        let text = sketch.text();
        let direction = Some(sketch.kind().direction);
        let written = Sketch::parse(decoder.clone(), &text, direction).unwrap();
        assert_eq!(
            (written.bits(), written.text()),
            (sketch.bits(), text),
            "{name}"
        );
        for field in sketch.kind().layout.fields() {
            let mut again = sketch.clone();
            let entry = sketch.entry(field.row.name).unwrap();
            again.enter(field.row.name, &entry, Checks::Stay).unwrap();
            assert_eq!(
                again.bits(),
                sketch.bits(),
                "{name}, {}: {entry}",
                field.row.name
            );
        }
        match (sketch.kind().direction, sketch.heard()) {
            (Direction::Sent, Heard::Answer(answer)) => {
                let reply = Sketch::read(decoder, BitString::of_bytes(answer), None).unwrap();
                assert_eq!(reply.kind().direction, Direction::Received, "{name}");
                assert!(reply.kind().layout.holds(reply.bits()), "{name}");
            }
            // The emulator's address is set in a sequence only.
            (Direction::Sent, Heard::Silence) => assert_eq!(name, "request-set-address"),
            (Direction::Received, Heard::Reading(_) | Heard::Good) => {}
            (_, heard) => panic!("{name}, {title}: {heard:?}"),
        }
    }
}

#[test]
fn every_flipped_bit_is_told_or_followed() {
    for (decoder, kind) in kinds() {
        let example = Sketch::new(decoder, kind);
        let good = example.heard();
        for index in 0..example.bits().len() {
            let name = &example.kind().name;
            let mut broken = example.clone();
            broken.flip(index, Checks::Stay);
            assert_ne!(broken.bits().bit(index), example.bits().bit(index));
            let mut mended = example.clone();
            mended.flip(index, Checks::Follow);
            let layout = &example.kind().layout;
            let field = layout.field_at(index).unwrap();
            if field.cover.is_some() {
                assert_eq!(mended.bits(), broken.bits(), "{name}, bit {index}");
                if field.is_binding() {
                    assert!(layout.fault(field, broken.bits()).is_some());
                    assert_ne!(broken.heard(), good, "{name}, bit {index}");
                }
                continue;
            }
            assert_ne!(mended.bits().bit(index), example.bits().bit(index));
            for check in layout.fields().filter(|field| field.cover.is_some()) {
                let checked = layout.checked(check, mended.bits()).unwrap();
                assert!(checked.ok(), "{name}, bit {index}");
            }
            // Back again is as before, whatever the checks did.
            broken.flip(index, Checks::Stay);
            mended.flip(index, Checks::Follow);
            assert_eq!(broken.bits(), example.bits());
            assert_eq!(mended.bits(), example.bits(), "{name}, bit {index}");
        }
    }
}

#[test]
fn a_walk_ends_where_the_check_does() {
    let mut walked = 0;
    for (decoder, kind) in kinds() {
        let sketch = Sketch::new(decoder, kind);
        let layout = &sketch.kind().layout;
        for field in layout.fields() {
            let walk = layout.walk(field, sketch.bits());
            assert_eq!(walk.is_some(), field.cover.is_some());
            let Some(walk) = walk else { continue };
            walked += 1;
            assert_eq!(Some(walk.result), layout.expected(field, sketch.bits()));
            let mut register = walk.start;
            let width = walk.algorithm.width;
            for step in &walk.steps {
                // The register by its definition: shift, and subtract where a 1 falls out.
                let out = register >> (width - 1) & 1 == 1;
                assert_eq!(step.subtracts, out != step.bit);
                register = register << 1 & ((1 << width) - 1);
                register ^= if step.subtracts {
                    walk.algorithm.polynomial
                } else {
                    0
                };
                assert_eq!(step.register, register);
            }
        }
    }
    assert!(walked > 20, "{walked}");
    // What the exclusive or of all bytes is, bit by bit.
    let bytes = Bits::of_bytes(&[0x1f, 0x00, 0x56, 0x34, 0x12, 0x05, 0x00]);
    let all = encoderscope::bits::Span::new(0, 56);
    assert_eq!(Checksum::Crc8Xor.walk(bytes, all).result, 0x6a);
}

#[test]
fn values_are_entered_as_people_write_them() {
    let decoder = decoder("format=biss-c angle-bits=17 turns-bits=16");
    let kind = decoder.frame_kinds().remove(0);
    let mut sketch = Sketch::new(decoder, kind);
    let angle = |sketch: &Sketch| {
        let Heard::Reading(reading) = sketch.heard() else {
            panic!("{:?}", sketch.heard());
        };
        (reading.turns.unwrap(), reading.angle)
    };
    for (text, counts) in [
        ("180°", 65_536),
        ("180,0", 65_536),
        ("0x1_0000".replace('_', "").as_str(), 65_536),
        ("65 536", 65_536),
        ("0b101", 5),
        ("359.99999°", 0),
        ("0°", 0),
    ] {
        sketch.enter("angle", text, Checks::Follow).unwrap();
        assert_eq!(angle(&sketch).1, counts, "{text}");
    }
    sketch.enter("turns", "65535", Checks::Follow).unwrap();
    assert_eq!(angle(&sketch).0, 65_535);
    let before = copied(sketch.bits());
    let refused = |name: &str, text: &str| {
        let mut sketch = sketch.clone();
        let why = sketch.enter(name, text, Checks::Follow).unwrap_err();
        assert_eq!(sketch.bits(), before.as_bits());
        why
    };
    assert_eq!(refused("turns", "65536").to_string(), "0 to 65535 fit");
    assert_eq!(refused("turns", "-1").to_string(), "0 to 65535 fit");
    assert_eq!(refused("angle", "360°"), Refusal::Turn);
    assert_eq!(refused("angle", "NaN°"), Refusal::NoNumber);
    assert_eq!(refused("angle", "1e400°"), Refusal::NoNumber);
    for nonsense in ["", "°", "0x", "five", "0b2", "1.2.3"] {
        assert_eq!(refused("angle", nonsense), Refusal::NoNumber, "{nonsense}");
    }
    assert_eq!(refused("speed", "1"), Refusal::NoField);
    // A CRC that is entered stays as it is: broken on purpose.
    sketch.enter("crc", "0", Checks::Follow).unwrap();
    assert!(matches!(sketch.heard(), Heard::Faults(faults) if faults.len() == 1));
    sketch.mend();
    assert_eq!(sketch.bits(), before.as_bits());
}

#[test]
fn signed_numbers_and_tenths_are_entered() {
    let signed = decoder("format=rs485 command=t turns-code=signed");
    let kind = signed.frame_kinds().remove(1);
    let mut sketch = Sketch::new(signed, kind);
    sketch.enter("turns", "−3", Checks::Follow).unwrap();
    sketch
        .enter("temperature", "-12,5", Checks::Follow)
        .unwrap();
    let values = sketch.kind().layout.values(sketch.bits());
    assert_eq!((values.turns, values.temperature), (Some(-3), Some(-125)));
    let refusal = sketch.enter("temperature", "4000", Checks::Follow);
    assert_eq!(refusal.unwrap_err().to_string(), "-3276.8 to 3276.7 fit");
}

#[test]
fn a_request_nobody_knows_is_met_with_silence() {
    let bus = decoder("format=bus");
    let get = bus.frame_kinds().remove(0);
    let mut sketch = Sketch::new(bus, get);
    assert!(matches!(sketch.heard(), Heard::Answer(_)));
    sketch.enter("address", "3", Checks::Follow).unwrap();
    assert_eq!(sketch.heard(), Heard::Silence);
}

#[test]
fn conversations_end_with_the_change() {
    let mut all = 0;
    for decoder in decoders() {
        let profile = *decoder.profile();
        for change in Change::all(&profile) {
            let said = Conversation::of(&profile, change).unwrap();
            assert_eq!(said.holds, Holds::New, "{}", said.title);
            let times: Vec<_> = said.lines.iter().map(|line| line.at).collect();
            assert!(times.is_sorted());
            for line in &said.lines {
                let decoder = Decoder::new(line.profile).unwrap();
                let sketch = Sketch::read(
                    decoder,
                    BitString::of_bytes(line.bytes.clone()),
                    Some(line.direction),
                );
                let sketch = sketch.unwrap();
                assert_eq!(sketch.kind().direction, line.direction, "{}", said.title);
                assert!(sketch.kind().layout.holds(sketch.bits()));
            }
            all += 1;
        }
    }
    assert_eq!(all, 1 + 2 + 4 + 2);
    assert_eq!(
        Conversation::of(&Format::Ssi.default_profile(), Change::Zero),
        None
    );
}
