//! The raw log: every frame with its time, direction, bytes and verdict; and bytes by hand.

use crate::{
    app::{App, Source},
    frame_view::{Explained, FrameView},
};
use encoderscope::{decode::Decoder, dump, format::Medium, record::hex, sequence::danger};
use encoderscope_web::{
    link::query,
    message::{Entry, Link, LogFilter, ToEngine},
};
use leptos::prelude::*;

/// Most bytes that are sent by hand at once.
const BY_HAND: usize = 32;

#[component]
pub(crate) fn Frames() -> impl IntoView {
    let app = expect_context::<App>();
    let filter = RwSignal::new(LogFilter::All);
    let held = RwSignal::new(None::<Vec<Entry>>);
    let chosen = RwSignal::new(None::<Entry>);
    app.send(ToEngine::Log(LogFilter::All));
    // What was chosen is explained by the profile that it came with.
    Effect::new(move || {
        app.profile.track();
        chosen.set(None);
        held.set(None);
    });
    let log = Memo::new(move |_| held.get().unwrap_or_else(|| app.snapshot.get().log));
    let choose = move |entry: Entry| {
        // A row that runs away cannot be looked at.
        held.set(Some(log.get_untracked()));
        chosen.set(Some(entry));
    };
    let show = move |wanted: LogFilter| {
        filter.set(wanted);
        held.set(None);
        app.send(ToEngine::Log(wanted));
    };
    let pause = move |_| {
        held.update(|held| {
            *held = match held {
                Some(_) => None,
                None => Some(app.snapshot.get_untracked().log),
            };
        });
    };
    let filters = [
        (LogFilter::All, "all"),
        (LogFilter::Received, "received"),
        (LogFilter::Sent, "sent"),
        (LogFilter::Faults, "faults"),
        (LogFilter::Beside, "other"),
    ];
    view! {
        <section class="panel frames">
            <h2>"Frames"</h2>
            <div class="doors bar-of" role="group" aria-label="Which frames">
                {filters.map(|(wanted, text)| view! {
                    <button
                        class="quiet"
                        class:chosen=move || filter.get() == wanted
                        aria-pressed=move || (filter.get() == wanted).to_string()
                        data-testid="log-filter"
                        data-value=text
                        on:click=move |_| show(wanted)
                    >
                        {text}
                    </button>
                }).collect_view()}
                <button class="quiet" data-testid="log-pause" aria-pressed=move || held.get().is_some().to_string() on:click=pause>
                    {move || if held.get().is_some() { "go on" } else { "pause" }}
                </button>
            </div>
            <div class="rows-of">
                <table>
                    <thead>
                        <tr>
                            <th>"time"</th>
                            <th><span class="unseen">"direction"</span></th>
                            <th>"bytes"</th>
                            <th>"check"</th>
                        </tr>
                    </thead>
                    <tbody>
                        {move || log.get().into_iter().map(|entry| view! { <EntryRow entry=entry chosen=chosen choose=choose /> }).collect_view()}
                    </tbody>
                </table>
            </div>
            {move || chosen.get().map(|entry| view! { <Inspect entry=entry close=move || { chosen.set(None); held.set(None) } /> })}
            {move || (app.source.get() != Source::Preview).then(|| view! { <ByHand sent=move || show(LogFilter::Beside) /> })}
        </section>
    }
}

#[component]
fn EntryRow(
    entry: Entry,
    chosen: RwSignal<Option<Entry>>,
    choose: impl Fn(Entry) + Copy + 'static,
) -> impl IntoView {
    let bytes = entry.bytes.iter().map(|(byte, class)| {
        view! { <span class=format!("byte {class}")>{format!("{byte:02X}")}</span> }
    });
    let bytes = bytes.collect_view();
    let verdict = match entry.ok {
        Some(true) => ("verdict good", "✓".to_owned()),
        Some(false) => ("verdict bad", entry.text.clone()),
        None => ("verdict", entry.text.clone()),
    };
    let (direction, arrow) = if entry.sent {
        ("sent", "→")
    } else {
        ("received", "←")
    };
    let mine = entry.clone();
    let is_chosen = move || chosen.get().as_ref() == Some(&mine);
    let (ok, time) = (entry.ok, entry.time);
    view! {
        <tr
            class:chosen=is_chosen
            data-testid="frame-row"
            data-direction=direction
            data-ok=ok.map(|ok| ok.to_string())
            on:click=move |_| choose(entry.clone())
        >
            <td class="time"><button class="quiet" title="Explain these bytes">{format!("{time:.4}")}</button></td>
            <td title=direction>{arrow}</td>
            <td class="bytes">{bytes}</td>
            <td class=verdict.0>{verdict.1}</td>
        </tr>
    }
}

