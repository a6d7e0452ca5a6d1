//! Points on B-spline curves.

use crate::geometry::{Point, Vector};
use crate::policy;

/// The rational B-spline curve of `degree`, [`policy::SPLINE_DEGREE`] at most, at even parameters, `per_span` to a knot
/// span; `None` when knots, weights and control points do not belong together. Empty `weights` are all one.
pub(super) fn points(
    degree: usize,
    knots: &[f64],
    control: &[Point],
    weights: &[f64],
    per_span: usize,
) -> Option<Vec<Point>> {
    let n = control.len();
    let fits = (1..=policy::SPLINE_DEGREE).contains(&degree)
        && n > degree
        && knots.len() == n + degree + 1
        && (weights.is_empty() || weights.len() == n)
        && weights.iter().all(|w| *w > 0.0)
        && knots.windows(2).all(|k| k[0] <= k[1]);
    if !fits {
        return None;
    }
    let mut points = Vec::new();
    for span in degree..n {
        let (from, to) = (knots[span], knots[span + 1]);
        if to <= from {
            continue;
        }
        let first = usize::from(!points.is_empty());
        for i in first..=per_span {
            let t = from + (to - from) * i as f64 / per_span as f64;
            points.push(at(degree, knots, control, weights, span, t));
        }
    }
    Some(points)
}

/// De Boor's recursion in homogeneous coordinates.
fn at(degree: usize, knots: &[f64], control: &[Point], w: &[f64], span: usize, t: f64) -> Point {
    let weight = |i: usize| w.get(i).copied().unwrap_or(1.0);
    let mut d: Vec<[f64; 3]> = (span - degree..=span)
        .map(|i| [control[i].x * weight(i), control[i].y * weight(i), weight(i)])
        .collect();
    for round in 1..=degree {
        for j in (round..=degree).rev() {
            let i = span - degree + j;
            let width = knots[i + degree + 1 - round] - knots[i];
            let share = if width > 0.0 { (t - knots[i]) / width } else { 0.0 };
            let last = d[j - 1];
            for (value, last) in d[j].iter_mut().zip(last) {
                *value = (1.0 - share) * last + share * *value;
            }
        }
    }
    let [x, y, w] = d[degree];
    Point::new(x / w, y / w)
}

/// Even knots for control points that came without: clamped at the ends, or wrapped round.
pub(super) fn even(degree: usize, control: &[Point], closed: bool) -> (Vec<f64>, Vec<Point>) {
    let mut points = control.to_vec();
    if closed {
        if points.len() > 2 && points.first() == points.last() {
            points.pop();
        }
        points.extend(points.clone().iter().cycle().take(degree));
        return ((0..points.len() + degree + 1).map(|i| i as f64).collect(), points);
    }
    let inner = points.len() - degree;
    let knot = |i: usize| i.saturating_sub(degree).min(inner) as f64;
    ((0..points.len() + degree + 1).map(knot).collect(), points)
}

/// The cubic spline through points, at chord-length parameters: periodic where it is closed, else with natural ends.
pub(super) fn through(fit: &[Point], closed: bool, per_span: usize) -> Vec<Point> {
    let mut points = fit.to_vec();
    points.dedup();
    if closed && points.first() != points.last() {
        points.extend(points.first().copied());
    }
    let round = points.len() > 3 && points.first() == points.last();
    let n = points.len() - 1;
    if n < 2 {
        return points;
    }
    let h: Vec<f64> =
        points.windows(2).map(|w| (w[1] - w[0]).norm().max(f64::MIN_POSITIVE)).collect();
    let slope = |i: usize| (points[i + 1] - points[i]) / h[i];
    // Second derivatives m: h[i-1] m[i-1] + 2 (h[i-1] + h[i]) m[i] + h[i] m[i+1] = 6 (slope[i] - slope[i-1]).
    let count = if round { n } else { n + 1 };
    let mut m = vec![Vector::zeros(); count];
    let before = |i: usize| if i == 0 { n - 1 } else { i - 1 };
    // The system is diagonally dominant, so sweeps converge by a factor of two or more each.
    for _ in 0..SWEEPS {
        for i in 0..count {
            if !round && (i == 0 || i == n) {
                continue;
            }
            let (last, next) = (before(i), (i + 1) % count);
            let previous = if round { (i + n - 1) % n } else { i - 1 };
            let right = 6.0 * (slope(i) - slope(last)) - h[last] * m[previous] - h[i] * m[next];
            m[i] = right / (2.0 * (h[last] + h[i]));
        }
    }
    let mut made = vec![points[0]];
    for i in 0..n {
        let (a, b) = (m[i], m[(i + 1) % count]);
        for k in 1..=per_span {
            let t = k as f64 / per_span as f64;
            let s = 1.0 - t;
            let bend = ((s * s * s - s) * a + (t * t * t - t) * b) * (h[i] * h[i] / 6.0);
            made.push(points[i] + (points[i + 1] - points[i]) * t + bend);
        }
    }
    made
}

/// Sweeps over the equations of a spline: 2^-60 of the first error is left.
const SWEEPS: usize = 60;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spline_through_points_of_a_circle_is_nearly_the_circle() {
        let at = |i: u32| {
            let a = f64::from(i) * std::f64::consts::TAU / 24.0;
            Point::new(a.cos(), a.sin())
        };
        let fit: Vec<Point> = (0..24).map(at).collect();
        let made = through(&fit, true, 8);
        assert_eq!(made.len(), 193);
        assert!(made.iter().all(|p| (p.coords.norm() - 1.0).abs() < 2e-5));
        let (knots, points) = even(3, &fit, true);
        let made = points_of(3, &knots, &points);
        assert!((made[0] - made[made.len() - 1]).norm() < 1e-12);
        let open =
            through(&[Point::new(0.0, 0.0), Point::new(1.0, 0.0), Point::new(3.0, 0.0)], false, 4);
        assert!(open.iter().all(|p| p.y == 0.0) && open.len() == 9);
    }

    fn points_of(degree: usize, knots: &[f64], control: &[Point]) -> Vec<Point> {
        points(degree, knots, control, &[], 4).unwrap()
    }

    #[test]
    fn a_rational_quadratic_is_a_quarter_circle() {
        let control = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point::new(x, y));
        let weights = [1.0, std::f64::consts::FRAC_1_SQRT_2, 1.0];
        let knots = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
        let made = points(2, &knots, &control, &weights, 16).unwrap();
        assert_eq!(made.len(), 17);
        assert!(made.iter().all(|p| (p.coords.norm() - 1.0).abs() < 1e-14));
        assert!(points(3, &knots, &control, &weights, 16).is_none());
    }
}
