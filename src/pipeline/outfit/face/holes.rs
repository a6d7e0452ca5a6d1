//! Holes of a drawing as holes of its gear, with walls about them.

use super::{DrawnHoles, FaceChoice, Place, lines, plain, room};
use crate::assembly::{Gear, Opening};
use crate::control::StageName;
use crate::diagnose::{Code, Diagnostic};
use crate::geometry::{self, Face, Point, Vector};
use crate::input::Inner;
use crate::pipeline::outfit::Taken;
use crate::policy;

/// Rim that is left under the roots, mm and in modules, whichever is more: half of what goes all round with
/// [`policy::LIGHTENING_RIM_MODULES`], for drawn holes are few.
pub(super) const RIM: (f64, f64) = (2.0, 1.2);
/// Wall between two holes, and width of the bridges that hold what lies within a hole, mm: five lines of the usual nozzle.
const WALL: f64 = 2.0;
/// Smaller holes than this are filled in, mm^2: a circle of 2 mm.
const LEAST_AREA: f64 = 3.0;
/// Narrower holes than this are filled in, mm.
const LEAST_WIDTH: f64 = 1.0;
/// Bridges to an island with the axis, and to any other.
const BRIDGES: (usize, usize) = (3, 2);

/// Makes the holes of a drawing, given in the gear's frame, holes of the gear, and tells which are lost.
pub(in super::super) fn add(
    gear: &mut Gear,
    (holes, face): (DrawnHoles, &FaceChoice),
    inner: &Inner,
    (module, nozzle): (f64, f64),
    taken: &mut Taken,
) -> Option<Diagnostic> {
    if holes == DrawnHoles::Fill || inner.holes.is_empty() {
        return None;
    }
    let wanted: Vec<Face> = inner.holes.iter().map(|ring| vec![ring.clone()]).collect();
    let place = Place::new(gear, module, face.fit, nozzle);
    let rim = RIM.0.max(RIM.1 * module);
    let moved = place.faces(&wanted);
    let room = room(gear, rim, module, taken).unwrap_or_default();
    let inside = geometry::common(&lines::rings(&moved), &room);
    let before = gear.fittings.openings.len();
    let mut lost = cut(gear, with_bridges(inside), "drawn hole");
    let made = &gear.fittings.openings[before..];
    taken.rings.extend(made.iter().map(|o| o.ring.clone()));
    let gone = moved.iter().filter(|face| {
        !made.iter().any(|o| geometry::contains(&face[0], geometry::centroid(&o.ring)))
    });
    let gone = gone.count();
    if gone > 0 {
        let note = Diagnostic::note(Code::HolesLost, StageName::Outfitted);
        lost =
            Some(note.about(&gear.name).with("count", gone as f64).with("of", moved.len() as f64));
    }
    lost
}

/// Cuts areas through a gear, the largest first, each with a wall to those before it; what has no room is left whole and
/// told.
pub(super) fn cut(gear: &mut Gear, areas: Vec<Face>, name: &str) -> Option<Diagnostic> {
    let chord = policy::OPENING_CHORD;
    let mut made: Vec<Vec<Point>> = Vec::new();
    let mut areas = areas;
    areas.sort_by(|a, b| geometry::area(&b[0]).total_cmp(&geometry::area(&a[0])));
    let wanted = areas.len();
    let mut kept = 0;
    for area in areas {
        let walls = made.iter().flat_map(|ring| geometry::offset(ring, WALL, chord));
        let free = geometry::without(&area, &walls.flatten().collect::<Vec<_>>());
        let sound = lines::opened(&free, LEAST_WIDTH).into_iter().filter_map(|f| plain(&f));
        let rings = sound.filter(|f| f.len() == 1 && geometry::area(&f[0]) >= LEAST_AREA);
        let before = made.len();
        made.extend(rings.flatten());
        kept += usize::from(made.len() > before);
    }
    let openings = made.into_iter().enumerate();
    let openings = openings.map(|(i, ring)| Opening { name: format!("{name} {}", i + 1), ring });
    gear.fittings.openings.extend(openings);
    (kept < wanted).then(|| {
        let note = Diagnostic::note(Code::HolesLost, StageName::Outfitted);
        let lost = (wanted - kept) as f64;
        note.about(&gear.name).with("count", lost).with("of", wanted as f64)
    })
}

