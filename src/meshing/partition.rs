//! Convex pieces of an outline, for programs that collide convex bodies.
//!
//! 1. A constrained Delaunay triangulation of the outline; triangles outside are left out.
//! 2. Diagonals are taken away, longest first, wherever the joined piece stays convex, or so
//!    nearly that its hull adds no more than the tolerance.
//!
//! Nothing is approximated: with tolerance 0 the pieces cover the outline and nothing else.

use crate::geometry::{Point, cross, signed_area};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Why an outline has no partition.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PartitionError {
    /// Fewer than three points, or no area.
    #[error("the outline has no area; give a closed curve of at least three points")]
    NoArea,
    /// A coordinate is not finite, or too large or small to triangulate.
    #[error("point {index} of the outline cannot be used; give finite coordinates in mm")]
    BadPoint {
        /// Index of the point, from zero.
        index: usize,
    },
    /// Two points coincide, or two edges cross.
    #[error(
        "the outline touches or crosses itself near ({x:.4}, {y:.4}); give a simple closed curve"
    )]
    NotSimple {
        /// Where, mm.
        x: f64,
        /// Where, mm.
        y: f64,
    },
}

/// Convex pieces, each counter-clockwise, that together cover a simple counter-clockwise outline.
///
/// A piece may reach beyond the union of its triangles by up to `hull_tolerance` (mm): the hull
/// over a shallow dent. At tolerance 0 their areas sum to the outline's and none overlap, up to
/// rounding. The same outline always gives the same pieces in the same order. About
/// O(n log n) for gears, whose pieces are small.
///
/// # Errors
/// See [`PartitionError`].
pub fn convex_partition(
    outline: &[Point],
    hull_tolerance: f64,
) -> Result<Vec<Vec<Point>>, PartitionError> {
    let pieces = convex_pieces(outline, hull_tolerance)?;
    Ok(pieces.iter().map(|piece| piece.points(outline)).collect())
}

/// A convex piece of an outline by the numbers of its corners, counter-clockwise.
pub(super) struct Piece {
    pub(super) corners: Vec<usize>,
    /// Whether the edge that begins at each corner lies on the outline, or spans a shallow dent of it; else it runs
    /// through the material.
    pub(super) on_outline: Vec<bool>,
}

impl Piece {
    pub(super) fn points(&self, outline: &[Point]) -> Vec<Point> {
        self.corners.iter().map(|&i| outline[i]).collect()
    }
}

/// The pieces of [`convex_partition`], by number.
pub(super) fn convex_pieces(
    outline: &[Point],
    hull_tolerance: f64,
) -> Result<Vec<Piece>, PartitionError> {
    let faces = triangles(outline)?;
    let mut pieces = Pieces::new(outline, faces);
    pieces.merge(hull_tolerance);
    Ok(pieces.hulls())
}

