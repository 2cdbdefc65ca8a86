//! What is sold: the series of encoders, and the interfaces that each comes with.

pub mod facts;
pub mod sizes;

use crate::{format::Format, language::msg};

/// A series of encoders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Series {
    /// KingKong MPP, magnetic.
    Mpp,
    /// Mosrac PT, magnetic: the same electronics in another mount.
    Pt,
    /// The inductosyn IP-75.
    Ip75,
    /// Pepperl+Fuchs AVS58, single turn, solid shaft.
    Avs58,
    /// Pepperl+Fuchs AVM58, multi-turn, solid shaft.
    Avm58,
    /// Pepperl+Fuchs ASS58, single turn, hollow shaft.
    Ass58,
    /// Pepperl+Fuchs ASM58, multi-turn, hollow shaft.
    Asm58,
}

/// How an encoder is wired and what it speaks. RS485 and RS422 speak the same over other wires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interface {
    /// SSI of MPP and PT, letter S.
    Ssi,
    /// BiSS-C, letter B.
    BissC,
    /// RS485, letter R: two wires.
    Rs485,
    /// RS422, letter A: four wires.
    Rs422,
    /// T485, letter T.
    T485,
    /// BUS, letter D.
    Bus,
    /// PERIOD, letter P.
    Period,
    /// The binary stream of IP-75 over RS-485.
    Asi1,
    /// The text stream of IP-75 over RS-485.
    Asi4,
    /// SSI of IP-75.
    Ssi7,
    /// The classic SSI word of Pepperl+Fuchs.
    SsiTree,
}

impl Series {
    /// All series.
    pub const ALL: [Self; 7] = [
        Self::Mpp,
        Self::Pt,
        Self::Ip75,
        Self::Avs58,
        Self::Avm58,
        Self::Ass58,
        Self::Asm58,
    ];

    /// The name on the label.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mpp => "MPP",
            Self::Pt => "PT",
            Self::Ip75 => msg("IP-75"),
            Self::Avs58 => "AVS58",
            Self::Avm58 => "AVM58",
            Self::Ass58 => "ASS58",
            Self::Asm58 => "ASM58",
        }
    }

    /// Its name in links.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Mpp => "mpp",
            Self::Pt => "pt",
            Self::Ip75 => "ip-75",
            Self::Avs58 => "avs58",
            Self::Avm58 => "avm58",
            Self::Ass58 => "ass58",
            Self::Asm58 => "asm58",
        }
    }

    /// The series of a name in links.
    ///
    /// ```
    /// use encoderscope::product::Series;
    /// assert_eq!(Series::parse("ip-75"), Some(Series::Ip75));
    /// assert_eq!(Series::parse("IP75"), None);
    /// ```
    #[must_use]
    pub fn parse(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|series| series.key() == key)
    }

    /// The interfaces that it comes with.
    ///
    /// ```
    /// use encoderscope::product::{Interface, Series};
    /// assert_eq!(Series::Avm58.interfaces(), [Interface::SsiTree]);
    /// ```
    #[must_use]
    pub const fn interfaces(self) -> &'static [Interface] {
        match self {
            Self::Mpp | Self::Pt => &[
                Interface::Ssi,
                Interface::BissC,
                Interface::Rs485,
                Interface::Rs422,
                Interface::T485,
                Interface::Bus,
                Interface::Period,
            ],
            Self::Ip75 => &[Interface::Asi1, Interface::Asi4, Interface::Ssi7],
            Self::Avs58 | Self::Avm58 | Self::Ass58 | Self::Asm58 => &[Interface::SsiTree],
        }
    }
}

impl Interface {
    /// All interfaces.
    pub const ALL: [Self; 11] = [
        Self::Ssi,
        Self::BissC,
        Self::Rs485,
        Self::Rs422,
        Self::T485,
        Self::Bus,
        Self::Period,
        Self::Asi1,
        Self::Asi4,
        Self::Ssi7,
        Self::SsiTree,
    ];

    /// Its name in links.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Ssi => "ssi",
            Self::BissC => "biss-c",
            Self::Rs485 => "rs485",
            Self::Rs422 => "rs422",
            Self::T485 => "t485",
            Self::Bus => "bus",
            Self::Period => "period",
            Self::Asi1 => "asi1",
            Self::Asi4 => "asi4",
            Self::Ssi7 => "ssi7",
            Self::SsiTree => "ssi-tree",
        }
    }

    /// The interface of a name in links.
    ///
    /// ```
    /// use encoderscope::product::Interface;
    /// assert_eq!(Interface::parse("rs422"), Some(Interface::Rs422));
    /// assert_eq!(Interface::parse("rs232"), None);
    /// ```
    #[must_use]
    pub fn parse(key: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|interface| interface.key() == key)
    }

    /// The name for people.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Rs485 => "RS485",
            Self::Rs422 => "RS422",
            other => other.format().title(),
        }
    }

    /// The format of its frames.
    #[must_use]
    pub const fn format(self) -> Format {
        match self {
            Self::Ssi => Format::Ssi,
            Self::BissC => Format::BissC,
            Self::Rs485 | Self::Rs422 => Format::Rs485,
            Self::T485 => Format::T485,
            Self::Bus => Format::Bus,
            Self::Period => Format::Period,
            Self::Asi1 => Format::Asi1,
            Self::Asi4 => Format::Asi4,
            Self::Ssi7 => Format::Ssi7,
            Self::SsiTree => Format::SsiTree,
        }
    }
}
