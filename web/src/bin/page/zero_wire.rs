//! The zero of an IP-75, which is set by its wires at power-on: a checklist that watches the
//! stream and ticks what it sees (IP-75, 5.1.1).

use crate::app::{App, Source};
use encoderscope::{
    format::Format,
    language::{msg, t},
    procedure::HOLD,
    session::Micros,
    text,
};
use encoderscope_web::{
    browser::now,
    message::{Link, Shown, Snapshot, Supply, Wish},
};
use leptos::prelude::*;

/// What has not been seen by then has not happened.
const VERDICT: Micros = 4_000_000;
/// The angle is near another when they are so close, in degrees: the shaft may turn a little.
const NEAR: f64 = 1.0;

/// A wire that sets the zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Input {
    /// ZERO SET: the present position becomes 0.
    Set,
    /// ZERO RESET: the factory's zero comes back.
    Reset,
}

/// How far the user has come.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    /// The supply is still on.
    On,
    /// It is off: the wire is to be tied, then it is switched on.
    Off,
    /// It is on again since this time, and the input is held.
    Held(Micros),
    Ended(Ending),
}

/// What was seen in the end.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Ending {
    Made,
    /// ZPD or the angle say that nothing has happened.
    NotMade,
    /// Before and after look alike.
    Unclear,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Task {
    input: Input,
    before: Shown,
    stage: Stage,
}

/// How far two angles are apart, the shorter way round.
fn apart(one: f64, other: f64) -> f64 {
    let apart = (one - other).abs();
    apart.min(360.0 - apart)
}

impl Task {
    /// Where it stands after what has come by `now`.
    fn after(self, snapshot: &Snapshot, now: Micros) -> Self {
        let stage = match (self.stage, &snapshot.link, snapshot.reading) {
            // It may go off again before its time.
            (Stage::On | Stage::Held(_), Link::Silent { .. }, _) => Stage::Off,
            (Stage::Off, Link::Reading, _) => Stage::Held(now),
            (Stage::Held(since), Link::Reading, Some(shown)) => {
                let seen = self.seen(&shown);
                let held = now.saturating_sub(since);
                if held >= VERDICT || held >= HOLD && seen == Ending::Made {
                    Stage::Ended(seen)
                } else {
                    self.stage
                }
            }
            (stage, ..) => stage,
        };
        Self { stage, ..self }
    }

    /// What ZPD and the angle say.
    fn seen(&self, shown: &Shown) -> Ending {
        let near = |shown: &Shown| apart(shown.degrees, 0.0) < NEAR;
        let wanted = self.input == Input::Reset;
        match (self.input, self.before.zero_default, shown.zero_default) {
            (_, _, Some(now)) if now != wanted => Ending::NotMade,
            (_, Some(before), Some(_)) if before != wanted => Ending::Made,
            (Input::Set, ..) if near(shown) && near(&self.before) => Ending::Unclear,
            (Input::Set, ..) if near(shown) => Ending::Made,
            (Input::Set, ..) => Ending::NotMade,
            (Input::Reset, None, _) if apart(self.before.degrees, shown.degrees) > NEAR => {
                Ending::Made
            }
            (Input::Reset, ..) => Ending::Unclear,
        }
    }

    fn wire(&self) -> &'static str {
        match self.input {
            Input::Set => t("ZERO SET (violet)"),
            Input::Reset => t("ZERO RESET (yellow)"),
        }
    }

    /// What the last step waits for.
    fn sign(&self) -> &'static str {
        match (self.input, self.before.zero_default.is_some()) {
            (Input::Set, true) => t("ZPD becomes 0 and the angle 0"),
            (Input::Set, false) => t("The angle becomes 0"),
            (Input::Reset, true) => t("ZPD becomes 1"),
            (Input::Reset, false) => t("The angle is the factory's again"),
        }
    }

    fn outcome(&self, ending: Ending) -> (&'static str, &'static str, String) {
        let wire = self.wire();
        match (ending, self.input) {
            (Ending::Made, Input::Set) => (
                "lamp good",
                "yes",
                t("The zero is stored. Take the wire off 0 V.").into(),
            ),
            (Ending::Made, Input::Reset) => (
                "lamp good",
                "yes",
                t("The factory's zero is back. Take the wire off 0 V.").into(),
            ),
            (Ending::NotMade, _) => {
                let sign = match self.before.zero_default {
                    Some(_) => "ZPD",
                    None => t("The angle"),
                };
                let text = text!(
                    "{} does not show it after 4 s: {} was not at 0 V when the supply came on.",
                    sign,
                    wire
                );
                ("lamp bad", "no", text)
            }
            (Ending::Unclear, _) => (
                "lamp warn",
                "unknown",
                t("It looks as it did before, so nothing shows whether the input acted.").into(),
            ),
        }
    }
}

/// The task that somebody is at.
#[derive(Clone, Copy)]
struct Begun(RwSignal<Option<Task>>);

