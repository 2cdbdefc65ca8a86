//! Sizes and characteristics of the products.

use leptos::prelude::*;

#[component]
pub(super) fn Page() -> impl IntoView {}
