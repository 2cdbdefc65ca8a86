//! Order codes: read, corrected and composed.

mod composer;

use super::Topic;
use crate::{
    app::App,
    reference::{
        Scroll,
        book::{self, Book, Leaf, filled_link},
        calculator::CopyLink,
    },
};
use composer::{Composer, form_of};
use encoderscope::{
    explain::grouped,
    format::Link,
    language::{msg, number, t},
    model::{self, FORMS, Form, Look, Model, ModelError, Place, RULES, Turns},
    product::{
        Interface, Series,
        facts::{CURRENT, SUPPLY},
    },
    text,
};
use encoderscope_web::link::query;
use leptos::prelude::*;

/// The name of the code in links.
const CODE: &str = "code";

#[component]
pub(super) fn Page() -> impl IntoView {
    let book = expect_context::<App>().book();
    let code = Memo::new(move |_| book.entry(CODE).unwrap_or_default());
    let looks = Memo::new(move |_| match code.get().trim() {
        "" => Vec::new(),
        code => model::look(code),
    });
    let model = Memo::new(move |_| model::parse(&code.get()));
    let fault = move || {
        let error = model.with(|model| model.as_ref().err().cloned())?;
        (!looks.with(Vec::is_empty)).then_some(error)
    };
    let meaning = move || match model.get() {
        Ok(model) => Some(view! { <Meaning model=model /> }),
        Err(_) => None,
    };
    view! {
        <section class="part" aria-label=t("The code")>
            <label class="order-code">
                {t("Order code")}
                <input
                    data-testid="order-code"
                    placeholder="MPP-20-30-A-24BM-R-N-A-M"
                    autocapitalize="characters"
                    spellcheck="false"
                    autocomplete="off"
                    aria-describedby="order-hint"
                    aria-invalid=move || fault().map(|_| "true")
                    prop:value=code
                    on:input:target=move |event| write(book, &event.target().value())
                />
            </label>
            <p class="hint" id="order-hint">
                {t("As it stands on the label: small letters, spaces, any dash and Cyrillic letters are fine.")}
            </p>
            <div aria-live="polite">
                {move || fault().map(|error| view! {
                    <p class="fault" data-testid="order-fault" data-position=error.position.to_string()>
                        {sentence(&error)}
                    </p>
                })}
            </div>
            {move || match looks.get() {
                looks if looks.is_empty() => view! { <Examples /> }.into_any(),
                looks => view! { <Parts looks=looks /> }.into_any(),
            }}
        </section>
        {meaning}
        <Composer looks=looks />
        <Legend looks=looks />
        <CopyLink />
    }
}

fn write(book: Book, code: &str) {
    match code.is_empty() {
        true => book.clear(CODE),
        false => book.enter(CODE, code),
    }
}

fn sentence(error: &ModelError) -> String {
    text!("Part {}: {}.", error.position, error.message)
}

fn code_link(code: &str) -> String {
    filled_link(Leaf::Topic(Topic::OrderCode), &[(CODE, code)])
}

#[component]
fn Examples() -> impl IntoView {
    let examples = FORMS.iter().map(|form| {
        let texts = form.example.iter().filter(|text| !text.is_empty());
        let code = texts.copied().collect::<Vec<_>>().join("-");
        view! { <li><a href=code_link(&code)><code>{code.clone()}</code></a></li> }
    });
    view! {
        <p>{t("Such as:")}</p>
        <ul class="order-examples">{examples.collect_view()}</ul>
    }
}

/// Every part of the code, with what it means or what fits there.
#[component]
fn Parts(looks: Vec<Look>) -> impl IntoView {
    let rows = looks.into_iter().zip(1..).map(|(look, position)| {
        let name = look.part.map_or("", |part| part.place.name());
        let (state, sign, said) = match look.fault {
            None => ("true", "", look.doc),
            Some(fault) if look.text.is_empty() => ("missing", "", fault),
            Some(fault) => ("false", "✗ ", fault),
        };
        view! {
            <tr data-testid="order-part" data-position=position.to_string() data-ok=state>
                <td>{position}</td>
                <td class="text"><b>{match look.text.as_str() {
                    "" => "–".to_owned(),
                    text => text.to_owned(),
                }}</b></td>
                <th scope="row">{name}</th>
                <td class="words said">{sign} {said}</td>
            </tr>
        }
    });
    view! {
        <Scroll label=t("Parts of the code").to_owned()>
            <table class="order-parts">
                <caption class="unseen">{t("Parts of the code")}</caption>
                <thead>
                    <tr>
                        <th scope="col">{t("part")}</th>
                        <th scope="col">{t("text")}</th>
                        <th scope="col">{t("what it is")}</th>
                        <th scope="col">{t("what it means")}</th>
                    </tr>
                </thead>
                <tbody>{rows.collect_view()}</tbody>
            </table>
        </Scroll>
    }
}

