#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    decode::Decoder,
    detect::{Candidate, Change, Verdict, detect, near},
    dump,
    emulator::{Emulator, Shaft},
    format::{Format, Medium},
    profile::Profile,
    reading::Values,
    record::hex,
};
use encoderscope_tests::{Noise, decoder};

/// Bits of each word of an encoder on a shaft, 40 ms apart.
type Words = Vec<Vec<bool>>;

/// A shaft that goes through zero twice in sixty frames.
const TURNING: Shaft = Shaft::turning(300.55, 0.9);
const FRAMES: usize = 60;

fn words(parameters: &str, shaft: Shaft) -> Words {
    let decoder: Decoder = decoder(parameters);
    let encoder = Emulator::new(*decoder.profile(), shaft).unwrap();
    let word = |index: usize| {
        let values = Values {
            operation: None,
            ..encoder.values(index as u64 * 40_000)
        };
        let word = decoder.encode(&values);
        (0..word.as_bits().len())
            .map(|at| word.as_bits().bit(at))
            .collect()
    };
    (0..FRAMES).map(word).collect()
}

/// Strings of 0 and 1, one a line.
fn strings(words: &Words) -> String {
    let digit = |bit: &bool| if *bit { '1' } else { '0' };
    let lines = words.iter().map(|word| word.iter().map(digit).collect());
    lines.collect::<Vec<String>>().join("\n")
}

fn byte_lines(words: &Words) -> Vec<Vec<u8>> {
    let byte = |bits: &[bool]| {
        (0..8).fold(0, |byte, at| {
            byte * 2 + u8::from(bits.get(at) == Some(&true))
        })
    };
    let line = |word: &Vec<bool>| word.chunks(8).map(byte).collect();
    words.iter().map(line).collect()
}

/// Bytes in hexadecimal, one frame a line, the last byte filled up with zeros.
fn bytes(words: &Words) -> String {
    text(&byte_lines(words))
}

fn text(lines: &[Vec<u8>]) -> String {
    lines
        .iter()
        .map(|line| hex(line))
        .collect::<Vec<_>>()
        .join("\n")
}

fn first(text: &str) -> Candidate {
    let found = detect(text);
    found
        .first()
        .cloned()
        .unwrap_or_else(|| panic!("nothing in {text}"))
}

fn says(candidate: &Candidate, sentence: &str) -> bool {
    candidate
        .evidence
        .iter()
        .any(|said| said.contains(sentence))
}

fn dump_of(parameters: &str, shaft: Shaft) -> String {
    let words = words(parameters, shaft);
    match decoder(parameters).profile().medium() {
        Medium::Bits => strings(&words),
        Medium::Bytes | Medium::Text => bytes(&words),
    }
}

