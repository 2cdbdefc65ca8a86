use super::Input;
use encoderscope::{
    decode::Decoder,
    emulator::{Emulator, Shaft},
    format::{Format, bus, own, t485},
    link::{self, Fragment},
    profile::{Dialect, Profile},
    sequence::danger,
    session::{Ask, Output, Session},
};

/// What links are made of, beside their letters.
const WORDS: &[&str] = &[
    "#/console?",
    "#/decode?",
    "/explain?",
    "?",
    "&",
    "=",
    "%20",
    "%2B",
    "%D1%8F",
    "%",
    "%zz",
    "+",
    "я",
    "&format=",
    "ssi",
    "biss-c",
    "rs485",
    "t485",
    "bus",
    "period",
    "asi1",
    "asi4",
    "ssi7",
    "ssi-tree",
    "own",
    "&model=",
    "MPP12-17M-B-T485",
    "&angle-bits=",
    "&angleBits=17",
    "&turns-bits=",
    "&status-bits=",
    "&ack-bits=",
    "&frame-bits=25",
    "&command=",
    "&command=0",
    "&command=d",
    "&address=",
    "&baud=",
    "&dialect=tamagawa",
    "&parity=even",
    "&code=gray",
    "&align=tree",
    "&turns-code=signed",
    "&justify=left",
    "&marker=",
    "0",
    "1",
    "16",
    "17",
    "24",
    "31",
    "115200",
    "2500000",
    "4294967295",
    "&layout=",
    "rls-biss-26",
    "rls-orbis-serial",
    "Mine;poll:",
    "Mine;stream;",
    "Mine;line;angle:12",
    "const:8:0x31,",
    "angle:16,",
    "crc:8:0x97",
    "30",
    "c2",
    "1a",
    "&dump=1A%2020",
];

/// A link, a profile or a user's layout.
///
/// # Panics
///
/// A law is broken: a link says something else when it is written again, or its encoder would be
/// changed by being read.
pub fn link(data: &[u8]) {
    let mut input = Input(data);
    match input.byte() % 3 {
        0 => fragment(&input.worded(WORDS)),
        1 => fragment(&String::from_utf8_lossy(input.0)),
        _ => {
            let decoder = input.decoder(Format::ALL);
            if let Some(decoder) = decoder {
                check_profile(decoder.profile());
            }
        }
    }
}

fn fragment(text: &str) {
    let fragment = Fragment::parse(text);
    let bare = text.strip_prefix('#').unwrap_or(text);
    assert_eq!(Fragment::parse(bare), fragment);
    let written = |(name, value): &(String, String)| {
        let (name, value) = (link::encode(name), link::encode(value));
        assert!(name.is_ascii() && value.is_ascii());
        format!("{name}={value}")
    };
    let query: Vec<String> = fragment.parameters.iter().map(written).collect();
    let query = query.join("&");
    assert_eq!(
        Fragment::parse(&format!("#/{}?{query}", fragment.area)),
        fragment
    );
    for (name, _) in &fragment.parameters {
        let first = fragment.parameters.iter().find(|(known, _)| known == name);
        assert_eq!(fragment.value(name), first.map(|(_, value)| &**value));
    }
    // Whatever else a link says, of which a profile knows nothing, is there and changes nothing.
    let other = format!("?a-stranger={}&{query}", link::encode(text));
    let other = Fragment::parse(&other);
    assert_eq!(other.value("a-stranger"), Some(text));
    assert_eq!(other.parameters[1..], fragment.parameters);
    assert_eq!(other.profile(), fragment.profile());
    match fragment.profile() {
        Some(Ok(profile)) => check_profile(&profile),
        Some(Err(error)) => assert!(error.to_string().len() > 8, "{error}"),
        None => {
            let mut names = fragment.parameters.iter().map(|(name, _)| name);
            assert!(!names.any(|name| Profile::knows(name)));
        }
    }
}

/// A profile is what its link says, and reading its encoder changes none.
fn check_profile(profile: &Profile) {
    let query = link::query(profile);
    let again = link::profile(&query).expect("what was written");
    assert_eq!(again.parameters(), profile.parameters());
    assert_eq!(link::profile(&link::query(&again)), Ok(again));
    let said = Fragment::parse(&format!("#/explain?frame=12&{query}")).profile();
    assert_eq!(said, Some(Ok(again)));
    let (Ok(decoder), Ok(other)) = (Decoder::new(*profile), Decoder::new(again)) else {
        panic!("no decoder of {query}");
    };
    let (layout, other) = (decoder.main_layout(), other.main_layout());
    assert_eq!(layout.len, other.len);
    assert_eq!(
        layout
            .fields()
            .map(|field| (field.row.name, field.width))
            .collect::<Vec<_>>(),
        other
            .fields()
            .map(|field| (field.row.name, field.width))
            .collect::<Vec<_>>(),
    );
    if let Some(own) = profile.own {
        assert_eq!(profile.angle_bits, again.angle_bits, "{query}");
        assert_eq!(profile.turns_bits, again.turns_bits, "{query}");
        assert!(own::of(own.short()).is_ok_and(|known| core::ptr::eq(known, own)));
    }
    polled(&decoder);
}

/// Whatever a session asks in turn, no encoder that hears it is another one behind it.
fn polled(decoder: &Decoder) {
    let profile = decoder.profile();
    if profile.format == Format::T485 {
        for request in t485::Request::ALL {
            let ask = Ask::t485(decoder, *request, 0);
            assert!(ask.is_err() || !request.changes_encoder());
        }
    }
    let session = match Session::new(decoder.clone(), 0) {
        Ok(session) => session,
        Err(refused) => return assert!(refused.to_string().len() > 10),
    };
    let sent = requests(session);
    if let Some(first) = sent.first() {
        assert_eq!(danger(profile, first), None);
        let operation = bus::Operation::ALL.iter().skip(1);
        for operation in operation.filter(|_| profile.format == Format::Bus) {
            assert_ne!(
                first[..],
                [bus::request(profile, *operation, profile.address as u8)]
            );
        }
    }
    let tamagawa = Profile {
        dialect: Dialect::Tamagawa,
        ..Format::T485.default_profile()
    };
    let formats = [Format::Rs485, Format::T485, Format::Bus].map(Format::default_profile);
    for theirs in formats.into_iter().chain([tamagawa]) {
        let shaft = Shaft::still(5.25);
        let mut encoder = Emulator::new(theirs, shaft).expect("a profile that fits");
        encoder.status = 1;
        let holds = |encoder: &Emulator| {
            let values = encoder.values(1_000_000_000);
            let cells: Vec<_> = (0..8).map(|cell| encoder.memory(cell)).collect();
            (
                values.turns,
                values.angle,
                encoder.status,
                encoder.address(),
                cells,
            )
        };
        let before = holds(&encoder);
        for (request, now) in sent.iter().zip((0u64..).step_by(100_000)) {
            encoder.handle_input(now, request);
            while encoder.poll_output(now + 50_000).is_some() {}
        }
        assert_eq!(holds(&encoder), before, "{sent:02x?}");
    }
}

/// What a session sends that is never answered.
fn requests(mut session: Session) -> Vec<Vec<u8>> {
    let mut sent = Vec::new();
    for _ in 0..40 {
        session.handle_timeout(session.deadline());
        while let Some(output) = session.poll_output() {
            if let Output::Transmit(bytes) = output {
                sent.push(bytes);
            }
        }
    }
    sent
}