/// What follows from a code.
#[component]
fn Meaning(model: Model) -> impl IntoView {
    let rows = conclusions(&model).into_iter().map(|(name, value, note)| {
        view! {
            <tr data-testid="order-meaning" data-name=name>
                <th scope="row">{t(name)}</th>
                <td class="words">{value}</td>
                <td class="words doc">{note}</td>
            </tr>
        }
    });
    let notes = model.notes().into_iter();
    view! {
        <section class="part" aria-labelledby="order-meaning">
            <h2 id="order-meaning">{t("What it means")}</h2>
            {notes.map(|note| view! { <p class="order-note">{note}</p> }).collect_view()}
            <Doors model=model.clone() />
            <Scroll label=t("What it means").to_owned()>
                <table class="order-meaning">
                    <caption class="unseen">{t("What it means")}</caption>
                    <tbody>{rows.collect_view()}</tbody>
                </table>
            </Scroll>
            <p class="source">{t("Source: ")} {t(model.form.source)}</p>
        </section>
    }
}

/// Where to go with it.
#[component]
fn Doors(model: Model) -> impl IntoView {
    let profile = model.profile;
    let query = query(&profile);
    let series = model.series.map(Series::key);
    let wiring = series.map(|series| {
        let mut entries = vec![("series", series), ("interface", model.interface.key())];
        if model.has_battery() {
            entries.push(("battery", "yes"));
        }
        filled_link(Leaf::Topic(Topic::Wiring), &entries)
    });
    let products =
        series.map(|series| filled_link(Leaf::Topic(Topic::Products), &[("series", series)]));
    let door = |name: &'static str, href: String, title: &'static str| {
        view! { <a class="button" data-testid="order-door" data-name=name href=href>{title}</a> }
    };
    view! {
        <p class="doors">
            {profile.is_serial().then(|| door("console", format!("#/console?{query}"), t("Read one")))}
            {door("decode", format!("#/decode?{query}"), t("Decode a dump"))}
            {door("format", book::link(&profile, None), t("Its frames"))}
            {wiring.map(|href| door("wiring", href, t("Wiring")))}
            {products.map(|href| door("products", href, t("Characteristics")))}
        </p>
    }
}

/// What follows, with what to know about it.
fn conclusions(model: &Model) -> Vec<(&'static str, String, String)> {
    let profile = &model.profile;
    let fact = |name| model.series.and_then(|series| series.fact(name));
    let mut rows = vec![
        ("series", t(model.series_name()).to_owned(), String::new()),
        (
            "interface",
            t(model.interface.title()).to_owned(),
            t(profile.source()).to_owned(),
        ),
        (
            msg("bits per turn"),
            profile.angle_bits.to_string(),
            String::new(),
        ),
        (msg("turns"), turns(model), String::new()),
    ];
    if profile.is_serial() {
        rows.push((
            msg("baud rate"),
            grouped(profile.baud.into()),
            t("8 bits, no parity, 1 stop bit").to_owned(),
        ));
    }
    rows.push(match model.frame_bits() {
        Some(bits) => (
            msg("frame"),
            match profile.is_serial() {
                true => text!("{} bytes", bits / 8),
                false => text!("{} bits", bits),
            },
            match model.interface {
                Interface::BissC => {
                    t("from the turns or the angle to the CRC, without acknowledge, start and zero")
                        .to_owned()
                }
                _ => t("the reply that is read most").to_owned(),
            },
        ),
        None => (
            msg("frame"),
            t("a line of text").to_owned(),
            t("as long as its number").to_owned(),
        ),
    });
    let requests = model.requests();
    if !requests.is_empty() {
        let list = requests.iter().map(|request| {
            let sign = if request.changes_encoder { " *" } else { "" };
            format!("0x{:02X} {}{sign}", request.byte, t(request.title))
        });
        rows.push((
            msg("requests"),
            list.collect::<Vec<_>>().join(", "),
            t("* changes what the encoder holds").to_owned(),
        ));
    }
    rows.push((
        msg("changed by command"),
        match (
            model.changes_by_command(),
            model.interface.format().spec().link,
        ) {
            (true, _) => t("yes").to_owned(),
            (false, Link::Stream) => t("no: it only sends").to_owned(),
            (false, _) => t("no: it is only clocked").to_owned(),
        },
        String::new(),
    ));
    for name in [SUPPLY, CURRENT, "battery"] {
        if let Some(fact) = fact(name)
            && (name != "battery" || model.has_battery())
        {
            rows.push((name, t(fact.value).to_owned(), t(fact.source).to_owned()));
        }
    }
    if let Some((least, most)) = model.temperature() {
        let said = format!("{}…{most} °C", least.to_string().replace('-', "−"));
        rows.push((msg("working temperature"), said, String::new()));
    }
    if let Some(size) = model.size() {
        rows.push((
            msg("stator"),
            text!(
                "⌀ {} mm, screws on ⌀ {} mm",
                size.stator_diameter(),
                number(size.stator_circle)
            ),
            t("the size table has the rest").to_owned(),
        ));
        rows.push((msg("connector"), size.connector().to_owned(), String::new()));
    }
    if let Some(logic) = model.token(Place::Logic) {
        rows.push((
            msg("logic"),
            logic.doc(),
            t("P+F article, table 6").to_owned(),
        ));
    }
    rows
}

