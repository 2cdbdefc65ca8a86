//! How fast the core reads a stream: raw bytes a second, framing, checks and readings included;
//! also where one byte in a hundred is changed, lost, or has another in front of it; and how fast
//! it reads stored lines of bit formats, pasted text, and recordings of clock and data, the latter
//! in bytes of text.
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
        capture::{Options, Recording, sniff, wave::Wave},
        columns::Columns,
        decode::{Decoder, Words},
        dump::Reader,
        format::Medium,
        framing::Framer,
        reading::Values,
    };
    use encoderscope_tests::{
        Noise,
        captures::{Writing, written},
        decoder, disturbed,
    };
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
        println!("{:<42} {:>10} {:>16}", "", "MB/s", "of adding up");
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
                report(name, text.as_bytes(), |_| parsed(&text));
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
            let noisy = format!("{parameters} noise");
            if !chosen(&noisy) {
                continue;
            }
            let decoder = decoder(parameters);
            let bytes = stream(&decoder);
            if chosen(parameters) {
                report(parameters, &bytes, |bytes| read(&decoder, bytes));
            }
            let bytes = disturbed(&bytes, 10, &mut Noise::new(7));
            report(&noisy, &bytes, |bytes| read(&decoder, bytes));
        }
        for parameters in ["format=biss-c", "format=ssi", "format=ssi-tree"] {
            let decoder = decoder(parameters);
            let bits = decoder.main_layout().len;
            let name = format!("words {parameters}");
            if chosen(&name) {
                report(&name, &stream(&decoder), |bytes| {
                    stored(&decoder, bits, bytes)
                });
            }
            let name = format!("text {parameters}");
            if chosen(&name) {
                let text = pasted(&stream(&decoder), bits.div_ceil(8));
                report(&name, text.as_bytes(), |_| pasted_lines(&decoder, &text));
            }
        }
        for (name, writing) in [
            ("capture vcd", Writing::Vcd),
            ("capture saleae", Writing::Saleae),
            ("capture sigrok csv", Writing::Sigrok(24)),
        ] {
            if !chosen(name) {
                continue;
            }
            let decoder = decoder("format=ssi angle-bits=17");
            let text = recording(&decoder, writing);
            report(name, text.as_bytes(), |text| recorded(&decoder, text));
        }
    }

    fn report(name: &str, bytes: &[u8], read: impl Fn(&[u8]) -> u64) {
        let sum = best(|| {
            u64::from(
                black_box(bytes)
                    .iter()
                    .fold(0u32, |sum, byte| sum.wrapping_add((*byte).into())),
            )
        });
        let read = best(|| read(black_box(bytes)));
        let rate = |seconds: f64| bytes.len() as f64 / seconds / 1e6;
        println!("{name:<42} {:>10.0} {:>16.3}", rate(read), sum / read);
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

    /// A recording of a shaft that turns.
    fn recording(decoder: &Decoder, writing: Writing) -> String {
        let mut wave = Wave::new(decoder.profile()).expect("a master clocks it");
        let frames = match writing {
            Writing::Sigrok(_) => 1_000,
            _ => 4_000,
        };
        for index in 0..frames {
            let values = Values {
                turns: Some(index / 100),
                angle: Some(index as u64 * 1_311 % (1 << 17)),
                ..Values::default()
            };
            wave.frame(&decoder.encode(&values));
        }
        written(&wave.edges(), wave.now(), writing)
    }

    /// Reads a recording; returns something that depends on all of it.
    fn recorded(decoder: &Decoder, text: &[u8]) -> u64 {
        let kind = sniff(text.get(..4_096).unwrap_or(text)).expect("a recording");
        let found = Recording::read(text, kind, decoder, Options::default()).expect("readable");
        assert!(found.frames.len() >= 1_000);
        assert!(found.frames.iter().all(|frame| frame.violations.is_empty()));
        let clocks = found.frames.iter().map(|frame| u64::from(frame.clocks));
        clocks.sum()
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

    /// Reads stored lines of a bit format.
    fn stored(decoder: &Decoder, bits: usize, bytes: &[u8]) -> u64 {
        let mut words = Words::new(decoder, bits, bytes);
        let mut columns = Columns::default();
        let mut sum = 0u64;
        for chunk in bytes.chunks(CHUNK) {
            words.push_runs(chunk, &mut |run| columns.take(&run));
            sum = sum.wrapping_add(columns.angle.last().copied().unwrap_or(0));
            black_box(&columns);
            columns.clear();
        }
        sum
    }

    /// Frames of so many bytes as hexadecimal digits, one a line.
    fn pasted(bytes: &[u8], each: usize) -> String {
        let line = |frame: &[u8]| {
            let digits: Vec<String> = frame.iter().map(|byte| format!("{byte:02X}")).collect();
            digits.join(" ") + "\n"
        };
        bytes[..BYTES / 4].chunks_exact(each).map(line).collect()
    }

    /// Reads such text into columns.
    fn pasted_lines(decoder: &Decoder, text: &str) -> u64 {
        let mut reader = Reader::new(decoder.profile().medium(), text);
        reader.push(text.as_bytes());
        let mut columns = Columns::default();
        decoder.dump_runs(&reader.finish(), &mut |run| columns.take(&run));
        columns.angle.last().copied().unwrap_or(0)
    }

    /// Reads everything; returns something that depends on all of it.
    fn read(decoder: &Decoder, bytes: &[u8]) -> u64 {
        let mut framer = Framer::at_start();
        let mut columns = Columns::default();
        let mut sum = 0u64;
        let mut frames = 0;
        for chunk in bytes.chunks(CHUNK) {
            framer.push_runs(decoder, chunk, &mut |run| columns.take(&run));
            frames += columns.len();
            sum = sum.wrapping_add(columns.angle.last().copied().unwrap_or(0));
            black_box(&columns);
            columns.clear();
        }
        framer.finish_runs(decoder, &mut |run| columns.take(&run));
        frames += columns.len();
        let least = bytes.len() / decoder.longest();
        assert!(frames * 100 > least * 80, "{frames} of {least} frames");
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
