//! Files that are written from what is shown.

use super::{Desk, rows, source::title};
use crate::{
    browser::pause,
    link,
    message::{FileKind, FromDesk},
};
use encoderscope::{export::table::Table, language::t};
use js_sys::Array;
use wasm_bindgen::JsValue;
use web_sys::{Blob, BlobPropertyBag};

/// Rows that are written in one go.
const ROWS: usize = 4_000;
/// Bytes of a recording that are written in one go.
const BYTES: usize = 1 << 20;

impl Desk {
    /// Writes a file, piece by piece, and hands it to the page.
    pub(super) fn export(&self, kind: FileKind) {
        let desk = self.clone();
        let job = self.state.borrow().job;
        wasm_bindgen_futures::spawn_local(async move {
            let parts = match kind {
                FileKind::Recording => desk.recording().await,
                FileKind::Csv | FileKind::JsonLines => desk.table(kind, job).await,
            };
            let options = BlobPropertyBag::new();
            options.set_type("text/plain;charset=utf-8");
            let blob = parts
                .ok()
                .and_then(|parts| Blob::new_with_str_sequence_and_options(&parts, &options).ok());
            match blob {
                Some(blob) => desk.post_with(FromDesk::Exported(kind), Some(blob.into())),
                None => desk.post(FromDesk::Refused(t("The file cannot be written.").into())),
            }
        });
    }

    /// The rows that are shown, in the order in which they are shown.
    async fn table(&self, kind: FileKind, job: u32) -> Result<Array, String> {
        let parts = Array::new();
        let table = self.look(|sheet, _| Table::new(sheet.decoder()));
        let table = table.filter(|_| kind == FileKind::Csv);
        if let Some(table) = &table {
            parts.push(&JsValue::from_str(&table.header()));
        }
        let mut place = 0;
        loop {
            let text = self.look(|sheet, dump| {
                let rows = place..(place + ROWS).min(sheet.shown());
                let rows = rows.filter_map(|place| sheet.row(dump, sheet.shown_at(place)?));
                let text = match &table {
                    Some(table) => rows::csv_lines(table, rows),
                    None => rows::json_lines(rows),
                };
                (text, place >= sheet.shown())
            });
            let Some((text, false)) = text else {
                return Ok(parts);
            };
            parts.push(&JsValue::from_str(&text));
            place += ROWS;
            pause(0.0).await;
            if !self.wants(job) {
                return Err("other input came meanwhile".into());
            }
        }
    }

    /// The input with its profile in front; bytes that are no text in hexadecimal.
    async fn recording(&self) -> Result<Array, String> {
        let (source, origin, profile, text, change) = {
            let state = self.state.borrow();
            let profile = state.profile.as_ref().map(link::query);
            (
                state.source.clone(),
                state.origin,
                profile,
                !state.binary,
                state.judge.change,
            )
        };
        let source = source.ok_or("there is nothing to write")?;
        let parts = Array::of1(&JsValue::from_str(&title(
            &profile.unwrap_or_default(),
            change,
        )));
        let mut at = origin as f64;
        // A letter may be cut by the end of a piece.
        let mut rest: Vec<u8> = Vec::new();
        loop {
            let piece = source.read(at, BYTES).await?;
            let last = piece.is_empty();
            at += piece.len() as f64;
            rest.extend(piece);
            let whole = match std::str::from_utf8(&rest) {
                Err(error) if text && !last && error.error_len().is_none() => error.valid_up_to(),
                _ => rest.len(),
            };
            let piece: Vec<u8> = rest.drain(..whole).collect();
            let piece = match text {
                true => String::from_utf8_lossy(&piece).into_owned(),
                false => rows::hex_lines(&piece),
            };
            parts.push(&JsValue::from_str(&piece));
            if last {
                return Ok(parts);
            }
        }
    }
}
