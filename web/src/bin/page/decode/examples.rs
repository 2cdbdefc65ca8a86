//! What stands where nothing has been pasted: an example of every format, a click away.

use crate::app::App;
use encoderscope::{format::Format, language::t};
use leptos::prelude::*;

#[component]
pub(super) fn Examples() -> impl IntoView {
    let app = expect_context::<App>();
    let show = move |format: Format| {
        let profile = format.default_profile();
        app.change_profile(profile);
        app.desk().typed(format.manual().example.into(), &profile);
    };
    let rows = Format::ALL.iter().map(|format| {
        let manual = format.manual();
        let first = manual.example.lines().next();
        view! {
            <li>
                <button data-testid="example-of" data-value=format.name() on:click=move |_| show(*format)>
                    <b>{format.title()}</b>
                    <span>{t(manual.about)}</span>
                    <code>{first}</code>
                </button>
            </li>
        }
    });
    view! {
        <section class="panel">
            <h2>{t("Frames")}</h2>
            <p class="hint">
                {t("Bytes in any writing: hexadecimal or decimal, hexdump and xxd, C arrays, terminal logs with times and directions, tables of Saleae and sigrok, strings of 0 and 1. Files too: text, binary, VCD and CSV of a logic analyser. Nothing leaves this page.")}
            </p>
            <h2>{t("An example of each format")}</h2>
            <ul class="examples">{rows.collect_view()}</ul>
        </section>
    }
}
