#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    decode::{Decoded, Decoder},
    dump::Dump,
    emulator::{Emulator, Shaft},
    framing::Why,
    reading::Values,
    record::hex,
    sheet::{Filter, Order, Quantity, Sheet, Show},
};
use encoderscope_tests::{Noise, decoder, paste};

fn sheet(decoder: &Decoder, dump: &Dump) -> Sheet {
    let mut sheet = Sheet::new(decoder.clone());
    while sheet.step(dump, 1 << 16) {}
    sheet.finish(dump);
    sheet
}

/// Frames of a turning shaft, every tenth of them damaged.
fn damaged(parameters: &str, count: u64) -> (Decoder, Dump) {
    let decoder = decoder(parameters);
    let encoder = Emulator::new(*decoder.profile(), Shaft::turning(5.0, 2.0)).unwrap();
    // The status field of T485 has other bits.
    let weak = |index: u64| index.is_multiple_of(7) && parameters != "format=t485";
    let lines = (0..count).map(|index| {
        let values = Values {
            status: Some(if weak(index) { 0b100 } else { 0 }),
            warning: Some(weak(index)),
            ..encoder.values(index * 1_000)
        };
        let mut frame = decoder.encode(&values).into_bytes();
        if index % 10 == 9 {
            frame[1] ^= 0x10;
        }
        format!("{:.3} s RX: {}", index as f64 * 0.001, hex(&frame))
    });
    let text = lines.collect::<Vec<_>>().join("\n");
    let dump = paste(&decoder, &text);
    (decoder, dump)
}

/// A row in short.
fn short(sheet: &Sheet, dump: &Dump, index: usize) -> (u64, Vec<u8>, bool) {
    let row = sheet.row(dump, index).unwrap();
    match row.decoded {
        Decoded::Frame(frame) => (frame.start, frame.bits.bytes().into(), frame.ok()),
        Decoded::Skip { start, bits, .. } => (start, bits.bytes().into(), false),
    }
}

#[test]
fn rows_are_what_the_decoder_finds() {
    for parameters in [
        "format=rs485 command=d",
        "format=t485",
        "format=bus",
        "format=period",
        "format=biss-c angle-bits=17",
        "format=ssi angle-bits=17",
        "format=asi1",
    ] {
        let (decoder, dump) = damaged(parameters, 200);
        let sheet = sheet(&decoder, &dump);
        let mut index = 0;
        let summary = decoder.dump(&dump, &mut |decoded| {
            let found = short(&sheet, &dump, index);
            let expected = match &decoded {
                Decoded::Frame(frame) => (frame.start, frame.bits.bytes().to_vec(), frame.ok()),
                Decoded::Skip { start, bits, .. } => (*start, bits.bytes().to_vec(), false),
            };
            assert_eq!(found, expected, "{parameters} row {index}");
            assert_eq!(sheet.is_good(index), expected.2, "{parameters} row {index}");
            index += 1;
        });
        assert_eq!(sheet.len(), index, "{parameters}");
        assert_eq!(sheet.figures().summary, summary, "{parameters}");
        assert_eq!(summary.frames, 200, "{parameters}");
    }
}

#[test]
fn rows_of_a_damaged_stream_are_kept_as_they_came() {
    for parameters in [
        "format=period",
        "format=t485",
        "format=rs485 command=1",
        "format=asi4",
    ] {
        let decoder = decoder(parameters);
        let encoder = Emulator::new(*decoder.profile(), Shaft::turning(5.0, 2.0)).unwrap();
        let mut noise = Noise::new(8);
        let mut bytes = Vec::new();
        for index in 0..2_000u64 {
            let mut frame = decoder.encode(&encoder.values(index * 300)).into_bytes();
            // Long quiet stretches, then bytes that are lost, added and damaged.
            if index % 400 >= 370 {
                match noise.below(6) {
                    0 => drop(frame.pop()),
                    1 => frame.push(noise.below(256) as u8),
                    2 => frame[0] ^= 1 << noise.below(8),
                    _ => {}
                }
            }
            bytes.extend(frame);
        }
        let dump = Dump::of_bytes(bytes);
        let sheet = sheet(&decoder, &dump);
        let (mut rows, mut faults) = (Vec::new(), Vec::new());
        decoder.dump(&dump, &mut |decoded| {
            faults.push(match &decoded {
                Decoded::Frame(frame) => !frame.ok(),
                Decoded::Skip { why, .. } => *why != Why::Request,
            });
            rows.push(match decoded {
                Decoded::Frame(frame) => (frame.start, frame.bits.bytes().to_vec(), frame.ok()),
                Decoded::Skip { start, bits, .. } => (start, bits.bytes().to_vec(), false),
            });
        });
        assert!(faults.contains(&true), "{parameters}");
        assert_eq!(sheet.len(), rows.len(), "{parameters}");
        for (index, row) in rows.iter().enumerate() {
            assert_eq!(
                &short(&sheet, &dump, index),
                row,
                "{parameters} row {index}"
            );
            let fault = faults[index..].iter().position(|fault| *fault);
            assert_eq!(
                sheet.next_fault(index),
                fault.map(|at| index + at),
                "{parameters} {index}"
            );
        }
        assert_eq!(sheet.next_fault(rows.len()), None);
    }
}

