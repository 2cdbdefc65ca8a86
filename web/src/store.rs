//! The browser's own file system, in which recordings are kept: the only module that touches it.
//!
//! A file is written through a handle that writes at once, so that a browser that is killed takes
//! nothing with it that was written; such handles exist in workers alone.

use crate::{
    browser::{error_text, property},
    message::Kept,
};
use encoderscope::{
    language::msg,
    recording::{Reader, Writer, is_whole},
};
use js_sys::{Array, Function, Promise, Uint8Array};
use wasm_bindgen::{JsCast, JsValue, closure::Closure};
use wasm_bindgen_futures::JsFuture;
use web_sys::{
    Blob, File, FileSystemDirectoryHandle, FileSystemFileHandle, FileSystemGetDirectoryOptions,
    FileSystemGetFileOptions, FileSystemReadWriteOptions, FileSystemSyncAccessHandle, LockManager,
    StorageManager,
};

/// Where recordings are, and the beginning of the names of their locks.
const FOLDER: &str = "recordings";
/// So much of a file's end says whether it was ended.
const TAIL: f64 = 1024.0;
/// So much of it holds a whole section.
const SECTIONS: f64 = 1_048_576.0;

fn navigator() -> JsValue {
    property(&js_sys::global(), "navigator")
}

fn locks() -> Option<LockManager> {
    property(&navigator(), "locks").dyn_into().ok()
}

fn lock_of(name: &str) -> String {
    format!("{FOLDER}/{name}")
}

async fn folder() -> Result<FileSystemDirectoryHandle, JsValue> {
    let storage: StorageManager = property(&navigator(), "storage").dyn_into()?;
    let root: FileSystemDirectoryHandle =
        JsFuture::from(storage.get_directory()).await?.dyn_into()?;
    let options = FileSystemGetDirectoryOptions::new();
    options.set_create(true);
    let folder = root.get_directory_handle_with_options(FOLDER, &options);
    JsFuture::from(folder).await?.dyn_into()
}

/// A recording that is being written. As long as it is there, every tab can see that it runs.
#[derive(Debug)]
pub struct Out {
    handle: FileSystemSyncAccessHandle,
    size: f64,
    _lock: Option<Lock>,
}

impl Out {
    /// Makes a file that is not there yet.
    ///
    /// # Errors
    ///
    /// The browser keeps no files here, or has no room for them, or there is one of that name.
    pub async fn create(name: &str) -> Result<Self, JsValue> {
        let folder = folder().await?;
        if JsFuture::from(folder.get_file_handle(name)).await.is_ok() {
            return Err(JsValue::from_str("there is one"));
        }
        let options = FileSystemGetFileOptions::new();
        options.set_create(true);
        let made = folder.get_file_handle_with_options(name, &options);
        Self::open(JsFuture::from(made).await?.dyn_into()?, name).await
    }

    async fn open(file: FileSystemFileHandle, name: &str) -> Result<Self, JsValue> {
        // A page has no such handles.
        property(&file, "createSyncAccessHandle").dyn_into::<Function>()?;
        let handle = JsFuture::from(file.create_sync_access_handle()).await?;
        let handle: FileSystemSyncAccessHandle = handle.dyn_into()?;
        Ok(Self {
            size: handle.get_size()?,
            handle,
            _lock: locks().map(|locks| Lock::new(&locks, &lock_of(name))),
        })
    }

    /// How many bytes have been written.
    #[must_use]
    pub const fn size(&self) -> f64 {
        self.size
    }

    /// Appends bytes and makes sure that they outlast a loss of power. What does not fit leaves
    /// the file as it was.
    ///
    /// # Errors
    ///
    /// Why they could not be written, in English.
    pub fn append(&mut self, bytes: &[u8]) -> Result<(), String> {
        let options = FileSystemReadWriteOptions::new();
        options.set_at_f64(self.size);
        let written = self.handle.write_with_u8_array_and_options(bytes, &options);
        let end = self.size + bytes.len() as f64;
        let done = written.and_then(|written| {
            self.handle.flush()?;
            Ok(self.size + written >= end)
        });
        match done {
            Ok(true) => {
                self.size = end;
                return Ok(());
            }
            Ok(false) => {}
            Err(error) if error_text(&error).0 == "QuotaExceededError" => {}
            Err(error) => {
                let (_, message) = error_text(&error);
                return Err(format!("{}: {message}", msg("It cannot be written")));
            }
        }
        // Whole blocks alone are left; where even that fails, a reader finds the end.
        let _ = self
            .handle
            .truncate_with_f64(self.size)
            .and_then(|()| self.handle.flush());
        Err(msg("There is no room left for it.").into())
    }
}

