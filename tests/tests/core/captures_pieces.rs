//! Recordings that come in pieces, that end early, and that are framed in steps.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::captures::{clean, values};
use encoderscope::{
    capture::{
        Change, Changes, Extraction, Kind, Options, Reader, Recording, Unreadable, sniff, vcd::Vcd,
    },
    decode::Decoder,
};
use encoderscope_tests::{
    captures::{Writing, written},
    decoder,
};

const FILES: [&[u8]; 4] = [
    include_bytes!("../../captures/ssi-17m.sigrok.vcd"),
    include_bytes!("../../captures/ssi7.sigrok.csv"),
    include_bytes!("../../captures/firtree.saleae.csv"),
    include_bytes!("../../captures/inverted.csv"),
];

fn kind(text: &[u8]) -> Kind {
    sniff(&text[..text.len().min(512)]).expect("a recording")
}

fn read<'a>(kind: Kind, pieces: impl IntoIterator<Item = &'a [u8]>) -> Result<Changes, Unreadable> {
    let mut reader = Reader::new(kind, None)?;
    for piece in pieces {
        reader.push(piece)?;
    }
    reader.finish()
}

fn whole(text: &[u8]) -> Changes {
    read(kind(text), [text]).expect("readable")
}

fn wave(decoder: &Decoder, times: usize, writing: Writing) -> String {
    let mut wave = clean(decoder);
    for _ in 0..times {
        for values in values(decoder) {
            wave.frame(&decoder.encode(&values));
        }
    }
    written(&wave.edges(), wave.now(), writing)
}

#[test]
fn pieces_cut_at_every_place_give_the_same_as_the_whole() {
    for text in FILES {
        let expected = whole(text);
        assert!(expected.len() > 100);
        for at in 0..=text.len() {
            let (a, b) = text.split_at(at);
            assert_eq!(read(kind(text), [a, b]), Ok(expected.clone()), "{at}");
        }
        assert_eq!(read(kind(text), text.chunks(1)), Ok(expected));
    }
}

#[test]
fn a_long_dump_is_read_while_it_comes_wherever_it_is_cut() {
    let decoder = decoder("format=ssi angle-bits=17");
    let text = wave(&decoder, 25, Writing::Vcd);
    let text = text.as_bytes();
    assert!(text.len() > 150_000, "{}", text.len());
    let expected = whole(text);
    let places = (65_500..65_600).chain((0..text.len()).step_by(7_919));
    for at in places {
        let (a, b) = text.split_at(at);
        assert_eq!(read(Kind::Vcd, [a, b]), Ok(expected.clone()), "{at}");
    }
    for size in [1, 13, 65_535, 65_536, 65_537, 100_000] {
        assert_eq!(read(Kind::Vcd, text.chunks(size)), Ok(expected.clone()));
    }
    // What has come is read but for what the longest command may take.
    let mut vcd = Vcd::new();
    let mut last = 0;
    vcd.push(&text[..140_000], &mut |change| last = change.time)
        .unwrap();
    let line = |at: usize| {
        let lines = std::str::from_utf8(&text[..at])
            .unwrap()
            .lines()
            .rev()
            .skip(1);
        let mut times = lines.filter_map(|line| line.strip_prefix('#'));
        times.next().unwrap().parse::<i64>().unwrap()
    };
    let end = 140_000 - 65_536;
    assert!(last >= line(end - 30) && last <= line(end + 30));
}

#[test]
fn a_fault_is_told_alike_wherever_the_text_is_cut() {
    let head = "$timescale 1 ns $end\n$var wire 1 ! clk $end\n$var wire 1 \" data $end\n";
    let deep = "$scope module a $end\n".repeat(5_000);
    let endless = format!("{head}$comment {}", "x".repeat(200_000));
    for text in [
        format!("{head}#10\n1!\n#9\n0!\n#20\n"),
        format!("{head}#5\n1!\n{}#4\n0!\n", "0!\n1!\n".repeat(20_000)),
        format!("{head}#5\n1"),
        deep,
        endless,
    ] {
        let text = text.as_bytes();
        let expected = read(Kind::Vcd, [text]).unwrap_err();
        for at in (0..text.len()).step_by(text.len() / 50 + 1) {
            let (a, b) = text.split_at(at);
            assert_eq!(read(Kind::Vcd, [a, b]), Err(expected.clone()), "{at}");
        }
        assert_eq!(read(Kind::Vcd, text.chunks(1_000)), Err(expected));
    }
    // It is told of when it has come, not at the end.
    let mut reader = Reader::new(Kind::Vcd, None).unwrap();
    let deep = "$scope module a $end\n".repeat(50);
    let pushed = (0..1_000).find_map(|_| reader.push(deep.as_bytes()).err());
    assert_eq!(pushed, Some(Unreadable::Deep(65)));
}

