//! Laws of reading text and of decoding it piece by piece.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::BitString,
    decode::{Decoded, Decoder, Pass, Summary},
    dump::{Direction, Dropped, Dump, Reader, parse},
    format::Medium,
    framing::Why,
};
use encoderscope_tests::{Noise, decoder};

const MEDIA: [Medium; 3] = [Medium::Bytes, Medium::Bits, Medium::Text];

/// Pieces of which pastes are made.
const WORDS: [&str; 44] = [
    "1a",
    "20",
    "0x1A",
    "1A2029C0",
    "0b1011",
    "1011",
    "0",
    "255",
    "1Ah",
    "\\x1a",
    "b'\\x1a )'",
    "$1F",
    "dead",
    "feed",
    "hello",
    "\n",
    "\r\n",
    "\n",
    "\n\n",
    " ",
    ", ",
    "  ",
    "\t",
    "|",
    "[12:00:01.234] ",
    "12:00:01 ",
    "RX: ",
    "TX: ",
    "<< ",
    ">> ",
    "→",
    "> ",
    "{",
    "} // end",
    "/* ",
    " */",
    "= ",
    "=\n",
    "00000000  ",
    "*\n",
    "Time [s],Value,Parity Error\n",
    "uart-1: rx-data: 1A\n",
    "\u{a0}С0\u{200b}",
    "\u{0}",
];

fn paste(noise: &mut Noise) -> String {
    let len = noise.below(60);
    let kinds = 1 + noise.below(WORDS.len() as u64);
    let first = noise.below(WORDS.len() as u64);
    let word = |noise: &mut Noise| WORDS[(first + noise.below(kinds)) as usize % WORDS.len()];
    (0..len)
        .map(|_| match noise.below(20) {
            0 => char::from_u32(noise.below(0x2100) as u32).map_or_else(String::new, String::from),
            1..=6 => format!("{:02x} ", noise.below(256)),
            _ => word(noise).to_string(),
        })
        .collect()
}

fn decoders() -> Vec<Decoder> {
    [
        "format=t485",
        "format=rs485 command=d",
        "format=bus",
        "format=asi4",
        "format=biss-c angle-bits=17",
        "format=ssi-tree",
    ]
    .map(decoder)
    .into()
}

/// A stretch that can be compared, and what a pass counted.
type Told = (u64, Vec<u8>, usize, Option<Why>, bool, Option<u64>);

fn told(decoded: &Decoded<'_>) -> Told {
    match decoded {
        Decoded::Frame(frame) => {
            let bytes = frame.bits.bytes().to_vec();
            (
                frame.start,
                bytes,
                frame.bits.len(),
                None,
                frame.ok(),
                frame.request,
            )
        }
        Decoded::Skip { start, bits, why } => (
            *start,
            bits.bytes().to_vec(),
            bits.len(),
            Some(*why),
            false,
            None,
        ),
    }
}

fn whole(decoder: &Decoder, dump: &Dump) -> (Vec<Told>, Summary) {
    let mut all = Vec::new();
    let summary = decoder.dump(dump, &mut |decoded| all.push(told(&decoded)));
    (all, summary)
}

#[test]
fn a_text_cut_anywhere_is_the_same_dump() {
    let mut noise = Noise::new(31);
    for _ in 0..600 {
        let text = paste(&mut noise);
        for medium in MEDIA {
            let expected = parse(&text, medium);
            let mut reader = Reader::new(medium, &text);
            let mut rest = text.as_bytes();
            let mut before = 0;
            while !rest.is_empty() {
                let cut = (1 + noise.below(9) as usize).min(rest.len());
                reader.push(&rest[..cut]);
                rest = &rest[cut..];
                assert!(reader.dump().len() >= before);
                before = reader.dump().len();
            }
            assert_eq!(reader.finish(), expected, "{medium:?} {text:?}");
        }
    }
}

#[test]
fn every_byte_of_any_text_is_in_one_stretch_and_places_are_in_the_text() {
    let mut noise = Noise::new(32);
    let decoders = decoders();
    for _ in 0..400 {
        let text = paste(&mut noise);
        for decoder in &decoders {
            let dump = parse(&text, decoder.profile().medium());
            for marks in [dump.dropped(), dump.unread()] {
                for mark in &marks.places {
                    let place = mark.at.start as usize..mark.at.end as usize;
                    assert!(
                        text.get(place).is_some_and(|part| !part.is_empty()),
                        "{mark:?} {text:?}"
                    );
                }
                let kinds = Dropped::ALL.iter().map(|kind| marks.count(*kind));
                assert_eq!(kinds.sum::<u64>(), marks.total);
            }
            let (all, summary) = whole(decoder, &dump);
            let bytes: Vec<u8> = all.iter().flat_map(|told| told.1.clone()).collect();
            assert_eq!(bytes, dump.bytes(), "{text:?}");
            assert_eq!(summary.bytes, bytes.len() as u64);
            let mut at = 0;
            for told in &all {
                assert_eq!(told.0, at, "{text:?}");
                at += if dump.is_bits() { told.2 } else { told.1.len() } as u64;
            }
        }
    }
}

