//! Which wire of an encoder goes where: pins, colours, supply, terminators, and what to beware of.
//!
//! ```
//! use encoderscope::{product::{Interface, Series}, wiring::{Adapter, Battery, Setup, svg}};
//! let setup = Setup {
//!     series: Series::Mpp,
//!     interface: Interface::Rs485,
//!     battery: Battery::None,
//!     adapter: Adapter::TwoWire,
//! };
//! let wiring = setup.wire()?;
//! let wire = wiring.wires.iter().find(|wire| wire.signal == "B").unwrap();
//! assert_eq!((wire.pin, wire.paint.unwrap().name()), (Some(4), "green-black".into()));
//! assert_eq!(wire.goes.unwrap().name, "B (D−)");
//! assert!(svg(&wiring).starts_with("<svg "));
//! # Ok::<(), encoderscope::calculator::Fault>(())
//! ```

mod advice;
mod entry;
mod paint;
mod picture;
mod pins;
mod refusal;
mod terminators;

pub use entry::encoder;
pub use paint::{Colour, Paint};
pub use picture::svg;
pub(crate) use refusal::exists;
pub use terminators::{End, OHMS, Presence, Terminator};

use crate::{
    calculator::Fault,
    language::t,
    product::{
        Interface, Series,
        facts::{CURRENT, Fact, SUPPLY},
    },
};
use alloc::{string::String, vec::Vec};

/// What is to be wired.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setup {
    /// The encoder.
    pub series: Series,
    /// What it speaks.
    pub interface: Interface,
    /// Whether a battery keeps its turns.
    pub battery: Battery,
    /// What is at the other end.
    pub adapter: Adapter,
}

/// Whether a battery keeps the turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Battery {
    /// There are no battery wires.
    None,
    /// Models BM of MPP and PT.
    Fitted,
}

impl Battery {
    /// Both.
    pub const ALL: [Self; 2] = [Self::None, Self::Fitted];

    /// Its name in links.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::None => "no",
            Self::Fitted => "yes",
        }
    }

    /// The one of a name in links.
    ///
    /// ```
    /// use encoderscope::wiring::Battery;
    /// assert_eq!(Battery::parse("yes"), Some(Battery::Fitted));
    /// ```
    #[must_use]
    pub fn parse(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|battery| battery.key() == key)
    }
}

/// What is at the other end of the cable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Adapter {
    /// A two-wire USB–RS485 adapter whose terminator can be switched on.
    TwoWire,
    /// A two-wire USB–RS485 adapter without a terminator.
    TwoWireBare,
    /// A four-wire USB–RS422 adapter.
    FourWire,
    /// A controller card that clocks SSI or BiSS.
    Master,
    /// The APCI-1710 or CPCI-1710 (P+F article, table 3).
    Apci1710,
}

impl Adapter {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::TwoWire,
        Self::TwoWireBare,
        Self::FourWire,
        Self::Master,
        Self::Apci1710,
    ];

    /// Its name in links.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::TwoWire => "rs485",
            Self::TwoWireBare => "rs485-bare",
            Self::FourWire => "rs422",
            Self::Master => "master",
            Self::Apci1710 => "apci-1710",
        }
    }

    /// The adapter of a name in links.
    ///
    /// ```
    /// use encoderscope::wiring::Adapter;
    /// assert_eq!(Adapter::parse("apci-1710"), Some(Adapter::Apci1710));
    /// ```
    #[must_use]
    pub fn parse(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|adapter| adapter.key() == key)
    }

    /// The name for people.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::TwoWire => t("USB–RS485, terminator switch"),
            Self::TwoWireBare => t("USB–RS485, no terminator"),
            Self::FourWire => t("USB–RS422, four wires"),
            Self::Master => t("SSI or BiSS master"),
            Self::Apci1710 => t("APCI-1710 or CPCI-1710"),
        }
    }

    /// The name on its box in the picture.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::TwoWire | Self::TwoWireBare => "USB–RS485",
            Self::FourWire => "USB–RS422",
            Self::Master => t("SSI/BiSS master"),
            Self::Apci1710 => "APCI-1710",
        }
    }
}

/// Which of two wires of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Polarity {
    /// The one that is higher for a 1.
    Plus,
    /// The other.
    Minus,
}

