//! Walls between rings: how much material stands between a hole and an edge.

use super::SolidError;
use crate::geometry::{self, Point, cross};
use parry2d_f64::math::Vector;
use parry2d_f64::query::PointQuery;
use parry2d_f64::shape::Polyline;

/// Passes a bore that leaves at least `wall` (mm) of material up to `outline` everywhere.
///
/// Both polygons in the gear's frame, mm; distances are exact for the polygons.
///
/// # Errors
/// [`SolidError::BoreTooLarge`] with the largest round bore about the axis that would fit.
pub fn fits(outline: &[Point], bore: &[Point], wall: f64) -> Result<(), SolidError> {
    let axis = Point::origin();
    let clear = if geometry::contains(outline, axis) { distance_to(outline, axis) } else { 0.0 };
    let reach = bore.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    if reach + wall <= clear {
        return Ok(());
    }
    let inside = bore.iter().all(|&p| geometry::contains(outline, p))
        && !outline.iter().any(|&p| geometry::contains(bore, p));
    let thinnest = if inside { distance_between(outline, bore) } else { 0.0 };
    if thinnest >= wall && thinnest > 0.0 {
        return Ok(());
    }
    let largest = (2.0 * (clear - wall)).max(0.0);
    Err(SolidError::BoreTooLarge { wall: thinnest, needed: wall, largest, kind: "round" })
}

fn edges(ring: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
}

/// The edges of rings, kept so that each of many points is measured in little time.
pub(super) struct Edges(Option<Polyline>);

impl Edges {
    pub(super) fn new(rings: &[Vec<Point>]) -> Self {
        let corners = rings.iter().flatten().map(|p| Vector::new(p.x, p.y)).collect();
        let mut ends = Vec::new();
        for ring in rings {
            let (first, count) = (ends.len() as u32, ring.len() as u32);
            ends.extend((0..count).map(|i| [first + i, first + (i + 1) % count]));
        }
        Self((!ends.is_empty()).then(|| Polyline::new(corners, Some(ends))))
    }

    /// Distance of a point to the nearest edge, mm; infinite without any.
    pub(super) fn distance_to(&self, p: Point) -> f64 {
        let nearest = |line: &Polyline| line.distance_to_local_point(Vector::new(p.x, p.y), true);
        self.0.as_ref().map_or(f64::INFINITY, nearest)
    }
}

pub(super) fn distance_to(ring: &[Point], p: Point) -> f64 {
    edges(ring).map(|(a, b)| distance_to_segment(p, a, b)).fold(f64::INFINITY, f64::min)
}

fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let along = b - a;
    let t = (p - a).dot(&along) / along.norm_squared();
    let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
    (p - (a + along * t)).norm()
}

/// Between two rings; zero where they cross.
pub(super) fn distance_between(a: &[Point], b: &[Point]) -> f64 {
    let crossing = edges(a).any(|(p, q)| {
        edges(b).any(|(r, s)| {
            let side = |u: Point, v: Point, w: Point| cross(v - u, w - u);
            side(p, q, r) * side(p, q, s) < 0.0 && side(r, s, p) * side(r, s, q) < 0.0
        })
    });
    if crossing {
        return 0.0;
    }
    let one_way = |a: &[Point], b: &[Point]| {
        b.iter().map(|&p| distance_to(a, p)).fold(f64::INFINITY, f64::min)
    };
    one_way(a, b).min(one_way(b, a))
}

/// Whether each of two rings lies outside the other, without touching.
pub(super) fn apart(a: &[Point], b: &[Point]) -> bool {
    let ((a_low, a_high), (b_low, b_high)) = (geometry::bounds(a), geometry::bounds(b));
    let beside = |a: f64, b: f64| a > b;
    if beside(a_low.x, b_high.x)
        || beside(b_low.x, a_high.x)
        || beside(a_low.y, b_high.y)
        || beside(b_low.y, a_high.y)
    {
        return true;
    }
    !geometry::contains(a, b[0]) && !geometry::contains(b, a[0]) && distance_between(a, b) > 0.0
}

#[cfg(test)]
mod tests {
    use super::super::{Bore, circle};
    use super::*;
    use crate::geometry::Vector;

    const TOLERANCE: f64 = 0.005;

    #[test]
    fn kept_edges_measure_as_each_edge_does() {
        let rings = [circle(10.0, 0.01), circle(4.0, 0.1)];
        let edges = Edges::new(&rings);
        for i in 0..200 {
            let (r, a) = (0.07 * f64::from(i), 2.4 * f64::from(i));
            let p = Point::new(r * a.cos(), r * a.sin());
            let each = rings.iter().map(|ring| distance_to(ring, p)).fold(f64::INFINITY, f64::min);
            assert!((edges.distance_to(p) - each).abs() < 1e-12, "{p}");
        }
        assert_eq!(Edges::new(&[]).distance_to(Point::origin()), f64::INFINITY);
    }

    #[test]
    fn the_wall_decides_what_fits() {
        let outline = circle(10.0, 1e-4);
        let hole = |diameter| Bore::Round { diameter }.polygon(1e-4).unwrap().unwrap();
        assert_eq!(fits(&outline, &hole(15.9), 2.0), Ok(()));
        match fits(&outline, &hole(17.0), 2.0) {
            Err(SolidError::BoreTooLarge { wall, needed, largest, .. }) => {
                assert!((wall - 1.5).abs() < 1e-3 && needed == 2.0);
                assert!((largest - 16.0).abs() < 1e-3);
                assert_eq!(fits(&outline, &hole(largest - 1e-3), 2.0), Ok(()));
            }
            other => panic!("{other:?}"),
        }
        // A cross may fit between corners where the circle about it would not.
        let square: Vec<Point> =
            Bore::Square { side: 6.0 * 2.0_f64.sqrt() }.polygon(1.0).unwrap().unwrap();
        let cross = Bore::Lego { play: 0.1 }.polygon(TOLERANCE).unwrap().unwrap();
        assert_eq!(fits(&square, &cross, 1.6), Ok(()));
    }

    #[test]
    fn an_axis_outside_the_gear_takes_no_bore() {
        let outline: Vec<Point> =
            circle(10.0, 0.01).iter().map(|p| p + Vector::new(30.0, 0.0)).collect();
        let error = fits(&outline, &circle(1.0, 1.0), 0.0).unwrap_err();
        let (wall, needed, largest) = (0.0, 0.0, 0.0);
        assert_eq!(error, SolidError::BoreTooLarge { wall, needed, largest, kind: "round" });
        assert!(error.to_string().contains("leave the bore out"));
    }
}
