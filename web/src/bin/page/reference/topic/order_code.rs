//! Order codes: read, corrected and composed.

use super::Topic;
use crate::{
    app::App,
    reference::{
        Scroll,
        book::{self, Book, Leaf, filled_link},
        calculator::CopyLink,
    },
};
use encoderscope::{
    explain::grouped,
    format::Link,
    model::{self, FORMS, Form, Look, Model, ModelError, Place, Turns},
    product::{
        Interface, Series,
        facts::{CURRENT, SUPPLY},
    },
};
use encoderscope_web::link::query;
use leptos::prelude::*;

/// The name of the code in links.
const CODE: &str = "code";

#[component]
pub(super) fn Page() -> impl IntoView {
    let book = expect_context::<App>().book;
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
        <section class="part" aria-label="The code">
            <label class="order-code">
                "Order code"
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
                "As it stands on the label: small letters, spaces, any dash and Cyrillic letters are fine."
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
    format!("Part {}: {}.", error.position, error.message)
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
        <p>"Such as:"</p>
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
        <Scroll label="Parts of the code".to_owned()>
            <table class="order-parts">
                <caption class="unseen">"Parts of the code"</caption>
                <thead>
                    <tr>
                        <th scope="col">"part"</th>
                        <th scope="col">"text"</th>
                        <th scope="col">"what it is"</th>
                        <th scope="col">"what it means"</th>
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
                <th scope="row">{name}</th>
                <td class="words">{value}</td>
                <td class="words doc">{note}</td>
            </tr>
        }
    });
    let notes = model.notes().into_iter();
    view! {
        <section class="part" aria-labelledby="order-meaning">
            <h2 id="order-meaning">"What it means"</h2>
            {notes.map(|note| view! { <p class="order-note">{note}</p> }).collect_view()}
            <Doors model=model.clone() />
            <Scroll label="What it means".to_owned()>
                <table class="order-meaning">
                    <caption class="unseen">"What it means"</caption>
                    <tbody>{rows.collect_view()}</tbody>
                </table>
            </Scroll>
            <p class="source">"Source: " {model.form.source}</p>
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
            {profile.is_serial().then(|| door("console", format!("#/console?{query}"), "Read one"))}
            {door("decode", format!("#/decode?{query}"), "Decode a dump")}
            {door("format", book::link(&profile, None), "Its frames")}
            {wiring.map(|href| door("wiring", href, "Wiring"))}
            {products.map(|href| door("products", href, "Characteristics"))}
        </p>
    }
}

/// What follows, with what to know about it.
fn conclusions(model: &Model) -> Vec<(&'static str, String, String)> {
    let profile = &model.profile;
    let fact = |name| model.series.and_then(|series| series.fact(name));
    let mut rows = vec![
        ("series", model.series_name().to_owned(), String::new()),
        (
            "interface",
            model.interface.title().to_owned(),
            profile.source().to_owned(),
        ),
        (
            "bits per turn",
            profile.angle_bits.to_string(),
            String::new(),
        ),
        ("turns", turns(model), String::new()),
    ];
    if profile.is_serial() {
        rows.push((
            "baud rate",
            grouped(profile.baud.into()),
            "8 bits, no parity, 1 stop bit".to_owned(),
        ));
    }
    rows.push(match model.frame_bits() {
        Some(bits) => (
            "frame",
            match profile.is_serial() {
                true => format!("{} bytes", bits / 8),
                false => format!("{bits} bits"),
            },
            match model.interface {
                Interface::BissC => {
                    "from the turns or the angle to the CRC, without acknowledge, start and zero"
                        .to_owned()
                }
                _ => "the reply that is read most".to_owned(),
            },
        ),
        None => (
            "frame",
            "a line of text".to_owned(),
            "as long as its number".to_owned(),
        ),
    });
    let requests = model.requests();
    if !requests.is_empty() {
        let list = requests.iter().map(|request| {
            let sign = if request.changes_encoder { " *" } else { "" };
            format!("0x{:02X} {}{sign}", request.byte, request.title)
        });
        rows.push((
            "requests",
            list.collect::<Vec<_>>().join(", "),
            "* changes what the encoder holds".to_owned(),
        ));
    }
    rows.push((
        "changed by command",
        match (
            model.changes_by_command(),
            model.interface.format().spec().link,
        ) {
            (true, _) => "yes".to_owned(),
            (false, Link::Stream) => "no: it only sends".to_owned(),
            (false, _) => "no: it is only clocked".to_owned(),
        },
        String::new(),
    ));
    for name in [SUPPLY, CURRENT, "battery"] {
        if let Some(fact) = fact(name)
            && (name != "battery" || model.has_battery())
        {
            rows.push((name, fact.value.to_owned(), fact.source.to_owned()));
        }
    }
    if let Some((least, most)) = model.temperature() {
        let said = format!("{}…{most} °C", least.to_string().replace('-', "−"));
        rows.push(("working temperature", said, String::new()));
    }
    if let Some(size) = model.size() {
        rows.push((
            "stator",
            format!(
                "⌀ {} mm, screws on ⌀ {} mm",
                size.stator_diameter(),
                size.stator_circle
            ),
            "the size table has the rest".to_owned(),
        ));
        rows.push(("connector", size.connector().to_owned(), String::new()));
    }
    if let Some(logic) = model.token(Place::Logic) {
        rows.push(("logic", logic.doc(), "P+F article, table 6".to_owned()));
    }
    rows
}

