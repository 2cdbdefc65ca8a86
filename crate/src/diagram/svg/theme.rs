//! The colours of pictures.

use crate::layout::Class;
use alloc::{format, string::String};

/// Which colours a picture has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Theme {
    /// Dark on light.
    Light,
    /// Light on dark.
    Dark,
    /// What the reader prefers (`prefers-color-scheme`); light in print.
    Auto,
}

impl Theme {
    /// The theme of a name: `light`, `dark` or `auto`.
    #[must_use]
    pub fn parse(name: &str) -> Option<Self> {
        match name {
            "light" => Some(Self::Light),
            "dark" => Some(Self::Dark),
            "auto" => Some(Self::Auto),
            _ => None,
        }
    }

    pub(super) const fn class(self) -> &'static str {
        match self {
            Self::Light => "es-light",
            Self::Dark => "es-dark",
            Self::Auto => "es-auto",
        }
    }

    /// The rules of a style sheet.
    pub(super) fn rules(self) -> String {
        let class = self.class();
        let palette = match self {
            Self::Light | Self::Auto => &Palette::LIGHT,
            Self::Dark => &Palette::DARK,
        };
        let mut rules = fonts(class) + &palette.rules(class);
        if self == Self::Auto {
            let dark = Palette::DARK.rules(class);
            rules += &format!("@media screen and (prefers-color-scheme:dark){{{dark}}}");
        }
        rules
    }
}

/// Colours, as `#rrggbb`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Palette {
    /// What everything stands on.
    pub panel: &'static str,
    /// Words and wires.
    pub ink: &'static str,
    /// Words beside the matter.
    pub dim: &'static str,
    /// Rules between rows.
    pub line: &'static str,
    /// What holds.
    pub good: &'static str,
    /// What fails.
    pub bad: &'static str,
    /// Turns.
    pub turns: &'static str,
    /// Angle.
    pub angle: &'static str,
    /// Flags.
    pub flags: &'static str,
    /// Status.
    pub status: &'static str,
    /// CRC and parity.
    pub check: &'static str,
    /// What frames.
    pub framing: &'static str,
}

impl Palette {
    /// Dark on light.
    pub const LIGHT: Self = Self {
        panel: "#fffefb",
        ink: "#1c2226",
        dim: "#5f6972",
        line: "#dedbd2",
        good: "#2c7a4b",
        bad: "#b3261e",
        turns: "#7b5ea7",
        angle: "#0b6e75",
        flags: "#965a00",
        status: "#2f66b3",
        check: "#9c3d63",
        framing: "#6a6f76",
    };
    /// Light on dark.
    pub const DARK: Self = Self {
        panel: "#1b2125",
        ink: "#e8e6e0",
        dim: "#97a1a9",
        line: "#2d353b",
        good: "#63c088",
        bad: "#f0766c",
        turns: "#b79be6",
        angle: "#4fb8bf",
        flags: "#e0a23c",
        status: "#7eabf0",
        check: "#e58bb0",
        framing: "#929aa2",
    };

    /// The colour of a class of fields.
    ///
    /// ```
    /// use encoderscope::{diagram::svg::Palette, layout::Class};
    /// assert_eq!(Palette::LIGHT.of(Class::Angle), "#0b6e75");
    /// ```
    #[must_use]
    pub const fn of(&self, class: Class) -> &'static str {
        match class {
            Class::Turns => self.turns,
            Class::Angle => self.angle,
            Class::Flags => self.flags,
            Class::Status => self.status,
            Class::Check => self.check,
            Class::Framing => self.framing,
        }
    }

    fn rules(&self, theme: &str) -> String {
        let classes = [
            Class::Turns,
            Class::Angle,
            Class::Flags,
            Class::Status,
            Class::Check,
            Class::Framing,
        ];
        let mut fills = alloc::vec![
            ("panel", self.panel),
            ("ink", self.ink),
            ("dim", self.dim),
            ("good", self.good),
            ("bad", self.bad),
        ];
        fills.extend(classes.map(|class| (class.name(), self.of(class))));
        let mut rules = String::new();
        for (name, colour) in fills {
            rules += &format!(".{theme} .es-{name}{{fill:{colour}}}");
        }
        let strokes = [("rule", self.line), ("wire", self.ink), ("fault", self.bad)];
        for (name, colour) in strokes {
            rules += &format!(".{theme} .es-{name}{{fill:none;stroke:{colour}}}");
        }
        rules
    }
}

fn fonts(theme: &str) -> String {
    let sans = "system-ui,'Segoe UI',Roboto,'Noto Sans','DejaVu Sans',sans-serif";
    let mono = "ui-monospace,'Cascadia Mono','Roboto Mono','DejaVu Sans Mono',monospace";
    format!(
        ".{theme} text{{font:13px {sans}}}\
         .{theme} .es-head{{font-weight:600}}\
         .{theme} .es-mono{{font:12px {mono};font-variant-numeric:tabular-nums}}\
         .{theme} .es-bit{{font:600 15px {mono};font-variant-numeric:tabular-nums}}\
         .{theme} .es-name{{font:11px {mono}}}\
         .{theme} .es-small{{font:9px {mono};font-variant-numeric:tabular-nums}}\
         .{theme} .es-mid{{text-anchor:middle}}\
         .{theme} .es-wire{{stroke-width:1.5}}\
         .{theme} .es-fault{{stroke-width:1.5;stroke-dasharray:3 2}}"
    )
}
