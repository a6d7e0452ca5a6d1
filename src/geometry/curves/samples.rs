//! Vertices of a smooth stretch of an outline, with what the fits ask of them.

use crate::geometry::{Point, cross};

/// Consecutive vertices of a curve without corners.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    pub(super) points: Vec<Point>,
    /// Length of the chords up to each vertex.
    pub(super) walked: Vec<f64>,
    /// Turn at each vertex, radians; at the ends of an open stretch that of the neighbour.
    pub(super) turns: Vec<f64>,
    /// The last vertex is the first again and the curve passes it smoothly.
    pub(super) ring: bool,
}

impl Samples {
    pub(super) fn new(points: Vec<Point>, ring: bool) -> Self {
        let n = points.len();
        let mut walked = vec![0.0; n];
        for i in 1..n {
            walked[i] = walked[i - 1] + (points[i] - points[i - 1]).norm();
        }
        let mut turns = vec![0.0; n];
        for i in 1..n.saturating_sub(1) {
            turns[i] = turn(points[i - 1], points[i], points[i + 1]);
        }
        if ring && n > 2 {
            turns[0] = turn(points[n - 2], points[0], points[1]);
            turns[n - 1] = turns[0];
        } else if n > 2 {
            turns[0] = turns[1];
            turns[n - 1] = turns[n - 2];
        }
        Self { points, walked, turns, ring }
    }

    /// Middle of the chord from vertex `k` to the next.
    pub(super) fn middle(&self, k: usize) -> Point {
        nalgebra::center(&self.points[k], &self.points[k + 1])
    }

    /// Places on the chord from vertex `k` to the next at which a curve beside it is judged, each with the
    /// length walked to it: a curve may cross a chord in its middle and stand off on both sides.
    pub(super) fn places(&self, k: usize) -> [(f64, Point); 3] {
        let (a, b) = (self.points[k], self.points[k + 1]);
        [0.25, 0.5, 0.75].map(|t| (self.walked[k] + t * self.edge(k), a + t * (b - a)))
    }

    fn edge(&self, k: usize) -> f64 {
        self.walked[k + 1] - self.walked[k]
    }

    /// How far a curve that passes the vertices within `tolerance` may stand off the chord from
    /// vertex `k` to the next: twice the bow, for curvature is not as even as its estimate.
    pub(super) fn allowance(&self, k: usize, tolerance: f64) -> f64 {
        tolerance + 2.0 * self.bow(k)
    }

    /// The samples up to and from vertex `k`, which becomes a corner.
    pub(super) fn parted(&self, k: usize) -> Vec<Self> {
        if self.ring {
            let n = self.points.len() - 1;
            let turned = (0..=n).map(|i| self.points[(k + i) % n]).collect();
            return vec![Self::new(turned, false)];
        }
        [&self.points[..=k], &self.points[k..]].map(|part| Self::new(part.to_vec(), false)).into()
    }

    /// About how far the curve stands off the chord from vertex `k` to the next, judged by how the chords
    /// turn: the curvature there, times the square of the chord over eight.
    pub(super) fn bow(&self, k: usize) -> f64 {
        let n = self.points.len();
        let length = self.edge(k);
        let before = if k > 0 { self.edge(k - 1) } else { length };
        let after = if k + 2 < n { self.edge(k + 1) } else { length };
        let bend = |turn: f64, other: f64| 2.0 * turn.abs() / (length + other);
        let curvature = bend(self.turns[k], before).max(bend(self.turns[k + 1], after));
        curvature * length * length / 8.0
    }
}

/// Turn of the path a, b, c at b, radians, counter-clockwise positive.
pub(super) fn turn(a: Point, b: Point, c: Point) -> f64 {
    cross(b - a, c - b).atan2((b - a).dot(&(c - b)))
}
