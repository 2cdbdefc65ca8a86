#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    adapter::{CHIPS, Made},
    bits,
    detect::Verdict,
    emulator::{Bus, Emulator, Faults, Shaft},
    finder::{Finder, Found, Output, requests},
    format::{Format, Link, bus, rs485, t485},
    layout::{Resolved, Shape},
    profile::Profile,
    session::Micros,
};
use encoderscope_tests::decoder;

/// What was sent, at which baud rate.
type Sent = Vec<(u32, Vec<u8>)>;

/// Lets a finder search a line; the adapter does what it is told.
fn run(finder: &mut Finder, line: &mut Bus, start: Micros) -> (Sent, Micros) {
    let mut now = start;
    let mut sent = Sent::new();
    let mut baud = line.devices.first().map_or(0, |first| first.profile().baud);
    loop {
        while let Some(output) = finder.poll_output() {
            match output {
                Output::Open(rate) => {
                    baud = rate;
                    for device in &mut line.devices {
                        device.faults.rate = Some(rate);
                        device.drop_unread(now + 50_000);
                    }
                    now += 50_000;
                    finder.handle_opened(now);
                }
                Output::Transmit(bytes) => {
                    line.handle_input(now, &bytes);
                    sent.push((baud, bytes));
                }
                Output::Ended => return (sent, now - start),
            }
        }
        assert!(now - start < 20_000_000, "a search ends");
        let next = line
            .deadline()
            .unwrap_or(Micros::MAX)
            .min(finder.deadline());
        now = next.max(now);
        while let Some(bytes) = line.poll_output(now) {
            finder.handle_input(now, &bytes);
        }
        finder.handle_timeout(now);
    }
}

fn device(parameters: &str, shaft: Shaft, faults: Faults) -> Emulator {
    let mut emulator = Emulator::new(*decoder(parameters).profile(), shaft).unwrap();
    emulator.faults = faults;
    emulator
}

fn search(parameters: &str, shaft: Shaft, faults: Faults) -> (Option<Found>, Sent, Micros) {
    let mut line = Bus {
        devices: vec![device(parameters, shaft, faults)],
    };
    let mut finder = Finder::new();
    let (sent, took) = run(&mut finder, &mut line, 7_000_000);
    let sure = |found: &&Found| matches!(found.verdict, Verdict::Certain | Verdict::Likely);
    let others = finder.found().iter().filter(sure).count();
    assert!(others <= 1, "{parameters}: {:?}", finder.found());
    (finder.found().first().cloned(), sent, took)
}

const ENCODERS: &[&str] = &[
    "format=t485 angle-bits=23",
    "format=t485 angle-bits=17",
    "format=rs485 angle-bits=24",
    "format=rs485 angle-bits=24 turns-bits=0 baud=115200",
    "format=rs485 angle-bits=16",
    "format=rs485 angle-bits=16 turns-bits=0 baud=115200",
    "format=bus angle-bits=24 address=31",
    "format=bus angle-bits=16 turns-bits=0 address=5",
    "format=period angle-bits=24",
    "format=period angle-bits=24 turns-bits=0 baud=115200",
    "format=period angle-bits=16",
    "format=asi1",
    "format=asi4",
];

/// The parts of a profile that a search finds out.
fn named(profile: &Profile) -> (Format, u32, u32, u32, u32) {
    let turns = if profile.format == Format::T485 {
        0
    } else {
        profile.turns_bits
    };
    (
        profile.format,
        profile.angle_bits,
        turns,
        profile.baud,
        profile.address,
    )
}

fn expect_found(parameters: &str, shaft: Shaft, faults: Faults) -> Found {
    let (found, _, took) = search(parameters, shaft, faults);
    let found = found.unwrap_or_else(|| panic!("{parameters}: nothing found"));
    let expected = *decoder(parameters).profile();
    assert_eq!(
        named(&found.profile),
        named(&expected),
        "{parameters}: {:?}",
        found.evidence
    );
    assert!(took < 6_000_000, "{parameters}: took {took} µs");
    found
}

