//! Bevelled edges: a triangulation of the plane between an edge and its offsets, lifted into space.
//!
//! A height field over a triangulation is a closed surface whatever the outline does: where a bevel
//! of a thin tooth would run into itself it ends in a flat ledge.

use super::{Mesh, SolidError};
use crate::geometry::{self, Point, signed_area};
use crate::outline::simplify;
use crate::policy;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// A lifted surface closed by walls and a flat face.
pub(super) struct Bevelled {
    /// The closed mesh, outward.
    pub(super) mesh: Mesh,
    /// Its outer ring as it was drawn: in single precision, as kernels take meshes.
    pub(super) outer: Vec<Point>,
    /// Signed volume between the lifted surface and the plane of its outer edge, mm^3.
    pub(super) lifted: f64,
}

/// The prism over `outline` from z = 0 to `top`, its lower edge bevelled at 45 degrees by `chamfer`; mm.
pub(super) fn bevelled_prism(
    part: &str,
    outline: &[Point],
    top: f64,
    chamfer: f64,
) -> Result<Bevelled, SolidError> {
    let levels: Vec<(Vec<Point>, f64)> = [0.5, 1.0]
        .into_iter()
        .flat_map(|share| {
            let inward = rings(outline, -share * chamfer);
            inward.into_iter().map(move |ring| (ring, (1.0 - share) * chamfer))
        })
        .collect();
    lifted(outline, top, chamfer, &levels)
        .ok_or_else(|| SolidError::NoBevel { part: part.to_owned(), chamfer })
}

/// What a bore's prism must be joined with to bevel the bore's edge at z = 0, sticking out below by
/// `overhang`; the bore's ring comes back as second. Its `lifted` counts the bore's prism up to
/// z = `chamfer` as well.
pub(super) fn bore_bevel(
    part: &str,
    bore: &[Point],
    overhang: f64,
    chamfer: f64,
) -> Result<(Bevelled, Vec<Point>), SolidError> {
    let none = || SolidError::NoBevel { part: format!("{part}'s bore"), chamfer };
    let bore = single(bore);
    let wide = rings(&bore, chamfer).pop().ok_or_else(none)?;
    let made = lifted(&wide, -overhang, 0.0, &[(bore.clone(), chamfer)]).ok_or_else(none)?;
    Ok((made, bore))
}

/// The outer rings of an offset, without needless vertices.
fn rings(ring: &[Point], distance: f64) -> Vec<Vec<Point>> {
    let faces = geometry::offset(ring, distance, policy::BEVEL_CHORD);
    let fine = policy::BEVEL_TOLERANCE;
    let outer = faces.into_iter().filter_map(|face| face.into_iter().next());
    outer
        .map(|ring| simplify(&ring, fine))
        .filter(|r| r.len() > 2 && signed_area(r) > fine)
        .collect()
}

/// In the precision in which kernels take meshes.
fn single(ring: &[Point]) -> Vec<Point> {
    ring.iter().map(|p| Point::new(f64::from(p.x as f32), f64::from(p.y as f32))).collect()
}

