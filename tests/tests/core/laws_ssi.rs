//! Laws of lines that hold a word of SSI.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::{layouts::widths, vectors_ssi::text};
use encoderscope::{
    bits::{self, BitString},
    decode::{Decoded, Decoder},
    format::Format,
    reading::{FaultKind, Values},
};
use encoderscope_tests::{Noise, decoder, paste};

fn random_values(noise: &mut Noise, decoder: &Decoder) -> Values {
    let profile = decoder.profile();
    let counted = profile.turns_bits > 0;
    let turns = noise.draw() & bits::mask(profile.turns_bits as usize);
    // A word that is not all zeros, whatever the turns are.
    let angle = (noise.draw() | 1) & bits::mask(profile.angle_bits as usize);
    let values = Values {
        turns: Some(turns as i64).filter(|_| counted),
        angle: Some(angle),
        error: Some(noise.below(2) == 1),
        warning: Some(noise.below(2) == 1),
        status: Some((noise.draw() & 0x3f) as u8),
        ..Values::default()
    };
    // What the format does not carry is not read back.
    let layout = decoder.main_layout();
    layout.values(layout.encode(&values).as_bits())
}

fn joined(parts: &[&str]) -> BitString {
    let mut out = BitString::default();
    for digit in parts.concat().chars() {
        out.push(digit == '1');
    }
    out
}

/// The values of all frames of a dump, which are all good.
fn dumped(decoder: &Decoder, text: &str) -> Vec<Values> {
    let mut found = Vec::new();
    decoder.dump(&paste(decoder, text), &mut |decoded| match decoded {
        Decoded::Frame(frame) => {
            assert!(frame.ok(), "{:?} {text}", decoder.profile());
            found.push(frame.values());
        }
        Decoded::Skip { .. } => panic!("{decoded:?}"),
    });
    found
}

/// A word in as few bytes as hold it, at their start or at their end; with spaces between the
/// bytes, since a run of 0 and 1 alone is taken for bits.
fn in_bytes(word: &str, left: bool, fill: &str) -> String {
    let spare = word.len().next_multiple_of(8) - word.len();
    let spare = fill.repeat(spare);
    let line = if left {
        joined(&[word, &spare])
    } else {
        joined(&[&spare, word])
    };
    let bytes = line.as_bits().bytes();
    let pairs: Vec<String> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    pairs.join(" ")
}

#[test]
fn a_word_in_hexadecimal_is_read_from_either_side_of_its_bytes() {
    let mut noise = Noise::new(1);
    for format in [Format::Ssi, Format::Ssi7, Format::SsiTree] {
        for name in widths(format) {
            for side in ["left", "right"] {
                let decoder = decoder(&format!("{name} justify={side}"));
                let sent: Vec<Values> = (0..3)
                    .map(|_| random_values(&mut noise, &decoder))
                    .collect();
                for fill in ["0", "1"] {
                    let lines: Vec<String> = sent
                        .iter()
                        .map(|values| {
                            let word = text(decoder.encode(values).as_bits());
                            in_bytes(&word, side == "left", fill)
                        })
                        .collect();
                    let found = dumped(&decoder, &lines.join("\n"));
                    assert_eq!(found, sent, "{name} {side}");
                }
            }
        }
    }
}

#[test]
fn a_string_of_0_and_1_is_read_at_its_own_length_from_both_sides() {
    let mut noise = Noise::new(2);
    for format in [Format::Ssi, Format::Ssi7, Format::SsiTree] {
        for name in widths(format) {
            let left = decoder(&format!("{name} justify=left"));
            let right = decoder(&format!("{name} justify=right"));
            let values = random_values(&mut noise, &left);
            let word = text(left.encode(&values).as_bits());
            assert_eq!(word, text(right.encode(&values).as_bits()), "{name}");
            if word.len() < 9 {
                continue;
            }
            assert_eq!(dumped(&left, &word), [values], "{name}");
            assert_eq!(dumped(&right, &word), [values], "{name}");
        }
    }
}

