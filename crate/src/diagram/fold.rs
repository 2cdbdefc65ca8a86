//! A scale on which long rests are folded, so that bits stay wide enough to be read.

use super::Timeline;
use alloc::vec::Vec;

/// Between two lines of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// From when, in picoseconds.
    pub from: i64,
    /// To when.
    pub to: i64,
    /// Where it begins on the scale.
    pub x: f64,
    /// How wide it is on the scale.
    pub width: f64,
    /// Whether it lasts longer than its width says.
    pub is_folded: bool,
}

/// From times to places: a bit lasts as long as it is wide, and what rests for longer than a few
/// bits is folded.
///
/// ```
/// use encoderscope::{decode::Decoder, diagram::{Fold, Master, Timeline}, profile::Profile};
/// let decoder = Decoder::new(Profile::parse([("format", "asi4")])?)?;
/// let frame = decoder.frame(b"0\r\n").unwrap();
/// let timeline = Timeline::new(&frame.layout, frame.bits, &Master::default());
/// let fold = Fold::new(&timeline, 10.0);
/// // Thirty bits of three characters, two bits of rest on either side, and a pause of almost two
/// // milliseconds that takes the room of four.
/// assert_eq!(fold.width().round(), 380.0);
/// assert_eq!(fold.x(timeline.slot_of(7).unwrap().from).round(), 30.0);
/// # Ok::<(), encoderscope::profile::ProfileError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Fold {
    cells: Vec<Cell>,
}

/// Bits that a folded rest is wide.
const WIDEST: f64 = 4.0;

impl Fold {
    /// A scale on which a bit is `width` wide.
    #[must_use]
    pub fn new(timeline: &Timeline, width: f64) -> Self {
        let bit = usual(timeline) as f64;
        let mut x = 0.0;
        let pairs = timeline.ticks.iter().zip(timeline.ticks.iter().skip(1));
        let cells = pairs
            .map(|(from, to)| {
                let bits = to.saturating_sub(*from) as f64 / bit;
                let is_folded = bits > WIDEST;
                let cell = Cell {
                    from: *from,
                    to: *to,
                    x,
                    width: width * bits.min(WIDEST),
                    is_folded,
                };
                x += cell.width;
                cell
            })
            .collect();
        Self { cells }
    }

    /// The cells of the grid, in the order of time.
    #[must_use]
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The place of a time, in picoseconds; what lies outside is at the nearer end.
    #[must_use]
    pub fn x(&self, time: i64) -> f64 {
        let after = self.cells.partition_point(|cell| cell.from <= time);
        let Some(cell) = after.checked_sub(1).and_then(|index| self.cells.get(index)) else {
            return 0.0;
        };
        let part = time.min(cell.to).saturating_sub(cell.from) as f64
            / cell.to.saturating_sub(cell.from).max(1) as f64;
        cell.x + cell.width * part
    }

    /// How wide the whole is.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.cells.last().map_or(0.0, |cell| cell.x + cell.width)
    }
}

/// How long most bits last, in picoseconds.
fn usual(timeline: &Timeline) -> i64 {
    let read = timeline.slots.iter().filter(|slot| slot.sampled.is_some());
    let mut lasts: Vec<i64> = read.map(|slot| slot.to.saturating_sub(slot.from)).collect();
    lasts.sort_unstable();
    let middle = lasts.get(lasts.len() / 2).copied();
    middle.unwrap_or(timeline.end).max(1)
}
