//! Where the reference is open: a page of it, and what is marked there.

use super::{kinds, topic::Topic};
use crate::app::App;
use encoderscope::{calculator::Calculator, language::t, profile::Profile};
use encoderscope_web::link::{Fragment, encode, query};
use leptos::prelude::*;

/// A page of the reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Leaf {
    /// All formats.
    Overview,
    /// Where the manuals are wrong.
    Errata,
    /// The format of the profile.
    Format,
    /// A matter of products and wiring.
    Topic(Topic),
    /// A calculator, by its name.
    Calculator(&'static str),
}

impl Leaf {
    /// Its name in links; none for the overview and for formats, which a profile names.
    const fn name(self) -> Option<&'static str> {
        match self {
            Self::Overview | Self::Format => None,
            Self::Errata => Some("errata"),
            Self::Topic(topic) => Some(topic.name()),
            Self::Calculator(name) => Some(name),
        }
    }

    /// The page of a name.
    fn named(name: &str) -> Option<Self> {
        let topic = || Topic::ALL.into_iter().find(|topic| topic.name() == name);
        let calculator = || Calculator::named(name).map(|known| Self::Calculator(known.name));
        match name {
            "errata" => Some(Self::Errata),
            _ => topic().map(Self::Topic).or_else(calculator),
        }
    }

    /// Whether it works with the shared profile.
    pub(super) const fn has_profile(self) -> bool {
        match self {
            Self::Format => true,
            Self::Topic(topic) => topic.has_profile(),
            Self::Overview | Self::Errata | Self::Calculator(_) => false,
        }
    }

    /// Whether it is filled in.
    const fn has_entries(self) -> bool {
        matches!(self, Self::Topic(_) | Self::Calculator(_))
    }
}

/// A part of a format's page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Section {
    Frames,
    Commands,
    Sequences,
    Status,
    Timing,
    Checks,
    Parameters,
    Errata,
}

impl Section {
    pub(super) const ALL: [Self; 8] = [
        Self::Frames,
        Self::Commands,
        Self::Sequences,
        Self::Status,
        Self::Timing,
        Self::Checks,
        Self::Parameters,
        Self::Errata,
    ];

    /// Its name in links.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Parameters => "parameters",
            Self::Frames => "frames",
            Self::Commands => "commands",
            Self::Sequences => "sequences",
            Self::Status => "status",
            Self::Timing => "timing",
            Self::Checks => "checks",
            Self::Errata => "errata",
        }
    }

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Parameters => t("Parameters"),
            Self::Frames => t("Frames"),
            Self::Commands => t("Requests"),
            Self::Sequences => t("Sequences"),
            Self::Status => t("Status bits"),
            Self::Timing => t("Timing"),
            Self::Checks => t("Checks"),
            Self::Errata => t("Where manuals err"),
        }
    }
}

/// What a link points at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Mark {
    /// A field of a kind of frame.
    Field { kind: String, name: String },
    /// An erratum, by its number.
    Erratum(u32),
    /// A part of the page.
    Section(Section),
}

impl Mark {
    /// The element that it is.
    pub(super) fn id(&self) -> String {
        match self {
            Self::Field { kind, name } => format!("field-{kind}-{name}"),
            Self::Erratum(number) => format!("erratum-{number}"),
            Self::Section(section) => format!("section-{}", section.name()),
        }
    }

    /// How a link says it.
    fn text(&self) -> String {
        match self {
            Self::Field { kind, name } => {
                format!("&frame-kind={}&field={}", encode(kind), encode(name))
            }
            Self::Erratum(number) => format!("&erratum={number}"),
            Self::Section(section) => format!("&section={}", section.name()),
        }
    }
}

/// The link to a place on the page of a profile's format.
pub(super) fn link(profile: &Profile, mark: Option<&Mark>) -> String {
    let mark = mark.map(Mark::text).unwrap_or_default();
    format!("#/reference?{}{mark}", query(profile))
}

/// The link to an erratum among all of them, or to the first.
pub(super) fn errata_link(number: Option<u32>) -> String {
    let mark = number.map(|number| Mark::Erratum(number).text());
    format!("#/reference?page=errata{}", mark.unwrap_or_default())
}

/// The link to a page that is filled in.
pub(super) fn filled_link(leaf: Leaf, entries: &[(&str, &str)]) -> String {
    let mut text = match leaf.name() {
        Some(name) => format!("#/reference?page={name}"),
        None => "#/reference".to_owned(),
    };
    for (name, value) in entries {
        text += &format!("&{name}={}", encode(value));
    }
    text
}

/// Where the reference is open.
#[derive(Clone, Copy)]
pub(crate) struct Book {
    pub(super) leaf: RwSignal<Leaf>,
    pub(super) mark: RwSignal<Option<Mark>>,
    /// What is filled in on the page that is open, by the names of links.
    entries: RwSignal<Vec<(String, String)>>,
}

