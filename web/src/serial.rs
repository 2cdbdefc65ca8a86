//! Web Serial: the only module that touches it.

use crate::{
    browser::{error_text, property, settled},
    message::PortId,
};
use encoderscope::{
    adapter::{Chip, Made},
    language::msg,
    recording::LineError,
    text,
};
use js_sys::{Array, Uint8Array};
use std::{cell::RefCell, rc::Rc};
use wasm_bindgen::{JsCast, JsValue, closure::Closure};
use wasm_bindgen_futures::JsFuture;
use web_sys::{
    ReadableStream, ReadableStreamDefaultReader, Serial, SerialOptions, SerialPort, WritableStream,
    WritableStreamDefaultWriter,
};

/// At 2.5 Mbaud 64 KiB last a quarter of a second.
const BUFFER: u32 = 65_536;

/// A port that has not closed after so many milliseconds is left behind.
const CLOSING: f64 = 2_000.0;

/// Writes that the port has not taken; what came behind them would be sent long after it was
/// meant.
const UNTAKEN: u32 = 2;

/// Why serial ports cannot be reached from here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Absent {
    /// The page came over plain http.
    Insecure,
    /// The browser has no Web Serial.
    NoApi,
    /// A policy forbids it here.
    Blocked,
}

fn serial() -> Option<Serial> {
    let serial = property(&property(&js_sys::global(), "navigator"), "serial");
    (!serial.is_undefined() && !serial.is_null()).then(|| serial.unchecked_into())
}

/// Whether a policy of the page, or of the frame that it stands in, forbids serial ports. Workers
/// cannot tell.
fn is_blocked() -> bool {
    let document = property(&js_sys::global(), "document");
    if document.is_undefined() {
        return false;
    }
    let policy = property(&document, "featurePolicy");
    let allows: Option<js_sys::Function> = property(&policy, "allowsFeature").dyn_into().ok();
    let answer = allows.and_then(|allows| allows.call1(&policy, &"serial".into()).ok());
    answer.is_some_and(|allowed| allowed.is_falsy())
}

/// Whether serial ports can be reached from this worker or page.
///
/// # Errors
///
/// Says what is missing.
pub fn available() -> Result<(), Absent> {
    let secure = property(&js_sys::global(), "isSecureContext").is_truthy();
    match serial() {
        _ if !secure => Err(Absent::Insecure),
        None => Err(Absent::NoApi),
        Some(_) if is_blocked() => Err(Absent::Blocked),
        Some(_) => Ok(()),
    }
}

fn identity(index: usize, port: &SerialPort) -> PortId {
    let info = port.get_info();
    let number = |name| property(&info, name).as_f64().map(|value| value as u16);
    PortId {
        index: index as u32,
        vendor: number("usbVendorId"),
        product: number("usbProductId"),
    }
}

fn identities(ports: &[SerialPort]) -> Vec<PortId> {
    let numbered = ports.iter().enumerate();
    numbered
        .map(|(index, port)| identity(index, port))
        .collect()
}

/// Where a port stands in a list: at its own place, or, when the list has changed, at that of
/// the only one of its kind. Another port is never taken for it.
#[must_use]
pub fn find(listed: &[PortId], wanted: PortId) -> Option<usize> {
    if listed.contains(&wanted) {
        return Some(wanted.index as usize);
    }
    let alike = |port: &PortId| (port.vendor, port.product) == (wanted.vendor, wanted.product);
    let mut places = (0..listed.len()).filter(|index| alike(&listed[*index]));
    let first = places.next();
    first.filter(|_| places.next().is_none())
}

async fn ports() -> Result<Vec<SerialPort>, JsValue> {
    // Asking where it is forbidden would only be a complaint in the browser's console.
    let serial = available().ok().and_then(|()| serial());
    let serial = serial.ok_or_else(|| JsValue::from_str("no Web Serial"))?;
    let list: Array = JsFuture::from(serial.get_ports()).await?.unchecked_into();
    Ok(list.iter().map(JsCast::unchecked_into).collect())
}

