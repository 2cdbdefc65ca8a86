//! The lamp, the bits behind it, and where they stand.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    decode::Decoder,
    format::{STATUS, blinks},
    lamp::{BATTERY, Health, Lamp, Light, Rhythm, about, flags},
    layout::{Active, Role},
    product::{Interface, Series},
};

fn place(interface: Interface, role: Role) -> Option<u32> {
    let flags = flags(interface);
    let found = flags.iter().find(|flag| flag.role == role);
    found.map(|flag| flag.place)
}

#[test]
fn error_and_warning_stand_where_the_manuals_say() {
    // MPP and PT, positions of the error and warning bits.
    for (interface, error, warning) in [
        (Interface::Ssi, 7, 6),
        (Interface::BissC, 13, 12),
        (Interface::Rs485, 7, 6),
        (Interface::Rs422, 7, 6),
        (Interface::Bus, 7, 6),
        (Interface::Period, 7, 6),
    ] {
        assert_eq!(place(interface, Role::Error), Some(error), "{interface:?}");
        assert_eq!(
            place(interface, Role::Warning),
            Some(warning),
            "{interface:?}"
        );
        let status: Vec<_> = flags(interface)
            .into_iter()
            .filter(|flag| flag.role == Role::Status)
            .map(|flag| (flag.place, flag.name))
            .collect();
        let expected: Vec<_> = STATUS
            .iter()
            .map(|bit| (warning - 6 + bit.place, bit.name.to_owned()))
            .collect();
        assert_eq!(status, expected, "{interface:?}");
    }
    let low = flags(Interface::BissC);
    let low = low.iter().find(|flag| flag.role == Role::Error).unwrap();
    assert_eq!(low.active, Active::Low);
}

#[test]
fn the_others_have_what_their_manuals_say() {
    let all = |interface| -> Vec<(String, u32)> {
        let flags = flags(interface).into_iter();
        flags.map(|flag| (flag.name, flag.place)).collect()
    };
    let named = |names: &[(&str, u32)]| -> Vec<(String, u32)> {
        let names = names.iter();
        names.map(|(name, at)| ((*name).to_owned(), *at)).collect()
    };
    // IP-75, figure 7: PV and ZPD below the top bit; 5.4.1: A is the last bit.
    assert_eq!(
        all(Interface::Asi1),
        named(&[("valid", 6), ("zero default", 5)])
    );
    assert_eq!(all(Interface::Ssi7), named(&[("alarm", 0)]));
    assert_eq!(all(Interface::Asi4), []);
    assert_eq!(all(Interface::SsiTree), []);
    // MPP, T485: B1 b6 and b5, E b7 and b6.
    let t485 = all(Interface::T485);
    for known in named(&[("battery disconnected", 7), ("battery low", 6)]) {
        assert!(t485.contains(&known), "{t485:?}");
    }
    assert_eq!(place(Interface::T485, Role::Error), None);
}

#[test]
fn every_status_byte_has_the_lamp_of_the_table() {
    for byte in 0..=u8::MAX {
        let health = Health::of_byte(byte);
        let lamp = health.lamp();
        let (error, warning) = (byte & 0x80 != 0, byte & 0x40 != 0);
        assert_eq!((health.error, health.warning), (error, warning));
        assert_eq!(health.status, byte & 0x3f);
        let light = if error {
            Light::Red
        } else if warning {
            Light::Yellow
        } else {
            Light::Green
        };
        assert_eq!(lamp.light, light, "{byte:02x}");
        let battery = byte & 0x30 != 0;
        assert_eq!(
            lamp.rhythm == Rhythm::Blinking,
            battery && light != Light::Green,
            "{byte:02x}"
        );
        assert_eq!(Health::parse(&format!("{byte:02x}")), Ok(health));
        assert_eq!(Health::parse(&format!("0x{byte:X}")), Ok(health));
        assert_eq!(Health::parse(&format!("{byte:08b}")), Ok(health));
        assert_eq!(Health::parse(&format!("0b{byte:08b}")), Ok(health));
        // The bits that are read are those of the byte, and those set explain the lamp.
        let bits = health.bits();
        let places: Vec<_> = bits.iter().map(|bit| bit.place).collect();
        assert_eq!(places, [7, 6, 5, 4, 3, 2, 1, 0]);
        for bit in &bits {
            assert_eq!(bit.set, byte & (1 << bit.place) != 0, "{byte:02x} {bit:?}");
        }
        let causes = lamp.causes().unwrap();
        let regular = health.oddities().is_empty();
        let named = |place| causes.iter().any(|cause| cause.bit.place == place);
        if regular && light != Light::Green {
            assert!(
                bits.iter().any(|bit| bit.set && named(bit.place)),
                "{byte:02x}"
            );
        }
    }
}

