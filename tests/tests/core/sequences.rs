#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    decode::Decoder,
    emulator::{Bus, Emulator, Faults, Shaft},
    format::{Format, bus, t485},
    sequence::{Change, Event, Holds, Runner, Stop},
    session::Micros,
};
use encoderscope_tests::decoder;

/// How a sequence ended, and what was sent on the way.
#[derive(Debug)]
struct Run {
    stop: Option<Stop>,
    holds: Holds,
    sent: Vec<Vec<u8>>,
    counts: Vec<u8>,
    took: Micros,
}

/// Runs a sequence against encoders on one wire; `meddle` may do something before each command.
fn run_with(
    decoder: &Decoder,
    change: Change,
    bus: &mut Bus,
    mut meddle: impl FnMut(usize, Micros, &mut Bus),
) -> Run {
    let mut runner = Runner::new(decoder, change, 0).unwrap();
    let mut run = Run {
        stop: None,
        holds: Holds::Unknown,
        sent: Vec::new(),
        counts: Vec::new(),
        took: 0,
    };
    let mut now = 0;
    loop {
        runner.handle_timeout(now);
        while let Some(bytes) = bus.poll_output(now) {
            runner.handle_input(now, &bytes);
        }
        while let Some(event) = runner.poll_output() {
            match event {
                Event::Transmit(bytes) => {
                    meddle(run.sent.len(), now, bus);
                    bus.handle_input(now, &bytes);
                    run.sent.push(bytes);
                }
                Event::Progress {
                    done, total, count, ..
                } => {
                    assert!(done <= total);
                    assert_eq!(total, runner.total());
                    run.counts.extend(count);
                }
                Event::Ended { stop, holds, .. } => {
                    // Nothing more is sent, whatever comes.
                    runner.handle_input(now, &[0x0a, 0xe4]);
                    runner.handle_timeout(Micros::MAX);
                    assert_eq!(runner.poll_output(), None);
                    run.took = now;
                    return Run { stop, holds, ..run };
                }
            }
        }
        let next = bus.deadline().unwrap_or(Micros::MAX);
        now = next.min(runner.deadline()).max(now + 1);
        assert!(now < 60_000_000, "a sequence must end");
    }
}

fn one(parameters: &str, shaft: Shaft) -> (Decoder, Bus) {
    let decoder = decoder(parameters);
    let encoder = Emulator::new(*decoder.profile(), shaft).unwrap();
    let devices = vec![encoder];
    (decoder, Bus { devices })
}

fn run(decoder: &Decoder, change: Change, bus: &mut Bus) -> Run {
    run_with(decoder, change, bus, |_, _, _| {})
}

/// Every sequence there is, with the profile it needs.
const ALL: &[(&str, Change)] = &[
    ("format=rs485", Change::Zero),
    ("format=rs485 command=1 turns-bits=0", Change::Zero),
    ("format=t485", Change::ResetAngle),
    ("format=t485", Change::ResetTurns),
    ("format=t485 dialect=tamagawa", Change::ResetErrors),
    (
        "format=t485 dialect=tamagawa",
        Change::Memory {
            address: 0x10,
            data: 0x5a,
        },
    ),
    ("format=bus", Change::Zero),
    ("format=bus parity=even address=3", Change::Zero),
    ("format=bus", Change::Address(7)),
];

/// Whether the encoder holds what the sequence was to make it hold.
fn is_changed(change: Change, encoder: &Emulator) -> bool {
    let values = encoder.values(0);
    match change {
        Change::Zero => values.angle == Some(0) && values.turns == Some(0),
        Change::ResetAngle => values.angle == Some(0) && values.turns == Some(5),
        Change::ResetTurns => values.angle != Some(0) && values.turns == Some(0),
        Change::ResetErrors => !encoder.error,
        Change::Memory { address, data } => encoder.memory(address) == Some(data),
        Change::Address(address) => encoder.address() == address,
    }
}

fn fresh(parameters: &str) -> (Decoder, Bus) {
    let (decoder, mut bus) = one(parameters, Shaft::still(5.25));
    bus.devices[0].error = true;
    (decoder, bus)
}

#[test]
fn every_sequence_makes_its_change() {
    for (parameters, change) in ALL {
        for echo in [false, true] {
            let (decoder, mut bus) = fresh(parameters);
            bus.devices[0].faults.echo = echo;
            assert!(!is_changed(*change, &bus.devices[0]), "{parameters}");
            let run = run(&decoder, *change, &mut bus);
            assert_eq!(
                (run.stop, run.holds),
                (None, Holds::New),
                "{parameters} {change:?} echo {echo}: {run:?}"
            );
            assert!(
                is_changed(*change, &bus.devices[0]),
                "{parameters} {change:?}"
            );
        }
    }
}

