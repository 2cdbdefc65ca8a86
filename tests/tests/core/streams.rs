#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    decode::Decoder,
    framing::{Framer, Piece},
    reading::Values,
};
use encoderscope_tests::{Noise, Stretch, decoder, framed};

const BYTE_FORMATS: &[&str] = &[
    "format=rs485",
    "format=rs485 command=1 turns-bits=0 angle-bits=16",
    "format=rs485 command=t",
    "format=t485",
    "format=bus",
    "format=bus parity=none turns-bits=0",
    "format=period",
    "format=period turns-bits=0 angle-bits=17",
    "format=asi1",
    "format=asi1 angle-bits=22 marker=first",
    "format=asi4",
];

/// The frame of a shaft at `turns`.
fn frame(decoder: &Decoder, turns: f64) -> Vec<u8> {
    let codes = 2f64.powi(decoder.profile().angle_bits as i32);
    let values = Values {
        turns: Some(turns as i64),
        angle: Some((turns.fract() * codes) as u64),
        ..Values::default()
    };
    decoder.encode(&values).into_bytes()
}

fn stream(decoder: &Decoder, count: usize, turns: f64, step: f64) -> Vec<Vec<u8>> {
    (0..count)
        .map(|index| frame(decoder, turns + step * index as f64))
        .collect()
}

/// What a framer that joins a stream makes of it.
fn joined(decoder: &Decoder, bytes: &[u8]) -> Vec<(u64, Vec<u8>, bool)> {
    let mut good = Vec::new();
    let mut framer = Framer::joining();
    let mut sink = |piece: Piece<'_>| {
        good.push((piece.start, piece.bytes.to_vec(), piece.reading().is_some()));
    };
    framer.push(decoder, bytes, &mut sink);
    framer.finish(decoder, &mut sink);
    good
}

#[test]
fn every_cutting_of_a_short_stream_gives_the_same_pieces() {
    for parameters in BYTE_FORMATS {
        let decoder = decoder(parameters);
        let mut bytes = stream(&decoder, 2, 3.3, 0.01).concat();
        bytes.insert(1, 0x55);
        bytes.truncate(13);
        let whole = framed(&decoder, &[&bytes]);
        let places = bytes.len() - 1;
        for cutting in 0..1u32 << places {
            let mut cuts = Vec::new();
            let mut from = 0;
            for place in 0..places {
                if cutting >> place & 1 == 1 {
                    cuts.push(&bytes[from..=place]);
                    from = place + 1;
                }
            }
            cuts.push(&bytes[from..]);
            // Building every cutting is dear; every seventh still has each single cut.
            if cutting.count_ones() > 2 && cutting % 7 != 0 {
                continue;
            }
            assert_eq!(framed(&decoder, &cuts), whole, "{parameters} {cutting:b}");
        }
    }
}

#[test]
fn with_noise_of_one_to_ten_percent_every_byte_is_in_one_piece_and_cuts_change_nothing() {
    let mut noise = Noise::new(21);
    for parameters in BYTE_FORMATS {
        let decoder = decoder(parameters);
        for percent in [1, 3, 10] {
            let mut bytes = Vec::new();
            for byte in stream(&decoder, 300, 4.2, 0.003).concat() {
                match noise.below(300) {
                    hit if hit >= 3 * percent => bytes.push(byte),
                    hit if hit < percent => bytes.push(byte ^ (1 << noise.below(8))),
                    hit if hit < 2 * percent => {}
                    _ => bytes.extend([byte, noise.draw() as u8]),
                }
            }
            let whole = framed(&decoder, &[&bytes]);
            let together: Vec<u8> = whole.iter().flat_map(Stretch::bytes).copied().collect();
            assert_eq!(together, bytes, "{parameters} {percent} %");
            let mut cuts = Vec::new();
            let mut rest = &bytes[..];
            while !rest.is_empty() {
                let (cut, after) = rest.split_at((noise.below(40) as usize).min(rest.len()));
                cuts.push(cut);
                rest = after;
            }
            assert_eq!(framed(&decoder, &cuts), whole, "{parameters} {percent} %");
        }
    }
}

