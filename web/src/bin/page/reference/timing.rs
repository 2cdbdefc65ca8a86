//! What the manuals say of time.

use super::{
    Part, Scroll,
    book::Section,
    kinds::{self, Kind, length},
};
use encoderscope::{
    capture::Duration,
    diagram::{Master, Timeline},
    explain::grouped,
    format::timing::{SECOND, Words},
    language::{msg, t},
    profile::Profile,
    text,
};
use leptos::prelude::*;

/// A matter of time.
pub(super) struct Time {
    name: &'static str,
    text: String,
    source: &'static str,
}

/// All that is known of a profile's format.
pub(super) fn times(profile: &Profile, kinds: &[Kind]) -> Vec<Time> {
    let mut times = Vec::new();
    let main = kinds::main(kinds);
    if profile.is_serial() {
        let source = profile.source();
        // A start bit, eight bits and a stop bit.
        let lasts = |bits: usize| {
            let bits = i64::try_from(bits / 8 * 10).unwrap_or(i64::MAX);
            Duration(bits.saturating_mul(SECOND / i64::from(profile.baud.max(1)))).to_string()
        };
        times.push(Time {
            name: msg("rate"),
            text: text!("{} baud, 8 bits, the least significant first, no parity, 1 stop bit, no flow control: a byte lasts {}", grouped(profile.baud.into()), lasts(8)),
            source,
        });
        if let Some(kind) = main {
            let bits = kind.bits().len();
            times.push(Time {
                name: msg("frame"),
                text: text!("{} last {}", length(profile, bits), lasts(bits)),
                source: t("computed"),
            });
        }
    }
    if let Some(kind) = main {
        let timeline = Timeline::new(&kind.frame.layout, kind.bits(), &Master::default());
        times.extend(timeline.limits.into_iter().map(|limit| Time {
            name: limit.name,
            text: limit.text,
            source: limit.source,
        }));
    }
    if let Some(timing) = profile
        .format
        .timing()
        .filter(|timing| timing.words == Words::Ring)
    {
        times.push(Time {
            name: msg("more clocks"),
            text: t("the same word again, a 0 between").to_owned(),
            source: timing.source,
        });
    }
    times
}

#[component]
pub(super) fn Timing(profile: Profile, kinds: StoredValue<Vec<Kind>>) -> impl IntoView {
    let rows: Vec<_> = kinds
        .with_value(|kinds| times(&profile, kinds))
        .into_iter()
        .map(|time| {
            view! {
                <tr data-testid="reference-time" data-name=time.name>
                    <th scope="row">{t(time.name)}</th>
                    <td>{time.text}</td>
                    <td class="words doc">{t(time.source)}</td>
                </tr>
            }
        })
        .collect();
    view! {
        <Part profile=profile section=Section::Timing>
            <Scroll label=t("Timing").to_owned()>
                <table>
                    <caption class="unseen">{t("Timing")}</caption>
                    <thead>
                        <tr>
                            <th scope="col">{t("what")}</th>
                            <th scope="col">{t("how long or how fast")}</th>
                            <th scope="col">{t("manual")}</th>
                        </tr>
                    </thead>
                    <tbody>{rows}</tbody>
                </table>
            </Scroll>
        </Part>
    }
}
