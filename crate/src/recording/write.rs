//! Writes recordings.

use super::{BESIDE, HEADER, LINK_TYPE, Line, LineError, Purpose, SECTION_LENGTH, event};
use crate::session::Micros;
use alloc::{
    borrow::Cow,
    string::{String, ToString},
    vec::Vec,
};
use pcap_parser::{
    EnhancedPacketBlock, InterfaceDescriptionBlock, InterfaceStatisticsBlock, Linktype, OptionCode,
    PcapNGOption, SectionHeaderBlock, ToVec,
};

/// The longest value of an option.
const LONGEST: usize = 65_532;

/// Writes what happens on lines, in blocks: whatever a method appends to `out` is a whole number
/// of them, so that a file which ends behind any is a good one.
///
/// ```
/// use encoderscope::recording::{Event, Line, Reader, Writer};
/// let mut writer = Writer::new("Encoderscope", "Linux");
/// let mut file = Vec::new();
/// let line = Line { profile: "format=t485".into(), adapter: "FT232H".into(), baud: 2_500_000 };
/// writer.open(1_000_000, line, &mut file);
/// writer.sent(1_000_100, &[0x1a], None, &mut file);
///
/// let mut reader = Reader::new();
/// reader.push(&file);
/// reader.next()?;
/// let moment = reader.next()?.unwrap();
/// assert_eq!(moment.at, 1_000_100);
/// assert_eq!(moment.event, Event::Sent { bytes: vec![0x1a], purpose: None });
/// # Ok::<(), encoderscope::recording::Unreadable>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Writer {
    application: String,
    system: String,
    /// What each section says in front.
    comment: String,
    line: Option<Line>,
    /// When the line was opened.
    opened: Micros,
    /// The last time that was written: times do not run backwards.
    last: Micros,
    /// Bytes of the present section; nothing before the first.
    written: usize,
    /// The open line's number within the section.
    interface: Option<u32>,
    interfaces: u32,
}

impl Writer {
    /// A writer for a program that runs on a system, by their names.
    #[must_use]
    pub fn new(application: &str, system: &str) -> Self {
        Self {
            application: application.into(),
            system: system.into(),
            ..Self::default()
        }
    }

    /// The same, with a comment in front of every section.
    #[must_use]
    pub fn commented(self, comment: &str) -> Self {
        Self {
            comment: comment.into(),
            ..self
        }
    }

    /// Begins a section, which can be read without those before it. The first begins by itself.
    pub fn begin(&mut self, out: &mut Vec<u8>) {
        let from = out.len();
        let mut options = Vec::new();
        let mut rest = self.comment.as_str();
        while !rest.is_empty() {
            let end = floor(rest, LONGEST);
            options.push(text(OptionCode::Comment, &rest[..end]));
            rest = &rest[end..];
        }
        options.push(text(OptionCode::ShbOs, &self.system));
        options.push(text(OptionCode::ShbUserAppl, &self.application));
        block(
            SectionHeaderBlock {
                block_type: 0,
                block_len1: 0,
                bom: 0,
                major_version: 0,
                minor_version: 0,
                // It is not known beforehand.
                section_len: -1,
                options,
                block_len2: 0,
            },
            out,
        );
        self.written = out.len() - from;
        self.interface = None;
        self.interfaces = 0;
        self.describe(out);
    }

    /// A line was opened, or goes on with another profile.
    pub fn open(&mut self, at: Micros, line: Line, out: &mut Vec<u8>) {
        if self.line.is_none() {
            self.opened = at;
        }
        self.line = Some(line);
        self.interface = None;
        if self.written == 0 {
            return self.begin(out);
        }
        self.describe(out);
    }

    /// Bytes came.
    pub fn received(&mut self, at: Micros, bytes: &[u8], beside: bool, out: &mut Vec<u8>) {
        let comment = beside.then_some(BESIDE);
        self.packet(at, event::DATA_RX_START, bytes, comment, out);
    }

    /// Bytes were sent.
    pub fn sent(&mut self, at: Micros, bytes: &[u8], purpose: Option<Purpose>, out: &mut Vec<u8>) {
        let comment = purpose.map(Purpose::text);
        self.packet(at, event::DATA_TX_START, bytes, comment, out);
    }

    /// The UART complained.
    pub fn failed(&mut self, at: Micros, error: LineError, out: &mut Vec<u8>) {
        self.packet(at, error.event(), &[], None, out);
    }

    /// A note.
    pub fn mark(&mut self, at: Micros, note: &str, out: &mut Vec<u8>) {
        self.packet(at, event::STATUS_CHANGE, &[], Some(note), out);
    }

