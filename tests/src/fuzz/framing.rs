use super::{Input, streams};
use encoderscope::{
    bits::{self, Bits},
    decode::Decoder,
    format::{Format, bus, t485},
    framing::{Framer, Piece, PieceKind, Why},
    layout::Resolved,
    reading::Values,
};

/// More is not looked at: the slow checks are tried at every place.
const LONGEST: usize = 1024;

/// A stream of bytes, cut anyhow.
///
/// # Panics
///
/// A law is broken: the pieces depend on the cuts, do not follow one another or leave a byte
/// out, or the quick verdict on a frame is not the slow one.
pub fn framing(data: &[u8]) {
    let mut input = Input(data);
    let Some(decoder) = input.decoder(&streams()) else {
        return;
    };
    let options = input.byte();
    let cuts: Vec<usize> = input.take(4).iter().map(|cut| usize::from(*cut)).collect();
    let mut bytes = match options & 1 {
        0 => input.0.to_vec(),
        _ => stream(&decoder, &mut input),
    };
    bytes.truncate(LONGEST);
    check_verdicts(&decoder, &bytes);
    for framer in [Framer::at_start(), Framer::joining()] {
        let whole = pieces(&decoder, framer.clone(), [&bytes[..]].into_iter());
        check_order(&decoder, &whole, &bytes);
        let single = pieces(&decoder, framer.clone(), bytes.chunks(1));
        assert_eq!(single, whole);
        if cuts.iter().any(|cut| *cut > 0) {
            let mut rest = &bytes[..];
            let mut sizes = cuts.iter().cycle();
            let cut = core::iter::from_fn(|| {
                let size = (*sizes.next()?).min(rest.len());
                let (cut, after) = rest.split_at(size);
                let more = !rest.is_empty();
                rest = after;
                more.then_some(cut)
            });
            assert_eq!(pieces(&decoder, framer, cut), whole);
        }
    }
}

/// What a piece is, apart from its bytes.
#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Frame { sure: bool, bits: usize, good: bool },
    Skip(Why),
}

type Found = (u64, Vec<u8>, Kind);

fn pieces<'b>(
    decoder: &Decoder,
    mut framer: Framer,
    cuts: impl Iterator<Item = &'b [u8]>,
) -> Vec<Found> {
    let mut found = Vec::new();
    let mut sink = |piece: Piece<'_>| {
        let kind = match piece.kind {
            PieceKind::Frame {
                layout,
                sure,
                holds,
            } => {
                let good = layout.holds(Bits::of_bytes(piece.bytes));
                assert_eq!(holds, good);
                Kind::Frame {
                    sure,
                    bits: layout.len,
                    good,
                }
            }
            PieceKind::Skip(why) => Kind::Skip(why),
        };
        found.push((piece.start, piece.bytes.to_vec(), kind));
    };
    for cut in cuts {
        framer.push(decoder, cut, &mut sink);
    }
    framer.finish(decoder, &mut sink);
    found
}

/// The pieces are the input.
fn check_order(decoder: &Decoder, found: &[Found], bytes: &[u8]) {
    let mut at = 0;
    for (start, piece, kind) in found {
        assert_eq!(*start, at as u64);
        assert!(!piece.is_empty());
        assert_eq!(bytes.get(at..at + piece.len()), Some(&piece[..]));
        at += piece.len();
        if let Kind::Frame { sure, bits, good } = kind {
            assert_eq!(*bits, piece.len() * 8);
            let frame = decoder.frame(piece).expect("a frame");
            assert_eq!(frame.ok(), *good);
            assert!(*sure || *good, "a bad frame needs no doubt");
        }
    }
    assert_eq!(at, bytes.len());
}

/// The tables that judge many frames quickly judge as the checks themselves do.
fn check_verdicts(decoder: &Decoder, bytes: &[u8]) {
    let mut slow: Vec<(*const Resolved, Resolved)> = Vec::new();
    for at in 0..bytes.len() {
        let Some(quick) = decoder.layout(&bytes[at..]) else {
            continue;
        };
        let Some(frame) = bytes.get(at..at + quick.len / 8) else {
            continue;
        };
        if !slow.iter().any(|(known, _)| core::ptr::eq(*known, quick)) {
            slow.push((quick, Resolved::new(quick.layout, quick.shape)));
        }
        let known = slow.iter().find(|(known, _)| core::ptr::eq(*known, quick));
        let slow = &known.expect("just put there").1;
        let frame = Bits::of_bytes(frame);
        assert_eq!(quick.holds(frame), slow.holds(frame), "{frame:02x?}");
        assert_eq!(quick.faults(frame), slow.faults(frame));
        assert_eq!(quick.holds(frame), slow.faults(frame).is_empty());
        assert_eq!(quick.values(frame), slow.values(frame));
        assert_eq!(quick.reading(frame), slow.reading(frame));
    }
}

/// Frames of a moving shaft, with what goes wrong between them.
fn stream(decoder: &Decoder, input: &mut Input<'_>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut values = Values {
        turns: Some(input.word().into()),
        angle: Some(0),
        operation: operation(decoder, input.byte()),
        enid: Some(0x17),
        ..Values::default()
    };
    while !input.is_empty() && bytes.len() < LONGEST {
        let (what, how) = (input.byte(), input.byte());
        let last = bytes.len().saturating_sub(1 + usize::from(how & 0x0f));
        match what & 7 {
            0..=2 => {
                let step = i64::from(how as i8) << (what >> 3 & 0x0f);
                let angle = values.angle.unwrap_or(0).wrapping_add_signed(step);
                values.angle = Some(angle & bits::mask(decoder.profile().angle_bits as usize));
                bytes.extend(decoder.encode(&values).into_bytes());
            }
            3 => {
                let frame = decoder.encode(&values).into_bytes();
                bytes.extend(frame.repeat(usize::from(how & 0x0f)));
            }
            4 => {
                let shown = what & 8 == 0;
                let asked = how % 9;
                values.operation = operation(decoder, asked);
                let request = request(decoder, asked);
                bytes.extend(request.filter(|_| shown));
            }
            5 => bytes.extend(input.take(usize::from(how & 0x0f))),
            6 => {
                if let Some(byte) = bytes.get_mut(last) {
                    *byte ^= 1 << (what >> 3 & 7);
                }
            }
            _ if what & 8 == 0 => drop(bytes.drain(last..(last + 1).min(bytes.len()))),
            _ => values.status = Some(how & 0xf0),
        }
    }
    bytes
}

/// What is asked for in turn, in formats whose frames say so.
fn operation(decoder: &Decoder, asked: u8) -> Option<u8> {
    let byte = request(decoder, asked)?;
    decoder
        .layout(&[byte])?
        .values(Bits::of_bytes(&[byte]))
        .operation
}

fn request(decoder: &Decoder, asked: u8) -> Option<u8> {
    let profile = decoder.profile();
    let asked = usize::from(asked);
    match profile.format {
        Format::Rs485 => Some(profile.command.byte()),
        Format::T485 => Some(t485::Request::ALL[asked % t485::Request::ALL.len()].byte()),
        Format::Bus => {
            let operation = bus::Operation::ALL[asked % bus::Operation::ALL.len()];
            Some(bus::request(profile, operation, profile.address as u8))
        }
        _ => None,
    }
}
