//! Sizes and characteristics of the products.

use super::Topic;
use crate::{
    app::App,
    reference::{
        Scroll,
        book::{Leaf, filled_link},
        calculator::CopyLink,
    },
};
use encoderscope::{
    calculator::quantity::{self, Measure},
    language::{msg, number, t},
    product::{
        Series,
        facts::{FACTS, Fact, Group},
        sizes::{Mount, SIZES, Size, THICKNESS},
    },
    text,
};
use leptos::prelude::*;

/// The name of the series in links.
const SERIES: &str = "series";
/// The name of the least inner diameter in links.
const INNER: &str = "inner";

/// Series that share their tables.
const TABLES: &[(&str, &[Series])] = &[
    ("MPP", &[Series::Mpp]),
    ("PT", &[Series::Pt]),
    ("IP-75", &[Series::Ip75]),
    (
        "Pepperl+Fuchs",
        &[Series::Avs58, Series::Avm58, Series::Ass58, Series::Asm58],
    ),
];

#[component]
pub(super) fn Page() -> impl IntoView {
    let book = expect_context::<App>().book();
    let chosen = Memo::new(move |_| book.entry(SERIES).as_deref().and_then(Series::parse));
    let choose = move |key: String| match key.as_str() {
        "" => book.clear(SERIES),
        key => book.enter(SERIES, key),
    };
    let inner = move || book.entry(INNER).unwrap_or_default();
    let enter = move |text: String| match text.as_str() {
        "" => book.clear(INNER),
        text => book.enter(INNER, text),
    };
    let least = Memo::new(move |_| match inner().trim() {
        "" => Ok(0.0),
        text => quantity::parse(text, Measure::Length, "mm"),
    });
    let options = Series::ALL.map(|series| {
        view! {
            <option value=series.key() prop:selected=move || chosen.get() == Some(series)>
                {t(series.name())}
            </option>
        }
    });
    let tables = move || {
        let wanted = chosen.get();
        TABLES
            .iter()
            .filter_map(|(title, all)| match wanted {
                None => Some((*title, *all)),
                Some(one) => {
                    let at = all.iter().position(|series| *series == one)?;
                    Some((one.name(), all.get(at..=at)?))
                }
            })
            .map(|(title, series)| {
                view! { <Product title=title series=series least=least /> }
            })
            .collect_view()
    };
    view! {
        <section class="part" aria-label=t("What is shown")>
            <div class="form">
                <div class="asked">
                    <label for="product-series">{t("Series")}</label>
                    <span class="entered">
                        <select
                            id="product-series"
                            data-testid="product-series"
                            on:change:target=move |event| choose(event.target().value())
                        >
                            <option value="" prop:selected=move || chosen.get().is_none()>{t("all")}</option>
                            {options.into_view()}
                        </select>
                    </span>
                </div>
                <div class="asked">
                    <label for="product-inner">{t("Inner diameter of the rotor, at least")}</label>
                    <span class="entered">
                        <input
                            id="product-inner"
                            data-testid="product-inner"
                            inputmode="decimal"
                            spellcheck="false"
                            autocomplete="off"
                            aria-invalid=move || least.with(Result::is_err).then_some("true")
                            prop:value=inner
                            on:input:target=move |event| enter(event.target().value())
                        />
                        <span class="unit">{t("mm")}</span>
                    </span>
                    <p class="hint">{t("As the order code says it; shows the sizes of MPP and PT from there.")}</p>
                </div>
            </div>
            {move || least.get().err().map(|why| view! {
                <p class="fault" role="alert">{t("Inner diameter: ")} {why} "."</p>
            })}
        </section>
        {tables}
        <CopyLink />
    }
}

/// The tables of one series, or of several that share them.
#[component]
fn Product(
    title: &'static str,
    series: &'static [Series],
    least: Memo<Result<f64, String>>,
) -> impl IntoView {
    let sizes = move || {
        let least = least.get().ok()?;
        let all: Vec<&Size> = SIZES
            .iter()
            .filter(|size| series.contains(&size.series))
            .collect();
        if all.is_empty() {
            return None;
        }
        let fitting = all
            .into_iter()
            .filter(|size| f64::from(size.rotor_diameter()) >= least);
        Some(view! { <Sizes title=title sizes=fitting.collect() /> })
    };
    view! {
        <section class="part" aria-label=t(title) data-testid="product" data-series=title>
            <h2>{t(title)}</h2>
            <Facts title=title series=series />
            {sizes}
        </section>
    }
}

