//! The decoder: pasted text in, a row a frame out, and the chosen frame in bits and fields.

use crate::{
    app::App,
    frame_view::{Explained, FrameView},
    profile_editor::{Offer, ProfileEditor},
};
use encoderscope::{
    decode::{Decoded, Decoder, Frame, Summary},
    detect::{Candidate, detect},
    dump::{self, Dump},
    explain::{degrees_text, grouped, grouped_signed},
    format::{Format, Medium},
    framing::Why,
    profile::Profile,
};
use encoderscope_web::link::{encode, query};
use leptos::prelude::*;

/// Rows that are shown; more would only slow the page down.
const MOST_ROWS: usize = 1000;

/// A row of the table.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    start: u64,
    ok: bool,
    turns: Option<i64>,
    angle: Option<(u64, String)>,
    status: String,
    check: String,
    /// Index among the frames; `None` for skipped input.
    frame: Option<usize>,
}

/// A decoded dump.
#[derive(Clone, Debug, Default, PartialEq)]
struct Table {
    rows: Vec<Row>,
    summary: Summary,
    unread: Vec<String>,
    lines: usize,
}

fn row_of_frame(frame: &Frame<'_>, index: usize) -> Row {
    let values = frame.values();
    let faults = frame.faults();
    let bits = frame.layout.shape.profile.angle_bits;
    let mut status: Vec<String> = Vec::new();
    if values.error == Some(true) {
        status.push("error".into());
    }
    if values.warning == Some(true) {
        status.push("warning".into());
    }
    for note in frame.explain() {
        let named = note.bits.iter().filter(|bit| bit.set && bit.role.is_none());
        status.extend(named.map(|bit| bit.name.to_owned()));
    }
    let received = values.crc.map(|crc| format!("✓ {:02X}", crc.received));
    Row {
        start: frame.start,
        ok: faults.is_empty(),
        turns: values.turns,
        angle: values
            .angle
            .map(|angle| (angle, degrees_text(angle, bits, 4))),
        status: status.join(" · "),
        check: faults
            .first()
            .map_or(received.unwrap_or_default(), |fault| fault.kind.to_string()),
        frame: Some(index),
    }
}

fn row_of_skip(start: u64, bytes: &[u8], why: Why, unit: &str) -> Row {
    let some: Vec<_> = bytes
        .iter()
        .take(6)
        .map(|byte| format!("{byte:02X}"))
        .collect();
    let more = if bytes.len() > 6 { " …" } else { "" };
    let reason = match why {
        Why::Request => "a request, or its echo".into(),
        Why::NoFrame | Why::Unasked => format!("{} of no frame", plural(bytes.len(), "byte")),
        Why::Truncated { have, need } => format!("{have} of {need} {unit}"),
    };
    Row {
        start,
        ok: false,
        turns: None,
        angle: None,
        status: some.join(" ") + more,
        check: reason,
        frame: None,
    }
}

fn plural(count: usize, what: &str) -> String {
    format!(
        "{} {what}{}",
        grouped(count as u64),
        if count == 1 { "" } else { "s" }
    )
}

fn parse(profile: &Profile, text: &str) -> Option<(Decoder, Dump)> {
    let decoder = Decoder::new(*profile).ok()?;
    Some((decoder, dump::parse(text, profile.medium())))
}

fn table(profile: &Profile, text: &str) -> Table {
    let Some((decoder, dump)) = parse(profile, text) else {
        return Table::default();
    };
    let unit = match profile.medium() {
        Medium::Bits => "bits",
        Medium::Bytes | Medium::Text => "bytes",
    };
    let mut rows = Vec::new();
    let mut frames = 0;
    let summary = decoder.dump(&dump, &mut |decoded| {
        let index = frames;
        frames += usize::from(matches!(decoded, Decoded::Frame(_)));
        if rows.len() < MOST_ROWS {
            rows.push(match decoded {
                Decoded::Frame(frame) => row_of_frame(&frame, index),
                Decoded::Skip { start, bits, why } => row_of_skip(start, bits.bytes(), why, unit),
            });
        }
    });
    let unread = dump
        .unread()
        .places
        .iter()
        .filter_map(|mark| text.get(mark.at.start as usize..mark.at.end as usize));
    Table {
        rows,
        summary,
        unread: unread.map(ToOwned::to_owned).collect(),
        lines: dump.len(),
    }
}

/// Explains the frame of an index.
fn explained(profile: &Profile, text: &str, index: usize) -> Option<Explained> {
    let (decoder, dump) = parse(profile, text)?;
    let bytes = profile.medium() != Medium::Bits;
    let mut at = 0;
    let mut found = None;
    decoder.dump(&dump, &mut |decoded| {
        if let Decoded::Frame(frame) = decoded {
            if at == index {
                found = Some(Explained::new(frame.bits, bytes, frame.explain()));
            }
            at += 1;
        }
    });
    found
}

