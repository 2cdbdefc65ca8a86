//! The frame that is explained, and what is pointed at.

use crate::app::App;
use encoderscope::{
    bits::BitString,
    decode::Decoder,
    dump::Direction,
    format::Format,
    framing::Why,
    language::t,
    layout::Class,
    profile::Profile,
    sketch::{Checks, Sketch},
    text,
};
use encoderscope_web::link::{Fragment, encode};
use leptos::prelude::*;

/// What is pointed at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lit {
    /// A bit of the frame.
    Bit(usize),
    /// A field, by its place among them.
    Field(usize),
}

/// A field as it does not change while bits do.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FieldPlan {
    /// Its name in the layout.
    pub(super) name: &'static str,
    pub(super) class: Class,
    pub(super) width: u32,
    /// Whether it is a CRC or a parity.
    pub(super) is_check: bool,
}

impl FieldPlan {
    /// Its name for people.
    pub(super) fn title(&self) -> String {
        t(self.name).replace('_', " ")
    }

    /// The same in English, for what looks for it.
    pub(super) fn plain(&self) -> String {
        self.name.replace('_', " ")
    }
}

/// What does not change while bits do: elements stay, and so does the focus.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Plan {
    pub(super) fields: Vec<FieldPlan>,
    /// The field of each bit.
    pub(super) cells: Vec<Option<usize>>,
    /// Whether it is made of bytes that a UART sends.
    pub(super) bytes: bool,
    /// What tells two kinds of equal layout apart.
    key: (String, Option<Profile>),
}

impl Plan {
    fn of(sketch: &Sketch) -> Self {
        let kind = sketch.kind();
        let layout = &kind.layout;
        let fields = layout.fields().map(|field| FieldPlan {
            name: field.row.name,
            class: field.row.role.class(),
            width: field.width,
            is_check: field.cover.is_some(),
        });
        let mut cells = vec![None; sketch.bits().len()];
        for (index, field) in layout.fields().enumerate() {
            for part in layout.parts(field) {
                let run = cells.get_mut(part.span.start..part.span.end());
                run.unwrap_or_default().fill(Some(index));
            }
        }
        let profile = *sketch.decoder().profile();
        Self {
            fields: fields.collect(),
            cells,
            bytes: profile.is_serial(),
            key: (kind.name.clone(), Some(profile)),
        }
    }

    /// The name of the kind of frame.
    pub(super) fn kind(&self) -> &str {
        &self.key.0
    }

    /// The class of a bit's field.
    pub(super) fn class_of(&self, bit: usize) -> Option<Class> {
        let field = self.cells.get(bit).copied().flatten()?;
        self.fields.get(field).map(|field| field.class)
    }
}

/// What the explainer shows.
#[derive(Clone, Copy)]
pub(crate) struct Paper {
    /// Nothing where the profile describes no frame.
    pub(super) sketch: RwSignal<Option<Sketch>>,
    pub(super) plan: Memo<Plan>,
    pub(super) checks: RwSignal<Checks>,
    pub(super) lit: RwSignal<Option<Lit>>,
    /// Why a text is not taken for a frame.
    pub(super) fault: RwSignal<Option<String>>,
}

impl App {
    /// The frame of the explainer.
    pub(crate) fn paper(self) -> Paper {
        self.keep(Paper::new)
    }
}

impl Paper {
    fn new() -> Self {
        let sketch = RwSignal::new(None);
        Self {
            sketch,
            plan: Memo::new(move |_| {
                sketch.with(|sketch| sketch.as_ref().map(Plan::of).unwrap_or_default())
            }),
            checks: RwSignal::new(Checks::default()),
            lit: RwSignal::new(None),
            fault: RwSignal::new(None),
        }
    }

    /// Takes over what a link says.
    pub(crate) fn follow_link(self, fragment: &Fragment, profile: Profile) {
        let direction = match fragment.value("direction") {
            Some("sent") => Some(Direction::Sent),
            Some("received") => Some(Direction::Received),
            _ => None,
        };
        match fragment.value("frame") {
            Some(text) => self.take(text, profile, direction),
            None => self.follow_profile(profile),
        }
    }

