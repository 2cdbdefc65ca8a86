#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{decode::Decoder, reading::Values};
use encoderscope_tests::{Noise, Stretch, decoder, framed};

/// Frames of a shaft that starts at `turns` and moves by `step` turns a frame.
fn stream(decoder: &Decoder, count: usize, turns: f64, step: f64) -> Vec<Vec<u8>> {
    let profile = decoder.profile();
    (0..count)
        .map(|index| {
            let position = turns + step * index as f64;
            let values = Values {
                turns: Some(position as i64),
                angle: Some((position.fract() * 2f64.powi(profile.angle_bits as i32)) as u64),
                error: Some(false),
                warning: Some(false),
                status: Some(0),
                operation: Some(3),
                enid: Some(0x17),
                ..Values::default()
            };
            decoder.main_layout().encode(&values).into_bytes()
        })
        .collect()
}

fn good(found: &[Stretch]) -> Vec<&[u8]> {
    found
        .iter()
        .filter(|stretch| stretch.is_good())
        .map(Stretch::bytes)
        .collect()
}

/// How many of `frames` were found good, in order, and how many good ones were none of them.
fn score(found: &[Stretch], frames: &[Vec<u8>]) -> (usize, usize) {
    let mut frames = frames.iter();
    let mut right = 0;
    let mut wrong = 0;
    for bytes in good(found) {
        match frames.clone().position(|frame| frame == bytes) {
            Some(at) => {
                right += 1;
                frames.nth(at);
            }
            None => wrong += 1,
        }
    }
    (right, wrong)
}

#[test]
fn any_cutting_gives_the_same_pieces_and_every_byte_is_in_one() {
    let mut noise = Noise::new(5);
    for parameters in [
        "format=t485",
        "format=rs485",
        "format=rs485 command=1 turns-bits=0 angle-bits=16",
    ] {
        let decoder = decoder(parameters);
        for _ in 0..40 {
            let mut bytes = stream(&decoder, 30, 3.2, 0.01).concat();
            for _ in 0..noise.below(12) {
                let at = noise.below(bytes.len() as u64) as usize;
                match noise.below(3) {
                    0 => bytes[at] ^= 1 << noise.below(8),
                    1 => drop(bytes.remove(at)),
                    _ => bytes.insert(at, noise.draw() as u8),
                }
            }
            let whole = framed(&decoder, &[&bytes]);
            assert_eq!(
                whole
                    .iter()
                    .flat_map(Stretch::bytes)
                    .copied()
                    .collect::<Vec<_>>(),
                bytes
            );
            let mut at = 0;
            for stretch in &whole {
                assert_eq!(stretch.start(), at);
                at += stretch.bytes().len() as u64;
            }
            let mut cuts = Vec::new();
            let mut rest = &bytes[..];
            while !rest.is_empty() {
                let (cut, after) = rest.split_at((noise.below(9) as usize).min(rest.len()));
                cuts.push(cut);
                rest = after;
            }
            assert_eq!(framed(&decoder, &cuts), whole, "{parameters}");
        }
    }
}

#[test]
fn a_single_frame_is_good_and_one_with_a_wrong_crc_is_shown_as_bad() {
    let decoder = decoder("format=rs485 command=1");
    let frame = [0x00, 0x05, 0x80, 0x00, 0x00, 0xfd];
    assert_eq!(
        framed(&decoder, &[&frame]),
        [Stretch::Frame(0, frame.into(), true)]
    );
    let mut broken = frame;
    broken[3] ^= 4;
    assert_eq!(
        framed(&decoder, &[&broken]),
        [Stretch::Frame(0, broken.into(), false)]
    );
    let short = &frame[..5];
    assert_eq!(
        framed(&decoder, &[short]),
        [Stretch::Skip(0, short.into(), "5 of 6".into())]
    );
}

#[test]
fn a_wrong_crc_among_good_frames_is_one_bad_frame() {
    for parameters in ["format=t485", "format=rs485"] {
        let decoder = decoder(parameters);
        let frames = stream(&decoder, 12, 700.3, 0.003);
        let mut bytes = frames.concat();
        let len = frames[0].len();
        bytes[5 * len + 3] ^= 0x10;
        let found = framed(&decoder, &[&bytes]);
        let verdicts: Vec<_> = found.iter().map(Stretch::is_good).collect();
        let expected: Vec<_> = (0..12).map(|index| index != 5).collect();
        assert_eq!(verdicts, expected, "{parameters} {found:?}");
        assert!(matches!(found[5], Stretch::Frame(..)));
    }
}