/// A stationary shaft repeats one packet for ever, so that a single false lock would stay.
#[test]
fn asi1_never_locks_wrongly_on_a_still_shaft_at_any_angle() {
    let decoder = decoder("format=asi1");
    for angle in 0..16_384u64 {
        let values = Values {
            angle: Some(angle),
            valid: Some(angle % 3 != 0),
            zero_default: Some(angle % 2 == 0),
            ..Values::default()
        };
        let packet = decoder.encode(&values).into_bytes();
        let begin = angle as usize % 6;
        let bytes = &packet.repeat(14)[begin..];
        let found = joined(&decoder, bytes);
        let right = found
            .iter()
            .filter(|(_, bytes, ok)| *ok && *bytes == packet);
        let wrong = found
            .iter()
            .filter(|(_, bytes, ok)| *ok && *bytes != packet);
        assert_eq!(wrong.count(), 0, "{angle}: {packet:02x?} {found:02x?}");
        assert!(right.count() >= 12, "{angle}: {packet:02x?} {found:02x?}");
    }
}

/// The CRC alone would lock wrongly somewhere: the test above tests something.
#[test]
fn the_crc_of_asi1_alone_would_lock_wrongly() {
    let decoder = decoder("format=asi1 angle-bits=22");
    let mut false_locks = 0;
    for angle in 0..16_384u64 {
        for flags in 0..4 {
            let values = Values {
                angle: Some(angle),
                valid: Some(flags & 1 == 1),
                zero_default: Some(flags & 2 == 2),
                ..Values::default()
            };
            let packet = decoder.encode(&values).into_bytes();
            for begin in 1..6 {
                let turned = [&packet[begin..], &packet[..begin]].concat();
                let crc = decoder
                    .main_layout()
                    .values(encoderscope::bits::Bits::of_bytes(&turned))
                    .crc;
                false_locks += u32::from(turned != packet && crc.unwrap().ok());
            }
        }
    }
    assert!(false_locks > 0, "{false_locks}");
}

#[test]
fn a_single_packet_in_the_middle_of_rubbish_is_not_believed() {
    let decoder = decoder("format=asi1");
    let packet = frame(&decoder, 0.4);
    let rubbish = [0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77];
    let bytes = [&rubbish[..], &packet, &rubbish].concat();
    assert!(joined(&decoder, &bytes).iter().all(|(.., ok)| !ok));
    let twice = [&rubbish[..], &packet, &packet, &rubbish].concat();
    let good = joined(&decoder, &twice)
        .iter()
        .filter(|(.., ok)| *ok)
        .count();
    assert_eq!(good, 2);
}

#[test]
fn period_finds_the_intact_frames_among_dropped_flipped_and_inserted_bytes() {
    let mut noise = Noise::new(33);
    let decoder = decoder("format=period");
    let (mut intact, mut right, mut wrong, mut longest) = (0, 0, 0, 0);
    for turns in 0..=300 {
        let step = [0.0, 0.000_02, 0.003, 0.04][turns % 4];
        let frames = stream(&decoder, 120, turns as f64 + 0.37, step);
        let mut bytes = Vec::new();
        let mut whole = Vec::new();
        for frame in &frames {
            let start = bytes.len() as u64;
            let before = bytes.len();
            for byte in frame {
                match noise.below(300) {
                    0 => bytes.push(byte ^ (1 << noise.below(8))),
                    1 => {}
                    2 => bytes.extend([*byte, noise.draw() as u8]),
                    _ => bytes.push(*byte),
                }
            }
            if bytes[before..] == frame[..] {
                whole.push(start);
            }
        }
        let found = framed(&decoder, &[&bytes]);
        let mut run = 0;
        for stretch in found.iter().filter(|stretch| stretch.is_good()) {
            if whole.binary_search(&stretch.start()).is_ok()
                || frames.iter().any(|frame| frame == stretch.bytes())
            {
                right += usize::from(whole.binary_search(&stretch.start()).is_ok());
                run = 0;
            } else {
                wrong += 1;
                run += 1;
                longest = longest.max(run);
            }
        }
        intact += whole.len();
    }
    assert!(right * 100 >= intact * 95, "{right} of {intact}");
    assert!(longest <= 1, "a run of {longest} wrong angles");
    assert!(wrong * 1000 <= intact, "{wrong} wrong of {intact}");
}

