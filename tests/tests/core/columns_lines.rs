//! Lines of bit formats in columns are what the lines say one by one.

use encoderscope::{
    bits::{BitString, Bits},
    columns::Columns,
    decode::{Decoded, Decoder, Words},
    dump::Dump,
    framing::{Piece, PieceKind},
    reading::{Reading, Values},
};
use encoderscope_tests::{Noise, decoder};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

const PROFILES: [&str; 14] = [
    "format=biss-c",
    "format=biss-c angle-bits=17 turns-bits=0",
    "format=biss-c justify=right",
    "format=biss-c status-bits=0 angle-bits=20 ack-bits=3",
    "format=biss-c status-active=low turns-code=signed",
    "format=ssi",
    "format=ssi angle-bits=17 turns-code=signed",
    "format=ssi justify=left angle-bits=17 turns-bits=0",
    "format=ssi7",
    "format=ssi-tree",
    "format=ssi-tree code=binary align=right",
    "format=ssi-tree parity=even frame-bits=26",
    "format=ssi-tree code=binary parity=odd frame-bits=26",
    "format=ssi-tree turns-bits=0 frame-bits=13",
];

/// What stands around the words of a dump: levels before and behind.
struct Around {
    before: Vec<bool>,
    behind: Vec<bool>,
}

/// Lines of one length: a shaft that turns, and stands still for a while; `noise` bits in ten
/// thousand are turned over, and now and then a bit has moved from one end to the other.
fn lines(decoder: &Decoder, around: &Around, noise: u64, random: &mut Noise) -> Vec<BitString> {
    let layout = decoder.main_layout();
    let profile = decoder.profile();
    let turns = 1 << profile.turns_bits;
    let mut position = 2.7;
    let line = |index: u32| {
        if index % 400 > 100 {
            position += 0.000_37;
        }
        let values = Values {
            turns: Some(position as i64 % turns),
            angle: Some((f64::fract(position) * 2f64.powi(profile.angle_bits as i32)) as u64),
            status: Some(if index % 300 > 250 { 1 } else { 0 }),
            error: Some(index % 500 > 450),
            warning: Some(index % 100 > 90),
            ..Values::default()
        };
        let word = layout.encode(&values);
        let mut levels = around.before.clone();
        levels.extend((0..layout.len).map(|at| word.as_bits().bit(at)));
        levels.extend(&around.behind);
        if random.below(50) == 0 {
            levels.rotate_right(1);
        }
        let mut line = BitString::default();
        for level in levels {
            line.push(level != (random.below(10_000) < noise));
        }
        line
    };
    (0..1_500).map(line).collect()
}

fn arounds() -> [Around; 5] {
    let levels = |text: &str| text.chars().map(|level| level == '1').collect();
    [
        ("", ""),
        ("1", ""),
        ("", "0"),
        ("", "0000000"),
        ("00000", ""),
    ]
    .map(|(before, behind)| Around {
        before: levels(before),
        behind: levels(behind),
    })
}

/// Offset of the line in bytes, and its reading.
type Found = Vec<(u64, Reading)>;

fn check(columns: &Columns, found: &Found, here: &str) {
    let starts: Vec<u64> = columns
        .runs
        .iter()
        .flat_map(|run| (0..run.frames).map(|at| run.start + u64::from(at * run.len)))
        .collect();
    assert_eq!(starts.len(), columns.len(), "{here}");
    assert_eq!(columns.len(), found.len(), "{here}");
    for (at, (start, reading)) in found.iter().enumerate() {
        assert_eq!(starts[at], *start, "{here} {at}");
        assert_eq!(columns.angle[at], reading.angle, "{here} {at}");
        assert_eq!(columns.turns[at], reading.turns.unwrap_or(0), "{here} {at}");
        assert_eq!(
            columns.status[at],
            reading.status.unwrap_or(0),
            "{here} {at}"
        );
        assert_eq!(columns.health[at].is_error(), reading.error, "{here} {at}");
        assert_eq!(
            columns.health[at].is_warning(),
            reading.warning,
            "{here} {at}"
        );
    }
}

