//! Takes what the session says: counts it, and keeps the last good frame.

use super::{Kind, Place, Tally, frame_of, shown};
use crate::message::Cell;
use encoderscope::{
    bits,
    decode::{Decoder, Frame},
    history::Sample,
    session::{Micros, Output},
};

/// Replies over which latencies are sorted.
const LATENCIES: usize = 512;

impl Tally {
    /// Counts what the session says; returns whether it is a good frame.
    pub fn take(&mut self, now: Micros, output: &Output) -> bool {
        match output {
            Output::Transmit(bytes) => {
                self.transcript.sent(now, bytes, None);
                self.pace.request();
                self.remember(now, bytes, Kind::Asked);
            }
            Output::Silent { .. } => {
                self.counts.silent += 1.0;
                self.pace.frame(now, false);
                self.trail.fail(now);
            }
            Output::Skip { bytes, why } => {
                self.counts.skipped += bytes.len() as f64;
                self.remember(now, bytes, Kind::Skip(*why));
            }
            Output::Frame {
                bytes,
                sure,
                latency,
            } => {
                self.counts.framed += bytes.len() as f64;
                return self.take_frame(now, bytes, *sure, *latency);
            }
        }
        self.pass();
        false
    }

    fn take_frame(
        &mut self,
        now: Micros,
        bytes: &[u8],
        sure: bool,
        latency: Option<Micros>,
    ) -> bool {
        let Some(decoder) = self.decoder.take() else {
            return false;
        };
        let frame = frame_of(&decoder, bytes, sure);
        let good = frame
            .as_ref()
            .is_some_and(|frame| frame.faults().is_empty());
        self.pace.frame(now, good);
        if let Some(frame) = &frame {
            self.take_device(now, frame, good);
        }
        let memory = frame.as_ref().map(|frame| frame.values().memory);
        match (good, &frame) {
            (true, Some(frame)) => {
                self.counts.good += 1.0;
                // The encoder takes its position when it is asked.
                let at = now - latency.unwrap_or(0).min(now);
                if let Some((Some(address), data)) = memory {
                    // It says nothing about the shaft.
                    self.memory = Some(Cell { address, data });
                } else if self.devices.is_empty() || is_own(&decoder, frame) {
                    self.take_good(at, frame);
                }
                self.good_times.push_back(now);
                self.forget(now);
                self.latencies.extend(latency);
                if self.latencies.len() > LATENCIES {
                    self.latencies.pop_front();
                }
            }
            _ => {
                self.counts.bad += 1.0;
                self.trail.fail(now);
            }
        }
        self.decoder = Some(decoder);
        self.remember(now, bytes, Kind::Frame { sure, good });
        good
    }

    /// A good frame of the encoder on the dial.
    fn take_good(&mut self, now: Micros, frame: &Frame<'_>) {
        let named = frame.layout.fields().flat_map(|field| {
            let raw = frame.layout.read(field, frame.bits);
            field
                .row
                .bits
                .iter()
                .map(move |bit| bits::bit(raw, bit.place))
        });
        for (index, set) in named.enumerate() {
            if index == self.seen_bits.len() {
                self.seen_bits.push(0.0);
            }
            self.seen_bits[index] += f64::from(u8::from(set));
        }
        if let Some(shown) = shown(frame) {
            self.places.push_back(Place {
                at: now,
                part: shown.degrees / 360.0,
                turns: shown.turns,
            });
            let sample = Sample {
                degrees: shown.degrees,
                turns: shown.turns,
                speed: shown.speed,
                temperature: shown.temperature,
            };
            self.trail.take(now, shown.angle as u64, &sample);
        }
        let bytes = frame.bits.bytes();
        match &mut self.last_good {
            Some(last) => {
                last.clear();
                last.extend_from_slice(bytes);
            }
            none => *none = Some(bytes.into()),
        }
        self.fresh = true;
    }
}

/// Whether a frame comes from the device of the profile.
fn is_own(decoder: &Decoder, frame: &Frame<'_>) -> bool {
    let address = frame.values().address;
    address.is_none_or(|address| u32::from(address) == decoder.profile().address)
}
