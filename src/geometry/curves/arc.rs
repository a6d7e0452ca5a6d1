//! One circular arc or straight line between two points.

use std::f64::consts::PI;

use crate::geometry::{Point, Vector, cross, quarter_turn};

/// A circular arc, given as DXF gives it: its ends and its bulge, the tangent of a quarter of the angle it
/// turns through, positive when it turns counter-clockwise; zero is a straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Where it starts.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// Tangent of a quarter of its angle.
    pub bulge: f64,
}

impl Arc {
    /// The straight line between two points.
    #[must_use]
    pub fn line(from: Point, to: Point) -> Self {
        Self { from, to, bulge: 0.0 }
    }

    /// Angle it turns through, radians, counter-clockwise positive.
    #[must_use]
    pub fn angle(&self) -> f64 {
        4.0 * self.bulge.atan()
    }

    /// Radius; infinite for a line.
    #[must_use]
    pub fn radius(&self) -> f64 {
        let b = self.bulge.abs();
        (self.to - self.from).norm() * (1.0 + b * b) / (4.0 * b)
    }

    /// Centre of the circle; of no meaning for a line.
    #[must_use]
    pub fn center(&self) -> Point {
        let chord = self.to - self.from;
        let b = self.bulge;
        self.from + 0.5 * chord + quarter_turn(chord) * ((1.0 - b * b) / (4.0 * b))
    }

    /// The point a share `t` (0 to 1) of the way along.
    #[must_use]
    pub fn at(&self, t: f64) -> Point {
        let chord = self.to - self.from;
        let half = 2.0 * self.bulge.atan();
        // The chord of the first part of the arc, as a share of the whole chord, and its direction.
        let share = if half.abs() < 1e-9 { t } else { (t * half).sin() / half.sin() };
        let (sin, cos) = ((t - 1.0) * half).sin_cos();
        self.from + share * (cos * chord + sin * quarter_turn(chord))
    }

    /// Unit direction at its start and end.
    #[must_use]
    pub fn tangents(&self) -> [Vector; 2] {
        let along = (self.to - self.from).normalize();
        let (sin, cos) = (2.0 * self.bulge.atan()).sin_cos();
        [along * cos - quarter_turn(along) * sin, along * cos + quarter_turn(along) * sin]
    }

    /// Distance of a point from the arc.
    #[must_use]
    pub fn distance(&self, p: Point) -> f64 {
        let chord = self.to - self.from;
        let ends = (p - self.from).norm().min((p - self.to).norm());
        if self.bulge == 0.0 {
            let t = (p - self.from).dot(&chord) / chord.norm_squared();
            return if (0.0..=1.0).contains(&t) {
                cross(chord, p - self.from).abs() / chord.norm()
            } else {
                ends
            };
        }
        let (center, radius) = (self.center(), self.radius());
        let [a, d] = [self.from - center, p - center];
        let sense = self.bulge.signum();
        let turned = (sense * cross(a, d)).atan2(a.dot(&d));
        let turned = if turned < 0.0 { turned + 2.0 * PI } else { turned };
        if turned <= self.angle().abs() { (d.norm() - radius).abs() } else { ends }
    }

    /// Area between the chord and the arc, positive where the arc lies to the right of its chord.
    #[must_use]
    pub fn segment_area(&self) -> f64 {
        if self.bulge == 0.0 {
            return 0.0;
        }
        let angle = self.angle();
        // theta - sin theta, without cancellation for flat arcs.
        let excess = if angle.abs() < 1e-2 {
            angle.powi(3) / 6.0 - angle.powi(5) / 120.0
        } else {
            angle - angle.sin()
        };
        0.5 * self.radius().powi(2) * excess
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_circle_is_one() {
        let arc =
            Arc { from: Point::new(2.0, 0.0), to: Point::new(0.0, 2.0), bulge: (PI / 8.0).tan() };
        assert!((arc.radius() - 2.0).abs() < 1e-12 && arc.center().coords.norm() < 1e-12);
        let (sin, cos) = (PI / 8.0).sin_cos();
        assert!((arc.at(0.25) - Point::new(2.0 * cos, 2.0 * sin)).norm() < 1e-12);
        let [start, end] = arc.tangents();
        assert!((start - Vector::y()).norm() < 1e-12 && (end + Vector::x()).norm() < 1e-12);
        assert!((arc.distance(Point::new(1.0, 1.0)) - (2.0 - 2_f64.sqrt())).abs() < 1e-12);
        assert!((arc.distance(Point::new(2.0, -1.0)) - 1.0).abs() < 1e-12);
        // Quarter disc less its triangle.
        assert!((arc.segment_area() - (PI - 2.0)).abs() < 1e-12);
        let back = Arc { from: arc.to, to: arc.from, bulge: -arc.bulge };
        assert!((back.distance(Point::new(1.0, 1.0)) - (2.0 - 2_f64.sqrt())).abs() < 1e-12);
        assert!((back.segment_area() + (PI - 2.0)).abs() < 1e-12);
    }

    #[test]
    fn a_line_is_an_arc_without_bulge() {
        let line = Arc::line(Point::origin(), Point::new(4.0, 0.0));
        assert_eq!(line.at(0.25), Point::new(1.0, 0.0));
        assert_eq!(line.distance(Point::new(1.0, -2.0)), 2.0);
        assert_eq!(line.distance(Point::new(7.0, 4.0)), 5.0);
        assert_eq!(line.segment_area(), 0.0);
    }
}
