//! What kind of writing a text is, decided over its head.

use super::{
    clean::Clean,
    line::{Front, declaration, without_comments},
    offsets::Offsets,
    prose,
    reader::{bare, is_number},
    stamp,
    table::{Annotation, Table},
    token::{Token, tokens_of},
    writing::{Digits, Form, Quotes, Times, Writing},
};
use crate::format::Medium;
use alloc::{
    string::{String, ToString},
    vec::Vec,
};

/// Decides on the writing of the text that begins with `head`.
pub(super) fn survey(medium: Medium, head: &str) -> Writing {
    let mut writing = Writing::default();
    writing.printable = is_printable(head);
    let lines = clean(head, writing.printable);
    writing.quotes = quotes(&lines);
    let lines: Vec<&str> = lines
        .iter()
        .map(|line| {
            line.get(Front::read(line, &writing).quote.end..)
                .unwrap_or_default()
        })
        .filter(|line| !line.trim().is_empty())
        .collect();
    // What is quoted is taken off already.
    let mut inner = Writing {
        quotes: Quotes::None,
        ..writing.clone()
    };
    if let Some(table) = table(&lines) {
        writing.form = Form::Table(table);
        return writing;
    }
    let annotations = lines
        .iter()
        .filter(|line| Annotation::read(line).is_some())
        .count();
    if annotations * 5 > lines.len() * 3 {
        writing.form = Form::Annotations;
        return writing;
    }
    if let Some(offsets) = Offsets::of(&lines) {
        writing.form = Form::Offsets(offsets);
        writing.unit = Some(2);
        return writing;
    }
    inner.times = times(&lines);
    inner.source = is_source(&lines);
    let fronts: Vec<Front> = lines.iter().map(|line| Front::read(line, &inner)).collect();
    inner.directed = fronts.iter().any(|front| front.sign.is_some());
    let bodies = bodies(&lines, &fronts, inner.source);
    inner.settle(medium, &bodies);
    Writing {
        quotes: writing.quotes,
        ..inner
    }
}

fn clean(head: &str, printable: bool) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = Clean::default();
    for raw in head.split(['\n', '\r']) {
        let soft = printable && raw.ends_with('=');
        let raw = if soft { &raw[..raw.len() - 1] } else { raw };
        line.add(raw.as_bytes(), 0, printable);
        if !soft {
            lines.push(line.text.clone());
            line.clear();
        }
    }
    lines.push(line.text);
    lines
}

/// Whether mail programs have folded the text (RFC 2045, section 6.7).
fn is_printable(head: &str) -> bool {
    let lines = || head.lines().map(str::trim_end);
    let soft = lines().filter(|line| line.len() > 1 && line.ends_with('=') && line.contains(' '));
    let spaces = lines().any(|line| line.ends_with("=20"));
    let codes = ["=3D", "=C2=A0", "=E2=80"]
        .iter()
        .any(|code| head.contains(code));
    let long = lines().any(|line| line.len() >= 70 && line.ends_with('='));
    spaces || codes || long || soft.count() > 1
}

/// How lines are quoted. Where others begin with `<`, one more `>` marks a direction.
fn quotes(lines: &[String]) -> Quotes {
    let level = |line: &str| {
        line.chars()
            .filter(|mark| *mark != ' ')
            .take_while(|mark| *mark == '>')
            .count()
    };
    let behind = |line: &str| line.trim_start_matches([' ', '>']).to_string();
    let lines = || {
        lines
            .iter()
            .map(|line| line.trim())
            .filter(|line| !line.is_empty())
    };
    let answers =
        lines().filter(|line| behind(line).starts_with('<') && !behind(line).contains('>'));
    let bars = lines().filter(|line| line.starts_with("| ")).count();
    let count = lines().count();
    if bars > 1 && bars == count {
        return Quotes::Any;
    }
    if let Some(levels) = answers.map(level).min() {
        return if levels > 0 {
            Quotes::Levels(levels)
        } else {
            Quotes::None
        };
    }
    let quoted = || lines().filter(|line| line.starts_with('>') && !line.starts_with("->"));
    let all = quoted().count();
    let prosy = quoted().any(|line| prose::is_prose(&behind(line), Some(2)));
    // A mark in front of every line says nothing about its direction.
    let every = lines()
        .filter(|line| !prose::is_prose(&behind(line), Some(2)))
        .all(|line| line.starts_with('>'));
    if all > 0 && (prosy || every) {
        Quotes::Any
    } else {
        Quotes::None
    }
}