#[test]
fn a_wrong_crc_at_the_end_is_a_bad_frame_and_what_follows_is_short() {
    for parameters in ["format=t485", "format=rs485"] {
        let decoder = decoder(parameters);
        let frames = stream(&decoder, 4, 700.3, 0.003);
        let len = frames[0].len();
        let mut bytes = frames.concat();
        bytes[3 * len + 4] ^= 1;
        bytes.extend(&frames[0][..2]);
        let found = framed(&decoder, &[&bytes]);
        let short = Stretch::Skip(4 * len as u64, frames[0][..2].into(), format!("2 of {len}"));
        assert_eq!(good(&found).len(), 3, "{parameters}: {found:?}");
        assert!(
            matches!(found[3], Stretch::Frame(_, _, false)),
            "{parameters}: {found:?}"
        );
        assert_eq!(found[4..], [short], "{parameters}");
    }
}

#[test]
fn garbage_and_requests_between_frames_are_skipped() {
    let decoder = decoder("format=t485");
    let frames = stream(&decoder, 6, 41.7, 0.02);
    let mut bytes = vec![0x1a];
    for (index, frame) in frames.iter().enumerate() {
        bytes.extend(frame);
        bytes.extend(if index == 2 {
            vec![0xff, 0x00, 0x1a, 0x33]
        } else {
            vec![0x1a]
        });
    }
    let found = framed(&decoder, &[&bytes]);
    assert_eq!(score(&found, &frames), (6, 0), "{found:?}");
    assert!(
        found.contains(&Stretch::Skip(0, vec![0x1a], "request".into())),
        "{found:?}"
    );
}

/// The zero-lead trap: while the turns are below 256, the phase one byte late
/// passes its CRC in every frame.
#[test]
fn a_lost_byte_does_not_slide_the_stream_into_the_late_phase() {
    let decoder = decoder("format=rs485 command=d");
    let len = 7;
    for step in [0.0, 0.000_01, 0.01, 0.11] {
        for turns in [0.0, 1.0, 17.0, 255.0, 300.0] {
            let frames = stream(&decoder, 40, turns + 0.377, step);
            for lost in 10 * len..11 * len {
                let mut bytes = frames.concat();
                bytes.remove(lost);
                let found = framed(&decoder, &[&bytes]);
                let (right, wrong) = score(&found, &frames);
                assert_eq!(wrong, 0, "turns {turns} step {step} lost {lost}: {found:?}");
                assert!(
                    right >= 38,
                    "turns {turns} step {step} lost {lost}: {right} {found:?}"
                );
            }
        }
    }
}

#[test]
fn a_stream_may_begin_anywhere() {
    let decoder = decoder("format=rs485 command=d");
    for turns in [0.0, 1.0, 255.0, 1000.0] {
        let frames = stream(&decoder, 40, turns + 0.25, 0.004);
        let bytes = frames.concat();
        for start in 0..7 {
            let found = framed(&decoder, &[&bytes[start..]]);
            let (right, wrong) = score(&found, &frames);
            assert_eq!(wrong, 0, "turns {turns} start {start}");
            assert!(
                right >= 39,
                "turns {turns} start {start}: {right} {found:?}"
            );
        }
    }
}

#[test]
fn noise_hides_few_intact_frames_and_makes_no_wrong_ones() {
    let mut noise = Noise::new(6);
    for parameters in ["format=rs485", "format=t485"] {
        let decoder = decoder(parameters);
        for turns in [0.0, 5.0, 300.0] {
            let frames = stream(&decoder, 3000, turns + 0.3, 0.000_7);
            let mut bytes = Vec::new();
            let mut intact = Vec::new();
            for frame in &frames {
                let before = bytes.len();
                for byte in frame {
                    // One byte in a hundred is hit.
                    match noise.below(300) {
                        0 => bytes.push(byte ^ (1 << noise.below(8))),
                        1 => {}
                        2 => bytes.extend([*byte, noise.draw() as u8]),
                        _ => bytes.push(*byte),
                    }
                }
                if bytes[before..] == frame[..] {
                    intact.push(frame.clone());
                }
            }
            let found = framed(&decoder, &[&bytes]);
            let (right, _) = score(&found, &intact);
            let (_, wrong) = score(&found, &frames);
            assert!(
                right * 100 >= intact.len() * 95,
                "{parameters} {turns}: {right} of {}",
                intact.len()
            );
            assert!(
                wrong <= 3,
                "{parameters} {turns}: {wrong} wrong of {}",
                found.len()
            );
        }
    }
}

#[test]
fn random_bytes_give_almost_no_good_frames() {
    let mut noise = Noise::new(7);
    for (parameters, most) in [("format=t485", 0), ("format=rs485", 3)] {
        let decoder = decoder(parameters);
        let bytes: Vec<u8> = (0..20_000).map(|_| noise.draw() as u8).collect();
        let found = framed(&decoder, &[&bytes]);
        let count = good(&found).len();
        assert!(count <= most, "{parameters}: {count} good frames in noise");
    }
}

