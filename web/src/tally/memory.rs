//! The cell of the EEPROM that was asked for last.

use super::Tally;
use crate::message::{Cell, Setting};
use encoderscope::sequence::Holds;

impl Tally {
    /// A cell of the EEPROM has been asked for.
    pub const fn ask_memory(&mut self, address: u8) {
        self.memory = Some(Cell {
            address,
            data: None,
        });
        self.touch();
    }

    /// What the cell that a setting writes held when it was read last.
    pub(super) fn held(&self, setting: Setting) -> Option<u8> {
        match (setting, self.memory) {
            (Setting::Memory { address, .. }, Some(cell)) if cell.address == address => cell.data,
            _ => None,
        }
    }

    /// What the cell that was to be written holds now.
    pub(super) fn settle_memory(&mut self, holds: Holds) {
        let setting = self.progress.as_ref().map(|progress| progress.setting);
        if let Some(Setting::Memory { address, data }) = setting {
            let data = match holds {
                Holds::New => Some(data),
                Holds::Old => self.held(Setting::Memory { address, data }),
                Holds::Unknown => None,
            };
            self.memory = Some(Cell { address, data });
        }
    }
}
