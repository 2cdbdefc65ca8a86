//! CRCs and sums that are found in frames of an unknown format, and none in noise.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::{self, BitString, Bits, Span},
    check::{Algorithm, Checksum},
    crc_search::{ByteOrder, Found, Sum, search},
    format::Medium,
};
use encoderscope_tests::{Noise, decoder};

/// Frames of noise of `len` bytes.
fn noise_frames(noise: &mut Noise, count: usize, len: usize) -> Vec<BitString> {
    let bytes = |noise: &mut Noise| (0..len).map(|_| noise.draw() as u8).collect();
    (0..count)
        .map(|_| BitString::of_bytes(bytes(noise)))
        .collect()
}

fn found(medium: Medium, frames: &[BitString]) -> Vec<Found> {
    let frames: Vec<_> = frames.iter().map(BitString::as_bits).collect();
    search(medium, &frames)
}

/// Puts a CRC of the bits in `covers` into `at`.
fn seal(frame: &mut BitString, crc: &Algorithm, covers: Span, at: Span, order: ByteOrder) {
    let value = crc.compute(frame.as_bits(), covers);
    let value = match order {
        ByteOrder::Big => value,
        ByteOrder::Little => u64::from((value as u16).swap_bytes()),
    };
    frame.write(at, value);
}

/// How many independent frames make a CRC of this width certain at the end of a frame.
fn enough(width: u32) -> usize {
    FRAMES_BITS.div_ceil(width as usize).max(2) + 1
}
const FRAMES_BITS: usize = 26;

/// Check values of "123456789": R. N. Williams' and G. Cook's catalogues, and the manuals.
#[test]
fn the_table_has_the_published_check_values() {
    let table = [
        ("CRC-3/GSM", 0x4),
        ("CRC-4/G-704", 0x7),
        ("CRC-5/USB", 0x19),
        ("CRC-5/G-704", 0x07),
        ("CRC-6/BISS", 0x2e),
        ("CRC-6/G-704", 0x06),
        ("CRC-7/MMC", 0x75),
        ("CRC-8/0x97", 0x94),
        ("exclusive or", 0x31),
        ("CRC-8/SMBUS", 0xf4),
        ("CRC-8/MAXIM", 0xa1),
        ("CRC-8/NRSC-5", 0xf7),
        ("CRC-8/AUTOSAR", 0xdf),
        ("CRC-8/SAE-J1850", 0x4b),
        ("CRC-10/ATM", 0x199),
        ("CRC-12/UMTS", 0xdaf),
        ("CRC-15/CAN", 0x59e),
        ("CRC-16/BUYPASS", 0xfee8),
        ("CRC-16/ARC", 0xbb3d),
        ("CRC-16/MODBUS", 0x4b37),
        ("CRC-16/CCITT-FALSE", 0x29b1),
        ("CRC-16/XMODEM", 0x31c3),
        ("CRC-16/KERMIT", 0x2189),
        ("CRC-16/X-25", 0x906e),
        ("CRC-16/USB", 0xb4c8),
    ];
    for (name, check) in table {
        let known = Algorithm::KNOWN.iter().find(|(known, _)| *known == name);
        let (_, crc) = known.unwrap_or_else(|| panic!("{name} is not in the table"));
        let text = Bits::of_bytes(b"123456789");
        assert_eq!(crc.compute(text, Span::new(0, 72)), check, "{name}");
    }
}

#[test]
fn names_and_parameters_stand_once_in_the_table() {
    for (index, (name, crc)) in Algorithm::KNOWN.iter().enumerate() {
        assert_eq!(crc.name(), Some(*name));
        assert!((3..=16).contains(&crc.width), "{name}");
        let mut others = Algorithm::KNOWN.iter().skip(index + 1);
        assert!(others.all(|(other, _)| other != name), "{name}");
    }
}

#[test]
fn the_parameters_of_a_checksum_compute_what_it_computes() {
    let mut noise = Noise::new(3);
    for sum in [
        Checksum::Crc8x97,
        Checksum::Crc8Xor,
        Checksum::Crc6Biss,
        Checksum::Crc16x8005,
    ] {
        let crc = sum.algorithm().unwrap();
        assert_eq!(crc.width, sum.width());
        for frame in noise_frames(&mut noise, 50, 9) {
            let start = noise.below(30) as usize & !7;
            let span = match sum {
                Checksum::Crc8Xor => Span::new(start, 32),
                _ => Span::new(start + 3, noise.below(35) as usize),
            };
            let bits = frame.as_bits();
            assert_eq!(crc.compute(bits, span), sum.compute(bits, span), "{sum:?}");
        }
    }
}

