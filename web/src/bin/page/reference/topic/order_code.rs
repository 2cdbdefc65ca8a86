//! Order codes: read, corrected and composed.

use leptos::prelude::*;

#[component]
pub(super) fn Page() -> impl IntoView {}
