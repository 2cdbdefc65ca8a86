//! What USB adapters can do: the baud rates that their chips make.
//!
//! Drivers accept any rate and use the nearest one that the chip makes; a UART bears about 2 %.
//! The rates of FTDI chips follow from their dividers (AN232B-05; Linux `ftdi_sio`), those of the
//! others are what their makers' tables end at.

/// A chip, known by its maker's USB identity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chip {
    /// USB vendor.
    pub vendor: u16,
    /// USB product.
    pub product: u16,
    /// What it is called.
    pub name: &'static str,
    clock: Clock,
}

/// How a chip makes a baud rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Clock {
    /// This many baud divided by 2 and more in steps of 1/8; and by 1 and 1.5.
    Eighths(u32),
    /// Nothing above this rate; what it makes below is near enough.
    UpTo(u32),
    /// Not known: measure.
    Unknown,
}

/// What an adapter makes of a baud rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Made {
    /// So many baud, which is near enough.
    Rate(f64),
    /// Not this rate: the nearest that the chip makes is so many baud, which no encoder bears.
    Not(f64),
    /// Not known.
    Unknown,
}

/// The share by which two UARTs may differ.
pub const TOLERANCE: f64 = 0.02;

const fn chip(vendor: u16, product: u16, name: &'static str, clock: Clock) -> Chip {
    Chip {
        vendor,
        product,
        name,
        clock,
    }
}

/// Chips of common adapters.
pub static CHIPS: &[Chip] = &[
    chip(0x0403, 0x6001, "FT232R", Clock::Eighths(3_000_000)),
    chip(0x0403, 0x6010, "FT2232H", Clock::Eighths(12_000_000)),
    chip(0x0403, 0x6011, "FT4232H", Clock::Eighths(12_000_000)),
    chip(0x0403, 0x6014, "FT232H", Clock::Eighths(12_000_000)),
    chip(0x0403, 0x6015, "FT230X", Clock::Eighths(3_000_000)),
    chip(0x067b, 0x2303, "PL2303", Clock::Unknown),
    chip(0x10c4, 0xea60, "CP210x", Clock::Unknown),
    chip(0x1a86, 0x55d3, "CH343", Clock::Unknown),
    chip(0x1a86, 0x7523, "CH340", Clock::UpTo(2_000_000)),
];

impl Chip {
    /// The chip of a USB identity.
    #[must_use]
    pub fn of(vendor: u16, product: u16) -> Option<&'static Self> {
        CHIPS
            .iter()
            .find(|chip| (chip.vendor, chip.product) == (vendor, product))
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
            Clock::UpTo(most) => asked.min(f64::from(most)),
            Clock::Eighths(base) => {
                let base = f64::from(base);
                let eighths = (base * 8.0 / asked).max(16.0);
                let below = eighths as u64 as f64;
                let dividers = [below / 8.0, (below + 1.0) / 8.0, 1.0, 1.5];
                let apart = |rate: f64| abs(rate - asked);
                dividers
                    .iter()
                    .map(|divider| base / divider)
                    .fold(f64::MAX, |best, rate| match apart(rate) < apart(best) {
                        true => rate,
                        false => best,
                    })
            }
        };
        match abs(nearest - asked) <= asked * TOLERANCE {
            true => Made::Rate(nearest),
            false => Made::Not(nearest),
        }
    }
}

fn abs(value: f64) -> f64 {
    if value < 0.0 { -value } else { value }
}
