#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    adapter::{CHIPS, Chip, Made},
    doctor::{Doctor, Finding},
    emulator::{Emulator, Faults, Shaft},
    format::Link,
    session::{Micros, Output, Session},
};
use encoderscope_tests::decoder;

/// What the doctor finds when a session for `asked` meets an encoder for two seconds.
fn finding(asked: &str, encoder: &str, faults: Faults) -> Finding {
    let shaft = Shaft::turning(3.8, 0.3);
    *findings(asked, encoder, shaft, &[faults]).last().unwrap()
}

/// What it finds every 10 ms, while faults follow each other, each for two seconds.
fn findings(asked: &str, encoder: &str, shaft: Shaft, faults: &[Faults]) -> Vec<Finding> {
    let mut emulator = Emulator::new(*decoder(encoder).profile(), shaft).unwrap();
    let mut findings = Vec::new();
    let mut faults = faults.iter();
    let mut session = Session::new(decoder(asked), 0).unwrap();
    let mut doctor = Doctor::new(*session.decoder().profile(), 0);
    let mut now: Micros = 0;
    let mut until: Micros = 0;
    emulator.drop_unread(now);
    loop {
        if now >= until {
            let Some(next) = faults.next() else {
                return findings;
            };
            emulator.faults = *next;
            until += 2_000_000;
        }
        session.handle_timeout(now);
        while let Some(bytes) = emulator.poll_output(now) {
            session.handle_input(now, &bytes);
        }
        while let Some(output) = session.poll_output() {
            let good = match &output {
                Output::Transmit(bytes) => {
                    emulator.handle_input(now, bytes);
                    false
                }
                Output::Frame { bytes, sure, .. } => {
                    let frame = session.decoder().frame(bytes);
                    *sure && frame.is_some_and(|frame| frame.ok())
                }
                _ => false,
            };
            doctor.watch(now, &output, good);
        }
        while findings.len() as Micros * 10_000 < now {
            findings.push(doctor.finding());
        }
        let due = emulator.deadline().unwrap_or(Micros::MAX);
        now = due.min(session.deadline()).max(now + 1);
    }
}

const ALL: &[&str] = &[
    "format=t485",
    "format=rs485",
    "format=rs485 baud=115200",
    "format=bus address=3",
    "format=period",
    "format=asi1",
    "format=asi4",
];

#[test]
fn each_state_has_its_name() {
    for parameters in ALL {
        let polled = !["period", "asi1", "asi4"]
            .iter()
            .any(|name| parameters.contains(name));
        let found = |faults| finding(parameters, parameters, faults);
        assert_eq!(found(Faults::default()), Finding::Good, "{parameters}");
        let noisy = Faults {
            flip: 50,
            ..Faults::default()
        };
        assert_eq!(found(noisy), Finding::Good, "{parameters}");
        let silent = Faults {
            silent: true,
            ..Faults::default()
        };
        assert_eq!(found(silent), Finding::Silent, "{parameters}");
        if polled {
            let echo = Faults {
                echo: true,
                ..silent
            };
            assert_eq!(found(echo), Finding::EchoOnly, "{parameters}");
            let spoilt = Faults {
                flip: 900,
                ..Faults::default()
            };
            assert_eq!(found(spoilt), Finding::ChecksFail, "{parameters}");
            let cut = Faults {
                flip: 500,
                drop: 300,
                insert: 300,
                ..Faults::default()
            };
            assert_eq!(found(cut), Finding::Garbage, "{parameters}");
        } else {
            let slower = Faults {
                rate: Some(decoder(parameters).profile().baud / 2),
                ..Faults::default()
            };
            assert_eq!(found(slower), Finding::Garbage, "{parameters}");
        }
    }
}

/// Of the text of ASI4 nothing can fail: any digit is as good as another.
const CHECKED: &[&str] = &[
    "format=t485",
    "format=rs485",
    "format=bus address=3",
    "format=period",
    "format=asi1",
];

/// One byte in five has a bit turned over.
fn fifth() -> Faults {
    Faults {
        flip: 200,
        ..Faults::default()
    }
}

