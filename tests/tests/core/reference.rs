//! What the reference of the page is made of: words and ranges beside the layouts.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::{Bits, Span},
    check::Algorithm,
    decode::Decoder,
    dump::Direction,
    format::{Format, own::SHIPPED, t485::Request},
    profile::{Dialect, Profile},
    sequence::Change,
};

#[test]
fn every_format_and_parameter_says_what_it_is() {
    for format in Format::ALL.iter().chain(&[Format::Own]) {
        let manual = format.manual();
        assert!(
            !manual.about.is_empty() && !manual.about.ends_with('.'),
            "{format:?}"
        );
        assert!(!manual.source.is_empty(), "{format:?}");
        for name in format.parameters() {
            assert!(!Profile::doc(name).is_empty(), "{name}");
            let (words, docs) = (Profile::words(name), Profile::word_docs(name));
            assert_eq!(words.len(), docs.len(), "{name}");
            assert!(docs.iter().all(|doc| !doc.trim().is_empty()), "{name}");
        }
    }
}

#[test]
fn a_number_is_taken_exactly_where_its_range_says_so() {
    for format in Format::ALL {
        let profile = format.default_profile();
        for name in format.parameters() {
            let Some((least, most)) = profile.range(name) else {
                let is_word = !Profile::words(name).is_empty();
                assert!(is_word, "{name} of {format:?} is neither number nor word");
                continue;
            };
            let refused = |value: i64| {
                let error = profile.with(name, &value.to_string()).err();
                error.filter(|error| error.name == *name || error.name == "frame-bits")
            };
            // Beside a wide angle there may be no room for as many turns.
            assert_eq!(refused(i64::from(least)), None, "{name} of {format:?}");
            assert!(
                refused(i64::from(most) + 1).is_some(),
                "{name} of {format:?}"
            );
            assert!(
                refused(i64::from(least) - 1).is_some(),
                "{name} of {format:?}"
            );
        }
    }
}

#[test]
fn the_source_of_a_shipped_layout_is_its_own() {
    for shipped in SHIPPED {
        let profile = Profile::parse([("format", "own"), ("layout", shipped.name)]).unwrap();
        assert_eq!(profile.source(), shipped.source);
    }
    assert_eq!(Format::Ssi7.default_profile().source(), "IP-75, 5.4.1");
}

/// A program goes through the table byte by byte.
fn by_table(crc: &Algorithm, table: &[u64], bytes: &[u8]) -> u64 {
    let mask = (1u64 << crc.width) - 1;
    let reversed = |value: u64| value.reverse_bits() >> (64 - crc.width);
    let mut register = if crc.refin {
        reversed(crc.init)
    } else {
        crc.init
    } & mask;
    for byte in bytes {
        let byte = u64::from(*byte);
        register = match crc.refin {
            true => (register >> 8) ^ table[((register ^ byte) & 0xff) as usize],
            false => {
                let index = ((register >> (crc.width - 8)) ^ byte) & 0xff;
                ((register << 8) & mask) ^ table[index as usize]
            }
        };
    }
    let out = if crc.refin == crc.refout {
        register
    } else {
        reversed(register)
    };
    (out ^ crc.xorout) & mask
}

#[test]
fn a_table_computes_what_the_algorithm_does() {
    let text = b"123456789";
    let mut seen = 0;
    for (name, crc) in Algorithm::KNOWN {
        let table = crc.table();
        assert_eq!(table.len(), 1 << crc.width.min(8), "{name}");
        if crc.width < 8 {
            continue;
        }
        seen += 1;
        let right = crc.compute(Bits::of_bytes(text), Span::new(0, text.len() * 8));
        assert_eq!(by_table(crc, &table, text), right, "{name}");
    }
    assert!(seen > 30);
}

#[test]
fn a_request_says_what_it_asks_for() {
    for request in Request::ALL {
        let operation = request.byte() >> 3 & 0b1111;
        assert_eq!(Request::of_operation(operation), Some(*request));
    }
    assert_eq!(Request::of_operation(0b1111), None);
    let text = |parameters: &[(&str, &str)], name: &str| {
        let decoder = Decoder::new(Profile::parse(parameters.iter().copied()).unwrap()).unwrap();
        let kinds = decoder.frame_kinds();
        let kind = kinds.iter().find(|kind| kind.name == name).unwrap();
        let notes = kind.layout.explain(kind.example.as_bits());
        let mut said = notes
            .into_iter()
            .filter(|note| note.name == "operation" || note.name == "command");
        said.next().map(|note| note.text).unwrap()
    };
    let rs485 = [("format", "rs485"), ("command", "s")];
    assert_eq!(text(&rs485, "request"), "‘s’: position and speed");
    assert_eq!(text(&[("format", "bus")], "set-zero"), "01: set zero");
    assert_eq!(text(&[("format", "t485")], "turns"), "0x8A: turns");
    let own = [("format", "own"), ("layout", "rls-orbis-serial")];
    assert_eq!(text(&own, "request"), "0x31: what the encoder answers to");
}

#[test]
fn steps_say_what_is_sent_and_what_comes_back() {
    let t485 = Format::T485.default_profile();
    let tamagawa = Profile {
        dialect: Dialect::Tamagawa,
        ..t485
    };
    for (profile, count) in [
        (Format::Rs485.default_profile(), 1),
        (t485, 2),
        (tamagawa, 4),
        (Format::Bus.default_profile(), 2),
    ] {
        let all = Change::all(&profile);
        assert_eq!(all.len(), count);
        for change in all {
            let script = change.script(&profile).unwrap();
            for step in script.round.iter().chain([&script.before, &script.after]) {
                let bytes = change.bytes(&profile, step.send);
                let decoder = Decoder::new(profile).unwrap();
                let known = decoder.frame_kinds().into_iter().any(|kind| {
                    kind.direction == Direction::Sent
                        && kind.example.as_bits().len() == bytes.len() * 8
                });
                assert!(known, "{} of {}", step.send.title(), script.title);
                assert!(!step.send.title().is_empty() && !step.expect.to_string().is_empty());
            }
            assert!(!script.proof.to_string().is_empty());
        }
    }
}
