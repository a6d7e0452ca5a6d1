//! Unions of filled contours, and simple outlines out of self-crossing ones.

use super::simplify::bounded;
use super::{Outline, OutlineError, check_coordinates};
use crate::geometry::{self, Point, cross};
use crate::policy;
use i_overlay::core::{fill_rule::FillRule, overlay_rule::OverlayRule};
use i_overlay::float::overlay::{FloatOverlay, OverlayOptions};
use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};

/// A closed contour in the plain form the boolean library reads.
pub(crate) type Ring = Vec<[f64; 2]>;

/// Makes an outline of `points`, repairing small self-crossings.
///
/// Where the boundary crosses itself it is filled by the non-zero rule, holes are dropped and
/// the largest part is kept, provided it has at least [`policy::REPAIR_AREA_KEPT`] of the area.
/// Outlines of very many points are simplified first ([`policy::OUTLINE_VERTICES_KEPT`]).
///
/// # Errors
/// [`OutlineError::SelfCrossing`] with the first crossing when too much would be lost,
/// otherwise as [`Outline::new`].
pub fn repaired(points: Vec<Point>) -> Result<Outline, OutlineError> {
    check_coordinates(&points)?;
    let points = bounded(points)?;
    let crossings = count_crossings(&[&points])?;
    let failure = match Outline::new(points.clone()) {
        Err(OutlineError::NoArea) if crossings > 0 => crossing_of(&points),
        Err(crossing @ OutlineError::SelfCrossing { .. }) => crossing,
        settled => return settled,
    };
    let parts = filled_parts(&[to_ring(&points)], FillRule::NonZero);
    let total: f64 = parts.iter().map(ring_area).sum();
    match parts.into_iter().next() {
        Some(largest) if ring_area(&largest) >= policy::REPAIR_AREA_KEPT * total => {
            simple(to_points(&largest)).map_err(|_| failure)
        }
        _ => Err(failure),
    }
}

fn crossing_of(points: &[Point]) -> OutlineError {
    geometry::first_self_crossing(points)
        .map_or(OutlineError::NoArea, |p| OutlineError::SelfCrossing { x: p.x, y: p.y })
}

/// An outline of a boolean's result, whose rounding may let neighbouring vertices coincide.
pub(crate) fn simple(points: Vec<Point>) -> Result<Outline, OutlineError> {
    Outline::new(points.clone()).or_else(|_| {
        let (low, high) = geometry::bounds(&points);
        let step = policy::WELD_DISTANCE * (high - low).norm();
        let mut welded: Vec<Point> = Vec::with_capacity(points.len());
        for p in points {
            if welded.last().is_none_or(|q: &Point| (p - q).norm() > step) {
                welded.push(p);
            }
        }
        Outline::new(welded)
    })
}

/// The filled components of `rings`, holes dropped, largest first; counter-clockwise.
pub(crate) fn filled_parts(rings: &[Ring], rule: FillRule) -> Vec<Ring> {
    let shapes = FloatOverlay::with_subj_custom(rings, OverlayOptions::ogc(), Default::default())
        .overlay(OverlayRule::Subject, rule);
    outer_rings(shapes)
}

fn outer_rings(shapes: Vec<Vec<Ring>>) -> Vec<Ring> {
    let mut outer: Vec<Ring> = shapes.into_iter().filter_map(|s| s.into_iter().next()).collect();
    outer.sort_by(|a, b| ring_area(b).total_cmp(&ring_area(a)));
    outer
}

/// Joins separate parts, as [`filled_parts`] gives them, that are nearer to each other than
/// `touch` (unit of the rings).
///
/// Only when something is joined by it is the boundary moved, outwards by half of `touch`.
pub(crate) fn joined(parts: Vec<Ring>, touch: f64) -> Vec<Ring> {
    if parts.len() < 2 {
        return parts;
    }
    let style = |offset: f64| {
        OutlineStyle::new(offset).line_join(LineJoin::Miter(std::f64::consts::FRAC_PI_4))
    };
    let grown = outer_rings(parts.as_slice().outline(&style(touch)));
    if grown.len() >= parts.len() {
        return parts;
    }
    let settled = outer_rings(grown.as_slice().outline(&style(-0.5 * touch)));
    if settled.is_empty() { parts } else { settled }
}

