#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::BitString,
    decode::Decoder,
    emulator::{Emulator, Shaft},
    format::own::{self, SHIPPED, Written},
    layout::Role,
    profile::Profile,
    reading::Values,
    session::{Output, Session},
};
use encoderscope_tests::{Noise, paste, stretches};

fn decoder(layout: &str) -> Decoder {
    let profile = Profile::parse([("format", "own"), ("layout", layout)]).unwrap();
    Decoder::new(profile).unwrap()
}

/// The only frame of a dump, all checks of which hold.
fn values(layout: &str, dump: &str) -> Values {
    let decoder = decoder(layout);
    let mut found = Vec::new();
    decoder.dump(&paste(&decoder, dump), &mut |decoded| {
        let encoderscope::decode::Decoded::Frame(frame) = decoded else {
            panic!("{layout}: {dump} has bytes of no frame");
        };
        assert!(frame.ok(), "{layout}: {:?}", frame.faults());
        found.push(frame.values());
    });
    assert_eq!(found.len(), 1, "{layout}: {dump}");
    found[0]
}

fn wrong(layout: &str) -> String {
    let pairs = [("format", "own"), ("layout", layout)];
    Profile::parse(pairs).unwrap_err().to_string()
}

#[test]
fn shipped_layouts_read_frames_that_others_have_published() {
    // Position 0x12345 of each IncOder variant.
    for (layout, dump) in [
        ("incoder-ssi1", "C12345"),
        ("incoder-ssi2", "048D16"),
        ("incoder-ssi4", "C91A2AA2"),
        ("incoder-ssi6", "DFC12345"),
        ("incoder-ssi9", "C91A2B92"),
    ] {
        let found = values(layout, dump);
        assert_eq!(
            (found.angle, found.error),
            (Some(0x12345), Some(false)),
            "{layout}"
        );
    }
    assert_eq!(values("incoder-ssi2", "048D17").error, Some(true));
    assert_eq!(values("incoder-ssi1", "C12345").zero_default, Some(true));

    for (layout, dump, angle, error, warning) in [
        ("rls-biss-26", "1234567EB", 0x123_4567, false, false),
        ("rls-biss-26", "1234567A8", 0x123_4567, false, true),
        ("rls-biss-26", "12345676D", 0x123_4567, true, false),
        ("rls-biss-32", "12345678C5", 0x1234_5678, false, false),
        ("rls-biss-32", "1234567843", 0x1234_5678, true, false),
    ] {
        let digits =
            usize::from(layout == "rls-biss-26") * 34 + usize::from(layout == "rls-biss-32") * 40;
        let word = u64::from_str_radix(dump, 16).unwrap();
        let found = values(layout, &format!("{word:0digits$b}"));
        assert_eq!(
            (found.angle, found.error, found.warning),
            (Some(angle), Some(error), Some(warning)),
            "{layout} {dump}"
        );
    }
    let found = values("rls-orbis-serial", "31 48 8B");
    assert_eq!(
        (found.angle, found.error, found.warning),
        (Some(4642), Some(false), Some(false))
    );
    let found = values("rls-orbis-serial", "31 48 88");
    assert_eq!(
        (found.angle, found.error, found.warning),
        (Some(4642), Some(true), Some(true))
    );
    let found = values("rls-aksim2-serial-18", "31 AA F3 43");
    assert_eq!((found.angle, found.error), (Some(0x2_abcd), Some(false)));
    let found = values("rls-serial-crc", "00 03 08 f6 43 eb");
    assert_eq!(
        (found.turns, found.angle, found.error),
        (Some(3), Some(9177), Some(false))
    );
}

#[test]
fn every_shipped_layout_encodes_decodes_and_notices_each_flipped_bit_it_checks() {
    let mut noise = Noise::new(41);
    for shipped in SHIPPED {
        let decoder = decoder(shipped.name);
        assert_eq!(decoder.profile().own.unwrap().short(), shipped.name);
        let layout = decoder.main_layout();
        for _ in 0..50 {
            let own = decoder.profile();
            let values = Values {
                angle: Some(noise.draw() % (1 << own.angle_bits)),
                turns: Some(noise.draw() as i64 & ((1 << own.turns_bits) - 1)),
                ..Values::default()
            };
            let frame = layout.encode(&values);
            let read = layout.values(frame.as_bits());
            assert!(layout.holds(frame.as_bits()), "{}", shipped.name);
            assert_eq!(read.angle, values.angle, "{}", shipped.name);
            assert_eq!(
                read.turns.unwrap_or(0),
                values.turns.unwrap(),
                "{}",
                shipped.name
            );
            for field in layout.fields().filter(|field| field.row.role == Role::Crc) {
                let mut broken = frame.clone();
                let span = layout.parts(field)[0].span;
                broken.write(span, broken.as_bits().read(span) ^ 1);
                assert!(!layout.holds(broken.as_bits()), "{}", shipped.name);
            }
        }
    }
}