#[test]
fn each_encoder_is_found_while_it_turns() {
    for parameters in ENCODERS {
        let found = expect_found(parameters, Shaft::turning(3.7, 1.3), Faults::default());
        assert_eq!(
            found.verdict,
            Verdict::Certain,
            "{parameters}: {:?}",
            found.evidence
        );
    }
}

#[test]
fn each_encoder_is_found_while_it_stands_still() {
    for parameters in ENCODERS {
        let found = expect_found(parameters, Shaft::still(5.3), Faults::default());
        assert!(
            matches!(found.verdict, Verdict::Certain | Verdict::Likely),
            "{parameters}: {:?} {:?}",
            found.verdict,
            found.evidence
        );
    }
}

#[test]
fn an_echo_and_five_percent_noise_hide_nothing() {
    for parameters in ENCODERS {
        let noise = Faults {
            flip: 50,
            ..Faults::default()
        };
        expect_found(parameters, Shaft::turning(3.7, 1.3), noise);
        if decoder(parameters).profile().link() == Link::Polled {
            let echo = Faults {
                echo: true,
                ..Faults::default()
            };
            let found = expect_found(parameters, Shaft::turning(3.7, 1.3), echo);
            assert!(found.evidence.iter().any(|line| line.contains("echoes")));
        }
    }
}

#[test]
fn a_width_is_only_named_when_the_angle_wraps() {
    for format in ["rs485", "bus", "period"] {
        for bits in 17..=24 {
            for turns in [0, 16] {
                let parameters = format!("format={format} angle-bits={bits} turns-bits={turns}");
                let (found, ..) = search(&parameters, Shaft::turning(0.6, 2.1), Faults::default());
                let found = found.unwrap();
                assert_eq!(
                    (found.profile.angle_bits, found.narrowest),
                    (bits, bits),
                    "{parameters}: {:?}",
                    found.evidence
                );
                let (found, ..) = search(&parameters, Shaft::still(0.101), Faults::default());
                let found = found.unwrap_or_else(|| panic!("{parameters}: nothing found"));
                if bits < 24 {
                    assert!(found.narrowest <= bits && bits <= found.profile.angle_bits);
                    assert!(
                        found
                            .evidence
                            .iter()
                            .any(|line| line.contains("order code"))
                    );
                }
            }
        }
    }
}

#[test]
fn silence_and_a_foreign_talker_find_nothing() {
    let silent = Faults {
        silent: true,
        ..Faults::default()
    };
    let (found, _, took) = search("format=t485", Shaft::still(0.0), silent);
    assert_eq!(found, None);
    assert!(took < 8_000_000, "{took}");
    // Only the echo of the requests.
    let echo = Faults {
        echo: true,
        silent: true,
        ..Faults::default()
    };
    assert_eq!(search("format=rs485", Shaft::still(0.0), echo).0, None);
    // A stream at a rate that is not tried.
    let (found, ..) = search(
        "format=period baud=1000000",
        Shaft::turning(0.0, 1.0),
        Faults::default(),
    );
    assert_eq!(found, None);
}

#[test]
fn all_devices_of_a_bus_are_found() {
    let made = |address: u32| {
        let parameters = format!("format=bus angle-bits=20 address={address}");
        device(
            &parameters,
            Shaft::still(f64::from(address) + 0.4),
            Faults::default(),
        )
    };
    let mut line = Bus {
        devices: [3, 7, 31].map(made).into(),
    };
    let mut finder = Finder::new();
    run(&mut finder, &mut line, 0);
    assert_eq!(finder.found()[0].addresses, [3, 7, 31]);

    let profile = *line.devices[0].profile();
    for device in &mut line.devices {
        device.faults.rate = None;
    }
    let mut scan = Finder::scan(&profile, 9_000_000).unwrap();
    let (sent, _) = run(&mut scan, &mut line, 9_000_000);
    assert_eq!(scan.found()[0].addresses, [3, 7, 31]);
    assert!(scan.disturbed().is_empty());
    assert!(sent.len() >= 32);
    assert!(Finder::scan(decoder("format=t485").profile(), 0).is_none());
}

