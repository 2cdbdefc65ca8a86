//! Reads recordings, of Encoderscope and of others who write serial lines as pcapng.

use super::{BESIDE, EVENT, Event, HEADER, LINK_TYPE, Line, LineError, Moment, Purpose, event};
use crate::{language::t, say, session::Micros};
use alloc::{
    string::{String, ToString},
    vec::Vec,
};
use core::fmt;
use pcap_parser::{
    Block, EnhancedPacketBlock, InterfaceDescriptionBlock, OptionCode, PcapNGOption,
    SectionHeaderBlock, parse_block_be, parse_block_le, parse_enhancedpacketblock_le,
    traits::PcapNGPacketBlock,
};

/// Type and length, as every block begins.
const BLOCK_HEADER: usize = 8;
/// The shortest block: type and both lengths.
const SHORTEST: usize = 12;
/// The longest block, as in Wireshark: what claims to be longer is damage.
const LONGEST: usize = 16 * 1024 * 1024;
/// The type of a section header, the same in both byte orders.
const SECTION: [u8; 4] = [0x0a, 0x0d, 0x0d, 0x0a];
/// The byte order mark of a section whose numbers have their low byte first.
const LITTLE: [u8; 4] = [0x4d, 0x3c, 0x2b, 0x1a];
/// The same with the high byte first.
const BIG: [u8; 4] = [0x1a, 0x2b, 0x3c, 0x4d];

/// Why a file cannot be read, or not on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unreadable {
    /// It does not begin as pcapng does.
    NotPcapng,
    /// There is no serial line in it, but packets of this link type.
    NotSerial(i32),
}

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPcapng => f.write_str(t("this is no pcapng file")),
            Self::NotSerial(link) => say!(
                f,
                "its packets are of link type {}, not of a serial line ({})",
                link,
                LINK_TYPE
            ),
        }
    }
}

impl core::error::Error for Unreadable {}

/// What a section says in front.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Section {
    /// Its comments, joined.
    pub comment: String,
    /// The program that wrote it.
    pub application: String,
    /// The system that the program ran on.
    pub system: String,
}

/// An interface of the present section.
#[derive(Clone, Debug)]
struct Interface {
    link: i32,
    line: Line,
    /// Units of its times in a second, and seconds to be added.
    resolution: u64,
    offset: i64,
}

/// Reads a file in pieces. It never fails on damage: what cannot be read is counted in
/// [`Self::lost`], and reading goes on with the next section.
///
/// See [`super::Writer`] for an example.
#[derive(Debug, Default)]
pub struct Reader {
    buffer: Vec<u8>,
    /// How much of the buffer has been read.
    at: usize,
    /// In which byte order the section is; nothing while one is searched for.
    order: Option<Order>,
    /// A section has been found, however damaged.
    found: bool,
    /// Something of a serial line has been found.
    serial: bool,
    section: Section,
    /// What the first section says.
    front: Option<String>,
    interfaces: Vec<Interface>,
    /// The line that is open, as far as the reader has said.
    open: Option<Line>,
    /// An event whose line was said first.
    held: Option<Moment>,
    lost: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Order {
    Little,
    Big,
}

impl Reader {
    /// A reader that has read nothing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A reader that begins somewhere in a file, at the next section.
    #[must_use]
    pub fn joining() -> Self {
        Self {
            found: true,
            ..Self::default()
        }
    }

    /// More of the file has come.
    pub fn push(&mut self, bytes: &[u8]) {
        // What is kept moves no more often than as much has been read.
        if self.at * 2 >= self.buffer.len() {
            self.buffer.drain(..self.at);
            self.at = 0;
        }
        self.buffer.extend_from_slice(bytes);
    }

    /// What the present section says in front.
    #[must_use]
    pub const fn section(&self) -> &Section {
        &self.section
    }

    /// The comment in front of the file, as soon as its first section has been read: a support
    /// file's text.
    #[must_use]
    pub fn front(&self) -> Option<&str> {
        self.front.as_deref()
    }

    /// Bytes that could not be read: damage, and once everything has come ([`Self::rest`]) a
    /// block that was cut off.
    #[must_use]
    pub const fn lost(&self) -> u64 {
        self.lost
    }

    /// Bytes that wait for more: at the end of a file, what was cut off.
    #[must_use]
    pub fn rest(&self) -> usize {
        self.buffer.len() - self.at
    }

