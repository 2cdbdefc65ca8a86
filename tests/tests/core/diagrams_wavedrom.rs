//! WaveJSON and bit fields, written and read back.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::{
    captures::{PROFILES, values},
    diagrams::{UNRECORDED, profiles},
    diagrams_svg::read,
    layouts::layouts,
};
use encoderscope::{
    decode::Decoder,
    diagram::{Master, Timeline, bitfield, wavejson},
    format::{
        Format, Link,
        own::{self, Framing, SHIPPED, Written},
    },
    layout::{Resolved, Role},
    profile::Profile,
    record::Value,
};
use encoderscope_tests::{Noise, decoder};

/// A value as another reader of JSON has it.
fn parsed(json: &Value) -> serde_json::Value {
    serde_json::from_str(&json.to_string()).expect("JSON")
}

#[test]
fn the_wave_of_a_clocked_frame_is_read_back_bit_by_bit() {
    for parameters in PROFILES.iter().chain(UNRECORDED) {
        let decoder = decoder(parameters);
        for values in values(&decoder) {
            let bits = decoder.encode(&values);
            let frame = read(&decoder, &bits);
            for hertz in [200_000, 1_000_000, 1_400_000] {
                let master = Master {
                    hertz,
                    ..Master::default()
                };
                let timeline = Timeline::new(&frame.layout, frame.bits, &master);
                let json = wavejson::written(&frame, &timeline).to_string();
                let found = wavejson::read(&json, decoder.profile()).expect("bits");
                let extra = usize::from(frame.layout.shape.preamble);
                assert_eq!(found.as_bits().len(), bits.as_bits().len() + extra);
                for at in 0..bits.as_bits().len() {
                    assert_eq!(
                        found.as_bits().bit(at + extra),
                        bits.as_bits().bit(at),
                        "{parameters} {at}"
                    );
                }
                let again = read(&decoder, &found);
                assert_eq!(again.values(), frame.values(), "{parameters}");
            }
        }
    }
}

#[test]
fn waves_are_json_whose_lanes_are_equally_long() {
    for parameters in profiles() {
        let decoder = decoder(parameters);
        let bits = decoder.encode(&values(&decoder)[3]);
        let frame = read(&decoder, &bits);
        let timeline = Timeline::new(&frame.layout, frame.bits, &Master::default());
        let record = wavejson::written(&frame, &timeline);
        let json = parsed(&Value::Record(record));
        let signal = json["signal"].as_array().unwrap();
        assert_eq!(signal.len(), timeline.lanes.len() + 1);
        let waves: Vec<&str> = signal
            .iter()
            .map(|lane| lane["wave"].as_str().unwrap())
            .collect();
        assert!(
            waves.iter().all(|wave| wave.len() == waves[0].len()),
            "{parameters}"
        );
        assert!(waves.iter().all(|wave| !wave.starts_with('.')));
        let fields = signal.last().unwrap();
        let boxes = fields["wave"].as_str().unwrap().matches('=').count();
        let data = fields["data"].as_array().unwrap();
        assert_eq!(data.len(), boxes, "{parameters}");
        for note in frame.explain() {
            assert!(
                data.iter().any(|name| name == note.name),
                "{parameters} {}",
                note.name
            );
        }
        assert_eq!(json["head"]["text"], decoder.profile().title());
        // A serial line: a letter a bit, levels as they are sent.
        if decoder.profile().link() != Link::Clocked {
            assert!(wavejson::read(&json.to_string(), decoder.profile()).is_err());
            let wave = waves[timeline.encoder()];
            let ones = |wave: &str| {
                let mut level = '1';
                wave.chars()
                    .filter(|letter| *letter != '|')
                    .map(|letter| {
                        if letter != '.' {
                            level = letter;
                        }
                        level
                    })
                    .collect::<String>()
            };
            let sent: String = (0..bits.as_bits().len() / 8)
                .map(|byte| {
                    let bit = |at: usize| u8::from(bits.as_bits().bit(byte * 8 + 7 - at));
                    let middle: String = (0..8).map(|at| bit(at).to_string()).collect();
                    format!("0{middle}1")
                })
                .collect();
            assert!(ones(wave).contains(&sent), "{parameters}");
        }
    }
}

