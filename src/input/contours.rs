//! What a reader makes of a file: contours, each with where it comes from.

use super::note::Note;
use super::record::PairRecord;
use crate::geometry::{self, Point};

/// A stretch of a drawing, y upwards, in the unit of its file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Contour {
    /// Without a repeated last point where it is closed.
    pub(super) points: Vec<Point>,
    pub(super) closed: bool,
    /// Layer, group or object; empty where the format has none.
    pub(super) layer: String,
    /// Where a filled path that is open was closed by a straight line.
    pub(super) bridged: Option<(Point, Point)>,
    /// Drawn with a dashed or dotted line, as centre lines and reference circles are.
    pub(super) dashed: bool,
}

impl Contour {
    /// A list of points that closes by itself, unless its closing chord is far longer than any other.
    pub(super) fn listed(mut points: Vec<Point>) -> Self {
        points.dedup();
        let gap = match (points.first(), points.last()) {
            (Some(first), Some(last)) => (last - first).norm(),
            _ => 0.0,
        };
        let longest = points.windows(2).map(|w| (w[1] - w[0]).norm()).fold(0.0, f64::max);
        Self { points, closed: gap <= OPEN_LIST_GAP * longest, ..Self::default() }
    }

    /// Diagonal of its bounding box.
    pub(super) fn extent(&self) -> f64 {
        if self.points.is_empty() {
            return 0.0;
        }
        let (low, high) = geometry::bounds(&self.points);
        (high - low).norm()
    }

    /// Whether every point of `other` lies inside.
    pub(super) fn encloses(&self, other: &Self) -> bool {
        let (low, high) = geometry::bounds(&self.points);
        other.points.iter().all(|p| *p >= low && *p <= high)
            && other.points.iter().all(|p| geometry::contains(&self.points, *p))
    }
}

/// A list of points is open when its ends are apart by this many of its longest edges.
const OPEN_LIST_GAP: f64 = 3.0;

/// The contours of a file, before any of them is chosen.
#[derive(Clone, Debug, Default)]
pub(super) struct Contours {
    pub(super) list: Vec<Contour>,
    pub(super) unit: Unit,
    /// What a reader should know.
    pub(super) notes: Vec<Note>,
    /// What a `design.json` tells of the pair.
    pub(super) record: Option<PairRecord>,
    /// Whether the file says itself which contour is the gear: the first.
    pub(super) told: bool,
    /// Whether what was named behind `#` has been picked already.
    pub(super) part_used: bool,
}

/// The unit in which a file is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unit {
    pub(super) name: &'static str,
    /// Millimetres in one.
    pub(super) mm: f64,
}

impl Default for Unit {
    fn default() -> Self {
        Self { name: "mm", mm: 1.0 }
    }
}
