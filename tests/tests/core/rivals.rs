//! Input that holds in more than one way: none of them may pass for a wrong angle.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{decode::Decoder, reading::Values};
use encoderscope_tests::{Stretch, decoder, framed, paste, stretches};

fn frame(decoder: &Decoder, angle: u64, turns: i64) -> Vec<u8> {
    let values = Values {
        angle: Some(angle),
        turns: Some(turns),
        ..Values::default()
    };
    decoder.encode(&values).into_bytes()
}

fn wrong<'a>(found: &'a [Stretch], frames: &[Vec<u8>]) -> Vec<&'a Stretch> {
    let good = found.iter().filter(|stretch| stretch.is_good());
    good.filter(|stretch| !frames.iter().any(|frame| frame == stretch.bytes()))
        .collect()
}

#[test]
fn bus_frames_that_lose_any_byte_never_slide_for_good() {
    let decoder = decoder("format=bus");
    for step in [0, 0x1357] {
        let frames: Vec<_> = (0..40)
            .map(|index| frame(&decoder, 0x12_3456 + step * index, 5))
            .collect();
        for lost in 8..16 {
            let mut bytes = frames.concat();
            bytes.remove(lost);
            let found = framed(&decoder, &[&bytes]);
            let wrong = wrong(&found, &frames);
            assert!(wrong.is_empty(), "{lost}: {wrong:02x?}");
            let good = found.iter().filter(|stretch| stretch.is_good()).count();
            assert!(good >= 37, "{lost}: {good} {found:02x?}");
        }
    }
}

#[test]
fn a_bus_dump_that_begins_behind_a_header_gives_no_wrong_frame() {
    let decoder = decoder("format=bus");
    let frames: Vec<_> = (0..20).map(|_| frame(&decoder, 0x12_3456, 5)).collect();
    let bytes: Vec<u8> = frames
        .iter()
        .flat_map(|frame| [&frame[..1], &frame[..]].concat())
        .collect();
    for start in 0..9 {
        let found = framed(&decoder, &[&bytes[start..]]);
        let wrong = wrong(&found, &frames);
        assert!(wrong.is_empty(), "{start}: {wrong:02x?}");
    }
}

/// On a still shaft a phase that passes by accident passes for ever.
#[test]
fn a_still_shaft_that_loses_a_byte_never_slides_into_an_accidental_phase() {
    for (parameters, len) in [
        ("format=rs485 command=1 turns-bits=0", 4),
        ("format=period turns-bits=0", 5),
    ] {
        let decoder = decoder(parameters);
        let passes = |bytes: &[u8]| decoder.frame(bytes).is_some_and(|frame| frame.ok());
        let mut cases = 0;
        for angle in 0..60_000u64 {
            let one = frame(&decoder, angle * 277 % 0x100_0000, 0);
            let twice = one.repeat(2);
            if !(1..len).any(|shift| passes(&twice[shift..shift + len])) || one[len - 1] == 0 {
                continue;
            }
            cases += 1;
            for lost in 6 * len..7 * len {
                let mut bytes = one.repeat(26);
                bytes.remove(lost);
                let found = framed(&decoder, &[&bytes]);
                let wrong = wrong(&found, core::slice::from_ref(&one));
                assert!(wrong.len() <= 1, "{one:02x?} lost {lost}: {wrong:02x?}");
            }
            if cases > 40 {
                break;
            }
        }
        assert!(cases > 20, "{parameters}: {cases}");
    }
}

#[test]
fn a_broken_frame_behind_its_request_is_shown_in_its_place() {
    for (parameters, request) in [
        ("format=t485", 0x1a),
        ("format=rs485 command=d", 0x64),
        ("format=bus", 0x1f),
    ] {
        let decoder = decoder(parameters);
        for broken in 0..5 {
            let mut bytes = Vec::new();
            let mut start = 0;
            for index in 0..5 {
                let mut one = frame(&decoder, 0x12_3456 + 0x1111 * index, 300);
                bytes.push(request);
                if index == broken {
                    start = bytes.len() as u64;
                    one[3] ^= 0x40;
                }
                bytes.extend(one);
            }
            let found = framed(&decoder, &[&bytes]);
            let bad: Vec<_> = found
                .iter()
                .filter_map(|stretch| match stretch {
                    Stretch::Frame(start, _, false) => Some(*start),
                    _ => None,
                })
                .collect();
            assert_eq!(bad, [start], "{parameters} {broken}: {found:02x?}");
            let good = found.iter().filter(|stretch| stretch.is_good()).count();
            assert_eq!(good, 4, "{parameters} {broken}: {found:02x?}");
        }
    }
}

