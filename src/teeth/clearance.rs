//! Clearance: every face of a gear moved inward by the same distance.

use std::collections::HashMap;

use super::profile::{EdgeKind, Profile};
use crate::geometry::{self, Point, Vector, quarter_turn};
use crate::policy;

impl Profile {
    /// The profile with every edge moved inward by `distance` mm (an offset, not a scaling). Corners
    /// that point outward stay sharp; those that point inward are rounded. Where the offset folds
    /// over itself the fold is cut away; `None` when nothing is left.
    #[must_use]
    pub fn inset(&self, distance: f64) -> Option<Self> {
        if distance == 0.0 {
            return Some(self.clone());
        }
        let n = self.points.len();
        let inward = |i: usize| -> Vector {
            let edge = self.points[(i + 1) % n] - self.points[i % n];
            quarter_turn(edge.normalize())
        };
        let (mut points, mut kinds) = (Vec::with_capacity(n), Vec::with_capacity(n));
        // First and last new point of each old one.
        let mut spans = Vec::with_capacity(n);
        for i in 0..n {
            let first = points.len();
            let (before, after) = (inward(i + n - 1), inward(i));
            let turn = geometry::cross(before, after).atan2(before.dot(&after));
            let p = self.points[i];
            if turn < -policy::INSET_ROUND_FROM {
                let steps = (-turn / policy::INSET_ROUND_CHORD).ceil() as usize;
                for k in 0..=steps {
                    let angle = turn * k as f64 / steps as f64;
                    points.push(
                        geometry::rotate(Point::from(before), angle).coords * distance + p.coords,
                    );
                    kinds.push(if k < steps { EdgeKind::Root } else { self.kinds[i] });
                }
            } else {
                let reach =
                    (before + after) / (1.0 + before.dot(&after)).max(policy::INSET_SHARPEST);
                points.push(p.coords + distance * reach);
                kinds.push(self.kinds[i]);
            }
            spans.push((first, points.len() - 1));
        }
        let points: Vec<Point> = points.into_iter().map(Point::from).collect();
        // An offset past the middle turns a gear inside out: its edges then run backwards.
        let along = |i: usize| {
            let old = self.points[(i + 1) % n] - self.points[i];
            (points[spans[(i + 1) % n].0] - points[spans[i].1]).dot(&old).signum() * old.norm()
        };
        if (0..n).map(along).sum::<f64>() <= 0.0 {
            return None;
        }
        Self { points, kinds }.untangled()
    }

    /// The largest region with positive winding, when the boundary crosses itself; labels are kept
    /// by place.
    #[must_use]
    pub fn untangled(self) -> Option<Self> {
        if self.points.len() >= 3 && geometry::first_self_crossing(&self.points).is_none() {
            return (geometry::signed_area(&self.points) > 0.0).then_some(self);
        }
        let face = geometry::largest(geometry::positive_part(&self.points))?;
        Some(self.relabelled(face.into_iter().next()?))
    }

    /// `points` as a profile whose edges take the label of this profile's nearest edge.
    #[must_use]
    pub fn relabelled(&self, points: Vec<Point>) -> Self {
        let cell = geometry::perimeter(&self.points) / self.points.len() as f64 * 4.0;
        let key = |p: Point| ((p.x / cell).floor() as i64, (p.y / cell).floor() as i64);
        let n = self.points.len();
        let mut grid: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
        for i in 0..n {
            let middle = nalgebra::center(&self.points[i], &self.points[(i + 1) % n]);
            grid.entry(key(middle)).or_default().push(i);
        }
        let count = points.len();
        let label = |i: usize| {
            let middle = nalgebra::center(&points[i], &points[(i + 1) % count]);
            let (x, y) = key(middle);
            (-1..=1)
                .flat_map(|dx| (-1..=1).map(move |dy| (x + dx, y + dy)))
                .filter_map(|k| grid.get(&k))
                .flatten()
                .min_by(|&&a, &&b| {
                    let far = |j: usize| {
                        nalgebra::distance_squared(
                            &nalgebra::center(&self.points[j], &self.points[(j + 1) % n]),
                            &middle,
                        )
                    };
                    far(a).total_cmp(&far(b))
                })
                .map_or(EdgeKind::Root, |&j| self.kinds[j])
        };
        let kinds = (0..count).map(label).collect();
        Self { points, kinds }
    }
}
