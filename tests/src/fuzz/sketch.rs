use super::{Input, check_record};
use encoderscope::{
    bits::{self, BitString, Bits},
    decode::Decoder,
    format::{
        Format,
        own::{self, Draft, Kind, Own, Written},
    },
    layout::{Active, Class, Field, Resolved, Role},
    profile::{Profile, TurnsCode},
    reading::{Checked, Values},
    sketch::{Checks, DigitsError, Heard, Refusal, Sketch},
};
use std::fmt::Write;

/// What layouts are written with, beside their letters.
const WORDS: &[&str] = &[
    "Mine;line;",
    "Mine;biss;",
    "Mine;stream;",
    "Mine;poll:31;",
    "Mine;poll:30;",
    "rls-biss-26",
    "incoder-ssi6",
    ";",
    ",",
    ":",
    "=",
    "|",
    " ",
    "angle:18,",
    "angle:8:name=a,",
    "angle:12:gray,",
    "turns:12:gray,",
    "angle:24:le,",
    "turns:16,",
    "error:1:low,",
    "warning,",
    "valid:1,",
    "zero-default:1,",
    "status:3:bits=hot||cold,",
    "temperature:12,",
    "speed:16:le,",
    "count:4,",
    "const:8:0xa5,",
    "zeros:2,",
    "skip:6,",
    "crc:6:0x03:xor=0x3f",
    "crc:8:0x97:reflected:init=0xff,",
    "crc:16:0x1021:from=turns:to=angle,",
    "even,",
    "odd:1",
    ":from=",
    ":to=",
    ":name=",
    ":gray",
    ":le",
    ":low",
    "é",
    "0x",
    "64",
    "256",
];
/// What is put into fields.
const ENTRIES: &[&str] = &[
    "0",
    "1",
    "180°",
    "359,99999",
    "-1",
    "−12.5",
    "0x1f",
    "0b101",
    "18446744073709551615",
    "1e9",
    "1 000",
    "",
    "x",
    "255",
];

/// A user's layout or a format, and a frame of it that is changed.
///
/// # Panics
///
/// A law is broken: a layout is not what is written, a frame is not what was put into it, checks
/// that are computed do not hold, or an error is nowhere.
pub fn sketch(data: &[u8]) {
    let mut input = Input(data);
    let form = input.byte();
    let decoder = match form % 4 {
        0 => {
            let text = input.worded(WORDS);
            layout(&text);
            let Ok(own) = own::of(&text) else { return };
            // The same letters are what is done to its frame.
            input = Input(data);
            decoder_of(own.short(), form)
        }
        1 => {
            let text = drafted(&mut input);
            layout(&text);
            let Ok(own) = own::of(&text) else { return };
            decoder_of(own.short(), form)
        }
        2 => decoder_of(input.one_of(own::SHIPPED).name, form),
        _ => match input.decoder(Format::ALL) {
            Some(decoder) => decoder,
            None => return,
        },
    };
    if decoder.profile().format == Format::Own {
        numbers(&decoder, &mut input);
    }
    edits(decoder, &mut input);
}

fn decoder_of(layout: &str, form: u8) -> Decoder {
    let turns = TurnsCode::ALL[usize::from(form >> 7)].name();
    let pairs = [("format", "own"), ("layout", layout), ("turns-code", turns)];
    let profile = Profile::parse(pairs).expect("a layout that was made");
    Decoder::new(profile).expect("a layout that was made")
}

/// Fields that mostly make a layout.
fn drafted(input: &mut Input<'_>) -> String {
    let framing = ["line", "biss", "stream", "poll:31", "poll:64"];
    let mut text = format!("Drafted;{};", input.one_of(&framing));
    let count = input.within(1, 12);
    for index in 0..count {
        let kind = input.one_of(Kind::ALL);
        let (least, most) = kind.widths();
        let width = input.within(least, most.min(40));
        let options = input.byte();
        let comma = if index > 0 { "," } else { "" };
        let _ = write!(text, "{comma}{}:{width}", kind.name());
        let mask = bits::mask(width as usize);
        if kind == Kind::Crc {
            let (polynomial, init) = (input.long() & mask | 1, input.long() & mask);
            let _ = write!(text, ":0x{polynomial:x}:xor=0x{:x}", input.long() & mask);
            if options & 1 == 1 {
                let _ = write!(text, ":reflected:init=0x{init:x}");
            }
        }
        if kind == Kind::Const {
            let _ = write!(text, ":0x{:x}", input.long() & mask);
        }
        for (place, said) in [(2, ":low"), (3, ":gray"), (4, ":le")] {
            // Most of what fits together has none.
            if options >> place & 1 == 1 && options & 0xc0 == 0 {
                text.push_str(said);
            }
        }
        if kind.role().class() == Class::Check && options >> 5 & 1 == 1 {
            let _ = write!(text, ":from=f{}", input.within(0, count - 1));
            let _ = write!(text, ":to=f{}", input.within(0, count - 1));
        }
        // Parts of one number have one name.
        let name = match options >> 6 & 3 {
            3 => 0,
            _ => index,
        };
        if options & 0x40 != 0 {
            let _ = write!(text, ":name=f{name}");
        }
    }
    text
}

