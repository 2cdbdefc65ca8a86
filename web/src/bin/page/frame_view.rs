//! One frame: its bits and its fields; pointing at one lights the other.

use encoderscope::{
    bits::Bits,
    explain::{Note, grouped},
};
use leptos::prelude::*;

/// A frame as the view needs it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Explained {
    /// The frame's bits, first on the left.
    pub(crate) bits: Vec<bool>,
    /// Whether it is made of bytes.
    pub(crate) bytes: bool,
    /// One note a field.
    pub(crate) notes: Vec<Note>,
}

impl Explained {
    pub(crate) fn new(bits: Bits<'_>, bytes: bool, notes: Vec<Note>) -> Self {
        Self {
            bits: (0..bits.len()).map(|index| bits.bit(index)).collect(),
            bytes,
            notes,
        }
    }

    fn note_at(&self, index: usize) -> Option<usize> {
        self.notes
            .iter()
            .position(|note| note.spans.iter().any(|span| span.contains(index)))
    }
}

/// A field's name for people.
fn spaced(name: &str) -> String {
    name.replace('_', " ")
}

/// Bits and fields of a frame.
#[component]
pub(crate) fn FrameView(frame: Explained) -> impl IntoView {
    let lit = RwSignal::new(None::<usize>);
    let cell = |index: usize| {
        let note = frame.note_at(index);
        let class = note.map_or("none", |note| frame.notes[note].class.name());
        let field = note.map_or("", |note| frame.notes[note].name);
        let first = index == 0 || frame.note_at(index - 1) != note;
        view! {
            <button
                class=format!("bit {class}")
                class:lit=move || note.is_some() && lit.get() == note
                class:first=first
                data-testid="explain-bit"
                data-field=field
                data-index=index
                aria-label=format!("bit {index}, {}", spaced(field))
                on:mouseenter=move |_| lit.set(note)
                on:focus=move |_| lit.set(note)
                on:mouseleave=move |_| lit.set(None)
                on:blur=move |_| lit.set(None)
            >
                {u8::from(frame.bits[index])}
            </button>
        }
    };
    let len = frame.bits.len();
    let cells = if frame.bytes {
        let octet = |at: usize| view! { <span class="octet">{(at..at + 8).map(cell).collect_view()}</span> };
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
fn FieldRow(index: usize, note: Note, lit: RwSignal<Option<usize>>) -> impl IntoView {
    let width: usize = note.spans.iter().map(|span| span.len).sum();
    let value = match width {
        0..=8 => format!("{:0width$b}", note.raw),
        _ => grouped(note.raw),
    };
    let set: Vec<_> = note.bits.into_iter().filter(|bit| bit.set).collect();
    // Bits that are set explain themselves.
    let text = set.is_empty().then(|| view! { <p>{note.text}</p> });
    let set = set
        .into_iter()
        .map(|bit| view! { <p><b>{bit.name}</b> ": " {bit.doc}</p> })
        .collect_view();
    view! {
        <li
            class=format!("field {}", note.class.name())
            class:lit=move || lit.get() == Some(index)
            class:faulty=note.fault.is_some()
            data-testid="explain-field"
            data-field=note.name
            data-value=note.raw.to_string()
            tabindex="0"
            on:mouseenter=move |_| lit.set(Some(index))
            on:focus=move |_| lit.set(Some(index))
            on:mouseleave=move |_| lit.set(None)
            on:blur=move |_| lit.set(None)
        >
            <span class="name">{spaced(note.name)}</span>
            <span class="raw">{value} <small>" · " {width} " bit"</small></span>
            <div class="says">
                {text}
                {set}
                {note.fault.map(|fault| view! { <p class="fault">{fault.kind.to_string()}</p> })}
                <p class="doc">{note.doc}</p>
            </div>
        </li>
    }
}