#[test]
fn what_has_come_is_kept_wherever_a_recording_is_stopped() {
    for text in FILES {
        let all: Vec<Change> = whole(text).iter().collect();
        let stopped = |text: &[u8], kind| {
            let mut reader = Reader::new(kind, None).unwrap();
            reader.push(text).unwrap();
            let end = text.len();
            reader.cut().unwrap_or_else(|why| panic!("{end}: {why}"))
        };
        for at in 0..=text.len() {
            let changes = stopped(&text[..at], kind(text));
            let found: Vec<Change> = changes.iter().collect();
            assert!(all.starts_with(&found), "{at}");
            // No line is lost that has come as a whole.
            let end = text[..at].iter().rposition(|byte| *byte == b'\n');
            let before = stopped(&text[..end.map_or(0, |end| end + 1)], kind(text));
            assert!(
                found.len() >= before.len() && changes.end() >= before.end(),
                "{at}"
            );
        }
    }
}

#[test]
fn a_stopped_recording_has_the_frames_that_had_come() {
    let decoder = decoder("format=ssi angle-bits=17");
    for writing in [Writing::Vcd, Writing::Saleae, Writing::Sigrok(24)] {
        let text = wave(&decoder, 4, writing);
        let kind = kind(text.as_bytes());
        let all = Recording::read(text.as_bytes(), kind, &decoder, Options::default()).unwrap();
        assert_eq!(all.frames.len(), 24);
        let mut reader = Reader::new(kind, None).unwrap();
        reader.push(&text.as_bytes()[..text.len() / 2]).unwrap();
        let found = framed(&reader.cut().unwrap(), &decoder, 100);
        assert!((11..=13).contains(&found.frames.len()), "{writing:?}");
        // The last one is cut.
        let whole = found.frames.len() - 1;
        assert_eq!(found.frames[..whole], all.frames[..whole], "{writing:?}");
        assert_eq!(found.wires.clock, all.wires.clock);
    }
}

fn framed(changes: &Changes, decoder: &Decoder, budget: usize) -> Recording {
    let mut extraction = Extraction::new(changes, decoder, Options::default()).unwrap();
    while extraction.step(changes, budget).unwrap() {}
    extraction.finish(changes)
}

#[test]
fn frames_do_not_depend_on_the_steps_nor_on_what_was_framed_before() {
    let profiles = [
        "format=ssi angle-bits=17",
        "format=biss-c angle-bits=17",
        "format=ssi7 angle-bits=22",
        "format=ssi-tree",
    ]
    .map(decoder);
    for text in FILES {
        let changes = whole(text);
        for decoder in &profiles {
            let expected = Recording::read(text, kind(text), decoder, Options::default()).unwrap();
            for budget in [1, 7, 1_000_000] {
                assert_eq!(framed(&changes, decoder, budget), expected, "{budget}");
            }
        }
    }
    // Both wires of this one are inverted, so that it is gone through twice.
    let found = framed(&whole(FILES[3]), &profiles[3], 10);
    assert!(found.wires.clock.inverted && found.wires.data.inverted);
}

