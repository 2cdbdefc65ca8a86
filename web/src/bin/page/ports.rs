//! Ports: choosing, opening, searching, plugging, and what stands in the way.

use crate::{
    adapters,
    app::{App, Area, Source},
};
use encoderscope::{
    adapter::Made, explain::grouped, format::Link as Way, language::t, profile::Profile, text,
};
use encoderscope_web::{
    browser::error_text,
    link::query,
    message::{Link, PortId, ToEngine},
    serial::{self, Absent},
};
use leptos::prelude::*;
use std::time::Duration;

/// Why there is no port.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Obstacle {
    /// The browser has no Web Serial.
    NoApi,
    /// The page came over plain http.
    Insecure,
    /// A policy forbids serial ports.
    Blocked,
    /// The user chose none.
    NothingChosen,
    /// The chosen port is not among the known ones.
    NotPluggedIn,
    /// The adapter does not make the baud rate; the nearest that it makes.
    RateNotMade(f64),
    /// The settings have changed, and not on the console.
    OtherSettings,
    /// The engine broke down.
    BrokeDown,
    /// What the browser says.
    Other(String),
}

impl Obstacle {
    /// What keeps this browser from serial ports altogether.
    pub(crate) fn of_browser() -> Option<Self> {
        serial::available().err().map(|absent| match absent {
            Absent::Insecure => Self::Insecure,
            Absent::NoApi => Self::NoApi,
            Absent::Blocked => Self::Blocked,
        })
    }

    /// One word for each.
    pub(crate) const fn name(&self) -> &'static str {
        match self {
            Self::NoApi => "no-api",
            Self::Insecure => "insecure",
            Self::Blocked => "blocked",
            Self::NothingChosen => "nothing-chosen",
            Self::NotPluggedIn => "not-plugged-in",
            Self::RateNotMade(_) => "rate-not-made",
            Self::OtherSettings => "other-settings",
            Self::BrokeDown => "broke-down",
            Self::Other(_) => "no-port",
        }
    }

    /// What it is, and what to do about it.
    pub(crate) fn text(&self) -> String {
        let text = match self {
            Self::NoApi => t(
                "This browser has no Web Serial. Chrome, Edge or another Chromium browser on a \
                   computer can read the encoder. The demo and the decoder work here.",
            ),
            Self::Insecure => t(
                "This page came over plain http, where browsers give no access to serial ports. \
                   Open it over https or from localhost. The demo and the decoder work here.",
            ),
            Self::Blocked => t(
                "A policy blocks serial ports on this page: ask who manages this computer, or, \
                   where the page stands in a frame, let the frame allow \u{201c}serial\u{201d}. The \
                   demo and the decoder work here.",
            ),
            Self::NothingChosen => t("No port was chosen."),
            Self::NotPluggedIn => t(
                "The adapter is not plugged in, or this page may no longer use it. Plug it in, or \
                   choose or add a port.",
            ),
            Self::RateNotMade(nearest) => {
                return text!(
                    "The chip of this adapter does not make this baud rate: its driver would take \
                     about {}, where an encoder may hear a command instead of a request. Use an \
                     adapter that makes the rate.",
                    grouped(*nearest as u64)
                );
            }
            Self::OtherSettings => {
                t("A link or another page has changed the settings. Connect to read with them.")
            }
            Self::BrokeDown => t("The reader broke down. Connect again."),
            Self::Other(text) => t(text),
        };
        text.into()
    }
}

impl App {
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
                    self.obstacle.set(Some(Obstacle::NotPluggedIn));
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
                let (name, message) = error_text(&error);
                self.obstacle.set(Some(match name.as_str() {
                    "NotFoundError" => Obstacle::NothingChosen,
                    "SecurityError" => Obstacle::Blocked,
                    _ => Obstacle::Other(message),
                }));
                None
            }
        }
    }

    /// Searches for the encoder: the built-in one where that is read, else on a port.
    pub(crate) fn find(self) {
        self.obstacle.set(None);
        if self.source.get_untracked() == Source::Demo {
            let profile = query(&self.readable());
            return self.send(&ToEngine::Find {
                port: None,
                profile,
            });
        }
        leptos::task::spawn_local(async move {
            if let Some(port) = self.chosen_port().await {
                self.port.set(Some(port));
                self.source.set(Source::Port);
                self.send(&ToEngine::Find {
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

    /// Takes over a profile that the user has chosen on the console; reading goes on with it.
    pub(crate) fn choose_profile(self, profile: Profile) {
        let reads = self.area.get_untracked() == Area::Console && self.reads_port();
        if reads {
            self.running.set(Some(profile));
        }
        self.change_profile(profile);
        if reads {
            self.connect();
        }
    }

    /// Whether a port is open, or being opened.
    pub(crate) fn reads_port(self) -> bool {
        self.source.get_untracked() == Source::Port
            && self
                .snapshot
                .with_untracked(|snapshot| snapshot.link.is_open())
    }

    /// Whether what was read before the plug was pulled out is what would be read now.
    fn was_reading(self) -> bool {
        self.source.get_untracked() == Source::Port
            && self.running.get_untracked() == Some(self.profile.get_untracked())
    }

    fn open(self, port: PortId) {
        self.obstacle.set(None);
        self.port.set(Some(port));
        self.source.set(Source::Port);
        let profile = self.profile.get_untracked();
        // At another rate an encoder may hear a command where a request was sent.
        let polled = profile.link() == Way::Polled;
        if let (Made::Not(nearest), true, false) = (
            serial::made(port, profile.baud),
            polled,
            self.any_rate.get_untracked(),
        ) {
            self.running.set(Some(profile));
            self.disconnect();
            return self.obstacle.set(Some(Obstacle::RateNotMade(nearest)));
        }
        adapters::remember(port, &profile);
        self.running.set(Some(profile));
        self.send(&ToEngine::Open {
            port,
            profile: query(&profile),
        });
    }

    /// A port was plugged in: reads on where reading ended with the plug pulled out.
    pub(crate) fn plugged(self) {
        let lost = self
            .snapshot
            .with_untracked(|snapshot| snapshot.link == Link::Lost);
        if lost && self.was_reading() {
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
    pub(crate) fn follow_plug(self) {
        let lost = self.snapshot.with(|snapshot| snapshot.link == Link::Lost);
        if lost && self.just_plugged.get() && self.was_reading() {
            self.just_plugged.set(false);
            self.connect();
        }
    }

    /// Chooses a port, and the encoder that was behind it last.
    pub(crate) fn choose_port(self, port: PortId) {
        let reads = self.reads_port();
        self.port.set(Some(port));
        self.any_rate.set(false);
        if let Some(profile) = adapters::recall(port) {
            self.change_profile(profile);
        }
        // What is shown as chosen is what settings go to.
        if reads {
            self.open(port);
        }
    }

    pub(crate) async fn refresh_ports(self) {
        if let Ok(ports) = serial::known().await {
            self.ports.set(ports);
        }
    }
}

/// Connects all the same, where only the adapter's rate is in doubt.
#[component]
pub(crate) fn AllTheSame() -> impl IntoView {
    let app = expect_context::<App>();
    let doubted = move || matches!(app.obstacle.get(), Some(Obstacle::RateNotMade(_)));
    move || {
        doubted().then(|| {
            view! {
                <button
                    data-testid="all-the-same"
                    on:click=move |_| {
                        app.any_rate.set(true);
                        app.connect();
                    }
                >
                    {t("Connect all the same")}
                </button>
            }
        })
    }
}
