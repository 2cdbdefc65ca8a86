//! Decodes a dump from standard input: one JSON object a frame, then a summary.
//!
//! `decode --format t485 --angle-bits 23 < dump.txt`; parameters as in
//! [`encoderscope::profile`]. With `--detect`, ranks what the dump may be instead.

#[path = "flags/flags.rs"]
mod flags;

use encoderscope::{
    decode::{Decoded, Decoder},
    detect::detect,
    dump,
    profile::Profile,
};
use flags::Flags;
use std::{
    io::{self, Read, Write},
    process::ExitCode,
};

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("decode: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn std::error::Error>> {
    let flags = Flags::read(&["detect"])?;
    let mut input = Vec::new();
    io::stdin().read_to_end(&mut input)?;
    let text = String::from_utf8_lossy(&input);
    let mut out = io::BufWriter::new(io::stdout().lock());
    if flags.has("detect") {
        for candidate in detect(&text) {
            writeln!(out, "{}", candidate.record())?;
        }
        return Ok(out.flush()?);
    }

    let profile = Profile::parse(flags.pairs())?;
    let decoder = Decoder::new(profile)?;
    let dump = dump::parse(&text, profile.medium());
    let mut broken = Ok(());
    let summary = decoder.dump(&dump, &mut |decoded| {
        if let Decoded::Frame(frame) = decoded
            && broken.is_ok()
        {
            broken = writeln!(out, "{}", frame.record());
        }
    });
    broken?;
    writeln!(out, "{}", summary.record())?;
    out.flush()?;
    for mark in &dump.unread().places {
        let place = mark.at.start as usize..mark.at.end as usize;
        eprintln!(
            "decode: not readable, left out: {:?} at byte {}",
            text.get(place).unwrap_or_default(),
            mark.at.start
        );
    }
    Ok(())
}