fn table(lines: &[&str]) -> Option<Table> {
    let head = lines
        .iter()
        .take(20)
        .position(|line| Table::headed_by(line).is_some())?;
    let mut table = Table::headed_by(lines.get(head)?)?;
    let rows = || lines.iter().skip(head + 1).copied();
    table.settle(rows());
    let good = rows()
        .filter(|line| table.row(line).is_some_and(|row| !row.other))
        .count();
    (good > 0 && good * 2 >= rows().count()).then_some(table)
}

/// Which times are no data.
fn times(lines: &[&str]) -> Times {
    let strong = lines.iter().any(|line| {
        let after_sign =
            super::direction::read(line.trim_start().as_bytes()).map_or(0, |sign| sign.end);
        let line = line.trim_start().get(after_sign..).unwrap_or_default();
        stamp::read(line.as_bytes()).is_some_and(|stamp| stamp.strong)
    });
    let stamps: Vec<_> = lines
        .iter()
        .filter_map(|line| {
            let line = line.trim_start();
            let stamp = stamp::read(line.as_bytes())?;
            Some((stamp.seconds, line.get(stamp.end..)?))
        })
        .filter(|(_, rest)| tokens_of(rest).next().is_some())
        .collect();
    let rising = stamps.windows(2).all(|pair| pair[0].0 <= pair[1].0);
    let apart = !stamps.is_empty() && stamps.iter().all(|(_, rest)| !rest.contains(':'));
    let many = stamps.len() * 5 >= lines.len() * 3 && (stamps.len() > 1 || apart);
    match strong {
        _ if many && rising => Times::Any,
        true => Times::Strong,
        false => Times::None,
    }
}

/// Whether the text is in a programming language.
fn is_source(lines: &[&str]) -> bool {
    let braces =
        lines.iter().any(|line| line.contains('{')) && lines.iter().any(|line| line.contains('}'));
    let list = |line: &&str| {
        let rest = line.rfind('[').map(|open| &line[open..]);
        rest.is_some_and(|rest| rest.contains(',') || line.contains('='))
    };
    let literal = ["b'", "b\"", "= \"", "=\""];
    braces
        || lines
            .iter()
            .any(|line| list(line) && stamp::read(line.trim_start().as_bytes()).is_none())
        || lines
            .iter()
            .any(|line| literal.iter().any(|mark| line.contains(mark)))
}

/// What of the lines may be data.
fn bodies(lines: &[&str], fronts: &[Front], source: bool) -> Vec<String> {
    let mut inside = false;
    let mut bodies = Vec::new();
    for (line, front) in lines.iter().zip(fronts) {
        let text = without_comments(line, &mut inside)
            .map_or_else(|| (*line).to_string(), |(text, _)| text);
        let mut body = text.get(front.body..).unwrap_or_default();
        if let Some(end) = declaration(body) {
            body = body.get(end..).unwrap_or_default();
        } else if let Some(end) = prose::label(body, None) {
            body = body.get(end..).unwrap_or_default();
        } else if !source && prose::is_prose(body, None) {
            continue;
        }
        if !body.trim().is_empty() {
            bodies.push(body.to_string());
        }
    }
    bodies
}

