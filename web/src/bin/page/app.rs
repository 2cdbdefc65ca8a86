//! The shell: areas, profile, theme, and the state that they share.

use crate::{
    adapters, connection::Connection, console::Console, decode::Decode, plot::Feed,
    theme::ThemeSwitch,
};
use encoderscope::{format::Format, profile::Profile};
use encoderscope_web::{
    link::{Fragment, query},
    message::{Link, PortId, Snapshot, ToEngine},
    serial,
};
use leptos::{ev, prelude::*};
use std::time::Duration;

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
}

impl Area {
    const ALL: [Self; 2] = [Self::Console, Self::Decode];

    const fn name(self) -> &'static str {
        match self {
            Self::Console => "console",
            Self::Decode => "decode",
        }
    }

    const fn title(self) -> &'static str {
        match self {
            Self::Console => "Console",
            Self::Decode => "Decode",
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
    running: RwSignal<Option<Profile>>,
    /// How often a second the encoder is asked; 0 is as often as it answers.
    pub(crate) pace: RwSignal<f64>,
    /// Why there is no port, in words.
    pub(crate) notice: RwSignal<Option<String>>,
    /// Text of the decode area.
    pub(crate) dump: RwSignal<String>,
    /// The worker has broken down, and an engine on the page has taken over.
    broken: RwSignal<bool>,
    /// A port was plugged in a moment ago.
    just_plugged: RwSignal<bool>,
    connection: StoredValue<Connection, LocalStorage>,
}

impl App {
    fn new(make_worker: &js_sys::Function) -> Self {
        let snapshot = RwSignal::new(Snapshot::default());
        let feed = Feed::new();
        let broken = RwSignal::new(false);
        let connection = Connection::new(make_worker, snapshot, feed, broken);
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
            notice: RwSignal::new(None),
            dump: RwSignal::new(String::new()),
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
        self.notice.set(None);
        let profile = self.readable();
        self.running.set(Some(profile));
        self.send(ToEngine::Demo {
            profile: query(&profile),
        });
    }

