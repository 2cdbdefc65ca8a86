//! Frames as comma-separated values.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::Bits, decode::Decoded, export::table::Table, format::Format, framing::Why, record::Value,
};
use encoderscope_tests::{decoder, paste};

/// The cells of a line, quotes taken off (RFC 4180).
fn cells(line: &str) -> Vec<String> {
    let line = line.strip_suffix("\r\n").expect("a line end");
    let (mut out, mut quoted) = (vec![String::new()], false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => {
                letters.next();
                out.last_mut().expect("a cell").push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => out.push(String::new()),
            letter => out.last_mut().expect("a cell").push(letter),
        }
    }
    assert!(!quoted, "{line}");
    out
}

#[test]
fn columns_stand_in_the_order_of_the_record() {
    let t485 = Table::new(&decoder("format=t485"));
    assert_eq!(
        t485.header(),
        "start,time,ok,turns,angle,degrees,error,warning,status,crc.expected,crc.received,\
         crc.ok,parity.expected,parity.received,parity.ok,operation,enid,alarm,faults,hex\r\n"
    );
    let ssi = Table::new(&decoder("format=ssi"));
    assert_eq!(
        ssi.header(),
        "start,time,ok,turns,angle,degrees,error,warning,status,crc,faults,hex\r\n"
    );
}

#[test]
fn rows_say_what_the_record_says() {
    for (parameters, dump) in [
        (
            "format=t485",
            "1a 20 29 c0 3b 17 00 00 00 c8 37 02 00 01 02 03 00 02 00 01 02 03 03",
        ),
        ("format=rs485 command=t", "00 01 00 00 01 ff 9c 6c"),
        (
            "format=biss-c angle-bits=17",
            "82 00 05 80 00 60 68\n82 00 05 80 00 60 6c",
        ),
        ("format=asi4", "8192\n16384\n"),
    ] {
        let decoder = decoder(parameters);
        let table = Table::new(&decoder);
        let header = cells(&table.header());
        assert_eq!(header, table.columns());
        let mut rows = 0;
        decoder.dump(&paste(&decoder, dump), &mut |decoded| {
            let Decoded::Frame(frame) = decoded else {
                return;
            };
            rows += 1;
            let row = cells(&table.frame(&frame, None));
            assert_eq!(row.len(), header.len());
            let record = frame.record();
            let mut shown = 0;
            for (name, value) in &record.0 {
                let cell = |name: &str| {
                    let at = header.iter().position(|column| column == name);
                    row[at.unwrap_or_else(|| panic!("{parameters}: no column {name}"))].clone()
                };
                match value {
                    Value::Record(inner) => {
                        for (own, value) in &inner.0 {
                            assert_eq!(cell(&format!("{name}.{own}")), value.plain());
                            shown += 1;
                        }
                    }
                    Value::List(list) => {
                        let texts: Vec<_> = list.iter().map(Value::plain).collect();
                        assert_eq!(cell(name), texts.join("; "));
                        shown += 1;
                    }
                    Value::Null => {
                        let empty = header.iter().zip(&row).filter(|(column, _)| {
                            *column == name || column.starts_with(&format!("{name}."))
                        });
                        assert!(empty.clone().count() > 0, "{parameters}: {name}");
                        assert!(empty.into_iter().all(|(_, cell)| cell.is_empty()));
                    }
                    other => {
                        assert_eq!(cell(name), other.plain());
                        shown += 1;
                    }
                }
            }
            let filled = row.iter().filter(|cell| !cell.is_empty()).count();
            assert!(filled <= shown, "{parameters}: {row:?}");
        });
        assert!(rows > 0, "{parameters}");
    }
}

#[test]
fn skips_time_and_commas_are_written_as_the_standard_says() {
    let decoder = decoder("format=rs485 command=d");
    let table = Table::new(&decoder);
    let why = Why::Truncated { have: 3, need: 7 };
    let line = table.skip(12, Bits::of_bytes(&[1, 2, 255]), why, Some(61.000_007));
    let row = cells(&line);
    assert_eq!((row[0].as_str(), row[1].as_str()), ("12", "61.000007"));
    assert_eq!(row[row.len() - 1], "0102ff");
    assert_eq!(row[row.len() - 2], why.to_string());
    assert!(
        row[2..row.len() - 2].iter().all(String::is_empty),
        "{row:?}"
    );
    // The fault of a CRC has a comma in it.
    let bad = [0, 0, 0, 0, 0, 0, 1];
    let line = table.frame(&decoder.frame(&bad).unwrap(), None);
    assert!(
        line.contains("\"crc is 0x01, the data gives 0x00\""),
        "{line}"
    );
    assert_eq!(cells(&line).len(), table.columns().len());
}

#[test]
fn every_format_has_its_quantities_as_columns() {
    for format in Format::ALL {
        let decoder = decoder(&format!("format={}", format.name()));
        let table = Table::new(&decoder);
        for name in format.spec().quantities {
            let parted = format!("{name}.ok");
            let has = |column: &String| column == name || *column == parted;
            assert!(table.columns().iter().any(has), "{} {name}", format.name());
        }
        let mut names = table.columns().to_vec();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), table.columns().len(), "{}", format.name());
    }
}
