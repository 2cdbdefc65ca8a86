use super::Input;
use encoderscope::recording::{
    Event, Line, LineError, Moment, Purpose, Reader, Unreadable, Writer,
};

/// A recording: written and read again, cut anyhow, damaged, or arbitrary bytes from the start.
///
/// # Panics
///
/// A law is broken: what is read depends on the cuts, is not what was written, happens on a line
/// that is not open, or more bytes are lost than there are.
pub fn recording(data: &[u8]) {
    let mut input = Input(data);
    let how = input.byte();
    let size = 1 + usize::from(input.word());
    if how & 1 == 0 {
        let found = moments(input.0, input.0.len().max(1));
        assert_eq!(moments(input.0, size), found);
        return;
    }
    let (damage, place) = (input.byte(), input.word());
    let (file, written) = write(&mut input);
    for size in [file.len().max(1), size] {
        assert_eq!(moments(&file, size), Ok((written.clone(), 0)));
    }

    // What is cut off takes nothing away that stands before it.
    let cut = usize::from(place) % (file.len() + 1);
    if let Ok((read, _)) = moments(&file[..cut], size) {
        assert!(written.starts_with(&read));
    }
    let mut broken = file;
    if let Some(byte) = broken.get_mut(cut) {
        *byte ^= damage | 1;
        let read = moments(&broken, broken.len());
        assert_eq!(moments(&broken, size), read);
    }
}

/// Reads a file in pieces: what happened, and how many bytes could not be read.
fn moments(file: &[u8], size: usize) -> Result<(Vec<Moment>, u64), Unreadable> {
    let mut reader = Reader::new();
    let mut found = Vec::new();
    let mut open = false;
    for piece in file.chunks(size) {
        reader.push(piece);
        while let Some(moment) = reader.next()? {
            match moment.event {
                Event::Opened(_) => open = true,
                Event::Closed(_) => assert!(core::mem::take(&mut open), "{moment:?}"),
                Event::Marked(_) | Event::Ended(_) => {}
                Event::Received { .. } | Event::Sent { .. } | Event::Failed(_) => {
                    assert!(open, "{moment:?}");
                }
            }
            found.push(moment);
        }
    }
    let unread = reader.lost() + reader.rest() as u64;
    assert!(unread <= file.len() as u64);
    Ok((found, unread))
}

/// What arbitrary bytes say happens: the file, and what is to be read from it.
fn write(input: &mut Input<'_>) -> (Vec<u8>, Vec<Moment>) {
    let mut writer = Writer::new("fuzz", "nothing");
    let mut file = Vec::new();
    let mut written: Vec<Moment> = Vec::new();
    let mut open: Option<Line> = None;
    // A line is said with the first thing that happens on it.
    let mut said: Option<Line> = None;
    let mut now = input.long();
    while !input.is_empty() {
        let (what, how) = (input.byte(), input.byte());
        now = now.saturating_add(input.word().into());
        let bytes = input.take(1 + usize::from(how & 0x3f)).to_vec();
        let note = String::from_utf8_lossy(&bytes).into_owned();
        let beside = how & 0x40 != 0;
        let event = match what & 7 {
            0 => {
                let line = Line {
                    profile: note,
                    adapter: "adapter".into(),
                    baud: how.into(),
                };
                open = Some(line.clone());
                writer.open(now, line, &mut file);
                continue;
            }
            1 if what & 8 == 0 => {
                writer.begin(&mut file);
                continue;
            }
            1 => {
                open = None;
                writer.close(now, &note, &mut file);
                if said.take().is_none() {
                    continue;
                }
                Event::Closed(note)
            }
            7 if what & 8 == 0 => {
                writer.end(now, &note, &mut file);
                Event::Ended(note)
            }
            7 if note.is_empty() => continue,
            7 => {
                writer.mark(now, &note, &mut file);
                Event::Marked(note)
            }
            // Notes are all that is left where no line is open.
            _ if open.is_none() => continue,
            _ if bytes.is_empty() => continue,
            2 | 3 => {
                writer.received(now, &bytes, beside, &mut file);
                Event::Received { bytes, beside }
            }
            4 | 5 => {
                let purpose = beside.then(|| input.one_of(&Purpose::ALL));
                writer.sent(now, &bytes, purpose, &mut file);
                Event::Sent { bytes, purpose }
            }
            _ => {
                let error = input.one_of(&LineError::ALL);
                writer.failed(now, error, &mut file);
                Event::Failed(error)
            }
        };
        if open.is_some() && said != open {
            said.clone_from(&open);
            written.push(Moment {
                at: now,
                event: Event::Opened(open.clone().unwrap_or_default()),
            });
        }
        written.push(Moment { at: now, event });
    }
    (file, written)
}
