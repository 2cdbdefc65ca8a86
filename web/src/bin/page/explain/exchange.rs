//! Out of the explainer, and into it: links, pictures, WaveDrom, a tag for one's own pages.

use crate::{
    app::App,
    handout::{copy, save_text},
};
use encoderscope::{
    diagram::{Master, bitfield, svg, wavejson},
    format::own::{self, Framing},
    language::t,
    profile::Profile,
    sketch::Sketch,
};
use leptos::prelude::*;

#[component]
pub(super) fn Exchange() -> impl IntoView {
    let app = expect_context::<App>();
    let paper = app.paper();
    let said = RwSignal::new(None::<String>);
    Effect::new(move || {
        paper.sketch.track();
        said.set(None);
    });
    let file =
        move |id: &'static str, title: &'static str, write: fn(&Sketch) -> (String, &str)| {
            let hand = move |_| {
                if let Some((text, name)) = untrack(|| {
                    paper.with(|sketch| {
                        let (text, name) = write(sketch);
                        (text, name.to_owned())
                    })
                }) {
                    save_text(&text, &name);
                }
            };
            view! { <button data-testid=id on:click=hand>{title}</button> }
        };
    let link = move |_| copy(untrack(|| app.address()), said, t("Link copied."));
    let tag = move |_| {
        if let Some(tag) = untrack(|| paper.with(tag)) {
            copy(
                tag,
                said,
                t("Tag copied: paste it into an HTML page that loads encoder-frame.js."),
            );
        }
    };
    view! {
        <section class="panel exchange">
            <h2>{t("Send it on")}</h2>
            <div class="doors">
                <button class="primary" data-testid="share" on:click=link>{t("Copy link")}</button>
                {file("save-svg", t("Picture (SVG)"), picture)}
                {file("save-wavejson", "WaveJSON", wave)}
                {file("save-bitfield", t("Bit field"), fields)}
                <button data-testid="copy-tag" on:click=tag>{t("Copy as <encoder-frame>")}</button>
            </div>
            {move || said.get().map(|text| view! { <p class="hint" role="status" data-testid="said">{text}</p> })}
            <Import />
        </section>
    }
}

fn picture(sketch: &Sketch) -> (String, &'static str) {
    let timeline = sketch.timeline(&Master::default());
    let picture = svg::frame(&sketch.frame(), Some(&timeline), &svg::Style::default());
    (picture, "frame.svg")
}

fn wave(sketch: &Sketch) -> (String, &'static str) {
    let timeline = sketch.timeline(&Master::default());
    (
        wavejson::written(&sketch.frame(), &timeline).to_string(),
        "frame.wave.json",
    )
}

fn fields(sketch: &Sketch) -> (String, &'static str) {
    (
        bitfield::written(&sketch.kind().layout).to_string(),
        "frame.bitfield.json",
    )
}

/// The tag that shows this frame in a page of one's own.
fn tag(sketch: &Sketch) -> String {
    let profile = sketch.decoder().profile().parameters().into_iter();
    let mut attributes: Vec<(String, String)> = profile
        .map(|(name, value)| (name.to_owned(), value.plain()))
        .collect();
    attributes.push(("direction".into(), sketch.kind().direction.name().into()));
    attributes.push(("frame".into(), sketch.text()));
    let attributes = attributes.into_iter().map(|(name, value)| {
        let value = value
            .replace('&', "&amp;")
            .replace('"', "&quot;")
            .replace('<', "&lt;");
        format!(" {name}=\"{value}\"")
    });
    format!(
        "<encoder-frame{}></encoder-frame>",
        attributes.collect::<String>()
    )
}

/// WaveDrom's descriptions, read.
#[component]
fn Import() -> impl IntoView {
    let app = expect_context::<App>();
    let fault = RwSignal::new(None::<String>);
    let text = RwSignal::new(String::new());
    let read = move |_| {
        let text = text.get_untracked();
        let done = match text.trim_start().starts_with('[') {
            true => read_fields(app, &text),
            false => read_wave(app, &text),
        };
        fault.set(done.err());
    };
    view! {
        <details>
            <summary>{t("Read a WaveDrom description")}</summary>
            <p class="hint">
                {t("WaveJSON with clock and data is read as a frame of the present profile; a bit field becomes a layout of your own.")}
            </p>
            <textarea
                class="import"
                spellcheck="false"
                aria-label=t("WaveJSON or bit field")
                data-testid="import-text"
                prop:value=text
                on:input:target=move |event| text.set(event.target().value())
            ></textarea>
            <button data-testid="import" on:click=read>{t("Read")}</button>
            {move || fault.get().map(|fault| view! { <p class="fault" role="alert">{fault}</p> })}
        </details>
    }
}

fn read_wave(app: App, text: &str) -> Result<(), String> {
    let profile = app.profile.get_untracked();
    let bits = wavejson::read(text, &profile).map_err(|why| why.to_string())?;
    app.paper().take_bits(bits, profile, None);
    Ok(())
}

fn read_fields(app: App, text: &str) -> Result<(), String> {
    let present = app.profile.get_untracked();
    let framing = match present.is_serial() {
        true => Framing::Stream,
        false => Framing::Line,
    };
    let written = bitfield::read(text, "bit field", framing).map_err(|why| why.to_string())?;
    let layout = written.to_string();
    own::of(&layout)?;
    let pairs = [("format", "own"), ("layout", layout.as_str())];
    let profile = Profile::parse(pairs).map_err(|error| error.to_string())?;
    app.change_profile(profile);
    Ok(())
}
