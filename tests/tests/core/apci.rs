//! The registers of the APCI-1710.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    apci1710::{
        Access, Channel, FASTEST, Form, MODULE_BYTES, Register, Word, WordError, divider, frq,
    },
    reading::Values,
};
use encoderscope_tests::{Noise, decoder};

#[test]
fn the_registers_stand_where_the_article_says() {
    let expected = [
        ("frq", 0, Access::Write, 16),
        ("status", 0, Access::Read, 32),
        ("counts", 4, Access::Write, 8),
        ("shift-1", 4, Access::Read, 32),
        ("start", 8, Access::Write, 32),
        ("shift-2", 8, Access::Read, 32),
        ("control", 12, Access::Write, 8),
        ("shift-3", 12, Access::Read, 32),
        ("output", 16, Access::Write, 32),
        ("identity", 60, Access::Read, 32),
    ];
    let registers = Register::ALL.map(|register| {
        (
            register.name(),
            register.offset(),
            register.access(),
            register.width(),
        )
    });
    assert_eq!(registers, expected);
    for (index, register) in Register::ALL.into_iter().enumerate() {
        assert!(register.offset() + 4 <= MODULE_BYTES);
        assert_eq!(register.place(2), 128 + register.offset());
        // Of one offset one is read and one is written.
        let alike = Register::ALL.into_iter().skip(index + 1);
        let alike = alike.filter(|other| other.offset() == register.offset());
        assert!(
            alike
                .into_iter()
                .all(|other| other.access() != register.access())
        );
    }
}

#[test]
fn every_bit_of_a_register_is_explained_once() {
    let mut noise = Noise::new(71);
    for register in Register::ALL {
        for _ in 0..100 {
            let value = noise.draw() as u32;
            let notes = register.notes(value);
            let mut covered = vec![0; register.width()];
            let mut whole = 0;
            for note in &notes {
                assert!(
                    !note.doc.is_empty() && !note.text.is_empty(),
                    "{}",
                    note.name
                );
                for span in &note.spans {
                    covered[span.start..span.end()]
                        .iter_mut()
                        .for_each(|times| *times += 1);
                    whole |= note.raw << (register.width() - span.end());
                }
            }
            assert!(
                covered.iter().all(|times| *times == 1),
                "{}",
                register.title()
            );
            let width = register.width() as u32;
            let kept = u64::from(value) & (u64::MAX >> (64 - width));
            assert_eq!(whole, kept, "{}", register.title());
        }
    }
}

fn says(register: Register, value: u32, field: &str) -> String {
    let notes = register.notes(value);
    let note = notes.into_iter().find(|note| note.name == field);
    note.expect("a field of the name").text
}

#[test]
fn status_is_table_5() {
    let status = |value, field| says(Register::Status, value, field);
    assert_eq!(status(0, "busy"), "done: the words are in SHIFT");
    assert_eq!(status(1, "busy"), "the word is on its way");
    for (bit, field) in [(1, "data_1"), (2, "data_2"), (3, "data_3")] {
        assert_eq!(status(0, field), "the line is low");
        assert_eq!(status(1 << bit, field), "the line is high");
    }
    for (bit, field) in [(4, "input_1"), (5, "input_2"), (6, "input_3")] {
        assert_eq!(status(0, field), "the input is high");
        assert_eq!(status(1 << bit, field), "the input is low");
    }
    assert_ne!(status(1 << 7, "unused"), status(0, "unused"));
}

#[test]
fn the_other_registers_say_what_they_do() {
    assert_eq!(says(Register::Frq, 0, "divider"), "the PCI clock through 2");
    assert_eq!(
        says(Register::Frq, 50, "divider"),
        "the PCI clock through 100"
    );
    assert_eq!(says(Register::Counts, 25, "bits"), "25 bits, 26 clocks");
    assert_eq!(says(Register::Counts, 32, "bits"), "32 bits, 33 clocks");
    for (channel, field) in Channel::ALL.into_iter().zip(["gray_1", "gray_2", "gray_3"]) {
        assert_eq!(
            says(Register::Control, channel.control(), field),
            "Gray code becomes binary"
        );
        assert_eq!(
            says(Register::Control, !channel.control(), field),
            "the word stays as it comes"
        );
    }
    assert_eq!(says(Register::Output, 1, "output"), "the output is on");
    let identity = u32::from_be_bytes(*b"SI10");
    assert_eq!(
        says(Register::Identity, identity, "function"),
        "SI: Synchronous Serial Interface"
    );
    assert_eq!(
        says(Register::Identity, identity, "revision"),
        "10: revision 1.0"
    );
    assert_eq!(
        says(Register::Identity, u32::from_be_bytes(*b"MC2!"), "function"),
        "MC"
    );
    assert!(says(Register::Identity, 0, "function").contains("no letters"));
}

