//! A recording on its way into a file of the user's.

use crate::browser::{error_text, pause};
use encoderscope::language::msg;
use js_sys::Uint8Array;
use std::cell::RefCell;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::JsFuture;
use web_sys::{Blob, FileSystemFileHandle, FileSystemWritableFileStream};

/// Milliseconds between two looks at what has come.
const LOOK: f64 = 250.0;

/// What has come and the file has not taken.
#[derive(Default)]
struct Queue {
    bytes: Vec<u8>,
    ended: bool,
    fault: Option<String>,
}

pub(super) struct Copy {
    handle: FileSystemFileHandle,
    queue: RefCell<Queue>,
}

impl Copy {
    pub(super) fn new(handle: FileSystemFileHandle) -> Self {
        Self {
            handle,
            queue: RefCell::default(),
        }
    }

    /// The name of the file.
    pub(super) fn name(&self) -> String {
        self.handle.name()
    }

    /// Why the file takes nothing any more.
    pub(super) fn fault(&self) -> Option<String> {
        self.queue.borrow().fault.clone()
    }

    pub(super) fn push(&self, bytes: &[u8]) {
        let mut queue = self.queue.borrow_mut();
        if queue.fault.is_none() {
            queue.bytes.extend_from_slice(bytes);
        }
    }

    pub(super) fn end(&self) {
        self.queue.borrow_mut().ended = true;
    }

    /// Writes what came before the copy began, then what comes, until it is ended.
    pub(super) async fn run(&self, front: Option<Blob>) {
        if let Err(error) = self.write(front).await {
            let mut queue = self.queue.borrow_mut();
            queue.bytes = Vec::new();
            let (_, message) = error_text(&error);
            queue.fault = Some(format!("{}: {message}", msg("The copy on disk has failed")));
        }
    }

    async fn write(&self, front: Option<Blob>) -> Result<(), JsValue> {
        let stream = JsFuture::from(self.handle.create_writable()).await?;
        let stream: FileSystemWritableFileStream = stream.unchecked_into();
        if let Some(front) = front {
            JsFuture::from(stream.write_with_blob(&front)?).await?;
        }
        loop {
            let (bytes, ended) = {
                let mut queue = self.queue.borrow_mut();
                (std::mem::take(&mut queue.bytes), queue.ended)
            };
            if !bytes.is_empty() {
                let bytes = Uint8Array::from(&bytes[..]);
                JsFuture::from(stream.write_with_js_u8_array(&bytes)?).await?;
            } else if ended {
                break;
            } else {
                pause(LOOK).await;
            }
        }
        JsFuture::from(stream.close()).await?;
        Ok(())
    }
}
