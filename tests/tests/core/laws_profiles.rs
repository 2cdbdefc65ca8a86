//! Laws of profiles and their parameters.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::layouts::{layouts, widths};
use encoderscope::{
    decode::Decoder,
    format::{Format, rs485::Command},
    profile::{
        Align, Choice, Code, Dialect, Justify, Marker, Parity, Profile, StatusActive, TurnsCode,
        camel,
    },
};

fn parse(parameters: &str) -> Result<Profile, String> {
    let pairs = parameters
        .split_whitespace()
        .map(|pair| pair.split_once('=').unwrap_or((pair, "")));
    Profile::parse(pairs).map_err(|error| error.to_string())
}

/// Words that a parameter of this name can be, whatever the format.
fn words(name: &str, format: Format) -> Vec<String> {
    fn all<T: Choice>() -> Vec<String> {
        T::WORDS.iter().map(ToString::to_string).collect()
    }
    let numbers = |numbers: &[u32]| numbers.iter().map(ToString::to_string).collect();
    let limits = format.limits();
    match name {
        "angle-bits" => numbers(&[1, 2, 11, limits.angle]),
        "turns-bits" => numbers(&[0, 1, 5, limits.turns.min(32)]),
        "status-bits" => (0..=8).map(|bits: u32| bits.to_string()).collect(),
        "ack-bits" => numbers(&[1, 5, 64]),
        "command" => Command::ALL
            .iter()
            .map(|command| command.letter().to_string())
            .collect(),
        "address" => (0..=31).map(|address: u32| address.to_string()).collect(),
        "code" => all::<Code>(),
        "align" => all::<Align>(),
        "frame-bits" => numbers(&[limits.frame.0.max(28), limits.frame.1]),
        "parity" => all::<Parity>(),
        "turns-code" => all::<TurnsCode>(),
        "status-active" => all::<StatusActive>(),
        "dialect" => all::<Dialect>(),
        "marker" => all::<Marker>(),
        "baud" => numbers(&[1, 9_600, 115_200, 230_400, 2_500_000, 50_000_000]),
        "justify" => all::<Justify>(),
        other => panic!("{other} of {format:?} is not tested"),
    }
}

/// Writes the parameters of a profile and reads them again, in both spellings.
fn assert_read_back(name: &str, profile: &Profile) {
    let written: Vec<(&str, String)> = profile
        .parameters()
        .into_iter()
        .map(|(name, value)| (name, value.plain()))
        .collect();
    let pairs = || written.iter().map(|(name, value)| (*name, value.as_str()));
    assert_eq!(Profile::parse(pairs()).as_ref(), Ok(profile), "{name}");
    let reversed: Vec<_> = pairs().collect();
    let reversed = reversed.into_iter().rev();
    assert_eq!(Profile::parse(reversed).as_ref(), Ok(profile), "{name}");
    let camel: Vec<_> = pairs().map(|(name, value)| (camel(name), value)).collect();
    let camel = camel.iter().map(|(name, value)| (name.as_str(), *value));
    assert_eq!(Profile::parse(camel).as_ref(), Ok(profile), "{name}");
}

#[test]
fn every_parameter_of_every_format_is_read_back() {
    for format in Format::ALL {
        let own = format.name();
        assert_read_back(own, &parse(&format!("format={own}")).unwrap());
        for parameter in format.parameters() {
            assert!(Profile::knows(parameter) && Profile::knows(&camel(parameter)));
            for word in words(parameter, *format) {
                // Narrow numbers leave room for the widest of another parameter.
                let room = match *parameter {
                    "angle-bits" if format.limits().turns > 0 => "turns-bits=0",
                    "turns-bits" | "frame-bits" => "angle-bits=12",
                    _ => "",
                };
                let name = format!("format={own} {room} {parameter}={word}");
                let profile = parse(&name).unwrap();
                let written = profile.parameters();
                let value = written.iter().find(|(name, _)| name == parameter);
                assert_eq!(value.unwrap().1.plain(), word, "{name}");
                assert_read_back(&name, &profile);
            }
        }
    }
}

#[test]
fn the_profile_of_every_layout_is_read_back() {
    for case in layouts().iter().step_by(7) {
        assert_read_back(&case.name, &case.layout.shape.profile);
    }
}

#[test]
fn every_width_makes_a_decoder_for_its_profile() {
    for format in Format::ALL {
        for name in widths(*format) {
            let profile = parse(&name).unwrap();
            assert_eq!(profile.check(), Ok(()), "{name}");
            assert_eq!(*Decoder::new(profile).unwrap().profile(), profile, "{name}");
        }
    }
}

