mod pair;

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    emulator::{Emulator, Faults, Shaft},
    format::{rs485, t485},
    session::{Ask, Echo, Micros, Output, Refusal, Session},
};
use encoderscope_tests::decoder;
use pair::Pair;

const SECOND: Micros = 1_000_000;

#[test]
fn both_formats_are_read_while_the_shaft_turns() {
    for parameters in [
        "format=t485",
        "format=rs485 command=d",
        "format=rs485 command=s baud=115200",
        "format=rs485 turns-bits=0 angle-bits=16 command=1",
    ] {
        let shaft = Shaft::turning(3.75, 1.5);
        let mut pair = Pair::new(parameters, shaft);
        let log = pair.run(SECOND);
        assert!(
            log.readings.len() > 500,
            "{parameters}: {}",
            log.readings.len()
        );
        assert_eq!(
            (log.bad, log.skipped, log.silent),
            (0, 0, 0),
            "{parameters}"
        );
        for (at, reading) in &log.readings {
            let turned = reading.degrees() / 360.0;
            let apart = (shaft.at(*at).fract() - turned).abs();
            assert!(
                apart.min(1.0 - apart) < 0.04,
                "{parameters}: {reading:?} at {at}"
            );
        }
        let last = &log.readings.last().unwrap().1;
        assert_eq!(
            last.turns,
            (pair.session.decoder().profile().turns_bits > 0).then_some(5),
            "{parameters}"
        );
    }
}

#[test]
fn an_echoing_adapter_is_found_out_and_no_reading_is_wrong() {
    for parameters in [
        "format=t485",
        "format=rs485 command=1",
        "format=rs485 command=d",
    ] {
        let mut pair = Pair::new(parameters, Shaft::turning(0.0, 0.9));
        pair.emulator.faults.echo = true;
        let shaft = pair.emulator.shaft;
        let log = pair.run(SECOND);
        assert_eq!(pair.session.echo(), Echo::Present, "{parameters}");
        assert!(
            log.readings.len() > 500,
            "{parameters}: {}",
            log.readings.len()
        );
        assert_eq!(log.bad, 0, "{parameters}");
        assert!(log.readings.iter().all(|(at, reading)| {
            (shaft.at(*at).fract() - reading.degrees() / 360.0).abs() < 0.04
        }));
        assert_eq!(log.received, log.framed + log.skipped, "{parameters}");

        pair.emulator.faults.echo = false;
        let log = pair.run(3 * SECOND);
        assert_eq!(
            pair.session.echo(),
            Echo::Absent,
            "{parameters}: the adapter was changed"
        );
        assert!(log.readings.len() > 500);
    }
}

#[test]
fn replies_may_arrive_byte_by_byte() {
    let mut pair = Pair::new("format=t485", Shaft::turning(0.5, 1.0));
    pair.piece = 1;
    let log = pair.run(SECOND);
    assert!(log.readings.len() > 500);
    assert_eq!((log.bad, log.skipped), (0, 0));
}

#[test]
fn noise_is_counted_and_no_reading_is_wrong() {
    for parameters in ["format=t485", "format=rs485 command=d"] {
        let shaft = Shaft::turning(0.1, 0.7);
        let mut pair = Pair::new(parameters, shaft);
        pair.emulator.faults = Faults {
            flip: 10,
            drop: 10,
            insert: 10,
            ..Faults::default()
        };
        let log = pair.run(60 * SECOND);
        assert!(
            log.readings.len() > 300,
            "{parameters}: {}",
            log.readings.len()
        );
        assert!(
            log.bad > 10 && log.skipped > 10,
            "{parameters}: {} {}",
            log.bad,
            log.skipped
        );
        let open = log.received - log.framed - log.skipped;
        assert!(open < 16, "{parameters}: {open} bytes went astray");
        let wrong = log.readings.iter().filter(|(at, reading)| {
            let apart = (shaft.at(*at).fract() - reading.degrees() / 360.0).abs();
            apart.min(1.0 - apart) > 0.2
        });
        // An eight-bit check lets one broken frame in 256 pass.
        assert!(
            wrong.count() * 256 <= 2 * (log.bad + log.readings.len() / 50),
            "{parameters}"
        );
    }
}