#[test]
fn the_commands_are_those_of_the_manuals() {
    let sent = |parameters: &str, change| {
        let (decoder, mut bus) = fresh(parameters);
        run(&decoder, change, &mut bus).sent.concat()
    };
    let zero = sent("format=rs485", Change::Zero);
    assert_eq!(zero[1..21], b"10".repeat(10)[..]);
    let angle = sent("format=t485", Change::ResetAngle);
    assert_eq!(angle[1..11], [0xc2; 10]);
    let turns = sent("format=t485", Change::ResetTurns);
    assert_eq!(turns[1..11], [0x62; 10]);
    let errors = sent("format=t485 dialect=tamagawa", Change::ResetErrors);
    assert_eq!(errors[1..11], [0xba; 10]);
    let bus = sent("format=bus", Change::Zero);
    assert_eq!(bus[1..21], [0x1f, 0xbf].repeat(10)[..]);
    // Operation 10 with addresses 0 2 4 … 16 and 7, each with odd parity.
    let address = sent("format=bus", Change::Address(7));
    let expected = [0x40, 0xc2, 0xc4, 0x46, 0xc8, 0x4a, 0x4c, 0xce, 0xd0, 0xc7];
    let address = &address[1..11];
    let fields: Vec<_> = address.iter().map(|byte| byte & 0x7f).collect();
    let wanted: Vec<_> = expected.iter().map(|byte: &u8| byte & 0x7f).collect();
    assert_eq!(fields, wanted);
    assert!(address.iter().all(|byte| byte.count_ones() % 2 == 1));
}

#[test]
fn counts_are_those_of_the_manuals() {
    let counts = |parameters: &str, change| {
        let (decoder, mut bus) = fresh(parameters);
        run(&decoder, change, &mut bus).counts
    };
    let to_ten: Vec<u8> = (1..=10).collect();
    assert_eq!(counts("format=rs485", Change::Zero), to_ten);
    assert_eq!(counts("format=bus", Change::Zero), to_ten);
    assert_eq!(
        counts("format=bus", Change::Address(9)),
        [4, 5, 6, 7, 8, 9, 10]
    );
}

#[test]
fn a_foreign_command_in_between_stops_it_and_nothing_changes() {
    for (parameters, change) in ALL {
        let (decoder, _) = fresh(parameters);
        let commands = Runner::new(&decoder, *change, 0).unwrap().total() - 2;
        for at in 1..=commands {
            let (decoder, mut bus) = fresh(parameters);
            let foreign = match decoder.profile().format {
                Format::Rs485 => b't',
                Format::Bus => bus::request(decoder.profile(), bus::Operation::Get, 0),
                _ => 0x1a,
            };
            // The host does not see what another host sends, only what comes of it.
            let run = run_with(&decoder, *change, &mut bus, |index, now, bus| {
                if index == at {
                    let device = &mut bus.devices[0];
                    device.handle_input(now.saturating_sub(100), &[foreign]);
                    while device.poll_output(now).is_some() {}
                }
            });
            let changed = is_changed(*change, &bus.devices[0]);
            let name = format!("{parameters} {change:?} foreign before {at}: {run:?}");
            match run.holds {
                Holds::New => assert!(changed, "{name}"),
                Holds::Old => assert!(!changed, "{name}"),
                Holds::Unknown => assert_eq!(decoder.profile().format, Format::T485, "{name}"),
            }
            // Encoders that count tell; a reset of T485 is seen in what is read afterwards.
            let counts = decoder.profile().format != Format::T485;
            let first_pair = at <= 2 || matches!(change, Change::Address(_)) && at <= 4;
            if counts && !first_pair {
                assert!(run.stop.is_some(), "{name}");
            }
        }
    }
}

