//! Writes what the benches decode, and what is in it: `bench-data FOLDER MEGABYTES`.
//!
//! Beside a file for each workload, `workloads.json` says how many frames each holds and what
//! their angles add up to. Each has a short front in a file of its own, for what is slow; the first
//! comes in growing lengths too. What the core reads is compared with what was encoded.

use encoderscope::record::{Record, Value};
use encoderscope_tests::workload::{GROWTH, Sums, WORKLOADS, Workload};
use std::{fs, path::Path, process::ExitCode};

/// How many times the whole is longer than its short front.
const SHORT: f64 = 64.0;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, megabytes] = arguments.as_slice() else {
        eprintln!("usage: bench-data FOLDER MEGABYTES");
        return ExitCode::FAILURE;
    };
    let written = match megabytes.parse::<f64>() {
        Ok(megabytes) if megabytes > 0.0 => write(Path::new(folder), megabytes * 1e6),
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

fn write(folder: &Path, bytes: f64) -> Result<(), String> {
    let told = |error: std::io::Error| format!("{}: {error}", folder.display());
    fs::create_dir_all(folder).map_err(told)?;
    let mut workloads = Vec::new();
    for workload in &WORKLOADS {
        let record = part(workload, workload.name, bytes, folder)?
            .with("title", workload.title)
            .with("profile", workload.decoder().profile().record());
        let short = format!("{}-short", workload.name);
        let short = part(workload, &short, bytes / SHORT, folder)?;
        workloads.push(record.with("short", short).into());
    }
    let mut growth = Vec::new();
    for (name, times) in GROWTH {
        let name = format!("growth-{name}");
        growth.push(part(&WORKLOADS[0], &name, bytes * times, folder)?.into());
    }
    let all = Record::new()
        .with("workloads", Value::List(workloads))
        .with("growth", Value::List(growth));
    fs::write(folder.join("workloads.json"), format!("{all}\n")).map_err(told)
}

/// Writes a file, and says what is in it as the core reads it.
fn part(workload: &Workload, name: &str, bytes: f64, folder: &Path) -> Result<Record, String> {
    let (input, made) = workload.input(bytes as usize);
    let mut read = Sums::default();
    let mut add = |columns: &_| read.add(columns);
    workload.read(&workload.decoder(), &input, &mut add);
    if !workload.admits(made, read) {
        return Err(format!("{name}: {made:?} were encoded, {read:?} decoded"));
    }
    let file = format!("{name}.bin");
    fs::write(folder.join(&file), &input).map_err(|error| format!("{file}: {error}"))?;
    Ok(Record::new()
        .with("name", name)
        .with("file", file)
        .with("bytes", input.len())
        .with("frames", read.frames)
        .with("angles", read.angles))
}