#[test]
fn bus_frames_are_not_read_a_byte_late_though_their_crc_holds() {
    for (parameters, bytes_before) in [
        ("format=bus", 0),
        ("format=bus", 3),
        ("format=bus address=5", 1),
        ("format=bus parity=none", 2),
    ] {
        let decoder = decoder(parameters);
        for step in [0.0, 0.000_01, 0.013] {
            let frames = stream(&decoder, 40, 5.37, step);
            let bytes = frames.concat();
            let found = joined(&decoder, &bytes[bytes_before..]);
            let good: Vec<_> = found.iter().filter(|(.., ok)| *ok).collect();
            assert!(good.len() >= 38, "{parameters} {step}: {}", good.len());
            assert!(
                good.iter().all(|(_, bytes, _)| frames.contains(bytes)),
                "{parameters} {step}"
            );
        }
    }
}

#[test]
fn bus_requests_and_replies_of_several_devices_are_told_apart() {
    let main = decoder("format=bus");
    let mut bytes = Vec::new();
    let mut frames = Vec::new();
    for round in 0..40 {
        for address in [0x1f, 2, 7] {
            let values = Values {
                address: Some(address),
                turns: Some(i64::from(address)),
                angle: Some(0x10_0000 + round * 0x1234),
                ..Values::default()
            };
            let frame = main.encode(&values).into_bytes();
            bytes.push(frame[0]);
            bytes.extend(&frame);
            frames.push(frame);
        }
    }
    let found = framed(&main, &[&bytes]);
    let good: Vec<_> = found.iter().filter(|stretch| stretch.is_good()).collect();
    assert!(
        good.iter()
            .all(|stretch| frames.iter().any(|frame| frame == stretch.bytes()))
    );
    assert!(good.len() >= 114, "{}", good.len());
}

#[test]
fn asi4_lines_are_only_believed_whole_and_on_the_way() {
    let decoder = decoder("format=asi4");
    let lines = |text: &str| joined(&decoder, text.as_bytes());
    let good = |text: &str| -> Vec<String> {
        let found = lines(text).into_iter().filter(|(.., ok)| *ok);
        found
            .map(|(_, bytes, _)| String::from_utf8(bytes).unwrap().trim().to_owned())
            .collect()
    };
    // The first line of a stream that was joined may be the end of one.
    assert_eq!(good("83\r\n1234\r\n1235\r\n"), ["1234", "1235"]);
    // At the start of a dump it is whole.
    let dump = framed(&decoder, &[b"83\r\n84\r\n"]);
    assert!(dump.iter().all(Stretch::is_good));
    // A digit that was lost leaps off the way.
    assert_eq!(
        good("\n8190\r\n8191\r\n892\r\n8193\r\n8194\r\n"),
        ["8190", "8191", "8193", "8194"]
    );
    // The way over the zero is no leap.
    assert_eq!(good("\n16382\r\n16383\r\n0\r\n1\r\n").len(), 4);
    // One more than 14 bits, letters, no carriage return, and text without an end.
    for bad in ["16384\r\n", "12a4\r\n", "1234\n", "123456\r\n", "\r\n"] {
        let text = format!("\n100\r\n{bad}101\r\n102\r\n");
        assert_eq!(good(&text), ["100", "101", "102"], "{bad:?}");
    }
    assert_eq!(good(&"7".repeat(1000)).len(), 0);
}