#[test]
fn what_the_manuals_do_not_name_is_said() {
    let odd = |text| Health::parse(text).unwrap().oddities().len();
    for (text, count) in [
        ("00", 0),
        ("42", 0),
        ("a0", 0),
        ("10", 1),
        ("40", 1),
        ("60", 1),
        ("c1", 1),
    ] {
        assert_eq!(odd(text), count, "{text}");
    }
}

#[test]
fn a_lamp_stands_for_the_bits_of_the_battery_table() {
    let said = |light: &str, blinking: &str| -> Vec<(u32, &'static str)> {
        let lamp = Lamp::parse(light, blinking).unwrap();
        let causes = lamp.causes().unwrap().into_iter();
        causes.map(|cause| (cause.bit.place, cause.text)).collect()
    };
    assert_eq!(
        said("yellow", "yes"),
        [(4, "the battery is below 2.9 V")],
        "b5 has no warning"
    );
    let red = said("red", "yes");
    assert_eq!(red.len(), 2);
    assert!(red[0].1.contains("restarted from 0"));
    assert_eq!(red[1], (4, "the battery is below 2.7 V"));
    for light in ["yellow", "red"] {
        let steady: Vec<_> = said(light, "no").into_iter().map(|(at, _)| at).collect();
        assert_eq!(steady, [3, 2, 1, 0]);
    }
    assert_eq!(said("green", "no"), []);
    assert_eq!(said("dark", "no"), []);
    // The volts are those that the status bit speaks of.
    let low = STATUS.iter().find(|bit| bit.place == 4).unwrap();
    for volts in ["2.9 V", "2.7 V"] {
        assert!(low.doc.contains(volts));
    }
    for row in &BATTERY {
        let bit = STATUS.iter().find(|bit| bit.place == row.place).unwrap();
        assert!(blinks(bit.name));
    }
}

#[test]
fn what_cannot_be_gets_a_sentence() {
    for light in ["green", "dark"] {
        let fault = Lamp::parse(light, "yes").unwrap().causes().unwrap_err();
        assert_eq!(fault.input, "blinking");
        assert!(fault.message.contains("blink"));
    }
    assert_eq!(Lamp::parse("blue", "no").unwrap_err().input, "lamp");
    assert_eq!(Lamp::parse("red", "1").unwrap_err().input, "blinking");
    for text in [
        "", " ", "0x", "0b", "100", "256", "g0", "0x123", "-1", "+5", "0x+5", "1010101",
        "20000000", "0b123", "é",
    ] {
        if let Ok(health) = Health::parse(text) {
            // "0b" is a hex number too.
            assert_eq!((text, health), ("0b", Health::of_byte(0x0b)));
        }
    }
    assert!(
        Health::parse("256")
            .unwrap_err()
            .message
            .contains("\"256\"")
    );
}

#[test]
fn series_without_a_lamp_say_so() {
    assert!(about(Series::Mpp).contains("green"));
    assert!(about(Series::Ip75).contains("no lamp"));
    for series in [Series::Avs58, Series::Avm58, Series::Ass58, Series::Asm58] {
        assert!(about(series).contains("neither a lamp"));
    }
}

#[test]
fn a_reply_with_a_weak_battery_has_a_yellow_lamp_that_blinks() {
    let profile = Interface::Period.format().default_profile();
    let decoder = Decoder::new(profile).unwrap();
    let frame = [0xff, 0xfe, 0x12, 0x34, 0x56, 0x60, 0xbb];
    let values = decoder.frame(&frame).unwrap().values();
    let health = Health {
        error: values.error.unwrap(),
        warning: values.warning.unwrap(),
        status: values.status.unwrap(),
    };
    assert_eq!(health, Health::of_byte(0x60));
    assert_eq!(health.lamp().name(), "yellow-blinking");
}
