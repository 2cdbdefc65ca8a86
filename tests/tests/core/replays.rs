//! A conversation that was recorded says the same when it is replayed.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    emulator::{Bus, Emulator, Faults, Shaft},
    recording::{Event, Line, Reader, Writer},
    session::{Micros, Output, Session},
};
use encoderscope_tests::decoder;

/// Reads an encoder for three seconds, and records it.
fn live(mut session: Session, mut line: Bus) -> (Vec<Output>, Vec<u8>) {
    let mut writer = Writer::new("Encoderscope", "Linux");
    let (mut said, mut file) = (Vec::new(), Vec::new());
    writer.open(0, Line::default(), &mut file);
    let mut now = 0;
    while now < 3_000_000 {
        session.handle_timeout(now);
        while let Some(bytes) = line.poll_output(now) {
            writer.received(now, &bytes, false, &mut file);
            session.handle_input(now, &bytes);
        }
        while let Some(output) = session.poll_output() {
            if let Output::Transmit(bytes) = &output {
                writer.sent(now, bytes, None, &mut file);
                line.handle_input(now, bytes);
            }
            said.push(output);
        }
        let next = line
            .deadline()
            .unwrap_or(Micros::MAX)
            .min(session.deadline());
        now = next.max(now + 1);
    }
    writer.end(now, "stopped", &mut file);
    session.rest();
    said.extend(std::iter::from_fn(|| session.poll_output()));
    (said, file)
}

/// Reads the recording along.
fn replayed(mut session: Session, file: &[u8]) -> Vec<Output> {
    let mut reader = Reader::new();
    reader.push(file);
    let mut said = Vec::new();
    while let Some(moment) = reader.next().unwrap() {
        while session.deadline() < moment.at {
            session.handle_timeout(session.deadline());
        }
        match moment.event {
            Event::Sent { bytes, .. } => session.handle_sent(moment.at, &bytes),
            Event::Received { bytes, .. } => session.handle_input(moment.at, &bytes),
            _ => {}
        }
        said.extend(std::iter::from_fn(|| session.poll_output()));
    }
    session.rest();
    said.extend(std::iter::from_fn(|| session.poll_output()));
    said
}

#[test]
fn a_replay_says_what_was_said() {
    let well = Faults::default();
    for faults in [
        well,
        Faults { flip: 50, ..well },
        Faults { lose: 100, ..well },
        Faults {
            drop: 20,
            insert: 20,
            ..well
        },
        Faults {
            echo: true,
            flip: 10,
            ..well
        },
        Faults { late: 50, ..well },
        Faults { twice: 50, ..well },
        Faults {
            silent: true,
            ..well
        },
    ] {
        for parameters in [
            "format=t485",
            "format=rs485 command=d",
            "format=bus",
            "format=period",
            "format=asi1",
        ] {
            let decoder = decoder(parameters);
            let shaft = Shaft::turning(0.3, 1.5);
            let mut emulator = Emulator::new(*decoder.profile(), shaft).unwrap();
            emulator.faults = faults;
            let line = Bus {
                devices: vec![emulator],
            };
            let (said, file) = live(Session::new(decoder.clone(), 500).unwrap(), line);
            let again = replayed(Session::following(decoder).unwrap(), &file);
            assert!(said.len() > 3);
            for (number, (again, said)) in again.iter().zip(&said).enumerate() {
                assert_eq!(again, said, "{number} {parameters} {faults:?}");
            }
            assert_eq!(again.len(), said.len(), "{parameters} {faults:?}");
        }
    }
}

#[test]
fn a_bus_is_read_along() {
    let decoder = decoder("format=bus");
    let addresses = [3, 9, 31];
    let device = |address: u8| {
        let profile = encoderscope::profile::Profile {
            address: address.into(),
            ..*decoder.profile()
        };
        Emulator::new(profile, Shaft::turning(0.1, 0.2)).unwrap()
    };
    let line = Bus {
        devices: addresses.map(device).into(),
    };
    let session = Session::of_devices(decoder.clone(), &addresses, 500).unwrap();
    let (said, file) = live(session, line);
    let frames = |said: &[Output]| {
        said.iter()
            .filter(|output| matches!(output, Output::Frame { sure: true, .. }))
            .count()
    };
    assert!(frames(&said) > 1_000);
    assert_eq!(replayed(Session::following(decoder).unwrap(), &file), said);
}

#[test]
fn what_a_session_would_not_ask_is_only_said() {
    let decoder = decoder("format=t485");
    let mut session = Session::following(decoder).unwrap();
    session.handle_sent(0, &[0xc2]);
    assert_eq!(session.poll_output(), Some(Output::Transmit(vec![0xc2])));
    session.handle_input(100, &[1, 2, 3]);
    assert!(matches!(session.poll_output(), Some(Output::Skip { .. })));
    assert_eq!(session.poll_output(), None);
    assert!(Session::following(encoderscope_tests::decoder("format=ssi")).is_err());
}