#[test]
fn a_parameter_out_of_range_is_named() {
    for format in Format::ALL {
        let own = format.name();
        let limits = format.limits();
        let wrong = |parameter: &str| -> Vec<String> {
            let numbers: &[u32] = match parameter {
                "angle-bits" => &[0, limits.angle + 1, u32::MAX],
                "turns-bits" => &[limits.turns + 1, u32::MAX],
                "status-bits" => &[9],
                "ack-bits" => &[0, 256],
                "address" => &[32],
                "baud" => &[0, 50_000_001],
                "frame-bits" => &[0, limits.frame.0 - 1, limits.frame.1 + 1, u32::MAX],
                _ => &[],
            };
            let numbers = numbers.iter().map(ToString::to_string);
            let texts = ["", "-1", "1.5", "4294967296", "twelve", "0x10", "NONE"];
            numbers.chain(texts.map(String::from)).collect()
        };
        for parameter in format.parameters() {
            for word in wrong(parameter) {
                let error = parse(&format!("format={own} {parameter}={word}")).unwrap_err();
                let named = error.starts_with(&format!("{parameter}: "));
                assert!(named, "{own} {parameter}={word}: {error}");
            }
        }
    }
}

#[test]
fn numbers_that_do_not_fit_together_name_a_parameter() {
    for (parameters, name) in [
        ("format=ssi angle-bits=32 turns-bits=17", "turns-bits"),
        ("format=biss-c angle-bits=49 turns-bits=16", "turns-bits"),
        ("format=biss-c angle-bits=33 turns-bits=32", "turns-bits"),
        ("format=asi1 turns-bits=1", "turns-bits"),
        ("format=asi4 turns-bits=1", "turns-bits"),
        ("format=ssi7 turns-bits=1", "turns-bits"),
        ("format=ssi-tree frame-bits=24", "frame-bits"),
        ("format=ssi-tree frame-bits=25 parity=even", "frame-bits"),
        ("format=ssi-tree turns-bits=9 frame-bits=24", "frame-bits"),
        ("format=ssi-tree turns-bits=0 frame-bits=12", "frame-bits"),
        (
            "format=ssi-tree align=right turns-bits=9 frame-bits=21",
            "frame-bits",
        ),
    ] {
        let error = parse(parameters).unwrap_err();
        assert!(
            error.starts_with(&format!("{name}: ")),
            "{parameters}: {error}"
        );
    }
    for parameters in [
        "format=ssi angle-bits=32 turns-bits=16",
        "format=biss-c angle-bits=48 turns-bits=16",
        "format=biss-c angle-bits=32 turns-bits=32",
        "format=ssi-tree frame-bits=26 parity=even",
        "format=ssi-tree align=right turns-bits=9 frame-bits=22",
        "format=ssi-tree turns-bits=0 frame-bits=13",
    ] {
        assert!(parse(parameters).is_ok(), "{parameters}");
    }
}

/// P+F, table 4: 13 clocks a single turn, 25 a multi-turn word; IP-75, 5.4.1: 30.
#[test]
fn a_word_has_the_length_of_its_manual_when_none_is_given() {
    for (parameters, bits) in [
        ("format=ssi-tree", 25),
        ("format=ssi-tree parity=odd angle-bits=12", 25),
        ("format=ssi-tree parity=odd", 26),
        ("format=ssi-tree turns-bits=9 angle-bits=7", 25),
        ("format=ssi-tree turns-bits=16 angle-bits=18", 34),
        ("format=ssi-tree turns-bits=0", 13),
        ("format=ssi-tree turns-bits=0 angle-bits=12 parity=even", 13),
        ("format=ssi-tree turns-bits=0 angle-bits=18", 18),
        ("format=ssi7", 30),
    ] {
        let profile = parse(parameters).unwrap();
        assert_eq!(profile.frame_bits, bits, "{parameters}");
        let decoder = Decoder::new(profile).unwrap();
        assert_eq!(decoder.main_layout().len, bits as usize, "{parameters}");
    }
}

#[test]
fn names_of_formats_are_read_back() {
    for format in Format::ALL {
        assert_eq!(Format::parse(format.name()), Some(*format));
        assert_eq!(format.default_profile().check(), Ok(()));
    }
}

#[test]
fn every_interface_letter_of_an_order_code_has_its_format() {
    for (letter, format, turns) in [
        ("S", Format::Ssi, ""),
        ("B", Format::BissC, "BM"),
        ("R", Format::Rs485, "M"),
        ("A", Format::Rs485, "FM"),
        ("T", Format::T485, "BM"),
        ("D", Format::Bus, "M"),
        ("P", Format::Period, ""),
    ] {
        let code = format!("MPP-20-30-A-23{turns}-{letter}-N-A-M");
        let profile = encoderscope::model::parse(&code).unwrap().profile;
        let turns_bits = if turns.is_empty() { 0 } else { 16 };
        assert_eq!(
            (profile.format, profile.angle_bits, profile.turns_bits),
            (format, 23, turns_bits),
            "{code}"
        );
        assert_eq!(profile.check(), Ok(()), "{code}");
    }
}