#[test]
fn columns_hold_what_the_lines_say() {
    let mut most = 0;
    for (number, profile) in PROFILES.iter().enumerate() {
        for (place, around) in arounds().iter().enumerate() {
            for noise in [0, 30] {
                let here = format!("{profile}, around {place}, noise {noise}");
                let decoder = decoder(profile);
                let mut random = Noise::new(number as u64 * 31 + noise);
                let lines = lines(&decoder, around, noise, &mut random);
                let bits = lines[0].as_bits().len();
                let dump = Dump::of_lines(lines.into_iter().map(|line| (line, None)));

                let mut at = 0;
                let mut found = Found::new();
                decoder.dump(&dump, &mut |decoded| {
                    let line = match &decoded {
                        Decoded::Frame(frame) => frame.bits,
                        Decoded::Skip { bits, .. } => *bits,
                    };
                    if let Decoded::Frame(frame) = &decoded {
                        found.extend(frame.reading().map(|reading| (at, reading)));
                    }
                    at += line.bytes().len() as u64;
                });
                most = most.max(found.len());

                let mut columns = Columns::default();
                decoder.dump_runs(&dump, &mut |run| columns.take(&run));
                check(&columns, &found, &here);

                let mut columns = Columns::default();
                let mut words = Words::new(&decoder, bits, dump.bytes());
                let mut rest = dump.bytes();
                while !rest.is_empty() {
                    let size = (1 + random.below(3_000) as usize).min(rest.len());
                    let (cut, behind) = rest.split_at(size);
                    words.push_runs(&decoder, cut, &mut |run| columns.take(&run));
                    rest = behind;
                }
                words.finish_runs(&mut |_| panic!("nothing is left"));
                check(&columns, &found, &here);
            }
        }
    }
    assert_eq!(most, 1_500);
}

#[test]
fn every_line_is_in_one_piece_and_good_ones_come_together() {
    let decoder = decoder("format=biss-c");
    let around = Around {
        before: vec![],
        behind: vec![false; 2],
    };
    let lines = lines(&decoder, &around, 5, &mut Noise::new(3));
    let bytes: Vec<u8> = lines.into_iter().flat_map(BitString::into_bytes).collect();
    let (mut at, mut longest) = (0, 0);
    let mut take = |piece: Piece<'_>| {
        assert_eq!(piece.start, at);
        at += piece.bytes.len() as u64;
        match piece.kind {
            PieceKind::Frame {
                layout,
                holds,
                sure,
            } => {
                assert!(piece.bytes.len().is_multiple_of(8));
                let frames = piece.frames();
                let good = frames.filter(|frame| frame.reading().is_some()).count();
                assert_eq!(
                    good,
                    if sure && holds {
                        piece.bytes.len() / 8
                    } else {
                        0
                    }
                );
                assert!(
                    holds == layout.holds(Bits::of_bytes(&piece.bytes[..8]).prefix(layout.len))
                );
                longest = longest.max(good);
            }
            PieceKind::Skip(_) => assert_eq!(piece.bytes.len(), 8),
        }
    };
    let mut words = Words::new(&decoder, 64, &bytes);
    words.push_runs(&decoder, &bytes, &mut take);
    words.finish_runs(&mut take);
    assert_eq!(at, bytes.len() as u64);
    assert!(longest > 50, "{longest}");

    let mut words = Words::new(&decoder, 64, &bytes);
    let mut last = Vec::new();
    words.push_runs(&decoder, &bytes[..19], &mut |_| {});
    words.finish_runs(&mut |piece| {
        let PieceKind::Skip(why) = piece.kind else {
            panic!("a frame");
        };
        last.push((piece.start, piece.bytes.len(), why.to_string()));
    });
    assert_eq!(last, [(16, 3, "24 of 64".to_string())]);
}
