//! Marks that show how two gears go together.

use super::Taken;
use crate::assembly::{Gear, Mark};
use crate::geometry::{self, Point, Vector};
use crate::policy;

/// Sinks an arrowhead into the gear's top face that points at the mate's in the first pose, along
/// `towards` (to the mate's axis), as near to the mate as the material lets it. Tells whether there
/// was room.
pub(super) fn add(gear: &mut Gear, towards: Vector, module: f64, taken: &mut Taken) -> bool {
    let along = towards.normalize();
    let across = geometry::quarter_turn(along);
    let edge = geometry::offset(&gear.outline, -policy::MARK_WALL, policy::OPENING_CHORD);
    let Some(room) =
        edge.into_iter().map(|f| f[0].clone()).find(|r| geometry::contains(r, Point::origin()))
    else {
        return false;
    };
    let barred = taken.grown(policy::MARK_WALL);
    let reach = room.iter().map(|p| p.coords.dot(&along)).fold(0.0, f64::max);
    let largest = (policy::MARK_LENGTH * module).clamp(policy::MARK_LEAST, policy::MARK_MOST);
    for length in [largest, 0.7 * largest, 0.5 * largest] {
        if length < policy::MARK_LEAST {
            break;
        }
        let half = 0.5 * policy::MARK_WIDTH * length;
        let steps = (reach / policy::MARK_STEP) as usize;
        for i in 0..steps {
            let tip = reach - i as f64 * policy::MARK_STEP;
            if tip - length <= taken.radius {
                break;
            }
            let back = Point::from(along * (tip - length));
            let ring = vec![Point::from(along * tip), back + across * half, back - across * half];
            if is_free(&ring, &room, &barred) {
                taken.rings.push(ring.clone());
                gear.fittings.marks.push(Mark {
                    name: "phase mark".to_owned(),
                    face: vec![ring],
                    height: -policy::ENGRAVING_DEPTH,
                });
                return true;
            }
        }
    }
    false
}

/// Whether a small convex ring lies inside `room` and clear of what is `barred`.
fn is_free(ring: &[Point], room: &[Point], barred: &[Vec<Point>]) -> bool {
    let samples = ring.iter().zip(ring.iter().cycle().skip(1)).flat_map(|(a, b)| {
        let n = policy::MARK_SAMPLES;
        (0..n).map(move |i| a + (b - a) * (f64::from(i) / f64::from(n)))
    });
    samples
        .into_iter()
        .all(|p| geometry::contains(room, p) && !barred.iter().any(|r| geometry::contains(r, p)))
}
