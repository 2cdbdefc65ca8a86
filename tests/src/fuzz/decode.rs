use super::{Input, check_record};
use encoderscope::{
    bits::{self, Bits},
    decode::{Decoded, Decoder, Frame},
    dump::{self, Dump},
    emulator::{Emulator, Shaft},
    format::{Format, Medium},
    layout::{Field, Resolved, Role, Weight},
    reading::Values,
};

/// Pasted text, numbers or an emulated encoder, read with any profile.
///
/// # Panics
///
/// A law is broken: a byte is in no stretch of a dump or in two, a reading comes from a frame
/// that is not good, or a good frame is not what its numbers encode to.
pub fn decode(data: &[u8]) {
    let mut input = Input(data);
    let Some(decoder) = input.decoder(Format::ALL) else {
        return;
    };
    match input.byte() % 4 {
        0 => numbers(&decoder, &mut input),
        1 => clocked(&decoder, &mut input),
        _ => text(&decoder, &input.text()),
    }
}

fn text(decoder: &Decoder, text: &str) {
    let dump = dump::parse(text, decoder.profile().medium());
    account(decoder, &dump);
}

/// Every byte of a dump is in one stretch, in order.
fn account(decoder: &Decoder, dump: &Dump) {
    let mut seen = Vec::new();
    let (mut at, mut frames, mut bad, mut skipped) = (0, 0, 0, 0);
    let summary = decoder.dump(dump, &mut |decoded| {
        let (start, bits) = match &decoded {
            Decoded::Frame(frame) => {
                frames += 1;
                bad += u64::from(!frame.ok());
                check_frame(decoder, frame);
                (frame.start, frame.bits)
            }
            Decoded::Skip { start, bits, why } => {
                assert!(!why.to_string().is_empty());
                skipped += bits.bytes().len() as u64;
                (*start, *bits)
            }
        };
        assert_eq!(start, at);
        assert!(!bits.is_empty());
        at += match dump.is_bits() {
            true => bits.len(),
            false => bits.bytes().len(),
        } as u64;
        seen.extend_from_slice(bits.bytes());
    });
    assert_eq!(seen, dump.bytes());
    assert_eq!(summary.bytes, seen.len() as u64);
    assert_eq!((summary.frames, summary.bad), (frames, bad));
    assert_eq!(summary.skipped, skipped);
    check_record(&summary.record().into());
}

fn check_frame(decoder: &Decoder, frame: &Frame<'_>) {
    let values = frame.values();
    assert_eq!(frame.ok(), frame.faults().is_empty());
    for fault in frame.faults() {
        assert!(fault.at.end() <= frame.bits.len());
        assert!(!fault.kind.to_string().is_empty());
    }
    check_record(&frame.record().into());
    assert!(frame.record().to_string().len() > 2);
    let notes = frame.explain();
    let spans = notes.iter().flat_map(|note| &note.spans);
    assert_eq!(spans.map(|span| span.len).sum::<usize>(), frame.bits.len());
    for note in &notes {
        check_record(&note.record().into());
        assert!(note.bits.iter().all(|bit| bit.at < frame.bits.len()));
    }
    let reading = frame.reading();
    assert_eq!(reading.is_some(), frame.ok() && frame.layout.has_angle);
    if let Some(reading) = reading {
        assert!(reading.angle <= bits::mask(reading.angle_bits as usize));
        assert!((0.0..360.0).contains(&reading.degrees()));
        assert_eq!(Some(reading.angle), values.angle);
        assert_eq!(reading.turns, values.turns);
        assert_eq!(reading.status, values.status);
        assert_eq!(reading.error, values.error == Some(true));
        assert_eq!(reading.warning, values.warning == Some(true));
    }
    if frame.layout.holds(frame.bits) {
        check_encoding(&frame.layout, frame.bits);
        let encoded = decoder.encode(&values);
        check_decoding(decoder, encoded.as_bits(), &values);
    }
}

/// Whether a field is written by nobody's numbers.
fn is_free(field: &Field) -> bool {
    field.row.role == Role::Framing && field.row.constant.is_none()
        || field.cover.is_some() && field.row.weight == Weight::Advisory
}