/// A number in wide bytes has zeros in front of it; other bits there say that the number is
/// wider than the profile.
#[test]
fn bits_in_front_of_a_right_aligned_word_are_zeros_or_line_idle() {
    for parameters in ["format=ssi angle-bits=17", "format=ssi7", "format=ssi-tree"] {
        let decoder = decoder(&format!("{parameters} justify=right"));
        let mut noise = Noise::new(3);
        let word = text(
            decoder
                .encode(&random_values(&mut noise, &decoder))
                .as_bits(),
        );
        for (front, good) in [
            ("00000", true),
            ("11111", true),
            ("00100", false),
            ("10000", false),
        ] {
            let line = joined(&[front, &word]);
            let frame = decoder.line(line.as_bits()).unwrap();
            assert_eq!(frame.ok(), good, "{parameters} {front}");
        }
        let short = joined(&[&word[1..]]);
        assert!(decoder.line(short.as_bits()).is_err(), "{parameters}");
    }
}

/// IP-75, 5.4.1: SSI2 of the IncOder family is the low 24 bits of the word.
#[test]
fn the_low_bits_of_an_ssi7_word_are_the_shorter_words() {
    let mut noise = Noise::new(4);
    let whole = decoder("format=ssi7 angle-bits=22");
    for _ in 0..100 {
        let values = random_values(&mut noise, &whole);
        let word = text(whole.encode(&values).as_bits());
        assert_eq!(word.len(), 30);
        for len in 24..=30 {
            let short = decoder(&format!("format=ssi7 angle-bits=22 frame-bits={len}"));
            let line = joined(&[&word[30 - len..]]);
            let frame = short.line(line.as_bits()).unwrap();
            assert!(frame.ok(), "{len}");
            assert_eq!(frame.values(), values, "{len}");
            assert_eq!(short.encode(&values), line, "{len}");
        }
    }
}

/// P+F article, "multi-transmission": 14 clocks a word of 13 bits, 26 a word of 25.
#[test]
fn a_repeated_word_agrees_or_the_fault_names_the_word() {
    let mut noise = Noise::new(5);
    for (parameters, clocks) in [("turns-bits=0", 14), ("turns-bits=12", 26)] {
        for code in ["gray", "binary"] {
            for side in ["left", "right"] {
                let decoder = decoder(&format!(
                    "format=ssi-tree {parameters} code={code} justify={side}"
                ));
                let values = random_values(&mut noise, &decoder);
                let word = text(decoder.encode(&values).as_bits());
                assert_eq!(word.len() + 1, clocks);
                for words in [2, 3] {
                    let line = joined(&[&vec![word.as_str(); words].join("0")]);
                    assert_repeats(&decoder, &line, &values, clocks);
                }
            }
        }
    }
}

fn assert_repeats(decoder: &Decoder, line: &BitString, values: &Values, clocks: usize) {
    let frame = decoder.line(line.as_bits()).unwrap();
    assert!(frame.ok(), "{:?}", frame.faults());
    assert_eq!(frame.values(), *values);
    let words = (line.as_bits().len() + 1) / clocks;
    assert_eq!(frame.layout.shape.repeats as usize + 1, words);
    assert_eq!(frame.layout.encode(values), *line);
    assert_eq!(dumped(decoder, &text(line.as_bits())), [*values]);
    for index in 0..line.as_bits().len() {
        let mut flipped = line.clone();
        flipped.flip(index);
        let frame = decoder.line(flipped.as_bits()).unwrap();
        assert!(!frame.ok(), "bit {index}");
        assert!(frame.reading().is_none(), "bit {index}");
        // The 0 between belongs to the word behind it, and the first word to the second.
        let word = ((index + 1) / clocks + 1).max(2) as u32;
        let named = FaultKind::Repeat { word };
        let faults = frame.faults();
        let found = faults.iter().any(|fault| fault.kind == named);
        assert!(found, "bit {index}: {faults:?}");
    }
}

