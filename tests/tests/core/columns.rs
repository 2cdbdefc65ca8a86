//! Readings in columns are those of the frames, however the input is cut.

use encoderscope::{
    columns::Columns,
    decode::Decoder,
    framing::{Framer, Piece, PieceKind},
    reading::{Reading, Values},
};
use encoderscope_tests::{Noise, decoder};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

const PROFILES: [&str; 14] = [
    "format=period",
    "format=period angle-bits=16 turns-bits=0",
    "format=rs485 command=1 turns-bits=0 angle-bits=17",
    "format=rs485 command=s",
    "format=rs485 command=t turns-code=signed",
    "format=rs485 command=0",
    "format=t485",
    "format=t485 angle-bits=17",
    "format=bus",
    "format=bus angle-bits=16 turns-bits=0 address=3",
    "format=asi1",
    "format=asi4",
    "format=own layout=Long;stream;const:8:0xa5,turns:12,angle:52,error:1:low,status:7:low,skip:8,crc:8:0x07",
    "format=own layout=Parts;stream;angle:3,skip:2,angle:13,warning:1,skip:3,error:1,skip:1,crc:16:0x8005",
];

/// A shaft that turns, stands still for a while, and turns on; with bytes changed, lost and
/// doubled, `noise` in a thousand.
fn stream(decoder: &Decoder, noise: u64, random: &mut Noise) -> Vec<u8> {
    let profile = decoder.profile();
    let mut bytes = Vec::new();
    let mut position = 99.7;
    for index in 0..3_000u32 {
        if index % 700 > 200 {
            position += 0.000_37;
        }
        let values = Values {
            turns: Some(position as i64),
            angle: Some((f64::fract(position) * 2f64.powi(profile.angle_bits as i32)) as u64),
            status: Some(if index % 1_000 > 900 { 1 } else { 0 }),
            error: Some(index > 2_500),
            count: Some(1),
            ..Values::default()
        };
        for byte in decoder.encode(&values).into_bytes() {
            match (random.below(1_000) < noise, random.below(3)) {
                (false, _) => bytes.push(byte),
                (true, 0) => bytes.push(byte ^ 0x10),
                (true, 1) => bytes.extend([byte, byte]),
                (true, _) => {}
            }
        }
    }
    bytes
}

/// Pushes all of it in chunks of changing length.
fn cut(bytes: &[u8], random: &mut Noise, mut push: impl FnMut(&[u8])) {
    let mut rest = bytes;
    while !rest.is_empty() {
        let (chunk, behind) = rest.split_at(rest.len().min(1 + random.below(4_000) as usize));
        push(chunk);
        rest = behind;
    }
}

#[test]
fn columns_hold_what_the_frames_say() {
    for (number, profile) in PROFILES.iter().enumerate() {
        for noise in [0, 10, 50] {
            let decoder = decoder(profile);
            let mut random = Noise::new(number as u64 * 7 + noise);
            let bytes = stream(&decoder, noise, &mut random);

            let mut readings: Vec<(u64, Reading)> = Vec::new();
            let mut sink = |piece: Piece<'_>| {
                readings.extend(piece.reading().map(|reading| (piece.start, reading)));
            };
            let mut framer = Framer::at_start();
            cut(&bytes, &mut random, |chunk| {
                framer.push(&decoder, chunk, &mut sink);
            });
            framer.finish(&decoder, &mut sink);

            let mut columns = Columns::default();
            let mut take = |run: Piece<'_>| columns.take(&run);
            let mut framer = Framer::at_start();
            cut(&bytes, &mut random, |chunk| {
                framer.push_runs(&decoder, chunk, &mut take);
            });
            framer.finish_runs(&decoder, &mut take);

            let starts: Vec<u64> = columns
                .runs
                .iter()
                .flat_map(|run| (0..run.frames).map(|at| run.start + u64::from(at * run.len)))
                .collect();
            assert_eq!(starts.len(), columns.len(), "{profile}");
            assert_eq!(columns.len(), readings.len(), "{profile} {noise}");
            assert!(
                profile.ends_with('0') || readings.len() > 1_000,
                "{profile} {noise}"
            );
            for (at, (start, reading)) in readings.iter().enumerate() {
                let here = format!("{profile} {noise} frame {at}");
                assert_eq!(starts[at], *start, "{here}");
                assert_eq!(columns.angle[at], reading.angle, "{here}");
                assert_eq!(columns.turns[at], reading.turns.unwrap_or(0), "{here}");
                assert_eq!(columns.status[at], reading.status.unwrap_or(0), "{here}");
                assert_eq!(columns.health[at].is_error(), reading.error, "{here}");
                assert_eq!(columns.health[at].is_warning(), reading.warning, "{here}");
            }
        }
    }
}

#[test]
fn runs_are_the_frames_together() {
    let decoder = decoder("format=t485");
    let bytes = stream(&decoder, 5, &mut Noise::new(1));
    let (mut singles, mut runs, mut longest) = (Vec::new(), Vec::new(), 0);
    let mut framer = Framer::at_start();
    framer.push(&decoder, &bytes, &mut |piece| {
        singles.push((piece.start, piece.bytes.to_vec()));
    });
    let mut framer = Framer::at_start();
    framer.push_runs(&decoder, &bytes, &mut |run| {
        if let PieceKind::Frame {
            layout,
            sure,
            holds,
        } = run.kind
        {
            let frames = run.bytes.len() / (layout.len / 8);
            assert!(frames == 1 || sure && holds);
            longest = longest.max(frames);
        }
        runs.extend(
            run.frames()
                .map(|piece| (piece.start, piece.bytes.to_vec())),
        );
    });
    assert_eq!(singles, runs);
    assert!(longest > 20, "{longest}");
}
