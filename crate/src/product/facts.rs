//! The characteristics of the series, as their manuals list them.

use super::Series;

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
    pub const fn title(self) -> &'static str {
        match self {
            Self::Measuring => "resolution and accuracy",
            Self::Electrical => "electrical",
            Self::Output => "output",
            Self::Connection => "connection",
            Self::Mechanical => "mechanical",
            Self::Environment => "environment",
        }
    }
}

/// The name of the supply voltage.
pub const SUPPLY: &str = "supply";
/// The name of the current.
pub const CURRENT: &str = "current";
/// The name of the temperature range.
pub const TEMPERATURE: &str = "working temperature";

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
    ($($series:ident $group:ident $source:literal { $($name:expr => $value:literal;)* })*) => {
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
    BOTH Measuring "MPP and PT, absolute values" {
        "bits per turn" => "24, one count is 0.0772″";
        "repeatability" => "0…±1 count, depending on the bits";
        "update rate" => "50 kHz";
        "greatest speed" => "8000 rpm";
    }
    BOTH Measuring "MPP and PT, system parameters" {
        "accuracy" => "±0.01°";
    }
    BOTH Electrical "MPP and PT, supply" {
        SUPPLY => "4.5…5.5 V";
        "battery" => "2.7…3.6 V";
        "start-up" => "15 ms";
    }
    MPP Electrical "MPP, supply" { CURRENT => "≈ 60 mA"; }
    PT Electrical "PT, electrical" { CURRENT => "≈ 100 mA"; }
    BOTH Electrical "MPP and PT, supply" {
        "current from the battery" => "≈ 6 µA at 3.6 V, standing still";
        "electrostatic discharge" => "human body ±2 kV, charged device ±1 kV at most";
    }
    BOTH Output "MPP and PT, absolute values" {
        "interfaces" => "SSI, BiSS-C, RS485, RS422, T485, BUS, PERIOD";
    }
    MPP Connection "MPP, connectors" {
        "connector SUR" => "SM08-SURS-TF, wire to board; Teflon twisted pairs 4P×AWG32";
        "connector MOLEX" => "504050-0891, wire to board; twisted pairs 4P×AWG28, shielded, ⌀ ≈ 4.0 mm";
        "shield" => "to ground on the side of the controller";
    }
    PT Connection "PT, connector" {
        "connector" => "wire to board, by size; Teflon twisted pairs 4P×AWG32";
        "shield" => "to ground on the side of the drive";
    }
    BOTH Mechanical "MPP and PT, system and mechanical parameters" {
        "mounting" => "axial, hollow";
        "rotor" => "stainless steel";
        "stator" => "aluminium alloy";
    }
    MPP Mechanical "MPP, first page" {
        "width of the ring" => "10 mm on each side";
        "hollow shaft" => "up to 100 mm";
        "inner diameters" => "models for every 10 mm";
    }
    PT Mechanical "PT, first page" {
        "width of the ring" => "5 mm on each side";
        "inner diameters" => "models for every 5 mm";
    }
    PT Mechanical "PT, drawing" {
        "screws of the stator" => "M1.6 through the M2 threaded hole, or M2 in its thread";
        "mounting of the rotor" => "tighten it with the special tool";
    }
    BOTH Environment "MPP and PT, environment" {
        TEMPERATURE => "−40…85, −40…105 or −40…125 °C, by order code";
    }

    IP75 Measuring "IP-75, table 1" {
        "kind" => "single turn, absolute";
        "bits per turn" => "14, 16 384 counts, one is 79.1″";
        "repeatability" => "±1 count";
        "accuracy" => "≤ 720″, standing still";
        "update rate" => "> 10 kHz";
        "greatest speed" => "4000 rpm";
        "drift with temperature" => "≤ 0.5 ppm/K";
    }
    IP75 Electrical "IP-75, table 1" {
        SUPPLY => "+5…+7 V";
        "reversed supply" => "protected by a diode in series";
        CURRENT => "≤ 0.2 A";
        "start-up" => "first correct reading after ≤ 0.15 s";
    }
    IP75 Output "IP-75, table 1" {
        "interfaces" => "RS-485 serial asynchronous, SSI serial synchronous";
    }
    IP75 Connection "IP-75, 5.1.2 and 5.1.3" {
        "cable" => "without connector, AWG 24: six wires with RS-485, eight with SSI";
        "terminators" => "none inside";
    }
    IP75 Mechanical "IP-75, table 1" {
        "stator and rotor" => "⌀ 75 mm, 16.2 mm high without the connector";
        "mass" => "100 g";
    }
    IP75 Mechanical "IP-75, 5.2" {
        "greatest misalignment" => "0.25 mm";
        "gap between rotor and stator" => "0.75…1.45 mm";
    }
    IP75 Environment "IP-75, table 1" {
        TEMPERATURE => "−40…+80 °C";
        "protection" => "IP67";
    }
    IP75 Environment "IP-75, 7 and 10" {
        "storage" => "−50…+50 °C, at most 80 % relative humidity, packed";
        "service life" => "5 years; warranty 1 year";
    }

    P_F_SINGLE Measuring "P+F article, table 6" { "resolution" => "up to 16 bits"; }
    P_F_MULTI Measuring "P+F article, table 6" { "resolution" => "up to 30 bits"; }
    P_F_MULTI Measuring "P+F article, variety of designs" {
        "turns" => "up to 14 bits, 16 384 turns, by a mechanical gear";
    }
    P_F Measuring "P+F article, table 6" {
        "accuracy" => "±2 counts of 16 bits, ±1 of 13 bits, ±0.5 of 12 bits";
        "greatest speed" => "12 000 rpm";
    }
    P_F Electrical "P+F article, table 6" { SUPPLY => "10…30 V"; }
    P_F Output "P+F article, table 6" {
        "code" => "Gray or binary, as ordered";
        "counting direction" => "falling when turned clockwise";
        "rate" => "0.1…1.5 Mbit/s";
        "signals" => "RS-422";
        "counting direction can be switched" => "yes, also with the suffix -H; the article's text says only without";
        "preset to 0 (PRESET1)" => "yes; not with the suffix -H";
    }
    P_F Mechanical "P+F article, table 6" {
        "starting torque" => "< 5 N·cm (the article prints N·cm²)";
        "moment of inertia" => "50 g·cm²";
        "housing and flange" => "aluminium or stainless steel";
        "shaft" => "stainless steel";
        "mass" => "0.46 or 0.8 kg, probably in aluminium and in stainless steel";
        "life" => "at least 10¹² turns";
    }
    P_F_SOLID Mechanical "P+F article, table 6" {
        "load on the shaft" => "40 N axial, 110 N radial";
    }
    P_F_SOLID Mechanical "P+F article, variety of designs" {
        "housing and shaft" => "⌀ 58 mm; shafts of 6, 10 and 12 mm";
    }
    P_F_HOLLOW Mechanical "P+F article, table 6" {
        "displacement of the shaft, angular" => "±0.9°";
        "displacement of the shaft, axial" => "±0.3 mm at rest, ±0.1 mm moving";
        "displacement of the shaft, radial" => "±0.5 mm at rest, ±0.2 mm moving";
    }
    P_F_HOLLOW Mechanical "P+F article, variety of designs" {
        "housing" => "⌀ 58 mm";
    }
    P_F Environment "P+F article, table 6" {
        TEMPERATURE => "−40…+85 °C";
        "storage" => "−40…+85 °C";
        "protection" => "IP65";
        "vibration" => "10 g, 10…2000 Hz";
        "shock" => "100 g, 3 ms";
    }
}
