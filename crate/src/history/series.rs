//! One quantity over time, in bounded memory.

use crate::session::Micros;
use alloc::{collections::VecDeque, vec::Vec};

/// Samples that are kept as they came.
const SAMPLES: usize = 16_384;
/// Buckets of a level.
const BUCKETS: usize = 4_096;
/// What a bucket holds of the level below.
const PER_BUCKET: u32 = 8;
/// Levels of buckets: the last holds 134 million samples, 37 hours at a thousand a second.
const LEVELS: usize = 5;
/// A longer time between neighbours is a gap.
const PAUSE: Micros = 500_000;

/// Whether the largest value has the smallest for a neighbour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// It has not.
    Line,
    /// It has: values are degrees of a turn.
    Circle,
}

/// A point of a plot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// When.
    pub at: Micros,
    /// The value; `None` is a gap, which no line crosses.
    pub value: Option<f64>,
}

/// What is kept of samples that came one behind the other.
#[derive(Clone, Copy, Debug)]
struct Bucket {
    from: Micros,
    until: Micros,
    first: f64,
    last: f64,
    min: f64,
    max: f64,
    /// How many neighbours within it no line connects.
    breaks: u32,
    /// How many of the level below it holds.
    parts: u32,
    /// No line connects it with the one before.
    apart: bool,
}

impl Bucket {
    const fn sample(at: Micros, value: f64, apart: bool) -> Self {
        Self {
            from: at,
            until: at,
            first: value,
            last: value,
            min: value,
            max: value,
            breaks: 0,
            parts: 1,
            apart,
        }
    }

    /// Both, `next` behind this one.
    fn joined(self, next: &Self) -> Self {
        Self {
            from: self.from,
            until: next.until,
            first: self.first,
            last: next.last,
            min: self.min.min(next.min),
            max: self.max.max(next.max),
            breaks: (self.breaks.saturating_add(next.breaks)).saturating_add(next.apart.into()),
            parts: self.parts + 1,
            apart: self.apart,
        }
    }

    /// Draws it with a point or two.
    fn draw(&self, points: &mut Vec<Point>) {
        let gap = |at| Point { at, value: None };
        let point = |at, value| Point {
            at,
            value: Some(value),
        };
        if self.apart && !points.is_empty() {
            points.push(gap(self.from));
        }
        if self.min == self.max {
            points.push(point(self.from, self.min));
            if self.until > self.from {
                points.push(point(self.until, self.max));
            }
            return;
        }
        let middle = self.from + (self.until - self.from) / 2;
        // Where the angle passes 0 once, what is lowest follows what is highest, or precedes it.
        let (one, other) = match self.first <= self.last {
            true => (self.min, self.max),
            false => (self.max, self.min),
        };
        points.push(point(self.from, one));
        if self.breaks == 1 {
            points.push(gap(middle));
        }
        points.push(point(middle, other));
    }
}

/// A level of buckets.
#[derive(Clone, Debug, Default)]
struct Level {
    /// Those that are complete.
    ring: VecDeque<Bucket>,
    /// The one that is being filled.
    open: Option<Bucket>,
    /// Older ones have been dropped.
    dropped: bool,
}

impl Level {
    /// Takes what the level below has completed; returns what is complete here by that.
    fn take(&mut self, part: Bucket) -> Option<Bucket> {
        let joined = match self.open.take() {
            None => Bucket { parts: 1, ..part },
            Some(open) => open.joined(&part),
        };
        if joined.parts < PER_BUCKET {
            self.open = Some(joined);
            return None;
        }
        Some(self.complete(joined))
    }

    fn complete(&mut self, bucket: Bucket) -> Bucket {
        if self.ring.len() == BUCKETS {
            self.ring.pop_front();
            self.dropped = true;
        }
        self.ring.push_back(bucket);
        bucket
    }
}

/// One quantity over time: the latest samples as they came, and further back the extremes of
/// ever longer stretches.
///
/// Memory is bounded (1.7 MB) whatever is pushed; a sample costs constant time on average.
///
/// ```
/// use encoderscope::history::{Scale, Series};
/// let mut series = Series::new(Scale::Line);
/// for at in 0..1_000_000 {
///     series.push(at * 1_000, (at % 5_000) as f64);
/// }
/// let points = series.points(0, 1_000_000_000, 500);
/// assert!(points.len() < 2_100);
/// assert!(points.iter().any(|point| point.value == Some(4_999.0)));
/// ```
#[derive(Clone, Debug)]
pub struct Series {
    scale: Scale,
    /// Time, value, and whether it is apart from the one before.
    samples: VecDeque<(Micros, f64, bool)>,
    levels: [Level; LEVELS],
    dropped: bool,
    start: Option<Micros>,
}

impl Series {
    /// Nothing yet.
    #[must_use]
    pub fn new(scale: Scale) -> Self {
        Self {
            scale,
            samples: VecDeque::new(),
            levels: core::array::from_fn(|_| Level::default()),
            dropped: false,
            start: None,
        }
    }

