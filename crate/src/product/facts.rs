//! The characteristics of the series, as their manuals list them.

use super::Series;
use crate::language::{msg, t};

/// A characteristic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fact {
    /// Whose it is.
    pub series: &'static [Series],
    /// What it is about.
    pub group: Group,
    /// What it is.
    pub name: &'static str,
    /// How much, with its unit.
    pub value: &'static str,
    /// The manual, and the place in it.
    pub source: &'static str,
}

/// What a characteristic is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// How finely and how truly it measures.
    Measuring,
    /// Supply and battery.
    Electrical,
    /// What it speaks.
    Output,
    /// Connectors and cables.
    Connection,
    /// Mounting and material.
    Mechanical,
    /// What it bears.
    Environment,
}

impl Group {
    /// All groups, in the order in which they are shown.
    pub const ALL: [Self; 6] = [
        Self::Measuring,
        Self::Electrical,
        Self::Output,
        Self::Connection,
        Self::Mechanical,
        Self::Environment,
    ];

    /// Its name for people.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Measuring => t("resolution and accuracy"),
            Self::Electrical => t("electrical"),
            Self::Output => t("output"),
            Self::Connection => t("connection"),
            Self::Mechanical => t("mechanical"),
            Self::Environment => t("environment"),
        }
    }
}

/// The name of the supply voltage.
pub const SUPPLY: &str = msg("supply");
/// The name of the current.
pub const CURRENT: &str = msg("current");
/// The name of the temperature range.
pub const TEMPERATURE: &str = msg("working temperature");

impl Series {
    /// Its characteristics.
    ///
    /// ```
    /// use encoderscope::product::Series;
    /// let supply = Series::Ip75.fact("supply").unwrap();
    /// assert_eq!((supply.value, supply.source), ("+5…+7 V", "IP-75, table 1"));
    /// ```
    pub fn facts(self) -> impl Iterator<Item = &'static Fact> {
        FACTS.iter().filter(move |fact| fact.series.contains(&self))
    }

    /// The characteristic of a name.
    #[must_use]
    pub fn fact(self, name: &str) -> Option<&'static Fact> {
        self.facts().find(|fact| fact.name == name)
    }
}

const MPP: &[Series] = &[Series::Mpp];
const PT: &[Series] = &[Series::Pt];
const BOTH: &[Series] = &[Series::Mpp, Series::Pt];
const IP75: &[Series] = &[Series::Ip75];
const P_F: &[Series] = &[Series::Avs58, Series::Avm58, Series::Ass58, Series::Asm58];
const P_F_SINGLE: &[Series] = &[Series::Avs58, Series::Ass58];
const P_F_MULTI: &[Series] = &[Series::Avm58, Series::Asm58];
const P_F_SOLID: &[Series] = &[Series::Avs58, Series::Avm58];
const P_F_HOLLOW: &[Series] = &[Series::Ass58, Series::Asm58];

/// Writes the table with one line a row.
macro_rules! facts {
    ($($series:ident $group:ident msg($source:literal) { $($name:expr => msg($value:literal);)* })*) => {
        /// All characteristics.
        pub static FACTS: &[Fact] = &[$($(Fact {
            series: $series,
            group: Group::$group,
            name: $name,
            value: $value,
            source: $source,
        }),*),*];
    };
}

