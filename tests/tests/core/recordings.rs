//! Recordings of serial lines: what stands in the file, and what is left of a damaged one.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::recording::{
    Event, Line, LineError, Moment, Purpose, Reader, Section, Unreadable, Writer,
};

fn line(profile: &str) -> Line {
    Line {
        profile: profile.into(),
        adapter: "FTDI FT232R (0403:6001)".into(),
        baud: 2_500_000,
    }
}

fn read(file: &[u8]) -> Vec<Moment> {
    let mut reader = Reader::new();
    reader.push(file);
    rest_of(&mut reader)
}

fn rest_of(reader: &mut Reader) -> Vec<Moment> {
    std::iter::from_fn(|| reader.next().expect("a recording")).collect()
}

fn received(at: u64, bytes: &[u8]) -> Moment {
    Moment {
        at,
        event: Event::Received {
            bytes: bytes.into(),
            beside: false,
        },
    }
}

/// 2026-11-23 00:00:00 UTC.
const MIDNIGHT: u64 = 1_795_392_000_000_000;

#[test]
fn a_packet_is_what_the_link_type_says() {
    let mut writer = Writer::new("Encoderscope 0.1.0", "Linux");
    let mut file = Vec::new();
    writer.open(MIDNIGHT, line("format=t485"), &mut file);
    let head = file.len();
    writer.received(MIDNIGHT + 1_000_002, &[0x1a, 0x20, 0x29], false, &mut file);
    let packet = &file[head..];
    assert_eq!(packet[..12], [6, 0, 0, 0, 48, 0, 0, 0, 0, 0, 0, 0]);
    let time = MIDNIGHT + 1_000_002;
    assert_eq!(packet[12..16], ((time >> 32) as u32).to_le_bytes());
    assert_eq!(packet[16..20], (time as u32).to_le_bytes());
    assert_eq!(packet[20..28], [15, 0, 0, 0, 15, 0, 0, 0]);
    // Seconds and microseconds of the line, the event, control lines, two of no meaning.
    assert_eq!(packet[28..40], [0, 0, 0, 1, 0, 0, 0, 2, 2, 0, 0, 0]);
    assert_eq!(packet[40..], [0x1a, 0x20, 0x29, 0, 48, 0, 0, 0]);
    // Section header, then link type 250.
    assert_eq!(file[..4], [0x0a, 0x0d, 0x0d, 0x0a]);
    let interface = file[4] as usize;
    assert_eq!(file[interface..interface + 4], [1, 0, 0, 0]);
    assert_eq!(file[interface + 8..interface + 10], [250, 0]);
}

#[test]
fn everything_that_happens_is_read_again() {
    let mut writer = Writer::new("Encoderscope 0.1.0", "Linux").commented("what is odd: ы");
    let mut file = Vec::new();
    writer.open(MIDNIGHT, line("format=t485"), &mut file);
    writer.sent(MIDNIGHT + 1, &[0x1a], None, &mut file);
    writer.received(MIDNIGHT + 2, &[1, 2, 3], false, &mut file);
    writer.failed(MIDNIGHT + 3, LineError::Overrun, &mut file);
    writer.mark(MIDNIGHT + 4, "the cable is moved", &mut file);
    writer.sent(MIDNIGHT + 5, &[0x62], Some(Purpose::Setting), &mut file);
    writer.received(MIDNIGHT + 6, &[0x62], true, &mut file);
    writer.close(MIDNIGHT + 7, "lost", &mut file);
    writer.open(MIDNIGHT + 8, line("format=rs485"), &mut file);
    writer.received(MIDNIGHT + 9, &[9], false, &mut file);
    writer.end(MIDNIGHT + 10, "stopped", &mut file);

    let mut reader = Reader::new();
    reader.push(&file);
    let moments = rest_of(&mut reader);
    assert_eq!(
        *reader.section(),
        Section {
            comment: "what is odd: ы".into(),
            application: "Encoderscope 0.1.0".into(),
            system: "Linux".into(),
        }
    );
    assert_eq!((reader.lost(), reader.rest()), (0, 0));
    let times: Vec<u64> = moments.iter().map(|moment| moment.at - MIDNIGHT).collect();
    assert_eq!(times, [1, 1, 2, 3, 4, 5, 6, 7, 9, 9, 10]);
    let events: Vec<Event> = moments.into_iter().map(|moment| moment.event).collect();
    let came = |bytes: &[u8], beside| Event::Received {
        bytes: bytes.into(),
        beside,
    };
    let went = |byte, purpose| Event::Sent {
        bytes: vec![byte],
        purpose,
    };
    let expected = [
        Event::Opened(line("format=t485")),
        went(0x1a, None),
        came(&[1, 2, 3], false),
        Event::Failed(LineError::Overrun),
        Event::Marked("the cable is moved".into()),
        went(0x62, Some(Purpose::Setting)),
        came(&[0x62], true),
        Event::Closed("lost".into()),
        Event::Opened(line("format=rs485")),
        came(&[9], false),
        Event::Ended("stopped".into()),
    ];
    assert_eq!(events, expected);
}

