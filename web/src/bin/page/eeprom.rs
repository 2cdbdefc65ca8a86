//! The EEPROM of a Tamagawa encoder: a cell is read when asked, and written by a confirmed
//! setting.

use crate::app::App;
use encoderscope::{format::t485::MEMORY_SIZE, language::t, text};
use encoderscope_web::message::{Link, Setting, Wish};
use leptos::prelude::*;

/// A number as people write it: decimal, or hexadecimal behind 0x.
fn number(text: &str) -> Option<u8> {
    let text = text.trim();
    let hex = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
    match hex {
        Some(digits) => u8::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    }
}

/// A byte in every way that manuals write one.
pub(crate) fn byte_text(byte: u8) -> String {
    format!("0x{byte:02X} · {byte} · {byte:08b}")
}

/// Reads a cell; what is to be written into it goes to `chosen`, to be confirmed.
#[component]
pub(crate) fn Eeprom(chosen: RwSignal<Option<Setting>>) -> impl IntoView {
    let app = expect_context::<App>();
    let cell = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.memory));
    let shown = cell.get_untracked().map(|cell| cell.address);
    let address_text = RwSignal::new(format!("0x{:02X}", shown.unwrap_or(0)));
    let byte = RwSignal::new(String::new());
    let address = Memo::new(move |_| {
        let address = number(&address_text.get());
        address.filter(|address| *address < MEMORY_SIZE)
    });
    let reading = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.link == Link::Reading));
    let asked = move || {
        cell.get()
            .filter(|cell| Some(cell.address) == address.get())
    };
    let held = move || asked().and_then(|cell| cell.data);
    let to_write = move || {
        held()?;
        let (address, data) = (address.get()?, number(&byte.get())?);
        reading.get().then_some(Setting::Memory { address, data })
    };
    let read = move |_| {
        if let Some(address) = address.get_untracked() {
            app.wish(&Wish::ReadMemory(address));
        }
    };
    let answer = move || match (asked(), held()) {
        (None, _) => t("not read yet").into(),
        (Some(_), None) => t("asked; no answer yet").into(),
        (Some(cell), Some(data)) => {
            let address = cell.address;
            text!(
                "{} holds {}",
                format_args!("0x{address:02X}"),
                byte_text(data)
            )
        }
    };
    view! {
        <div class="eeprom">
            <h3>"EEPROM"</h3>
            <div class="doors">
                <label>
                    {t("Cell, 0…127 or 0x00…0x7F")}
                    <input
                        name="memory-address"
                        autocomplete="off"
                        prop:value=move || address_text.get()
                        on:input:target=move |event| address_text.set(event.target().value())
                    />
                </label>
                <button data-testid="memory-read" disabled=move || !reading.get() || address.get().is_none() on:click=read>
                    {t("Read")}
                </button>
            </div>
            <p data-testid="memory-cell" data-value=move || held().map(|data| data.to_string()) role="status">{answer}</p>
            <div class="doors">
                <label>
                    {t("New byte, 0…255 or 0x00…0xFF")}
                    <input
                        name="memory-byte"
                        autocomplete="off"
                        prop:value=move || byte.get()
                        on:input:target=move |event| byte.set(event.target().value())
                    />
                </label>
                <button data-testid="memory-write" disabled=move || to_write().is_none() on:click=move |_| chosen.set(to_write())>
                    {t("Write…")}
                </button>
            </div>
            <p class="hint">{t("A cell is read before it is written. What the cells mean stands in the maker's manual.")}</p>
        </div>
    }
}
