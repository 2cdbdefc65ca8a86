//! Which wire of the encoder goes where.

use super::{
    super::{
        Scroll,
        book::{Leaf, filled_link, link},
        calculator::{CopyLink, sentence},
        choice::{Choice, EncoderChoice, found},
    },
    Topic,
};
use crate::{app::App, handout::save_text};
use encoderscope::{
    calculator::Fault,
    language::t,
    text,
    wiring::{
        Adapter, Battery, End, OHMS, Paint, Place, Presence, Setup, Terminator, Warning, Wire,
        Wiring, svg,
    },
};
use leptos::prelude::*;

#[component]
pub(super) fn Page() -> impl IntoView {
    let book = expect_context::<App>().book();
    let setup = Memo::new(move |_| {
        let filled = book.filled();
        Setup::parse(|name| found(&filled, name))
    });
    let wiring = Memo::new(move |_| setup.get().and_then(Setup::wire));
    let adapter = Signal::derive(move || {
        let setup = setup.get().map(|setup| setup.adapter.key().to_owned());
        setup.unwrap_or_default()
    });
    let battery = Signal::derive(move || {
        let entry = book.entry("battery");
        entry.unwrap_or_else(|| Battery::None.key().to_owned())
    });
    let batteries = Battery::ALL.map(|battery| match battery {
        Battery::None => (battery.key(), t("no battery")),
        Battery::Fitted => (battery.key(), t("battery: models BM")),
    });
    let adapters = Adapter::ALL.map(|adapter| (adapter.key(), adapter.title()));
    view! {
        <section class="part" aria-label=t("What is wired")>
            <div class="form">
                <EncoderChoice />
                <Choice
                    name="battery"
                    title=t("Battery")
                    hint=t("BM behind the bits of the order code")
                    words=batteries.to_vec()
                    chosen=battery
                />
                <Choice
                    name="adapter"
                    title=t("Other end")
                    hint=t("what the encoder is connected to")
                    words=adapters.to_vec()
                    chosen=adapter
                />
            </div>
        </section>
        <div aria-live="polite">
            {move || match wiring.get() {
                Ok(wiring) => view! { <Drawn wiring=wiring /> }.into_any(),
                Err(fault) => view! { <Refused fault=fault setup=setup.get().ok() /> }.into_any(),
            }}
        </div>
    }
}

/// Why there is no picture, and what would fit.
#[component]
fn Refused(fault: Fault, setup: Option<Setup>) -> impl IntoView {
    let book = expect_context::<App>().book();
    let fitting = setup.map(Setup::fitting).unwrap_or_default();
    let doors: Vec<_> = fitting
        .into_iter()
        .map(|adapter| {
            view! {
                <li>
                    <button on:click=move |_| book.enter("adapter", adapter.key())>{adapter.title()}</button>
                </li>
            }
        })
        .collect();
    let fits = !doors.is_empty();
    view! {
        <section class="part" aria-label=t("What does not work")>
            <p class="fault" data-testid="wiring-fault" data-input=fault.input>{sentence(&fault)}</p>
            {fits.then(|| view! {
                <p>{t("What fits:")}</p>
                <ul class="doors">{doors}</ul>
            })}
        </section>
    }
}

