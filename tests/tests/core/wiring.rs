//! Which wire goes where: every combination of encoder, battery and adapter.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    format::Link,
    product::{Interface, Series},
    wiring::{Adapter, Battery, End, Line, Paint, Place, Polarity, Presence, Setup, Wire, Wiring},
};

fn setups() -> impl Iterator<Item = Setup> {
    Series::ALL.into_iter().flat_map(|series| {
        Interface::ALL.into_iter().flat_map(move |interface| {
            Battery::ALL.into_iter().flat_map(move |battery| {
                Adapter::ALL.into_iter().map(move |adapter| Setup {
                    series,
                    interface,
                    battery,
                    adapter,
                })
            })
        })
    })
}

pub(crate) fn wirings() -> impl Iterator<Item = Wiring> {
    setups().filter_map(|setup| setup.wire().ok())
}

fn wired(series: Series, interface: Interface, battery: Battery, adapter: Adapter) -> Wiring {
    let setup = Setup {
        series,
        interface,
        battery,
        adapter,
    };
    setup.wire().expect("this exists")
}

/// What a wire goes to, in words.
fn told(wire: &Wire) -> String {
    let colour = wire.paint.map(Paint::name);
    let goes = wire.goes.map_or("nowhere", |terminal| terminal.name);
    format!(
        "{} {} {} → {goes}",
        wire.pin.unwrap_or_default(),
        colour.unwrap_or_default(),
        wire.signal
    )
}

fn all_told(wiring: &Wiring) -> Vec<String> {
    wiring.wires.iter().map(told).collect()
}

#[test]
fn every_signal_goes_to_one_terminal_that_fits() {
    let mut count = 0;
    for wiring in wirings() {
        count += 1;
        let setup = wiring.setup;
        let mut taken = Vec::new();
        for wire in &wiring.wires {
            match wire.goes {
                None => assert_eq!(wire.line, Line::Unused, "{setup:?} {wire:?}"),
                Some(terminal) => {
                    assert!(wire.line.fits(terminal.line), "{setup:?} {wire:?}");
                    // Plus to plus; a level has no polarity.
                    let plus = |name: &str| name.contains('+');
                    let minus = |name: &str| name.contains('−');
                    if plus(wire.signal) && terminal.place == Place::Adapter {
                        assert!(plus(terminal.name), "{setup:?} {wire:?}");
                    }
                    if minus(wire.signal) && terminal.place == Place::Adapter {
                        assert!(minus(terminal.name), "{setup:?} {wire:?}");
                    }
                    if terminal.line != Line::Level {
                        assert!(!taken.contains(&terminal), "{setup:?}: {terminal:?} twice");
                        taken.push(terminal);
                    }
                }
            }
        }
        let pins: Vec<u8> = wiring.wires.iter().filter_map(|wire| wire.pin).collect();
        assert!(pins.is_sorted(), "{setup:?}");
        assert!(pins.is_empty() || pins.len() == wiring.wires.len());
        // Both ends share 0 V, except at a board whose table names no ground.
        assert_eq!(wiring.ground.is_none(), setup.adapter == Adapter::Apci1710);
        for place in [Place::Supply, Place::Adapter] {
            assert!(taken.iter().any(|terminal| terminal.place == place));
        }
    }
    // MPP and PT: SSI 2, BiSS-C 1, RS485, T485 and BUS 2 each, RS422 1, PERIOD 3; with and
    // without a battery. IP-75: 3, 3 and 2. P+F: 2 for each of four.
    assert_eq!(count, 2 * 2 * (2 + 1 + 6 + 1 + 3) + 8 + 8);
}

