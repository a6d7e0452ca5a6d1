//! The follower carved literally, as the paper draws it (Figure 7): a blank
//! less the driver in all its poses, all of them solids. Slow; it judges the
//! fast carving of the teeth room.

use super::gear::{prism_through, simple};
use super::{Expected, Mesh, Solid, SolidError, check};
use crate::geometry::{self, Point};

/// What the driver leaves of a blank.
#[derive(Clone, Debug, PartialEq)]
pub struct Carved {
    /// Outline of the part that holds the follower's axis: follower's frame, mm, counter-clockwise.
    pub outline: Vec<Point>,
    /// Area of the outline, mm^2.
    pub area: f64,
    /// The solid over the outline, from z = 0 to the thickness.
    pub mesh: Mesh,
}

/// Carves `blank` (mm, follower's frame) by the driver at each of `poses`.
///
/// A pose is (phi_D, phi_F) in radians: driver turned counter-clockwise by phi_D, follower
/// clockwise by phi_F, axes `center_distance` apart. In the follower's frame the driver of a pose
/// is turned by phi_D, moved by -L along x, and turned on by phi_F about the follower's axis.
/// Parts cut loose from the axis are dropped, and so are holes, which no moving driver can make.
/// The result is exact for the poses given; between poses the driver is not swept.
///
/// # Errors
/// [`SolidError::NothingLeft`] when the axis itself is swept; otherwise as for
/// [`super::gear_solid`].
pub fn carve_follower_with_manifold(
    driver_outline: &[Point],
    blank: &[Point],
    center_distance: f64,
    poses: &[(f64, f64)],
    thickness: f64,
) -> Result<Carved, SolidError> {
    if !(thickness > 0.0 && thickness.is_finite()) {
        return Err(SolidError::NotPositiveThickness { thickness });
    }
    simple("the driver", driver_outline)?;
    simple("the follower's blank", blank)?;
    let driver = prism_through(driver_outline, thickness);
    let stock = Solid::extrude(blank, &[], thickness);
    let near = prism_through(&around(blank), thickness);
    let cutters = poses.iter().map(|&(driver_angle, follower_angle)| {
        driver
            .rotate_z(driver_angle)
            .translate(-center_distance, 0.0, 0.0)
            .rotate_z(follower_angle)
            .intersect(&near)
            .settled()
    });
    let rest = stock.subtract(&Solid::union_all(cutters.collect()));
    let outline = rest
        .slice(0.5 * thickness)
        .into_iter()
        .find(|ring| geometry::signed_area(ring) > 0.0 && geometry::contains(ring, Point::origin()))
        .ok_or(SolidError::NothingLeft)?;
    let area = geometry::area(&outline);
    let mesh = Solid::extrude(&outline, &[], thickness).mesh();
    check(&mesh, Expected { volume: area * thickness, genus: 0 })
        .map_err(|fault| SolidError::Unsound { part: "the carved follower".to_owned(), fault })?;
    Ok(Carved { outline, area, mesh })
}

/// An octagon about the axis that clears the blank: what of a driver lies outside cuts nothing, and
/// dropping it first makes every union smaller.
fn around(blank: &[Point]) -> Vec<Point> {
    let reach = blank.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    let corner = Point::new(1.25 * reach, 0.0);
    (0..8).map(|i| geometry::rotate(corner, f64::from(i) * std::f64::consts::FRAC_PI_4)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::circle;
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn even_poses(count: usize) -> Vec<(f64, f64)> {
        (0..count).map(|i| TAU * i as f64 / count as f64).map(|a| (a, a)).collect()
    }

    #[test]
    fn a_round_driver_leaves_a_round_follower() {
        let (radius, distance) = (30.0, 50.0);
        let driver = circle(radius, 1e-2);
        let carved = carve_follower_with_manifold(
            &driver,
            &circle(25.0, 1e-2),
            distance,
            &even_poses(128),
            5.0,
        )
        .unwrap();
        let least = PI * (distance - radius).powi(2);
        // Below the scallops between poses and the chords of the driver stays the true circle.
        assert!(carved.area > least && carved.area < least * (1.0 + 5e-3), "{}", carved.area);
        assert!((carved.mesh.volume() / (5.0 * carved.area) - 1.0).abs() < 2e-5);
    }

    #[test]
    fn frames_follow_the_conventions() {
        // A driver with one long finger along +x at angle 0, seen once: it notches the
        // follower on the side that faces the driver, at local angle pi + phi_F.
        let finger =
            [(-5.0, -1.0), (20.0, -1.0), (20.0, 1.0), (-5.0, 1.0)].map(|(x, y)| Point::new(x, y));
        let follower_angle = 0.7;
        let carved = carve_follower_with_manifold(
            &finger,
            &circle(12.0, 1e-2),
            30.0,
            &[(0.0, follower_angle)],
            2.0,
        )
        .unwrap();
        let deepest = carved
            .outline
            .iter()
            .min_by(|a, b| a.coords.norm().total_cmp(&b.coords.norm()))
            .unwrap();
        let floor = geometry::rotate(Point::new(-10.0, 0.0), follower_angle);
        assert!((deepest - floor).norm() < 1.5, "{deepest} {floor}");
        // And the driver's own turn moves the finger away: nothing is cut.
        let untouched = carve_follower_with_manifold(
            &finger,
            &circle(12.0, 1e-2),
            30.0,
            &[(PI, follower_angle)],
            2.0,
        )
        .unwrap();
        assert!((untouched.area - geometry::area(&circle(12.0, 1e-2))).abs() < 1e-9);
    }

    #[test]
    fn a_driver_over_the_axis_leaves_nothing() {
        let error = carve_follower_with_manifold(
            &circle(30.0, 0.01),
            &circle(10.0, 0.01),
            20.0,
            &even_poses(8),
            5.0,
        );
        assert_eq!(error, Err(SolidError::NothingLeft));
    }
}
