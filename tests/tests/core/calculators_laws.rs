//! What must hold of all calculators.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::calculator::{CALCULATORS, Input, Kind};

/// What each input can be beside its default.
fn others(input: &Input) -> Vec<String> {
    match input.kind {
        Kind::Word(words) => words
            .iter()
            .filter(|word| word.name != input.default)
            .map(|word| word.name.to_owned())
            .collect(),
        Kind::Number { least, most, .. } => {
            let near = |share: f64| (least + (most - least) * share).round();
            [0.01, 0.1, 0.25, 0.5, 0.75, 0.9]
                .map(near)
                .into_iter()
                .filter(|value| (least..=most).contains(value))
                .map(|value| value.to_string())
                .chain([least.to_string(), most.to_string()])
                .chain(["4", "12", "90"].map(String::from))
                .collect()
        }
    }
}

#[test]
fn what_is_impossible_names_its_input_and_gives_no_number() {
    for calculator in CALCULATORS {
        for input in calculator.inputs {
            let texts = [
                "",
                " ",
                "apples",
                "-1",
                "−5",
                "1e30",
                "99999999999999999999999",
                "0x",
                "1.2.3",
                "NaN",
                "inf",
                "1 000 furlongs",
                "\u{0}",
                "٣",
                "--1",
                ",",
            ];
            for text in texts {
                let outcome = calculator.work(|name| (name == input.name).then_some(text));
                let fault =
                    outcome.expect_err(&format!("{} {} {text:?}", calculator.name, input.name));
                assert_eq!(fault.input, input.name, "{text:?}");
                assert!(fault.message.len() > 10, "{text:?}: {}", fault.message);
                assert!(!fault.message.ends_with('.'), "{}", fault.message);
            }
        }
    }
}

#[test]
fn every_input_matters() {
    for calculator in CALCULATORS {
        let plain = calculator.work(|_| None).expect("the defaults work");
        assert!(!plain.answers.is_empty());
        for input in calculator.inputs {
            let changes = others(input).iter().any(|text| {
                let outcome = calculator.work(|name| (name == input.name).then_some(text));
                outcome.is_ok_and(|outcome| outcome != plain)
            });
            assert!(changes, "{} {}", calculator.name, input.name);
        }
    }
}

#[test]
fn every_answer_is_finite_and_says_what_it_is() {
    for calculator in CALCULATORS {
        for (name, text) in calculator
            .inputs
            .iter()
            .flat_map(|input| others(input).into_iter().map(|text| (input.name, text)))
        {
            let entered = |known: &str| (known == name).then_some(text.as_str());
            let Ok(outcome) = calculator.work(entered) else {
                continue;
            };
            let mut names = Vec::new();
            for answer in &outcome.answers {
                assert!(!answer.title.is_empty() && !answer.text.is_empty());
                assert!(
                    answer.number.is_none_or(f64::is_finite),
                    "{name}={text} {}",
                    answer.name
                );
                assert!(!names.contains(&answer.name), "{} twice", answer.name);
                names.push(answer.name);
            }
        }
    }
}
