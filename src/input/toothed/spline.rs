//! Points on B-spline curves.

use crate::geometry::Point;
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

#[cfg(test)]
mod tests {
    use super::*;

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
