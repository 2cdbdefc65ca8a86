//! What the page and the worker that decodes dumps say to each other.

use serde::{Deserialize, Serialize};

/// From the page to the worker. A file comes beside its message.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ToDesk {
    /// Speak the language of the texts that come with this, English where none come, and say all that
    /// was said of the input once more.
    Speak,
    /// Text was pasted or typed.
    Text {
        /// The text.
        text: String,
        /// The profile, as the parameters of a link.
        profile: String,
    },
    /// A file was chosen or dropped.
    File {
        /// The profile, as the parameters of a link.
        profile: String,
    },
    /// A link carries frames.
    Link {
        /// The value of its parameter.
        payload: String,
        /// The mistake of the capture that is to be undone; empty for none.
        change: String,
        /// The profile, as the parameters of a link.
        profile: String,
    },
    /// Decode the same input with another profile.
    Profile(String),
    /// Undo a mistake of the capture, by its code in links, or none, and decode with a profile.
    Change {
        /// The mistake; empty for none.
        change: String,
        /// The profile, as the parameters of a link.
        profile: String,
    },
    /// Stop reading; what has been decoded stays.
    Cancel,
    /// Which rows to show, and in which order.
    Show(Selection),
    /// These rows are looked at.
    Rows {
        /// Place of the first one among those that are shown.
        first: usize,
        /// How many.
        count: usize,
    },
    /// Explain a row.
    Explain(usize),
    /// Go to a row.
    Place(usize),
    /// Go to the row at a place among those that are shown.
    Pick(usize),
    /// Go to the row at a time in seconds.
    Seek(f64),
    /// Go to the first row from this one on that is not as it should be.
    NextFault(usize),
    /// Trace the angle.
    Trace {
        /// The first row.
        from: usize,
        /// The row behind the last.
        to: usize,
        /// How many columns there are.
        columns: usize,
    },
    /// Write everything that is shown into a file.
    Export(FileKind),
    /// Put the input into a link; the number comes back with it.
    Share(u32),
    /// Explain the rows that a report shows.
    Report,
    /// Write the decoder in a programming language, by its name.
    Source(String),
}

/// Files that the worker writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FileKind {
    /// A table for a spreadsheet.
    Csv,
    /// A JSON object a line.
    JsonLines,
    /// What was pasted, with its profile.
    Recording,
}

impl FileKind {
    /// The end of its file's name.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::JsonLines => "jsonl",
            Self::Recording => "encoderscope.txt",
        }
    }
}

/// Which rows are shown, by the names that links use.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Selection {
    /// Which kinds; empty for all.
    pub show: String,
    /// Status bits of which one must be set; 0 for any.
    pub status: u8,
    /// A quantity and the range it must be in.
    pub range: Option<(String, f64, f64)>,
    /// What rows are sorted by, and whether the largest comes first.
    pub order: Option<(String, bool)>,
}

/// From the worker to the page. A file comes beside its message.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum FromDesk {
    /// The worker is ready.
    Ready,
    /// How far it is, and what the rows come to.
    Overview(Box<Overview>),
    /// The text that a link or a small file holds, and the profile it asks for.
    Opened {
        /// The text; nothing where it is too long for the page.
        text: Option<String>,
        /// The profile, where the file says which.
        profile: Option<String>,
        /// The mistake that is undone, where the file says so.
        change: Option<String>,
    },
    /// The profile that a recording of clock and data is read with, where the page's has no clock.
    Taken(String),
    /// How text was read, for the page to show in place.
    Marks(Vec<Marked>),
    /// Rows that were looked at.
    Rows {
        /// Place of the first one.
        first: usize,
        /// The rows.
        rows: Vec<RowView>,
    },
    /// What the input may be.
    Candidates {
        /// The best ones, best first.
        found: Vec<CandidateView>,
        /// Whether there is more to try.
        done: bool,
    },
    /// What fits better than the profile that is decoded with, though little is different.
    Near(Vec<NearView>),
    /// A row in bits and fields.
    Explained(Box<Explained>),
    /// A row was looked for: its place among those shown, and itself.
    Found(Option<(usize, usize)>),
    /// The angle over the rows.
    Trace(TraceView),
    /// The value of a link's parameter, or why there is none.
    Shared(u32, Result<String, String>),
    /// A file was written.
    Exported(FileKind),
    /// The rows of a report.
    Report(Vec<Explained>),
    /// The decoder in a programming language.
    Source(String),
    /// The input cannot be opened.
    Refused(String),
}

/// A count of something, and the first row with it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Count {
    /// What.
    pub name: String,
    /// How often.
    pub count: f64,
    /// The first row with it.
    pub first: usize,
}

