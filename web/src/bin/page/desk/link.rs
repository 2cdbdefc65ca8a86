//! The input, and what is shown of it, in a link.

use super::{Choice, Desk, Named};
use encoderscope::sheet::Quantity;
use encoderscope_web::{
    link::{Fragment, encode, query},
    message::{Selection, ToDesk},
};
use leptos::prelude::*;

impl Desk {
    /// Takes over what a link says.
    pub(crate) fn follow_link(self, fragment: &Fragment) {
        let profile = match fragment.profile() {
            Some(Ok(profile)) => {
                self.choice.set(Choice::User);
                profile
            }
            _ => self
                .profile
                .get_value()
                .unwrap_or_else(|| encoderscope::format::Format::T485.default_profile()),
        };
        let value = |name: &str| fragment.value(name).map(ToOwned::to_owned);
        if let Some(payload) = value("frames") {
            self.forget();
            self.payload.set(Some(Ok(payload.clone())));
            self.profile.set_value(Some(profile));
            let profile = query(&profile);
            self.file.set(Some(Named::Linked));
            let change = value("change");
            self.changed.set(change.clone());
            self.send(ToDesk::Link {
                payload,
                change: change.unwrap_or_default(),
                profile,
            });
        } else if let Some(text) = value("dump") {
            self.profile.set_value(Some(profile));
            self.typed(text, &profile);
        } else {
            return;
        }
        // An empty end is open.
        let numbers = |text: String| {
            let mut parts = text.split(':');
            let name = Quantity::parse(parts.next()?)?.name().to_owned();
            let mut end = |open: f64| match parts.next()? {
                "" => Some(open),
                text => text.parse().ok().filter(|end: &f64| !end.is_nan()),
            };
            Some((name, end(f64::MIN)?, end(f64::MAX)?))
        };
        let order = value("sort").map(|name| match name.strip_prefix('-') {
            Some(name) => (name.to_owned(), true),
            None => (name, false),
        });
        self.selection.set(Selection {
            show: value("show").unwrap_or_default(),
            status: value("bits")
                .and_then(|bits| bits.parse().ok())
                .unwrap_or(0),
            range: value("range").and_then(numbers),
            order: order.filter(|(name, _)| Quantity::parse(name).is_some()),
        });
        self.chosen
            .set(value("row").and_then(|row| row.parse().ok()));
        self.goal.set(self.chosen.get_untracked());
    }

    /// What a link says of the input and of what is shown of it.
    pub(crate) fn fragment(self) -> String {
        let mut text = String::new();
        if self.is_empty() {
            return text;
        }
        let mut add = |name: &str, value: String| text += &format!("&{name}={}", encode(&value));
        let Selection {
            show,
            status,
            range,
            order,
        } = self.selection.get();
        if !show.is_empty() && show != "all" {
            add("show", show);
        }
        if status != 0 {
            add("bits", status.to_string());
        }
        if let Some((name, low, high)) = range {
            let (low, high) = (end_text(low), end_text(high));
            add("range", format!("{name}:{low}:{high}"));
        }
        if let Some((name, descending)) = order {
            add("sort", if descending { format!("-{name}") } else { name });
        }
        if let Some(row) = self.chosen.get() {
            add("row", row.to_string());
        }
        if let Some(change) = self.changed.get() {
            add("change", change);
        }
        // The longest part last: where a mail program cuts it the rest is still said.
        if let Some(Ok(payload)) = self.payload.get() {
            add("frames", payload);
        }
        text
    }
}

/// The end of a range; nothing where it is open.
pub(crate) fn end_text(end: f64) -> String {
    match end {
        f64::MIN | f64::MAX => String::new(),
        end => end.to_string(),
    }
}
