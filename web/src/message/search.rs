//! A search for the encoder on a line, as the page shows it.

use serde::{Deserialize, Serialize};

/// A search for the encoder on a line.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Search {
    /// What was tried.
    pub trials: Vec<Trial>,
    /// What was found, best first.
    pub found: Vec<Found>,
    /// How it goes.
    pub stage: SearchStage,
}

/// How a search goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum SearchStage {
    /// It runs.
    #[default]
    Running,
    /// It has come to its end.
    Ended,
    /// It was broken off.
    BrokenOff,
}

/// What was tried in a search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// At which baud rate.
    pub baud: u32,
    /// The name of the format that was asked; nothing while it only listened.
    pub format: Option<String>,
    /// Requests sent.
    pub requests: u32,
    /// Bytes that came.
    pub bytes: f64,
    /// Whether it was tried at all: the adapter may not make the rate.
    pub tried: bool,
}

/// An encoder that a search has found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    /// Its profile, as the parameters of a link.
    pub profile: String,
    /// How sure that is.
    pub verdict: String,
    /// Why, in sentences.
    pub evidence: Vec<String>,
    /// The fewest bits per turn that the angles fit in.
    pub narrowest: u32,
}