/// A layout is what is written, and what is wrong with it is in one of its fields.
fn layout(text: &str) {
    let parsed: Result<Written, String> = text.parse();
    if let Ok(written) = &parsed {
        let again: Written = written.to_string().parse().expect("what was written");
        assert_eq!(&again, written);
        assert_eq!(again.to_string(), written.to_string());
    }
    let own = match own::of(text) {
        Ok(own) => own,
        Err(why) => {
            assert!(why.len() > 8, "{why}");
            if let Some(rest) = why.strip_prefix("field ") {
                let (number, _) = rest.split_once(' ').expect("a number");
                let number: usize = number.parse().expect("a number");
                assert!((1..=text.split(',').count()).contains(&number), "{why}");
            }
            return;
        }
    };
    assert!(parsed.is_err() || parsed.as_ref() == Ok(own.written()));
    for same in [own.short(), &own.written().to_string()] {
        assert!(
            own::of(same).is_ok_and(|same| core::ptr::eq(same, own)),
            "{text}"
        );
    }
    in_order(own);
}

/// Fields stand one behind the other as they are written; in little-endian numbers bytes do.
fn in_order(own: &Own) {
    let fields = &own.written().fields;
    let decoder = decoder_of(own.short(), 0);
    let layout = decoder.main_layout();
    let mut written = 0;
    let mut base = None;
    for draft in fields {
        let named = |other: &&Draft| other.name == draft.name && draft.name.is_some();
        let alone = fields.iter().filter(named).count() == 1;
        let found = layout
            .fields()
            .find(|field| Some(field.row.name) == draft.name.as_deref());
        if let Some(field) = found.filter(|_| alone && !draft.little_endian) {
            assert_eq!(field.width, draft.width);
            let [part] = layout.parts(field) else {
                panic!("{} is in parts", field.row.name);
            };
            let here = part.span.start - written;
            assert_eq!(*base.get_or_insert(here), here, "{}", field.row.name);
        }
        written += draft.width as usize;
    }
    assert!(written <= layout.len);
}

/// The numbers that were encoded are read back, as far as there is room for them.
fn numbers(decoder: &Decoder, input: &mut Input<'_>) {
    let profile = decoder.profile();
    let layout = decoder.main_layout();
    let range = bits::mask(profile.angle_bits as usize);
    let values = Values {
        angle: Some(input.long() & range),
        turns: Some(input.word().into()),
        valid: None,
        ..input.values()
    };
    let frame = layout.encode(&values);
    let frame = frame.as_bits();
    assert!(layout.holds(frame), "{:?}", layout.faults(frame));
    let read = layout.values(frame);
    assert_eq!(read.angle, values.angle, "{:?}", profile.own);
    // Of two counts of different widths only one is read.
    let fields = profile.own.map_or(&[][..], |own| &own.written().fields);
    let twice = |kind: &Kind| fields.iter().filter(|field| field.kind == *kind).count() > 1;
    if !Kind::ALL.iter().any(twice) {
        assert_eq!(layout.encode(&read).as_bits(), frame, "{:?}", profile.own);
    }
    if profile.turns_code == TurnsCode::Unsigned && profile.turns_bits > 0 {
        let most = bits::mask(profile.turns_bits as usize);
        assert_eq!(
            read.turns,
            Some((u64::from(values.turns.unwrap_or(0) as u16) & most) as i64),
            "{:?}",
            profile.own
        );
    }
    let reading = layout
        .reading(frame)
        .expect("a good frame")
        .expect("an angle");
    assert_eq!(Some(reading.angle), values.angle);
    assert_eq!(reading.error, read.error == Some(true), "{:?}", profile.own);
}

fn edits(decoder: Decoder, input: &mut Input<'_>) {
    let kinds = decoder.frame_kinds();
    let kind = kinds[usize::from(input.byte()) % kinds.len()].clone();
    let fields: Vec<&'static str> = kind.layout.fields().map(|field| field.row.name).collect();
    let mut sketch = Sketch::new(decoder, kind);
    check_sketch(&sketch);
    check_text(&sketch);
    let mut steps = 0;
    while !input.is_empty() && steps < 24 {
        steps += 1;
        let (what, how) = (input.byte(), input.byte());
        let checks = [Checks::Follow, Checks::Stay][usize::from(what >> 7)];
        let before = copied(sketch.bits());
        match what & 7 {
            0..=2 => {
                let index = usize::from(how) % (before.as_bits().len() + 1);
                sketch.flip(index, checks);
                flipped(&sketch, before.as_bits(), index, checks);
            }
            3 => sketch.set_byte(usize::from(how) % 40, input.byte()),
            4 => sketch.mend(),
            5 => {
                let digits = input.take(usize::from(how & 0x1f));
                of_digits(sketch.decoder(), &String::from_utf8_lossy(digits));
            }
            _ => {
                let name = fields[usize::from(how) % fields.len()];
                let text = match what >> 3 & 1 {
                    0 => input.one_of(ENTRIES).to_owned(),
                    _ => input.long().to_string(),
                };
                match sketch.enter(name, &text, checks) {
                    Ok(()) => entered(&sketch, name),
                    Err(why) => {
                        assert_eq!(sketch.bits(), before.as_bits());
                        refused(why);
                    }
                }
            }
        }
        check_sketch(&sketch);
    }
    check_text(&sketch);
    sketch.mend();
    let mended = copied(sketch.bits());
    for field in sketch
        .kind()
        .layout
        .fields()
        .filter(|field| field.cover.is_some())
    {
        let checked = sketch.kind().layout.checked(field, sketch.bits());
        assert!(checked.is_some_and(Checked::ok), "{field:?}");
    }
    sketch.mend();
    assert_eq!(sketch.bits(), mended.as_bits());
}

