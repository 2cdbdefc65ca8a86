//! Order codes: what the tables allow is read, written and explained; what they do not is named.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    decode::Decoder,
    format::Format,
    model::{FORMS, Form, Model, Part, Place, Token, Turns, look, parse},
    product::{Interface, Series},
    profile::{Code, Profile},
    record::Value,
};

fn model(code: &str) -> Model {
    parse(code).unwrap_or_else(|error| panic!("{code}: {error}"))
}

fn error(code: &str) -> String {
    match parse(code) {
        Err(error) => error.to_string(),
        Ok(model) => panic!("{code} is {}", model.code()),
    }
}

/// Every text that a position can have; of diameters one, for nothing follows from them.
fn texts(part: &'static Part) -> Vec<String> {
    let numbers = match part.number {
        None => vec![0],
        Some((least, most, "bits")) => (least..=most).collect(),
        Some(_) => vec![40],
    };
    let numbers = numbers.into_iter();
    numbers
        .flat_map(|number| {
            let words = part.words.iter();
            words.map(move |word| Token { part, number, word }.text())
        })
        .collect()
}

/// All codes that a form's table can write, whether or not the parts go together.
fn codes(form: &'static Form) -> Vec<Vec<String>> {
    form.parts.iter().fold(vec![Vec::new()], |codes, part| {
        let texts = texts(part);
        let longer = codes.iter().flat_map(|code: &Vec<String>| {
            texts.iter().map(|text| {
                let mut code = code.clone();
                code.push(text.clone());
                code
            })
        });
        longer.collect()
    })
}

/// What the manuals say of parts that do not go together, written once more: T485 has 17 or 23
/// bits and a counter, BUS no counter or M, only RS485 and RS422 a baud code (MPP, order code
/// and note 2; BUS, versions; RS485).
fn exists(resolution: &str, interface: &str, option: &str) -> bool {
    let counted = resolution.trim_start_matches(|letter: char| letter.is_ascii_digit());
    let fits = match interface {
        "T" => ["17M", "17BM", "17FM", "23M", "23BM", "23FM"].contains(&resolution),
        "D" => ["", "M", "M1"].contains(&counted),
        _ => counted != "M1",
    };
    fits && (option == "M" || ["R", "A"].contains(&interface))
}

#[test]
fn everything_that_the_tables_allow_is_read_and_written_back() {
    let mut seen = (0, 0);
    for form in FORMS {
        for texts in codes(form) {
            let at = |place| {
                let index = form.parts.iter().position(|part| part.place == place);
                index.map(|index| texts[index].as_str())
            };
            let code = texts.join("-");
            let code = code.trim_end_matches('-');
            let resolution = at(Place::Resolution);
            let is_real = resolution.is_none_or(|resolution| {
                let interface = at(Place::Interface).unwrap();
                exists(resolution, interface, at(Place::Option).unwrap_or("M"))
            });
            match (parse(code), is_real) {
                (Ok(model), true) => {
                    seen.0 += 1;
                    assert_eq!(model.code(), code);
                    assert_eq!(form.compose(&texts), Ok(model.clone()), "{code}");
                    assert_eq!(model.profile.check(), Ok(()), "{code}");
                    let looks = look(code);
                    assert!(looks.iter().all(|look| look.fault.is_none()), "{code}");
                    assert!(looks.iter().all(|look| !look.doc.is_empty()), "{code}");
                }
                (Err(error), false) => {
                    seen.1 += 1;
                    let place = form.parts[error.position - 1].place;
                    let may = [Place::Resolution, Place::Option];
                    assert!(may.contains(&place), "{code}: {error}");
                    let look = &look(code)[error.position - 1];
                    assert_eq!(look.fault.as_ref(), Some(&error.message), "{code}");
                }
                (found, _) => panic!("{code}: {found:?}"),
            }
        }
    }
    assert!(seen.0 > 5_000 && seen.1 > 1_000, "{seen:?}");
}

#[test]
fn the_crc_6_program_counts_47_bits_for_17m_and_30_for_16() {
    let with_turns = model("17M");
    assert_eq!(with_turns.interface, Interface::BissC);
    assert_eq!(
        (with_turns.profile.angle_bits, with_turns.profile.turns_bits),
        (17, 16)
    );
    assert_eq!(with_turns.frame_bits(), Some(47));
    assert_eq!(model("16").frame_bits(), Some(30));
    assert_eq!(model("MPP-40-60-A-17M-B-N-A-M").frame_bits(), Some(47));
    // With the preamble of a dump: acknowledge, start and zero.
    let decoder = Decoder::new(model("16").profile).unwrap();
    assert!(decoder.main_layout().len >= 37);
}

