//! What the input is called.

use encoderscope::{explain::grouped, language::t, text};

/// What the input is called where it is not the text of the box.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Named {
    /// A link carried it.
    Linked,
    /// So many bytes were pasted that they are better not shown.
    Pasted(usize),
    /// A file.
    File(String),
}

impl Named {
    /// The name for people.
    pub(crate) fn title(&self) -> String {
        match self {
            Self::Linked => t("frames from a link").to_owned(),
            Self::Pasted(bytes) => text!("pasted text, {} {0|byte|bytes}", grouped(*bytes as u64)),
            Self::File(name) => name.clone(),
        }
    }
}
