//! The tables of pins and colours, supplies, and the terminals at the other end.

use super::{
    Adapter, Battery, Colour,
    Line::{self, FromEncoder, Level, Shared, ToEncoder, Unused},
    Paint, Place,
    Polarity::{Minus, Plus},
    Setup, Shield, Terminal, Wire,
};
use crate::{
    language::{msg, t},
    product::{Interface, Series},
};
use alloc::vec::Vec;

/// MPP and PT have the same pins and other colours (MPP and PT, "Pin").
const PAINTS: [(Paint, Paint); 8] = {
    const fn same(colour: Colour) -> (Paint, Paint) {
        (Paint::plain(colour), Paint::plain(colour))
    }
    [
        same(Colour::Red),
        same(Colour::Black),
        (Paint::plain(Colour::Green), Paint::plain(Colour::Blue)),
        (
            Paint::striped(Colour::Green, Colour::Black),
            Paint::plain(Colour::Green),
        ),
        same(Colour::Yellow),
        (
            Paint::striped(Colour::Yellow, Colour::Black),
            Paint::plain(Colour::Orange),
        ),
        same(Colour::White),
        (
            Paint::striped(Colour::White, Colour::Black),
            Paint::plain(Colour::Gray),
        ),
    ]
};

const NOT_USED: &str = msg("not used with this interface: insulate the end");
const ZERO_INPUT: &str =
    msg("to 0 V before power-on, and only to set or reset the zero; open otherwise");

