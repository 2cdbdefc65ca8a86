//! What a link says: the URL fragment, `#/console?format=t485&angle-bits=23`.

use crate::profile::{Profile, ProfileError};
use alloc::{format, string::String, vec::Vec};

/// A fragment in parts.
///
/// ```
/// use encoderscope::link::Fragment;
/// let fragment = Fragment::parse("#/decode?format=t485&angle-bits=17&dump=1A%2020");
/// assert_eq!((&*fragment.area, fragment.value("dump")), ("decode", Some("1A 20")));
/// assert_eq!(fragment.profile().unwrap()?.angle_bits, 17);
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Fragment {
    /// The area, without the slash.
    pub area: String,
    /// Parameters in order, decoded.
    pub parameters: Vec<(String, String)>,
}

impl Fragment {
    /// Takes a fragment apart, with or without its `#`.
    #[must_use]
    pub fn parse(text: &str) -> Self {
        let text = text.trim_start_matches(['#', '/']);
        let (area, query) = text.split_once('?').unwrap_or((text, ""));
        Self {
            area: area.into(),
            parameters: parse_query(query),
        }
    }

    /// The first value of a parameter.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<&str> {
        let mut found = self.parameters.iter().filter(|(known, _)| known == name);
        found.next().map(|(_, value)| value.as_str())
    }

    /// The profile it describes.
    ///
    /// # Errors
    ///
    /// A parameter of the profile is wrong; `None` where there is no profile at all.
    #[must_use]
    pub fn profile(&self) -> Option<Result<Profile, ProfileError>> {
        let mine: Vec<_> = self
            .parameters
            .iter()
            .filter(|(name, _)| Profile::knows(name))
            .map(|(name, value)| (name.as_str(), value.as_str()))
            .collect();
        (!mine.is_empty()).then(|| Profile::parse(mine))
    }
}

/// The parameters of a profile as a query; [`profile`] reads it again.
///
/// ```
/// use encoderscope::{format::Format, link};
/// let period = Format::Period.default_profile();
/// assert!(link::query(&period).starts_with("format=period&"));
/// assert_eq!(link::profile(&link::query(&period)), Ok(period));
/// ```
#[must_use]
pub fn query(profile: &Profile) -> String {
    let pairs = profile.parameters().into_iter();
    pairs
        .map(|(name, value)| format!("{name}={}", encode(&value.plain())))
        .collect::<Vec<_>>()
        .join("&")
}

/// A profile from a query.
///
/// # Errors
///
/// A parameter is wrong.
pub fn profile(query: &str) -> Result<Profile, ProfileError> {
    let pairs = parse_query(query);
    Profile::parse(
        pairs
            .iter()
            .map(|(name, value)| (name.as_str(), value.as_str())),
    )
}

fn parse_query(query: &str) -> Vec<(String, String)> {
    query
        .split('&')
        .filter(|pair| !pair.is_empty())
        .map(|pair| {
            let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
            (decode(name), decode(value))
        })
        .collect()
}

/// Text as a value of a query, as `encodeURIComponent` of JavaScript writes it.
///
/// ```
/// assert_eq!(encoderscope::link::encode("1A + é"), "1A%20%2B%20%C3%A9");
/// ```
#[must_use]
pub fn encode(text: &str) -> String {
    let mut out = String::new();
    for byte in text.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' => out.push(char::from(byte)),
            _ if b"-_.!~*'()".contains(&byte) => out.push(char::from(byte)),
            _ => out.push_str(&format!("%{byte:02X}")),
        }
    }
    out
}

/// What a name or a value says; as it stands where its codes are none.
fn decode(text: &str) -> String {
    let spaced = text.replace('+', " ");
    decoded(&spaced).unwrap_or(spaced)
}

fn decoded(text: &str) -> Option<String> {
    let mut parts = text.split('%');
    let mut bytes = parts.next()?.as_bytes().to_vec();
    for part in parts {
        let (code, rest) = part.split_at_checked(2)?;
        let digits = code.bytes().all(|digit| digit.is_ascii_hexdigit());
        bytes.push(u8::from_str_radix(code, 16).ok().filter(|_| digits)?);
        bytes.extend_from_slice(rest.as_bytes());
    }
    String::from_utf8(bytes).ok()
}
