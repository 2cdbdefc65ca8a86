//! Sequences as conversations: what is said line by line, each frame to look at.

use super::paper::Paper;
use crate::app::App;
use encoderscope::{
    conversation::{Conversation, Line},
    dump::Direction,
    language::{number, t},
    record::hex,
    sequence::Change,
    text,
};
use leptos::prelude::*;

/// The conversations that the encoders of the profile know.
#[component]
pub(super) fn Talk() -> impl IntoView {
    let app = expect_context::<App>();
    let talk = RwSignal::new(None::<Conversation>);
    let at = RwSignal::new(0usize);
    let format = Memo::new(move |_| app.profile.get().format);
    Effect::new(move || {
        let _ = format.get();
        talk.set(None);
    });
    let go = move |to: usize| {
        at.set(to);
        let line = talk.with_untracked(|talk| talk.as_ref()?.lines.get(to).cloned());
        if let Some(line) = line {
            look_at(app, &line);
        }
    };
    let begin = move |change: Change| {
        talk.set(Conversation::of(&app.profile.get_untracked(), change));
        go(0);
    };
    let choices = move || {
        let profile = app.profile.get();
        let changes = Change::all(&profile).into_iter();
        changes
            .filter_map(|change| {
                let title = change.script(&profile)?.title;
                Some(view! {
                    <button data-testid="talk-begin" data-value=title on:click=move |_| begin(change)>
                        {t(title)}
                    </button>
                })
            })
            .collect::<Vec<_>>()
    };
    let lines = move || {
        let talk = talk.get()?;
        let last = talk.lines.len().saturating_sub(1);
        let holds = talk.holds.to_string();
        let at_end = move || at.get() >= last;
        let rows = talk.lines.into_iter().enumerate();
        let rows = rows.map(|(index, line)| {
            view! {
                <li>
                    <button
                        class=format!("line {}", line.direction.name())
                        class:chosen=move || at.get() == index
                        aria-current=move || (at.get() == index).then_some("step")
                        data-testid="talk-line"
                        on:click=move |_| go(index)
                    >
                        <span class="time">{text!("{} ms", number(format_args!("{:.3}", line.at as f64 / 1e3)))}</span>
                        <span>{match line.direction {
                            Direction::Sent => t("master"),
                            Direction::Received => t("encoder"),
                        }}</span>
                        <code>{spaced(&line.bytes)}</code>
                    </button>
                </li>
            }
        });
        Some(view! {
            <div class="doors">
                <button disabled=move || at.get() == 0 data-testid="talk-back" on:click=move |_| go(at.get_untracked().saturating_sub(1))>{t("← back")}</button>
                <button disabled=at_end data-testid="talk-on" on:click=move |_| go((at.get_untracked() + 1).min(last))>{t("on →")}</button>
                <span class="hint" role="status">{move || text!("frame {} of {}", at.get() + 1, last + 1)}</span>
            </div>
            <ol class="talk-lines">{rows.collect_view()}</ol>
            <p class="hint">{text!("In the end: {}.", holds)}</p>
        })
    };
    move || {
        let choices = choices();
        (!choices.is_empty()).then(|| {
            view! {
                <section class="panel talk" data-testid="talk">
                    <h2>{t("Conversations")}</h2>
                    <p class="hint">
                        {t("A built-in encoder answers; nothing goes to any port. Each frame is explained above.")}
                    </p>
                    <div class="doors">{choices}</div>
                    {lines}
                </section>
            }
        })
    }
}

fn spaced(bytes: &[u8]) -> String {
    let bytes: Vec<_> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
    bytes.join(" ")
}

/// Explains a frame of the conversation.
fn look_at(app: App, line: &Line) {
    let paper: Paper = app.paper();
    paper.take(&hex(&line.bytes), line.profile, Some(line.direction));
    app.change_profile(line.profile);
}