#[test]
fn every_example_of_the_manuals_is_read() {
    // MPP, order code; PT, size table and the example of 24BM; T485 note 2; BUS, versions.
    for (code, format, angle, turns, kept) in [
        ("MPP-20-30-A-24-S-N-A-M", Format::Ssi, 24, 0, Turns::Single),
        (
            "MPP-20-30-A-24M-B-N-A-M",
            Format::BissC,
            24,
            16,
            Turns::Powered,
        ),
        (
            "MPP-20-30-A-24BM-R-N-A-M",
            Format::Rs485,
            24,
            16,
            Turns::Battery,
        ),
        (
            "MPP-20-30-A-24FM-A-N-A-A",
            Format::Rs485,
            24,
            16,
            Turns::Flash,
        ),
        (
            "PT-15B-25H-A-24BM-R-N-A-M",
            Format::Rs485,
            24,
            16,
            Turns::Battery,
        ),
        ("17M-T", Format::T485, 17, 16, Turns::Powered),
        ("17BM-T", Format::T485, 17, 16, Turns::Battery),
        ("17FM-T", Format::T485, 17, 16, Turns::Flash),
        ("23M-T", Format::T485, 23, 16, Turns::Powered),
        ("23BM-T", Format::T485, 23, 16, Turns::Battery),
        ("23FM-T", Format::T485, 23, 16, Turns::Flash),
        ("16-D", Format::Bus, 16, 0, Turns::Single),
        ("24M-D", Format::Bus, 24, 16, Turns::Powered),
        ("16M1-D", Format::Bus, 16, 8, Turns::Powered),
        ("IP-75-ASI1", Format::Asi1, 14, 0, Turns::Single),
        ("IP-75-ASI4", Format::Asi4, 14, 0, Turns::Single),
        ("IP-75-SSI7", Format::Ssi7, 14, 0, Turns::Single),
        ("AVS58", Format::SsiTree, 13, 0, Turns::Single),
        ("AVM58-H", Format::SsiTree, 13, 12, Turns::Gear),
        ("ASS58-H", Format::SsiTree, 13, 0, Turns::Single),
        ("ASM58", Format::SsiTree, 13, 12, Turns::Gear),
    ] {
        let model = model(code);
        let Profile {
            angle_bits,
            turns_bits,
            ..
        } = model.profile;
        assert_eq!(
            (model.profile.format, angle_bits, turns_bits, model.turns),
            (format, angle, turns, kept),
            "{code}"
        );
        assert_eq!(model.interface.format(), format, "{code}");
        assert_eq!(model.code(), code);
    }
    assert_eq!(model("AVS58").profile.frame_bits, 13);
    assert_eq!(model("AVM58").profile.frame_bits, 25);
    assert_eq!(model("AVM58").profile.code, Code::Gray);
    // Every size of the tables is part of a code, and found again.
    for size in encoderscope::product::sizes::SIZES {
        let model = model(&format!("{}-A-24-B-N-C-M", size.name()));
        assert_eq!(model.size(), Some(size));
        assert!(model.notes().is_empty(), "{:?}", model.notes());
        assert_eq!(model.temperature(), Some((-40, 125)));
    }
}

#[test]
fn letters_r_and_a_share_a_format_and_not_the_wires() {
    let (two, four) = (
        model("PT-20-30-A-24-R-N-A-M"),
        model("PT-20-30-A-24-A-N-A-M"),
    );
    assert_eq!(two.profile, four.profile);
    assert_eq!(
        (two.interface, four.interface),
        (Interface::Rs485, Interface::Rs422)
    );
}

#[test]
fn a_baud_code_is_the_baud_rate() {
    for (option, baud) in [("M", 2_500_000), ("A", 115_200), ("B", 2_500_000)] {
        let code = format!("MPP-20-30-A-24-R-N-A-{option}");
        assert_eq!(model(&code).profile.baud, baud, "{code}");
    }
    assert_eq!(model("IP-75-ASI1").profile.baud, 230_400);
}