#[test]
fn a_good_frame_beside_a_broken_one_is_good() {
    for parameters in ["format=rs485", "format=period", "format=t485", "format=bus"] {
        let decoder = decoder(parameters);
        let good = frame(&decoder, 0x12_3456, 300);
        let mut bad = frame(&decoder, 0x12_4567, 300);
        bad[3] ^= 0x20;
        for order in [[true, false], [false, true]] {
            let bytes: Vec<u8> = order
                .iter()
                .flat_map(|ok| if *ok { good.clone() } else { bad.clone() })
                .collect();
            let found = framed(&decoder, &[&bytes]);
            let verdicts: Vec<_> = found.iter().map(Stretch::is_good).collect();
            assert_eq!(verdicts, order, "{parameters}: {found:02x?}");
        }
        let both = [bad.clone(), bad].concat();
        let found = framed(&decoder, &[&both]);
        assert_eq!(found.len(), 2, "{parameters}: {found:02x?}");
        assert!(
            found
                .iter()
                .all(|stretch| matches!(stretch, Stretch::Frame(_, _, false)))
        );
    }
}

#[test]
fn a_t485_encoder_that_does_not_know_a_request_is_still_read() {
    let decoder = decoder("format=t485");
    for (request, bytes) in [
        ("identity", [0x92, 0x40, 0x66, 0x66, 0x26, 0xf4]),
        ("no request of any", [0x52, 0x40, 0x66, 0x66, 0x26, 0x34]),
    ] {
        let found = framed(&decoder, &[&bytes.repeat(3)]);
        assert_eq!(found.len(), 3, "{request}: {found:02x?}");
        assert!(found.iter().all(Stretch::is_good), "{request}");
    }
}

/// With a clock too many, and no checksum, a word may be read one bit off.
#[test]
fn a_clock_too_many_is_put_where_the_word_holds_or_called_ambiguous() {
    let verdict = |parameters: &str, text: &str| {
        let decoder = decoder(parameters);
        let mut out = None;
        decoder.dump(&paste(&decoder, text), &mut |decoded| {
            if let encoderscope::decode::Decoded::Frame(frame) = decoded {
                out = Some((frame.ok(), frame.values().angle));
            }
        });
        out.unwrap()
    };
    let tree = "1010010100101001000100011";
    let single = "format=ssi-tree turns-bits=0";
    // 14 clocks a word of 13 bits, 26 of 25: the same word again behind a 0.
    let s = "0110101110010";
    let alone = verdict(single, s);
    assert!(alone.0);
    assert_eq!(verdict(single, &format!("{s}0{s}0")), alone);
    assert_eq!(verdict(single, &format!("{s}0{s}")), alone);
    assert_eq!(
        verdict("format=ssi-tree", &format!("{tree}0{tree}0")),
        (true, Some(962))
    );
    assert_eq!(
        verdict("format=ssi-tree", &format!("1{tree}")),
        (true, Some(962))
    );
    // A 0 behind: either reading holds, so neither is good.
    assert!(!verdict("format=ssi-tree", &format!("0{}0", &tree[1..])).0);
}

#[test]
fn a_line_of_asi4_that_was_cut_at_either_end_is_not_believed() {
    let decoder = decoder("format=asi4");
    let oks = |text: &str| -> Vec<bool> {
        stretches(&decoder, &paste(&decoder, text))
            .iter()
            .map(Stretch::is_good)
            .collect()
    };
    assert_eq!(oks("83\n8192\n8193\n8194\n"), [false, true, true, true]);
    assert_eq!(oks("8192\n8193\n8194\n81"), [true, true, true, false]);
    assert_eq!(oks("8192"), [true]);
    assert_eq!(oks("0\n4096\n8192\n12288\n"), [true; 4]);
    // Separators and a word in between do no harm.
    assert_eq!(oks("8192;\n8193,\nfoo0a1\n8194"), [true; 3]);
}

#[test]
fn dumps_of_many_hands_are_read() {
    let decoder = decoder("format=t485");
    let frame = [0x1a, 0x20, 0x29, 0xc0, 0x3b, 0x17, 0, 0, 0, 0xc8, 0x37];
    for text in [
        "\u{feff}1a 20 29 c0 3b 17 00 00 00 c8 37",
        "1A 20 29 C0 3B 17 0 0 0 C8 37",
        "1Ah 20h 29h C0h 3Bh 17h 0h 0h 0h C8h 37h",
        "{0x1A,0x20,0x29,0xC0,0x3B,0x17,0,0,0,0xC8,0x37}",
    ] {
        let dump = paste(&decoder, text);
        assert_eq!(dump.bytes(), frame, "{text}");
        assert!(dump.unread().is_empty(), "{text}");
    }
    // Three digits are no byte: they are marked, not guessed.
    let marked = paste(&decoder, "1Ah 0C0h");
    assert_eq!(marked.bytes(), [0x1a]);
    assert_eq!(
        marked.unread().places.first().map(|mark| mark.at.clone()),
        Some(4..8)
    );
}