/// Every CRC of the table, at the end, in front, in the middle and over a part of the frame.
#[test]
fn every_known_crc_is_found_wherever_it_stands() {
    let mut noise = Noise::new(1);
    for (name, crc) in Algorithm::KNOWN {
        let room = (crc.width as usize).next_multiple_of(8);
        let orders: &[ByteOrder] = match crc.width {
            16 => &[ByteOrder::Big, ByteOrder::Little],
            _ => &[ByteOrder::Big],
        };
        for (bytes, start, at) in [(7, 0, 7), (9, 2, 9), (6, 1, 5), (8, 2, 0), (4, 0, 4)] {
            for order in orders {
                let len = bytes + room / 8;
                let own = Span::new(at * 8 + room - crc.width as usize, crc.width as usize);
                let covers = match at {
                    0 => Span::new(room, bytes * 8),
                    _ => Span::new(start * 8, (at - start) * 8),
                };
                let count = enough(crc.width) + 3;
                let mut frames = noise_frames(&mut noise, count, len);
                for frame in &mut frames {
                    // What stands beside a narrow CRC in its byte is 0.
                    frame.write(Span::new(own.start + own.len - room, room), 0);
                    seal(frame, crc, covers, own, *order);
                }
                let all = found(Medium::Bytes, &frames);
                let case = format!("{name} {covers:?} {own:?} {order:?}: {all:?}");
                let best = all.first().unwrap_or_else(|| panic!("{case}"));
                let Sum::Crc(best_crc) = best.sum else {
                    panic!("{case}");
                };
                assert_eq!(best_crc, *crc, "{case}");
                if *name != "exclusive or" {
                    assert_eq!((best.covers, best.at), (covers, own), "{case}");
                } else if at == 0 {
                    // Each byte is the exclusive or of the others, so the last is taken.
                    assert_eq!((best.covers.start, best.at.end()), (0, len * 8), "{case}");
                }
                assert_eq!((best.order, best.holds), (*order, count), "{case}");
                assert_eq!(best.frames, count);
            }
        }
    }
}

#[test]
fn three_frames_are_enough_for_a_known_crc_at_the_end_of_a_frame() {
    let mut noise = Noise::new(9);
    let wide = || {
        Algorithm::KNOWN
            .iter()
            .filter(|(_, crc)| crc.width == 8 || crc.width == 16)
    };
    for (name, crc) in wide() {
        let width = crc.width as usize;
        let mut right = 0;
        for _ in 0..20 {
            let mut frames = noise_frames(&mut noise, 3, 8 + width / 8);
            for frame in &mut frames {
                let at = Span::new(64, width);
                seal(frame, crc, Span::new(0, 64), at, ByteOrder::Big);
            }
            let all = found(Medium::Bytes, &frames);
            let best = all.first().map(|best| best.sum);
            right += u32::from(best == Some(Sum::Crc(*crc)));
            frames.pop();
            assert_eq!(found(Medium::Bytes, &frames), [], "two frames say nothing");
        }
        // A bit of the field that three frames leave as it is speaks less.
        assert!(right >= if width == 8 { 4 } else { 19 }, "{name}: {right}");
    }
}

#[test]
fn a_crc_of_six_bits_is_found_at_the_end_of_bit_strings() {
    let mut noise = Noise::new(2);
    let biss = Checksum::Crc6Biss.algorithm().unwrap();
    for len in (30..=60).step_by(3) {
        for start in [0, 8] {
            let mut frames = Vec::new();
            for _ in 0..30 {
                let mut frame = BitString::zeros(len);
                for at in 0..len {
                    frame.write(Span::new(at, 1), noise.below(2));
                }
                let at = Span::new(len - 6, 6);
                seal(
                    &mut frame,
                    &biss,
                    Span::new(start, len - 6 - start),
                    at,
                    ByteOrder::Big,
                );
                frames.push(frame);
            }
            let all = found(Medium::Bits, &frames);
            let best = all.first().unwrap_or_else(|| panic!("{len} bits"));
            assert_eq!(best.sum, Sum::Crc(biss), "{len} bits: {all:?}");
            assert_eq!(best.at, Span::new(len - 6, 6));
            assert_eq!(best.covers, Span::new(start, len - 6 - start), "{all:?}");
        }
    }
}

