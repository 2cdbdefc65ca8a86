//! The devices of a BUS: a scan of all addresses, and a tile each.

use crate::app::App;
use encoderscope::{
    explain::grouped,
    format::Format,
    language::{number, t},
    text,
};
use encoderscope_web::message::{Device, Link, Snapshot, Wish};
use leptos::prelude::*;

#[component]
pub(crate) fn DevicesPanel() -> impl IntoView {
    let app = expect_context::<App>();
    let is_bus = Memo::new(move |_| app.profile.get().format == Format::Bus);
    let open = Memo::new(move |_| {
        app.snapshot.with(|Snapshot { link, .. }| {
            link.is_open() && !matches!(link, Link::Opening | Link::Searching)
        })
    });
    let busy = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.busy));
    let scan = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.scan.clone()));
    let addresses = Memo::new(move |_| {
        app.snapshot.with(|snapshot| {
            let devices = snapshot.devices.iter();
            devices.map(|device| device.address).collect::<Vec<_>>()
        })
    });
    move || {
        is_bus.get().then(|| {
            view! {
                <section class="panel devices">
                    <h2>{t("Devices on the bus")}</h2>
                    <div class="doors">
                        <button data-testid="scan" disabled=move || !open.get() || busy.get() on:click=move |_| app.wish(&Wish::Scan)>
                            {t("Scan 32 addresses")}
                        </button>
                        <span class="hint" data-testid="scan-result">{move || scan.get()}</span>
                    </div>
                    <div class="tiles">
                        {move || addresses.get().into_iter().map(|address| view! { <Tile address=address /> }).collect_view()}
                    </div>
                </section>
            }
        })
    }
}

#[component]
fn Tile(address: u8) -> impl IntoView {
    let app = expect_context::<App>();
    let device = Memo::new(move |_| {
        app.snapshot.with(|snapshot| {
            let mut devices = snapshot.devices.iter();
            devices.find(|device| device.address == address).cloned()
        })
    });
    let degrees = |degrees: f64| number(format_args!("{degrees:.3}°")).to_string();
    let own = move || app.profile.get().address == u32::from(address);
    let text = move || {
        let shown = device.get().and_then(|device: Device| device.reading);
        shown.map_or_else(
            || "–".to_owned(),
            |shown| match shown.turns {
                Some(turns) => text!("{} {0|turn|turns} {}", turns, degrees(shown.degrees)),
                None => degrees(shown.degrees),
            },
        )
    };
    let state = move || {
        device.get().map_or_else(String::new, |device| {
            let frames = text!(
                "{} good, {} bad",
                grouped(device.good as u64),
                grouped(device.bad as u64)
            );
            match device.fresh {
                true => frames,
                false => text!("no answer · {}", frames),
            }
        })
    };
    let angle = move || {
        let shown = device.get().and_then(|device| device.reading);
        shown.map(|shown| shown.angle.to_string())
    };
    view! {
        <button
            class="tile"
            class:chosen=own
            aria-pressed=move || own().to_string()
            data-testid="device"
            data-address=address.to_string()
            data-value=angle
            data-fresh=move || device.get().is_some_and(|device| device.fresh).to_string()
            on:click=move |_| app.wish(&Wish::Watch(address))
        >
            <span class="address">{text!("address {}", address)}</span>
            <b>{text}</b>
            <small>{state}</small>
        </button>
    }
}
