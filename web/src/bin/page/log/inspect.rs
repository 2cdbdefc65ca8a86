//! The bytes that were chosen in the log, explained.

use crate::{app::App, frame_view::FrameView};
use encoderscope::{decode::Decoder, language::t, record::hex};
use encoderscope_web::{
    link::query,
    message::{Entry, Explained},
};
use leptos::prelude::*;

/// The chosen bytes, explained.
#[component]
pub(crate) fn Inspect(entry: Entry, close: Callback<()>) -> impl IntoView {
    let app = expect_context::<App>();
    let profile = app.profile.get_untracked();
    let bytes: Vec<u8> = entry.bytes.iter().map(|(byte, _)| *byte).collect();
    let text = hex(&bytes);
    let decoder = Decoder::new(profile).ok().filter(|_| !entry.sent);
    let explained = decoder.and_then(|decoder| {
        let frame = decoder.frame(&bytes)?;
        Some(Explained::new(0, frame.bits, true, &frame.explain()))
    });
    let shown = match explained {
        Some(frame) => view! { <FrameView frame=frame /> }.into_any(),
        None => {
            view! { <p class="hint">{entry.text} " " <code>{text.clone()}</code></p> }.into_any()
        }
    };
    view! {
        <div class="inspect" data-testid="inspect">
            {shown}
            <div class="doors">
                <a class="button" href=format!("#/decode?{}&dump={text}", query(&profile))>{t("Open in the decoder")}</a>
                <button on:click=move |_| close.run(())>{t("Close")}</button>
            </div>
        </div>
    }
}
