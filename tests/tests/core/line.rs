//! What goes wrong between an encoder and its host, and that the encoder knows it.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::Bits,
    emulator::{Emulator, Faults, Sent, Shaft},
    reading::Reading,
    session::{Micros, Output, Session},
};
use encoderscope_tests::decoder;

const SECOND: Micros = 1_000_000;

/// What arrives of `count` replies of an encoder, each with its time, and what the encoder says
/// of it.
fn replies(parameters: &str, faults: Faults, count: u64) -> (Vec<(Micros, Vec<u8>)>, Sent) {
    let profile = *decoder(parameters).profile();
    let mut encoder = Emulator::new(profile, Shaft::still(5.5)).unwrap();
    encoder.faults = faults;
    let mut out = Vec::new();
    for asked in 0..count {
        encoder.handle_input(asked * SECOND, &[0x1a]);
        while let Some(due) = encoder.deadline() {
            out.push((due - asked * SECOND, encoder.poll_output(due).unwrap()));
        }
    }
    (out, *encoder.sent())
}

#[test]
fn what_arrives_whole_is_counted_so() {
    let whole = |faults| replies("format=t485", faults, 10).1;
    let none = Faults::default();
    let sent = |whole, damaged| Sent {
        whole,
        damaged,
        passing: 0,
    };
    assert_eq!(whole(none), sent(10, 0));
    assert_eq!(whole(Faults { echo: true, ..none }), sent(10, 0));
    assert_eq!(whole(Faults { late: 1000, ..none }), sent(10, 0));
    let twice = Faults {
        twice: 1000,
        ..none
    };
    assert_eq!(whole(twice), sent(20, 0));
    assert_eq!(whole(Faults { lose: 1000, ..none }), sent(0, 10));
    assert_eq!(whole(Faults { drop: 1000, ..none }), sent(0, 10));
    let double = Faults {
        double: 1000,
        ..none
    };
    assert_eq!(whole(double), sent(0, 10));
}

#[test]
fn damaged_replies_that_pass_are_those_whose_checks_hold() {
    let noise = Faults {
        flip: 200,
        ..Faults::default()
    };
    let decoder = decoder("format=t485");
    let (lines, sent) = replies("format=t485", noise, 5_000);
    let (good, _) = replies("format=t485", Faults::default(), 1);
    let whole = lines.iter().filter(|(_, line)| *line == good[0].1).count() as u64;
    let holds = |line: &[u8]| decoder.frame(line).is_some_and(|frame| frame.ok());
    let passing = lines.iter().filter(|(_, line)| holds(line)).count() as u64 - whole;
    let expected = Sent {
        whole,
        damaged: 5_000 - whole,
        passing,
    };
    assert_eq!(sent, expected);
    // Two flips of the same place in two bytes leave an XOR as it was: one pair in eight.
    assert!((100..400).contains(&passing), "{passing}");
}

#[test]
fn doubled_bytes_stand_beside_each_other() {
    let faults = Faults {
        double: 1000,
        ..Faults::default()
    };
    let (lines, _) = replies("format=t485", faults, 1);
    let (good, _) = replies("format=t485", Faults::default(), 1);
    let twice: Vec<u8> = good[0].1.iter().flat_map(|byte| [*byte, *byte]).collect();
    assert_eq!(lines[0].1, twice);
}

#[test]
fn replies_are_held_back_as_long_as_said_and_their_echo_is_not() {
    let at = |faults| -> Vec<Micros> {
        let (lines, _) = replies("format=t485", faults, 20);
        lines.into_iter().map(|(at, _)| at).collect()
    };
    let none = Faults::default();
    let prompt = at(none)[0];
    let delay = Faults {
        delay: 50_000,
        ..none
    };
    assert_eq!(at(delay), [prompt + 50_000; 20]);
    let echoed = Faults {
        echo: true,
        ..delay
    };
    let times = at(echoed);
    assert_eq!(times.len(), 40);
    assert!(
        times
            .chunks(2)
            .all(|pair| pair[0] < 100 && pair[1] > 50_000)
    );
    let jitter = Faults {
        jitter: 100_000,
        ..delay
    };
    let times = at(jitter);
    let within = prompt + 50_000..=prompt + 150_000;
    assert!(times.iter().all(|at| within.contains(at)), "{times:?}");
    assert!(times.iter().max().unwrap() - times.iter().min().unwrap() > 50_000);
}

#[test]
fn zeros_come_with_the_power_before_anything_else() {
    for parameters in ["format=t485", "format=period"] {
        let profile = *decoder(parameters).profile();
        let mut encoder = Emulator::new(profile, Shaft::still(5.5)).unwrap();
        encoder.faults.zeros = 20;
        encoder.power_off(0);
        assert_eq!(encoder.poll_output(SECOND), None);
        encoder.power_on(SECOND, None);
        assert_eq!(encoder.poll_output(SECOND), Some(vec![0; 20]));
        assert_eq!(encoder.poll_output(SECOND + 10_000), None);
        encoder.handle_input(SECOND + 20_000, &[0x1a]);
        assert!(encoder.poll_output(SECOND + 30_000).is_some());
    }
}

/// What a session reads from `now` on, for three seconds.
fn read(session: &mut Session, encoder: &mut Emulator, mut now: Micros) -> Vec<Reading> {
    let end = now + 3 * SECOND;
    let mut readings = Vec::new();
    while now < end {
        session.handle_timeout(now);
        while let Some(bytes) = encoder.poll_output(now) {
            session.handle_input(now, &bytes);
        }
        while let Some(output) = session.poll_output() {
            match output {
                Output::Transmit(bytes) => encoder.handle_input(now, &bytes),
                Output::Frame {
                    bytes, sure: true, ..
                } => {
                    let layout = session.decoder().layout(&bytes);
                    let bits = Bits::of_bytes(&bytes);
                    readings.extend(layout.and_then(|layout| layout.reading(bits).ok().flatten()));
                }
                _ => {}
            }
        }
        let next = encoder.deadline().unwrap_or(Micros::MAX);
        now = next.min(session.deadline()).max(now + 1);
    }
    readings
}

#[test]
fn zeros_at_power_on_are_no_reading_and_those_behind_them_are_found() {
    for parameters in [
        "format=t485",
        "format=rs485",
        "format=bus",
        "format=period",
        "format=asi1",
        "format=asi4",
    ] {
        for zeros in (0..16).chain([60, 63, 64]) {
            let decoder = decoder(parameters);
            let mut encoder = Emulator::new(*decoder.profile(), Shaft::still(5.5)).unwrap();
            let mut session = Session::new(decoder, 20_000).unwrap();
            encoder.interval = Some(5_000);
            let before = read(&mut session, &mut encoder, 0);
            encoder.faults.zeros = zeros;
            encoder.power_off(3 * SECOND);
            read(&mut session, &mut encoder, 3 * SECOND);
            encoder.power_on(6 * SECOND, None);
            let after = read(&mut session, &mut encoder, 6 * SECOND);
            let told = format!("{parameters} {zeros} zeros: {} readings", after.len());
            assert!(after.len() > 90, "{told}");
            // A packet of zeros is a good one of ASI1, which says that its position is not valid.
            let made_up = |one: &&Reading| one.angle != before[0].angle && !one.error;
            assert_eq!(after.iter().find(made_up), None, "{told}");
        }
    }
}
