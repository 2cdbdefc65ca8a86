//! The sizes of MPP and PT, as their manuals list them (MPP, "Dimensions"; PT, "Size").
//!
//! MPP has models for every 10 mm of inner diameter and PT for every 5 mm, so a size that is not
//! here may still be made: ask. Lengths are in millimetres.

use super::Series;
use crate::language::{msg, t};

/// A size that a manual lists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// The series.
    pub series: Series,
    /// What the order code says of the rotor: its diameter, and B where it is bonded.
    pub rotor: &'static str,
    /// What the order code says of the stator: its diameter, and H where it is mounted from both
    /// sides.
    pub stator: &'static str,
    /// Pitch circle of the stator's screws.
    pub stator_circle: f64,
    /// The rest, which differs between the series.
    pub mount: Mount,
    /// Overall thickness, in the row where the manual prints it; see [`THICKNESS`].
    pub thickness: Option<f64>,
}

/// How a rotor is held, and by what it is plugged in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mount {
    /// MPP: screws on a pitch circle of this diameter.
    Screws(f64),
    /// PT with a rotor that has this thread; one number stands for A, B and C.
    Thread(&'static str, f64),
    /// PT with a bonded rotor: A, B and C (H7).
    Bonded(f64, f64, f64),
}

/// What the manuals leave open about the overall thickness.
pub const THICKNESS: &str = msg(
    "The manuals print an overall thickness in few rows: MPP 5.6 at \
    MPP-40-60 and 6.7 at MPP-60-80, PT 6.7 at PT-20B-30. The empty cells below and above probably \
    belong to the same merged cells, but the manuals do not show where these end: ask before you \
    rely on it.",
);

impl Size {
    /// How an order code begins.
    ///
    /// ```
    /// use encoderscope::product::{Series, sizes::SIZES};
    /// assert_eq!(SIZES[0].name(), "MPP-40-60");
    /// ```
    #[must_use]
    pub fn name(&self) -> alloc::string::String {
        alloc::format!("{}-{}-{}", self.series.name(), self.rotor, self.stator)
    }

    /// Diameter of the rotor, as the order code says it.
    #[must_use]
    pub fn rotor_diameter(&self) -> u32 {
        diameter(self.rotor)
    }

    /// Outer diameter of the stator.
    #[must_use]
    pub fn stator_diameter(&self) -> u32 {
        diameter(self.stator)
    }

    /// The connector on the stator; MPP comes with one of two.
    #[must_use]
    pub fn connector(&self) -> &'static str {
        match (self.series, self.rotor_diameter()) {
            (Series::Pt, ..=15) => "SM06B-XSRS-ETB",
            (Series::Pt, _) => "SM08-SURS-TF",
            _ => t("SM08-SURS-TF or MOLEX 504050-0891"),
        }
    }

    /// Whether the stator can be mounted from the back directly.
    #[must_use]
    pub fn is_back_mounted(&self) -> bool {
        self.stator.ends_with('H')
    }
}

fn diameter(text: &str) -> u32 {
    let digits = text.trim_end_matches(|letter: char| !letter.is_ascii_digit());
    digits.parse().unwrap_or_default()
}

const fn mpp(
    rotor: &'static str,
    stator: &'static str,
    rotor_circle: f64,
    stator_circle: f64,
    thickness: Option<f64>,
) -> Size {
    Size {
        series: Series::Mpp,
        rotor,
        stator,
        stator_circle,
        mount: Mount::Screws(rotor_circle),
        thickness,
    }
}

const fn pt(rotor: &'static str, stator: &'static str, circle: f64, mount: Mount) -> Size {
    Size {
        series: Series::Pt,
        rotor,
        stator,
        stator_circle: circle,
        mount,
        thickness: None,
    }
}

use Mount::{Bonded, Thread};

/// All sizes that the manuals list, MPP first.
pub static SIZES: &[Size] = &[
    mpp("40", "60", 43.1, 56.6, Some(5.6)),
    mpp("50", "70", 53.1, 66.6, None),
    mpp("60", "80", 63.1, 76.6, Some(6.7)),
    mpp("70", "90", 73.1, 86.6, None),
    mpp("80", "100", 83.1, 96.6, None),
    mpp("90", "110", 93.1, 106.6, None),
    mpp("100", "120", 103.1, 116.6, None),
    pt("10", "20", 16.6, Thread("M10 × 0.4 mm", 9.0)),
    pt("10B", "20", 16.6, Bonded(9.0, 10.0, 12.6)),
    pt("10", "20H", 16.6, Thread("M10 × 0.4 mm", 9.0)),
    pt("10B", "20H", 16.6, Bonded(9.0, 10.0, 12.6)),
    pt("13", "25", 21.6, Thread("M13 × 0.4 mm", 12.0)),
    pt("13", "25H", 21.6, Thread("M13 × 0.4 mm", 12.0)),
    pt("14", "25", 21.6, Thread("M14 × 0.4 mm", 13.0)),
    pt("14", "25H", 21.6, Thread("M14 × 0.4 mm", 13.0)),
    pt("15", "25", 21.6, Thread("M15 × 0.4 mm", 14.0)),
    pt("15B", "25", 21.6, Bonded(14.0, 15.0, 17.6)),
    pt("15", "25H", 21.6, Thread("M15 × 0.4 mm", 14.0)),
    pt("15B", "25H", 21.6, Bonded(14.0, 15.0, 17.6)),
    pt("20", "30", 26.6, Thread("M20 × 0.4 mm", 19.0)),
    Size {
        thickness: Some(6.7),
        ..pt("20B", "30", 26.6, Bonded(19.0, 20.0, 22.6))
    },
    pt("20", "30H", 26.6, Thread("M20 × 0.4 mm", 19.0)),
    pt("20B", "30H", 26.6, Bonded(19.0, 20.0, 22.6)),
    pt("25", "35", 31.6, Thread("M25 × 0.4 mm", 24.0)),
    pt("25B", "35", 31.6, Bonded(24.0, 25.0, 27.6)),
    pt("25", "35H", 31.6, Thread("M25 × 0.4 mm", 24.0)),
    pt("25B", "35H", 31.6, Bonded(24.0, 25.0, 27.6)),
    pt("30", "40", 36.6, Thread("M30 × 0.4 mm", 29.0)),
    pt("30B", "40", 36.6, Bonded(29.0, 30.0, 32.6)),
    pt("30", "40H", 36.6, Thread("M30 × 0.4 mm", 29.0)),
    pt("30B", "40H", 36.6, Bonded(29.0, 30.0, 32.6)),
    pt("35", "45", 41.6, Thread("M35 × 0.4 mm", 34.0)),
    pt("35B", "45", 41.6, Bonded(34.0, 35.0, 37.6)),
    pt("35", "45H", 41.6, Thread("M35 × 0.4 mm", 34.0)),
    pt("35B", "45H", 41.6, Bonded(34.0, 35.0, 37.6)),
];
