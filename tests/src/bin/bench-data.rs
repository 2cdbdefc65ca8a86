//! Writes what the benches decode, and what is in it: `bench-data FOLDER MEGABYTES`.
//!
//! Beside a file for each workload, `workloads.json` says how many frames each holds and what
//! their angles add up to: over the whole of it, and over a short front for what is slow. Clean
//! frames are counted as they are made, so that the core is checked as well.

use encoderscope::record::{Record, Value};
use encoderscope_tests::workload::{Sums, WORKLOADS, Workload, Writing};
use std::{fs, path::Path, process::ExitCode};

/// How many times the whole is longer than its short front.
const SHORT: usize = 64;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, megabytes] = arguments.as_slice() else {
        eprintln!("usage: bench-data FOLDER MEGABYTES");
        return ExitCode::FAILURE;
    };
    let written = match megabytes.parse::<usize>() {
        Ok(megabytes) if megabytes > 0 => write(Path::new(folder), megabytes * 1_000_000),
        _ => Err(format!("{megabytes} is no number of megabytes")),
    };
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("bench-data: {message}");
            ExitCode::FAILURE
        }
    }
}

fn write(folder: &Path, bytes: usize) -> Result<(), String> {
    let told = |error: std::io::Error| format!("{}: {error}", folder.display());
    fs::create_dir_all(folder).map_err(told)?;
    let mut all = Vec::new();
    for workload in &WORKLOADS {
        let (input, sums) = workload.input(bytes);
        let (short, short_sums) = workload.input(bytes / SHORT);
        let file = format!("{}.bin", workload.name);
        fs::write(folder.join(&file), &input).map_err(told)?;
        let record = part(workload, &input, sums)?
            .with("name", workload.name)
            .with("title", workload.title)
            .with("profile", workload.decoder().profile().record())
            .with("file", file)
            .with("short", part(workload, &short, short_sums)?);
        all.push(record.into());
    }
    let all = Value::List(all).to_string();
    fs::write(folder.join("workloads.json"), all + "\n").map_err(told)
}

/// What is in a part of the input, as the core reads it.
fn part(workload: &Workload, input: &[u8], made: Sums) -> Result<Record, String> {
    let mut sums = Sums::default();
    workload.read(&workload.decoder(), input, &mut |columns| sums.add(columns));
    let lost = made.frames.abs_diff(sums.frames) * 4 > made.frames;
    if if workload.writing == Writing::Noise { lost } else { sums != made } {
        let name = workload.name;
        return Err(format!("{name}: {made:?} were encoded, {sums:?} decoded"));
    }
    Ok(Record::new()
        .with("bytes", input.len())
        .with("frames", sums.frames)
        .with("angles", sums.angles))
}
