//! Rows and frames as the page shows them.

use crate::message::{Explained, FieldView, RowState, RowView};
use encoderscope::{
    bits::Bits,
    decode::{Decoded, Frame},
    dump::Direction,
    explain::{Note, degrees_text, grouped},
    export::table::Table,
    format::Medium,
    framing::Why,
    language::{number, t},
    record::hex,
    sheet::Row,
    text,
};

/// Bytes that a row shows.
const SHOWN: usize = 16;
/// Bits of a row that are explained; no frame is longer, whatever follows it on its line.
const EXPLAINED: usize = 512;

fn bytes_text(bits: Bits<'_>) -> String {
    let bytes = bits.bytes();
    let some: Vec<_> = bytes
        .iter()
        .take(SHOWN)
        .map(|byte| format!("{byte:02X}"))
        .collect();
    let more = if bytes.len() > SHOWN { " …" } else { "" };
    some.join(" ") + more
}

/// Why input is in no frame.
fn reason(why: Why, bits: Bits<'_>, medium: Medium, direction: Option<Direction>) -> String {
    match why {
        Why::Request if direction == Some(Direction::Sent) => t("sent").into(),
        Why::Request => t("a request, or its echo").into(),
        Why::NoFrame | Why::Unasked => {
            let count = grouped(bits.bytes().len() as u64);
            text!("{} {0|byte|bytes} of no frame", count)
        }
        Why::Truncated { have, need } => match medium {
            Medium::Bits => text!("{} of {} bits", have, need),
            Medium::Bytes | Medium::Text => text!("{} of {} bytes", have, need),
        },
    }
}

/// Flags and named bits that are set.
fn conditions(frame: &Frame<'_>) -> String {
    let values = frame.values();
    let flags = [
        (values.error == Some(true), t("error")),
        (values.warning == Some(true), t("warning")),
    ];
    let mut set: Vec<&str> = flags
        .iter()
        .filter(|(is_set, _)| *is_set)
        .map(|(_, name)| *name)
        .collect();
    let notes = frame.explain();
    for note in &notes {
        let named = note.bits.iter().filter(|bit| bit.set && bit.role.is_none());
        set.extend(named.map(|bit| t(bit.name)));
    }
    set.join(" · ")
}

/// What a frame says beside its position.
fn beside(frame: &Frame<'_>) -> Option<String> {
    let values = frame.values();
    let tenths = |value: i32| number(format!("{:.1}", f64::from(value) / 10.0));
    let temperature = values.temperature;
    let temperature = temperature.map(|value| format!("{} °C", tenths(value)));
    let speed = values.speed.map(|value| text!("{} rev/s", tenths(value)));
    let count = values.count.map(|count| text!("{} counted", count));
    temperature.or(speed).or(count)
}

/// A row of the table.
pub(super) fn row_view(row: &Row<'_>, medium: Medium) -> RowView {
    let mut view = RowView {
        index: row.index,
        start: 0.0,
        time: row.time,
        state: RowState::Skip,
        turns: None,
        angle: None,
        degrees: None,
        status: String::new(),
        check: String::new(),
        hex: String::new(),
    };
    match &row.decoded {
        Decoded::Skip { start, bits, why } => {
            view.start = *start as f64;
            view.state = match why {
                Why::Request => RowState::Request,
                Why::NoFrame | Why::Unasked | Why::Truncated { .. } => RowState::Skip,
            };
            view.hex = bytes_text(*bits);
            view.check = reason(*why, *bits, medium, row.direction);
        }
        Decoded::Frame(frame) => {
            let values = frame.values();
            let faults = frame.faults();
            let width = frame.layout.shape.profile.angle_bits;
            view.start = frame.start as f64;
            view.state = match faults.is_empty() {
                true => RowState::Good,
                false => RowState::Bad,
            };
            view.turns = values.turns.map(|turns| turns as f64);
            view.angle = values.angle.map(|angle| angle.to_string());
            view.degrees = values.angle.map(|angle| degrees_text(angle, width, 4));
            view.status = conditions(frame);
            if let Some(more) = beside(frame) {
                let gap = if view.status.is_empty() { "" } else { " · " };
                view.status = format!("{more}{gap}{}", view.status);
            }
            view.hex = bytes_text(frame.bits);
            view.check = match (faults.first(), values.crc, values.parity) {
                (Some(fault), ..) => fault.kind.to_string(),
                (None, Some(crc), _) => format!("✓ {:02X}", crc.received),
                (None, None, Some(_)) => t("✓ parity").into(),
                (None, None, None) => String::new(),
            };
        }
    }
    view
}

