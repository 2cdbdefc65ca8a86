//! How zeros are set: the checklists are what the sequences really do.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    conversation::Conversation,
    dump::Direction,
    format::{TIMES, bus, rs485},
    procedure::{HOLD, Procedure, zero},
    product::{Interface, Series},
};

fn all() -> Vec<(Series, Interface, Procedure)> {
    let mut all = Vec::new();
    for series in Series::ALL {
        for interface in series.interfaces() {
            let ways = zero(series, *interface).unwrap().procedures;
            assert!(!ways.is_empty(), "{series:?} {interface:?}");
            all.extend(ways.into_iter().map(|way| (series, *interface, way)));
        }
    }
    all
}

fn words(way: &Procedure) -> String {
    let steps = way.steps.iter();
    steps
        .map(|step| format!("{} → {}\n", step.text, step.expect))
        .collect()
}

#[test]
fn what_is_sent_is_what_the_sequence_sends() {
    let mut count = 0;
    for (_, interface, way) in all() {
        let listed: Vec<u8> = way
            .steps
            .iter()
            .flat_map(|step| {
                let once: Vec<u8> = step.sends.iter().flatten().copied().collect();
                once.repeat(step.times.into())
            })
            .collect();
        let Some(change) = way.change else {
            assert!(listed.is_empty(), "{interface:?}");
            continue;
        };
        count += 1;
        let profile = way.console.expect("the console can do it");
        let talk = Conversation::of(&profile, change).unwrap();
        let sent: Vec<u8> = talk
            .lines
            .iter()
            .filter(|line| line.direction == Direction::Sent)
            .flat_map(|line| line.bytes.clone())
            .collect();
        assert_eq!(listed, sent, "{interface:?}");
        let many = way.steps.iter().filter(|step| step.times > 1);
        let many: Vec<_> = many.map(|step| step.times).collect();
        assert_eq!(many, [TIMES], "{interface:?}");
    }
    // MPP and PT: RS485, RS422, T485 twice, BUS.
    assert_eq!(count, 2 * 5);
}

#[test]
fn the_numbers_of_the_manuals_are_said() {
    for (series, interface, way) in all() {
        let text = words(&way) + &way.notes.join("\n");
        let says = |wanted: &str| assert!(text.contains(wanted), "{series:?}: {wanted}\n{text}");
        match (interface, way.name) {
            (Interface::Rs485 | Interface::Rs422, _) => {
                says("0x31");
                says("0x30");
                says("C = 1, 2 … 10");
                says("Wait 40 ms");
                assert_eq!(rs485::STORING, 40_000);
            }
            (Interface::T485, "reset-angle") => says("0xC2 (reset angle) 10 times in a row"),
            (Interface::T485, _) => says("0x62 (reset turns) 10 times in a row"),
            (Interface::Bus, _) => {
                says("0x1F (00, position and status), then 0xBF (01, set zero), 10 times");
                says("Wait 50 ms");
                says("C = 0");
                says("C = 1");
                assert_eq!(bus::STORING, 50_000);
            }
            (Interface::Asi1, "zero-set") => {
                says("ZERO SET (violet)");
                says("3 s");
                says("ZPD becomes 0");
            }
            (Interface::Asi1, _) => {
                says("ZERO RESET (yellow)");
                says("ZPD becomes 1");
            }
            (Interface::Asi4 | Interface::Ssi7, _) => {
                assert!(!text.contains("ZPD"), "{text}");
                assert_eq!(HOLD, 3_000_000);
            }
            (Interface::SsiTree, _) => {
                says("-H");
                says("PRESET1");
                says("V/R");
                says("moves by the value that was there before");
            }
            (Interface::Ssi | Interface::BissC | Interface::Period, _) => {
                assert_eq!(way.name, "offset");
                says("modulo 2");
            }
        }
    }
}

#[test]
fn every_step_says_what_to_expect_and_where_it_is_from() {
    for (series, interface, way) in all() {
        assert!(way.steps.len() >= 3, "{series:?} {interface:?}");
        for step in &way.steps {
            assert!(step.text.ends_with('.'), "{step:?}");
            assert!(!step.expect.is_empty() && !step.source.is_empty());
            assert_eq!(step.sends.is_empty(), step.times == 0);
        }
    }
}

#[test]
fn what_there_is_not_is_said() {
    for series in Series::ALL {
        for interface in Interface::ALL {
            match zero(series, interface) {
                Ok(zero) => assert!(!zero.missing.is_empty(), "{series:?} {interface:?}"),
                Err(fault) => {
                    assert!(!series.interfaces().contains(&interface));
                    assert_eq!(fault.input, "interface");
                }
            }
        }
    }
    for interface in [Interface::Ssi, Interface::BissC, Interface::Period] {
        let zero = zero(Series::Mpp, interface).unwrap();
        assert!(zero.procedures.iter().all(|way| way.change.is_none()));
        assert!(zero.missing[0].text.contains("no command"));
    }
}
