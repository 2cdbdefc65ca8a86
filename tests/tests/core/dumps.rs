#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{decode::Decoder, dump, format::Medium, profile::Profile};
use encoderscope_tests::{Noise, Stretch, decoder, paste, stretches};

fn profile_error(pairs: &[(&str, &str)]) -> String {
    Profile::parse(pairs.iter().copied())
        .unwrap_err()
        .to_string()
}

#[test]
fn bytes_are_read_in_any_spelling() {
    let expected = [0x1a, 0x20, 0x29, 0xc0];
    for text in [
        "1a 20 29 c0",
        "1A2029C0",
        "0x1A, 0x20,0x29,\t0xC0",
        "{ 0x1a, 0x20, 0x29, 0xc0 };",
        "\\x1a\\x20\\x29\\xc0",
        "1a-20-29-c0",
        "1a:20:29:c0\r\n",
        "1a2029\nc0",
        "00011010 00100000 00101001 11000000",
    ] {
        let dump = dump::parse(text, Medium::Bytes);
        assert_eq!(dump.bytes(), expected, "{text:?}");
        assert!(dump.unread().is_empty(), "{text:?}");
    }
}

#[test]
fn what_cannot_be_read_is_named_and_the_rest_is_kept() {
    let text = "1a 2z 29 0x é c0 123";
    let dump = dump::parse(text, Medium::Bytes);
    assert_eq!(dump.bytes(), [0x1a, 0x29, 0xc0]);
    let unread: Vec<_> = dump
        .unread()
        .places
        .iter()
        .map(|mark| &text[mark.at.start as usize..mark.at.end as usize])
        .collect();
    assert_eq!(unread, ["2z", "0x", "é", "123"]);
}

#[test]
fn bit_strings_keep_their_length() {
    let lens = |text: &str| {
        let dump = dump::parse(text, Medium::Bits);
        assert!(dump.unread().is_empty(), "{text}");
        let lens = dump.lines().map(|line| line.bits.len());
        (dump.is_bits(), lens.collect::<Vec<_>>())
    };
    assert_eq!(
        lens("1100101010101011111111\n1 0 1 1 0 0 1 0 1"),
        (true, vec![22, 9])
    );
    assert_eq!(lens("0b101 1\n0b1"), (true, vec![4, 1]));
    assert_eq!(lens("82 00 0b 80\n00 01 10 11"), (false, vec![32, 32]));
    assert_eq!(lens("00 01 10 11"), (false, vec![32]));
}

#[test]
fn a_biss_dump_may_be_bare_framed_or_a_number() {
    let framed = "82 00 05 80 00 60 68";
    let bare = "00 05 80 00 60 68";
    for (parameters, text, good) in [
        ("justify=left", framed, true),
        ("justify=left", bare, true),
        ("justify=right", "0002c0003034", true),
        ("justify=right", "0000 0100 02c0 0030 34", true),
        ("justify=left", "82 00 05 80 00 60 69", true),
        ("justify=left", "82 00 05 80 00 60 6a", false),
    ] {
        let decoder = decoder(&format!("format=biss-c angle-bits=17 {parameters}"));
        let found = stretches(&decoder, &paste(&decoder, text));
        assert_eq!(
            found.iter().all(Stretch::is_good),
            good,
            "{parameters} {text}: {found:?}"
        );
    }
}

#[test]
fn a_biss_capture_that_ends_early_is_short_and_never_good() {
    let decoder = decoder("format=biss-c angle-bits=17");
    let whole = [0x82, 0x00, 0x05, 0x80, 0x00, 0x60, 0x68];
    for len in 1..whole.len() {
        let text: String = whole[..len]
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect();
        let found = stretches(&decoder, &paste(&decoder, &text));
        assert!(
            matches!(&found[..], [Stretch::Skip(..)]),
            "{len}: {found:?}"
        );
    }
}

#[test]
fn what_follows_a_biss_frame_is_idle_or_the_frame_is_not_sure() {
    let decoder = decoder("format=biss-c angle-bits=17");
    let frame = "82 00 05 80 00 60 68";
    for (behind, good) in [
        ("", true),
        ("00 00", true),
        ("00 ff ff", true),
        ("ff ff", true),
        ("82 00 05 80 00 60 68", false),
        ("0f 00", false),
    ] {
        let found = stretches(&decoder, &paste(&decoder, &format!("{frame} {behind}")));
        assert_eq!(found.len(), 1, "{behind}");
        assert_eq!(found[0].is_good(), good, "{behind}: {found:?}");
    }
}

