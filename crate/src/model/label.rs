//! What stands on a label, as it is typed: any case, any dash, spaces, Cyrillic letters.

use alloc::{string::String, vec::Vec};

/// Cyrillic letters, small and capital, and the Latin one that each is taken for: those that look
/// alike, and И and П of ИП-75.
const CYRILLIC: &[(char, char, char)] = &[
    ('а', 'А', 'A'),
    ('в', 'В', 'B'),
    ('е', 'Е', 'E'),
    ('и', 'И', 'I'),
    ('к', 'К', 'K'),
    ('м', 'М', 'M'),
    ('н', 'Н', 'H'),
    ('о', 'О', 'O'),
    ('п', 'П', 'P'),
    ('р', 'Р', 'P'),
    ('с', 'С', 'C'),
    ('т', 'Т', 'T'),
    ('у', 'У', 'Y'),
    ('х', 'Х', 'X'),
];

const fn is_dash(letter: char) -> bool {
    matches!(
        letter,
        '-' | '\u{ad}' | '\u{2010}'
            ..='\u{2015}' | '\u{2043}' | '\u{2212}' | '\u{fe63}' | '\u{ff0d}'
    )
}

/// What has no width and comes along when text is copied.
const fn is_nothing(letter: char) -> bool {
    matches!(letter, '\u{200b}'..='\u{200d}' | '\u{2060}' | '\u{feff}')
}

fn latin(letter: char) -> char {
    let alike = CYRILLIC
        .iter()
        .find(|(small, capital, _)| letter == *small || letter == *capital);
    alike.map_or(letter.to_ascii_uppercase(), |(_, _, latin)| *latin)
}

/// The parts of a code in capital Latin letters. The series of IP-75 is one part.
pub(super) fn parts(code: &str) -> Vec<String> {
    let mut parts: Vec<String> = Vec::new();
    let mut is_new = true;
    for letter in code.chars() {
        if is_dash(letter) || letter.is_whitespace() {
            is_new = true;
        } else if !is_nothing(letter) {
            match parts.as_mut_slice() {
                [only] if only == "IP" => only.push('-'),
                [.., _] if !is_new => {}
                _ => parts.push(String::new()),
            }
            is_new = false;
            if let Some(part) = parts.last_mut() {
                part.push(latin(letter));
            }
        }
    }
    parts
}
