//! What USB adapters can do: the baud rates that their chips make, and what their drivers need.
//!
//! Drivers accept any rate and use the nearest one that the chip makes; a UART bears about 2 %.
//! The rates of FTDI chips follow from their dividers (AN232B-05; Linux `ftdi_sio`), those of the
//! others are what their makers' data sheets end at.

mod system;

use crate::language::msg;

pub use system::System;

/// A chip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chip {
    /// What it is called.
    pub name: &'static str,
    /// USB vendor and product, where they tell it from others.
    pub identity: Option<(u16, u16)>,
    clock: Clock,
}

/// How a chip makes a baud rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Clock {
    /// This many baud divided by 2 and more in steps of 1/8; and by 1 and 1.5.
    Eighths(u32),
    /// Its maker's list ends at this rate.
    UpTo(u32),
    /// Not known: measure.
    Unknown,
}

/// What an adapter makes of a baud rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Made {
    /// So many baud, which is near enough.
    Rate(f64),
    /// Its maker's list goes so far; what it makes exactly is not known.
    Listed,
    /// Not this rate: the nearest that the chip makes is so many baud, which no encoder bears.
    Not(f64),
    /// Not known.
    Unknown,
}

/// The share by which two UARTs may differ (Silicon Labs, CP2104 data sheet, 6.1).
pub const TOLERANCE: f64 = 0.02;

/// How long an FTDI chip holds a short reply unless told otherwise, in milliseconds (AN232B-04).
pub const LATENCY: f64 = 16.0;
/// The least that it can be told.
pub const LEAST_LATENCY: f64 = 1.0;

const fn chip(name: &'static str, identity: Option<(u16, u16)>, clock: Clock) -> Chip {
    Chip {
        name,
        identity,
        clock,
    }
}

/// What full-speed chips divide, in baud; below `SLOW` high-speed ones do as they do.
const FULL: u32 = 3_000_000;
const SLOW: f64 = 1_200.0;
/// The greatest divider, in eighths: 14 bits and three behind the point.
const GREATEST: f64 = 131_071.0;
const HIGH_SPEED: Clock = Clock::Eighths(12_000_000);
const FULL_SPEED: Clock = Clock::Eighths(FULL);

/// Chips of common adapters.
pub static CHIPS: &[Chip] = &[
    chip("FT232H", Some((0x0403, 0x6014)), HIGH_SPEED),
    chip("FT2232H", Some((0x0403, 0x6010)), HIGH_SPEED),
    chip("FT4232H", Some((0x0403, 0x6011)), HIGH_SPEED),
    chip("FT232R", Some((0x0403, 0x6001)), FULL_SPEED),
    chip("FT230X", Some((0x0403, 0x6015)), FULL_SPEED),
    chip("FT2232D", None, FULL_SPEED),
    chip("CH340", Some((0x1a86, 0x7523)), Clock::UpTo(2_000_000)),
    chip("CH343", Some((0x1a86, 0x55d3)), Clock::Unknown),
    chip("CP210x", Some((0x10c4, 0xea60)), Clock::Unknown),
    chip("CP2104", None, Clock::UpTo(2_000_000)),
    chip("CP2102N", None, Clock::Unknown),
    chip("PL2303", Some((0x067b, 0x2303)), Clock::Unknown),
];

impl Chip {
    /// The chip of a USB identity.
    #[must_use]
    pub fn of(vendor: u16, product: u16) -> Option<&'static Self> {
        CHIPS
            .iter()
            .find(|chip| chip.identity == Some((vendor, product)))
    }

    /// What to know about it; not in its row, so that who asks for rates alone need not carry it.
    #[must_use]
    pub fn note(&self) -> &'static str {
        match self.name {
            "FT2232H" => msg("the older FT2232D says the same of itself and does as FT232R"),
            // Both are as far from 2.5 Mbaud.
            "FT232R" | "FT230X" | "FT2232D" => {
                msg("makes nothing between 2 and 3 Mbaud; drivers take one or the other")
            }
            "CH340" => msg("its maker's list ends at 2 Mbaud, that of the CH341 too"),
            "CH343" => msg(
                "reaches 3 Mbaud and more, the CH347 too; in which steps is not published: measure",
            ),
            "CP210x" => msg("CP2102, CP2104 and CP2102N say the same of themselves"),
            "CP2104" => msg("its data sheet ends at 2 Mbaud, that of the CP2102 earlier"),
            "CP2102N" => msg("reaches 3 Mbaud; in which steps is not established: measure"),
            "PL2303" => msg("many versions and copies: measure, and take another for 2.5 Mbaud"),
            _ => "",
        }
    }

    /// What it makes of a baud rate.
    ///
    /// ```
    /// use encoderscope::adapter::{Chip, Made};
    /// let high_speed = Chip::of(0x0403, 0x6014).unwrap();
    /// assert!(matches!(high_speed.made(2_500_000), Made::Rate(rate) if (rate - 2_526_316.0).abs() < 1.0));
    /// let full_speed = Chip::of(0x0403, 0x6001).unwrap();
    /// assert!(matches!(full_speed.made(2_500_000), Made::Not(_)));
    /// ```
    #[must_use]
    pub fn made(&self, baud: u32) -> Made {
        let asked = f64::from(baud.max(1));
        let nearest = match self.clock {
            Clock::Unknown => return Made::Unknown,
            Clock::UpTo(most) if asked <= f64::from(most) => return Made::Listed,
            Clock::UpTo(most) => f64::from(most),
            Clock::Eighths(base) => {
                let base = match asked < SLOW {
                    true => f64::from(FULL),
                    false => f64::from(base),
                };
                let eighths = (base * 8.0 / asked).max(16.0);
                let below = (eighths as u64 as f64).min(GREATEST);
                let dividers = [below / 8.0, (below + 1.0).min(GREATEST) / 8.0, 1.0, 1.5];
                let apart = |rate: f64| (rate - asked).abs();
                dividers
                    .iter()
                    .map(|divider| base / divider)
                    .fold(f64::MAX, |best, rate| match apart(rate) < apart(best) {
                        true => rate,
                        false => best,
                    })
            }
        };
        match (nearest - asked).abs() <= asked * TOLERANCE {
            true => Made::Rate(nearest),
            false => Made::Not(nearest),
        }
    }
}
