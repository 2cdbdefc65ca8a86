#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::Bits,
    decode::Decoder,
    dump::Direction,
    explain::degrees_text,
    format::Format,
    framing::Why,
    profile::Profile,
    reading::Values,
    record::Value,
    sketch::{DigitsError, Sketch},
};
use encoderscope_tests::decoder;

fn decoders() -> impl Iterator<Item = Decoder> {
    let formats = Format::ALL.iter();
    formats.map(|format| Decoder::new(format.default_profile()).unwrap())
}

fn read(format: &str, digits: &str) -> Result<Sketch, DigitsError> {
    Sketch::of_digits(decoder(&format!("format={format}")), digits, None)
}

fn digits_of(bits: Bits<'_>) -> String {
    let digit = |at| if bits.bit(at) { '1' } else { '0' };
    (0..bits.len()).map(digit).collect()
}

#[test]
fn what_a_sketch_writes_is_read_again() {
    for decoder in decoders() {
        for kind in decoder.frame_kinds() {
            let (name, direction) = (kind.name.clone(), kind.direction);
            let sketch = Sketch::new(decoder.clone(), kind);
            let again = Sketch::of_digits(decoder.clone(), &sketch.text(), Some(direction));
            let again = again.unwrap();
            assert_eq!(again.bits(), sketch.bits(), "{name}");
            assert_eq!(again.kind().direction, direction, "{name}");
        }
    }
}

#[test]
fn digits_of_all_kinds_say_the_same() {
    let bytes = [0x82, 0x00, 0x05, 0x80, 0x00, 0x60, 0x68];
    let line = digits_of(Bits::of_bytes(&bytes));
    let decoder = decoder("format=biss-c angle-bits=17");
    for text in [
        "82000580006068",
        " 82 00 05 80 00 60 68 ",
        "82:00-05,80_00\n60 68",
        "0x82000580006068",
        &line,
        &format!("0b{line}"),
    ] {
        let sketch = Sketch::of_digits(decoder.clone(), text, None).unwrap();
        assert_eq!(digits_of(sketch.bits()), line, "{text}");
        assert_eq!(sketch.frame().values().turns, Some(5), "{text}");
    }
}

#[test]
fn zeros_and_ones_are_bits_only_where_a_frame_has_so_many() {
    // A request of one byte; 8 hexadecimal digits are no reply of T485.
    assert_eq!(read("t485", "00011010").unwrap().text(), "1a");
    // A reply of BUS has four bytes, so these are they.
    let counted = read("bus", "10110000").unwrap();
    assert_eq!(counted.bits().len(), 32);
    assert_eq!(read("bus", "0b10110000").unwrap().bits().len(), 8);
}

#[test]
fn what_is_no_frame_is_refused() {
    let why = |format, digits| read(format, digits).err();
    assert_eq!(why("t485", " : "), Some(DigitsError::Empty));
    assert_eq!(why("t485", "1a g0"), Some(DigitsError::NoDigit('g')));
    assert_eq!(why("ssi", "0b102"), Some(DigitsError::NoDigit('2')));
    assert!(matches!(why("t485", "1a20"), Some(DigitsError::NoFrame(_))));
    assert_eq!(
        why("ssi7", "101"),
        Some(DigitsError::NoFrame(Why::Truncated { have: 3, need: 30 }))
    );
    let word = "0".repeat(48);
    let sent = Sketch::of_digits(decoder("format=ssi"), &word, Some(Direction::Sent));
    assert_eq!(sent.err(), Some(DigitsError::NoFrame(Why::NoFrame)));
    assert_eq!(
        why("ssi", &"f".repeat(1_000_000)),
        Some(DigitsError::NoFrame(Why::NoFrame))
    );
    for error in [
        DigitsError::Empty,
        DigitsError::NoDigit('g'),
        DigitsError::NoFrame(Why::NoFrame),
    ] {
        assert!(!error.to_string().is_empty());
    }
}

#[test]
fn the_example_of_a_profile() {
    for decoder in decoders() {
        let format = decoder.profile().format;
        let reply = Sketch::example(decoder.clone(), Direction::Received).unwrap();
        assert!(reply.frame().ok(), "{format:?}");
        assert!(reply.frame().values().angle.is_some(), "{format:?}");
        let request = Sketch::example(decoder, Direction::Sent);
        let is_asked = matches!(format, Format::Rs485 | Format::T485 | Format::Bus);
        assert_eq!(request.is_some(), is_asked, "{format:?}");
        if let Some(request) = request {
            assert_eq!(request.kind().direction, Direction::Sent, "{format:?}");
            assert_eq!(request.bits().len(), 8, "{format:?}");
        }
    }
}

/// Records hold their decimals as text: the very digits that a float would be printed with.
#[test]
fn decimals_of_records_are_those_of_floats() {
    for bits in 1..=32u32 {
        let width = bits.to_string();
        let profile = Profile::parse([("format", "biss-c"), ("angle-bits", &width)]).unwrap();
        let decoder = Decoder::new(profile).unwrap();
        let last = (1u64 << bits) - 1;
        for angle in [0, 1, last / 3, last / 2, last / 2 + 1, last] {
            let values = Values {
                angle: Some(angle),
                ..Values::default()
            };
            let frame = decoder.encode(&values);
            let record = decoder.line(frame.as_bits()).unwrap().record();
            let places = (bits / 3).clamp(4, 12);
            let float: f64 = degrees_text(angle, bits, places).parse().unwrap();
            let degrees = record.find("degrees").map(Value::plain);
            assert_eq!(degrees, Some(float.to_string()), "{angle} of {bits} bits");
        }
    }
    let decoder = decoder("format=rs485 command=t");
    for tenths in [
        -32_768, -305, -300, -15, -10, -5, 0, 1, 10, 365, 400, 32_767,
    ] {
        let values = Values {
            temperature: Some(tenths),
            ..Values::default()
        };
        let frame = decoder.encode(&values);
        let record = decoder.frame(frame.as_bits().bytes()).unwrap().record();
        let shown = record.find("temperature").map(Value::plain);
        assert_eq!(shown, Some((f64::from(tenths) / 10.0).to_string()));
    }
    assert_eq!(Value::from(f64::NAN), Value::Null);
    assert_eq!(Value::from(-0.25).plain(), "-0.25");
}
