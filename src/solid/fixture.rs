//! Parts that stand still as solids.

use super::gear::{prism_between, simple};
use super::wall::apart;
use super::{Expected, Mesh, Solid, SolidError, check};
use crate::assembly::{Fixture, Pocket, Post};
use crate::geometry::{self, Point};
use crate::policy;

/// The fixture as a checked mesh in its own frame: the plate with its holes, its posts, and its pockets.
///
/// # Errors
/// A [`SolidError`]; no mesh comes back that is not sound.
pub fn fixture_solid(fixture: &Fixture) -> Result<Mesh, SolidError> {
    let Fixture { name, outline, holes, thickness, posts, pockets, .. } = fixture;
    let thickness = *thickness;
    if !(thickness > 0.0 && thickness.is_finite()) {
        return Err(SolidError::NotPositiveThickness { thickness });
    }
    simple(name, outline)?;
    for (i, hole) in holes.iter().enumerate() {
        simple(&format!("{name}'s hole {}", i + 1), hole)?;
        let within = hole.iter().all(|p| geometry::contains(outline, *p));
        let overlap = |k: usize| SolidError::Overlap {
            part: name.clone(),
            first: format!("hole {}", k + 1),
            second: format!("hole {}", i + 1),
        };
        if !within {
            let (what, why) = (format!("hole {}", i + 1), "it cuts the edge".to_owned());
            return Err(SolidError::Outside { part: name.clone(), what, why });
        }
        if let Some(k) = (0..i).find(|&k| !apart(&holes[k], hole)) {
            return Err(overlap(k));
        }
    }
    let mut body = Solid::extrude(outline, &[], thickness);
    let mut volume = geometry::area(outline) * thickness;
    let mut tops = vec![thickness; holes.len()];
    for post in posts {
        volume += height_of(name, post, holes)? * geometry::area(&post.ring);
        // It reaches down into what it stands on, so that no two faces only touch.
        let foot = (1.0 - policy::POST_ROOT) * post.from;
        body = body.union(&prism_between(&post.ring, foot, post.to));
        if let Some(top) = post.hole.and_then(|i| tops.get_mut(i)) {
            *top = top.max(post.to);
        }
    }
    let overhang = policy::CUTTER_OVERHANG * thickness;
    for (hole, top) in holes.iter().zip(tops) {
        body = body.subtract(&prism_between(hole, -overhang, top + overhang));
        volume -= geometry::area(hole) * top;
    }
    for pocket in pockets {
        volume -= depth_of(name, pocket, holes)? * {
            let widened = pocket.hole.and_then(|i| holes.get(i));
            geometry::area(&pocket.ring) - widened.map_or(0.0, |hole| geometry::area(hole))
        };
        // Out of the side that it opens to.
        let (from, to) = if pocket.from > 0.0 {
            (pocket.from, pocket.to + overhang)
        } else {
            (-overhang, pocket.to)
        };
        body = body.subtract(&prism_between(&pocket.ring, from, to));
    }
    let mesh = body.mesh();
    check(&mesh, Expected { volume, genus: holes.len() as i64 })
        .map_err(|fault| SolidError::Unsound { part: name.clone(), fault })?;
    Ok(mesh)
}

/// The depth of a pocket that surrounds its hole and keeps clear of the others.
fn depth_of(name: &str, pocket: &Pocket, holes: &[Vec<Point>]) -> Result<f64, SolidError> {
    let depth = pocket.to - pocket.from;
    if !(depth > 0.0 && depth.is_finite() && pocket.from >= 0.0) {
        return Err(SolidError::NotPositiveThickness { thickness: depth });
    }
    simple(&format!("{name}'s pocket"), &pocket.ring)?;
    around(name, "a pocket", &pocket.ring, pocket.hole, holes)?;
    Ok(depth)
}

/// Passes a ring that surrounds one hole, if it is to, and keeps clear of the others.
fn around(
    name: &str,
    what: &str,
    ring: &[Point],
    own: Option<usize>,
    holes: &[Vec<Point>],
) -> Result<(), SolidError> {
    for (i, hole) in holes.iter().enumerate() {
        let passes = if own == Some(i) {
            hole.iter().all(|p| geometry::contains(ring, *p))
        } else {
            apart(ring, hole)
        };
        if !passes {
            let (first, second) = (what.to_owned(), format!("hole {}", i + 1));
            return Err(SolidError::Overlap { part: name.to_owned(), first, second });
        }
    }
    Ok(())
}

