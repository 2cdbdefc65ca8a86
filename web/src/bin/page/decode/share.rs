//! Out again: links, files, a report, and decoders to paste into a program.

use crate::{app::App, handout::copy};
use encoderscope::{export::Language, language::t, text};
use encoderscope_web::message::{FileKind, ToDesk};
use leptos::prelude::*;

#[component]
pub(super) fn Share() -> impl IntoView {
    let app = expect_context::<App>();
    let desk = app.desk();
    let said = RwSignal::new(None::<String>);
    Effect::new(move || {
        desk.text.track();
        desk.file.track();
        app.profile.track();
        said.set(None);
    });
    let wanted = RwSignal::new(false);
    let link = move || app.address();
    // The link is copied as soon as the input is packed into it.
    Effect::new(move || {
        let payload = desk.payload.get();
        if !wanted.get() {
            return;
        }
        match payload {
            None => {}
            Some(Ok(_)) => {
                wanted.set(false);
                copy(untrack(link), said, t("Link copied."));
            }
            Some(Err(why)) => {
                wanted.set(false);
                said.set(Some(text!("{} A file was saved instead: send that.", why)));
                desk.ask(ToDesk::Export(FileKind::Recording));
            }
        }
    });
    let share = move |_| {
        if desk.payload.with_untracked(Option::is_none) {
            desk.share();
        }
        wanted.set(true);
    };
    let file = move |kind: FileKind, title: &'static str, id: &'static str| {
        view! {
            <button data-testid=id on:click=move |_| desk.ask(ToDesk::Export(kind))>{title}</button>
        }
    };
    let printing = RwSignal::new(false);
    let print = move |_| {
        printing.set(true);
        desk.ask(ToDesk::Report);
    };
    Effect::new(move || {
        desk.report.track();
        if printing.get_untracked() {
            printing.set(false);
            // When what came has been drawn.
            request_animation_frame(|| {
                // Where nothing can be printed the report is only not printed.
                let _ = window().print();
            });
        }
    });
    Effect::new(move || {
        if let Some(source) = desk.source.get() {
            desk.source.set(None);
            copy(source, said, t("Source copied."));
        }
    });
    let copy_as = move |language: Language| {
        let copy_source = move |_| desk.ask(ToDesk::Source(language.name().into()));
        view! {
            <button data-testid="copy-as" data-value=language.name() on:click=copy_source>{language.name()}</button>
        }
    };
    move || {
        (!desk.is_empty()).then(|| {
            view! {
                <h2>{t("Send it on")}</h2>
                <div class="doors">
                    <button class="primary" data-testid="share" on:click=share>{t("Copy link")}</button>
                    {file(FileKind::Csv, "CSV", "save-csv")}
                    {file(FileKind::JsonLines, t("JSON lines"), "save-json")}
                    {file(FileKind::Recording, t("Save as a file"), "save-recording")}
                    <button data-testid="print" on:click=print>{t("Print a report")}</button>
                </div>
                <div class="doors">
                    <span class="hint">{t("Copy this decoder as")}</span>
                    {Language::ALL.iter().copied().map(copy_as).collect_view()}
                </div>
                {move || said.get().map(|text| view! { <p class="hint" role="status" data-testid="said">{text}</p> })}
            }
        })
    }
}
