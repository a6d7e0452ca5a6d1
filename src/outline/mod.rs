//! Closed curves and where they come from: SVG drawings, silhouette images,
//! point files and the built-in library; smoothing and normalisation.

use crate::geometry::{self, Point};

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
}

impl Outline {
    /// Checks `points`, drops repeated ones and turns the boundary counter-clockwise.
    ///
    /// # Errors
    /// See [`OutlineError`].
    pub fn new(points: Vec<Point>) -> Result<Self, OutlineError> {
        if let Some(index) = points.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
            return Err(OutlineError::NotFinite { index });
        }
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
        if signed.abs() < 1e-9 * size * size {
            return Err(OutlineError::NoArea);
        }
        if let Some(p) = geometry::first_self_crossing(&points) {
            return Err(OutlineError::SelfCrossing { x: p.x, y: p.y });
        }
        if signed < 0.0 {
            points.reverse();
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
}