#[test]
fn what_stands_in_front_is_known_whatever_comes_behind() {
    let mut file = Vec::new();
    let mut head = Writer::new("Encoderscope", "Linux").commented("what was seen");
    head.begin(&mut file);
    let mut writer = Writer::new("Encoderscope", "Linux");
    writer.open(MIDNIGHT, line("format=t485"), &mut file);
    writer.received(MIDNIGHT, &[1], false, &mut file);
    let mut reader = Reader::new();
    assert_eq!(reader.front(), None);
    reader.push(&file);
    assert_eq!(rest_of(&mut reader).len(), 2);
    assert_eq!(reader.front(), Some("what was seen"));
    assert_eq!(reader.section().comment, "");
}

/// A long recording: a packet every millisecond, each with its number.
fn long(packets: u32) -> Vec<u8> {
    let mut writer = Writer::new("Encoderscope", "Linux");
    let mut file = Vec::new();
    writer.open(0, line("format=asi1"), &mut file);
    for number in 0..packets {
        writer.received(
            u64::from(number) * 1_000,
            &number.to_be_bytes(),
            false,
            &mut file,
        );
    }
    file
}

fn numbers(moments: &[Moment]) -> Vec<u32> {
    let number = |moment: &Moment| match &moment.event {
        Event::Received { bytes, .. } => Some(u32::from_be_bytes(bytes[..].try_into().unwrap())),
        _ => None,
    };
    moments.iter().filter_map(number).collect()
}

#[test]
fn a_cut_takes_only_what_it_hits() {
    let file = long(50);
    let whole = read(&file);
    for cut in 0..file.len() {
        let mut reader = Reader::new();
        reader.push(&file[..cut]);
        let found = rest_of(&mut reader);
        assert!(whole.starts_with(&found));
        assert_eq!(reader.lost(), 0);
        // A packet of four bytes and its head take 48.
        assert!(reader.rest() < 140);
        let read = numbers(&found).len();
        let there = (cut.saturating_sub(file.len() - 50 * 48)) / 48;
        assert_eq!(read, there);
    }
}

#[test]
fn damage_costs_a_section_at_most() {
    let packets = 20_000;
    let mut file = long(packets);
    assert_eq!(numbers(&read(&file)).len() as u32, packets);
    let third = file.len() / 3;
    file[third..third + 5_000].fill(0xa5);
    let mut reader = Reader::new();
    reader.push(&file);
    let found = numbers(&rest_of(&mut reader));
    assert!(
        reader.lost() >= 4_900 && reader.lost() < 300_000,
        "{}",
        reader.lost()
    );
    assert!(found.is_sorted());
    assert_eq!(found.first(), Some(&0));
    assert_eq!(found.last(), Some(&(packets - 1)));
    assert!(found.len() as u64 >= u64::from(packets) - reader.lost() / 48 - 1);
}

#[test]
fn reading_can_begin_in_the_middle() {
    let file = long(20_000);
    let mut reader = Reader::joining();
    reader.push(&file[file.len() / 2..]);
    let moments = rest_of(&mut reader);
    assert_eq!(moments[0].event, Event::Opened(line("format=asi1")));
    let found = numbers(&moments);
    assert_eq!(found.last(), Some(&19_999));
    assert!(found.len() > 4_000);
}