#[test]
fn framing_can_be_stopped_and_keeps_its_frames() {
    let decoder = decoder("format=ssi angle-bits=17");
    let text = wave(&decoder, 2, Writing::Saleae);
    // Data that rests low is gone through twice, no further the second time than the first.
    let inverted: String = text
        .lines()
        .map(|line| match line.rsplit_once(',') {
            Some((front, "0")) => format!("{front},1\n"),
            Some((front, "1")) => format!("{front},0\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    for (text, inverted) in [(text, false), (inverted, true)] {
        let changes = whole(text.as_bytes());
        let all = framed(&changes, &decoder, 1_000).frames;
        let mut extraction = Extraction::new(&changes, &decoder, Options::default()).unwrap();
        while extraction.seen() * 2 < changes.len() {
            assert!(extraction.step(&changes, 10).unwrap());
        }
        let seen = extraction.seen();
        extraction.stop();
        while extraction.step(&changes, 10).unwrap() {}
        assert_eq!(extraction.seen(), seen);
        assert!(!extraction.step(&changes, 10).unwrap());
        let found = extraction.finish(&changes);
        assert_eq!(found.wires.data.inverted, inverted);
        assert!((5..=7).contains(&found.frames.len()));
        assert_eq!(found.frames[..5], all[..5]);
    }
}

#[test]
fn changes_take_a_few_bytes_and_no_more_than_they_may() {
    let decoder = decoder("format=ssi angle-bits=17");
    for writing in [Writing::Vcd, Writing::Saleae] {
        let text = wave(&decoder, 4, writing);
        let text = text.as_bytes();
        let changes = whole(text);
        assert!(changes.len() > 2_000);
        assert!(changes.bytes() <= changes.len() * 5, "{}", changes.bytes());
        let room = |bytes: usize| {
            let mut reader = Reader::new(kind(text), None).unwrap().with_room(bytes);
            for piece in text.chunks(1_000) {
                reader.push(piece)?;
            }
            reader.finish()
        };
        assert_eq!(room(changes.bytes() + 12), Ok(changes.clone()));
        assert_eq!(room(1_000), Err(Unreadable::TooManyChanges(1_000)));
        assert_eq!(
            room(changes.bytes() - 1).unwrap_err(),
            Unreadable::TooManyChanges(changes.bytes() - 1)
        );
    }
    assert_eq!(
        Unreadable::TooManyChanges(256_000_000).to_string(),
        "its changes of level need more than 256 MB: export a shorter part of the recording, or \
         the clock and the data only"
    );
}

#[test]
fn levels_that_are_told_again_take_nothing() {
    let mut text = String::from("$var wire 1 ! clk $end $var wire 1 % data $end\n#0 1! 0%\n");
    for time in 1..50_000 {
        text.push_str(&format!("#{time}\n1!\n0%\n"));
    }
    text.push_str("#50000\n0!\n");
    let changes = read(Kind::Vcd, [text.as_bytes()]).unwrap();
    assert_eq!((changes.len(), changes.end()), (3, 50_000));
    let last = Change {
        time: 50_000,
        signal: 0,
        level: false,
    };
    assert_eq!(changes.iter().last(), Some(last));
}

#[test]
fn times_of_all_sizes_and_many_signals_are_kept_as_they_are() {
    let times = [
        "-9000000",
        "-1",
        "-0.000000000001",
        "0",
        "0.000000000127",
        "0.000000000255",
        "0.000016384",
        "1",
        "9000000",
    ];
    let names: String = (0..1_000).map(|index| format!(",s{index}")).collect();
    let mut text = format!("Time [s]{names}\n");
    for (row, time) in times.iter().enumerate() {
        let level = if row % 2 == 0 { ",0" } else { ",1" };
        text.push_str(&format!("{time}{}\n", level.repeat(1_000)));
    }
    let changes = read(Kind::Samples, [text.as_bytes()]).unwrap();
    assert_eq!((changes.len(), changes.signals().len()), (9_000, 1_000));
    assert!(changes.bytes() < 9_000 * 4);
    let picos: Vec<i64> = times
        .iter()
        .map(|time| (time.parse::<f64>().unwrap() * 1e12).round() as i64)
        .collect();
    for (index, change) in changes.iter().enumerate() {
        let (row, signal) = (index / 1_000, index % 1_000);
        let expected = Change {
            time: picos[row],
            signal,
            level: row % 2 == 1,
        };
        assert_eq!(change, expected);
    }
}
