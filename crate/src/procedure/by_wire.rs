//! Zeros that are set by inputs: IP-75, and Pepperl+Fuchs.

use super::{Missing, Procedure, STILL, Step, Zero};
use crate::{
    language::{msg, t},
    product::Interface,
    session::Micros,
    text,
};
use alloc::{format, string::String, vec::Vec};

/// How long the zero inputs of IP-75 are held after power-on, in microseconds (IP-75, 5.1.1).
pub const HOLD: Micros = 3_000_000;

const SOURCE: &str = msg("IP-75, 5.1.1");

pub(super) fn ip75(interface: Interface) -> Zero {
    // Only ASI1 carries ZPD.
    let has_zpd = interface == Interface::Asi1;
    let seconds = HOLD / 1_000_000;
    let shown = |zpd: &str, angle: &str| -> String {
        match has_zpd {
            true => format!("{zpd}; {angle}"),
            false => angle.into(),
        }
    };
    let silence = match interface {
        Interface::Ssi7 => t("no word can be read"),
        _ => t("the stream stops"),
    };
    let steps = |wire: &str, sign: String| {
        [
            Step::by_hand(t("Switch the supply off."), silence, SOURCE),
            Step::by_hand(
                text!("Join {} with 0 V (black).", wire),
                t("nothing yet: the input acts at power-on"),
                SOURCE,
            ),
            Step::by_hand(
                text!(
                    "Switch the supply on and keep the wire there for {} s.",
                    seconds
                ),
                sign,
                SOURCE,
            ),
            Step::by_hand(
                t("Take the wire off 0 V and insulate it."),
                t("the zero is stored and stays without power"),
                SOURCE,
            ),
        ]
    };
    let console = match interface {
        Interface::Asi1 | Interface::Asi4 => Some(interface.format().default_profile()),
        _ => None,
    };
    let late = t("After those seconds the inputs do nothing: a wire joined later changes nothing.");
    let still = Step::by_hand(t(STILL.0), t(STILL.1), t("IP-75, table 1"));
    let set = Procedure {
        name: "zero-set",
        title: t("Set the zero with ZERO SET (violet)"),
        about: t("The present position becomes 0."),
        steps: [still]
            .into_iter()
            .chain(steps(
                t("ZERO SET (violet)"),
                shown(t("ZPD becomes 0"), t("the angle is 0")),
            ))
            .collect(),
        notes: [late].into(),
        change: None,
        console,
    };
    let reset = Procedure {
        name: "zero-reset",
        title: t("Back to the factory's zero with ZERO RESET (yellow)"),
        about: t("The offset that was set is forgotten."),
        steps: steps(
            t("ZERO RESET (yellow)"),
            shown(t("ZPD becomes 1"), t("the angle is the factory's again")),
        )
        .into(),
        notes: [late].into(),
        change: None,
        console,
    };
    let commands = Missing {
        text: t("The encoder listens to no command: only its two inputs set the zero."),
        source: t(SOURCE),
    };
    let zpd = Missing {
        text: t(
            "Only ASI1 has the bit ZPD; with this interface the angle alone shows what has \
               happened.",
        ),
        source: t("IP-75, 5.3 and 5.4"),
    };
    Zero {
        procedures: [set, reset].into(),
        missing: match has_zpd {
            true => Vec::from([commands]),
            false => Vec::from([commands, zpd]),
        },
    }
}

pub(super) fn preset() -> Zero {
    let source = t("P+F article, \"Preset function\"");
    let table = t("P+F article, table 6");
    let steps = [
        Step::by_hand(
            t("Read the label: the model must not end in -H."),
            t("a model without -H has the input PRESET1"),
            table,
        ),
        Step::by_hand(
            t(
                "Put V/R at the level that the machine will run with: logic 1 counts down clockwise, \
             logic 0 up.",
            ),
            t("the code falls or rises as wanted when the shaft turns clockwise"),
            t("P+F article, \"Counting direction\""),
        ),
        Step::by_hand(t(STILL.0), t("the code stands still"), source),
        Step::by_hand(
            t("Give the signal on PRESET1."),
            t("the code is 0 in this direction"),
            source,
        ),
    ];
    let preset = Procedure {
        name: "preset",
        title: t("Preset with PRESET1"),
        about: t("The code becomes 0 in the present counting direction."),
        steps: steps.into(),
        notes: [
            t("The scale of the other direction moves by the value that was there before: at 1000 \
             before the preset, by 1000."),
            t("Change V/R afterwards, and the code at the same place is not 0."),
        ]
        .into(),
        change: None,
        console: None,
    };
    Zero {
        procedures: [preset].into(),
        missing: [
            Missing {
                text: t("Models -H have no PRESET1: take an offset off in the controller."),
                source: table,
            },
            Missing {
                text: t(
                    "The article gives no level, no duration and no pin for PRESET1: they are \
                       on the sheet of the model.",
                ),
                source: table,
            },
        ]
        .into(),
    }
}