#[test]
fn steps_of_any_size_make_the_same_sheet() {
    let (decoder, dump) = damaged("format=t485", 300);
    let whole = sheet(&decoder, &dump);
    for budget in [1, 7, 64, 1_000] {
        let mut cut = Sheet::new(decoder.clone());
        while cut.step(&dump, budget) {}
        cut.finish(&dump);
        assert_eq!(cut.figures(), whole.figures(), "{budget}");
        assert_eq!(cut.len(), whole.len(), "{budget}");
    }
}

#[test]
fn figures_count_what_was_put_in() {
    let (decoder, dump) = damaged("format=rs485 command=d", 700);
    let sheet = sheet(&decoder, &dump);
    let figures = sheet.figures();
    assert_eq!((figures.summary.frames, figures.summary.bad), (700, 70));
    let faults: Vec<_> = figures
        .faults
        .iter()
        .map(|tally| (tally.name.as_str(), tally.count, tally.first))
        .collect();
    assert_eq!(faults, [("crc does not hold", 70, 9)]);
    // Every seventh frame has the bit; every tenth of those is damaged.
    let weak = figures
        .conditions
        .iter()
        .find(|tally| tally.name == "field too weak");
    assert_eq!(weak.map(|tally| (tally.count, tally.first)), Some((90, 0)));
    let speed = figures.speed.unwrap();
    assert!(
        (speed.0 - 2.0).abs() < 0.01 && (speed.1 - 2.0).abs() < 0.01,
        "{speed:?}"
    );
    let (first, last) = figures.times.unwrap();
    assert!((last - first - 0.699).abs() < 1e-9);
    assert_eq!(figures.turns, Some((5, 6)));
}

#[test]
fn rows_are_filtered_sorted_and_found() {
    let (decoder, dump) = damaged("format=t485", 500);
    let mut sheet = sheet(&decoder, &dump);
    let arranged = |sheet: &mut Sheet, filter: Filter, order: Option<Order>| {
        sheet.show(filter, order);
        while sheet.arrange(&dump, 37) {}
        let rows = (0..sheet.shown()).map(|place| sheet.shown_at(place).unwrap());
        rows.collect::<Vec<_>>()
    };
    let faults = Filter {
        show: Show::Faults,
        ..Filter::default()
    };
    let rows = arranged(&mut sheet, faults, None);
    assert_eq!(
        rows,
        (0..50).map(|index| index * 10 + 9).collect::<Vec<_>>()
    );
    assert_eq!((sheet.place_of(19), sheet.place_of(20)), (Some(1), Some(2)));

    let range = Filter {
        range: Some((Quantity::Degrees, 90.0, 180.0)),
        ..Filter::default()
    };
    let rows = arranged(&mut sheet, range, None);
    assert!(!rows.is_empty());
    for index in 0..sheet.len() {
        let row = sheet.row(&dump, index).unwrap();
        let within = Quantity::Degrees
            .of(&row)
            .is_some_and(|angle| (90.0..=180.0).contains(&angle));
        assert_eq!(rows.contains(&index), within, "{index}");
    }

    let by = Quantity::Angle;
    for descending in [false, true] {
        let rows = arranged(
            &mut sheet,
            Filter::default(),
            Some(Order { by, descending }),
        );
        assert_eq!(rows.len(), 500);
        let keys: Vec<_> = rows
            .iter()
            .map(|index| by.of(&sheet.row(&dump, *index).unwrap()))
            .collect();
        let known: Vec<f64> = keys.iter().copied().flatten().collect();
        assert_eq!(known.len(), 450);
        // Frames that fail have no angle and come last, whatever the order.
        assert!(keys[450..].iter().all(Option::is_none));
        assert!(known.is_sorted_by(|one, other| if descending {
            one >= other
        } else {
            one <= other
        }));
    }
    assert_eq!(arranged(&mut sheet, Filter::default(), None).len(), 500);
    assert_eq!(sheet.next_fault(10), Some(19));
    assert_eq!(sheet.next_fault(499), Some(499));
    assert_eq!(sheet.next_fault(500), None);
    assert_eq!(sheet.row_at(&dump, 0.2), Some(200));
    assert_eq!(sheet.row_at(&dump, 99.0), Some(499));
}

