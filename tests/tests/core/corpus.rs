//! Dumps as they are pasted, each with what is read from it.
//!
//! `tests/dumps/NAME.txt` is the paste; `NAME.expect` beside it names the profile and says what
//! comes out, a line a stretch. `UPDATE=1 cargo test -p encoderscope-tests --test core corpus`
//! writes the latter anew. What was encoded when a dump was made stands here and is not
//! rewritten: turns and angle of every good frame, by a source of their own (a public capture
//! of `vectors.json`, or frames computed bit by bit from the manuals outside of this package).

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    decode::{Decoded, Decoder},
    detect::{Candidate, Verdict, detect},
    dump::{Dropped, Dump},
};
use encoderscope_tests::{decoder, golden, paste};
use std::fmt::Write;

struct Case {
    name: &'static str,
    text: &'static str,
    expect: &'static str,
    /// Turns and angle of the good frames.
    encoded: &'static str,
}

macro_rules! cases {
    ($($name:literal [$encoded:literal];)*) => {
        const CASES: &[Case] = &[$(Case {
            name: $name,
            text: include_str!(concat!("../../dumps/", $name, ".txt")),
            expect: include_str!(concat!("../../dumps/", $name, ".expect")),
            encoded: $encoded,
        }),*];
    };
}

cases! {
    "t485-plain" ["0:3915817 0:5423491 0:8249791"];
    "t485-long-run" ["0:3915817 0:5423491 0:8249791"];
    "t485-hexdump-c" ["0:3915817 0:5423491 0:8249791"];
    "t485-xxd" ["0:3915817 0:5423491 0:8249791"];
    "t485-od" ["0:3915817 0:5423491 0:8249791"];
    "t485-od-octal" ["0:3915817 0:5423491 0:8249791"];
    "t485-xxd-i" ["0:3915817 0:5423491 0:8249791"];
    "t485-c-array" ["0:3915817 0:5423491"];
    "t485-python-bytes" ["0:3915817 0:5423491 0:8249791"];
    "t485-python-list" ["0:3915817 0:5423491 0:8249791"];
    "t485-rust-array" ["0:3915817 0:5423491"];
    "t485-assembler" ["0:3915817 0:5423491 0:8249791"];
    "t485-dollar" ["0:3915817 0:5423491 0:8249791"];
    "t485-words" ["0:3915817 0:5423491"];
    "t485-colons-and-dashes" ["0:3915817 0:5423491 0:8249791"];
    "t485-escapes" ["0:3915817 0:5423491 0:8249791"];
    "t485-decimal" ["0:3915817 0:5423491 0:8249791"];
    "t485-binary" ["-:1883572 -:7907664 -:7267713"];
    "t485-docklight" ["-:1883572 -:7907664 -:7267713"];
    "t485-arrows" ["0:3915817 0:5423491 0:8249791"];
    "t485-saleae-2" ["-:1883572 -:7907664 -:7267713"];
    "t485-saleae-1" ["0:3915817 0:5423491"];
    "t485-mail" ["0:3915817 0:5423491 0:8249791"];
    "t485-mail-quoted" ["0:3915817 0:5423491 0:8249791"];
    "t485-mail-directions" ["0:3915817 0:5423491"];
    "t485-quoted-printable" ["0:3915817 0:5423491"];
    "t485-look-alikes" ["0:3915817 0:5423491"];
    "t485-typography" ["0:3915817 0:5423491 0:8249791"];
    "t485-putty" ["0:3915817 0:5423491 0:8249791"];
    "rs485-tx-rx" ["300:1193046 300:1193319 301:66 301:2202"];
    "rs485-other-commands" ["5:8388608 65534:1193046 1:1 7:16384 -:-"];
    "rs485-realterm" ["300:1193046 300:1193319 301:66 301:2202"];
    "rs485-candump-like" ["300:1193046 300:1193319 301:66 301:2202"];
    "rs485-milliseconds" ["300:1193046 300:1193319 301:66 301:2202"];
    "rs485-wrapped-log" ["300:1193046 300:1193319 301:66 301:2202"];
    "rs485-port-monitor" ["300:1193046 300:1193319 301:66 301:2202"];
    "rs485-unread-token" ["300:1193046 301:66 301:2202"];
    "rs485-undecided" ["-:1052688 -:1052690 -:1052695"];
    "bus-sigrok" ["5:1193046 5:1193300 6:17"];
    "bus-sigrok-samples" ["5:1193046 5:1193300 6:17"];
    "bus-pulseview" ["5:1193046 5:1193300 6:17"];
    "bus-saleae-value" ["5:1193046 5:1193300 6:17"];
    "bus-saleae-quoted" ["5:1193046 5:1193300 6:17"];
    "bus-send-recv" ["5:1193046 5:1193300 6:17"];
    "period-hterm" ["256:8388352 256:8388357 256:8388362 256:8388367 256:8388372 256:8388377 256:8388382 256:8388387"];
    "period-repeated" ["700:1193046 700:1193046 700:1193046 700:1193046 700:1193046 700:1193046 700:1193046 700:1193046 700:1193046 700:1193046 700:1193046 700:1193046 700:1193046 700:1193046 700:1193046 700:1193046"];
    "period-interrupted" ["256:8388352 256:8388357 256:8388362 256:8388372 256:8388377 256:8388382 256:8388387"];
    "asi1-js" ["-:4000 -:4001 -:4003 -:4008 -:4012"];
    "asi1-hex-json" ["-:4000 -:4001 -:4003 -:4008 -:4012"];
    "asi4-terminal" ["-:8190 -:8191 -:8192 -:8194 -:8197"];
    "asi4-timed" ["-:8190 -:8191 -:8192 -:8194 -:8197"];
    "asi4-hexdump" ["-:8190 -:8191 -:8192 -:8194 -:8197"];
    "ssi-bits" ["300:1193046 300:1193062 300:1193079"];
    "ssi-bits-grouped" ["300:1193046 300:1193062 300:1193079"];
    "ssi-prefixed" ["300:1193046 300:1193062 300:1193079"];
    "ssi-bits-apart" ["300:1193046 300:1193062 300:1193079"];
    "ssi-hex-of-ones" ["0:16 0:17 0:256"];
    "biss-c-spi" ["5:65536 5:65540 6:12"];
    "biss-c-bits" ["5:65536 5:65540 6:12"];
    "biss-c-hpmicro" ["2650:4005 2650:4006 2650:4007 2650:4008"];
    "biss-c-vesc" ["-:422917"];
    "biss-c-timed-spi" ["5:65536 5:65540 6:12"];
    "ssi7-vectors" ["-:1 -:8192 -:74565"];
    "ssi7-log" ["-:5000 -:5001 -:5003"];
    "as5048-spi" ["-:8192 -:8193 -:8195 -:8195"];
    "ssi-tree-bits" ["3171:962 3171:963 3172:0"];
    "ssi-tree-labelled" ["3171:962 3171:963 3172:0"];
}

