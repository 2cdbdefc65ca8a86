//! Which rows of a sheet are shown, and in which order.

use super::{Entry, Kind, Row, Sheet, Skip};
use crate::{
    decode::{Decoded, Frame},
    dump::Dump,
    language::msg,
    reading::degrees,
};
use alloc::vec::Vec;
use core::cmp::Ordering;

/// Which rows are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Show {
    /// All.
    #[default]
    All,
    /// Frames, good or bad.
    Frames,
    /// Frames with a fault, and input of no frame that is no request.
    Faults,
    /// Good frames with an error, a warning or a status bit set.
    Conditions,
}

impl Show {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::All, Self::Frames, Self::Faults, Self::Conditions];

    /// One word, in links too.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::All => msg("all"),
            Self::Frames => msg("frames"),
            Self::Faults => msg("faults"),
            Self::Conditions => msg("conditions"),
        }
    }

    fn takes(self, kind: Kind) -> bool {
        match (self, kind) {
            (Self::All, _) => true,
            (Self::Frames, kind) => !matches!(kind, Kind::Skip(_)),
            (Self::Faults, kind) => !matches!(kind, Kind::Good | Kind::Skip(Skip::Request)),
            (Self::Conditions, kind) => kind == Kind::Good,
        }
    }
}

/// A quantity that rows are sorted or chosen by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Offset in the input.
    Start,
    /// Seconds.
    Time,
    /// Whole turns.
    Turns,
    /// Counts within one turn.
    Angle,
    /// Degrees.
    Degrees,
    /// The status bits as a number.
    Status,
    /// Degrees Celsius.
    Temperature,
    /// Revolutions per second.
    Speed,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Start,
        Self::Time,
        Self::Turns,
        Self::Angle,
        Self::Degrees,
        Self::Status,
        Self::Temperature,
        Self::Speed,
    ];

    /// The name, as in records and links.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Start => msg("start"),
            Self::Time => msg("time"),
            Self::Turns => msg("turns"),
            Self::Angle => msg("angle"),
            Self::Degrees => msg("degrees"),
            Self::Status => msg("status"),
            Self::Temperature => msg("temperature"),
            Self::Speed => msg("speed"),
        }
    }

    /// The quantity of a name.
    #[must_use]
    pub fn parse(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|known| known.name() == name)
    }

    /// What a row has of it; nothing where its checks do not hold.
    #[must_use]
    pub fn of(self, row: &Row<'_>) -> Option<f64> {
        match (self, &row.decoded) {
            (Self::Time, _) => row.time,
            (Self::Start, Decoded::Frame(Frame { start, .. }) | Decoded::Skip { start, .. }) => {
                Some(*start as f64)
            }
            (_, Decoded::Skip { .. }) => None,
            (_, Decoded::Frame(frame)) => frame.ok().then(|| self.of_frame(frame)).flatten(),
        }
    }

    fn of_frame(self, frame: &Frame<'_>) -> Option<f64> {
        let values = frame.values();
        let tenths = |value: Option<i32>| value.map(|value| f64::from(value) / 10.0);
        match self {
            Self::Start | Self::Time => None,
            Self::Turns => values.turns.map(|turns| turns as f64),
            Self::Angle => values.angle.map(|angle| angle as f64),
            Self::Degrees => {
                let bits = frame.layout.shape.profile.angle_bits;
                values.angle.map(|angle| degrees(angle, bits))
            }
            Self::Status => values.status.map(f64::from),
            Self::Temperature => tenths(values.temperature),
            Self::Speed => tenths(values.speed),
        }
    }
}

/// Which rows are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Filter {
    /// Which kinds.
    pub show: Show,
    /// Only rows with any of these status bits set.
    pub status: u8,
    /// Only rows whose quantity lies in this range, ends included.
    pub range: Option<(Quantity, f64, f64)>,
}

/// In which order rows are shown; without one, that of the input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Order {
    /// By what; rows that have none come last.
    pub by: Quantity,
    /// Whether the largest comes first.
    pub descending: bool,
}

/// The rows that are shown.
#[derive(Clone, Debug, Default)]
pub(super) struct View {
    filter: Filter,
    order: Option<Order>,
    /// The chosen rows and what they are sorted by; none where all are shown as they come.
    chosen: Option<Vec<(u32, f64)>>,
    /// Rows that have been looked at.
    seen: usize,
    sorted: bool,
}