#[test]
fn any_budget_gives_the_same_frames() {
    let mut noise = Noise::new(33);
    for decoder in decoders() {
        for _ in 0..60 {
            let text: String = (0..noise.below(30))
                .map(|index| {
                    let mut values = encoderscope::reading::Values {
                        angle: Some(index * 3),
                        turns: Some(5),
                        ..Default::default()
                    };
                    values.angle = values.angle.filter(|_| noise.below(9) > 0);
                    let frame = decoder.encode(&values);
                    let mut line = String::from(
                        ["", "TX: 64\nRX: ", "RX: ", "[0.5] "][noise.below(4) as usize],
                    );
                    let skip = noise.below(12) / 11;
                    for byte in frame.as_bits().bytes().iter().skip(skip as usize) {
                        line += &format!("{byte:02x} ");
                    }
                    line + "\n"
                })
                .collect();
            let medium = decoder.profile().medium();
            let dump = parse(&text, medium);
            let (expected, summary) = whole(&decoder, &dump);
            // At any budget, of a dump that grows meanwhile.
            let mut reader = Reader::new(medium, &text);
            let mut pass = Pass::new();
            let mut all = Vec::new();
            for piece in text.as_bytes().chunks(1 + noise.below(40) as usize) {
                reader.push(piece);
                let budget = noise.below(20) as usize;
                while pass.step(&decoder, reader.dump(), budget, &mut |decoded| {
                    all.push(told(&decoded));
                }) {
                    if noise.below(3) == 0 {
                        break;
                    }
                }
            }
            let grown = reader.finish();
            pass.finish(&decoder, &grown, &mut |decoded| all.push(told(&decoded)));
            assert_eq!(all, expected, "{text}");
            assert_eq!(pass.summary(), summary, "{text}");
        }
    }
}

#[test]
fn lines_are_found_by_their_offset() {
    let lens = |index: usize| 1 + index * 7 % 61;
    let lines = (0..1000).map(|index| (BitString::zeros(lens(index)), Some(index as f64)));
    let dump = Dump::of_lines(lines);
    assert!(dump.is_bits());
    assert_eq!((dump.len(), dump.lines().len()), (1000, 1000));
    let mut start = 0;
    for (index, line) in dump.lines().enumerate() {
        assert_eq!((line.start, line.bits.len()), (start, lens(index)));
        assert_eq!(dump.line(index), Some(line));
        for at in [start, start + lens(index) as u64 - 1] {
            assert_eq!(dump.line_at(at), index);
        }
        start += lens(index) as u64;
    }
    assert_eq!(dump.line_at(start + 5), 999);
    assert_eq!(dump.line(1000), None);
    let bytes = Dump::of_bytes([1, 2, 3]);
    assert_eq!(
        (bytes.bytes(), bytes.len(), bytes.is_bits()),
        (&[1, 2, 3][..], 1, false)
    );
    assert_eq!(
        (Dump::of_bytes([]).len(), Dump::default().line_at(7)),
        (0, 0)
    );
}

#[test]
fn nothing_and_noise_give_a_clear_result() {
    for text in ["", " \n\t\r\n", "\0\0\0", "\u{feff}", "***\n---\n"] {
        for medium in MEDIA {
            let dump = parse(text, medium);
            assert!(dump.is_empty() && dump.unread().is_empty(), "{text:?}");
        }
    }
    // However much of it there is, only so many places are kept.
    let dump = parse(&"1a 2z ".repeat(50_000), Medium::Bytes);
    assert_eq!((dump.bytes().len(), dump.unread().total), (50_000, 50_000));
    assert!(dump.unread().places.len() <= 1_000);
    assert!(dump.len() > 1, "a line without end is several");
}

#[test]
fn repeated_lines_are_written_out_only_so_far() {
    let line = "1a 20 29 c0 3b 17 00 00 00 c8 37 1a 20 29 c0 3b";
    let text = |end: &str| format!("00000000  {line}\n00000010  {line}\n*\n{end}\n");
    assert_eq!(parse(&text("00000100"), Medium::Bytes).bytes().len(), 0x100);
    for end in ["ffffffff0", "00000105"] {
        let dump = parse(&text(end), Medium::Bytes);
        assert_eq!(dump.bytes().len(), 0x20, "{end}");
        assert_eq!(dump.dropped().count(Dropped::Repeat), 1, "{end}");
    }
}

