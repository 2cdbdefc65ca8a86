#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::Bits,
    emulator::{Battery, Bus, Counter, Direction, Emulator, Faults, Shaft, ZeroInput},
    format::{Format, Link, t485},
    layout::Resolved,
    profile::Profile,
    reading::{Reading, Values},
    session::{Ask, Micros, Output, Session},
};
use encoderscope_tests::decoder;

const SECOND: Micros = 1_000_000;

fn encoder(parameters: &str, shaft: Shaft) -> Emulator {
    Emulator::new(*decoder(parameters).profile(), shaft).unwrap()
}

/// What a session with the encoders comes to until `until`.
fn converse(session: &mut Session, bus: &mut Bus, until: Micros) -> Vec<(Micros, Output)> {
    let mut out = Vec::new();
    let mut now = 0;
    while now < until {
        session.handle_timeout(now);
        while let Some(bytes) = bus.poll_output(now) {
            session.handle_input(now, &bytes);
        }
        while let Some(output) = session.poll_output() {
            if let Output::Transmit(bytes) = &output {
                bus.handle_input(now, bytes);
            }
            out.push((now, output));
        }
        let next = bus.deadline().unwrap_or(Micros::MAX);
        now = next.min(session.deadline()).max(now + 1);
    }
    out
}

/// A frame that the session is sure of, with the layout that reads it.
fn sure<'a>(session: &'a Session, output: &'a Output) -> Option<(&'a Resolved, Bits<'a>)> {
    match output {
        Output::Frame {
            bytes, sure: true, ..
        } => Some((session.decoder().layout(bytes)?, Bits::of_bytes(bytes))),
        _ => None,
    }
}

fn values_of(session: &Session, output: &Output) -> Option<Values> {
    let (layout, bits) = sure(session, output)?;
    layout.holds(bits).then(|| layout.values(bits))
}

fn readings(session: &Session, said: &[(Micros, Output)]) -> Vec<(Micros, Reading)> {
    let each = said.iter().filter_map(|(at, output)| {
        let (layout, bits) = sure(session, output)?;
        Some((*at, layout.reading(bits).ok().flatten()?))
    });
    each.collect()
}

#[test]
fn the_emulator_and_the_decoder_agree_on_every_format() {
    for format in Format::ALL {
        for shaft in [
            Shaft::still(5.25),
            Shaft::turning(300.9, 1.5),
            Shaft::turning(3.2, -2.0),
        ] {
            let profile = format.default_profile();
            let decoder = encoderscope::decode::Decoder::new(profile).unwrap();
            let mut emulator = Emulator::new(profile, shaft).unwrap();
            emulator.status = 0b00_0100;
            emulator.warning = true;
            // A reply is known when the line has been quiet, at first.
            let near = |at: Micros, reading: &Reading| {
                let turned = shaft.at(at).rem_euclid(1.0) - reading.degrees() / 360.0;
                let turned = turned.abs();
                assert!(
                    turned.min(1.0 - turned) < 0.05,
                    "{}: {reading:?} at {at}",
                    format.name()
                );
                assert_eq!(reading.turns.is_some(), profile.turns_bits > 0);
            };
            if format.spec().link == Link::Clocked {
                for index in 0..50 {
                    let at = index * 1_000;
                    let len = decoder.main_layout().len;
                    let word = emulator.clock(at, len);
                    let frame = decoder.line(word.as_bits()).unwrap();
                    near(at, &frame.reading().unwrap());
                    let tells = frame
                        .layout
                        .fields()
                        .any(|field| field.row.name == "status");
                    assert_eq!(frame.values().status.is_some(), tells);
                }
                continue;
            }
            let mut session = Session::new(decoder, 0).unwrap();
            let mut bus = Bus {
                devices: vec![emulator],
            };
            let said = converse(&mut session, &mut bus, SECOND);
            let readings = readings(&session, &said);
            assert!(
                readings.len() > 300,
                "{}: {}",
                format.name(),
                readings.len()
            );
            for (at, reading) in &readings {
                near(*at, reading);
            }
        }
    }
}

