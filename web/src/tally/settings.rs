//! Guided settings: their progress, their end, and the EEPROM.

use super::{Tally, frame_of, shown};
use crate::message::{Cell, Outcome, Progress, Setting};
use encoderscope::sequence::{Event, Holds};

impl Tally {
    /// A sequence begins.
    pub fn begin(&mut self, setting: Setting, total: usize) {
        let before = self
            .decoder
            .as_ref()
            .zip(self.last_good.as_ref())
            .and_then(|(decoder, bytes)| shown(&frame_of(decoder, bytes, true)?));
        self.progress = Some(Progress {
            setting,
            done: 0,
            total: total as u32,
            count: None,
            before,
            held: self.held(setting),
            outcome: None,
        });
        self.changed = true;
    }

    /// A cell of the EEPROM has been asked for.
    pub const fn ask_memory(&mut self, address: u8) {
        self.memory = Some(Cell {
            address,
            data: None,
        });
        self.changed = true;
    }

    /// What the cell that a setting writes held when it was read last.
    fn held(&self, setting: Setting) -> Option<u8> {
        match (setting, self.memory) {
            (Setting::Memory { address, .. }, Some(cell)) if cell.address == address => cell.data,
            _ => None,
        }
    }

    /// What the cell that was to be written holds now.
    fn settle_memory(&mut self, holds: Holds) {
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

    /// A sequence could not begin.
    pub fn refuse(&mut self, setting: Setting, why: &str) {
        self.begin(setting, 0);
        self.end(Some(false), why.into());
    }

    /// What a sequence says.
    pub fn follow(&mut self, event: &Event) {
        self.changed = true;
        match event {
            Event::Transmit(_) => {}
            Event::Progress { done, count, .. } => {
                if let Some(progress) = &mut self.progress {
                    progress.done = *done as u32;
                    progress.count = count.or(progress.count);
                }
            }
            Event::Ended { stop, holds, .. } => {
                self.settle_memory(*holds);
                let changed = match holds {
                    Holds::New => Some(true),
                    Holds::Old => Some(false),
                    Holds::Unknown => None,
                };
                let text = match stop {
                    Some(stop) => format!("Stopped: {stop}; {holds}."),
                    None => format!("Done: {holds}."),
                };
                self.end(changed, text);
            }
        }
    }

    fn end(&mut self, changed: Option<bool>, text: String) {
        // What was read before says nothing about the shaft any more.
        self.places.clear();
        self.trail.jump();
        if let Some(progress) = &mut self.progress {
            progress.outcome = Some(Outcome { changed, text });
        }
        self.changed = true;
    }

    /// The outcome has been read.
    pub fn forget_progress(&mut self) {
        self.progress = None;
        self.changed = true;
    }
}