impl From<&Note> for FieldView {
    fn from(note: &Note) -> Self {
        let width: usize = note.spans.iter().map(|span| span.len).sum();
        Self {
            name: note.name.replace('_', " "),
            title: t(note.name).replace('_', " "),
            class: note.class.name().to_owned(),
            spans: note
                .spans
                .iter()
                .map(|span| (span.start, span.len))
                .collect(),
            doc: note.doc.clone(),
            raw: match width {
                0..=8 => format!("{:0width$b}", note.raw),
                _ => grouped(note.raw),
            },
            value: note.raw.to_string(),
            text: note.text.clone(),
            set: note
                .bits
                .iter()
                .filter(|bit| bit.set)
                .map(|bit| (t(bit.name).to_owned(), bit.doc.to_owned()))
                .collect(),
            fault: note.fault.map(|fault| fault.kind.to_string()),
        }
    }
}

impl Explained {
    /// A frame with its notes.
    #[must_use]
    pub fn new(index: usize, bits: Bits<'_>, bytes: bool, notes: &[Note]) -> Self {
        Self {
            index,
            bits: (0..bits.len().min(EXPLAINED))
                .map(|index| bits.bit(index))
                .collect(),
            bytes,
            notes: notes.iter().map(FieldView::from).collect(),
            says: Vec::new(),
            answers: None,
        }
    }

    /// The field that holds a bit.
    #[must_use]
    pub fn field_at(&self, index: usize) -> Option<usize> {
        let holds = |(start, len): &(usize, usize)| (*start..start + len).contains(&index);
        self.notes
            .iter()
            .position(|note| note.spans.iter().any(holds))
    }
}

/// A row in bits and fields.
pub(super) fn explained(row: &Row<'_>, medium: Medium) -> Explained {
    let bytes = medium != Medium::Bits;
    match &row.decoded {
        Decoded::Frame(frame) => {
            let mut view = Explained::new(row.index, frame.bits, bytes, &frame.explain());
            view.answers = frame.request.map(|start| start as f64);
            if frame.bits.len() > EXPLAINED {
                let more = grouped((frame.bits.len() - EXPLAINED) as u64);
                view.says.push(text!(
                    "{} {0|bit more follows|bits more follow} on this line",
                    more
                ));
            }
            // What a field is wrong about stands beside it.
            let of_all = frame.faults().into_iter();
            let all = of_all.filter(|fault| fault.at.len == frame.bits.len());
            view.says.extend(all.map(|fault| fault.kind.to_string()));
            view
        }
        Decoded::Skip { bits, why, .. } => {
            let mut view = Explained::new(row.index, *bits, bytes, &[]);
            view.bits.truncate(8 * SHOWN);
            view.says = vec![format!(
                "{}: {}",
                reason(*why, *bits, medium, row.direction),
                bytes_text(*bits)
            )];
            view
        }
    }
}

/// Rows as objects, one a line.
pub(super) fn json_lines<'a>(rows: impl Iterator<Item = Row<'a>>) -> String {
    let mut out = String::new();
    for row in rows {
        let Decoded::Frame(frame) = &row.decoded else {
            continue;
        };
        let record = match row.time {
            Some(time) => frame.record().with("time", time),
            None => frame.record(),
        };
        out += &record.to_string();
        out.push('\n');
    }
    out
}

/// Rows as lines of a table.
pub(super) fn csv_lines<'a>(table: &Table, rows: impl Iterator<Item = Row<'a>>) -> String {
    rows.map(|row| match &row.decoded {
        Decoded::Frame(frame) => table.frame(frame, row.time),
        Decoded::Skip { start, bits, why } => table.skip(*start, *bits, *why, row.time),
    })
    .collect()
}

/// Sixteen bytes a line.
pub(super) fn hex_lines(bytes: &[u8]) -> String {
    let lines: Vec<String> = bytes.chunks(16).map(hex).collect();
    lines.join("\n") + "\n"
}
