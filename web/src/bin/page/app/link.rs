//! Links: what one says is shown, and one leads back to what is shown.

use super::{App, Area};
use crate::parts;
use encoderscope::{language::t, text};
use encoderscope_web::link::{Fragment, query};
use leptos::prelude::*;

impl App {
    /// Takes over the profile of a link, where there is one.
    pub(crate) fn follow_profile_of(self, link: &Fragment) {
        match link.profile() {
            Some(Ok(profile)) => self.change_profile(profile),
            Some(Err(error)) => self
                .link_fault
                .set(Some(text!("The link is not right: {}.", error))),
            None => {}
        }
    }

    pub(super) fn follow_link(self, text: &str) {
        let fragment = Fragment::parse(text);
        let area = Area::ALL
            .into_iter()
            .find(|area| area.name() == fragment.area);
        let area = area.unwrap_or(Area::Console);
        self.link.set(fragment.clone());
        let moves = self.area.get_untracked() != area;
        if moves {
            self.place.set(None);
            self.area.set(area);
        }
        match (area, self.place.get_untracked()) {
            (Area::Console, _) if fragment.parameters.is_empty() => {}
            (Area::Console, _) => self.follow_console(fragment),
            (_, Some(place)) if !moves => place.follow.run(fragment),
            // The area follows it when its code is there.
            _ => {}
        }
    }

    /// Reading a profile takes more code than the first view has.
    fn follow_console(self, link: Fragment) {
        self.reads_link.set(true);
        leptos::task::spawn_local(async move {
            if parts::profile_of(self, link).await.is_err() {
                let why = t("The link cannot be read without the network.");
                self.link_fault.set(Some(why.into()));
            }
            self.reads_link.set(false);
        });
    }

    /// Whether a link is the one that was followed last.
    pub(crate) fn is_here(self, link: &Fragment) -> bool {
        self.link.with_untracked(|last| last == link)
    }

    /// The fragment that leads back here; none while the code of the area is on its way.
    pub(super) fn fragment(&self) -> Option<String> {
        match self.area.get() {
            Area::Console if self.reads_link.get() => None,
            Area::Console => Some(format!("#/console?{}", query(&self.profile.get()))),
            _ => self.place.get().map(|place| place.fragment.get()),
        }
    }

    /// The whole address that leads back here.
    pub(crate) fn address(&self) -> String {
        let address = window().location().href().unwrap_or_default();
        match self.fragment() {
            Some(fragment) => address.split('#').next().unwrap_or_default().to_owned() + &fragment,
            None => address,
        }
    }
}
