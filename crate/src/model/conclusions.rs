//! What follows from an order code beyond the profile.

use super::{Model, Place, Says, Token, Turns};
use crate::{
    bits::low_byte,
    decode::Decoder,
    dump::Direction,
    format::{
        Format, Medium,
        bus::{self, Operation},
        rs485, t485,
    },
    language::t,
    layout::Role,
    product::{Interface, Series, facts, sizes},
    record::Record,
    text,
};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};

/// What an encoder can be asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Request {
    /// Its first byte.
    pub byte: u8,
    /// What it asks for, in a few words.
    pub title: &'static str,
    /// Whether the encoder may hold something else afterwards.
    pub changes_encoder: bool,
}

impl Model {
    /// The series in words; both, where the code does not say which.
    ///
    /// ```
    /// use encoderscope::model::parse;
    /// assert_eq!(parse("AVM58-H").unwrap().series_name(), "AVM58");
    /// assert_eq!(parse("17M-T").unwrap().series_name(), "MPP or PT");
    /// ```
    #[must_use]
    pub fn series_name(&self) -> &'static str {
        self.series.map_or(self.form.title, Series::name)
    }

    /// Whether it has wires for a battery (MPP and PT, pin table, note 1).
    #[must_use]
    pub fn has_battery(&self) -> bool {
        self.turns == Turns::Battery
    }

    /// The least and the greatest working temperature in °C; none where the code does not say.
    #[must_use]
    pub fn temperature(&self) -> Option<(i32, i32)> {
        let mut says = self.tokens.iter().map(|token| token.word.says);
        says.find_map(|says| match says {
            Says::Temperature(least, most) => Some((least, most)),
            Says::Series(Series::Ip75) => Some((-40, 80)),
            Says::Series(Series::Avs58 | Series::Avm58 | Series::Ass58 | Series::Asm58) => {
                Some((-40, 85))
            }
            _ => None,
        })
    }

    /// The row of the manual's size table; none where it has no such row.
    #[must_use]
    pub fn size(&self) -> Option<&'static sizes::Size> {
        let text = |place| self.token(place).map(Token::text);
        let (rotor, stator) = (text(Place::Rotor)?, text(Place::Stator)?);
        sizes::SIZES.iter().find(|size| {
            Some(size.series) == self.series && size.rotor == rotor && size.stator == stator
        })
    }

    /// Bits of the frame that is read most, as the manuals count them: of BiSS-C from the turns to
    /// the CRC, without acknowledge, start and zero (CRC-6 program). None where the length
    /// changes with the number.
    ///
    /// ```
    /// use encoderscope::model::parse;
    /// assert_eq!(parse("17M").unwrap().frame_bits(), Some(47));
    /// assert_eq!(parse("16").unwrap().frame_bits(), Some(30));
    /// assert_eq!(parse("IP-75-ASI4").unwrap().frame_bits(), None);
    /// ```
    #[must_use]
    pub fn frame_bits(&self) -> Option<usize> {
        if self.profile.medium() == Medium::Text {
            return None;
        }
        let kinds = Decoder::new(self.profile).ok()?.frame_kinds();
        let frames = kinds
            .iter()
            .filter(|kind| kind.direction == Direction::Received && kind.name != "twice");
        let lengths = frames.map(|kind| match self.profile.format {
            Format::BissC => {
                let fields = kind.layout.fields();
                let data = fields.filter(|field| field.row.role != Role::Framing);
                data.map(|field| field.width as usize).sum()
            }
            _ => kind.example.as_bits().len(),
        });
        lengths.max()
    }

    /// What it can be asked; nothing where it sends by itself or is clocked.
    ///
    /// ```
    /// let model = encoderscope::model::parse("MPP-40-60-A-24-R-N-A-M").unwrap();
    /// let bytes: Vec<u8> = model.requests().iter().map(|request| request.byte).collect();
    /// assert_eq!(bytes, *b"01dst");
    /// ```
    #[must_use]
    pub fn requests(&self) -> Vec<Request> {
        let profile = &self.profile;
        match profile.format {
            Format::Rs485 => rs485::Command::ALL
                .iter()
                .map(|command| Request {
                    byte: command.byte(),
                    title: command.title(),
                    changes_encoder: command.changes_encoder(),
                })
                .collect(),
            Format::T485 => t485::Request::ALL
                .iter()
                .filter(|request| request.is_known_to(profile.dialect))
                .map(|request| Request {
                    byte: request.byte(),
                    title: request.title(),
                    changes_encoder: request.changes_encoder(),
                })
                .collect(),
            Format::Bus => Operation::ALL
                .iter()
                .map(|operation| Request {
                    byte: bus::request(profile, *operation, low_byte(profile.address.into())),
                    title: operation.title(),
                    changes_encoder: operation.changes_encoder(),
                })
                .collect(),
            _ => Vec::new(),
        }
    }

    /// Whether zero or address can be changed by command. IP-75 and Pepperl+Fuchs have inputs
    /// for it.
    #[must_use]
    pub fn changes_by_command(&self) -> bool {
        let requests = self.requests();
        requests.iter().any(|request| request.changes_encoder)
    }

    /// What the code leaves open, and what the manual advises, in sentences.
    ///
    /// ```
    /// let model = encoderscope::model::parse("MPP-20-30-A-24-S-N-A-M").unwrap();
    /// assert!(model.notes()[0].starts_with("The size table of MPP has no MPP-20-30"));
    /// ```
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let text = |place| self.token(place).map(Token::text);
        if let (Some(rotor), Some(stator)) = (text(Place::Rotor), text(Place::Stator))
            && self.size().is_none()
        {
            let name = t(self.series_name());
            let step = if self.series == Some(Series::Mpp) {
                10
            } else {
                5
            };
            let number = |place| self.token(place).map_or(0, |token| token.number);
            let (inner, outer) = (number(Place::Rotor), number(Place::Stator));
            let advice = match inner.is_multiple_of(step) && outer > inner {
                true => text!(
                    "The manual speaks of models for every {} mm, so it may still be made: ask.",
                    step
                ),
                false => t("Look at the label again.").to_string(),
            };
            notes.push(text!(
                "The size table of {} has no {}-{}-{}. {}",
                name,
                name,
                rotor,
                stator,
                advice
            ));
        }
        if self.series.is_none() {
            notes.push(match self.token(Place::Interface) {
                Some(token) if self.interface == Interface::BissC && token.word.text == "B" => t(
                    "A resolution alone is how the CRC-6 programs of MPP and PT call a BiSS-C \
                     model; the whole code says the rest.",
                )
                .to_string(),
                _ => t(
                    "A short form of the manuals: the whole code says series, size and \
                      temperature.",
                )
                .to_string(),
            });
        }
        match self.interface {
            Interface::Ssi => notes
                .push(t("SSI has no CRC: MPP and PT recommend BiSS-C on the same wires.").to_string()),
            Interface::SsiTree => notes.push(
                t("Bits and code are ordered separately and are no part of this name: what stands \
                 here is the classic word. Look at the type plate and change it.")
                    .to_string(),
            ),
            _ => {}
        }
        notes
    }

    /// The record of an order code: its profile's, and what else follows.
    #[must_use]
    pub fn record(&self) -> Record {
        let fact = |name| self.series.and_then(|series| series.fact(name));
        let value = |name| fact(name).map(|fact| fact.value);
        let diameter = |place| self.token(place).map(|token| token.number);
        let temperature = self.temperature();
        let record = self
            .profile
            .record()
            .with("series", self.series_name())
            .with("orderCode", self.code())
            .with("interface", self.interface.key())
            .with("turnsKept", self.turns.name())
            .with("battery", self.has_battery())
            .with("changesByCommand", self.changes_by_command())
            .with("supply", value(facts::SUPPLY))
            .with("current", value(facts::CURRENT))
            .with(
                "leastTemperature",
                temperature.map(|range| i64::from(range.0)),
            )
            .with(
                "greatestTemperature",
                temperature.map(|range| i64::from(range.1)),
            )
            .with("rotor", diameter(Place::Rotor))
            .with("stator", diameter(Place::Stator));
        match self.frame_bits() {
            // The word length of an SSI profile is the same number.
            Some(bits) if record.find("frameBits").is_none() => record.with("frameBits", bits),
            _ => record,
        }
    }
}