#[test]
fn silence_is_said_and_reading_goes_on_when_the_encoder_is_back() {
    let mut pair = Pair::new("format=t485", Shaft::still(0.5));
    pair.emulator.faults.silent = true;
    let log = pair.run(4 * SECOND);
    assert!(log.silent > 5 && log.readings.is_empty());
    pair.emulator.faults.echo = true;
    let log = pair.run(8 * SECOND);
    assert!(log.silent > 3 && log.readings.is_empty());
    pair.emulator.faults = Faults::default();
    assert!(pair.run(11 * SECOND).readings.len() > 500);
}

#[test]
fn the_time_that_a_reply_is_waited_for_grows_with_losses_and_comes_back() {
    let mut pair = Pair::new("format=t485", Shaft::turning(0.0, 0.3));
    pair.emulator.faults = Faults {
        lose: 100,
        ..Faults::default()
    };
    let log = pair.run(60 * SECOND);
    assert!(log.silent > 60, "{log:?}");
    assert!(log.readings.len() > 60 * 10, "{}", log.readings.len());
    pair.emulator.faults.lose = 1_000;
    pair.run(70 * SECOND);
    pair.emulator.faults = Faults::default();
    pair.run(73 * SECOND);
    pair.emulator.faults.lose = 1_000;
    let silent = pair.run(74 * SECOND).silent;
    assert!(silent >= 3, "{silent}");
}

/// Runs a session up to the request it sends next.
fn ask(session: &mut Session) -> Micros {
    loop {
        let now = session.deadline();
        session.handle_timeout(now);
        if let Some(Output::Transmit(_)) = session.poll_output() {
            return now;
        }
    }
}

#[test]
fn what_is_asked_once_is_asked_again_until_the_reply_is_certain() {
    let mut pair = Pair::new("format=t485 dialect=tamagawa", Shaft::still(0.5));
    pair.run(SECOND);
    let ask = Ask::t485(pair.session.decoder(), t485::Request::MemoryRead, 5).unwrap();
    let asked = |pair: &mut Pair, until: Micros| {
        let before = pair.asked.len();
        pair.run(until);
        let since = &pair.asked[before..];
        since
            .iter()
            .filter(|bytes| bytes[0] == ask.bytes()[0])
            .count()
    };
    pair.session.ask(ask.clone()).unwrap();
    assert_eq!(asked(&mut pair, 2 * SECOND), 1);
    // The first reply is missing, and the second may be it.
    pair.emulator.faults.silent = true;
    pair.session.ask(ask.clone()).unwrap();
    let until = pair.now + 100_000;
    let lost = asked(&mut pair, until);
    pair.emulator.faults.silent = false;
    assert_eq!((lost, lost + asked(&mut pair, 6 * SECOND)), (1, 3));
    pair.emulator.faults.silent = true;
    pair.session.ask(ask.clone()).unwrap();
    assert_eq!(asked(&mut pair, 20 * SECOND), 3);
}

#[test]
fn a_late_reply_is_not_taken_for_the_next_one() {
    let decoder = decoder("format=t485");
    let mut emulator = Emulator::new(*decoder.profile(), Shaft::turning(0.0, 0.3)).unwrap();
    let mut session = Session::new(decoder, 0).unwrap();
    // Every reply takes 150 ms, longer than the first time-out.
    let delay = 150_000;
    let mut on_the_way = std::collections::VecDeque::new();
    let mut now = 0;
    let mut sure = 0;
    while now < 20 * SECOND {
        session.handle_timeout(now);
        while let Some((at, bytes)) = on_the_way.front().cloned() {
            if at > now {
                break;
            }
            let _: Option<(Micros, Vec<u8>)> = on_the_way.pop_front();
            session.handle_input(now, &bytes);
        }
        while let Some(output) = session.poll_output() {
            match output {
                Output::Transmit(bytes) => {
                    emulator.handle_input(now, &bytes);
                    on_the_way.push_back((now + delay, emulator.poll_output(Micros::MAX).unwrap()));
                }
                Output::Frame {
                    sure: true,
                    latency,
                    ..
                } => {
                    assert!(
                        latency.is_some_and(|latency| latency >= delay),
                        "{latency:?}"
                    );
                    sure += 1;
                }
                _ => {}
            }
        }
        now += 500;
    }
    assert!(sure > 50, "{sure}");
}