    /// What a link says of the frame.
    pub(crate) fn fragment(self) -> String {
        self.sketch.with(|sketch| match sketch {
            Some(sketch) => {
                let direction = sketch.kind().direction.name();
                let frame = encode(&sketch.text());
                format!("&direction={direction}&frame={frame}")
            }
            None => String::new(),
        })
    }

    /// Shows a frame of the profile, where the one that is shown is of another.
    pub(crate) fn follow_profile(self, profile: Profile) {
        let shown = self
            .sketch
            .with_untracked(|sketch| sketch.as_ref().map(|sketch| *sketch.decoder().profile()));
        if shown == Some(profile) {
            return;
        }
        let before = self.plan.with_untracked(|plan| plan.kind().to_owned());
        self.choose(profile, &before);
    }

    /// Shows the example of a kind of frame; the last one where there is none of the name.
    pub(super) fn choose(self, profile: Profile, name: &str) {
        let Ok(decoder) = Decoder::new(profile) else {
            return;
        };
        let mut kinds = decoder.frame_kinds();
        let usual = match profile.format {
            Format::T485 => "all",
            Format::Bus => "get",
            Format::SsiTree => "frame",
            _ => "reply",
        };
        let named = |name: &str| kinds.iter().position(|kind| kind.name == name);
        let place = named(name).or(named(usual));
        let place = place.unwrap_or(kinds.len().saturating_sub(1));
        if place < kinds.len() {
            let kind = kinds.swap_remove(place);
            self.show(Sketch::new(decoder, kind));
        }
    }

    /// Shows a frame that was pasted, or stands in a link.
    pub(super) fn take(self, text: &str, profile: Profile, direction: Option<Direction>) {
        if let Ok(decoder) = Decoder::new(profile) {
            self.show_or_say(Sketch::parse(decoder, text, direction), profile);
        }
    }

    /// Shows a frame that was read out of something else.
    pub(super) fn take_bits(self, bits: BitString, profile: Profile, direction: Option<Direction>) {
        if let Ok(decoder) = Decoder::new(profile) {
            self.show_or_say(Sketch::read(decoder, bits, direction), profile);
        }
    }

    fn show_or_say(self, read: Result<Sketch, Why>, profile: Profile) {
        match read {
            Ok(sketch) => self.show(sketch),
            Err(why) => {
                self.follow_profile(profile);
                let title = profile.title();
                self.fault
                    .set(Some(text!("This is no frame of {}: {}.", title, why)));
            }
        }
    }

    fn show(self, sketch: Sketch) {
        self.fault.set(None);
        self.lit.set(None);
        self.sketch.set(Some(sketch));
    }

    /// Changes the frame; what is asked of it meanwhile says whether the checks follow.
    pub(super) fn change<T>(self, change: impl FnOnce(&mut Sketch, Checks) -> T) -> Option<T> {
        let checks = self.checks.get_untracked();
        self.fault.set(None);
        self.sketch
            .try_update(|sketch| Some(change(sketch.as_mut()?, checks)))
            .flatten()
    }

    /// Looks at the frame.
    pub(super) fn with<T>(self, look: impl FnOnce(&Sketch) -> T) -> Option<T> {
        self.sketch.with(|sketch| sketch.as_ref().map(look))
    }

    /// Whether a bit is pointed at, itself or with its field.
    pub(super) fn is_lit(self, bit: usize) -> bool {
        match self.lit.get() {
            None => false,
            Some(Lit::Bit(lit)) if lit == bit => true,
            Some(lit) => {
                let field = self
                    .plan
                    .with(|plan| plan.cells.get(bit).copied().flatten());
                field.is_some() && field == self.field_of(lit)
            }
        }
    }

    /// The field that is pointed at, itself or with one of its bits.
    pub(super) fn field_of(self, lit: Lit) -> Option<usize> {
        match lit {
            Lit::Field(field) => Some(field),
            Lit::Bit(bit) => self
                .plan
                .with(|plan| plan.cells.get(bit).copied().flatten()),
        }
    }

    /// Whether a field is pointed at.
    pub(super) fn is_field_lit(self, field: usize) -> bool {
        let lit = self.lit.get();
        lit.and_then(|lit| self.field_of(lit)) == Some(field)
    }
}
