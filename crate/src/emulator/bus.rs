//! Several encoders on one pair of wires.

use super::Emulator;
use crate::session::Micros;
use alloc::vec::Vec;

/// A bus: every encoder hears the host and the other encoders; what two send at once is spoilt.
#[derive(Debug, Default)]
pub struct Bus {
    /// The encoders.
    pub devices: Vec<Emulator>,
}

impl Bus {
    /// When the next bytes are due.
    #[must_use]
    pub fn deadline(&self) -> Option<Micros> {
        self.devices.iter().filter_map(Emulator::deadline).min()
    }

    /// The host has sent `bytes`.
    pub fn handle_input(&mut self, now: Micros, bytes: &[u8]) {
        for device in &mut self.devices {
            device.handle_input(now, bytes);
        }
    }

    /// The next bytes that have left the wire by `now`.
    pub fn poll_output(&mut self, now: Micros) -> Option<Vec<u8>> {
        let due = self.deadline().filter(|due| *due <= now)?;
        let mut line: Option<Vec<u8>> = None;
        let mut talking = Vec::new();
        for (index, device) in self.devices.iter_mut().enumerate() {
            let Some(bytes) = device.poll_output(due) else {
                continue;
            };
            talking.push(index);
            // A 0 of one device pulls the line against a 1 of another.
            line = Some(match line {
                None => bytes,
                Some(other) => other.iter().zip(&bytes).map(|(a, b)| a & b).collect(),
            });
        }
        let line = line?;
        for (index, device) in self.devices.iter_mut().enumerate() {
            if !talking.contains(&index) {
                device.handle_input(due, &line);
            }
        }
        Some(line)
    }
}
