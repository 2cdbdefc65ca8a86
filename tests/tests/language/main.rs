//! Another language than English.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    language::{self, Catalogue, number, t},
    text,
};

/// One test, for the language is that of the whole program.
#[test]
fn a_catalogue_translates_texts_numbers_and_forms() {
    let degrees = || {
        text!(
            "{}° of {}",
            number(format_args!("{:.2}", 12.5)),
            "an encoder"
        )
    };
    let bytes = |count: i64| text!("{} {0|byte|bytes}", count);
    assert_eq!(degrees(), "12.50° of an encoder");
    assert_eq!(
        [0, 1, 2, 21].map(bytes),
        ["0 bytes", "1 byte", "2 bytes", "21 bytes"]
    );
    assert_eq!(text!("{1} before {0}, {}", 1, 2), "2 before 1, 1");
    assert_eq!(text!("open { and {9} and {"), "open  and ");

    language::speak(Some(Catalogue::new([
        (".", ","),
        ("{}° of {}", "{1}: {0}°"),
        ("{} {0|byte|bytes}", "{} {0|байт|байта|байтов}"),
        ("Angle within one turn.", "Угол."),
    ])));
    let field = language::meaning("Angle within one turn.".into());
    let other = language::in_english(|| language::meaning("Angle within one turn.".into()));
    let said = (t("not in it"), degrees(), field, other);
    let forms = [0, 1, -1, 3, 5, 11, 12, 14, 21, 22, 25, 101, 111, 1_002].map(bytes);
    let broken = text!("{} {0|byte|bytes}", number(1.5));
    language::speak(None);

    assert_eq!(said.0, "not in it");
    assert_eq!(said.1, "an encoder: 12,50°");
    assert_eq!(
        (said.2, said.3),
        ("Угол.".into(), "Angle within one turn.".into())
    );
    let ends: Vec<_> = forms
        .iter()
        .map(|form| form.trim_start_matches(['-', '0', '1', '2', '3', '4', '5', ' ']))
        .collect();
    assert_eq!(
        ends,
        [
            "байтов",
            "байт",
            "байт",
            "байта",
            "байтов",
            "байтов",
            "байтов",
            "байтов",
            "байт",
            "байта",
            "байтов",
            "байт",
            "байтов",
            "байта"
        ]
    );
    assert_eq!(broken, "1,5 байта");
    assert_eq!(t("."), ".");
}