/// Generators and constants that no table has.
#[test]
fn a_crc_without_a_name_is_found_with_its_parameters() {
    let mut noise = Noise::new(4);
    for width in 3..=16u32 {
        let all_ones = bits::mask(width as usize);
        for (init, xorout) in [(0, 0), (all_ones, 0), (0, all_ones), (0, 5)] {
            let polynomial = noise.draw() & all_ones | 1;
            let crc = Algorithm {
                width,
                polynomial,
                init,
                refin: false,
                refout: false,
                xorout,
            };
            if polynomial == 1 {
                continue;
            }
            let mut frames = noise_frames(&mut noise, 40, 8);
            let at = Span::new(64 - width as usize, width as usize);
            let covers = Span::new(0, at.start);
            for frame in &mut frames {
                seal(frame, &crc, covers, at, ByteOrder::Big);
            }
            let all = found(Medium::Bytes, &frames);
            let best = all.first().unwrap_or_else(|| panic!("{crc:?}"));
            let Sum::Crc(best_crc) = best.sum else {
                panic!("{crc:?}: {all:?}");
            };
            assert_eq!(
                (best_crc.width, best_crc.polynomial, best.covers),
                (width, polynomial, covers),
                "{all:?}"
            );
            // Start value and inversion are told apart only by what is usual: what counts is
            // that the parameters give the frames.
            let given = |frame: &BitString| best_crc.compute(frame.as_bits(), covers);
            assert!(
                frames
                    .iter()
                    .all(|frame| given(frame) == frame.as_bits().read(at))
            );
        }
    }
}

#[test]
fn damaged_frames_do_not_hide_a_crc() {
    let mut noise = Noise::new(5);
    let crc = Checksum::Crc8x97.algorithm().unwrap();
    let mut frames = noise_frames(&mut noise, 40, 7);
    for frame in &mut frames {
        seal(
            frame,
            &crc,
            Span::new(0, 48),
            Span::new(48, 8),
            ByteOrder::Big,
        );
    }
    for index in [3, 17, 29] {
        frames[index].flip(20);
    }
    let all = found(Medium::Bytes, &frames);
    assert_eq!(all[0].sum, Sum::Crc(crc), "{all:?}");
    assert_eq!((all[0].holds, all[0].frames), (37, 40));
    assert!(all[0].to_string().contains("holds in 37 of 40 frames"));
}

#[test]
fn sums_and_exclusive_or_are_found() {
    let mut noise = Noise::new(6);
    let sum = |bytes: &[u8]| bytes.iter().fold(0u8, |sum, byte| sum.wrapping_add(*byte));
    type Rule = fn(u8, u8) -> u8;
    let cases: [(Sum, Rule); 4] = [
        (Sum::Added { plus: 0 }, |sum, _| sum),
        (Sum::Subtracted { plus: 0xff }, |sum, _| !sum),
        (Sum::Subtracted { plus: 0 }, |sum, _| sum.wrapping_neg()),
        (Sum::Added { plus: 0x55 }, |sum, _| sum.wrapping_add(0x55)),
    ];
    for (expected, rule) in cases {
        for start in [0, 1] {
            let mut frames = noise_frames(&mut noise, 12, 6);
            for frame in &mut frames {
                let all = sum(&frame.as_bits().bytes()[start..5]);
                frame.write(Span::new(40, 8), rule(all, 0).into());
            }
            let all = found(Medium::Bytes, &frames);
            assert_eq!(all.len(), 1, "{all:?}");
            assert_eq!(all[0].sum, expected);
            assert_eq!(
                (all[0].covers, all[0].at.start),
                (Span::new(start * 8, 40 - start * 8), 40)
            );
        }
    }
}

#[test]
fn parity_is_found_where_frames_are_many() {
    let mut noise = Noise::new(7);
    for (at, covers) in [
        (39, Span::new(0, 39)),
        (0, Span::new(1, 39)),
        (39, Span::new(4, 35)),
    ] {
        for (sum, odd) in [(Sum::Even, 0), (Sum::Odd, 1)] {
            let frames: Vec<_> = (0..60)
                .map(|_| {
                    let mut frame = BitString::zeros(40);
                    frame.write(Span::new(0, 40), noise.draw());
                    let ones = u64::from(frame.as_bits().read(covers).count_ones());
                    frame.write(Span::new(at, 1), (ones + odd) % 2);
                    frame
                })
                .collect();
            let all = found(Medium::Bits, &frames);
            assert_eq!(all.len(), 1, "{all:?}");
            assert_eq!(all[0].sum, sum);
            let both = covers.start.min(at)..covers.end().max(at + 1);
            let shown =
                all[0].covers.start.min(all[0].at.start)..all[0].at.end().max(all[0].covers.end());
            assert_eq!(shown, both, "{all:?}");
            assert_eq!(
                found(Medium::Bits, &frames[..12]),
                [],
                "twelve frames are too few"
            );
        }
    }
}

