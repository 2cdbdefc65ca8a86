//! Input in a link: `1.` and the compressed bytes in letters that a link may have.
//!
//! The first byte says whether text or bytes follow; four bytes of CRC-32 end them. The number
//! in front is the version: what a later page writes otherwise gets another one, and this one
//! is opened for ever.

use crate::browser::error_text;
use base64::{Engine as _, prelude::BASE64_URL_SAFE_NO_PAD as URL_SAFE_NO_PAD};
use encoderscope::{language::t, text};
use js_sys::{Array, Reflect, Uint8Array};
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::JsFuture;
use web_sys::{
    Blob, CompressionFormat, CompressionStream, DecompressionStream, ReadableStream,
    ReadableStreamDefaultReader, ReadableWritablePair,
};

/// Letters of the longest payload: what mail and chat programs still take as one link.
pub(super) const LONGEST: usize = 30_000;
/// Bytes of input that are tried at all.
pub(super) const MOST: usize = 2_000_000;
/// Bytes that a payload may grow to.
const LARGEST: usize = 64_000_000;

/// What a link carries.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Load {
    /// Text.
    Text(String),
    /// Bytes of a binary file.
    Bytes(Vec<u8>),
}

/// The payload for a load.
///
/// # Errors
///
/// It is too long for a link, or the browser cannot compress.
pub(super) async fn pack(load: &Load) -> Result<String, String> {
    let (kind, data) = match load {
        Load::Text(text) => (b'T', text.as_bytes()),
        Load::Bytes(bytes) => (b'B', &bytes[..]),
    };
    if data.len() > MOST {
        return Err(text!(
            "Too long for a link: more than {} MB of input.",
            MOST / 1_000_000
        ));
    }
    let mut all = vec![kind];
    all.extend(data);
    all.extend(crc32(&all).to_be_bytes());
    let stream =
        CompressionStream::new(CompressionFormat::DeflateRaw).map_err(|error| said(&error))?;
    let packed = through(&all, stream.unchecked_ref(), usize::MAX).await?;
    let text = format!("1.{}", URL_SAFE_NO_PAD.encode(packed));
    match text.len() {
        len if len > LONGEST => Err(too_long(len)),
        _ => Ok(text),
    }
}

fn too_long(len: usize) -> String {
    text!(
        "Too long for a link: it would have about {} kB, and mail programs cut links beyond {} kB.",
        len.div_ceil(1000),
        LONGEST / 1000
    )
}

/// What a payload carries.
///
/// # Errors
///
/// It is of a later version, damaged, or unpacks to more than a page can hold.
pub(super) async fn unpack(payload: &str) -> Result<Load, String> {
    let damaged = || {
        t("The link is damaged: a part of it is missing or was changed. Ask for it again, as a file if it was cut.").to_owned()
    };
    let Some((version, rest)) = payload.split_once('.') else {
        return Err(damaged());
    };
    if version != "1" {
        return Err(text!(
            "The link was written by a later Encoderscope (version {}): reload the page to get the latest.",
            version
        ));
    }
    let packed = URL_SAFE_NO_PAD.decode(rest).map_err(|_| damaged())?;
    let stream =
        DecompressionStream::new(CompressionFormat::DeflateRaw).map_err(|error| said(&error))?;
    let all = through(&packed, stream.unchecked_ref(), LARGEST)
        .await
        .map_err(|_| damaged())?;
    let Some((body, sum)) = all.split_last_chunk::<4>() else {
        return Err(damaged());
    };
    if crc32(body) != u32::from_be_bytes(*sum) {
        return Err(damaged());
    }
    match body.split_first() {
        Some((b'T', text)) => String::from_utf8(text.to_vec())
            .map(Load::Text)
            .map_err(|_| damaged()),
        Some((b'B', bytes)) => Ok(Load::Bytes(bytes.to_vec())),
        _ => Err(damaged()),
    }
}

fn said(error: &JsValue) -> String {
    text!("The browser cannot pack links: {}", error_text(error).1)
}

/// What comes out of a transforming stream.
async fn through(
    bytes: &[u8],
    pair: &ReadableWritablePair,
    most: usize,
) -> Result<Vec<u8>, String> {
    let parts = Array::of1(&Uint8Array::from(bytes));
    let blob = Blob::new_with_u8_array_sequence(&parts).map_err(|error| said(&error))?;
    let out: ReadableStream = blob.stream().pipe_through(pair);
    let reader: ReadableStreamDefaultReader = out.get_reader().unchecked_into();
    let mut all = Vec::new();
    loop {
        let read = JsFuture::from(reader.read())
            .await
            .map_err(|error| said(&error))?;
        let value = Reflect::get(&read, &"value".into()).unwrap_or_default();
        let Ok(piece) = value.dyn_into::<Uint8Array>() else {
            return Ok(all);
        };
        all.extend(piece.to_vec());
        if all.len() > most {
            // What is not read on is thrown away.
            let _ = reader.cancel();
            return Err(format!("more than {most} bytes"));
        }
    }
}

fn crc32(bytes: &[u8]) -> u32 {
    static CRC: crc::Crc<u32> = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    CRC.checksum(bytes)
}
