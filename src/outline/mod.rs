//! Closed curves: repair, smoothing, normalisation, and the built-in library.

pub mod library;
mod normalize;
pub(crate) mod repair;
mod simplify;
mod smooth;

pub use normalize::{Similarity, normalized};
pub use repair::repaired;
pub use simplify::simplify;
pub use smooth::{Smoothing, resample, smooth};

use crate::geometry::{self, Point};
use crate::policy;

/// A closed, simple, counter-clockwise polygon.
///
/// In any unit; y upwards. The last point is not a repetition of the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    points: Vec<Point>,
}

/// Why points do not make an outline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum OutlineError {
    /// Fewer than three different points.
    #[error("the outline has {count} distinct points; draw at least three")]
    TooFewPoints {
        /// Distinct points that were found.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("point {index} of the outline is not a finite number; remove it or correct it")]
    NotFinite {
        /// Index of the point, from zero.
        index: usize,
    },
    /// A coordinate is too large to compute with.
    #[error("a coordinate of the outline reaches {largest:e}, beyond {limit:e}; scale it down")]
    OutOfRange {
        /// The largest magnitude found.
        largest: f64,
        /// The largest that is accepted, [`crate::policy::OUTLINE_RANGE`].
        limit: f64,
    },
    /// Two edges meet away from their ends.
    #[error("the outline crosses itself at ({x:.4}, {y:.4}); redraw it there")]
    SelfCrossing {
        /// Where, in the units of the input.
        x: f64,
        /// Where, in the units of the input.
        y: f64,
    },
    /// The enclosed area vanishes beside the size of the outline.
    #[error("the outline encloses no area; draw a shape that is wider than a line")]
    NoArea,
    /// More vertices than are read.
    #[error("the outline has {count} points, more than {limit}; thin it out before loading")]
    TooManyPoints {
        /// Points that were found.
        count: usize,
        /// Most that are read.
        limit: usize,
    },
    /// More crossings or detail than can be resolved in reasonable time.
    #[error("the outline is too intricate to be a gear; trace it more coarsely")]
    TooIntricate,
}

/// Refuses coordinates that are not finite or too large.
pub(crate) fn check_coordinates(points: &[Point]) -> Result<(), OutlineError> {
    if let Some(index) = points.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
        return Err(OutlineError::NotFinite { index });
    }
    let largest = points.iter().map(|p| p.x.abs().max(p.y.abs())).fold(0.0, f64::max);
    let limit = policy::OUTLINE_RANGE.1;
    if largest > limit { Err(OutlineError::OutOfRange { largest, limit }) } else { Ok(()) }
}

impl Outline {
    /// Checks `points`, drops repeated ones and turns the boundary counter-clockwise.
    ///
    /// # Errors
    /// See [`OutlineError`].
    pub fn new(points: Vec<Point>) -> Result<Self, OutlineError> {
        check_coordinates(&points)?;
        let mut points = points;
        points.dedup();
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        if points.len() < 3 {
            return Err(OutlineError::TooFewPoints { count: points.len() });
        }
        let signed = geometry::signed_area(&points);
        let size = geometry::perimeter(&points);
        if size < policy::OUTLINE_RANGE.0 || signed.abs() < 1e-9 * size * size {
            return Err(OutlineError::NoArea);
        }
        // First, so that what is accepted is accepted again: where a corner touches a side by rounding, the answer
        // depends on the order of the points.
        if signed < 0.0 {
            points.reverse();
        }
        if let Some(p) = geometry::first_self_crossing(&points) {
            return Err(OutlineError::SelfCrossing { x: p.x, y: p.y });
        }
        Ok(Self { points })
    }

    /// The points, counter-clockwise.
    #[must_use]
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Applies a map that keeps orientation and simplicity (a similarity).
    #[must_use]
    pub fn map(&self, f: impl FnMut(&Point) -> Point) -> Self {
        Self { points: self.points.iter().map(f).collect() }
    }

    /// Enclosed area, in the square of the outline's unit; positive.
    #[must_use]
    pub fn area(&self) -> f64 {
        geometry::area(&self.points)
    }

    /// Length of the boundary.
    #[must_use]
    pub fn perimeter(&self) -> f64 {
        geometry::perimeter(&self.points)
    }

    /// Centre of area.
    #[must_use]
    pub fn centroid(&self) -> Point {
        geometry::centroid(&self.points)
    }

    /// Lower left and upper right corner of the bounding box.
    #[must_use]
    pub fn bounds(&self) -> (Point, Point) {
        geometry::bounds(&self.points)
    }

    /// Whether `p` lies inside; on the boundary the answer may go either way.
    #[must_use]
    pub fn contains(&self, p: Point) -> bool {
        geometry::contains(&self.points, p)
    }
}
