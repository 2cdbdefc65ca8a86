use super::Input;
use encoderscope::{
    dump::{Dropped, Dump, Marks, Reader, parse},
    format::Medium,
};

/// What pasted text is made of, beside its letters.
const WORDS: &[&str] = &[
    "1a 20 29 c0 3b 17 00 00 00 c8 37",
    "1A 2029C0",
    "1a-20-29-c0-3b",
    "0x1a, ",
    "\\x1a",
    "$1a ",
    "1ah ",
    "0b01101010 ",
    "01101010 ",
    "110010101010101",
    "1 0 1 1 ",
    "26 32 41 192 ",
    "1234567\n",
    "\n",
    "\r\n",
    "\t",
    "  ",
    ",",
    "; ",
    ": ",
    " | ",
    "> ",
    ">> ",
    "| ",
    "-> ",
    "<- ",
    ">>> ",
    "=\n",
    "=20\n",
    "=3D",
    "=C2=A0",
    "TX: ",
    "RX: ",
    "[12:00:00.250] ",
    "12:00:00.251 -> ",
    "2024-03-01 12:00:00 ",
    "0.001250 ",
    "Sent data\n",
    "received raw data 12:00:00\n",
    "COM3 ",
    "can0  123   [8]  ",
    "(11) ",
    "11 bytes: ",
    "the encoder sent ",
    "dead beef ",
    "angle = ",
    "Frame 1: ",
    "const uint8_t frame[11] = { ",
    "};\n",
    "#include <stdint.h>\n",
    "db ",
    "len = 11\n",
    "b'\\x1a ",
    "\"",
    "'",
    "// ",
    "/* ",
    "*/",
    "# ",
    "*\n",
    "00000000  1a 20 29 c0 3b 17 00 00  00 c8 37 00 00 00 00 00  |. ).;...|\n",
    "00000010: 1a20 29c0 3b17 0000 00c8 3700 0000 0000  . ).;.....7.....\n",
    "00000040\n",
    "0000020 201a c029 173b 0000\n",
    "Time [s],Value,Parity Error,Framing Error\n",
    "0.000125,0x1A,,\n",
    "0.000225,'26' (0x1a),Error,\n",
    "start_time;type;data\n",
    "uart-1: RX data: 1A\n",
    "100-200 UART: RX: 20\n",
    "uart-1: RX bits: error\n",
    "→",
    "×",
    "\u{a0}",
    "\u{200b}",
    "\u{feff}",
    "А",
    "О",
    "１",
    "é",
    "\u{1f916}",
    "\0",
];
/// What is read in one go.
const PIECE: usize = 64 * 1024;
/// A hexdump's repeated lines are written out to so many bytes.
const REPEATED: usize = 1 << 20;

/// Pasted text, or bytes that are none, in pieces; some of it many times over.
///
/// # Panics
///
/// A law is broken: a dump depends on how its text is cut, its lines are not its bytes, a place
/// lies outside of the text or in two others, or something that was written is neither data nor
/// at a place.
pub fn dump(data: &[u8]) {
    let mut input = Input(data);
    let medium = input.one_of(&[Medium::Bytes, Medium::Bits, Medium::Text]);
    let form = input.byte();
    let (first, other) = (usize::from(input.byte()), usize::from(input.byte()));
    if form & 3 == 3 {
        let head = String::from_utf8_lossy(input.0.get(..first).unwrap_or(input.0));
        check_pieces(medium, &head, input.0, first, other);
        return plain(input.0, first);
    }
    let text = match form & 3 {
        2 => String::from_utf8_lossy(input.0).into_owned(),
        _ => input.worded(WORDS),
    };
    // A page knows no more than the head when it begins to read.
    let head = match form & 4 {
        0 => &text,
        _ => text.get(..first).unwrap_or(&text),
    };
    let dump = check_pieces(medium, head, text.as_bytes(), first, other);
    check_marks(&text, &dump);
    check_letters(medium, &text);
    if form >> 3 == 31 {
        let many = text.repeat(2 * PIECE / text.len().max(1));
        let dump = parse(&many, medium);
        check_lines(&dump);
        let size = many.len() + REPEATED;
        assert!(dump.bytes().len() <= size && dump.len() <= size);
        assert!(dump.dropped().total + dump.unread().total <= size as u64);
    }
}

/// The same dump, however the text is cut.
fn check_pieces(medium: Medium, head: &str, text: &[u8], first: usize, other: usize) -> Dump {
    let read = |pieces: &mut dyn Iterator<Item = &[u8]>| {
        let mut reader = Reader::new(medium, head);
        let mut before = 0;
        for piece in pieces {
            reader.push(piece);
            let now = reader.dump().bytes().len();
            assert!(before <= now);
            before = now;
        }
        reader.finish()
    };
    let whole = read(&mut [text].into_iter());
    check_lines(&whole);
    let (a, b) = text.split_at(first.min(text.len()));
    assert_eq!(read(&mut [a, b].into_iter()), whole);
    assert_eq!(read(&mut text.chunks(1 + other % 32)), whole);
    whole
}