type Signal = (&'static str, Line);

const UNUSED: Signal = ("–", Unused);

/// The signals of pins 3 to 6 of MPP and PT.
const fn signals(interface: Interface) -> [Signal; 4] {
    match interface {
        Interface::BissC => [
            ("MA+", ToEncoder(Plus)),
            ("MA−", ToEncoder(Minus)),
            ("SLO+", FromEncoder(Plus)),
            ("SLO−", FromEncoder(Minus)),
        ],
        Interface::Rs422 => [
            ("RX+", ToEncoder(Plus)),
            ("RX−", ToEncoder(Minus)),
            ("TX+", FromEncoder(Plus)),
            ("TX−", FromEncoder(Minus)),
        ],
        Interface::Rs485 | Interface::T485 | Interface::Bus => {
            [("A", Shared(Plus)), ("B", Shared(Minus)), UNUSED, UNUSED]
        }
        Interface::Period => [
            UNUSED,
            UNUSED,
            ("TX+", FromEncoder(Plus)),
            ("TX−", FromEncoder(Minus)),
        ],
        Interface::Ssi
        | Interface::SsiTree
        | Interface::Asi1
        | Interface::Asi4
        | Interface::Ssi7 => [
            ("Clock+", ToEncoder(Plus)),
            ("Clock−", ToEncoder(Minus)),
            ("Data+", FromEncoder(Plus)),
            ("Data−", FromEncoder(Minus)),
        ],
    }
}

/// The signals of IP-75 between supply and zero inputs, with their colours (IP-75, 5.1.2 and
/// 5.1.3).
const OUT: [(Colour, Signal); 2] = [
    (Colour::Green, ("OUT DATA+", FromEncoder(Plus))),
    (Colour::Orange, ("OUT DATA−", FromEncoder(Minus))),
];
const CLOCK: [(Colour, Signal); 2] = [
    (Colour::Blue, ("IN CLK+", ToEncoder(Plus))),
    (Colour::Brown, ("IN CLK−", ToEncoder(Minus))),
];
const ZERO: [(Colour, Signal); 2] = [
    (Colour::Violet, ("ZERO SET", Level)),
    (Colour::Yellow, ("ZERO RESET", Level)),
];

const fn terminal(place: Place, name: &'static str, line: Line) -> Terminal {
    Terminal { place, name, line }
}

const SUPPLY_PLUS: Terminal = terminal(Place::Supply, "+", Line::Supply(Plus));
const SUPPLY_MINUS: Terminal = terminal(Place::Supply, "−", Line::Supply(Minus));

const fn wire(signal: Signal, goes: Option<Terminal>) -> Wire {
    let note = match signal.1 {
        Unused => NOT_USED,
        _ => "",
    };
    Wire {
        pin: None,
        paint: None,
        signal: signal.0,
        line: signal.1,
        goes,
        note,
    }
}

/// The wires of an encoder, those of the signals not yet connected.
pub(super) fn of(setup: Setup) -> Vec<Wire> {
    let supplied = |plus, minus| {
        [
            wire((plus, Line::Supply(Plus)), Some(SUPPLY_PLUS)),
            wire((minus, Line::Supply(Minus)), Some(SUPPLY_MINUS)),
        ]
    };
    match setup.series {
        Series::Mpp | Series::Pt => {
            let signals = signals(setup.interface).map(|signal| wire(signal, None));
            let mut wires: Vec<Wire> = supplied(msg("+5 V"), msg("0 V"))
                .into_iter()
                .chain(signals)
                .collect();
            if setup.battery == Battery::Fitted {
                wires.extend(battery());
            }
            numbered(&mut wires);
            for (wire, (mpp, pt)) in wires.iter_mut().zip(PAINTS) {
                wire.paint = Some(if setup.series == Series::Mpp { mpp } else { pt });
            }
            wires
        }
        Series::Ip75 => {
            let clock: &[_] = match setup.interface {
                Interface::Ssi7 => &CLOCK,
                _ => &[],
            };
            let colours = [Colour::Red, Colour::Black];
            let supply = supplied(msg("supply +"), msg("0 V"))
                .into_iter()
                .zip(colours);
            let painted = |wire: Wire, colour| Wire {
                paint: Some(Paint::plain(colour)),
                ..wire
            };
            let switch = terminal(Place::Switch, msg("0 V or open"), Level);
            let zero = |(colour, signal)| {
                let wire = wire(signal, Some(switch));
                let note = ZERO_INPUT;
                painted(Wire { note, ..wire }, colour)
            };
            let mut wires: Vec<Wire> = supply
                .map(|(wire, colour)| painted(wire, colour))
                .chain(
                    OUT.iter()
                        .chain(clock)
                        .map(|(colour, signal)| painted(wire(*signal, None), *colour)),
                )
                .chain(ZERO.map(zero))
                .collect();
            numbered(&mut wires);
            wires
        }
        Series::Avs58 | Series::Avm58 | Series::Ass58 | Series::Asm58 => {
            let direction = Wire {
                note: msg("logic 1 counts down clockwise, logic 0 up (TTL)"),
                ..wire(
                    ("V/R", Level),
                    Some(terminal(Place::Switch, msg("0 or 1"), Level)),
                )
            };
            let preset = Wire {
                note: msg("sets the zero; not on models -H"),
                ..wire(
                    ("PRESET1", Level),
                    Some(terminal(Place::Switch, msg("button"), Level)),
                )
            };
            supplied(msg("supply +"), "GND")
                .into_iter()
                .chain(signals(Interface::SsiTree).map(|signal| wire(signal, None)))
                .chain([direction, preset])
                .collect()
        }
    }
}

fn battery() -> [Wire; 2] {
    let plus = Line::Battery(Plus);
    let minus = Line::Battery(Minus);
    [
        wire(
            (msg("Battery+"), plus),
            Some(terminal(Place::Battery, "+", plus)),
        ),
        Wire {
            note: msg("joined to 0 V inside the encoder"),
            ..wire(
                (msg("Battery−"), minus),
                Some(terminal(Place::Battery, "−", minus)),
            )
        },
    ]
}

fn numbered(wires: &mut [Wire]) {
    for (wire, pin) in wires.iter_mut().zip(1..) {
        wire.pin = Some(pin);
    }
}

impl Adapter {
    /// Its terminals for signals.
    const fn terminals(self) -> &'static [(&'static str, Line)] {
        match self {
            Self::TwoWire | Self::TwoWireBare => {
                &[("A (D+)", Shared(Plus)), ("B (D−)", Shared(Minus))]
            }
            Self::FourWire => &[
                ("T+", ToEncoder(Plus)),
                ("T−", ToEncoder(Minus)),
                ("R+", FromEncoder(Plus)),
                ("R−", FromEncoder(Minus)),
            ],
            Self::Master => &[
                ("CLK+", ToEncoder(Plus)),
                ("CLK−", ToEncoder(Minus)),
                ("DATA+", FromEncoder(Plus)),
                ("DATA−", FromEncoder(Minus)),
            ],
            // P+F article, table 3: CLOCK_x and DATA 1_x of module x.
            Self::Apci1710 => &[
                ("Ax+ CLOCK", ToEncoder(Plus)),
                ("Ax− CLOCK", ToEncoder(Minus)),
                ("Bx+ DATA 1", FromEncoder(Plus)),
                ("Bx− DATA 1", FromEncoder(Minus)),
            ],
        }
    }

    /// The terminal that a signal fits.
    pub(super) fn terminal(self, line: Line) -> Option<Terminal> {
        let found = self.terminals().iter().find(|(_, other)| line.fits(*other));
        found.map(|(name, line)| terminal(Place::Adapter, name, *line))
    }

    pub(super) const fn ground(self) -> Option<Terminal> {
        match self {
            Self::Apci1710 => None,
            _ => Some(terminal(Place::Adapter, "GND", Line::Supply(Minus))),
        }
    }
}

pub(super) const fn shield(series: Series) -> Shield {
    match series {
        Series::Mpp | Series::Pt => Shield::AtController,
        Series::Ip75 => Shield::Unsaid,
        Series::Avs58 | Series::Avm58 | Series::Ass58 | Series::Asm58 => Shield::Depends,
    }
}

pub(super) fn source(setup: Setup) -> &'static str {
    match (setup.series, setup.interface) {
        (Series::Mpp, _) => t("MPP, \"Connection\", table of contacts"),
        (Series::Pt, _) => t("PT, \"Electrical connection\", table of pins"),
        (Series::Ip75, Interface::Ssi7) => t("IP-75, 5.1.3"),
        (Series::Ip75, _) => t("IP-75, 5.1.2, table 2"),
        _ => t(
            "P+F article: signals only, no pins and no colours; those are on the encoder's own sheet",
        ),
    }
}
