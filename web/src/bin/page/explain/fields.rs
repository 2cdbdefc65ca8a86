//! The fields: what each is and says, to point at and to write into.

use super::paper::{FieldPlan, Lit};
use crate::app::App;
use encoderscope::{
    explain::{BitNote, Note, degrees_text},
    language::{number, t},
    layout::Class,
    sketch::Sketch,
    text,
};
use leptos::prelude::*;

#[component]
pub(super) fn Fields() -> impl IntoView {
    let paper = expect_context::<App>().paper();
    // One explanation for all rows.
    let notes = Memo::new(move |_| paper.with(Sketch::notes).unwrap_or_default());
    let rows = move || {
        let plan = paper.plan.get();
        let row = |(index, field)| view! { <FieldRow index=index field=field notes=notes /> };
        plan.fields.into_iter().enumerate().map(row).collect_view()
    };
    view! {
        <section class="panel">
            <h2>{t("Fields")}</h2>
            <ul class="fields" on:mouseleave=move |_| paper.lit.set(None)>{rows}</ul>
        </section>
    }
}

#[component]
fn FieldRow(index: usize, field: FieldPlan, notes: Memo<Vec<Note>>) -> impl IntoView {
    let paper = expect_context::<App>().paper();
    let note = Memo::new(move |_| notes.with(|notes| notes.get(index).cloned()));
    let with = move |look: fn(&Note) -> String| note.with(|note| note.as_ref().map(look));
    let text = move || with(|note| note.text.clone());
    let fault = move || {
        let fault = note.with(|note| note.as_ref().and_then(|note| note.fault));
        fault.map(|fault| view! { <p class="fault">{fault.kind.to_string()}</p> })
    };
    let named = note.with_untracked(|note| {
        let bits = note.as_ref().map(|note| note.bits.clone());
        bits.unwrap_or_default()
    });
    let named: Vec<_> = named
        .into_iter()
        .enumerate()
        .map(|(place, bit)| view! { <NamedBit place=place bit=bit note=note /> })
        .collect();
    let doc = with(|note| note.doc.clone()).unwrap_or_default();
    let point = move |_| paper.lit.set(Some(Lit::Field(index)));
    view! {
        <li
            id=format!("field-{}", field.name)
            class=format!("field {}", field.class.name())
            class:lit=move || paper.is_field_lit(index)
            class:faulty=move || note.with(|note| note.as_ref().is_some_and(|note| note.fault.is_some()))
            data-testid="explain-field"
            data-field=field.plain()
            data-value=move || with(|note| note.raw.to_string())
            on:mouseenter=point
            on:focusin=move |_| paper.lit.set(Some(Lit::Field(index)))
        >
            <span class="name">{field.title()}</span>
            <span class="raw">
                <Entry field=field.clone() note=note />
                <small>{text!(" · {} bit", field.width)}</small>
            </span>
            <div class="says">
                <p data-testid="explain-text">{text}</p>
                {(!named.is_empty()).then(|| view! { <div class="named-bits">{named}</div> })}
                {fault}
                <p class="doc">{doc}</p>
            </div>
        </li>
    }
}

/// A named bit of a field, to switch on and off.
#[component]
fn NamedBit(place: usize, bit: BitNote, note: Memo<Option<Note>>) -> impl IntoView {
    let paper = expect_context::<App>().paper();
    let set = move || {
        note.with(|note| {
            let bits = note.as_ref().map(|note| &note.bits);
            bits.and_then(|bits| bits.get(place))
                .is_some_and(|bit| bit.set)
        })
    };
    let at = bit.at;
    view! {
        <label class="check-box" title=bit.doc>
            <input
                type="checkbox"
                data-testid="explain-named"
                data-value=bit.name
                prop:checked=set
                on:change=move |_| {
                    paper.change(|sketch, checks| sketch.flip(at, checks));
                }
                on:focus=move |_| paper.lit.set(Some(Lit::Bit(at)))
            />
            {t(bit.name)}
        </label>
        {move || set().then(|| view! { <span class="doc">{bit.doc}</span> })}
    }
}

/// The value of a field, to type over.
#[component]
fn Entry(field: FieldPlan, note: Memo<Option<Note>>) -> impl IntoView {
    let paper = expect_context::<App>().paper();
    let refusal = RwSignal::new(None::<String>);
    let name = field.name;
    let enter = move |text: String| {
        let done = paper.change(|sketch, checks| sketch.enter(name, &text, checks));
        refusal.set(done.and_then(Result::err).map(|why| why.to_string()));
        paper.sketch.notify();
    };
    let value = move || {
        // Typed numbers that are refused are replaced by what is there.
        let _ = note.get();
        paper.with(|sketch| sketch.entry(name)).flatten()
    };
    let degrees = move || {
        paper.with(|sketch| {
            let layout = &sketch.kind().layout;
            let raw = layout.read(sketch.field(name)?, sketch.bits());
            let bits = layout.shape.profile.angle_bits;
            Some(number(degrees_text(raw, bits, places(bits))).to_string())
        })
    };
    let is_angle = field.class == Class::Angle;
    view! {
        <input
            class="entry"
            spellcheck="false"
            autocomplete="off"
            aria-label=field.title()
            aria-invalid=move || refusal.get().is_some().to_string()
            data-testid="explain-entry"
            data-field=field.plain()
            prop:value=value
            on:change:target=move |event| enter(event.target().value())
        />
        {is_angle.then(|| view! {
            <label class="degrees">
                <input
                    class="entry"
                    inputmode="decimal"
                    autocomplete="off"
                    aria-label=t("angle in degrees")
                    data-testid="explain-degrees"
                    prop:value=move || degrees().flatten()
                    on:change:target=move |event| enter(event.target().value() + "°")
                />
                "°"
            </label>
        })}
        {move || refusal.get().map(|why| view! { <span class="fault" role="alert">{why}</span> })}
    }
}

/// Digits behind the point that tell neighbouring counts apart.
fn places(bits: u32) -> u32 {
    (bits / 3).clamp(1, 12)
}
