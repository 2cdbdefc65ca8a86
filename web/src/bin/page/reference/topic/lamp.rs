//! What the lamp shows, what the bits say, and what to do.

use super::super::{
    Scroll,
    book::{Book, link},
    calculator::{CopyLink, sentence},
    choice::Choice,
};
use crate::{app::App, live::tone};
use encoderscope::{
    calculator::Fault,
    format::STATUS,
    lamp::{BATTERY, Cause, Flag, Health, Lamp, Light, ReadBit, Rhythm, about, flags},
    language::t,
    layout::{Active, Role},
    product::{Interface, Series},
    text,
};
use leptos::prelude::*;

/// What is asked: a lamp that is seen, or a status byte that is read.
#[derive(Clone, Copy, PartialEq)]
enum Asked {
    Lamp(Lamp),
    Status(Health),
}

fn asked(book: Book) -> Result<Asked, Fault> {
    match book.entry("status") {
        Some(status) => Health::parse(&status).map(Asked::Status),
        None => {
            let entry = |name, usual: &str| book.entry(name).unwrap_or(usual.to_owned());
            Lamp::parse(&entry("lamp", "green"), &entry("blinking", "no")).map(Asked::Lamp)
        }
    }
}

#[component]
pub(super) fn Page() -> impl IntoView {
    let book = expect_context::<App>().book();
    let asked = Memo::new(move |_| asked(book));
    let lamp = Signal::derive(move || match asked.get() {
        Ok(Asked::Status(health)) => health.lamp().light.name().to_owned(),
        _ => book.entry("lamp").unwrap_or_else(|| "green".to_owned()),
    });
    let blinking = Signal::derive(move || match asked.get() {
        Ok(Asked::Status(health)) if health.lamp().rhythm == Rhythm::Blinking => "yes".to_owned(),
        Ok(Asked::Status(_)) => "no".to_owned(),
        _ => book.entry("blinking").unwrap_or_else(|| "no".to_owned()),
    });
    let enter = move |text: String| {
        book.clear("lamp");
        book.clear("blinking");
        match text.trim().is_empty() {
            true => book.clear("status"),
            false => book.enter("status", &text),
        }
    };
    let wrong = move || {
        let fault = asked.with(|asked| asked.as_ref().err().map(|fault| fault.input));
        (fault == Some("status")).then_some("true")
    };
    let lights = Light::ALL.map(|light| (light.name(), t(light.name())));
    view! {
        <section class="part" aria-label=t("What is seen")>
            <div class="form">
                <Choice
                    name="lamp"
                    title=t("The lamp is")
                    hint=t("of MPP and PT")
                    words=lights.to_vec()
                    chosen=lamp
                    clears=&["status"]
                />
                <Choice
                    name="blinking"
                    title=t("It blinks")
                    hint=t("once a second")
                    words=vec![("no", t("no")), ("yes", t("yes"))]
                    chosen=blinking
                    clears=&["status"]
                />
                <div class="asked">
                    <label for="lamp-status">{t("Or the status byte is")}</label>
                    <span class="entered">
                        <input
                            id="lamp-status"
                            data-testid="lamp-status"
                            aria-describedby="lamp-status-hint"
                            aria-invalid=wrong
                            spellcheck="false"
                            autocomplete="off"
                            prop:value=move || book.entry("status").unwrap_or_default()
                            on:input:target=move |event| enter(event.target().value())
                        />
                    </span>
                    <p class="hint" id="lamp-status-hint">{t("two hex digits, or eight bits with b7 first")}</p>
                </div>
            </div>
        </section>
        <section class="part" aria-label=t("What it means") aria-live="polite">
            {move || match asked.get() {
                Ok(Asked::Lamp(lamp)) => match lamp.causes() {
                    Ok(causes) => view! { <Seen lamp=lamp causes=causes /> }.into_any(),
                    Err(fault) => view! { <Refused fault=fault /> }.into_any(),
                },
                Ok(Asked::Status(health)) => view! { <Read health=health /> }.into_any(),
                Err(fault) => view! { <Refused fault=fault /> }.into_any(),
            }}
            <CopyLink />
        </section>
        <Places />
        <BatteryBits />
        <section class="part" aria-labelledby="lamp-series">
            <h2 id="lamp-series">{t("Which encoders have what")}</h2>
            <ul class="warnings">
                {[Series::Mpp, Series::Ip75, Series::Avs58]
                    .map(|series| view! { <li data-testid="lamp-series">{about(series)}</li> })
                    .into_view()}
            </ul>
        </section>
    }
}