    /// The line was closed or lost.
    pub fn close(&mut self, at: Micros, why: &str, out: &mut Vec<u8>) {
        let at = self.time(at);
        if let Some(interface) = self.interface.take() {
            let (high, low) = halves(at);
            let end = [high.to_le_bytes(), low.to_le_bytes()].concat();
            let made = InterfaceStatisticsBlock {
                block_type: 0,
                block_len1: 0,
                if_id: interface,
                ts_high: high,
                ts_low: low,
                options: Vec::from([
                    text(OptionCode::Comment, why),
                    option(OptionCode::IsbEndTime, end),
                ]),
                block_len2: 0,
            };
            let from = out.len();
            block(made, out);
            self.written += out.len() - from;
        }
        self.line = None;
    }

    /// The recording is ended; what comes behind belongs to another one.
    pub fn end(&mut self, at: Micros, why: &str, out: &mut Vec<u8>) {
        self.packet(at, event::CAPTURE_COMPLETE, &[], Some(why), out);
    }

    fn time(&mut self, at: Micros) -> Micros {
        self.last = self.last.max(at);
        self.last
    }

    /// Says which line is open.
    fn describe(&mut self, out: &mut Vec<u8>) {
        // Notes and the end may stand where no line is open.
        let line = self.line.clone().unwrap_or_default();
        let mut options = Vec::from([
            text(OptionCode::IfName, &line.adapter),
            text(OptionCode::IfDescription, &line.profile),
            option(
                OptionCode::IfSpeed,
                u64::from(line.baud).to_le_bytes().into(),
            ),
        ]);
        options.retain(|option| option.len > 0);
        let made = InterfaceDescriptionBlock {
            block_type: 0,
            block_len1: 0,
            linktype: Linktype(LINK_TYPE),
            reserved: 0,
            snaplen: 0,
            options,
            block_len2: 0,
            // Microseconds, of no offset.
            if_tsresol: 6,
            if_tsoffset: 0,
        };
        let from = out.len();
        block(made, out);
        self.written += out.len() - from;
        self.interface = Some(self.interfaces);
        self.interfaces += 1;
    }

    fn packet(
        &mut self,
        at: Micros,
        event: u8,
        bytes: &[u8],
        comment: Option<&str>,
        out: &mut Vec<u8>,
    ) {
        if self.written == 0 || self.written > SECTION_LENGTH {
            self.begin(out);
        } else if self.interface.is_none() {
            self.describe(out);
        }
        let at = self.time(at);
        let since = at.saturating_sub(self.opened);
        let mut data = Vec::with_capacity(HEADER + bytes.len());
        // A line is open for less than 136 years.
        data.extend_from_slice(&((since / 1_000_000) as u32).to_be_bytes());
        data.extend_from_slice(&((since % 1_000_000) as u32).to_be_bytes());
        data.extend_from_slice(&[event, 0, 0, 0]);
        data.extend_from_slice(bytes);
        let (ts_high, ts_low) = halves(at);
        let from = out.len();
        block(
            EnhancedPacketBlock {
                block_type: 0,
                block_len1: 0,
                if_id: self.interface.unwrap_or_default(),
                ts_high,
                ts_low,
                caplen: data.len() as u32,
                origlen: data.len() as u32,
                data: &data,
                options: comment
                    .map(|comment| text(OptionCode::Comment, comment))
                    .into_iter()
                    .collect(),
                block_len2: 0,
            },
            out,
        );
        self.written += out.len() - from;
    }
}

/// The high and the low half of a time.
const fn halves(at: Micros) -> (u32, u32) {
    let [a, b, c, d, e, f, g, h] = at.to_be_bytes();
    (
        u32::from_be_bytes([a, b, c, d]),
        u32::from_be_bytes([e, f, g, h]),
    )
}

/// Appends a block.
fn block(mut made: impl ToVec, out: &mut Vec<u8>) {
    // Writing into memory does not fail.
    out.extend(made.to_vec().unwrap_or_default());
}

fn option<'a>(code: OptionCode, value: Vec<u8>) -> PcapNGOption<'a> {
    PcapNGOption {
        code,
        len: value.len() as u16,
        value: Cow::Owned(value),
    }
}

/// An option that is text, as much of it as an option holds.
fn text<'a>(code: OptionCode, text: &str) -> PcapNGOption<'a> {
    option(code, text[..floor(text, LONGEST)].to_string().into_bytes())
}

/// The last end of a character at or before a place.
fn floor(text: &str, place: usize) -> usize {
    let mut place = place.min(text.len());
    while !text.is_char_boundary(place) {
        place -= 1;
    }
    place
}