impl Filter {
    fn takes(&self, kind: Kind) -> bool {
        self.show.takes(kind)
    }

    /// Whether more than the kind of a row must be known.
    fn reads(&self) -> bool {
        self.status != 0 || self.range.is_some() || self.show == Show::Conditions
    }

    fn accepts(&self, row: &Row<'_>) -> bool {
        let values = match &row.decoded {
            Decoded::Frame(frame) => frame.values(),
            Decoded::Skip { .. } => Default::default(),
        };
        let status = values.status.unwrap_or(0);
        let raised = values.error == Some(true) || values.warning == Some(true) || status != 0;
        let named = self.status == 0 || status & self.status != 0 && row.is_good();
        let within = self.range.is_none_or(|(quantity, low, high)| {
            let value = quantity.of(row);
            value.is_some_and(|value| (low..=high).contains(&value))
        });
        named && within && (self.show != Show::Conditions || raised)
    }
}

impl Sheet {
    /// Chooses and sorts the rows that are shown; [`Self::arrange`] does the work.
    pub fn show(&mut self, filter: Filter, order: Option<Order>) {
        let plain = filter == Filter::default() && order.is_none();
        self.view = View {
            filter,
            order,
            chosen: (!plain).then(Vec::new),
            seen: 0,
            sorted: false,
        };
    }

    /// Looks at `count` rows more; whether there are more to look at. Rows are sorted when all
    /// have been looked at.
    pub fn arrange(&mut self, dump: &Dump, count: usize) -> bool {
        let Some(mut chosen) = self.view.chosen.take() else {
            return false;
        };
        let end = self.view.seen.saturating_add(count).min(self.rows.len());
        for index in self.view.seen..end {
            if let Some(key) = self.key(dump, index) {
                chosen.push((index as u32, key));
                self.view.sorted = false;
            }
        }
        self.view.seen = end;
        let more = end < self.rows.len();
        if let (false, false, Some(order)) = (more, self.view.sorted, self.view.order) {
            chosen.sort_by(|one, other| order.compare(one, other));
            self.view.sorted = true;
        }
        self.view.chosen = Some(chosen);
        more
    }

    /// What a row is sorted by, where it is shown.
    fn key(&self, dump: &Dump, index: usize) -> Option<f64> {
        let Entry { kind, .. } = self.rows.get(index)?;
        let View { filter, order, .. } = &self.view;
        if !filter.takes(kind) {
            return None;
        }
        if !filter.reads() && order.is_none() {
            return Some(0.0);
        }
        let row = self.row(dump, index)?;
        if filter.reads() && !filter.accepts(&row) {
            return None;
        }
        let key = order.map_or(Some(0.0), |order| order.by.of(&row));
        Some(key.unwrap_or(f64::NAN))
    }

    /// Number of rows that are shown.
    #[must_use]
    pub fn shown(&self) -> usize {
        self.view.chosen.as_ref().map_or(self.rows.len(), Vec::len)
    }

    /// The row at a place among those that are shown.
    #[must_use]
    pub fn shown_at(&self, place: usize) -> Option<usize> {
        match &self.view.chosen {
            None => (place < self.rows.len()).then_some(place),
            Some(chosen) => chosen.get(place).map(|(index, _)| *index as usize),
        }
    }

    /// The place of a row among those that are shown, or of the next one that is shown.
    #[must_use]
    pub fn place_of(&self, index: usize) -> Option<usize> {
        match &self.view.chosen {
            None => (index < self.rows.len()).then_some(index),
            Some(chosen) if self.view.order.is_some() => {
                chosen.iter().position(|(row, _)| *row as usize == index)
            }
            Some(chosen) => {
                let place = chosen.partition_point(|(row, _)| (*row as usize) < index);
                (place < chosen.len()).then_some(place)
            }
        }
    }
}

impl Order {
    fn compare(self, one: &(u32, f64), other: &(u32, f64)) -> Ordering {
        let by_key = match (one.1.is_nan(), other.1.is_nan()) {
            (false, false) if self.descending => other.1.total_cmp(&one.1),
            (false, false) => one.1.total_cmp(&other.1),
            (first, second) => first.cmp(&second),
        };
        by_key.then(one.0.cmp(&other.0))
    }
}