    /// Takes a sample. What is no number is left out; a time before that of the sample before
    /// counts as that.
    pub fn push(&mut self, at: Micros, value: f64) {
        if !value.is_finite() {
            return;
        }
        let (at, apart) = match self.samples.back().copied() {
            None => (at, false),
            Some((before, last, _)) => {
                let at = at.max(before);
                let pause = at - before;
                if pause > PAUSE {
                    self.close(pause);
                }
                (at, pause > PAUSE || self.wraps(last, value))
            }
        };
        self.start.get_or_insert(at);
        if self.samples.len() == SAMPLES {
            self.samples.pop_front();
            self.dropped = true;
        }
        self.samples.push_back((at, value, apart));
        let mut part = Some(Bucket::sample(at, value, apart));
        for level in &mut self.levels {
            let Some(bucket) = part else {
                break;
            };
            part = level.take(bucket);
        }
    }

    /// Whether the shorter way from one value to the next leads over the end of the scale.
    fn wraps(&self, last: f64, value: f64) -> bool {
        self.scale == Scale::Circle && (value - last).abs() > 180.0
    }

    /// Ends buckets in front of a pause, so that none spans it. A long one, which only a plot of
    /// hours draws, spans a short pause: else a line that keeps dropping out would use it up.
    fn close(&mut self, pause: Micros) {
        let mut part = None;
        let mut longest = PAUSE;
        for level in &mut self.levels {
            part = part.and_then(|bucket| level.take(bucket));
            if part.is_none() && pause > longest {
                part = level.open.take().map(|open| level.complete(open));
            }
            longest *= 2;
        }
    }

    /// Whether there is nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.samples.is_empty()
    }

    /// When the first sample came, however long ago, and the last.
    #[must_use]
    pub fn span(&self) -> Option<(Micros, Micros)> {
        let (last, ..) = self.samples.back()?;
        Some((self.start?, *last))
    }

    /// How many samples and buckets are held.
    #[must_use]
    pub fn held(&self) -> usize {
        let levels = self.levels.iter();
        self.samples.len() + levels.map(|level| level.ring.len()).sum::<usize>()
    }

    /// What a plot of the time from `from` to `to` shows that is about `columns` columns wide:
    /// the extremes of each column, in the order of time, with a neighbour on either side.
    ///
    /// The samples are taken from the finest level that reaches back to `from`. There are at most
    /// two values and two gaps a column, and no more than `columns` + 3 columns.
    #[must_use]
    pub fn points(&self, from: Micros, to: Micros, columns: usize) -> Vec<Point> {
        let width = (to.saturating_sub(from) / columns.max(1) as Micros).max(1);
        let mut plotter = Plotter {
            from,
            to,
            width,
            before: None,
            column: None,
            behind: false,
            points: Vec::new(),
        };
        let reaches = |dropped: bool, first: Option<Micros>| {
            !dropped || first.is_some_and(|first| first <= from)
        };
        if reaches(self.dropped, self.samples.front().map(|(at, ..)| *at)) {
            let start = self.samples.partition_point(|(at, ..)| *at < from);
            for (at, value, apart) in self.samples.range(start.saturating_sub(1)..) {
                plotter.take(Bucket::sample(*at, *value, *apart));
            }
            return plotter.finish();
        }
        let covers = |level: &Level| reaches(level.dropped, level.ring.front().map(|b| b.from));
        let index = self.levels.iter().position(covers);
        let (finer, rest) = self.levels.split_at(index.unwrap_or(LEVELS - 1));
        if let Some(level) = rest.first() {
            let start = level.ring.partition_point(|bucket| bucket.until < from);
            for bucket in level.ring.range(start.saturating_sub(1)..) {
                plotter.take(*bucket);
            }
            // What is not complete yet stands in the open buckets, the finer the later.
            for open in level
                .open
                .iter()
                .chain(finer.iter().rev().filter_map(|level| level.open.as_ref()))
            {
                plotter.take(*open);
            }
        }
        plotter.finish()
    }
}

/// Merges what comes into columns.
struct Plotter {
    from: Micros,
    to: Micros,
    /// Of a column. Columns lie at its multiples, so that a plot that moves does not flicker.
    width: Micros,
    /// The last one in front of the plot.
    before: Option<Bucket>,
    column: Option<Bucket>,
    /// The plot has ended.
    behind: bool,
    points: Vec<Point>,
}

impl Plotter {
    fn take(&mut self, bucket: Bucket) {
        if self.behind {
            return;
        }
        if bucket.until < self.from {
            self.before = Some(bucket);
            return;
        }
        if let Some(before) = self.before.take() {
            before.draw(&mut self.points);
        }
        self.behind = bucket.from > self.to;
        let same = |column: &Bucket| column.from / self.width == bucket.from / self.width;
        self.column = match self.column.take() {
            Some(column) if same(&column) && !self.behind => Some(column.joined(&bucket)),
            Some(column) => {
                column.draw(&mut self.points);
                Some(bucket)
            }
            None => Some(bucket),
        };
    }

    fn finish(mut self) -> Vec<Point> {
        if let Some(column) = self.column.or(self.before) {
            column.draw(&mut self.points);
        }
        self.points
    }
}
