//! The decoder: any dump in; what it is, what it says and what is wrong with it out.

mod candidates;
mod chart;
mod examples;
mod figures;
mod own;
mod paste;
mod report;
mod rows;
mod share;

use crate::{
    app::{App, Place, in_pieces},
    desk::Choice,
    frame_view::FrameView,
    profile_editor::{Offer, ProfileEditor},
};
use candidates::{Candidates, Nearby};
use chart::AngleChart;
use encoderscope::{explain::grouped, format::Format, language::t, text};
use encoderscope_web::{
    link::{self, Fragment},
    message::{Explained, ToDesk},
};
use examples::Examples;
use figures::Figures;
use leptos::prelude::*;
use own::OwnEditor;
pub(crate) use own::first as first_own;
use paste::Paste;
use report::Report;
use rows::Rows;
use share::Share;

/// A count, with thin spaces between thousands.
fn count(count: f64) -> String {
    grouped(count as u64)
}

#[component]
pub(crate) fn Decode() -> impl IntoView {
    let app = expect_context::<App>();
    let desk = app.desk();
    app.settle(Place {
        follow: Callback::new(move |link: Fragment| {
            app.follow_profile_of(&link);
            desk.follow_link(&link);
        }),
        fragment: Signal::derive(move || {
            let profile = link::query(&app.profile.get());
            format!("#/decode?{profile}{}", desk.fragment())
        }),
    });
    Effect::new(move || desk.decode_as(app.profile.get()));
    Effect::new(move || {
        if let Some(profile) = desk.found.get() {
            // Once: what the user chooses later stands.
            desk.found.set(None);
            app.profile.set(profile);
        }
    });
    // The first frame is explained until a row is chosen.
    let first = Memo::new(move |_| {
        let rows = desk.rows.get();
        let mut frames = rows.1.iter();
        let frame = frames.find(|row| row.is_frame()).or(rows.1.first());
        frame.map(|row| row.index)
    });
    let shown = Memo::new(move |_| desk.chosen.get().or(first.get()));
    let whole = Memo::new(move |_| {
        let overview = desk.overview.get();
        (overview.profile, overview.done, overview.rows.min(1))
    });
    Effect::new(move || {
        let _ = whole.get();
        if let Some(index) = shown.get() {
            desk.send(ToDesk::Explain(index));
        }
    });
    let empty = Memo::new(move |_| desk.is_empty());
    let own = Memo::new(move |_| app.profile.get().format == Format::Own);
    view! {
        <div class="decode">
            <section class="panel paste">
                <h2>{t("What came over the wire")}</h2>
                <Paste />
                <Candidates />
                <h2>{t("How to read it")}</h2>
                <div on:change=move |_| desk.choice.set(Choice::User)>
                    <ProfileEditor offer=Offer::All />
                </div>
                <Nearby />
                {move || own.get().then(|| view! { <OwnEditor /> })}
                <Share />
            </section>
            <div class="results">
                {move || match empty.get() {
                    true => view! { <Examples /> }.into_any(),
                    false => view! { <Results shown=shown /> }.into_any(),
                }}
                {move || desk.explained.get().filter(|_| !empty.get()).map(|explained| view! {
                    <section class="panel detail">
                        <h2>
                            {text!("Row {}", grouped(explained.index as u64 + 1))}
                            {explained.answers.map(|start| view! { <span>{text!("answers the request at {}", start)}</span> })}
                        </h2>
                        {explain_link(app, &explained).map(|link| view! {
                            <p><a href=link data-testid="to-explain">{t("Open in the explainer")}</a></p>
                        })}
                        {explained.says.iter().map(|text| view! { <p class="fault">{text.clone()}</p> }).collect_view()}
                        <FrameView frame=explained />
                    </section>
                })}
            </div>
            <Report />
        </div>
    }
}

/// What the input says.
#[component]
fn Results(shown: Memo<Option<usize>>) -> impl IntoView {
    let [figures, rows, chart] = in_pieces();
    view! {
        {move || figures.get().then(|| view! { <Figures /> })}
        {move || rows.get().then(|| view! { <Rows shown=shown /> })}
        {move || chart.get().then(|| view! { <AngleChart /> })}
    }
}

/// The link that explains a frame.
fn explain_link(app: App, frame: &Explained) -> Option<String> {
    let bits = frame.bits.iter();
    let text: String = match frame.bytes {
        true => {
            let byte = |bits: &[bool]| bits.iter().fold(0, |byte, bit| byte * 2 + u32::from(*bit));
            let bytes = frame.bits.chunks(8).map(byte);
            bytes.map(|byte| format!("{byte:02x}")).collect()
        }
        false => bits.map(|bit| if *bit { '1' } else { '0' }).collect(),
    };
    let profile = link::query(&app.profile.get_untracked());
    (!frame.notes.is_empty())
        .then(|| format!("#/explain?{profile}&direction=received&frame={text}"))
}