#[test]
fn a_layout_of_the_users_own_says_what_the_manuals_formats_say() {
    // The same frames, by the table of the manual and by one written by hand.
    for (format, layout) in [
        (
            "format=rs485 angle-bits=20 command=d",
            "mine;stream;turns:16,zeros:4,angle:20,error:1,warning:1,status:6,crc:8:0x97",
        ),
        (
            "format=t485 angle-bits=17",
            "mine;stream;const:8:0x1a,status:8,zeros:7:le,angle:17:le,skip:8,turns:16:le,zeros:8,skip:8,crc:8:0x01",
        ),
        (
            "format=ssi-tree angle-bits=12 turns-bits=12 align=right frame-bits=24",
            "mine;line;turns:12:gray,angle:12:gray",
        ),
        (
            "format=ssi7 angle-bits=22",
            "mine;line;zeros:6,angle:22,even:1:from=angle,error:1",
        ),
        (
            "format=biss-c angle-bits=17",
            "mine;biss;turns:16,angle:17,error:1:low,warning:1:low,status:6,crc:6:0x03:xor=0x3f",
        ),
    ] {
        let theirs = encoderscope_tests::decoder(format);
        let mine = decoder(layout);
        let mut noise = Noise::new(5);
        for _ in 0..100 {
            let bits = theirs.profile().angle_bits;
            let values = Values {
                angle: Some(noise.draw() % (1 << bits)),
                turns: Some(noise.draw() as i64 & 0xfff),
                error: Some(noise.below(2) == 1),
                ..Values::default()
            };
            let frame: BitString = theirs.encode(&values);
            let (one, other) = (
                theirs.main_layout().reading(frame.as_bits()),
                mine.main_layout().reading(frame.as_bits()),
            );
            let (one, other) = (one.unwrap().unwrap(), other.unwrap().unwrap());
            assert_eq!(
                (one.angle, one.turns),
                (other.angle, other.turns),
                "{layout}"
            );
            if !format.contains("t485") {
                assert_eq!(one.error, other.error, "{layout}");
            }
        }
    }
}

#[test]
fn text_and_data_are_the_same_layout() {
    for shipped in SHIPPED {
        let written: Written = shipped.text.parse().unwrap();
        assert_eq!(written.to_string(), shipped.text, "{}", shipped.name);
    }
    let text = "All of it;poll:55;const:8:0x55,turns:16:le,angle:24:le:name=position,\
                status:4:low:bits=hot||cold|,count:4,temperature:16,speed:16,\
                crc:16:0x1021:reflected:init=0xffff:xor=0x1:from=turns:to=position";
    let written: Written = text.parse().unwrap();
    assert_eq!(written.to_string(), text);
    let one = own::of(text).unwrap();
    let again = own::of(&format!(" {text} ")).unwrap();
    assert!(core::ptr::eq(one, again), "a layout is kept once");
}

