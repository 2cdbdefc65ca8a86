//! The checks, bit by bit.

use super::paper::{FieldPlan, Lit, Paper};
use crate::app::App;
use encoderscope::{check::Walk, language::t, text};
use leptos::prelude::*;

/// One panel a check of the frame.
#[component]
pub(super) fn Checks() -> impl IntoView {
    let paper = expect_context::<App>().paper();
    move || {
        let plan = paper.plan.get();
        let checks = plan.fields.into_iter().filter(|field| field.is_check);
        checks
            .map(|field| view! { <CheckPanel field=field /> })
            .collect_view()
    }
}

/// A number in binary digits.
fn binary(value: u64, width: u32) -> String {
    format!("{value:0width$b}", width = width as usize)
}

#[component]
fn CheckPanel(field: FieldPlan) -> impl IntoView {
    let name = field.name;
    let paper = expect_context::<App>().paper();
    let look = move || {
        paper.with(|sketch| {
            let layout = &sketch.kind().layout;
            let field = sketch.field(name)?;
            let walk = layout.walk(field, sketch.bits())?;
            let checked = layout.checked(field, sketch.bits())?;
            let (sum, _) = field.cover?;
            Some((walk, checked.received, sum.name()))
        })
    };
    let walk = Memo::new(move |_| look().flatten());
    let step = RwSignal::new(0usize);
    let count = move || walk.with(|walk| walk.as_ref().map_or(0, |(walk, ..)| walk.steps.len()));
    let go = move |to: usize| {
        step.set(to);
        let at = walk.with_untracked(|walk| {
            let (walk, ..) = walk.as_ref()?;
            Some(walk.steps.get(to.checked_sub(1)?)?.at)
        });
        paper.lit.set(at.map(Lit::Bit));
    };
    let sum = walk.with_untracked(|walk| walk.as_ref().map_or("", |(.., name)| *name));
    let body = move || {
        let (walk, received, _) = walk.get()?;
        let width = walk.algorithm.width;
        let good = walk.result == received;
        Some(view! {
            <p class="covers">{t("covers ")} {covered(paper, &walk)} {text!(" = {} bits", walk.steps.len())}</p>
            <p class="outcome">
                {ending(&walk)}
                <b data-testid="explain-result" data-value=walk.result.to_string()>{binary(walk.result, width)}</b>
                {match good {
                    true => view! { <span class="good">{t(" = received ✓")}</span> }.into_any(),
                    false => view! {
                        <span class="bad">{t(" ≠ received ")} <b>{binary(received, width)}</b></span>
                    }.into_any(),
                }}
            </p>
        })
    };
    let now = move || {
        let (walk, ..) = walk.get()?;
        let at = step.get().min(walk.steps.len());
        Some(stage(paper, &walk, at))
    };
    view! {
        <section class="panel walk" data-testid="explain-check" data-field=field.plain()>
            <h2>{field.title().to_uppercase()} <span>{t(sum)}</span></h2>
            {body}
            <label class="steps">
                <span class="hint">{move || text!("Step {} of {}", step.get().min(count()), count())}</span>
                <input
                    type="range"
                    min="0"
                    max=move || count().to_string()
                    data-testid="explain-step"
                    prop:value=move || step.get().to_string()
                    on:input:target=move |event| go(event.target().value().parse().unwrap_or(0))
                />
            </label>
            {now}
        </section>
    }
}

/// The names of the fields that go in, in order.
fn covered(paper: Paper, walk: &Walk) -> impl IntoView + use<> {
    let plan = paper.plan.get();
    let mut order = Vec::new();
    for step in &walk.steps {
        let field = plan.cells.get(step.at).copied().flatten();
        if let Some(field) = field.filter(|field| !order.contains(field)) {
            order.push(field);
        }
    }
    let names = order.into_iter().filter_map(|index| plan.fields.get(index));
    names
        .map(|field| {
            view! { <span class=format!("name {}", field.class.name())>{field.title()}</span> " " }
        })
        .collect_view()
}

/// What becomes of the register at the end.
fn ending(walk: &Walk) -> String {
    let algorithm = &walk.algorithm;
    let last = walk.steps.last().map_or(walk.start, |step| step.register);
    let remainder = binary(last, algorithm.width);
    let mut text = text!("remainder {} → ", remainder);
    if algorithm.refout {
        text += t("read backwards ");
    }
    if algorithm.xorout != 0 {
        let all = binary(algorithm.xorout, algorithm.width);
        text += match all.contains('0') {
            false => t("inverted "),
            true => t("changed "),
        };
    }
    text
}

/// One step: the register, the bit that comes in and the one that falls out.
fn stage(paper: Paper, walk: &Walk, at: usize) -> AnyView {
    let width = walk.algorithm.width;
    let Some(step) = at.checked_sub(1).and_then(|index| walk.steps.get(index)) else {
        return view! {
            <p class="walk-step">{t("The register begins at ")} <b class="register">{binary(walk.start, width)}</b> "."</p>
        }
        .into_any();
    };
    let before = at
        .checked_sub(2)
        .and_then(|index| walk.steps.get(index))
        .map_or(walk.start, |step| step.register);
    let digits = binary(before, width);
    let (out, kept) = digits.split_at(1);
    let field = paper.plan.with(|plan| {
        let field = plan.cells.get(step.at).copied().flatten();
        let name = field.and_then(|field| Some(plan.fields.get(field)?.title()));
        name.unwrap_or_default()
    });
    let subtracted = format!("1{}", binary(walk.algorithm.polynomial, width));
    let does = match step.subtracts {
        true => text!("they differ: {} is subtracted", subtracted),
        false => t("they are equal: nothing is subtracted").into(),
    };
    view! {
        <div class="walk-step">
            <p>
                {t("Out falls ")} <b>{out.to_owned()}</b> {text!(", bit {} of {} is ", step.at, field)}
                <b>{u8::from(step.bit)}</b> "; " {does} "."
            </p>
            <p class="register">
                <s>{out.to_owned()}</s> {kept.to_owned()} " → "
                <b data-testid="explain-register">{binary(step.register, width)}</b>
            </p>
        </div>
    }
    .into_any()
}