/// Triangles inside the outline, counter-clockwise, as indices of its points.
fn triangles(outline: &[Point]) -> Result<Vec<[usize; 3]>, PartitionError> {
    let n = outline.len();
    if n < 3 {
        return Err(PartitionError::NoArea);
    }
    if let Some(index) = outline.iter().position(|p| !(p.x.is_finite() && p.y.is_finite())) {
        return Err(PartitionError::BadPoint { index });
    }
    let area = signed_area(outline);
    if area <= 0.0 || area.is_nan() {
        return Err(PartitionError::NoArea);
    }
    let points: Vec<_> = outline.iter().map(|p| Point2::new(flush(p.x), flush(p.y))).collect();
    let edges = (0..n).map(|i| [i, (i + 1) % n]).collect();
    let mut conflict = None;
    let cdt = ConstrainedDelaunayTriangulation::<_>::try_bulk_load_cdt(points, edges, |edge| {
        conflict.get_or_insert(edge[0]);
    })
    .map_err(|_| PartitionError::BadPoint { index: 0 })?;
    let not_simple = |at: usize| PartitionError::NotSimple { x: outline[at].x, y: outline[at].y };
    if let Some(at) = conflict {
        return Err(not_simple(at.min(n - 1)));
    }
    if cdt.num_vertices() != n || cdt.num_constraints() != n {
        return Err(not_simple(repeated(outline).unwrap_or(0)));
    }
    // A face is inside when the edge that begins at one of its outline edges runs along it; the
    // others follow from a neighbour across a diagonal.
    let mut inside = vec![None; cdt.num_all_faces()];
    let mut queue = Vec::new();
    for edge in cdt.directed_edges().filter(|e| e.is_constraint_edge()) {
        let (from, to) = (edge.from().index(), edge.to().index());
        let face = edge.face().fix().index();
        let along = (from + 1) % n == to;
        if inside[face].is_none() {
            inside[face] = Some(along);
            queue.push(edge.face().fix());
        }
    }
    while let Some(fixed) = queue.pop() {
        let within = inside[fixed.index()];
        let Some(face) = cdt.face(fixed).as_inner() else { continue };
        for edge in face.adjacent_edges().into_iter().filter(|e| !e.is_constraint_edge()) {
            let next = edge.rev().face().fix();
            if inside[next.index()].is_none() {
                inside[next.index()] = within;
                queue.push(next);
            }
        }
    }
    Ok(cdt
        .inner_faces()
        .filter(|f| inside[f.fix().index()] == Some(true))
        .map(|f| f.vertices().map(|v| v.index()))
        .collect())
}

/// Coordinates too small for the triangulation's exact arithmetic count as zero.
fn flush(v: f64) -> f64 {
    spade::mitigate_underflow(Point2::new(v, 0.0)).x
}

