//! Nothing that they say is left in English.

use encoderscope::{
    adapter::{CHIPS, System},
    apci1710::Register,
    calculator::{CALCULATORS, Kind},
    errata::ERRATA,
    lamp::{self, BATTERY, Health, Lamp, Light},
    language::{self, Catalogue, t},
    model::{self, FORMS, Form, RULES, Token},
    procedure,
    product::{
        Interface, Series,
        facts::{FACTS, Group},
        sizes::THICKNESS,
    },
    wiring::{Adapter, Battery, Paint, Setup, svg},
};
use std::{collections::BTreeMap, fs, path::Path};

/// The Russian texts of all files.
fn russian() -> &'static Catalogue {
    let files = Path::new(env!("CARGO_MANIFEST_DIR")).join("../web/locales/ru");
    let mut texts = BTreeMap::new();
    for file in fs::read_dir(files).unwrap() {
        let text = fs::read_to_string(file.unwrap().path()).unwrap();
        texts.extend(serde_json::from_str::<BTreeMap<String, String>>(&text).unwrap());
    }
    Catalogue::new(texts)
}

/// What is said in English wherever it is said.
const STAYS: &[&str] = &["sudo tee", "sudo usermod"];

/// Two words of Latin letters in a row.
fn english(text: &str) -> Option<String> {
    let is_word = |word: &&str| {
        word.len() > 1
            && word
                .bytes()
                .all(|letter| letter.is_ascii_lowercase() || letter == b'\'')
    };
    let words: Vec<&str> = text
        .split(|letter: char| letter.is_whitespace() || ",.;:()".contains(letter))
        .collect();
    let found = words.windows(2).find(|pair| pair.iter().all(is_word))?;
    let pair = found.join(" ");
    (!STAYS.contains(&pair.as_str())).then(|| format!("{pair:?} in {text:?}"))
}

fn calculators(said: &mut Vec<String>) {
    for calculator in CALCULATORS {
        said.extend(
            [calculator.title, calculator.about, calculator.source].map(|text| t(text).into()),
        );
        let mut outcomes = vec![calculator.work(|_| None)];
        for input in calculator.inputs {
            said.extend([
                t(input.title).into(),
                t(input.doc).into(),
                input.unit_title(),
            ]);
            let entered: Vec<String> = match input.kind {
                Kind::Word(words) => words.iter().map(|word| word.name.to_owned()).collect(),
                Kind::Number { least, most, .. } => vec![
                    least.to_string(),
                    most.to_string(),
                    (most + 1.0).to_string(),
                    String::from("1.3"),
                    String::from("x"),
                    String::from("1,234"),
                    String::from("1 kHz"),
                ],
            };
            if let Kind::Word(words) = input.kind {
                said.extend(words.iter().map(|word| t(word.title).into()));
            }
            for text in entered {
                outcomes.push(calculator.work(|name| (name == input.name).then_some(&*text)));
            }
        }
        for outcome in outcomes {
            match outcome {
                Ok(outcome) => {
                    for answer in outcome.answers {
                        said.extend([answer.title, answer.text, answer.note]);
                    }
                    said.extend(outcome.code.map(|code| t(code.title).into()));
                }
                Err(fault) => said.push(fault.message),
            }
        }
    }
    said.extend(CHIPS.iter().map(|chip| t(chip.note()).into()));
    for system in System::ALL {
        said.extend([system.latency().into(), system.permission().into()]);
    }
}

fn wirings(said: &mut Vec<String>) {
    for series in Series::ALL {
        for interface in Interface::ALL {
            for battery in Battery::ALL {
                for adapter in Adapter::ALL {
                    said.extend([adapter.title().into(), adapter.label().into()]);
                    let setup = Setup {
                        series,
                        interface,
                        battery,
                        adapter,
                    };
                    let wiring = match setup.wire() {
                        Ok(wiring) => wiring,
                        Err(fault) => {
                            said.push(fault.message);
                            continue;
                        }
                    };
                    said.push(wiring.source.into());
                    for wire in &wiring.wires {
                        said.extend([t(wire.note), t(wire.signal)].map(String::from));
                        said.extend(wire.goes.map(|terminal| t(terminal.name).into()));
                        said.extend(wire.paint.map(Paint::title));
                    }
                    for warning in &wiring.warnings {
                        said.extend([warning.text.clone(), warning.source.into()]);
                    }
                    for terminator in &wiring.terminators {
                        said.extend([t(terminator.text), t(terminator.source)].map(String::from));
                    }
                    let picture = svg(&wiring);
                    let shown = picture.split('>').filter_map(|part| part.split('<').next());
                    said.extend(shown.map(String::from));
                }
            }
            match procedure::zero(series, interface) {
                Err(fault) => said.push(fault.message),
                Ok(zero) => {
                    for way in zero.procedures {
                        said.extend([way.title, way.about].map(String::from));
                        said.extend(way.notes.into_iter().map(String::from));
                        for step in way.steps {
                            said.extend([step.text, step.expect, step.source.into()]);
                        }
                    }
                    for missing in zero.missing {
                        said.extend([missing.text, missing.source].map(String::from));
                    }
                }
            }
        }
    }
}