#[test]
fn each_wrong_part_is_named_with_what_fits() {
    for (code, message) in [
        ("", "part 1 of the order code: is missing"),
        (
            "XPP-20-30-A-24-S-N-A-M",
            "part 1 of the order code: \"XPP\" is no series; \
             MPP, PT, IP-75, AVS58, AVM58, ASS58, ASM58 fit",
        ),
        (
            "MPP-20B-30-A-24-S-N-A-M",
            "part 2 of the order code: \"20B\" is no rotor diameter; 1 to 999 mm fit",
        ),
        (
            "PT-20X-30-A-24-S-N-A-M",
            "part 2 of the order code: \"20X\" is no rotor diameter; \
             1 to 999 mm fit, alone or with B behind",
        ),
        (
            "PT-20-30B-A-24-S-N-A-M",
            "part 3 of the order code: \"30B\" is no stator diameter; \
             1 to 999 mm fit, alone or with H behind",
        ),
        (
            "PT-20-0-A-24-S-N-A-M",
            "part 3 of the order code: \"0\" is no stator diameter; \
             1 to 999 mm fit, alone or with H behind",
        ),
        (
            "MPP-20-30-B-24-S-N-A-M",
            "part 4 of the order code: \"B\" is no output; A fits",
        ),
        (
            "MPP-20-30-A-25-S-N-A-M",
            "part 5 of the order code: \"25\" is no resolution; \
             16 to 24 bits fit, alone or with M, BM, FM or M1 behind",
        ),
        (
            "MPP-20-30-A-24-Z-N-A-M",
            "part 6 of the order code: \"Z\" is no interface; S, B, R, A, T, D or P fit",
        ),
        (
            "MPP-20-30-A-24-S-M-A-M",
            "part 7 of the order code: \"M\" is no supply; N fits",
        ),
        (
            "MPP-20-30-A-24-S-N-D-M",
            "part 8 of the order code: \"D\" is no temperature range; A, B or C fit",
        ),
        (
            "MPP-20-30-A-24-S-N-A",
            "part 9 of the order code: the option is missing; M, A or B fit",
        ),
        (
            "MPP-20-30-A-24-S-N-A-M-X",
            "part 10 of the order code: \"X\" is one too many: the code has 9 parts",
        ),
        (
            "MPP-20-30-A-24BM-T-N-A-M",
            "part 5 of the order code: T485 comes with 17M, 17BM, 17FM, 23M, 23BM or 23FM only",
        ),
        (
            "MPP-20-30-A-24BM-D-N-A-M",
            "part 5 of the order code: \
             BUS comes without a turn counter or with M; BM and FM do not exist",
        ),
        (
            "MPP-20-30-A-24-S-N-A-A",
            "part 9 of the order code: \
             only RS485 and RS422, letters R and A, have a baud code; M fits",
        ),
        (
            "16M1-B",
            "part 1 of the order code: M1 exists with BUS only; nothing, M, BM or FM fits",
        ),
        (
            "99M",
            "part 1 of the order code: \"99M\" is no resolution; \
             16 to 24 bits fit, alone or with M, BM, FM or M1 behind",
        ),
        (
            "IP-75",
            "part 2 of the order code: the interface is missing; ASI1, ASI4 or SSI7 fit",
        ),
        (
            "IP-75-ASI2",
            "part 2 of the order code: \"ASI2\" is no interface; ASI1, ASI4 or SSI7 fit",
        ),
        (
            "AVM58-X",
            "part 2 of the order code: \"X\" is no kind of logic; H or nothing fits",
        ),
    ] {
        assert_eq!(error(code), message, "{code}");
    }
    for (code, rotor) in [
        ("PT-1-999H-A-24-S-N-A-M", 1),
        ("PT-999B-1-A-24-S-N-A-M", 999),
    ] {
        assert_eq!(model(code).token(Place::Rotor).unwrap().number, rotor);
    }
    assert!(error("PT-1000-30-A-24-S-N-A-M").contains("part 2"));
    // Numbers too large for any word are no panic.
    assert!(error("MPP-99999999999999999999-30-A-24-S-N-A-M").contains("part 2"));
}

#[test]
fn all_wrong_parts_are_seen_at_once() {
    let looks = look("MPP-x-30-B-24-Z-N-A-M-1");
    let wrong: Vec<usize> = (1..)
        .zip(&looks)
        .filter(|(_, look)| look.fault.is_some())
        .map(|(position, _)| position)
        .collect();
    assert_eq!(wrong, [2, 4, 6, 10]);
    assert_eq!(looks[4].doc, "24 bits, single turn");
    // What is not yet typed is said to be missing, and what a code may end before is not.
    assert_eq!(
        look("MPP")
            .iter()
            .filter(|look| look.fault.is_some())
            .count(),
        8
    );
    assert!(look("AVM58").iter().all(|look| look.fault.is_none()));
    let unknown = look("ABC-1");
    assert!(unknown[0].fault.is_some() && unknown[1].fault.is_none());
    assert!(look("").is_empty() || look("")[0].fault.is_some());
}

