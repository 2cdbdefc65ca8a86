//! How the zero of each product is set.

use leptos::prelude::*;

#[component]
pub(super) fn Page() -> impl IntoView {}
