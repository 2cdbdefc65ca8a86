//! Value change dumps (IEEE 1364, clause 18), as sigrok, PulseView and simulators write them.
//!
//! Signals of one bit are read; wider ones, reals and strings are passed over, and so are levels
//! that are neither 0 nor 1.

use super::{Change, Clocking, Named, Unreadable, recording::MOST_SIGNALS};
use crate::format::timing::{MICROSECOND, NANOSECOND, SECOND};
use alloc::{
    collections::BTreeMap,
    string::{String, ToString},
    vec::Vec,
};
use std::io::{self, BufRead, Read};
use vcd::{Command, IdCode, Parser, TimescaleUnit, Value};

/// Bytes that one command may have: a longer one is no recording of a logic analyser.
const LONGEST_COMMAND: usize = 65_536;
/// Scopes within scopes.
const DEEPEST: usize = 64;

/// The text, of which a command may take so much; a line break follows its end, where the last
/// command may lack one.
struct Guard<'a> {
    text: &'a [u8],
    end: &'a [u8],
    left: usize,
}

impl Read for Guard<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.left < buffer.len() {
            return Err(io::Error::other("a command or name without end"));
        }
        self.left -= buffer.len();
        match self.text {
            [] => self.end.read(buffer),
            _ => self.text.read(buffer),
        }
    }
}

impl BufRead for Guard<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        Ok(if self.text.is_empty() {
            self.end
        } else {
            self.text
        })
    }

    fn consume(&mut self, count: usize) {
        match self.text {
            [] => self.end.consume(count),
            _ => self.text.consume(count),
        }
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

/// Reads a whole value change dump; `sink` gets every change in order.
///
/// # Errors
///
/// The text is no value change dump, its time runs backwards or out of bounds, or it has no end
/// of signals, scopes or names; says where.
pub fn read(text: &[u8], sink: &mut dyn FnMut(Change)) -> Result<Named, Unreadable> {
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let guard = Guard {
        text,
        end: b"\n",
        left: LONGEST_COMMAND,
    };
    let mut parser = Parser::new(guard);
    let mut names: Vec<String> = Vec::new();
    let mut signals: BTreeMap<IdCode, usize> = BTreeMap::new();
    let mut scopes: Vec<String> = Vec::new();
    // Without a time scale the times count something unknown.
    let mut scale = None;
    let mut time = 0;
    let mut begun = false;
    loop {
        parser.reader().left = LONGEST_COMMAND;
        let Some(command) = parser.next() else { break };
        let line = parser.line();
        let command = command.map_err(|error| {
            let placed = error
                .get_ref()
                .and_then(|inner| inner.downcast_ref::<vcd::ParseError>())
                .is_some();
            Unreadable::Vcd(match placed {
                true => error.to_string(),
                false => alloc::format!("{error} at line {line}"),
            })
        })?;
        let mut change = |id: IdCode, value: Value| {
            let level = match value {
                Value::V0 => false,
                Value::V1 => true,
                Value::X | Value::Z => return,
            };
            if let Some(signal) = signals.get(&id) {
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
                let (above, below) = scale.unwrap_or((1, 1));
                let picos = i128::from(ticks)
                    .checked_mul(above)
                    .and_then(|picos| i64::try_from(picos / below).ok());
                let now = picos.ok_or(Unreadable::Time(line))?;
                if begun && now < time {
                    return Err(Unreadable::Backwards(line));
                }
                begun = true;
                time = now;
            }
            Command::Timescale(0, _) => return Err(Unreadable::Time(line)),
            Command::Timescale(count, unit) => scale = Some(tick(count, unit)),
            Command::ScopeDef(_, name) => {
                if scopes.len() == DEEPEST {
                    return Err(Unreadable::Deep(line));
                }
                scopes.push(name);
            }
            Command::Upscope => {
                scopes.pop();
            }
            Command::VarDef(_, 1, id, name, index) => {
                if names.len() == MOST_SIGNALS {
                    return Err(Unreadable::TooManySignals);
                }
                signals.entry(id).or_insert_with(|| {
                    let name = match index {
                        Some(index) => name + &index.to_string(),
                        None => name,
                    };
                    let known = names.contains(&name);
                    names.push(match scopes.last() {
                        Some(scope) if known => alloc::format!("{scope}.{name}"),
                        _ => name,
                    });
                    names.len() - 1
                });
            }
            _ => {}
        }
    }
    Ok(Named {
        names,
        others: Vec::new(),
        clocking: match scale {
            Some(_) => Clocking::Timed(0),
            None => Clocking::Counted,
        },
        end: time,
    })
}
