use super::Input;
use encoderscope::capture::{Change, Changes, Kind, Reader, Unreadable, sniff};
use std::fmt::Write;

/// What recordings are made of, beside their letters.
const WORDS: &[&str] = &[
    "$timescale 1 us $end\n",
    "$timescale 100ns $end\n",
    "$timescale 0 s $end\n",
    "$var wire 1 ! ma $end\n",
    "$var wire 1 \" slo $end\n",
    "$var reg 8 # word [7:0] $end\n",
    "$var wire 4294967295 $ wide $end\n",
    "$scope module logic $end\n",
    "$upscope $end\n",
    "$enddefinitions $end\n",
    "$dumpvars\n",
    "$comment ",
    "$date ",
    " $end\n",
    "#0\n",
    "#18446744073709551615\n",
    "#9223372036854\n",
    "0!",
    "1!",
    "0\"",
    "1\"",
    "b10101010 #\n",
    "b1 !\n",
    "r1.25 !\n",
    "sidle !\n",
    "x!",
    "\n",
    "\r\n",
    "\u{feff}",
    "; Samplerate: 24 MHz\n",
    "Time [s],clk,data\n",
    "Time [us];clk;data\n",
    "clk,data\n",
    "Sample in Buffer,TRIGGER,ma,slo\n",
    "Radix - UNSIGNED,HEX,HEX,HEX\n",
    "0,1,1\n",
    "1,0,1\n",
    "0.000001,1,0\n",
    "1e300,1,0\n",
    "-5,1,1\n",
    "0,5;1;0\n",
    ",1,",
    "\"1\"",
    "µs",
];
/// What a VCD keeps back until it ends, and signals that are read.
const WAITS: usize = 65_536;
const MOST_SIGNALS: usize = 1024;

/// A recording in pieces: arbitrary text, or one whose changes are known.
///
/// # Panics
///
/// A law is broken: a reader depends on how its text is cut, keeps more than there is, reads
/// other changes than were written, or finds fault with a line that is not there.
pub fn vcd(data: &[u8]) {
    let mut input = Input(data);
    let form = input.byte();
    let cut = usize::from(input.word());
    let size = 1 + usize::from(input.byte());
    let kind = [Kind::Vcd, Kind::Samples][usize::from(form & 1)];
    let (text, expected) = match form >> 1 & 3 {
        0 => (input.worded(WORDS).into_bytes(), None),
        1 => (input.0.to_vec(), None),
        _ => {
            let long = form >> 3 == 31;
            let known = match kind {
                Kind::Vcd => commands(&mut input, long),
                Kind::Samples => rows(&mut input, long),
            };
            let sniffed = sniff(known.text.as_bytes());
            assert!(
                sniffed == Some(kind) || known.changes.is_err(),
                "{}",
                known.text
            );
            (known.text.into_bytes(), Some(known.changes))
        }
    };
    let whole = check_pieces(kind, &text, cut, size);
    match (&whole, expected) {
        (Ok(found), Some(Ok(expected))) => assert_eq!(found.iter().collect::<Vec<_>>(), expected),
        (Err(_), Some(Err(()))) | (_, None) => {}
        (found, expected) => panic!("{found:?}, not {expected:?}"),
    }
}

/// The same changes, however the text is cut; fewer where it ends early.
fn check_pieces(kind: Kind, text: &[u8], cut: usize, size: usize) -> Result<Changes, Unreadable> {
    let whole = changes(kind, &mut [text].into_iter());
    let (a, b) = text.split_at(cut.min(text.len()));
    assert_eq!(changes(kind, &mut [a, b].into_iter()), whole);
    assert_eq!(changes(kind, &mut text.chunks(size)), whole);
    match &whole {
        Ok(whole) => check_size(whole, text),
        Err(error) => check_fault(error, text),
    }
    let mut reader = Reader::new(kind, None)?;
    let early = reader.push(a).and_then(|()| reader.cut());
    if let Ok(whole) = &whole {
        let early = early.expect("what is read before the rest");
        assert!(early.iter().eq(whole.iter().take(early.len())));
    }
    whole
}

