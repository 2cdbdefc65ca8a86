//! What goes on beside reading: scans, searches, and bytes sent by hand.

use super::{Kind, RATE_OVER, Tally, shown};
use crate::{
    link::query,
    message::{Device, Found, Search, SearchStage, Shown, Trial},
};
use encoderscope::{
    decode::{Decoder, Frame},
    finder::Finder,
    format::Format,
    language::{msg, t},
    recording::Purpose,
    session::Micros,
    text,
};

/// Why nothing can be asked.
pub(crate) const RESTLESS: &str = msg("Something talks on the line all the time.");

/// What is kept of a device of a BUS.
pub(super) struct Kept {
    pub(super) address: u8,
    reading: Option<Shown>,
    good: f64,
    bad: f64,
    at: Option<Micros>,
    /// Between its last two good frames.
    apart: Micros,
}

impl Kept {
    const fn new(address: u8) -> Self {
        Self {
            address,
            reading: None,
            good: 0.0,
            bad: 0.0,
            at: None,
            apart: 0,
        }
    }

    pub(super) fn shown(&self, now: Micros) -> Device {
        Device {
            address: self.address,
            reading: self.reading,
            good: self.good,
            bad: self.bad,
            fresh: self
                .at
                .is_some_and(|at| now < at + RATE_OVER.max(3 * self.apart)),
        }
    }
}

/// What came of a scan.
pub(super) struct Scan {
    /// How many devices answer.
    count: usize,
    /// The addresses at which what answers is damaged.
    disturbed: Vec<u8>,
    restless: bool,
}

impl Scan {
    pub(super) fn says(&self) -> String {
        let found = match self.count {
            0 => t("No device answers.").to_owned(),
            1 => t("One device answers.").to_owned(),
            count => text!("{} devices answer.", count),
        };
        let strange = self.disturbed.iter();
        let strange: Vec<String> = strange.map(ToString::to_string).collect();
        match strange.is_empty() {
            true if self.restless => t(RESTLESS).to_owned(),
            true => found,
            false => text!(
                "{} What answers at {} is damaged: a disturbed device, or two with one address.",
                found,
                strange.join(", ")
            ),
        }
    }
}

impl Tally {
    /// A reply, or a part of one, that is not for the session.
    pub fn answered(&mut self, now: Micros, bytes: &[u8]) {
        if !bytes.is_empty() {
            self.remember(now, bytes, Kind::Beside);
        }
    }

    /// Bytes are sent that the session did not ask for.
    pub fn sent(&mut self, now: Micros, bytes: &[u8], purpose: Purpose) {
        self.transcript.sent(now, bytes, Some(purpose));
        self.pace.request();
        self.remember(now, bytes, Kind::Sent(purpose));
    }

    /// A scan is over.
    pub fn scanned(&mut self, addresses: &[u8], finder: &Finder) {
        self.devices = addresses.iter().copied().map(Kept::new).collect();
        self.scan = Some(Scan {
            count: addresses.len(),
            disturbed: finder.disturbed().into(),
            restless: finder.is_restless(),
        });
        self.touch();
    }

    /// A device of a BUS is asked, perhaps beside the one on the dial.
    pub fn meet(&mut self, address: u8) {
        let Some(watched) = self.watched() else {
            return;
        };
        if self.devices.is_empty() && u32::from(address) == watched {
            return;
        }
        let known = |address: u8| move |kept: &Kept| kept.address == address;
        let own = u8::try_from(watched).ok();
        for address in [own, Some(address)].into_iter().flatten() {
            if !self.devices.iter().any(known(address)) {
                self.devices.push(Kept::new(address));
            }
        }
    }

    /// One device alone is read again.
    pub fn forget_devices(&mut self) {
        self.devices.clear();
        self.scan = None;
        self.touch();
    }

    /// The addresses of the devices that are read.
    #[must_use]
    pub fn addresses(&self) -> Vec<u8> {
        self.devices.iter().map(|device| device.address).collect()
    }

    /// The BUS device on the dial.
    pub(super) fn watched(&self) -> Option<u32> {
        let decoder = self.decoder.as_ref();
        let profile = decoder.map(Decoder::profile);
        let bus = profile.filter(|profile| profile.format == Format::Bus);
        bus.map(|profile| profile.address)
    }

    /// How far a search is.
    pub fn searched(&mut self, finder: &Finder) {
        let trials = finder.trials().iter().map(|trial| Trial {
            baud: trial.baud,
            format: trial.format.map(|format| format.name().into()),
            requests: trial.requests,
            bytes: trial.bytes as f64,
            tried: trial.tried,
        });
        let found = finder.found().iter().map(|found| Found {
            profile: query(&found.profile),
            verdict: found.verdict.name().into(),
            evidence: found.evidence.clone(),
            narrowest: found.narrowest,
        });
        self.search = Some(Search {
            trials: trials.collect(),
            found: found.collect(),
            stage: SearchStage::Running,
        });
        self.pass();
    }

    /// A search has come to its end.
    pub const fn end_search(&mut self) {
        if let Some(search) = &mut self.search {
            search.stage = SearchStage::Ended;
        }
    }

    /// Nothing goes on any more on this link.
    pub fn interrupted(&mut self) {
        let running = |search: &&mut Search| search.stage == SearchStage::Running;
        if let Some(search) = self.search.as_mut().filter(running) {
            search.stage = SearchStage::BrokenOff;
        }
        self.touch();
    }

    /// A frame of one device among several.
    pub(super) fn take_device(&mut self, now: Micros, frame: &Frame<'_>, good: bool) {
        let address = frame.values().address;
        let mut devices = self.devices.iter_mut();
        if let Some(device) = devices.find(|device| Some(device.address) == address) {
            match good {
                true => {
                    device.good += 1.0;
                    device.reading = shown(frame);
                    device.apart = device.at.map_or(0, |at| now - at);
                    device.at = Some(now);
                }
                false => device.bad += 1.0,
            }
        }
    }
}
