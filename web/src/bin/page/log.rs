//! The raw log.

use crate::app::App;
use encoderscope_web::message::Entry;
use leptos::prelude::*;

#[component]
pub(crate) fn Frames() -> impl IntoView {
    let app = expect_context::<App>();
    let log = Memo::new(move |_| app.snapshot.get().log);
    view! {
        <section class="panel frames">
            <h2>"Frames"</h2>
            <table>
                <thead>
                    <tr>
                        <th>"time"</th>
                        <th>"bytes"</th>
                        <th>"check"</th>
                    </tr>
                </thead>
                <tbody>
                    {move || log.get().into_iter().map(|entry| view! { <EntryRow entry=entry /> }).collect_view()}
                </tbody>
            </table>
        </section>
    }
}

#[component]
fn EntryRow(entry: Entry) -> impl IntoView {
    let bytes = entry.bytes.into_iter().map(|(byte, class)| {
        view! { <span class=format!("byte {class}")>{format!("{byte:02X}")}</span> }
    });
    view! {
        <tr data-testid="frame-row" data-ok=entry.ok.to_string()>
            <td class="time">{format!("{:.4}", entry.time)}</td>
            <td class="bytes">{bytes.collect_view()}</td>
            <td class=if entry.ok { "verdict good" } else { "verdict bad" }>
                {if entry.ok { "✓".into() } else { entry.text }}
            </td>
        </tr>
    }
}