facts! {
    BOTH Measuring msg("MPP and PT, absolute values") {
        msg("bits per turn") => msg("24, one count is 0.0772″");
        msg("repeatability") => msg("0…±1 count, depending on the bits");
        msg("update rate") => msg("50 kHz");
        msg("greatest speed") => msg("8000 rpm");
    }
    BOTH Measuring msg("MPP and PT, system parameters") {
        msg("accuracy") => msg("±0.01°");
    }
    BOTH Electrical msg("MPP and PT, supply") {
        SUPPLY => msg("4.5…5.5 V");
        msg("battery") => msg("2.7…3.6 V");
        msg("start-up") => msg("15 ms");
    }
    MPP Electrical msg("MPP, supply") { CURRENT => msg("≈ 60 mA"); }
    PT Electrical msg("PT, electrical") { CURRENT => msg("≈ 100 mA"); }
    BOTH Electrical msg("MPP and PT, supply") {
        msg("current from the battery") => msg("≈ 6 µA at 3.6 V, standing still");
        msg("electrostatic discharge") => msg("human body ±2 kV, charged device ±1 kV at most");
    }
    BOTH Output msg("MPP and PT, absolute values") {
        msg("interfaces") => msg("SSI, BiSS-C, RS485, RS422, T485, BUS, PERIOD");
    }
    MPP Connection msg("MPP, connectors") {
        msg("connector SUR") => msg("SM08-SURS-TF, wire to board; Teflon twisted pairs 4P×AWG32");
        msg("connector MOLEX") => msg("504050-0891, wire to board; twisted pairs 4P×AWG28, shielded, ⌀ ≈ 4.0 mm");
        msg("shield") => msg("to ground on the side of the controller");
    }
    PT Connection msg("PT, connector") {
        msg("connector") => msg("wire to board, by size; Teflon twisted pairs 4P×AWG32");
        msg("shield") => msg("to ground on the side of the drive");
    }
    BOTH Mechanical msg("MPP and PT, system and mechanical parameters") {
        msg("mounting") => msg("axial, hollow");
        msg("rotor") => msg("stainless steel");
        msg("stator") => msg("aluminium alloy");
    }
    MPP Mechanical msg("MPP, first page") {
        msg("width of the ring") => msg("10 mm on each side");
        msg("hollow shaft") => msg("up to 100 mm");
        msg("inner diameters") => msg("models for every 10 mm");
    }
    PT Mechanical msg("PT, first page") {
        msg("width of the ring") => msg("5 mm on each side");
        msg("inner diameters") => msg("models for every 5 mm");
    }
    PT Mechanical msg("PT, drawing") {
        msg("screws of the stator") => msg("M1.6 through the M2 threaded hole, or M2 in its thread");
        msg("mounting of the rotor") => msg("tighten it with the special tool");
    }
    BOTH Environment msg("MPP and PT, environment") {
        TEMPERATURE => msg("−40…85, −40…105 or −40…125 °C, by order code");
    }

    IP75 Measuring msg("IP-75, table 1") {
        msg("kind") => msg("single turn, absolute");
        msg("bits per turn") => msg("14, 16 384 counts, one is 79.1″");
        msg("repeatability") => msg("±1 count");
        msg("accuracy") => msg("≤ 720″, standing still");
        msg("update rate") => msg("> 10 kHz");
        msg("greatest speed") => msg("4000 rpm");
        msg("drift with temperature") => msg("≤ 0.5 ppm/K");
    }
    IP75 Electrical msg("IP-75, table 1") {
        SUPPLY => msg("+5…+7 V");
        msg("reversed supply") => msg("protected by a diode in series");
        CURRENT => msg("≤ 0.2 A");
        msg("start-up") => msg("first correct reading after ≤ 0.15 s");
    }
    IP75 Output msg("IP-75, table 1") {
        msg("interfaces") => msg("RS-485 serial asynchronous, SSI serial synchronous");
    }
    IP75 Connection msg("IP-75, 5.1.2 and 5.1.3") {
        msg("cable") => msg("without connector, AWG 24: six wires with RS-485, eight with SSI");
        msg("terminators") => msg("none inside");
    }
    IP75 Mechanical msg("IP-75, table 1") {
        msg("stator and rotor") => msg("⌀ 75 mm, 16.2 mm high without the connector");
        msg("mass") => msg("100 g");
    }
    IP75 Mechanical msg("IP-75, 5.2") {
        msg("greatest misalignment") => msg("0.25 mm");
        msg("gap between rotor and stator") => msg("0.75…1.45 mm");
    }
    IP75 Environment msg("IP-75, table 1") {
        TEMPERATURE => msg("−40…+80 °C");
        msg("protection") => msg("IP67");
    }
    IP75 Environment msg("IP-75, 7 and 10") {
        msg("storage") => msg("−50…+50 °C, at most 80 % relative humidity, packed");
        msg("service life") => msg("5 years; warranty 1 year");
    }

    P_F_SINGLE Measuring msg("P+F article, table 6") { msg("resolution") => msg("up to 16 bits"); }
    P_F_MULTI Measuring msg("P+F article, table 6") { msg("resolution") => msg("up to 30 bits"); }
    P_F_MULTI Measuring msg("P+F article, variety of designs") {
        msg("turns") => msg("up to 14 bits, 16 384 turns, by a mechanical gear");
    }
    P_F Measuring msg("P+F article, table 6") {
        msg("accuracy") => msg("±2 counts of 16 bits, ±1 of 13 bits, ±0.5 of 12 bits");
        msg("greatest speed") => msg("12 000 rpm");
    }
    P_F Electrical msg("P+F article, table 6") { SUPPLY => msg("10…30 V"); }
    P_F Output msg("P+F article, table 6") {
        msg("code") => msg("Gray or binary, as ordered");
        msg("counting direction") => msg("falling when turned clockwise");
        msg("rate") => msg("0.1…1.5 Mbit/s");
        msg("signals") => msg("RS-422");
        msg("counting direction can be switched") => msg("yes, also with the suffix -H; the article's text says only without");
        msg("preset to 0 (PRESET1)") => msg("yes; not with the suffix -H");
    }
    P_F Mechanical msg("P+F article, table 6") {
        msg("starting torque") => msg("< 5 N·cm (the article prints N·cm²)");
        msg("moment of inertia") => msg("50 g·cm²");
        msg("housing and flange") => msg("aluminium or stainless steel");
        msg("shaft") => msg("stainless steel");
        msg("mass") => msg("0.46 or 0.8 kg, probably in aluminium and in stainless steel");
        msg("life") => msg("at least 10¹² turns");
    }
    P_F_SOLID Mechanical msg("P+F article, table 6") {
        msg("load on the shaft") => msg("40 N axial, 110 N radial");
    }
    P_F_SOLID Mechanical msg("P+F article, variety of designs") {
        msg("housing and shaft") => msg("⌀ 58 mm; shafts of 6, 10 and 12 mm");
    }
    P_F_HOLLOW Mechanical msg("P+F article, table 6") {
        msg("displacement of the shaft, angular") => msg("±0.9°");
        msg("displacement of the shaft, axial") => msg("±0.3 mm at rest, ±0.1 mm moving");
        msg("displacement of the shaft, radial") => msg("±0.5 mm at rest, ±0.2 mm moving");
    }
    P_F_HOLLOW Mechanical msg("P+F article, variety of designs") {
        msg("housing") => msg("⌀ 58 mm");
    }
    P_F Environment msg("P+F article, table 6") {
        TEMPERATURE => msg("−40…+85 °C");
        msg("storage") => msg("−40…+85 °C");
        msg("protection") => msg("IP65");
        msg("vibration") => msg("10 g, 10…2000 Hz");
        msg("shock") => msg("100 g, 3 ms");
    }
}
