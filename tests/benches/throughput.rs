//! How fast the core reads a stream: raw bytes a second, framing, checks and readings included;
//! and how fast it reads pasted text, in bytes of text.
//!
//! `cargo bench -p encoderscope-tests`; the limit beside it only adds the bytes up.
#![allow(missing_docs)]

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    native::run();
}

#[cfg(not(target_arch = "wasm32"))]
mod native {
    use encoderscope::{
        decode::Decoder, dump::Reader, format::Medium, framing::Framer, reading::Values,
    };
    use encoderscope_tests::decoder;
    use std::{hint::black_box, time::Instant};

    const BYTES: usize = 16_000_000;
    /// What a serial port delivers at once.
    const CHUNK: usize = 65_536;
    const ROUNDS: usize = 20;
    /// Pasted text, line by line.
    const TEXTS: [(&str, &str); 3] = [
        ("text of plain bytes", "1a 20 29 c0 3b 17 00 00 00 c8 37\n"),
        (
            "text of a log",
            "[12:00:01.234] RX: 1A 20 29 C0 3B 17 00 00 00 C8 37\n",
        ),
        (
            "text with comments",
            "1A 20 29 C0 3B 17 00 00 00 C8 37 // at rest\n",
        ),
    ];

    pub(crate) fn run() {
        println!("{:<28} {:>10} {:>16}", "", "MB/s", "of adding up");
        // An argument chooses the lines that hold it.
        let chosen = |name: &str| {
            let mut wanted = std::env::args()
                .skip(1)
                .filter(|word| !word.starts_with('-'));
            wanted.all(|word| name.contains(&word))
        };
        for (name, line) in TEXTS {
            if chosen(name) {
                let text = line.repeat(BYTES / line.len());
                let bytes = text.as_bytes();
                let (sum, read) = (best(|| sum(bytes)), best(|| parsed(&text)));
                report(name, bytes.len(), sum, read);
            }
        }
        for parameters in [
            "format=period",
            "format=rs485 command=1 turns-bits=0",
            "format=t485",
            "format=bus",
            "format=asi1",
            "format=asi4",
        ] {
            if !chosen(parameters) {
                continue;
            }
            let decoder = decoder(parameters);
            let bytes = stream(&decoder);
            let read = best(|| read(&decoder, black_box(&bytes)));
            report(parameters, bytes.len(), best(|| sum(&bytes)), read);
        }
    }

    fn report(name: &str, bytes: usize, sum: f64, read: f64) {
        let rate = bytes as f64 / read / 1e6;
        println!("{name:<28} {rate:>10.0} {:>16.3}", sum / read);
    }

    fn sum(bytes: &[u8]) -> u64 {
        let bytes = black_box(bytes).iter();
        u64::from(bytes.fold(0u32, |sum, byte| sum.wrapping_add((*byte).into())))
    }

    /// Reads pasted text as it comes from a file.
    fn parsed(text: &str) -> u64 {
        let mut reader = Reader::new(Medium::Bytes, text);
        for chunk in black_box(text).as_bytes().chunks(CHUNK) {
            reader.push(chunk);
        }
        let dump = reader.finish();
        let lines = text.len() / dump.len();
        assert!(lines < 100 && dump.unread().is_empty());
        dump.bytes().len() as u64
    }

    /// A shaft that turns through many turns.
    fn stream(decoder: &Decoder) -> Vec<u8> {
        let profile = decoder.profile();
        let mut bytes = Vec::with_capacity(BYTES + 16);
        let mut index = 0u64;
        while bytes.len() < BYTES {
            let position = 300.3 + index as f64 * 0.000_37;
            let angle = position.fract() * 2f64.powi(profile.angle_bits as i32);
            let values = Values {
                turns: Some(position as i64 % 65_536),
                angle: Some(angle as u64),
                ..Values::default()
            };
            bytes.extend(decoder.encode(&values).into_bytes());
            index += 1;
        }
        bytes
    }

    /// Reads everything; returns something that depends on all of it.
    fn read(decoder: &Decoder, bytes: &[u8]) -> u64 {
        let mut framer = Framer::at_start();
        let mut sum = 0u64;
        let mut frames = 0u64;
        let mut sink = |piece: encoderscope::framing::Piece<'_>| {
            if let Some(reading) = piece.reading() {
                frames += 1;
                sum = sum
                    .wrapping_add(reading.angle)
                    .wrapping_add(reading.turns.unwrap_or(0) as u64)
                    .wrapping_add(reading.status.unwrap_or(0).into())
                    .wrapping_add(u64::from(reading.error) + u64::from(reading.warning));
            }
        };
        for chunk in bytes.chunks(CHUNK) {
            framer.push(decoder, chunk, &mut sink);
        }
        framer.finish(decoder, &mut sink);
        let least = bytes.len() / decoder.longest();
        assert!(
            frames as usize * 100 > least * 99,
            "{frames} of {least} frames"
        );
        sum
    }

    /// Seconds of the fastest of a few rounds.
    fn best(run: impl Fn() -> u64) -> f64 {
        let rounds = (0..ROUNDS).map(|_| {
            let start = Instant::now();
            black_box(run());
            start.elapsed().as_secs_f64()
        });
        rounds.fold(f64::INFINITY, f64::min)
    }
}