#[test]
fn waves_as_people_write_them_are_read() {
    let ssi = Format::SsiTree.default_profile();
    let bits = |text: &str| {
        let found = wavejson::read(text, &ssi).unwrap_or_else(|why| panic!("{text}: {why}"));
        let found = found.as_bits();
        (0..found.len())
            .map(|at| if found.bit(at) { '1' } else { '0' })
            .collect::<String>()
    };
    // Four falling edges each, of which the first latches.
    for (text, expected) in [
        (
            "{signal:[{name:'clk',wave:'p...'},{name:'dat',wave:'0101'}]}",
            "101",
        ),
        (
            "{ signal : [ {name: \"data\", wave: \"0.10\"}, {wave: \"P...\", name: \"SCK\",}, ], } ;",
            "010",
        ),
        (
            "// a reading\n{signal:[{name:'a',wave:'nnnn'},{},{name:'b',wave:'1001', phase: 0.2}]}",
            "001",
        ),
        (
            "{signal:['group',{name:'CLOCK',wave:'10101010'},['inner',{name:'DATA',wave:'1.0.1.0.'}]]}",
            "010",
        ),
        (
            "{signal:[{name:'ma',wave:'p.|.'},{name:'slo',wave:'x=.=',data:['1','0']}]}",
            "110",
        ),
        (
            "{signal:[{name:'ma',wave:'p.|.'},{name:'slo',wave:'x345',data:'0 1 1'}]}",
            "011",
        ),
        (
            "{signal:[{name:'clk',wave:'p.......',period:0.5},{name:'dat',wave:'h.lu'}]}",
            "1110011",
        ),
        (
            "/* both */{\"signal\":[{\"name\":\"clk\",\"wave\":\"hlhlhlhl\"},{\"name\":\"dat\",\"wave\":\"u.d.u.d.\"}]}",
            "010",
        ),
    ] {
        assert_eq!(bits(text), expected, "{text}");
    }
    for (text, part) in [
        ("", "ends"),
        ("{signal:", "ends"),
        ("{signal:[{name:'clk',wave:'p..']}", "line 1"),
        ("{\n\nsignal:[{name:'clk' wave:'p..'}]}", "line 3"),
        ("{signal:[]}", "two lanes"),
        ("{}", "two lanes"),
        ("[1, 2]", "two lanes"),
        ("{signal:[{name:'clk',wave:'p...'}]}", "two lanes"),
        (
            "{signal:[{name:'clk',wave:'pq'},{name:'d',wave:'0'}]}",
            "'q'",
        ),
        (
            "{signal:[{name:'clk',wave:'p...'},{name:'d',wave:'01x1'}]}",
            "clock 3",
        ),
        (
            "{signal:[{name:'clk',wave:'11'},{name:'d',wave:'01'}]}",
            "reads no bit",
        ),
        ("{a:1} {", "behind the end"),
        ("{a:wrong}", "\"wrong\""),
        ("{a:'\\u12'}", "hexadecimal"),
    ] {
        let why = wavejson::read(text, &ssi).expect_err(text).to_string();
        assert!(why.contains(part), "{text}: {why}");
    }
    let deep = "[".repeat(10_000);
    assert!(
        wavejson::read(&deep, &ssi)
            .unwrap_err()
            .to_string()
            .contains("nested")
    );
    assert!(wavejson::read("{}", &Format::T485.default_profile()).is_err());
}

/// Name and width of all parts of a layout, in the order in which they are sent.
fn parts(layout: &Resolved) -> Vec<(String, usize)> {
    let mut parts: Vec<(usize, String, usize)> = layout
        .fields()
        .flat_map(|field| {
            let parts = layout.parts(field).iter();
            parts.map(|part| (part.span.start, field.row.name.to_string(), part.span.len))
        })
        .collect();
    parts.sort();
    parts
        .into_iter()
        .map(|(_, name, len)| (name, len))
        .collect()
}