impl App {
    /// Where the reference is open.
    pub(crate) fn book(self) -> Book {
        self.keep(Book::new)
    }
}

impl Book {
    fn new() -> Self {
        Self {
            leaf: RwSignal::new(Leaf::Overview),
            mark: RwSignal::new(None),
            entries: RwSignal::new(Vec::new()),
        }
    }

    /// Whether a link is to a page that has its own entries, which are no parameters of a profile.
    pub(crate) fn is_filled(fragment: &Fragment) -> bool {
        let leaf = fragment.value("page").and_then(Leaf::named);
        leaf.is_some_and(|leaf| {
            leaf.has_entries() && !(leaf.has_profile() && fragment.value("format").is_some())
        })
    }

    /// What is filled in under a name.
    pub(super) fn entry(self, name: &str) -> Option<String> {
        self.entries.with(|entries| {
            let found = entries.iter().find(|(known, _)| known == name);
            found.map(|(_, value)| value.clone())
        })
    }

    /// All that is filled in.
    pub(super) fn filled(self) -> Vec<(String, String)> {
        self.entries.get()
    }

    /// Fills something in.
    pub(super) fn enter(self, name: &str, value: &str) {
        self.entries.update(
            |entries| match entries.iter_mut().find(|(known, _)| known == name) {
                Some((_, present)) => value.clone_into(present),
                None => entries.push((name.to_owned(), value.to_owned())),
            },
        );
    }

    /// Takes an entry away.
    pub(super) fn clear(self, name: &str) {
        self.entries
            .update(|entries| entries.retain(|(known, _)| known != name));
    }

    /// Opens what a link says.
    pub(crate) fn follow_link(self, fragment: &Fragment) {
        let profile = match Self::is_filled(fragment) {
            true => None,
            false => fragment.profile().and_then(Result::ok),
        };
        let page = fragment.value("page").and_then(Leaf::named);
        let leaf = match (page, &profile) {
            (Some(leaf), _) if leaf.has_entries() => leaf,
            (_, Some(_)) => Leaf::Format,
            (page, None) => page.unwrap_or(Leaf::Overview),
        };
        let entries = match leaf.has_entries() {
            true => fragment
                .parameters
                .iter()
                .filter(|(name, _)| name != "page" && !(leaf.has_profile() && Profile::knows(name)))
                .cloned()
                .collect(),
            false => Vec::new(),
        };
        if self.entries.with_untracked(|present| *present != entries) {
            self.entries.set(entries);
        }
        let section = || {
            let name = fragment.value("section")?;
            let known = Section::ALL.into_iter();
            known
                .filter(|section| section.name() == name)
                .map(Mark::Section)
                .next()
        };
        let erratum = || Some(Mark::Erratum(fragment.value("erratum")?.parse().ok()?));
        let field = || {
            let kinds = kinds::all(profile.as_ref()?);
            let name = fragment.value("field")?;
            let wanted = fragment.value("frame-kind");
            let holds = |kind: &&kinds::Kind| {
                let mut fields = kind.frame.layout.fields();
                fields.any(|field| field.row.name == name)
            };
            let holding = || kinds.iter().filter(holds);
            let kind = holding()
                .find(|kind| Some(kind.key.as_str()) == wanted)
                .or_else(|| holding().find(|kind| kind.is_reply()))
                .or_else(|| holding().next())?;
            Some(Mark::Field {
                kind: kind.key.clone(),
                name: name.to_owned(),
            })
        };
        self.mark.set(field().or_else(erratum).or_else(section));
        self.leaf.set(leaf);
    }

    /// The fragment that leads back here.
    pub(crate) fn fragment(self, profile: &Profile) -> String {
        let mark = self.mark.get();
        match (self.leaf.get(), mark) {
            (Leaf::Overview, _) => "#/reference".to_owned(),
            (Leaf::Errata, Some(Mark::Erratum(number))) => errata_link(Some(number)),
            (Leaf::Errata, _) => errata_link(None),
            (Leaf::Format, mark) => link(profile, mark.as_ref()),
            (leaf @ (Leaf::Topic(_) | Leaf::Calculator(_)), _) => {
                let entries = self.entries.get();
                let entries: Vec<_> = entries
                    .iter()
                    .map(|(name, value)| (name.as_str(), value.as_str()))
                    .collect();
                let text = filled_link(leaf, &entries);
                match leaf.has_profile() {
                    true => format!("{text}&{}", query(profile)),
                    false => text,
                }
            }
        }
    }

    /// Whether a link points at this.
    pub(super) fn is_marked(self, mark: &Mark) -> bool {
        self.mark.with(|marked| marked.as_ref() == Some(mark))
    }
}
