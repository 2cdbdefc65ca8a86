//! A calculator: what it needs, and what follows. All of it is out of the core's tables.

use super::{Scroll, book::Book};
use crate::{
    app::App,
    handout::{copy, save_text},
};
use encoderscope::{
    calculator::{Answer, Calculator, Code, Fault, Input, Kind, Outcome, Tone},
    language::t,
    text,
};
use leptos::prelude::*;

#[component]
pub(super) fn Page(calculator: &'static Calculator) -> impl IntoView {
    let book = expect_context::<App>().book();
    let outcome = Memo::new(move |_| work(calculator, book));
    let inputs = calculator
        .inputs
        .iter()
        .map(|input| view! { <Field input=input outcome=outcome /> });
    view! {
        <article class="sheet" data-testid="calculator" data-name=calculator.name>
            <header class="head">
                <h1>{t(calculator.title)}</h1>
                <p class="about">{t(calculator.about)}</p>
            </header>
            <section class="part" aria-label=t("What is given")>
                <div class="form">{inputs.collect_view()}</div>
            </section>
            <section class="part" aria-label=t("What follows") aria-live="polite">
                {move || match outcome.get() {
                    Ok(outcome) => view! { <Answers outcome=outcome /> }.into_any(),
                    Err(fault) => view! {
                        <p class="fault" data-testid="calculator-fault" data-input=fault.input>
                            {sentence(&fault)}
                        </p>
                    }.into_any(),
                }}
            </section>
            <p class="source">{t("Source: ")} {t(calculator.source)}</p>
            <CopyLink />
        </article>
    }
}

fn work(calculator: &Calculator, book: Book) -> Result<Outcome, Fault> {
    let entered: Vec<_> = calculator
        .inputs
        .iter()
        .map(|input| (input.name, book.entry(input.name)))
        .collect();
    calculator.work(|name| {
        let found = entered.iter().find(|(known, _)| *known == name);
        found.and_then(|(_, text)| text.as_deref())
    })
}

/// What is wrong, as a sentence.
pub(super) fn sentence(fault: &Fault) -> String {
    let mut letters = fault.message.chars();
    let first = letters.next().map(char::to_uppercase);
    first
        .into_iter()
        .flatten()
        .chain(letters)
        .chain(['.'])
        .collect()
}

/// One input. What is the default is no part of the link.
#[component]
fn Field(input: &'static Input, outcome: Memo<Result<Outcome, Fault>>) -> impl IntoView {
    let book = expect_context::<App>().book();
    let id = format!("input-{}", input.name);
    let hint = format!("{id}-hint");
    let value = move || book.entry(input.name).unwrap_or(input.default.to_owned());
    let enter = move |text: String| match text == input.default {
        true => book.clear(input.name),
        false => book.enter(input.name, &text),
    };
    let wrong = move || {
        let fault = outcome.with(|outcome| outcome.as_ref().err().map(|fault| fault.input));
        (fault == Some(input.name)).then_some("true")
    };
    let control = match input.kind {
        Kind::Word(words) => view! {
            <select
                id=id.clone()
                data-testid="calculator-input"
                data-name=input.name
                aria-describedby=hint.clone()
                on:change:target=move |event| enter(event.target().value())
            >
                {words
                    .iter()
                    .map(|word| view! {
                        <option value=word.name selected=move || value() == word.name>{t(word.title)}</option>
                    })
                    .collect_view()}
            </select>
        }.into_any(),
        Kind::Number { .. } => view! {
            <input
                id=id.clone()
                data-testid="calculator-input"
                data-name=input.name
                aria-describedby=hint.clone()
                aria-invalid=wrong
                inputmode="decimal"
                spellcheck="false"
                autocomplete="off"
                prop:value=value
                on:input:target=move |event| enter(event.target().value())
            />
        }.into_any(),
    };
    view! {
        <div class="asked">
            <label for=id>{t(input.title)}</label>
            <span class="entered">{control} <span class="unit">{input.unit_title()}</span></span>
            <p class="hint" id=hint>{t(input.doc)}</p>
        </div>
    }
}

#[component]
fn Answers(outcome: Outcome) -> impl IntoView {
    let rows = outcome.answers.into_iter().map(answer);
    let code = outcome.code.map(|code| view! { <Program code=code /> });
    view! {
        <Scroll label=t("Answers").to_owned()>
            <table class="answers">
                <caption class="unseen">{t("Answers")}</caption>
                <thead class="unseen">
                    <tr>
                        <th scope="col">{t("what")}</th>
                        <th scope="col">{t("answer")}</th>
                        <th scope="col">{t("to know")}</th>
                    </tr>
                </thead>
                <tbody>{rows.collect_view()}</tbody>
            </table>
        </Scroll>
        {code}
    }
}

/// A program with the answers filled in.
#[component]
fn Program(code: Code) -> impl IntoView {
    let said = RwSignal::new(None::<String>);
    let (copied, saved) = (code.text.clone(), code.text.clone());
    view! {
        <div class="program">
            <h2>{t(code.title)}</h2>
            <Scroll label=t(code.title).to_owned()>
                <pre data-testid="calculator-code">{code.text}</pre>
            </Scroll>
            <p class="doors">
                <button
                    data-testid="copy-code"
                    on:click=move |_| copy(copied.clone(), said, t("Program copied."))
                >
                    {t("Copy the program")}
                </button>
                <button data-testid="save-code" on:click=move |_| save_text(&saved, code.file)>
                    {text!("Save as {}", code.file)}
                </button>
                <span role="status" class="hint">{move || said.get()}</span>
            </p>
        </div>
    }
}

fn answer(answer: Answer) -> impl IntoView {
    let (tone, sign) = match answer.tone {
        Tone::Plain => ("", ""),
        Tone::Good => ("good", "✓ "),
        Tone::Warn => ("warn", "! "),
        Tone::Bad => ("bad", "✗ "),
    };
    let is_said = answer.number.is_none();
    view! {
        <tr
            data-testid="calculator-answer"
            data-name=answer.name
            data-value=answer.number.map(|number| number.to_string())
        >
            <th scope="row">{answer.title}</th>
            <td class=format!("answer {}", tone) class:words=is_said>{sign} {answer.text}</td>
            <td class="words doc">{answer.note}</td>
        </tr>
    }
}

/// Copies the link to the page as it is filled in.
#[component]
pub(super) fn CopyLink() -> impl IntoView {
    let app = expect_context::<App>();
    let said = RwSignal::new(None::<String>);
    view! {
        <p class="doors">
            <button
                data-testid="copy-link"
                on:click=move |_| copy(untrack(|| app.address()), said, t("Link copied."))
            >
                {t("Copy link")}
            </button>
            <span role="status" class="hint">{move || said.get()}</span>
        </p>
    }
}