#[test]
fn nothing_is_found_in_noise() {
    let mut noise = Noise::new(8);
    for round in 0..120 {
        let count = [3, 4, 5, 8, 20, 100][round % 6];
        let len = 3 + round % 10;
        let frames = noise_frames(&mut noise, count, len);
        let all = found(Medium::Bytes, &frames);
        assert_eq!(all, [], "{count} frames of {len} bytes, round {round}");
    }
    for round in 0..24 {
        let count = [3, 6, 40][round % 3];
        let len = 20 + round * 2;
        let frames: Vec<_> = (0..count)
            .map(|_| {
                let mut frame = BitString::zeros(len);
                for at in 0..len {
                    frame.write(Span::new(at, 1), noise.below(2));
                }
                frame
            })
            .collect();
        assert_eq!(
            found(Medium::Bits, &frames),
            [],
            "{count} strings of {len} bits"
        );
    }
}

/// A shaft that turns slowly, a counter, still frames: data without a checksum.
#[test]
fn nothing_is_found_in_frames_without_a_checksum() {
    let mut noise = Noise::new(10);
    let counter = |step: u64| -> Vec<BitString> {
        let bytes = |index: u64| (0x0012_3400_0000 + index * step).to_be_bytes()[2..].to_vec();
        (0..100)
            .map(|index| BitString::of_bytes(bytes(index)))
            .collect()
    };
    for step in [1, 3, 256, 1000, 77_777] {
        assert_eq!(
            found(Medium::Bytes, &counter(step)),
            [],
            "a counter by {step}"
        );
    }
    let ssi = decoder("format=ssi angle-bits=17");
    let words: Vec<_> = (0..100)
        .map(|index| {
            ssi.encode(&encoderscope::reading::Values {
                turns: Some(7),
                angle: Some((90_000 + index * 130 + noise.below(40)) % 131_072),
                ..Default::default()
            })
        })
        .collect();
    assert_eq!(found(Medium::Bits, &words), []);
    assert_eq!(found(Medium::Bytes, &[]), []);
    let same = vec![BitString::of_bytes(vec![0; 6]); 20];
    assert_eq!(found(Medium::Bytes, &same), []);
    let one_byte: Vec<_> = (0..9).map(|byte| BitString::of_bytes(vec![byte])).collect();
    assert_eq!(found(Medium::Bytes, &one_byte), []);
    let long = noise_frames(&mut noise, 5, 40);
    assert_eq!(found(Medium::Bytes, &long), []);
}

/// The formats of the manuals, their shafts nearly still.
#[test]
fn the_crcs_of_the_formats_are_found_in_their_frames() {
    let mut noise = Noise::new(11);
    for (parameters, medium, name) in [
        (
            "format=rs485 command=d angle-bits=17",
            Medium::Bytes,
            "CRC-8/0x97",
        ),
        ("format=t485 angle-bits=23", Medium::Bytes, "exclusive or"),
        ("format=biss-c angle-bits=19", Medium::Bits, "CRC-6/BISS"),
    ] {
        let decoder = decoder(parameters);
        let frames: Vec<_> = (0..100)
            .map(|_| {
                decoder.encode(&encoderscope::reading::Values {
                    turns: Some(1234),
                    angle: Some(50_000 + noise.below(200)),
                    ..Default::default()
                })
            })
            .collect();
        let all = found(medium, &frames);
        let best = all.first().unwrap_or_else(|| panic!("{parameters}"));
        assert_eq!(best.sum.name(), name, "{all:?}");
        assert_eq!(best.at.end(), frames[0].as_bits().len());
    }
}

#[test]
fn finds_are_told_in_words() {
    let mut noise = Noise::new(12);
    let known = Algorithm::KNOWN
        .iter()
        .find(|(name, _)| *name == "CRC-16/MODBUS");
    let (_, modbus) = known.unwrap();
    let mut frames = noise_frames(&mut noise, 10, 8);
    for frame in &mut frames {
        seal(
            frame,
            modbus,
            Span::new(0, 48),
            Span::new(48, 16),
            ByteOrder::Little,
        );
    }
    let all = found(Medium::Bytes, &frames);
    assert_eq!(
        all[0].to_string(),
        "CRC-16/MODBUS (polynomial 0x8005) in bytes 6…7 over bytes 0…5, low byte first; \
         holds in 10 of 10 frames"
    );
}