/// Areas without islands: what would fall out is held by bridges.
pub(super) fn with_bridges(areas: Vec<Face>) -> Vec<Face> {
    areas
        .into_iter()
        .flat_map(|area| {
            if area.len() < 2 {
                return vec![area];
            }
            let bridges: Vec<Vec<Point>> =
                area[1..].iter().flat_map(|i| bridges(&area, i)).collect();
            geometry::without(&area, &lines::rings(&geometry::union(&bridges)))
        })
        .filter(|area| area.len() == 1)
        .collect()
}

/// Bars from an island to what lies about its hole.
fn bridges(area: &Face, island: &[Point]) -> Vec<Vec<Point>> {
    let axis = Point::origin();
    let has_axis = geometry::contains(island, axis);
    let middle = if has_axis { axis } else { geometry::centroid(island) };
    let count = if has_axis { BRIDGES.0 } else { BRIDGES.1 };
    (0..count)
        .map(|i| {
            let turn = std::f64::consts::TAU * (i as f64 / count as f64 + 0.25);
            let along = Vector::new(turn.cos(), turn.sin());
            let across = geometry::quarter_turn(along) * (0.5 * WALL);
            // Out of the island, then out of the hole.
            let mut ends: Vec<f64> =
                area.iter().flat_map(|r| crossings(r, middle, along)).collect();
            ends.sort_by(f64::total_cmp);
            let end = along * (ends.get(1).copied().unwrap_or(0.0) + WALL);
            vec![middle - across, middle + end - across, middle + end + across, middle + across]
        })
        .collect()
}

/// Distances at which a ray crosses a ring.
fn crossings(ring: &[Point], from: Point, along: Vector) -> Vec<f64> {
    let edges = ring.iter().zip(ring.iter().cycle().skip(1));
    edges
        .filter_map(|(a, b)| {
            let (u, v) = (geometry::cross(along, a - from), geometry::cross(along, b - from));
            let at =
                ((u > 0.0) != (v > 0.0)).then(|| (a - from + (b - a) * (u / (u - v))).dot(&along));
            at.filter(|t| *t > 0.0)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::circle;

    #[test]
    fn what_lies_in_a_hole_is_held_by_bridges() {
        let inner: Vec<Point> = circle(6.0, 0.01).into_iter().rev().collect();
        let held = with_bridges(vec![vec![circle(10.0, 0.01), inner.clone()]]);
        assert_eq!(held.len(), BRIDGES.0);
        assert!(held.iter().all(|area| area.len() == 1));
        let total: f64 = held.iter().map(|a| geometry::area(&a[0])).sum();
        // Three bars 4 mm long and 2 mm wide are missing.
        let ring = std::f64::consts::PI * (100.0 - 36.0);
        assert!((ring - total - 24.0).abs() < 0.8, "{}", ring - total);
        let beside = |r: &[Point]| r.iter().map(|p| Point::new(p.x + 30.0, p.y)).collect();
        let off = vec![beside(&circle(10.0, 0.01)), beside(&inner)];
        assert_eq!(with_bridges(vec![off]).len(), BRIDGES.1);
    }

    #[test]
    fn holes_keep_walls_to_each_other() {
        let mut gear = crate::solid::tests::wavy("driver", 640, crate::solid::Bore::None);
        let disc = |x: f64, r: f64| -> Face {
            vec![circle(r, 0.01).iter().map(|p| Point::new(p.x + x, p.y)).collect()]
        };
        let lost = cut(&mut gear, vec![disc(0.0, 5.0), disc(10.5, 5.0), disc(20.0, 0.3)], "hole");
        assert!(lost.is_some_and(|l| l.code == Code::HolesLost));
        let rings: Vec<&[Point]> =
            gear.fittings.openings.iter().map(|o| o.ring.as_slice()).collect();
        assert_eq!(rings.len(), 2);
        let gap = rings[1].iter().map(|p| p.coords.norm() - 5.0).fold(f64::INFINITY, f64::min);
        assert!(gap > WALL - 0.05, "{gap}");
    }
}
