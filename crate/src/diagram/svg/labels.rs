//! Names above or below what they name, on as many lines as keep them apart.

use alloc::{string::String, vec::Vec};

/// Width of a letter of a name.
const LETTER: f64 = 6.7;
/// Longest name that is shown in full.
const LONGEST: usize = 26;
/// Height of a line of names.
pub(super) const LINE: f64 = 13.0;

/// A name in its place.
pub(super) struct Label {
    /// What stands there.
    pub(super) text: String,
    /// Where what it names begins.
    pub(super) anchor: f64,
    /// How it is painted.
    pub(super) class: &'static str,
    /// Where it begins.
    pub(super) x: f64,
    /// Which line it stands on, 0 being the nearest to what it names.
    pub(super) line: usize,
}

impl Label {
    /// A name at `anchor`, not yet in its place.
    pub(super) fn new(anchor: f64, text: &str, class: &'static str) -> Self {
        Self {
            text: shortened(text),
            anchor,
            class,
            x: anchor,
            line: 0,
        }
    }
}

/// Puts names, given from left to right, in their places before `right`; returns how many lines
/// they take. No name covers another, nor the leader from a farther line to what it names.
pub(super) fn place(labels: &mut [Label], right: f64) -> usize {
    let mut free: Vec<f64> = Vec::new();
    for label in labels.iter_mut().rev() {
        let width = label.text.chars().count() as f64 * LETTER;
        label.x = label.anchor.min(right - width).max(0.0);
        let end = label.x + width;
        let line = free.iter().position(|left| end < *left);
        label.line = line.unwrap_or(free.len());
        if free.len() <= label.line {
            free.resize(label.line + 1, f64::INFINITY);
        }
        for left in free.iter_mut().take(label.line + 1) {
            *left = left.min(label.x);
        }
    }
    free.len()
}

/// A name that takes no more room than there is.
pub(super) fn shortened(text: &str) -> String {
    if text.chars().count() <= LONGEST {
        return text.into();
    }
    let mut short: String = text.chars().take(LONGEST - 1).collect();
    short.push('…');
    short
}
