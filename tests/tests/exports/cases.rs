//! Profiles, frames of each, and what is to be read from them.

use encoderscope::{
    bits::{Bits, codes},
    decode::Decoder,
    export::{Language, source},
    format::{Format, Medium, t485},
    reading::Values,
    record::hex,
};
use encoderscope_tests::{Noise, decoder};
use std::fmt::Write as _;

pub(crate) const PROFILES: &[&str] = &[
    "format=ssi",
    "format=ssi angle-bits=13 turns-bits=0",
    "format=ssi angle-bits=32 turns-bits=16",
    "format=ssi angle-bits=19 turns-bits=11 turns-code=signed",
    "format=biss-c",
    "format=biss-c angle-bits=17 turns-bits=0 status-bits=0 ack-bits=1",
    "format=biss-c angle-bits=64 turns-bits=0 status-bits=0",
    "format=biss-c angle-bits=1 turns-bits=63 turns-code=signed ack-bits=9",
    "format=biss-c angle-bits=19 turns-bits=13 status-bits=3 status-active=low turns-code=signed",
    "format=biss-c angle-bits=21 turns-bits=32 turns-code=signed status-bits=8",
    "format=rs485 command=0",
    "format=rs485 command=1 angle-bits=16 turns-bits=0",
    "format=rs485 command=d angle-bits=17 turns-bits=12 turns-code=signed",
    "format=rs485 command=s angle-bits=24 turns-bits=16 turns-code=signed",
    "format=rs485 command=t angle-bits=9 turns-bits=1",
    "format=t485",
    "format=t485 angle-bits=17 dialect=tamagawa",
    "format=t485 angle-bits=24 turns-bits=24 turns-code=signed dialect=tamagawa",
    "format=t485 angle-bits=11 turns-bits=0",
    "format=bus",
    "format=bus angle-bits=16 turns-bits=0 parity=even",
    "format=bus angle-bits=9 turns-bits=5 parity=none turns-code=signed address=3",
    "format=period",
    "format=period angle-bits=20 turns-bits=0",
    "format=asi1",
    "format=asi1 angle-bits=22 marker=first",
    "format=asi1 angle-bits=5",
    "format=asi4",
    "format=asi4 angle-bits=16",
    "format=asi4 angle-bits=1",
    "format=ssi7",
    "format=ssi7 angle-bits=22 frame-bits=24",
    "format=ssi7 angle-bits=7 frame-bits=27",
    "format=ssi-tree",
    "format=ssi-tree turns-bits=0",
    "format=ssi-tree code=binary align=right parity=even frame-bits=32",
    "format=ssi-tree angle-bits=18 turns-bits=16 parity=odd frame-bits=41",
    "format=ssi-tree angle-bits=9 turns-bits=5 turns-code=signed",
    "format=ssi-tree angle-bits=10 turns-bits=7 code=binary align=tree parity=odd",
    "format=ssi-tree angle-bits=18 turns-bits=3 align=right frame-bits=64 turns-code=signed",
];

/// Good frames with random numbers, of each profile.
pub(crate) const FRAMES: usize = 200;

/// A profile with its sources, frames and what is to be read from them.
pub(crate) struct Case {
    pub(crate) decoder: Decoder,
    pub(crate) parameters: &'static str,
    /// Names of the frame's members, and whether they may be absent.
    pub(crate) members: Vec<(String, bool)>,
    pub(crate) frames: Vec<Vec<u8>>,
    pub(crate) expected: Vec<String>,
}

impl Case {
    fn new(parameters: &'static str, noise: &mut Noise) -> Self {
        let decoder = decoder(parameters);
        let members = members(&decoder);
        let mut frames: Vec<_> = (0..FRAMES).map(|_| frame(&decoder, noise)).collect();
        for index in 0..4 {
            let good = frames[index].clone();
            for bit in 0..good.len() * 8 {
                let mut flipped = good.clone();
                flipped[bit / 8] ^= 0x80 >> (bit % 8);
                frames.push(flipped);
            }
            let longer: Vec<u8> = good.iter().copied().chain([0]).collect();
            frames.extend([good[1..].to_vec(), good[..good.len() - 1].to_vec(), longer]);
        }
        frames.push(Vec::new());
        let expected = frames
            .iter()
            .map(|frame| expected(&decoder, &members, frame))
            .collect();
        Self {
            decoder,
            parameters,
            members,
            frames,
            expected,
        }
    }

    pub(crate) fn function(&self) -> String {
        format!(
            "decode_{}",
            self.decoder.profile().format.name().replace('-', "_")
        )
    }

    pub(crate) fn compare(&self, language: Language, lines: &[String]) {
        assert_eq!(
            lines.len(),
            self.frames.len(),
            "{} {language:?}",
            self.parameters
        );
        for ((frame, expected), line) in self.frames.iter().zip(&self.expected).zip(lines) {
            assert_eq!(
                line,
                expected,
                "{} {language:?} {}",
                self.parameters,
                hex(frame)
            );
        }
        let good = lines.iter().filter(|line| *line != "bad").count();
        assert!(
            good >= FRAMES / 2,
            "{}: {good} good frames",
            self.parameters
        );
    }
}