fn turns(model: &Model) -> String {
    let bits = model.profile.turns_bits;
    let kept = match model.turns {
        Turns::Single => return t("not counted").to_owned(),
        Turns::Powered => t("0 again after the power was off"),
        Turns::Battery => t("counted on the battery while the power is off"),
        Turns::Flash => t("kept in flash; without power the shaft may turn by ±90° at most"),
        Turns::Gear => t("by a mechanical gear, with or without power"),
    };
    text!("{} bits, {}", bits, kept)
}

/// All that can stand in a code of the form that is open.
#[component]
fn Legend(looks: Memo<Vec<Look>>) -> impl IntoView {
    let form = Memo::new(move |_| looks.with(|looks| form_of(looks)));
    let rows = move || {
        let parts = form.get().parts.iter().zip(1..);
        parts
            .flat_map(|(part, position)| {
                let words = part.words.iter().enumerate();
                words.map(move |(index, word)| {
                    let text = match (part.number, word.text) {
                        (None, "") => t("nothing").to_owned(),
                        (None, text) => text.to_owned(),
                        (Some((least, most, _)), text) => format!("{least}{text} … {most}{text}"),
                    };
                    let unit = part.number.map_or("", |(_, _, unit)| t(unit));
                    let doc = match t(word.doc) {
                        "" => unit.to_owned(),
                        doc if unit.is_empty() => doc.to_owned(),
                        doc => format!("{unit}, {doc}"),
                    };
                    let (position, name) = match index {
                        0 => (position.to_string(), part.place.name()),
                        _ => (String::new(), ""),
                    };
                    view! {
                        <tr data-testid="order-legend">
                            <td>{position}</td>
                            <td class="words">{name}</td>
                            <td>{text}</td>
                            <td class="words">{doc}</td>
                        </tr>
                    }
                })
            })
            .collect_view()
    };
    view! {
        <section class="part" aria-labelledby="order-legend">
            <h2 id="order-legend">{t("All that a code can say")}</h2>
            <Scroll label=t("All that a code can say").to_owned()>
                <table>
                    <caption>{move || format!("{}: {}", t(form.get().title), t(form.get().source))}</caption>
                    <thead>
                        <tr>
                            <th scope="col">{t("part")}</th>
                            <th scope="col">{t("what it is")}</th>
                            <th scope="col">{t("text")}</th>
                            <th scope="col">{t("what it means")}</th>
                        </tr>
                    </thead>
                    <tbody>{rows}</tbody>
                </table>
            </Scroll>
            {move || has_rules(form.get()).then(|| view! {
                <ul class="order-rules">
                    {RULES.map(|rule| view! { <li>{t(rule)}</li> }).into_view()}
                </ul>
            })}
        </section>
    }
}

/// Whether there are parts of a form that do not go together.
fn has_rules(form: &Form) -> bool {
    let mut parts = form.parts.iter();
    parts.any(|part| part.place == Place::Resolution)
}