/// The ports that the user or a policy has given permission for.
///
/// # Errors
///
/// The browser refuses to list them.
pub async fn known() -> Result<Vec<PortId>, JsValue> {
    Ok(identities(&ports().await?))
}

/// Asks the user for a port; must be called from a click, on the page.
///
/// # Errors
///
/// `NotFoundError` where the user chose none.
pub async fn ask() -> Result<PortId, JsValue> {
    let serial = serial().ok_or_else(|| JsValue::from_str("no Web Serial"))?;
    let chosen: SerialPort = JsFuture::from(serial.request_port())
        .await?
        .unchecked_into();
    let ports = ports().await?;
    let index = ports
        .iter()
        .position(|port| js_sys::Object::is(port, &chosen))
        .unwrap_or(0);
    Ok(identity(index, &chosen))
}

/// Runs `then` whenever a port that the page has permission for is plugged in.
pub fn on_plugged(then: impl Fn() + 'static) {
    if let (Ok(()), Some(serial)) = (available(), serial()) {
        let listen = Closure::<dyn Fn()>::new(then);
        serial.set_onconnect(Some(listen.as_ref().unchecked_ref()));
        listen.forget();
    }
}

/// A name for a port.
#[must_use]
pub fn name(port: PortId) -> String {
    let (Some(vendor), Some(product)) = (port.vendor, port.product) else {
        return text!("Serial port {}", port.index + 1);
    };
    Chip::of(vendor, product).map_or_else(
        || format!("USB {vendor:04x}:{product:04x}"),
        |chip| chip.name.into(),
    )
}

/// A name for a port that tells its kind to everyone: its chip and USB identity, in English.
#[must_use]
pub fn kind(port: PortId) -> String {
    let (Some(vendor), Some(product)) = (port.vendor, port.product) else {
        return msg("serial port").into();
    };
    let chip = Chip::of(vendor, product).map_or("USB", |chip| chip.name);
    format!("{chip} ({vendor:04x}:{product:04x})")
}

/// What a port makes of a baud rate.
#[must_use]
pub fn made(port: PortId, baud: u32) -> Made {
    let chip = port
        .vendor
        .zip(port.product)
        .and_then(|(vendor, product)| Chip::of(vendor, product));
    chip.map_or(Made::Unknown, |chip| chip.made(baud))
}

/// An open port.
#[derive(Clone, Debug)]
pub struct Port {
    port: SerialPort,
    out: Rc<RefCell<Out>>,
    _watch: Rc<Watch>,
}

/// The sending side.
#[derive(Debug, Default)]
struct Out {
    /// Made with the first write, and anew when a write has failed.
    writer: Option<WritableStreamDefaultWriter>,
    untaken: u32,
}

/// Listens for the port going away until it is dropped.
#[derive(Debug)]
struct Watch {
    port: SerialPort,
    _listener: Closure<dyn Fn()>,
}

impl Watch {
    fn new(port: &SerialPort, gone: impl Fn() + 'static) -> Self {
        let listener = Closure::<dyn Fn()>::new(gone);
        port.set_ondisconnect(Some(listener.as_ref().unchecked_ref()));
        Self {
            port: port.clone(),
            _listener: listener,
        }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        self.port.set_ondisconnect(None);
    }
}

/// What reading a port came to.
#[derive(Debug)]
pub enum Read {
    /// Bytes.
    Bytes(Vec<u8>),
    /// The UART complained; a new reader goes on.
    LineError(LineError),
    /// The stream has ended: the port was closed.
    Closed,
    /// The port went away, or fails for good.
    Lost,
}

