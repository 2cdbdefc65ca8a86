//! Frames as rows of comma-separated values (RFC 4180).
//!
//! The columns are the names of [`Frame::record`], so that they agree with the JSON lines; those
//! of records inside it have a point between.

use crate::{
    bits::Bits,
    decode::{Decoder, Frame},
    framing::Why,
    language::in_english,
    layout::Resolved,
    reading::Values,
    record::{FAULTS, HEX, Record, START, Value, hex},
};
use alloc::{
    borrow::Cow,
    format,
    string::{String, ToString},
    vec::Vec,
};

/// Column with the time of a frame.
const TIME: &str = "time";

/// The columns of the frames of one profile.
///
/// ```
/// use encoderscope::{decode::Decoder, export::table::Table, profile::Profile};
/// let decoder = Decoder::new(Profile::parse([("format", "asi4")])?)?;
/// let table = Table::new(&decoder);
/// let frame = decoder.frame(b"8192\r\n").unwrap();
/// assert!(table.header().starts_with("start,time,ok,turns,angle,degrees,"));
/// assert!(table.frame(&frame, Some(2.5)).starts_with("0,2.500000,true,,8192,180,"));
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Table {
    columns: Vec<String>,
}

impl Table {
    /// The columns that the frames of a decoder can have.
    #[must_use]
    pub fn new(decoder: &Decoder) -> Self {
        let mut columns: Vec<String> = Vec::new();
        for (_, layout) in decoder.replies() {
            for (name, _) in cells(&example(layout)) {
                if !columns.contains(&name) {
                    columns.push(name);
                }
            }
        }
        let all = columns.clone();
        let parted = |name: &str| {
            let mut inner = all.iter().filter_map(|other| other.strip_prefix(name));
            inner.any(|rest| rest.starts_with('.'))
        };
        columns.retain(|name| !parted(name) && !LAST.contains(&name.as_str()));
        columns.extend(LAST.map(ToString::to_string));
        columns.insert(columns.len().min(1), TIME.into());
        Self { columns }
    }

    /// The names of the columns.
    #[must_use]
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The first line, with its line end.
    #[must_use]
    pub fn header(&self) -> String {
        line(self.columns.iter().map(String::as_str))
    }

    /// The line of a frame that came at `time` seconds, with its line end.
    #[must_use]
    pub fn frame(&self, frame: &Frame<'_>, time: Option<f64>) -> String {
        self.row(&frame.record(), time)
    }

    /// The line of input that belongs to no frame; the faults say why.
    #[must_use]
    pub fn skip(&self, start: u64, bits: Bits<'_>, why: Why, time: Option<f64>) -> String {
        let record = Record::new()
            .with(START, start)
            .with(FAULTS, in_english(|| why.to_string()))
            .with(HEX, hex(bits.bytes()));
        self.row(&record, time)
    }

    fn row(&self, record: &Record, time: Option<f64>) -> String {
        let mut cells = cells(record);
        if let Some(time) = time {
            cells.push((TIME.into(), format!("{time:.6}")));
        }
        let cell = |column: &String| {
            let found = cells.iter().find(|(name, _)| name == column);
            found.map_or("", |(_, text)| text.as_str())
        };
        line(self.columns.iter().map(cell))
    }
}

/// The columns that stand last: they are the widest.
const LAST: [&str; 2] = [FAULTS, HEX];

/// The record of a frame that a layout describes.
fn example(layout: &Resolved) -> Record {
    let bits = layout.encode(&Values::default());
    let frame = Frame {
        start: 0,
        layout: Cow::Borrowed(layout),
        bits: bits.as_bits(),
        sure: true,
        request: None,
    };
    frame.record()
}

/// The values of a record; those of a record inside it have its name and a point in front.
fn cells(record: &Record) -> Vec<(String, String)> {
    let mut out = Vec::new();
    for (name, value) in &record.0 {
        match value {
            Value::Record(inner) => {
                let inner = cells(inner).into_iter();
                out.extend(inner.map(|(own, text)| (format!("{name}.{own}"), text)));
            }
            Value::List(values) => {
                let texts: Vec<String> = values.iter().map(Value::plain).collect();
                out.push((name.clone(), texts.join("; ")));
            }
            Value::Null => out.push((name.clone(), String::new())),
            other => out.push((name.clone(), other.plain())),
        }
    }
    out
}

fn line<'a>(cells: impl Iterator<Item = &'a str>) -> String {
    let mut out = String::new();
    for (index, cell) in cells.enumerate() {
        if index > 0 {
            out.push(',');
        }
        if cell.contains(['"', ',', '\r', '\n']) {
            out.push('"');
            out.push_str(&cell.replace('"', "\"\""));
            out.push('"');
        } else {
            out.push_str(cell);
        }
    }
    out.push_str("\r\n");
    out
}
