//! Which way the surface of an outline faces.
//!
//! A gear cut into convex pieces has edges inside its material. A tooth that touches one piece may
//! find the inner side of the next one closer than the surface, and be pushed along the surface
//! instead of off it. [`Surface`] tells such contacts from true ones: at a true contact the normal
//! lies in the normal cone of the outline.

use crate::geometry::{Point, Vector, cross};
use crate::policy;
use std::collections::HashMap;

/// The edges of a counter-clockwise outline, ready to be asked for their normals.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    points: Vec<Point>,
    /// Outward unit normal of the edge that begins at each point.
    normals: Vec<Vector>,
    cells: HashMap<[i64; 2], Vec<u32>>,
    cell: f64,
    reach: f64,
}

impl Surface {
    /// `module` in the units of the outline.
    pub(super) fn new(outline: &[Point], module: f64) -> Self {
        let reach = policy::SURFACE_REACH * module;
        let cell = policy::SURFACE_CELL * module;
        let mut surface = Self {
            points: outline.to_vec(),
            normals: Vec::with_capacity(outline.len()),
            cells: HashMap::new(),
            cell,
            reach,
        };
        for (i, p) in outline.iter().enumerate() {
            let q = outline[(i + 1) % outline.len()];
            let along = q - p;
            surface.normals.push(Vector::new(along.y, -along.x) / along.norm());
            // Walk along the edge in cells, each with what lies within reach of it.
            let pieces = (along.norm() / cell).ceil().max(1.0);
            for k in 0..pieces as usize {
                let (a, b) =
                    (p + along * (k as f64 / pieces), p + along * ((k + 1) as f64 / pieces));
                let low = surface.key(Point::new(a.x.min(b.x) - reach, a.y.min(b.y) - reach));
                let high = surface.key(Point::new(a.x.max(b.x) + reach, a.y.max(b.y) + reach));
                for x in low[0]..=high[0] {
                    for y in low[1]..=high[1] {
                        let edges = surface.cells.entry([x, y]).or_default();
                        if edges.last() != Some(&(i as u32)) {
                            edges.push(i as u32);
                        }
                    }
                }
            }
        }
        surface
    }

    fn key(&self, p: Point) -> [i64; 2] {
        [(p.x / self.cell).floor() as i64, (p.y / self.cell).floor() as i64]
    }

    /// Whether the outline within reach of `at` faces `normal` (a unit vector), up to
    /// [`policy::SURFACE_ANGLE`].
    pub(super) fn faces(&self, at: Point, normal: Vector) -> bool {
        let Some(edges) = self.cells.get(&self.key(at)) else { return false };
        let n = self.points.len();
        let near = |i: usize| {
            let (p, q) = (self.points[i], self.points[(i + 1) % n]);
            let along = q - p;
            let t = ((at - p).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
            (p + along * t - at).norm() <= self.reach
        };
        let least = policy::SURFACE_ANGLE.cos();
        edges.iter().map(|&i| i as usize).filter(|&i| near(i)).any(|i| {
            if self.normals[i].dot(&normal) >= least {
                return true;
            }
            // The corner at the edge's end, if it is within reach.
            let next = (i + 1) % n;
            if (self.points[next] - at).norm() > self.reach {
                return false;
            }
            let (from, to) = (self.normals[i], self.normals[next]);
            let side = cross(from, to).signum();
            side * cross(from, normal) >= 0.0
                && side * cross(normal, to) >= 0.0
                && (from + to).dot(&normal) > 0.0
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_faces_outward_and_corners_face_both_ways() {
        let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
        let square: Vec<Point> = square.iter().map(|&(x, y)| Point::new(x, y)).collect();
        let surface = Surface::new(&square, 1.0);
        let down = Vector::new(0.0, -1.0);
        let right = Vector::new(1.0, 0.0);
        assert!(surface.faces(Point::new(2.0, 0.0), down));
        assert!(!surface.faces(Point::new(2.0, 0.0), right), "along the surface");
        assert!(!surface.faces(Point::new(2.0, 0.0), -down), "into the material");
        assert!(!surface.faces(Point::new(2.0, 1.0), down), "inside");
        let corner = Point::new(4.0, 0.0);
        assert!(surface.faces(corner, (down + right).normalize()));
        assert!(!surface.faces(corner, (-down - right).normalize()));
        assert!(!surface.faces(corner, (down - right).normalize()));
    }
}