#[test]
fn values_are_entered_in_three_bases() {
    for text in ["165", "0xA5", "0XA5", "0b1010_0101", " 1 65 ", "0b10100101"] {
        assert_eq!(Register::Counts.entered(text), Ok(165), "{text}");
    }
    for register in Register::ALL {
        let most = u64::MAX >> (64 - register.width());
        assert_eq!(register.entered(&format!("{most:#x}")), Ok(most as u32));
        let fault = register.entered(&(most + 1).to_string()).unwrap_err();
        assert!(fault.contains("does not fit"), "{fault}");
        for text in [
            "",
            "-1",
            "0x",
            "0b2",
            "0b",
            "SI10",
            "1e3",
            "1.5",
            "é0",
            "99999999999999999999999",
        ] {
            assert!(register.entered(text).is_err(), "{text}");
        }
    }
}

#[test]
fn the_divider_is_twice_frq_but_for_0() {
    assert_eq!(
        (divider(0), divider(1), divider(50), divider(u16::MAX)),
        (2, 2, 100, 131_070)
    );
    for value in 1..=u16::MAX {
        // Each divider is found again from the clock that it makes.
        let clock = 33e6 / f64::from(divider(value));
        assert_eq!(frq(33e6, clock), Some(value));
    }
    let fastest = frq(33e6, f64::from(FASTEST)).map(divider);
    assert_eq!(fastest, Some(34));
    for (pci, wished) in [
        (33e6, 0.0),
        (33e6, -1.0),
        (33e6, f64::NAN),
        (f64::NAN, 1.0),
        (f64::INFINITY, 1.0),
        (0.0, 1.0),
    ] {
        assert_eq!(frq(pci, wished), None);
    }
}

#[test]
fn an_18_bit_encoder_stands_in_a_word_of_25_bits() {
    // P+F article, register COUNTS: four zeros, eight bits of turns, ten of angle, three zeros.
    let decoder = decoder("format=ssi-tree angle-bits=10 turns-bits=8 code=binary");
    assert_eq!(decoder.profile().frame_bits, 25);
    let word = Word::read(
        &decoder,
        0b1010_0101 << 13 | 0b11_0000_1111 << 3,
        Form::Plain,
    )
    .unwrap();
    let spans: Vec<_> = word
        .notes
        .iter()
        .map(|note| (note.name, note.spans[0].start, note.spans[0].len))
        .collect();
    assert_eq!(
        spans,
        [
            ("above", 0, 7),
            ("leading", 7, 4),
            ("turns", 11, 8),
            ("angle", 19, 10),
            ("trailing", 29, 3)
        ]
    );
    assert!(word.ok);
    assert_eq!(
        (word.values.turns, word.values.angle),
        (Some(0b1010_0101), Some(0b11_0000_1111))
    );
}

#[test]
fn a_word_that_the_board_has_converted_is_read_as_one_that_it_has_not() {
    let mut noise = Noise::new(1710);
    for parameters in [
        "format=ssi-tree",
        "format=ssi-tree turns-bits=0",
        "format=ssi-tree angle-bits=10 turns-bits=8",
        "format=ssi-tree code=binary parity=odd",
        "format=ssi-tree align=right angle-bits=16 turns-bits=14 frame-bits=32",
        "format=ssi angle-bits=24 turns-bits=0",
        "format=ssi7",
        "format=biss-c angle-bits=16 turns-bits=0",
    ] {
        let decoder = decoder(parameters);
        let profile = *decoder.profile();
        for _ in 0..200 {
            let below = |bits: u32, noise: &mut Noise| noise.draw() & ((1 << bits) - 1);
            let values = Values {
                angle: Some(below(profile.angle_bits, &mut noise)),
                turns: (profile.turns_bits > 0)
                    .then(|| below(profile.turns_bits, &mut noise) as i64),
                ..Values::default()
            };
            for form in [Form::Plain, Form::Converted] {
                let register = Word::write(&decoder, &values, form).unwrap();
                let word = Word::read(&decoder, register, form).unwrap();
                assert!(word.ok, "{parameters} {form:?} {register:08x}");
                assert_eq!(word.values.angle, values.angle, "{parameters} {form:?}");
                assert_eq!(word.values.turns, values.turns, "{parameters} {form:?}");
                let len: usize = word
                    .notes
                    .iter()
                    .flat_map(|note| &note.spans)
                    .map(|span| span.len)
                    .sum();
                assert_eq!(len, 32);
                let above = 32 - word.line.as_bits().len() as u32;
                if above > 0 {
                    let stray = Word::read(&decoder, register | 1 << 31, form).unwrap();
                    assert!(!stray.ok && stray.values == word.values);
                    assert!(stray.notes[0].text.starts_with("not zero"));
                }
            }
        }
    }
}

#[test]
fn what_no_register_holds_is_said() {
    let read = |parameters| Word::read(&decoder(parameters), 0, Form::Plain).unwrap_err();
    assert_eq!(read("format=t485"), WordError::NotClocked);
    assert_eq!(read("format=ssi"), WordError::TooLong { bits: 48 });
    assert_eq!(
        read("format=ssi-tree frame-bits=33"),
        WordError::TooLong { bits: 33 }
    );
    assert!(read("format=ssi").to_string().contains("48 bits"));
}