/// P+F article, tables 1 and 4: turns end and the angle begins at the axis, whatever their
/// widths are.
#[test]
fn turns_and_angle_of_a_fir_tree_meet_at_the_axis() {
    for angle in 1..=13 {
        for turns in 1..=12 {
            let decoder = decoder(&format!(
                "format=ssi-tree code=binary angle-bits={angle} turns-bits={turns}"
            ));
            let values = Values {
                turns: Some(1),
                angle: Some(1 << (angle - 1)),
                ..Values::default()
            };
            let word = text(decoder.encode(&values).as_bits());
            assert_eq!(word, "0000000000011000000000000", "{turns} {angle}");
        }
    }
}

/// P+F article: turns and angle are one Gray word, so that one step of the shaft changes one bit
/// even where a turn ends.
#[test]
fn one_step_of_the_shaft_changes_one_bit_of_a_gray_word() {
    let decoder = decoder("format=ssi-tree turns-bits=5 angle-bits=7");
    let mut last: Option<BitString> = None;
    for position in 0..=1u64 << 12 {
        let values = Values {
            turns: Some((position >> 7 & 0x1f) as i64),
            angle: Some(position & 0x7f),
            ..Values::default()
        };
        let word = decoder.encode(&values);
        let frame = decoder.line(word.as_bits()).unwrap();
        assert_eq!(frame.values(), values);
        if let Some(last) = last {
            let changed = (0..25).filter(|at| word.as_bits().bit(*at) != last.as_bits().bit(*at));
            assert_eq!(changed.count(), 1, "{position}");
        }
        last = Some(word);
    }
}

/// An adapter reads more clocks than a word has; the line is idle or low for the rest of them,
/// which is no second word.
#[test]
fn one_word_alone_in_wide_bytes_is_not_taken_for_a_repeated_one() {
    let mut noise = Noise::new(6);
    for (parameters, len) in [("turns-bits=0", 13), ("turns-bits=12", 25)] {
        for side in ["left", "right"] {
            let decoder = decoder(&format!("format=ssi-tree {parameters} justify={side}"));
            let values = random_values(&mut noise, &decoder);
            let word = text(decoder.encode(&values).as_bits());
            for bytes in 4..=16 {
                for fill in ["0", "1"] {
                    let spare = fill.repeat(bytes * 8 - len);
                    let line = match side {
                        "left" => joined(&[&word, &spare]),
                        _ => joined(&[&spare, &word]),
                    };
                    let frame = decoder.line(line.as_bits()).unwrap();
                    let name = format!("{parameters} {side} {bytes} bytes of {fill}");
                    assert!(frame.ok(), "{name}: {:?}", frame.faults());
                    assert_eq!(frame.values(), values, "{name}");
                }
            }
        }
    }
}

/// MPP "BISS-C": a capture may begin with any number of ones, and an encoder may take its time
/// with the acknowledge.
#[test]
fn a_biss_line_with_any_idle_and_acknowledge_is_encoded_again() {
    let mut noise = Noise::new(7);
    let decoder = decoder("format=biss-c angle-bits=17");
    for idle in [1, 2, 5, 40, 63, 64, 65, 130] {
        for ack in [1, 2, 14, 64, 65, 130] {
            let values = random_values(&mut noise, &decoder);
            let word = text(decoder.encode(&values).as_bits());
            // The profile's own preamble is one bit of idle and five of acknowledge.
            let line = joined(&[&"1".repeat(idle), &"0".repeat(ack), &word[6..]]);
            let frame = decoder.line(line.as_bits()).unwrap();
            assert!(frame.ok(), "{idle} {ack}");
            let found = frame.values();
            assert_eq!((found.turns, found.angle), (values.turns, values.angle));
            assert_eq!(frame.layout.encode(&found), line, "{idle} {ack}");
        }
    }
}

#[test]
fn every_bit_of_a_long_acknowledge_of_biss_must_be_0() {
    for ack in [1, 5, 64] {
        let decoder = decoder(&format!("format=biss-c ack-bits={ack}"));
        let frame = decoder.encode(&Values::default());
        for index in 1..=ack {
            let mut flipped = frame.clone();
            flipped.flip(index);
            let holds = decoder.main_layout().holds(flipped.as_bits());
            assert!(!holds, "bit {index} of {ack}");
        }
    }
}
