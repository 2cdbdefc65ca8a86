//! The areas of the page, the profile, and the state that they share.

mod link;
mod shell;

pub(crate) use shell::{sizes, summary};

use crate::{
    Workers, adapters, connection::Connection, language::Spoken, parts, plot::Feed, ports::Obstacle,
};
use encoderscope::{format::Format, language::t, profile::Profile};
use encoderscope_web::{
    link::{Fragment, query},
    message::{self, PortId, Snapshot, ToEngine, Wish},
    serial,
};
use js_sys::Array;
use leptos::{ev, prelude::*};
use std::{any::Any, time::Duration};
use wasm_bindgen::JsValue;

/// What the dial shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// The built-in encoder behind the first view.
    Preview,
    /// The built-in encoder, chosen.
    Demo,
    /// A port.
    Port,
    /// A recording.
    Replay,
}

/// The areas of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Area {
    Console,
    Decode,
    Explain,
    Reference,
}

impl Area {
    const ALL: [Self; 4] = [Self::Console, Self::Decode, Self::Explain, Self::Reference];

    const fn name(self) -> &'static str {
        match self {
            Self::Console => "console",
            Self::Decode => "decode",
            Self::Explain => "explain",
            Self::Reference => "reference",
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Console => t("Console"),
            Self::Decode => t("Decode"),
            Self::Explain => t("Explain"),
            Self::Reference => t("Reference"),
        }
    }
}

/// How an area takes part in links, once its code is there.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    /// Shows what a link says.
    pub(crate) follow: Callback<Fragment>,
    /// The fragment that leads back.
    pub(crate) fragment: Signal<String>,
}

/// State that the areas share.
#[derive(Clone, Copy)]
pub(crate) struct App {
    pub(crate) area: RwSignal<Area>,
    pub(crate) profile: RwSignal<Profile>,
    /// What is wrong with the link that led here.
    pub(crate) link_fault: RwSignal<Option<String>>,
    pub(crate) snapshot: RwSignal<Snapshot>,
    /// What the engine has answered to the plot.
    pub(crate) feed: Feed,
    pub(crate) source: RwSignal<Source>,
    pub(crate) ports: RwSignal<Vec<PortId>>,
    pub(crate) port: RwSignal<Option<PortId>>,
    /// What the engine was last started with.
    pub(crate) running: RwSignal<Option<Profile>>,
    /// How often a second the encoder is asked; 0 is as often as it answers.
    pub(crate) pace: RwSignal<f64>,
    /// The user wants a baud rate that the adapter is known not to make.
    pub(crate) any_rate: RwSignal<bool>,
    /// Why there is no port.
    pub(crate) obstacle: RwSignal<Option<Obstacle>>,
    /// Makes workers and charts.
    pub(crate) workers: StoredValue<Workers, LocalStorage>,
    /// The last link that was followed.
    link: RwSignal<Fragment>,
    /// The profile of the link is on its way.
    pub(crate) reads_link: RwSignal<bool>,
    /// What the open area makes of links.
    place: RwSignal<Option<Place>>,
    /// Owns what areas keep.
    owner: StoredValue<Owner>,
    /// The worker has broken down, and an engine on the page has taken over.
    broken: RwSignal<bool>,
    /// A port was plugged in a moment ago.
    pub(crate) just_plugged: RwSignal<bool>,
    /// A recording runs; a new version of the page must not end it.
    pub(crate) recording: RwSignal<bool>,
    /// The language of it all.
    pub(crate) spoken: Spoken,
    /// All of them are gone with this.
    views: StoredValue<Option<Box<dyn Any>>, LocalStorage>,
    connection: StoredValue<Connection, LocalStorage>,
}

