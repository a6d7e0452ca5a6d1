//! Parts that stand still as solids.

use super::gear::{prism_between, simple};
use super::wall::apart;
use super::{Expected, Mesh, Solid, SolidError, check};
use crate::assembly::{Fixture, Post};
use crate::geometry::{self, Point};
use crate::policy;

/// The fixture as a checked mesh in its own frame: the plate with its holes, and its posts.
///
/// # Errors
/// A [`SolidError`]; no mesh comes back that is not sound.
pub fn fixture_solid(fixture: &Fixture) -> Result<Mesh, SolidError> {
    let Fixture { name, outline, holes, thickness, posts, .. } = fixture;
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
    let mesh = body.mesh();
    check(&mesh, Expected { volume, genus: holes.len() as i64 })
        .map_err(|fault| SolidError::Unsound { part: name.clone(), fault })?;
    Ok(mesh)
}

/// The height of a post that surrounds its hole and keeps clear of the others.
fn height_of(name: &str, post: &Post, holes: &[Vec<Point>]) -> Result<f64, SolidError> {
    let height = post.to - post.from;
    if !(height > 0.0 && height.is_finite() && post.from > 0.0) {
        return Err(SolidError::NotPositiveThickness { thickness: height });
    }
    simple(&format!("{name}'s post"), &post.ring)?;
    for (i, hole) in holes.iter().enumerate() {
        let passes = if post.hole == Some(i) {
            hole.iter().all(|p| geometry::contains(&post.ring, *p))
        } else {
            apart(&post.ring, hole)
        };
        if !passes {
            let (first, second) = ("a post".to_owned(), format!("hole {}", i + 1));
            return Err(SolidError::Overlap { part: name.to_owned(), first, second });
        }
    }
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
            z: -5.0,
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
    fn holes_that_meet_or_cut_the_edge_are_refused() {
        let mut base = plate();
        base.holes.push(base.holes[0].iter().map(|p| Point::new(p.x + 3.0, p.y)).collect());
        assert!(matches!(fixture_solid(&base), Err(SolidError::Overlap { .. })));
        base.holes[1].iter_mut().for_each(|p| p.x += 16.0);
        assert!(matches!(fixture_solid(&base), Err(SolidError::Outside { .. })));
    }
}
