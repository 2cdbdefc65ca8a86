//! Where input comes from: text, bytes, or a file that is read in pieces.

use crate::browser::error_text;
use encoderscope::{detect::Change, language::number, text};
use js_sys::Uint8Array;
use std::rc::Rc;
use wasm_bindgen_futures::JsFuture;
use web_sys::Blob;

/// Bytes of a piece.
const PIECE: usize = 1 << 20;
/// Bytes of the largest file that is opened.
const LARGEST: f64 = 2e9;
/// Bytes that decide what a file is.
pub(super) const HEAD: usize = 1 << 16;

/// Input that can be read again from its beginning.
#[derive(Clone, Debug)]
pub(super) enum Source {
    /// Text that was pasted or typed, or that a link carried.
    Text(Rc<[u8]>),
    /// Bytes that a link carried.
    Bytes(Rc<[u8]>),
    /// A file.
    File(Blob),
}

impl Source {
    /// Bytes of it.
    pub(super) fn len(&self) -> f64 {
        match self {
            Self::Text(bytes) | Self::Bytes(bytes) => bytes.len() as f64,
            Self::File(blob) => blob.size(),
        }
    }

    /// Why it is not opened.
    pub(super) fn refusal(&self) -> Option<String> {
        (self.len() > LARGEST).then(|| {
            text!(
                "The file has {} GB; more than {} GB do not fit into a browser's memory. Cut it in pieces.",
                number(format_args!("{:.1}", self.len() / 1e9)),
                format_args!("{:.0}", LARGEST / 1e9)
            )
        })
    }

    /// The piece that begins `at`; empty at the end.
    ///
    /// # Errors
    ///
    /// The file cannot be read, for example because it was changed meanwhile.
    pub(super) async fn piece(&self, at: f64) -> Result<Vec<u8>, String> {
        self.read(at, PIECE).await
    }

    /// Up to `count` bytes from `at`.
    pub(super) async fn read(&self, at: f64, count: usize) -> Result<Vec<u8>, String> {
        match self {
            Self::Text(bytes) | Self::Bytes(bytes) => {
                let rest = bytes.get(at as usize..).unwrap_or_default();
                Ok(rest[..rest.len().min(count)].into())
            }
            Self::File(blob) => {
                let said = |error| {
                    let (_, message) = error_text(&error);
                    text!("The file cannot be read: {}", message)
                };
                let slice = blob
                    .slice_with_f64_and_f64(at, at + count as f64)
                    .map_err(said)?;
                let buffer = JsFuture::from(slice.array_buffer()).await.map_err(said)?;
                Ok(Uint8Array::new(&buffer).to_vec())
            }
        }
    }
}

/// Turns UTF-16 into UTF-8, piece by piece; other input stays as it is.
#[derive(Debug, Default)]
pub(super) struct Recoder {
    order: Option<Order>,
    /// A byte, or half a pair of surrogates, that waits for the rest.
    rest: Vec<u8>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Order {
    Little,
    Big,
}

impl Recoder {
    /// One for input that begins so.
    pub(super) fn new(head: &[u8]) -> Self {
        let order = match head {
            [0xff, 0xfe, ..] => Some(Order::Little),
            [0xfe, 0xff, ..] => Some(Order::Big),
            _ => None,
        };
        Self {
            order,
            rest: Vec::new(),
        }
    }

    /// Whether anything is changed.
    pub(super) const fn is_needed(&self) -> bool {
        self.order.is_some()
    }

    /// The next piece.
    pub(super) fn recode(&mut self, piece: Vec<u8>) -> Vec<u8> {
        let Some(order) = self.order else {
            return piece;
        };
        self.rest.extend(piece);
        let units: Vec<u16> = self
            .rest
            .chunks_exact(2)
            .map(|pair| match order {
                Order::Little => u16::from_le_bytes([pair[0], pair[1]]),
                Order::Big => u16::from_be_bytes([pair[0], pair[1]]),
            })
            .collect();
        let high = |unit: &u16| (0xd800..0xdc00).contains(unit);
        let whole = units.len() - usize::from(units.last().is_some_and(high));
        self.rest.drain(..whole * 2);
        let letters = char::decode_utf16(units[..whole].iter().copied());
        let text: String = letters
            .map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER))
            .collect();
        text.into_bytes()
    }
}

/// What begins a file that the page wrote, before its profile.
const MARK: &str = "# Encoderscope recording 1 · ";

/// The first line of a recording; `change` is the mistake that is to be undone.
pub(super) fn title(profile: &str, change: Option<Change>) -> String {
    let change = change.map(|change| format!("&change={}", change.code()));
    format!("{MARK}{profile}{}\n", change.unwrap_or_default())
}

/// The profile that a recording begins with, and where its data begins.
pub(super) fn profile_of(head: &[u8]) -> Option<(String, usize)> {
    let rest = head.strip_prefix(MARK.as_bytes())?;
    let end = rest.iter().position(|byte| *byte == b'\n')?;
    let profile = String::from_utf8(rest[..end].to_vec()).ok()?;
    Some((profile.trim_end().to_owned(), MARK.len() + end + 1))
}

/// Whether bytes are no text.
pub(super) fn is_binary(head: &[u8]) -> bool {
    let control = |byte: &&u8| matches!(byte, 0..=8 | 14..=26 | 28..=31 | 127);
    let strange = head.iter().filter(control).count();
    let invalid = match std::str::from_utf8(head) {
        Ok(_) => 0,
        // A letter that is cut by the end of the head is none.
        Err(error) if error.error_len().is_none() => 0,
        Err(_) => String::from_utf8_lossy(head)
            .matches(char::REPLACEMENT_CHARACTER)
            .count(),
    };
    strange * 50 > head.len() || invalid * 10 > head.len()
}
