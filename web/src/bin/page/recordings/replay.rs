//! The controls of a replay.

use super::{Recordings, noted, size_text};
use crate::app::{App, Source};
use encoderscope::{
    language::{msg, t},
    text,
};
use encoderscope_web::{
    browser::time_text,
    message::{Replay, Wish},
};
use leptos::prelude::*;

/// How fast a recording may be replayed, and how that is called.
const SPEEDS: [(f64, &str); 8] = [
    (0.01, "1/100"),
    (0.1, "1/10"),
    (1.0, msg("as it was")),
    (2.0, "2×"),
    (10.0, "10×"),
    (100.0, "100×"),
    (1000.0, "1 000×"),
    (f64::INFINITY, msg("at once")),
];

/// Steps of the place in the recording.
const STEPS: f64 = 1000.0;

#[component]
pub(crate) fn ReplayBar() -> impl IntoView {
    let app = expect_context::<App>();
    let recordings = Recordings::of(app);
    let replay = Memo::new(move |_| recordings.state.with(|state| state.replay.clone()));
    let exists = Memo::new(move |_| replay.with(Option::is_some));
    let speed = recordings.speed;
    let of = move |read: fn(&Replay) -> f64| {
        Memo::new(move |_| replay.with(|replay| replay.as_ref().map_or(0.0, read)))
    };
    let (now, part, time, lost) = (
        of(|replay| replay.speed),
        of(|replay| replay.part),
        of(|replay| (replay.time / 1000.0).floor() * 1000.0),
        of(|replay| replay.lost),
    );
    let ended = of(|replay| f64::from(u8::from(replay.ended)));
    let ended = move || ended.get() > 0.0;
    let adapter = Memo::new(move |_| {
        replay.with(|replay| replay.as_ref().map(|replay| replay.adapter.clone()))
    });
    let notes = Memo::new(move |_| {
        replay.with(|replay| {
            replay
                .as_ref()
                .map(|replay| replay.notes.clone())
                .unwrap_or_default()
        })
    });
    let press = move |_| match (ended(), now.get_untracked() > 0.0) {
        (true, _) => {
            recordings.send(&Wish::Seek(0.0));
            recordings.send(&Wish::Play(speed.get_untracked()));
        }
        (false, true) => recordings.send(&Wish::Play(0.0)),
        (false, false) => recordings.send(&Wish::Play(speed.get_untracked())),
    };
    let replays = move || app.source.get() == Source::Replay && exists.get();
    view! {
        {move || replays().then(|| view! {
            <div class="replay" data-testid="replay-bar">
                <div class="doors">
                    <button class="primary" data-testid="replay-play" on:click=press>
                        {move || match (ended(), now.get() > 0.0) {
                            (true, _) => t("Once more"),
                            (false, true) => t("Hold"),
                            (false, false) => t("Play"),
                        }}
                    </button>
                    <label>
                        <span class="unseen">{t("Speed")}</span>
                        <select
                            name="replay-speed"
                            data-testid="replay-speed"
                            on:change:target=move |event| {
                                let index: usize = event.target().value().parse().unwrap_or(2);
                                if let Some((wanted, _)) = SPEEDS.get(index) {
                                    speed.set(*wanted);
                                    if now.get_untracked() > 0.0 {
                                        recordings.send(&Wish::Play(*wanted));
                                    }
                                }
                            }
                        >
                            {SPEEDS.iter().enumerate().map(|(index, (value, text))| {
                                let value = *value;
                                view! { <option value=index.to_string() selected=move || speed.get() == value>{t(text)}</option> }
                            }).collect_view()}
                        </select>
                    </label>
                </div>
                <label class="place">
                    <span class="unseen">{t("Place in the recording")}</span>
                    <input
                        type="range"
                        min="0"
                        max=STEPS.to_string()
                        data-testid="replay-place"
                        prop:value=move || (part.get() * STEPS).round().to_string()
                        on:change:target=move |event| {
                            let place: f64 = event.target().value().parse().unwrap_or(0.0);
                            recordings.send(&Wish::Seek(place / STEPS));
                        }
                    />
                </label>
                <p class="number" data-testid="replay-time" data-value=move || time.get().to_string()>
                    {move || match time.get() {
                        time if time > 0.0 => time_text(time),
                        _ => "–".into(),
                    }}
                    {move || ended().then(|| t(" · the end"))}
                </p>
                {move || adapter.get().filter(|name| !name.is_empty()).map(|name| view! { <p class="hint">{text!("Recorded with {}", t(&name))}</p> })}
                {move || (lost.get() > 0.0).then(|| view! {
                    <p class="fault" data-testid="replay-lost" data-value=lost.get().to_string()>
                        {text!("{} of the file cannot be read.", size_text(lost.get()))}
                    </p>
                })}
                <ul class="notes">
                    {move || notes.get().into_iter().rev().map(|(at, text)| view! {
                        <li><span class="number">{time_text(at)}</span> " " {noted(&text)}</li>
                    }).collect_view()}
                </ul>
            </div>
        })}
    }
}
