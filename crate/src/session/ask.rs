//! What a session may ask: requests that read, and never one that changes the encoder.

use crate::{
    bits::Bits,
    decode::Decoder,
    format::{
        Format,
        bus::{self, Operation},
        own::Own,
        t485::{self, Request},
    },
    language::t,
    layout::{Resolved, Role, Shape},
    profile::Profile,
    reading::Values,
    say,
};
use alloc::vec::Vec;
use core::fmt;

/// A request that reads, and the reply it should get.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ask {
    /// The format it belongs to.
    pub(super) format: Option<Format>,
    /// The request.
    pub(super) bytes: Vec<u8>,
    /// Bytes of the reply.
    pub(super) reply: usize,
    /// Whether the reply begins with the first byte of the request.
    echoes: bool,
    /// The EEPROM address that the reply must name.
    memory: Option<u8>,
}

/// Why something cannot be asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The format does not come over a serial line.
    NotSerial(Format),
    /// The format has no such request.
    NotOf(Format),
    /// The request would change the encoder.
    ChangesEncoder(u8),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotSerial(format) => say!(
                f,
                "{} is not read over a serial port: paste a dump instead",
                t(format.title())
            ),
            Self::NotOf(format) => say!(f, "{} has no such request", t(format.title())),
            Self::ChangesEncoder(byte) => say!(
                f,
                "0x{} changes the encoder and is never sent by polling",
                format_args!("{byte:02X}")
            ),
        }
    }
}

impl core::error::Error for Refusal {}

impl Ask {
    /// What reads the position: T485 everything, RS485 the profile's command, BUS the profile's
    /// device, a user's own layout its request.
    ///
    /// # Errors
    ///
    /// The format is not polled, or the profile's command changes the encoder.
    pub fn position(decoder: &Decoder) -> Result<Self, Refusal> {
        let profile = decoder.profile();
        match profile.format {
            Format::T485 => Self::t485(decoder, Request::All, 0),
            Format::Bus => Self::device(decoder, crate::bits::low_byte(profile.address.into())),
            Format::Rs485 if profile.command.changes_encoder() => {
                Err(Refusal::ChangesEncoder(profile.command.byte()))
            }
            Format::Rs485 => Self::byte(decoder, profile.command.byte()),
            other => match profile.own.and_then(Own::request) {
                Some(byte) => Self::byte(decoder, byte),
                None => Err(Refusal::NotSerial(other)),
            },
        }
    }

    /// A T485 request; `memory` is the EEPROM address where the request has one.
    ///
    /// ```
    /// use encoderscope::{decode::Decoder, format::t485::Request, profile::Profile, session::{Ask, Refusal}};
    /// let profile = Profile::parse([("format", "t485"), ("dialect", "tamagawa")])?;
    /// let decoder = Decoder::new(profile)?;
    /// assert!(Ask::t485(&decoder, Request::MemoryRead, 0x10).is_ok());
    /// let reset = Ask::t485(&decoder, Request::ResetAngle, 0);
    /// assert_eq!(reset, Err(Refusal::ChangesEncoder(0xc2)));
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The request would change the encoder, its dialect does not know it, the EEPROM has no such
    /// address, or the format is not T485.
    pub fn t485(decoder: &Decoder, request: Request, memory: u8) -> Result<Self, Refusal> {
        let format = decoder.profile().format;
        if format != Format::T485 {
            return Err(Refusal::NotOf(format));
        }
        if request.changes_encoder() {
            return Err(Refusal::ChangesEncoder(request.byte()));
        }
        // An encoder that does not know it would take each of its bytes for a request.
        if !request.is_known_to(decoder.profile().dialect) || memory >= t485::MEMORY_SIZE {
            return Err(Refusal::NotOf(format));
        }
        let bytes = request.bytes(decoder.profile(), memory, 0);
        Ok(Self {
            memory: (request == Request::MemoryRead).then_some(memory),
            ..Self::with(decoder, bytes)?
        })
    }

    /// The position of a BUS device.
    ///
    /// # Errors
    ///
    /// The format is not BUS.
    pub fn device(decoder: &Decoder, address: u8) -> Result<Self, Refusal> {
        let profile = decoder.profile();
        match profile.format {
            Format::Bus => Self::byte(decoder, bus::request(profile, Operation::Get, address)),
            other => Err(Refusal::NotOf(other)),
        }
    }

    /// The request that these bytes are, where a session may ask it: for reading along what another
    /// host asks.
    ///
    /// ```
    /// use encoderscope::{decode::Decoder, profile::Profile, session::Ask};
    /// let decoder = Decoder::new(Profile::parse([("format", "t485")])?)?;
    /// assert_eq!(Ask::of_bytes(&decoder, &[0x1a]).map(|ask| ask.reply_len()), Some(11));
    /// assert_eq!(Ask::of_bytes(&decoder, &[0xc2]), None);
    /// # Ok::<(), encoderscope::profile::ProfileError>(())
    /// ```
    #[must_use]
    pub fn of_bytes(decoder: &Decoder, bytes: &[u8]) -> Option<Self> {
        let is_it = |ask: &Self| ask.bytes == bytes;
        match decoder.profile().format {
            Format::Bus => (0..bus::ADDRESSES)
                .filter_map(|address| Self::device(decoder, address).ok())
                .find(is_it),
            Format::T485 => {
                let memory = bytes.get(1).copied().unwrap_or_default();
                Request::ALL
                    .iter()
                    .filter_map(|request| Self::t485(decoder, *request, memory).ok())
                    .find(is_it)
            }
            _ => Self::position(decoder).ok().filter(is_it),
        }
    }

    /// The bytes of the request.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// How many bytes the reply has.
    #[must_use]
    pub const fn reply_len(&self) -> usize {
        self.reply
    }

    fn byte(decoder: &Decoder, byte: u8) -> Result<Self, Refusal> {
        Self::with(decoder, [byte].into())
    }

    fn with(decoder: &Decoder, bytes: Vec<u8>) -> Result<Self, Refusal> {
        let layout = decoder
            .layout(&bytes)
            .ok_or(Refusal::NotOf(decoder.profile().format))?;
        Ok(Self {
            format: Some(decoder.profile().format),
            reply: layout.len / 8,
            echoes: decoder.echoes(),
            memory: None,
            bytes,
        })
    }

    /// Whether `reply` is a good answer.
    pub(crate) fn is_answered_by(&self, decoder: &Decoder, reply: &[u8]) -> bool {
        let answers = !self.echoes || reply.first() == self.bytes.first();
        let bits = Bits::of_bytes(reply);
        let holds = decoder.layout(reply).is_some_and(|layout| {
            let named = self.memory.is_none() || layout.values(bits).memory.0 == self.memory;
            named && layout.len == bits.len() && layout.holds(bits)
        });
        answers && holds
    }
}

impl Request {
    /// The bytes of the request: the control byte, with EEPROM address, data and CRC where it has
    /// them.
    #[must_use]
    pub(crate) fn bytes(self, profile: &Profile, address: u8, data: u8) -> Vec<u8> {
        let layout = Resolved::new(self.request(), Shape::of(*profile));
        let values = Values {
            memory: (Some(address), Some(data)),
            ..Values::default()
        };
        let mut out = layout.encode(&values);
        out.write(crate::bits::Span::new(0, 8), u64::from(self.byte()));
        layout.seal(&mut out, Role::Crc);
        out.into_bytes()
    }
}