#[test]
fn what_can_be_decided_is_certain_and_right() {
    let mut kinds: Vec<String> = Vec::new();
    for angle in [16, 17, 18, 20, 23, 24] {
        for turns in [0, 16] {
            kinds.push(format!(
                "format=biss-c angle-bits={angle} turns-bits={turns}"
            ));
            kinds.push(format!("format=bus angle-bits={angle} turns-bits={turns}"));
            kinds.push(format!(
                "format=rs485 angle-bits={angle} turns-bits={turns}"
            ));
            kinds.push(format!(
                "format=rs485 angle-bits={angle} turns-bits={turns} command=1"
            ));
        }
        kinds.push(format!("format=ssi angle-bits={angle} turns-bits=0"));
    }
    for kind in [
        "format=ssi angle-bits=17",
        "format=ssi angle-bits=18",
        "format=ssi angle-bits=20",
        "format=ssi angle-bits=23",
        "format=ssi angle-bits=24",
        "format=ssi-tree turns-bits=0",
        "format=ssi-tree turns-bits=0 code=binary",
        "format=ssi-tree turns-bits=12 angle-bits=12 frame-bits=25",
        "format=ssi7",
        "format=ssi7 angle-bits=22",
        "format=t485 angle-bits=17",
        "format=t485 angle-bits=23",
        "format=asi1",
        "format=asi1 angle-bits=22",
        "format=asi4",
    ] {
        kinds.push(kind.to_string());
    }
    let mut wrong = Vec::new();
    for kind in &kinds {
        let truth = *decoder(kind).profile();
        let found = detect(&dump_of(kind, TURNING));
        let best = &found[0];
        if (best.profile, best.verdict) != (truth, Verdict::Certain) {
            wrong.push(format!("{kind}: {found:#?}"));
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {}: {}",
        wrong.len(),
        kinds.len(),
        wrong.join("\n")
    );
}

#[test]
fn what_reads_alike_in_several_ways_is_named_first_and_not_certain() {
    for kind in [
        // Turns and angle are one number.
        "format=ssi-tree",
        "format=ssi-tree code=binary",
        "format=ssi-tree parity=even",
        "format=ssi-tree parity=odd code=binary",
        "format=biss-c angle-bits=26 turns-bits=0 status-bits=0",
        "format=biss-c angle-bits=32 turns-bits=0 status-bits=0",
    ] {
        let truth = *decoder(kind).profile();
        let best = first(&dump_of(kind, TURNING));
        assert_eq!(best.profile, truth, "{kind}: {best:#?}");
        assert!(
            matches!(best.verdict, Verdict::Likely | Verdict::Ambiguous),
            "{kind}: {best:#?}"
        );
        assert!(
            says(&best, "data sheet") || says(&best, "would decide"),
            "{best:#?}"
        );
    }
    // In whole bytes, where the turns end shows from 512 on.
    let best = first(&bytes(&words("format=ssi angle-bits=24", TURNING)));
    assert_eq!(best.verdict, Verdict::Ambiguous, "{best:#?}");
    assert!(says(&best, "turns of at least 512"), "{best:#?}");
    let far = Shaft::turning(40_000.55, 0.9);
    let best = first(&bytes(&words("format=ssi angle-bits=24", far)));
    assert_eq!(best.profile.angle_bits, 24, "{best:#?}");
    assert!(!says(&best, "turns of at least 512"), "{best:#?}");
    // The right-aligned word of 25 bits is the fir-tree of 12 and 13.
    let best = first(&dump_of(
        "format=ssi-tree code=binary align=right frame-bits=25",
        TURNING,
    ));
    assert_eq!((best.profile.angle_bits, best.profile.turns_bits), (13, 12));
    assert_eq!(best.profile.code.name(), "binary");
    let heat = detect(&dump_of("format=rs485 angle-bits=20 command=t", TURNING));
    assert_eq!(heat[0].profile.command.letter(), 't', "{heat:#?}");
    assert_eq!(heat[0].profile.angle_bits, 20);
}

#[test]
fn words_in_bytes_are_found_on_either_side() {
    for kind in [
        "format=ssi angle-bits=17 justify=left",
        "format=ssi angle-bits=20 turns-bits=0 justify=left",
        "format=ssi7 justify=left",
    ] {
        let truth = *decoder(kind).profile();
        let best = first(&bytes(&words(kind, TURNING)));
        assert_eq!(
            (best.profile, best.verdict),
            (truth, Verdict::Certain),
            "{best:#?}"
        );
    }
}

#[test]
fn a_still_shaft_leaves_open_what_frames_do_not_tell() {
    for kind in [
        "format=ssi angle-bits=17",
        "format=ssi-tree",
        "format=ssi-tree parity=even",
        "format=ssi7",
        "format=biss-c angle-bits=17",
        "format=bus angle-bits=20",
        "format=rs485 angle-bits=24",
        "format=rs485 angle-bits=20 command=t",
    ] {
        let truth = *decoder(kind).profile();
        let found = detect(&dump_of(kind, Shaft::still(300.55)));
        let named = found.iter().find(|one| one.profile == truth);
        let Some(named) = named else {
            panic!("{kind}: {found:#?}")
        };
        assert_eq!(named.verdict, Verdict::Ambiguous, "{kind}: {named:#?}");
        assert!(says(named, "would decide"), "{kind}: {named:#?}");
    }
    for kind in ["format=t485", "format=asi1"] {
        let best = first(&dump_of(kind, Shaft::still(300.55)));
        assert_eq!(best.verdict, Verdict::Likely, "{kind}: {best:#?}");
    }
}

#[test]
fn damaged_dumps_are_still_what_they_are() {
    let mut noise = Noise::new(5);
    for kind in [
        "format=t485 angle-bits=17",
        "format=rs485 angle-bits=24",
        "format=bus angle-bits=20",
        "format=biss-c angle-bits=18",
        "format=asi1",
    ] {
        let truth = *decoder(kind).profile();
        let mut words = words(kind, TURNING);
        for word in words.iter_mut().step_by(10) {
            let at = noise.below(word.len() as u64) as usize;
            word[at] = !word[at];
        }
        let mut lines = byte_lines(&words);
        if truth.medium() != Medium::Bits {
            for line in lines.iter_mut().skip(5).step_by(20) {
                line.pop();
            }
        }
        let text = match truth.medium() {
            Medium::Bits => strings(&words),
            _ => text(&lines),
        };
        let best = first(&text);
        assert_eq!(best.profile, truth, "{best:#?}");
        assert_eq!(best.verdict, Verdict::Certain, "{best:#?}");
    }
}

#[test]
fn several_devices_on_a_bus_are_one_bus() {
    let one = byte_lines(&words("format=bus angle-bits=20 address=3", TURNING));
    let other = byte_lines(&words(
        "format=bus angle-bits=20 address=4",
        Shaft::turning(7.2, -0.4),
    ));
    let lines: Vec<_> = one
        .into_iter()
        .zip(other)
        .flat_map(|(one, other)| [one, other])
        .collect();
    let best = first(&text(&lines));
    assert_eq!(
        (best.profile.format, best.profile.angle_bits),
        (Format::Bus, 20),
        "{best:#?}"
    );
    assert!(says(&best, "2 addresses answer"), "{best:#?}");
}

#[test]
fn mistakes_of_a_capture_are_named() {
    let words_of = |kind: &str| words(kind, TURNING);
    let t485 = byte_lines(&words_of("format=t485"));
    let each = |lines: &[Vec<u8>], change: fn(u8) -> u8| -> String {
        let lines: Vec<Vec<u8>> = lines
            .iter()
            .map(|line| line.iter().map(|byte| change(*byte)).collect())
            .collect();
        text(&lines)
    };
    let headless: Vec<Vec<u8>> = t485.iter().map(|line| line[1..].to_vec()).collect();
    let letters: Vec<Vec<u8>> = t485
        .iter()
        .map(|line| format!("{}\r\n", hex(line)).into_bytes())
        .collect();
    let late: Words = words_of("format=ssi angle-bits=17")
        .into_iter()
        .map(|word| word.into_iter().skip(1).chain([false]).collect())
        .collect();
    for (dump, change, format) in [
        (
            each(&t485, u8::reverse_bits),
            Change::Reversed,
            Format::T485,
        ),
        (each(&t485, |byte| !byte), Change::Inverted, Format::T485),
        (text(&headless), Change::MissingByte(0x1a), Format::T485),
        (text(&letters), Change::HexText, Format::T485),
        (strings(&late), Change::ClockLate, Format::Ssi),
    ] {
        let found = detect(&dump);
        let best = found.iter().find(|one| one.change.is_some());
        let best = best.unwrap_or_else(|| panic!("{change:?}: {found:#?}"));
        assert_eq!(
            (best.change, best.profile.format),
            (Some(change), format),
            "{found:#?}"
        );
        assert_eq!(best.evidence[0], change.sentence());
        assert!(
            found.iter().all(|one| one.verdict != Verdict::Certain),
            "{found:#?}"
        );
        let medium = best.profile.medium();
        let changed = change.apply(&dump::parse(&dump, medium));
        let mut good = 0;
        let decoder = Decoder::new(best.profile).unwrap();
        let summary = decoder.dump(&changed, &mut |_| good += 1);
        assert!(
            summary.frames >= 59 && summary.bad <= 1,
            "{change:?}: {summary:?}"
        );
    }
}

#[test]
fn the_other_order_of_bytes_is_named() {
    let frames = byte_lines(&words("format=bus angle-bits=24 turns-bits=0", TURNING));
    let turned: Vec<Vec<u8>> = frames
        .iter()
        .map(|frame| vec![frame[0], frame[1], frame[4], frame[3], frame[2], frame[5]])
        .collect();
    let found = detect(&text(&turned));
    let bus = found
        .iter()
        .find(|one| one.profile.format == Format::Bus)
        .unwrap();
    assert!(says(bus, "with its bytes in the other order"), "{found:#?}");
}

#[test]
fn two_formats_in_one_dump_are_both_named() {
    let mut lines = byte_lines(&words("format=t485", TURNING));
    lines.extend(byte_lines(&words("format=asi1", TURNING)));
    let found = detect(&text(&lines));
    let mixed = found
        .iter()
        .filter(|one| says(one, "two formats are mixed"));
    assert_eq!(mixed.count(), 2, "{found:#?}");
}

#[test]
fn an_unknown_checksum_becomes_a_layout() {
    let layout = "Mine;line;const:8:0xa5,angle:20,skip:4,crc:8:0x97:xor=0xff";
    let profile = Profile::parse([("format", "own"), ("layout", layout)]).unwrap();
    let decoder = Decoder::new(profile).unwrap();
    let lines: Vec<Vec<u8>> = (0..FRAMES as u64)
        .map(|index| {
            let values = Values {
                angle: Some((index * 37_113 + 1_000) % 1_048_576),
                ..Values::default()
            };
            decoder.encode(&values).into_bytes()
        })
        .collect();
    let best = first(&text(&lines));
    assert_eq!(best.profile.format, Format::Own, "{best:#?}");
    assert!(says(&best, "the CRC of RS485, but inverted"), "{best:#?}");
    assert!(best.verdict != Verdict::Certain);
    let found = Decoder::new(best.profile).unwrap();
    let frame = |line: &Vec<u8>| {
        let read = found
            .line(encoderscope::bits::Bits::of_bytes(line))
            .unwrap();
        (read.ok(), read.values().angle)
    };
    let angles: Vec<_> = lines.iter().map(frame).collect();
    assert!(
        angles.iter().all(|(ok, angle)| *ok && angle.is_some()),
        "{best:#?}"
    );
}

#[test]
fn what_nearly_fits_a_chosen_profile_is_said() {
    let chosen = |kind: &str| *decoder(kind).profile();
    let dump = |kind: &str| {
        let medium = chosen(kind).medium();
        dump::parse(&dump_of(kind, TURNING), medium)
    };
    let beside = near(
        &chosen("format=biss-c angle-bits=24"),
        &dump("format=biss-c angle-bits=17"),
    );
    assert_eq!(beside[0].profile.angle_bits, 17, "{beside:#?}");
    assert!(
        beside[0].text.starts_with("with angle-bits 17"),
        "{beside:#?}"
    );
    let right = chosen("format=biss-c angle-bits=17");
    assert_eq!(near(&right, &dump("format=biss-c angle-bits=17")), []);
    let turned = Change::Inverted.apply(&dump("format=t485"));
    let beside = near(&chosen("format=t485"), &turned);
    assert_eq!(beside[0].change, Some(Change::Inverted), "{beside:#?}");
}

#[test]
fn nothing_is_likely_in_noise() {
    let mut noise = Noise::new(17);
    let mut draw = |count: usize| -> Vec<u8> { (0..count).map(|_| noise.draw() as u8).collect() };
    let mut dumps: Vec<(String, String)> = Vec::new();
    for round in 0..6 {
        for len in [3, 4, 5, 6, 7, 8, 11] {
            let lines: Vec<Vec<u8>> = (0..1 + round * 5).map(|_| draw(len)).collect();
            dumps.push((format!("{len} random bytes"), text(&lines)));
        }
    }
    for len in [2, 3, 4, 5, 6, 7, 8] {
        let count = |index: u64| index.to_be_bytes()[8 - len..].to_vec();
        let up: Vec<Vec<u8>> = (1..60).map(count).collect();
        dumps.push((format!("a counter in {len} bytes"), text(&up)));
        let flat = |byte: u8| text(&vec![vec![byte; len]; 30]);
        dumps.push(("zeros".to_string(), flat(0)));
        dumps.push(("ones".to_string(), flat(0xff)));
        let lines: Vec<Vec<u8>> = (0u8..40)
            .map(|index| {
                (0..len as u8)
                    .map(|at| index.wrapping_mul(len as u8).wrapping_add(at))
                    .collect()
            })
            .collect();
        dumps.push(("rising bytes".to_string(), text(&lines)));
    }
    let prose = "the quick brown fox jumps over the lazy dog, and the dog does not mind at all";
    dumps.push(("prose".to_string(), hex(prose.as_bytes())));
    let rows: Vec<Vec<u8>> = prose.as_bytes().chunks(6).map(<[u8]>::to_vec).collect();
    dumps.push(("prose in rows".to_string(), text(&rows)));
    for (name, dump) in &dumps {
        let found = detect(dump);
        let sure = found
            .iter()
            .find(|one| matches!(one.verdict, Verdict::Certain | Verdict::Likely));
        assert!(sure.is_none(), "{name}: {sure:#?}\n{dump}");
    }
}

/// The frames of one encoder out of the public captures: the format and bits per turn.
#[test]
fn captures_of_others_come_out_right() {
    let vectors: Vec<serde_json::Value> =
        serde_json::from_str(include_str!("../../vectors.json")).unwrap();
    let dump = |ids: &str| {
        let mine = vectors
            .iter()
            .filter(|one| one["id"].as_str().unwrap().starts_with(ids));
        let lines = mine.map(|one| one["hex"].as_str().or(one["bits"].as_str()).unwrap());
        lines.collect::<Vec<_>>().join("\n")
    };
    for (ids, format, angle_bits) in [
        ("tama-hpm-uart", Format::T485, 23),
        ("tama-hpm-sei", Format::T485, 23),
        ("biss-hpm", Format::BissC, 24),
        ("asi1-s0", Format::Asi1, 22),
    ] {
        let best = first(&dump(ids));
        assert_eq!(
            (best.profile.format, best.profile.angle_bits),
            (format, angle_bits),
            "{best:#?}"
        );
    }
}
