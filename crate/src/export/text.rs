//! Lines of source.

use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// The longest line of a comment.
const WIDTH: usize = 88;

/// Lines as one text.
pub(super) fn joined(lines: &[String]) -> String {
    let mut out = String::new();
    for line in lines {
        out.push_str(line.trim_end());
        out.push('\n');
    }
    out
}

/// The words of a text in lines, each behind `lead`.
pub(super) fn wrapped(lead: &str, text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        let len = lead.chars().count() + line.chars().count() + word.chars().count();
        if !line.is_empty() && len >= WIDTH {
            lines.push(format!("{lead}{line}"));
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    lines.push(format!("{lead}{line}"));
    lines
}

/// Lines moved in by `by` spaces.
pub(super) fn indented(by: usize, lines: impl IntoIterator<Item = String>) -> Vec<String> {
    let moved = |line: String| match line.is_empty() {
        true => line,
        false => format!("{:by$}{line}", ""),
    };
    lines.into_iter().map(moved).collect()
}

/// Lines of a template; an empty one at the end where it ends with a line break.
pub(super) fn lines(template: &str) -> Vec<String> {
    template.split('\n').map(ToString::to_string).collect()
}

/// A name in snake case: letters and digits, with one underscore for anything between.
pub(super) fn snake(name: &str) -> String {
    let mut out = String::new();
    for letter in name.chars() {
        match letter.is_ascii_alphanumeric() {
            true => out.push(letter.to_ascii_lowercase()),
            false if out.ends_with('_') || out.is_empty() => {}
            false => out.push('_'),
        }
    }
    out.trim_end_matches('_').to_string()
}

/// A text as a sentence.
pub(super) fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_ascii_uppercase());
    let stop = (!text.ends_with('.')).then_some('.');
    first.into_iter().chain(letters).chain(stop).collect()
}

/// A sum of bits on lines of its own where one of `room` letters is too short for it.
pub(super) fn folded(room: usize, line: String) -> Vec<String> {
    if line.len() <= room || !line.contains(" | ") {
        return Vec::from([line]);
    }
    let mut parts = line.split(" | ");
    let first = parts.next().map(ToString::to_string);
    let more = parts.map(|part| format!("    | {part}"));
    first.into_iter().chain(more).collect()
}

/// A name in upper case.
pub(super) fn upper(name: &str) -> String {
    snake(name).to_ascii_uppercase()
}

/// A name in Pascal case.
pub(super) fn pascal(name: &str) -> String {
    let mut out = String::new();
    for word in snake(name).split('_') {
        let mut letters = word.chars();
        out.extend(letters.next().map(|first| first.to_ascii_uppercase()));
        out.extend(letters);
    }
    out
}

/// Whether the first parenthesis is closed by the last character.
pub(super) fn closes_last(text: &str) -> bool {
    let mut open = 0i32;
    for (at, letter) in text.char_indices() {
        open += match letter {
            '(' => 1,
            ')' => -1,
            _ => 0,
        };
        if open == 0 && letter == ')' {
            return at + 1 == text.len();
        }
    }
    false
}

/// A text without the parentheses around it.
pub(super) fn bare(text: &str) -> &str {
    let inner = text
        .strip_prefix('(')
        .and_then(|rest| rest.strip_suffix(')'));
    match inner {
        Some(inner) if closes_last(text) => inner,
        _ => text,
    }
}