#[test]
fn what_is_no_layout_is_named() {
    for (layout, part) in [
        ("", "TITLE;"),
        ("x;line", "TITLE;"),
        ("x;serial;angle:8", "no way frames come"),
        (";line;angle:8", "a name is empty"),
        ("x;line;turns:8", "there is no angle"),
        ("x;line;angel:8", "field 1 (angel:8): \"angel\" is no kind"),
        ("x;line;angle:65", "65 bits are not in 1…64"),
        ("x;line;angle:8,angle:60", "68 bits of angle exceed 64"),
        ("x;line;angle:8:blue", "says nothing about angle"),
        ("x;line;angle:8,crc:8", "needs its polynomial"),
        ("x;line;angle:8,crc:4:0x97", "more than 4 bits"),
        ("x;line;crc:8:0x97,angle:8", "covers nothing"),
        (
            "x;line;angle:8,crc:8:0x97:from=turns",
            "no field is called \"turns\"",
        ),
        ("x;line;angle:8,crc:8:0x97:to=crc", "covers itself"),
        (
            "x;line;angle:9,crc:8:0x97:reflected",
            "covers whole bytes, not 9 bits",
        ),
        ("x;stream;angle:9", "no whole bytes"),
        ("x;line;angle:8:gray,skip:1,turns:4:gray", "side by side"),
        ("x;line;angle:8:gray:le", "either gray or le"),
        ("x;line;angle:8,skip:255", "263 bits are more than 256"),
        (
            "x;line;angle:8:name=a,turns:4:name=a",
            "two fields are called a",
        ),
        ("x;poll:30;angle:8", "set zero"),
        ("x;poll:c2;angle:8", "reset angle"),
        ("x;poll:zz;angle:8", "not a byte in hexadecimal"),
    ] {
        let message = wrong(layout);
        assert!(message.starts_with("layout: "), "{message}");
        assert!(message.contains(part), "{layout:?}: {message}");
    }
    let many = format!("x;line;angle:1{}", ",skip:1".repeat(60));
    assert!(wrong(&many).contains("more than 40 fields"));
    let none = Profile::parse([("format", "own")]).unwrap_err().to_string();
    assert!(none.contains("incoder-ssi1"), "{none}");
    let other = Profile::parse([("format", "ssi"), ("layout", "x;line;angle:8")]);
    assert!(other.unwrap_err().to_string().contains("is not for SSI"));
}

#[test]
fn nonsense_is_refused_and_never_panics() {
    let mut noise = Noise::new(77);
    let words = [
        "angle",
        "turns",
        "crc",
        ":",
        ":",
        ",",
        ";",
        "8",
        "64",
        "0x97",
        "le",
        "gray",
        "low",
        "reflected",
        "init=",
        "xor=0xff",
        "from=angle",
        "to=crc",
        "line",
        "biss",
        "stream",
        "é",
        "status",
        "bits=a|b",
        "zeros",
        "even",
        "1",
        "poll:64",
        "name=x",
    ];
    for _ in 0..4_000 {
        let count = noise.below(14);
        let mut text = "x;line;angle:12".to_owned();
        if noise.below(3) == 0 {
            text.clear();
        }
        for _ in 0..count {
            text += words[noise.below(words.len() as u64) as usize];
        }
        let Ok(profile) = Profile::parse([("format", "own"), ("layout", &text)]) else {
            continue;
        };
        let decoder = Decoder::new(profile).unwrap();
        let frame = decoder.encode(&Values::default());
        let notes = decoder.main_layout().explain(frame.as_bits());
        let bits: usize = notes
            .iter()
            .flat_map(|note| &note.spans)
            .map(|span| span.len)
            .sum();
        assert_eq!(bits, frame.as_bits().len(), "{text}");
    }
}

#[test]
fn a_stream_is_framed_by_its_crc_and_a_request_is_asked_for() {
    let stream = decoder("rls-serial-crc");
    let encoder = Emulator::new(*stream.profile(), Shaft::turning(10.0, 0.7)).unwrap();
    let frames = (0..40).flat_map(|index| {
        let values = encoder.values(index * 1_000);
        stream.encode(&values).into_bytes()
    });
    let bytes: Vec<u8> = [0x17, 0x99].into_iter().chain(frames).collect();
    let text = encoderscope::record::hex(&bytes);
    let found = stretches(&stream, &paste(&stream, &text));
    assert!(
        found.iter().filter(|stretch| stretch.is_good()).count() >= 39,
        "{found:?}"
    );

    let polled = decoder("rls-orbis-serial");
    let mut encoder = Emulator::new(*polled.profile(), Shaft::turning(10.0, 0.1)).unwrap();
    let mut session = Session::new(polled, 1_000).unwrap();
    let mut angles = Vec::new();
    for now in (0..1_000_000).step_by(200) {
        session.handle_timeout(now);
        if let Some(bytes) = encoder.poll_output(now) {
            session.handle_input(now, &bytes);
        }
        while let Some(output) = session.poll_output() {
            match output {
                Output::Transmit(bytes) => {
                    assert_eq!(bytes, [0x31]);
                    encoder.handle_input(now, &bytes);
                }
                Output::Frame { bytes, .. } => {
                    angles.push(
                        session
                            .decoder()
                            .frame(&bytes)
                            .and_then(|frame| frame.reading()),
                    );
                }
                other => panic!("{now} {other:?}"),
            }
        }
    }
    assert!(angles.len() > 20, "{}", angles.len());
    let good = angles
        .iter()
        .flatten()
        .filter(|reading| reading.angle < 1 << 14 && !reading.error);
    assert_eq!(good.count(), angles.len());
}
