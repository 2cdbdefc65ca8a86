//! Draws a frame as SVG: its bits, its fields, and what the wires do.
//!
//! `frame_svg --format biss-c --angle-bits 17 --frame 82000580006069 > frame.svg`; parameters as
//! in [`encoderscope::profile`]. `--frame` is the frame as a dump has it, in hexadecimal or in
//! bits; without it a frame with sensible values is drawn. Further: `--theme light|dark|auto`,
//! `--width PIXELS`, `--timing` adds the wires, at a clock of `--clock HERTZ`; `--wavejson` and
//! `--bitfield` print those for WaveDrom instead.

#[path = "flags/flags.rs"]
mod flags;

use encoderscope::{
    bits::BitString,
    decode::{Decoded, Decoder, Frame},
    diagram::{
        Master, Timeline, bitfield,
        svg::{self, Style, Theme},
        wavejson,
    },
    dump,
    emulator::{Emulator, Shaft},
    format::Medium,
    framing::Why,
    profile::Profile,
};
use flags::Flags;
use std::{error::Error, process::ExitCode};

/// Where the shaft of the frame that is drawn without `--frame` stands, in turns.
const TURNS: f64 = 5.5;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("frame_svg: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let flags = Flags::read(&["timing", "wavejson", "bitfield"])?;
    let find = |wanted: &str| {
        let mut pairs = flags.pairs();
        pairs.find(|(name, _)| *name == wanted).map(|pair| pair.1)
    };
    let own = ["frame", "theme", "width", "clock"];
    let parameters = flags.pairs().filter(|(name, _)| !own.contains(name));
    let decoder = Decoder::new(Profile::parse(parameters)?)?;

    let mut style = Style::default();
    if let Some(name) = find("theme") {
        style.theme = Theme::parse(name)
            .ok_or_else(|| format!("--theme: {name:?} is not known; known: light dark auto"))?;
    }
    if let Some(width) = find("width") {
        style.width = number("width", width)?;
    }
    let mut master = Master::default();
    if let Some(hertz) = find("clock") {
        master.hertz = number("clock", hertz)?;
    }

    let bits = match find("frame") {
        Some(text) => given(&decoder, text)?,
        None => sensible(&decoder)?,
    };
    let frame = read(&decoder, &bits)?;
    let timeline = Timeline::new(&frame.layout, frame.bits, &master);
    if flags.has("bitfield") {
        println!("{}", bitfield::written(&frame.layout));
    } else if flags.has("wavejson") {
        println!("{}", wavejson::written(&frame, &timeline));
    } else {
        let timeline = flags.has("timing").then_some(&timeline);
        print!("{}", svg::frame(&frame, timeline, &style));
    }
    Ok(())
}

fn number(name: &str, text: &str) -> Result<u32, String> {
    text.parse()
        .map_err(|_| format!("--{name}: {text:?} is not a whole number"))
}

/// The frame of a dump, which must be one.
fn given(decoder: &Decoder, text: &str) -> Result<BitString, String> {
    let dump = dump::parse(text, decoder.profile().medium());
    let unit = match decoder.profile().medium() {
        Medium::Bits => "bits",
        Medium::Bytes | Medium::Text => "bytes",
    };
    let mut found = Vec::new();
    let mut skipped = Vec::new();
    decoder.dump(&dump, &mut |decoded| match decoded {
        Decoded::Frame(frame) => {
            let mut bits = BitString::default();
            for at in 0..frame.bits.len() {
                bits.push(frame.bits.bit(at));
            }
            found.push(bits);
        }
        Decoded::Skip { why, .. } => skipped.push(match why {
            Why::Truncated { have, need } => format!("only {have} of {need} {unit}"),
            other => other.to_string(),
        }),
    });
    match (found.len(), skipped.first()) {
        (1, _) => Ok(found.remove(0)),
        (0, Some(why)) => Err(format!("--frame: no frame: {why}")),
        (0, None) => Err(format!("--frame: nothing to be read in {text:?}")),
        (count, _) => Err(format!("--frame: {count} frames; only one can be drawn")),
    }
}

/// A frame of an encoder that stands half a turn after its fifth.
fn sensible(decoder: &Decoder) -> Result<BitString, Box<dyn Error>> {
    let encoder = Emulator::new(*decoder.profile(), Shaft::still(TURNS))?;
    Ok(decoder.encode(&encoder.values(0)))
}

fn read<'a>(decoder: &'a Decoder, bits: &'a BitString) -> Result<Frame<'a>, Box<dyn Error>> {
    let bits = bits.as_bits();
    match decoder.profile().medium() {
        Medium::Bits => decoder.line(bits).map_err(|why| why.to_string().into()),
        Medium::Bytes | Medium::Text => {
            let frame = decoder.frame(bits.bytes());
            frame.ok_or_else(|| "these bytes begin no frame".into())
        }
    }
}