#[test]
fn what_does_not_exist_gets_a_sentence_that_names_the_entry() {
    for setup in setups() {
        let Err(fault) = setup.wire() else { continue };
        let Setup {
            series, interface, ..
        } = setup;
        assert!(fault.message.len() > 30, "{fault:?}");
        assert!(!fault.message.ends_with('.'), "{fault:?}");
        let input = if !series.interfaces().contains(&interface) {
            "interface"
        } else if setup.battery == Battery::Fitted && !matches!(series, Series::Mpp | Series::Pt) {
            "battery"
        } else {
            "adapter"
        };
        assert_eq!(fault.input, input, "{setup:?}");
        if input == "adapter" {
            let is_clocked = interface.format().spec().link == Link::Clocked;
            let is_master = matches!(setup.adapter, Adapter::Master | Adapter::Apci1710);
            let is_biss_on_board =
                (interface, setup.adapter) == (Interface::BissC, Adapter::Apci1710);
            let pairs = [
                Interface::Rs422,
                Interface::Rs485,
                Interface::T485,
                Interface::Bus,
            ];
            assert!(
                is_clocked != is_master || is_biss_on_board || pairs.contains(&interface),
                "{setup:?}: {fault}"
            );
        }
    }
    let said = |series, interface, adapter| {
        let setup = Setup {
            series,
            interface,
            battery: Battery::None,
            adapter,
        };
        setup.wire().unwrap_err().message
    };
    assert_eq!(
        said(Series::Ip75, Interface::T485, Adapter::TwoWire),
        "IP-75 does not come with T485, only with ASI1, ASI4, SSI7"
    );
    assert!(
        said(Series::Mpp, Interface::Ssi, Adapter::TwoWire)
            .starts_with("a USB adapter cannot read SSI")
    );
    assert!(said(Series::Pt, Interface::Rs422, Adapter::TwoWire).contains("four-wire"));
}

#[test]
fn the_wires_are_those_of_the_manuals() {
    let mpp = wired(
        Series::Mpp,
        Interface::Ssi,
        Battery::Fitted,
        Adapter::Master,
    );
    assert_eq!(
        all_told(&mpp),
        [
            "1 red +5 V → +",
            "2 black 0 V → −",
            "3 green Clock+ → CLK+",
            "4 green-black Clock− → CLK−",
            "5 yellow Data+ → DATA+",
            "6 yellow-black Data− → DATA−",
            "7 white Battery+ → +",
            "8 white-black Battery− → −",
        ]
    );
    let pt = wired(
        Series::Pt,
        Interface::Period,
        Battery::None,
        Adapter::TwoWire,
    );
    assert_eq!(
        all_told(&pt),
        [
            "1 red +5 V → +",
            "2 black 0 V → −",
            "3 blue – → nowhere",
            "4 green – → nowhere",
            "5 yellow TX+ → A (D+)",
            "6 orange TX− → B (D−)",
        ]
    );
    let rs422 = wired(
        Series::Pt,
        Interface::Rs422,
        Battery::Fitted,
        Adapter::FourWire,
    );
    assert_eq!(
        all_told(&rs422)[2..],
        [
            "3 blue RX+ → T+",
            "4 green RX− → T−",
            "5 yellow TX+ → R+",
            "6 orange TX− → R−",
            "7 white Battery+ → +",
            "8 gray Battery− → −",
        ]
    );
    let stream = wired(
        Series::Ip75,
        Interface::Asi1,
        Battery::None,
        Adapter::TwoWire,
    );
    assert_eq!(
        all_told(&stream),
        [
            "1 red supply + → +",
            "2 black 0 V → −",
            "3 green OUT DATA+ → A (D+)",
            "4 orange OUT DATA− → B (D−)",
            "5 violet ZERO SET → 0 V or open",
            "6 yellow ZERO RESET → 0 V or open",
        ]
    );
    let clocked = wired(
        Series::Ip75,
        Interface::Ssi7,
        Battery::None,
        Adapter::Apci1710,
    );
    assert_eq!(
        all_told(&clocked)[2..6],
        [
            "3 green OUT DATA+ → Bx+ DATA 1",
            "4 orange OUT DATA− → Bx− DATA 1",
            "5 blue IN CLK+ → Ax+ CLOCK",
            "6 brown IN CLK− → Ax− CLOCK",
        ]
    );
    // The article names no pins and no colours.
    let article = wired(
        Series::Avm58,
        Interface::SsiTree,
        Battery::None,
        Adapter::Apci1710,
    );
    for wire in &article.wires {
        assert_eq!((wire.pin, wire.paint), (None, None));
    }
    assert!(article.source.contains("no pins and no colours"));
}

