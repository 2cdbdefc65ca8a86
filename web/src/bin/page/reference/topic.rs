//! What a customer asks with the encoder in the hand.

mod lamp;
mod order_code;
mod products;
mod registers;
mod wiring;
mod zero;

use encoderscope::language::t;
use leptos::prelude::*;

/// A matter of products and wiring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Topic {
    /// Order codes: read and composed.
    OrderCode,
    /// Sizes and characteristics.
    Products,
    /// Which wire goes where.
    Wiring,
    /// How the zero of each product is set.
    Zero,
    /// What the lamp says.
    Lamp,
    /// The registers of the board that clocks SSI encoders.
    Registers,
}

impl Topic {
    pub(super) const ALL: [Self; 6] = [
        Self::OrderCode,
        Self::Products,
        Self::Wiring,
        Self::Zero,
        Self::Lamp,
        Self::Registers,
    ];

    /// Its name in links.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::OrderCode => "order-code",
            Self::Products => "products",
            Self::Wiring => "wiring",
            Self::Zero => "zero",
            Self::Lamp => "lamp",
            Self::Registers => "apci-1710-registers",
        }
    }

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::OrderCode => t("Order codes"),
            Self::Products => t("Sizes and characteristics"),
            Self::Wiring => t("Wiring"),
            Self::Zero => t("Setting the zero"),
            Self::Lamp => t("Lamp and status"),
            Self::Registers => t("APCI-1710 registers"),
        }
    }

    /// What it answers, in a sentence.
    pub(super) fn about(self) -> &'static str {
        match self {
            Self::OrderCode => t(
                "What the label says: format, widths, rate and wires of an order code, and what is wrong with one.",
            ),
            Self::Products => {
                t("What the manuals promise of each series, and the sizes it comes in.")
            }
            Self::Wiring => t("Which wire goes where, with terminators, supply and battery."),
            Self::Zero => t("How the zero of each product is set, step by step."),
            Self::Lamp => t("What the lamp shows, what the status bits say, and what to do."),
            Self::Registers => t(
                "The registers of Addi-Data's APCI-1710 and CPCI-1710, bit by bit, and what the encoder sent.",
            ),
        }
    }

    /// Whether it works with the shared profile.
    pub(super) const fn has_profile(self) -> bool {
        matches!(self, Self::Registers)
    }
}

/// The page of a topic.
#[component]
pub(super) fn Page(topic: Topic) -> impl IntoView {
    let page = match topic {
        Topic::OrderCode => view! { <order_code::Page /> }.into_any(),
        Topic::Products => view! { <products::Page /> }.into_any(),
        Topic::Wiring => view! { <wiring::Page /> }.into_any(),
        Topic::Zero => view! { <zero::Page /> }.into_any(),
        Topic::Lamp => view! { <lamp::Page /> }.into_any(),
        Topic::Registers => view! { <registers::Page /> }.into_any(),
    };
    view! {
        <article class="sheet" data-testid="reference-topic" data-name=topic.name()>
            <header class="head">
                <h1>{topic.title()}</h1>
                <p class="about">{topic.about()}</p>
            </header>
            {page}
        </article>
    }
}