/// A frame whose checks hold is what its numbers encode to.
fn check_encoding(layout: &Resolved, bits: Bits<'_>) {
    let again = layout.encode(&layout.values(bits));
    assert_eq!(again.as_bits().len(), bits.len());
    assert!(layout.holds(again.as_bits()));
    let same = |field: &Field| layout.wire(field, bits) == layout.wire(field, again.as_bits());
    let free = layout.fields().all(|field| !is_free(field) || same(field));
    for field in layout.fields() {
        // What is in the free bits is in the checks, too.
        let follows = matches!(field.row.role, Role::Crc | Role::Parity | Role::Repeat);
        assert!(
            same(field) || !free && (follows || is_free(field)),
            "{}: {bits:02x?} {again:02x?}",
            field.row.name
        );
    }
}

/// What was encoded from the numbers of a good frame is a good frame with these numbers.
fn check_decoding(decoder: &Decoder, encoded: Bits<'_>, values: &Values) {
    let frame = match decoder.profile().medium() {
        Medium::Bits => decoder.line(encoded).expect("a whole frame"),
        Medium::Bytes | Medium::Text => decoder.frame(encoded.bytes()).expect("a whole frame"),
    };
    assert!(frame.ok(), "{:?}", frame.faults());
    let plain = |values: Values| Values {
        crc: None,
        parity: None,
        ..values
    };
    assert_eq!(plain(frame.values()), plain(*values));
}

/// Any numbers give a frame, and those that fit are read back from it.
fn numbers(decoder: &Decoder, input: &mut Input<'_>) {
    let mut values = input.values();
    let profile = decoder.profile();
    if profile.format == Format::T485 {
        values.status = values.status.map(|status| status & 0xf0);
    }
    let encoded = decoder.encode(&values);
    let frame = match profile.medium() {
        Medium::Bits => decoder.line(encoded.as_bits()).ok(),
        Medium::Bytes | Medium::Text => decoder.frame(encoded.as_bits().bytes()),
    };
    // A frame cannot say what it answers when there is no such operation.
    let Some(frame) = frame else {
        assert!(decoder.echoes() && values.operation.is_some());
        return;
    };
    let range = bits::mask(profile.angle_bits as usize);
    let wide = values.angle.unwrap_or(0) > range;
    assert!(frame.ok() || profile.format == Format::Asi4 && wide);
    if frame.layout.has_angle && !wide {
        assert_eq!(frame.values().angle, Some(values.angle.unwrap_or(0)));
    }
    check_frame(decoder, &frame);
}

/// A master clocks an emulated encoder, too short, too long or as it should.
fn clocked(decoder: &Decoder, input: &mut Input<'_>) {
    // The least step of a number near 1, and less of it.
    let tiny = f64::EPSILON / 16.0;
    let shaft = Shaft {
        start: f64::from(input.word() as i16) / 256.0 + f64::from(input.byte() as i8) * tiny,
        speed: f64::from(input.byte() as i8) / 16.0,
        sway: f64::from(input.byte()) / 16.0,
        period: 1.0,
    };
    let mut encoder = Emulator::new(*decoder.profile(), shaft).expect("a profile that fits");
    encoder.error = input.byte() & 1 == 1;
    encoder.status = input.byte() & 0x3f;
    encoder.faults.flip = u32::from(input.byte() & 3);
    let whole = decoder.main_layout().len;
    let bits = decoder.profile().medium() == Medium::Bits;
    let mut now = 0;
    while !input.is_empty() {
        now += u64::from(input.word()) * 100;
        let count = usize::from(input.byte());
        let values = encoder.values(now);
        assert!(values.angle <= Some(bits::mask(decoder.profile().angle_bits as usize)));
        let word = encoder.clock(now, count);
        assert_eq!(word.as_bits().len(), count);
        let Some(frame) = bits.then(|| decoder.line(word.as_bits()).ok()).flatten() else {
            continue;
        };
        check_frame(decoder, &frame);
        if count == whole && encoder.faults.flip == 0 {
            assert!(frame.ok());
        }
    }
}