    /// The present profile, or the nearest one that the console can read: a dump can be decoded
    /// as more than comes over a serial line.
    fn readable(&self) -> Profile {
        let profile = self.profile.get_untracked();
        if !profile.format.is_serial() {
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

    /// Opens the chosen known port, or asks for one when none is known.
    pub(crate) fn connect(self) {
        leptos::task::spawn_local(async move {
            if let Some(port) = self.chosen_port().await {
                self.open(port);
            }
        });
    }

    /// The chosen port, the first known one, or the one that the user chooses now; where there is
    /// none, the page says why.
    async fn chosen_port(self) -> Option<PortId> {
        self.refresh_ports().await;
        let known = self.ports.get_untracked();
        match (self.port.get_untracked(), known.first()) {
            (Some(chosen), _) => {
                let index = serial::find(&known, chosen);
                if index.is_none() {
                    self.notice.set(Some(
                        "The adapter is not plugged in, or this page may no longer use it. Plug it \
                         in, or choose or add a port."
                            .into(),
                    ));
                }
                index.map(|index| known[index])
            }
            (None, Some(port)) => Some(*port),
            (None, None) => self.ask_port().await,
        }
    }

    /// Asks for a port and opens it.
    pub(crate) async fn add_port(self) {
        if let Some(port) = self.ask_port().await {
            self.open(port);
        }
    }

    async fn ask_port(self) -> Option<PortId> {
        match serial::ask().await {
            Ok(port) => {
                self.refresh_ports().await;
                Some(port)
            }
            Err(error) => {
                let (name, message) = encoderscope_web::browser::error_text(&error);
                self.notice.set(Some(match name.as_str() {
                    "NotFoundError" => "No port was chosen.".into(),
                    "SecurityError" => {
                        "A policy of this browser blocks serial ports on this page.".into()
                    }
                    _ => message,
                }));
                None
            }
        }
    }

    /// Searches for the encoder: the built-in one where that is read, else on a port.
    pub(crate) fn find(self) {
        self.notice.set(None);
        if self.source.get_untracked() == Source::Demo {
            let profile = query(&self.readable());
            return self.send(ToEngine::Find {
                port: None,
                profile,
            });
        }
        leptos::task::spawn_local(async move {
            if let Some(port) = self.chosen_port().await {
                self.port.set(Some(port));
                self.source.set(Source::Port);
                self.send(ToEngine::Find {
                    port: Some(port),
                    profile: String::new(),
                });
            }
        });
    }

    /// Reads the encoder that a search has found, or that the link has shown.
    pub(crate) fn read_as(self, profile: Profile) {
        self.change_profile(profile);
        match (self.source.get_untracked(), self.port.get_untracked()) {
            (Source::Port, Some(port)) => self.open(port),
            (source, _) => self.demo(source),
        }
    }

    fn open(self, port: PortId) {
        self.notice.set(None);
        self.port.set(Some(port));
        self.source.set(Source::Port);
        let profile = self.profile.get_untracked();
        adapters::remember(port, &profile);
        self.running.set(Some(profile));
        self.send(ToEngine::Open {
            port,
            profile: query(&profile),
        });
    }

    /// A port was plugged in: reads on where reading ended with the plug pulled out.
    fn plugged(self) {
        let lost = self.snapshot.get_untracked().link == Link::Lost;
        if lost && self.source.get_untracked() == Source::Port {
            self.connect();
        } else {
            leptos::task::spawn_local(self.refresh_ports());
            self.just_plugged.set(true);
            set_timeout(
                move || self.just_plugged.set(false),
                Duration::from_millis(500),
            );
        }
    }

    /// Reads on where the news of a plug put back has overtaken that of its being pulled out.
    fn follow_plug(self) {
        let lost = self.snapshot.get().link == Link::Lost;
        if lost && self.just_plugged.get() && self.source.get_untracked() == Source::Port {
            self.just_plugged.set(false);
            self.connect();
        }
    }

    /// Chooses a port, and the encoder that was behind it last.
    pub(crate) fn choose_port(self, port: PortId) {
        self.port.set(Some(port));
        if let Some(profile) = adapters::recall(port) {
            self.change_profile(profile);
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

    async fn refresh_ports(self) {
        if let Ok(ports) = serial::known().await {
            self.ports.set(ports);
        }
    }

    /// Takes over a new profile.
    pub(crate) fn change_profile(self, profile: Profile) {
        self.profile.set(profile);
        self.link_fault.set(None);
    }

    /// The device that is being read has a new address: nothing needs to be opened again.
    pub(crate) fn adopt_address(self, address: u8) {
        let moved = |profile: Profile| Profile {
            address: u32::from(address),
            ..profile
        };
        self.running.update(|running| *running = running.map(moved));
        self.profile.update(|profile| *profile = moved(*profile));
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
        self.area.set(area.unwrap_or(Area::Console));
        match fragment.profile() {
            Some(Ok(profile)) => self.change_profile(profile),
            Some(Err(error)) => self
                .link_fault
                .set(Some(format!("The link is not right: {error}."))),
            None => {}
        }
        if let Some(dump) = fragment.value("dump") {
            self.dump.set(dump.into());
        }
    }

    /// The fragment that leads back here.
    pub(crate) fn fragment(&self) -> String {
        format!(
            "#/{}?{}",
            self.area.get().name(),
            query(&self.profile.get())
        )
    }
}

/// The whole page.
pub(crate) fn app(make_worker: &js_sys::Function) -> impl IntoView + use<> {
    let app = App::new(make_worker);
    provide_context(app);
    app.follow_link(&location_hash());
    Effect::new(move || app.follow_profile());
    Effect::new(move || app.follow_plug());
    Effect::new(move || {
        if app.broken.get() {
            match app.source.get_untracked() {
                Source::Port => app
                    .notice
                    .set(Some("The reader broke down. Connect again.".into())),
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
    if profile.format.is_serial() {
        text += &format!(" · {} Mbaud", f64::from(profile.baud) / 1e6);
    }
    view! { <b>{profile.format.title()}</b> " " {text} }
}
