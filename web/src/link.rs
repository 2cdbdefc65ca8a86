//! The URL fragment: `#/console?format=t485&angle-bits=23`.

use encoderscope::profile::{Profile, ProfileError};

/// A fragment in parts.
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

/// The parameters of a profile as a query.
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

/// Text as a value of a query.
#[must_use]
pub fn encode(text: &str) -> String {
    js_sys::encode_uri_component(text).into()
}

fn decode(text: &str) -> String {
    let spaced = text.replace('+', " ");
    // A link of a stranger may have a million parameters; asking the browser takes its time.
    if !spaced.contains('%') {
        return spaced;
    }
    js_sys::decode_uri_component(&spaced).map_or(spaced, Into::into)
}
