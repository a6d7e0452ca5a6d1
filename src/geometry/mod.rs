//! Plane geometry shared by every room: points, polygons, booleans, splines.

pub mod curves;
mod cyclic;
mod integers;
mod letters;
mod polygon;
mod region;

pub(crate) use cyclic::solve_cyclic;
pub use integers::gcd;
pub use letters::{Lettering, LetteringError, has_letter, lettering};
pub use polygon::{
    area, bounds, centroid, contains, first_self_crossing, intersection_over_union, perimeter,
    signed_area,
};
pub use region::{
    Face, common, difference, grown, largest, offset, positive_part, positive_parts, union, without,
};

/// A point in the plane, in mm unless a function says otherwise.
pub type Point = nalgebra::Point2<f64>;

/// A displacement or direction in the plane.
pub type Vector = nalgebra::Vector2<f64>;

/// Rotates `v` a quarter turn counter-clockwise.
#[must_use]
pub fn quarter_turn(v: Vector) -> Vector {
    Vector::new(-v.y, v.x)
}

/// The cross product `a.x b.y - a.y b.x`.
#[must_use]
pub fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Turns `p` about the origin by `angle` radians, counter-clockwise.
#[must_use]
pub fn rotate(p: Point, angle: f64) -> Point {
    let (s, c) = angle.sin_cos();
    Point::new(c * p.x - s * p.y, s * p.x + c * p.y)
}