fn turns(model: &Model) -> String {
    let bits = model.profile.turns_bits;
    let kept = match model.turns {
        Turns::Single => return "not counted".to_owned(),
        Turns::Powered => "0 again after the power was off",
        Turns::Battery => "counted on the battery while the power is off",
        Turns::Flash => "kept in flash; without power the shaft may turn by ±90° at most",
        Turns::Gear => "by a mechanical gear, with or without power",
    };
    format!("{bits} bits, {kept}")
}

/// A choice for every part, which writes the code.
#[component]
fn Composer(looks: Memo<Vec<Look>>) -> impl IntoView {
    let book = expect_context::<App>().book;
    let form = Memo::new(move |_| looks.with(|looks| form_of(looks)));
    let texts = Memo::new(move |_| looks.with(|looks| form.get().complete(looks)));
    let selects = move || {
        let form = form.get();
        let parts = form.parts.iter().enumerate();
        let is_series = |place| place == Place::Series;
        parts
            .filter(|(_, part)| !is_series(part.place))
            .map(|(index, part)| {
                let options = move || options(form, index, &texts.get());
                let choose = move |text: String| {
                    let mut looks = looks.get_untracked();
                    if looks.is_empty() {
                        looks = model::look(&texts.get_untracked().join("-"));
                    }
                    for look in &mut looks {
                        let place = look.part.map(|part| part.place);
                        if place == Some(part.place) {
                            look.text.clone_from(&text);
                        } else if part.place == Place::Rotor && place == Some(Place::Stator) {
                            // The stator goes with the rotor.
                            look.text.clear();
                        }
                    }
                    write(book, &joined(&form.complete(&looks)));
                };
                view! {
                    <label>
                        {part.place.name()}
                        <select
                            data-testid="order-compose"
                            data-position=(index + 1).to_string()
                            on:change:target=move |event| choose(event.target().value())
                        >
                            {options}
                        </select>
                    </label>
                }
            })
            .collect_view()
    };
    let series = move || {
        let present = looks.with(|looks| series_of(looks));
        all_series()
            .map(|(name, title)| {
                view! {
                    <option value=name selected=name == present>{title}</option>
                }
            })
            .collect_view()
    };
    let change_series = move |name: String| {
        let Some((form, first)) = starts(&name) else {
            return;
        };
        let mut texts = form.complete(&looks.get_untracked());
        if let (Some(text), Some(first)) = (texts.first_mut(), first) {
            first.clone_into(text);
        }
        write(book, &joined(&texts));
    };
    view! {
        <section class="part" aria-labelledby="order-composer">
            <h2 id="order-composer">"Compose one"</h2>
            <div class="order-form">
                <label>
                    "series"
                    <select
                        data-testid="order-compose"
                        data-position="series"
                        on:change:target=move |event| change_series(event.target().value())
                    >
                        {series}
                    </select>
                </label>
                {selects}
            </div>
        </section>
    }
}

/// The name of the short form among the series.
const SHORT: &str = "short";

/// All series, by what a code begins with.
fn all_series() -> impl Iterator<Item = (&'static str, &'static str)> {
    FORMS.iter().flat_map(|form| {
        let first = form.parts.first();
        let series = first.filter(|part| part.place == Place::Series);
        let words = series.map_or(&[][..], |part| part.words);
        let short = series
            .is_none()
            .then_some((SHORT, "short form of MPP and PT"));
        words.iter().map(|word| (word.text, word.text)).chain(short)
    })
}

/// The form of a series, and how its codes begin.
fn starts(name: &str) -> Option<(&'static Form, Option<&str>)> {
    if name == SHORT {
        return FORMS.last().map(|form| (form, None));
    }
    let begins = |form: &&Form| {
        form.parts
            .first()
            .is_some_and(|part| part.read(name).is_some())
    };
    FORMS.iter().find(begins).map(|form| (form, Some(name)))
}

/// What a code begins with.
fn series_of(looks: &[Look]) -> String {
    match looks.first() {
        Some(look) if look.part.is_some_and(|part| part.place == Place::Series) => {
            look.text.clone()
        }
        Some(Look { part: Some(_), .. }) => SHORT.to_owned(),
        _ => FORMS
            .first()
            .map(|form| form.title.to_owned())
            .unwrap_or_default(),
    }
}

/// The form of a code; the first where there is none yet.
fn form_of(looks: &[Look]) -> &'static Form {
    let found = starts(&series_of(looks)).map(|(form, _)| form);
    found.unwrap_or(&FORMS[0])
}

fn joined(texts: &[String]) -> String {
    let texts: Vec<_> = texts.iter().map(String::as_str).collect();
    texts.join("-").trim_end_matches('-').to_owned()
}

/// What can be chosen at a position; what does not go with the rest says so.
fn options(form: &'static Form, index: usize, texts: &[String]) -> Vec<AnyView> {
    let present = texts.get(index).cloned().unwrap_or_default();
    let mut choices = form.choices(index, texts);
    let read = form.parts.get(index).and_then(|part| part.read(&present));
    // A size that the table does not have may be typed.
    if let Some(token) = read
        && !choices.contains(&token)
    {
        choices.insert(0, token);
    }
    choices
        .into_iter()
        .map(|token| {
            let text = token.text();
            let mut with = texts.to_vec();
            if let Some(place) = with.get_mut(index) {
                place.clone_from(&text);
            }
            let doc = match form.compose(&with) {
                Ok(_) => token.doc(),
                Err(_) => format!("{}; not with the rest", token.doc()),
            };
            let title = match text.as_str() {
                "" => format!("nothing: {doc}"),
                text => format!("{text}: {doc}"),
            };
            view! { <option value=text.clone() selected=text == present>{title}</option> }
                .into_any()
        })
        .collect()
}
