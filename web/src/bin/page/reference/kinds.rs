//! The kinds of frame of a format, those most used first.

use encoderscope::{
    bits::{Bits, Span},
    decode::Decoder,
    dump::Direction,
    explain::Note,
    format::{Format, rs485::Command},
    language::t,
    layout::{Field, Resolved},
    profile::Profile,
    sketch::{FrameKind, Sketch},
    text,
};
use encoderscope_web::link::{encode, query};

/// A kind of frame on the page of its format.
#[derive(Clone, Debug)]
pub(super) struct Kind {
    /// Its name in links and attributes.
    pub(super) key: String,
    /// The profile that reads it: replies of RS485 do not say what they answer.
    pub(super) profile: Profile,
    pub(super) frame: FrameKind,
}

impl Kind {
    /// Whether the encoder sends it.
    pub(super) fn is_reply(&self) -> bool {
        self.frame.direction == Direction::Received
    }

    pub(super) fn bits(&self) -> Bits<'_> {
        self.frame.example.as_bits()
    }

    pub(super) fn notes(&self) -> Vec<Note> {
        self.frame.layout.explain(self.bits())
    }

    /// Its length in words.
    pub(super) fn length(&self) -> String {
        length(&self.profile, self.bits().len())
    }

    /// The example as a link writes it.
    pub(super) fn text(&self) -> String {
        let decoder = Decoder::new(self.profile);
        let sketch = decoder.map(|decoder| Sketch::new(decoder, self.frame.clone()));
        sketch.map(|sketch| sketch.text()).unwrap_or_default()
    }

    /// The link to the explainer with the example.
    pub(super) fn explainer(&self) -> String {
        format!(
            "#/explain?{}&direction={}&frame={}",
            query(&self.profile),
            self.frame.direction.name(),
            encode(&self.text())
        )
    }
}

/// A number of bits in words: bytes, where a UART sends them.
pub(super) fn length(profile: &Profile, bits: usize) -> String {
    match profile.is_serial() {
        true => text!("{} {0|byte|bytes}", bits / 8),
        false => text!("{} {0|bit|bits}", bits),
    }
}

/// All kinds of frame that encoders of a profile and their masters exchange.
pub(super) fn all(profile: &Profile) -> Vec<Kind> {
    let of = |profile: Profile| {
        let decoder = Decoder::new(profile);
        let frames = decoder.map(|decoder| decoder.frame_kinds());
        let frames = frames.unwrap_or_default().into_iter();
        frames.map(move |frame| Kind {
            key: frame.name.clone(),
            profile,
            frame,
        })
    };
    let mut kinds: Vec<Kind> = match profile.format {
        Format::Rs485 => Command::ALL
            .iter()
            .flat_map(|command| {
                let command = *command;
                let kinds = of(Profile {
                    command,
                    ..*profile
                });
                kinds.map(move |kind| Kind {
                    key: match kind.frame.direction {
                        Direction::Sent => format!("request-{}", command.letter()),
                        Direction::Received => command.letter().to_string(),
                    },
                    ..kind
                })
            })
            .collect(),
        _ => of(*profile).collect(),
    };
    let usual = usual(profile);
    kinds.sort_by_key(|kind| kind.key.trim_start_matches("request-") != usual);
    kinds
}

/// The kind that is read most: of several.
fn usual(profile: &Profile) -> String {
    match profile.format {
        Format::T485 => "all".to_owned(),
        Format::Rs485 => profile.command.letter().to_string(),
        _ => String::new(),
    }
}

/// The reply that is read most.
pub(super) fn main(kinds: &[Kind]) -> Option<&Kind> {
    kinds.iter().find(|kind| kind.is_reply())
}

/// What a field is called on the page.
pub(super) fn title(field: &Field) -> String {
    t(field.row.name).replace('_', " ")
}

/// A run of bits of one field, of a serial format within one byte.
#[derive(Clone, Debug)]
pub(super) struct Run {
    pub(super) span: Span,
    /// Place of its least significant bit in the field's number.
    pub(super) place: u32,
    pub(super) field: Field,
}

/// A frame in runs, in transmission order.
pub(super) fn runs(layout: &Resolved, cut: Option<usize>) -> Vec<Run> {
    let mut runs = Vec::new();
    for field in layout.fields() {
        for part in layout.parts(field) {
            let mut at = part.span.start;
            while at < part.span.end() {
                let rest = part.span.end() - at;
                let len = cut.map_or(rest, |cut| rest.min(cut - at % cut));
                runs.push(Run {
                    span: Span::new(at, len),
                    place: part.place + (rest - len) as u32,
                    field: field.clone(),
                });
                at += len;
            }
        }
    }
    runs.sort_by_key(|run| run.span.start);
    runs
}
