//! How alike a gear and its drawing are to the eye.
//!
//! Area alone hardly minds a lost ear: a cat without ears keeps more than nine tenths of its area. Most of what tells one silhouette
//! from another is where the contour runs, and thin parts have much contour for their area. So likeness is the mean of two shares: of
//! area (intersection over union) and of contour.

use crate::geometry::{self, Point};

/// Distance at which a piece of contour counts for 1/e, over the square root of the drawing's area.
const REACH: f64 = 0.05;
/// Places of a contour that are looked at, evenly along it.
const PLACES: usize = 360;

/// How much of two contours runs where the other one does, 0 to 1: the mean, over the length of both, of `exp(-(d / reach)^2)` with d
/// the distance to the other contour and a reach of 5 % of the square root of the area of `drawing`.
///
/// Both are closed polygons. 0 if either has no length.
#[must_use]
pub fn contour_share(curve: &[Point], drawing: &[Point]) -> f64 {
    let reach = REACH * geometry::area(drawing).abs().sqrt();
    let (curve, drawing) = (evenly(curve, PLACES), evenly(drawing, PLACES));
    let share = |from: &[Point], to: &[Point]| -> f64 {
        let near = |p: &Point| (-squared_distance(*p, to) / (reach * reach)).exp();
        from.iter().map(near).sum::<f64>() / from.len().max(1) as f64
    };
    let mean = 0.5 * (share(&curve, &drawing) + share(&drawing, &curve));
    if mean.is_finite() { mean } else { 0.0 }
}

/// Points at even distances along a closed polygon; none for one without length.
fn evenly(points: &[Point], count: usize) -> Vec<Point> {
    let edges = || points.iter().zip(points.iter().cycle().skip(1));
    let total: f64 = edges().map(|(a, b)| (b - a).norm()).sum();
    let step = total / count as f64;
    let mut places = Vec::with_capacity(count);
    if !(step > 0.0 && step.is_finite()) {
        return places;
    }
    let mut passed = 0.0;
    for (a, b) in edges() {
        let length = (b - a).norm();
        while places.len() < count && places.len() as f64 * step < passed + length {
            places.push(a + (b - a) * ((places.len() as f64 * step - passed) / length));
        }
        passed += length;
    }
    places
}

/// Squared distance from a point to the nearest edge of a closed polygon.
fn squared_distance(p: Point, points: &[Point]) -> f64 {
    let mut least = f64::INFINITY;
    let Some(mut a) = points.last().map(|a| a - p) else {
        return least;
    };
    for b in points {
        let b = b - p;
        let edge = b - a;
        let length = edge.norm_squared();
        let t = if length > 0.0 { (-a.dot(&edge) / length).clamp(0.0, 1.0) } else { 0.0 };
        least = least.min((a + edge * t).norm_squared());
        a = b;
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn disc(r: f64) -> Vec<Point> {
        (0..720).map(|i| geometry::rotate(Point::new(r, 0.0), TAU * f64::from(i) / 720.0)).collect()
    }

    #[test]
    fn a_contour_is_where_it_is_and_loses_by_its_distance() {
        assert!((contour_share(&disc(1.0), &disc(1.0)) - 1.0).abs() < 1e-9);
        // Concentric circles are one distance apart all round.
        let reach = REACH * (0.5 * TAU).sqrt();
        for d in [0.03, 0.1, 0.2] {
            let expected = (-(d / reach) * (d / reach)).exp();
            let share = contour_share(&disc(1.0 + d), &disc(1.0));
            assert!((share - expected).abs() < 1e-3, "{d} {share} {expected}");
        }
        assert_eq!(contour_share(&[], &disc(1.0)), 0.0);
    }

    #[test]
    fn a_lost_ear_costs_more_contour_than_area() {
        let head = disc(1.0);
        let eared: Vec<Point> = (0..720)
            .map(|i| {
                let a = TAU * f64::from(i) / 720.0;
                let ear = |at: f64| (1.0 - ((a - at) / 0.25).abs()).max(0.0);
                geometry::rotate(Point::new(1.0 + 0.7 * (ear(1.0) + ear(2.1)), 0.0), a)
            })
            .collect();
        let area = geometry::intersection_over_union(&head, &eared);
        let contour = contour_share(&head, &eared);
        assert!(area > 0.85 && contour < area - 0.05, "{area} {contour}");
    }
}
