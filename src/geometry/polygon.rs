//! Measures of closed polygons. A polygon is a slice of points without a
//! repeated last point; counter-clockwise is positive.

use super::{Point, Vector, cross};
use i_overlay::core::{fill_rule::FillRule, overlay_rule::OverlayRule};
use i_overlay::float::single::SingleFloatOverlay;

/// Signed area: positive for a counter-clockwise polygon.
#[must_use]
pub fn signed_area(points: &[Point]) -> f64 {
    let Some(&origin) = points.first() else {
        return 0.0;
    };
    let edges = points.iter().zip(points.iter().cycle().skip(1));
    0.5 * edges.map(|(a, b)| cross(a - origin, b - origin)).sum::<f64>()
}

/// Unsigned area.
#[must_use]
pub fn area(points: &[Point]) -> f64 {
    signed_area(points).abs()
}

/// Length of the closed boundary.
#[must_use]
pub fn perimeter(points: &[Point]) -> f64 {
    let edges = points.iter().zip(points.iter().cycle().skip(1));
    edges.map(|(a, b)| (b - a).norm()).sum()
}

/// Centre of area; the mean of the points when the area vanishes.
#[must_use]
pub fn centroid(points: &[Point]) -> Point {
    let origin = points.first().copied().unwrap_or_else(Point::origin);
    let (mut doubled, mut moment) = (0.0, Vector::zeros());
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        let (a, b) = (a - origin, b - origin);
        let w = cross(a, b);
        doubled += w;
        moment += w * (a + b);
    }
    if doubled == 0.0 {
        let sum: Vector = points.iter().map(|p| p - origin).sum();
        return origin + sum / points.len().max(1) as f64;
    }
    origin + moment / (3.0 * doubled)
}

/// Lower left and upper right corner of the bounding box.
#[must_use]
pub fn bounds(points: &[Point]) -> (Point, Point) {
    let start = (
        Point::new(f64::INFINITY, f64::INFINITY),
        Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    );
    points.iter().fold(start, |(low, high), p| {
        (Point::from(low.coords.inf(&p.coords)), Point::from(high.coords.sup(&p.coords)))
    })
}

/// Whether `p` lies inside the polygon (even-odd rule; the boundary may go either way).
#[must_use]
pub fn contains(points: &[Point], p: Point) -> bool {
    let edges = points.iter().zip(points.iter().cycle().skip(1));
    edges
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y))
        .filter(|(a, b)| p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
        .count()
        % 2
        == 1
}

/// The first place where two non-adjacent edges meet, or `None` for a simple polygon.
///
/// Sweeps the edges by their left end; O(n log n) for outlines whose edges are short.
#[must_use]
pub fn first_self_crossing(points: &[Point]) -> Option<Point> {
    let n = points.len();
    let edge = |i: usize| (points[i], points[(i + 1) % n]);
    let mut order: Vec<usize> = (0..n).collect();
    let left = |i: usize| edge(i).0.x.min(edge(i).1.x);
    order.sort_by(|&i, &j| left(i).total_cmp(&left(j)));
    let mut active: Vec<usize> = Vec::new();
    for &i in &order {
        let (a, b) = edge(i);
        let (low, high) = (a.y.min(b.y), a.y.max(b.y));
        active.retain(|&j| edge(j).0.x.max(edge(j).1.x) >= left(i));
        for &j in &active {
            let adjacent = (i + 1) % n == j || (j + 1) % n == i;
            let (c, d) = edge(j);
            if adjacent || c.y.max(d.y) < low || c.y.min(d.y) > high {
                continue;
            }
            if let Some(p) = segments_meet(a, b, c, d) {
                return Some(p);
            }
        }
        active.push(i);
    }
    None
}

fn segments_meet(a: Point, b: Point, c: Point, d: Point) -> Option<Point> {
    let (u, v, w) = (b - a, d - c, c - a);
    let det = cross(u, v);
    if det == 0.0 {
        return None;
    }
    let (s, t) = (cross(w, v) / det, cross(w, u) / det);
    ((0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t)).then(|| a + u * s)
}

/// Area of the intersection over area of the union of two simple polygons, in 0..=1.
#[must_use]
pub fn intersection_over_union(a: &[Point], b: &[Point]) -> f64 {
    let plain = |p: &[Point]| p.iter().map(|q| [q.x, q.y]).collect::<Vec<_>>();
    let common = plain(a).overlay(&plain(b), OverlayRule::Intersect, FillRule::NonZero);
    let ring_area = |ring: &Vec<[f64; 2]>| {
        signed_area(&ring.iter().map(|q| Point::new(q[0], q[1])).collect::<Vec<_>>())
    };
    let shared: f64 = common.iter().flatten().map(ring_area).sum();
    let joined = area(a) + area(b) - shared;
    if joined > 0.0 { shared / joined } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Vec<Point> {
        [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(x, y)).to_vec()
    }

    #[test]
    fn measures_of_a_square() {
        let s = square();
        assert_eq!(signed_area(&s), 4.0);
        assert_eq!(perimeter(&s), 8.0);
        assert_eq!(centroid(&s), Point::new(1.0, 1.0));
        assert!(contains(&s, Point::new(0.5, 1.5)) && !contains(&s, Point::new(2.5, 1.0)));
        assert!((intersection_over_union(&s, &s) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_bow_tie_crosses_itself() {
        let mut s = square();
        s.swap(2, 3);
        assert_eq!(first_self_crossing(&s), Some(Point::new(1.0, 1.0)));
        assert_eq!(first_self_crossing(&square()), None);
    }
}
