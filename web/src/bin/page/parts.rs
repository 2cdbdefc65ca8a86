//! Parts of the page whose code comes when they are first wanted.
//!
//! Each function here is a split point: the build takes whatever only it reaches out of the first
//! WASM file and puts it into one of its own.

use crate::{
    adapters,
    app::{App, Area},
    console::Live,
    decode::Decode,
    explain::Explain,
    log::{ByHand, Controls, Inspect, LogView},
    profile_editor::{Offer, ProfileEditor},
    recordings::{Recordings, Remains},
    reference::Reference,
};
use encoderscope::language::t;
use encoderscope_web::{
    link::Fragment,
    message::{Entry, PortId},
};
use leptos::{
    prelude::*,
    wasm_split::{SplitLoaderError, wasm_split},
};
use std::future::Future;
use web_sys::Blob;

/// The view of a part, or that its code cannot be had.
type Part = Result<AnyView, SplitLoaderError>;

#[wasm_split(decode, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn decode() -> Part {
    Ok(view! { <Decode /> }.into_any())
}

#[wasm_split(explain, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn explain() -> Part {
    Ok(view! { <Explain /> }.into_any())
}

#[wasm_split(reference, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn reference() -> Part {
    Ok(view! { <Reference /> }.into_any())
}

/// What the console shows of an encoder that is read.
#[wasm_split(live, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn live() -> Part {
    Ok(view! { <Live /> }.into_any())
}

/// Recordings that were cut off.
#[wasm_split(live, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn remains() -> Part {
    Ok(view! { <Remains /> }.into_any())
}

/// Replays a recording of the user's.
#[wasm_split(live, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn replay(app: App, name: String, file: Blob) -> Result<(), SplitLoaderError> {
    app.area.set(Area::Console);
    Recordings::of(app).open(name, &file);
    Ok(())
}

/// The settings behind the console's first view.
#[wasm_split(live, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn settings() -> Part {
    Ok(view! { <ProfileEditor offer=Offer::Serial /> }.into_any())
}

/// Which entries the log shows.
#[wasm_split(live, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn log_controls(view: LogView) -> Part {
    Ok(view! { <Controls view=view /> }.into_any())
}

/// The chosen bytes of the log.
#[wasm_split(live, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn inspect(entry: Entry, close: Callback<()>) -> Part {
    Ok(view! { <Inspect entry=entry close=close /> }.into_any())
}

/// Bytes that are sent by hand.
#[wasm_split(live, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn by_hand(sent: Callback<()>) -> Part {
    Ok(view! { <ByHand sent=sent /> }.into_any())
}

/// Takes over the profile of a link to the console.
#[wasm_split(live, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn profile_of(app: App, link: Fragment) -> Result<(), SplitLoaderError> {
    if app.is_here(&link) {
        app.follow_profile_of(&link);
    }
    Ok(())
}

/// Takes over the encoder that was behind a port last.
#[wasm_split(live, wasm_split_path = leptos::wasm_split, fallible)]
pub(crate) fn recall(app: App, port: PortId) -> Result<(), SplitLoaderError> {
    if let Some(profile) = adapters::recall(port) {
        app.change_profile(profile);
    }
    Ok(())
}

/// Says that something is on its way.
pub(crate) fn coming() -> impl IntoView {
    view! { <p class="coming" role="status">{t("Loading…")}</p> }
}

/// A part once its code is there; until then `meanwhile`.
pub(crate) fn later<F, V>(
    part: impl Fn() -> F + Send + 'static,
    meanwhile: fn() -> V,
) -> impl IntoView
where
    F: Future<Output = Part> + Send + 'static,
    V: IntoView + 'static,
{
    let waits = RwSignal::new(true);
    let fails = RwSignal::new(false);
    let attempt = RwSignal::new(0);
    let again = move |_| {
        waits.set(true);
        fails.set(false);
        attempt.update(|attempt| *attempt += 1);
    };
    view! {
        {move || {
            attempt.track();
            let part = part();
            Suspend::new(async move {
                let arrived = part.await;
                waits.set(false);
                arrived.map_err(|_| fails.set(true)).ok()
            })
        }}
        {move || waits.get().then(meanwhile)}
        {move || fails.get().then(|| view! {
            <p class="notice" role="alert" data-testid="part-missing">
                {t(
                    "This part of the page could not be loaded: the network is gone, or the page was renewed on \
                     its server meanwhile; then reload it.",
                )}
                " "
                <button on:click=again>{t("Try again")}</button>
            </p>
        })}
    }
}
