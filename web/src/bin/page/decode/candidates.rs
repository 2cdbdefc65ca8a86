//! What the input may be; a click reads it that way.

use crate::{app::App, desk::Choice, profile_editor::spoken_word};
use encoderscope::{format::Format, language::t, profile::Profile, text};
use encoderscope_web::{
    link,
    message::{CandidateView, NearView},
};
use leptos::prelude::*;

/// Candidates that are shown at first.
const BEST: usize = 3;

/// A profile in a line.
pub(super) fn describe(profile: &Profile) -> String {
    let mut text = text!("{}, {} bit", profile.title(), profile.angle_bits);
    if profile.turns_bits > 0 {
        text += &text!(", {} bit turns", profile.turns_bits);
    }
    match profile.format {
        Format::Rs485 => text += &text!(", reply to ‘{}’", profile.command.letter()),
        Format::BissC => text += &text!(", {} status bits", profile.status_bits),
        Format::Bus => text += &text!(", device {}", format_args!("0x{:02X}", profile.address)),
        Format::SsiTree => {
            text += &text!(
                ", {}, {}, {} clocks",
                spoken_word("code", profile.code.name()),
                spoken_word("align", profile.align.name()),
                profile.frame_bits
            );
        }
        _ => {}
    }
    text
}

/// Text with its powers, `2^24`, as they are printed.
fn raised(text: &str) -> String {
    let mut is_power = false;
    let letters = text.chars().filter_map(|letter| {
        is_power = letter == '^' || is_power && letter.is_ascii_digit();
        match (letter, letter.to_digit(10)) {
            ('^', _) => None,
            (_, Some(digit)) if is_power => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹']
                .get(digit as usize)
                .copied(),
            _ => Some(letter),
        }
    });
    letters.collect()
}

/// Reads the input with a profile, a mistake of its capture undone where there is one.
fn read_as(app: App, change: Option<&String>, profile: Profile) {
    let desk = app.desk();
    desk.choice.set(Choice::User);
    if desk
        .changed
        .with_untracked(|changed| changed.as_ref() != change)
    {
        desk.change(change.cloned(), profile);
    }
    app.change_profile(profile);
}

/// What fits better than the chosen profile, though little is different.
#[component]
pub(super) fn Nearby() -> impl IntoView {
    let app = expect_context::<App>();
    let row = move |near: NearView| {
        let profile = link::profile(&near.profile).ok()?;
        let change = near.change;
        let choose = move |_| read_as(app, change.as_ref(), profile);
        Some(view! {
            <li data-testid="near" data-value=near.profile>
                {near.text}
                " "
                <button class="quiet" on:click=choose>{t("Read it so")}</button>
            </li>
        })
    };
    move || {
        let near = app.desk().near.get();
        (!near.is_empty() && !app.desk().is_empty()).then(|| {
            view! {
                <div class="nearby" role="status">
                    <p>{t("These frames fit better:")}</p>
                    <ul>{near.into_iter().filter_map(row).collect_view()}</ul>
                </div>
            }
        })
    }
}

#[component]
pub(super) fn Candidates() -> impl IntoView {
    let app = expect_context::<App>();
    let desk = app.desk();
    let all = RwSignal::new(false);
    let row = move |candidate: CandidateView| {
        let profile = link::profile(&candidate.profile).ok()?;
        let value = format!("{}&verdict={}", candidate.profile, candidate.verdict);
        let change = candidate.change.clone();
        let mine = change.clone();
        let choose = move |_| read_as(app, change.as_ref(), profile);
        Some(view! {
            <button
                class="candidate"
                class:chosen=move || app.profile.get() == profile && desk.changed.get() == mine
                data-testid="candidate"
                data-value=value
                on:click=choose
            >
                <b>{describe(&profile)}</b>
                <span class=format!("verdict {}", candidate.verdict)>{t(&candidate.verdict).to_owned()}</span>
                <small>{raised(&candidate.evidence.join("; "))}</small>
            </button>
        })
    };
    move || {
        let found = desk.candidates.get();
        let more = found.len() > BEST;
        let reads = desk
            .overview
            .with(|overview| overview.frames > overview.bad);
        let judging = desk.judging.get() && !desk.is_empty();
        let some = if all.get() { found.len() } else { BEST };
        let nothing =
            !judging && found.is_empty() && !desk.is_empty() && desk.overview.get().lines > 0.0;
        (!found.is_empty() || judging || nothing).then(|| {
            view! {
                <div class="candidates">
                    <h2>{t("What it is")}</h2>
                    {nothing.then(|| view! {
                        <p class="hint" data-testid="no-candidate">{match reads {
                            true => t("Nothing in these frames tells the formats apart: choose the one of your encoder below. More frames, of a turning shaft, may tell."),
                            false => t("No known format fits. More frames, or frames of a turning shaft, may tell."),
                        }}</p>
                    })}
                    {judging.then(|| view! { <p class="hint">{t("Comparing with every format…")}</p> })}
                    {found.into_iter().take(some).filter_map(row).collect_view()}
                    {(more && !all.get()).then(|| view! {
                        <button class="quiet" on:click=move |_| all.set(true)>{t("More")}</button>
                    })}
                </div>
            }
        })
    }
}