/// The height of a post that surrounds its hole and keeps clear of the others.
fn height_of(name: &str, post: &Post, holes: &[Vec<Point>]) -> Result<f64, SolidError> {
    let height = post.to - post.from;
    if !(height > 0.0 && height.is_finite() && post.from > 0.0) {
        return Err(SolidError::NotPositiveThickness { thickness: height });
    }
    simple(&format!("{name}'s post"), &post.ring)?;
    around(name, "a post", &post.ring, post.hole, holes)?;
    Ok(height)
}

#[cfg(test)]
mod tests {
    use super::super::circle;
    use super::*;
    use std::f64::consts::PI;

    fn plate() -> Fixture {
        let outline = [(-20.0, -12.0), (60.0, -12.0), (60.0, 12.0), (-20.0, 12.0)];
        let at = |x: f64, r: f64| -> Vec<Point> {
            circle(r, 1e-4).iter().map(|p| Point::new(p.x + x, p.y)).collect()
        };
        let post = |x, r, hole, from, to| Post { ring: at(x, r), hole, from, to };
        Fixture {
            name: "base".to_owned(),
            outline: outline.map(|(x, y)| Point::new(x, y)).to_vec(),
            holes: vec![at(40.0, 2.4)],
            thickness: 4.0,
            posts: vec![
                post(0.0, 5.0, None, 4.0, 5.0),
                post(0.0, 2.5, None, 5.0, 14.0),
                post(40.0, 4.0, Some(0), 4.0, 5.0),
            ],
            pockets: Vec::new(),
            stance: crate::assembly::Stance::flat(-5.0),
        }
    }

    #[test]
    fn a_plate_with_posts_has_the_sum_of_their_volumes() {
        let mesh = fixture_solid(&plate()).unwrap();
        let disc = |r: f64| PI * r * r;
        let volume =
            (80.0 * 24.0 - disc(2.4)) * 4.0 + disc(5.0) + 9.0 * disc(2.5) + disc(4.0) - disc(2.4);
        assert!((mesh.volume() / volume - 1.0).abs() < 1e-4, "{} {volume}", mesh.volume());
        let heights: Vec<f64> = mesh.positions.iter().map(|p| p[2]).collect();
        assert!(heights.iter().all(|z| [0.0, 4.0, 5.0, 14.0].contains(z)));
    }

    #[test]
    fn pockets_take_what_they_measure() {
        let mut base = plate();
        let plain = fixture_solid(&base).unwrap().volume();
        let ring = |r: f64| {
            base.holes[0]
                .iter()
                .map(|p| Point::new(40.0 + (p.x - 40.0) * r / 2.4, p.y * r / 2.4))
                .collect::<Vec<_>>()
        };
        let areas = [3.5, 3.0].map(|r| geometry::area(&ring(r)) - geometry::area(&base.holes[0]));
        let [below, above] = [ring(3.5), ring(3.0)];
        base.pockets = vec![
            Pocket { ring: below, hole: Some(0), from: 0.0, to: 2.0 },
            Pocket { ring: above, hole: Some(0), from: 4.5, to: 5.0 },
        ];
        let taken = plain - fixture_solid(&base).unwrap().volume();
        assert!((taken - 2.0 * areas[0] - 0.5 * areas[1]).abs() < 1e-3, "{taken}");
        base.pockets[0].hole = None;
        assert!(matches!(fixture_solid(&base), Err(SolidError::Overlap { .. })));
    }

    #[test]
    fn holes_that_meet_or_cut_the_edge_are_refused() {
        let mut base = plate();
        base.holes.push(base.holes[0].iter().map(|p| Point::new(p.x + 3.0, p.y)).collect());
        assert!(matches!(fixture_solid(&base), Err(SolidError::Overlap { .. })));
        base.holes[1].iter_mut().for_each(|p| p.x += 16.0);
        assert!(matches!(fixture_solid(&base), Err(SolidError::Outside { .. })));
    }
}
