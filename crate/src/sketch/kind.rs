//! Which frames an encoder and its master exchange, each with an example.

use crate::{
    bits::{self, BitString, Bits},
    decode::Decoder,
    dump::Direction,
    format::{
        Format, Medium, REQUEST_BYTE,
        bus::{self, Operation},
        own::Own,
        t485::Request,
    },
    framing::Why,
    language::t,
    layout::{Layout, Resolved, Shape},
    profile::Profile,
    reading::Values,
    text,
};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// What the examples say.
pub(super) const EXAMPLE_DEGREES: f64 = 123.456;
/// What the examples say; as much of it as fits into the counter.
pub(super) const EXAMPLE_TURNS: i64 = 5;
/// EEPROM address and data of the examples.
const EXAMPLE_MEMORY: (u8, u8) = (0x10, 0x2a);

/// A kind of frame.
#[derive(Clone, Debug)]
pub struct FrameKind {
    /// Its name, as links write it: `frame`, `twice`, `reply`, `request`; of T485 and BUS the name
    /// of what was asked, behind `request-` for the request itself.
    pub name: String,
    /// What it is.
    pub title: String,
    /// Which way it goes.
    pub direction: Direction,
    /// Its layout.
    pub layout: Resolved,
    /// A frame of this kind whose checks hold.
    pub example: BitString,
}

impl FrameKind {
    fn request(decoder: &Decoder, name: &str, layout: &'static Layout, bytes: Vec<u8>) -> Self {
        let hex: Vec<String> = bytes.iter().map(|byte| format!("0x{byte:02X}")).collect();
        Self {
            name: name.to_string(),
            title: text!("request {}", hex.join(" ")),
            direction: Direction::Sent,
            layout: Resolved::new(layout, Shape::of(*decoder.profile())),
            example: BitString::of_bytes(bytes),
        }
    }

    fn reply(decoder: &Decoder, name: &str, layout: &'static Layout, values: &Values) -> Self {
        let example = decoder.encode(values);
        // The length of an ASI4 line is that of its number.
        let own = decoder.frame(example.as_bits().bytes());
        let own = own.map_or(decoder.main_layout().clone(), |frame| {
            frame.layout.into_owned()
        });
        let layout = match core::ptr::eq(own.layout, layout) {
            true => own,
            false => Resolved::new(layout, Shape::of(*decoder.profile())),
        };
        Self {
            name: name.to_string(),
            title: match layout.layout.doc {
                // It has the layout of an RS485 reply, and answers nothing.
                _ if decoder.profile().format == Format::Period => {
                    t("Position and status, sent again and again").to_string()
                }
                [] => t(decoder.profile().title()).to_string(),
                _ => layout.layout.title(),
            },
            direction: Direction::Received,
            layout,
            example,
        }
    }

    /// The kind that bits look like most: one of exactly their length, the better the more its
    /// fixed fields and echoes agree; else, of the clocked formats, what a dump's line is.
    pub(super) fn of(
        decoder: &Decoder,
        bits: Bits<'_>,
        direction: Option<Direction>,
    ) -> Result<Self, Why> {
        let kinds = decoder.frame_kinds().into_iter();
        let fitting = kinds.filter(|kind| {
            kind.layout.len == bits.len()
                && direction.is_none_or(|direction| kind.direction == direction)
        });
        let likeness = |kind: &Self| {
            let starts = |len: usize| kind.example.as_bits().prefix(len) == bits.prefix(len);
            // The first byte names the request, and is echoed.
            (starts(8), kind.direction == Direction::Received)
        };
        // Of equals the first.
        let best = fitting.reduce(|best, kind| match likeness(&kind) > likeness(&best) {
            true => kind,
            false => best,
        });
        if let Some(best) = best {
            return Ok(best);
        }
        let kinds = decoder.frame_kinds().into_iter();
        let main = kinds.last().ok_or(Why::NoFrame)?;
        let need = decoder.main_layout().len;
        let truncated = Why::Truncated {
            have: bits.len(),
            need,
        };
        let layout = match decoder.profile().medium() {
            Medium::Bits => decoder.line(bits)?.layout,
            Medium::Bytes | Medium::Text => match decoder.frame(bits.bytes()) {
                Some(frame) if frame.bits.len() == bits.len() => frame.layout,
                _ if bits.len() < need => return Err(truncated),
                _ => return Err(Why::NoFrame),
            },
        };
        Ok(Self {
            layout: layout.into_owned(),
            ..main
        })
    }
}

