//! The band of convex pieces along the surface of an outline: all that can touch another gear.
//!
//! The body of a gear is a convex piece of hundreds of corners that lies near every tooth of its mate. Only its edges
//! on the outline can ever be touched, so pieces like it are cut: along each stretch of the outline a strip of some
//! depth remains, and the core is left out.

use super::partition::{PartitionError, Piece, convex_pieces};
use crate::geometry::{Point, Vector, bounds, quarter_turn, signed_area};

/// Corners from which on a piece is cut. What two pieces cost grows with their corners; a whole tooth has 40 to 60.
const MOST_CORNERS: usize = 64;
/// Length and width, in modules, from which on a piece is cut: it lies near many teeth of the mate, a tooth near two.
const MOST_EXTENT: f64 = 4.0;
/// Depth of the strip under a stretch of the outline, in modules: ten times the overlap at which a pair fails.
const DEPTH: f64 = 0.5;
/// Most edges of one stretch.
const STRETCH_EDGES: usize = 16;
/// Longest stretch of several edges, in modules. Shorter ones than [`DEPTH`] would be pushed out sideways.
const STRETCH_LENGTH: f64 = 1.0;
/// Most turn from the first edge of a stretch to its last, as the cosine of the angle (60 degrees): the strip lies
/// between the perpendiculars to the stretch's chord at both ends, so the stretch must not turn back over them.
const STRETCH_COSINE: f64 = 0.5;
/// Corners nearer to each other than this, in modules, are one.
const SAME_CORNER: f64 = 1e-7;

/// Convex pieces, each counter-clockwise, that hold every point of the outline and lie in it.
///
/// As with [`convex_partition`](super::convex_partition) a piece may reach over a dent of up to `hull_tolerance`.
/// Lengths in the unit of the outline. The order follows the outline.
///
/// # Errors
/// See [`PartitionError`].
pub(super) fn surface_band(
    outline: &[Point],
    module: f64,
    hull_tolerance: f64,
) -> Result<Vec<Vec<Point>>, PartitionError> {
    let mut band: Vec<(usize, Vec<Point>)> = Vec::new();
    for piece in convex_pieces(outline, hull_tolerance)? {
        let Some(first) = piece.on_outline.iter().position(|&on| on) else { continue };
        let points = piece.points(outline);
        let (low, high) = bounds(&points);
        if points.len() < MOST_CORNERS && (high - low).max() < MOST_EXTENT * module {
            band.push((piece.corners[first], points));
        } else {
            for [from, edges] in stretches(&piece, &points, module) {
                let strip = strip(&points, from, edges, module);
                if strip.len() >= 3 && signed_area(&strip) > 0.0 {
                    band.push((piece.corners[from], strip));
                }
            }
        }
    }
    if band.is_empty() {
        return Err(PartitionError::NoArea);
    }
    band.sort_by_key(|(at, _)| *at);
    Ok(band.into_iter().map(|(_, points)| points).collect())
}

/// The corner at which each stretch begins, and how many edges it has.
fn stretches(piece: &Piece, points: &[Point], module: f64) -> Vec<[usize; 2]> {
    let n = points.len();
    let edge = |i: usize| points[(i + 1) % n] - points[i % n];
    // Begin after an edge that is not on the outline, if there is one.
    let start = piece.on_outline.iter().position(|&on| !on).map_or(0, |i| i + 1);
    let mut found: Vec<[usize; 2]> = Vec::new();
    let mut open = false;
    for i in start..start + n {
        if !piece.on_outline[i % n] {
            open = false;
            continue;
        }
        let last = found.last_mut().filter(|_| open);
        match last {
            Some([from, edges])
                if *edges < STRETCH_EDGES
                    && (points[(i + 1) % n] - points[*from]).norm() < STRETCH_LENGTH * module
                    && edge(*from).normalize().dot(&edge(i).normalize()) > STRETCH_COSINE =>
            {
                *edges += 1;
            }
            _ => found.push([i % n, 1]),
        }
        open = true;
    }
    found
}

/// What of a convex piece lies under the stretch of `edges` edges from corner `from` on.
fn strip(points: &[Point], from: usize, edges: usize, module: f64) -> Vec<Point> {
    let (p, q) = (points[from], points[(from + edges) % points.len()]);
    let along = (q - p).normalize();
    let inward = quarter_turn(along);
    let cut = clipped(points.to_vec(), p, along);
    let cut = clipped(cut, q, -along);
    let mut cut = clipped(cut, p + inward * (DEPTH * module), -inward);
    let near = SAME_CORNER * module;
    cut.dedup_by(|a, b| (*a - *b).norm() < near);
    while cut.len() > 1 && (cut[0] - cut[cut.len() - 1]).norm() < near {
        cut.pop();
    }
    cut
}

/// The part of a convex polygon on the side of the line through `at` to which `normal` points.
fn clipped(polygon: Vec<Point>, at: Point, normal: Vector) -> Vec<Point> {
    let height = |p: &Point| (p - at).dot(&normal);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (h, k) = (height(p), height(q));
        if h >= 0.0 {
            kept.push(*p);
        }
        if (h > 0.0 && k < 0.0) || (h < 0.0 && k > 0.0) {
            kept.push(p + (q - p) * (h / (h - k)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{contains, cross, union};
    use crate::meshing::spur::Spur;

    fn gear() -> Vec<Point> {
        let spur =
            Spur { teeth: 40, module: 2.0, pressure_angle: 20_f64.to_radians(), thinning: 0.1 };
        spur.outline(0.1, 12, 37)
    }

    #[test]
    fn the_band_holds_the_whole_outline_and_nothing_outside_it() {
        let outline = gear();
        let band = surface_band(&outline, 2.0, 0.0).unwrap();
        for piece in &band {
            let n = piece.len();
            let turns = (0..n).all(|i| {
                let (a, b, c) = (piece[i], piece[(i + 1) % n], piece[(i + 2) % n]);
                cross(b - a, c - b) > -1e-12
            });
            assert!(turns && signed_area(piece) > 0.0);
        }
        let covered = union(&band);
        let sum: f64 = covered.iter().flatten().map(|ring| signed_area(ring)).sum();
        assert!(sum < 0.9 * signed_area(&outline), "the core is left out");
        for i in 0..outline.len() {
            let (p, q) = (outline[i], outline[(i + 1) % outline.len()]);
            let inside = nalgebra::center(&p, &q) + quarter_turn((q - p).normalize()) * 1e-3;
            let outside = nalgebra::center(&p, &q) - quarter_turn((q - p).normalize()) * 1e-3;
            assert!(band.iter().any(|piece| contains(piece, inside)), "edge {i}");
            assert!(!band.iter().any(|piece| contains(piece, outside)), "edge {i}");
        }
    }

    #[test]
    fn no_piece_has_many_corners() {
        let outline: Vec<Point> = (0..2000)
            .map(|i| f64::from(i) * std::f64::consts::TAU / 2000.0)
            .map(|a| Point::new(30.0 * a.cos(), 30.0 * a.sin()))
            .collect();
        let band = surface_band(&outline, 1.0, 0.0).unwrap();
        assert!(band.iter().all(|piece| piece.len() <= STRETCH_EDGES + 3));
        assert!(band.len() < 400, "{}", band.len());
    }
}