/// The body between a flat face at `flat` and a surface over the same outline that lies at `edge`
/// along the outline and at given heights along rings inside it.
fn lifted(outer: &[Point], flat: f64, edge: f64, levels: &[(Vec<Point>, f64)]) -> Option<Bevelled> {
    let outer = single(outer);
    let n = outer.len();
    let (mut points, mut heights) = (outer.clone(), vec![edge; n]);
    let mut edges: Vec<[usize; 2]> = (0..n).map(|i| [i, (i + 1) % n]).collect();
    for (ring, height) in levels {
        let (start, count) = (points.len(), ring.len());
        points.extend(single(ring));
        heights.extend(vec![*height; count]);
        edges.extend((0..count).map(|i| [start + i, start + (i + 1) % count]));
    }
    let surface = inside(&points, &edges, n)?;
    let cap = inside(&outer, &edges[..n], n)?;
    let lifted = surface
        .iter()
        .map(|t| {
            let area = signed_area(&t.map(|i| points[i]));
            area * t.iter().map(|&i| heights[i] - edge).sum::<f64>() / 3.0
        })
        .sum();
    let mut mesh = Mesh::default();
    mesh.positions.extend(points.iter().zip(&heights).map(|(p, &z)| [p.x, p.y, z]));
    let below = mesh.positions.len();
    mesh.positions.extend(outer.iter().map(|p| [p.x, p.y, flat]));
    let index = |i: usize| i as u32;
    mesh.triangles.extend(surface.iter().map(|t| t.map(index)));
    mesh.triangles
        .extend(cap.iter().map(|&[a, b, c]| [below + a, below + c, below + b].map(index)));
    for i in 0..n {
        let k = (i + 1) % n;
        mesh.triangles.push([below + i, below + k, k].map(index));
        mesh.triangles.push([below + i, k, i].map(index));
    }
    if flat > edge {
        mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    Some(Bevelled { mesh, outer, lifted })
}

/// Triangles, counter-clockwise, of the region inside the ring of the first `n` points, which keep
/// all `edges`; none when edges cross or points coincide.
fn inside(points: &[Point], edges: &[[usize; 2]], n: usize) -> Option<Vec<[usize; 3]>> {
    let sites =
        points.iter().map(|p| spade::mitigate_underflow(Point2::new(p.x, p.y))).collect::<Vec<_>>();
    let mut crossed = false;
    let cdt =
        ConstrainedDelaunayTriangulation::<_>::try_bulk_load_cdt(sites, edges.to_vec(), |_| {
            crossed = true;
        })
        .ok()?;
    if crossed || cdt.num_vertices() != points.len() || cdt.num_constraints() != edges.len() {
        return None;
    }
    let outline = |a: usize, b: usize| a < n && b < n && ((a + 1) % n == b || (b + 1) % n == a);
    let mut within = vec![None; cdt.num_all_faces()];
    let mut queue = Vec::new();
    for edge in cdt.directed_edges().filter(|e| e.is_constraint_edge()) {
        let (from, to) = (edge.from().index(), edge.to().index());
        let face = edge.face().fix();
        if outline(from, to) && within[face.index()].is_none() {
            within[face.index()] = Some((from + 1) % n == to);
            queue.push(face);
        }
    }
    while let Some(fixed) = queue.pop() {
        let known = within[fixed.index()];
        let Some(face) = cdt.face(fixed).as_inner() else { continue };
        for edge in face.adjacent_edges() {
            let next = edge.rev().face().fix();
            let barred = outline(edge.from().index(), edge.to().index());
            if !barred && within[next.index()].is_none() {
                within[next.index()] = known;
                queue.push(next);
            }
        }
    }
    let faces = cdt.inner_faces().filter(|f| within[f.fix().index()] == Some(true));
    Some(faces.map(|f| f.vertices().map(|v| v.index())).collect())
}

#[cfg(test)]
mod tests {
    use super::super::{Bore, Expected, check, circle};
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_bevelled_disc_is_a_disc_less_a_ring() {
        let (r, c, h) = (20.0, 0.5, 6.0);
        let made = bevelled_prism("disc", &circle(r, 1e-4), h, c).unwrap();
        // A cylinder on a frustum.
        let frustum = PI * c / 3.0 * (r * r + r * (r - c) + (r - c) * (r - c));
        let volume = PI * r * r * (h - c) + frustum;
        assert!((made.mesh.volume() / volume - 1.0).abs() < 1e-5);
        assert_eq!(check(&made.mesh, Expected { volume, genus: 0 }), Ok(()));
        assert!((made.lifted + frustum).abs() < 1e-3 * frustum, "{}", made.lifted);
    }

    #[test]
    fn dents_and_tips_thinner_than_the_bevel_stay_closed() {
        // A comb: tips 0.6 wide, gaps 0.8 wide, bevelled by 0.4.
        let mut comb = vec![Point::new(0.0, 0.0), Point::new(20.0, 0.0)];
        for i in (0..10).rev() {
            let x = 2.0 * f64::from(i);
            comb.extend(
                [(x + 1.4, 4.0), (x + 1.3, 8.0), (x + 0.7, 8.0), (x, 4.0)]
                    .map(|(x, y)| Point::new(x, y)),
            );
        }
        let (h, c) = (5.0, 0.4);
        let made = bevelled_prism("comb", &comb, h, c).unwrap();
        let plain = geometry::area(&comb) * h;
        // The bevel takes the strip within t of the edge over the height c - t.
        let shrunk = |t: f64| {
            let faces = geometry::offset(&comb, -t, 0.05);
            geometry::area(&comb) - faces.iter().map(|f| geometry::area(&f[0])).sum::<f64>()
        };
        let steps = 200;
        let taken: f64 = (0..steps)
            .map(|i| shrunk(c * (f64::from(i) + 0.5) / f64::from(steps)) * c / f64::from(steps))
            .sum();
        let found = plain - made.mesh.volume();
        // Ledges on tips, which are thinner than two bevels, take more.
        assert!(found > taken && found < 1.1 * taken, "{found} {taken}");
        let expected = Expected { volume: made.mesh.volume(), genus: 0 };
        assert_eq!(check(&made.mesh, expected), Ok(()));
    }

    #[test]
    fn a_bevelled_square_bore_has_a_pyramid_with_rounded_corners() {
        let (s, c) = (4.0, 0.5);
        let bore = Bore::Square { side: s }.polygon(1e-3).unwrap().unwrap();
        let (made, _) = bore_bevel("gear", &bore, 1.0, c).unwrap();
        // Over the height z the side strips are c - z wide and the corners round.
        let volume = s * s * c + 4.0 * s * c * c / 2.0 + PI * c.powi(3) / 3.0;
        assert!((made.lifted / volume - 1.0).abs() < 2e-3, "{} {volume}", made.lifted);
        let whole = volume + geometry::area(&made.outer);
        assert_eq!(check(&made.mesh, Expected { volume: made.mesh.volume(), genus: 0 }), Ok(()));
        assert!((made.mesh.volume() / whole - 1.0).abs() < 2e-3);
    }

    #[test]
    fn rings_that_cross_are_no_bevel() {
        let mut crossed = circle(10.0, 0.1);
        crossed.swap(3, 9);
        assert!(matches!(bevelled_prism("x", &crossed, 5.0, 0.4), Err(SolidError::NoBevel { .. })));
    }
}