/// What a wire or a terminal is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// Supply, and 0 V.
    Supply(Polarity),
    /// A signal from the controller: Clock, MA, RX.
    ToEncoder(Polarity),
    /// A signal from the encoder: Data, SLO, TX, OUT.
    FromEncoder(Polarity),
    /// A pair on which both talk in turn: A and B.
    Shared(Polarity),
    /// A battery.
    Battery(Polarity),
    /// An input that is switched by hand or stays at one level.
    Level,
    /// Not used with this interface.
    Unused,
}

impl Line {
    /// Whether a wire for `self` may go to a terminal for `other`.
    ///
    /// ```
    /// use encoderscope::wiring::{Line, Polarity::{Minus, Plus}};
    /// assert!(Line::FromEncoder(Plus).fits(Line::Shared(Plus)));
    /// assert!(!Line::FromEncoder(Plus).fits(Line::FromEncoder(Minus)));
    /// assert!(!Line::ToEncoder(Plus).fits(Line::Shared(Plus)));
    /// ```
    #[must_use]
    pub fn fits(self, other: Self) -> bool {
        match (self, other) {
            (Self::Unused, _) => false,
            // Whoever only listens may do so at the terminals of a pair for both directions.
            (Self::FromEncoder(mine), Self::Shared(theirs)) => mine == theirs,
            _ => self == other,
        }
    }
}

/// Where a terminal is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// On a power supply.
    Supply,
    /// On the adapter.
    Adapter,
    /// On a battery.
    Battery,
    /// At a switch or a fixed level.
    Switch,
}

/// What a wire is connected to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Terminal {
    /// Where it is.
    pub place: Place,
    /// What is written on it.
    pub name: &'static str,
    /// What it is for.
    pub line: Line,
}

/// A wire of the encoder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wire {
    /// Its pin, where the source numbers them.
    pub pin: Option<u8>,
    /// Its colours, where the source names them.
    pub paint: Option<Paint>,
    /// Its signal.
    pub signal: &'static str,
    /// What it is for.
    pub line: Line,
    /// Where it goes; nowhere when it is not used.
    pub goes: Option<Terminal>,
    /// What to know about it.
    pub note: &'static str,
}

/// Something to know, with where it is from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Its name, in kebab-case.
    pub name: &'static str,
    /// The sentences.
    pub text: String,
    /// Where they are from.
    pub source: &'static str,
}

/// What a shield is connected to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shield {
    /// Grounded at the controller's end, as is recommended.
    AtController,
    /// At one end or both, as the installation asks.
    Depends,
    /// The source says nothing of one.
    Unsaid,
}

/// Which wire goes where.
#[derive(Clone, Debug, PartialEq)]
pub struct Wiring {
    /// What is wired.
    pub setup: Setup,
    /// The wires, in the order of their pins.
    pub wires: Vec<Wire>,
    /// Voltage, current and start-up time, as far as the source has them.
    pub supply: Vec<&'static Fact>,
    /// The terminal of the adapter that is joined with 0 V; `None` where the source names none.
    pub ground: Option<Terminal>,
    /// Resistors at the ends of the pairs.
    pub terminators: Vec<Terminator>,
    /// The shield.
    pub shield: Shield,
    /// What to beware of.
    pub warnings: Vec<Warning>,
    /// Where pins and colours are from.
    pub source: &'static str,
}

impl Setup {
    /// Works out which wire goes where.
    ///
    /// # Errors
    ///
    /// Names what does not exist or cannot work together, and what would.
    pub fn wire(self) -> Result<Wiring, Fault> {
        refusal::check(self)?;
        let wires: Vec<Wire> = pins::of(self)
            .into_iter()
            .map(|wire| Wire {
                goes: wire.goes.or_else(|| self.adapter.terminal(wire.line)),
                ..wire
            })
            .collect();
        let terminators = terminators::of(self);
        let warnings = advice::of(self);
        Ok(Wiring {
            supply: [SUPPLY, CURRENT, "start-up"]
                .iter()
                .filter_map(|name| self.series.fact(name))
                .collect(),
            ground: self.adapter.ground(),
            shield: pins::shield(self.series),
            source: pins::source(self),
            setup: self,
            wires,
            terminators,
            warnings,
        })
    }
}
