//! The shell: areas, profile, theme, and the state that they share.

use crate::{
    Workers, adapters,
    connection::Connection,
    console::Console,
    decode::Decode,
    desk::Desk,
    explain::{Explain, Paper},
    plot::Feed,
    ports::Obstacle,
    reference::{Book, Reference},
    theme::ThemeSwitch,
};
use encoderscope::{format::Format, profile::Profile};
use encoderscope_web::{
    link::{Fragment, query},
    message::{PortId, Snapshot, ToEngine},
    serial,
};
use leptos::{ev, prelude::*};

/// What the dial shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// The built-in encoder behind the first view.
    Preview,
    /// The built-in encoder, chosen.
    Demo,
    /// A port.
    Port,
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

    const fn title(self) -> &'static str {
        match self {
            Self::Console => "Console",
            Self::Decode => "Decode",
            Self::Explain => "Explain",
            Self::Reference => "Reference",
        }
    }
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
    /// The decode area's end of its worker.
    pub(crate) desk: Desk,
    /// The frame of the explainer.
    pub(crate) paper: Paper,
    /// Where the reference is open.
    pub(crate) book: Book,
    /// The worker has broken down, and an engine on the page has taken over.
    broken: RwSignal<bool>,
    /// A port was plugged in a moment ago.
    pub(crate) just_plugged: RwSignal<bool>,
    connection: StoredValue<Connection, LocalStorage>,
}

