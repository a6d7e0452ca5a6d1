//! Plane maps of DXF: coordinate systems of entities and blocks.

use crate::geometry::{Point, Vector};
use nalgebra::Matrix2;

/// An affine map of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Map {
    linear: Matrix2<f64>,
    shift: Vector,
}

impl Map {
    pub(super) const IDENTITY: Self =
        Self { linear: Matrix2::new(1.0, 0.0, 0.0, 1.0), shift: Vector::new(0.0, 0.0) };

    /// From an entity's own system to the world's, seen from above, by AutoCAD's arbitrary axis; `None` where the entity
    /// does not lie parallel to the xy plane.
    pub(super) fn of_extrusion(normal: [f64; 3]) -> Option<Self> {
        let [x, y, z] = normal;
        let length = (x * x + y * y + z * z).sqrt();
        if length == 0.0 {
            return Some(Self::IDENTITY);
        }
        match z / length {
            up if up > FLAT => Some(Self::IDENTITY),
            // Seen from behind: x runs to the left.
            down if down < -FLAT => {
                Some(Self { linear: Matrix2::new(-1.0, 0.0, 0.0, 1.0), shift: Vector::zeros() })
            }
            _ => None,
        }
    }

    /// The map of a block: about `base`, scaled, turned (radians) and put at `at`.
    pub(super) fn of_insert(base: Point, scale: [f64; 2], turn: f64, at: Point) -> Self {
        let (sine, cosine) = turn.sin_cos();
        let linear =
            Matrix2::new(cosine, -sine, sine, cosine) * Matrix2::new(scale[0], 0.0, 0.0, scale[1]);
        Self { linear, shift: at.coords - linear * base.coords }
    }

    pub(super) fn point(&self, p: Point) -> Point {
        Point::from(self.linear * p.coords + self.shift)
    }

    pub(super) fn vector(&self, v: Vector) -> Vector {
        self.linear * v
    }

    /// First `inner`, then this one.
    pub(super) fn after(&self, inner: &Self) -> Self {
        Self { linear: self.linear * inner.linear, shift: self.linear * inner.shift + self.shift }
    }

    /// The same, moved afterwards.
    pub(super) fn moved(&self, by: Vector) -> Self {
        Self { linear: self.linear, shift: self.shift + by }
    }
}

/// Cosine from which on a normal points straight up or down.
const FLAT: f64 = 0.9999;