#[test]
fn labels_are_read_as_they_are_typed() {
    let plain = model("MPP-20-30-A-24BM-R-N-A-M");
    for typed in [
        "mpp-20-30-a-24bm-r-n-a-m",
        "  MPP 20 30 A 24BM R N A M ",
        "MPP–20–30–A–24BM–R–N–A–M",
        "MPP − 20 ‑ 30 ‐ A — 24BM - R - N - A - M",
        "МРР-20-30-А-24ВМ-R-N-А-М",
        "мрр-20-30-а-24вм-R-N-а-м",
        "MPP\u{ad}20-30\u{a0}A-24\u{200b}BM-R-N-A-M\u{feff}",
    ] {
        assert_eq!(model(typed), plain, "{typed}");
    }
    let stream = model("IP-75-ASI1");
    for typed in ["ИП-75-ASI1", "ип75 asi1", "ИП 75 ASI1", "ip-75‑asi1"] {
        assert_eq!(model(typed), stream, "{typed}");
    }
    assert_eq!(
        model("РТ-15В-25Н-А-24М-В-N-С-М").code(),
        "PT-15B-25H-A-24M-B-N-C-M"
    );
    assert_eq!(model("ASМ58-Н").code(), "ASM58-H");
}

#[test]
fn a_code_says_what_else_follows() {
    let model = model("PT-15B-25H-A-24BM-R-N-B-A");
    assert_eq!(model.series, Some(Series::Pt));
    assert!(model.has_battery() && model.changes_by_command());
    assert_eq!(model.temperature(), Some((-40, 105)));
    assert_eq!(model.frame_bits(), Some(7 * 8));
    let record = model.record().to_string();
    assert_eq!(
        record,
        r#"{"format":"rs485","angleBits":24,"turnsBits":16,"command":"d","turnsCode":"unsigned","baud":115200,"series":"PT","orderCode":"PT-15B-25H-A-24BM-R-N-B-A","interface":"rs485","turnsKept":"battery","battery":true,"changesByCommand":true,"supply":"4.5…5.5 V","current":"≈ 100 mA","leastTemperature":-40,"greatestTemperature":105,"rotor":15,"stator":25,"frameBits":56}"#
    );
}

#[test]
fn no_name_of_a_record_means_two_things() {
    for code in [
        "17M",
        "16M1-D",
        "IP-75-ASI4",
        "IP-75-SSI7",
        "AVS58",
        "AVM58-H",
    ] {
        let model = model(code);
        let record = model.record();
        let mut names: Vec<_> = record.0.iter().map(|(name, _)| name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), record.0.len(), "{code}: {record}");
        let bits = record.find("frameBits").map(Value::plain);
        let expected = model.frame_bits().map(|bits| bits.to_string());
        assert_eq!(bits, expected, "{code}");
    }
}

#[test]
fn what_can_be_asked_is_what_the_interface_knows() {
    for (code, bytes, changes) in [
        ("24BM-R", &b"01dst"[..], true),
        ("23M-T", &[0x02, 0x8a, 0x1a, 0xc2, 0x62], true),
        ("24M-D", &[0x1f, 0xbf, 0xdf], true),
        ("24-P", &[], false),
        ("24-B", &[], false),
        ("IP-75-ASI1", &[], false),
        ("AVM58", &[], false),
    ] {
        let model = model(code);
        let asked: Vec<u8> = model
            .requests()
            .iter()
            .map(|request| request.byte)
            .collect();
        assert_eq!(asked, bytes, "{code}");
        assert_eq!(model.changes_by_command(), changes, "{code}");
    }
}

#[test]
fn frames_have_the_lengths_of_the_manuals() {
    for (code, bits) in [
        ("24-S", Some(32)),
        ("24M-S", Some(48)),
        ("24-R", Some(5 * 8)),
        ("23M-T", Some(11 * 8)),
        ("16-D", Some(5 * 8)),
        ("24M-D", Some(8 * 8)),
        ("24-P", Some(5 * 8)),
        ("IP-75-ASI1", Some(6 * 8)),
        ("IP-75-ASI4", None),
        ("IP-75-SSI7", Some(30)),
        ("AVS58", Some(13)),
        ("AVM58", Some(25)),
    ] {
        assert_eq!(model(code).frame_bits(), bits, "{code}");
    }
}
