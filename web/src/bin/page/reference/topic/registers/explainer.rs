//! One register: its value, its bits to turn over, and what they say.

use crate::app::App;
use encoderscope::{
    apci1710::{Register, WORD_BITS},
    bits,
    explain::Note,
    language::t,
    layout::Class,
    text,
};
use leptos::prelude::*;

/// A register; `name` is that of its entry in the link.
#[component]
pub(super) fn Explainer(
    register: Register,
    name: &'static str,
    text: Memo<String>,
    value: Memo<Result<u32, String>>,
    notes: Memo<Vec<Note>>,
    #[prop(optional)] children: Option<Children>,
) -> impl IntoView {
    let book = expect_context::<App>().book();
    let id = format!("register-{name}");
    let fault = move || {
        let fault = value.get().err();
        fault.map(|fault| view! { <p class="fault" data-testid="register-fault">{fault}</p> })
    };
    let heading = match register {
        Register::Shift(_) => "SHIFT",
        other => other.title(),
    };
    let width = register.width();
    let bits = (0..width).map(|at| {
        view! { <Bit register=register name=name at=at text=text value=value notes=notes /> }
    });
    let mut bits: Vec<_> = bits.collect();
    let mut octets = Vec::new();
    while !bits.is_empty() {
        let rest = bits.split_off(bits.len().min(8));
        octets.push(view! { <div class="octet">{bits}</div> });
        bits = rest;
    }
    view! {
        <section
            class="part register-part"
            data-testid="register"
            data-name=name
            data-value=move || value.get().ok().map(|value| value.to_string())
            aria-labelledby=format!("{id}-title")
        >
            <h2 id=format!("{id}-title")>{heading}</h2>
            <p class="hint">{register.layout().title()} "."</p>
            {children.map(|children| children())}
            <div class="asked">
                <label for=id.clone()>{t("Value")}</label>
                <span class="entered">
                    <input
                        id=id.clone()
                        data-testid="register-value"
                        spellcheck="false"
                        autocomplete="off"
                        prop:value=text
                        aria-invalid=move || value.get().is_err().then_some("true")
                        on:input:target=move |event| book.enter(name, &event.target().value())
                    />
                </span>
                <p class="hint">{t("decimal, or behind 0x or 0b")}</p>
            </div>
            {fault}
            <div
                class="bits bytes big"
                role="group"
                aria-label=text!("Bits of {}; a click turns one over", heading)
            >
                {octets}
            </div>
            <ul class="fields">{move || notes.get().into_iter().map(field).collect_view()}</ul>
        </section>
    }
}

/// One bit; a click turns it over.
#[component]
fn Bit(
    register: Register,
    name: &'static str,
    at: usize,
    text: Memo<String>,
    value: Memo<Result<u32, String>>,
    notes: Memo<Vec<Note>>,
) -> impl IntoView {
    let book = expect_context::<App>().book();
    let width = register.width();
    let place = u32::try_from(width - 1 - at).unwrap_or(WORD_BITS);
    let is_set = Memo::new(move |_| {
        let value = value.get();
        value.is_ok_and(|value| bits::bit(value.into(), place))
    });
    let of = Memo::new(move |_| {
        notes.with(|notes| {
            let mut notes = notes.iter();
            let mine = notes.find(|note| note.spans.iter().any(|span| span.contains(at)));
            mine.map(|note| (note.class, title(note)))
        })
    });
    let class = move || {
        let class = of.get().map_or("none", |(class, _)| Class::name(class));
        format!("bit {class}")
    };
    let label = move || {
        let field = of.get().map(|(_, title)| title).unwrap_or_default();
        format!("D{place}, {field}, {}", u8::from(is_set.get()))
    };
    let flip = move |_| {
        if let Ok(value) = value.get_untracked() {
            let turned = value ^ u32::try_from(bits::placed(1, place)).unwrap_or(0);
            book.enter(name, &written(turned, &text.get_untracked(), width));
        }
    };
    view! {
        <button
            class=class
            data-testid="register-bit"
            data-index=place
            data-value=move || u8::from(is_set.get()).to_string()
            aria-label=label
            aria-pressed=move || is_set.get().to_string()
            title=move || of.get().map(|(_, title)| format!("D{place} {title}"))
            disabled=move || value.get().is_err()
            on:click=flip
        >
            {move || u8::from(is_set.get())}
        </button>
    }
}

/// A value in the base of the text that was there before.
fn written(value: u32, before: &str, width: usize) -> String {
    match before.trim().get(..2) {
        Some("0b" | "0B") => format!("0b{value:0width$b}"),
        Some("0x" | "0X") => format!("0x{value:0digits$X}", digits = width.div_ceil(4)),
        _ => value.to_string(),
    }
}

fn title(note: &Note) -> String {
    t(note.name).replace('_', " ")
}

fn field(note: Note) -> impl IntoView {
    let spans = note.spans.iter().map(|span| span.len).sum::<usize>();
    view! {
        <li
            class=format!("field {}", note.class.name())
            class:faulty=note.fault.is_some()
            data-testid="register-field"
            data-name=note.name
            data-value=note.raw.to_string()
        >
            <span class="name">{title(&note)}</span>
            <span class="raw">
                {text!("{} {0|bit|bits}", spans)}
            </span>
            <div class="says">
                <p>{note.text}</p>
                <p class="doc">{note.doc}</p>
                {note.fault.map(|fault| view! { <p class="fault">{fault.kind.to_string()}</p> })}
            </div>
        </li>
    }
}