#[test]
fn two_devices_with_one_address_are_not_taken_for_one() {
    let made = |turns| {
        device(
            "format=bus address=9",
            Shaft::still(turns),
            Faults::default(),
        )
    };
    let mut line = Bus {
        devices: [1.25, 6.8].map(made).into(),
    };
    let profile = *line.devices[0].profile();
    let mut scan = Finder::scan(&profile, 0).unwrap();
    run(&mut scan, &mut line, 0);
    assert!(scan.found().is_empty());
    assert_eq!(scan.disturbed(), [9]);
}

/// Whether a byte belongs to a command that changes some encoder.
fn is_dangerous(byte: u8) -> bool {
    let rs485 = rs485::Command::of_byte(byte).is_some_and(rs485::Command::changes_encoder);
    let t485 = t485::Request::of_byte(byte).is_some_and(t485::Request::changes_encoder);
    let head = Resolved::new(&bus::HEAD, Shape::of(Format::Bus.default_profile()));
    let values = head.values(bits::Bits::of_bytes(&[byte]));
    let bus = values.operation.and_then(bus::Operation::of_code);
    let parity = values
        .parity
        .is_some_and(encoderscope::reading::Checked::ok);
    rs485 || t485 || parity && bus.is_some_and(bus::Operation::changes_encoder)
}

#[test]
fn a_line_that_never_rests_ends_every_search() {
    for (parameters, known) in [("format=t485", None), ("format=bus", Some("format=bus"))] {
        let mut finder = match known {
            None => Finder::new(),
            Some(known) => Finder::scan(decoder(known).profile(), 0).unwrap(),
        };
        let mut now = 0;
        let mut ended = false;
        let mut sent = 0;
        while !ended && now < 60_000_000 {
            now += 15_000;
            finder.handle_input(now, &[0x55]);
            finder.handle_timeout(now);
            while let Some(output) = finder.poll_output() {
                match output {
                    Output::Open(_) => finder.handle_opened(now),
                    Output::Transmit(_) => sent += 1,
                    Output::Ended => ended = true,
                }
            }
        }
        assert!(ended && now < 10_000_000, "{parameters}: {now}");
        assert_eq!(sent, 0);
        assert!(finder.is_restless());
    }
}

#[test]
fn rates_that_the_adapter_does_not_make_are_left_out() {
    let chip = CHIPS.iter().find(|chip| chip.name == "FT232R").unwrap();
    let mut finder = Finder::through(|baud| !matches!(chip.made(baud), Made::Not(_)));
    assert_eq!(finder.poll_output(), Some(Output::Open(115_200)));
    let left_out: Vec<_> = finder
        .trials()
        .iter()
        .filter(|trial| !trial.tried)
        .collect();
    assert_eq!(left_out.len(), 1);
    assert_eq!(left_out[0].baud, 2_500_000);
}

/// The longest row of one dangerous byte, as commands must come to act.
fn longest_row(bytes: &[u8]) -> usize {
    let (mut longest, mut row, mut last) = (0, 0, None);
    for byte in bytes {
        row = if last == Some(byte) { row + 1 } else { 1 };
        last = Some(byte);
        if is_dangerous(*byte) {
            longest = longest.max(row);
        }
    }
    longest
}

