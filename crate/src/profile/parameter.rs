//! The table of parameters.

use super::{
    Align, Choice, Code, Dialect, Justify, Marker, Parity, Profile, StatusActive, TurnsCode,
};
use crate::{
    format::{
        own::{self, Own},
        rs485::Command,
        said,
    },
    record::Value,
    text,
};
use alloc::string::{String, ToString};

/// A parameter: what it is, its words and what they mean where it is not a number, and how it is
/// written and read.
pub(super) struct Parameter {
    pub(super) name: &'static str,
    pub(super) doc: &'static str,
    pub(super) words: &'static [&'static str],
    pub(super) docs: &'static [&'static str],
    pub(super) show: fn(&Profile) -> Value,
}

/// Reads a text into its place in a profile.
pub(super) type Setter = fn(&mut Profile, &str) -> Result<(), String>;

/// Makes the table and the readers from the same rows. They are apart because whoever only writes
/// a profile, such as the first view of a page, needs none of what reading takes.
macro_rules! parameters {
    ($(Parameter {
        name: $name:literal,
        doc: $doc:expr,
        words: $words:expr,
        docs: $docs:expr,
        show: $show:expr,
        set: $set:expr,
    }),* $(,)?) => {
        pub(super) const PARAMETERS: &[Parameter] = &[$(Parameter {
            name: $name,
            doc: $doc,
            words: $words,
            docs: $docs,
            show: $show,
        }),*];

        /// What reads the parameter of a name.
        pub(super) fn setter(name: &str) -> Option<Setter> {
            match name {
                $($name => {
                    let set: Setter = $set;
                    Some(set)
                })*
                _ => None,
            }
        }
    };
}

const fn listed(texts: &'static [&'static str]) -> &'static [&'static str] {
    if cfg!(feature = "small") { &[] } else { texts }
}

parameters! {
    Parameter {
        name: "layout",
        doc: said("a layout of one's own, or the name of one that comes with the program"),
        words: &[],
        docs: &[],
        show: |p| p.own.map_or("", Own::short).into(),
        set: |p, text| own::of(text).map(|own| own.fit(p)),
    },
    Parameter {
        name: "angle-bits",
        doc: said("bits per turn"),
        words: &[],
        docs: &[],
        show: |p| p.angle_bits.into(),
        set: |p, text| number(text).map(|value| p.angle_bits = value),
    },
    Parameter {
        name: "turns-bits",
        doc: said("bits of the turn counter; 0 for a single turn"),
        words: &[],
        docs: &[],
        show: |p| p.turns_bits.into(),
        set: |p, text| number(text).map(|value| p.turns_bits = value),
    },
    Parameter {
        name: "status-bits",
        doc: said("status bits in front of the CRC"),
        words: &[],
        docs: &[],
        show: |p| p.status_bits.into(),
        set: |p, text| number(text).map(|value| p.status_bits = value),
    },
    Parameter {
        name: "ack-bits",
        doc: said("zeros in front of the start bit while the encoder gets its data ready"),
        words: &[],
        docs: &[],
        show: |p| p.ack_bits.into(),
        set: |p, text| number(text).map(|value| p.ack_bits = value),
    },
    Parameter {
        name: "command",
        doc: said("the command whose replies are read"),
        words: &["0", "1", "d", "s", "t"],
        docs: listed(&[
            Command::Zero.title(),
            Command::Position.title(),
            Command::Status.title(),
            Command::Speed.title(),
            Command::Temperature.title(),
        ]),
        show: |p| p.command.letter().to_string().into(),
        set: |p, text| {
            Command::parse(text)
                .map(|value| p.command = value)
                .ok_or_else(|| text!("\"{}\" is no command; known: 0 1 d s t", text))
        },
    },
    Parameter {
        name: "address",
        doc: said("address of the device"),
        words: &[],
        docs: &[],
        show: |p| p.address.into(),
        set: |p, text| number(text).map(|value| p.address = value),
    },
    Parameter {
        name: "code",
        doc: said("how the word stands for a number"),
        words: Code::WORDS,
        docs: listed(Code::DOCS),
        show: |p| p.code.word().into(),
        set: |p, text| chosen(text).map(|value| p.code = value),
    },
    Parameter {
        name: "align",
        doc: said("where the number stands in the word"),
        words: Align::WORDS,
        docs: listed(Align::DOCS),
        show: |p| p.align.word().into(),
        set: |p, text| chosen(text).map(|value| p.align = value),
    },
    Parameter {
        name: "frame-bits",
        doc: said("bits of the word"),
        words: &[],
        docs: &[],
        show: |p| p.frame_bits.into(),
        set: |p, text| number(text).map(|value| p.frame_bits = value),
    },
    Parameter {
        name: "parity",
        doc: said("how the parity bit is computed"),
        words: Parity::WORDS,
        docs: listed(Parity::DOCS),
        show: |p| p.parity.word().into(),
        set: |p, text| chosen(text).map(|value| p.parity = value),
    },
    Parameter {
        name: "turns-code",
        doc: said("how the turn counter is read"),
        words: TurnsCode::WORDS,
        docs: listed(TurnsCode::DOCS),
        show: |p| p.turns_code.word().into(),
        set: |p, text| chosen(text).map(|value| p.turns_code = value),
    },
    Parameter {
        name: "status-active",
        doc: said("which level of a status bit says that the condition is there"),
        words: StatusActive::WORDS,
        docs: listed(StatusActive::DOCS),
        show: |p| p.status_active.word().into(),
        set: |p, text| chosen(text).map(|value| p.status_active = value),
    },
    Parameter {
        name: "dialect",
        doc: said("what the alarm byte means, and which requests are known"),
        words: Dialect::WORDS,
        docs: listed(Dialect::DOCS),
        show: |p| p.dialect.word().into(),
        set: |p, text| chosen(text).map(|value| p.dialect = value),
    },
    Parameter {
        name: "marker",
        doc: said("top bits of the bytes that are sent; any are accepted"),
        words: Marker::WORDS,
        docs: listed(Marker::DOCS),
        show: |p| p.marker.word().into(),
        set: |p, text| chosen(text).map(|value| p.marker = value),
    },
    Parameter {
        name: "baud",
        doc: said("bits a second on the line"),
        words: &[],
        docs: &[],
        show: |p| p.baud.into(),
        set: |p, text| number(text).map(|value| p.baud = value),
    },
    Parameter {
        name: "justify",
        doc: said("on which side the bits of a dump stand in its bytes"),
        words: Justify::WORDS,
        docs: listed(Justify::DOCS),
        show: |p| p.justify.word().into(),
        set: |p, text| chosen(text).map(|value| p.justify = value),
    },
}

fn chosen<T: Choice>(text: &str) -> Result<T, String> {
    T::of_word(text)
        .ok_or_else(|| text!("\"{}\" is not known; known: {}", text, T::WORDS.join(" ")))
}

fn number(text: &str) -> Result<u32, String> {
    text.parse()
        .map_err(|_| text!("\"{}\" is not a whole number", text))
}
