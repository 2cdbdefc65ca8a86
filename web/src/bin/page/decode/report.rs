//! What is printed: the profile, what the rows come to, the faults, and frames bit by bit.

use super::{candidates::describe, count, figures::figures};
use crate::{app::App, frame_view::FrameView};
use encoderscope::{
    explain::grouped,
    language::{msg, t},
    text,
};
use encoderscope_web::link::query;
use leptos::prelude::*;

#[component]
pub(super) fn Report() -> impl IntoView {
    let app = expect_context::<App>();
    let desk = app.desk();
    move || {
        let rows = desk.report.get();
        (!rows.is_empty()).then(|| {
            let overview = desk.overview.get();
            let profile = app.profile.get();
            let mut facts = vec![
                (msg("profile"), describe(&profile)),
                (msg("parameters"), query(&profile).replace('&', " ")),
                (msg("read as"), overview.writing.clone()),
                (
                    msg("frames"),
                    text!(
                        "{} good, {} bad, {} bytes in no frame",
                        count(overview.frames - overview.bad),
                        count(overview.bad),
                        count(overview.skipped)
                    ),
                ),
            ];
            facts.extend(figures(&overview));
            let facts = facts
                .into_iter()
                .map(|(name, value)| view! { <div><dt>{t(name)}</dt><dd>{value}</dd></div> });
            let said = overview
                .faults
                .iter()
                .chain(&overview.timing)
                .chain(&overview.skips)
                .chain(&overview.conditions)
                .map(|item| {
                    let text = format!("{} × {}", count(item.count), item.name);
                    view! { <li>{text}</li> }
                });
            view! {
                <article class="report" data-testid="report">
                    <h1>{t("Encoderscope report")}</h1>
                    <dl>{facts.collect_view()}</dl>
                    <h2>{t("What was found")}</h2>
                    <ul>{said.collect_view()}</ul>
                    {rows.into_iter().map(|row| view! {
                        <section>
                            <h2>{text!("Row {}", grouped(row.index as u64 + 1))}</h2>
                            {row.says.iter().map(|text| view! { <p class="fault">{text.clone()}</p> }).collect_view()}
                            <FrameView frame=row />
                        </section>
                    }).collect_view()}
                </article>
            }
        })
    }
}
