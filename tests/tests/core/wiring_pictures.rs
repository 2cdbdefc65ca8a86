//! Pictures of wirings: well-formed, complete in words, and without crossings.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::{diagrams_svg::text_of, wiring::wirings};
use encoderscope::wiring::{OHMS, svg};

#[test]
fn pictures_are_well_formed_and_say_everything_in_words() {
    for wiring in wirings() {
        let picture = svg(&wiring);
        let text = text_of(&picture).unwrap_or_else(|error| panic!("{:?}: {error}", wiring.setup));
        // A page without inline styles and scripts shows it.
        for banned in ["style", "<script", "href", "onload"] {
            assert!(!picture.contains(banned), "{banned}");
        }
        for wire in &wiring.wires {
            assert!(text.contains(wire.signal), "{}", wire.signal);
            if let Some(paint) = wire.paint {
                assert!(text.contains(&paint.name()));
                assert!(picture.contains(paint.base.hex()));
            }
            if let Some(terminal) = wire.goes {
                assert!(text.contains(terminal.name), "{}", terminal.name);
            }
        }
        let resistors = picture.matches("height=\"22\"").count();
        assert_eq!(resistors, wiring.terminators.len(), "{:?}", wiring.setup);
        assert_eq!(text.matches(&format!("{OHMS} Ω")).count(), resistors);
        assert!(picture.contains("width=\"360\""), "it fits a phone");
    }
}

#[test]
fn wires_lie_side_by_side_and_do_not_cross() {
    for wiring in wirings() {
        let picture = svg(&wiring);
        let mut last = 0.0;
        let mut count = 0;
        // A wire in its colours is the one path with this width.
        for path in picture.split("stroke-width=\"5.5\"").skip(1) {
            let (_, path) = path.split_once(" d=\"M").unwrap();
            let (path, _) = path.split_once('"').unwrap();
            let points: Vec<f64> = path
                .split([' ', 'L'])
                .map(|number| number.parse().unwrap())
                .collect();
            let [_, from, _, to] = points[..] else {
                panic!("{path}")
            };
            assert_eq!(from, to, "level");
            assert!(from >= last, "one below the other");
            if from > last {
                count += 1;
            }
            last = from;
        }
        let painted = wiring.wires.iter().filter(|wire| wire.paint.is_some());
        assert_eq!(count, painted.count());
    }
}
