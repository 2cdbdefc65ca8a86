//! What does not exist, or cannot work together.

use super::{Adapter, Battery, Setup};
use crate::{
    calculator::Fault,
    format::Link,
    language::t,
    product::{Interface, Series},
    text,
};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};

pub(super) fn check(setup: Setup) -> Result<(), Fault> {
    let fault = |input, message: String| Err(Fault { input, message });
    exists(setup.series, setup.interface)?;
    if let (Battery::Fitted, Some(message)) = (setup.battery, no_battery(setup.series)) {
        return fault("battery", message.to_string());
    }
    match no_link(setup) {
        Some(message) => fault("adapter", message),
        None => Ok(()),
    }
}

/// Whether a series comes with an interface.
pub(crate) fn exists(series: Series, interface: Interface) -> Result<(), Fault> {
    if series.interfaces().contains(&interface) {
        return Ok(());
    }
    let known: Vec<_> = series
        .interfaces()
        .iter()
        .map(|known| t(known.title()))
        .collect();
    Err(Fault {
        input: "interface",
        message: text!(
            "{} does not come with {}, only with {}",
            t(series.name()),
            t(interface.title()),
            known.join(", ")
        ),
    })
}

fn no_battery(series: Series) -> Option<&'static str> {
    match series {
        Series::Mpp | Series::Pt => None,
        Series::Ip75 => Some(t("IP-75 counts no turns and has no wires for a battery")),
        Series::Avs58 | Series::Ass58 => Some(t(
            "a single-turn encoder has no turns that a battery could keep",
        )),
        Series::Avm58 | Series::Asm58 => Some(t(
            "these encoders count their turns with gears, which need no battery (P+F article)",
        )),
    }
}

fn no_link(setup: Setup) -> Option<String> {
    let name = t(setup.interface.title());
    let link = setup.interface.format().spec().link;
    match (link, setup.interface, setup.adapter) {
        (Link::Clocked, Interface::BissC, Adapter::Apci1710) => Some(
            t("the module of the board clocks SSI words of a fixed length, and BiSS-C begins its \
             data with a start bit and answers with a CRC: use a BiSS master")
                .into(),
        ),
        (Link::Clocked, _, Adapter::Master | Adapter::Apci1710) => None,
        (Link::Clocked, ..) => Some(text!("a USB adapter cannot read {}: it has no clock to send, and the encoder says \
             nothing without one. Use an SSI or BiSS master, or record the wires with a logic \
             analyser", name)),
        (_, _, Adapter::Master | Adapter::Apci1710) => Some(text!("{} is a serial line of bytes without a clock: a master for SSI or BiSS cannot \
             read it. Use a USB–{} adapter", name, match setup.interface {
                Interface::Rs422 => "RS422",
                _ => "RS485",
            })),
        (_, Interface::Rs422, Adapter::TwoWire | Adapter::TwoWireBare) => Some(
            t("an RS422 encoder listens on RX and talks on TX, and a two-wire adapter has one pair: \
             on TX+ and TX− it would hear, but nothing is sent unasked; on RX+ and RX− it would \
             ask and hear nothing; and joining both pairs sets two transmitters against each \
             other. Use a four-wire RS422 adapter, or order the encoder with R, RS485")
                .into(),
        ),
        (_, Interface::Rs485 | Interface::T485 | Interface::Bus, Adapter::FourWire) => {
            Some(text!("{} answers on the pair on which it is asked, and an RS422 adapter drives T+ \
                 and T− all the time. Only an adapter that can let go of the pair, in a mode \
                 called RS485, half duplex or two-wire, will do: join T+ with R+ and T− with R− \
                 there, and read on under a two-wire adapter", name))
        }
        _ => None,
    }
}
