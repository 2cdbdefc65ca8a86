//! Resistors at the ends of pairs: which are inside, and which the user adds.

use super::{Adapter, Setup};
use crate::{
    language::{msg, t},
    product::{Interface, Series},
};
use alloc::vec::Vec;

/// What a terminator usually has, in ohms: the impedance of a twisted pair (P+F article, figure 4,
/// of the encoder's Clock; MPP and PT name no value).
pub const OHMS: u32 = 120;

/// An end of a cable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The encoder's.
    Encoder,
    /// The controller's or adapter's.
    Controller,
}

/// Whether there is a terminator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// It is inside the device at that end.
    Inside,
    /// It is inside the adapter and is to be switched on.
    Switched,
    /// The user adds it.
    Added,
    /// The manuals contradict each other.
    Unclear,
}

/// A resistor between the wires of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Terminator {
    /// The signals of the two wires, as in [`super::Wire::signal`].
    pub between: (&'static str, &'static str),
    /// Which end it is at.
    pub end: End,
    /// Whether it is there.
    pub presence: Presence,
    /// What to do, or what is said of it.
    pub text: &'static str,
    /// Where that is from.
    pub source: &'static str,
}

type Pair = (&'static str, &'static str);

const fn at(
    between: Pair,
    end: End,
    presence: Presence,
    text: &'static str,
    source: &'static str,
) -> Terminator {
    Terminator {
        between,
        end,
        presence,
        text,
        source,
    }
}

const IN_ENCODER: &str = msg("inside the encoder");

const CLOCK: Pair = ("Clock+", "Clock−");
const DATA: Pair = ("Data+", "Data−");
const MA: Pair = ("MA+", "MA−");
const SLO: Pair = ("SLO+", "SLO−");
const RX: Pair = ("RX+", "RX−");
const TX: Pair = ("TX+", "TX−");
const SHARED: Pair = ("A", "B");
const OUT: Pair = ("OUT DATA+", "OUT DATA−");
const IN: Pair = ("IN CLK+", "IN CLK−");

/// The user's own, at the controller.
const fn own(setup: Setup, between: Pair, source: &'static str) -> Terminator {
    let (presence, text) = match setup.adapter {
        Adapter::TwoWire => (Presence::Switched, msg("the adapter has one")),
        Adapter::TwoWireBare => (
            Presence::Added,
            msg("add one at the terminals of the adapter"),
        ),
        Adapter::FourWire => (
            Presence::Added,
            msg("add one between R+ and R−, unless the adapter has one inside"),
        ),
        Adapter::Master => (
            Presence::Added,
            msg("add one between DATA+ and DATA−, unless the controller has one inside"),
        ),
        Adapter::Apci1710 => (
            Presence::Added,
            msg("add one between Bx+ and Bx−; the article does not say whether the board has one"),
        ),
    };
    at(between, End::Controller, presence, text, source)
}

pub(super) fn of(setup: Setup) -> Vec<Terminator> {
    let inside = |pair, source| at(pair, End::Encoder, Presence::Inside, IN_ENCODER, source);
    match (setup.interface, setup.series) {
        (Interface::Ssi, _) => {
            let source = t("MPP and PT, SSI");
            [inside(CLOCK, source), own(setup, DATA, source)].into()
        }
        (Interface::BissC, _) => {
            let source = t("MPP and PT, BiSS-C");
            [inside(MA, source), own(setup, SLO, source)].into()
        }
        (Interface::Rs422, _) => {
            let source = t("MPP and PT, RS422");
            [inside(RX, source), own(setup, TX, source)].into()
        }
        (Interface::Rs485 | Interface::T485, series) => {
            let source = match setup.interface {
                Interface::T485 => t("MPP and PT, T485"),
                _ => t("MPP and PT, RS485"),
            };
            [shared(series, SHARED, source), own(setup, SHARED, source)].into()
        }
        (Interface::Period, series) => {
            let source = t("MPP and PT, PERIOD");
            [shared(series, TX, source), own(setup, TX, source)].into()
        }
        (Interface::Bus, _) => {
            let source = t("MPP and PT, BUS");
            [inside(SHARED, source), own(setup, SHARED, source)].into()
        }
        (Interface::Asi1 | Interface::Asi4, _) => [own(
            setup,
            OUT,
            t("IP-75, 5.1.2: none inside, add one where needed"),
        )]
        .into(),
        (Interface::Ssi7, _) => {
            let source = t("IP-75, 5.1.3: none inside, add them where needed");
            let text = t("add one at the encoder's end of the cable");
            [
                own(setup, OUT, source),
                at(IN, End::Encoder, Presence::Added, text, source),
            ]
            .into()
        }
        (Interface::SsiTree, _) => {
            let source = t("P+F article, figure 4");
            [inside(CLOCK, source), own(setup, DATA, source)].into()
        }
    }
}

/// At the encoder, where MPP and PT contradict each other: they are the same electronics.
const fn shared(series: Series, between: Pair, source: &'static str) -> Terminator {
    let text = match series {
        Series::Pt => msg(
            "inside the encoder, says PT; MPP, the same electronics, says only that both ends \
             must be terminated. With the power off and the adapter unplugged, about \
             120 Ω between the two wires show it",
        ),
        _ => msg(
            "MPP says only that both ends must be terminated; PT, the same electronics, says that \
             the encoder has one inside. With the power off and the adapter unplugged, about 120 Ω \
             between the two wires show it; add one only where they are not",
        ),
    };
    at(between, End::Encoder, Presence::Unclear, text, source)
}
