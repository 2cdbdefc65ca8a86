//! What the manuals ask, measured on timelines.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::{
    captures::{PROFILES, US, values},
    diagrams::drawn,
};
use encoderscope::diagram::{Master, Timeline};
use encoderscope_tests::decoder;

/// The names of the limits that fail.
fn failing(timeline: &Timeline) -> Vec<&'static str> {
    let failing = timeline.limits.iter().filter(|limit| !limit.holds);
    failing.map(|limit| limit.name).collect()
}

#[test]
fn what_the_manual_forbids_is_told_of() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let frame = decoder.encode(&values(&decoder)[2]);
        let timing = decoder.profile().format.timing().unwrap();
        let clocked_by =
            |master: Master| Timeline::new(decoder.main_layout(), frame.as_bits(), &master);
        let clocked = |hertz: u32| Master {
            hertz,
            first_low: Some(US / 2),
            ..Master::default()
        };
        for hertz in [timing.slowest - 1, timing.limit() + 1] {
            let timeline = clocked_by(clocked(hertz));
            assert_eq!(failing(&timeline), ["clock"], "{parameters} {hertz}");
        }
        // So slow that the encoder gives the reading up between two edges.
        let slow = clocked_by(clocked(10_000));
        assert_eq!(failing(&slow), ["clock", "time-out"], "{parameters}");
        let short = Master {
            pause: Some(timing.pause - 1),
            ..Master::default()
        };
        let short = clocked_by(short);
        assert_eq!(failing(&short), ["pause"], "{parameters}");
        let pause = short.limits.iter().find(|limit| limit.name == "pause");
        let pause = pause.unwrap();
        assert_eq!(pause.source, timing.source);
        assert_eq!(pause.at.1 - pause.at.0, timing.pause - 1);
        for limit in &short.limits {
            assert!((0..=short.end).contains(&limit.at.0));
            assert!((0..=short.end).contains(&limit.at.1), "{}", limit.name);
        }
    }
    let ssi = decoder("format=ssi");
    let frame = ssi.encode(&values(&ssi)[2]);
    let fast = Master {
        hertz: 5_000_000,
        ..Master::default()
    };
    let fast = Timeline::new(ssi.main_layout(), frame.as_bits(), &fast);
    assert_eq!(failing(&fast), ["first low"]);
    assert_eq!(fast.limits[1].value, "100 ns");
    assert_eq!(fast.limits[1].text, "500 ns above 1.5 MHz");
}

#[test]
fn streams_and_the_bus_are_measured_by_their_own_limits() {
    let limits = |parameters: &str| {
        let decoder = decoder(parameters);
        let frame = decoder.encode(&values(&decoder)[2]);
        let layout = decoder.layout(frame.as_bits().bytes()).unwrap();
        drawn(layout, frame.as_bits()).limits
    };
    let one = |parameters: &str| {
        let limits = limits(parameters);
        assert_eq!(limits.len(), 1, "{parameters}");
        limits.into_iter().next().unwrap()
    };
    let period = one("format=period");
    assert_eq!(
        (period.text.as_str(), period.value.as_str(), period.holds),
        ("a frame every 1 ms", "a frame lasts 28 µs", true)
    );
    assert!(!one("format=period baud=9600").holds);
    assert!(one("format=asi1").holds && one("format=asi4").holds);
    // Nine bytes of silence: the request's time is over, three microseconds and eight bytes fit.
    let bus = one("format=bus");
    assert_eq!(
        (bus.text.as_str(), bus.value.as_str(), bus.holds),
        (
            "other devices are deaf for 36 µs",
            "the reply is over after 35 µs",
            true
        )
    );
    for widths in ["angle-bits=16 turns-bits=16", "angle-bits=20 turns-bits=0"] {
        assert!(one(&format!("format=bus {widths}")).holds);
    }
    assert!(limits("format=t485").is_empty());
    assert!(limits("format=rs485").is_empty());
}