fn changes(kind: Kind, pieces: &mut dyn Iterator<Item = &[u8]>) -> Result<Changes, Unreadable> {
    let mut reader = Reader::new(kind, None)?;
    for piece in pieces {
        reader.push(piece)?;
    }
    reader.finish()
}

/// What is kept of a text is no more than there is of it.
fn check_size(changes: &Changes, text: &[u8]) {
    assert!(changes.len() <= text.len());
    assert!(changes.bytes() <= 12 * changes.len());
    let signals = changes.signals();
    assert!(signals.len() <= text.len().min(MOST_SIGNALS));
    // A column without a name has its number; what is no UTF-8 becomes a letter of three bytes.
    let longest = 3 * text.len() + "column 1024".len();
    assert!(signals.iter().all(|signal| signal.name.len() <= longest));
    let mut edges = vec![0; signals.len()];
    let mut levels = vec![None; signals.len()];
    let mut last = i64::MIN;
    for change in changes.iter() {
        assert!(last <= change.time && change.time <= changes.end());
        last = change.time;
        let before = levels[change.signal].replace(change.level);
        assert_ne!(before, Some(change.level));
        edges[change.signal] += u64::from(before.is_some());
    }
    // Of a signal that turned out to hold something else nothing is said.
    let said = |(signal, edges): (&_, u64)| {
        let signal: &encoderscope::capture::Signal = signal;
        !signal.lives() || signal.edges == edges
    };
    assert!(signals.iter().zip(edges).all(said));
}

/// The place of what is wrong is one of the text.
fn check_fault(error: &Unreadable, text: &[u8]) {
    let said = error.to_string();
    assert!(said.len() > 10);
    let lines = text.iter().filter(|byte| **byte == b'\n').count() as u64 + 1;
    let line = match error {
        Unreadable::Time(line)
        | Unreadable::Backwards(line)
        | Unreadable::LongLine(line)
        | Unreadable::Deep(line) => *line,
        Unreadable::Vcd(said) => {
            let Some((_, line)) = said.rsplit_once("line ") else {
                return assert!(said.contains("end of"), "{said}");
            };
            line.parse().expect("a number")
        }
        _ => return,
    };
    assert!((1..=lines).contains(&line), "{said}: {lines} lines");
}

/// A recording, and its changes where it can be read.
struct Known {
    text: String,
    changes: Result<Vec<Change>, ()>,
}

impl Known {
    fn change(
        &mut self,
        time: Option<i64>,
        signal: usize,
        level: bool,
        levels: &mut [Option<bool>],
    ) {
        let Some(time) = time else {
            self.changes = Err(());
            return;
        };
        if levels[signal].replace(level) != Some(level)
            && let Ok(changes) = &mut self.changes
        {
            changes.push(Change {
                time,
                signal,
                level,
            });
        }
    }
}

/// Picoseconds of units, as the fraction of a tick.
const UNITS: [(&str, i128, i128); 6] = [
    ("s", 1_000_000_000_000, 1),
    ("ms", 1_000_000_000, 1),
    ("us", 1_000_000, 1),
    ("ns", 1_000, 1),
    ("ps", 1, 1),
    ("fs", 1, 1_000),
];

/// The identity of a variable: a number whose digits are the letters from `!` to `~`.
fn identity(index: usize) -> String {
    let letter = |digit: usize| char::from(b'!' + digit as u8);
    match index {
        0..94 => letter(index).into(),
        _ => [letter(index % 94), letter(index / 94 - 1)]
            .iter()
            .collect(),
    }
}

