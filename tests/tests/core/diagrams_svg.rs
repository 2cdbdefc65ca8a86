//! Pictures: well-formed, and complete in words.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::{captures::values, diagrams::profiles};
use encoderscope::{
    bits::{BitString, Span},
    decode::{Decoder, Frame},
    diagram::{
        Master, Timeline,
        svg::{self, Palette, Style, Theme},
    },
    format::Medium,
    layout::Class,
};
use encoderscope_tests::decoder;

pub(crate) fn read<'a>(decoder: &'a Decoder, bits: &'a BitString) -> Frame<'a> {
    let bits = bits.as_bits();
    match decoder.profile().medium() {
        Medium::Bits => decoder.line(bits).expect("a frame"),
        _ => decoder.frame(bits.bytes()).expect("a frame"),
    }
}

/// The frame and its timeline, and the timeline alone.
pub(crate) fn pictures(frame: &Frame<'_>, style: &Style) -> [String; 2] {
    let timeline = Timeline::new(&frame.layout, frame.bits, &Master::default());
    [
        svg::frame(frame, Some(&timeline), style),
        svg::timeline(frame, &timeline, style),
    ]
}

/// The text of an XML document, if it is well-formed: elements nest, attributes are quoted and
/// named once, and only the five entities are used.
pub(crate) fn text_of(xml: &str) -> Result<String, String> {
    let mut open: Vec<&str> = Vec::new();
    let mut text = String::new();
    let mut rest = xml;
    let mut roots = 0;
    while let Some(at) = rest.find('<') {
        let (before, from) = rest.split_at(at);
        if open.is_empty() && !before.trim().is_empty() {
            return Err(format!("text outside: {before:?}"));
        }
        text.push_str(&unescaped(before)?);
        let end = from.find('>').ok_or("a tag is not closed")?;
        let tag = &from[1..end];
        rest = &from[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop() != Some(name) {
                return Err(format!("</{name}> closes nothing"));
            }
            text.push(' ');
            continue;
        }
        let (tag, alone) = match tag.strip_suffix('/') {
            Some(tag) => (tag, true),
            None => (tag, false),
        };
        let name = tag.split(' ').next().unwrap_or_default();
        if name.is_empty() || !name.chars().all(|letter| letter.is_ascii_alphabetic()) {
            return Err(format!("<{tag}> has no name"));
        }
        let mut names = Vec::new();
        let mut attributes = tag[name.len()..].trim_start();
        while !attributes.is_empty() {
            let (key, value) = attributes.split_once("=\"").ok_or("an attribute")?;
            let (value, behind) = value.split_once('"').ok_or("a quote")?;
            unescaped(value)?;
            if names.contains(&key) || key.contains(' ') {
                return Err(format!("{key} of <{tag}>"));
            }
            names.push(key);
            attributes = behind.trim_start();
        }
        if !alone {
            roots += usize::from(open.is_empty());
            open.push(name);
        }
    }
    match (open.is_empty(), roots, rest.trim()) {
        (true, 1, "") => Ok(text),
        _ => Err(format!("{open:?} is open, {roots} roots, {rest:?} behind")),
    }
}

fn unescaped(text: &str) -> Result<String, String> {
    let mut out = String::new();
    let mut parts = text.split('&');
    out.push_str(parts.next().unwrap_or_default());
    for part in parts {
        let (name, rest) = part.split_once(';').ok_or("an entity is not closed")?;
        out.push(match name {
            "amp" => '&',
            "lt" => '<',
            "gt" => '>',
            "quot" => '"',
            "apos" => '\'',
            other => return Err(format!("&{other};")),
        });
        out.push_str(rest);
    }
    let legal = |letter: char| letter == '\n' || !letter.is_control();
    match out.contains('<') && !text.contains("&lt;") || !out.chars().all(legal) {
        true => Err(format!("{out:?}")),
        false => Ok(out),
    }
}

#[test]
fn the_checker_of_these_tests_refuses_what_is_no_xml() {
    assert_eq!(text_of("<a b=\"1\">x &amp; <c/>y</a>").unwrap(), "x & y ");
    for wrong in [
        "<a>",
        "<a></b>",
        "<a b=1></a>",
        "<a b=\"\" b=\"\"></a>",
        "<a>&nbsp;</a>",
        "<a/>",
        "<a>&</a>",
        "<a></a>x",
        "<a></a><a></a>",
        "<a>\u{1}</a>",
        "<a b=\"></a>",
    ] {
        assert!(text_of(wrong).is_err(), "{wrong}");
    }
}