#[test]
fn a_link_on_which_some_frames_are_good_is_read_and_one_without_is_not() {
    let spoilt = Faults {
        flip: 900,
        drop: 200,
        insert: 200,
        ..Faults::default()
    };
    for parameters in CHECKED {
        let shaft = Shaft::turning(3.8, 0.3);
        let found = findings(
            parameters,
            parameters,
            shaft,
            &[fifth(), spoilt, spoilt, spoilt],
        );
        let (noisy, bad) = found.split_at(200);
        let good = noisy.iter().filter(|one| **one == Finding::Good).count();
        let stream = decoder(parameters).profile().link() == Link::Stream;
        let least = if stream { 150 } else { 80 };
        assert!(good > least, "{parameters}: {good} of 200");
        let bad = &bad[400..];
        let good = bad.iter().filter(|one| **one == Finding::Good).count();
        assert!(good < 40, "{parameters}: {good} of {}", bad.len());
    }
}

#[test]
fn frames_that_stand_out_of_noise_are_called_frames() {
    // Frames of a shaft at rest are alike, so that a lone one is not certain.
    for parameters in CHECKED {
        let found = findings(parameters, parameters, Shaft::still(5.5), &[fifth()]);
        let garbage = found.iter().filter(|one| **one == Finding::Garbage).count();
        assert!(garbage < 10, "{parameters}: {garbage} of {}", found.len());
    }
}

#[test]
fn another_profile_is_named() {
    for (asked, encoder) in [
        (
            "format=rs485 angle-bits=24 turns-bits=0",
            "format=rs485 angle-bits=24 turns-bits=16",
        ),
        (
            "format=rs485 angle-bits=16 turns-bits=0 command=t",
            "format=rs485 angle-bits=24 turns-bits=16 command=t",
        ),
        (
            "format=rs485 angle-bits=17 turns-bits=16",
            "format=rs485 angle-bits=24 turns-bits=16",
        ),
        ("format=t485 angle-bits=17", "format=t485 angle-bits=23"),
        (
            "format=bus angle-bits=24 turns-bits=16 address=9",
            "format=bus angle-bits=16 turns-bits=0 address=9",
        ),
        (
            "format=period angle-bits=16 turns-bits=0",
            "format=period angle-bits=24 turns-bits=16",
        ),
        (
            "format=period angle-bits=24 turns-bits=16",
            "format=period angle-bits=24 turns-bits=0",
        ),
        ("format=asi1", "format=asi4"),
        ("format=asi4", "format=asi1"),
    ] {
        let expected = *decoder(encoder).profile();
        for faults in [
            Faults::default(),
            Faults {
                echo: true,
                ..Faults::default()
            },
        ] {
            assert_eq!(
                finding(asked, encoder, faults),
                Finding::OtherProfile(expected),
                "{asked} on {encoder}"
            );
        }
    }
    let period = *decoder("format=period").profile();
    for asked in ["format=t485", "format=rs485", "format=bus"] {
        let found = finding(asked, "format=period", Faults::default());
        assert_eq!(found, Finding::Unasked(Some(period)), "{asked}");
    }
}

#[test]
fn what_adapters_make_of_a_rate() {
    let made = |name: &str, baud| {
        let chip = CHIPS.iter().find(|chip| chip.name == name).unwrap();
        let (vendor, product) = chip.identity.unwrap();
        assert_eq!(Chip::of(vendor, product), Some(chip));
        chip.made(baud)
    };
    let near = |made: Made, rate: f64| matches!(made, Made::Rate(r) if (r - rate).abs() < 1.0);
    assert!(near(made("FT232H", 2_500_000), 12e6 / 4.75));
    assert!(near(made("FT232R", 115_200), 3e6 / 26.0));
    assert!(near(made("FT232R", 230_400), 3e6 / 13.0));
    for name in ["FT232R", "FT230X"] {
        assert_eq!(made(name, 2_500_000), Made::Not(3e6), "{name}");
        assert!(near(made(name, 3_000_000), 3e6));
        assert!(near(made(name, 2_000_000), 2e6));
    }
    assert_eq!(made("CH340", 2_500_000), Made::Not(2e6));
    assert_eq!(made("PL2303", 2_500_000), Made::Unknown);
    assert_eq!(made("CH343", 2_500_000), Made::Unknown);
    assert_eq!(Chip::of(1, 2), None);
    for chip in CHIPS {
        for baud in [115_200, 230_400] {
            assert!(!matches!(chip.made(baud), Made::Not(_)));
        }
        for baud in [0, 1, u32::MAX] {
            let _ = chip.made(baud);
        }
    }
}