#[test]
fn conditions_are_found_by_their_bits() {
    let (decoder, dump) = damaged("format=rs485 command=d", 140);
    let mut sheet = sheet(&decoder, &dump);
    let count = |sheet: &mut Sheet, filter: Filter| {
        sheet.show(filter, None);
        while sheet.arrange(&dump, 1_000) {}
        sheet.shown()
    };
    let status = |status| Filter {
        status,
        ..Filter::default()
    };
    assert_eq!(count(&mut sheet, status(0b100)), 18);
    assert_eq!(count(&mut sheet, status(0b10)), 0);
    let conditions = Filter {
        show: Show::Conditions,
        ..Filter::default()
    };
    assert_eq!(count(&mut sheet, conditions), 18);
}

#[test]
fn columns_hold_the_lowest_and_the_highest_angle() {
    // More rows than a block has, so that both ways of counting are used.
    let decoder = decoder("format=t485");
    let mut noise = Noise::new(3);
    let frames: Vec<Vec<u8>> = (0..20_000)
        .map(|_| {
            let values = Values {
                angle: Some(noise.draw() % (1 << 23)),
                turns: Some(0),
                ..Values::default()
            };
            decoder.encode(&values).into_bytes()
        })
        .collect();
    let dump = Dump::of_bytes(frames.concat());
    let sheet = sheet(&decoder, &dump);
    assert_eq!(sheet.len(), 20_000);
    for (from, to, columns) in [
        (0, 20_000, 3),
        (0, 20_000, 500),
        (5_000, 5_100, 40),
        (0, 1, 9),
    ] {
        let found = sheet.columns(&dump, from, to, columns);
        assert!(found.len() <= columns);
        for (index, column) in found.iter().enumerate() {
            let next = found.get(index + 1).map_or(to, |next| next.row);
            if to - from > 10_000 && columns == 3 {
                continue;
            }
            let angles = (column.row..next).map(|row| {
                let row = sheet.row(&dump, row).unwrap();
                Quantity::Degrees.of(&row).unwrap()
            });
            let (low, high) = angles.fold((f64::MAX, f64::MIN), |(low, high), angle| {
                (low.min(angle), high.max(angle))
            });
            assert_eq!(column.range, Some((low, high)), "{from}…{to} {index}");
        }
    }
    let whole = sheet.columns(&dump, 0, 20_000, 1);
    let figures = sheet.figures().angle.unwrap();
    let degrees = |angle| encoderscope::reading::degrees(angle, 23);
    assert_eq!(
        whole[0].range,
        Some((degrees(figures.0), degrees(figures.1)))
    );
}

#[test]
fn a_reply_to_another_command_is_read_again_as_what_it_is() {
    let text = "TX: 64\nRX: 00 05 12 34 56 00 02\nTX: 31\nRX: 00 05 12 34 56 c4\n";
    let decoder = decoder("format=rs485 command=d");
    let dump = paste(&decoder, text);
    let sheet = sheet(&decoder, &dump);
    let mut expected = Vec::new();
    decoder.dump(&dump, &mut |decoded| {
        if let Decoded::Frame(frame) = decoded {
            expected.push((frame.start, frame.layout.len, frame.ok(), frame.request));
        }
    });
    let found: Vec<_> = (0..sheet.len())
        .filter_map(|index| match sheet.row(&dump, index).unwrap().decoded {
            Decoded::Frame(frame) => {
                Some((frame.start, frame.layout.len, frame.ok(), frame.request))
            }
            Decoded::Skip { .. } => None,
        })
        .collect();
    assert_eq!(expected.len(), 2);
    assert_eq!(found, expected);
    assert_eq!((found[0].3, found[1].3), (Some(0), Some(8)));
}