#[test]
fn supplies_are_those_of_the_manuals() {
    let supply = |series: Series, adapter| {
        let wiring = wired(series, series.interfaces()[0], Battery::None, adapter);
        let values = wiring.supply.iter();
        values.map(|fact| fact.value).collect::<Vec<_>>()
    };
    let mpp = supply(Series::Mpp, Adapter::Master);
    assert_eq!(mpp, ["4.5…5.5 V", "≈ 60 mA", "15 ms"]);
    let pt = supply(Series::Pt, Adapter::Master);
    assert_eq!(pt, ["4.5…5.5 V", "≈ 100 mA", "15 ms"]);
    let ip75 = supply(Series::Ip75, Adapter::TwoWire);
    assert_eq!(ip75[..2], ["+5…+7 V", "≤ 0.2 A"]);
    assert_eq!(supply(Series::Asm58, Adapter::Master), ["10…30 V"]);
    for wiring in wirings() {
        let mut warnings = wiring.warnings.iter();
        let warning = warnings.find(|warning| warning.name == "supply").unwrap();
        for volts in ["4.5…5.5 V", "+5…+7 V", "10…30 V"] {
            assert!(warning.text.contains(volts), "{}", warning.text);
        }
    }
}

#[test]
fn terminators_are_those_of_the_manuals() {
    for wiring in wirings() {
        let setup = wiring.setup;
        let signals: Vec<_> = wiring.wires.iter().map(|wire| wire.signal).collect();
        let mut at_controller = 0;
        for terminator in &wiring.terminators {
            let (plus, minus) = terminator.between;
            assert!(
                signals.contains(&plus) && signals.contains(&minus),
                "{setup:?}"
            );
            assert!(!terminator.source.is_empty() && !terminator.text.is_empty());
            at_controller += usize::from(terminator.end == End::Controller);
        }
        // What comes back ends at the controller, once.
        assert_eq!(at_controller, 1, "{setup:?}");
        let at_encoder = wiring
            .terminators
            .iter()
            .find(|terminator| terminator.end == End::Encoder)
            .map(|terminator| terminator.presence);
        let expected = match setup.interface {
            Interface::Asi1 | Interface::Asi4 => None,
            Interface::Ssi7 => Some(Presence::Added),
            Interface::Rs485 | Interface::T485 | Interface::Period => Some(Presence::Unclear),
            _ => Some(Presence::Inside),
        };
        assert_eq!(at_encoder, expected, "{setup:?}");
    }
    // Both manuals are named where they contradict each other.
    for series in [Series::Mpp, Series::Pt] {
        let wiring = wired(series, Interface::T485, Battery::None, Adapter::TwoWire);
        let unclear = &wiring.terminators[0];
        assert!(unclear.text.contains("MPP") && unclear.text.contains("PT"));
    }
    let own = |adapter| {
        let wiring = wired(Series::Mpp, Interface::Rs485, Battery::None, adapter);
        wiring.terminators[1].presence
    };
    assert_eq!(own(Adapter::TwoWire), Presence::Switched);
    assert_eq!(own(Adapter::TwoWireBare), Presence::Added);
}

