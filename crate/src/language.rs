//! What is said to people, in their language.
//!
//! The source says everything in English, and the English text is the name of what is said: a
//! [`Catalogue`] has the same in another language. [`t`] looks a text up; [`say!`](crate::say) and
//! [`text!`](crate::text) fill in what changes; [`msg`] marks a text in a table that is looked up
//! later, and what a field of a layout means is asked for by [`meaning`]. What programs read –
//! names of formats and fields in links, columns, JSON – is never translated; what is made for them
//! out of texts is made [`in_english`].
//!
//! ```
//! use encoderscope::{language::{self, Catalogue, t}, text};
//! let russian = [("Connect", "Подключить"), ("{} {0|byte|bytes}", "{} {0|байт|байта|байт}")];
//! assert_eq!((t("Connect"), text!("{} {0|byte|bytes}", 1)), ("Connect", "1 byte".into()));
//! language::speak(Some(Catalogue::new(russian)));
//! assert_eq!((t("Connect"), text!("{} {0|byte|bytes}", 22)), ("Подключить", "22 байта".into()));
//! language::speak(None);
//! assert_eq!(t("Connect"), "Connect");
//! ```

use alloc::{
    borrow::ToOwned,
    boxed::Box,
    string::{String, ToString},
    vec::Vec,
};
use core::{
    fmt::{self, Display, Write},
    sync::atomic::{AtomicBool, Ordering},
};
use once_cell::race::OnceRef;

static LEARNT: OnceRef<'static, Catalogue> = OnceRef::new();
static SPEAKS: AtomicBool = AtomicBool::new(false);

/// Texts of another language by the English ones. A program keeps it as long as it runs.
#[derive(Debug)]
pub struct Catalogue {
    /// Sorted by the first.
    texts: Vec<(&'static str, &'static str)>,
}

impl Catalogue {
    /// A catalogue of pairs: what is said in English, and the same in the other language.
    pub fn new<A: Into<String>, B: Into<String>>(
        texts: impl IntoIterator<Item = (A, B)>,
    ) -> &'static Self {
        let kept = |text: String| &*Box::leak(text.into_boxed_str());
        let texts = texts.into_iter();
        let mut texts: Vec<_> = texts
            .map(|(english, other)| (kept(english.into()), kept(other.into())))
            .collect();
        texts.sort_unstable();
        Self::sorted(texts)
    }

    /// A catalogue of texts with NULs between: each is followed by the same in the other language, and
    /// they are sorted.
    ///
    /// ```
    /// use encoderscope::language::Catalogue;
    /// let russian = Catalogue::read("angle\0угол\0turns\0обороты".into());
    /// assert_eq!(russian.get("turns"), Some("обороты"));
    /// ```
    #[must_use]
    pub fn read(texts: String) -> &'static Self {
        let mut texts = Box::leak(texts.into_boxed_str()).split('\0');
        let pairs = core::iter::from_fn(|| Some((texts.next()?, texts.next()?)));
        Self::sorted(pairs.collect())
    }

    fn sorted(texts: Vec<(&'static str, &'static str)>) -> &'static Self {
        Box::leak(Box::new(Self { texts }))
    }

    /// The text in this language.
    #[must_use]
    pub fn get(&self, english: &str) -> Option<&'static str> {
        let found = self.texts.binary_search_by_key(&english, |(key, _)| key);
        found.ok().and_then(|at| Some(self.texts.get(at)?.1))
    }
}

/// Speaks another language from now on, or English again. A program learns one other language: what
/// comes later than the first is not taken.
pub fn speak(catalogue: Option<&'static Catalogue>) {
    if let Some(catalogue) = catalogue {
        // Where one has been learnt that one goes on.
        let _ = LEARNT.set(catalogue);
    }
    SPEAKS.store(catalogue.is_some(), Ordering::Relaxed);
}

fn spoken() -> Option<&'static Catalogue> {
    match SPEAKS.load(Ordering::Relaxed) {
        true => LEARNT.get(),
        false => None,
    }
}

/// A text in the language that is spoken; English where the catalogue has none.
#[must_use]
pub fn t(english: &str) -> &str {
    let found = spoken().and_then(|catalogue| catalogue.get(english));
    found.unwrap_or(english)
}

