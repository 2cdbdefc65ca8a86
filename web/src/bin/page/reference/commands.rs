//! What can be asked of an encoder, and the sequences that change it.

use super::{Part, Scroll, book::Section, kinds::Kind};
use encoderscope::{
    explain::grouped,
    format::{Format, bus::Operation, rs485::Command, t485::Request},
    layout::{Layout, Resolved, Shape},
    profile::Profile,
    sequence::{Change, Expect, Script, Step},
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
                sign: request.name().replace('-', " "),
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
    Some(asked.title)
}

#[component]
pub(super) fn Commands(profile: Profile) -> impl IntoView {
    let plural = |count: usize| match count {
        1 => "1 byte".to_owned(),
        count => format!("{count} bytes"),
    };
    let rows: Vec<_> = asked(&profile)
        .into_iter()
        .map(|asked| {
            let (there, back) = asked.lengths;
            let effect = match (asked.is_known, asked.changes) {
                (false, _) => {
                    view! { <td class="words doc">"not known to the encoders of this page"</td> }
                        .into_any()
                }
                (true, true) => view! { <td class="words changes">"yes"</td> }.into_any(),
                (true, false) => view! { <td class="words">"no"</td> }.into_any(),
            };
            view! {
                <tr data-testid="reference-request" data-value=asked.byte>
                    <td><b>{format!("0x{:02X}", asked.byte)}</b></td>
                    <td>{asked.sign}</td>
                    <th scope="row">{asked.title}</th>
                    <td>{plural(there)}</td>
                    <td>{plural(back)}</td>
                    {effect}
                </tr>
            }
        })
        .collect();
    let caption = match profile.format {
        Format::Bus => format!("Requests to the device 0x{:02X}", profile.address),
        _ => "Requests".to_owned(),
    };
    view! {
        <Part profile=profile section=Section::Commands>
            <Scroll label=caption.clone()>
                <table>
                    <caption>{caption}</caption>
                    <thead>
                        <tr>
                            <th scope="col">"byte"</th>
                            <th scope="col">"sign"</th>
                            <th scope="col">"asks for"</th>
                            <th scope="col">"request"</th>
                            <th scope="col">"reply"</th>
                            <th scope="col">"changes the encoder"</th>
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
                "Anything unexpected ends them. The encoder acts on the last command alone: until then nothing has changed."
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
                <th scope="row">{step.send.title()}</th>
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
                (0, 1) if script.round.len() > 1 => "in order",
                (0, 1) => "once",
                (0, 10) => "ten times in a row",
                (0, _) => "each round",
                _ => "",
            };
            row(when, step, "round")
        })
        .collect();
    let rests = (script.settles > 0).then(|| {
        let rests = format!(
            "Then the encoder is silent for up to {} ms. ",
            grouped(script.settles / 1000)
        );
        view! { {rests} }
    });
    view! {
        <section class="kind" data-testid="reference-sequence" data-value=script.title>
            <h3>{script.title}</h3>
            <Scroll label=script.title.to_owned()>
                <table class="sequence">
                    <caption class="unseen">{format!("Steps of {}", script.title)}</caption>
                    <thead>
                        <tr>
                            <th scope="col">"when"</th>
                            <th scope="col">"bytes"</th>
                            <th scope="col">"command"</th>
                            <th scope="col">"must come back"</th>
                        </tr>
                    </thead>
                    <tbody>
                        {row("first", &script.before, "")}
                        {rounds}
                        {row("last", &script.after, "")}
                    </tbody>
                </table>
            </Scroll>
            <p class="hint">{rests} "It is done when " {script.proof.to_string()} "."</p>
        </section>
    }
}