#[test]
fn no_search_changes_an_encoder_through_an_adapter_at_any_rate() {
    let made = CHIPS.iter().filter_map(|chip| match chip.made(2_500_000) {
        Made::Rate(rate) | Made::Not(rate) => Some(rate as u32),
        Made::Listed | Made::Unknown => None,
    });
    let swept = (80..130).map(|percent| 25_000 * percent);
    for rate in made.chain(swept) {
        for parameters in [
            "format=t485",
            "format=t485 dialect=tamagawa",
            "format=rs485",
            "format=bus address=4",
            "format=bus address=31",
        ] {
            let mut emulator = device(parameters, Shaft::still(5.3), Faults::default());
            let before = (emulator.values(0), emulator.address(), emulator.memory(0));
            let mut finder = Finder::new();
            let mut heard = Vec::new();
            let mut now = 0;
            loop {
                while let Some(output) = finder.poll_output() {
                    match output {
                        Output::Open(baud) => {
                            // The adapter runs at this rate instead of 2.5 Mbaud.
                            let rate = if baud == 2_500_000 { rate } else { baud };
                            emulator.faults.rate = Some(rate);
                            emulator.drop_unread(now);
                            finder.handle_opened(now);
                        }
                        Output::Transmit(bytes) => {
                            let rate = emulator.faults.rate.unwrap();
                            let own = emulator.profile().baud;
                            heard.extend(encoderscope::emulator::heard(&bytes, rate, own));
                            emulator.handle_input(now, &bytes);
                        }
                        Output::Ended => now = Micros::MAX,
                    }
                }
                if now == Micros::MAX {
                    break;
                }
                let due = emulator.deadline().unwrap_or(Micros::MAX);
                now = due.min(finder.deadline()).max(now);
                while let Some(bytes) = emulator.poll_output(now) {
                    finder.handle_input(now, &bytes);
                }
                finder.handle_timeout(now);
            }
            let after = (emulator.values(0), emulator.address(), emulator.memory(0));
            assert_eq!(before.0.angle, after.0.angle, "{parameters} at {rate}");
            assert_eq!(before.0.turns, after.0.turns, "{parameters} at {rate}");
            assert_eq!(
                (before.1, before.2),
                (after.1, after.2),
                "{parameters} at {rate}"
            );
            let row = longest_row(&heard);
            assert!(
                row <= 3,
                "{parameters} at {rate}: {row} in a row of {heard:02x?}"
            );
        }
    }
}

#[test]
fn a_search_sends_nothing_that_changes_any_encoder() {
    assert!(
        [0x30, 0xc2, 0x62, 0xba, 0x32, 0xbf, 0xdf]
            .into_iter()
            .all(is_dangerous)
    );
    for format in [Format::T485, Format::Rs485, Format::Bus] {
        for ask in requests(&format.default_profile()) {
            assert!(
                !ask.bytes().iter().any(|byte| is_dangerous(*byte)),
                "{ask:?}"
            );
        }
    }
    for parameters in ENCODERS {
        for faults in [
            Faults::default(),
            Faults {
                silent: true,
                ..Faults::default()
            },
        ] {
            let (_, sent, _) = search(parameters, Shaft::turning(0.3, 1.0), faults);
            for (baud, bytes) in sent {
                assert!(
                    !bytes.iter().any(|byte| is_dangerous(*byte)),
                    "{baud}: {bytes:02x?}"
                );
                // What devices at the other rates of the manuals hear.
                for other in [115_200, 230_400, 2_500_000] {
                    let heard = encoderscope::emulator::heard(&bytes, baud, other);
                    let harmless = heard.iter().all(|byte| !is_dangerous(*byte));
                    assert!(other == baud || harmless, "{baud} at {other}: {heard:02x?}");
                }
            }
        }
    }
}

#[test]
fn what_another_rate_makes_of_bytes() {
    let heard = encoderscope::emulator::heard;
    assert_eq!(
        heard(&[0x12, 0xff, 0x00], 115_200, 115_200),
        [0x12, 0xff, 0x00]
    );
    // Two per cent are borne, ten are not.
    let all: Vec<u8> = (0..=255).collect();
    assert_eq!(heard(&all, 100_000, 102_000), all);
    assert_eq!(heard(&all, 100_000, 98_000), all);
    assert_ne!(heard(&all, 100_000, 110_000), all);
    // At half the rate two bits are one.
    assert_eq!(heard(&[0xe6], 200_000, 100_000), [0xfd]);
    assert!(heard(&[0x64], 2_500_000, 115_200).is_empty());
}
