//! What can be asked of an encoder, and the sequences that change it.

use super::{Part, Scroll, book::Section, kinds::Kind};
use encoderscope::{
    explain::grouped,
    format::{Format, bus::Operation, rs485::Command, t485::Request},
    language::t,
    layout::{Layout, Resolved, Shape},
    profile::Profile,
    sequence::{Change, Expect, Script, Step},
    text,
};
use leptos::prelude::*;

/// A request.
pub(super) struct Asked {
    /// Its first byte, which names it.
    pub(super) byte: u8,
    /// How people write it.
    pub(super) sign: String,
    pub(super) title: &'static str,
    /// Bytes of the request, and of what comes back.
    pub(super) lengths: (usize, usize),
    pub(super) changes: bool,
    /// Whether encoders of the profile know it.
    pub(super) is_known: bool,
}

/// All requests of a profile's format, whoever knows them.
pub(super) fn asked(profile: &Profile) -> Vec<Asked> {
    let bytes = |layout: &'static Layout| Resolved::new(layout, Shape::of(*profile)).len / 8;
    match profile.format {
        Format::Rs485 => Command::ALL
            .iter()
            .map(|command| Asked {
                byte: command.byte(),
                sign: format!("‘{}’", command.letter()),
                title: command.title(),
                lengths: (1, bytes(command.reply())),
                changes: command.changes_encoder(),
                is_known: true,
            })
            .collect(),
        Format::T485 => Request::ALL
            .iter()
            .map(|request| Asked {
                byte: request.byte(),
                sign: t(&request.name().replace('-', " ")).to_owned(),
                title: request.title(),
                lengths: (bytes(request.request()), bytes(request.reply())),
                changes: request.changes_encoder(),
                is_known: request.is_known_to(profile.dialect),
            })
            .collect(),
        Format::Bus => {
            let address = profile.address.try_into().unwrap_or(u8::MAX);
            let of = |operation: &Operation| Asked {
                byte: encoderscope::format::bus::request(profile, *operation, address),
                sign: format!("{:02b}", operation.code()),
                title: operation.title(),
                lengths: (1, bytes(operation.reply())),
                changes: operation.changes_encoder(),
                is_known: true,
            };
            Operation::ALL.iter().map(of).collect()
        }
        _ => Vec::new(),
    }
}

/// What a request asks for.
pub(super) fn asks_for(kind: &Kind) -> Option<&'static str> {
    let byte = *kind.bits().bytes().first()?;
    let mut all = asked(&kind.profile).into_iter();
    let asked = all.find(|asked| !kind.is_reply() && asked.byte == byte)?;
    Some(t(asked.title))
}

#[component]
pub(super) fn Commands(profile: Profile) -> impl IntoView {
    let plural = |count: usize| text!("{} {0|byte|bytes}", count);
    let rows: Vec<_> = asked(&profile)
        .into_iter()
        .map(|asked| {
            let (there, back) = asked.lengths;
            let effect = match (asked.is_known, asked.changes) {
                (false, _) => {
                    view! { <td class="words doc">{t("not known to the encoders of this page")}</td> }
                        .into_any()
                }
                (true, true) => view! { <td class="words changes">{t("yes")}</td> }.into_any(),
                (true, false) => view! { <td class="words">{t("no")}</td> }.into_any(),
            };
            view! {
                <tr data-testid="reference-request" data-value=asked.byte>
                    <td><b>{format!("0x{:02X}", asked.byte)}</b></td>
                    <td>{asked.sign}</td>
                    <th scope="row">{t(asked.title)}</th>
                    <td>{plural(there)}</td>
                    <td>{plural(back)}</td>
                    {effect}
                </tr>
            }
        })
        .collect();
    let caption = match profile.format {
        Format::Bus => text!(
            "Requests to the device 0x{}",
            format_args!("{:02X}", profile.address)
        ),
        _ => t("Requests").to_owned(),
    };
    view! {
        <Part profile=profile section=Section::Commands>
            <Scroll label=caption.clone()>
                <table>
                    <caption>{caption}</caption>
                    <thead>
                        <tr>
                            <th scope="col">{t("byte")}</th>
                            <th scope="col">{t("sign")}</th>
                            <th scope="col">{t("asks for")}</th>
                            <th scope="col">{t("request")}</th>
                            <th scope="col">{t("reply")}</th>
                            <th scope="col">{t("changes the encoder")}</th>
                        </tr>
                    </thead>
                    <tbody>{rows}</tbody>
                </table>
            </Scroll>
        </Part>
    }
}

#[component]
pub(super) fn Sequences(profile: Profile) -> impl IntoView {
    let all = Change::all(&profile).into_iter();
    let all: Vec<_> = all
        .filter_map(|change| {
            let script = change.script(&profile)?;
            Some(view! { <Sequence profile=profile change=change script=script /> })
        })
        .collect();
    view! {
        <Part profile=profile section=Section::Sequences>
            <p class="hint">
                {t("Anything unexpected ends them. The encoder acts on the last command alone: until then nothing has changed.")}
            </p>
            {all}
        </Part>
    }
}

#[component]
fn Sequence(profile: Profile, change: Change, script: &'static Script) -> impl IntoView {
    let row = move |when: &'static str, step: &Step, class: &'static str| {
        let bytes = change.bytes(&profile, step.send);
        let bytes: Vec<_> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
        let back = match step.expect {
            Expect::CountsRound => format!("{}, 1…{}", step.expect, script.rounds),
            expect => expect.to_string(),
        };
        view! {
            <tr class=class>
                <td class="doc words">{when}</td>
                <td><b>{bytes.join(" ")}</b></td>
                <th scope="row">{t(step.send.title())}</th>
                <td class="words">{back}</td>
            </tr>
        }
    };
    let rounds: Vec<_> = script
        .round
        .iter()
        .enumerate()
        .map(|(index, step)| {
            let when = match (index, script.rounds) {
                (0, 1) if script.round.len() > 1 => t("in order"),
                (0, 1) => t("once"),
                (0, 10) => t("ten times in a row"),
                (0, _) => t("each round"),
                _ => "",
            };
            row(when, step, "round")
        })
        .collect();
    let rests = (script.settles > 0).then(|| {
        let rests = text!(
            "Then the encoder is silent for up to {} ms. ",
            grouped(script.settles / 1000)
        );
        view! { {rests} }
    });
    view! {
        <section class="kind" data-testid="reference-sequence" data-value=script.title>
            <h3>{t(script.title)}</h3>
            <Scroll label=t(script.title).to_owned()>
                <table class="sequence">
                    <caption class="unseen">{text!("Steps of {}", t(script.title))}</caption>
                    <thead>
                        <tr>
                            <th scope="col">{t("when")}</th>
                            <th scope="col">{t("bytes")}</th>
                            <th scope="col">{t("command")}</th>
                            <th scope="col">{t("must come back")}</th>
                        </tr>
                    </thead>
                    <tbody>
                        {row(t("first"), &script.before, "")}
                        {rounds}
                        {row(t("last"), &script.after, "")}
                    </tbody>
                </table>
            </Scroll>
            <p class="hint">{rests} {t("It is done when ")} {script.proof.to_string()} "."</p>
        </section>
    }
}