/// A value change dump.
fn commands(input: &mut Input<'_>, long: bool) -> Known {
    let (unit, above, below) = input.one_of(&UNITS);
    let count = input.one_of(&[1, 10, 100]);
    let mut known = Known {
        text: format!("$timescale {count} {unit} $end\n"),
        changes: Ok(Vec::new()),
    };
    let mut widths: Vec<u32> = Vec::new();
    let mut levels = Vec::new();
    let mut ticks = 0u64;
    let mut scopes = 0;
    let steps = input.0;
    while !input.is_empty() || long && known.text.len() < WAITS + WAITS / 2 && !steps.is_empty() {
        if input.is_empty() {
            input.0 = steps;
        }
        let (what, how) = (input.byte(), input.byte());
        let picos = i128::from(ticks) * i128::from(count) * above / below;
        let now = i64::try_from(picos).ok();
        let of = usize::from(how).checked_rem(widths.len());
        let signal = |of: usize| widths[..of].iter().filter(|width| **width == 1).count();
        let text = &mut known.text;
        match (what & 7, of) {
            (0..=2, Some(of)) if widths[of] == 1 => {
                let level = what >> 3 & 1 == 1;
                let shown = match what >> 4 & 7 {
                    0 => 'x',
                    1 => 'Z',
                    _ => ['0', '1'][usize::from(level)],
                };
                let _ = write!(text, "{shown}{}", identity(of));
                text.push([' ', '\n'][usize::from(what >> 7)]);
                if shown.is_ascii_digit() {
                    let signal = signal(of);
                    known.change(now, signal, level, &mut levels);
                }
            }
            (3, _) => {
                ticks = ticks.saturating_add(u64::from(how));
                let _ = writeln!(text, "#{ticks}");
            }
            (4, _) => {
                ticks = ticks.saturating_add(u64::from(how) << (what >> 3));
                let _ = writeln!(text, "#{ticks}");
            }
            (5, Some(of)) => {
                let digits = "1".repeat(1 + usize::from(what >> 3) * 40);
                let _ = writeln!(text, "b{digits} {}", identity(of));
                if widths[of] == 1 && digits.len() == 1 {
                    let signal = signal(of);
                    known.change(now, signal, true, &mut levels);
                }
            }
            (6, _) if widths.len() < 4 * MOST_SIGNALS => {
                for _ in 0..=how {
                    let width = [1, 1, 1, 8, u32::MAX][usize::from(what >> 3) % 5];
                    let id = identity(widths.len());
                    let _ = writeln!(text, "$var wire {width} {id} v{how} $end");
                    widths.push(width);
                    if width == 1 {
                        levels.push(None);
                    }
                }
            }
            (7, _) if scopes < 60 => {
                scopes += 1;
                let _ = writeln!(text, "$scope module s{how} $end");
            }
            _ => text.push_str("$comment nothing $end\n"),
        }
        let far = i64::try_from(i128::from(ticks) * i128::from(count) * above / below).is_err();
        if far || levels.len() > MOST_SIGNALS {
            known.changes = Err(());
        }
    }
    known
}

/// Rows of levels below a heading.
fn rows(input: &mut Input<'_>, long: bool) -> Known {
    let (unit, factor, _) = input.one_of(&UNITS[..5]);
    let separator = input.one_of(&[',', ';', '\t']);
    let columns = 2 + usize::from(input.byte() % 7);
    let mut known = Known {
        text: format!("Time [{unit}]"),
        changes: Ok(Vec::new()),
    };
    for column in 0..columns {
        let _ = write!(known.text, "{separator}c{column}");
    }
    known.text.push('\n');
    let mut levels = vec![None; columns];
    let mut ticks = 0u64;
    let steps = input.0;
    let mut count = 0;
    while !input.is_empty()
        || count < 2
        || long && known.text.len() < WAITS + WAITS / 2 && !steps.is_empty()
    {
        if input.is_empty() {
            input.0 = steps;
        }
        let (row, step) = (input.byte(), input.byte());
        // A heading and rows that are no times at all are no recording.
        if count > 1 {
            ticks = ticks.saturating_add(u64::from(step) << (row >> 3 & 7));
            ticks = ticks.saturating_add(if step == 255 { u64::from(row) << 56 } else { 0 });
        }
        count += 1;
        let time = i64::try_from(i128::from(ticks) * factor).ok();
        let _ = write!(known.text, "{ticks}");
        for column in 0..columns {
            let level = row >> column & 1 == 1;
            let _ = write!(known.text, "{separator}{}", u8::from(level));
            known.change(time, column, level, &mut levels);
        }
        known.text.push_str(["\n", "\r\n"][usize::from(step & 1)]);
    }
    known
}
