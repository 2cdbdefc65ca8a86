//! What to beware of, each with its source.

use super::{Adapter, Battery, Setup, Warning};
use crate::{
    adapter::{CHIPS, Made},
    explain::grouped,
    format::Link,
    language::t,
    product::{Interface, Series, facts::SUPPLY},
    text,
};
use alloc::{format, string::String, vec::Vec};

pub(super) fn of(setup: Setup) -> Vec<Warning> {
    let mut said = Vec::new();
    let mut say = |name, source, text: String| said.push(Warning { name, text, source });
    let (source, text) = supply(setup.series);
    say("supply", source, text);
    let battery = setup.series.fact("battery").map(|fact| t(fact.value));
    if let (Battery::Fitted, Some(volts)) = (setup.battery, battery) {
        say(
            "battery",
            t("MPP and PT, notes to the pins; characteristics"),
            text!(
                "The battery has {}. Its minus is joined to 0 V inside the encoder: one \
                 battery for several encoders joins their 0 V too.",
                volts
            ),
        );
    }
    for (name, source, text) in interface(setup) {
        say(name, source, text);
    }
    if let Some(text) = rate(setup) {
        say("rate", t("AN232B-05; Linux ftdi_sio; makers' tables"), text);
    }
    for (name, source, text) in connection(setup.series) {
        say(name, source, text);
    }
    said
}

/// No series takes the supply of another.
fn supply(series: Series) -> (&'static str, String) {
    let volts = |series: Series| series.fact(SUPPLY).map_or("", |fact| t(fact.value));
    let others = [Series::Mpp, Series::Ip75, Series::Avs58].into_iter();
    let others: Vec<String> = others
        .filter(|other| volts(*other) != volts(series))
        .map(|other| {
            let name = match other {
                Series::Mpp => t("MPP and PT"),
                Series::Avs58 => "Pepperl+Fuchs",
                other => t(other.name()),
            };
            format!("{name} {}", volts(other))
        })
        .collect();
    let text = text!(
        "{} takes {} at the encoder. Others do not take the same: {}.",
        t(series.name()),
        volts(series),
        others.join(", ")
    );
    let source = t("MPP and PT, characteristics; IP-75, table 1; P+F article, table 6");
    (source, text)
}

type Advice = (&'static str, &'static str, String);

fn interface(setup: Setup) -> Vec<Advice> {
    let mut said: Vec<Advice> = Vec::new();
    if matches!(setup.adapter, Adapter::TwoWire | Adapter::TwoWireBare) {
        let plus = match setup.interface {
            Interface::Rs485 | Interface::T485 | Interface::Bus => t(
                "The manuals have A on the pin that is plus with every other interface, so A goes \
                 to D+",
            ),
            _ => t("The plus of the encoder goes to D+, whatever letter stands beside it"),
        };
        said.push((
            "swap",
            match setup.series {
                Series::Ip75 => t("IP-75, table 2; Wikipedia, RS-485, \"Signals\""),
                _ => t("MPP and PT, table of pins; Wikipedia, RS-485, \"Signals\""),
            },
            text!(
                "Makers of adapters do not agree which of A and B is plus. {}. If nothing \
                 comes, or only nonsense, swap the two wires.",
                plus
            ),
        ));
    }
    match setup.interface {
        Interface::Period => said.push((
            "tx-only",
            t("MPP and PT, PERIOD and table of pins"),
            t("PERIOD sends unasked and listens to nothing: TX+ and TX− are enough, and the adapter \
             must never send. The manuals' text calls the wires A and B, their tables have TX+ \
             and TX− on pins 5 and 6: the table is right, as PERIOD is said to be RS422's TX.")
                .into(),
        )),
        Interface::Asi1 | Interface::Asi4 => said.push((
            "tx-only",
            t("IP-75, 5.3"),
            t("The stream comes unasked, and the encoder listens to nothing: the adapter must never \
             send.")
                .into(),
        )),
        Interface::Bus => said.push((
            "bus",
            t("MPP and PT, BUS"),
            t("Every encoder has its terminator inside, so that several on a wire stand in \
             parallel; the manuals do not say how to take one out. Keep the stubs short, and ask \
             the maker for more than two.")
                .into(),
        )),
        Interface::Ssi | Interface::BissC | Interface::Ssi7 | Interface::SsiTree => said.push((
            "clocked",
            t("MPP and PT, SSI and BiSS-C; IP-75, 5.4.1; P+F article"),
            t("The encoder sends only what is clocked out of it: a USB–RS485 or RS422 adapter \
             cannot read it at all.")
                .into(),
        )),
        Interface::Rs422 | Interface::Rs485 | Interface::T485 => {}
    }
    if matches!(
        setup.interface,
        Interface::Rs485 | Interface::T485 | Interface::Period
    ) {
        said.push((
            "terminator",
            t("MPP and PT, RS485, T485 and PERIOD"),
            t(
                "MPP and PT contradict each other: MPP asks for terminators at both ends and names \
             none inside, PT has the encoder's inside. Measure before adding a third.",
            )
            .into(),
        ));
    }
    if (setup.interface, setup.battery) == (Interface::Bus, Battery::Fitted) {
        said.push((
            "bus-battery",
            t("MPP and PT, BUS and table of pins"),
            t("The table of pins has the battery with BUS as well, but BUS lists only models XX-D \
             and XXM-D: make sure that the label says BM.")
                .into(),
        ));
    }
    if setup.adapter == Adapter::Apci1710 {
        said.push((
            "board",
            t("P+F article, table 3 and figure 5; Linux, comedi"),
            t(
                "x is the number of the module, 0…3. The clock is common to three encoders, whose \
             data go to Bx (DATA 1), Cx (DATA 2) and Dx (DATA 3). Table 3 names no ground; join \
             the board's with the 0 V of the supply. The shift registers hold 32 bits: longer \
             words do not fit.",
            )
            .into(),
        ));
    }
    if setup.series == Series::Ip75 {
        said.push((
            "zero-inputs",
            t("IP-75, 5.1.1"),
            t(
                "ZERO SET and ZERO RESET act at power-on: a wire that touches 0 V then changes the \
             zero. Insulate both.",
            )
            .into(),
        ));
    }
    said
}