impl Port {
    /// Opens a port at a baud rate, 8N1; `gone` is called when its device goes away, even while
    /// it is being opened.
    ///
    /// # Errors
    ///
    /// The port is not there any more, is busy, or the browser may not open it.
    pub async fn open(id: PortId, baud: u32, gone: impl Fn() + 'static) -> Result<Self, JsValue> {
        let ports = ports().await?;
        let listed: Vec<PortId> = identities(&ports);
        let index = find(&listed, id).ok_or_else(|| {
            JsValue::from(js_sys::Error::new(msg(
                "The adapter is not plugged in, or not the only one of its kind.",
            )))
        })?;
        let port = &ports[index];
        let watch = Watch::new(port, gone);
        let options = SerialOptions::new(baud);
        options.set_buffer_size(BUFFER);
        JsFuture::from(port.open(&options)).await?;
        Ok(Self {
            port: port.clone(),
            out: Rc::default(),
            _watch: Rc::new(watch),
        })
    }

    /// Sends bytes. That they were taken proves nothing; only a reply does. A write that fails,
    /// or is dropped because earlier ones have not been taken, shows as silence.
    pub fn write(&self, bytes: &[u8]) {
        let mut out = self.out.borrow_mut();
        if out.untaken >= UNTAKEN {
            return;
        }
        if out.writer.is_none() {
            out.writer = self.writer();
        }
        let Some(writer) = out.writer.clone() else {
            return;
        };
        out.untaken += 1;
        let sent = writer.write_with_chunk(&Uint8Array::from(bytes).into());
        let out = Rc::clone(&self.out);
        wasm_bindgen_futures::spawn_local(async move {
            let failed = JsFuture::from(sent).await.is_err();
            let mut out = out.borrow_mut();
            out.untaken -= 1;
            // An error that is not fatal replaces the stream.
            if failed && out.writer.as_ref() == Some(&writer) {
                out.writer = None;
                writer.release_lock();
            }
        });
    }

    fn writer(&self) -> Option<WritableStreamDefaultWriter> {
        let writable = property(&self.port, "writable");
        let stream: WritableStream = writable.dyn_into().ok()?;
        stream.get_writer().ok()
    }

    /// A reader of the port; there can be one at a time.
    #[must_use]
    pub fn reader(&self) -> Option<Reader> {
        let readable = property(&self.port, "readable");
        let stream: ReadableStream = readable.dyn_into().ok()?;
        let reader = stream.get_reader().dyn_into().ok()?;
        Some(Reader { reader })
    }

    /// Closes the port, after its reader has been let go; one that does not close within two
    /// seconds is left behind.
    pub async fn close(&self) {
        if let Some(writer) = self.out.borrow_mut().writer.take() {
            writer.release_lock();
        }
        settled(&self.port.close(), CLOSING).await;
    }
}

/// The error after which a port has a new stream (Web Serial, "readable").
fn line_error(error: &JsValue) -> Option<LineError> {
    Some(match error_text(error).0.as_str() {
        "BreakError" => LineError::Break,
        "BufferOverrunError" => LineError::Overrun,
        "FramingError" => LineError::Framing,
        "ParityError" => LineError::Parity,
        _ => return None,
    })
}

/// Reads an open port.
#[derive(Clone, Debug)]
pub struct Reader {
    reader: ReadableStreamDefaultReader,
}

impl Reader {
    /// The next bytes.
    pub async fn read(&self) -> Read {
        match JsFuture::from(self.reader.read()).await {
            Ok(result) if property(&result, "done").is_truthy() => Read::Closed,
            Ok(result) => {
                let bytes: Uint8Array = property(&result, "value").unchecked_into();
                Read::Bytes(bytes.to_vec())
            }
            Err(error) => line_error(&error).map_or(Read::Lost, Read::LineError),
        }
    }

    /// Ends a pending read, as far as the port lets it within two seconds.
    pub async fn cancel(&self) {
        settled(&self.reader.cancel(), CLOSING).await;
    }

    /// Lets the stream go, so that another reader or a close can have it.
    pub fn release(&self) {
        self.reader.release_lock();
    }
}
