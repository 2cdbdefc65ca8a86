//! What the core says, in Russian: a program of its own, for a program learns one other language.
#![cfg(not(target_arch = "wasm32"))]
#![allow(missing_docs)]

use encoderscope::{
    bits::{BitString, Bits},
    decode::{Decoder, Frame},
    detect::{Change, detect, near},
    dump,
    explain::Note,
    format::{Format, bus::Operation, own::SHIPPED, rs485::Command, t485::Request},
    language::{Catalogue, in_english, speak},
    layout::{Layout, Piece, Row},
    profile::Profile,
};
use encoderscope_tests::decoder;
use serde_json::Value;
use std::{collections::BTreeSet, fs, path::Path};

/// Profiles that have every layout and every named bit between them.
const PROFILES: &[&str] = &[
    "format=ssi",
    "format=biss-c",
    "format=biss-c status-active=low status-bits=6",
    "format=rs485 command=0",
    "format=rs485 command=1",
    "format=rs485 command=d",
    "format=rs485 command=s",
    "format=rs485 command=t",
    "format=t485",
    "format=t485 dialect=tamagawa",
    "format=bus",
    "format=bus parity=odd",
    "format=bus parity=even",
    "format=period",
    "format=asi1",
    "format=asi4",
    "format=ssi7",
    "format=ssi-tree",
    "format=ssi-tree parity=even frame-bits=26",
    "format=ssi-tree parity=odd code=binary frame-bits=30",
];

/// Words of formats and makers that stand side by side in Russian too.
const STAYS: &[&str] = &["line biss stream poll"];

#[test]
fn the_core_speaks_russian() {
    let russian = catalogue();
    assert_eq!(missing(russian), BTreeSet::new());

    let english: Vec<String> = decoders().iter().flat_map(said).collect();
    speak(Some(russian));
    let mut all: Vec<String> = decoders().iter().flat_map(said).collect();
    let again: Vec<String> = in_english(|| decoders().iter().flat_map(said).collect());
    let records = records();
    all.extend(detected());
    speak(None);

    assert_eq!(english, again);
    assert_eq!(records, self::records());
    let left: BTreeSet<&String> = all.iter().filter(|text| is_english(text)).collect();
    assert_eq!(left, BTreeSet::new());
    let text = all.join("\n");
    for known in [
        "контроль сходится в 4 из 4 кадров",
        "0x1A: угол, код энкодера, обороты и тревоги",
        "батарея отсоединена",
        "Угол в пределах оборота.",
        "123,456",
    ] {
        assert!(text.contains(known), "{known}");
    }
}

/// All that the page has in Russian.
fn catalogue() -> &'static Catalogue {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../web/locales/ru");
    let files = fs::read_dir(directory).unwrap();
    Catalogue::new(files.flat_map(|file| {
        let text = fs::read_to_string(file.unwrap().path()).unwrap();
        let Value::Object(texts) = serde_json::from_str(&text).unwrap() else {
            panic!("no object");
        };
        let texts = texts.into_iter();
        texts.map(|(english, other)| (english, other.as_str().unwrap().to_owned()))
    }))
}

/// Decoders of the manuals' formats, then of the shipped layouts.
fn decoders() -> Vec<Decoder> {
    let shipped = SHIPPED.iter().map(|own| {
        let pairs = [("format", "own"), ("layout", own.name)];
        Decoder::new(Profile::parse(pairs).unwrap()).unwrap()
    });
    let known = PROFILES.iter().map(|parameters| decoder(parameters));
    known.chain(shipped).collect()
}

/// What the tables say and the catalogue does not have.
fn missing(russian: &Catalogue) -> BTreeSet<String> {
    let mut texts: BTreeSet<String> = BTreeSet::new();
    for decoder in decoders() {
        for kind in decoder.frame_kinds() {
            texts.insert(kind.title);
            layout(kind.layout.layout, &mut texts);
        }
        let profile = decoder.profile();
        texts.insert(profile.source().to_owned());
        for (name, _) in profile.parameters() {
            texts.insert(Profile::doc(name).to_owned());
            texts.extend(
                Profile::word_docs(name)
                    .iter()
                    .map(|doc| doc.trim().to_owned()),
            );
        }
    }
    for format in Format::ALL {
        texts.insert(format.manual().about.to_owned());
        if let Some(timing) = format.timing() {
            let said = [timing.source, timing.timeout_text, timing.pause_text];
            texts.extend(said.map(ToOwned::to_owned));
        }
    }
    let commands = Command::ALL.iter().map(|command| command.title());
    let requests = Request::ALL.iter().map(|request| request.title());
    let operations = Operation::ALL.iter().map(|operation| operation.title());
    let titles = commands.chain(requests).chain(operations);
    texts.extend(titles.map(ToOwned::to_owned));
    texts.extend(SHIPPED.iter().map(|own| own.source.to_owned()));
    // A request is called by its bytes, an IncOder by its maker.
    let named = |text: &str| text.starts_with("request 0x") || text.starts_with("IncOder SSI");
    let is_data = |text: &String| text.is_empty() || named(text);
    texts.retain(|text| !is_data(text) && russian.get(text).is_none());
    texts
}