#[test]
fn bit_fields_list_every_part_from_the_last_bit_on() {
    for case in layouts() {
        let json = parsed(&bitfield::written(&case.layout));
        let found: Vec<(String, usize)> = json
            .as_array()
            .unwrap()
            .iter()
            .rev()
            .map(|entry| {
                let name = entry["name"].as_str().unwrap();
                let name = name.split('[').next().unwrap();
                (name.to_string(), entry["bits"].as_u64().unwrap() as usize)
            })
            .collect();
        assert_eq!(found, parts(&case.layout), "{}", case.name);
        let total: usize = found.iter().map(|(_, bits)| bits).sum();
        assert_eq!(total, case.layout.len, "{}", case.name);
    }
}

/// Layouts of users beside the shipped ones.
const WRITTEN: &[&str] = &[
    "Counter;stream;const:8:0xa5,angle:16,crc:8:0x07",
    "Little;stream;const:8:0xa5,zeros:2:le,angle:22:le,turns:16:le,crc:16:0x8005:reflected:init=0xffff",
    "Split;line;angle:8,even:1,angle:8,odd:1:from=angle",
    "Gray;line;turns:4:gray,angle:10:gray,status:3:low:bits=hot||lost,skip:2,skip:3,zeros:1,zeros:1",
    "Odd start;line;error:1,angle:12:le,count:4:le,speed:16:le,temperature:12,crc:5:0x05:from=angle",
    "Last;stream;angle:24:le,error:1,skip:7,crc:16:0x1021:le",
    "Two;line;angle:16:le,const:8:0x1f,angle:16:le",
];

#[test]
fn an_own_layout_comes_back_as_it_was() {
    let shipped = SHIPPED.iter().map(|shipped| shipped.text);
    for text in shipped.chain(WRITTEN.iter().copied()) {
        let pairs = [("format", "own"), ("layout", text)];
        let decoder = Decoder::new(Profile::parse(pairs).unwrap()).unwrap();
        let own = decoder.profile().own.unwrap();
        let json = bitfield::written(decoder.main_layout()).to_string();
        let written = own.written();
        let found = bitfield::read(&json, &written.title, written.framing).expect("a layout");
        let again = own::of(&found.to_string()).unwrap_or_else(|why| panic!("{found}: {why}"));
        let mut profile = *decoder.profile();
        profile.own = Some(again);
        let again = Decoder::new(profile).unwrap();
        assert_eq!(
            parts(again.main_layout()),
            parts(decoder.main_layout()),
            "{found}"
        );
        for values in values(&decoder) {
            assert_eq!(again.encode(&values), decoder.encode(&values), "{found}");
        }
    }
    // Those with no names of their own come back to the letter.
    for text in [WRITTEN[0], WRITTEN[1], WRITTEN[5], WRITTEN[6]] {
        let pairs = [("format", "own"), ("layout", text)];
        let decoder = Decoder::new(Profile::parse(pairs).unwrap()).unwrap();
        let written = decoder.profile().own.unwrap().written();
        let json = bitfield::written(decoder.main_layout()).to_string();
        let found = bitfield::read(&json, &written.title, written.framing);
        assert_eq!(found.unwrap().to_string(), text);
    }
}

#[test]
fn the_manuals_layouts_become_own_ones_that_read_the_same() {
    let cases = [
        ("format=ssi", Framing::Line),
        ("format=ssi7 angle-bits=22", Framing::Line),
        ("format=ssi-tree", Framing::Line),
        (
            "format=ssi-tree code=binary parity=odd turns-bits=12 angle-bits=11",
            Framing::Line,
        ),
        ("format=biss-c angle-bits=17", Framing::Biss),
        ("format=period", Framing::Stream),
        ("format=rs485 command=t", Framing::Poll(0x74)),
        ("format=t485", Framing::Poll(0x1a)),
        ("format=bus", Framing::Poll(0x1f)),
    ];
    for (parameters, framing) in cases {
        let decoder = decoder(parameters);
        let json = bitfield::written(decoder.main_layout()).to_string();
        let found = bitfield::read(&json, "Mine", framing)
            .expect("a layout")
            .to_string();
        let profile = Profile::parse([("format", "own"), ("layout", found.as_str())]);
        let again = Decoder::new(profile.unwrap_or_else(|why| panic!("{found}: {why}"))).unwrap();
        assert_eq!(
            parts(again.main_layout()),
            parts(decoder.main_layout()),
            "{found}"
        );
        for values in values(&decoder) {
            let bits = decoder.encode(&values);
            let frame = read(&again, &bits);
            let read = frame.values();
            assert_eq!(
                (read.turns, read.angle),
                (values.turns, values.angle),
                "{found}"
            );
            assert!(frame.ok(), "{found}: {:?}", frame.faults());
            let crc = frame
                .layout
                .fields()
                .any(|field| field.row.role == Role::Crc);
            let own = decoder
                .main_layout()
                .fields()
                .any(|field| field.row.role == Role::Crc);
            assert_eq!(crc, own, "{found}");
        }
    }
}