/// On a still shaft a second phase that passes once passes for ever (1 in 256 for each phase);
/// when the stream starts in the middle of a frame, nothing tells the two apart.
#[test]
fn what_cannot_be_decided_is_not_called_good() {
    let decoder = decoder("format=rs485 command=d");
    let passes = |bytes: &[u8]| decoder.frame(bytes).unwrap().ok();
    let mut undecided = 0;
    for angle in 0..4096 {
        let values = Values {
            turns: Some(0x1234),
            angle: Some(0x5a_1001 + angle * 0x101),
            ..Values::default()
        };
        let frame = decoder.main_layout().encode(&values).into_bytes();
        let twice = frame.repeat(2);
        let second =
            (1..7).find(|shift| passes(&twice[*shift..shift + 7]) && twice[shift + 6] != 0);
        let Some(second) = second.filter(|_| frame[6] != 0) else {
            continue;
        };
        let bytes = &frame.repeat(30)[second..];
        let found = framed(&decoder, &[bytes]);
        let wrong = good(&found).iter().filter(|bytes| **bytes != frame).count();
        assert_eq!(wrong, 0, "{frame:02x?} {found:02x?}");
        undecided += 1;
    }
    assert!(undecided > 20, "{undecided}");
}

/// A request in front of each reply: read as the first byte of a frame it passes once in 256.
#[test]
fn requests_between_replies_are_never_read_as_their_first_byte() {
    for (parameters, request) in [
        ("format=rs485 command=d", 0x64),
        ("format=rs485 command=1", 0x31),
        ("format=rs485 command=d turns-bits=0", 0x64),
        ("format=rs485 command=1 turns-bits=0 angle-bits=16", 0x31),
        ("format=t485", 0x1a),
    ] {
        let decoder = decoder(parameters);
        let frames = stream(&decoder, 3000, 5.1, 0.0123);
        let bytes: Vec<u8> = frames
            .iter()
            .flat_map(|frame| [&[request], &frame[..]].concat())
            .collect();
        let found = framed(&decoder, &[&bytes]);
        let (right, wrong) = score(&found, &frames);
        assert_eq!(wrong, 0, "{parameters}");
        assert!(right >= 2970, "{parameters}: {right}");
    }
}

/// While the shaft stands still, a true CRC of 0 looks like the phase one byte late.
#[test]
fn a_still_shaft_whose_crc_is_zero_is_never_read_wrong_from_the_start() {
    for parameters in [
        "format=rs485 command=d turns-bits=0 angle-bits=23",
        "format=rs485 command=d",
    ] {
        let decoder = decoder(parameters);
        let mut seen = 0;
        for angle in 0..20_000 {
            let values = Values {
                turns: Some(5),
                angle: Some(0x19_0000 + angle),
                status: Some(4),
                ..Values::default()
            };
            let frame = decoder.main_layout().encode(&values).into_bytes();
            if frame.last() != Some(&0) {
                continue;
            }
            let found = framed(&decoder, &[&frame.repeat(12)]);
            assert!(
                good(&found).iter().all(|bytes| *bytes == frame),
                "{frame:02x?}: {found:02x?}"
            );
            seen += 1;
        }
        assert!(seen > 40, "{parameters}: {seen}");
    }
}

#[test]
fn a_log_of_requests_alone_has_no_angle() {
    let decoder = decoder("format=t485");
    for request in [0x02, 0x8a, 0x92, 0x1a, 0x32, 0xba, 0xc2, 0x62, 0xea] {
        for count in 1..70 {
            let found = framed(&decoder, &[&vec![request; count]]);
            // Four equal bytes are a whole EEPROM frame; none holds an angle.
            let angles = good(&found)
                .into_iter()
                .filter_map(|bytes| decoder.frame(bytes)?.values().angle);
            assert_eq!(angles.count(), 0, "{count} of {request:02x}: {found:02x?}");
        }
    }
}

/// A stray zero byte makes a broken frame whose CRC passes by chance, with good ones behind it.
#[test]
fn a_broken_frame_does_not_borrow_the_evidence_of_those_behind_it() {
    let decoder = decoder("format=rs485 command=d");
    let mut dumps = 0;
    let mut wrong = 0;
    for start in 0..40 {
        let frames = stream(&decoder, 14, 5.1 + f64::from(start) * 0.017, 0.000_003);
        for at in 7..12 * 7 {
            let mut bytes = frames.concat();
            bytes.insert(at, 0);
            let found = framed(&decoder, &[&bytes]);
            wrong += usize::from(score(&found, &frames).1 > 0);
            dumps += 1;
        }
    }
    assert!(wrong * 1000 <= dumps, "{wrong} of {dumps}");
}