fn copied(bits: Bits<'_>) -> BitString {
    let mut out = BitString::default();
    (0..bits.len()).for_each(|at| out.push(bits.bit(at)));
    out
}

/// One bit is another one, and besides it checks that follow alone.
fn flipped(sketch: &Sketch, before: Bits<'_>, index: usize, checks: Checks) {
    let now = sketch.bits();
    for at in 0..now.len() {
        let check = || {
            let field = sketch.kind().layout.field_at(at);
            field.is_some_and(|field| field.cover.is_some())
        };
        let changed = now.bit(at) != before.bit(at);
        assert!(
            changed == (at == index) || checks == Checks::Follow && check(),
            "bit {at}"
        );
    }
}

/// What was put into a field is there, as it is shown.
fn entered(sketch: &Sketch, name: &str) {
    let shown = sketch.entry(name).expect("a field");
    let mut again = sketch.clone();
    again
        .enter(name, &shown, Checks::Stay)
        .expect("what is shown");
    assert_eq!(again.bits(), sketch.bits(), "{name}: {shown}");
}

fn refused(why: Refusal) {
    assert!(why.to_string().len() > 8);
    assert_ne!(why, Refusal::NoField);
    if let Refusal::Range { least, most, .. } = why {
        assert!(least <= 0 && 0 <= most && least < most);
    }
}

/// Digits are a frame, or one of them is none.
fn of_digits(decoder: &Decoder, text: &str) {
    match Sketch::of_digits(decoder.clone(), text, None) {
        Ok(sketch) => {
            assert_eq!(sketch.bits().len(), sketch.kind().layout.len);
            check_sketch(&sketch);
        }
        Err(DigitsError::NoDigit(letter)) => assert!(text.contains(letter)),
        Err(why) => assert!(why.to_string().len() > 8),
    }
}

/// Everything that is said of a frame is said of its bits.
fn check_sketch(sketch: &Sketch) {
    let (kind, now) = (sketch.kind(), sketch.bits());
    assert_eq!(now.len(), kind.layout.len);
    let slow = Resolved::new(kind.layout.layout, kind.layout.shape);
    let own = sketch.decoder().profile().own;
    assert_eq!(kind.layout.faults(now), slow.faults(now), "{own:?}");
    assert_eq!(
        kind.layout.holds(now),
        slow.faults(now).is_empty(),
        "{own:?}"
    );
    assert_eq!(kind.layout.reading(now), slow.reading(now));
    if let Ok(Some(reading)) = slow.reading(now) {
        let says = |field: &Field| {
            let set = slow.read(field, now) == 1;
            let active = set == (field.row.active == Active::High);
            field.row.role == Role::Error && active || field.row.role == Role::Valid && !active
        };
        assert!(reading.error || !slow.fields().any(says));
        assert_eq!(slow.values(now).angle, Some(reading.angle));
    }
    for fault in slow.faults(now) {
        assert!(fault.at.end() <= now.len() && !fault.kind.to_string().is_empty());
    }
    let notes = sketch.notes();
    let spans = notes.iter().flat_map(|note| &note.spans);
    assert_eq!(spans.map(|span| span.len).sum::<usize>(), now.len());
    for note in &notes {
        check_record(&note.record().into());
    }
}

/// What is written is read again, and the other side makes something of it.
fn check_text(sketch: &Sketch) {
    let (kind, now) = (sketch.kind(), sketch.bits());
    let direction = Some(kind.direction);
    let again = Sketch::parse(sketch.decoder().clone(), &sketch.text(), direction);
    let again = again.unwrap_or_else(|why| panic!("{}, {}: {why}", kind.name, sketch.text()));
    assert_eq!(again.bits(), now, "{}, {}", kind.name, sketch.text());
    match sketch.heard() {
        Heard::Faults(faults) => assert!(!faults.is_empty()),
        Heard::NoFrame(why) => assert!(!why.to_string().is_empty()),
        Heard::Answer(answer) => assert!(!answer.is_empty()),
        Heard::Reading(reading) => assert!((0.0..360.0).contains(&reading.degrees())),
        Heard::Good | Heard::Silence => {}
    }
}