/// An example of each format, from public captures and the manuals' rules.
const fn example(format: Format) -> &'static str {
    match format {
        Format::Ssi => "00 05 12 34 56 00\n00 05 12 a0 01 00\nff fe 13 00 00 60\n",
        Format::BissC => {
            "82 00 05 55 a3 c1 c0 d4\n82 00 05 56 b0 f7 c0 48\n82 ff fe 80 00 01 90 88\n"
        }
        Format::Rs485 | Format::Period => {
            "00 05 12 34 56 00 02\n00 05 12 a0 01 00 31\nff fe 13 00 00 60 8d\n"
        }
        Format::T485 => {
            "1a 20 29 c0 3b 17 00 00 00 c8 37\n1a 20 83 c1 52 17 00 00 00 c8 f5\n1a 20 bf e1 7d 17 00 00 00 c8 c6\n"
        }
        Format::Bus => {
            "1f 1f 00 56 34 12 05 00 6a\n1f 1f 00 01 a0 12 05 00 a9\n1f 1f 60 00 00 13 fe ff 6d\n"
        }
        Format::Asi1 => "60 00 00 06 00 35\n60 03 7f 7c 15 4a\n60 00 00 00 00 66\n",
        Format::Asi4 => "8190\n8191\n8192\n",
        Format::Ssi7 => "000000000000000000000000000110\n000000000000001000000000000011\n",
        Format::SsiTree => "1010010100101001000100011\n0110001111111011110001000\n",
        Format::Own => "",
    }
}

#[component]
pub(crate) fn Decode() -> impl IntoView {
    let app = expect_context::<App>();
    let table = Memo::new(move |_| table(&app.profile.get(), &app.dump.get()));
    let chosen = RwSignal::new(0usize);
    let detail = Memo::new(move |_| explained(&app.profile.get(), &app.dump.get(), chosen.get()));
    let copied = RwSignal::new(false);
    Effect::new(move || {
        app.dump.track();
        app.profile.track();
        chosen.set(0);
        copied.set(false);
    });
    let share = move |_| {
        let origin = window().location().href().unwrap_or_default();
        let page = origin.split('#').next().unwrap_or_default();
        let link = format!(
            "{page}{}&dump={}",
            app.fragment(),
            encode(&app.dump.get_untracked())
        );
        leptos::task::spawn_local(async move {
            let clipboard = window().navigator().clipboard();
            let written = wasm_bindgen_futures::JsFuture::from(clipboard.write_text(&link)).await;
            copied.set(written.is_ok());
        });
    };
    let empty = move || app.dump.get().trim().is_empty();
    view! {
        <div class="decode">
            <section class="panel paste">
                <h2>"Paste a dump"</h2>
                <ProfileEditor offer=Offer::All />
                <textarea
                    data-testid="dump-input"
                    aria-label="Dump"
                    spellcheck="false"
                    autocomplete="off"
                    placeholder="1a 20 29 c0 3b 17 00 00 00 c8 37"
                    prop:value=move || app.dump.get()
                    on:input:target=move |event| app.dump.set(event.target().value())
                />
                <ReadNote table=table />
                <Candidates />
                <div class="doors">
                    <button data-testid="example" on:click=move |_| app.dump.set(example(app.profile.get_untracked().format).into())>
                        "Show an example"
                    </button>
                    {move || (!empty()).then(|| view! {
                        <button data-testid="share" on:click=share>
                            {move || if copied.get() { "Link copied" } else { "Copy link" }}
                        </button>
                        <button on:click=move |_| app.dump.set(String::new())>"Clear"</button>
                    })}
                </div>
            </section>
            <div class="results">
                {move || empty().then(|| view! {
                    <section class="panel">
                        <h2>"Frames"</h2>
                        <p class="hint">
                            "Paste hexadecimal bytes with any separators, or strings of 0 and 1. A dump from a serial line is one stream; of SSI and BiSS-C, each line is a frame."
                        </p>
                    </section>
                })}
                {move || (!empty()).then(|| view! { <Rows table=table chosen=chosen /> })}
                {move || detail.get().map(|frame| view! {
                    <section class="panel detail">
                        <h2>{move || format!("Frame {}", chosen.get() + 1)}</h2>
                        <FrameView frame=frame />
                    </section>
                })}
            </div>
        </div>
    }
}

/// A profile in a line.
fn describe(profile: &Profile) -> String {
    let mut text = format!("{}, {} bit", profile.title(), profile.angle_bits);
    if profile.turns_bits > 0 {
        text += &format!(", {} bit turns", profile.turns_bits);
    }
    if profile.format == Format::Rs485 {
        text += &format!(", reply to ‘{}’", profile.command.letter());
    }
    match profile.format {
        Format::BissC => text += &format!(", {} status bits", profile.status_bits),
        Format::Bus => text += &format!(", device 0x{:02X}", profile.address),
        _ => {}
    }
    text
}

