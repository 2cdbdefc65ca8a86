//! Pictures as they were.
//!
//! `tests/diagrams/NAME.svg` are goldens; `UPDATE=1 cargo test -p encoderscope-tests --test core
//! diagrams_golden` writes them anew.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::diagrams_svg::{pictures, read};
use encoderscope::{
    bits::BitString,
    diagram::svg::{Style, Theme},
};
use encoderscope_tests::{decoder, golden as files};

struct Golden {
    name: &'static str,
    parameters: &'static str,
    frame: &'static [u8],
    theme: Theme,
    expected: &'static str,
}

const GOLDENS: &[Golden] = &[
    Golden {
        name: "biss-c",
        parameters: "format=biss-c angle-bits=17",
        frame: &[0x82, 0x00, 0x05, 0x80, 0x00, 0x60, 0x69],
        theme: Theme::Auto,
        expected: include_str!("../../diagrams/biss-c.svg"),
    },
    // A public capture; its CRC is turned over here.
    Golden {
        name: "t485-bad",
        parameters: "format=t485",
        frame: &[
            0x1a, 0x20, 0x29, 0xc0, 0x3b, 0x17, 0x00, 0x00, 0x00, 0xc8, 0x36,
        ],
        theme: Theme::Light,
        expected: include_str!("../../diagrams/t485-bad.svg"),
    },
];

#[test]
fn pictures_are_as_they_were() {
    for golden in GOLDENS {
        let decoder = decoder(golden.parameters);
        let bits = BitString::of_bytes(golden.frame.into());
        let frame = read(&decoder, &bits);
        let style = Style {
            theme: golden.theme,
            ..Style::default()
        };
        let [found, _] = pictures(&frame, &style);
        if files::is_updating() {
            files::write(&format!("diagrams/{}.svg", golden.name), &found);
            continue;
        }
        let pairs = found.lines().zip(golden.expected.lines());
        for (number, (found, expected)) in pairs.enumerate() {
            assert_eq!(found, expected, "{} line {}", golden.name, number + 1);
        }
        assert_eq!(found, golden.expected, "{}", golden.name);
    }
}