/// Marks a text that [`t`] is asked for later.
#[must_use]
pub const fn msg(english: &'static str) -> &'static str {
    english
}

/// A text that is put together from the lines of a doc, such as what a field means.
#[must_use]
pub fn meaning(english: String) -> String {
    let found = spoken().and_then(|catalogue| catalogue.get(&english));
    found.map_or(english, ToOwned::to_owned)
}

/// What `say` makes while English is spoken, for what programs read.
pub fn in_english<T>(say: impl FnOnce() -> T) -> T {
    let spoke = SPEAKS.swap(false, Ordering::Relaxed);
    let said = say();
    SPEAKS.store(spoke, Ordering::Relaxed);
    said
}

/// A number as people of the language write it, with their decimal mark.
///
/// ```
/// assert_eq!(encoderscope::language::number(format_args!("{:.1}", 2.25)).to_string(), "2.2");
/// ```
#[must_use]
pub const fn number<T: Display>(number: T) -> Number<T> {
    Number(number)
}

/// See [`number`].
#[derive(Clone, Copy, Debug)]
pub struct Number<T>(T);

impl<T: Display> Display for Number<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match spoken() {
            Some(catalogue) => {
                let mark = catalogue.get(MARK).unwrap_or(MARK);
                let text = self.0.to_string();
                text.split_inclusive('.')
                    .try_for_each(|part| match part.strip_suffix('.') {
                        Some(part) => f.write_str(part).and_then(|()| f.write_str(mark)),
                        None => f.write_str(part),
                    })
            }
            None => self.0.fmt(f),
        }
    }
}

/// The decimal mark has an entry of its own.
const MARK: &str = ".";

/// Writes a text with values in it; [`say!`](crate::say).
///
/// # Errors
///
/// Those of what it writes to.
#[doc(hidden)]
pub fn fill(out: &mut dyn Write, english: &'static str, values: &[&dyn Display]) -> fmt::Result {
    let mut rest = t(english);
    let mut next = 0;
    while let Some((before, behind)) = rest.split_once('{') {
        out.write_str(before)?;
        let (place, behind) = behind.split_once('}').unwrap_or((behind, ""));
        rest = behind;
        let (index, forms) = match place.split_once('|') {
            Some((index, forms)) => (index, Some(forms)),
            None => (place, None),
        };
        let index = index
            .bytes()
            .next()
            .map_or(next, |digit| usize::from(digit.wrapping_sub(b'0')));
        next += usize::from(place.is_empty());
        let Some(value) = values.get(index) else {
            continue;
        };
        match forms {
            Some(forms) => out.write_str(form(&value.to_string(), forms))?,
            None => write!(out, "{value}")?,
        }
    }
    out.write_str(rest)
}

/// The form of a word beside a number: of two the first is for one alone, of three, as in Slavic
/// languages, the first is for 1, 21…, the second for 2…4, 22… and for fractions.
fn form<'a>(number: &str, forms: &'a str) -> &'a str {
    let digits = number.bytes().filter(u8::is_ascii_digit);
    let (tens, ones) = digits.fold((0, 0), |(_, ones), digit| (ones, digit - b'0'));
    let alone = number.trim_start_matches(['-', '+', '−']) == "1";
    let broken = number.contains([',', '.']);
    let mut forms = forms.split('|');
    let (one, few, many) = (forms.next(), forms.next(), forms.next());
    let chosen = match many {
        None if alone => one,
        None => few,
        Some(_) if broken => few,
        Some(_) if ones == 1 && tens != 1 => one,
        Some(_) if (2..=4).contains(&ones) && tens != 1 => few,
        many => many,
    };
    chosen.unwrap_or_default()
}

/// What has been said, as a string; [`text!`](crate::text).
#[doc(hidden)]
#[must_use]
pub fn filled(english: &'static str, values: &[&dyn Display]) -> String {
    let mut out = String::new();
    // A string takes everything.
    let _ = fill(&mut out, english, values);
    out
}

/// Writes a text in the language that is spoken: `say!(f, "{} of {} bytes", have, need)`.
///
/// A value stands for `{}`, or for its index, as in `{1}`. A word that depends on a number gives its
/// forms: `"{} {0|frame|frames}"`.
#[macro_export]
macro_rules! say {
    ($out:expr, $english:literal $(, $value:expr)* $(,)?) => {
        $crate::language::fill($out, $english, &[$(&$value as &dyn ::core::fmt::Display),*])
    };
}

/// The same as a string: `text!("{} of {} bytes", have, need)`.
#[macro_export]
macro_rules! text {
    ($english:literal $(, $value:expr)* $(,)?) => {
        $crate::language::filled($english, &[$(&$value as &dyn ::core::fmt::Display),*])
    };
}
