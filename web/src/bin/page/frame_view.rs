//! One frame: its bits and its fields; pointing at one lights the other.

use encoderscope::text;
use encoderscope_web::message::{Explained, FieldView};
use leptos::prelude::*;

/// Bits and fields of a frame.
#[component]
pub(crate) fn FrameView(frame: Explained) -> impl IntoView {
    let lit = RwSignal::new(None::<usize>);
    let cell = |index: usize| {
        let note = frame.field_at(index);
        let class = note.map_or("none", |note| frame.notes[note].class.as_str());
        let (field, title) = note.map_or(("", ""), |note| {
            let note = &frame.notes[note];
            (note.name.as_str(), note.title.as_str())
        });
        let value = u8::from(frame.bits[index]);
        let first = index == 0 || frame.field_at(index - 1) != note;
        view! {
            <button
                class=format!("bit {class}")
                class:lit=move || note.is_some() && lit.get() == note
                class:first=first
                data-testid="explain-bit"
                data-field=field.to_owned()
                data-index=index
                aria-label=text!("bit {}, {}, {}", index, title, value)
                on:mouseenter=move |_| lit.set(note)
                on:focus=move |_| lit.set(note)
                on:mouseleave=move |_| lit.set(None)
                on:blur=move |_| lit.set(None)
            >
                {value}
            </button>
        }
    };
    let len = frame.bits.len();
    let cells = if frame.bytes {
        let octet = |at: usize| view! { <span class="octet">{(at..(at + 8).min(len)).map(cell).collect_view()}</span> };
        (0..len).step_by(8).map(octet).collect_view().into_any()
    } else {
        (0..len).map(cell).collect_view().into_any()
    };
    let rows = frame
        .notes
        .into_iter()
        .enumerate()
        .map(|(index, note)| view! { <FieldRow index=index note=note lit=lit /> })
        .collect_view();
    view! {
        <div class="bits" class:bytes=frame.bytes>{cells}</div>
        <ul class="fields">{rows}</ul>
    }
}

#[component]
fn FieldRow(index: usize, note: FieldView, lit: RwSignal<Option<usize>>) -> impl IntoView {
    let width: usize = note.spans.iter().map(|(_, len)| len).sum();
    // Bits that are set explain themselves.
    let text = note.set.is_empty().then(|| view! { <p>{note.text}</p> });
    let set = note
        .set
        .into_iter()
        .map(|(name, doc)| match doc.is_empty() {
            true => view! { <p><b>{name}</b></p> }.into_any(),
            false => view! { <p><b>{name}</b> ": " {doc}</p> }.into_any(),
        })
        .collect_view();
    let faulty = note.fault.is_some();
    let field = note.name.clone();
    view! {
        <li
            class=format!("field {}", note.class)
            class:lit=move || lit.get() == Some(index)
            class:faulty=faulty
            data-testid="explain-field"
            data-field=field
            data-value=note.value
            tabindex="0"
            on:mouseenter=move |_| lit.set(Some(index))
            on:focus=move |_| lit.set(Some(index))
            on:mouseleave=move |_| lit.set(None)
            on:blur=move |_| lit.set(None)
        >
            <span class="name">{note.title}</span>
            <span class="raw">{note.raw} <small>{text!(" · {} bit", width)}</small></span>
            <div class="says">
                {text}
                {set}
                {note.fault.map(|fault| view! { <p class="fault">{fault}</p> })}
                <p class="doc">{note.doc}</p>
            </div>
        </li>
    }
}