#[component]
fn Refused(fault: Fault) -> impl IntoView {
    view! { <p class="fault" data-testid="lamp-fault" data-input=fault.input>{sentence(&fault)}</p> }
}

/// What a lamp shows, in its colour and in words.
#[component]
fn Shows(lamp: Lamp) -> impl IntoView {
    let blinking = lamp.rhythm == Rhythm::Blinking;
    let text = match blinking {
        true => text!("{}, blinking", lamp.light.meaning()),
        false => lamp.light.meaning().to_owned(),
    };
    view! {
        <p
            class=format!("lamp {}", tone(lamp.light))
            class:blink=blinking
            data-testid="lamp-shows"
            data-value=lamp.name()
        >
            <b>{text}</b>
        </p>
        <p class="remedy">{t("What to do: ")} {lamp.remedy()} "."</p>
    }
}

#[component]
fn Seen(lamp: Lamp, causes: Vec<Cause>) -> impl IntoView {
    let rows: Vec<_> = causes
        .into_iter()
        .map(|cause| view! { <Bit place=cause.bit.place name=cause.bit.name text=cause.text remedy=cause.remedy /> })
        .collect();
    let none = rows.is_empty();
    view! {
        <Shows lamp=lamp />
        {match none {
            true => view! { <p class="hint">{t("It stands for no status bit.")}</p> }.into_any(),
            false => view! {
                <Bits caption=t("At least one of these is set")>{rows}</Bits>
            }.into_any(),
        }}
    }
}

#[component]
fn Read(health: Health) -> impl IntoView {
    let row = |bit: ReadBit| {
        view! {
            <Bit place=bit.place name=bit.name text=bit.text remedy=bit.remedy set=bit.set />
        }
    };
    let rows: Vec<_> = health.bits().into_iter().map(row).collect();
    let odd: Vec<_> = health
        .oddities()
        .into_iter()
        .map(|text| view! { <li data-testid="lamp-oddity">{text} "."</li> })
        .collect();
    view! {
        <Shows lamp=health.lamp() />
        {(!odd.is_empty()).then(|| view! { <ul class="warnings">{odd}</ul> })}
        <Bits caption=t("The byte, bit by bit")>{rows}</Bits>
    }
}

#[component]
fn Bits(caption: &'static str, children: Children) -> impl IntoView {
    view! {
        <Scroll label=caption.to_owned()>
            <table>
                <caption>{caption}</caption>
                <thead>
                    <tr>
                        <th scope="col">{t("bit")}</th>
                        <th scope="col">{t("name")}</th>
                        <th scope="col">{t("what it says")}</th>
                        <th scope="col">{t("what to do")}</th>
                    </tr>
                </thead>
                <tbody>{children()}</tbody>
            </table>
        </Scroll>
    }
}

#[component]
fn Bit(
    place: u32,
    name: &'static str,
    text: &'static str,
    remedy: &'static str,
    #[prop(optional, into)] set: Option<bool>,
) -> impl IntoView {
    let value = set.map(|set| if set { " = 1" } else { " = 0" });
    view! {
        <tr
            data-testid="lamp-bit"
            data-name=name
            data-set=set.map(|set| set.to_string())
            class:quiet=set == Some(false)
        >
            <td><b>{format!("b{place}")}</b> {value}</td>
            <th scope="row">{t(name)}</th>
            <td class="words">{t(text)}</td>
            <td class="words doc">{t(remedy)}</td>
        </tr>
    }
}