#[test]
fn bad_parameters_are_named_with_what_would_fit() {
    assert_eq!(
        profile_error(&[("format", "t48")]),
        "format: \"t48\" is not known; known: ssi biss-c rs485 t485 bus period asi1 asi4 ssi7 ssi-tree as5048 own"
    );
    assert_eq!(
        profile_error(&[]),
        "format: is missing; known: ssi biss-c rs485 t485 bus period asi1 asi4 ssi7 ssi-tree as5048 own"
    );
    assert_eq!(
        profile_error(&[("format", "t485"), ("angle-bits", "40")]),
        "angle-bits: 40 is not in 1…24 of T485"
    );
    assert_eq!(
        profile_error(&[("format", "t485"), ("colour", "red")]),
        "colour: is no parameter of a profile"
    );
    assert_eq!(
        profile_error(&[("format", "rs485"), ("command", "x")]),
        "command: \"x\" is no command; known: 0 1 d s t"
    );
    assert_eq!(
        profile_error(&[("format", "biss-c"), ("angle-bits", "60")]),
        "turns-bits: 16 and 60 bits of angle exceed the 64 of BiSS-C"
    );
    assert!(profile_error(&[("model", "MPP-20-30-A-24BM-T-N-A-M")]).contains("part 5"));
}

#[test]
fn both_spellings_and_an_order_code_make_the_same_profile() {
    let kebab = Profile::parse([("format", "t485"), ("angle-bits", "17")]).unwrap();
    let camel = Profile::parse([("angleBits", "17"), ("format", "T485")]).unwrap();
    let model = Profile::parse([("model", "pt-20-30-a-17bm-t-n-a-m")]).unwrap();
    assert_eq!(kebab, camel);
    assert_eq!(kebab, model);
}

#[test]
fn nonsense_never_panics_and_every_byte_is_accounted_for() {
    let mut noise = Noise::new(4);
    let profiles = [
        "format=t485",
        "format=rs485",
        "format=rs485 turns-bits=0 angle-bits=16 command=1",
        "format=biss-c",
    ];
    for parameters in profiles {
        let decoder: Decoder = decoder(parameters);
        for _ in 0..300 {
            let len = noise.below(200);
            let text: String = (0..len)
                .map(|_| match noise.below(12) {
                    0 => '\n',
                    1 => ' ',
                    2 => char::from_u32(noise.below(0x500) as u32).unwrap_or('?'),
                    3 => 'x',
                    _ => char::from_digit(noise.below(16) as u32, 16).unwrap(),
                })
                .collect();
            let dump = paste(&decoder, &text);
            let mut seen = 0;
            let summary = decoder.dump(&dump, &mut |decoded| {
                seen += match &decoded {
                    encoderscope::decode::Decoded::Frame(frame) => {
                        assert_eq!(
                            frame
                                .explain()
                                .iter()
                                .flat_map(|note| &note.spans)
                                .map(|span| span.len)
                                .sum::<usize>(),
                            frame.bits.len()
                        );
                        frame.bits.bytes().len()
                    }
                    encoderscope::decode::Decoded::Skip { bits, .. } => bits.bytes().len(),
                } as u64;
            });
            assert_eq!(seen, summary.bytes, "{parameters} {text:?}");
        }
    }
}

#[test]
fn whole_lines_are_read_as_those_that_come_in_pieces() {
    let mut random = Noise::new(9);
    let ends = [
        "\n",
        "\r\n",
        "\r",
        " \n",
        ",\n",
        " // at rest\n",
        "\n\n",
        "",
    ];
    let between = [" ", "  ", ",", ", ", "\t", ";", "", " 0x"];
    for medium in [Medium::Bytes, Medium::Bits] {
        let mut bytes = 0;
        for round in 0..200 {
            // Most lines of most texts are as plain as can be.
            let odd = 1 + random.below(40);
            let mut text = "1a 20 29 C0 3b\n".repeat(3);
            for _ in 0..30 {
                let mut choose = |from: &[&'static str]| match random.below(odd) {
                    0 => from[random.below(from.len() as u64) as usize],
                    _ => from[0],
                };
                let (end, mut gap) = (choose(&ends), choose(&between));
                let digits = choose(&["", "letters"]);
                for index in 0..1 + random.below(12) {
                    text += if index > 0 { gap } else { "" };
                    text += &match digits {
                        "" => format!("{:02x}", random.below(256)),
                        // Words are no data where there is nothing else.
                        _ => ["be", "ad", "AD", "cd"][random.below(4) as usize].into(),
                    };
                    gap = if random.below(100) == 0 { "-" } else { gap };
                }
                text += end;
            }
            let whole = dump::parse(&text, medium);
            let mut reader = dump::Reader::new(medium, &text);
            for piece in text.as_bytes().chunks(1 + round % 7) {
                reader.push(piece);
            }
            bytes += whole.bytes().len();
            assert_eq!(reader.finish(), whole, "{text:?}");
        }
        assert!(bytes > 20_000, "{bytes}");
    }
}
