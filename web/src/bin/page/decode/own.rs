//! A layout of the user's own: a row a field, over the same tables as the manuals' formats.

use crate::{app::App, profile_editor::Offer};
use encoderscope::{
    format::own::{Draft, Framing, Kind, SHIPPED, Written},
    language::{msg, t},
    layout::Active,
    profile::Profile,
};
use leptos::prelude::*;

/// How frames can come, with a word for people.
const WAYS: [(&str, &str); 4] = [
    ("line", msg("clocked word (SSI)")),
    ("biss", "BiSS-C"),
    ("stream", msg("serial, unasked")),
    ("poll:31", msg("serial, answers a byte")),
];

#[component]
pub(super) fn OwnEditor() -> impl IntoView {
    let app = expect_context::<App>();
    let fault = RwSignal::new(None::<String>);
    let written = Memo::new(move |_| {
        let own = app.profile.get().own;
        own.map(|own| own.written().clone())
    });
    let take = move |text: &str| match app.profile.get_untracked().with("layout", text) {
        Ok(profile) => {
            fault.set(None);
            app.desk().choice.set(crate::desk::Choice::User);
            app.change_profile(profile);
        }
        Err(error) => fault.set(Some(error.message)),
    };
    let change = move |with: &dyn Fn(&mut Written)| {
        if let Some(mut new) = written.get_untracked() {
            with(&mut new);
            take(&new.to_string());
        }
    };
    let option = |text: &str| {
        let text = text.trim().to_owned();
        (!text.is_empty()).then_some(text)
    };
    let field = move |index: usize, draft: Draft| {
        let set = move |with: &dyn Fn(&mut Draft)| {
            change(&|written| {
                if let Some(field) = written.fields.get_mut(index) {
                    with(field);
                }
            });
        };
        // What is written beside kind, width, name and level, for whoever knows the words.
        let rest = {
            let plain = Draft {
                name: None,
                active: Active::High,
                ..draft.clone()
            };
            let text = plain.to_string();
            text.splitn(3, ':').nth(2).unwrap_or_default().to_owned()
        };
        let kinds = Kind::ALL.iter().map(|kind| {
            view! { <option value=kind.name() selected=*kind == draft.kind>{t(kind.name())}</option> }
        });
        let kind = move |name: String| {
            let known = Kind::ALL.iter().find(|kind| kind.name() == name);
            set(&|field| {
                if let Some(kind) = known {
                    let (least, most) = kind.widths();
                    let width = field.width.clamp(least, most);
                    *field = Draft::new(*kind, width);
                    if *kind == Kind::Crc {
                        field.width = 8;
                        field.crc.polynomial = 0x97;
                    }
                }
            });
        };
        let own_name = draft.name.clone();
        let (kind_name, width, active) = (draft.kind.name(), draft.width, draft.active);
        let details = move |text: String| {
            let name = own_name.clone();
            let text = match text.trim() {
                "" => format!("{kind_name}:{width}"),
                rest => format!("{kind_name}:{width}:{rest}"),
            };
            match text.parse::<Draft>() {
                Ok(new) => set(&|field| {
                    *field = Draft {
                        name: name.clone(),
                        active,
                        ..new.clone()
                    };
                }),
                Err(why) => fault.set(Some(why)),
            }
        };
        let name = draft.name.unwrap_or_default();
        view! {
            <tr data-testid="own-field">
                <td><select aria-label=t("Kind") on:change:target=move |event| kind(event.target().value())>{kinds.collect_view()}</select></td>
                <td>
                    <input
                        aria-label=t("Bits")
                        inputmode="numeric"
                        prop:value=width.to_string()
                        on:change:target=move |event| {
                            let width = event.target().value().trim().parse().unwrap_or(0);
                            set(&|field| field.width = width);
                        }
                    />
                </td>
                <td><input aria-label=t("Name") prop:value=name on:change:target=move |event| { let name = option(&event.target().value()); set(&|field| field.name.clone_from(&name)); } /></td>
                <td>
                    <input
                        type="checkbox"
                        aria-label=t("Active low")
                        prop:checked=active == Active::Low
                        on:change=move |_| set(&|field| field.active = match field.active { Active::Low => Active::High, Active::High => Active::Low })
                    />
                </td>
                <td><input aria-label=t("Details") data-testid="own-details" prop:value=rest on:change:target=move |event| details(event.target().value()) /></td>
                <td>
                    <button class="quiet" aria-label=t("Up") on:click=move |_| change(&|written| if index > 0 { written.fields.swap(index, index - 1) })>"↑"</button>
                    <button class="quiet" aria-label=t("Remove") on:click=move |_| change(&|written| { written.fields.remove(index); })>"×"</button>
                </td>
            </tr>
        }
    };
    let choose = move |name: String| {
        if let Some(shipped) = SHIPPED.iter().find(|shipped| shipped.name == name) {
            take(shipped.name);
        }
    };
    let short = move || app.profile.get().own.map_or("", |own| own.short());
    let poll = move |text: String| match format!("poll:{}", text.trim()).parse::<Framing>() {
        Ok(framing) => change(&|written| written.framing = framing),
        Err(why) => fault.set(Some(why)),
    };
    let titles = [t("Kind"), t("Bits"), t("Name"), t("low"), t("Details")]
        .map(|title| view! { <th>{title.to_lowercase()}</th> });
    view! {
        <div class="own" data-testid="own">
            <div class="profile">
                <label>
                    {t("Start from")}
                    <select data-testid="own-shipped" on:change:target=move |event| choose(event.target().value())>
                        <option value="" selected=move || SHIPPED.iter().all(|shipped| shipped.name != short())>"…"</option>
                        {SHIPPED.iter().map(|shipped| {
                            let title = shipped.text.split(';').next().unwrap_or_default();
                            view! { <option value=shipped.name selected=move || short() == shipped.name>{title}</option> }
                        }).collect_view()}
                    </select>
                </label>
                <label>
                    {t("Name")}
                    <input
                        data-testid="own-title"
                        prop:value=move || written.get().map(|written| written.title).unwrap_or_default()
                        on:change:target=move |event| { let title = event.target().value(); change(&|written| written.title.clone_from(&title)); }
                    />
                </label>
                <label>
                    {t("Frames come as")}
                    <select on:change:target=move |event| {
                        if let Ok(framing) = event.target().value().parse::<Framing>() {
                            change(&|written| written.framing = framing);
                        }
                    }>
                        {WAYS.map(|(way, title)| view! {
                            <option value=way selected=move || written.get().is_some_and(|written| written.framing.to_string().split(':').next() == way.split(':').next())>{t(title)}</option>
                        }).into_view()}
                    </select>
                </label>
            </div>
            {move || match written.get().map(|written| written.framing) {
                Some(Framing::Poll(byte)) => Some(view! {
                    <label class="poll">
                        {t("It answers to the byte")}
                        <input
                            data-testid="own-poll"
                            prop:value=format!("{byte:02X}")
                            on:change:target=move |event| poll(event.target().value())
                        />
                    </label>
                }),
                _ => None,
            }}
            <table>
                <thead><tr>{titles.into_view()}<th></th></tr></thead>
                <tbody>
                    {move || written.get().map(|written| {
                        written.fields.into_iter().enumerate().map(|(index, draft)| field(index, draft)).collect_view()
                    })}
                </tbody>
            </table>
            <button data-testid="own-add" on:click=move |_| change(&|written| written.fields.push(Draft::new(Kind::Skip, match written.framing { Framing::Line | Framing::Biss => 1, Framing::Stream | Framing::Poll(_) => 8 })))>{t("Add a field")}</button>
            <label>
                {t("As text")}
                <textarea
                    class="own-text"
                    data-testid="own-text"
                    spellcheck="false"
                    prop:value=move || written.get().map(|written| written.to_string()).unwrap_or_default()
                    on:change:target=move |event| take(&event.target().value())
                />
            </label>
            {move || fault.get().map(|fault| view! { <p class="fault" role="alert">{fault}</p> })}
            <p class="hint">{t("Details: le, gray, 0x… (polynomial or constant), init=, xor=, reflected, from= and to= (fields a check covers), bits=a|b. The layout is part of the link.")}</p>
        </div>
    }
}

/// The profile that the editor begins with.
pub(crate) fn first(offer: Offer) -> Option<Profile> {
    let profile = |name| Profile::parse([("format", "own"), ("layout", name)]).ok();
    let mut all = SHIPPED.iter().filter_map(|shipped| profile(shipped.name));
    all.find(|profile| offer == Offer::All || profile.is_serial())
}
