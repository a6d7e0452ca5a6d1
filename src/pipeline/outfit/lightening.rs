//! Holes that save material and leave a rim, a hub and spokes.

use super::{Lightening, Taken};
use crate::assembly::{Gear, Opening};
use crate::geometry::{self, Face, Point, Vector};
use crate::outline::simplify;
use crate::policy;
use std::f64::consts::TAU;

/// Cuts holes as asked; the first spoke points along `towards`. Tells whether there was room.
///
/// What is left of the gear inside the rim, without hub and spokes and what stands in the way,
/// rounded off: so the holes follow whatever shape the gear has.
pub(super) fn add(
    gear: &mut Gear,
    choice: Lightening,
    towards: Vector,
    module: f64,
    taken: &Taken,
) -> bool {
    if choice == Lightening::None {
        return true;
    }
    let rim = policy::LIGHTENING_RIM.max(policy::LIGHTENING_RIM_MODULES * module);
    let wall = policy::LIGHTENING_WALL;
    // Taking off half a tooth's thickness more than the rim, and giving it back, leaves no teeth; a
    // little more leaves no waves from one root to the next either.
    let tooth = policy::TOOTH_HALF_THICKNESS * module;
    let smooth = policy::LIGHTENING_SMOOTHING * module;
    let Some(core) = core(&gear.outline, rim, tooth + smooth) else { return false };
    let count = match choice {
        Lightening::Holes(count) => count,
        _ => {
            let (least, most) = policy::LIGHTENING_CHOICE;
            let wanted = geometry::perimeter(&core) / policy::LIGHTENING_SPACING;
            (wanted.round() as u32).clamp(least, most)
        }
    };
    let mut tools = taken.grown(wall);
    let reach = core.iter().map(|p| p.coords.norm()).fold(0.0, f64::max) + wall;
    let first = towards.y.atan2(towards.x);
    for i in 0..count {
        let angle = first + TAU * f64::from(i) / f64::from(count);
        let spoke = [(0.0, -1.0), (reach, -1.0), (reach, 1.0), (0.0, 1.0)]
            .map(|(x, y)| geometry::rotate(Point::new(x, 0.5 * wall * y), angle));
        tools.push(spoke.to_vec());
    }
    let mut holes: Vec<Vec<Point>> =
        geometry::difference(&core, &tools).into_iter().flat_map(rounded).collect();
    holes.sort_by(|a, b| {
        let angle = |ring: &[Point]| {
            let c = geometry::centroid(ring);
            (c.y.atan2(c.x) - first).rem_euclid(TAU)
        };
        angle(a).total_cmp(&angle(b))
    });
    for (i, ring) in holes.iter().enumerate() {
        let name = format!("lightening hole {}", i + 1);
        gear.fittings.openings.push(Opening { name, ring: ring.clone() });
    }
    !holes.is_empty()
}

/// The gear inside its rim, about the axis.
fn core(outline: &[Point], rim: f64, tooth: f64) -> Option<Vec<Point>> {
    let about = |faces: Vec<Face>| {
        faces.into_iter().map(|f| f[0].clone()).find(|r| geometry::contains(r, Point::origin()))
    };
    let chord = policy::OPENING_CHORD;
    let inner = about(geometry::offset(outline, -(rim + tooth), chord))?;
    let inner = simplify(&inner, policy::OPENING_TOLERANCE);
    about(geometry::offset(&inner, tooth, chord))
}

/// A face with its sharp corners rounded; nothing of a small face, or of one with holes in it.
fn rounded(face: Face) -> Vec<Vec<Point>> {
    let [ring] = face.as_slice() else { return Vec::new() };
    let (r, chord) = (policy::LIGHTENING_FILLET, policy::OPENING_CHORD);
    geometry::offset(ring, -r, chord)
        .into_iter()
        .flat_map(|f| geometry::offset(&f[0], r, chord))
        .filter(|f| f.len() == 1 && geometry::area(&f[0]) >= policy::LIGHTENING_LEAST_AREA)
        .map(|f| simplify(&f[0], policy::OPENING_TOLERANCE))
        .collect()
}