/// What a reply can suffer on its way.
fn sufferings() -> [(&'static str, Faults); 4] {
    let none = Faults::default();
    [
        ("lost", Faults { lose: 1000, ..none }),
        ("late", Faults { late: 1000, ..none }),
        (
            "doubled",
            Faults {
                twice: 1000,
                ..none
            },
        ),
        ("broken", Faults { flip: 400, ..none }),
    ]
}

#[test]
fn a_lost_late_doubled_or_broken_reply_stops_it_and_it_says_what_the_encoder_holds() {
    for (parameters, change) in ALL {
        let (decoder, _) = fresh(parameters);
        let commands = Runner::new(&decoder, *change, 0).unwrap().total() - 2;
        for (name, faults) in sufferings() {
            for at in 0..=commands + 1 {
                let (decoder, mut bus) = fresh(parameters);
                let run = run_with(&decoder, *change, &mut bus, |index, _, bus| {
                    bus.devices[0].faults = match index == at {
                        true => faults,
                        false => Faults::default(),
                    };
                });
                let silent = matches!(change, Change::Address(_)) && (1..=3).contains(&at);
                let changed = is_changed(*change, &bus.devices[0]);
                let told = format!("{parameters} {change:?} {name} at {at}: {run:?}");
                if silent || run.stop.is_none() {
                    // Nothing was there to be lost, or chance left it whole.
                    assert!(silent || name == "broken", "{told}");
                    continue;
                }
                match run.holds {
                    Holds::New => assert!(changed && at > commands, "{told}"),
                    Holds::Old => assert!(!changed && at < commands, "{told}"),
                    Holds::Unknown => assert!(at >= commands && changed, "{told}"),
                }
                assert_eq!(run.sent.len(), at + 1, "{told}");
            }
        }
    }
}

#[test]
fn a_bit_error_on_any_reply_never_passes_for_success_of_the_wrong_kind() {
    for (parameters, change) in ALL {
        for seed in 0..60 {
            let (decoder, mut bus) = fresh(parameters);
            bus.devices[0].faults.flip = 3;
            bus.devices[0].faults.drop = 2;
            bus.devices[0].faults.insert = 2;
            // Moves the noise on.
            for _ in 0..seed {
                bus.devices[0].handle_input(0, &[0x1f]);
                while bus.poll_output(1_000_000).is_some() {}
            }
            let run = run(&decoder, *change, &mut bus);
            let changed = is_changed(*change, &bus.devices[0]);
            match run.holds {
                Holds::New => assert!(changed, "{parameters} {change:?}: {run:?}"),
                Holds::Old => assert!(!changed, "{parameters} {change:?}: {run:?}"),
                Holds::Unknown => {}
            }
        }
    }
}

#[test]
fn an_unplugged_adapter_stops_it() {
    for (parameters, change) in ALL {
        let (decoder, mut bus) = fresh(parameters);
        let run = run_with(&decoder, *change, &mut bus, |index, _, bus| {
            bus.devices[0].faults.unplugged = index > 0;
        });
        // The silent steps of an address sequence do not show it at once.
        let steps = if matches!(change, Change::Address(_)) {
            5
        } else {
            2
        };
        assert_eq!(run.sent.len(), steps, "{parameters} {change:?}: {run:?}");
        assert_eq!(run.stop, Some(Stop::NoReply), "{parameters} {change:?}");
        assert!(!is_changed(*change, &bus.devices[0]));
    }
}

#[test]
fn what_an_earlier_sequence_has_left_does_not_count() {
    for (parameters, change) in ALL {
        let (decoder, mut bus) = fresh(parameters);
        let commands = Runner::new(&decoder, *change, 0).unwrap().total() - 2;
        if commands < 2 {
            continue;
        }
        // Stopped one command short.
        let mut runner = Runner::new(&decoder, *change, 0).unwrap();
        let mut now = 0;
        let mut sent = 0;
        while sent < commands {
            runner.handle_timeout(now);
            while let Some(bytes) = bus.poll_output(now) {
                runner.handle_input(now, &bytes);
            }
            while let Some(event) = runner.poll_output() {
                if let Event::Transmit(bytes) = event {
                    bus.handle_input(now, &bytes);
                    sent += 1;
                }
            }
            now += 100;
        }
        runner.stop();
        let ended = core::iter::from_fn(|| runner.poll_output()).last();
        assert!(
            matches!(
                ended,
                Some(Event::Ended {
                    stop: Some(Stop::Asked),
                    holds: Holds::Old,
                    ..
                })
            ),
            "{ended:?}"
        );
        while bus.poll_output(Micros::MAX / 2).is_some() {}
        // The next one stops before its last command: without what the first one has left, the
        // encoder has not acted.
        let mut second = fresh(parameters).1;
        core::mem::swap(&mut second, &mut bus);
        let run = run_with(&decoder, *change, &mut second, |index, _, bus| {
            bus.devices[0].faults.silent = index >= commands;
        });
        assert!(run.stop.is_some());
        assert!(
            !is_changed(*change, &second.devices[0]),
            "{parameters} {change:?}: {run:?}"
        );
    }
}

#[test]
fn an_encoder_that_stores_is_silent_and_the_sequence_waits() {
    for (parameters, change, least) in [
        ("format=rs485", Change::Zero, 40_000),
        ("format=bus", Change::Zero, 50_000),
        ("format=bus", Change::Address(1), 50_000),
    ] {
        let (decoder, mut bus) = fresh(parameters);
        let mut times = Vec::new();
        let run = run_with(&decoder, change, &mut bus, |_, now, _| times.push(now));
        assert_eq!(run.stop, None);
        let [.., acted, read] = times[..] else {
            panic!("{times:?}");
        };
        assert!(read - acted >= least, "{parameters}: {}", read - acted);
    }
}

#[test]
fn a_format_has_only_its_own_sequences_and_values_must_fit() {
    let runner = |parameters: &str, change| Runner::new(&decoder(parameters), change, 0);
    assert!(runner("format=t485", Change::Zero).is_none());
    assert!(runner("format=rs485", Change::Address(1)).is_none());
    assert!(runner("format=period", Change::Zero).is_none());
    assert!(runner("format=biss-c", Change::ResetAngle).is_none());
    assert!(runner("format=bus", Change::Address(32)).is_none());
    let cell = Change::Memory {
        address: 128,
        data: 0,
    };
    assert!(runner("format=t485", cell).is_none());
}

#[test]
fn setting_an_address_is_heard_by_every_device() {
    let decoder = decoder("format=bus");
    let device = |address: u32| {
        let mut profile = *decoder.profile();
        profile.address = address;
        Emulator::new(profile, Shaft::still(f64::from(address) / 64.0)).unwrap()
    };
    let mut bus = Bus {
        devices: vec![device(31), device(4)],
    };
    let run = run(&decoder, Change::Address(12), &mut bus);
    // Both count alike and answer alike; when both are asked as 12, they spoil each other's
    // reply. This is why only one device may be on the wire.
    assert_eq!(run.stop, Some(Stop::BadReply), "{run:?}");
    assert_eq!(run.holds, Holds::New);
    assert_eq!(bus.devices[0].address(), 12);
    assert_eq!(bus.devices[1].address(), 12);
}

#[test]
fn a_command_that_the_encoder_does_not_know_stops_it() {
    let (decoder, _) = fresh("format=t485 dialect=tamagawa");
    let (_, mut mpp) = fresh("format=t485");
    let run = run(&decoder, Change::ResetErrors, &mut mpp);
    assert_eq!(
        (run.stop, run.holds),
        (Some(Stop::NotUnderstood), Holds::Old)
    );
    assert_eq!(run.sent.len(), 2, "{run:?}");
    assert!(mpp.devices[0].error);
    let own = Runner::new(&fresh("format=t485").0, Change::ResetErrors, 0);
    assert!(own.is_none());
    assert!(!t485::Request::ResetErrors.is_known_to(mpp.devices[0].profile().dialect));
}

#[test]
fn every_byte_that_changes_an_encoder_is_called_dangerous() {
    use encoderscope::{
        bits::Bits,
        format::{bus, rs485, t485},
        layout::{Resolved, Shape},
        sequence::danger,
    };
    for format in Format::ALL {
        let profile = format.default_profile();
        for byte in 0..=255u8 {
            let rs485 = rs485::Command::of_byte(byte).is_some_and(rs485::Command::changes_encoder);
            let t485 = t485::Request::of_byte(byte).is_some_and(t485::Request::changes_encoder);
            let head = Resolved::new(&bus::HEAD, Shape::of(Format::Bus.default_profile()));
            let operation = head.values(Bits::of_bytes(&[byte])).operation;
            let bus = operation
                .and_then(bus::Operation::of_code)
                .is_some_and(bus::Operation::changes_encoder);
            let expected = rs485 || t485 || bus && *format == Format::Bus;
            assert_eq!(
                danger(&profile, &[byte]).is_some(),
                expected,
                "{format:?} {byte:02x}"
            );
            assert_eq!(danger(&profile, &[0x1a, byte]).is_some(), expected);
            assert_eq!(
                danger(&profile, &[byte; 3]).is_some(),
                expected || bus,
                "{byte:02x}"
            );
        }
        assert_eq!(danger(&profile, &[]), None);
    }
    let zero: Vec<u8> = [0x1f, 0xbf].repeat(10);
    assert!(danger(&Format::T485.default_profile(), &zero).is_some());
}