    /// The next thing that happened; nothing where more of the file must come first.
    ///
    /// # Errors
    ///
    /// The file is no recording of a serial line.
    #[allow(
        clippy::should_implement_trait,
        reason = "there may be more after None"
    )]
    pub fn next(&mut self) -> Result<Option<Moment>, Unreadable> {
        loop {
            if let Some(moment) = self.held.take() {
                return Ok(Some(moment));
            }
            let Some(length) = self.block()? else {
                return Ok(None);
            };
            let end = self.at + length;
            let buffer = core::mem::take(&mut self.buffer);
            let moment = self.take(&buffer[self.at..end]);
            self.buffer = buffer;
            self.at = end;
            if let Some(moment) = moment? {
                return Ok(Some(moment));
            }
        }
    }

    /// The length of the next block, when all of it is there.
    fn block(&mut self) -> Result<Option<usize>, Unreadable> {
        loop {
            let rest = &self.buffer[self.at..];
            let order = match order_of(rest) {
                Start::More => return Ok(None),
                Start::Section(order) => Some(order),
                Start::Other => self.order,
            };
            if order.is_none() && !self.found {
                return Err(Unreadable::NotPcapng);
            }
            self.found = true;
            let length = order.and_then(|order| length_of(rest, order));
            let Some(length) = length else {
                self.skip();
                continue;
            };
            if rest.len() < length {
                return Ok(None);
            }
            self.order = order;
            return Ok(Some(length));
        }
    }

    /// Passes over damage, up to what may be a section.
    fn skip(&mut self) {
        self.order = None;
        let rest = &self.buffer[self.at + 1..];
        let next = rest
            .windows(SECTION.len())
            .position(|bytes| bytes == SECTION);
        // The beginning of one may stand at the end.
        let passed = 1 + next.unwrap_or(rest.len().saturating_sub(SECTION.len() - 1));
        self.lost += passed as u64;
        self.at += passed;
    }

    /// What a block says.
    fn take(&mut self, bytes: &[u8]) -> Result<Option<Moment>, Unreadable> {
        let parsed = match self.order {
            Some(Order::Big) => parse_block_be(bytes),
            _ => parse_block_le(bytes),
        };
        match parsed {
            Ok((_, Block::SectionHeader(header))) => {
                self.section = section(&header);
                if self.front.is_none() {
                    self.front = Some(self.section.comment.clone());
                }
                self.interfaces.clear();
                Ok(None)
            }
            Ok((_, Block::InterfaceDescription(description))) => {
                let interface = interface(&description, self.order);
                self.serial |= interface.link == LINK_TYPE;
                self.interfaces.push(interface);
                Ok(None)
            }
            Ok((_, Block::EnhancedPacket(packet))) => self.packet(&packet),
            Ok((_, Block::InterfaceStatistics(end))) => {
                let interface = self.interface(end.if_id);
                let Some(interface) = interface.filter(|line| line.link == LINK_TYPE) else {
                    return Ok(None);
                };
                let at = interface.time(end.ts_high, end.ts_low);
                let why = comment(&end.options);
                Ok(self.open.take().map(|_| Moment {
                    at,
                    event: Event::Closed(why),
                }))
            }
            // Others say nothing about the line.
            Ok(_) => Ok(None),
            Err(_) => {
                self.lost += bytes.len() as u64;
                Ok(None)
            }
        }
    }

    fn interface(&self, number: u32) -> Option<&Interface> {
        self.interfaces.get(usize::try_from(number).ok()?)
    }

    fn packet(&mut self, packet: &EnhancedPacketBlock<'_>) -> Result<Option<Moment>, Unreadable> {
        let Some(interface) = self.interface(packet.if_id).cloned() else {
            self.lost += u64::from(packet.block_len1);
            return Ok(None);
        };
        if interface.link != LINK_TYPE {
            return match self.serial {
                true => Ok(None),
                false => Err(Unreadable::NotSerial(interface.link)),
            };
        }
        let data = packet.packet_data();
        let Some((header, bytes)) = data.split_at_checked(HEADER) else {
            self.lost += u64::from(packet.block_len1);
            return Ok(None);
        };
        let at = interface.time(packet.ts_high, packet.ts_low);
        let remark = comment(&packet.options);
        let Some(event) = event_of(header[EVENT], bytes, remark) else {
            return Ok(None);
        };
        let moment = Moment { at, event };
        let lies = matches!(moment.event, Event::Marked(_) | Event::Ended(_));
        let opens = self.open.as_ref() != Some(&interface.line);
        // Notes may stand where no line is open.
        if !opens || (lies && interface.line == Line::default()) {
            return Ok(Some(moment));
        }
        self.open = Some(interface.line.clone());
        self.held = Some(moment);
        Ok(Some(Moment {
            at,
            event: Event::Opened(interface.line),
        }))
    }
}

/// Whether a recording was ended, and not cut off, by the last kilobyte of its file.
///
/// ```
/// use encoderscope::recording::{Writer, is_whole};
/// let (mut writer, mut file) = (Writer::new("Encoderscope", "Linux"), Vec::new());
/// writer.mark(0, "begins", &mut file);
/// assert!(!is_whole(&file));
/// writer.end(0, "stopped", &mut file);
/// assert!(is_whole(&file));
/// ```
#[must_use]
pub fn is_whole(tail: &[u8]) -> bool {
    // A block ends with its length.
    let last = tail.last_chunk().and_then(|length| {
        let length = usize::try_from(u32::from_le_bytes(*length)).ok()?;
        tail.get(tail.len().checked_sub(length)?..)
    });
    let packet = last.map(parse_enhancedpacketblock_le);
    packet.is_some_and(|packet| {
        packet.is_ok_and(|(_, packet)| {
            packet.packet_data().get(EVENT) == Some(&event::CAPTURE_COMPLETE)
        })
    })
}

