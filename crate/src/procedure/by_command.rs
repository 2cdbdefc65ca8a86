//! Zeros that are set by commands: the scripts of [`crate::sequence`] in words.

use super::{Missing, Procedure, STILL, Step, Zero};
use crate::{
    format::{Format, bus::Operation},
    language::t,
    product::Interface,
    profile::Profile,
    sequence::{Change, Expect, Proof, Script, Send},
    text,
};
use alloc::{format, string::String, vec::Vec};

pub(super) fn rs485(interface: Interface) -> Zero {
    let source = t("MPP, RS485 and RS422, note 3; PT, RS485, note 1");
    let about = match interface {
        Interface::Rs422 => {
            t("The present position becomes 0 and is stored. Send on RX, hear on TX.")
        }
        _ => t("The present position becomes 0 and is stored."),
    };
    let zero = Procedure {
        name: "set-zero",
        title: t("Set zero by command"),
        about,
        notes: [
            t("Any other command between them starts the count again."),
            t("PT names only the command 0x30, ten times, with 0x31 between; MPP the same in pairs."),
        ]
        .into(),
        ..of(Format::Rs485.default_profile(), Change::Zero, source)
    };
    Zero {
        procedures: [zero].into(),
        missing: [Missing {
            text: t("No command brings the factory's zero back."),
            source: t("MPP and PT, RS485: commands"),
        }]
        .into(),
    }
}

pub(super) fn t485() -> Zero {
    let source = t("MPP, T485, notes 3 and 4; PT, T485, note 3");
    let profile = Format::T485.default_profile();
    let row = t("Ten in a row: another request between them starts over.");
    let angle = Procedure {
        name: "reset-angle",
        title: t("Reset the angle by command"),
        about: t("The present angle becomes 0; the turns are reset by a command of their own."),
        notes: [
            row,
            t("The replies count nothing: only the angle shows that it has acted."),
        ]
        .into(),
        ..of(profile, Change::ResetAngle, source)
    };
    let turns = Procedure {
        name: "reset-turns",
        title: t("Reset the turns by command"),
        about: t("The turns become 0; the angle stays."),
        notes: [
            row,
            t("The replies carry the angle: read the turns to see that it has acted."),
        ]
        .into(),
        ..of(profile, Change::ResetTurns, source)
    };
    Zero {
        procedures: [angle, turns].into(),
        missing: [Missing {
            text: t(
                "The manuals name no time for which the encoder is silent afterwards, and no \
                   command that brings the factory's zero back.",
            ),
            source,
        }]
        .into(),
    }
}

pub(super) fn bus() -> Zero {
    let source = t("MPP and PT, BUS, set zero");
    let zero = Procedure {
        name: "set-zero",
        title: t("Set zero by command"),
        about: t("The present position of the encoder at one address becomes 0 and is stored."),
        notes: [
            t("C = 0: the command before was not 00, get."),
            t("C = 1: the set zero before it was missing; the count starts from there."),
            t("Send each command only after the reply to the one before."),
            t("The bytes are for the factory's address 0x1F; another address has others."),
        ]
        .into(),
        ..of(Format::Bus.default_profile(), Change::Zero, source)
    };
    Zero {
        procedures: [zero].into(),
        missing: [Missing {
            text: t("No command brings the factory's zero back."),
            source: t("MPP and PT, BUS: operations"),
        }]
        .into(),
    }
}

/// The script of a change, in words.
fn of(profile: Profile, change: Change, source: &'static str) -> Procedure {
    let mut steps = Vec::from([Step::by_hand(
        t(STILL.0),
        t(STILL.1),
        t("MPP and PT, repeatability"),
    )]);
    if let Some(script) = change.script(&profile) {
        steps.extend(commands(&profile, change, script, source));
    }
    Procedure {
        name: "",
        title: "",
        about: "",
        steps,
        notes: Vec::new(),
        change: Some(change),
        console: Some(profile),
    }
}

fn commands(profile: &Profile, change: Change, script: &Script, source: &'static str) -> Vec<Step> {
    let named = |send: Send| {
        let bytes = change.bytes(profile, send);
        let hex: Vec<String> = bytes.iter().map(|byte| format!("0x{byte:02X}")).collect();
        format!("{} ({})", hex.join(" "), title(send))
    };
    let sent = |text: String, expect: String, steps: &[crate::sequence::Step], times| Step {
        text,
        expect,
        sends: steps
            .iter()
            .map(|step| change.bytes(profile, step.send))
            .collect(),
        times,
        source,
    };
    let round: Vec<String> = script.round.iter().map(|step| named(step.send)).collect();
    let counts = script
        .round
        .iter()
        .any(|step| step.expect == Expect::CountsRound);
    let last = script.rounds;
    let counted = match counts {
        true => text!("each round counts one more: C = 1, 2 … {}", last),
        false => t("a good reply to each").into(),
    };
    let times = match script.round.len() {
        1 => text!("Send {} {} times in a row.", round.join(""), last),
        _ => text!("Send {}, {} times in turn.", round.join(t(", then ")), last),
    };
    let mut steps = Vec::from([
        sent(
            text!("Send {}.", named(script.before.send)),
            t("a good reply: the encoder is there, and what an earlier try has left is broken off")
                .into(),
            &[script.before],
            1,
        ),
        sent(times, counted, script.round, last),
    ]);
    if script.settles > 0 {
        steps.push(Step::by_hand(
            text!("Wait {} ms.", script.settles / 1_000),
            t("nothing: the encoder stores the zero and answers no command"),
            source,
        ));
    }
    let proof = match script.proof {
        Proof::Count => t("the position is 0, but for what the shaft has moved"),
        Proof::Angle => t("the angle is 0, but for what the shaft has moved"),
        Proof::Turns => t("the turns are 0"),
        Proof::Errors => t("no error"),
        Proof::Memory => t("the byte that was written"),
    };
    steps.push(sent(
        text!("Send {}.", named(script.after.send)),
        proof.into(),
        &[script.after],
        1,
    ));
    steps
}

/// Operations of the bus go by their code.
fn title(send: Send) -> String {
    match send {
        Send::Bus(operation @ (Operation::Get | Operation::SetZero | Operation::SetAddress)) => {
            format!("{:02b}, {}", operation.code(), t(operation.title()))
        }
        other => t(other.title()).into(),
    }
}
