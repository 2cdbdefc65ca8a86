//! Which entries the log shows, and whether it goes on.

use super::LogView;
use crate::app::App;
use encoderscope::language::{msg, t};
use encoderscope_web::message::LogFilter;
use leptos::prelude::*;

/// The buttons over the log.
#[component]
pub(crate) fn Controls(view: LogView) -> impl IntoView {
    let app = expect_context::<App>();
    let LogView { filter, held, .. } = view;
    let pause = move |_| {
        held.update(|held| {
            *held = match held {
                Some(_) => None,
                None => Some(app.snapshot.with_untracked(|snapshot| snapshot.log.clone())),
            };
        });
    };
    let filters = [
        (LogFilter::All, msg("all")),
        (LogFilter::Received, msg("received")),
        (LogFilter::Sent, msg("sent")),
        (LogFilter::Faults, msg("faults")),
        (LogFilter::Beside, msg("other")),
    ];
    view! {
        <div class="doors bar-of" role="group" aria-label=t("Which frames")>
            {filters.map(|(wanted, text)| view! {
                <button
                    class="quiet"
                    aria-pressed=move || (filter.get() == wanted).to_string()
                    data-testid="log-filter"
                    data-value=text
                    on:click=move |_| view.show(app, wanted)
                >
                    {t(text)}
                </button>
            }).collect_view()}
            <button class="quiet" data-testid="log-pause" aria-pressed=move || held.get().is_some().to_string() on:click=pause>
                {move || if held.get().is_some() { t("go on") } else { t("pause") }}
            </button>
        </div>
    }
}