#[test]
fn every_dump_is_read_as_expected() {
    let mut wrong = String::new();
    for case in CASES {
        let profile = case.expect.lines().next().unwrap_or_default();
        let decoder = decoder(profile);
        let dump = paste(&decoder, case.text);
        let found = format!("{profile}\n{}", shown(&decoder, &dump, case.text));
        if golden::is_updating() {
            golden::write(&format!("dumps/{}.expect", case.name), &found);
        } else if found != case.expect {
            let _ = writeln!(wrong, "{}: {}", case.name, difference(case.expect, &found));
        }
        let encoded = encoded(&decoder, &dump);
        if encoded != case.encoded {
            let _ = writeln!(
                wrong,
                "{}: encoded {}, read {encoded}\n{found}",
                case.name, case.encoded
            );
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// Turns and angle of good frames as one number.
fn numbers(decoder: &Decoder, dump: &Dump) -> Vec<u64> {
    let mut all = Vec::new();
    let one = decoder.profile().angle_bits;
    decoder.dump(dump, &mut |decoded| {
        if let Decoded::Frame(frame) = decoded
            && let Some(reading) = frame.reading()
        {
            let turns = reading.turns.unwrap_or(0) as u64;
            all.push(turns * (1 << one) + reading.angle);
        }
    });
    all
}

/// Dumps that say too little to tell what they are: frames of a shaft that hardly moves.
const OPEN: &[&str] = &[];

#[test]
fn detection_names_what_a_dump_is_or_says_that_it_is_open() {
    let mut wrong = String::new();
    let (mut named, mut open) = (0, Vec::new());
    // A browser gives up on a page that does not answer for long: there a part stands for all.
    let part = if cfg!(target_arch = "wasm32") { 8 } else { 1 };
    for case in CASES.iter().step_by(part) {
        let truth = decoder(case.expect.lines().next().unwrap_or_default());
        let found = detect(case.text);
        // Two profiles are one where they read the same.
        let is_right = |candidate: &Candidate| {
            let known = Decoder::new(candidate.profile).unwrap();
            let same = candidate.profile.medium() == truth.profile().medium();
            same && encoded(&known, &paste(&known, case.text)) == case.encoded
        };
        let verdict = found.first().map(|best| best.verdict);
        let is_named = match verdict {
            Some(Verdict::Certain | Verdict::Likely) => is_right(&found[0]),
            Some(Verdict::Ambiguous) => {
                // Where turns end and the angle begins may be what is open.
                let side_by_side = |other: &Candidate| {
                    let known = Decoder::new(other.profile).unwrap();
                    let dump = paste(&truth, case.text);
                    numbers(&known, &dump) == numbers(&truth, &dump)
                };
                let open = |other: &&Candidate| other.verdict == Verdict::Ambiguous;
                let mut all = found.iter().filter(open);
                all.any(|other| is_right(other) || side_by_side(other))
            }
            Some(Verdict::Unlikely) | None => {
                open.push(case.name);
                continue;
            }
        };
        named += usize::from(verdict != Some(Verdict::Ambiguous));
        if !is_named {
            let list = found
                .iter()
                .take(3)
                .map(|candidate| candidate.record().to_string());
            let list = list.collect::<Vec<_>>().join("\n  ");
            let _ = writeln!(wrong, "{}:\n  {list}", case.name);
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert_eq!(open, OPEN);
    assert!(named * part >= 30, "{named}");
}

#[test]
fn the_dumps_are_of_all_formats() {
    for format in encoderscope::format::Format::ALL {
        let of = |case: &&Case| {
            case.expect.split_whitespace().next() == Some(&format!("format={}", format.name()))
        };
        assert!(CASES.iter().any(|case| of(&case)), "{}", format.name());
    }
    assert!(CASES.len() >= 60);
}

/// Turns and angle of every good frame.
fn encoded(decoder: &Decoder, dump: &Dump) -> String {
    let mut all = Vec::new();
    decoder.dump(dump, &mut |decoded| {
        if let Decoded::Frame(frame) = decoded
            && frame.ok()
        {
            let values = frame.values();
            let turns = values.turns.map_or("-".into(), |turns| turns.to_string());
            let angle = values.angle.map_or("-".into(), |angle| angle.to_string());
            all.push(format!("{turns}:{angle}"));
        }
    });
    all.join(" ")
}

/// What is read from a dump, as text.
fn shown(decoder: &Decoder, dump: &Dump, text: &str) -> String {
    let mut out = format!("writing: {}\n", dump.writing());
    let line = |start| {
        let line = dump.line(dump.line_at(start)).expect("a line");
        let time = line.time.map(|time| format!(" {time:.6} s"));
        let direction = line
            .direction
            .map(|direction| format!(" {}", direction.name()));
        format!(
            "{start}{}{}",
            time.unwrap_or_default(),
            direction.unwrap_or_default()
        )
    };
    decoder.dump(dump, &mut |decoded| {
        match decoded {
            Decoded::Frame(frame) => {
                let values = frame.values();
                let _ = write!(
                    out,
                    "{} {}",
                    line(frame.start),
                    if frame.ok() { "ok" } else { "bad" }
                );
                let numbers = [
                    ("turns", values.turns),
                    ("angle", values.angle.map(|angle| angle as i64)),
                ];
                for (name, number) in numbers {
                    if let Some(number) = number {
                        let _ = write!(out, " {name} {number}");
                    }
                }
                for fault in frame.faults() {
                    let _ = write!(out, ", {}", fault.kind);
                }
                if let Some(request) = frame.request {
                    let _ = write!(out, ", answers {request}");
                }
            }
            Decoded::Skip { start, bits, why } => {
                let _ = write!(out, "{} skip {}: {why}", line(start), bits.bytes().len());
            }
        }
        out.push('\n');
    });
    for kind in Dropped::ALL {
        let count = dump.dropped().count(kind);
        if count > 0 {
            let _ = writeln!(out, "dropped: {count} {kind}");
        }
    }
    for mark in &dump.unread().places {
        let place = mark.at.start as usize..mark.at.end as usize;
        let _ = writeln!(out, "unread: {:?} at {}", &text[place], mark.at.start);
    }
    out
}

/// The first lines that differ.
fn difference(expected: &str, found: &str) -> String {
    let mut out = String::new();
    let (mut one, mut other) = (expected.lines(), found.lines());
    for number in 1.. {
        match (one.next(), other.next()) {
            (None, None) => break,
            (expected, found) if expected == found => {}
            (expected, found) => {
                let _ = write!(
                    out,
                    "\n  line {number}\n    expected {expected:?}\n    found    {found:?}"
                );
            }
        }
    }
    out
}