impl App {
    fn new(workers: Workers) -> Self {
        let snapshot = RwSignal::new(Snapshot::default());
        let feed = Feed::new();
        let broken = RwSignal::new(false);
        let spoken = Spoken::new(&workers);
        let workers = StoredValue::new_local(workers);
        let connection = Connection::new(workers, spoken.texts, snapshot, feed, broken);
        Self {
            area: RwSignal::new(Area::Console),
            profile: RwSignal::new(Format::T485.default_profile()),
            link_fault: RwSignal::new(None),
            snapshot,
            feed,
            source: RwSignal::new(Source::Preview),
            ports: RwSignal::new(Vec::new()),
            port: RwSignal::new(None),
            running: RwSignal::new(None),
            pace: RwSignal::new(0.0),
            any_rate: RwSignal::new(false),
            obstacle: RwSignal::new(None),
            workers,
            link: RwSignal::new(Fragment::default()),
            reads_link: RwSignal::new(false),
            place: RwSignal::new(None),
            owner: StoredValue::new(Owner::current().unwrap_or_default()),
            broken,
            just_plugged: RwSignal::new(false),
            recording: RwSignal::new(false),
            spoken,
            views: StoredValue::new_local(None),
            connection: StoredValue::new_local(connection),
        }
    }

    /// What an area keeps while another one is shown; made when it is first wanted.
    pub(crate) fn keep<T: Clone + Send + Sync + 'static>(self, make: impl FnOnce() -> T) -> T {
        self.owner.get_value().with(|| {
            use_context().unwrap_or_else(|| {
                let made = make();
                provide_context(made.clone());
                made
            })
        })
    }

    /// The area that is shown takes part in links from now on; where it is made anew, in another
    /// language, it has followed its link already.
    pub(crate) fn settle(self, place: Place) {
        let before = self.place.get_untracked();
        self.place.set(Some(place));
        if before.is_none() {
            place.follow.run(self.link.get_untracked());
        }
    }

    /// Speaks to the engine.
    pub(crate) fn send(&self, message: &ToEngine) {
        self.connection
            .with_value(|connection| connection.send(message));
    }

    /// Tells the engine the texts of another language.
    pub(crate) fn tell(&self, texts: &JsValue) {
        self.connection
            .with_value(|connection| connection.post(message::speak(texts)));
    }

    /// Tells the engine what a part of the page wishes.
    pub(crate) fn wish(&self, wish: &Wish) {
        self.wish_with(wish, &JsValue::UNDEFINED);
    }

    /// The same with a file.
    pub(crate) fn wish_with(&self, wish: &Wish, file: &JsValue) {
        if let Ok(wish) = serde_wasm_bindgen::to_value(wish) {
            let both = Array::of2(&wish, file);
            self.connection
                .with_value(|connection| connection.post(both.into()));
        }
    }

    /// Hears the answers to wishes.
    pub(crate) fn hear(&self, heard: impl Fn(Array) + 'static) {
        self.connection
            .with_value(|connection| connection.hear(heard));
    }

    /// Starts the built-in encoder with the present profile.
    pub(crate) fn demo(&self, source: Source) {
        self.source.set(source);
        self.obstacle.set(None);
        let profile = self.readable();
        self.running.set(Some(profile));
        self.send(&ToEngine::Demo {
            profile: query(&profile),
        });
    }

    /// The present profile, or the nearest one that the console can read: a dump can be decoded
    /// as more than comes over a serial line.
    pub(crate) fn readable(&self) -> Profile {
        let profile = self.profile.get_untracked();
        if !profile.is_serial() {
            Format::T485.default_profile()
        } else if profile.command.changes_encoder() {
            Profile {
                command: profile.format.default_profile().command,
                ..profile
            }
        } else {
            profile
        }
    }

    /// Asks so many times a second.
    pub(crate) fn set_pace(self, rate: f64) {
        self.pace.set(rate);
        self.wish(&Wish::Pace(rate));
    }

    /// Stops reading.
    pub(crate) fn disconnect(&self) {
        self.send(&ToEngine::Close);
    }

    /// Takes over a new profile.
    pub(crate) fn change_profile(self, profile: Profile) {
        self.profile.set(profile);
        self.link_fault.set(None);
    }

    /// The device that is being read has a new address: nothing needs to be opened again.
    pub(crate) fn adopt_address(self, address: u32) {
        if self.profile.get_untracked().address == address {
            return;
        }
        let moved = |profile: Profile| Profile { address, ..profile };
        self.running.update(|running| *running = running.map(moved));
        self.profile.update(|profile| *profile = moved(*profile));
        if let (Source::Port, Some(port)) = (self.source.get_untracked(), self.port.get_untracked())
        {
            adapters::remember(port, &self.profile.get_untracked());
        }
    }

    /// Lets the console run with the profile that is shown: the demo by itself, a port only when
    /// the user says so, for the profile may be that of a link or a file.
    fn follow_profile(self) {
        let shown = self.profile.get();
        if self.area.get() != Area::Console {
            return;
        }
        let running = self.running.get_untracked();
        match self.source.get_untracked() {
            Source::Port if running == Some(shown) => {}
            Source::Port => {
                if self.reads_port() {
                    self.disconnect();
                    self.obstacle.set(Some(Obstacle::OtherSettings));
                }
            }
            Source::Replay => {}
            Source::Demo | Source::Preview if running == Some(self.readable()) => {}
            source => self.demo(source),
        }
    }

    /// Lets the engine and the ports have their say; `bare` is an address that names no encoder.
    fn begin(self, bare: bool) {
        let app = self;
        Effect::new(move || app.follow_profile());
        Effect::new(move || app.follow_plug());
        // The engine says which device of a BUS is on the dial: settings go to that one.
        let watched = Memo::new(move |_| app.snapshot.with(|snapshot| snapshot.watched));
        Effect::new(move || {
            if let Some(address) = watched.get() {
                app.adopt_address(address);
            }
        });
        Effect::new(move || {
            if app.broken.get() {
                match app.source.get_untracked() {
                    Source::Port | Source::Replay => {
                        app.obstacle.set(Some(Obstacle::BrokeDown));
                    }
                    source => app.demo(source),
                }
            }
        });

        serial::on_plugged(move || app.plugged());
        leptos::task::spawn_local(async move {
            app.refresh_ports().await;
            if let ([only], true) = (&app.ports.get_untracked()[..], bare)
                && adapters::is_known(*only)
            {
                // Without the network the encoder's settings are as good as new.
                let _ = parts::recall(app, *only).await;
            }
        });
    }
}