#[test]
fn times_and_directions_are_those_of_the_line() {
    for (text, time, direction) in [
        (
            "[12:00:01.234] RX: 1a 20",
            43_201.234,
            Some(Direction::Received),
        ),
        ("12:00:01,234 Tx 1a 20", 43_201.234, Some(Direction::Sent)),
        ("2024-05-06 00:00:01.5 -> 1a 20", 1.5, Some(Direction::Sent)),
        ("1234.567 ms << 1a 20", 1.234_567, Some(Direction::Received)),
        ("0.001234 s OUT 1a 20", 0.001_234, Some(Direction::Sent)),
        ("(001.234) IN: 1a 20", 1.234, Some(Direction::Received)),
        (
            "06.05.2024 12:00:01 PM [RX] - 1a 20",
            43_201.0,
            Some(Direction::Received),
        ),
        ("TX 12:00:01.5: 1a 20", 43_201.5, Some(Direction::Sent)),
        ("12:00:01 1a 20", 43_201.0, None),
    ] {
        let dump = parse(text, Medium::Bytes);
        let line = dump.line(0).unwrap();
        assert_eq!(line.bits.bytes(), [0x1a, 0x20], "{text}");
        assert!(
            line.time.is_some_and(|found| (found - time).abs() < 1e-9),
            "{text} {:?}",
            line.time
        );
        assert_eq!(line.direction, direction, "{text}");
    }
    // A date is counted from the first one.
    let dump = parse(
        "2024-02-28 23:59:59.0 1a\n2024-03-01 00:00:00.0 20",
        Medium::Bytes,
    );
    let times: Vec<_> = dump.lines().filter_map(|line| line.time).collect();
    assert_eq!(times, [86_399.0, 2.0 * 86_400.0]);
    // Bytes between colons are no time.
    assert_eq!(
        parse("12:00:01:0a\n1a:20:29:c0", Medium::Bytes)
            .bytes()
            .len(),
        8
    );
}

#[test]
fn what_is_text_is_never_bytes() {
    for text in [
        "a dead feed be added",
        "be a dead feed",
        "On 6 May 2024 at 10:22, Abe wrote:",
        "Tel. +49 30 123456",
        "Phone: +7 (495) 123-45-67",
        "Date: 12 05 2024",
        "Sent: Monday, May 6, 2024 12:00",
        "Best regards, Ed",
    ] {
        for medium in [Medium::Bytes, Medium::Bits] {
            let dump = parse(&format!("{text}\n1a 20 29 c0 3b 17\n"), medium);
            assert_eq!(dump.bytes(), [0x1a, 0x20, 0x29, 0xc0, 0x3b, 0x17], "{text}");
            assert_eq!(dump.line(0).map(|line| line.bits.len()), Some(48), "{text}");
            assert!(dump.dropped().total > 0, "{text}");
        }
    }
    assert_eq!(
        parse("de ad be ef", Medium::Bytes).bytes(),
        [0xde, 0xad, 0xbe, 0xef]
    );
}

#[test]
fn zeros_and_ones_are_bits_only_where_they_look_so() {
    for (text, bits) in [
        ("0b1011 0101", true),
        ("1011 0101 1100", true),
        ("1 0 1 1 0 0 1 0 1", true),
        ("00 01 10 11 01 10", false),
        ("000000000100\n000000000010\n", false),
        ("0000000001001\n0000000001101\n", true),
        ("0000000000001000\n0000000000000a00\n", false),
    ] {
        assert_eq!(parse(text, Medium::Bits).is_bits(), bits, "{text}");
    }
}

#[test]
fn decimal_needs_evidence() {
    for (text, bytes, writing) in [
        ("26, 32, 41, 192", &[26, 32, 41, 192][..], "decimal"),
        ("[26, 32]", &[26, 32], "source code"),
        (
            "26 32 41",
            &[0x26, 0x32, 0x41],
            "hexadecimal, though decimal would fit too",
        ),
        ("26 05 41", &[0x26, 0x05, 0x41], "hexadecimal"),
        ("026 032 041 192", &[26, 32, 41, 192], "decimal"),
    ] {
        let dump = parse(text, Medium::Bytes);
        assert_eq!(dump.bytes(), bytes, "{text}");
        assert_eq!(dump.writing().to_string(), writing, "{text}");
    }
}
