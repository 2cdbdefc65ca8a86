//! What the lamp shows, what the bits say, and what to do.

use leptos::prelude::*;

#[component]
pub(super) fn Page() -> impl IntoView {}