impl Decoder {
    /// The frames that an encoder of this profile and its master exchange, each with an example;
    /// the request stands before its reply.
    ///
    /// ```
    /// use encoderscope::{decode::Decoder, format::Format};
    /// let names = |format: Format| {
    ///     let decoder = Decoder::new(format.default_profile()).unwrap();
    ///     decoder.frame_kinds().into_iter().map(|kind| kind.name).collect::<Vec<_>>()
    /// };
    /// assert_eq!(names(Format::BissC), ["frame"]);
    /// assert_eq!(names(Format::Rs485), ["request", "reply"]);
    /// assert_eq!(names(Format::Bus)[..2], ["request-get", "get"]);
    /// ```
    #[must_use]
    pub fn frame_kinds(&self) -> Vec<FrameKind> {
        let profile = self.profile();
        let values = example(profile);
        match profile.format {
            Format::T485 => {
                let known = Request::ALL.iter().copied();
                known
                    .filter(|request| request.is_known_to(profile.dialect))
                    .flat_map(|request| self.t485_kinds(request, &values))
                    .collect()
            }
            Format::Bus => Operation::ALL
                .iter()
                .flat_map(|operation| self.bus_kinds(*operation, &values))
                .collect(),
            Format::Rs485 => {
                let request = [profile.command.byte()].into();
                [
                    FrameKind::request(self, "request", &REQUEST_BYTE, request),
                    FrameKind::reply(self, "reply", profile.command.reply(), &values),
                ]
                .into()
            }
            Format::SsiTree => {
                let layout = self.main_layout().layout;
                let frame = FrameKind::reply(self, "frame", layout, &values);
                let shape = Shape {
                    repeats: 1,
                    ..Shape::of(*profile)
                };
                let twice = Resolved::new(layout, shape);
                let again = FrameKind {
                    name: "twice".to_string(),
                    title: t("The same word twice (multi-transmission)").to_string(),
                    direction: Direction::Received,
                    example: twice.encode(&values),
                    layout: twice,
                };
                [frame, again].into()
            }
            _ => {
                let layout = self.main_layout().layout;
                let reply = |name| FrameKind::reply(self, name, layout, &values);
                match profile.own.and_then(Own::request) {
                    Some(byte) => [
                        FrameKind::request(self, "request", &REQUEST_BYTE, [byte].into()),
                        reply("reply"),
                    ]
                    .into(),
                    None => [reply("frame")].into(),
                }
            }
        }
    }

    fn t485_kinds(&self, request: Request, values: &Values) -> [FrameKind; 2] {
        let (address, data) = EXAMPLE_MEMORY;
        let bytes = request.bytes(self.profile(), address, data);
        let name = request.name();
        let echo = self.main_layout().values(Bits::of_bytes(&bytes));
        let values = Values {
            operation: echo.operation,
            ..*values
        };
        [
            FrameKind::request(self, &format!("request-{name}"), request.request(), bytes),
            FrameKind::reply(self, name, request.reply(), &values),
        ]
    }

    fn bus_kinds(&self, operation: Operation, values: &Values) -> [FrameKind; 2] {
        let own = bits::low_byte(self.profile().address.into());
        let byte = bus::request(self.profile(), operation, own);
        let name = operation.name();
        let values = Values {
            operation: Some(operation.code()),
            ..*values
        };
        [
            FrameKind::request(self, &format!("request-{name}"), &bus::HEAD, [byte].into()),
            FrameKind::reply(self, name, operation.reply(), &values),
        ]
    }
}

/// What the examples say: a position in which every field differs from 0, and no fault.
fn example(profile: &Profile) -> Values {
    let turns = EXAMPLE_TURNS as u64 & bits::mask(profile.turns_bits as usize);
    let angle = bits::codes(profile.angle_bits) as f64 * EXAMPLE_DEGREES / 360.0;
    Values {
        turns: Some(turns as i64),
        angle: Some(angle as u64),
        error: Some(false),
        warning: Some(false),
        valid: Some(true),
        enid: Some(if profile.angle_bits == 17 { 0x11 } else { 0x17 }),
        speed: Some(125),
        temperature: Some(365),
        count: Some(3),
        memory: (Some(EXAMPLE_MEMORY.0), Some(EXAMPLE_MEMORY.1)),
        ..Values::default()
    }
}