impl Writing {
    fn settle(&mut self, medium: Medium, bodies: &[String]) {
        let all: Vec<Token<'_>> = bodies
            .iter()
            .flat_map(|body| tokens_of(body))
            .filter(|token| {
                !self.source || token.hexadecimal().is_some() || token.decimal().is_some()
            })
            .collect();
        let feeds = |token: &Token<'_>| {
            let token = token.text.to_ascii_lowercase();
            token.trim_start_matches("0x") == "0a" || token.ends_with("0d0a")
        };
        let numbers = bodies.iter().any(|body| is_number(bare(body)));
        if medium == Medium::Text && numbers && !all.iter().any(feeds) {
            self.digits = Digits::Numbers;
            return;
        }
        self.unit = unit(&all);
        let lines: Vec<Vec<Token<'_>>> = bodies
            .iter()
            .map(|body| tokens_of(body).collect())
            .collect();
        let binary = match medium {
            Medium::Bits => is_binary(&lines),
            Medium::Bytes | Medium::Text => is_octets(&lines),
        };
        if binary {
            self.digits = Digits::Binary;
            return;
        }
        self.choose_base(&all);
    }

    fn choose_base(&mut self, all: &[Token<'_>]) {
        let plain: Vec<&str> = all
            .iter()
            .filter(|token| token.hexadecimal().is_none_or(|(_, marked)| !marked))
            .map(|token| token.text)
            .collect();
        let marked = all.len() > plain.len();
        let decimal = |text: &&&str| text.bytes().all(|digit| digit.is_ascii_digit());
        let bytes = plain
            .iter()
            .filter(|text| text.len() < 4 && text.parse::<u8>().is_ok())
            .count();
        if plain.is_empty()
            || !plain.iter().all(|text| decimal(&text))
            || bytes * 10 < plain.len() * 9
        {
            return;
        }
        let three = plain.iter().any(|text| text.len() == 3);
        let led = plain
            .iter()
            .any(|text| text.len() == 2 && text.starts_with('0'));
        let single = plain.iter().any(|text| text.len() == 1) && plain.len() >= 8;
        let uneven = single && plain.iter().any(|text| text.len() == 2);
        let likely = !led && (three || uneven || self.source);
        if likely && (!marked || self.source) {
            self.digits = Digits::Decimal;
            self.unit = Some(3);
        } else {
            self.undecided = !led && !marked && bytes == plain.len();
        }
    }
}

/// How many digits most tokens have.
fn unit(all: &[Token<'_>]) -> Option<usize> {
    let mut widths: Vec<usize> = all
        .iter()
        .filter_map(|token| token.hexadecimal())
        .map(|(digits, _)| digits)
        .collect();
    widths.sort_unstable();
    let most = widths
        .chunk_by(|one, other| one == other)
        .max_by_key(|group| group.len())?;
    (most.len() * 5 >= widths.len() * 3).then_some(most[0])
}

/// Digits of all tokens of lines that hold nothing but 0 and 1, and how many are 1.
fn zeros_and_ones(lines: &[Vec<Token<'_>>]) -> Option<(usize, usize)> {
    let mut count = (0, 0);
    for token in lines.iter().flatten() {
        let (digits, _) = token.binary()?;
        count.0 += digits.len();
        count.1 += digits.bytes().filter(|digit| *digit == b'1').count();
    }
    (count.0 > 0).then_some(count)
}

fn digits_of(line: &[Token<'_>]) -> usize {
    let digits = line.iter().filter_map(|token| token.binary());
    digits.map(|(digits, _)| digits.len()).sum()
}

/// Whether bit strings are meant: of bytes with only the digits 0 and 1 the pairs, and words of
/// even length that are almost empty, are rather hexadecimal.
fn is_binary(lines: &[Vec<Token<'_>>]) -> bool {
    let Some((digits, ones)) = zeros_and_ones(lines) else {
        return false;
    };
    let tokens = || lines.iter().flatten();
    if tokens().any(|token| token.binary().is_some_and(|(_, marked)| marked)) {
        return true;
    }
    let pairs = tokens().all(|token| token.text.len() == 2);
    let first = lines.first().map_or(0, |line| digits_of(line));
    let even = lines.iter().all(|line| digits_of(line) == first) && first.is_multiple_of(2);
    let empty = even && lines.len() > 1 && ones * 8 < digits && ones > 0 && first <= 20;
    digits >= 8 && !pairs && !empty
}

/// Whether bytes are meant that are written in eight digits of 0 and 1 each.
fn is_octets(lines: &[Vec<Token<'_>>]) -> bool {
    let Some((digits, ones)) = zeros_and_ones(lines) else {
        return false;
    };
    let tokens = || lines.iter().flatten();
    let marked = |token: &Token<'_>| {
        token
            .binary()
            .is_some_and(|(digits, marked)| marked && digits.len() <= 8)
    };
    if tokens().all(|token| marked(token)) || tokens().all(|token| token.text.len() == 8) {
        return true;
    }
    let whole = lines.iter().all(|line| digits_of(line).is_multiple_of(8));
    let pairs = tokens().all(|token| token.text.len() == 2);
    whole && !pairs && digits >= 16 && ones * 5 > digits
}