/// The checklist; only for encoders that have the wires.
#[component]
pub(crate) fn ZeroWire() -> impl IntoView {
    let app = expect_context::<App>();
    let Begun(task) = app.keep(|| Begun(RwSignal::new(None)));
    let fits = Memo::new(move |_| matches!(app.profile.get().format, Format::Asi1 | Format::Asi4));
    Effect::new(move || {
        app.snapshot.track();
        if let Some(begun) = task.get_untracked() {
            let next = app.snapshot.with(|snapshot| begun.after(snapshot, now()));
            if next != begun {
                task.set(Some(next));
            }
        }
    });
    Effect::new(move || {
        if !fits.get() {
            task.set(None);
        }
    });
    let reading = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.link == Link::Reading));
    let begin = move |input: Input| {
        if let Some(before) = app.snapshot.with_untracked(|snapshot| snapshot.reading) {
            task.set(Some(Task {
                input,
                before,
                stage: Stage::On,
            }));
        }
    };
    move || {
        fits.get().then(|| view! {
            <section class="panel setting">
                <h2>{t("Zero by wire")}</h2>
                <Stored />
                {move || match task.get() {
                    Some(task_now) => view! { <Checklist now=task_now task=task /> }.into_any(),
                    None => view! {
                        <div class="doors">
                            <button data-testid="wire-set" disabled=move || !reading.get() on:click=move |_| begin(Input::Set)>
                                {t("Set zero…")}
                            </button>
                            <button data-testid="wire-reset" disabled=move || !reading.get() on:click=move |_| begin(Input::Reset)>
                                {t("Factory zero…")}
                            </button>
                        </div>
                    }
                    .into_any(),
                }}
                {move || (app.source.get() == Source::Demo).then(|| view! { <DemoSupply /> })}
            </section>
        })
    }
}

/// Whether a zero of the user is stored, where the stream says so.
#[component]
fn Stored() -> impl IntoView {
    let app = expect_context::<App>();
    let stored = Memo::new(move |_| {
        let reading = app.snapshot.with(|snapshot| snapshot.reading);
        reading.and_then(|shown| shown.zero_default)
    });
    let text = move || match stored.get() {
        Some(true) => t("ZPD 1: the factory's zero"),
        Some(false) => t("ZPD 0: a zero of your own is stored"),
        None => t("This stream does not say whether a zero of your own is stored."),
    };
    view! {
        <p data-testid="zero-default" data-value=move || stored.get().map(|stored| u8::from(stored).to_string())>{text}</p>
    }
}

#[component]
fn Checklist(now: Task, task: RwSignal<Option<Task>>) -> impl IntoView {
    let stage = match now.stage {
        Stage::On => 0,
        Stage::Off => 1,
        Stage::Held(_) => 2,
        Stage::Ended(Ending::Made) => 4,
        Stage::Ended(_) => 3,
    };
    // While the supply is off the user ties the wire, which nobody sees, and switches on.
    let state = move |step: usize| match (step, now.stage) {
        (3, Stage::Ended(Ending::NotMade | Ending::Unclear)) => msg("not seen"),
        (1, Stage::Held(_)) => msg("done"),
        (step, _) if step < stage => "done",
        (2, Stage::Off) => msg("now"),
        (step, _) if step == stage => "now",
        _ => msg("later"),
    };
    let steps = [
        t("Switch the supply off").to_owned(),
        text!("Tie {} to 0 V", now.wire()),
        t("Switch the supply on and hold for 3 s").to_owned(),
        now.sign().to_owned(),
    ];
    let steps = steps.into_iter().enumerate().map(move |(step, text)| {
        let state = state(step);
        let tone = match state {
            "done" => "lamp good",
            "now" => "lamp idle",
            "not seen" => "lamp bad",
            _ => "lamp off",
        };
        view! {
            <li class=tone data-testid="wire-step" data-state=state>
                <span>{step + 1} ". " {text}</span>
                <span class="when">{t(state)}</span>
            </li>
        }
    });
    let ended = match now.stage {
        Stage::Ended(ending) => Some(now.outcome(ending)),
        _ => None,
    };
    let over = ended.is_some();
    view! {
        <p>{t("Hold the shaft still, and leave the port open.")}</p>
        <ol class="steps">{steps.collect_view()}</ol>
        {match now.stage {
            Stage::Held(since) => Some(view! { <Held since=since /> }),
            _ => None,
        }}
        {ended.map(|(tone, value, text)| view! {
            <p class=tone data-testid="zero-outcome" data-value=value role="status">{text}</p>
        })}
        <div class="doors">
            <button class:primary=over on:click=move |_| task.set(None)>{if over { t("Done") } else { t("Cancel") }}</button>
        </div>
    }
}

/// Counts how long the input has been held.
#[component]
fn Held(since: Micros) -> impl IntoView {
    let app = expect_context::<App>();
    let seconds = Memo::new(move |_| {
        app.snapshot.track();
        now().saturating_sub(since).min(HOLD) / 1_000_000
    });
    view! {
        <p class="count" data-testid="wire-hold" data-value=move || seconds.get().to_string()>
            {seconds} <small>{t(" of 3 seconds held")}</small>
        </p>
    }
}

/// The supply of the built-in encoder, and its wires.
#[component]
fn DemoSupply() -> impl IntoView {
    let app = expect_context::<App>();
    let switches = [
        (Supply::Off, "demo-power-off", t("Demo supply off")),
        (Supply::On, "demo-power-on", t("On")),
        (
            Supply::OnWithSet,
            "demo-power-set",
            t("On with ZERO SET at 0 V"),
        ),
        (
            Supply::OnWithReset,
            "demo-power-reset",
            t("On with ZERO RESET at 0 V"),
        ),
    ];
    let buttons = switches.map(|(supply, testid, text)| {
        view! {
            <button class="quiet" data-testid=testid on:click=move |_| app.wish(&Wish::Supply(supply))>{text}</button>
        }
    });
    view! { <div class="doors">{buttons.collect_view()}</div> }
}