fn order_codes(said: &mut Vec<String>) {
    const CODES: &[&str] = &[
        "MPP-20-30-A-24BM-R-N-A-M",
        "MPP-41-60-A-23FM-T-N-B-M",
        "PT-15B-25H-A-24-B-N-A-M",
        "PT-20-30-A-16M1-D-N-C-M",
        "MPP-20-30-A-24-S-N-A-B",
        "IP-75-ASI4",
        "AVM58-H",
        "AVS58",
        "17M",
        "17BM-D",
        "16",
        "24M-T",
        "x",
        "",
        "MPP-x-y-z-99-Q-M-Z-Q-1",
        "MPP",
    ];
    for code in CODES {
        match model::parse(code) {
            Ok(model) => {
                said.extend(model.notes());
                said.extend([t(model.series_name()), t(model.form.source)].map(String::from));
                said.extend(model.tokens.iter().map(Token::doc));
            }
            Err(error) => said.push(error.to_string()),
        }
        for look in model::look(code) {
            said.push(look.doc);
            said.extend(look.fault);
        }
    }
    said.extend(RULES.map(|rule| t(rule).into()));
    for form in FORMS {
        said.extend([t(form.title), t(form.source)].map(String::from));
        for part in form.parts {
            said.extend([part.place.name().into(), t(part.doc).into(), part.fits()]);
            said.extend(part.words.iter().map(|word| t(word.doc).into()));
        }
    }
    let mpp = Form::named("MPP").unwrap();
    let texts: [&str; 0] = [];
    said.extend(mpp.choices(4, &texts).iter().map(Token::doc));
}

fn tables(said: &mut Vec<String>) {
    for fact in FACTS {
        said.extend([t(fact.name), t(fact.value), t(fact.source)].map(String::from));
    }
    said.extend(Group::ALL.map(|group| group.title().into()));
    said.push(t(THICKNESS).into());
    for erratum in ERRATA {
        let texts = [erratum.place, erratum.says, erratum.right, erratum.because];
        said.extend(texts.map(|text| t(text).into()));
    }
    for row in &BATTERY {
        said.extend([row.warning.unwrap_or(""), row.error, row.remedy].map(|text| t(text).into()));
    }
    for light in Light::ALL {
        said.extend([t(light.name()), light.meaning()].map(String::from));
        for blinking in ["yes", "no", "x"] {
            let lamp = Lamp::parse(light.name(), blinking);
            match lamp.and_then(|lamp| Ok((lamp.remedy(), lamp.causes()?))) {
                Ok((remedy, causes)) => {
                    said.push(remedy.into());
                    said.extend(causes.iter().map(|cause| t(cause.text).into()));
                }
                Err(fault) => said.push(fault.message),
            }
        }
    }
    for byte in 0..=255 {
        let health = Health::of_byte(byte);
        said.extend(health.oddities().into_iter().map(String::from));
        said.extend(health.bits().into_iter().map(|bit| t(bit.text).into()));
    }
    said.extend(Health::parse("z").err().map(|fault| fault.message));
    said.extend(Series::ALL.map(|series| lamp::about(series).into()));
    for register in Register::ALL {
        said.push(t(register.access().name()).into());
        said.extend(register.entered("z").err());
        said.extend(register.entered("0x1FFFFFFFF").err());
        for value in [0, u32::MAX, 0x5349_3130] {
            said.extend(register.notes(value).into_iter().map(|note| note.text));
        }
    }
}

#[test]
fn all_that_the_reference_says_is_said_in_russian() {
    language::speak(Some(russian()));
    let mut said = Vec::new();
    calculators(&mut said);
    wirings(&mut said);
    order_codes(&mut said);
    tables(&mut said);
    language::speak(None);
    said.sort();
    said.dedup();
    if let Some(path) = std::env::var_os("SAID") {
        fs::write(path, said.join("\n")).unwrap();
    }
    let left: Vec<String> = said.iter().filter_map(|text| english(text)).collect();
    assert!(left.is_empty(), "{}", left.join("\n"));
}
