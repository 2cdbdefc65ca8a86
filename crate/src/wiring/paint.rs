//! Colours of wires.

use crate::language::{msg, t};
use alloc::{
    format,
    string::{String, ToString},
};

/// A colour of a wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// Red.
    Red,
    /// Black.
    Black,
    /// Green.
    Green,
    /// Blue.
    Blue,
    /// Yellow.
    Yellow,
    /// Orange.
    Orange,
    /// White.
    White,
    /// Gray.
    Gray,
    /// Violet.
    Violet,
    /// Brown.
    Brown,
}

impl Colour {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Red => msg("red"),
            Self::Black => msg("black"),
            Self::Green => msg("green"),
            Self::Blue => msg("blue"),
            Self::Yellow => msg("yellow"),
            Self::Orange => msg("orange"),
            Self::White => msg("white"),
            Self::Gray => msg("gray"),
            Self::Violet => msg("violet"),
            Self::Brown => msg("brown"),
        }
    }

    /// What it looks like, as `#rrggbb`.
    #[must_use]
    pub const fn hex(self) -> &'static str {
        match self {
            Self::Red => "#cf3a2e",
            Self::Black => "#17191b",
            Self::Green => "#2c9148",
            Self::Blue => "#2d63c0",
            Self::Yellow => "#f0c81e",
            Self::Orange => "#ec7d1c",
            Self::White => "#ffffff",
            Self::Gray => "#8d9398",
            Self::Violet => "#8047ad",
            Self::Brown => "#7c4a24",
        }
    }
}

/// The colours of a wire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paint {
    /// Most of it.
    pub base: Colour,
    /// A stripe of another colour.
    pub stripe: Option<Colour>,
}

impl Paint {
    pub(super) const fn plain(base: Colour) -> Self {
        Self { base, stripe: None }
    }

    pub(super) const fn striped(base: Colour, stripe: Colour) -> Self {
        Self {
            base,
            stripe: Some(stripe),
        }
    }

    /// Its name as it is said to people.
    #[must_use]
    pub fn title(self) -> String {
        let name = match (self.base, self.stripe) {
            (Colour::Green, Some(Colour::Black)) => t("green-black"),
            (Colour::Yellow, Some(Colour::Black)) => t("yellow-black"),
            (Colour::White, Some(Colour::Black)) => t("white-black"),
            (base, None) => t(base.name()),
            (base, Some(stripe)) => {
                return format!("{}-{}", t(base.name()), t(stripe.name()));
            }
        };
        name.to_string()
    }

    /// Its name: `green`, `green-black`.
    #[must_use]
    pub fn name(self) -> String {
        match self.stripe {
            None => self.base.name().to_string(),
            Some(stripe) => format!("{}-{}", self.base.name(), stripe.name()),
        }
    }
}
