//! A closed path of arcs and lines.

use super::samples::Samples;
use super::{Arc, TraceError};
use crate::geometry::{self, Point};

/// Chords on each arc when a path is tested for crossings.
const CHORDS: usize = 4;

/// A closed path of arcs and lines, each starting exactly where the one before ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArcPath {
    arcs: Vec<Arc>,
    /// Greatest distance of a vertex of the outline from the path.
    vertices_off: f64,
    /// Greatest distance of the middle of a chord of the outline from the path.
    chords_off: f64,
}

impl ArcPath {
    /// The closed polygon through `points` as straight lines.
    #[must_use]
    pub fn polygon(points: &[Point]) -> Self {
        let next = points.iter().cycle().skip(1);
        Self {
            arcs: points.iter().zip(next).map(|(&a, &b)| Arc::line(a, b)).collect(),
            ..Self::default()
        }
    }

    /// The path with every point moved by a rotation or shift; anything else would bend arcs.
    #[must_use]
    pub fn mapped(&self, place: impl Fn(Point) -> Point) -> Self {
        let moved = |a: &Arc| Arc { from: place(a.from), to: place(a.to), bulge: a.bulge };
        Self { arcs: self.arcs.iter().map(moved).collect(), ..*self }
    }

    /// The arcs in order.
    #[must_use]
    pub fn arcs(&self) -> &[Arc] {
        &self.arcs
    }

    /// Greatest distances of the outline's vertices, and of the middles of its chords, from the path.
    #[must_use]
    pub fn deviation(&self) -> [f64; 2] {
        [self.vertices_off, self.chords_off]
    }

    /// Signed area inside, exact.
    #[must_use]
    pub fn signed_area(&self) -> f64 {
        let chord = |a: &Arc| 0.5 * geometry::cross(a.from.coords, a.to.coords);
        self.arcs.iter().map(|a| chord(a) + a.segment_area()).sum()
    }

    /// Points along the path, `per_arc` on each arc and one on each line.
    #[must_use]
    pub fn flattened(&self, per_arc: usize) -> Vec<Point> {
        let mut points = Vec::with_capacity(per_arc * self.arcs.len());
        for arc in &self.arcs {
            let count = if arc.bulge == 0.0 { 1 } else { per_arc };
            points.extend((0..count).map(|i| arc.at(i as f64 / count as f64)));
        }
        points
    }

    /// Adds the arcs along one stretch, after measuring them against it.
    pub(super) fn append(
        &mut self,
        arcs: &[Arc],
        samples: &Samples,
        tolerance: f64,
    ) -> Result<(), TraceError> {
        let off = |p: Point| arcs.iter().map(|a| a.distance(p)).fold(f64::INFINITY, f64::min);
        for (k, &p) in samples.points.iter().enumerate() {
            let found = off(p);
            // Rounding of the arcs' own formulas is far below a tolerance that may be asked for.
            if found > 1.000_001 * tolerance {
                return Err(TraceError::TooFar { found, tolerance, at: p });
            }
            self.vertices_off = self.vertices_off.max(found);
            if k + 1 < samples.points.len() {
                let middle = samples.middle(k);
                let found = off(middle);
                if found > 1.000_001 * samples.allowance(k, 2.0 * tolerance) {
                    return Err(TraceError::TooFar { found, tolerance, at: middle });
                }
                self.chords_off = self.chords_off.max(found);
            }
        }
        self.arcs.extend(arcs.iter().filter(|a| a.from != a.to));
        Ok(())
    }

    pub(super) fn check_simple(&self) -> Result<(), TraceError> {
        match geometry::first_self_crossing(&self.flattened(CHORDS)) {
            Some(at) => Err(TraceError::Crossing { at }),
            None => Ok(()),
        }
    }
}
