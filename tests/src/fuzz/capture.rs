use super::Input;
use encoderscope::{
    capture::{Capture, Clocking, Edge, Kind, Options, Recording, Wire, sniff},
    decode::Decoder,
    format::Format,
};

/// Arbitrary edges, or arbitrary text as a recording of either kind.
///
/// # Panics
///
/// A law is broken: clocks are lost, frames are out of order, or something has no words.
pub fn capture(data: &[u8]) {
    let mut input = Input(data);
    let clocked: Vec<Format> = Format::ALL
        .iter()
        .copied()
        .filter(|format| format.timing().is_some())
        .collect();
    let Some(decoder) = input.decoder(&clocked) else {
        return;
    };
    match input.byte() % 4 {
        0 => edges(&decoder, input),
        1 => text(&decoder, input, Kind::Vcd, b"$timescale 1 us $end\n$var wire 1 ! ma $end\n$var wire 1 \" slo $end\n$enddefinitions $end\n"),
        2 => text(&decoder, input, Kind::Samples, b"Time [us],clk,data\n0,1,1\n"),
        _ => text(&decoder, input, Kind::Samples, b""),
    }
}

fn edges(decoder: &Decoder, mut input: Input<'_>) {
    let clocking = match input.byte() % 4 {
        0 => Clocking::Counted,
        1 => Clocking::Timed(i64::from(input.word())),
        _ => Clocking::Timed(0),
    };
    let mut capture = Capture::new(decoder)
        .expect("a master clocks it")
        .with_clocking(clocking);
    let mut time = input.long() as i64;
    let mut falls = 0;
    let mut clock = None;
    let mut levels = [true; 2];
    while !input.is_empty() {
        let step = input.byte();
        // Mostly half periods of a few microseconds, sometimes anything at all.
        let span = match step >> 5 {
            0 => input.long() as i64 & i64::MAX,
            1 => i64::from(input.word()) * 1_000,
            2 => 30_000_000,
            _ => i64::from(step) * 5_000,
        };
        time = time.saturating_add(span);
        let wire = [Wire::Clock, Wire::Data][usize::from(step & 1)];
        let level = &mut levels[usize::from(step & 1)];
        *level = !*level;
        if wire == Wire::Clock && clock.replace(*level) == Some(true) {
            falls += 1;
        }
        capture.push(Edge {
            time,
            wire,
            level: *level,
        });
    }
    capture.finish(time);
    let mut last = None;
    let mut counted = 0;
    while let Some(frame) = capture.poll() {
        assert!(last.is_none_or(|last| last <= frame.time), "{frame:?}");
        last = Some(frame.time);
        let behind = u32::from(decoder.profile().format != Format::BissC);
        assert_eq!(frame.bits.as_bits().len() as u32 + behind, frame.clocks);
        counted += frame.clocks;
        assert!(
            frame
                .violations
                .iter()
                .all(|found| found.to_string().len() > 10)
        );
        assert!(frame.hertz.is_none_or(f64::is_finite));
        let _ = decoder.line(frame.bits.as_bits());
    }
    assert!(
        capture
            .stray()
            .iter()
            .all(|found| found.to_string().len() > 10)
    );
    assert!(counted <= falls, "{counted} of {falls}");
    assert!(counted == falls || clocking != Clocking::Counted);
}

fn text(decoder: &Decoder, input: Input<'_>, kind: Kind, head: &[u8]) {
    let mut text = head.to_vec();
    text.extend_from_slice(input.0);
    let _ = sniff(&text);
    match Recording::read(&text, kind, decoder, Options::default()) {
        Ok(found) => {
            assert!(found.wires.clock.signal != found.wires.data.signal);
            assert!(
                found
                    .wires
                    .reasons
                    .iter()
                    .all(|reason| reason.to_string().len() > 8)
            );
        }
        Err(error) => assert!(error.to_string().len() > 10),
    }
}