/// Which chips make the rate.
fn rate(setup: Setup) -> Option<String> {
    let format = setup.interface.format();
    if format.spec().link == Link::Clocked {
        return None;
    }
    let baud = format.default_profile().baud;
    let chips = |wanted: fn(Made) -> bool| {
        let names = CHIPS.iter().filter(|chip| wanted(chip.made(baud)));
        names.map(|chip| chip.name).collect::<Vec<_>>().join(", ")
    };
    let able = chips(|made| matches!(made, Made::Rate(_) | Made::Listed));
    let not = chips(|made| matches!(made, Made::Not(_)));
    let not = match not.is_empty() {
        true => String::new(),
        false => text!(" {} cannot, and their drivers do not say so.", not),
    };
    let option = match setup.interface {
        Interface::Rs485 | Interface::Rs422 => {
            t(" With option A in the order code it is 115 200 baud, which all of them make.")
        }
        _ => "",
    };
    Some(text!(
        "The adapter must make {} baud: {} do.{} Others: measure.{}",
        grouped(baud.into()),
        able,
        not,
        option
    ))
}

fn connection(series: Series) -> Vec<Advice> {
    let shield = (
        "shield",
        t("MPP and PT, notes to the pins"),
        t("Ground the shield at the controller's end.").into(),
    );
    match series {
        Series::Mpp => [
            shield,
            (
                "connector",
                t("MPP, \"Connectors\""),
                t("The connector is SM08-SURS-TF with four twisted pairs AWG32, or Molex \
                 504050-0891 with four shielded twisted pairs AWG28. Keep plus and minus of a \
                 signal in one pair.")
                    .into(),
            ),
        ]
        .into(),
        Series::Pt => [
            shield,
            (
                "connector",
                t("PT, \"Size\" and \"Pin\""),
                t("Sizes 20 to 35 have the connector SM08-SURS-TF with eight contacts. Sizes 10 and \
                 15 have SM06B-XSRS-ETB with six, and the manual's table of pins has eight: go by \
                 the colours, and ask the maker before wiring a battery there.")
                    .into(),
            ),
        ]
        .into(),
        Series::Ip75 => [(
            "connector",
            t("IP-75, 5.1.2 and 5.1.3"),
            t("The cable is AWG24 without a connector; the manual says nothing of a shield.").into(),
        )]
        .into(),
        Series::Avs58 | Series::Avm58 | Series::Ass58 | Series::Asm58 => [
            (
                "pins",
                t("P+F article"),
                t("The article names signals, but no pins, no colours, and no levels for PRESET1: \
                 they are on the sheet of the model. Models -H have no PRESET1; of V/R the text \
                 says that they lack it, table 6 that they have it.")
                    .into(),
            ),
            (
                "shield",
                t("P+F article, rules of installation"),
                t("Connect the shield over a large area; where the two ends are not at one \
                 potential, directly at one end and through a capacitor at the other. Six wires \
                 are needed, the pairs twisted, of at least 0.22 mm².")
                    .into(),
            ),
        ]
        .into(),
    }
}