fn layout(layout: &Layout, texts: &mut BTreeSet<String>) {
    if !layout.doc.is_empty() {
        texts.insert(layout.title());
    }
    for piece in layout.pieces {
        match piece {
            Piece::Row(one) => row(one, texts),
            Piece::LittleEndian(rows) | Piece::Gray(_, rows) | Piece::Decimal(rows) => {
                rows.iter().for_each(|one| row(one, texts));
            }
            Piece::Include(other) => self::layout(other, texts),
        }
    }
}

fn row(row: &Row, texts: &mut BTreeSet<String>) {
    texts.insert(row.name.to_owned());
    texts.insert(row.english());
    for bit in row.bits {
        texts.extend([bit.name.to_owned(), bit.doc.to_owned()]);
    }
}

/// What is said of the examples of every frame, whole and with each bit in turn damaged.
fn said(decoder: &Decoder) -> Vec<String> {
    let mut texts = Vec::new();
    for kind in decoder.frame_kinds() {
        texts.push(kind.title);
        let whole = kind.example;
        let damaged = (0..whole.as_bits().len()).map(|at| flipped(whole.as_bits(), at));
        for bits in damaged.chain([whole.clone()]) {
            let notes = kind.layout.explain(bits.as_bits());
            texts.extend(notes.into_iter().flat_map(of_note));
        }
    }
    texts
}

fn of_note(note: Note) -> Vec<String> {
    let mut texts = vec![note.doc, note.text];
    texts.extend(note.bits.iter().map(|bit| bit.doc.to_owned()));
    texts.extend(note.fault.map(|fault| fault.kind.to_string()));
    texts
}

fn flipped(bits: Bits<'_>, at: usize) -> BitString {
    let mut out = BitString::default();
    (0..bits.len()).for_each(|index| out.push(bits.bit(index) != (index == at)));
    out
}

/// What programs read of a damaged frame.
fn records() -> String {
    let decoder = decoder("format=t485");
    let frame: Frame<'_> = decoder
        .frame(&[0x02, 0x20, 0xb4, 0xbd, 0x1c, 0x38])
        .unwrap();
    frame.record().to_string()
}

/// Longer dumps take long without saying anything else.
const LONGEST: usize = 1_500;

/// One frame is like the next.
const EVERY: usize = 8;

/// What detection says of some published vectors and of the dumps.
fn detected() -> Vec<String> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(directory.join("vectors.json")).unwrap();
    let vectors: Vec<Value> = serde_json::from_str(&text).unwrap();
    let hex = vectors.iter().filter_map(|vector| vector["hex"].as_str());
    let mut dumps: Vec<String> = hex.step_by(EVERY).map(ToOwned::to_owned).collect();
    for file in fs::read_dir(directory.join("dumps")).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "txt") {
            let text = fs::read_to_string(path).unwrap();
            dumps.extend((text.len() < LONGEST).then_some(text));
        }
    }
    let mut texts = Vec::new();
    for text in dumps {
        for candidate in detect(&text) {
            texts.extend(candidate.evidence);
            texts.extend(candidate.change.map(Change::sentence));
        }
        let profile = Format::T485.default_profile();
        let dump = dump::parse(&text, profile.medium());
        texts.push(dump.writing().to_string());
        let kinds = dump.dropped().places.iter();
        texts.extend(kinds.map(|mark| mark.kind.to_string()));
        texts.extend(near(&profile, &dump).into_iter().map(|near| near.text));
    }
    texts
}

/// Whether two words of English stand side by side; names begin with capitals.
fn is_english(text: &str) -> bool {
    let mut text = text.to_owned();
    STAYS.iter().for_each(|name| text = text.replace(name, ""));
    let words: Vec<&str> = text.split(' ').collect();
    let is_word = |word: &str| {
        let word = word.trim_matches(|letter: char| letter.is_ascii_punctuation());
        word.len() > 1 && word.bytes().all(|letter| letter.is_ascii_alphabetic())
    };
    let is_low = |word: &str| word.starts_with(|letter: char| letter.is_ascii_lowercase());
    words.windows(2).any(|pair| {
        let both = pair.iter().all(|word| is_word(word));
        both && pair.iter().any(|word| is_low(word))
    })
}