impl Interface {
    /// Microseconds since 1970.
    fn time(&self, high: u32, low: u32) -> Micros {
        let units = u128::from(high) * (1 << 32) + u128::from(low);
        let time = units * 1_000_000 / u128::from(self.resolution);
        let offset = i128::from(self.offset) * 1_000_000;
        let time = i128::try_from(time).unwrap_or(i128::MAX);
        // Nobody has recorded beyond these bounds.
        Micros::try_from(time.saturating_add(offset).max(0)).unwrap_or(Micros::MAX)
    }
}

/// What stands at the beginning of a block.
enum Start {
    /// Too little to tell.
    More,
    Section(Order),
    Other,
}

fn order_of(bytes: &[u8]) -> Start {
    match (bytes.get(..4), bytes.get(8..12)) {
        // No block is shorter than this.
        (None, _) | (_, None) => Start::More,
        (Some(kind), Some(mark)) if kind == SECTION && mark == LITTLE => {
            Start::Section(Order::Little)
        }
        (Some(kind), Some(mark)) if kind == SECTION && mark == BIG => Start::Section(Order::Big),
        _ => Start::Other,
    }
}

/// The length that a block says it has; nothing where that cannot be.
fn length_of(bytes: &[u8], order: Order) -> Option<usize> {
    let length: [u8; 4] = bytes.get(4..BLOCK_HEADER)?.try_into().ok()?;
    let length = match order {
        Order::Little => u32::from_le_bytes(length),
        Order::Big => u32::from_be_bytes(length),
    };
    let length = usize::try_from(length).ok()?;
    (length.is_multiple_of(4) && (SHORTEST..=LONGEST).contains(&length)).then_some(length)
}

fn section(header: &SectionHeaderBlock<'_>) -> Section {
    Section {
        comment: comment(&header.options),
        application: text(&header.options, OptionCode::ShbUserAppl),
        system: text(&header.options, OptionCode::ShbOs),
    }
}

fn interface(block: &InterfaceDescriptionBlock<'_>, order: Option<Order>) -> Interface {
    let value = |code| {
        let mut found = block.options.iter().filter(|option| option.code == code);
        found.next().and_then(|option| option.as_bytes().ok())
    };
    let long = |code| {
        let bytes: [u8; 8] = value(code)?.try_into().ok()?;
        Some(match order {
            Some(Order::Big) => u64::from_be_bytes(bytes),
            _ => u64::from_le_bytes(bytes),
        })
    };
    let resolution = match value(OptionCode::IfTsresol) {
        Some(&[power @ 0..=19]) => 10_u64.pow(power.into()),
        // The highest bit set: a power of 2.
        Some(&[power @ 0x80..=0xbf]) => 2_u64.pow(u32::from(power - 0x80)),
        _ => 1_000_000,
    };
    Interface {
        link: block.linktype.0,
        line: Line {
            profile: text(&block.options, OptionCode::IfDescription),
            adapter: text(&block.options, OptionCode::IfName),
            baud: long(OptionCode::IfSpeed)
                .and_then(|speed| u32::try_from(speed).ok())
                .unwrap_or_default(),
        },
        resolution,
        offset: long(OptionCode::IfTsoffset).map_or(0, u64::cast_signed),
    }
}

/// All comments, joined.
fn comment(options: &[PcapNGOption<'_>]) -> String {
    let comments = options
        .iter()
        .filter(|option| option.code == OptionCode::Comment);
    comments
        .filter_map(|option| option.as_bytes().ok())
        .map(String::from_utf8_lossy)
        .collect()
}

fn text(options: &[PcapNGOption<'_>], code: OptionCode) -> String {
    let mut found = options.iter().filter(|option| option.code == code);
    let value = found.next().and_then(|option| option.as_bytes().ok());
    value.map_or_else(String::new, |value| {
        String::from_utf8_lossy(value).to_string()
    })
}

fn event_of(number: u8, bytes: &[u8], remark: String) -> Option<Event> {
    let error = LineError::ALL
        .into_iter()
        .find(|error| error.event() == number);
    Some(match number {
        event::DATA_TX_START | event::DATA_TX_END if !bytes.is_empty() => Event::Sent {
            bytes: bytes.into(),
            purpose: Purpose::ALL
                .into_iter()
                .find(|purpose| purpose.text() == remark),
        },
        event::DATA_RX_START | event::DATA_RX_END if !bytes.is_empty() => Event::Received {
            bytes: bytes.into(),
            beside: remark == BESIDE,
        },
        event::STATUS_CHANGE if !remark.is_empty() => Event::Marked(remark),
        event::CAPTURE_COMPLETE => Event::Ended(remark),
        _ => Event::Failed(error?),
    })
}