/// Starts the page.
pub(crate) fn start(workers: Workers) {
    let app = App::new(workers);
    provide_context(app);
    let bare = Fragment::parse(&location_hash()).parameters.is_empty();
    app.follow_link(&location_hash());
    // The address bar may have been brought up to date since the link was followed.
    window_event_listener(ev::hashchange, move |event| {
        let address = event.new_url();
        app.follow_link(address.find('#').map_or("", |at| &address[at..]));
    });
    window_event_listener_untyped("pagehide", move |_| app.disconnect());
    Effect::new(move || {
        if let (Some(fragment), Ok(history)) = (app.fragment(), window().history()) {
            // Where it fails the link in the address bar is only out of date.
            let _ = history.replace_state_with_url(&JsValue::NULL, "", Some(&fragment));
        }
    });
    // Nothing of this is needed for the first picture.
    let owner = app.owner.get_value();
    after_picture(move || owner.with(|| app.begin(bare)));

    app.show();
}

/// Does something once the next picture of the page has been drawn.
pub(crate) fn after_picture(then: impl FnOnce() + 'static) {
    request_animation_frame(move || set_timeout(then, Duration::ZERO));
}

/// The pieces of a view, one with each picture, so that what the user does meanwhile is heard
/// between them.
pub(crate) fn in_pieces<const N: usize>() -> [Memo<bool>; N] {
    let made = RwSignal::new(0);
    make_next(made, N);
    std::array::from_fn(|place| Memo::new(move |_| made.get() > place))
}

fn make_next(made: RwSignal<usize>, all: usize) {
    after_picture(move || {
        made.try_update(|made| *made += 1);
        if made.try_get_untracked().is_some_and(|made| made < all) {
            make_next(made, all);
        }
    });
}

fn location_hash() -> String {
    window().location().hash().unwrap_or_default()
}