/// The members of the C struct, and whether each may be absent.
pub(crate) fn members(decoder: &Decoder) -> Vec<(String, bool)> {
    let text = source(decoder, Language::C);
    let body = text.split_once("_frame {\n").expect("a struct").1;
    let body = body.split_once("};").expect("its end").0;
    let names: Vec<&str> = body
        .lines()
        .filter_map(|line| line.strip_suffix(';')?.rsplit_once(' '))
        .map(|(_, name)| name)
        .collect();
    let optional = |name: &str| names.iter().any(|other| *other == format!("has_{name}"));
    let plain = names.iter().filter(|name| !name.starts_with("has_"));
    plain
        .map(|name| ((*name).to_owned(), optional(name)))
        .collect()
}

pub(crate) fn frame(decoder: &Decoder, noise: &mut Noise) -> Vec<u8> {
    let profile = decoder.profile();
    let flag = |noise: &mut Noise| Some(noise.below(2) == 1);
    let byte = |noise: &mut Noise| Some(noise.draw() as u8);
    let dialect = profile.dialect;
    let requests = t485::Request::ALL
        .iter()
        .filter(|known| known.is_known_to(dialect));
    let requests: Vec<_> = requests.map(|known| known.byte() >> 3 & 0x0f).collect();
    let wide = noise.draw() ^ noise.draw() << 20 ^ noise.draw() << 40;
    // All numbers of a few bits, small and large ones of many.
    let angle = (wide >> noise.below(60)) & encoderscope::bits::mask(profile.angle_bits as usize);
    let status = noise.draw() as u8 & encoderscope::bits::mask(profile.status_bits as usize) as u8;
    let tenths = |noise: &mut Noise| Some(i32::from(noise.draw() as i16));
    let values = Values {
        turns: Some((noise.draw() ^ noise.draw() << 20) as i64),
        angle: Some(angle),
        error: flag(noise),
        valid: flag(noise),
        zero_default: flag(noise),
        warning: flag(noise),
        status: Some(match profile.format {
            Format::T485 => noise.draw() as u8 & 0xf0,
            _ => status,
        }),
        alarm: byte(noise),
        enid: byte(noise),
        speed: tenths(noise),
        temperature: tenths(noise),
        count: byte(noise),
        operation: Some(match profile.format {
            Format::T485 => requests[noise.below(requests.len() as u64) as usize],
            _ => noise.below(3) as u8,
        }),
        address: Some(noise.below(32) as u8),
        memory: (byte(noise), byte(noise)),
        crc: None,
        parity: None,
    };
    decoder.encode(&values).into_bytes()
}

/// The line that a program must write for a frame.
pub(crate) fn expected(decoder: &Decoder, members: &[(String, bool)], frame: &[u8]) -> String {
    let layout = decoder.main_layout();
    let values = match decoder.profile().medium() {
        Medium::Bits => {
            let bits = Bits::of_bytes(frame);
            let good = bits.len() >= layout.len && layout.holds(bits);
            good.then(|| layout.values(bits))
        }
        Medium::Bytes | Medium::Text => {
            let found = decoder.frame(frame).filter(encoderscope::decode::Frame::ok);
            found.map(|frame| frame.values())
        }
    };
    let Some(values) = values else {
        return "bad".into();
    };
    let mut out = String::from("ok");
    for (name, _) in members {
        if let Some(value) = quantity(&values, name) {
            write!(out, " {name}={value}").expect("room");
        }
    }
    if let Some(angle) = values.angle {
        let degrees = angle as f64 * 360.0 / codes(decoder.profile().angle_bits) as f64;
        write!(out, " degrees={degrees:.6}").expect("room");
    }
    out
}

pub(crate) fn quantity(values: &Values, name: &str) -> Option<i128> {
    match name {
        "turns" => values.turns.map(Into::into),
        "angle" => values.angle.map(Into::into),
        "error" => values.error.map(Into::into),
        "warning" => values.warning.map(Into::into),
        "status" => values.status.map(Into::into),
        "alarm" => values.alarm.map(Into::into),
        "enid" => values.enid.map(Into::into),
        "speed" => values.speed.map(Into::into),
        "temperature" => values.temperature.map(Into::into),
        "count" => values.count.map(Into::into),
        "operation" => values.operation.map(Into::into),
        "address" => values.address.map(Into::into),
        "memory_address" => values.memory.0.map(Into::into),
        "memory_data" => values.memory.1.map(Into::into),
        "valid" => values.valid.map(Into::into),
        "zero_default" => values.zero_default.map(Into::into),
        _ => panic!("{name} is no quantity"),
    }
}

pub(crate) fn cases() -> Vec<Case> {
    let mut noise = Noise::new(77);
    let mut made = |parameters: &&'static str| Case::new(parameters, &mut noise);
    PROFILES.iter().map(&mut made).collect()
}