#[test]
fn times_do_not_run_backwards() {
    let mut writer = Writer::new("Encoderscope", "Linux");
    let mut file = Vec::new();
    writer.open(100, line("format=asi1"), &mut file);
    writer.received(200, &[1], false, &mut file);
    writer.received(150, &[2], false, &mut file);
    assert_eq!(read(&file)[1..], [received(200, &[1]), received(200, &[2])]);
}

#[test]
fn notes_stand_where_no_line_is_open() {
    let mut writer = Writer::new("Encoderscope", "Linux");
    let mut file = Vec::new();
    writer.mark(5, "begins", &mut file);
    writer.end(6, "stopped", &mut file);
    // Bytes open it, even if nothing is known about it.
    writer.received(7, &[1], false, &mut file);
    let moments = read(&file);
    let events: Vec<&Event> = moments.iter().map(|moment| &moment.event).collect();
    assert_eq!(
        events[..3],
        [
            &Event::Marked("begins".into()),
            &Event::Ended("stopped".into()),
            &Event::Opened(Line::default()),
        ]
    );
    assert_eq!(moments[3..], [received(7, &[1])]);
}

/// A block with its high bytes first.
fn big(kind: u32, body: &[u8]) -> Vec<u8> {
    let length = (12 + body.len() as u32).to_be_bytes();
    [&kind.to_be_bytes()[..], &length, body, &length].concat()
}

fn foreign(link: u16) -> Vec<u8> {
    let section = [
        &0x1a2b_3c4d_u32.to_be_bytes()[..],
        &[0, 1, 0, 0],
        &[0xff; 8],
    ]
    .concat();
    // Nanoseconds, and a speed.
    let options = [
        &[0, 9, 0, 1, 9, 0, 0, 0, 0, 8, 0, 8][..],
        &9_600_u64.to_be_bytes(),
        &[0, 0, 0, 0],
    ]
    .concat();
    let interface = [&link.to_be_bytes()[..], &[0; 6], &options].concat();
    let data = [0, 0, 0, 0, 0, 0, 0, 0, 4, 0x3f, 0, 0, 0x64];
    let packet = [
        &0_u32.to_be_bytes()[..],
        &5_000_000_000_u64.to_be_bytes(),
        &13_u32.to_be_bytes(),
        &13_u32.to_be_bytes(),
        &data,
        &[0; 3],
    ]
    .concat();
    [
        big(0x0a0d_0d0a, &section),
        big(1, &interface),
        big(6, &packet),
    ]
    .concat()
}

#[test]
fn recordings_of_others_are_read() {
    let moments = read(&foreign(250));
    let line = Line {
        baud: 9_600,
        ..Line::default()
    };
    assert_eq!(moments[0].event, Event::Opened(line));
    assert_eq!(moments[1], received(5_000_000, &[0x64]));
}

#[test]
fn a_network_beside_the_line_does_not_close_it() {
    let network = big(1, &[0, 1, 0, 0, 0, 0, 0, 0]);
    let end = |interface: u32| big(5, &[&interface.to_be_bytes()[..], &[0; 8]].concat());
    let beside = [foreign(250), network, end(1)].concat();
    assert_eq!(read(&beside), read(&foreign(250)));
    let closed = read(&[beside, end(0)].concat());
    assert_eq!(closed[2].event, Event::Closed(String::new()));
}

#[test]
fn what_is_no_recording_is_named() {
    let error = |file: &[u8]| {
        let mut reader = Reader::new();
        reader.push(file);
        reader.next().unwrap_err().to_string()
    };
    assert_eq!(error(b"1a 20 29 c0 3b 17 00 00"), "this is no pcapng file");
    assert_eq!(
        error(&foreign(1)),
        "its packets are of link type 1, not of a serial line (250)"
    );
    let mut reader = Reader::new();
    reader.push(b"1a");
    assert_eq!(reader.next(), Ok(None));
    assert_eq!(Unreadable::NotPcapng.to_string(), "this is no pcapng file");
}