/// Counts how often edges of the polygons cross, up to [`policy::CROSSINGS`].
///
/// Booleans take time and memory in proportion to it, so hostile input is turned away here.
///
/// # Errors
/// [`OutlineError::TooIntricate`] beyond that, or when the search itself would take too long.
pub(crate) fn count_crossings(polygons: &[&[Point]]) -> Result<usize, OutlineError> {
    let mut edges: Vec<(Point, Point)> = polygons
        .iter()
        .flat_map(|p| p.iter().copied().zip(p.iter().copied().cycle().skip(1)))
        .map(|(a, b)| if a.x <= b.x { (a, b) } else { (b, a) })
        .collect();
    edges.sort_by(|e, f| e.0.x.total_cmp(&f.0.x));
    let mut active: Vec<(Point, Point)> = Vec::new();
    let (mut tests, mut crossings) = (0_u64, 0_usize);
    for (a, b) in edges {
        active.retain(|e| e.1.x >= a.x);
        tests += active.len() as u64;
        crossings += active.iter().filter(|&&(c, d)| properly_cross(a, b, c, d)).count();
        if crossings > policy::CROSSINGS || tests > policy::CROSSING_TESTS {
            return Err(OutlineError::TooIntricate);
        }
        active.push((a, b));
    }
    Ok(crossings)
}

fn properly_cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    let (low, high) = (a.y.min(b.y), a.y.max(b.y));
    if c.y.max(d.y) < low || c.y.min(d.y) > high {
        return false;
    }
    let side = |p: Point, q: Point, r: Point| cross(q - p, r - p);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

pub(crate) fn to_ring(points: &[Point]) -> Ring {
    points.iter().map(|p| [p.x, p.y]).collect()
}

pub(crate) fn to_points(ring: &Ring) -> Vec<Point> {
    ring.iter().map(|&[x, y]| Point::new(x, y)).collect()
}

pub(crate) fn ring_area(ring: &Ring) -> f64 {
    geometry::area(&to_points(ring))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<Point> {
        list.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    fn ring(x: f64, y: f64, side: f64) -> Ring {
        vec![[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
    }

    #[test]
    fn a_small_loop_at_a_corner_is_cut_off() {
        let square = points(&[
            (0.0, 0.0),
            (10.0, 0.0),
            (10.0, 10.2),
            (9.9, 10.2),
            (10.1, 10.0),
            (0.0, 10.0),
        ]);
        let outline = repaired(square).unwrap();
        assert!((outline.area() - 100.0).abs() < 0.2, "{}", outline.area());
    }

    #[test]
    fn a_figure_of_eight_is_refused_where_it_crosses() {
        let bow_tie = points(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]);
        let error = repaired(bow_tie).unwrap_err();
        assert_eq!(error, OutlineError::SelfCrossing { x: 1.0, y: 1.0 });
    }

    #[test]
    fn scribbles_are_refused() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let scribble = (0..20_000).map(|_| Point::new(random(), random())).collect();
        assert_eq!(repaired(scribble).unwrap_err(), OutlineError::TooIntricate);
    }

    #[test]
    fn shared_edges_corners_and_hairline_gaps_join() {
        let areas = |rings: &[Ring]| {
            joined(filled_parts(rings, FillRule::NonZero), 1e-3)
                .iter()
                .map(ring_area)
                .collect::<Vec<_>>()
        };
        assert_eq!(areas(&[ring(0.0, 0.0, 1.0), ring(1.0, 0.0, 1.0)]), [2.0]);
        for apart in [1.0, 1.0005] {
            let corner = areas(&[ring(0.0, 0.0, 1.0), ring(apart, apart, 1.0)]);
            assert!(corner.len() == 1 && (corner[0] - 2.0).abs() < 0.01, "{corner:?}");
        }
        let apart = areas(&[ring(0.0, 0.0, 1.0), ring(1.01, 0.0, 2.0)]);
        assert!(apart.len() == 2 && (apart[0] - 4.0).abs() < 1e-6, "{apart:?}");
    }

    #[test]
    fn a_union_that_meets_in_a_corner_is_simple() {
        let whole = joined(vec![ring(0.0, 0.0, 1.0), ring(1.0, 1.0, 1.0)], 1e-3);
        assert!(simple(to_points(&whole[0])).is_ok());
    }
}