#[component]
fn Facts(title: &'static str, series: &'static [Series]) -> impl IntoView {
    let mine = |fact: &&Fact| fact.series.iter().any(|known| series.contains(known));
    let row = move |fact: &'static Fact| {
        let is_common = series.iter().all(|series| fact.series.contains(series));
        let names: Vec<_> = fact.series.iter().map(|series| t(series.name())).collect();
        let only = (!is_common).then(|| format!(" ({})", names.join(", ")));
        view! {
            <tr data-testid="product-fact" data-name=fact.name>
                <th scope="row">{t(fact.name)} <span class="doc">{only}</span></th>
                <td class="words">{t(fact.value)}</td>
                <td class="words doc">{t(fact.source)}</td>
            </tr>
        }
    };
    let groups = Group::ALL.map(|group| {
        let facts: Vec<_> = FACTS
            .iter()
            .filter(mine)
            .filter(|fact| fact.group == group)
            .collect();
        (!facts.is_empty()).then(|| {
            view! {
                <tbody>
                    <tr><th class="group" scope="rowgroup" colspan="3">{group.title()}</th></tr>
                    {facts.into_iter().map(row).collect_view()}
                </tbody>
            }
        })
    });
    view! {
        <Scroll label=text!("Characteristics of {}", t(title))>
            <table class="characteristics">
                <caption class="unseen">{text!("Characteristics of {}", t(title))}</caption>
                <thead>
                    <tr>
                        <th scope="col">{t("what")}</th>
                        <th scope="col">{t("how much")}</th>
                        <th scope="col">{t("manual")}</th>
                    </tr>
                </thead>
                {groups.into_view()}
            </table>
        </Scroll>
    }
}

/// The columns of a size table, those of MPP or of PT.
fn columns(series: Series) -> &'static [&'static str] {
    match series {
        Series::Pt => {
            const {
                &[
                    msg("size"),
                    msg("rotor"),
                    msg("stator"),
                    msg("thread"),
                    "A",
                    "B",
                    "C",
                    msg("stator ⌀"),
                    msg("stator screws on ⌀"),
                    msg("connector"),
                    msg("thickness"),
                ]
            }
        }
        _ => {
            const {
                &[
                    msg("size"),
                    msg("rotor, inner ⌀"),
                    msg("stator, outer ⌀"),
                    msg("rotor screws on ⌀"),
                    msg("stator screws on ⌀"),
                    msg("connector"),
                    msg("thickness"),
                ]
            }
        }
    }
}

/// The cells of a row, and over how many columns each goes.
fn cells(size: &Size) -> Vec<(String, &'static str)> {
    let said = |length: f64| number(length).to_string();
    let diameter = size.stator_diameter().to_string();
    let mut cells = match size.mount {
        Mount::Screws(circle) => vec![
            (size.rotor_diameter().to_string(), "1"),
            (diameter, "1"),
            (said(circle), "1"),
        ],
        Mount::Thread(thread, abc) => vec![
            (t("thread").to_owned(), "1"),
            (side(size), "1"),
            (number(thread.replace("mm", t("mm"))).to_string(), "1"),
            (said(abc), "3"),
            (diameter, "1"),
        ],
        Mount::Bonded(a, b, c) => vec![
            (t("bonded").to_owned(), "1"),
            (side(size), "1"),
            ("–".to_owned(), "1"),
            (said(a), "1"),
            (said(b), "1"),
            (said(c), "1"),
            (diameter, "1"),
        ],
    };
    cells.extend([
        (said(size.stator_circle), "1"),
        (size.connector().to_owned(), "1"),
        (size.thickness.map_or(String::new(), said), "1"),
    ]);
    cells
}

fn side(size: &Size) -> String {
    match size.is_back_mounted() {
        true => t("front and back").to_owned(),
        false => t("front").to_owned(),
    }
}

#[component]
fn Sizes(title: &'static str, sizes: Vec<&'static Size>) -> impl IntoView {
    let Some(first) = sizes.first() else {
        return view! { <p class="hint">{text!("The size table of {} has none so wide.", title)}</p> }
            .into_any();
    };
    let (series, heads) = (first.series, columns(first.series));
    let rows = sizes.into_iter().map(|size| {
        let code = format!("{}-A-24-B-N-A-M", size.name());
        let href = filled_link(Leaf::Topic(Topic::OrderCode), &[("code", &code)]);
        view! {
            <tr data-testid="product-size" data-name=size.name()>
                <th scope="row"><a href=href>{size.name()}</a></th>
                {cells(size)
                    .into_iter()
                    .map(|(text, columns)| view! { <td colspan=columns>{text}</td> })
                    .collect_view()}
            </tr>
        }
    });
    let source = match series {
        Series::Pt => t(
            "PT, size. A, B and C are the rotor's fitting diameters (H7), the stator's is h7; of a rotor with a thread the manual prints one number for all three.",
        ),
        _ => t("MPP, dimensions and connectors."),
    };
    view! {
        <Scroll label=text!("Sizes of {}", t(title))>
            <table class="sizes">
                <caption>{text!("Sizes of {}, mm", t(title))}</caption>
                <thead>
                    <tr>{heads.iter().map(|head| view! { <th scope="col">{t(head)}</th> }).collect_view()}</tr>
                </thead>
                <tbody>{rows.collect_view()}</tbody>
            </table>
        </Scroll>
        <p class="source">{t("Source: ")} {source} " " {t(THICKNESS)}</p>
    }
    .into_any()
}
