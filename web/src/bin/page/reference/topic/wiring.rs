//! Which wire of the encoder goes where.

use leptos::prelude::*;

#[component]
pub(super) fn Page() -> impl IntoView {}