impl App {
    fn new(workers: Workers) -> Self {
        let snapshot = RwSignal::new(Snapshot::default());
        let feed = Feed::new();
        let broken = RwSignal::new(false);
        let connection = Connection::new(workers.engine().ok(), snapshot, feed, broken);
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
            desk: Desk::new(workers),
            paper: Paper::new(),
            book: Book::new(),
            broken,
            just_plugged: RwSignal::new(false),
            connection: StoredValue::new_local(connection),
        }
    }

    /// Speaks to the engine.
    pub(crate) fn send(&self, message: ToEngine) {
        self.connection
            .with_value(|connection| connection.send(message));
    }

    /// Starts the built-in encoder with the present profile.
    pub(crate) fn demo(&self, source: Source) {
        self.source.set(source);
        self.obstacle.set(None);
        let profile = self.readable();
        self.running.set(Some(profile));
        self.send(ToEngine::Demo {
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
        self.send(ToEngine::Pace(rate));
    }

    /// Stops reading.
    pub(crate) fn disconnect(&self) {
        self.send(ToEngine::Close);
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

    /// Lets the console run with the profile that is shown.
    fn follow_profile(self) {
        let shown = self.profile.get();
        if self.area.get() != Area::Console {
            return;
        }
        let running = self.running.get_untracked();
        match self.source.get_untracked() {
            Source::Port if running == Some(shown) => {}
            Source::Port if self.snapshot.get_untracked().link.is_open() => self.connect(),
            Source::Port => {}
            Source::Demo | Source::Preview if running == Some(self.readable()) => {}
            source => self.demo(source),
        }
    }

    fn follow_link(self, text: &str) {
        let fragment = Fragment::parse(text);
        let area = Area::ALL
            .into_iter()
            .find(|area| area.name() == fragment.area);
        let area = area.unwrap_or(Area::Console);
        if self.area.get_untracked() != area {
            self.area.set(area);
        }
        let is_filled = area == Area::Reference && Book::is_filled(&fragment);
        match fragment.profile().filter(|_| !is_filled) {
            Some(Ok(profile)) => self.change_profile(profile),
            Some(Err(error)) => self
                .link_fault
                .set(Some(format!("The link is not right: {error}."))),
            None => {}
        }
        match area {
            Area::Explain => {
                let profile = self.profile.get_untracked();
                self.paper.follow_link(&fragment, profile);
            }
            Area::Reference => self.book.follow_link(&fragment),
            Area::Console | Area::Decode => self.desk.follow_link(&fragment),
        }
    }

    /// The fragment that leads back here.
    pub(crate) fn fragment(&self) -> String {
        let area = self.area.get();
        let mut text = format!("#/{}?{}", area.name(), query(&self.profile.get()));
        match area {
            Area::Console => {}
            Area::Decode => text += &self.desk.fragment(),
            Area::Explain => text += &self.paper.fragment(),
            Area::Reference => text = self.book.fragment(&self.profile.get()),
        }
        text
    }
}

impl App {
    /// The whole address that leads back here.
    pub(crate) fn address(&self) -> String {
        let address = window().location().href().unwrap_or_default();
        let page = address.split('#').next().unwrap_or_default().to_owned();
        page + &self.fragment()
    }
}

/// The whole page.
pub(crate) fn app(workers: Workers) -> impl IntoView + use<> {
    let app = App::new(workers);
    provide_context(app);
    app.follow_link(&location_hash());
    Effect::new(move || app.follow_profile());
    Effect::new(move || app.follow_plug());
    // The engine says which device of a BUS is on the dial: settings go to that one.
    let watched = Memo::new(move |_| app.snapshot.get().watched);
    Effect::new(move || {
        if let Some(address) = watched.get() {
            app.adopt_address(address);
        }
    });
    Effect::new(move || {
        if app.broken.get() {
            match app.source.get_untracked() {
                Source::Port => app.obstacle.set(Some(Obstacle::BrokeDown)),
                source => app.demo(source),
            }
        }
    });

    let hash = window_event_listener(ev::hashchange, move |_| app.follow_link(&location_hash()));
    let hide = window_event_listener_untyped("pagehide", move |_| app.disconnect());
    on_cleanup(move || {
        hash.remove();
        hide.remove();
    });
    Effect::new(move || {
        let fragment = app.fragment();
        if let Ok(history) = window().history() {
            // Where it fails the link in the address bar is only out of date.
            let _ =
                history.replace_state_with_url(&wasm_bindgen::JsValue::NULL, "", Some(&fragment));
        }
    });
    serial::on_plugged(move || app.plugged());
    let bare = Fragment::parse(&location_hash()).profile().is_none();
    leptos::task::spawn_local(async move {
        app.refresh_ports().await;
        if let ([only], true) = (&app.ports.get_untracked()[..], bare)
            && let Some(profile) = adapters::recall(*only)
        {
            app.change_profile(profile);
        }
    });

    view! {
        <header class="bar">
            <a class="brand" href="#/console">
                <svg viewBox="0 0 24 24" aria-hidden="true">
                    <circle cx="12" cy="12" r="10" />
                    <line x1="12" y1="12" x2="17" y2="7" />
                    <circle class="dot" cx="12" cy="12" r="2" />
                </svg>
                "Encoderscope"
            </a>
            <nav aria-label="Areas">
                {Area::ALL
                    .map(|area| {
                        view! {
                            <a
                                href=format!("#/{}", area.name())
                                aria-current=move || (app.area.get() == area).then_some("page")
                            >
                                {area.title()}
                            </a>
                        }
                    })
                    .into_view()}
            </nav>
            <span class="pill" data-testid="profile" data-value=move || query(&app.profile.get())>
                {move || summary(&app.profile.get())}
            </span>
            <ThemeSwitch />
        </header>
        <main>
            {move || {
                app.link_fault.get().map(|fault| view! { <p class="fault" role="alert">{fault}</p> })
            }}
            {move || match app.area.get() {
                Area::Console => view! { <Console /> }.into_any(),
                Area::Decode => view! { <Decode /> }.into_any(),
                Area::Explain => view! { <Explain /> }.into_any(),
                Area::Reference => view! { <Reference /> }.into_any(),
            }}
        </main>
    }
}

fn location_hash() -> String {
    window().location().hash().unwrap_or_default()
}

pub(crate) fn summary(profile: &Profile) -> impl IntoView + use<> {
    let mut text = format!("{} bit", profile.angle_bits);
    if profile.turns_bits > 0 {
        text += &format!(" + {} turns", profile.turns_bits);
    }
    if profile.is_serial() {
        text += &format!(" · {} Mbaud", f64::from(profile.baud) / 1e6);
    }
    view! { <b>{profile.title()}</b> " " {text} }
}