fn repeated(outline: &[Point]) -> Option<usize> {
    let mut order: Vec<usize> = (0..outline.len()).collect();
    let key = |i: usize| (outline[i].x, outline[i].y);
    order.sort_by(|&a, &b| {
        let (a, b) = (key(a), key(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    order.windows(2).find(|w| key(w[0]) == key(w[1])).map(|w| w[0])
}

/// Loops of outline points that shrink in number as they are merged.
struct Pieces<'a> {
    outline: &'a [Point],
    loops: Vec<Vec<usize>>,
    /// Which loop took a loop in; itself while it lives.
    owner: Vec<usize>,
    diagonals: Vec<Diagonal>,
}

/// An edge between two pieces, from `a` to `b` along the first.
struct Diagonal {
    length: f64,
    ends: [usize; 2],
    sides: [usize; 2],
}

impl<'a> Pieces<'a> {
    fn new(outline: &'a [Point], faces: Vec<[usize; 3]>) -> Self {
        let mut edges: Vec<([usize; 2], bool, usize)> = Vec::with_capacity(3 * faces.len());
        for (face, v) in faces.iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (v[k], v[(k + 1) % 3]);
                edges.push(([a.min(b), a.max(b)], a < b, face));
            }
        }
        edges.sort_unstable();
        let mut diagonals: Vec<Diagonal> = edges
            .windows(2)
            .filter(|w| w[0].0 == w[1].0)
            // `false` sorts first: the first of the two runs from the greater index to the lesser.
            .map(|w| Diagonal {
                length: (outline[w[0].0[0]] - outline[w[0].0[1]]).norm(),
                ends: [w[0].0[1], w[0].0[0]],
                sides: [w[0].2, w[1].2],
            })
            .collect();
        diagonals.sort_by(|a, b| b.length.total_cmp(&a.length).then(a.ends.cmp(&b.ends)));
        let owner = (0..faces.len()).collect();
        Self { outline, loops: faces.into_iter().map(Vec::from).collect(), owner, diagonals }
    }

    fn merge(&mut self, tolerance: f64) {
        for diagonal in std::mem::take(&mut self.diagonals) {
            let [first, second] = diagonal.sides.map(|side| self.living(side));
            if first == second {
                continue;
            }
            let Some(joined) = self.joined(first, second, diagonal.ends) else { continue };
            if self.is_nearly_convex(&joined, tolerance) {
                self.loops[first] = joined;
                self.loops[second] = Vec::new();
                self.owner[second] = first;
            }
        }
    }

    fn living(&mut self, mut piece: usize) -> usize {
        while self.owner[piece] != piece {
            self.owner[piece] = self.owner[self.owner[piece]];
            piece = self.owner[piece];
        }
        piece
    }

    /// Both loops without their common edge, which runs from `a` to `b` in the first.
    fn joined(&self, first: usize, second: usize, [a, b]: [usize; 2]) -> Option<Vec<usize>> {
        let turned = |piece: usize, start: usize| {
            let ring = &self.loops[piece];
            let at = ring.iter().position(|&v| v == start)?;
            Some(ring[at..].iter().chain(&ring[..at]).copied().collect::<Vec<_>>())
        };
        // From b round to a, then on from a round to just before b.
        let mut joined = turned(first, b)?;
        let other = turned(second, a)?;
        debug_assert!(joined.last() == Some(&a) && other.last() == Some(&b));
        joined.extend_from_slice(&other[1..other.len() - 1]);
        Some(joined)
    }

    fn is_nearly_convex(&self, ring: &[usize], tolerance: f64) -> bool {
        let hull = hull(self.outline, ring);
        if hull.len() < 3 {
            return false;
        }
        let n = ring.len();
        (0..hull.len()).all(|k| {
            let (i, j) = (hull[k], hull[(k + 1) % hull.len()]);
            let (p, q) = (self.outline[ring[i]], self.outline[ring[j]]);
            let along = (q - p).normalize();
            let mut at = (i + 1) % n;
            // Hull corners must follow each other as the loop runs; the steps bound the walk.
            for _ in 0..n {
                if at == j {
                    return true;
                }
                if cross(along, self.outline[ring[at]] - p) > tolerance {
                    return false;
                }
                at = (at + 1) % n;
            }
            false
        })
    }

    fn hulls(&self) -> Vec<Piece> {
        self.loops
            .iter()
            .filter(|ring| !ring.is_empty())
            .map(|ring| self.piece(ring))
            // Three points in a line make a triangle without area; there is nothing to cover.
            .filter(|piece| {
                piece.corners.len() >= 3 && signed_area(&piece.points(self.outline)) > 0.0
            })
            .collect()
    }

    fn piece(&self, ring: &[usize]) -> Piece {
        let hull = hull(self.outline, ring);
        let follows = |at: usize| {
            let next = ring[(at + 1) % ring.len()];
            next == (ring[at] + 1) % self.outline.len()
        };
        let on_outline = (0..hull.len())
            .map(|k| {
                let (from, to) = (hull[k], hull[(k + 1) % hull.len()]);
                let steps = (to + ring.len() - from) % ring.len();
                (0..steps).any(|step| follows((from + step) % ring.len()))
            })
            .collect();
        Piece { corners: hull.iter().map(|&k| ring[k]).collect(), on_outline }
    }
}

/// Corners of the convex hull of a loop, counter-clockwise, as indices into the loop.
fn hull(outline: &[Point], ring: &[usize]) -> Vec<usize> {
    let at = |k: usize| outline[ring[k]];
    let mut order: Vec<usize> = (0..ring.len()).collect();
    order.sort_by(|&a, &b| at(a).x.total_cmp(&at(b).x).then(at(a).y.total_cmp(&at(b).y)));
    let mut corners: Vec<usize> = Vec::with_capacity(ring.len() + 1);
    let half = |points: &mut dyn Iterator<Item = usize>, corners: &mut Vec<usize>| {
        let base = corners.len();
        for k in points {
            while corners.len() >= base + 2 {
                let (p, q) = (at(corners[corners.len() - 2]), at(corners[corners.len() - 1]));
                if cross(q - p, at(k) - q) > 0.0 {
                    break;
                }
                corners.pop();
            }
            corners.push(k);
        }
        corners.pop();
    };
    half(&mut order.iter().copied(), &mut corners);
    half(&mut order.iter().rev().copied(), &mut corners);
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{area, contains, rotate, union};
    use crate::meshing::spur::Spur;
    use std::f64::consts::TAU;

    fn gear() -> Vec<Point> {
        let spur =
            Spur { teeth: 24, module: 2.0, pressure_angle: 20_f64.to_radians(), thinning: 0.1 };
        spur.outline(0.1, 40, 21)
    }

    fn is_convex(piece: &[Point]) -> bool {
        let n = piece.len();
        (0..n).all(|i| {
            let (a, b, c) = (piece[i], piece[(i + 1) % n], piece[(i + 2) % n]);
            cross(b - a, c - b) > 0.0
        })
    }

    #[test]
    fn pieces_cover_the_gear_exactly_and_do_not_overlap() {
        let outline = gear();
        let pieces = convex_partition(&outline, 0.0).unwrap();
        assert!(pieces.iter().all(|p| is_convex(p)));
        let sum: f64 = pieces.iter().map(|p| area(p)).sum();
        let whole = area(&outline);
        assert!((sum / whole - 1.0).abs() < 1e-12, "{sum} {whole}");
        // The union has that area too: so nothing lies outside and nothing is covered twice.
        let covered: f64 = union(&pieces).iter().flatten().map(|ring| signed_area(ring)).sum();
        assert!((covered / whole - 1.0).abs() < 1e-9, "{covered} {whole}");
        assert!(pieces.len() < outline.len() / 4, "{} pieces", pieces.len());
    }

    #[test]
    fn hulls_stay_within_the_tolerance() {
        // A flower of shallow dents: radius 10 with waves of 0.12.
        let outline: Vec<Point> = (0..720)
            .map(|i| TAU * f64::from(i) / 720.0)
            .map(|a| rotate(Point::new(10.0 + 0.12 * (12.0 * a).cos(), 0.0), a))
            .collect();
        let exact = convex_partition(&outline, 0.0).unwrap();
        let loose = convex_partition(&outline, 0.3).unwrap();
        assert_eq!(loose.len(), 1);
        assert!(exact.len() > 6, "{}", exact.len());
        let grown = area(&loose[0]) - area(&outline);
        assert!(grown > 0.0 && grown < 0.3 * TAU * 10.0);
    }

    #[test]
    fn every_piece_lies_inside() {
        let outline = gear();
        for piece in convex_partition(&outline, 0.0).unwrap() {
            let center = piece.iter().map(|p| p.coords).sum::<crate::geometry::Vector>()
                / piece.len() as f64;
            assert!(contains(&outline, Point::from(center)));
        }
    }

    #[test]
    fn bad_outlines_are_refused() {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let points =
            |p: &[(f64, f64)]| p.iter().map(|&(x, y)| Point::new(x, y)).collect::<Vec<_>>();
        assert_eq!(convex_partition(&points(&square), 0.0).unwrap().len(), 1);
        assert_eq!(convex_partition(&points(&square[..2]), 0.0), Err(PartitionError::NoArea));
        let mut bow = points(&[(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (1.0, 3.0), (3.0, -1.0)]);
        assert!(matches!(convex_partition(&bow, 0.0), Err(PartitionError::NotSimple { .. })));
        bow[2].x = f64::NAN;
        assert_eq!(convex_partition(&bow, 0.0), Err(PartitionError::BadPoint { index: 2 }));
        let twice =
            points(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 1.0), (2.0, 2.0), (0.0, 2.0)]);
        assert!(matches!(convex_partition(&twice, 0.0), Err(PartitionError::NotSimple { .. })));
    }
}