impl Drop for Out {
    fn drop(&mut self) {
        self.handle.close();
    }
}

/// Held until it is dropped.
#[derive(Debug)]
struct Lock {
    release: Function,
}

impl Lock {
    fn new(locks: &LockManager, name: &str) -> Self {
        let mut release = Function::default();
        let held = Promise::new(&mut |kept, _| release = kept);
        let hold = Closure::once_into_js(move || held);
        // Where it is not given, the recording only seems not to run.
        let _ = locks.request(name, hold.unchecked_ref());
        Self { release }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Nobody listens when this fails.
        let _ = self.release.call0(&JsValue::UNDEFINED);
    }
}

/// The names of locks that are held.
async fn held() -> Vec<String> {
    let Some(locks) = locks() else {
        return Vec::new();
    };
    let Ok(state) = JsFuture::from(locks.query()).await else {
        return Vec::new();
    };
    let held = Array::from(&property(&state, "held"));
    held.iter()
        .filter_map(|lock| property(&lock, "name").as_string())
        .collect()
}

/// The recordings that are there, newest first.
///
/// # Errors
///
/// The browser keeps no files here.
pub async fn list() -> Result<Vec<Kept>, JsValue> {
    let folder = folder().await?;
    let held = held().await;
    let names = JsFuture::from(Array::from_async(&folder.keys())?).await?;
    let mut all = Vec::new();
    for name in Array::from(&names)
        .iter()
        .filter_map(|name| name.as_string())
    {
        // It may have been let go meanwhile.
        let Ok(file) = open(&name).await else {
            continue;
        };
        let size = file.size();
        let tail = file.slice_with_f64_and_f64((size - TAIL).max(0.0), size)?;
        all.push(Kept {
            size,
            written: file.last_modified(),
            runs: held.contains(&lock_of(&name)),
            whole: bytes(&tail).await.is_ok_and(|tail| is_whole(&tail)),
            name,
        });
    }
    all.sort_by(|one, other| other.written.total_cmp(&one.written));
    Ok(all)
}

/// A recording, as it is now.
///
/// # Errors
///
/// There is none of that name.
pub async fn open(name: &str) -> Result<File, JsValue> {
    let handle = folder().await?.get_file_handle(name);
    let handle: FileSystemFileHandle = JsFuture::from(handle).await?.dyn_into()?;
    JsFuture::from(handle.get_file()).await?.dyn_into()
}

/// Gives a recording that was cut off its end; one that has an end stays as it is.
///
/// # Errors
///
/// It is being written, or there is none of that name.
pub async fn settle(name: &str) -> Result<(), JsValue> {
    let file = open(name).await?;
    let size = file.size();
    let tail = file.slice_with_f64_and_f64((size - SECTIONS).max(0.0), size)?;
    let tail = bytes(&tail).await?;
    if is_whole(&tail) {
        return Ok(());
    }
    let mut reader = Reader::joining();
    reader.push(&tail);
    let mut last = 0;
    while let Ok(Some(moment)) = reader.next() {
        last = moment.at;
    }
    let handle = folder().await?.get_file_handle(name);
    let mut out = Out::open(JsFuture::from(handle).await?.dyn_into()?, name).await?;
    // Of a block that was being written when the power went, nothing is left to read.
    out.size -= reader.rest() as f64;
    out.handle.truncate_with_f64(out.size)?;
    let mut end = Vec::new();
    Writer::new("", "").end(last, "cut off", &mut end);
    out.append(&end).map_err(|error| JsValue::from_str(&error))
}

/// Lets a recording go.
///
/// # Errors
///
/// It is being written, or there is none of that name.
pub async fn delete(name: &str) -> Result<(), JsValue> {
    let folder = folder().await?;
    JsFuture::from(folder.remove_entry(name)).await?;
    Ok(())
}

/// The bytes of a part of a file.
///
/// # Errors
///
/// It cannot be read any more.
pub async fn bytes(part: &Blob) -> Result<Vec<u8>, JsValue> {
    let buffer = JsFuture::from(part.array_buffer()).await?;
    Ok(Uint8Array::new(&buffer).to_vec())
}
