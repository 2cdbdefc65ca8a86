//! SHIFT: the word of an encoder, as its profile reads it.

use super::{CONTROL, explainer::Explainer};
use crate::app::App;
use encoderscope::{
    apci1710::{Channel, Form, Register, Word, WordError},
    bits,
    decode::Decoder,
    explain::{Note, degrees_text, grouped, grouped_signed},
    format::{Format, Link},
    language::{number, t},
    profile::{Code, Profile},
    reading::Values,
    text,
};
use leptos::prelude::*;

/// What an example holds.
const TURNS: u64 = 5;

/// The word in a register.
#[derive(Clone, Debug, Default, PartialEq)]
struct Held {
    turns: Option<i64>,
    angle: Option<u64>,
    ok: bool,
    notes: Vec<Note>,
    error: Option<WordError>,
}

fn held(profile: Profile, value: &Result<u32, String>, form: Form) -> Held {
    let (Ok(decoder), Ok(value)) = (Decoder::new(profile), value) else {
        return Held::default();
    };
    match Word::read(&decoder, *value, form) {
        Ok(word) => Held {
            turns: word.values.turns,
            angle: word.values.angle,
            ok: word.ok,
            notes: word.notes,
            error: None,
        },
        Err(error) => Held {
            notes: Register::Shift(Channel::One).notes(*value),
            error: Some(error),
            ..Held::default()
        },
    }
}

/// A register that holds a plausible word.
fn example(profile: Profile, form: Form) -> String {
    let values = Values {
        turns: (profile.turns_bits > 0).then(|| {
            let turns = TURNS.min(bits::mask(profile.turns_bits as usize));
            i64::try_from(turns).unwrap_or(0)
        }),
        // Of all ones and zeros in turn every bit is seen.
        angle: Some(bits::mask(profile.angle_bits as usize) / 3),
        ..Values::default()
    };
    let decoder = Decoder::new(profile).ok();
    let register = decoder.and_then(|decoder| Word::write(&decoder, &values, form).ok());
    format!("0x{:08X}", register.unwrap_or(0))
}

#[component]
pub(super) fn Shift() -> impl IntoView {
    let app = expect_context::<App>();
    let book = app.book();
    let shared = Memo::new(move |_| app.profile.get());
    let is_clocked = Memo::new(move |_| shared.get().link() == Link::Clocked);
    let profile = Memo::new(move |_| match is_clocked.get() {
        true => shared.get(),
        false => Format::SsiTree.default_profile(),
    });
    let channel = Memo::new(move |_| {
        let named = book.entry("channel");
        let mut known = Channel::ALL.into_iter();
        known
            .find(|channel| named.as_deref() == Some(&channel.number().to_string()))
            .unwrap_or(Channel::One)
    });
    let form = Memo::new(move |_| {
        let control = book.entry("control").unwrap_or(CONTROL.to_owned());
        let control = Register::Control.entered(&control).unwrap_or(0);
        match control & channel.get().control() {
            0 => Form::Plain,
            _ => Form::Converted,
        }
    });
    let text = Memo::new(move |_| {
        let entered = book.entry("shift");
        entered.unwrap_or_else(|| example(profile.get(), form.get()))
    });
    let register = Register::Shift(Channel::One);
    let value = Memo::new(move |_| register.entered(&text.get()));
    let held = Memo::new(move |_| held(profile.get(), &value.get(), form.get()));
    let notes = Memo::new(move |_| held.with(|held| held.notes.clone()));
    view! {
        <Explainer register=register name="shift" text=text value=value notes=notes>
            <Whose shared=shared profile=profile />
            <div class="asked">
                <label for="register-channel">{t("Encoder")}</label>
                <select
                    id="register-channel"
                    data-testid="register-channel"
                    on:change:target=move |event| book.enter("channel", &event.target().value())
                >
                    {Channel::ALL
                        .map(|known| view! {
                            <option
                                value=known.number().to_string()
                                selected=move || channel.get() == known
                            >
                                {format!("{} (+{})", known.number(), Register::Shift(known).offset())}
                            </option>
                        })
                        .into_view()}
                </select>
            </div>
            <p class="hint" data-testid="shift-form">
                {move || said(profile.get(), form.get(), channel.get())}
            </p>
            <Position held=held profile=profile />
        </Explainer>
    }
}

/// What CONTROL makes of the word.
fn said(profile: Profile, form: Form, channel: Channel) -> String {
    let bit = channel.number() - 1;
    match (form, profile.code) {
        (Form::Plain, Code::Gray) => text!(
            "D{} of CONTROL is 0: the word is the Gray code of the encoder, to be converted by the program.",
            bit
        ),
        (Form::Plain, Code::Binary) => {
            text!(
                "D{} of CONTROL is 0: the word stands as the encoder sends it.",
                bit
            )
        }
        (Form::Converted, Code::Gray) => text!(
            "D{} of CONTROL is 1: the module has converted the Gray code; what stands behind the number means nothing.",
            bit
        ),
        (Form::Converted, Code::Binary) => text!(
            "D{} of CONTROL is 1, but this encoder sends binary: the module has garbled the word. Here that is taken back; set the bit to 0.",
            bit
        ),
    }
}

/// Which profile reads the word.
#[component]
fn Whose(shared: Memo<Profile>, profile: Memo<Profile>) -> impl IntoView {
    let book = expect_context::<App>().book();
    move || {
        let (shared, profile) = (shared.get(), profile.get());
        (shared != profile).then(|| {
            view! {
                <p class="hint" data-testid="shift-profile">
                    {text!("This encoder speaks {}, which no SSI module reads: the word is read as that of {}, {} bits. ", t(shared.title()), t(profile.title()), profile.frame_bits)}
                    <a href=book.fragment(&profile)>{t("Take this encoder")}</a>
                </p>
            }
        })
    }
}

#[component]
fn Position(held: Memo<Held>, profile: Memo<Profile>) -> impl IntoView {
    let book = expect_context::<App>().book();
    move || {
        let held = held.get();
        let angle_bits = profile.get().angle_bits;
        let error = held.error.map(|error| {
            let known = Format::SsiTree.default_profile();
            view! {
                <p class="fault" data-testid="shift-fault">
                    {error.to_string()} ". "
                    <a href=book.fragment(&known)>{t("Take a word of 25 bits")}</a>
                </p>
            }
        });
        let bad = held.error.is_none() && held.angle.is_some() && !held.ok;
        let bad = bad.then(|| {
            view! { <p class="fault" data-testid="shift-bad">{t("Not a good word: see below.")}</p> }
        });
        view! {
            <dl class="held">
                {held.turns.map(|turns| view! {
                    <div>
                        <dt>{t("turns")}</dt>
                        <dd class="name turns" data-testid="shift-turns" data-value=turns.to_string()>
                            {grouped_signed(turns)}
                        </dd>
                    </div>
                })}
                {held.angle.map(|angle| view! {
                    <div>
                        <dt>{t("angle")}</dt>
                        <dd class="name angle" data-testid="shift-angle" data-value=angle.to_string()>
                            {number(degrees_text(angle, angle_bits, 4)).to_string()} "° "
                            <span class="hint">{text!("{} counts", grouped(angle))}</span>
                        </dd>
                    </div>
                })}
            </dl>
            {error}
            {bad}
        }
    }
}
