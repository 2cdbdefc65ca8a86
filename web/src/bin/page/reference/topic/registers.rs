//! The registers of the APCI-1710, bit by bit.

mod explainer;
mod shift;

use crate::{
    app::App,
    reference::{
        Scroll,
        book::{Leaf, filled_link},
        calculator::CopyLink,
    },
};
use encoderscope::{
    apci1710::{MODULE_BYTES, Register, SOURCE},
    language::t,
    text,
};
use explainer::Explainer;
use leptos::prelude::*;
use shift::Shift;

/// The registers whose value says something by itself, and an example of each.
const PLAIN: [(Register, &str); 6] = [
    (Register::Frq, "50"),
    (Register::Counts, "25"),
    (Register::Control, CONTROL),
    (Register::Status, "0x0E"),
    (Register::Output, "0"),
    (Register::Identity, "0x53493130"),
];
/// The first word is converted, the others are not.
const CONTROL: &str = "0x01";

#[component]
pub(super) fn Page() -> impl IntoView {
    let calculator = filled_link(Leaf::Calculator("apci-1710"), &[]);
    let plain = PLAIN.map(|(register, example)| {
        let book = expect_context::<App>().book();
        let text = Memo::new(move |_| book.entry(register.name()).unwrap_or(example.to_owned()));
        let value = Memo::new(move |_| register.entered(&text.get()));
        let notes = Memo::new(move |_| {
            let value = value.get();
            value.map(|value| register.notes(value)).unwrap_or_default()
        });
        view! {
            <Explainer
                register=register
                name=register.name()
                text=text
                value=value
                notes=notes
            />
        }
    });
    view! {
        <p class="about">
            {t("The SSI module of the boards APCI-1710 and CPCI-1710 clocks up to three encoders. What is written to it is worked out by the ")}
            <a href=calculator>{t("calculator")}</a>
            {t("; what a register holds is taken apart here.")}
        </p>
        <Map />
        {plain.into_view()}
        <Shift />
        <p class="source">
            {t("Source: ")} {t(SOURCE)}
            {t("; offsets of SHIFT and OUTPUT: Linux, comedi, APCI1710_Ssi.c")}
        </p>
        <CopyLink />
    }
}

/// All registers of a module.
#[component]
fn Map() -> impl IntoView {
    let rows = Register::ALL.map(|register| {
        view! {
            <tr data-testid="register-row" data-name=register.name() data-value=register.offset()>
                <th scope="row">{register.title()}</th>
                <td class="number">{format!("+{}", register.offset())}</td>
                <td>{t(register.access().name())}</td>
                <td class="number">{register.width()}</td>
                <td class="words doc">{register.layout().title()}</td>
            </tr>
        }
    });
    view! {
        <section class="part" aria-labelledby="register-map">
            <h2 id="register-map">{t("A module")}</h2>
            <p class="hint">
                {text!("A board has four; the registers of module n begin at {} · n bytes from the address of the board.", MODULE_BYTES)}
            </p>
            <Scroll label=t("Registers of a module").to_owned()>
                <table>
                    <caption class="unseen">{t("Registers of a module")}</caption>
                    <thead>
                        <tr>
                            <th scope="col">{t("register")}</th>
                            <th scope="col">{t("byte")}</th>
                            <th scope="col">{t("is for")}</th>
                            <th scope="col">{t("bits")}</th>
                            <th scope="col">{t("what it is")}</th>
                        </tr>
                    </thead>
                    <tbody>{rows.into_view()}</tbody>
                </table>
            </Scroll>
        </section>
    }
}
