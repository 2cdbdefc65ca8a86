//! The bits: pointed at, walked along with the arrow keys, turned over with a click.

use super::paper::{FieldPlan, Lit};
use crate::app::App;
use encoderscope::{language::t, layout::Class, text};
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use web_sys::{HtmlElement, KeyboardEvent};

/// The order in which the bits of a byte are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum View {
    /// As the byte is read: the most significant bit first.
    AsRead,
    /// As a UART sends it: start bit, the least significant bit first, stop bit.
    OnTheWire,
}

#[component]
pub(super) fn BitRow() -> impl IntoView {
    let paper = expect_context::<App>().paper();
    let view = RwSignal::new(View::AsRead);
    // The bit that the tabulator key leads to.
    let here = RwSignal::new(0usize);
    let cells = move || {
        let plan = paper.plan.get();
        let order = view.get();
        here.set(0);
        let cell = |at: usize| view! { <Cell at=at here=here /> };
        if !plan.bytes {
            return (0..plan.cells.len()).map(cell).collect_view().into_any();
        }
        let octet = |byte: usize| {
            let bits: Vec<usize> = match order {
                View::AsRead => (byte * 8..byte * 8 + 8).collect(),
                View::OnTheWire => (byte * 8..byte * 8 + 8).rev().collect(),
            };
            let framed = order == View::OnTheWire;
            view! {
                <div class="octet">
                    <div class="octet-bits">
                        {framed.then(|| view! { <span class="uart" title=t("start bit")>"0"</span> })}
                        {bits.into_iter().map(cell).collect_view()}
                        {framed.then(|| view! { <span class="uart" title=t("stop bit")>"1"</span> })}
                    </div>
                    <ByteBox byte=byte />
                </div>
            }
        };
        (0..plan.cells.len() / 8)
            .map(octet)
            .collect_view()
            .into_any()
    };
    let walk = move |event: KeyboardEvent| {
        let len = paper.plan.with_untracked(|plan| plan.cells.len());
        let at = here.get_untracked();
        let (back, on) = match view.get_untracked() {
            View::AsRead => (at.checked_sub(1), Some(at + 1)),
            View::OnTheWire => (wire_step(at, -1), wire_step(at, 1)),
        };
        let to = match event.key().as_str() {
            "ArrowLeft" => back,
            "ArrowRight" => on,
            "Home" => Some(0),
            "End" => len.checked_sub(1),
            _ => return,
        };
        if let Some(to) = to.filter(|to| *to < len) {
            event.prevent_default();
            here.set(to);
            focus(to);
        }
    };
    let bytes = move || paper.plan.with(|plan| plan.bytes);
    let order = move |wanted: View, title: &'static str| {
        view! {
            <button
                class="quiet"
                aria-pressed=move || (view.get() == wanted).to_string()
                on:click=move |_| view.set(wanted)
            >
                {title}
            </button>
        }
    };
    view! {
        {move || bytes().then(|| view! {
            <div class="bar-of" role="group" aria-label=t("Order of the bits") data-testid="bit-order">
                {order(View::AsRead, t("as read"))}
                {order(View::OnTheWire, t("as on the wire"))}
            </div>
        })}
        <div
            class="bits big"
            class:bytes=bytes
            role="group"
            aria-label=t("Bits of the frame; a click turns one over")
            data-testid="explain-bits"
            on:keydown=walk
            on:mouseleave=move |_| paper.lit.set(None)
        >
            {cells}
        </div>
    }
}

/// The neighbour of a bit on the wire, where each byte goes out last bit first.
fn wire_step(at: usize, by: isize) -> Option<usize> {
    let sent = (at / 8 * 8 + 7 - at % 8).checked_add_signed(by)?;
    Some(sent / 8 * 8 + 7 - sent % 8)
}

fn focus(bit: usize) {
    let element = document().get_element_by_id(&format!("bit-{bit}"));
    if let Some(element) = element.and_then(|element| element.dyn_into::<HtmlElement>().ok()) {
        // An element that is gone needs no focus.
        let _ = element.focus();
    }
}

#[component]
fn Cell(at: usize, here: RwSignal<usize>) -> impl IntoView {
    let paper = expect_context::<App>().paper();
    let (class, field, first) = paper.plan.with_untracked(|plan| {
        let field = plan.cells.get(at).copied().flatten();
        let before = at.checked_sub(1).and_then(|at| plan.cells.get(at).copied());
        let plain = field.and_then(|field| plan.fields.get(field));
        (
            plan.class_of(at).map_or("none", Class::name),
            plain.cloned(),
            before != Some(field),
        )
    });
    let bit = Memo::new(move |_| paper.with(|sketch| sketch.bits().bit(at)) == Some(true));
    let number = move || u8::from(bit.get());
    let title = field.as_ref().map(FieldPlan::title).unwrap_or_default();
    let field = field.as_ref().map(FieldPlan::plain).unwrap_or_default();
    let label = move || text!("bit {}, {}, {}", at, title, number());
    view! {
        <button
            id=format!("bit-{at}")
            class=format!("bit {class}")
            class:lit=move || paper.is_lit(at)
            class:first=first
            tabindex=move || if here.get() == at { "0" } else { "-1" }
            data-testid="explain-bit"
            data-field=field
            data-index=at
            data-value=move || number().to_string()
            aria-label=label
            on:mouseenter=move |_| paper.lit.set(Some(Lit::Bit(at)))
            on:focus=move |_| {
                here.set(at);
                paper.lit.set(Some(Lit::Bit(at)));
            }
            on:click=move |_| {
                paper.change(|sketch, checks| sketch.flip(at, checks));
            }
        >
            {number}
        </button>
    }
}

/// A byte in hexadecimal digits, to type over.
#[component]
fn ByteBox(byte: usize) -> impl IntoView {
    let paper = expect_context::<App>().paper();
    let text = move || {
        let byte = paper.with(|sketch| sketch.bits().bytes().get(byte).copied());
        format!("{:02X}", byte.flatten().unwrap_or(0))
    };
    let enter = move |typed: String| {
        if let Ok(value) = u8::from_str_radix(typed.trim().trim_start_matches("0x"), 16) {
            paper.change(|sketch, _| sketch.set_byte(byte, value));
        }
        // What is no byte is replaced by the one that is there.
        paper.sketch.notify();
    };
    view! {
        <input
            class="byte"
            maxlength="4"
            spellcheck="false"
            autocomplete="off"
            aria-label=text!("byte {} in hexadecimal digits", byte)
            data-testid="explain-byte"
            prop:value=text
            on:change:target=move |event| enter(event.target().value())
        />
    }
}