#[test]
fn streams_are_joined_anywhere_and_every_byte_is_accounted_for() {
    for parameters in ["format=period", "format=asi1", "format=asi4"] {
        for (turns, speed) in [(5.25, 0.0), (5.25, 0.7), (300.1, -3.0), (0.001, 0.1)] {
            for cut in 0..8 {
                let shaft = Shaft::turning(turns, speed);
                let mut emulator = encoder(parameters, shaft);
                let mut session = Session::new(decoder(parameters), 0).unwrap();
                let mut fed = 0;
                let mut first = true;
                let mut said = Vec::new();
                for now in (0..300_000).step_by(50) {
                    while let Some(bytes) = emulator.poll_output(now) {
                        let bytes = if first {
                            &bytes[cut.min(bytes.len())..]
                        } else {
                            &bytes
                        };
                        first = false;
                        fed += bytes.len();
                        session.handle_input(now, bytes);
                    }
                    while let Some(output) = session.poll_output() {
                        said.push((now, output));
                    }
                }
                let told: usize = said
                    .iter()
                    .map(|(_, output)| match output {
                        Output::Frame { bytes, .. } | Output::Skip { bytes, .. } => bytes.len(),
                        _ => 0,
                    })
                    .sum();
                assert!(
                    told <= fed && fed - told < 130,
                    "{parameters} {told} of {fed}"
                );
                let readings = readings(&session, &said);
                assert!(
                    readings.len() > 100,
                    "{parameters} {turns} {speed}: {}",
                    readings.len()
                );
                for (at, reading) in &readings {
                    let turned = shaft.at(*at).rem_euclid(1.0) - reading.degrees() / 360.0;
                    assert!(
                        turned.abs().min(1.0 - turned.abs()) < 0.05,
                        "{parameters} {turns} {speed} cut {cut}: {reading:?} at {at}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_silent_stream_is_said_to_be_silent() {
    let mut emulator = encoder("format=period", Shaft::still(1.5));
    emulator.faults.silent = true;
    let mut session = Session::new(decoder("format=period"), 0).unwrap();
    let mut bus = Bus {
        devices: vec![emulator],
    };
    let said = converse(&mut session, &mut bus, 2 * SECOND);
    let silent = said
        .iter()
        .filter(|(_, output)| *output == Output::Silent { echo: false });
    assert_eq!(silent.count(), 3);
    assert!(
        !said
            .iter()
            .any(|(_, output)| matches!(output, Output::Transmit(_)))
    );
}

#[test]
fn every_tamagawa_request_that_reads_is_answered() {
    let parameters = "format=t485 dialect=tamagawa";
    let decoder = decoder(parameters);
    for (echo, dialect) in [(false, "tamagawa"), (true, "tamagawa")] {
        let mut emulator = encoder(parameters, Shaft::still(5.25));
        emulator.faults.echo = echo;
        let mut session = Session::new(decoder.clone(), 1_000).unwrap();
        for request in t485::Request::ALL {
            let asked = Ask::t485(&decoder, *request, 0x21);
            match request.changes_encoder() {
                true => assert!(asked.is_err()),
                false => session.ask(asked.unwrap()).unwrap(),
            }
        }
        let mut bus = Bus {
            devices: vec![emulator],
        };
        let said = converse(&mut session, &mut bus, SECOND);
        let seen: Vec<Values> = said
            .iter()
            .filter_map(|(_, output)| values_of(&session, output))
            .collect();
        let [angle, turns, identity, all, memory, ..] = &seen[..] else {
            panic!("{dialect} echo {echo}: {said:?}");
        };
        assert_eq!((angle.angle, angle.turns), (Some(1 << 21), None));
        assert_eq!((turns.angle, turns.turns), (None, Some(5)));
        assert_eq!((identity.enid, identity.angle), (Some(0x17), None));
        assert_eq!(
            (all.angle, all.turns, all.enid),
            (Some(1 << 21), Some(5), Some(0x17))
        );
        assert_eq!(memory.memory, (Some(0x21), Some(0)));
        let skipped = said.iter().filter(|(_, output)| {
            matches!(output, Output::Skip { why, .. } if *why != encoderscope::framing::Why::Request)
        });
        assert_eq!(skipped.count(), 0, "echo {echo}: {said:?}");
    }
}

#[test]
fn mpp_answers_what_it_does_not_know_with_a_communication_error_and_the_angle() {
    let mut emulator = encoder("format=t485", Shaft::still(5.25));
    emulator.handle_input(0, &[0x92]);
    let reply = emulator.poll_output(1_000).unwrap();
    assert_eq!(reply[..5], [0x92, 0x40, 0x00, 0x00, 0x20]);
}

#[test]
fn several_devices_share_a_bus_and_sleep_while_another_talks() {
    let decoder = decoder("format=bus angle-bits=24");
    let addresses = [0x1f, 3, 9];
    let device = |address: &u8| {
        let profile = Profile {
            address: u32::from(*address),
            ..*decoder.profile()
        };
        Emulator::new(profile, Shaft::turning(f64::from(*address) + 0.5, 0.01)).unwrap()
    };
    let mut bus = Bus {
        devices: addresses.iter().map(device).collect(),
    };
    let mut session = Session::of_devices(decoder, &addresses, 0).unwrap();
    let said = converse(&mut session, &mut bus, SECOND);
    let mut seen = [0; 32];
    for (_, output) in &said {
        if let Some(values) = values_of(&session, output) {
            let address = values.address.unwrap();
            seen[usize::from(address)] += 1;
            // Each device has its own turns: none is taken for another.
            assert_eq!(values.turns, Some(i64::from(address)));
        }
        assert!(
            !matches!(output, Output::Silent { .. } | Output::Skip { .. }),
            "{output:?}"
        );
    }
    let most = seen.iter().max().unwrap();
    for address in addresses {
        assert!(seen[usize::from(address)] + 1 >= *most, "{seen:?}");
    }
    assert!(*most > 100);
    // Requests are at least the request byte and the sleep of the others apart.
    let times: Vec<Micros> = said
        .iter()
        .filter(|(_, output)| matches!(output, Output::Transmit(_)))
        .map(|(at, _)| *at)
        .collect();
    assert!(
        times.windows(2).all(|pair| pair[1] - pair[0] >= 40),
        "{times:?}"
    );
}

#[test]
fn a_device_that_hears_another_address_is_deaf_for_the_time_of_the_manual() {
    for (parameters, deaf) in [
        ("format=bus angle-bits=16 turns-bits=8", 28),
        ("format=bus angle-bits=16 turns-bits=16", 32),
        ("format=bus angle-bits=24 turns-bits=16", 36),
    ] {
        let answers = |after: Micros| {
            let mut emulator = encoder(parameters, Shaft::still(0.5));
            // Address 0.
            emulator.handle_input(0, &[0x80]);
            emulator.handle_input(after, &[0x1f]);
            emulator.poll_output(SECOND).is_some()
        };
        assert!(!answers(deaf - 1), "{parameters}");
        assert!(answers(deaf), "{parameters}");
    }
}

#[test]
fn bus_counts_follow_the_rules_of_the_manual() {
    let mut emulator = encoder("format=bus", Shaft::still(5.25));
    let mut now = 0;
    let mut ask = |byte: u8| {
        now += 1_000;
        emulator.handle_input(now, &[byte]);
        emulator.poll_output(now + 900).map(|reply| reply[2])
    };
    const GET: u8 = 0x1f;
    const SET_ZERO: u8 = 0xbf;
    // Note 1: the command before is not 00.
    assert_eq!(ask(SET_ZERO), Some(0));
    ask(GET);
    assert_eq!(ask(SET_ZERO), Some(1));
    ask(GET);
    assert_eq!(ask(SET_ZERO), Some(2));
    // Note 2: the command before that is not 01, so the count starts from here.
    ask(GET);
    ask(GET);
    assert_eq!(ask(SET_ZERO), Some(1));
    // Operation 11 gets no answer.
    assert_eq!(ask(0x7f), None);
    // Set address: X 2 4 are silent, then a wrong address counts 1 and starts anew.
    let set = |address: u8| {
        let byte = 0x40 | address;
        byte | (u8::from(byte.count_ones().is_multiple_of(2)) << 7)
    };
    assert_eq!(ask(set(21)), None);
    assert_eq!(ask(set(2)), None);
    assert_eq!(ask(set(4)), None);
    assert_eq!(ask(set(6)), Some(4));
    assert_eq!(ask(set(8)), Some(5));
    assert_eq!(ask(set(8)), Some(1));
    // The second and third of the new count are silent again, and another command breaks it.
    assert_eq!(ask(set(2)), None);
    assert_eq!(ask(GET), Some(0x00));
    assert_eq!(ask(set(2)), None);
}

#[test]
fn turns_are_kept_without_power_as_the_order_code_says() {
    let run = |counter, battery, while_off: f64| {
        let mut encoder = encoder("format=rs485", Shaft::still(7.4));
        encoder.counter = counter;
        encoder.battery = battery;
        encoder.power_off(0);
        encoder.handle_input(10, b"d");
        assert_eq!(encoder.poll_output(SECOND), None, "off");
        encoder.shaft = Shaft::still(7.4 + while_off);
        encoder.power_on(SECOND, None);
        encoder.handle_input(SECOND + 10, b"d");
        assert_eq!(encoder.poll_output(SECOND + 1_000), None, "starting up");
        let values = encoder.values(2 * SECOND);
        let degrees = values.angle.unwrap() as f64 / 2f64.powi(24) * 360.0;
        let expected = (7.4 + while_off).rem_euclid(1.0) * 360.0;
        assert!((degrees - expected).abs() < 0.01, "the angle is absolute");
        (
            values.turns.unwrap(),
            values.error.unwrap(),
            values.status.unwrap(),
        )
    };
    const LOST: u8 = 0b10_0000;
    const LOW: u8 = 0b01_0000;
    assert_eq!(run(Counter::Volatile, Battery::Good, 3.0), (0, false, 0));
    assert_eq!(run(Counter::Battery, Battery::Good, 3.0), (10, false, 0));
    assert_eq!(run(Counter::Battery, Battery::Low, 3.0), (10, false, LOW));
    assert_eq!(run(Counter::Battery, Battery::Absent, 3.0), (0, true, LOST));
    assert_eq!(
        run(Counter::Battery, Battery::Empty, 0.0),
        (0, true, LOST | LOW)
    );
    // Flash: up to a quarter turn to either side is followed, more is taken for less.
    assert_eq!(run(Counter::Flash, Battery::Good, 0.24).0, 7);
    assert_eq!(run(Counter::Flash, Battery::Good, -0.24).0, 7);
    assert_eq!(run(Counter::Flash, Battery::Good, 0.7).0, 7);
    assert_eq!(run(Counter::Flash, Battery::Good, -0.45).0, 6);
    assert_eq!(run(Counter::Flash, Battery::Good, 5.0).0, 7);
}

#[test]
fn a_lost_turn_counter_is_an_error_until_the_next_power_cycle() {
    let mut encoder = encoder("format=rs485", Shaft::still(7.4));
    encoder.counter = Counter::Battery;
    encoder.battery = Battery::Absent;
    encoder.power_off(0);
    encoder.power_on(SECOND, None);
    encoder.battery = Battery::Good;
    assert_eq!(encoder.values(2 * SECOND).error, Some(true));
    encoder.power_off(3 * SECOND);
    encoder.power_on(4 * SECOND, None);
    let values = encoder.values(5 * SECOND);
    assert_eq!((values.error, values.turns), (Some(false), Some(0)));
}

#[test]
fn the_zero_inputs_of_the_ip75_act_three_seconds_after_power_on() {
    let mut encoder = encoder("format=asi1", Shaft::still(0.3));
    let at = |encoder: &mut Emulator, now| {
        encoder.poll_output(now);
        let values = encoder.values(now);
        (values.angle.unwrap(), values.zero_default.unwrap())
    };
    let factory = (0.3 * 16_384.0) as u64;
    assert_eq!(at(&mut encoder, 0), (factory, true));
    encoder.power_off(SECOND);
    encoder.power_on(2 * SECOND, Some(ZeroInput::Set));
    assert_eq!(at(&mut encoder, 4 * SECOND), (factory, true));
    assert_eq!(at(&mut encoder, 5 * SECOND), (0, false));
    encoder.power_off(6 * SECOND);
    encoder.power_on(7 * SECOND, None);
    assert_eq!(at(&mut encoder, 11 * SECOND), (0, false));
    encoder.power_off(12 * SECOND);
    encoder.power_on(13 * SECOND, Some(ZeroInput::Reset));
    assert_eq!(at(&mut encoder, 17 * SECOND), (factory, true));
}

#[test]
fn preset_zeroes_the_present_direction_and_shifts_the_other() {
    let parameters = "format=ssi-tree";
    let mut encoder = encoder(parameters, Shaft::still(2.25));
    let decoder = decoder(parameters);
    let read = |encoder: &mut Emulator, now| {
        let word = encoder.clock(now, 25);
        let values = decoder.line(word.as_bits()).unwrap().values();
        (values.turns.unwrap(), values.angle.unwrap())
    };
    assert_eq!(read(&mut encoder, 0), (2, 0x2000 / 4));
    encoder.direction = Direction::Down;
    assert_eq!(read(&mut encoder, 1_000), (4096 - 3, 0x2000 / 4 * 3));
    encoder.direction = Direction::Up;
    encoder.preset(2_000);
    assert_eq!(read(&mut encoder, 3_000), (0, 0));
    // After a change of direction the code is not 0: −2.25 − 2.25 turns.
    encoder.direction = Direction::Down;
    assert_eq!(read(&mut encoder, 4_000), (4096 - 5, 0x2000 / 2));
    encoder.shaft = Shaft::still(2.5);
    assert_eq!(read(&mut encoder, 5_000), (4096 - 5, 0x2000 / 4));
}

#[test]
fn a_latched_word_is_clocked_out_again_until_the_time_out() {
    let mut encoder = encoder("format=ssi-tree turns-bits=0", Shaft::turning(0.0, 100.0));
    let first = encoder.clock(0, 13);
    assert_eq!(encoder.clock(20, 13), first);
    assert_ne!(encoder.clock(1_000, 13), first);
    // 14 clocks a word: the same word three times with a 0 between.
    let decoder = decoder("format=ssi-tree turns-bits=0");
    let ring = encoder.clock(2_000, 3 * 14 - 1);
    let frame = decoder.line(ring.as_bits()).unwrap();
    assert!(frame.ok(), "{:?}", frame.faults());
    assert_eq!(frame.layout.shape.repeats, 2);
}

#[test]
fn an_unplugged_encoder_neither_hears_nor_speaks() {
    for parameters in ["format=t485", "format=period"] {
        let mut encoder = encoder(parameters, Shaft::still(0.5));
        encoder.faults = Faults {
            unplugged: true,
            echo: true,
            ..Faults::default()
        };
        encoder.handle_input(0, &[0x1a]);
        assert_eq!(encoder.poll_output(SECOND), None);
        encoder.faults = Faults::default();
        encoder.handle_input(SECOND, &[0x1a]);
        assert!(encoder.poll_output(2 * SECOND).is_some());
    }
}

#[test]
fn a_session_without_polls_waits_to_be_asked_whatever_comes() {
    let decoder = decoder("format=bus");
    let mut session = Session::of_devices(decoder.clone(), &[], 0).unwrap();
    let mut bus = Bus {
        devices: vec![encoder("format=bus", Shaft::still(7.5))],
    };
    session.handle_timeout(0);
    session.handle_timeout(session.deadline());
    session.handle_timeout(session.deadline());
    assert_eq!(session.deadline(), Micros::MAX);
    session.handle_input(SECOND, &[0x55]);
    session.handle_timeout(session.deadline());
    assert_eq!(session.deadline(), Micros::MAX);
    session.ask(Ask::position(&decoder).unwrap()).unwrap();
    let other = encoderscope_tests::decoder("format=rs485 command=1");
    assert!(session.ask(Ask::position(&other).unwrap()).is_err());
    let said = converse(&mut session, &mut bus, 3 * SECOND);
    assert_eq!(readings(&session, &said).len(), 1);
    assert_eq!(readings(&session, &said)[0].1.turns, Some(7));
}