/// A free-running encoder is heard before anything is asked, and none of it is a reply.
#[test]
fn what_talks_unasked_is_not_read() {
    let decoder = decoder("format=rs485 command=d");
    let mut emulator = Emulator::new(*decoder.profile(), Shaft::turning(0.0, 0.3)).unwrap();
    for phase in 0..7 {
        let mut session = Session::new(decoder.clone(), 0).unwrap();
        let mut bytes = Vec::new();
        for millisecond in 0..2000 {
            let now = millisecond * 1000;
            emulator.handle_input(now, b"d");
            bytes.extend(emulator.poll_output(Micros::MAX).unwrap());
            if bytes.len() < 7 + phase {
                continue;
            }
            session.handle_timeout(now);
            let rest = bytes.split_off(7);
            session.handle_input(now, &bytes);
            bytes = rest;
            while let Some(output) = session.poll_output() {
                assert!(
                    !matches!(output, Output::Frame { sure: true, .. }),
                    "{phase} {now}"
                );
            }
        }
    }
}

#[test]
fn a_reply_with_something_behind_it_is_not_sure() {
    let decoder = decoder("format=t485");
    let mut emulator = Emulator::new(*decoder.profile(), Shaft::still(0.5)).unwrap();
    let mut session = Session::new(decoder, 0).unwrap();
    for _ in 0..5 {
        let now = ask(&mut session);
        emulator.handle_input(now, &[0x1a]);
        let mut reply = emulator.poll_output(Micros::MAX).unwrap();
        reply.push(0x55);
        session.handle_input(now + 50, &reply);
        session.handle_timeout(session.deadline());
        assert!(matches!(
            session.poll_output(),
            Some(Output::Frame { sure: false, .. })
        ));
        assert!(matches!(session.poll_output(), Some(Output::Skip { .. })));
    }
}

#[test]
fn polling_never_sends_what_changes_the_encoder() {
    let refused = Session::new(decoder("format=rs485 command=0"), 0).unwrap_err();
    assert_eq!(refused, Refusal::ChangesEncoder(0x30));
    assert!(Session::new(decoder("format=biss-c"), 0).is_err());
    for parameters in ["format=t485", "format=rs485 command=d"] {
        let mut session = Session::new(decoder(parameters), 0).unwrap();
        for _ in 0..1000 {
            session.handle_timeout(session.deadline());
            session.handle_input(session.deadline() - 1, &[0x30, 0xc2, 0x62, 0xba, 0x1a]);
            while let Some(output) = session.poll_output() {
                if let Output::Transmit(bytes) = output {
                    assert!(matches!(bytes[..], [0x1a | 0x64]));
                }
            }
        }
    }
}

#[test]
fn the_emulated_t485_encoder_answers_as_the_manual_says() {
    let decoder = decoder("format=t485");
    let mut encoder = Emulator::new(*decoder.profile(), Shaft::still(7.25)).unwrap();
    let mut ask = |byte: u8| {
        encoder.handle_input(0, &[byte]);
        encoder.poll_output(SECOND).unwrap()
    };
    assert_eq!(ask(0x02), [0x02, 0x00, 0x00, 0x00, 0x20, 0x22]);
    assert_eq!(ask(0x8a), [0x8a, 0x00, 0x07, 0x00, 0x00, 0x8d]);
    assert_eq!(ask(0x1a)[2..9], [0x00, 0x00, 0x20, 0x17, 0x07, 0x00, 0x00]);
    let unknown = ask(0x55);
    assert_eq!(
        unknown[..2],
        [0x55, 0x40],
        "an unknown operation is a communication error"
    );
    assert_eq!(unknown.iter().fold(0, |sum, byte| sum ^ byte), 0);
    for _ in 0..9 {
        ask(t485::Request::ResetAngle.byte());
    }
    assert_eq!(ask(0x02)[4], 0x20, "nine resets do nothing");
    for _ in 0..10 {
        ask(t485::Request::ResetAngle.byte());
    }
    assert_eq!(ask(0x02)[2..5], [0, 0, 0]);
    assert_eq!(ask(0x8a)[2], 7, "the turns stay");
}

