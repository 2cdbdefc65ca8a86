//! The benches, where there is a clock.

mod input;

use criterion::{BenchmarkGroup, Criterion, SamplingMode, Throughput, measurement::WallTime};
use encoderscope::{
    capture::{Options, Recording, sniff, wave::Wave},
    decode::Decoder,
    dump::Reader,
    format::Medium,
    reading::Values,
};
use encoderscope_tests::{
    captures::{Writing as Recorder, written},
    decoder,
    workload::{CHUNK, GROWTH, WORKLOADS, Workload, Writing},
};
use input::Input;
use std::{hint::black_box, time::Duration};

/// What is not in the table of `make bench`.
const OTHERS: [Workload; 6] = [
    stream("period-noise", "format=period", Writing::Noise),
    stream("t485-noise", "format=t485", Writing::Noise),
    stream(
        "rs485",
        "format=rs485 command=1 turns-bits=0",
        Writing::Stream,
    ),
    stream("bus", "format=bus", Writing::Stream),
    stream("bus-noise", "format=bus", Writing::Noise),
    stream("asi4", "format=asi4", Writing::Stream),
];
/// Pasted text, line by line.
const TEXTS: [(&str, &str); 3] = [
    ("plain", "1a 20 29 c0 3b 17 00 00 00 c8 37\n"),
    (
        "log",
        "[12:00:01.234] RX: 1A 20 29 C0 3B 17 00 00 00 C8 37\n",
    ),
    ("comments", "1A 20 29 C0 3B 17 00 00 00 C8 37 // at rest\n"),
];
const TEXT: usize = 16_000_000;
const RECORDINGS: [(&str, Recorder, u32); 3] = [
    ("vcd", Recorder::Vcd, 4_000),
    ("saleae", Recorder::Saleae, 4_000),
    ("sigrok-csv", Recorder::Sigrok(24), 1_000),
];

const fn stream(name: &'static str, parameters: &'static str, writing: Writing) -> Workload {
    Workload {
        name,
        title: name,
        parameters,
        writing,
    }
}

pub(crate) fn run() {
    let mut criterion = Criterion::default()
        .sample_size(10)
        .nresamples(2_000)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(3))
        .without_plots()
        .configure_from_args();
    decode(&mut group(&mut criterion, "decode"));
    growth(&mut group(&mut criterion, "growth"));
    limits(&mut group(&mut criterion, "limit"));
    texts(&mut group(&mut criterion, "text"));
    recordings(&mut group(&mut criterion, "capture"));
    criterion.final_summary();
}

fn group<'c>(criterion: &'c mut Criterion, name: &str) -> BenchmarkGroup<'c, WallTime> {
    let mut group = criterion.benchmark_group(name);
    // A run takes milliseconds: every sample is a few of them.
    group.sampling_mode(SamplingMode::Flat);
    group
}

/// Frames into columns.
fn decode(group: &mut BenchmarkGroup<'_, WallTime>) {
    for workload in WORKLOADS.iter().chain(&OTHERS) {
        let decoder = workload.decoder();
        let input = Input::of(workload, 1.0);
        measure(group, workload.name, &input, |bytes| {
            let mut frames = 0;
            workload.read(&decoder, bytes, &mut |columns| {
                frames += black_box(columns).len() as u64;
            });
            frames
        });
    }
}

/// The same for ever longer input.
fn growth(group: &mut BenchmarkGroup<'_, WallTime>) {
    let workload = &WORKLOADS[0];
    let decoder = workload.decoder();
    for (name, times) in GROWTH {
        let input = Input::of(workload, times);
        measure(group, name, &input, |bytes| {
            let mut frames = 0;
            workload.read(&decoder, bytes, &mut |columns| {
                frames += black_box(columns).len() as u64;
            });
            frames
        });
    }
}

/// What the machine does with bytes that nobody reads.
fn limits(group: &mut BenchmarkGroup<'_, WallTime>) {
    let input = Input::of(&WORKLOADS[0], 1.0);
    measure(group, "sum", &input, |bytes| {
        let add = |sum: u32, byte: &u8| sum.wrapping_add(u32::from(*byte));
        bytes.iter().fold(0, add)
    });
    let mut copy = Vec::new();
    measure(group, "memcpy", &input, |bytes| {
        copy.clear();
        copy.extend_from_slice(bytes);
        black_box(&copy).len()
    });
}

fn measure<T>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    input: &Input<'_>,
    mut run: impl FnMut(&[u8]) -> T,
) {
    group.throughput(Throughput::Bytes(input.most()));
    group.bench_function(name, |bencher| {
        let bytes = input.bytes();
        bencher.iter(|| run(black_box(bytes)));
    });
}

/// Pasted text, as it comes from a file, into bytes.
fn texts(group: &mut BenchmarkGroup<'_, WallTime>) {
    for (name, line) in TEXTS {
        let text = line.repeat(TEXT / line.len());
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let mut reader = Reader::new(Medium::Bytes, black_box(&text));
                for chunk in text.as_bytes().chunks(CHUNK) {
                    reader.push(chunk);
                }
                let dump = reader.finish();
                assert_eq!(dump.bytes().len(), text.len() / line.len() * 11);
                assert!(dump.unread().is_empty());
                dump
            });
        });
    }
}

/// Recordings of clock and data into frames.
fn recordings(group: &mut BenchmarkGroup<'_, WallTime>) {
    let decoder = decoder("format=ssi angle-bits=17");
    for (name, recorder, frames) in RECORDINGS {
        let text = recording(&decoder, recorder, frames);
        let text = text.as_bytes();
        let kind = sniff(text.get(..4_096).unwrap_or(text)).expect("a recording");
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let found = Recording::read(black_box(text), kind, &decoder, Options::default());
                let found = found.expect("readable");
                assert_eq!(found.frames.len(), frames as usize);
                assert!(found.frames.iter().all(|frame| frame.violations.is_empty()));
                found
            });
        });
    }
}

/// A recording of a shaft that turns.
fn recording(decoder: &Decoder, recorder: Recorder, frames: u32) -> String {
    let mut wave = Wave::new(decoder.profile()).expect("a master clocks it");
    for index in 0..frames {
        let values = Values {
            turns: Some(i64::from(index / 100)),
            angle: Some(u64::from(index) * 1_311 % (1 << 17)),
            ..Values::default()
        };
        wave.frame(&decoder.encode(&values));
    }
    written(&wave.edges(), wave.now(), recorder)
}
