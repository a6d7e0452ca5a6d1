//! What a closed contour looks like: a gear, a circle, a frame, or something else.

use super::contours::Contour;
use crate::geometry::{self, Point, cross};
use crate::outline::simplify;
use std::f64::consts::{PI, TAU};

/// What a contour looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Nature {
    /// Teeth all the way round.
    Toothed(usize),
    /// A circle.
    Round,
    /// A rectangle, its corners sharp.
    Box,
    Other,
}

/// Points at even distances that a boundary is looked at in.
const SAMPLES: usize = 4096;
/// The boundary's direction swings by this much and back at every tooth, radians: flat waves swing by 50 degrees,
/// hand-drawn bumps by less.
const SWING: f64 = 0.7;
/// Fewest teeth that are told from a drawing's own corners.
const LEAST_TEETH: usize = 5;
/// Widest sector, seen from the centre, without a tooth: a rack shows its teeth in half a turn or less.
const TOOTHLESS: f64 = 0.85 * PI;
/// Stray of the radius of a circle, as a share.
const ROUND: f64 = 4e-3;

impl Nature {
    pub(super) fn of(contour: &Contour) -> Self {
        let points = &contour.points;
        if points.len() < 3 {
            return Self::Other;
        }
        if is_round(points) {
            return Self::Round;
        }
        if is_box(points) {
            return Self::Box;
        }
        teeth(points, contour.closed).map_or(Self::Other, Self::Toothed)
    }

    pub(super) fn is_toothed(self) -> bool {
        matches!(self, Self::Toothed(_))
    }
}

fn is_round(points: &[Point]) -> bool {
    let (low, high) = geometry::bounds(points);
    let center = nalgebra::center(&low, &high);
    let radius = 0.25 * (high.x - low.x + high.y - low.y);
    let widest = points
        .iter()
        .zip(points.iter().cycle().skip(1))
        .map(|(a, b)| (b - a).norm())
        .fold(0.0, f64::max);
    points.len() > 6
        && widest <= 1.1 * radius
        && points.iter().all(|p| ((p - center).norm() - radius).abs() <= ROUND * radius)
}

fn is_box(points: &[Point]) -> bool {
    let (low, high) = geometry::bounds(points);
    let corners = simplify(points, 1e-3 * (high - low).norm());
    // The first point may lie within a side.
    let square = |i: usize| {
        let n = corners.len();
        let (a, b) = (corners[(i + n - 1) % n] - corners[i], corners[(i + 1) % n] - corners[i]);
        let cosine = a.dot(&b) / (a.norm() * b.norm());
        (cosine.abs() < 0.03, cosine < -0.999)
    };
    let found: Vec<(bool, bool)> = (0..corners.len()).map(square).collect();
    found.iter().filter(|(right, _)| *right).count() == 4
        && found.iter().all(|(right, flat)| *right || *flat)
}

/// How often the direction of the boundary swings to and fro, if it does so all the way round the centre.
fn teeth(points: &[Point], closed: bool) -> Option<usize> {
    let total = geometry::perimeter(points);
    if !(total.is_finite() && total > 0.0) {
        return None;
    }
    let points = evenly(points, total);
    let n = points.len();
    let sense = geometry::signed_area(&points).signum();
    let step = |i: usize| points[(i + 1) % n] - points[i % n];
    // Direction less its even turn, from extreme to extreme.
    let mut direction = 0.0;
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    let mut rising = false;
    let mut places = Vec::new();
    for i in 0..2 * n {
        let (a, b) = (step(i), step(i + 1));
        direction += sense * cross(a, b).atan2(a.dot(&b)) - TAU / n as f64;
        (low, high) = (low.min(direction), high.max(direction));
        if rising && direction < high - SWING {
            (rising, low) = (false, direction);
        } else if !rising && direction > low + SWING {
            (rising, high) = (true, direction);
            // The first round only finds where to begin.
            if i >= n {
                places.push(points[i % n]);
            }
        }
    }
    let center = if closed {
        geometry::centroid(&points)
    } else {
        let (low, high) = geometry::bounds(&points);
        nalgebra::center(&low, &high)
    };
    let mut angles: Vec<f64> =
        places.iter().map(|p| (p.y - center.y).atan2(p.x - center.x)).collect();
    angles.sort_by(f64::total_cmp);
    let wrapped = angles.first().map(|a| a + TAU);
    let next = angles.iter().copied().skip(1).chain(wrapped);
    let widest = angles.iter().zip(next).map(|(a, b)| b - a).fold(0.0, f64::max);
    (places.len() >= LEAST_TEETH && widest <= TOOTHLESS).then_some(places.len())
}

fn evenly(points: &[Point], total: f64) -> Vec<Point> {
    let step = total / SAMPLES as f64;
    let mut made = Vec::with_capacity(SAMPLES);
    let mut walked = 0.0;
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        let length = (b - a).norm();
        while made.len() < SAMPLES {
            let along = made.len() as f64 * step - walked;
            if along > length {
                break;
            }
            made.push(if length > 0.0 { a + (b - a) * (along / length).max(0.0) } else { *a });
        }
        walked += length;
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polar(n: usize, radius: impl Fn(f64) -> f64) -> Contour {
        let at = |i: usize| {
            let angle = TAU * i as f64 / n as f64;
            Point::new(radius(angle) * angle.cos(), radius(angle) * angle.sin())
        };
        Contour { points: (0..n).map(at).collect(), closed: true, ..Contour::default() }
    }

    #[test]
    fn gears_circles_frames_and_racks_are_told_apart() {
        let natures = |c: &Contour| Nature::of(c);
        assert_eq!(natures(&polar(2000, |a| 30.0 + 1.6 * (20.0 * a).cos())), Nature::Toothed(20));
        let square_teeth = |a: f64| if (24.0 * a).sin() > 0.0 { 26.0 } else { 22.0 };
        assert_eq!(natures(&polar(5000, square_teeth)), Nature::Toothed(24));
        let lobed = |a: f64| (20.0 + 5.0 * (2.0 * a).cos()) + (32.0 * a).cos();
        assert_eq!(natures(&polar(5000, lobed)), Nature::Toothed(32));
        assert_eq!(natures(&polar(12, |_| 3.0)), Nature::Round);
        assert_eq!(natures(&polar(500, |a| 3.0 + (3.0 * a).cos())), Nature::Other);
        let of = |list: &[(f64, f64)]| Contour {
            points: list.iter().map(|&(x, y)| Point::new(x, y)).collect(),
            closed: true,
            ..Contour::default()
        };
        assert_eq!(
            natures(&of(&[(1.0, 0.0), (4.0, 0.0), (4.0, 2.0), (0.0, 2.0), (0.0, 0.0)])),
            Nature::Box
        );
        assert_eq!(natures(&of(&[(0.0, 0.0), (4.0, 0.0), (5.0, 2.0), (0.0, 2.0)])), Nature::Other);
        let mut rack = vec![(0.0, -3.0), (100.0, -3.0)];
        for i in (0..20).rev() {
            let x = 5.0 * f64::from(i);
            rack.extend([(x + 5.0, 0.0), (x + 3.5, 4.0), (x + 2.0, 4.0), (x + 0.5, 0.0)]);
        }
        assert_eq!(natures(&of(&rack)), Nature::Other);
    }
}
