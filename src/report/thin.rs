//! Fewer points for the eye: outlines and curves reduced to what a screen can show.

use crate::geometry::{Point, cross};

/// Drops points of a closed ring that lie within `tolerance` of the line through the kept ones
/// (Ramer, Douglas and Peucker).
pub(crate) fn thin_ring(points: &[Point], tolerance: f64) -> Vec<Point> {
    let n = points.len();
    if n < 4 {
        return points.to_vec();
    }
    let far = (0..n)
        .max_by(|&i, &j| (points[i] - points[0]).norm().total_cmp(&(points[j] - points[0]).norm()));
    let far = far.unwrap_or(0);
    let mut keep = vec![false; n + 1];
    (keep[0], keep[far], keep[n]) = (true, true, true);
    let mut spans = vec![(0, far), (far, n)];
    while let Some((first, last)) = spans.pop() {
        let (a, b) = (points[first], points[last % n]);
        let middle = (first + 1..last)
            .map(|i| (i, distance_to_segment(points[i], a, b)))
            .max_by(|p, q| p.1.total_cmp(&q.1));
        if let Some((i, distance)) = middle
            && distance > tolerance
        {
            keep[i] = true;
            spans.extend([(first, i), (i, last)]);
        }
    }
    points.iter().zip(keep).filter(|(_, kept)| *kept).map(|(p, _)| *p).collect()
}

fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let (u, v) = (b - a, p - a);
    let length = u.norm();
    if length == 0.0 {
        return v.norm();
    }
    match u.dot(&v) / length {
        t if t <= 0.0 => v.norm(),
        t if t >= length => (p - b).norm(),
        _ => cross(u, v).abs() / length,
    }
}

/// At most about `most` finite points of a curve, keeping both ends and the peaks:
/// the lowest and highest point of each of `most / 2` runs.
pub(super) fn thin_curve(points: &[(f64, f64)], most: usize) -> Vec<(f64, f64)> {
    let finite: Vec<_> =
        points.iter().copied().filter(|(x, y)| x.is_finite() && y.is_finite()).collect();
    if finite.len() <= most.max(4) {
        return finite;
    }
    let inner = &finite[1..finite.len() - 1];
    let run = inner.len().div_ceil((most / 2).max(1));
    let mut kept = vec![finite[0]];
    for piece in inner.chunks(run) {
        let by_height = |i: &usize, j: &usize| piece[*i].1.total_cmp(&piece[*j].1);
        let lowest = (0..piece.len()).min_by(by_height).unwrap_or(0);
        let highest = (0..piece.len()).max_by(by_height).unwrap_or(0);
        kept.push(piece[lowest.min(highest)]);
        if lowest != highest {
            kept.push(piece[lowest.max(highest)]);
        }
    }
    kept.extend(finite.last());
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_fine_circle_loses_points_but_not_its_shape() {
        let circle = |i: usize| {
            let t = TAU * i as f64 / 4000.0;
            Point::new(50.0 * t.cos(), 50.0 * t.sin())
        };
        let fine: Vec<_> = (0..4000).map(circle).collect();
        let thin = thin_ring(&fine, 0.01);
        // A chord that leaves the arc by 0.01 spans 2 acos(1 - 0.01/50): at least 157 chords.
        assert!((157..=400).contains(&thin.len()), "{}", thin.len());
        let short = crate::geometry::area(&fine) - crate::geometry::area(&thin);
        assert!((0.0..0.01 * TAU * 50.0).contains(&short), "{short}");
    }

    #[test]
    fn a_spike_survives() {
        let mut curve: Vec<_> = (0..10_000).map(|i| (f64::from(i), 0.0)).collect();
        curve[5432].1 = 9.0;
        curve[77].1 = f64::NAN;
        let thin = thin_curve(&curve, 200);
        assert!(thin.len() <= 202 && thin.contains(&(5432.0, 9.0)));
        assert_eq!((thin[0].0, thin[thin.len() - 1].0), (0.0, 9999.0));
        assert!(thin.windows(2).all(|w| w[0].0 < w[1].0));
    }
}