#[test]
fn warnings_are_said_where_they_belong() {
    for wiring in wirings() {
        let setup = wiring.setup;
        let names: Vec<_> = wiring.warnings.iter().map(|warning| warning.name).collect();
        for warning in &wiring.warnings {
            assert!(warning.text.ends_with('.'), "{warning:?}");
            assert!(!warning.source.is_empty());
        }
        let has = |name| names.contains(&name);
        let is_clocked = setup.interface.format().spec().link == Link::Clocked;
        assert_eq!(has("battery"), setup.battery == Battery::Fitted);
        assert_eq!(has("clocked"), is_clocked);
        assert_eq!(has("rate"), !is_clocked);
        assert_eq!(
            has("tx-only"),
            matches!(
                setup.interface,
                Interface::Period | Interface::Asi1 | Interface::Asi4
            )
        );
        let unclear = wiring.terminators.iter();
        let unclear = unclear.filter(|terminator| terminator.presence == Presence::Unclear);
        assert_eq!(has("terminator"), unclear.count() > 0);
        assert_eq!(
            has("swap"),
            matches!(setup.adapter, Adapter::TwoWire | Adapter::TwoWireBare)
        );
        assert_eq!(has("zero-inputs"), setup.series == Series::Ip75);
        assert_eq!(has("board"), setup.adapter == Adapter::Apci1710);
    }
    // At 2.5 Mbaud a full-speed FTDI chip cannot, at 115 200 and 230 400 it can.
    let rate = |series, interface| {
        let wiring = wired(series, interface, Battery::None, Adapter::TwoWire);
        let mut warnings = wiring.warnings.into_iter();
        warnings
            .find(|warning| warning.name == "rate")
            .unwrap()
            .text
    };
    assert!(rate(Series::Mpp, Interface::T485).contains("FT232R"));
    let cannot = rate(Series::Mpp, Interface::T485);
    let (_, cannot) = cannot.split_once(" do.").unwrap();
    assert!(
        cannot.contains("FT232R") && !cannot.contains("FT2232H"),
        "{cannot}"
    );
    assert!(!rate(Series::Ip75, Interface::Asi1).contains("cannot"));
}

#[test]
fn links_that_say_little_get_what_fits() {
    let parse = |entries: &'static [(&'static str, &'static str)]| {
        Setup::parse(move |name| {
            let found = entries.iter().find(|(known, _)| *known == name);
            found.map(|(_, value)| *value)
        })
    };
    for (entries, interface, adapter) in [
        (&[][..], Interface::Rs485, Adapter::TwoWire),
        (&[("series", "pt")], Interface::Rs485, Adapter::TwoWire),
        (&[("series", "ip-75")], Interface::Asi1, Adapter::TwoWire),
        (
            &[("series", "ip-75"), ("interface", "ssi7")],
            Interface::Ssi7,
            Adapter::Master,
        ),
        (
            &[("interface", "rs422")],
            Interface::Rs422,
            Adapter::FourWire,
        ),
        (&[("series", "avm58")], Interface::SsiTree, Adapter::Master),
    ] {
        let setup = parse(entries).unwrap();
        assert_eq!((setup.interface, setup.adapter), (interface, adapter));
        assert!(setup.wire().is_ok());
    }
    for (name, entries) in [
        ("series", &[("series", "mpx")][..]),
        ("interface", &[("interface", "rs232")]),
        ("battery", &[("battery", "maybe")]),
        ("adapter", &[("adapter", "usb")]),
    ] {
        let fault = parse(entries).unwrap_err();
        assert_eq!(fault.input, name);
        assert!(fault.message.contains("is none of"), "{fault}");
    }
    for setup in setups() {
        let fits = setup.fitting().contains(&setup.adapter);
        assert_eq!(fits, setup.wire().is_ok(), "{setup:?}");
    }
}

#[test]
fn polarity_is_never_mixed() {
    use Polarity::{Minus, Plus};
    let lines = [
        Line::Supply(Plus),
        Line::Supply(Minus),
        Line::ToEncoder(Plus),
        Line::ToEncoder(Minus),
        Line::FromEncoder(Plus),
        Line::FromEncoder(Minus),
        Line::Shared(Plus),
        Line::Shared(Minus),
        Line::Battery(Plus),
        Line::Battery(Minus),
        Line::Level,
        Line::Unused,
    ];
    let fitting = lines
        .iter()
        .flat_map(|wire| lines.iter().filter(|terminal| wire.fits(**terminal)))
        .count();
    // Each to itself, unused ones to nothing, and what only listens to a shared pair.
    assert_eq!(fitting, lines.len() - 1 + 2);
}
