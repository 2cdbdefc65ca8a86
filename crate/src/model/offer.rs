//! What a composer of order codes offers.

use super::{Form, Look, Part, Place, Token};
use crate::product::sizes::SIZES;
use alloc::{string::String, vec::Vec};

impl Form {
    /// What can be chosen at a position, counted from 0, beside the rest of a code; of diameters
    /// those of the manual's size table.
    ///
    /// ```
    /// use encoderscope::model::Form;
    /// let mpp = Form::named("MPP").unwrap();
    /// let stators = mpp.choices(2, &["MPP", "50"]);
    /// assert_eq!(stators.iter().map(|token| token.text()).collect::<Vec<_>>(), ["70"]);
    /// ```
    #[must_use]
    pub fn choices(&self, index: usize, texts: &[impl AsRef<str>]) -> Vec<Token> {
        let Some(part) = self.parts.get(index).copied() else {
            return Vec::new();
        };
        match (part.place, part.number) {
            (Place::Rotor, _) => self.diameters(part, |size| size.0),
            (Place::Stator, _) => {
                let rotor = self
                    .parts
                    .iter()
                    .position(|part| part.place == Place::Rotor);
                let rotor = rotor.and_then(|index| texts.get(index));
                let rotor = rotor.map(AsRef::as_ref).unwrap_or_default();
                let fitting = |size: (&'static str, &'static str)| match size.0 == rotor {
                    true => size.1,
                    false => "",
                };
                let found = self.diameters(part, fitting);
                match found.is_empty() {
                    true => self.diameters(part, |size| size.1),
                    false => found,
                }
            }
            (_, number) => {
                let (least, most) = number.map_or((0, 0), |(least, most, _)| (least, most));
                // The finest first.
                (least..=most)
                    .rev()
                    .flat_map(|number| {
                        let words = part.words.iter();
                        words.map(move |word| Token { part, number, word })
                    })
                    .collect()
            }
        }
    }

    /// The texts of the size table at a part, each once.
    fn diameters(
        &self,
        part: &'static Part,
        text: impl Fn((&'static str, &'static str)) -> &'static str,
    ) -> Vec<Token> {
        let mut found: Vec<Token> = Vec::new();
        let mine = SIZES.iter().filter(|size| size.series.name() == self.title);
        for token in mine.filter_map(|size| part.read(text((size.rotor, size.stator)))) {
            if !found.contains(&token) {
                found.push(token);
            }
        }
        found
    }

    /// The parts of a code of this form that keeps what it can of another: what is missing or
    /// wrong there is as in the [example](Form::example).
    ///
    /// ```
    /// use encoderscope::model::{Form, look};
    /// let pt = Form::named("PT").unwrap();
    /// let texts = pt.complete(&look("PT-15B-?-A-24-B-N-A"));
    /// assert_eq!(texts.join("-"), "PT-15B-25-A-24-B-N-A-M");
    /// ```
    #[must_use]
    pub fn complete(&self, looks: &[Look]) -> Vec<String> {
        let mut texts: Vec<String> = Vec::new();
        let mut examples = self.example.iter();
        for (index, part) in self.parts.iter().enumerate() {
            let example = examples.next().copied().unwrap_or_default();
            let same = looks
                .iter()
                .find(|look| look.part.is_some_and(|known| known.place == part.place));
            let kept = same.filter(|look| part.read(&look.text).is_some());
            let choices = self.choices(index, &texts);
            let text = match (kept, part.place) {
                (Some(look), _) => look.text.clone(),
                (None, Place::Stator) => choices.first().map(Token::text).unwrap_or_default(),
                (None, _) => example.into(),
            };
            texts.push(text);
        }
        texts
    }
}