/// The chosen bytes, explained.
#[component]
fn Inspect(entry: Entry, close: impl Fn() + Copy + 'static) -> impl IntoView {
    let app = expect_context::<App>();
    let profile = app.profile.get_untracked();
    let bytes: Vec<u8> = entry.bytes.iter().map(|(byte, _)| *byte).collect();
    let text = hex(&bytes);
    let decoder = Decoder::new(profile).ok().filter(|_| !entry.sent);
    let explained = decoder.and_then(|decoder| {
        let frame = decoder.frame(&bytes)?;
        Some(Explained::new(frame.bits, true, frame.explain()))
    });
    let shown = match explained {
        Some(frame) => view! { <FrameView frame=frame /> }.into_any(),
        None => {
            view! { <p class="hint">{entry.text} " " <code>{text.clone()}</code></p> }.into_any()
        }
    };
    view! {
        <div class="inspect" data-testid="inspect">
            {shown}
            <div class="doors">
                <a class="button" href=format!("#/decode?{}&dump={text}", query(&profile))>"Open in the decoder"</a>
                <button on:click=move |_| close()>"Close"</button>
            </div>
        </div>
    }
}

/// What a line of text asks to be sent.
fn parse(text: &str) -> Result<Vec<u8>, String> {
    let dump = dump::parse(text, Medium::Bytes);
    let bytes = dump.bytes().to_vec();
    match bytes.len() {
        _ if !dump.unread().is_empty() || !dump.dropped().is_empty() => {
            // What is to be sent must not be guessed.
            let marks = dump.unread().places.iter().chain(&dump.dropped().places);
            let unread =
                marks.filter_map(|mark| text.get(mark.at.start as usize..mark.at.end as usize));
            Err(format!(
                "not bytes: {}",
                unread.collect::<Vec<_>>().join(" ")
            ))
        }
        0 => Err("hexadecimal bytes, for example 1A".into()),
        count if count > BY_HAND => Err(format!("{count} bytes are more than {BY_HAND}")),
        _ => Ok(bytes),
    }
}

/// Sends bytes by hand, and shows what comes back; those that change an encoder only after a question.
#[component]
fn ByHand(sent: impl Fn() + Copy + Send + 'static) -> impl IntoView {
    let app = expect_context::<App>();
    let text = RwSignal::new(String::new());
    let fault = RwSignal::new(None::<String>);
    let question = RwSignal::new(None::<(Vec<u8>, String)>);
    let open = Memo::new(move |_| {
        let snapshot = app.snapshot.get();
        let reads = !matches!(snapshot.link, Link::Opening | Link::Searching);
        snapshot.link.is_open() && reads && !snapshot.busy
    });
    // What was asked about one encoder is not sent to another.
    let target = Memo::new(move |_| {
        let open = app.snapshot.get().link.is_open();
        (open, app.port.get(), app.profile.get())
    });
    Effect::new(move || {
        target.track();
        question.set(None);
    });
    let send = move || {
        question.set(None);
        fault.set(None);
        match parse(&text.get_untracked()) {
            Err(why) => fault.set(Some(why)),
            Ok(bytes) => match danger(&app.profile.get_untracked(), &bytes) {
                Some(danger) => question.set(Some((bytes, danger.to_string()))),
                None => {
                    sent();
                    app.send(ToEngine::Send {
                        bytes,
                        confirmed: false,
                    });
                }
            },
        }
    };
    let confirm = move |bytes: Vec<u8>| {
        question.set(None);
        sent();
        app.send(ToEngine::Send {
            bytes,
            confirmed: true,
        });
    };
    view! {
        <form
            class="by-hand"
            on:submit=move |event| {
                event.prevent_default();
                send();
            }
        >
            <label>
                "Send bytes by hand"
                <input
                    name="by-hand"
                    placeholder="1A"
                    autocomplete="off"
                    spellcheck="false"
                    prop:value=move || text.get()
                    on:input:target=move |event| {
                        text.set(event.target().value());
                        question.set(None);
                    }
                />
            </label>
            <button data-testid="send" disabled=move || !open.get()>"Send"</button>
        </form>
        {move || fault.get().map(|fault| view! { <p class="fault" role="alert">{fault}</p> })}
        {move || question.get().map(|(bytes, why)| view! {
            <div class="question" role="alertdialog" data-testid="danger">
                <p>{why} ". It may change what the encoder holds."</p>
                <div class="doors">
                    <button data-testid="send-anyway" on:click=move |_| confirm(bytes.clone())>"Send it all the same"</button>
                    <button on:click=move |_| question.set(None)>"Do not send"</button>
                </div>
            </div>
        })}
    }
}
