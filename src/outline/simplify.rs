//! Fewer vertices within a tolerance, and a bound on how many there may be.

use super::OutlineError;
use crate::geometry::{self, Point, cross};
use crate::policy;

/// Drops vertices of a closed polygon so that no dropped one is farther than `tolerance`
/// (same unit as the points) from the chord that replaces it.
///
/// One pass, O(n): from each kept vertex a wedge of directions that pass every later vertex
/// within the tolerance is narrowed until a vertex leaves it. Spikes survive, because turning
/// back by more than the tolerance ends a chord too. The result may touch itself where two
/// sides were nearer than the tolerance.
#[must_use]
pub fn simplify(points: &[Point], tolerance: f64) -> Vec<Point> {
    let Some(&first) = points.first() else {
        return Vec::new();
    };
    let mut kept = vec![first];
    let mut anchor = first;
    let mut previous = first;
    let mut farthest: f64 = 0.0;
    let mut wedge = None;
    for &p in points.iter().skip(1).chain(std::iter::once(&first)) {
        let reach = p - anchor;
        let distance = reach.norm();
        let inside = wedge
            .is_none_or(|(right, left)| cross(right, reach) >= 0.0 && cross(left, reach) <= 0.0);
        if previous != anchor && !(inside && distance >= farthest - tolerance) {
            kept.push(previous);
            anchor = previous;
            farthest = 0.0;
            wedge = None;
        }
        let reach = p - anchor;
        let distance = reach.norm();
        farthest = farthest.max(distance);
        if distance > tolerance {
            let half = (tolerance / distance).asin();
            let turned = |angle: f64| geometry::rotate(Point::from(reach), angle).coords;
            let (mut right, mut left) = (turned(-half), turned(half));
            if let Some((r, l)) = wedge {
                right = if cross(r, right) > 0.0 { right } else { r };
                left = if cross(l, left) < 0.0 { left } else { l };
            }
            wedge = Some((right, left));
        }
        previous = p;
    }
    kept
}

/// Refuses more than [`policy::OUTLINE_VERTICES`] points and thins out more than
/// [`policy::OUTLINE_VERTICES_KEPT`] at the finest tolerance that suffices.
pub(super) fn bounded(points: Vec<Point>) -> Result<Vec<Point>, OutlineError> {
    let count = points.len();
    if count > policy::OUTLINE_VERTICES {
        return Err(OutlineError::TooManyPoints { count, limit: policy::OUTLINE_VERTICES });
    }
    if count <= policy::OUTLINE_VERTICES_KEPT {
        return Ok(points);
    }
    let (low, high) = geometry::bounds(&points);
    let side = (high - low).min();
    let (mut tolerance, last) = policy::SIMPLIFY_TOLERANCE;
    while tolerance <= last {
        let fewer = simplify(&points, tolerance * side);
        if fewer.len() <= policy::OUTLINE_VERTICES_KEPT {
            return Ok(fewer);
        }
        tolerance *= 2.0;
    }
    Err(OutlineError::TooIntricate)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn distance_to_polygon(p: Point, polygon: &[Point]) -> f64 {
        let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
        edges
            .map(|(a, b)| {
                let along = b - a;
                let t = (along.dot(&(p - a)) / along.norm_squared()).clamp(0.0, 1.0);
                (a + along * t - p).norm()
            })
            .fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_circle_keeps_its_tolerance_with_few_vertices() {
        let n = 5000;
        let circle: Vec<Point> = (0..n)
            .map(|i| {
                let (s, c) = (TAU * f64::from(i) / f64::from(n)).sin_cos();
                Point::new(c, s)
            })
            .collect();
        let fewer = simplify(&circle, 1e-3);
        // A chord of a unit circle with sagitta 1e-3 spans 0.0894 rad: 70 of them at best.
        assert!(fewer.len() < 150, "{}", fewer.len());
        let worst = circle.iter().map(|&p| distance_to_polygon(p, &fewer)).fold(0.0, f64::max);
        assert!(worst <= 1e-3, "{worst}");
    }

    #[test]
    fn straight_runs_go_and_spikes_stay() {
        let mut points: Vec<Point> = (0..100).map(|i| Point::new(f64::from(i), 0.0)).collect();
        points.extend([Point::new(99.0, 50.0), Point::new(50.0, 50.0), Point::new(50.0, 90.0)]);
        points.extend([Point::new(49.9, 50.0), Point::new(0.0, 50.0)]);
        let fewer = simplify(&points, 0.01);
        assert_eq!(fewer.len(), 7, "{fewer:?}");
        assert!(fewer.contains(&Point::new(50.0, 90.0)));
    }

    #[test]
    fn too_many_vertices_are_refused_and_many_are_thinned() {
        let circle = |n: usize| -> Vec<Point> {
            (0..n)
                .map(|i| geometry::rotate(Point::new(1.0, 0.0), TAU * i as f64 / n as f64))
                .collect()
        };
        assert!(matches!(bounded(circle(200_001)), Err(OutlineError::TooManyPoints { .. })));
        let thinned = bounded(circle(150_000)).unwrap();
        assert!(thinned.len() <= policy::OUTLINE_VERTICES_KEPT);
        assert!((geometry::area(&thinned) - std::f64::consts::PI).abs() < 1e-3);
    }
}