/// What the dump may be; a click reads it that way.
#[component]
fn Candidates() -> impl IntoView {
    let app = expect_context::<App>();
    let found = Memo::new(move |_| {
        let mut found = detect(&app.dump.get());
        found.truncate(3);
        found
    });
    let row = move |candidate: Candidate| {
        let profile = candidate.profile;
        let mut value = query(&profile);
        value += &format!("&verdict={}", candidate.verdict.name());
        view! {
            <button
                class="candidate"
                class:chosen=move || app.profile.get() == profile
                data-testid="candidate"
                data-value=value
                on:click=move |_| app.change_profile(profile)
            >
                <b>{describe(&profile)}</b>
                <span class=format!("verdict {}", candidate.verdict.name())>{candidate.verdict.name()}</span>
                <small>{candidate.evidence.join("; ")}</small>
            </button>
        }
    };
    move || {
        let found = found.get();
        (!found.is_empty()).then(|| {
            view! {
                <div class="candidates">
                    <h2>"What it is"</h2>
                    {found.into_iter().map(row).collect_view()}
                </div>
            }
        })
    }
}

#[component]
fn ReadNote(table: Memo<Table>) -> impl IntoView {
    move || {
        let table = table.get();
        let unread = (!table.unread.is_empty()).then(|| {
            let some: Vec<_> = table
                .unread
                .iter()
                .take(5)
                .map(|token| format!("“{token}”"))
                .collect();
            let more = if table.unread.len() > 5 { " …" } else { "" };
            format!(
                " {} not readable: {}{more}",
                plural(table.unread.len(), "token"),
                some.join(" ")
            )
        });
        let read = (table.lines > 0).then(|| {
            format!(
                "Read {}: {}.",
                plural(table.lines, "line"),
                plural(table.summary.bytes as usize, "byte")
            )
        });
        view! {
            <p class="hint" role="status">
                {read}
                {unread.map(|unread| view! { <span class="fault">{unread}</span> })}
            </p>
        }
    }
}

#[component]
fn Rows(table: Memo<Table>, chosen: RwSignal<usize>) -> impl IntoView {
    let heading = move || {
        let Summary {
            frames,
            bad,
            skipped,
            ..
        } = table.get().summary;
        let mut text = format!("{} good", grouped(frames - bad));
        if bad > 0 {
            text += &format!(" · {} bad", grouped(bad));
        }
        if skipped > 0 {
            text += &format!(" · {} skipped", plural(skipped as usize, "byte"));
        }
        text
    };
    let more = move || {
        let table = table.get();
        (table.rows.len() == MOST_ROWS).then(|| {
            let of = grouped(table.summary.frames);
            view! { <p class="hint">{format!("The first {MOST_ROWS} rows; {of} frames in all.")}</p> }
        })
    };
    view! {
        <section class="panel rows">
            <h2>{move || plural(table.get().summary.frames as usize, "frame")} <span>{heading}</span></h2>
            <div class="scroll">
                <table>
                    <thead>
                        <tr>
                            <th>"at"</th>
                            <th>"turns"</th>
                            <th>"angle"</th>
                            <th>"status"</th>
                            <th>"check"</th>
                        </tr>
                    </thead>
                    <tbody>
                        {move || {
                            let rows = table.get().rows.into_iter();
                            rows.map(|row| view! { <RowView row=row chosen=chosen /> }).collect_view()
                        }}
                    </tbody>
                </table>
            </div>
            {more}
        </section>
    }
}

#[component]
fn RowView(row: Row, chosen: RwSignal<usize>) -> impl IntoView {
    let Some(index) = row.frame else {
        return view! {
            <tr class="skip" data-testid="dump-skip">
                <td>{row.start}</td>
                <td colspan="3" class="bytes">{row.status}</td>
                <td class="verdict">{row.check}</td>
            </tr>
        }
        .into_any();
    };
    let dash = || "–".to_owned();
    // The numbers of a frame that fails are in its fields; here they would pass for good ones.
    let good = |text: Option<String>| text.filter(|_| row.ok).unwrap_or_else(dash);
    let turns = good(row.turns.map(grouped_signed));
    let angle = good(row.angle.clone().map(|(_, degrees)| degrees + "°"));
    view! {
        <tr
            data-testid="dump-row"
            data-ok=row.ok.to_string()
            data-angle=row.angle.map(|(angle, _)| angle.to_string())
            data-turns=row.turns.map(|turns| turns.to_string())
            class:chosen=move || chosen.get() == index
            aria-selected=move || (chosen.get() == index).to_string()
            on:click=move |_| chosen.set(index)
        >
            <td><button class="quiet" on:focus=move |_| chosen.set(index)>{row.start}</button></td>
            <td class="turns">{turns}</td>
            <td class="angle">{angle}</td>
            <td class="flags">{if row.ok { row.status } else { dash() }}</td>
            <td class=if row.ok { "verdict good" } else { "verdict bad" }>{row.check}</td>
        </tr>
    }
    .into_any()
}
