//! Where the reference is open: a page of it, and what is marked there.

use super::kinds;
use encoderscope::profile::Profile;
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

    pub(super) const fn title(self) -> &'static str {
        match self {
            Self::Parameters => "Parameters",
            Self::Frames => "Frames",
            Self::Commands => "Requests",
            Self::Sequences => "Sequences",
            Self::Status => "Status bits",
            Self::Timing => "Timing",
            Self::Checks => "Checks",
            Self::Errata => "Where manuals err",
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

/// Where the reference is open.
#[derive(Clone, Copy)]
pub(crate) struct Book {
    pub(super) leaf: RwSignal<Leaf>,
    pub(super) mark: RwSignal<Option<Mark>>,
}

impl Book {
    pub(crate) fn new() -> Self {
        Self {
            leaf: RwSignal::new(Leaf::Overview),
            mark: RwSignal::new(None),
        }
    }

    /// Opens what a link says.
    pub(crate) fn follow_link(self, fragment: &Fragment) {
        let profile = fragment.profile().and_then(Result::ok);
        let leaf = match (&profile, fragment.value("page")) {
            (Some(_), _) => Leaf::Format,
            (None, Some("errata")) => Leaf::Errata,
            (None, _) => Leaf::Overview,
        };
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
        }
    }

    /// Whether a link points at this.
    pub(super) fn is_marked(self, mark: &Mark) -> bool {
        self.mark.with(|marked| marked.as_ref() == Some(mark))
    }
}