/// The lines are the bytes, whichever way they are come by.
fn check_lines(dump: &Dump) {
    let mut bytes = Vec::new();
    let mut start = 0;
    assert_eq!(dump.lines().len(), dump.len());
    assert_eq!(dump.is_empty(), dump.bytes().is_empty());
    assert!(!dump.writing().to_string().is_empty() && !dump.writing().name().is_empty());
    // Of many lines the ones around where it is known where they begin.
    let looked_at = |index: usize| dump.len() < 200 || index % 64 < 2 || index + 1 == dump.len();
    for (index, line) in dump.lines().enumerate() {
        assert_eq!(line.start, start);
        assert!(!line.bits.is_empty());
        let len = match dump.is_bits() {
            true => line.bits.len(),
            false => line.bits.bytes().len(),
        } as u64;
        if looked_at(index) {
            assert_eq!(dump.line(index), Some(line));
            assert_eq!(dump.line_at(start), index);
            assert_eq!(dump.line_at(start + len - 1), index);
        }
        assert!(line.time.is_none_or(f64::is_finite));
        assert!(dump.has_times() || line.time.is_none());
        assert!(dump.has_directions() || line.direction.is_none());
        bytes.extend_from_slice(line.bits.bytes());
        start += len;
    }
    assert_eq!(dump.line(dump.len()), None);
    assert_eq!(bytes, dump.bytes());
}

/// Bytes that nobody has written down are all there.
fn plain(bytes: &[u8], cut: usize) {
    let (a, b) = bytes.split_at(cut.min(bytes.len()));
    let mut dump = Dump::of_bytes(a);
    dump.push_bytes(b);
    assert_eq!(dump, Dump::of_bytes(bytes));
    assert_eq!(dump.bytes(), bytes);
    check_lines(&dump);
}

/// Every place is one of the text, in order; what cannot be read is not left out as well.
fn check_marks(text: &str, dump: &Dump) {
    let mut dropped = vec![false; text.len()];
    for marks in [dump.dropped(), dump.unread()] {
        let counts = Dropped::ALL.iter().map(|kind| marks.count(*kind));
        assert_eq!(counts.sum::<u64>(), marks.total);
        assert_eq!(marks.places.len() as u64, marks.total.min(1_000));
        let mut last = 0..0;
        for mark in &marks.places {
            let place = mark.at.start as usize..mark.at.end as usize;
            let there = text.get(place.clone());
            assert!(
                there.is_some_and(|piece| !piece.is_empty()),
                "{mark:?} of {text:?}"
            );
            assert!(
                last.start <= place.start,
                "{mark:?} behind {last:?} of {text:?}"
            );
            if mark.kind == Dropped::Unreadable {
                assert!(
                    last.end <= place.start,
                    "{mark:?} behind {last:?} of {text:?}"
                );
                assert!(
                    !dropped[place.clone()].contains(&true),
                    "{mark:?} of {text:?}"
                );
            } else if mark.kind != Dropped::LookAlike {
                dropped[place.clone()].fill(true);
            }
            last = place;
        }
    }
}

/// What is written in a line without data is at a place.
fn check_letters(medium: Medium, text: &str) {
    let mut reader = Reader::new(medium, text);
    let mut at = 0;
    let mut before = 0;
    let mut without = Vec::new();
    for line in text.split_inclusive(['\n', '\r']) {
        reader.push(line.as_bytes());
        at += line.len();
        if !line.ends_with(['\n', '\r']) {
            reader.push(b"\n");
        }
        let now = reader.dump().bytes().len();
        if core::mem::replace(&mut before, now) == now {
            without.push(at - line.len()..at);
        }
    }
    let dump = reader.finish();
    // Of very many places only the first are kept.
    let kept = |marks: &Marks| marks.places.len() as u64 == marks.total;
    // Mail programs fold lines, and write digits for what is none.
    let mailed = dump.writing().to_string().contains("e-mail");
    if mailed || !kept(dump.dropped()) || !kept(dump.unread()) {
        return;
    }
    let within = |marks: &Marks, at: usize| {
        let mut places = marks.places.iter();
        places.any(|mark| mark.at.contains(&(at as u64)))
    };
    for line in without {
        for (index, letter) in text[line.clone()].char_indices() {
            let at = line.start + index;
            let marked = within(dump.dropped(), at) || within(dump.unread(), at);
            assert!(
                marked || !letter.is_alphanumeric(),
                "{letter} of {:?}",
                &text[line]
            );
        }
    }
}
