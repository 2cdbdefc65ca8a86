//! Writes the elements of a picture from top to bottom.

use super::{MARGIN, theme::Theme};
use alloc::{
    format,
    string::{String, ToString},
    vec::Vec,
};

/// What has been drawn, and how far down.
pub(super) struct Pen {
    body: String,
    width: f64,
    /// Where the next thing stands.
    pub(super) y: f64,
}

impl Pen {
    pub(super) const fn new(width: f64) -> Self {
        Self {
            body: String::new(),
            width,
            y: MARGIN,
        }
    }

    /// How wide the room between the margins is.
    pub(super) const fn inner(&self) -> f64 {
        self.width - 2.0 * MARGIN
    }

    pub(super) fn down(&mut self, by: f64) {
        self.y += by;
    }

    /// Text from `x` on, on the present line.
    pub(super) fn text(&mut self, x: f64, class: &str, text: &str) {
        self.text_at(x, self.y, class, text);
    }

    pub(super) fn text_at(&mut self, x: f64, y: f64, class: &str, text: &str) {
        let (x, y, text) = (number(x), number(y), escaped(text));
        self.body += &format!("<text class=\"{class}\" x=\"{x}\" y=\"{y}\">{text}</text>\n");
    }

    pub(super) fn rect(&mut self, (x, y): (f64, f64), (width, height): (f64, f64), class: &str) {
        let [x, y, width, height] = [x, y, width, height].map(number);
        self.body += &format!(
            "<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/>\n"
        );
    }

    pub(super) fn dot(&mut self, (x, y): (f64, f64), class: &str) {
        let (x, y) = (number(x), number(y));
        self.body += &format!("<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"2\"/>\n");
    }

    /// A line through points.
    pub(super) fn path(&mut self, points: &[(f64, f64)], class: &str) {
        let mut path = String::new();
        for (index, (x, y)) in points.iter().enumerate() {
            let letter = if index == 0 { 'M' } else { 'L' };
            path += &format!("{letter}{} {}", number(*x), number(*y));
        }
        self.body += &format!("<path class=\"{class}\" d=\"{path}\"/>\n");
    }

    /// A rule over the whole width.
    pub(super) fn rule(&mut self) {
        let y = self.y;
        self.path(&[(MARGIN, y), (self.width - MARGIN, y)], "es-rule");
    }

    /// Begins what belongs together, with words that a pointer shows.
    pub(super) fn open(&mut self, title: &str) {
        self.body += &format!("<g><title>{}</title>\n", escaped(title));
    }

    pub(super) fn close(&mut self) {
        self.body += "</g>\n";
    }

    /// The whole picture.
    pub(super) fn finish(self, theme: Theme, title: &str, desc: &str) -> String {
        let (width, height) = (number(self.width), number(self.y + MARGIN));
        let (class, rules, body) = (theme.class(), theme.rules(), self.body);
        let (title, desc) = (escaped(title), escaped(desc));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"{class}\" role=\"img\" \
             width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n\
             <title>{title}</title>\n<desc>{desc}</desc>\n<style>{rules}</style>\n\
             <rect class=\"es-panel\" width=\"{width}\" height=\"{height}\"/>\n{body}</svg>\n"
        )
    }
}

/// Text cut at spaces, and within words that are longer than a line, into lines of at most
/// `room` pixels, where a letter is `letter` wide.
pub(super) fn wrapped(text: &str, room: f64, letter: f64) -> Vec<String> {
    let most = ((room / letter) as usize).max(8);
    let mut lines = Vec::new();
    let mut line = String::new();
    let mut count = 0;
    for word in text.split(' ') {
        let letters: Vec<char> = word.chars().collect();
        if count > 0 && count + 1 + letters.len() > most {
            lines.push(core::mem::take(&mut line));
            count = 0;
        }
        if count > 0 {
            line.push(' ');
            count += 1;
        }
        for letter in letters {
            if count >= most {
                lines.push(core::mem::take(&mut line));
                count = 0;
            }
            line.push(letter);
            count += 1;
        }
    }
    lines.push(line);
    lines
}

/// At most two digits behind the point.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.to_string()
}

/// Text as it stands in XML; what XML cannot hold is left out.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::new();
    for letter in text.chars() {
        match letter {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&apos;",
            '\u{fffe}' | '\u{ffff}' => {}
            letter if letter.is_control() => {}
            letter => out.push(letter),
        }
    }
    out
}
