//! Value change dumps (IEEE 1364, clause 18), as sigrok, PulseView and simulators write them.
//!
//! Signals of one bit are read; wider ones, reals and strings are passed over, and so are levels
//! that are neither 0 nor 1.

use super::{Change, Clocking, Named, Unreadable, recording::MOST_SIGNALS};
use crate::{
    format::timing::{MICROSECOND, NANOSECOND, SECOND},
    language::t,
    text,
};
use alloc::{
    collections::BTreeMap,
    string::{String, ToString},
    vec::Vec,
};
use core::fmt;
use std::io::{self, BufRead, Read};
use vcd::{Command, IdCode, Parser, TimescaleUnit, Value};

/// Bytes that one command may have: a longer one is no recording of a logic analyser.
const LONGEST_COMMAND: usize = 65_536;
/// Scopes within scopes.
const DEEPEST: usize = 64;

/// Text that has come and is not yet read, of which a command may take so much.
#[derive(Debug, Default)]
struct Queue {
    text: Vec<u8>,
    at: usize,
    left: usize,
}

impl Queue {
    fn rest(&self) -> &[u8] {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn push(&mut self, text: &[u8]) {
        // What is kept moves no more often than as much has been read.
        if self.at * 2 >= self.text.len() {
            self.text.drain(..self.at);
            self.at = 0;
        }
        self.text.extend_from_slice(text);
    }

    /// Leaves out the last word, which may be cut.
    fn drop_word(&mut self) {
        let end = self.rest().iter().rposition(u8::is_ascii_whitespace);
        self.text.truncate(self.at + end.map_or(0, |end| end + 1));
    }

    fn skip(&mut self, mark: &[u8]) {
        if self.rest().starts_with(mark) {
            self.at += mark.len();
        }
    }
}

impl Read for Queue {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.left < buffer.len() {
            return Err(io::Error::other(t("a command or name without end")));
        }
        self.left -= buffer.len();
        let count = self.rest().read(buffer)?;
        self.at += count;
        Ok(count)
    }
}

impl BufRead for Queue {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        Ok(self.rest())
    }

    fn consume(&mut self, count: usize) {
        self.at = (self.at + count).min(self.text.len());
    }
}

/// Picoseconds of a tick as a fraction.
fn tick(count: u32, unit: TimescaleUnit) -> (i128, i128) {
    let count = i128::from(count);
    match unit {
        TimescaleUnit::S => (count * i128::from(SECOND), 1),
        TimescaleUnit::MS => (count * i128::from(MICROSECOND) * 1000, 1),
        TimescaleUnit::US => (count * i128::from(MICROSECOND), 1),
        TimescaleUnit::NS => (count * i128::from(NANOSECOND), 1),
        TimescaleUnit::PS => (count, 1),
        TimescaleUnit::FS => (count, 1000),
    }
}

/// Reads a value change dump as it comes, cut anywhere.
///
/// Its memory is bounded, whatever the text is: a command of more than 65 536 bytes, more than
/// 1 024 signals and more than 64 scopes within scopes are refused. A command is read when what
/// has come holds the longest one, so that the last 65 536 bytes wait for the end.
///
/// ```
/// use encoderscope::capture::vcd::Vcd;
/// let mut changes = Vec::new();
/// let mut vcd = Vcd::new();
/// for cut in ["$timescale 1 us $end $var wire 1 ! c", "lk $end\n#0 1", "!\n#7 0!"] {
///     vcd.push(cut.as_bytes(), &mut |change| changes.push(change)).unwrap();
/// }
/// let named = vcd.finish(&mut |change| changes.push(change)).unwrap();
/// assert_eq!((named.names, named.end), (vec!["clk".to_string()], 7_000_000));
/// assert_eq!((changes.len(), changes[1].time, changes[1].level), (2, 7_000_000, false));
/// ```
pub struct Vcd {
    parser: Parser<Queue>,
    /// Whether anything has been read.
    opened: bool,
    /// Whether the text may end within a command.
    cut: bool,
    names: Vec<String>,
    signals: BTreeMap<IdCode, usize>,
    scopes: Vec<String>,
    /// Without it the times count something unknown.
    scale: Option<(i128, i128)>,
    time: Option<i64>,
}

impl fmt::Debug for Vcd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Vcd")
            .field("names", &self.names)
            .field("time", &self.time)
            .finish_non_exhaustive()
    }
}

impl Default for Vcd {
    fn default() -> Self {
        Self::new()
    }
}

impl Vcd {
    /// A reader.
    #[must_use]
    pub fn new() -> Self {
        Self {
            parser: Parser::new(Queue::default()),
            opened: false,
            cut: false,
            names: Vec::new(),
            signals: BTreeMap::new(),
            scopes: Vec::new(),
            scale: None,
            time: None,
        }
    }

