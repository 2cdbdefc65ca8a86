//! The registers of the APCI-1710, bit by bit.

use leptos::prelude::*;

#[component]
pub(super) fn Page() -> impl IntoView {}