#[test]
fn bit_fields_of_others_are_read_by_their_names() {
    let read =
        |text: &str| bitfield::read(text, "It", Framing::Line).map(|found| found.to_string());
    assert_eq!(
        read("[{bits: 1, name: 'error', attr: 'RO'}, {bits: 10, name: 'angle[9:0]', type: 4}, {bits: 5}]").unwrap(),
        "It;line;skip:5,angle:10,error:1"
    );
    assert_eq!(
        read("{reg:[{name:'a:b;c,d',bits:3},{name:'POSITION',bits:17},{name:'multiturn',bits:12}], config:{bits:32}}").unwrap(),
        "It;line;turns:12:name=multiturn,angle:17:name=POSITION,skip:3:name=a b c d"
    );
    for (text, part) in [
        ("{}", "list of fields"),
        ("3", "list of fields"),
        ("[]", "0 fields"),
        ("[{name:'a',bits:1},{name:'b'}]", "field 2"),
        ("[{name:'a',bits:-1}]", "field 1"),
        ("[{name:'a',bits:1e3}]", "field 1"),
        ("[{name:'a',bits:257}]", "more than 256"),
        ("[{bits:1", "line 1"),
    ] {
        let why = read(text).expect_err(text);
        assert!(why.to_string().contains(part), "{text}: {why}");
    }
    let many = format!("[{}]", "{bits:1},".repeat(41));
    assert!(read(&many).unwrap_err().to_string().contains("41 fields"));
}

#[test]
fn no_text_makes_a_reader_fail_otherwise_than_by_saying_why() {
    let mut noise = Noise::new(11);
    let pieces = [
        "{",
        "}",
        "[",
        "]",
        ":",
        ",",
        "'",
        "\"",
        "signal",
        "wave",
        "name",
        "reg",
        "bits",
        "attr",
        "'clk'",
        "'p.|n'",
        "'1x='",
        "data",
        "phase",
        "period",
        "-1e30",
        "0x7fffffffffffffffff",
        "9",
        "'a[7:0]'",
        "'angle:8:le'",
        "'b[4294967295:4294967295]'",
        "\\u",
        "//",
        "/*",
        "\n",
        "é",
    ];
    let ssi = Format::Ssi.default_profile();
    for _ in 0..20_000 {
        let count = noise.below(24);
        let text: String = (0..count)
            .map(|_| pieces[noise.below(pieces.len() as u64) as usize])
            .collect();
        let _ = wavejson::read(&text, &ssi);
        let _ = bitfield::read(&text, &text, Framing::Biss);
    }
    // The forms of both, with the strangest values in every place.
    for _ in 0..5_000 {
        let mut piece = || pieces[noise.below(pieces.len() as u64) as usize];
        let wave = format!(
            "{{signal:[{{name:'clk',wave:'nn.n',period:{},phase:{}}},{{name:{},wave:{},data:{}}}]}}",
            piece(),
            piece(),
            piece(),
            piece(),
            piece()
        );
        let _ = wavejson::read(&wave, &ssi);
        let field = format!(
            "[{{name:{},bits:{},attr:{}}},{{name:'a[15:8]',bits:8,attr:'angle:8:le'}}]",
            piece(),
            piece(),
            piece()
        );
        if let Ok(found) = bitfield::read(&field, "It", Framing::Line) {
            let text = found.to_string();
            let again: Result<Written, _> = text.parse();
            assert_eq!(again.as_ref(), Ok(&found), "{field}: {text}");
        }
    }
}