    /// Takes the next piece of text; `sink` gets every change that is read, in order.
    ///
    /// # Errors
    ///
    /// The text is no value change dump, its time runs backwards or out of bounds, or it has no
    /// end of signals, scopes or names; says where. Nothing more can be read then.
    pub fn push(&mut self, text: &[u8], sink: &mut dyn FnMut(Change)) -> Result<(), Unreadable> {
        self.parser.reader().push(text);
        self.run(LONGEST_COMMAND, sink)
    }

    /// Reads what is left; says what the signals are called.
    ///
    /// # Errors
    ///
    /// As those of [`Vcd::push`], or the text ends within a command.
    pub fn finish(mut self, sink: &mut dyn FnMut(Change)) -> Result<Named, Unreadable> {
        // The last command may lack its line break.
        self.parser.reader().push(b"\n");
        self.run(0, sink)?;
        Ok(Named {
            names: self.names,
            others: Vec::new(),
            clocking: match self.scale {
                Some(_) => Clocking::Timed(0),
                None => Clocking::Counted,
            },
            end: self.time.unwrap_or(0),
        })
    }

    /// As [`Vcd::finish`] where more text would come: a command that is not whole is left out.
    ///
    /// # Errors
    ///
    /// As those of [`Vcd::push`].
    pub fn cut(mut self, sink: &mut dyn FnMut(Change)) -> Result<Named, Unreadable> {
        self.cut = true;
        self.parser.reader().drop_word();
        self.finish(sink)
    }

    /// Reads commands while at least so many bytes wait, so that none meets the end of what has
    /// come.
    fn run(&mut self, least: usize, sink: &mut dyn FnMut(Change)) -> Result<(), Unreadable> {
        while self.parser.reader().rest().len() >= least {
            if !core::mem::replace(&mut self.opened, true) {
                self.parser.reader().skip(b"\xef\xbb\xbf");
            }
            self.parser.reader().left = LONGEST_COMMAND;
            let Some(command) = self.parser.next() else {
                break;
            };
            match command {
                Ok(command) => self.command(command, sink)?,
                Err(end) if self.cut && end.kind() == io::ErrorKind::UnexpectedEof => break,
                Err(error) => return Err(self.refused(&error)),
            }
        }
        Ok(())
    }

    fn refused(&self, error: &io::Error) -> Unreadable {
        let placed = error
            .get_ref()
            .and_then(|inner| inner.downcast_ref::<vcd::ParseError>())
            .is_some();
        // Where the text ends there is no line.
        let ends = error.kind() == io::ErrorKind::UnexpectedEof;
        Unreadable::Vcd(match placed || ends {
            true => error.to_string(),
            false => text!("{} at line {}", error, self.parser.line()),
        })
    }

    fn command(
        &mut self,
        command: Command,
        sink: &mut dyn FnMut(Change),
    ) -> Result<(), Unreadable> {
        let line = self.parser.line();
        let time = self.time.unwrap_or(0);
        let mut change = |id: IdCode, value: Value| {
            let level = match value {
                Value::V0 => false,
                Value::V1 => true,
                Value::X | Value::Z => return,
            };
            if let Some(signal) = self.signals.get(&id) {
                sink(Change {
                    time,
                    signal: *signal,
                    level,
                });
            }
        };
        match command {
            Command::ChangeScalar(id, value) => change(id, value),
            Command::ChangeVector(id, values) => {
                if let (1, Some(value)) = (values.len(), values.get(0)) {
                    change(id, value);
                }
            }
            Command::Timestamp(ticks) => {
                let (above, below) = self.scale.unwrap_or((1, 1));
                let picos = i128::from(ticks)
                    .checked_mul(above)
                    .and_then(|picos| i64::try_from(picos / below).ok());
                let now = picos.ok_or(Unreadable::Time(line))?;
                if self.time.is_some_and(|time| now < time) {
                    return Err(Unreadable::Backwards(line));
                }
                self.time = Some(now);
            }
            Command::Timescale(0, _) => return Err(Unreadable::Time(line)),
            Command::Timescale(count, unit) => self.scale = Some(tick(count, unit)),
            Command::ScopeDef(_, name) => {
                if self.scopes.len() == DEEPEST {
                    return Err(Unreadable::Deep(line));
                }
                self.scopes.push(name);
            }
            Command::Upscope => {
                self.scopes.pop();
            }
            Command::VarDef(_, 1, id, name, index) => {
                if self.names.len() == MOST_SIGNALS {
                    return Err(Unreadable::TooManySignals);
                }
                let names = &mut self.names;
                self.signals.entry(id).or_insert_with(|| {
                    let name = match index {
                        Some(index) => name + &index.to_string(),
                        None => name,
                    };
                    let known = names.contains(&name);
                    names.push(match self.scopes.last() {
                        Some(scope) if known => alloc::format!("{scope}.{name}"),
                        _ => name,
                    });
                    names.len() - 1
                });
            }
            _ => {}
        }
        Ok(())
    }
}