#[component]
fn Drawn(wiring: Wiring) -> impl IntoView {
    let setup = wiring.setup;
    let picture = StoredValue::new(svg(&wiring));
    let name = format!(
        "{}-{}-{}.svg",
        setup.series.key(),
        setup.interface.key(),
        setup.adapter.key()
    );
    let profile = setup.interface.format().default_profile();
    let supply = wiring.supply.iter();
    let supply: Vec<_> = supply
        .map(|fact| format!("{} {}", t(fact.name), t(fact.value)))
        .collect();
    let characteristics = filled_link(
        Leaf::Topic(Topic::Products),
        &[("series", setup.series.key())],
    );
    let order_code = filled_link(Leaf::Topic(Topic::OrderCode), &[]);
    let zero = filled_link(
        Leaf::Topic(Topic::Zero),
        &[
            ("series", setup.series.key()),
            ("interface", setup.interface.key()),
        ],
    );
    view! {
        <section class="part" aria-label=t("Picture and wires")>
            <div class="wired">
                <div class="wiring-picture" data-testid="wiring-picture" inner_html=picture.get_value()></div>
                <Scroll label=t("Wires").to_owned()>
                    <table>
                        <caption>{t("Wires")}</caption>
                        <thead>
                            <tr>
                                <th scope="col">{t("pin")}</th>
                                <th scope="col">{t("colour")}</th>
                                <th scope="col">{t("signal")}</th>
                                <th scope="col">{t("goes to")}</th>
                                <th scope="col">{t("to know")}</th>
                            </tr>
                        </thead>
                        <tbody>{wiring.wires.into_iter().map(wire_row).collect_view()}</tbody>
                    </table>
                </Scroll>
            </div>
            <p data-testid="wiring-supply">
                <a href=characteristics>{t("Characteristics")}</a>
                ": " {supply.join(", ")} "."
            </p>
            <p class="doors">
                <button
                    data-testid="save-svg"
                    on:click=move |_| picture.with_value(|picture| save_text(picture, &name))
                >
                    {t("Save as SVG")}
                </button>
                <button on:click=move |_| { let _ = window().print(); }>{t("Print")}</button>
            </p>
            <CopyLink />
            <p class="source">{t("Source: ")} {wiring.source}</p>
        </section>
        <section class="part" aria-labelledby="terminators-title">
            <h2 id="terminators-title">{t("Terminators")}</h2>
            <Scroll label=t("Terminators").to_owned()>
                <table>
                    <caption class="unseen">{text!("Resistors of {} Ω", OHMS)}</caption>
                    <thead>
                        <tr>
                            <th scope="col">{t("between")}</th>
                            <th scope="col">{t("at the end of")}</th>
                            <th scope="col">{t("is it there")}</th>
                            <th scope="col">{t("source")}</th>
                        </tr>
                    </thead>
                    <tbody>{wiring.terminators.into_iter().map(terminator_row).collect_view()}</tbody>
                </table>
            </Scroll>
        </section>
        <section class="part" aria-labelledby="beware-title">
            <h2 id="beware-title">{t("Beware")}</h2>
            <ul class="warnings">{wiring.warnings.into_iter().map(warning).collect_view()}</ul>
            <p class="ways">
                <a href=link(&profile, None)>{text!("{}, the format", t(profile.title()))}</a>
                <a href=order_code>{t("Order codes")}</a>
                <a href=zero>{t("Setting the zero")}</a>
            </p>
        </section>
    }
}

fn wire_row(wire: Wire) -> impl IntoView {
    let goes = match wire.goes {
        None => t("nowhere").to_owned(),
        Some(terminal) => {
            let place = match terminal.place {
                Place::Supply => t("supply"),
                Place::Adapter => t("adapter"),
                Place::Battery => t("battery"),
                Place::Switch => t("input at"),
            };
            format!("{place} {}", t(terminal.name))
        }
    };
    let colour = wire.paint.map_or("–".to_owned(), Paint::name);
    let shown = wire.paint.map_or("–".to_owned(), Paint::title);
    view! {
        <tr
            data-testid="wiring-row"
            data-pin=wire.pin.map(|pin| pin.to_string())
            data-signal=wire.signal
            data-colour=colour.clone()
            data-goes=goes.clone()
        >
            <td>{wire.pin.map_or("–".to_owned(), |pin| pin.to_string())}</td>
            <td class="words">{wire.paint.map(swatch)} " " {shown}</td>
            <th scope="row">{t(wire.signal)}</th>
            <td class="words">{goes.clone()}</td>
            <td class="words doc">{t(wire.note)}</td>
        </tr>
    }
}

/// A piece of the wire.
fn swatch(paint: Paint) -> impl IntoView {
    let stripe = paint.stripe.unwrap_or(paint.base).hex();
    view! {
        <svg class="swatch" width="22" height="10" viewBox="0 0 22 10" aria-hidden="true">
            <rect class="w-dim-stroke" x="0.5" y="0.5" width="21" height="9" fill=paint.base.hex() />
            <rect x="5" y="1" width="4" height="8" fill=stripe />
            <rect x="14" y="1" width="4" height="8" fill=stripe />
        </svg>
    }
}

fn terminator_row(terminator: Terminator) -> impl IntoView {
    let (plus, minus) = terminator.between;
    let end = match terminator.end {
        End::Encoder => t("the encoder"),
        End::Controller => t("the controller"),
    };
    let (name, word, tone) = match terminator.presence {
        Presence::Inside => ("inside", t("yes: "), "good"),
        Presence::Switched => ("switched", t("to switch on: "), "warn"),
        Presence::Added => ("added", t("no: "), "warn"),
        Presence::Unclear => ("unclear", t("the manuals differ: "), "warn"),
    };
    view! {
        <tr data-testid="wiring-terminator" data-value=name>
            <th scope="row">{text!("{} and {}", t(plus), t(minus))}</th>
            <td class="words">{end}</td>
            <td class="words"><b class=format!("presence {}", tone)>{word}</b> {t(terminator.text)}</td>
            <td class="words doc">{t(terminator.source)}</td>
        </tr>
    }
}

fn warning(warning: Warning) -> impl IntoView {
    view! {
        <li data-testid="wiring-warning" data-name=warning.name>
            {warning.text}
            <small class="doc">{warning.source}</small>
        </li>
    }
}