#[test]
fn every_picture_is_well_formed_and_names_every_field() {
    for parameters in profiles() {
        let decoder = decoder(parameters);
        for values in values(&decoder).iter().skip(1).take(2) {
            let bits = decoder.encode(values);
            let frame = read(&decoder, &bits);
            for width in [0, 320, 960, 100_000] {
                for theme in [Theme::Dark, Theme::Auto] {
                    let style = Style { theme, width };
                    for picture in pictures(&frame, &style) {
                        let text =
                            text_of(&picture).unwrap_or_else(|why| panic!("{parameters} {why}"));
                        let desc = picture.split("<desc>").nth(1).unwrap();
                        let desc =
                            text_of(&format!("<d>{}</d>", desc.split("</desc>").next().unwrap()))
                                .unwrap();
                        for note in frame.explain() {
                            assert!(text.contains(note.name), "{parameters} {}", note.name);
                            assert!(desc.contains(note.name), "{parameters} {}", note.name);
                            assert!(desc.contains(note.text.as_str()), "{parameters}");
                        }
                        assert!(picture.contains("role=\"img\""));
                    }
                }
            }
        }
    }
}

#[test]
fn all_bits_are_drawn_in_the_order_of_the_layout() {
    for parameters in profiles() {
        let decoder = decoder(parameters);
        let bits = decoder.encode(&values(&decoder)[3]);
        let frame = read(&decoder, &bits);
        for width in [320, 777, 2_000] {
            let style = Style {
                width,
                ..Style::default()
            };
            let picture = svg::frame(&frame, None, &style);
            let drawn: String = picture
                .lines()
                .filter(|line| line.contains("es-bit es-mid"))
                .filter_map(|line| line.split('>').nth(1)?.chars().next())
                .collect();
            let expected: String = (0..frame.bits.len())
                .map(|at| if frame.bits.bit(at) { '1' } else { '0' })
                .collect();
            assert_eq!(drawn, expected, "{parameters}");
        }
    }
}

/// All numbers of an attribute.
fn numbers(picture: &str, attribute: &str) -> Vec<f64> {
    let cut = format!(" {attribute}=\"");
    let values = picture.split(&cut).skip(1);
    values
        .map(|rest| rest.split('"').next().unwrap().parse().unwrap())
        .collect()
}

#[test]
fn nothing_is_drawn_outside_of_the_picture() {
    for parameters in profiles() {
        let decoder = decoder(parameters);
        let bits = decoder.encode(&values(&decoder)[3]);
        let frame = read(&decoder, &bits);
        for width in [320, 640, 960, 1_600] {
            let style = Style {
                width,
                ..Style::default()
            };
            for picture in pictures(&frame, &style) {
                let height = numbers(&picture, "height")[0];
                let xs = numbers(&picture, "x")
                    .into_iter()
                    .chain(numbers(&picture, "cx"));
                for x in xs {
                    assert!(
                        (0.0..f64::from(width)).contains(&x),
                        "{parameters} {width}: {x}"
                    );
                }
                let ys = numbers(&picture, "y")
                    .into_iter()
                    .chain(numbers(&picture, "cy"));
                for y in ys {
                    assert!((0.0..height).contains(&y), "{parameters} {width}: {y}");
                }
                for path in picture.split(" d=\"M").skip(1) {
                    let path = path.split('"').next().unwrap();
                    for point in path.split('L') {
                        let (x, y) = point.split_once(' ').unwrap();
                        let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
                        assert!(
                            x >= 0.0 && x <= f64::from(width),
                            "{parameters} {width}: {x}"
                        );
                        assert!(y >= 0.0 && y <= height, "{parameters} {width}: {y}");
                    }
                }
            }
        }
    }
}

/// The names of a picture: where they begin and end, and how far down they stand.
fn names(picture: &str) -> Vec<(f64, f64, f64)> {
    let texts = picture
        .lines()
        .filter(|line| line.starts_with("<text class=\"es-name") && !line.contains("es-mid"));
    let names = texts.map(|line| {
        let (x, y) = (numbers(line, "x")[0], numbers(line, "y")[0]);
        let text = line.split('>').nth(1).unwrap().split('<').next().unwrap();
        let letters = unescaped(text).unwrap().chars().count();
        (x, x + 6.6 * letters as f64, y)
    });
    names.collect()
}

#[test]
fn names_cover_no_other_names() {
    for parameters in profiles() {
        let decoder = decoder(parameters);
        let bits = decoder.encode(&values(&decoder)[3]);
        let frame = read(&decoder, &bits);
        for width in [320, 960] {
            let style = Style {
                width,
                ..Style::default()
            };
            for picture in pictures(&frame, &style) {
                let names = names(&picture);
                for (index, (from, to, y)) in names.iter().enumerate() {
                    assert!(
                        *from >= 0.0 && *to <= f64::from(width),
                        "{parameters} {width}"
                    );
                    let others = names.iter().skip(index + 1);
                    let covered =
                        others.filter(|other| other.2 == *y && other.0 < *to && *from < other.1);
                    assert_eq!(covered.count(), 0, "{parameters} {width} at {from} {y}");
                }
            }
        }
    }
}

