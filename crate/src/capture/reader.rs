//! A recording of a logic analyser, read as it comes.

#[cfg(feature = "vcd")]
use super::vcd::Vcd;
use super::{Changes, Kind, Unreadable, changes::Keeper, samples::Samples};

/// Bytes that the changes of a recording may take where nothing else is said.
const ROOM: usize = 256_000_000;

/// Reads a recording in pieces, cut anywhere, and keeps what changes in it.
///
/// The text itself is not kept but for the line or command at which it is cut. The changes take
/// up to 256 MB, which is some 60 million of them, or as much as [`Reader::with_room`] says;
/// a recording with more is refused.
///
/// ```
/// use encoderscope::capture::{Kind, Reader};
/// let mut reader = Reader::new(Kind::Samples, Some(1_000_000)).unwrap();
/// for cut in ["clk,da", "ta\n1,1\n0", ",1\n0,0\n"] {
///     reader.push(cut.as_bytes()).unwrap();
/// }
/// let changes = reader.finish().unwrap();
/// let names: Vec<_> = changes.signals().iter().map(|signal| signal.name.as_str()).collect();
/// assert_eq!((&names[..], changes.len()), (&["clk", "data"][..], 4));
/// ```
#[derive(Debug)]
pub struct Reader {
    text: Text,
    keeper: Keeper,
}

#[derive(Debug)]
enum Text {
    #[cfg(feature = "vcd")]
    Vcd(Vcd),
    Samples(Samples),
}

impl Reader {
    /// A reader of recordings of a kind; `sample` is the time from one row to the next in
    /// picoseconds, for rows that have no time and no rate.
    ///
    /// # Errors
    ///
    /// This build reads no VCD.
    pub fn new(kind: Kind, sample: Option<i64>) -> Result<Self, Unreadable> {
        Ok(Self {
            text: match kind {
                #[cfg(feature = "vcd")]
                Kind::Vcd => Text::Vcd(Vcd::new()),
                #[cfg(not(feature = "vcd"))]
                Kind::Vcd => return Err(Unreadable::NoVcd),
                Kind::Samples => Text::Samples(Samples::new(sample)),
            },
            keeper: Keeper::new(ROOM),
        })
    }

    /// This reader, whose changes may take so many bytes.
    #[must_use]
    pub const fn with_room(mut self, bytes: usize) -> Self {
        self.keeper.room = bytes;
        self
    }

    /// Takes the next piece of text.
    ///
    /// # Errors
    ///
    /// The text breaks the rules of its kind, says where; or its changes need too much room. The
    /// reader is of no use then.
    pub fn push(&mut self, text: &[u8]) -> Result<(), Unreadable> {
        let keeper = &mut self.keeper;
        let sink = &mut |change| keeper.take(change);
        match &mut self.text {
            #[cfg(feature = "vcd")]
            Text::Vcd(vcd) => vcd.push(text, sink),
            Text::Samples(samples) => samples.push(text, sink),
        }?;
        self.keeper.fits()
    }

    /// Says that the recording ends here.
    ///
    /// # Errors
    ///
    /// As those of [`Reader::push`].
    pub fn finish(self) -> Result<Changes, Unreadable> {
        let Self { text, mut keeper } = self;
        let sink = &mut |change| keeper.take(change);
        let named = match text {
            #[cfg(feature = "vcd")]
            Text::Vcd(vcd) => vcd.finish(sink),
            Text::Samples(samples) => samples.finish(sink),
        }?;
        keeper.finish(&named)
    }

    /// Says that nothing more is read, though more would come: a line or command that is not
    /// whole is left out.
    ///
    /// # Errors
    ///
    /// As those of [`Reader::push`].
    pub fn cut(self) -> Result<Changes, Unreadable> {
        #[cfg_attr(not(feature = "vcd"), expect(unused_mut))]
        let Self { text, mut keeper } = self;
        let named = match text {
            #[cfg(feature = "vcd")]
            Text::Vcd(vcd) => vcd.cut(&mut |change| keeper.take(change))?,
            Text::Samples(samples) => samples.cut(),
        };
        keeper.finish(&named)
    }
}
