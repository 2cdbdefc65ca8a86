use super::Input;
use encoderscope::recording::{Event, Line, LineError, Moment, Purpose, Reader, Writer};

/// A recording: written and read again, cut anyhow, damaged, or arbitrary bytes from the start.
///
/// # Panics
///
/// A law is broken: what is read depends on the cuts, is not what was written, or bytes of the
/// file are neither read nor counted as lost.
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
    assert_eq!(moments(&file, file.len().max(1)), Ok(written.clone()));
    assert_eq!(moments(&file, size), Ok(written.clone()));

    // What is cut off takes nothing away that stands before it.
    let cut = usize::from(place) % (file.len() + 1);
    if let Ok(read) = moments(&file[..cut], size) {
        assert!(written.starts_with(&read));
    }
    let mut broken = file;
    if let Some(byte) = broken.get_mut(cut) {
        *byte ^= damage | 1;
        let read = moments(&broken, broken.len());
        assert_eq!(moments(&broken, size), read);
    }
}

/// Reads a file in pieces.
fn moments(file: &[u8], size: usize) -> Result<Vec<Moment>, encoderscope::recording::Unreadable> {
    let mut reader = Reader::new();
    let mut found = Vec::new();
    for piece in file.chunks(size) {
        reader.push(piece);
        while let Some(moment) = reader.next()? {
            found.push(moment);
        }
    }
    assert!(reader.lost() + reader.rest() as u64 <= file.len() as u64);
    Ok(found)
}

/// What arbitrary bytes say happens: the file, and what is to be read from it.
fn write(input: &mut Input<'_>) -> (Vec<u8>, Vec<Moment>) {
    let mut writer = Writer::new("fuzz", "nothing");
    let mut file = Vec::new();
    let mut written: Vec<Moment> = Vec::new();
    let mut open: Option<Line> = None;
    // Said with the first thing that happens on the line.
    let mut unsaid = false;
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
                unsaid = open.as_ref() != Some(&line);
                open = Some(line.clone());
                writer.open(now, line, &mut file);
                continue;
            }
            1 if what & 8 == 0 => {
                writer.begin(&mut file);
                continue;
            }
            // Nothing comes where no line is open.
            _ if open.is_none() => continue,
            1 if unsaid => continue,
            1 => {
                open = None;
                writer.close(now, &note, &mut file);
                Event::Closed(note)
            }
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
            6 => {
                let error = input.one_of(&LineError::ALL);
                writer.failed(now, error, &mut file);
                Event::Failed(error)
            }
            _ => {
                writer.mark(now, &note, &mut file);
                Event::Marked(note)
            }
        };
        if unsaid && !matches!(event, Event::Closed(_)) {
            unsaid = false;
            written.push(Moment {
                at: now,
                event: Event::Opened(open.clone().unwrap_or_default()),
            });
        }
        written.push(Moment { at: now, event });
    }
    (file, written)
}