/// How far decoding is, and what the rows come to.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Overview {
    /// How the input was written.
    pub writing: String,
    /// The profile that is decoded with, as the parameters of a link.
    pub profile: String,
    /// Bytes of the input that have been read, and all of them.
    pub read: (f64, f64),
    /// Whether everything has been read and decoded.
    pub done: bool,
    /// Lines that hold something.
    pub lines: f64,
    /// Bytes that were read out of the input.
    pub bytes: f64,
    /// Frames, good and bad.
    pub frames: f64,
    /// Frames with a fault.
    pub bad: f64,
    /// Bytes in no frame.
    pub skipped: f64,
    /// Rows, and those that are shown.
    pub rows: usize,
    /// Rows that the filter lets through.
    pub shown: usize,
    /// How often rows have been chosen and sorted anew: those on the page are old then.
    pub arranged: u32,
    /// Rows that found no place.
    pub lost: f64,
    /// Whether rows have times.
    pub timed: bool,
    /// Faults by kind.
    pub faults: Vec<Count>,
    /// Input of no frame, by why.
    pub skips: Vec<Count>,
    /// Bits ever set.
    pub conditions: Vec<Count>,
    /// What is wrong with the timing of a capture.
    pub timing: Vec<Count>,
    /// Whether the input is a recording of clock and data.
    pub captured: bool,
    /// What was found out about a capture.
    pub notes: Vec<String>,
    /// Smallest and largest angle in degrees.
    pub angle: Option<(f64, f64)>,
    /// Fewest and most turns.
    pub turns: Option<(f64, f64)>,
    /// Lowest and highest temperature in degrees Celsius.
    pub temperature: Option<(f64, f64)>,
    /// Lowest and highest speed in revolutions per second.
    pub speed: Option<(f64, f64)>,
    /// Seconds from the first to the last row that has a time.
    pub duration: Option<f64>,
    /// What of the text was left out, and how often.
    pub dropped: Vec<Count>,
    /// Pieces of the text that cannot be read.
    pub unread: f64,
}

/// A stretch of the text that is no data; places count bytes of UTF-8.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Marked {
    /// Where it begins.
    pub start: usize,
    /// Where it ends.
    pub end: usize,
    /// What it is; empty where it should be data and cannot be read.
    pub kind: String,
}

impl Marked {
    /// Whether it should be data and cannot be read.
    #[must_use]
    pub const fn is_unread(&self) -> bool {
        self.kind.is_empty()
    }
}

impl RowView {
    /// Whether it is a frame, good or bad.
    #[must_use]
    pub const fn is_frame(&self) -> bool {
        matches!(self.state, RowState::Good | RowState::Bad)
    }
}

/// What a row is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum RowState {
    /// A frame whose every check holds.
    Good,
    /// A frame with a fault.
    Bad,
    /// A request, or its echo.
    Request,
    /// Input of no frame.
    Skip,
}

/// A row as the page shows it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowView {
    /// Its place among all rows.
    pub index: usize,
    /// Offset in the input.
    pub start: f64,
    /// Seconds.
    pub time: Option<f64>,
    /// What it is.
    pub state: RowState,
    /// Whole turns.
    pub turns: Option<f64>,
    /// Counts within one turn, in full.
    pub angle: Option<String>,
    /// The same in degrees.
    pub degrees: Option<String>,
    /// Flags and status bits that are set.
    pub status: String,
    /// What its checks say, or what else is to be said of it.
    pub check: String,
    /// Its first bytes.
    pub hex: String,
}

/// A row in bits and fields.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Explained {
    /// The row's place among all rows.
    pub index: usize,
    /// Its bits, first on the wire on the left.
    pub bits: Vec<bool>,
    /// Whether it is made of bytes.
    pub bytes: bool,
    /// One note a field; none for input of no frame.
    pub notes: Vec<FieldView>,
    /// What is to be said of it as a whole.
    pub says: Vec<String>,
    /// Offset of the request that it answers, where the input has marked one.
    pub answers: Option<f64>,
}

/// What a field says.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FieldView {
    /// Its name.
    pub name: String,
    /// Its name for people.
    pub title: String,
    /// The class that its colour comes from.
    pub class: String,
    /// The runs of bits it consists of: first bit and number.
    pub spans: Vec<(usize, usize)>,
    /// The manual's explanation.
    pub doc: String,
    /// Its number, in decimal or, of up to eight bits, in binary.
    pub raw: String,
    /// Its number in decimal.
    pub value: String,
    /// What the number says.
    pub text: String,
    /// Named bits that are set, and what they mean.
    pub set: Vec<(String, String)>,
    /// What is wrong with it.
    pub fault: Option<String>,
}

/// Something that the input may be.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CandidateView {
    /// The profile, as the parameters of a link.
    pub profile: String,
    /// How sure that is.
    pub verdict: String,
    /// Why, in sentences.
    pub evidence: Vec<String>,
    /// The mistake of the capture that must be undone first, as a link has it.
    pub change: Option<String>,
}

/// Something that fits better than the profile that is decoded with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NearView {
    /// What is different, and why it fits, in a sentence.
    pub text: String,
    /// The profile that fits, as the parameters of a link.
    pub profile: String,
    /// The mistake of the capture that must be undone first, as a link has it.
    pub change: Option<String>,
}

/// The angle over the rows.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TraceView {
    /// The first row.
    pub from: usize,
    /// The row behind the last.
    pub to: usize,
    /// Rows of the points, ascending; a column has two points.
    pub rows: Vec<f64>,
    /// Degrees; what is no number is a gap.
    pub degrees: Vec<f64>,
}