#[test]
fn the_emulated_rs485_encoder_sets_its_zero_after_ten_pairs() {
    let decoder = decoder("format=rs485 command=1");
    let mut encoder = Emulator::new(*decoder.profile(), Shaft::still(7.25)).unwrap();
    let mut counts = Vec::new();
    for now in 0..10 {
        encoder.handle_input(now, &[rs485::Command::Position.byte()]);
        assert!(encoder.poll_output(SECOND).is_some());
        encoder.handle_input(now, &[rs485::Command::Zero.byte()]);
        counts.push(encoder.poll_output(SECOND).unwrap()[0]);
    }
    assert_eq!(counts, [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    encoder.handle_input(20_000, &[0x31]);
    assert_eq!(
        encoder.poll_output(SECOND),
        None,
        "it is silent while it stores the zero"
    );
    encoder.handle_input(60_000, &[0x31]);
    assert_eq!(encoder.poll_output(SECOND).unwrap()[..5], [0, 0, 0, 0, 0]);
}

#[test]
fn every_byte_is_accounted_for_when_the_line_ends() {
    for (parameters, most) in [
        ("format=t485", 40_000),
        ("format=rs485 command=d", 40_000),
        ("format=period", 20_000),
        ("format=asi1", 20_000),
        ("format=asi4", 20_000),
    ] {
        // Ends at every moment of a reply, of an echo and of a frame.
        for until in (most - 1_000..most).step_by(97) {
            let mut pair = Pair::new(parameters, Shaft::turning(0.3, 2.0));
            pair.piece = 1;
            pair.emulator.faults.flip = 20;
            let mut log = pair.run(until);
            let half = pair.emulator.poll_output(pair.now + 900);
            let half = half.unwrap_or_default();
            let half = &half[..half.len() / 2];
            log.received += half.len();
            pair.session.handle_input(pair.now, half);
            pair.session.rest();
            log.count(&mut pair.session);
            let told = log.framed + log.skipped;
            assert_eq!(told, log.received, "{parameters} until {until}");
        }
    }
}

#[test]
fn a_device_that_is_away_spoils_nothing_of_the_others() {
    use encoderscope::emulator::Bus;
    let made = |address: u32| {
        let decoder = decoder(&format!("format=bus address={address}"));
        Emulator::new(*decoder.profile(), Shaft::still(f64::from(address) + 0.5)).unwrap()
    };
    let mut line = Bus {
        devices: [3, 7].map(made).into(),
    };
    let mut session = Session::of_devices(decoder("format=bus"), &[3, 5, 7], 0).unwrap();
    let mut now: Micros = 0;
    let (mut good, mut bad, mut silent) = (0, 0, 0);
    while now < 5_000_000 {
        session.handle_timeout(now);
        while let Some(bytes) = line.poll_output(now) {
            session.handle_input(now, &bytes);
        }
        while let Some(output) = session.poll_output() {
            match output {
                Output::Transmit(bytes) => line.handle_input(now, &bytes),
                Output::Frame { sure: true, .. } => good += 1,
                Output::Frame { .. } | Output::Skip { .. } => bad += 1,
                Output::Silent { .. } => silent += 1,
            }
        }
        let due = line.deadline().unwrap_or(Micros::MAX);
        now = due.min(session.deadline()).max(now + 1);
    }
    assert_eq!(bad, 0);
    assert!(
        silent > 30 && good + 2 >= 2 * silent,
        "{good} good, {silent} silent"
    );
}

#[test]
fn lines_of_digits_are_not_glued_over_a_rest() {
    let mut session = Session::new(decoder("format=asi4"), 0).unwrap();
    let mut said = Vec::new();
    session.handle_input(0, b"1629\r\n1630\r\n16");
    session.rest();
    session.handle_timeout(1_000_000);
    session.handle_input(1_000_000, b"50\r\n2051\r\n2052\r\n");
    session.handle_input(1_002_000, &b"2052\r\n".repeat(20));
    while let Some(output) = session.poll_output() {
        match output {
            Output::Frame {
                bytes, sure: true, ..
            } => said.push(bytes),
            Output::Skip { .. } | Output::Frame { .. } => {}
            other => panic!("{other:?}"),
        }
    }
    assert!(
        said.contains(&b"2052\r\n".to_vec()) && said.contains(&b"1630\r\n".to_vec()),
        "{said:?}"
    );
    for line in [&b"1650\r\n"[..], b"50\r\n"] {
        assert!(!said.contains(&line.to_vec()), "{said:?}");
    }
}