/// Where the bits stand in the frames of each interface.
#[component]
fn Places() -> impl IntoView {
    let rows = Interface::ALL.map(|interface| {
        let flags = flags(interface);
        let of = |role| {
            let mine = flags.iter().filter(|flag| flag.role == role);
            mine.map(|flag| bit(flag, false))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let status: Vec<&Flag> = flags
            .iter()
            .filter(|flag| flag.role == Role::Status)
            .collect();
        let is_common = status.len() == STATUS.len();
        let status = match (status.first(), status.last()) {
            (Some(first), Some(last)) if is_common => format!("b{}…b{}", first.place, last.place),
            _ => status
                .iter()
                .map(|flag| bit(flag, true))
                .collect::<Vec<_>>()
                .join(", "),
        };
        let others = flags
            .iter()
            .filter(|flag| matches!(flag.role, Role::Alarm | Role::Valid | Role::ZeroDefault));
        let others: Vec<_> = others.map(|flag| bit(flag, true)).collect();
        let profile = interface.format().default_profile();
        view! {
            <tr data-testid="lamp-place" data-name=interface.key()>
                <th scope="row"><a href=link(&profile, None)>{t(interface.title())}</a></th>
                <td data-name="error">{of(Role::Error)}</td>
                <td data-name="warning">{of(Role::Warning)}</td>
                <td class="words" data-name="status">{status}</td>
                <td class="words" data-name="others">{others.join(", ")}</td>
            </tr>
        }
    });
    view! {
        <section class="part" aria-labelledby="lamp-places">
            <h2 id="lamp-places">{t("Where the bits stand")}</h2>
            <p class="hint">
                {t("Clocked frames count from their last bit, b0, on; the others within the byte. Out of the layouts, and as MPP and PT have it in their table of positions.")}
            </p>
            <Scroll label=t("Where the bits stand").to_owned()>
                <table>
                    <caption class="unseen">{t("Places of error, warning and status")}</caption>
                    <thead>
                        <tr>
                            <th scope="col">{t("interface")}</th>
                            <th scope="col">{t("error")}</th>
                            <th scope="col">{t("warning")}</th>
                            <th scope="col">{t("status")}</th>
                            <th scope="col">{t("others")}</th>
                        </tr>
                    </thead>
                    <tbody>{rows.into_view()}</tbody>
                </table>
            </Scroll>
        </section>
    }
}

fn bit(flag: &Flag, named: bool) -> String {
    let level = match flag.active {
        Active::High => 1,
        Active::Low => 0,
    };
    match named {
        true => format!("{} b{} = {level}", flag.name, flag.place),
        false => format!("b{} = {level}", flag.place),
    }
}

/// The manuals' table of the battery's bits.
#[component]
fn BatteryBits() -> impl IntoView {
    let rows = BATTERY.each_ref().map(|row| {
        let bit = STATUS.iter().find(|bit| bit.place == row.place);
        let name = bit.map_or("", |bit| bit.name);
        view! {
            <tr data-testid="lamp-battery" data-name=name>
                <td><b>{format!("b{}", row.place)}</b></td>
                <th scope="row">{t(name)}</th>
                <td class="words">{t(row.warning.unwrap_or("–"))}</td>
                <td class="words">{t(row.error)}</td>
                <td class="words doc">{t(row.remedy)}</td>
            </tr>
        }
    });
    view! {
        <section class="part" aria-labelledby="lamp-battery">
            <h2 id="lamp-battery">{t("Bits of the battery")}</h2>
            <Scroll label=t("Bits of the battery").to_owned()>
                <table>
                    <caption class="unseen">{t("Bits of the battery, models BM")}</caption>
                    <thead>
                        <tr>
                            <th scope="col">{t("bit")}</th>
                            <th scope="col">{t("name")}</th>
                            <th scope="col">{t("with the warning bit")}</th>
                            <th scope="col">{t("with the error bit")}</th>
                            <th scope="col">{t("what to do")}</th>
                        </tr>
                    </thead>
                    <tbody>{rows.into_view()}</tbody>
                </table>
            </Scroll>
            <p class="source">{t("Source: MPP and PT, status bits")}</p>
        </section>
    }
}
