//! Bytes that are sent by hand.

use crate::app::App;
use encoderscope::{dump, format::Medium, language::t, sequence::danger, text};
use encoderscope_web::message::{Link, Wish};
use leptos::prelude::*;

/// Most bytes that are sent by hand at once.
const BY_HAND: usize = 32;

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
            let unread = unread.collect::<Vec<_>>().join(" ");
            Err(text!("not bytes: {}", unread))
        }
        0 => Err(t("hexadecimal bytes, for example 1A").into()),
        count if count > BY_HAND => Err(text!("{} bytes are more than {}", count, BY_HAND)),
        _ => Ok(bytes),
    }
}

/// Sends bytes by hand, and shows what comes back; those that change an encoder only after a question.
#[component]
pub(crate) fn ByHand(sent: Callback<()>) -> impl IntoView {
    let app = expect_context::<App>();
    let text = RwSignal::new(String::new());
    let fault = RwSignal::new(None::<String>);
    let question = RwSignal::new(None::<(Vec<u8>, String)>);
    let open = Memo::new(move |_| {
        app.snapshot.with(|snapshot| {
            let reads = !matches!(snapshot.link, Link::Opening | Link::Searching);
            snapshot.link.is_open() && reads && !snapshot.busy
        })
    });
    // What was asked about one encoder is not sent to another.
    let target = Memo::new(move |_| {
        let open = app.snapshot.with(|snapshot| snapshot.link.is_open());
        (open, app.port.get(), app.profile.get())
    });
    Effect::new(move || {
        let _ = target.get();
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
                    sent.run(());
                    app.wish(&Wish::Send {
                        bytes,
                        confirmed: false,
                    });
                }
            },
        }
    };
    let confirm = move |bytes: Vec<u8>| {
        question.set(None);
        sent.run(());
        app.wish(&Wish::Send {
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
                {t("Send bytes by hand")}
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
            <button data-testid="send" disabled=move || !open.get()>{t("Send")}</button>
        </form>
        {move || fault.get().map(|fault| view! { <p class="fault" role="alert">{fault}</p> })}
        {move || question.get().map(|(bytes, why)| view! {
            <div class="question" role="alertdialog" data-testid="danger">
                <p>{text!("{}. It may change what the encoder holds.", why)}</p>
                <div class="doors">
                    <button data-testid="send-anyway" on:click=move |_| confirm(bytes.clone())>{t("Send it all the same")}</button>
                    <button on:click=move |_| question.set(None)>{t("Do not send")}</button>
                </div>
            </div>
        })}
    }
}
