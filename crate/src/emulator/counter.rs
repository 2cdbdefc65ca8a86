//! What an encoder remembers: its zeros, its turn counter without power, its EEPROM.

use super::shaft::split;

/// How the turns are kept without power (order code: M, BM, FM).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counter {
    /// XM: they start from 0 at power-on.
    Volatile,
    /// XBM: a battery keeps counting.
    Battery,
    /// XFM: the number is kept in flash; while off the shaft may turn by 90° to either side.
    Flash,
}

/// The battery of a BM model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Battery {
    /// 2.9 V and more.
    Good,
    /// Below 2.9 V: a warning.
    Low,
    /// Below 2.7 V: an error.
    Empty,
    /// Not there.
    Absent,
}

/// In which direction the code rises (input V/R of P+F encoders).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The code rises with the shaft.
    Up,
    /// The code falls when the shaft rises.
    Down,
}

/// A zero input of the IP-75 that is tied to ground at power-on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ZeroInput {
    /// ZERO SET: the position three seconds later becomes 0.
    Set,
    /// ZERO RESET: three seconds later the zero is the factory's again.
    Reset,
}

/// What is taken off the shaft's position, in turns, for each direction of counting.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Scales {
    up: f64,
    down: f64,
}

impl Scales {
    /// The position that the encoder shows for a shaft.
    pub(super) fn position(&self, shaft: f64, direction: Direction) -> f64 {
        match direction {
            Direction::Up => shaft - self.up,
            Direction::Down => -shaft - self.down,
        }
    }

    /// Takes `turns` off the position that is shown.
    pub(super) fn shift(&mut self, turns: f64, direction: Direction) {
        match direction {
            Direction::Up => self.up += turns,
            Direction::Down => self.down += turns,
        }
    }

    /// The present direction shows 0, and the opposite one moves by the value before (P+F
    /// article, "Preset function"): after a change of direction the code is not 0.
    pub(super) fn preset(&mut self, shaft: f64, direction: Direction) {
        let before = self.position(shaft, direction);
        self.up += before;
        self.down += before;
    }
}

/// By how many whole turns a counter is wrong after the shaft has moved from `off` to `on`
/// without power; `None` when the number is lost altogether.
pub(super) fn slipped(counter: Counter, battery: Battery, off: f64, on: f64) -> Option<f64> {
    match (counter, battery) {
        (Counter::Volatile, _) | (Counter::Battery, Battery::Empty | Battery::Absent) => None,
        (Counter::Battery, Battery::Good | Battery::Low) => Some(0.0),
        // Flash knows the angle it went off at, and takes the shorter way to the present one.
        (Counter::Flash, _) => {
            let (turns, part) = split(on - off);
            Some(turns as f64 + if part < 0.5 { 0.0 } else { 1.0 })
        }
    }
}