#[test]
fn names_that_are_markup_stay_text() {
    let layout = "</text><script>\"&'\u{1};line;status:2:name=<b a=\"&\">:bits=<i>|&lt!,angle:12:name=a]]>'b";
    let decoder = Decoder::new(
        encoderscope::profile::Profile::parse([("format", "own"), ("layout", layout)]).unwrap(),
    )
    .unwrap();
    let mut bits = BitString::zeros(14);
    bits.write(Span::new(0, 14), 0x3fff);
    let frame = read(&decoder, &bits);
    for picture in pictures(&frame, &Style::default()) {
        let text = text_of(&picture).unwrap();
        assert!(text.contains("<b a=\"&\">") && text.contains("a]]>'b"));
        assert!(text.contains("<i>, &lt!"));
        assert!(text.contains("</text><script>\"&'"));
        assert!(!picture.contains("<script") && !picture.contains("<b "));
    }
}

#[test]
fn what_is_wrong_is_marked_and_said() {
    let decoder = decoder("format=biss-c angle-bits=17");
    let mut bits = decoder.encode(&values(&decoder)[2]);
    let whole = svg::frame(&read(&decoder, &bits), None, &Style::default());
    assert!(!whole.contains('✗') && whole.contains("every check holds"));
    bits.flip(30);
    let frame = read(&decoder, &bits);
    let fault = frame.faults()[0].kind.to_string();
    let picture = svg::frame(&frame, None, &Style::default());
    let text = text_of(&picture).unwrap();
    assert!(text.contains("✗ crc") && text.contains(&format!("Fault: {fault}.")));
    assert!(text.contains(&format!("✗ {fault}")));
    assert!(picture.contains("class=\"es-fault\"") && !text.contains("every check holds"));

    let timeline = Timeline::new(
        &frame.layout,
        frame.bits,
        &Master {
            hertz: 20_000_000,
            ..Master::default()
        },
    );
    let picture = svg::timeline(&frame, &timeline, &Style::default());
    assert!(
        text_of(&picture)
            .unwrap()
            .contains("✗ clock: fails, 20 MHz")
    );
}

/// Relative luminance (WCAG 2.2).
fn luminance(colour: &str) -> f64 {
    let channel = |at: usize| {
        let value = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
        match value <= 0.04045 {
            true => value / 12.92,
            false => ((value + 0.055) / 1.055).powf(2.4),
        }
    };
    0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5)
}

#[test]
fn words_are_readable_in_both_themes() {
    for palette in [Palette::LIGHT, Palette::DARK] {
        let ground = luminance(palette.panel);
        let classes = [
            Class::Turns,
            Class::Angle,
            Class::Flags,
            Class::Status,
            Class::Check,
            Class::Framing,
        ];
        let mut colours = vec![palette.ink, palette.dim, palette.good, palette.bad];
        colours.extend(classes.map(|class| palette.of(class)));
        for colour in colours {
            let own = luminance(colour);
            let contrast = (own.max(ground) + 0.05) / (own.min(ground) + 0.05);
            assert!(contrast >= 4.5, "{colour} on {}: {contrast}", palette.panel);
        }
    }
}

#[test]
fn rules_touch_nothing_around_the_picture() {
    let decoder = decoder("format=asi4");
    let bits = decoder.encode(&values(&decoder)[2]);
    for (theme, class) in [
        (Theme::Light, ".es-light "),
        (Theme::Dark, ".es-dark "),
        (Theme::Auto, ".es-auto "),
    ] {
        let picture = svg::frame(&read(&decoder, &bits), None, &Style { theme, width: 400 });
        let rules = picture
            .split("<style>")
            .nth(1)
            .unwrap()
            .split("</style>")
            .next()
            .unwrap();
        let media = "@media screen and (prefers-color-scheme:dark)";
        assert_eq!(rules.contains(media), theme == Theme::Auto);
        let plain = rules.replace(media, "");
        for rule in plain.split('}').filter(|rule| !rule.is_empty()) {
            let selector = rule.trim_start_matches('{').split('{').next().unwrap();
            assert!(selector.starts_with(class), "{selector}");
        }
        // Every class that is used is prefixed, and has a rule or stands for nothing but text.
        for used in picture.split("class=\"").skip(1) {
            let used = used.split('"').next().unwrap();
            assert!(
                used.split(' ').all(|name| name.starts_with("es-")),
                "{used}"
            );
        }
    }
}
