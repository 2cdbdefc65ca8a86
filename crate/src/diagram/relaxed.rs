//! Reads JSON as people write it for WaveDrom: names without quotes, single quotes, comments and
//! a comma too many are fine (the forms of JSON5 that its examples use).

use crate::{
    language::t,
    record::{Record, Value},
    say, text,
};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};
use core::{fmt, iter::Peekable, str::Chars};

/// Deepest nesting that is read.
const DEEPEST: usize = 32;

/// Why a text cannot be read, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable {
    /// Line of the text, from 1 on; 0 where the whole is meant.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => f.write_str(&self.message),
            line => say!(f, "line {}: {}", line, self.message),
        }
    }
}

impl core::error::Error for Unreadable {}

impl Unreadable {
    /// Something about the whole.
    pub(super) fn whole(message: impl Into<String>) -> Self {
        Self {
            line: 0,
            message: message.into(),
        }
    }
}

/// The value that a text writes.
pub(super) fn read(text: &str) -> Result<Value, Unreadable> {
    let mut reader = Reader {
        rest: text.chars().peekable(),
        line: 1,
    };
    let value = reader.value(0)?;
    reader.space();
    reader.accept(';');
    reader.space();
    match reader.rest.peek().copied() {
        None => Ok(value),
        Some(letter) => reader.fail(text!("{} behind the end", format_args!("{letter:?}"))),
    }
}

struct Reader<'a> {
    rest: Peekable<Chars<'a>>,
    line: usize,
}

impl Reader<'_> {
    fn fail<T>(&self, message: impl Into<String>) -> Result<T, Unreadable> {
        Err(Unreadable {
            line: self.line,
            message: message.into(),
        })
    }

    fn next(&mut self) -> Option<char> {
        let letter = self.rest.next();
        self.line += usize::from(letter == Some('\n'));
        letter
    }

    fn accept(&mut self, wanted: char) -> bool {
        let found = self.rest.peek() == Some(&wanted);
        if found {
            self.next();
        }
        found
    }

    /// Passes over spaces and comments.
    fn space(&mut self) {
        while let Some(letter) = self.rest.peek().copied() {
            match letter {
                _ if letter.is_whitespace() || letter == '\u{feff}' => {
                    self.next();
                }
                '/' => {
                    self.next();
                    let mut before = ' ';
                    let block = self.accept('*');
                    while let Some(letter) = self.next() {
                        if (block && before == '*' && letter == '/') || (!block && letter == '\n') {
                            break;
                        }
                        before = letter;
                    }
                }
                _ => break,
            }
        }
    }

    fn value(&mut self, depth: usize) -> Result<Value, Unreadable> {
        if depth > DEEPEST {
            return self.fail(text!("nested deeper than {}", DEEPEST));
        }
        self.space();
        match self.rest.peek().copied() {
            None => self.fail(t("ends where a value should be")),
            Some('{') => self.record(depth).map(Value::Record),
            Some('[') => {
                self.next();
                let mut values = Vec::new();
                while !self.closed(']')? {
                    values.push(self.value(depth + 1)?);
                    self.between(']')?;
                }
                Ok(Value::List(values))
            }
            Some(quote @ ('"' | '\'')) => self.quoted(quote).map(Value::Text),
            Some(_) => self.bare(),
        }
    }

    fn record(&mut self, depth: usize) -> Result<Record, Unreadable> {
        self.next();
        let mut record = Record::new();
        while !self.closed('}')? {
            let name = match self.rest.peek().copied() {
                Some(quote @ ('"' | '\'')) => self.quoted(quote)?,
                _ => self.word(),
            };
            self.space();
            if name.is_empty() || !self.accept(':') {
                return self.fail(t("a name and a colon should be here"));
            }
            record.0.push((name, self.value(depth + 1)?));
            self.between('}')?;
        }
        Ok(record)
    }

    /// Whether a list or record ends here.
    fn closed(&mut self, end: char) -> Result<bool, Unreadable> {
        self.space();
        match self.rest.peek() {
            None => self.fail(text!("{} is missing", format_args!("{end:?}"))),
            Some(_) => Ok(self.accept(end)),
        }
    }

    /// Passes over the comma behind a value, which the end may stand for.
    fn between(&mut self, end: char) -> Result<(), Unreadable> {
        self.space();
        match self.accept(',') || self.rest.peek() == Some(&end) {
            true => Ok(()),
            false => self.fail(text!(
                "a comma or {} should be here",
                format_args!("{end:?}")
            )),
        }
    }

    fn quoted(&mut self, quote: char) -> Result<String, Unreadable> {
        self.next();
        let mut text = String::new();
        loop {
            match self.next() {
                None => return self.fail(t("a quote is not closed")),
                Some(letter) if letter == quote => return Ok(text),
                Some('\\') => match self.next() {
                    Some('n') => text.push('\n'),
                    Some('t') => text.push('\t'),
                    Some('r') => text.push('\r'),
                    Some('u') => text.push(self.code()?),
                    Some('\n') => {}
                    Some(letter) => text.push(letter),
                    None => return self.fail(t("a quote is not closed")),
                },
                Some(letter) => text.push(letter),
            }
        }
    }

    /// The letter of four hexadecimal digits; halves of pairs are shown as unknown.
    fn code(&mut self) -> Result<char, Unreadable> {
        let mut code = 0;
        for _ in 0..4 {
            let Some(digit) = self.next().and_then(|letter| letter.to_digit(16)) else {
                return self.fail(t("four hexadecimal digits should be here"));
            };
            code = code * 16 + digit;
        }
        Ok(char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER))
    }

    fn word(&mut self) -> String {
        let mut word = String::new();
        let is_part = |letter: &char| {
            letter.is_alphanumeric() || matches!(letter, '_' | '$' | '-' | '+' | '.')
        };
        while let Some(letter) = self.rest.next_if(is_part) {
            word.push(letter);
        }
        word
    }

    fn bare(&mut self) -> Result<Value, Unreadable> {
        let word = self.word();
        Ok(match word.as_str() {
            "true" => Value::Bool(true),
            "false" => Value::Bool(false),
            "null" | "undefined" => Value::Null,
            _ => {
                let hex = word.strip_prefix("0x");
                let whole = match hex {
                    Some(digits) => i128::from_str_radix(digits, 16).ok(),
                    None => word.parse().ok(),
                };
                let number = whole.map(Value::Int);
                let number = number.or_else(|| {
                    let number = word.parse().ok().filter(|number: &f64| number.is_finite());
                    number.map(Value::from)
                });
                match number {
                    Some(number) => number,
                    None => {
                        let next = self.rest.peek().map(ToString::to_string);
                        let shown = if word.is_empty() { next } else { Some(word) };
                        return self.fail(text!(
                            "{} is no value",
                            format_args!("{:?}", shown.unwrap_or_default())
                        ));
                    }
                }
            }
        })
    }
}
